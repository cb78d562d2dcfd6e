#pragma once

// Shows frames on a headset that appears as a monitor: both eyes' parts side by side, bent for the
// lenses.

#include "player/headset.h"
#include "shared/core/status.h"
#include "shared/render/lens_pass.h"
#include "shared/render/render_target.h"
#include "shared/show/show_renderer.h"

namespace lararium::player {

class StereoDisplay {
 public:
  // headset: with a panel. Needs a current context; everything else happens on its thread.
  static Result<StereoDisplay> Create(const Headset& headset);

  // Draws the frame into picture, for each eye again where the headset is stereo, and from there
  // onto the panel.
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
