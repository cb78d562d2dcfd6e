#include "editor/panels/around_view.h"

#include <imgui.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <random>
#include <utility>

#include "editor/panels/align_panel.h"
#include "editor/panels/check_point_panel.h"
#include "editor/panels/frame_damage.h"
#include "editor/panels/gizmo_view.h"
#include "editor/panels/text.h"
#include "editor/panels/theme.h"
#include "editor/panels/widgets.h"
#include "shared/geometry/glm_convert.h"
#include "shared/human/human.h"
#include "shared/human/skinning.h"

namespace lararium::panels {

namespace {

using Eigen::Vector3d;
using geometry::Rigid3;
using geometry::Similarity3;

constexpr glm::u8vec4 kCameraColour(150, 156, 166, 255);
constexpr glm::u8vec4 kPathColour(110, 116, 128, 255);
constexpr glm::u8vec4 kGridColour(62, 67, 77, 255);
constexpr glm::u8vec4 kFloorColour(110, 170, 150, 28);
constexpr glm::u8vec4 kLiveColour(217, 107, 73, 255);

glm::u8vec4 Bytes(const ImVec4& c, float alpha = 1.0f) {
  return glm::u8vec4(glm::vec4(c.x, c.y, c.z, alpha) * 255.0f + 0.5f);
}

// Each point as grey as its first sight in a training image.
std::vector<uint8_t> PointShades(const vision::SceneDatabase& database) {
  constexpr uint8_t kUnseen = 128;
  std::vector<uint8_t> shades(database.points.size(), kUnseen);
  std::vector<bool> seen(database.points.size(), false);
  for (const vision::Observation& observation : database.observations) {
    const cv::Mat& grey = database.keyframes[observation.keyframe].grey;
    const int x = static_cast<int>(std::lround(observation.x));
    const int y = static_cast<int>(std::lround(observation.y));
    if (!seen[observation.point] && x >= 0 && y >= 0 && x < grey.cols && y < grey.rows) {
      seen[observation.point] = true;
      shades[observation.point] = grey.at<uint8_t>(y, x);
    }
  }
  return shades;
}

void AddLine(std::vector<render::OverlayLine>& lines,
             const Vector3d& from,
             const Vector3d& to,
             glm::u8vec4 packed) {
  lines.push_back({geometry::ToGlm(from), geometry::ToGlm(to), packed});
}

void AddFrustum(std::vector<render::OverlayLine>& lines,
                const geometry::CameraModel& camera,
                const Rigid3& camera_from_world,
                double depth,
                glm::u8vec4 packed) {
  const Rigid3 world_from_camera = camera_from_world.Inverse();
  const double half_x = 0.5 * camera.width / camera.fx * depth;
  const double half_y = 0.5 * camera.height / camera.fy * depth;
  const Vector3d eye = world_from_camera.translation;
  const Vector3d corners[] = {{-half_x, -half_y, depth},
                              {half_x, -half_y, depth},
                              {half_x, half_y, depth},
                              {-half_x, half_y, depth}};
  for (int i = 0; i < 4; ++i) {
    const Vector3d corner = world_from_camera * corners[i];
    AddLine(lines, eye, corner, packed);
    AddLine(lines, corner, world_from_camera * corners[(i + 1) % 4], packed);
  }
}

void AddStage(std::vector<render::OverlayLine>& lines, const Similarity3& world_from_stage) {
  constexpr int kHalf = 5;  // metres
  for (int i = -kHalf; i <= kHalf; ++i) {
    AddLine(lines, world_from_stage * Vector3d(i, 0, -kHalf),
            world_from_stage * Vector3d(i, 0, kHalf), kGridColour);
    AddLine(lines, world_from_stage * Vector3d(-kHalf, 0, i),
            world_from_stage * Vector3d(kHalf, 0, i), kGridColour);
  }
  for (int axis = 0; axis < 3; ++axis) {
    AddLine(lines, world_from_stage.translation, world_from_stage * Vector3d::Unit(axis),
            Bytes(kAxisColours[axis]));
  }
}

}  // namespace

Result<std::unique_ptr<AroundView>> AroundView::Create() {
  LARARIUM_ASSIGN_OR_RETURN(std::unique_ptr<render::Overlay> overlay, render::Overlay::Create());
  return std::unique_ptr<AroundView>(new AroundView(std::move(overlay)));
}

AroundView::AroundView(std::unique_ptr<render::Overlay> overlay) : overlay_(std::move(overlay)) {}

AroundView::~AroundView() = default;

void AroundView::UpdateMap(const app::LoadedPlace& loaded) {
  if (loaded.database == database_ && loaded.picks.map_from_picked == map_from_picked_) {
    return;
  }
  framed_ = framed_ && loaded.database == database_;
  database_ = loaded.database;
  map_from_picked_ = loaded.picks.map_from_picked;
  points_.clear();
  cameras_.clear();
  outdated_ = true;
  moving_points_.reset();
  if (database_ == nullptr) {
    return;
  }
  const Similarity3 picked_from_map = map_from_picked_.Inverse();
  const std::vector<uint8_t> shades = PointShades(*database_);
  for (size_t i = 0; i < shades.size(); ++i) {
    // Lifted a little, so that dark points stand out from the background.
    const auto shade = static_cast<uint8_t>(70 + shades[i] * 185 / 255);
    const Vector3d at = picked_from_map * database_->points[i].cast<double>();
    points_.push_back({geometry::ToGlm(at), glm::u8vec4(shade, shade, shade, 255)});
  }
  std::shuffle(points_.begin(), points_.end(), std::mt19937(1));
  constexpr double kFrustumDepth = 0.12;  // metres
  constexpr size_t kMaxFrusta = 60;
  const size_t step = database_->keyframes.size() / kMaxFrusta + 1;
  std::optional<Vector3d> previous;
  for (size_t i = 0; i < database_->keyframes.size(); ++i) {
    const Rigid3 camera_from_picked =
        geometry::CameraFromB(database_->keyframes[i].camera_from_map, map_from_picked_);
    const Vector3d center = camera_from_picked.Center();
    if (previous) {
      AddLine(cameras_, *previous, center, kPathColour);
    }
    previous = center;
    if (i % step == 0) {
      AddFrustum(cameras_, database_->camera, camera_from_picked, kFrustumDepth, kCameraColour);
    }
  }
}

void AroundView::UpdateOccluders(const app::Workspace& workspace) {
  const std::shared_ptr<const stage::Place>& staged = workspace.loaded().staged;
  static const std::vector<stage::Occluder> kNone;
  const std::vector<stage::Occluder>& wanted = staged != nullptr ? staged->occluders : kNone;
  const std::vector<stage::Occluder>& known = staged_ != nullptr ? staged_->occluders : kNone;
  const bool same = staged == staged_ ||
                    std::equal(wanted.begin(), wanted.end(), known.begin(), known.end(),
                               [](const stage::Occluder& a, const stage::Occluder& b) {
                                 return a.name == b.name && a.mesh.positions == b.mesh.positions &&
                                        a.mesh.indices == b.mesh.indices;
                               });
  staged_ = staged;
  if (same) {
    return;
  }
  for (const Ghost& ghost : occluders_) {
    overlay_->RemoveMesh(ghost.mesh);
  }
  occluders_.clear();
  for (const stage::Occluder& occluder : wanted) {
    occluders_.push_back({occluder.name, overlay_->AddMesh(occluder.mesh)});
  }
}

void AroundView::UpdateActors(const app::Workspace& workspace) {
  if (workspace.picture() == actors_of_) {
    return;
  }
  actors_of_ = workspace.picture();
  for (const auto& [mesh, transform] : actors_) {
    overlay_->RemoveMesh(mesh);
  }
  actors_.clear();
  if (actors_of_ == nullptr) {
    return;
  }
  for (const app::PreviewActor& actor : actors_of_->actors) {
    for (const human::SkinnedMesh& part : actor.human->meshes) {
      geometry::TriangleMesh mesh;
      mesh.positions.resize(part.positions.size());
      mesh.normals.resize(part.positions.size());
      mesh.indices = part.indices;
      human::SkinMesh(part, actor.skin, mesh.positions, mesh.normals);
      actors_.emplace_back(overlay_->AddMesh(mesh), actor.stage_from_actor);
    }
  }
}

// A faint square on the floor that was found in the map, about its points.
void AroundView::AddFloor(const app::LoadedPlace& loaded) {
  if (!loaded.measures.floor) {
    return;
  }
  if (!floor_) {
    geometry::TriangleMesh square;
    square.positions = {{-1, 0, -1}, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}};
    square.normals.assign(4, {0, 1, 0});
    square.indices = {0, 1, 2, 0, 2, 3};
    floor_ = overlay_->AddMesh(square);
  }
  const train::FloorPlane& floor = *loaded.measures.floor;
  const Similarity3 map_from_floor{
      2.0 * floor.radius, Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitY(), floor.normal),
      floor.center};
  const Similarity3 world_from_floor = loaded.picks.map_from_picked.Inverse() * map_from_floor;
  scene_.meshes.push_back({*floor_, geometry::ToGlm(world_from_floor), kFloorColour});
}

