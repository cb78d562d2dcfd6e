#include "editor/bake/probe.h"

#include <ImfRgbaFile.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <numbers>
#include <opencv2/imgcodecs.hpp>

#include "editor/bake/sun_split.h"
#include "shared/core/file.h"
#include "tests/support/test_files.h"

namespace lararium::bake {
namespace {

using ::testing::HasSubstr;
using Texel = std::function<glm::vec3(int column, int row)>;

void WriteExr(const std::filesystem::path& file, int width, int height, const Texel& texel) {
  std::vector<Imf::Rgba> pixels;
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      const glm::vec3 value = texel(column, row);
      pixels.emplace_back(value.r, value.g, value.b);
    }
  }
  Imf::RgbaOutputFile output(file.c_str(), width, height, Imf::WRITE_RGB);
  output.setFrameBuffer(pixels.data(), 1, width);
  output.writePixels(height);
}

// One bright texel on grey.
Texel Lamp(int lamp_column, int lamp_row) {
  return [=](int column, int row) {
    return column == lamp_column && row == lamp_row ? glm::vec3(400.0f, 300.0f, 200.0f)
                                                    : glm::vec3(0.5f);
  };
}

class Probe : public ::testing::Test {
 protected:
  test::TemporaryFolder folder_;
};

TEST_F(Probe, LightsTheSideThatTheLampIsOn) {
  WriteExr(folder_ / "right.exr", 64, 32, Lamp(48, 16));  // azimuth 90 degrees, horizon
  const auto image = ReadProbeImage(folder_ / "right.exr");
  ASSERT_TRUE(image.ok()) << image.message();
  const light::ShRgb light = ProjectProbeLight(*image, {}).Whole();
  EXPECT_GT(light::EvaluateIrradiance(light, {1, 0, 0}).r,
            2.0f * light::EvaluateIrradiance(light, {-1, 0, 0}).r);
  EXPECT_NEAR(light::EvaluateIrradiance(light, {0, 0, 1}).r,
              light::EvaluateIrradiance(light, {0, 0, -1}).r, 0.3);
}

TEST_F(Probe, PlacementTurnsAndScalesTheLight) {
  WriteExr(folder_ / "p.exr", 64, 32, Lamp(48, 16));
  const auto image = ReadProbeImage(folder_ / "p.exr");
  ASSERT_TRUE(image.ok()) << image.message();
  const light::ShRgb light = ProjectProbeLight(*image, {}).Whole();
  const glm::quat left =
      glm::angleAxis(std::numbers::pi_v<float> / 2.0f, glm::vec3(0, 1, 0));  // +X to -Z
  const light::ShRgb turned =
      ProjectProbeLight(*image, {.stage_from_probe = left, .radiance_scale = 3.0f}).Whole();
  EXPECT_NEAR(light::EvaluateIrradiance(turned, {0, 0, -1}).g,
              3.0f * light::EvaluateIrradiance(light, {1, 0, 0}).g, 1e-3);
}

TEST_F(Probe, RadianceAndOpenExrAgree) {
  const Texel texel = [](int column, int row) {
    return glm::vec3(0.25f + (column % 7) * 0.5f, 1.0f + (row % 5) * 0.5f, 32.0f);
  };
  WriteExr(folder_ / "p.exr", 32, 16, texel);
  cv::Mat bgr(16, 32, CV_32FC3);
  for (int row = 0; row < 16; ++row) {
    for (int column = 0; column < 32; ++column) {
      const glm::vec3 value = texel(column, row);
      bgr.at<cv::Vec3f>(row, column) = cv::Vec3f(value.b, value.g, value.r);
    }
  }
  ASSERT_TRUE(cv::imwrite((folder_ / "p.hdr").string(), bgr));
  const auto exr = ReadProbeImage(folder_ / "p.exr");
  const auto hdr = ReadProbeImage(folder_ / "p.hdr");
  ASSERT_TRUE(exr.ok() && hdr.ok());
  ASSERT_EQ(exr->pixels.size(), hdr->pixels.size());
  for (size_t i = 0; i < exr->pixels.size(); ++i) {
    // A Radiance file keeps eight bits of the brightest channel.
    EXPECT_NEAR(exr->pixels[i].r, hdr->pixels[i].r, 32.0 / 128.0);
    EXPECT_NEAR(exr->pixels[i].b, hdr->pixels[i].b, 32.0 / 128.0);
  }
}

TEST_F(Probe, RefusesAnImageThatIsNotEquirectangular) {
  WriteExr(folder_ / "square.exr", 32, 32, Lamp(3, 3));
  const auto image = ReadProbeImage(folder_ / "square.exr");
  ASSERT_FALSE(image.ok());
  EXPECT_THAT(image.message(), HasSubstr("32 x 32"));
  EXPECT_THAT(image.message(), HasSubstr("square.exr"));
}

