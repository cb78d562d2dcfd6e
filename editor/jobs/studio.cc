#include "editor/jobs/studio.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>
#include <utility>

#include "shared/core/check.h"
#include "shared/core/units.h"
#include "shared/light/spherical_harmonics.h"
#include "shared/render/clip_space.h"
#include "shared/render/gl/render_target.h"
#include "shared/stage/object.h"

namespace lararium::editor {
namespace {
// The field of view of a portrait lens.
constexpr double kFieldOfView = 20.0 * std::numbers::pi / 180.0;
constexpr float kMargin = 1.06f;  // Factor of space around the subject.

// The properties of a person that determine the framing.
struct Figure {
  const human::Human& human;
  std::span<const glm::mat4> actor_from_joint;
  std::vector<std::vector<glm::vec3>> positions;  // The positions of each mesh as drawn.
  std::optional<size_t> skull;                    // Index of a joint.

  explicit Figure(const PosedPerson& person)
      : human(person.human()),
        actor_from_joint(person.actor_from_joint()),
        positions(person.ComputePositions()),
        skull(human.skeleton.Find("skullbase")) {}
};

// The region that the picture must contain, actor frame, metres.
struct Extent {
  glm::vec3 centre = glm::vec3(0.0f);
  float half_height = 1.0f;
  float half_width = 0.5f;
};

// Everything that is drawn of a person, centred on the person's vertical axis.
Extent WholeFigure(const Figure& person, float azimuth) {
  const glm::vec3 right(std::cos(azimuth), 0.0f, -std::sin(azimuth));
  float bottom = 1e9f;
  float top = -1e9f;
  float width = 0.0f;
  for (size_t i = 0; i < person.positions.size(); ++i) {
    for (const uint32_t vertex : person.human.meshes[i].indices) {
      const glm::vec3& position = person.positions[i][vertex];
      bottom = std::min(bottom, position.y);
      top = std::max(top, position.y);
      width = std::max(width, std::abs(glm::dot(position, right)));
    }
  }
  return {{0.0f, 0.5f * (bottom + top), 0.0f}, 0.5f * (top - bottom), width};
}

// Marks the head's joint and its descendants.
std::vector<bool> HeadJoints(const human::Skeleton& skeleton, size_t skull) {
  std::vector<bool> head(skeleton.size(), false);
  head[skull] = true;
  for (size_t joint = skull + 1; joint < skeleton.size(); ++joint) {
    const int16_t parent = skeleton.parents[joint];
    head[joint] = parent != human::Skeleton::kNoParent && head[static_cast<size_t>(parent)];
  }
  return head;
}

// The region around the head's joint, from a little below the chin to above the crown.
Extent Head(const Figure& person, float azimuth) {
  const Extent whole = WholeFigure(person, azimuth);
  if (!person.skull) {
    const float top = whole.centre.y + whole.half_height;
    const float half = 0.16f * whole.half_height;
    return {{whole.centre.x, top - half, whole.centre.z}, half, half};
  }
  const glm::vec3 base = person.actor_from_joint[*person.skull][3];
  const std::vector<bool> head = HeadJoints(person.human.skeleton, *person.skull);
  glm::vec3 sum(0.0f);
  float count = 0.0f;
  float top = base.y;
  for (size_t mesh = 0; mesh < person.positions.size(); ++mesh) {
    for (size_t v = 0; v < person.positions[mesh].size(); ++v) {
      if (head[person.human.meshes[mesh].joints[v][0]]) {
        sum += person.positions[mesh][v];
        count += 1.0f;
        top = std::max(top, person.positions[mesh][v].y);
      }
    }
  }
  if (count == 0.0f) {
    return {base, 0.2f, 0.2f};
  }
  const float height =
      std::clamp(top - base.y, 0.05f * whole.half_height, 0.2f * whole.half_height);
  const glm::vec3 middle = sum / count;
  return {{middle.x, base.y + 0.38f * height, middle.z}, 0.8f * height, 0.62f * height};
}

// Head, neck and shoulders. A figure without a head is shown as a whole.
Extent Bust(const Figure& person, float azimuth) {
  if (!person.skull) {
    return WholeFigure(person, azimuth);
  }
  Extent bust = Head(person, azimuth);
  bust.centre.y -= 0.42f * bust.half_height;
  bust.half_width *= 1.7f;
  bust.half_height *= 1.55f;
  return bust;
}

Extent Choose(StudioFrame frame, const Figure& person, float azimuth) {
  switch (frame) {
    case StudioFrame::kBust:
      return Bust(person, azimuth);
    case StudioFrame::kFace:
      return Head(person, azimuth);
    case StudioFrame::kFigure:
      break;
  }
  return WholeFigure(person, azimuth);
}

// An object as seen by a camera that looks down on it.
Extent WholeThing(const stage::ObjectModel& model, float elevation) {
  const glm::vec3 size = model.upper() - model.lower();
  const float across = glm::length(glm::vec2(size.x, size.z));
  const float tall = size.y * std::cos(elevation) + across * std::sin(elevation);
  return {model.centre(), 0.5f * tall, 0.5f * across};
}

// Adds light from one direction as spherical harmonics. irradiance: on a surface that faces the
// light.
void AddLight(const glm::vec3& direction, const glm::vec3& irradiance, light::ShRgb& light) {
  const auto basis = light::EvaluateShBasis(glm::normalize(direction));
  for (int i = 0; i < light::kShCount; ++i) {
    light[i] += irradiance * basis[i];
  }
}

// A key light from the viewer's left, a fill light from the right, a back light, and ambient light;
// the lights rotate with the viewer.
light::ShRgb StudioLight(float azimuth) {
  light::ShRgb light = {};
  light[0] = glm::vec3(0.34f) * std::sqrt(4.0f * kPiF);
  // In the front view the viewer stands towards -Z and has +X on the left.
  const auto turned = [azimuth](float to_left, float up, float to_viewer) {
    const glm::quat turn = glm::angleAxis(azimuth, glm::vec3(0.0f, 1.0f, 0.0f));
    return turn * glm::vec3(to_left, up, -to_viewer);
  };
  AddLight(turned(0.7f, 0.8f, 0.9f), kPiF * glm::vec3(0.62f, 0.59f, 0.55f), light);
  AddLight(turned(-0.9f, 0.2f, 0.7f), kPiF * glm::vec3(0.14f, 0.15f, 0.17f), light);
  AddLight(turned(-0.5f, 0.7f, -1.0f), kPiF * glm::vec3(0.30f, 0.31f, 0.33f), light);
  return light;
}

// Neutral grey, darker towards the corners.
cv::Mat Backdrop(cv::Size size) {
  cv::Mat backdrop(size, CV_8UC3);
  const float half_width = 0.5f * static_cast<float>(size.width);
  const float half_height = 0.5f * static_cast<float>(size.height);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const float dx = (static_cast<float>(x) - half_width) / half_width;
      const float dy = (static_cast<float>(y) - half_height) / half_height;
      const auto grey = static_cast<uint8_t>(150.0f - 18.0f * (dx * dx + dy * dy));
      backdrop.at<cv::Vec3b>(y, x) = {grey, grey, grey};
    }
  }
  return backdrop;
}