void AroundView::AddMeshes(const app::Workspace& workspace, const EditorState& state) {
  const app::PlaceDocument& place = *workspace.place();
  const glm::mat4 world_from_stage = geometry::ToGlm(place.picked_from_stage);
  for (const auto& [mesh, stage_from_actor] : actors_) {
    scene_.meshes.push_back(
        {mesh, world_from_stage * stage_from_actor, glm::u8vec4(225, 214, 196, 255)});
  }
  for (const Ghost& ghost : occluders_) {
    const Selection selection{Selection::Kind::kOccluder, ghost.name};
    const Similarity3 transform = WorldFromOccluder(workspace, ghost.name);
    const bool selected = state.selection == selection;
    scene_.meshes.push_back(
        {ghost.mesh, geometry::ToGlm(transform),
         selected ? glm::u8vec4(217, 107, 73, 60) : glm::u8vec4(120, 150, 190, 44)});
  }
}

Status AroundView::Draw(const app::Workspace& workspace,
                        const EditorState& state,
                        const ViewCamera& view,
                        int width,
                        int height) {
  if (!target_ || target_->width() != width || target_->height() != height) {
    LARARIUM_ASSIGN_OR_RETURN(target_, render::RenderTarget::Create(width, height));
    outdated_ = true;
  }
  render::OverlayView& overlay_view = scene_.view;
  overlay_view.display.width = width;
  overlay_view.display.height = height;
  overlay_view.display.fx = view.focal_x;
  overlay_view.display.fy = view.focal_y;
  overlay_view.display.cx = 0.5 * (width - 1);
  overlay_view.display.cy = 0.5 * (height - 1);
  overlay_view.camera_from_stage = view.camera_from_world;
  overlay_view.near = static_cast<float>(std::max(0.005 * state.orbit.distance, 1e-3));
  overlay_view.far = static_cast<float>(1000.0 * state.orbit.distance);
  overlay_view.clear = glm::vec3(0.075f, 0.082f, 0.094f);

  scene_.pixel = Px(1.0f);
  scene_.lines.clear();
  scene_.meshes.clear();
  const app::PlaceDocument* place = workspace.place();
  scene_.has_place = place != nullptr;
  scene_.points = state.show_points;
  if (place != nullptr) {
    AddStage(scene_.lines, place->picked_from_stage);
    const auto& picture = workspace.picture();
    if (picture != nullptr && picture->camera_from_stage) {
      AddFrustum(
          scene_.lines, picture->display,
          geometry::CameraFromB(*picture->camera_from_stage, place->picked_from_stage.Inverse()),
          0.35, kLiveColour);
    }
    AddFloor(workspace.loaded());
    AddMeshes(workspace, state);
  }
  if (scene_.points && !points_.empty() && !moving_points_) {
    MeasurePoints();
  }
  const bool moves = !outdated_ && scene_.view != drawn_.view;
  if (outdated_ || scene_ != drawn_ || (thinned_ && !moves)) {
    const size_t points =
        moves ? std::min(moving_points_.value_or(0), points_.size()) : points_.size();
    DrawScene(points);
    drawn_ = scene_;
    outdated_ = false;
    thinned_ = points < points_.size();
    ++version_;
  }
  return Status();
}

