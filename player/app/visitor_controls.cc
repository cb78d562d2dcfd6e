#include "player/app/visitor_controls.h"

#include <algorithm>
#include <string_view>
#include <utility>
#include <vector>

#include "player/app/visitor_menu.h"

namespace lararium::player {
namespace {

// Switches the evidence view. It is not passed on to the drama.
constexpr std::string_view kEvidenceKey = "f2";
// Leaves the player, unless it is a kiosk. It is passed on to the drama as well.
constexpr std::string_view kLeaveKey = "escape";

}  // namespace

VisitorControls::VisitorControls(const ChoiceOptions& options,
                                 const KioskOptions& kiosk,
                                 const ChildStart& start,
                                 Log& log)
    : options_(options), log_(log) {
  if (kiosk.enabled) {
    kiosk_.emplace(kiosk.state.empty() ? DefaultStateFolder() : kiosk.state, start, log);
    kiosk_->SetVisit({.longest = 60.0 * kiosk.visit_minutes});
    choices_ = kiosk_->state().choices;
    house_ = kiosk_->state().house;
  }
  ApplyOptions(house_);
  ApplyOptions(choices_);
}

void VisitorControls::ApplyOptions(Choices& choices) const {
  if (!options_.language.empty()) {
    choices.language = options_.language;
  }
  if (!options_.captions.empty()) {
    choices.captions = options_.captions;
  }
  render::CaptionStyle& style = choices.caption_style;
  style.size = options_.caption_size.value_or(style.size);
  style.contrast = options_.caption_contrast.value_or(style.contrast);
  choices.descriptions = options_.descriptions.value_or(choices.descriptions);
  choices.reduced_motion = options_.reduced_motion.value_or(choices.reduced_motion);
}

void VisitorControls::ResetLanguages() {
  choices_.language.clear();
  choices_.captions.clear();
  choices_.read.clear();
  ApplyOptions(choices_);
}

void VisitorControls::Attach(const Buttons& buttons,
                             vision::PoseSource& poses,
                             PictureOutput& output) {
  buttons_ = buttons;
  poses_ = &poses;
  output_ = &output;
}

void VisitorControls::SetShow(show::Show& show) {
  show_ = &show;
  story_length_ = show.drama().settings().length;
  if (kiosk_) {
    kiosk_->SetStoryLength(story_length_);
  }
  ApplyChoices();
}

void VisitorControls::KeepLanguages(const show::LanguageChoice& languages, double now) {
  Choices choices = choices_;
  choices.language = languages.spoken;
  choices.captions = languages.captions;
  choices.read = languages.read;
  Change(choices, now);
}

void VisitorControls::PressKey(const std::string& key, double now) {
  if (key == kEvidenceKey) {
    output_->renderer().SetEvidence(!output_->renderer().shows_evidence());
    return;
  }
  if (kiosk_) {
    kiosk_->Touch(now, *show_);
  }
  const GazeMenu::Pressed pressed = menu_.Press(key, now);
  if (pressed.action) {
    Do(*pressed.action, now);
  }
  if (pressed.taken) {
    return;
  }
  show_->input().PressKey(key);
  if (const std::optional<Action> action = buttons_.ActionOf(key)) {
    Do(*action, now);
  }
  ends_ = ends_ || (key == kLeaveKey && !kiosk_);
}

// Commands of the staff apply to the current visitor and to later ones.
void VisitorControls::Obey(const StaffCommand& command, double now) {
  Choose(command, offer(), house_);
  if (command.action) {
    Choose(*command.action, offer(), house_);
  }
  Keep(now);
  Choices choices = choices_;
  Choose(command, offer(), choices);
  Change(choices, now);
  if (command.action) {
    Do(*command.action, now);
  }
  if (command.hold && markers_) {
    Hold(*command.hold);
  }
  if (!command.go_to.empty() && markers_) {
    GoTo(command.go_to);
  }
  restarts_ = restarts_ || (command.begin_again && kiosk_);
  ends_ = ends_ || command.end || restarts_;
}

void VisitorControls::BeforeFrame(show::StagedFrame& staged, double now) {
  if (kiosk_) {
    kiosk_->BeforeFrame(staged);
  }
  const bool tracked = staged.tracked.camera_from_map.has_value();
  if (const std::optional<Action> action =
          menu_.Look(now, tracked ? staged.camera.camera_from_stage : std::nullopt)) {
    Do(*action, now);
  }
  const render::RenderTarget& picture = output_->picture();
  ShowMenu(
      output_->PictureCamera(staged.tracked.camera).Resized(picture.width(), picture.height()));
}

void VisitorControls::ShowMenu(const geometry::CameraModel& picture) {
  output_->renderer().SetMenu(menu_.open() ? std::optional(PictureOf(menu_, picture, choices_))
                                           : std::nullopt);
}

void VisitorControls::AfterFrame(const show::StagedFrame& staged, double shown) {
  if (!kiosk_) {
    return;
  }
  kiosk_->AfterFrame(shown, staged, *show_);
  if (kiosk_->TakeNewVisitor()) {
    menu_.Close();
    Hold(false);
    Change(house_, shown);
  }
}

void VisitorControls::FillStaffState(const show::StagedFrame& staged, StaffState& state) const {
  const show::ShowContent& content = show_->content();
  state.title = content.title;
  state.place = content.places[staged.camera.place].stage.name;
  state.length = story_length_ > 0.0 ? std::optional(story_length_) : std::nullopt;
  state.kiosk = kiosk_.has_value();
  state.visitor = kiosk_ ? std::optional(kiosk_->visited()) : std::nullopt;
  state.choices = choices_;
  state.languages = content.spoken_languages;
  state.caption_languages = content.caption_languages;
  state.has_descriptions = content.has_descriptions;
  state.held = markers_ ? std::optional(holds_) : std::nullopt;
  for (const group::GroupOwn::Marker& marker :
       markers_.value_or(std::vector<group::GroupOwn::Marker>())) {
    state.markers.push_back(marker.name);
  }
}

void VisitorControls::Do(Action action, double now) {
  switch (action) {
    case Action::kRestart:
      Hold(false);
      if (kiosk_) {
        kiosk_->BeginAgain(now, *show_);
      } else {
        show_->input().RestartAt(0.0);
      }
      break;
    case Action::kFindAnew:
      poses_->Relocalize();
      show_->input().ForgetPose();
      break;
    case Action::kMenu:
      ToggleMenu(now);
      break;
    default: {
      Choices choices = choices_;
      Choose(action, offer(), choices);
      Change(choices, now);
    }
  }
}

void VisitorControls::Change(Choices choices, double now) {
  if (choices.captions == show::kNoCaptions && choices_.captions != show::kNoCaptions) {
    choices.read = choices_.captions;
  }
  if (choices == choices_) {
    return;
  }
  choices_ = std::move(choices);
  ApplyChoices();
  Keep(now);
}

// Applies the choices that do not need another show.
void VisitorControls::ApplyChoices() {
  output_->renderer().SetCaptionStyle(choices_.caption_style);
  show_->input().SetDescriptions(choices_.descriptions);
  show_->input().SetReducedMotion(choices_.reduced_motion);
  show_->input().Hold(holds_);
  menu_.SetItems(ItemsOf(show_->content(), choices_));
}

void VisitorControls::Keep(double now) {
  if (kiosk_) {
    kiosk_->Keep(choices_, house_, now);
  }
}

void VisitorControls::ToggleMenu(double now) {
  std::vector<MenuItem> items = ItemsOf(show_->content(), choices_);
  if (menu_.open() || items.empty()) {
    menu_.Close();
    return;
  }
  const double scale = ScaleFor(output_->PictureCamera(), items.size());
  menu_.Open(std::move(items), now, scale);
}

void VisitorControls::Hold(bool holds) {
  holds_ = holds;
  show_->input().Hold(holds);
}

void VisitorControls::GoTo(const std::string& marker) {
  const auto found =
      std::find_if(markers_->begin(), markers_->end(),
                   [&](const group::GroupOwn::Marker& m) { return m.name == marker; });
  if (found == markers_->end()) {
    log_.Warn("the staff asked for the marker \"{}\", which the drama does not have", marker);
    return;
  }
  show_->input().RestartAt(static_cast<double>(found->tick) / drama::Drama::kTicksPerSecond);
}

Offer VisitorControls::offer() const {
  const show::ShowContent& content = show_->content();
  return {content.spoken_languages, content.caption_languages, content.has_descriptions};
}

}  // namespace lararium::player
