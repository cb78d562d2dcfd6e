#include "shared/show/quality_controller.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "shared/core/json.h"
#include "shared/core/random.h"

namespace lararium::show {
namespace {

// A device with a given cost of a frame at the finest level, and the true relative costs of coarser
// levels.
struct Device {
  std::vector<double> share = {1.0, 0.75, 0.5, 0.3, 0.18};
  double noise = 0.1;
  Random random{7};

  double Work(size_t level, double finest_ms) {
    return finest_ms * share[level] * (1.0 + noise * (2.0 * random.Uniform() - 1.0));
  }
};

// Draws for a number of seconds from `begin`; frames never come faster than the camera's.
double Play(QualityController& controller,
            Device& device,
            double begin,
            double seconds,
            const std::function<double(double)>& finest_ms) {
  double time = begin;
  while (time < begin + seconds) {
    const double work = device.Work(controller.level(), finest_ms(time));
    controller.AddFrame(time, work);
    time += std::max(work, 1000.0 / 30.0) / 1000.0;
  }
  return time;
}

TEST(QualityController, StaysAtTheFinestWhereItFits) {
  QualityController controller;
  Device device;
  Play(controller, device, 0.0, 60.0, [](double) { return 20.0; });
  EXPECT_EQ(controller.level(), 0u);
  EXPECT_EQ(controller.step_count(), 0);
}

TEST(QualityController, IsAtALevelThatFitsWithinTwoSeconds) {
  for (const double finest : {50.0, 80.0, 110.0, 180.0}) {
    QualityController controller;
    Device device;
    Play(controller, device, 0.0, 3.5, [&](double) { return finest; });
    EXPECT_LE(finest * device.share[controller.level()], 36.0) << finest;
  }
}

TEST(QualityController, ClimbsFromTheCoarsestWithoutDelayWhereAllFit) {
  QualityController controller({}, 4);
  Device device;
  Play(controller, device, 0.0, 6.0, [](double) { return 20.0; });
  EXPECT_EQ(controller.level(), 0u);
  EXPECT_EQ(controller.step_count(), 4);
}

TEST(QualityController, APauseIsNoTimeToSpare) {
  QualityController controller({}, 4);
  Device device;
  Play(controller, device, 0.0, 0.3, [](double) { return 20.0; });
  controller.AddFrame(10.0, 4.0);
  EXPECT_EQ(controller.level(), 4u);
  Play(controller, device, 10.1, 1.0, [](double) { return 20.0; });
  EXPECT_LT(controller.level(), 4u);
}

TEST(QualityController, StaysAtTheCoarsestWhereNothingElseFits) {
  QualityController controller({}, 4);
  Device device;
  Play(controller, device, 0.0, 60.0, [](double) { return 180.0; });
  EXPECT_EQ(controller.level(), 4u);
  EXPECT_EQ(controller.step_count(), 0);
}

TEST(QualityController, OneLongFrameChangesNothing) {
  QualityController controller;
  for (int i = 0; i < 300; ++i) {
    controller.AddFrame(i / 30.0, i % 100 == 50 ? 120.0 : 20.0);
  }
  EXPECT_EQ(controller.step_count(), 0);
}

TEST(QualityController, ComesBackWhenTheSceneIsLighter) {
  QualityController controller;
  Device device;
  const double time = Play(controller, device, 0.0, 10.0, [](double) { return 110.0; });
  EXPECT_GE(controller.level(), 3u);
  Play(controller, device, time, 60.0, [](double) { return 25.0; });
  EXPECT_EQ(controller.level(), 0u);
}

TEST(QualityController, DoesNotSwingWhereTheFinerLevelJustDoesNotFit) {
  // Priors that are too optimistic: the finer level is expected to fit and does not.
  for (const double finest : {45.0, 48.0, 60.0, 70.0, 100.0}) {
    QualityOptions options;
    options.expected_cost = {1.0, 0.95, 0.9, 0.85, 0.8};
    QualityController controller(options);
    Device device;
    Play(controller, device, 0.0, 600.0, [&](double) { return finest; });
    EXPECT_LE(controller.step_count(), 16) << finest << ": steps in ten minutes";
    EXPECT_LE(finest * device.share[controller.level()], 36.0) << finest;
  }
}

TEST(QualityController, ALoadThatSwingsSlowlyIsFollowed) {
  QualityController controller;
  Device device;
  Play(controller, device, 0.0, 600.0,
       [](double t) { return 50.0 + 30.0 * std::sin(t / 600.0 * 2.0 * M_PI * 3.0); });
  EXPECT_GE(controller.step_count(), 6);
  EXPECT_LE(controller.step_count(), 60);
}

TEST(QualityController, HeatHoldsItDownUntilItHasCooledClearly) {
  QualityController controller;
  Device device;
  const auto light = [](double) { return 10.0; };
  EXPECT_TRUE(controller.SetPower(0.0, {81.0, std::nullopt}));
  EXPECT_EQ(controller.level(), 1u);
  EXPECT_EQ(controller.steps().back().reason, QualityReason::kHot);
  controller.SetPower(1.0, {85.0, std::nullopt});
  EXPECT_EQ(controller.level(), 2u);
  // Quality does not oscillate around the limit.
  double time = 2.0;
  for (int i = 0; i < 30; ++i) {
    controller.SetPower(time, {i % 2 == 0 ? 83.5 : 84.5, std::nullopt});
    time = Play(controller, device, time, 5.0, light);
  }
  EXPECT_EQ(controller.level(), 2u);
  controller.SetPower(time, {70.0, std::nullopt});
  Play(controller, device, time, 30.0, light);
  EXPECT_EQ(controller.level(), 0u);
}

TEST(QualityController, ALowBatteryHoldsItDownUntilItIsChargedOrOnMains) {
  QualityController controller;
  Device device;
  const auto light = [](double) { return 10.0; };
  controller.SetPower(0.0, {std::nullopt, 0.14});
  EXPECT_EQ(controller.level(), 2u);
  EXPECT_EQ(controller.steps().back().reason, QualityReason::kBattery);
  double time = Play(controller, device, 0.0, 30.0, light);
  controller.SetPower(time, {std::nullopt, 0.16});
  time = Play(controller, device, time, 30.0, light);
  EXPECT_EQ(controller.level(), 2u);
  controller.SetPower(time, {std::nullopt, std::nullopt});
  Play(controller, device, time, 30.0, light);
  EXPECT_EQ(controller.level(), 0u);
}

TEST(QualityController, ReportsItsStepsWithTheirReasons) {
  QualityController controller;
  controller.SetPower(2.5, {90.0, std::nullopt});
  const Json json = controller.ToJson();
  ASSERT_EQ(json["steps"].size(), 1u);
  EXPECT_EQ(json["steps"][0]["why"], "the device is hot");
  EXPECT_EQ(json["steps"][0]["from"], 0);
  EXPECT_EQ(json["steps"][0]["to"], 3);
  EXPECT_EQ(json["frames"].size(), controller.level_count());
}

TEST(QualityOptions, ThatMakeNoSenseAreRefused) {
  const auto refused = [](auto change) {
    QualityOptions options;
    change(options);
    return !options.Validate().ok();
  };
  EXPECT_TRUE(QualityOptions().Validate().ok());
  EXPECT_TRUE(refused([](QualityOptions& o) { o.expected_cost = {}; }));
  EXPECT_TRUE(refused([](QualityOptions& o) { o.expected_cost = {0.5, 1.0}; }));
  EXPECT_TRUE(refused([](QualityOptions& o) { o.budget_ms = 0.0; }));
  EXPECT_TRUE(refused([](QualityOptions& o) { o.celsius_per_level = 0.0; }));
}

}  // namespace
}  // namespace lararium::show
