#pragma once

// A grey room with soft light in which people are looked at, off screen.

#include <glm/vec2.hpp>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "editor/app/posed_person.h"
#include "shared/core/status.h"
#include "shared/human/human.h"
#include "shared/render/graphics_context.h"
#include "shared/render/renderer.h"
#include "shared/stage/object_use.h"

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

// As people stand about: at the beginning of their clip "idle" or "stand", by themselves without.
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

  // A person takes their place and strikes a pose (PosedPerson); whoever sat there leaves.
  // The person must be valid (Human::Validate).
  Status Seat(std::shared_ptr<const human::Human> human, const StudioPose& pose);

  // Whoever sits there makes another face. Somebody must sit there.
  void SetShapes(std::span<const StudioPose::Shape> shapes);

  // Likewise.
  Result<StudioShot> Shoot(const StudioView& view, cv::Size size);

  // A thing by itself as it is at the beginning of a drama, from above and aside, as large as fits;
  // bgr, 8 bits. Whoever sits there stays.
  Result<cv::Mat> ShootThing(const std::shared_ptr<const stage::ObjectModel>& model, cv::Size size);

 private:
  struct Sitter;

  Studio(render::OffscreenContext context, std::unique_ptr<render::Renderer> renderer);

  render::OffscreenContext context_;  // goes last
  std::unique_ptr<render::Renderer> renderer_;
  std::unique_ptr<Sitter> sitter_;
};

}  // namespace lararium::app
