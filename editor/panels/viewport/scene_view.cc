#include "editor/panels/viewport/scene_view.h"

#include <imgui.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <random>
#include <utility>

#include "editor/panels/viewport/align_panel.h"
#include "editor/panels/viewport/check_point_panel.h"
#include "editor/panels/viewport/gizmo_view.h"
#include "editor/panels/viewport/overlay_mesh.h"
#include "editor/panels/viewport/scene_view_style.h"
#include "editor/panels/widgets/frame_damage.h"
#include "editor/panels/widgets/text.h"
#include "editor/panels/widgets/theme.h"
#include "editor/panels/widgets/widgets.h"
#include "shared/geometry/glm_convert.h"
#include "shared/geometry/transform.h"
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

constexpr double kFrustumDepth = 0.12;  // metres
constexpr float kPointPx = 2.5f;        // Diameter, logical pixels.

glm::u8vec4 Bytes(const ImVec4& c, float alpha = 1.0f) {
  return glm::u8vec4(glm::vec4(c.x, c.y, c.z, alpha) * 255.0f + 0.5f);
}

void AddLine(std::vector<render::OverlayLine>& lines,
             const Vector3d& from,
             const Vector3d& to,
             glm::u8vec4 packed) {
  lines.push_back({geometry::ToGlm(from), geometry::ToGlm(to), packed});
}

