#include "shared/capture/camera_source.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <set>
#include <thread>

#include "tests/capture/fake_camera.h"

namespace lararium::capture {
namespace {

using geometry::Frame;
using ::testing::AllOf;
using ::testing::HasSubstr;
using Sent = FakeCamera::Sent;

Result<std::unique_ptr<FrameSource>> Open(FakeCamera& camera, const CameraSettings& settings = {}) {
  return OpenCamera("camera 3", camera.Open(), settings);
}

// A YUYV image of the camera's size and of one brightness: 16 is black, 235 white.
Sent Grey(const FakeCamera& camera, int luma) {
  Sent sent;
  for (uint32_t i = 0; i < camera.format.sizeimage / 2; ++i) {
    sent.bytes.push_back(static_cast<uint8_t>(luma));
    sent.bytes.push_back(128);
  }
  return sent;
}

// A smooth picture, which JPEG preserves.
cv::Mat Picture(int width, int height) {
  cv::Mat picture(height, width, CV_8UC3);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      picture.at<cv::Vec3b>(y, x) = cv::Vec3b(static_cast<uint8_t>(255 * x / width),
                                              static_cast<uint8_t>(255 * y / height), 90);
    }
  }
  return picture;
}

std::vector<uint8_t> Jpeg(const cv::Mat& picture) {
  std::vector<uint8_t> jpeg;
  EXPECT_TRUE(cv::imencode(".jpg", picture, jpeg));
  return jpeg;
}

// Most cameras omit the tables, because they are standard.
std::vector<uint8_t> WithoutHuffmanTables(std::vector<uint8_t> jpeg) {
  for (size_t i = 2; i + 4 <= jpeg.size() && jpeg[i + 1] != 0xda;) {
    const size_t length = 2 + jpeg[i + 2] * size_t{256} + jpeg[i + 3];
    const auto segment = jpeg.begin() + static_cast<ptrdiff_t>(i);
    if (jpeg[i + 1] == 0xc4) {
      jpeg.erase(segment, segment + static_cast<ptrdiff_t>(length));
    } else {
      i += length;
    }
  }
  return jpeg;
}

FakeCamera MotionJpegCamera() {
  FakeCamera camera;
  camera.modes = {{V4L2_PIX_FMT_MJPEG, {{640, 480}}}};
  return camera;
}

int Brightness(const Frame& frame) { return frame.grey.at<uint8_t>(100, 100); }

Frame NextOf(FrameSource& source) {
  const auto frame = source.Next();
  EXPECT_TRUE(frame.ok()) << frame.message();
  return frame.ok() && *frame ? **frame : Frame();
}

TEST(CameraSource, GivesTheNewestOfSeveralWaitingFrames) {
  FakeCamera camera;
  const auto source = Open(camera);
  ASSERT_TRUE(source.ok()) << source.message();
  for (const int luma : {50, 100, 200}) {
    camera.Send(Grey(camera, luma));
  }
  const Frame frame = NextOf(**source);
  EXPECT_EQ(frame.index, 0);
  EXPECT_NEAR(Brightness(frame), (200 - 16) * 255 / 219, 1);
  EXPECT_EQ(camera.queued.size(), camera.buffers.size()) << "the driver has all buffers again";
}

// If the driver had no free buffer for a while, its images are from before the pause.
TEST(CameraSource, GivesNoImageFromBeforeAPause) {
  FakeCamera camera;
  const auto source = Open(camera);
  ASSERT_TRUE(source.ok()) << source.message();
  for (int i = 0; i < 10; ++i) {
    camera.Send(Grey(camera, 16));
  }
  EXPECT_GT(camera.lost, 0u);
  camera.coming = {Grey(camera, 235)};
  EXPECT_EQ(Brightness(NextOf(**source)), 255);
}

