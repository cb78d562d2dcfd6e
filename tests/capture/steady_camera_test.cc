#include "shared/capture/steady_camera.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

namespace lararium::capture {
namespace {

// A simulated world whose time passes only during sleep() or while waiting for an image.
struct World {
  double now = 100.0;
  bool plugged = true;
  int width = 64;
  double clock = 0.0;  // camera's clock at opening
  int opened = 0;
  std::vector<std::string> changes;

  class Camera final : public FrameSource {
   public:
    explicit Camera(World& world) : world_(world), opened_at_(world.now), width_(world.width) {}
    Result<std::optional<geometry::Frame>> Next() override {
      if (!world_.plugged) {
        return Status::Error("camera 0", "gives no image", "check that it is connected");
      }
      world_.now += 1.0 / 30.0;
      geometry::Frame frame;
      frame.index = index_++;
      frame.capture_time = world_.clock + world_.now - opened_at_ - 0.004;  // taken earlier
      frame.bgr = cv::Mat(48, width_, CV_8UC3, cv::Scalar::all(200));
      frame.grey = cv::Mat(48, width_, CV_8UC1, cv::Scalar::all(200));
      return std::optional(frame);
    }
    Status Seek(int64_t) override { return Status(); }
    std::optional<int64_t> frame_count() const override { return std::nullopt; }
    int width() const override { return width_; }
    int height() const override { return 48; }
    double frames_per_second() const override { return 30.0; }
    bool live() const override { return true; }
    std::string FrameName(int64_t index) const override { return NumberedFrameName(index); }

   private:
    World& world_;
    double opened_at_;
    int width_;
    int64_t index_ = 0;
  };

  std::unique_ptr<FrameSource> Make() {
    return MakeSteady(std::make_unique<Camera>(*this),
                      {[this]() -> Result<std::unique_ptr<FrameSource>> {
                         ++opened;
                         if (!plugged) {
                           return Status::Error("camera 0", "cannot be opened");
                         }
                         return std::unique_ptr<FrameSource>(std::make_unique<Camera>(*this));
                       },
                       [this] { return now; }, [this](double seconds) { now += seconds; },
                       [this](bool connected, const std::string& why) {
                         changes.push_back(connected ? "back" : "away: " + why);
                       },
                       [this](bool steady, double leap) {
                         changes.push_back(steady ? "steady" : leap > 0.0 ? "on" : "back");
                       }});
  }
};

bool IsBlack(const geometry::Frame& frame) { return cv::countNonZero(frame.grey) == 0; }

TEST(SteadyCamera, GivesTheCamerasFramesWhileItIsThere) {
  World world;
  const auto source = world.Make();
  double last = -1.0;
  for (int64_t i = 0; i < 100; ++i) {
    const geometry::Frame frame = **source->Next();
    EXPECT_EQ(frame.index, i);
    EXPECT_FALSE(IsBlack(frame));
    if (i > 0) {
      EXPECT_NEAR(frame.capture_time - last, 1.0 / 30.0, 1e-9);
    }
    last = frame.capture_time;
  }
  EXPECT_TRUE(world.changes.empty());
}

TEST(SteadyCamera, IsBlackWhileUnpluggedAndComesBackWithinARetry) {
  World world;
  const auto source = world.Make();
  int64_t index = 0;
  double last = -1.0;
  const auto next = [&] {
    const auto frame = source->Next();
    EXPECT_TRUE(frame.ok() && frame->has_value());
    EXPECT_EQ((*frame)->index, index++);
    EXPECT_GT((*frame)->capture_time, last);
    last = (*frame)->capture_time;
    return **frame;
  };
  for (int cycle = 0; cycle < 5; ++cycle) {
    for (int i = 0; i < 30; ++i) {
      next();
    }
    EXPECT_FALSE(IsBlack(next()));
    world.plugged = false;
    const int opened = world.opened;
    for (double until = world.now + 10.0; world.now < until;) {
      const geometry::Frame frame = next();
      EXPECT_TRUE(IsBlack(frame));
      EXPECT_EQ(frame.bgr.size(), cv::Size(64, 48));
    }
    EXPECT_LE(world.opened - opened, 21) << "asked twice a second";
    world.clock += 1000.0;  // The camera's clock restarts at each opening.
    world.plugged = true;
    const double back = world.now;
    while (IsBlack(next())) {
    }
    EXPECT_LT(world.now - back, 0.7);
  }
  EXPECT_EQ(world.changes.size(), 10u);
  EXPECT_EQ(world.changes[0], "away: camera 0: gives no image; check that it is connected");
  EXPECT_EQ(world.changes[1], "back");
}

TEST(SteadyCamera, ACameraOfAnotherSizeIsNotTaken) {
  World world;
  const auto source = world.Make();
  (void)source->Next();
  world.plugged = false;
  (void)source->Next();
  world.plugged = true;
  world.width = 32;
  for (int i = 0; i < 50; ++i) {
    const auto frame = source->Next();
    EXPECT_EQ((*frame)->bgr.cols, 64);
    EXPECT_TRUE(IsBlack(**frame));
  }
  ASSERT_EQ(world.changes.size(), 2u) << "it is told once why there is no picture";
  EXPECT_EQ(world.changes[1],
            "away: the camera came back with 32x48 pixels instead of 64x48; restore its former "
            "mode, or restart the program");
  world.width = 64;
  for (int i = 0; i < 10; ++i) {
    (void)source->Next();
  }
  EXPECT_FALSE(IsBlack(**source->Next()));
}

TEST(SteadyCamera, ALeapOfTheCamerasClockIsNotPassedOn) {
  World world;
  const auto source = world.Make();
  double last = (*source->Next())->capture_time;
  for (const double leap : {0.0, 500.0, -3.0, 0.0, 1e6, 0.0}) {
    world.clock = leap;
    for (int i = 0; i < 5; ++i) {
      const double time = (*source->Next())->capture_time;
      EXPECT_GT(time, last);
      EXPECT_LT(time - last, 0.1);
      last = time;
    }
  }
}

TEST(SteadyCamera, AClockThatLeapsAllTheTimeIsToldOnceAndWhenItIsSteady) {
  World world;
  const auto source = world.Make();
  (void)source->Next();
  for (int i = 0; i < 300; ++i) {
    world.clock = i % 2 == 0 ? 700.0 : 0.0;
    (void)source->Next();
  }
  EXPECT_EQ(world.changes, std::vector<std::string>({"on"}));
  for (int i = 0; i < 300; ++i) {
    (void)source->Next();
  }
  EXPECT_EQ(world.changes, std::vector<std::string>({"on", "steady"}));
}

}  // namespace
}  // namespace lararium::capture
