#include "shared/image/picture_notes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "shared/core/file.h"
#include "tests/support/test_files.h"

namespace lararium::image {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string BigEndian(uint32_t number) {
  return {static_cast<char>(number >> 24), static_cast<char>(number >> 16),
          static_cast<char>(number >> 8), static_cast<char>(number)};
}

using Primaries = std::array<std::array<double, 3>, 3>;
constexpr Primaries kSrgb = {
    {{0.43607, 0.22249, 0.01392}, {0.38515, 0.71687, 0.09708}, {0.14307, 0.06061, 0.71410}}};
constexpr Primaries kDisplayP3 = {
    {{0.51512, 0.24120, -0.00105}, {0.29198, 0.69225, 0.04189}, {0.15710, 0.06657, 0.78407}}};

// A profile with a name, as version 4 of ICC's standard has it.
std::string Profile(const std::string& name, const Primaries& primaries) {
  std::string utf16;
  for (const char c : name) {
    utf16 += std::string(1, '\0') + c;
  }
  const auto length = static_cast<uint32_t>(utf16.size());
  std::string data = "mluc" + BigEndian(0) + BigEndian(1) + BigEndian(12) + "enUS" +
                     BigEndian(length) + BigEndian(28) + utf16;
  constexpr uint32_t kBegin = 132 + 4 * 12;
  std::string tags = BigEndian(4) + "desc" + BigEndian(kBegin) + BigEndian(28 + length);
  for (size_t i = 0; i < 3; ++i) {
    tags += std::string(1, "rgb"[i]) + "XYZ" +
            BigEndian(kBegin + static_cast<uint32_t>(data.size())) + BigEndian(20);
    data += "XYZ " + BigEndian(0);
    for (const double value : primaries[i]) {
      data += BigEndian(static_cast<uint32_t>(std::lround(value * 65536.0)));
    }
  }
  std::string header(128, '\0');
  header.replace(0, 4, BigEndian(kBegin + static_cast<uint32_t>(data.size())));
  header.replace(8, 4, BigEndian(0x04000000));
  header.replace(12, 12, "mntrRGB XYZ ");
  header.replace(36, 4, "acsp");
  header.replace(68, 12, BigEndian(63190) + BigEndian(65536) + BigEndian(54061));  // D50
  return header + tags + data;
}

std::string Encoded(const std::string& extension) {
  std::vector<uint8_t> bytes;
  CHECK(cv::imencode(extension, cv::Mat(8, 8, CV_8UC3, cv::Scalar(10, 20, 30)), bytes));
  return {bytes.begin(), bytes.end()};
}

// A JPEG with a profile in an APP2 segment.
std::string Jpeg(const std::string& profile) {
  const std::string plain = Encoded(".jpg");
  const std::string content = std::string("ICC_PROFILE\0\1\1", 14) + profile;
  const auto size = static_cast<uint32_t>(content.size() + 2);
  return plain.substr(0, 2) + "\xff\xe2" + BigEndian(size).substr(2) + content + plain.substr(2);
}

// Puts a chunk behind the header of a PNG.
std::string WithChunk(std::string png, const std::string& content) {
  const uLong checksum =
      crc32(0, reinterpret_cast<const Bytef*>(content.data()), static_cast<uInt>(content.size()));
  constexpr size_t kHeader = 33;
  return png.insert(kHeader, BigEndian(static_cast<uint32_t>(content.size() - 4)) + content +
                                 BigEndian(static_cast<uint32_t>(checksum)));
}

// A PNG with a profile in a chunk after its header.
std::string Png(const std::string& profile) {
  std::string deflated(compressBound(profile.size()), '\0');
  uLongf size = deflated.size();
  CHECK(compress(reinterpret_cast<Bytef*>(deflated.data()), &size,
                 reinterpret_cast<const Bytef*>(profile.data()), profile.size()) == Z_OK);
  return WithChunk(Encoded(".png"), "iCCP" + std::string("name\0\0", 6) + deflated.substr(0, size));
}

// A PNG whose colour space is given by numbers of ITU-T H.273.
std::string CodedPng(int primaries, int transfer) {
  return WithChunk(Encoded(".png"), std::string("cICP") + static_cast<char>(primaries) +
                                        static_cast<char>(transfer) + std::string("\0\1", 2));
}

std::vector<std::string> NotesOf(const std::string& encoded) {
  return PictureNotes(std::as_bytes(std::span(encoded)));
}

TEST(PictureNotes, AreEmptyForOrdinaryPictures) {
  for (const char* extension : {".jpg", ".png", ".tif", ".bmp", ".webp"}) {
    EXPECT_THAT(NotesOf(Encoded(extension)), IsEmpty()) << extension;
  }
  EXPECT_THAT(NotesOf(Jpeg(Profile("sRGB of another maker", kSrgb))), IsEmpty());
  EXPECT_THAT(NotesOf(""), IsEmpty());
}

TEST(PictureNotes, NameAProfileOfOtherPrimaries) {
  EXPECT_THAT(NotesOf(Jpeg(Profile("Display P3", kDisplayP3))),
              ElementsAre(HasSubstr("in the colours of \"Display P3\"")));
  EXPECT_THAT(NotesOf(Png(Profile("Wide", kDisplayP3))), ElementsAre(HasSubstr("\"Wide\"")));
  EXPECT_THAT(NotesOf(Png(Profile("sRGB", kSrgb))), IsEmpty());
}

TEST(PictureNotes, NameTheNumberedColourSpaceOfAPng) {
  const auto colours = [](const std::string& name) {
    return ElementsAre(HasSubstr("in the colours of \"" + name + "\", which"));
  };
  EXPECT_THAT(NotesOf(CodedPng(9, 16)), colours("BT.2020 PQ"));
  EXPECT_THAT(NotesOf(CodedPng(9, 18)), colours("BT.2020 HLG"));
  EXPECT_THAT(NotesOf(CodedPng(12, 13)), colours("P3"));
  EXPECT_THAT(NotesOf(CodedPng(1, 8)), colours("linear"));
  EXPECT_THAT(NotesOf(CodedPng(4, 4)), colours("primaries 4 transfer 4"));
  EXPECT_THAT(NotesOf(CodedPng(1, 13)), IsEmpty());
  const std::string whole = CodedPng(9, 16);
  for (size_t size = 0; size < whole.size(); ++size) {
    NotesOf(whole.substr(0, size));
  }
}

TEST(PictureNotes, NameTheNumberedColourSpaceOfHeicAndAvif) {
  const auto notes = [](const std::string& box) {
    return NotesOf(BigEndian(20) + "ftypavif" + std::string(8, '\0') + BigEndian(19) + box);
  };
  EXPECT_THAT(notes(std::string("colrnclx\0\11\0\20\0\11\200", 15)),
              ElementsAre(HasSubstr("\"BT.2020 PQ\"")));
  EXPECT_THAT(notes(std::string("colrnclx\0\1\0\15\0\6\200", 15)), IsEmpty());
  EXPECT_THAT(notes("colrnclx"), IsEmpty());
}

TEST(PictureNotes, TakeTheNumbersOfAPngBeforeItsProfile) {
  const std::string wide = Png(Profile("Wide", kDisplayP3));
  EXPECT_THAT(NotesOf(WithChunk(wide, std::string("cICP\1\15\0\1", 8))), IsEmpty());
  EXPECT_THAT(NotesOf(WithChunk(wide, std::string("cICP\11\20\0\1", 8))),
              ElementsAre(HasSubstr("\"BT.2020 PQ\"")));
}

TEST(PictureNotes, AreTakenOfAProfileThatIsCutShort) {
  const std::string whole = Profile("Display P3", kDisplayP3);
  for (size_t size = 0; size < whole.size(); size += 7) {
    NotesOf(Jpeg(whole.substr(0, size)));
  }
}

TEST(PictureNotes, CountThePagesOfATiff) {
  const std::vector<cv::Mat> pages(3, cv::Mat(8, 8, CV_8UC1, cv::Scalar(90)));
  const test::TemporaryFolder folder;
  ASSERT_TRUE(cv::imwritemulti((folder / "scan.tif").string(), pages));
  EXPECT_THAT(NotesOf(*ReadText(folder / "scan.tif")), ElementsAre(HasSubstr("has 3 pages")));
}

}  // namespace
}  // namespace lararium::image