// BT.601 with limited range; lines may have padding.
TEST(CameraSource, KeepsColoursOfYuyvUyvyAndNv12) {
  const uint8_t red[] = {82, 90, 240};  // luma, Cb, Cr
  const std::map<uint32_t, std::array<int, 4>> orders = {{V4L2_PIX_FMT_YUYV, {0, 1, 0, 2}},
                                                         {V4L2_PIX_FMT_YVYU, {0, 2, 0, 1}},
                                                         {V4L2_PIX_FMT_UYVY, {1, 0, 2, 0}},
                                                         {V4L2_PIX_FMT_NV12, {1, 2, 1, 2}}};
  for (const auto& [format, order] : orders) {
    for (const uint32_t padding : {0u, 64u}) {
      FakeCamera camera;
      camera.modes = {{format, {{320, 240}}}};
      camera.padding = padding;
      const auto source = Open(camera);
      ASSERT_TRUE(source.ok()) << source.message();
      Sent sent;
      sent.bytes.resize(camera.format.sizeimage);
      for (size_t i = 0; i < sent.bytes.size(); ++i) {
        const bool luma = format == V4L2_PIX_FMT_NV12 && i < camera.format.bytesperline * 240;
        sent.bytes[i] = luma ? red[0] : red[order[i % 4]];
      }
      camera.coming = {sent};
      const Frame frame = NextOf(**source);
      ASSERT_EQ(frame.bgr.size(), cv::Size(320, 240));
      const cv::Mat expected(240, 320, CV_8UC3, cv::Scalar(0, 0, 255));
      EXPECT_LE(cv::norm(frame.bgr, expected, cv::NORM_INF), 2.0) << format << " " << padding;
      EXPECT_NEAR(frame.grey.at<uint8_t>(0, 0), 76, 1);
    }
  }
}

TEST(CameraSource, KeepsColoursOfSensorsMosaics) {
  FakeCamera camera;
  camera.modes = {{V4L2_PIX_FMT_SGRBG8, {{320, 240}}}};
  const auto source = Open(camera);
  ASSERT_TRUE(source.ok()) << source.message();
  Sent sent;
  for (int i = 0; i < 320 * 240; ++i) {
    const bool even_line = i / 320 % 2 == 0;
    sent.bytes.push_back(i % 2 == (even_line ? 0 : 1) ? 120 : even_line ? 200 : 40);
  }
  camera.coming = {sent};
  EXPECT_EQ(NextOf(**source).bgr.at<cv::Vec3b>(100, 100), cv::Vec3b(40, 120, 200));
}

TEST(CameraSource, ReadsMotionJpegWithoutHuffmanTables) {
  FakeCamera camera = MotionJpegCamera();
  const auto source = Open(camera);
  ASSERT_TRUE(source.ok()) << source.message();
  const std::vector<uint8_t> whole = Jpeg(Picture(640, 480));
  std::vector<uint8_t> sent = WithoutHuffmanTables(whole);
  ASSERT_LT(sent.size(), whole.size());
  sent.resize(sent.size() + 100);  // Some cameras pad their buffers.
  camera.coming = {{sent}, {sent}};
  for (int i = 0; i < 2; ++i) {
    const Frame frame = NextOf(**source);
    EXPECT_LE(cv::norm(frame.bgr, cv::imdecode(whole, cv::IMREAD_COLOR), cv::NORM_INF), 1.0);
  }
}

TEST(CameraSource, SkipsDamagedFrames) {
  FakeCamera camera;
  const auto source = Open(camera);
  ASSERT_TRUE(source.ok()) << source.message();
  Sent damaged = Grey(camera, 16);
  damaged.flags |= V4L2_BUF_FLAG_ERROR;
  Sent cut_short = Grey(camera, 16);
  cut_short.bytes.resize(cut_short.bytes.size() / 2);
  camera.coming = {damaged, cut_short, {}, Grey(camera, 235)};
  const Frame frame = NextOf(**source);
  EXPECT_EQ(Brightness(frame), 255);
  EXPECT_EQ(frame.index, 0);
  // Damaged images do not hide the good one before them.
  camera.Send(Grey(camera, 235));
  camera.Send(damaged);
  EXPECT_EQ(Brightness(NextOf(**source)), 255);
  EXPECT_EQ(camera.queued.size(), camera.buffers.size());
}

