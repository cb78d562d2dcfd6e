#pragma once

// Collects the state for the staff page and the fleet while frames are drawn. The work for each
// frame is small; the state is sent twice a second, and pictures only while a browser shows them.

#include <functional>
#include <utility>

#include "player/staff/staff_link.h"
#include "player/staff/staff_state.h"
#include "shared/core/log.h"
#include "shared/render/gl/async_readback.h"
#include "shared/render/gl/render_target.h"
#include "shared/show/show.h"

namespace lararium::player {

// Use it on the thread that draws, while its context exists.
class StaffReporter {
 public:
  // links and log: see StaffLink.
  StaffReporter(const StaffLinks& links, Log& log, GroupPort group = {})
      : link_(links, log, std::move(group)), mirror_(StaffLink::kPictureWidth) {}

  // Call this before the first frame, when the context exists. picture: has the size of the
  // pictures that will be mirrored.
  void Prepare(const render::RenderTarget& picture) { mirror_.Prepare(picture); }

  // Call this after a frame was shown; picture contains it. fill: adds the state that is not part
  // of frames; it is called only when the state is sent.
  void AfterFrame(const show::StagedFrame& staged,
                  const render::RenderTarget& picture,
                  const std::function<void(StaffState&)>& fill);

  StaffLink& link() { return link_; }

 private:
  void Mirror(double now, const render::RenderTarget& picture);

  StaffLink link_;
  TrackingTally tally_;
  render::AsyncReadback mirror_;
  double told_ = -1e9;
  double mirrored_ = -1e9;
};

}  // namespace lararium::player
