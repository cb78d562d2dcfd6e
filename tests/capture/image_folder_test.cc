#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "shared/capture/frame_source.h"
#include "shared/core/file.h"
#include "tests/support/test_files.h"

namespace lararium::capture {
namespace {

using ::testing::HasSubstr;

void WriteGrey(const std::filesystem::path& file, int grey, cv::Size size = {32, 24}) {
  ASSERT_TRUE(cv::imwrite(file.string(), cv::Mat(size, CV_8UC3, cv::Scalar::all(grey))));
}

TEST(ImageFolder, OrdersNumbersByTheirValue) {
  test::TemporaryFolder folder;
  const std::vector<std::string> names = {"a2.png",     "frame2.png",  "frame03.png",
                                          "frame9.png", "frame10.png", "frame100.png"};
  for (size_t i = names.size(); i-- > 0;) {
    WriteGrey(folder / names[i], static_cast<int>(10 * i));
  }
  ASSERT_TRUE(WriteFileAtomically(folder / "notes.txt", "not an image").ok());
  const auto source = OpenImageFolder(folder.path());
  ASSERT_TRUE(source.ok()) << source.message();
  EXPECT_EQ((*source)->frame_count(), static_cast<int64_t>(names.size()));
  for (size_t i = 0; i < names.size(); ++i) {
    EXPECT_EQ((*source)->FrameName(static_cast<int64_t>(i)), names[i]);
    const auto frame = (*source)->Next();
    ASSERT_TRUE(frame.ok() && frame->has_value());
    EXPECT_EQ((*frame)->bgr.at<cv::Vec3b>(0, 0)[0], 10 * i);
    EXPECT_EQ((*frame)->grey.at<uint8_t>(0, 0), 10 * i);
  }
  EXPECT_FALSE((*source)->Next()->has_value());
  ASSERT_TRUE((*source)->Seek(4).ok());
  EXPECT_EQ((*source)->Next()->value().index, 4);
  EXPECT_FALSE((*source)->Seek(6).ok());
}

TEST(ImageFolder, NamesTheImageOfAnotherSizeAndGoesOn) {
  test::TemporaryFolder folder;
  WriteGrey(folder / "1.png", 1);
  WriteGrey(folder / "2.png", 2, {40, 24});
  WriteGrey(folder / "3.png", 3);
  const auto source = OpenImageFolder(folder.path());
  ASSERT_TRUE(source.ok()) << source.message();
  ASSERT_TRUE((*source)->Next().ok());
  EXPECT_THAT((*source)->Next().message(), HasSubstr("2.png: is 40x24"));
  EXPECT_EQ((*source)->Next()->value().index, 2);
}

TEST(ImageFolder, NamesTheImageThatIsBroken) {
  test::TemporaryFolder folder;
  WriteGrey(folder / "1.png", 1);
  ASSERT_TRUE(WriteFileAtomically(folder / "2.png", "not an image").ok());
  const auto source = OpenImageFolder(folder.path());
  ASSERT_TRUE(source.ok()) << source.message();
  ASSERT_TRUE((*source)->Next().ok());
  EXPECT_THAT((*source)->Next().message(), HasSubstr("2.png"));
}

TEST(ImageFolder, RefusesFoldersWithoutImages) {
  test::TemporaryFolder folder;
  EXPECT_THAT(OpenImageFolder(folder.path()).message(), HasSubstr("contains no images"));
  EXPECT_THAT(OpenImageFolder(folder / "absent").message(), HasSubstr("absent"));
}

TEST(OpenCamera, SaysWhichCameraIsMissing) {
  EXPECT_THAT(OpenCamera(-1).message(), HasSubstr("camera -1"));
  EXPECT_THAT(OpenCamera(987).message(), HasSubstr("camera 987"));
}

}  // namespace
}  // namespace lararium::capture
