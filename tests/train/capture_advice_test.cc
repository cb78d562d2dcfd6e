#include "editor/train/capture_advice.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lararium::train {
namespace {

using AdviceKind = CaptureAdvice::Kind;
using End = CaptureAdvice::End;

std::string English(const CaptureAdvice& advice) { return AdviceSentence(advice).English(); }

TEST(CaptureAdvice, NamesTheFramesWhyTheyAreWeakAndTheRemedy) {
  const CaptureAdvice several{.kind = AdviceKind::kNotLocated,
                              .first = "4.png",
                              .last = "5.png",
                              .reason = WeakReason::kBlur};
  EXPECT_EQ(English(several),
            "The frames 4.png to 5.png could not be located (blurred): film this part again, more "
            "slowly or in better light, with the focus fixed.");
  const CaptureAdvice one{.kind = AdviceKind::kNotLocated,
                          .first = "4.png",
                          .last = "4.png",
                          .reason = WeakReason::kFewFeatures};
  EXPECT_EQ(English(one),
            "The frame 4.png could not be located (few features): turn on more light, and keep "
            "textured objects in view.");
}

TEST(CaptureAdvice, CountsShortGaps) {
  EXPECT_TRUE(
      English({.kind = AdviceKind::kShortGaps, .value = 1}).starts_with("1 short stretch of"));
  EXPECT_TRUE(
      English({.kind = AdviceKind::kShortGaps, .value = 3}).starts_with("3 short stretches of"));
}

TEST(CaptureAdvice, SaysHowFarToWalkInMetresOrAsAShareOfWhatIsSeen) {
  CaptureAdvice advice{.kind = AdviceKind::kOneSide,
                       .first = "a",
                       .last = "b",
                       .end = End::kLeft,
                       .value = 2.34,
                       .walk = {0.52, true}};
  EXPECT_EQ(English(advice),
            "What frames a to b show (at the left end of the plan) was seen from one side only "
            "(directions differ by 2.3 degrees): walk past it sideways by about 0.5 m.");
  advice.walk = {0.264, false};
  EXPECT_TRUE(English(advice).ends_with("by about 26 % of the distance to the scene."));
  advice.walk = {1.2, false};
  EXPECT_TRUE(English(advice).ends_with("by about as far as the scene is away."));
}

TEST(CaptureAdvice, TellsWhatAVisitorDoesWhoIsLocatedPoorly) {
  CaptureAdvice advice{.kind = AdviceKind::kStepBack,
                       .first = "a",
                       .last = "b",
                       .end = End::kFar,
                       .value = 12.0,
                       .walk = {1.0, true}};
  EXPECT_EQ(English(advice),
            "A visitor at frames a to b (at the far end of the plan) who steps back by about 1.0 m "
            "will be located poorly (about 12 points found again): walk the same way again from "
            "further back.");
  advice.kind = AdviceKind::kTurnLeft;
  advice.end = End::kNone;
  EXPECT_EQ(English(advice),
            "A visitor at frames a to b who turns to the left by 30 degrees will be located poorly "
            "(about 12 points found again): film what lies to the left too, walking past it.");
}

TEST(CaptureAdvice, OfOneSentenceIsSaidAsItWasWritten) {
  EXPECT_EQ(English({.kind = AdviceKind::kWritten, .text = "Walk 100 %s further."}),
            "Walk 100 %s further.");
}

}  // namespace
}  // namespace lararium::train
