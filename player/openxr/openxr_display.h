#pragma once

// Shows frames on a headset that an OpenXR runtime drives (openxr_headset.h): as a picture in the
// room, or, if the runtime shows the real world itself, only people, drawn for each eye.

#include <chrono>
#include <functional>
#include <memory>
#include <string>

#include "player/openxr/openxr_headset.h"
#include "shared/render/gl/render_target.h"
#include "shared/show/show_renderer.h"
#include "shared/show/stage_anchor.h"

namespace lararium::player {

class OpenXrDisplay {
 public:
  // See OpenXrHeadset::Open.
  static Result<std::unique_ptr<OpenXrDisplay>> Open(const Headset& headset,
                                                     const std::string& title,
                                                     Log& log);

  // Draws the frame into picture, once for each eye if necessary, and hands it to the runtime. now:
  // seconds of a steady clock. opacity: opacity of people, used if only people are drawn. before:
  // if the eyes have different pinhole cameras, it is called with each of them before drawing.
  Status Draw(const show::StagedFrame& staged,
              show::ShowRenderer& renderer,
              const render::RenderTarget& picture,
              double now,
              float opacity,
              const std::function<void(const geometry::CameraModel&)>& before);

  OpenXrHeadset& headset() { return *openxr_; }

 private:
  OpenXrDisplay(const Headset& headset, std::unique_ptr<OpenXrHeadset> openxr)
      : headset_(headset), openxr_(std::move(openxr)) {}
  Status DrawSeeThrough(const show::StagedFrame& staged,
                        show::ShowRenderer& renderer,
                        const render::RenderTarget& picture,
                        std::chrono::steady_clock::time_point taken,
                        double now,
                        float opacity,
                        const std::function<void(const geometry::CameraModel&)>& before);

  Headset headset_;
  std::unique_ptr<OpenXrHeadset> openxr_;
  show::StageAnchor anchor_;  // The stage in the real world that a runtime shows.
};

}  // namespace lararium::player
