#pragma once

// A grey room with soft light in which people are looked at, off screen.

#include <glm/vec2.hpp>
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

// How much of a person is seen.
enum class StudioFrame {
  kFigure,  // from head to foot
  kBust,    // head and shoulders
  kFace,
};

// From where a person is seen, and how much of them.
struct StudioView {
  float azimuth = 0.0f;    // radians; 0 sees the front, a quarter turn the person's left side
  float elevation = 0.0f;  // radians, upward
  StudioFrame frame = StudioFrame::kFigure;

  friend bool operator==(const StudioView&, const StudioView&) = default;
};

// front, side, back, bust, face, three-quarter.
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

// As people stand about: at the beginning of their clip "idle" or "stand", at rest without.
StudioPose CalmPose(const human::Human& human);

struct StudioShot {
  cv::Mat picture;                // bgr, 8 bits
  std::vector<glm::vec2> joints;  // pixel of each joint of the skeleton, which may lie outside
};

// Everything happens on the thread that created it: its OpenGL context is current there.
class Studio {
 public:
  static Result<std::unique_ptr<Studio>> Create();
  ~Studio();

  // A person takes their place and strikes a pose; whoever sat there leaves. The person
  // must be valid (Human::Validate).
  Status Seat(const human::Human& human, const StudioPose& pose);

  // Whoever sits there. Somebody must.
  Result<StudioShot> Shoot(const StudioView& view, cv::Size size);

  // One picture of one person. bgr, 8 bits.
  Result<cv::Mat> Shoot(const human::Human& human,
                        const StudioPose& pose,
                        const StudioView& view,
                        cv::Size size);

 private:
  struct Sitter;

  Studio(render::OffscreenContext context, std::unique_ptr<render::Renderer> renderer);

  render::OffscreenContext context_;  // goes last
  std::unique_ptr<render::Renderer> renderer_;
  std::unique_ptr<Sitter> sitter_;
};

}  // namespace lararium::app
