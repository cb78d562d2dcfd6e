#include "shared/show/visitor_input.h"

#include <gtest/gtest.h>

namespace lararium::show {
namespace {

TEST(VisitorInputTest, EventsAreTakenOnceAndSettingsStay) {
  VisitorInput input;
  input.PressKey("space");
  input.PressKey("a");
  input.RestartAt(-1.0);
  input.ForgetPose();
  input.SetHour(9.5f);
  input.SetDescriptions(true);
  input.SetReducedMotion(true);
  std::string keys;
  drama::AddKey("space", keys);
  drama::AddKey("a", keys);
  const VisitorInput::Values first = input.Take();
  EXPECT_EQ(first.keys, keys);
  EXPECT_EQ(first.restart, 0.0) << "a drama has no time before its beginning";
  EXPECT_TRUE(first.forgets_pose);
  const VisitorInput::Values next = input.Take();
  EXPECT_EQ(next.keys, "");
  EXPECT_EQ(next.restart, std::nullopt);
  EXPECT_FALSE(next.forgets_pose);
  for (const VisitorInput::Values& values : {first, next}) {
    EXPECT_EQ(values.hour, 9.5f);
    EXPECT_TRUE(values.describes);
    EXPECT_TRUE(values.reduced_motion);
  }
}

}  // namespace
}  // namespace lararium::show
