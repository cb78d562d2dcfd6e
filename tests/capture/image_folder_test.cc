#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "shared/capture/frame_source.h"
#include "shared/core/file.h"
#include "tests/support/test_files.h"

namespace lararium::capture {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

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
  EXPECT_EQ(cameras[1].lens_of, 0u) << "a phone that was held upright";
  EXPECT_EQ(cameras[1].quarter_turns, 1);
  EXPECT_FALSE(cameras[2].lens_of.has_value());
  EXPECT_FALSE(cameras[3].lens_of.has_value());
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

TEST(ImageFolder, LeavesOutBrokenImagesAndNamesThem) {
  test::TemporaryFolder folder;
  ASSERT_TRUE(WriteFileAtomically(folder / "1.png", "not an image").ok());
  WriteGrey(folder / "2.png", 2);
  ASSERT_TRUE(WriteFileAtomically(folder / "3.png", "not an image").ok());
  const auto source = OpenImageFolder(folder.path());
  ASSERT_TRUE(source.ok()) << source.message();
  for (int round = 0; round < 2; ++round) {
    ASSERT_TRUE((*source)->Seek(0).ok());
    EXPECT_EQ((*source)->Next()->value().index, 1);
    EXPECT_FALSE((*source)->Next()->has_value());
    EXPECT_THAT((*source)->Notes(), ElementsAre(HasSubstr("1.png"), HasSubstr("3.png")));
  }
}

TEST(ImageFolder, TakesHiddenFilesForNoImages) {
  test::TemporaryFolder folder;
  WriteGrey(folder / "IMG_1.png", 1);
  WriteGrey(folder / "IMG_2.png", 2);
  for (const char* name : {"._IMG_1.png", "._IMG_2.png", ".DS_Store", "Thumbs.db"}) {
    ASSERT_TRUE(WriteFileAtomically(folder / name, "no image").ok());
  }
  const auto source = OpenImageFolder(folder.path());
  ASSERT_TRUE(source.ok()) << source.message();
  EXPECT_EQ((*source)->frame_count(), 2);
  EXPECT_EQ((*source)->FrameName(0), "IMG_1.png");
  EXPECT_THAT((*source)->Notes(), IsEmpty());
}

TEST(ImageFolder, SaysWhichPicturesItDoesNotRead) {
  test::TemporaryFolder folder;
  for (const char* name : {"1.CR2", "2.cr2", "3.NEF", "4.gif"}) {
    ASSERT_TRUE(WriteFileAtomically(folder / name, "picture").ok());
  }
  EXPECT_THAT(OpenImageFolder(folder.path()).message(),
              AllOf(HasSubstr("contains no images"), HasSubstr("3 camera raw files (.cr2, .nef)")));
  WriteGrey(folder / "5.png", 1);
  const auto source = OpenImageFolder(folder.path());
  ASSERT_TRUE(source.ok()) << source.message();
  EXPECT_THAT((*source)->Notes(), ElementsAre(HasSubstr("develop them"), HasSubstr(".gif")));
}

TEST(ImageFolder, ReadsSubfoldersWhereTheFolderItselfHoldsNoImages) {
  test::TemporaryFolder folder;
  for (const char* name : {"left", "right10", "right9", ".hidden"}) {
    std::filesystem::create_directory(folder / name);
    WriteGrey(folder / name / "1.png", 1);
  }
  const auto nested = OpenImageFolder(folder.path());
  ASSERT_TRUE(nested.ok()) << nested.message();
  ASSERT_EQ((*nested)->frame_count(), 3);
  EXPECT_EQ((*nested)->FrameName(0), "left/1.png");
  EXPECT_EQ((*nested)->FrameName(1), "right9/1.png");
  EXPECT_EQ((*nested)->FrameName(2), "right10/1.png");
  EXPECT_TRUE((*nested)->Next()->has_value());
  WriteGrey(folder / "top.png", 1);
  const auto flat = OpenImageFolder(folder.path());
  ASSERT_TRUE(flat.ok()) << flat.message();
  EXPECT_EQ((*flat)->frame_count(), 1);
  EXPECT_THAT((*flat)->Notes(), ElementsAre(HasSubstr("3 images in its subfolders")));
}

// Writes a JPEG, white in its upper left quarter, with an orientation in its EXIF data.
void WriteTurned(const std::filesystem::path& file, int orientation) {
  cv::Mat image(24, 32, CV_8UC3, cv::Scalar::all(0));
  image(cv::Rect(0, 0, 16, 12)).setTo(cv::Scalar::all(255));
  std::vector<uint8_t> jpeg;
  ASSERT_TRUE(cv::imencode(".jpg", image, jpeg));
  std::string exif("Exif\0\0MM\0*\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01\0?\0\0\0\0\0\0", 32);
  exif[exif.find('?')] = static_cast<char>(orientation);
  const std::string segment =
      std::string("\xff\xe1\0", 3) + static_cast<char>(exif.size() + 2) + exif;
  const std::string stored(jpeg.begin(), jpeg.end());
  ASSERT_TRUE(WriteFileAtomically(file, stored.substr(0, 2) + segment + stored.substr(2)).ok());
}

TEST(ImageFolder, TurnsPhotographsAsTheirExifDataSay) {
  test::TemporaryFolder folder;
  WriteTurned(folder / "1.jpg", 6);  // The camera was turned to the left.
  WriteTurned(folder / "2.jpg", 8);
  const auto source = OpenImageFolder(folder.path());
  ASSERT_TRUE(source.ok()) << source.message();
  const std::vector<SourceCamera> cameras = (*source)->Cameras();
  ASSERT_EQ(cameras.size(), 2u);
  EXPECT_EQ(cameras[0].size, cv::Size(24, 32));
  EXPECT_EQ(cameras[1].size, cv::Size(24, 32));
  EXPECT_EQ(cameras[1].lens_of, 0u);
  EXPECT_EQ(cameras[0].quarter_turns, 1);
  EXPECT_EQ(cameras[1].quarter_turns, 3);
  const geometry::Frame clockwise = (*source)->Next()->value();
  ASSERT_EQ(clockwise.grey.size(), cv::Size(24, 32));
  EXPECT_GT(clockwise.grey.at<uint8_t>(4, 20), 240) << "the upper right quarter is white";
  EXPECT_LT(clockwise.grey.at<uint8_t>(4, 4), 15);
  const geometry::Frame anticlockwise = (*source)->Next()->value();
  EXPECT_GT(anticlockwise.grey.at<uint8_t>(28, 4), 240) << "the lower left quarter is white";
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
