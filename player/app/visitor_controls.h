#pragma once

// Carries out what visitors and staff want of a running show: keys and buttons, the menu, the
// staff's commands, and, in a kiosk, the change of visitors.

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "player/app/gaze_menu.h"
#include "player/app/options.h"
#include "player/app/picture_output.h"
#include "player/kiosk/kiosk.h"
#include "player/kiosk/visitor_actions.h"
#include "player/staff/staff_messages.h"
#include "player/staff/staff_state.h"
#include "shared/core/log.h"
#include "shared/group/group_message.h"
#include "shared/show/show.h"
#include "shared/vision/tracked_frame.h"

namespace lararium::player {

// All times (now) are in seconds of one steady clock.
class VisitorControls {
 public:
  // Starts with the choices of a kiosk's last visitor; options take precedence over them. start:
  // see Kiosk. log must outlive the object.
  VisitorControls(const ChoiceOptions& options,
                  const KioskOptions& kiosk,
                  const ChildStart& start,
                  Log& log);

  Kiosk* kiosk() { return kiosk_ ? &*kiosk_ : nullptr; }  // nullptr: this is not a kiosk
  show::LanguageChoice languages() const {
    return {choices_.language, choices_.captions, false, choices_.read};
  }
  // Returns to the languages of the options, because the show does not have those of the last
  // visitor.
  void ResetLanguages();

  // Sets what is controlled, which must outlive the object. Call this and SetShow() before the
  // functions below.
  void Attach(const Buttons& buttons, vision::PoseSource& poses, PictureOutput& output);
  // Applies the choices to a show, which is controlled from now on.
  void SetShow(show::Show& show);
  // The languages could not be changed: those that the show has are chosen again.
  void KeepLanguages(const show::LanguageChoice& languages, double now);

  // A key, or a button of a controller. Keys that nothing else uses are passed on to the drama.
  void PressKey(const std::string& key, double now);
  void Obey(const StaffCommand& command, double now);
  // Updates the menu for a frame, and performs the action that is chosen by gaze.
  void BeforeFrame(show::StagedFrame& staged, double now);
  // Adds the menu to a picture that this pinhole camera shows.
  void ShowMenu(const geometry::CameraModel& picture);
  // Updates the kiosk, which may notice that the next visitor has come. shown: time of the frame.
  void AfterFrame(const show::StagedFrame& staged, double shown);

  // Factor on the visibility of people, which falls to 0 when a visit is over.
  float shown() const { return kiosk_ ? kiosk_->shown() : 1.0f; }
  float volume() const { return static_cast<float>(choices_.volume) * shown(); }
  // True if the visitor or the staff asked to end the program.
  bool ends() const { return ends_; }
  // True if the staff asked the watchdog to restart the show.
  bool restarts() const { return restarts_; }
  // Sets the moments to which the staff may go, and lets them hold the drama. A player in a group
  // does without, because its link does so for all.
  void SetMarkers(std::vector<group::GroupOwn::Marker> markers) { markers_ = std::move(markers); }
  // Adds what the staff sees of the show, the choices and the kiosk.
  void FillStaffState(const show::StagedFrame& staged, StaffState& state) const;

 private:
  void ApplyOptions(Choices& choices) const;
  void Do(Action action, double now);
  void Change(Choices choices, double now);
  void ApplyChoices();
  void Keep(double now);
  void ToggleMenu(double now);
  void Hold(bool holds);
  void GoTo(const std::string& marker);
  Offer offer() const;

  ChoiceOptions options_;
  std::optional<Kiosk> kiosk_;
  Choices choices_;
  Choices house_;  // Defaults set by the staff for a kiosk's next visitor.
  GazeMenu menu_;
  Buttons buttons_;
  bool ends_ = false;
  bool restarts_ = false;
  vision::PoseSource* poses_ = nullptr;
  PictureOutput* output_ = nullptr;
  show::Show* show_ = nullptr;
  double story_length_ = 0.0;                                    // Seconds; 0: not known.
  std::optional<std::vector<group::GroupOwn::Marker>> markers_;  // nullopt: in a group.
  bool holds_ = false;                                           // The staff holds the drama.
  Log& log_;
};

}  // namespace lararium::player