void AddFrustum(std::vector<render::OverlayLine>& lines,
                const Frustum& frustum,
                glm::u8vec4 packed) {
  for (int i = 0; i < 4; ++i) {
    AddLine(lines, frustum.eye, frustum.corners[i], packed);
    AddLine(lines, frustum.corners[i], frustum.corners[(i + 1) % 4], packed);
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

Result<std::unique_ptr<SceneView>> SceneView::Create() {
  LARARIUM_ASSIGN_OR_RETURN(std::unique_ptr<render::Overlay> overlay, render::Overlay::Create());
  return std::unique_ptr<SceneView>(new SceneView(std::move(overlay)));
}

SceneView::SceneView(std::unique_ptr<render::Overlay> overlay) : overlay_(std::move(overlay)) {}

SceneView::~SceneView() = default;

void SceneView::UpdateMap(const editor::LoadedMap& loaded, PlaceView& place_view) {
  if (loaded.database == database_ && loaded.picks.map_from_picked == map_from_picked_) {
    return;
  }
  // A map that only got another image keeps the viewpoint.
  const bool same_points = database_ != nullptr && loaded.database != nullptr &&
                           loaded.database->points == database_->points;
  if (!same_points) {
    framed_ = false;
    ChooseNoPoints(place_view);
  }
  database_ = loaded.database;
  map_from_picked_ = loaded.picks.map_from_picked;
  points_.clear();
  order_.clear();
  keyframes_.clear();
  colours_.reset();
  moving_points_.reset();
  if (database_ == nullptr) {
    return;
  }
  const Similarity3 picked_from_map = map_from_picked_.Inverse();
  for (const Eigen::Vector3f& point : database_->points) {
    order_.push_back(static_cast<uint32_t>(points_.size()));
    points_.push_back((picked_from_map * point.cast<double>()).cast<float>());
  }
  std::shuffle(order_.begin(), order_.end(), std::mt19937(1));
  constexpr size_t kMaxFrusta = 60;
  const size_t step = database_->keyframes.size() / kMaxFrusta + 1;
  for (uint32_t k = 0; k < database_->keyframes.size(); ++k) {
    const Rigid3 camera_from_picked =
        geometry::CameraFromB(database_->keyframes[k].camera_from_map, map_from_picked_);
    Camera& camera = keyframes_.emplace_back(Camera{k, camera_from_picked.Center(), {}});
    if (k % step == 0) {
      camera.frustum.emplace(database_->camera, camera_from_picked, kFrustumDepth);
    }
  }
}

void SceneView::UpdateColours(const editor::LoadedMap& loaded, PlaceView& place) {
  if (colours_ == place.colours) {
    return;
  }
  colours_ = place.colours;
  outdated_ = true;
  if (uploaded_) {
    overlay_->RemovePoints(*uploaded_);
    uploaded_.reset();
  }
  cameras_.clear();
  if (database_ == nullptr) {
    return;
  }
  place.range = RangeOf(*loaded.statistics, place.colours);
  const std::vector<glm::u8vec4> of_points = ColoursOf(*loaded.statistics, place.colours);
  std::vector<render::OverlayPoint> points;
  points.reserve(order_.size());
  for (const uint32_t point : order_) {
    const Eigen::Vector3f& at = points_[point];
    points.push_back({glm::vec3(at.x(), at.y(), at.z()), of_points[point]});
  }
  uploaded_ = overlay_->AddPoints(points);
  AddCameras(loaded, place.colours);
}

// Adds the path of each session and its frusta.
void SceneView::AddCameras(const editor::LoadedMap& loaded, PointColour colours) {
  const auto session = [&](size_t k) { return loaded.database->keyframes[k].session; };
  for (size_t k = 0; k < keyframes_.size(); ++k) {
    const bool by_session = colours == PointColour::kSessions;
    if (k > 0 && session(k) == session(k - 1)) {
      AddLine(cameras_, keyframes_[k - 1].center, keyframes_[k].center,
              by_session ? Bytes(SessionColour(session(k)), 0.6f) : kPathColour);
    }
    if (keyframes_[k].frustum) {
      AddFrustum(cameras_, *keyframes_[k].frustum,
                 by_session ? Bytes(SessionColour(session(k))) : kCameraColour);
    }
  }
}

void SceneView::UpdateOccluders(const editor::Workspace& workspace) {
  const std::shared_ptr<const stage::Place>& staged = workspace.preview().staged();
  static const std::vector<stage::Occluder> kNone;
  const std::vector<stage::Occluder>& wanted = staged != nullptr ? staged->occluders : kNone;
  const std::vector<stage::Occluder>& known = staged_ != nullptr ? staged_->occluders : kNone;
  const bool same =
      staged == staged_ || std::equal(wanted.begin(), wanted.end(), known.begin(), known.end(),
                                      [](const stage::Occluder& a, const stage::Occluder& b) {
                                        return a.name == b.name && SameMesh(a.mesh, b.mesh);
                                      });
  staged_ = staged;
  if (same) {
    return;
  }
  for (const OverlayMesh& overlay : occluders_) {
    overlay_->RemoveMesh(overlay.mesh);
  }
  occluders_.clear();
  for (const stage::Occluder& occluder : wanted) {
    occluders_.push_back({occluder.name, overlay_->AddMesh(occluder.mesh)});
  }
}

void SceneView::UpdateActors(const editor::Workspace& workspace) {
  if (workspace.preview().picture() == actors_of_) {
    return;
  }
  actors_of_ = workspace.preview().picture();
  for (const auto& [mesh, transform] : actors_) {
    overlay_->RemoveMesh(mesh);
  }
  actors_.clear();
  if (actors_of_ == nullptr) {
    return;
  }
  for (const editor::PreviewActor& actor : actors_of_->actors) {
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

// Adds a faint square on the floor that was found in the map, below its points.
void SceneView::AddFloor(const editor::LoadedMap& loaded) {
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
      2.0 * floor.radius, geometry::RotationBetween(floor.normal, Vector3d::UnitY()), floor.center};
  const Similarity3 world_from_floor = loaded.picks.map_from_picked.Inverse() * map_from_floor;
  scene_.meshes.push_back({*floor_, geometry::ToGlm(world_from_floor), kFloorColour});
}

void SceneView::AddMeshes(const editor::Workspace& workspace, const Selection& selection) {
  const editor::PlaceDocument& place = *workspace.project().place();
  const glm::mat4 world_from_stage = geometry::ToGlm(place.picked_from_stage);
  for (const auto& [mesh, stage_from_actor] : actors_) {
    scene_.meshes.push_back(
        {mesh, world_from_stage * stage_from_actor, glm::u8vec4(225, 214, 196, 255)});
  }
  for (const OverlayMesh& overlay : occluders_) {
    const Similarity3 transform = WorldFromOccluder(workspace, overlay.name);
    const bool selected = selection == Selection{Selection::Kind::kOccluder, overlay.name};
    scene_.meshes.push_back(
        {overlay.mesh, geometry::ToGlm(transform),
         selected ? glm::u8vec4(217, 107, 73, 60) : glm::u8vec4(120, 150, 190, 44)});
  }
}

Status SceneView::Draw(const editor::Workspace& workspace,
                       const Selection& selection,
                       const ViewOptions& options,
                       const PlaceView& place_view,
                       const ViewCamera& view,
                       int width,
                       int height) {
  if (!target_ || target_->width() != width || target_->height() != height) {
    LARARIUM_ASSIGN_OR_RETURN(
        target_,
        render::RenderTarget::Create(width, height, render::RenderTarget::Depth::kForOverlay));
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
  overlay_view.near = static_cast<float>(std::max(0.005 * place_view.orbit.distance, 1e-3));
  overlay_view.far = static_cast<float>(1000.0 * place_view.orbit.distance);
  overlay_view.clear = glm::vec3(0.075f, 0.082f, 0.094f);

  scene_.pixel = Px(1.0f);
  scene_.lines.clear();
  scene_.meshes.clear();
  const editor::PlaceDocument* place = workspace.project().place();
  scene_.has_place = place != nullptr;
  scene_.points = options.show_points;
  if (place != nullptr) {
    AddStage(scene_.lines, place->picked_from_stage);
    const auto& picture = workspace.preview().picture();
    if (picture != nullptr && picture->camera_from_stage) {
      const Rigid3 camera_from_world =
          geometry::CameraFromB(*picture->camera_from_stage, place->picked_from_stage.Inverse());
      AddFrustum(scene_.lines, Frustum(picture->display, camera_from_world, 0.35), kLiveColour);
    }
    AddFloor(workspace.map().loaded());
    AddMeshes(workspace, selection);
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

void SceneView::MeasurePoints() {
  constexpr double kMovingBudget = 0.003;  // seconds
  constexpr size_t kLeast = 2000;
  const auto seconds_of = [&](size_t points) {
    render::RenderTarget::Finish();
    const auto begin = std::chrono::steady_clock::now();
    DrawScene(points);
    render::RenderTarget::Finish();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  seconds_of(0);  // Excludes compilation at the first use.
  const double without = seconds_of(0);
  const double per_point =
      std::max(seconds_of(points_.size()) - without, 1e-6) / static_cast<double>(points_.size());
  moving_points_ = std::max(static_cast<size_t>(kMovingBudget / per_point), kLeast);
}

void SceneView::DrawScene(size_t points) {
  overlay_->Begin(scene_.view, *target_);
  if (scene_.has_place) {
    overlay_->DrawLines(scene_.lines, 1.5f * scene_.pixel);
    overlay_->DrawLines(cameras_, scene_.pixel);
    if (scene_.points && uploaded_) {
      const Status status = overlay_->DrawPoints(*uploaded_, points, kPointPx * scene_.pixel);
      CHECK(status.ok());  // They were uploaded here.
    }
    for (const MeshDraw& mesh : scene_.meshes) {
      const Status status = overlay_->DrawMesh(mesh.mesh, mesh.world_from_mesh, mesh.colour);
      CHECK(status.ok());  // They were uploaded here.
    }
  }
  overlay_->End();
}

std::optional<uint32_t> SceneView::KeyframeBelow(const ViewCamera& view,
                                                 const Eigen::Vector2d& pixel) const {
  const double kCenterPx = Px(7);
  const double kLinePx = Px(4);
  std::optional<uint32_t> below;
  double nearest = std::numeric_limits<double>::infinity();
  for (const Camera& camera : keyframes_) {
    const std::optional<Eigen::Vector2d> center = view.Project(camera.center);
    const double depth = (view.camera_from_world * camera.center).z();
    if (!center || depth >= nearest) {
      continue;
    }
    if ((*center - pixel).norm() < kCenterPx ||
        (camera.frustum && DistancePx(*camera.frustum, view, pixel) < kLinePx)) {
      nearest = depth;
      below = camera.keyframe;
    }
  }
  return below;
}

void SceneView::Point(editor::Workspace& workspace,
                      ViewOptions& options,
                      PickTarget& picks,
                      PlaceView& place_view,
                      PictureTextures& pictures,
                      const ViewCamera& view,
                      bool hovered,
                      ImDrawList& draw) {
  const Eigen::Vector2d pointer = ToEigen(ImGui::GetMousePos());
  const bool pressed = pressed_.has_value();
  const bool clicked = pressed && !ImGui::IsMouseDown(ImGuiMouseButton_Left) &&
                       (pointer - *pressed_).norm() < Px(kClickPx);
  if (pressed && !ImGui::IsMouseDown(ImGuiMouseButton_Left)) {
    pressed_.reset();
  }
  if (database_ == nullptr || !hovered || (pressed && !clicked)) {
    return;
  }
  std::optional<uint32_t> keyframe;
  if (!place_view.measure && !ImGui::GetIO().KeyShift) {
    keyframe = KeyframeBelow(view, pointer);
  }
  if (keyframe && clicked) {
    picks.keyframe = static_cast<int>(*keyframe);
    options.view = ViewKind::kPicks;
  } else if (keyframe) {
    const vision::Keyframe& shown = database_->keyframes[*keyframe];
    const Frustum frustum(database_->camera,
                          geometry::CameraFromB(shown.camera_from_map, map_from_picked_),
                          kFrustumDepth);
    for (int i = 0; i < 4; ++i) {
      const ImU32 packed = Packed(OverPicture().accent);
      DrawWorldLine(view, frustum.eye, frustum.corners[i], packed, Px(2), draw);
      DrawWorldLine(view, frustum.corners[i], frustum.corners[(i + 1) % 4], packed, Px(2), draw);
    }
    card_.Show(workspace, pictures, *keyframe);
  } else if (clicked) {
    const bool add =
        ImGui::GetIO().KeyShift || (place_view.measure && place_view.points.size() == 1);
    const std::optional<uint32_t> point =
        options.show_points ? PointBelow(points_, view, pointer, Px(kPointPx), Px(8))
                            : std::nullopt;
    ChoosePoint(point, add, place_view.points);
    place_view.metres = 0.0;
  }
}

void SceneView::Interact(PlaceView& place_view,
                         bool hovered,
                         bool active,
                         const Eigen::Vector2d& size) {
  const ImGuiIO& io = ImGui::GetIO();
  const Eigen::Vector2d delta = ToEigen(io.MouseDelta);
  if (active) {
    if (ImGui::IsMouseDown(ImGuiMouseButton_Left) && !io.KeyShift) {
      place_view.orbit.Orbit(delta, size.x());
    } else {
      place_view.orbit.Pan(delta, size.y());
    }
  }
  if (hovered && io.MouseWheel != 0.0f) {
    place_view.orbit.Zoom(io.MouseWheel);
  }
}

void SceneView::Show(const PanelContext& context) {
  auto [workspace, selection, options, tools, cast, pictures, input, dialogs, actions] = context;
  UpdateMap(workspace.map().loaded(), tools.place);
  UpdateColours(workspace.map().loaded(), tools.place);
  UpdateOccluders(workspace);
  UpdateActors(workspace);
  if (!framed_ && database_ != nullptr) {
    framed_ = true;
    tools.place.orbit = LookAtStage(workspace.project().place());
  }
  const ImVec2 origin = ImGui::GetCursorScreenPos();
  const ImVec2 size = ImGui::GetContentRegionAvail();
  const int width = std::max(static_cast<int>(size.x), 16);
  const int height = std::max(static_cast<int>(size.y), 16);
  const ViewCamera view = tools.place.orbit.View(ToEigen(origin), Eigen::Vector2d(width, height));
  ImGui::InvisibleButton("around", ImVec2(static_cast<float>(width), static_cast<float>(height)),
                         ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight |
                             ImGuiButtonFlags_MouseButtonMiddle);
  const bool hovered = ImGui::IsItemHovered();
  const bool active = ImGui::IsItemActive();
  if (ImGui::IsItemActivated() && ImGui::IsMouseClicked(ImGuiMouseButton_Left)) {
    pressed_ = ToEigen(ImGui::GetMousePos());
  }
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  if (const Status status = Draw(workspace, selection, options, tools.place, view, width, height);
      !status.ok()) {
    draw.AddText(origin, Packed(OverPicture().error), status.message().c_str());
    return;
  }
  const ImVec2 corner(origin.x + static_cast<float>(width), origin.y + static_cast<float>(height));
  draw.AddImage(TextureOf(target_->texture(), version_), origin, corner);
  draw.PushClipRect(origin, corner, true);
  DrawCheckPoints(workspace, selection, tools.check, view, draw);
  const auto dragging = [&] {
    return context.tools.gizmo.drag.has_value() || context.tools.walks.drag.has_value();
  };
  const bool was_dragging = dragging();
  const bool picking =
      DrawModelPoints(workspace, selection, options, tools.align, view, hovered, draw);
  const bool walking = walks_.Show(context, view, hovered && !picking, draw);
  const bool wanted = DrawGizmo(workspace, selection, options, tools.gizmo, input, view,
                                hovered && !picking && !walking, draw) ||
                      walking;
  const bool busy = wanted && (dragging() || was_dragging || !active);
  if (busy) {
    pressed_.reset();
  }
  Point(workspace, options, tools.picks, tools.place, pictures, view, hovered && !busy, draw);
  DrawChosenPoints(workspace, tools.place, view, draw);
  const char* keys = Tr("Drag or arrows to orbit, Shift to pan, wheel or Page Up and Down to zoom");
  const float wrap = size.x - Px(24);
  const float tall = ImGui::CalcTextSize(keys, nullptr, false, wrap).y;
  draw.AddText(ImGui::GetFont(), ImGui::GetFontSize(),
               ImVec2(origin.x + Px(12), corner.y - Px(10) - tall), Packed(OverPicture().dim), keys,
               nullptr, wrap);
  draw.PopClipRect();
  Interact(tools.place, hovered, active && !busy, ToEigen(size));
  LookByKeys(tools.place, input, ToEigen(size));
  LookWhereAsked(workspace, points_, ToEigen(size), selection, tools.picks, tools.place);
  const ImVec2 area(static_cast<float>(width), static_cast<float>(height));
  DrawPlaceTools(workspace, options, tools.place, input, origin, area);
  DrawPointCard(workspace, tools.place, input, origin, area);
}

}  // namespace lararium::panels