// libjpeg would fill the missing part with grey.
TEST(CameraSource, SkipsJpegsThatWereCutShort) {
  FakeCamera camera = MotionJpegCamera();
  const auto source = Open(camera);
  ASSERT_TRUE(source.ok()) << source.message();
  const std::vector<uint8_t> whole = Jpeg(Picture(640, 480));
  std::vector<uint8_t> half = whole;
  half.resize(whole.size() / 2);
  std::vector<uint8_t> head = whole;
  head.resize(50);
  std::vector<uint8_t> noise(5000, 0x55);
  camera.coming = {{whole}, {half}, {head}, {noise}, {whole}};
  const Frame first = NextOf(**source);
  const Frame second = NextOf(**source);
  EXPECT_TRUE(camera.coming.empty());
  EXPECT_EQ(second.index, 1);
  EXPECT_EQ(cv::norm(first.bgr, second.bgr, cv::NORM_INF), 0.0);
}

TEST(CameraSource, ReadsJpegsOfCamerasThatNeverMarkTheirEnd) {
  FakeCamera camera = MotionJpegCamera();
  const auto source = Open(camera);
  ASSERT_TRUE(source.ok()) << source.message();
  const cv::Mat picture = Picture(640, 480);
  std::vector<uint8_t> sent = Jpeg(picture);
  sent.resize(sent.size() - 2);
  camera.coming = {{sent}, {sent}};
  EXPECT_LE(cv::norm(NextOf(**source).bgr, picture, cv::NORM_INF), 20.0);
  EXPECT_EQ(NextOf(**source).index, 1);
}

TEST(CameraSource, GivesUpWhereNoImageCanBeRead) {
  FakeCamera camera = MotionJpegCamera();
  const auto source = Open(camera);
  ASSERT_TRUE(source.ok()) << source.message();
  int sent = 0;
  camera.when_waited = [&] {
    ++sent;
    return Sent{Jpeg(Picture(320, 240))};  // The size differs from the announced one.
  };
  EXPECT_THAT((*source)->Next().message(),
              AllOf(HasSubstr("camera 3: gives no image"), HasSubstr("640x480")));
  EXPECT_LE(sent, 100);
  camera.when_waited = nullptr;
  camera.coming = {{Jpeg(Picture(640, 480))}, {Jpeg(Picture(640, 480))}};
  EXPECT_EQ(NextOf(**source).index, 0) << "it may be asked again";
}

TEST(CameraSource, SaysThatItWasUnplugged) {
  FakeCamera camera;
  auto source = Open(camera);
  ASSERT_TRUE(source.ok()) << source.message();
  camera.coming = {Grey(camera, 100)};
  NextOf(**source);
  camera.unplugged = true;
  const std::string message = (*source)->Next().message();
  EXPECT_EQ(message, "camera 3: gives no image; check that it is connected");
  source->reset();
  EXPECT_EQ(camera.mapped, 0u);
}

TEST(CameraSource, SaysThatNoImageComes) {
  FakeCamera camera;
  const auto source = Open(camera);
  ASSERT_TRUE(source.ok()) << source.message();
  EXPECT_EQ((*source)->Next().message(), "camera 3: gives no image; check that it is connected");
  camera.coming = {Grey(camera, 100)};
  EXPECT_EQ(NextOf(**source).index, 0) << "it may be asked again";
}

TEST(CameraSource, GoesOnWhenASignalComes) {
  FakeCamera camera;
  camera.interruptions = 3;
  const auto source = Open(camera);
  ASSERT_TRUE(source.ok()) << source.message();
  camera.coming = {Grey(camera, 235)};
  camera.interruptions = 3;
  EXPECT_EQ(Brightness(NextOf(**source)), 255);
}

TEST(CameraSource, RefusesASizeThatTheCameraLacks) {
  for (const char* driver : {"fake", "uvcvideo"}) {
    FakeCamera camera;
    camera.driver = driver;
    camera.modes[0].sizes = {{320, 240}, {640, 480}};
    EXPECT_THAT(Open(camera, {.width = 800, .height = 600}).message(),
                AllOf(HasSubstr("camera 3: does not offer images of 800x600"), HasSubstr("640x480"),
                      HasSubstr("change the device file's \"capture\"")));
    const auto source = Open(camera, {.width = 320, .height = 240});
    ASSERT_TRUE(source.ok()) << source.message();
    EXPECT_EQ((*source)->width(), 320);
    EXPECT_EQ((*source)->height(), 240);
  }
}

