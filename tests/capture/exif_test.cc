#include "shared/capture/exif.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <span>
#include <string>

#include "shared/capture/frame_source.h"
#include "shared/core/file.h"
#include "shared/core/random.h"
#include "tests/support/test_files.h"

namespace lararium::capture {
namespace {

std::string Number(uint32_t value, int bytes, bool little_endian) {
  std::string text;
  for (int i = 0; i < bytes; ++i) {
    const int shift = 8 * (little_endian ? i : bytes - 1 - i);
    text.push_back(static_cast<char>(value >> shift & 0xff));
  }
  return text;
}

// The beginning of a JPEG with a focal length of `focal` mm (35 mm film) in its EXIF data.
std::string JpegWithFocal(uint32_t focal, bool little_endian) {
  const auto number = [&](uint32_t value, int bytes) {
    return Number(value, bytes, little_endian);
  };
  std::string tiff = little_endian ? "II" : "MM";
  tiff += number(42, 2) + number(8, 4);
  tiff += number(1, 2) + number(0x8769, 2) + number(4, 2) + number(1, 4) + number(26, 4);
  tiff += number(0, 4);
  tiff += number(2, 2) + number(0x9000, 2) + number(7, 2) + number(4, 4) + "0230";
  tiff += number(0xa405, 2) + number(3, 2) + number(1, 4) + number(focal, 2) + number(0, 2);
  tiff += number(0, 4);
  const std::string exif = std::string("Exif\0\0", 6) + tiff;
  const std::string comment = "a comment";
  return "\xff\xd8\xff\xfe" + Number(2 + comment.size(), 2, false) + comment + "\xff\xe1" +
         Number(2 + exif.size(), 2, false) + exif + "\xff\xda" + Number(2, 2, false);
}

std::optional<double> FocalOf(const std::string& content) {
  const auto film = FindFocalLengthIn35mmFilm(std::as_bytes(std::span(content)));
  return film ? std::optional(FocalPixels(*film, 4000, 3000)) : std::nullopt;
}

TEST(Exif, ReadsTheFocalLengthInBothByteOrders) {
  const double expected = 28.0 * 5000.0 / std::hypot(36.0, 24.0);
  for (const bool little_endian : {false, true}) {
    const auto focal = FocalOf(JpegWithFocal(28, little_endian));
    ASSERT_TRUE(focal.has_value());
    EXPECT_NEAR(*focal, expected, 1e-3);
  }
}

// The beginning of a JPEG with exposure time above / below, f/2.8 and ISO 400.
std::string JpegWithExposure(uint32_t above, uint32_t below, bool little_endian) {
  const auto number = [&](uint32_t value, int bytes) {
    return Number(value, bytes, little_endian);
  };
  std::string tiff = little_endian ? "II" : "MM";
  tiff += number(42, 2) + number(8, 4);
  tiff += number(1, 2) + number(0x8769, 2) + number(4, 2) + number(1, 4) + number(26, 4);
  tiff += number(0, 4);
  const uint32_t rationals = 26 + 2 + 3 * 12 + 4;
  tiff += number(3, 2) + number(0x829a, 2) + number(5, 2) + number(1, 4) + number(rationals, 4);
  tiff += number(0x829d, 2) + number(5, 2) + number(1, 4) + number(rationals + 8, 4);
  tiff += number(0x8827, 2) + number(3, 2) + number(1, 4) + number(400, 2) + number(0, 2);
  tiff += number(0, 4);
  tiff += number(above, 4) + number(below, 4) + number(28, 4) + number(10, 4);
  const std::string exif = std::string("Exif\0\0", 6) + tiff;
  return "\xff\xd8\xff\xe1" + Number(2 + exif.size(), 2, false) + exif + "\xff\xda" +
         Number(2, 2, false);
}

std::optional<double> ExposureOf(const std::string& content) {
  test::TemporaryFolder folder;
  EXPECT_TRUE(WriteFileAtomically(folder / "image.jpg", content).ok());
  return ExifExposure(folder / "image.jpg");
}

TEST(Exif, ReadsTheExposureInBothByteOrders) {
  for (const bool little_endian : {false, true}) {
    const auto exposure = ExposureOf(JpegWithExposure(1, 125, little_endian));
    ASSERT_TRUE(exposure.has_value());
    EXPECT_NEAR(*exposure, 4.0 / 125.0 / (2.8 * 2.8), 1e-9);
  }
  EXPECT_FALSE(ExposureOf(JpegWithExposure(1, 0, true)).has_value());
  EXPECT_FALSE(ExposureOf(JpegWithExposure(0, 1, true)).has_value());
  EXPECT_FALSE(ExposureOf(JpegWithFocal(28, true)).has_value());
}

TEST(Exif, DamagedExposuresDoNotCrash) {
  const std::string whole = JpegWithExposure(1, 125, true);
  Random random(4);
  for (int i = 0; i < 60; ++i) {
    std::string damaged = whole.substr(0, i % 2 == 0 ? whole.size() : random.Below(whole.size()));
    for (int k = 0; k < 3 && !damaged.empty(); ++k) {
      damaged[random.Below(damaged.size())] = static_cast<char>(random.Below(256));
    }
    const auto exposure = ExposureOf(damaged);
    EXPECT_TRUE(!exposure || (std::isfinite(*exposure) && *exposure > 0.0));
  }
}

TEST(Exif, FindsNothingWhereThereIsNothing) {
  EXPECT_FALSE(FocalOf("").has_value());
  EXPECT_FALSE(FocalOf("text").has_value());
  EXPECT_FALSE(FocalOf(JpegWithFocal(0, true)).has_value());
}

// The beginning of a JPEG by a camera "Lar" "ium 3", at a focal length of millimetres / 10.
std::string JpegByCamera(uint32_t millimetres, bool little_endian) {
  const auto number = [&](uint32_t value, int bytes) {
    return Number(value, bytes, little_endian);
  };
  std::string tiff = little_endian ? "II" : "MM";
  tiff += number(42, 2) + number(8, 4);
  tiff += number(3, 2);
  const uint32_t texts = 8 + 2 + 3 * 12 + 4;
  tiff += number(0x010f, 2) + number(2, 2) + number(4, 4) + std::string("Lar\0", 4);
  tiff += number(0x0110, 2) + number(2, 2) + number(6, 4) + number(texts, 4);
  tiff += number(0x8769, 2) + number(4, 2) + number(1, 4) + number(texts + 6, 4);
  tiff += number(0, 4) + std::string("ium 3\0", 6);
  tiff += number(1, 2) + number(0x920a, 2) + number(5, 2) + number(1, 4);
  tiff += number(texts + 6 + 2 + 12 + 4, 4) + number(0, 4);
  tiff += number(millimetres, 4) + number(10, 4);
  const std::string exif = std::string("Exif\0\0", 6) + tiff;
  return "\xff\xd8\xff\xe1" + Number(2 + exif.size(), 2, false) + exif + "\xff\xda" +
         Number(2, 2, false);
}

std::string CameraNameOf(const std::string& content) {
  return FindCameraName(std::as_bytes(std::span(content)));
}

TEST(Exif, TellsCamerasAndZoomsApart) {
  for (const bool little_endian : {false, true}) {
    const std::string name = CameraNameOf(JpegByCamera(43, little_endian));
    EXPECT_THAT(name, ::testing::StartsWith("Larium 3,4.3"));
    EXPECT_NE(name, CameraNameOf(JpegByCamera(62, little_endian)));
  }
  EXPECT_EQ(CameraNameOf("text"), "");
}

TEST(Exif, SurvivesCutsAndFlippedBytes) {
  const std::string by_camera = JpegByCamera(43, true);
  for (size_t size = 0; size < by_camera.size(); ++size) {
    CameraNameOf(by_camera.substr(0, size));
  }
  const std::string valid = JpegWithFocal(28, true);
  for (size_t size = 0; size + 6 < valid.size(); ++size) {
    FocalOf(valid.substr(0, size));
  }
  Random random(11);
  for (int i = 0; i < 60; ++i) {
    std::string broken = valid;
    broken[random.Below(static_cast<uint32_t>(broken.size()))] =
        static_cast<char>(random.Below(256));
    FocalOf(broken);
  }
}

}  // namespace
}  // namespace lararium::capture
