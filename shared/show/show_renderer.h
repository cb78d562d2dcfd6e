#pragma once

// Draws staged frames. Everything happens on the thread whose OpenGL context was
// current at creation.

#include <memory>
#include <vector>

#include "shared/core/status.h"
#include "shared/render/renderer.h"
#include "shared/show/show.h"

namespace lararium::show {

class ShowRenderer {
 public:
  // Uploads the cast and the place's occluders.
  static Result<std::unique_ptr<ShowRenderer>> Create(const ShowContent& content,
                                                      const render::RendererOptions& options = {});

  // Other occluders or light, while a designer stages.
  void SetPlace(const stage::Place& place);

  // Fills the target with the composite: image, occluders, people.
  Status Draw(const StagedFrame& staged, const render::RenderTarget& target);

  // For overlays that draw what was uploaded here.
  const render::Renderer& renderer() const { return *renderer_; }
  const std::vector<render::SceneOccluder>& occluders() const { return occluders_; }

 private:
  explicit ShowRenderer(std::unique_ptr<render::Renderer> renderer)
      : renderer_(std::move(renderer)) {}

  std::unique_ptr<render::Renderer> renderer_;
  std::vector<render::HumanHandle> cast_;
  std::vector<render::SceneOccluder> occluders_;
  std::vector<render::SceneHuman> humans_;  // of the frame being drawn
  light::ShRgb light_ = {};
};

}  // namespace lararium::show
