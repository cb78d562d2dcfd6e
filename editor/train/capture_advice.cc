#include "editor/train/capture_advice.h"

#include <array>
#include <charconv>

namespace lararium::train {
namespace {

using Kind = CaptureAdvice::Kind;
using End = CaptureAdvice::End;

std::string Fixed(double value, int decimals) {
  std::array<char, 64> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value,
                                 std::chars_format::fixed, decimals);
  return {text.data(), end.ptr};
}

Sentence Frames(const CaptureAdvice& advice) {
  return advice.first == advice.last ? Sentence("frame %s", {advice.first})
                                     : Sentence("frames %s to %s", {advice.first, advice.last});
}

// The words that follow the name of a stretch and say at which end of the plan it lies.
Sentence Where(End end) {
  switch (end) {
    case End::kNone:
      break;
    case End::kLeft:
      return Sentence(" (at the left end of the plan)");
    case End::kRight:
      return Sentence(" (at the right end of the plan)");
    case End::kNear:
      return Sentence(" (at the near end of the plan)");
    case End::kFar:
      return Sentence(" (at the far end of the plan)");
  }
  return Sentence();
}

Sentence Distance(const WalkDistance& walk) {
  if (walk.in_metres) {
    return Sentence("about %s m", {Fixed(walk.value, 1)});
  }
  constexpr double kAsFar = 0.95;
  return walk.value < kAsFar
             ? Sentence("about %s %% of the distance to the scene", {Fixed(100.0 * walk.value, 0)})
             : Sentence("about as far as the scene is away");
}

// Describes the step or turn after which a visitor is located poorly.
Sentence Leaves(const CaptureAdvice& advice) {
  const Sentence by = Distance(advice.walk);
  switch (advice.kind) {
    case Kind::kStepLeft:
      return Sentence("steps to the left by %s", {by});
    case Kind::kStepRight:
      return Sentence("steps to the right by %s", {by});
    case Kind::kStepNearer:
      return Sentence("goes nearer by %s", {by});
    case Kind::kStepBack:
      return Sentence("steps back by %s", {by});
    case Kind::kTurnLeft:
      return Sentence("turns to the left by 30 degrees");
    default:
      return Sentence("turns to the right by 30 degrees");
  }
}

Sentence RemedyOfLeaving(Kind kind) {
  switch (kind) {
    case Kind::kStepLeft:
      return Sentence("walk the same way again further left");
    case Kind::kStepRight:
      return Sentence("walk the same way again further right");
    case Kind::kStepNearer:
      return Sentence("walk the same way again from nearer");
    case Kind::kStepBack:
      return Sentence("walk the same way again from further back");
    case Kind::kTurnLeft:
      return Sentence("film what lies to the left too, walking past it");
    default:
      return Sentence("film what lies to the right too, walking past it");
  }
}

}  // namespace

Sentence Title(WeakReason reason) {
  switch (reason) {
    case WeakReason::kFewFeatures:
      return Sentence("few features");
    case WeakReason::kBlur:
      return Sentence("blurred");
    case WeakReason::kFastMotion:
      return Sentence("fast motion");
    case WeakReason::kNotLocated:
      return Sentence("does not fit the map");
    case WeakReason::kFewPoints:
      return Sentence("few points of the map in view");
  }
  return Sentence();
}

Sentence Remedy(WeakReason reason) {
  switch (reason) {
    case WeakReason::kFewFeatures:
      return Sentence("turn on more light, and keep textured objects in view");
    case WeakReason::kBlur:
      return Sentence("film this part again, more slowly or in better light, with the focus fixed");
    case WeakReason::kFastMotion:
      return Sentence("film this part again, more slowly");
    case WeakReason::kNotLocated:
      return Sentence(
          "film this part again so that it overlaps with the rest by two thirds, and keep people "
          "out of the way");
    case WeakReason::kFewPoints:
      return Sentence("stay longer here, and walk past the objects in view");
  }
  return Sentence();
}

Sentence AdviceSentence(const CaptureAdvice& advice) {
  switch (advice.kind) {
    case Kind::kEnough:
      return Sentence(
          "Nothing is missing: every stretch was located, and visitors near the path will be "
          "located well.");
    case Kind::kNotLocated:
      return Sentence("The %s could not be located (%s): %s.",
                      {Frames(advice), Title(advice.reason), Remedy(advice.reason)});
    case Kind::kShortGaps:
      return advice.value == 1.0
                 ? Sentence(
                       "1 short stretch of one or two frames could not be located; the frames "
                       "around make up for them. Move more slowly there if you film again.")
                 : Sentence(
                       "%s short stretches of one or two frames could not be located; the frames "
                       "around make up for them. Move more slowly there if you film again.",
                       {Fixed(advice.value, 0)});
    case Kind::kOneSide:
      return Sentence(
          "What %s show%s was seen from one side only (directions differ by %s degrees): walk past "
          "it sideways by %s.",
          {Frames(advice), Where(advice.end), Fixed(advice.value, 1), Distance(advice.walk)});
    case Kind::kStepLeft:
    case Kind::kStepRight:
    case Kind::kStepNearer:
    case Kind::kStepBack:
    case Kind::kTurnLeft:
    case Kind::kTurnRight:
      return Sentence(
          "A visitor at %s%s who %s will be located poorly (about %s points found again): %s.",
          {Frames(advice), Where(advice.end), Leaves(advice), Fixed(advice.value, 0),
           RemedyOfLeaving(advice.kind)});
    case Kind::kFocal:
      return Sentence(
          "The focal length is known to %s %% only: film the place from nearer and farther as "
          "well, or give the intrinsics.",
          {Fixed(advice.value, 1)});
    case Kind::kFewKeyframes:
      return Sentence(
          "Only %s images shape the map: film a longer walk, so that visitors find it from more "
          "places.",
          {Fixed(advice.value, 0)});
    case Kind::kExposure:
      return Sentence(
          "Exposure changed by %s stops while filming session %s: lock it, and keep bright windows "
          "out of the image.",
          {Fixed(advice.value, 1), std::to_string(advice.session)});
    case Kind::kLookalikes:
      return Sentence(
          "Other parts of the place look like what %s show%s: visitors are located there only "
          "after they saw something unique. Put up something unique, such as a notice, or let them "
          "begin elsewhere.",
          {Frames(advice), Where(advice.end)});
    case Kind::kUnordered:
      return Sentence(
          "Parts of this place look alike (%s %% of what the images show), and images in no order "
          "do "
          "not tell which part they show: equal parts may have been taken for one, and the map may "
          "be wrong. Film the place on one walk past all of its parts.",
          {Fixed(advice.value, 0)});
    case Kind::kWritten:
      break;
  }
  return advice.text;
}

}  // namespace lararium::train
