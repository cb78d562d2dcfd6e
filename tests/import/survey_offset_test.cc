#include "editor/import/model/survey_offset.h"

#include <gtest/gtest.h>

#include <cstring>
#include <string>

namespace lararium::import {
namespace {

std::vector<std::byte> Bytes(const std::string& text) {
  const auto* begin = reinterpret_cast<const std::byte*>(text.data());
  return {begin, begin + text.size()};
}

std::string Text(const std::vector<std::byte>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

TEST(SurveyOffset, IsWholeKilometresAndOnlyForWhatLiesFarAway) {
  using Points = std::vector<glm::dvec3>;
  EXPECT_EQ(SurveyOffset(Points{{451'234.0, 4'520'678.0, 30.0}, {451'244.0, 4'520'690.0, 36.0}}),
            glm::dvec3(451'000.0, 4'521'000.0, 0.0));
  EXPECT_EQ(SurveyOffset(Points{{-5.0, 0.0, 0.0}, {20.0, 3.0, 10.0}}), glm::dvec3(0.0));
  EXPECT_EQ(SurveyOffset(Points{{0.0, 0.0, 0.0}, {30'000.0, 3000.0, 10'000.0}}), glm::dvec3(0.0));
  EXPECT_EQ(SurveyOffset(Points{}), glm::dvec3(0.0));
}

TEST(TakeOffSurvey, KeepsAllDigitsOfAnObj) {
  std::vector<std::byte> bytes = Bytes(
      "# scan\nv 451234.125 4520678.001 30.5 0.5 0.5 0.5\nvn 0 0 1\n"
      "v 451235.125\t4520678.002 30.5\r\nf 1 2 1\n");
  EXPECT_EQ(TakeOffSurvey(".obj", bytes), glm::dvec3(451'000.0, 4'521'000.0, 0.0));
  EXPECT_EQ(Text(bytes),
            "# scan\nv 234.125000 -321.999000 30.500000 0.5 0.5 0.5\nvn 0 0 1\n"
            "v 235.125000 -321.998000 30.500000\r\nf 1 2 1\n");
  const std::vector<std::byte> near = Bytes("v 1 2 3\nv 4 5 6\n");
  bytes = near;
  EXPECT_EQ(TakeOffSurvey(".obj", bytes), glm::dvec3(0.0));
  EXPECT_EQ(bytes, near);
}

TEST(TakeOffSurvey, ReadsTheDoublesOfAPly) {
  const std::string head =
      "ply\nformat binary_little_endian 1.0\nelement vertex 2\nproperty uchar red\n"
      "property double x\nproperty double y\nproperty double z\nelement face 0\n"
      "property list uchar int vertex_indices\nend_header\n";
  std::vector<std::byte> bytes = Bytes(head);
  const glm::dvec3 points[] = {{451'234.0, 4'520'678.0, 30.0}, {451'235.0, 4'520'678.0, 31.0}};
  for (const glm::dvec3& point : points) {
    bytes.push_back(std::byte{7});
    const auto* begin = reinterpret_cast<const std::byte*>(&point);
    bytes.insert(bytes.end(), begin, begin + sizeof(point));
  }
  std::vector<std::byte> cut(bytes.begin(), bytes.end() - 1);
  EXPECT_EQ(TakeOffSurvey(".ply", cut), glm::dvec3(0.0));
  EXPECT_EQ(TakeOffSurvey(".ply", bytes), glm::dvec3(451'000.0, 4'521'000.0, 0.0));
  glm::dvec3 second;
  std::memcpy(&second, bytes.data() + head.size() + 1 + sizeof(second) + 1, sizeof(second));
  EXPECT_EQ(second, glm::dvec3(235.0, -322.0, 31.0));
}

TEST(TakeOffSurvey, ReadsThePlyThatIsText) {
  std::vector<std::byte> bytes = Bytes(
      "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n"
      "property float z\nend_header\n451234.125 4520678 30\n451235 4520679 31\n");
  EXPECT_EQ(TakeOffSurvey(".ply", bytes), glm::dvec3(451'000.0, 4'521'000.0, 0.0));
  EXPECT_NE(Text(bytes).find("\n234.125000 -322.000000 30.000000\n"), std::string::npos);
}

}  // namespace
}  // namespace lararium::import
