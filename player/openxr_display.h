#pragma once

// Shows frames on a headset that an OpenXR runtime drives (openxr_headset.h): as a picture in the
// room, or, where the runtime shows what is real by itself, people alone, for each eye.

#include <chrono>
#include <functional>
#include <memory>
#include <string>

#include "player/openxr_headset.h"
#include "player/stage_anchor.h"
#include "shared/render/render_target.h"
#include "shared/show/show_renderer.h"

namespace lararium::player {

class OpenXrDisplay {
 public:
  // As OpenXrHeadset::Open.
  static Result<std::unique_ptr<OpenXrDisplay>> Open(const Headset& headset,
                                                     const std::string& title,
                                                     Log& log);

  // Draws the frame into picture, for each eye again where that is wanted, and hands it over.
  // now: seconds by a steady clock. opacity: of people, where they are all that is drawn. before:
  // told of each pinhole that is drawn with, where the two eyes have their own.
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
  StageAnchor anchor_;  // where the runtime shows what is real
};

}  // namespace lararium::player
