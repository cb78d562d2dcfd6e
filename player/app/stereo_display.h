#pragma once

// Shows frames on a headset that appears as a monitor: the pictures of both eyes side by side,
// distorted for the lenses.

#include "player/openxr/headset.h"
#include "shared/core/status.h"
#include "shared/render/gl/render_target.h"
#include "shared/render/passes/lens_pass.h"
#include "shared/show/show_renderer.h"

namespace lararium::player {

class StereoDisplay {
 public:
  // headset must have a panel. Needs a current context; call all other members on its thread.
  static Result<StereoDisplay> Create(const Headset& headset);

  // Draws the frame into picture and then onto the panel. For a stereo headset it is drawn once for
  // each eye.
  Status Draw(const show::StagedFrame& staged,
              show::ShowRenderer& renderer,
              const render::RenderTarget& picture);

  const render::RenderTarget& panel() const { return panel_; }

 private:
  StereoDisplay(const Headset& headset, render::LensPass lens_pass, render::RenderTarget panel)
      : headset_(headset), lens_pass_(std::move(lens_pass)), panel_(std::move(panel)) {}

  Headset headset_;
  render::LensPass lens_pass_;
  render::RenderTarget panel_;
};

}  // namespace lararium::player
