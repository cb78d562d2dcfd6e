#include "editor/panels/dialogs/tour.h"

#include <array>

#include "editor/panels/widgets/text.h"

namespace lararium::panels {

namespace {

using Facts = TourFacts;

constexpr auto kSteps = std::to_array<TourStep>({
    {TrLater("Learn the place"),
     TrLater(
         "The editor learns the sample's place from a film of it, a small Roman street kitchen. "
         "Then it bakes the people, their light and their voices. Train\xe2\x80\xa6 and Bake above "
         "do the same for a place of your own."),
     KeyAction::kNone, [](const Facts&, const Facts& now) { return now.trained && now.picture; }},
    {TrLater("Watch the drama"),
     TrLater("This is what a visitor sees: the camera's image, and in it the people of the drama. "
             "Pause it, or play it again."),
     KeyAction::kPlay,
     [](const Facts& before, const Facts& now) { return now.playing != before.playing; }},
    {TrLater("See how the place was learned"),
     TrLater(
         "Open Place > The training's report\xe2\x80\xa6: which images of the film were located, "
         "how exactly, and what to film better. Train\xe2\x80\xa6 above learns a place from "
         "another film."),
     KeyAction::kNone, [](const Facts&, const Facts& now) { return now.report; }},
    {TrLater("See what the camera is located by"),
     TrLater("Each image is located in the map that training made, by the points you can show over "
             "it."),
     KeyAction::kMatches, [](const Facts&, const Facts& now) { return now.matches; }},
    {TrLater("Look around"),
     TrLater("Here is the map itself, with the way of the camera and the stage. Drag to turn it, "
             "the wheel goes nearer."),
     KeyAction::kAroundView, [](const Facts&, const Facts& now) { return now.around; }},
    {TrLater("Move the stage"),
     TrLater("Select Stage at the left and drag one of the arrows: everything that is staged moves "
             "along. Its origin, its direction and its metres were picked in images of the film; "
             "Picks above shows them."),
     KeyAction::kMove,
     [](const Facts& before, const Facts& now) { return now.stage != before.stage; }},
    {TrLater("Undo"), TrLater("Nothing is lost: every edit can be undone, in its order."),
     KeyAction::kUndo, [](const Facts&, const Facts& now) { return now.can_redo; }},
    {TrLater("Meet the cast"),
     TrLater("Select one of the people at the left: what they look like and sound like is set "
             "there."),
     KeyAction::kNone, [](const Facts&, const Facts& now) { return now.person; }},
    {TrLater("Turn the light"),
     TrLater("Go through the camera and select the light probe. Turn it and see how the light "
             "on people changes."),
     KeyAction::kLightFarLeft,
     [](const Facts& before, const Facts& now) { return now.light != before.light; }},
    {TrLater("Change the drama"),
     TrLater(
         "Click into the timeline below, then add something: a walk, or a gesture. What you add "
         "is written into the script."),
     KeyAction::kAdd,
     [](const Facts& before, const Facts& now) { return now.script != before.script; }},
    {TrLater("Check"),
     TrLater("Go to Checks and choose Check the saved project: it runs the whole drama and tells "
             "what would go wrong."),
     KeyAction::kChecksTab, [](const Facts&, const Facts& now) { return now.checked; }},
    {TrLater("Save"), TrLater("Until you save, your edits are kept in a journal."),
     KeyAction::kSave, [](const Facts&, const Facts& now) { return !now.dirty; }},
    {TrLater("Export"),
     TrLater(
         "File > Export\xe2\x80\xa6 packs all that visitors need into one file for the player."),
     KeyAction::kNone, [](const Facts&, const Facts& now) { return now.exported; }},
});

}  // namespace

std::span<const TourStep> TourSteps() { return kSteps; }

void Tour::Begin(const TourFacts& now) {
  step_ = 0;
  finished_ = false;
  at_begin_ = now;
}

void Tour::Update(const TourFacts& now) {
  if (step_ && !finished_ && step()->done(at_begin_, now)) {
    Skip(now);
  }
}

void Tour::Skip(const TourFacts& now) {
  if (!step_) {
    return;
  }
  finished_ = *step_ + 1 == kSteps.size();
  if (!finished_) {
    ++*step_;
    at_begin_ = now;
  }
}

void Tour::End() {
  step_.reset();
  finished_ = false;
}

}  // namespace lararium::panels