geometry::CameraModel StudioLens(cv::Size size) {
  const double focal = 0.5 * size.height / std::tan(0.5 * kFieldOfView);
  return {.width = size.width,
          .height = size.height,
          .fx = focal,
          .fy = focal,
          .cx = 0.5 * (size.width - 1),
          .cy = 0.5 * (size.height - 1)};
}

// The nearest camera from which the subject fits into the picture.
geometry::Rigid3 PlaceCamera(const Extent& subject, const StudioView& view, cv::Size size) {
  const float aspect = static_cast<float>(size.width) / static_cast<float>(size.height);
  const float half = kMargin * std::max(subject.half_height, subject.half_width / aspect);
  // Perspective enlarges the parts that are closer to the viewer.
  const float nearer = 0.3f * subject.half_height;
  const float distance = half / static_cast<float>(std::tan(0.5 * kFieldOfView)) + nearer;
  const float level = std::cos(view.elevation);
  // The person faces -Z and has the left side at -X.
  const glm::vec3 direction(-std::sin(view.azimuth) * level, std::sin(view.elevation),
                            -std::cos(view.azimuth) * level);
  const glm::vec3 eye = subject.centre + distance * direction;
  return render::LookAt({eye.x, eye.y, eye.z},
                        {subject.centre.x, subject.centre.y, subject.centre.z},
                        Eigen::Vector3d::UnitY());
}

render::RenderScene SceneFor(const Extent& subject, const StudioView& view, cv::Size size) {
  render::RenderScene scene;
  scene.background = Backdrop(size);
  scene.camera = scene.display = StudioLens(size);
  scene.camera_from_stage = PlaceCamera(subject, view, size);
  // A subject of any size lies between the planes of clipping.
  const glm::vec3& at = subject.centre;
  const Eigen::Vector3d from_camera = *scene.camera_from_stage * Eigen::Vector3d(at.x, at.y, at.z);
  const float distance = std::max(static_cast<float>(from_camera.norm()), 1e-3f);
  scene.near = 0.02f * distance;
  scene.far = 20.0f * distance;
  scene.light = StudioLight(view.azimuth);
  return scene;
}

}  // namespace

struct Studio::Sitter {
  PosedPerson person;
  render::ModelHandle model;
};

