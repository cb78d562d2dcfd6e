// The camera view with a live camera, simulated by a fake driver.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <opencv2/core.hpp>
#include <thread>

#include "editor/session/live_camera.h"
#include "editor/session/preview.h"
#include "shared/capture/camera_source.h"
#include "tests/capture/fake_camera.h"
#include "tests/support/synthetic_world.h"

namespace lararium::editor {
namespace {

using capture::FakeCamera;
using capture::FrameSource;
using testing::HasSubstr;
using Picture = std::shared_ptr<const PreviewPicture>;

class LivePreviewTest : public testing::Test {
 protected:
  static show::ShowContent Content() {
    show::ShowContent content;
    auto map = std::make_shared<const vision::SceneDatabase>(
        test::MakeSceneDatabase(test::MakeSyntheticWorld({})));
    content.places = {{stage::Place(), std::move(map)}};
    content.drama_file = "drama.lua";
    content.drama = "function main() end";
    return content;
  }

  // Creates a new driver each time that the camera is plugged in.
  Result<std::unique_ptr<FrameSource>> OpenDriver() {
    if (gone_) {
      return Status::Error("camera 3", "is not there");
    }
    FakeCamera& camera = *cameras_.emplace_back(std::make_unique<FakeCamera>());
    camera.when_waited = [this, &camera] {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      camera.unplugged = gone_;
      FakeCamera::Sent sent;
      for (uint32_t i = 0; i < camera.format.sizeimage / 2; ++i) {
        sent.bytes.push_back(luma_);
        sent.bytes.push_back(128);
      }
      return sent;
    };
    return capture::OpenCamera("camera 3", camera.Open(), {});
  }

  void Start() {
    preview_ = std::make_unique<Preview>(
        [this] { return OpenSteadily([this] { return OpenDriver(); }, presence_); }, Content(),
        *log_);
  }

  // The first picture that satisfies wanted, within a few seconds.
  template <typename Wanted>
  Picture WaitFor(const Wanted& wanted) {
    for (int tries = 0; tries < 2000 && !preview_->failed(); ++tries) {
      if (auto picture = preview_->TakePicture(); picture && wanted(**picture)) {
        return *picture;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return nullptr;
  }
  static double Brightness(const PreviewPicture& picture) { return cv::mean(picture.grey)[0]; }

  std::atomic<bool> gone_ = false;
  std::atomic<uint8_t> luma_ = 200;
  std::vector<std::unique_ptr<FakeCamera>> cameras_;  // Used by the preview's thread.
  std::shared_ptr<CameraPresence> presence_ = std::make_shared<CameraPresence>(false);
  std::shared_ptr<Log> log_ = MakeSilentLog();
  std::unique_ptr<Preview> preview_;  // The last member, because its thread uses the others.
};

TEST_F(LivePreviewTest, DrawsEachImageThatComesAtTheMomentOfTheDramaThatWasAskedForLast) {
  Start();
  PreviewRequest request;
  request.time = 1.0;
  preview_->Request(request);
  const Picture first = WaitFor([](const auto&) { return true; });
  ASSERT_NE(first, nullptr);
  EXPECT_EQ(first->time, 1.0);
  EXPECT_TRUE(*presence_);
  EXPECT_TRUE(preview_->source()->live);
  EXPECT_EQ(preview_->source()->frames, 0);
  EXPECT_GT(Brightness(*first), 150.0);
  const Picture later = WaitFor([&](const auto& p) { return p.frame >= first->frame + 3; });
  ASSERT_NE(later, nullptr) << "it waits for requests";
  EXPECT_EQ(later->time, 1.0);
  luma_ = 90;
  EXPECT_NE(WaitFor([](const auto& p) { return Brightness(p) < 100.0; }), nullptr);
  request.time = 2.5;
  preview_->Request(request);
  EXPECT_NE(WaitFor([](const auto& p) { return p.time == 2.5; }), nullptr);
}

TEST_F(LivePreviewTest, ACameraThatIsUnpluggedIsBlackAndComesBack) {
  Start();
  preview_->Request({});
  ASSERT_NE(WaitFor([](const auto& p) { return Brightness(p) > 150.0; }), nullptr);
  gone_ = true;
  const Picture black = WaitFor([](const auto& p) { return Brightness(p) == 0.0; });
  ASSERT_NE(black, nullptr);
  EXPECT_FALSE(*presence_);
  EXPECT_FALSE(black->camera_from_map);
  gone_ = false;
  const Picture back = WaitFor([](const auto& p) { return Brightness(p) > 150.0; });
  ASSERT_NE(back, nullptr);
  EXPECT_TRUE(*presence_);
  EXPECT_GT(back->frame, black->frame);
  EXPECT_FALSE(preview_->failed());
  EXPECT_TRUE(preview_->TakeProblems().empty());
}

TEST_F(LivePreviewTest, OneThatIsNotThereAtFirstSaysSo) {
  gone_ = true;
  Start();
  preview_->Request({});
  EXPECT_EQ(WaitFor([](const auto&) { return true; }), nullptr);
  EXPECT_TRUE(preview_->failed());
  const std::vector<Status> problems = preview_->TakeProblems();
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_THAT(problems[0].message(), HasSubstr("is not there"));
}

// A camera that ends after three images.
class EndingCamera : public FrameSource {
 public:
  Result<std::optional<geometry::Frame>> Next() override {
    if (next_ == 3) {
      return std::optional<geometry::Frame>();
    }
    geometry::Frame frame;
    frame.index = next_++;
    frame.capture_time = static_cast<double>(frame.index) / 30.0;
    frame.bgr = cv::Mat(480, 640, CV_8UC3, cv::Scalar::all(120));
    frame.grey = cv::Mat(480, 640, CV_8UC1, cv::Scalar::all(120));
    return std::optional(std::move(frame));
  }
  Status Seek(int64_t) override { return Status::Error("camera", "cannot be sought"); }
  std::optional<int64_t> frame_count() const override { return std::nullopt; }
  int width() const override { return 640; }
  int height() const override { return 480; }
  double frames_per_second() const override { return 30.0; }
  bool live() const override { return true; }
  std::string FrameName(int64_t index) const override { return capture::NumberedFrameName(index); }

 private:
  int64_t next_ = 0;
};

TEST_F(LivePreviewTest, OneThatEndsSaysSoAndGivesNoMorePictures) {
  preview_ = std::make_unique<Preview>(
      [] { return Result<std::unique_ptr<FrameSource>>(std::make_unique<EndingCamera>()); },
      Content(), *log_);
  preview_->Request({});
  WaitFor([](const auto&) { return false; });
  EXPECT_TRUE(preview_->failed());
  const std::vector<Status> problems = preview_->TakeProblems();
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_THAT(problems[0].message(), HasSubstr("no more images"));
}

}  // namespace
}  // namespace lararium::editor