// libv4lconvert would crop this image, but the calibration is for the whole image.
TEST(CameraSource, KeepsSizesThatAreNoMultipleOfEight) {
  FakeCamera camera;
  camera.modes[0].sizes = {{1366, 769}};
  const auto source = Open(camera, {.width = 1366, .height = 769});
  ASSERT_TRUE(source.ok()) << source.message();
  camera.coming = {Grey(camera, 16)};
  EXPECT_EQ(NextOf(**source).bgr.size(), cv::Size(1366, 769));
}

TEST(CameraSource, TakesTheFormatThatItIsTold) {
  FakeCamera camera;
  camera.modes = {{V4L2_PIX_FMT_YUYV, {{640, 480}}}, {V4L2_PIX_FMT_MJPEG, {{640, 480}}}};
  ASSERT_TRUE(Open(camera, {.format = "MJPG"}).ok());
  EXPECT_EQ(camera.format.pixelformat, V4L2_PIX_FMT_MJPEG);
  ASSERT_TRUE(Open(camera, {.format = "YUYV"}).ok());
  EXPECT_EQ(camera.format.pixelformat, V4L2_PIX_FMT_YUYV);
  EXPECT_THAT(Open(camera, {.format = "NV12"}).message(),
              AllOf(HasSubstr("does not offer the image format NV12"), HasSubstr("\"capture\"")));
}

TEST(CameraSource, TakesTheFormatThatHasTheSize) {
  for (const char* driver : {"fake", "uvcvideo"}) {
    FakeCamera camera;
    camera.driver = driver;
    camera.modes = {{V4L2_PIX_FMT_MJPEG, {{640, 480}, {1280, 720}}},
                    {V4L2_PIX_FMT_YUYV, {{640, 480}}},
                    {V4L2_PIX_FMT_H264, {{640, 480}, {1920, 1080}}}};
    ASSERT_TRUE(Open(camera).ok());
    EXPECT_EQ(camera.format.pixelformat, V4L2_PIX_FMT_YUYV) << "costs least";
    ASSERT_TRUE(Open(camera, {.width = 1280, .height = 720}).ok());
    EXPECT_EQ(camera.format.pixelformat, V4L2_PIX_FMT_MJPEG);
    EXPECT_FALSE(Open(camera, {.width = 1920, .height = 1080}).ok());
  }
}

TEST(CameraSource, RefusesFormatsThatNobodyKnows) {
  FakeCamera camera;
  camera.modes = {{V4L2_PIX_FMT_H264, {{640, 480}}}};
  EXPECT_THAT(Open(camera).message(), HasSubstr("offers no known image format"));
}

TEST(CameraSource, TakesTheRateThatTheDriverGrants) {
  FakeCamera camera;
  camera.rates = {15, 30, 60};
  const auto rate = [&](double wanted) {
    const auto source = Open(camera, {.frames_per_second = wanted});
    EXPECT_TRUE(source.ok()) << source.message();
    return (*source)->frames_per_second();
  };
  EXPECT_EQ(rate(60.0), 60.0);
  EXPECT_EQ(rate(50.0), 60.0);
  EXPECT_EQ(rate(12.5), 15.0);
  EXPECT_EQ(rate(0.0), 30.0);
  camera.knows_rates = false;
  EXPECT_EQ(rate(60.0), 30.0);
}

TEST(CameraSource, SetsTheExposureByHand) {
  FakeCamera camera;
  camera.controls = {{V4L2_CID_EXPOSURE_AUTO, V4L2_EXPOSURE_APERTURE_PRIORITY},
                     {V4L2_CID_EXPOSURE_ABSOLUTE, 250}};
  ASSERT_TRUE(Open(camera).ok());
  EXPECT_EQ(camera.controls[V4L2_CID_EXPOSURE_AUTO], V4L2_EXPOSURE_APERTURE_PRIORITY);
  ASSERT_TRUE(Open(camera, {.exposure_ms = 8.0}).ok());
  EXPECT_EQ(camera.controls[V4L2_CID_EXPOSURE_AUTO], V4L2_EXPOSURE_MANUAL);
  EXPECT_EQ(camera.controls[V4L2_CID_EXPOSURE_ABSOLUTE], 80);
  camera.controls.erase(V4L2_CID_EXPOSURE_AUTO);
  ASSERT_TRUE(Open(camera, {.exposure_ms = 4.0}).ok()) << "never exposes by itself";
  EXPECT_EQ(camera.controls[V4L2_CID_EXPOSURE_ABSOLUTE], 40);
}

