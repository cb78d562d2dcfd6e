#include "editor/panels/viewport/scene_view_style.h"

#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "editor/panels/viewport/gizmo_view.h"
#include "editor/panels/viewport/orbit_keys.h"
#include "editor/panels/viewport/pick_view.h"

namespace lararium::panels {

namespace {

using Eigen::Vector3d;
using geometry::Similarity3;
using Kind = Selection::Kind;
using LookDirection = PlaceView::LookAt;

// Radius of the ball around a point and around a person, metres.
constexpr double kAboutPoint = 0.6;
constexpr double kAboutPerson = 1.1;

template <typename Entry>
const Entry* Named(const std::vector<Entry>& entries, const std::string& name) {
  const auto found = std::find_if(entries.begin(), entries.end(),
                                  [&](const Entry& entry) { return entry.name == name; });
  return found == entries.end() ? nullptr : &*found;
}

std::optional<Ball> BallOfOccluder(const editor::Workspace& workspace, const std::string& name) {
  const auto& staged = workspace.preview().staged();
  const stage::Occluder* occluder = staged == nullptr ? nullptr : Named(staged->occluders, name);
  if (occluder == nullptr || occluder->mesh.positions.empty()) {
    return std::nullopt;
  }
  const Similarity3 world_from_mesh = WorldFromOccluder(workspace, name);
  Eigen::AlignedBox3d box;
  for (const glm::vec3& position : occluder->mesh.positions) {
    box.extend(world_from_mesh * Vector3d(position.x, position.y, position.z));
  }
  return Ball{box.center(), 0.5 * box.diagonal().norm()};
}

// The ball around a person at the present moment of the dry run.
std::optional<Ball> BallOfActor(const editor::Workspace& workspace,
                                const std::string& name,
                                const Similarity3& world_from_stage) {
  constexpr double kMiddle = 0.85;  // Metres above the floor.
  if (workspace.dry_run().newest() == nullptr) {
    return std::nullopt;
  }
  for (const editor::Trail& trail : workspace.dry_run().newest()->trails) {
    const std::optional<editor::TrailPoint> point = trail.At(workspace.playback().time());
    if (trail.actor == name && point) {
      return Ball{world_from_stage * Vector3d(point->place.x, kMiddle, point->place.y),
                  kAboutPerson * world_from_stage.scale};
    }
  }
  return std::nullopt;
}

// The point that is being picked, if the map locates it.
std::optional<Vector3d> PickedPoint(const editor::Workspace& workspace, const PickTarget& target) {
  const editor::ResolvedPicks& picks = workspace.map().loaded().picks;
  if (!picks.solution) {
    return std::nullopt;
  }
  const auto anchor = AnchorEntries()[static_cast<size_t>(target.anchor)].anchor;
  const stage::AnchorReport* report =
      Named(picks.solution->anchors, (workspace.project().place()->picks.*anchor).name);
  return report == nullptr
             ? std::nullopt
             : std::optional<Vector3d>(picks.map_from_picked.Inverse() * report->point_in_map);
}

// The ball around the selected points of the map, which have priority because they were clicked in
// this view.
std::optional<Ball> BallOfChosenPoints(const PlaceView& place,
                                       std::span<const Eigen::Vector3f> points) {
  Eigen::AlignedBox3d box;
  for (const uint32_t point : place.points) {
    if (point < points.size()) {
      box.extend(points[point].cast<double>());
    }
  }
  return box.isEmpty() ? std::nullopt
                       : std::optional(Ball{box.center(), 0.5 * box.diagonal().norm()});
}

std::optional<Ball> BallOfSelected(const editor::Workspace& workspace,
                                   const Selection& selection,
                                   const PickTarget& picks) {
  const Similarity3& world_from_stage = workspace.project().place()->picked_from_stage;
  const double about_point = kAboutPoint * world_from_stage.scale;
  const std::string& name = selection.name;
  const auto on_stage = [&](const Vector3d& position) {
    return Ball{world_from_stage * position, about_point};
  };
  switch (selection.kind) {
    case Kind::kOccluder:
      return BallOfOccluder(workspace, name);
    case Kind::kActor:
      return BallOfActor(workspace, name, world_from_stage);
    case Kind::kProbe:
      if (const auto* probe = Named(workspace.project().place()->probes, name)) {
        return on_stage(probe->position);
      }
      return std::nullopt;
    case Kind::kCheckPoint:
      if (const auto* point = Named(workspace.project().document().check_points, name)) {
        return on_stage(point->position);
      }
      return std::nullopt;
    case Kind::kPicks:
      if (const auto point = PickedPoint(workspace, picks)) {
        return Ball{*point, about_point};
      }
      return std::nullopt;
    case Kind::kObject:
      if (const auto object = SelectedTransform(workspace, selection)) {
        return Ball{object->translation, about_point};
      }
      return std::nullopt;
    case Kind::kNudge:
      if (const auto& picture = workspace.preview().picture();
          picture != nullptr && picture->camera_from_stage) {
        return on_stage(picture->camera_from_stage->Center());
      }
      return std::nullopt;
    default:
      return std::nullopt;
  }
}

}  // namespace

OrbitCamera LookAtStage(const editor::PlaceDocument* place) {
  OrbitCamera orbit;
  orbit.target = Vector3d(0.0, 0.9, -0.5);
  orbit.distance = 7.0;
  if (place != nullptr) {
    orbit.target = place->picked_from_stage * orbit.target;
    orbit.distance *= place->picked_from_stage.scale;
  }
  return orbit;
}

void LookByKeys(PlaceView& place_view, const Input& input, const Eigen::Vector2d& view_size_px) {
  if (ImGui::GetIO().WantTextInput || input.dialog_open || input.focus != Focus::kViews) {
    return;
  }
  for (const KeyPress& press : input.keys) {
    const KeyAction action = ActionOf(KeyScope::kAround, press);
    const bool shift = (press.modifiers & GLFW_MOD_SHIFT) != 0;
    if (action == KeyAction::kLookAtStage) {
      place_view.look_at = shift ? LookDirection::kMap : LookDirection::kStage;
    } else if (action == KeyAction::kLookAtSelected) {
      place_view.look_at = LookDirection::kSelected;
    } else {
      OrbitByKey(action, shift, view_size_px, place_view.orbit);
    }
  }
}

void LookWhereAsked(const editor::Workspace& workspace,
                    std::span<const Eigen::Vector3f> points,
                    const Eigen::Vector2d& view_size_px,
                    const Selection& selection,
                    const PickTarget& picks,
                    PlaceView& place_view) {
  const LookDirection asked = std::exchange(place_view.look_at, LookDirection::kWhereItDoes);
  if (asked == LookDirection::kWhereItDoes || workspace.project().place() == nullptr) {
    return;
  }
  std::optional<Ball> ball;
  if (asked == LookDirection::kSelected) {
    ball = BallOfChosenPoints(place_view, points);
    if (!ball) {
      ball = BallOfSelected(workspace, selection, picks);
    }
  }
  const bool stage = asked == LookDirection::kStage ||
                     (asked == LookDirection::kSelected && !ball && selection.kind == Kind::kStage);
  if (!ball && !stage) {
    ball = BallAround(points);
  }
  if (ball) {
    constexpr double kLeast = 0.05;  // Metres; the view stays outside a single point.
    ball->radius =
        std::max(ball->radius, kLeast * workspace.project().place()->picked_from_stage.scale);
    place_view.orbit.LookAt(*ball, view_size_px);
  } else {
    place_view.orbit = LookAtStage(workspace.project().place());
  }
}

}  // namespace lararium::panels
