#pragma once

// Gathers for the staff page while frames are drawn: a few additions for each, more only twice a
// second, a picture only when somebody looks.

#include <functional>

#include "player/staff_link.h"
#include "player/staff_state.h"
#include "shared/core/log.h"
#include "shared/render/picture_mirror.h"
#include "shared/render/render_target.h"
#include "shared/show/show.h"

namespace lararium::player {

// On the thread that draws, while its context lives.
class StaffReporter {
 public:
  // As StaffLink.
  StaffReporter(int link, Log& log) : link_(link, log), mirror_(StaffLink::kPictureWidth) {}

  // Before the first frame, when there is the context: pictures of that size are mirrored.
  void Prepare(const render::RenderTarget& picture) { mirror_.Prepare(picture); }

  // A frame was shown, and picture holds it. fill: adds what frames do not say; called only when
  // the page is told.
  void AfterFrame(const show::StagedFrame& staged,
                  const render::RenderTarget& picture,
                  const std::function<void(StaffState&)>& fill);

  StaffLink& link() { return link_; }

 private:
  void Mirror(double now, const render::RenderTarget& picture);

  StaffLink link_;
  TrackingTally tally_;
  render::PictureMirror mirror_;
  double told_ = -1e9;
  double mirrored_ = -1e9;
};

}  // namespace lararium::player