TEST_F(Probe, MendsATexelThatIsNoNumberAndNamesIt) {
  WriteExr(folder_ / "nan.exr", 32, 16, [](int column, int row) {
    return glm::vec3(column == 5 && row == 3 ? std::numeric_limits<float>::quiet_NaN() : 1.0f);
  });
  const auto image = ReadProbeImage(folder_ / "nan.exr");
  ASSERT_TRUE(image.ok()) << image.message();
  EXPECT_EQ(image->pixels[3 * 32 + 5], glm::vec3(1.0f));
  ASSERT_FALSE(image->warnings.empty());
  EXPECT_THAT(image->warnings[0], HasSubstr("pixel (5, 3)"));
}

TEST_F(Probe, RefusesManyTexelsThatAreNoNumbers) {
  WriteExr(folder_ / "nan.exr", 32, 16, [](int column, int) {
    return glm::vec3(column == 5 ? std::numeric_limits<float>::quiet_NaN() : 1.0f);
  });
  EXPECT_THAT(ReadProbeImage(folder_ / "nan.exr").message(), HasSubstr("pixel (5, 0)"));
}

TEST_F(Probe, BringsInfiniteTexelsToTheLargestHalf) {
  WriteExr(folder_ / "inf.exr", 32, 16, [](int column, int row) {
    return glm::vec3(column == 5 && row == 3 ? std::numeric_limits<float>::infinity() : 1.0f);
  });
  const auto image = ReadProbeImage(folder_ / "inf.exr");
  ASSERT_TRUE(image.ok()) << image.message();
  EXPECT_EQ(image->pixels[3 * 32 + 5].g, 65504.0f);
  ASSERT_FALSE(image->warnings.empty());
  EXPECT_THAT(image->warnings[0], HasSubstr("infinite"));
}

TEST_F(Probe, SendsMirrorBallsAndPhotographsToTheirTools) {
  WriteExr(folder_ / "ball.exr", 48, 32, Lamp(3, 3));
  EXPECT_THAT(ReadProbeImage(folder_ / "ball.exr").message(), HasSubstr("probe ball"));
  const auto picture = ReadHdrPicture(folder_ / "ball.exr");
  ASSERT_TRUE(picture.ok()) << picture.message();
  EXPECT_EQ(picture->width, 48);
  EXPECT_THAT(ReadProbeImage(folder_ / "sky.JPG").message(), HasSubstr("probe merge"));
}

TEST_F(Probe, RefusesStronglyNegativeTexels) {
  WriteExr(folder_ / "negative.exr", 32, 16,
           [](int column, int row) { return glm::vec3(column == 5 && row == 3 ? -1.0f : 1.0f); });
  EXPECT_FALSE(ReadProbeImage(folder_ / "negative.exr").ok());
}

TEST_F(Probe, ClampsRingingAndSaysSo) {
  WriteExr(folder_ / "ringing.exr", 32, 16, [](int column, int row) {
    return column == 5 && row == 3 ? glm::vec3(-0.01f) : Lamp(1, 1)(column, row);
  });
  const auto image = ReadProbeImage(folder_ / "ringing.exr");
  ASSERT_TRUE(image.ok()) << image.message();
  EXPECT_EQ(image->pixels[3 * 32 + 5], glm::vec3(0.0f));
  ASSERT_EQ(image->warnings.size(), 1u);
  EXPECT_THAT(image->warnings[0], HasSubstr("1 slightly negative"));
}

TEST_F(Probe, WarnsOfLowDynamicRange) {
  WriteExr(folder_ / "flat.exr", 32, 16, [](int, int) { return glm::vec3(0.8f); });
  const auto image = ReadProbeImage(folder_ / "flat.exr");
  ASSERT_TRUE(image.ok());
  EXPECT_EQ(image->warnings.size(), 1u);
}

TEST_F(Probe, RefusesBlack) {
  WriteExr(folder_ / "black.exr", 32, 16, [](int, int) { return glm::vec3(0.0f); });
  EXPECT_FALSE(ReadProbeImage(folder_ / "black.exr").ok());
}

TEST_F(Probe, RefusesDamagedFilesWithoutCrashing) {
  WriteExr(folder_ / "whole.exr", 32, 16, Lamp(1, 1));
  const auto bytes = ReadBytes(folder_ / "whole.exr");
  ASSERT_TRUE(bytes.ok());
  for (size_t length = 0; length < bytes->size(); length += 37) {
    for (const char* name : {"cut.exr", "cut.hdr"}) {
      ASSERT_TRUE(WriteFileAtomically(folder_ / name, std::span(*bytes).first(length)).ok());
      EXPECT_FALSE(ReadProbeImage(folder_ / name).ok()) << name << " " << length;
    }
  }
  EXPECT_FALSE(ReadProbeImage(folder_ / "absent.exr").ok());
  EXPECT_FALSE(ReadProbeImage(folder_ / "photo.jpg").ok());
}

}  // namespace
}  // namespace lararium::bake
