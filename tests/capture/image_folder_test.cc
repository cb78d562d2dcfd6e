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

TEST(ImageFolder, LaysImagesOfAllSizesIntoTheMiddleOfOneFrame) {
  test::TemporaryFolder folder;
  WriteGrey(folder / "1.png", 10);
  WriteGrey(folder / "2.png", 20, {24, 32});
  WriteGrey(folder / "3.png", 30, {320, 240});
  WriteGrey(folder / "4.png", 40);
  WriteGrey(folder / "5.png", 50, {16, 12});
  const auto source = OpenImageFolder(folder.path());
  ASSERT_TRUE(source.ok()) << source.message();
  EXPECT_EQ(cv::Size((*source)->width(), (*source)->height()), cv::Size(32, 32));
  const std::vector<SourceCamera> cameras = (*source)->Cameras();
  ASSERT_EQ(cameras.size(), 4u);
  EXPECT_EQ((*source)->CameraOf(0), (*source)->CameraOf(3));
  const std::vector<cv::Rect> areas = {
      {0, 4, 32, 24}, {4, 0, 24, 32}, {0, 4, 32, 24}, {0, 4, 32, 24}, {8, 10, 16, 12}};
  const std::vector<cv::Size> sizes = {{32, 24}, {24, 32}, {320, 240}, {32, 24}, {16, 12}};
  for (int i = 0; i < 5; ++i) {
    const SourceCamera& camera = cameras[(*source)->CameraOf(i)];
    EXPECT_EQ(camera.area, areas[i]);
    EXPECT_EQ(camera.size, sizes[i]);
    const auto frame = (*source)->Next();
    ASSERT_TRUE(frame.ok() && frame->has_value());
    cv::Mat expected(32, 32, CV_8UC1, cv::Scalar(0));
    expected(areas[i]).setTo(10 * (i + 1));
    EXPECT_EQ(cv::norm((*frame)->grey, expected, cv::NORM_INF), 0.0);
  }
}

TEST(ImageFolder, CountsImagesOfOneSizeAsOfOneCamera) {
  test::TemporaryFolder folder;
  WriteGrey(folder / "1.png", 1);
  WriteGrey(folder / "2.png", 2);
  const auto source = OpenImageFolder(folder.path());
  ASSERT_TRUE(source.ok()) << source.message();
  ASSERT_EQ((*source)->Cameras().size(), 1u);
  EXPECT_EQ((*source)->Cameras()[0].area, cv::Rect(0, 0, 32, 24));
  EXPECT_FALSE((*source)->Cameras()[0].focal_px.has_value());
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