void AroundView::MeasurePoints() {
  constexpr double kMovingBudget = 0.005;  // seconds
  constexpr size_t kLeast = 2000;
  const auto seconds_of = [&](size_t points) {
    render::RenderTarget::Finish();
    const auto begin = std::chrono::steady_clock::now();
    DrawScene(points);
    render::RenderTarget::Finish();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  seconds_of(0);  // what is compiled when it is first used
  const double without = seconds_of(0);
  const double per_point =
      std::max(seconds_of(points_.size()) - without, 1e-6) / static_cast<double>(points_.size());
  moving_points_ = std::max(static_cast<size_t>(kMovingBudget / per_point), kLeast);
}

void AroundView::DrawScene(size_t points) {
  overlay_->Begin(scene_.view, *target_);
  if (scene_.has_place) {
    overlay_->DrawLines(scene_.lines, 1.5f * scene_.pixel);
    overlay_->DrawLines(cameras_, scene_.pixel);
    if (scene_.points) {
      overlay_->DrawPoints(std::span(points_).first(points), 2.5f * scene_.pixel);
    }
    for (const MeshDraw& mesh : scene_.meshes) {
      const Status status = overlay_->DrawMesh(mesh.mesh, mesh.world_from_mesh, mesh.colour);
      CHECK(status.ok());  // the meshes are our own
    }
  }
  overlay_->End();
}

void AroundView::Interact(EditorState& state,
                          bool hovered,
                          bool gizmo_busy,
                          const Eigen::Vector2d& size) {
  const ImGuiIO& io = ImGui::GetIO();
  const Eigen::Vector2d delta = ToEigen(io.MouseDelta);
  if (ImGui::IsItemActive() && !gizmo_busy) {
    if (ImGui::IsMouseDown(ImGuiMouseButton_Left) && !io.KeyShift) {
      state.orbit.Orbit(delta, size.x());
    } else {
      state.orbit.Pan(delta, size.y());
    }
  }
  if (hovered && io.MouseWheel != 0.0f) {
    state.orbit.Zoom(io.MouseWheel);
  }
}

void AroundView::Show(app::Workspace& workspace, EditorState& state) {
  UpdateMap(workspace.loaded());
  UpdateOccluders(workspace);
  UpdateActors(workspace);
  if (!framed_ && database_ != nullptr) {
    framed_ = true;
    state.orbit = OrbitCamera();
    state.orbit.target = Vector3d(0.0, 0.9, -0.5);
    state.orbit.distance = 7.0;
  }
  const ImVec2 origin = ImGui::GetCursorScreenPos();
  const ImVec2 size = ImGui::GetContentRegionAvail();
  const int width = std::max(static_cast<int>(size.x), 16);
  const int height = std::max(static_cast<int>(size.y), 16);
  const ViewCamera view = state.orbit.View(ToEigen(origin), Eigen::Vector2d(width, height));
  ImGui::InvisibleButton("around", ImVec2(static_cast<float>(width), static_cast<float>(height)),
                         ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight |
                             ImGuiButtonFlags_MouseButtonMiddle);
  const bool hovered = ImGui::IsItemHovered();
  const bool active = ImGui::IsItemActive();
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  if (const Status status = Draw(workspace, state, view, width, height); !status.ok()) {
    draw.AddText(origin, Packed(OverPicture().error), status.message().c_str());
    return;
  }
  const ImVec2 corner(origin.x + static_cast<float>(width), origin.y + static_cast<float>(height));
  draw.AddImage(TextureOf(target_->texture(), version_), origin, corner);
  draw.PushClipRect(origin, corner, true);
  DrawCheckPoints(workspace, state, view, draw);
  const bool was_dragging = state.drag.has_value();
  const bool picking = ShowModelPoints(workspace, state, view, hovered, draw);
  const bool busy = ShowGizmo(workspace, state, view, hovered && !picking, draw) &&
                    (state.drag.has_value() || was_dragging || !active);
  const char* keys = Tr("Drag to orbit, Shift or right drag to pan, wheel to zoom");
  const float wrap = size.x - Px(24);
  const float tall = ImGui::CalcTextSize(keys, nullptr, false, wrap).y;
  draw.AddText(ImGui::GetFont(), ImGui::GetFontSize(),
               ImVec2(origin.x + Px(12), corner.y - Px(10) - tall), Packed(OverPicture().dim), keys,
               nullptr, wrap);
  draw.PopClipRect();
  Interact(state, hovered, busy, ToEigen(size));
}

}  // namespace lararium::panels
