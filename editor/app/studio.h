#pragma once

// A grey room with soft light in which people are looked at, off screen.

#include <memory>
#include <opencv2/core/mat.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "shared/core/status.h"
#include "shared/human/human.h"
#include "shared/render/graphics_context.h"
#include "shared/render/renderer.h"

namespace lararium::app {

// From where a person is seen, and how much of them.
struct StudioView {
  float azimuth = 0.0f;    // radians; 0 sees the front, a quarter turn the person's left side
  float elevation = 0.0f;  // radians, upward
  bool face = false;       // the head only
};

// front, side, back, face, three-quarter.
Result<StudioView> ParseStudioView(std::string_view name);

// A person as they are to be shown. Shapes are given by index into Human::face.
struct StudioPose {
  struct Shape {
    size_t shape = 0;
    float weight = 1.0f;
  };
  int clip = -1;  // index into Human::clips; none: the rest pose
  double time = 0.0;
  std::vector<Shape> shapes;
};

class Studio {
 public:
  static Result<std::unique_ptr<Studio>> Create();

  // bgr, 8 bits. The person must be valid (Human::Validate).
  Result<cv::Mat> Shoot(const human::Human& human,
                        const StudioPose& pose,
                        const StudioView& view,
                        cv::Size size);

 private:
  Studio(render::OffscreenContext context, std::unique_ptr<render::Renderer> renderer)
      : context_(std::move(context)), renderer_(std::move(renderer)) {}

  render::OffscreenContext context_;  // goes last
  std::unique_ptr<render::Renderer> renderer_;
};

}  // namespace lararium::app