TEST(CameraSource, RefusesAnExposureThatTheCameraLacks) {
  FakeCamera camera;
  EXPECT_THAT(Open(camera, {.exposure_ms = 8.0}).message(),
              AllOf(HasSubstr("V4L2_CID_EXPOSURE_ABSOLUTE"), HasSubstr("remove \"exposure_ms\"")));
}

TEST(CameraSource, RefusesWhatIsNoCamera) {
  FakeCamera camera;
  camera.capabilities = V4L2_CAP_META_CAPTURE | V4L2_CAP_STREAMING;
  EXPECT_THAT(Open(camera).message(), HasSubstr("camera 3: cannot be opened"));
}

TEST(CameraSource, SaysThatAnotherProgramHasIt) {
  FakeCamera camera;
  camera.busy = true;
  EXPECT_THAT(Open(camera).message(), AllOf(HasSubstr("camera 3: cannot be opened"),
                                            HasSubstr("busy"), HasSubstr("not in use")));
}

TEST(CameraSource, LeavesNothingBehindWhicheverCallFails) {
  FakeCamera whole;
  int needed = 0;
  {
    const auto source = Open(whole);
    ASSERT_TRUE(source.ok()) << source.message();
    needed = whole.calls;
  }
  EXPECT_GT(needed, 15);
  for (int call = 0; call <= needed; ++call) {
    FakeCamera camera;
    camera.failing_call = call < needed ? call : -1;
    (void)Open(camera);
    EXPECT_EQ(camera.mapped, 0u) << call;
    EXPECT_FALSE(camera.streams) << call;
    EXPECT_EQ(camera.buffers.size(), 0u) << call;
  }
}

TEST(CameraSource, TellsWhenTheImageWasTaken) {
  const auto now = [] {
    const auto time = std::chrono::steady_clock::now().time_since_epoch();
    return std::chrono::duration<double>(time).count();
  };
  FakeCamera camera;
  const double before = now();
  const auto source = Open(camera);
  ASSERT_TRUE(source.ok()) << source.message();
  const double opened = now();
  std::this_thread::sleep_for(std::chrono::milliseconds(150));
  double last = 0.0;
  const auto time_of = [&](double age, uint32_t flags) {
    Sent sent = Grey(camera, 100);
    sent.age = age;
    sent.flags = flags;
    camera.coming = {sent};
    const double time = NextOf(**source).capture_time;
    EXPECT_GT(time, last);
    return last = time;
  };
  const double taken = time_of(0.1, V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC);
  EXPECT_LE(taken, now() - 0.1 - before);
  // Time stamps of other clocks, and wrong ones, are ignored.
  const double asked = now();
  EXPECT_GE(time_of(0.1, V4L2_BUF_FLAG_TIMESTAMP_UNKNOWN), asked - opened);
  EXPECT_GE(time_of(1000.0, V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC), asked - opened);
  const double erring = time_of(-1000.0, V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC);
  EXPECT_LE(erring, now() + 1.0 - before);
}

TEST(CameraSource, TakesNoMemoryAnewForEachFrame) {
  FakeCamera camera;
  const auto source = Open(camera);
  ASSERT_TRUE(source.ok()) << source.message();
  camera.when_waited = [&] { return Grey(camera, 100); };
  std::set<const uint8_t*> memory;
  for (int i = 0; i < 50; ++i) {
    const Frame frame = NextOf(**source);
    memory.insert({frame.bgr.data, frame.grey.data});
  }
  EXPECT_EQ(memory.size(), 2u);
}

TEST(CameraSource, CannotSeek) {
  FakeCamera camera;
  const auto source = Open(camera);
  ASSERT_TRUE(source.ok()) << source.message();
  EXPECT_TRUE((*source)->live());
  EXPECT_FALSE((*source)->Seek(0).ok());
  EXPECT_EQ((*source)->frame_count(), std::nullopt);
}

}  // namespace
}  // namespace lararium::capture