Result<StudioView> ParseStudioView(std::string_view name) {
  constexpr float kQuarter = 0.5f * kPiF;
  if (name == "front") return StudioView{};
  if (name == "side") return StudioView{.azimuth = kQuarter};
  if (name == "back") return StudioView{.azimuth = 2.0f * kQuarter};
  if (name == "bust") return StudioView{.frame = StudioFrame::kBust};
  if (name == "face") return StudioView{.frame = StudioFrame::kFace};
  if (name == "three-quarter") return StudioView{.azimuth = 0.4f * kQuarter, .elevation = 0.1f};
  return Status::Error("--view " + std::string(name), "is not a view",
                       "use front, side, back, bust, face or three-quarter");
}

StudioPose CalmPose(const human::Human& human) {
  constexpr std::array kCalmClips = {"idle", "stand"};
  StudioPose pose;
  for (const char* calm : kCalmClips) {
    for (size_t clip = 0; clip < human.clips.size() && pose.clip < 0; ++clip) {
      if (human.clips[clip].name == calm) {
        pose.clip = static_cast<int>(clip);
      }
    }
  }
  return pose;
}

Result<std::unique_ptr<Studio>> Studio::Create() {
  LARARIUM_ASSIGN_OR_RETURN(render::OffscreenContext context, render::CreateOffscreenContext());
  std::unique_ptr<Studio> studio(new Studio(std::move(context)));
  const render::DrawingTurn turn(studio->context_);
  LARARIUM_ASSIGN_OR_RETURN(studio->renderer_, render::Renderer::Create());
  return studio;
}

Studio::Studio(render::OffscreenContext context) : context_(std::move(context)) {}

Studio::~Studio() = default;

Status Studio::Seat(std::shared_ptr<const human::Human> human, const StudioPose& pose) {
  const render::DrawingTurn turn(context_);
  if (sitter_ != nullptr) {
    renderer_->RemoveModel(sitter_->model);
    sitter_ = nullptr;
  }
  LARARIUM_ASSIGN_OR_RETURN(const render::ModelHandle model, renderer_->AddHuman(human));
  sitter_ = std::make_unique<Sitter>(Sitter{PosedPerson(std::move(human), pose), model});
  return Status();
}

void Studio::SetShapes(std::span<const StudioPose::Shape> shapes) {
  CHECK(sitter_ != nullptr);
  sitter_->person.SetShapes(shapes);
}

Result<StudioShot> Studio::Shoot(const StudioView& view, cv::Size size) {
  CHECK(sitter_ != nullptr);
  const render::DrawingTurn turn(context_);
  const PosedPerson& person = sitter_->person;
  LARARIUM_ASSIGN_OR_RETURN(const render::RenderTarget target,
                            render::RenderTarget::Create(size.width, size.height));
  render::SceneHuman shown;
  shown.human = sitter_->model;
  shown.skin = person.skin();
  shown.vertices = person.vertices();
  render::RenderScene scene =
      SceneFor(Choose(view.frame, Figure(person), view.azimuth), view, size);
  scene.humans = {&shown, 1};
  LARARIUM_RETURN_IF_ERROR(renderer_->Draw(scene, target));
  StudioShot shot;
  target.ReadPixels(shot.picture);
  for (const glm::mat4& joint : person.actor_from_joint()) {
    const Eigen::Vector3d at =
        *scene.camera_from_stage * Eigen::Vector3d(joint[3].x, joint[3].y, joint[3].z);
    const std::optional<Eigen::Vector2d> pixel = scene.display.Project(at);
    shot.joints.push_back(pixel ? glm::vec2(pixel->x(), pixel->y()) : glm::vec2(-1e6f));
  }
  return shot;
}

Result<cv::Mat> Studio::ShootThing(const std::shared_ptr<const stage::ObjectModel>& model,
                                   cv::Size size,
                                   const StudioView& view) {
  const render::DrawingTurn turn(context_);
  LARARIUM_ASSIGN_OR_RETURN(const render::RenderTarget target,
                            render::RenderTarget::Create(size.width, size.height));
  LARARIUM_ASSIGN_OR_RETURN(
      const render::ModelHandle handle,
      renderer_->AddProp(std::shared_ptr<const stage::Prop>(model, &model->prop())));
  stage::Object thing;
  thing.model = model;
  std::vector<glm::mat4> stage_from_part(model->prop().parts.size());
  std::vector<uint8_t> shown(stage_from_part.size());
  stage::ComputeParts(*model, stage::InitialState(thing), {}, stage_from_part, shown);
  render::SceneProp prop;
  prop.prop = handle;
  prop.stage_from_part = stage_from_part;
  prop.shown = shown;
  render::RenderScene scene = SceneFor(WholeThing(*model, view.elevation), view, size);
  scene.props = {&prop, 1};
  const Status drawn = renderer_->Draw(scene, target);
  renderer_->RemoveModel(handle);
  LARARIUM_RETURN_IF_ERROR(drawn);
  cv::Mat picture;
  target.ReadPixels(picture);
  return picture;
}

}  // namespace lararium::editor
