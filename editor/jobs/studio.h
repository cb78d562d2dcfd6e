#pragma once

// An offscreen studio with a grey background and soft light, for pictures of people.

#include <glm/vec2.hpp>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "editor/jobs/posed_person.h"
#include "shared/core/status.h"
#include "shared/human/human.h"
#include "shared/render/gl/graphics_context.h"
#include "shared/render/renderer.h"
#include "shared/stage/object_use.h"

namespace lararium::editor {

// The part of a person that a picture shows.
enum class StudioFrame {
  kFigure,  // Head to foot.
  kBust,    // Head and shoulders.
  kFace,
};

// The direction and the framing of a picture.
struct StudioView {
  float azimuth = 0.0f;    // Radians; 0 shows the front, pi/2 the person's left side.
  float elevation = 0.0f;  // Radians; above 0 the camera is higher.
  StudioFrame frame = StudioFrame::kFigure;

  friend bool operator==(const StudioView&, const StudioView&) = default;
};

inline constexpr StudioView kObliquely = {.azimuth = 0.6f, .elevation = 0.4f};

// name: one of front, side, back, bust, face, three-quarter.
Result<StudioView> ParseStudioView(std::string_view name);

// A relaxed pose: the beginning of the clip "idle" or "stand", or idle motion where the person has
// neither.
StudioPose CalmPose(const human::Human& human);

struct StudioShot {
  cv::Mat picture;  // bgr, 8 bits
  // Projection of each joint of the skeleton, pixels; it can lie outside the picture.
  std::vector<glm::vec2> joints;
};

// Use it only on the thread that created it: its OpenGL context is current there.
class Studio {
 public:
  static Result<std::unique_ptr<Studio>> Create();
  ~Studio();

  // Loads a person in a pose (PosedPerson) and replaces the one before. The person must be valid
  // (Human::Validate).
  Status Seat(std::shared_ptr<const human::Human> human, const StudioPose& pose);

  // Changes the face of the loaded person. A person must be loaded.
  void SetShapes(std::span<const StudioPose::Shape> shapes);

  // Takes a picture of the loaded person. A person must be loaded.
  Result<StudioShot> Shoot(const StudioView& view, cv::Size size);

  // A picture of an object alone in its state at the beginning of a drama, as large as fits; bgr,
  // The image has 8 bits a channel. The frame of the view is not used. The loaded person stays.
  Result<cv::Mat> ShootThing(const std::shared_ptr<const stage::ObjectModel>& model,
                             cv::Size size,
                             const StudioView& view = kObliquely);

 private:
  struct Sitter;

  explicit Studio(render::OffscreenContext context);

  render::OffscreenContext context_;  // The first member, so that it is destroyed last.
  std::unique_ptr<render::Renderer> renderer_;
  std::unique_ptr<Sitter> sitter_;
};

}  // namespace lararium::editor
