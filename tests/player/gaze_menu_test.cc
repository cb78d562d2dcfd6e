#include "player/app/gaze_menu.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lararium::player {
namespace {

constexpr double kFrame = 1.0 / 30.0;

std::vector<MenuItem> Items() {
  return {{Action::kLouder, "louder", true, false},
          {Action::kQuieter, "quieter", true, false},
          {Action::kLanguage, "language", false, false},
          {std::nullopt, "close", false, true}};
}

// The pose of a head that looks at a point of the plane one metre in front of its first direction.
geometry::Rigid3 LookingAt(const Eigen::Vector2d& plane) {
  const Eigen::Vector3d towards = plane.homogeneous().normalized();
  return {geometry::RotationBetween(Eigen::Vector3d::UnitZ(), towards), Eigen::Vector3d::Zero()};
}

class GazeMenuTest : public ::testing::Test {
 protected:
  void SetUp() override { Open(); }

  void Open() {
    menu_.Open(Items(), now_);
    Hold({0.0, 0.0}, 2.0 * kFrame);
    for (const GazeMenu::Cell& cell : menu_.Cells()) {
      middles_.push_back(cell.box.center());
    }
  }

  // Looks at a point for some seconds. Returns the actions that were chosen.
  std::vector<Action> Hold(const Eigen::Vector2d& plane, double seconds) {
    return Watch(LookingAt(plane), seconds);
  }
  std::vector<Action> Watch(const std::optional<geometry::Rigid3>& head, double seconds) {
    std::vector<Action> chosen;
    for (double passed = 0.0; passed < seconds; passed += kFrame) {
      now_ += kFrame;
      if (const std::optional<Action> action = menu_.Look(now_, head)) {
        chosen.push_back(*action);
      }
    }
    return chosen;
  }

  GazeMenu menu_;
  double now_ = 100.0;
  std::vector<Eigen::Vector2d> middles_;  // middles of all items
};

using Actions = std::vector<Action>;

TEST_F(GazeMenuTest, ChoosesNothingByBeingOpened) {
  EXPECT_TRUE(Hold({0.0, 0.0}, 8.0).empty());
  EXPECT_TRUE(menu_.open());
  for (const GazeMenu::Cell& cell : menu_.Cells()) {
    EXPECT_FALSE(cell.selected);
  }
}

TEST_F(GazeMenuTest, ChoosesWhatIsLookedAtLongEnough) {
  EXPECT_TRUE(Hold(middles_[2], GazeMenu::kDwell - 0.2).empty());
  EXPECT_GT(menu_.Cells()[2].progress, 0.7f);
  EXPECT_EQ(Hold(middles_[2], 0.4), Actions{Action::kLanguage});
}

TEST_F(GazeMenuTest, AGlanceElsewhereBeginsAnew) {
  Hold(middles_[2], GazeMenu::kDwell - 0.2);
  Hold(middles_[0], 0.3);
  EXPECT_TRUE(Hold(middles_[2], GazeMenu::kDwell - 0.2).empty());
}

TEST_F(GazeMenuTest, OnlyWhatRepeatsIsChosenAgain) {
  const double three = GazeMenu::kDwell + 2.5 * GazeMenu::kRepeat;
  EXPECT_EQ(Hold(middles_[0], three), Actions(3, Action::kLouder));
  EXPECT_EQ(Hold(middles_[2], three), Actions{Action::kLanguage});
  Hold({0.0, 0.0}, 0.2);
  EXPECT_EQ(Hold(middles_[2], three), Actions{Action::kLanguage}) << "once it was left";
}

TEST_F(GazeMenuTest, StaysWhereItWasOpened) {
  Hold({0.1, -0.05}, kFrame);
  const Eigen::Vector2d moved = menu_.Cells()[0].box.center() - middles_[0];
  EXPECT_NEAR(moved.x(), -0.1, 0.01);
  EXPECT_NEAR(moved.y(), 0.05, 0.01);
  Watch(geometry::Rigid3{Eigen::Quaterniond(0.0, 0.0, 1.0, 0.0), Eigen::Vector3d::Zero()}, kFrame);
  EXPECT_TRUE(menu_.Cells().empty()) << "behind the visitor";
}

TEST_F(GazeMenuTest, WithoutAPoseItStaysAndButtonsChoose) {
  EXPECT_TRUE(Watch(std::nullopt, 2.0).empty());
  EXPECT_NEAR((menu_.Cells()[0].box.center() - middles_[0]).norm(), 0.0, 1e-9);
  EXPECT_TRUE(menu_.Press("pad_down", now_).taken);
  EXPECT_TRUE(menu_.Press("down", now_).taken);
  EXPECT_EQ(menu_.Press("enter", now_).action, Action::kQuieter);
  EXPECT_EQ(menu_.Press("pad_a", now_).action, Action::kQuieter);
  EXPECT_TRUE(menu_.Cells()[1].selected);
  menu_.Press("up", now_);
  menu_.Press("up", now_);
  EXPECT_FALSE(menu_.Press("enter", now_).action.has_value());
  EXPECT_FALSE(menu_.open()) << "the last one closes";
}

TEST_F(GazeMenuTest, AHandsButtonChoosesWhatIsLookedAtAtOnce) {
  EXPECT_FALSE(menu_.Press(kHandSelect, now_).action.has_value()) << "nothing is looked at";
  Hold(middles_[2], 0.1);
  EXPECT_EQ(menu_.Press(kHandSelect, now_).action, Action::kLanguage);
  EXPECT_TRUE(Hold(middles_[2], 2.0 * GazeMenu::kDwell).empty()) << "chosen already";
}

TEST_F(GazeMenuTest, LeavesOtherButtonsToOthers) {
  EXPECT_FALSE(menu_.Press("l", now_).taken);
  EXPECT_TRUE(menu_.Press("enter", now_).taken);
  EXPECT_FALSE(menu_.Press("enter", now_).action.has_value()) << "nothing is selected";
  menu_.Close();
  EXPECT_FALSE(menu_.Press("up", now_).taken);
}

TEST_F(GazeMenuTest, GoesWhenNobodyLooksAtIt) {
  Hold(middles_[1], 0.5);
  Hold({0.0, 0.0}, GazeMenu::kIdle - 0.2);
  EXPECT_TRUE(menu_.open());
  Hold({0.0, 0.0}, 0.4);
  EXPECT_FALSE(menu_.open());
  EXPECT_TRUE(menu_.Cells().empty());
}

TEST_F(GazeMenuTest, ClosesByGaze) {
  EXPECT_TRUE(Hold(middles_[3], 2.0 * GazeMenu::kDwell).empty());
  EXPECT_FALSE(menu_.open());
  Open();
  EXPECT_TRUE(menu_.open());
}

}  // namespace
}  // namespace lararium::player
