#include <cstdio>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "player/app/show_session.h"

namespace lararium::player {
namespace {

// Switches the evidence view. It is not passed on to the drama.
constexpr std::string_view kEvidenceKey = "f2";
// Leaves the player, unless it is a kiosk. It is passed on to the drama as well.
constexpr std::string_view kLeaveKey = "escape";

}  // namespace

void ShowSession::PressKeys() {
  for (const std::string& message : osc_ != nullptr ? osc_->Take() : std::vector<std::string>()) {
    show_->input().PressKey(message);
  }
  for (const std::string& key : screen_->TakeKeys()) {
    if (key == kEvidenceKey) {
      renderer_->SetEvidence(!renderer_->shows_evidence());
      continue;
    }
    PressKey(key);
  }
}

// Keys that the menu does not use are passed on to the drama.
void ShowSession::PressKey(const std::string& key) {
  const double now = Seconds(SteadyClock::now());
  if (kiosk_) {
    kiosk_->Touch(now, *show_);
  }
  const GazeMenu::Pressed pressed = menu_.Press(key, now);
  if (pressed.action) {
    Do(*pressed.action);
  }
  if (pressed.taken) {
    return;
  }
  show_->input().PressKey(key);
  if (const std::optional<Action> action = device_.buttons.ActionOf(key)) {
    Do(*action);
  }
  if (key == kLeaveKey && !kiosk_) {
    RequestEnd();
  }
}

void ShowSession::Do(Action action) {
  switch (action) {
    case Action::kRestart:
      if (kiosk_) {
        kiosk_->BeginAgain(Seconds(SteadyClock::now()), *show_);
      } else {
        show_->input().RestartAt(0.0);
      }
      break;
    case Action::kFindAnew:
      poses_->Relocalize();
      show_->input().ForgetPose();
      break;
    case Action::kMenu:
      ToggleMenu();
      break;
    default: {
      Choices choices = choices_;
      Choose(action, offer(), choices);
      Change(choices);
    }
  }
}

// Applies the visitor's choices.
void ShowSession::Change(const Choices& choices) {
  if (choices == choices_) {
    return;
  }
  choices_ = choices;
  SetVolume();
  renderer_->SetCaptionStyle(choices_.caption_style);
  TellShow();
  menu_.SetItems(ItemsOf(show_->content(), choices_));
  if (kiosk_) {
    kiosk_->Keep(choices_, house_, Seconds(SteadyClock::now()));
  }
}

void ShowSession::SetVolume() {
  if (sound_ != nullptr) {
    sound_->SetVolume(static_cast<float>(choices_.volume) * Shown());
  }
}

void ShowSession::ObeyStaff() {
  if (staff_) {
    for (const StaffCommand& command : staff_->link().TakeCommands()) {
      Obey(command);
    }
  }
}

// Commands of the staff apply to the current visitor and to later ones.
void ShowSession::Obey(const StaffCommand& command) {
  Choose(command, offer(), house_);
  if (command.action) {
    Choose(*command.action, offer(), house_);
  }
  if (kiosk_) {
    kiosk_->Keep(choices_, house_, Seconds(SteadyClock::now()));
  }
  Choices choices = choices_;
  Choose(command, offer(), choices);
  Change(choices);
  if (command.action) {
    Do(*command.action);
  }
  begin_again_ = begin_again_ || (command.begin_again && kiosk_);
  if (command.end || begin_again_) {
    RequestEnd();
  }
}

void ShowSession::TellStaff(const show::StagedFrame& staged) {
  if (!staff_) {
    return;
  }
  staff_->AfterFrame(staged, *target_,
                     [this, &staged](StaffState& state) { FillStaffState(staged, state); });
  if (kiosk_ && told_statistics_ != kiosk_->statistics_version()) {
    told_statistics_ = kiosk_->statistics_version();
    staff_->link().TellStatistics(kiosk_->statistics());
  }
}

void ShowSession::FillStaffState(const show::StagedFrame& staged, StaffState& state) const {
  const show::ShowContent& content = show_->content();
  state.title = content.title;
  state.place = content.places[staged.camera.place].stage.name;
  state.length = story_length_ > 0.0 ? std::optional(story_length_) : std::nullopt;
  state.kiosk = kiosk_.has_value();
  state.visitor = kiosk_ ? std::optional(kiosk_->visited()) : std::nullopt;
  state.quality = level();
  state.choices = choices_;
  state.audible = sound_ != nullptr;
  state.languages = content.spoken_languages;
  state.caption_languages = content.caption_languages;
  state.has_descriptions = content.has_descriptions;
  state.up_seconds = Seconds(last_shown_);
  state.restarts = restarts_;
}

void ShowSession::ToggleMenu() {
  std::vector<MenuItem> items = ItemsOf(show_->content(), choices_);
  if (menu_.open() || items.empty()) {
    menu_.Close();
    return;
  }
  const double scale =
      ScaleFor(renderer_->PictureOf(camera_, size_.width, size_.height), items.size());
  menu_.Open(std::move(items), Seconds(SteadyClock::now()), scale);
}

// Updates the menu for a frame, and performs the action that is chosen by gaze.
void ShowSession::ShowMenu(const show::StagedFrame& staged) {
  const bool tracked = staged.tracked.camera_from_map.has_value();
  if (const std::optional<Action> action = menu_.Look(
          Seconds(SteadyClock::now()), tracked ? staged.camera.camera_from_stage : std::nullopt)) {
    Do(*action);
  }
  ShowMenuTo(renderer_->PictureOf(staged.tracked.camera, size_.width, size_.height)
                 .Resized(size_.width, size_.height));
}

void ShowSession::ShowMenuTo(const geometry::CameraModel& picture) {
  renderer_->SetMenu(menu_.open() ? std::optional(PictureOf(menu_, picture, choices_))
                                  : std::nullopt);
}

void ShowSession::TellKiosk() {
  story_length_ = show_->drama().settings().length;
  if (kiosk_) {
    kiosk_->SetStoryLength(story_length_);
  }
}

// Applies the choices that do not need another show.
void ShowSession::TellShow() {
  show_->input().SetDescriptions(choices_.descriptions);
  show_->input().SetReducedMotion(choices_.reduced_motion);
}

void ShowSession::ShowToStaff() {
  char more[64];
  const double rate =
      statistics_.interval.count() == 0 ? 0.0 : 1000.0 / statistics_.interval.mean();
  std::snprintf(more, sizeof(more), "   quality %zu   %.0f/s", level(), rate);
  renderer_->SetStaff(more);
}

// Updates the kiosk, which may notice that the next visitor has come.
void ShowSession::AfterFrame(const show::StagedFrame& staged) {
  if (!kiosk_) {
    return;
  }
  kiosk_->AfterFrame(Seconds(last_shown_), staged, *show_);
  if (kiosk_->TakeNewVisitor()) {
    menu_.Close();
    Change(house_);
  }
  SetVolume();
}

}  // namespace lararium::player
