#include "editor/panels/viewport/walk_view.h"

#include <GLFW/glfw3.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

#include "editor/panels/viewport/gizmo_view.h"
#include "editor/panels/viewport/place_picking.h"
#include "editor/panels/viewport/view_tools.h"
#include "editor/panels/widgets/text.h"
#include "editor/panels/widgets/theme.h"
#include "shared/stage/actor.h"

namespace lararium::panels {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using geometry::Similarity3;

constexpr float kClose = 0.05f;      // Metres between the points of a drawn path.
constexpr double kAbove = 0.01;      // Height of the drawn path above the floor, metres.
constexpr float kEndRadius = 0.16f;  // metres
constexpr double kGrabPx = 11.0;     // Logical pixels.

Vector3d InWorld(const Similarity3& world_from_stage, glm::vec2 place) {
  return world_from_stage * Vector3d(place.x, kAbove, place.y);
}

// The point of the stage's floor under the pointer; nullopt where the ray misses the floor.
std::optional<glm::vec2> FloorBelow(const Similarity3& world_from_stage,
                                    const ViewCamera& view,
                                    const Vector2d& pixel) {
  const std::optional<Vector3d> hit =
      MeetPlane(view.RayThrough(pixel), world_from_stage.translation,
                world_from_stage.rotation * Vector3d::UnitY());
  if (!hit) {
    return std::nullopt;
  }
  const Vector3d on_stage = world_from_stage.Inverse() * *hit;
  return glm::vec2(on_stage.x(), on_stage.z());
}

// The people whose walks are shown: that of the selected walk, and the selected person.
std::vector<std::string> PeopleShown(const editor::Workspace& workspace,
                                     const Selection& selection,
                                     const WalkHandles& walks) {
  std::vector<std::string> people;
  const auto add = [&](const std::string& name) {
    if (!name.empty() && std::find(people.begin(), people.end(), name) == people.end()) {
      people.push_back(name);
    }
  };
  const drama::TimelineText* text = workspace.project().script().timeline();
  const auto& item = walks.item;
  if (item && text != nullptr && item->lane < text->lanes().size() &&
      text->lanes()[item->lane].kind == drama::LaneKind::kWalks) {
    add(text->lanes()[item->lane].actor);
  }
  const editor::DramaRun* run = workspace.dry_run().newest();
  if (walks.task && run != nullptr && *walks.task < run->tasks.size()) {
    add(run->tasks[*walks.task].actor);
  }
  if (selection.kind == Selection::Kind::kActor) {
    add(selection.name);
  }
  return people;
}

ImVec4 ColourOf(const editor::Workspace& workspace, const std::string& actor) {
  const std::vector<editor::CastDocument>& cast = workspace.project().document().cast;
  const auto found = std::find_if(cast.begin(), cast.end(),
                                  [&](const auto& member) { return member.name == actor; });
  return PersonColour(static_cast<uint32_t>(found - cast.begin()));
}

// The path with more points, so that parts of it can be hidden separately.
std::vector<glm::vec2> Close(const std::vector<editor::TrailPoint>& way) {
  std::vector<glm::vec2> points;
  for (size_t i = 0; i < way.size(); ++i) {
    if (i > 0) {
      const glm::vec2 from = way[i - 1].place;
      const float length = glm::distance(from, way[i].place);
      const int steps = std::min(static_cast<int>(length / kClose), 10000);
      for (int step = 1; step < steps; ++step) {
        points.push_back(
            glm::mix(from, way[i].place, static_cast<float>(step) / static_cast<float>(steps)));
      }
    }
    points.push_back(way[i].place);
  }
  return points;
}

std::vector<glm::vec2> Seconds(const editor::WalkPath& path) {
  std::vector<glm::vec2> places;
  if (!path.task || path.way.empty()) {
    return places;
  }
  const editor::Trail trail{path.actor, path.way};
  for (double time = path.way.front().seconds + 1.0; time < path.way.back().seconds; time += 1.0) {
    places.push_back(trail.At(time)->place);
  }
  return places;
}

// The heading at the end, if it is known.
std::optional<float> EndHeading(const editor::WalkPath& path) {
  if (path.to && path.to->heading) {
    return path.to->heading;
  }
  if (path.task && !path.way.empty()) {
    return path.way.back().heading;
  }
  if (path.way.size() >= 2) {
    const glm::vec2 last = path.way.back().place - path.way[path.way.size() - 2].place;
    return glm::length(last) > 1e-3f ? std::optional(stage::HeadingOf(last)) : std::nullopt;
  }
  return std::nullopt;
}

const char* FieldOf(const WalkHandles::Handle& handle) {
  return handle.begins ? editor::kWalkFrom : editor::kWalkTo;
}

void MoveHandle(editor::Workspace& workspace,
                const WalkHandles::Handle& handle,
                const std::function<glm::vec2(glm::vec2)>& moved,
                std::string_view gesture) {
  const drama::TimelineText* text = workspace.project().script().timeline();
  if (text == nullptr || handle.item.lane >= text->lanes().size()) {
    return;
  }
  const std::string name = text->lanes()[handle.item.lane].actor;
  workspace.project().EditTimeline(
      Sentence("move a walk of %s", {name}),
      [&](drama::TimelineText& edited) {
        const auto point = editor::WalkPointOf(edited, handle.item, FieldOf(handle));
        return editor::SetWalkPlace(edited, handle.item, FieldOf(handle),
                                    moved(point ? point->place : glm::vec2(0.0f)));
      },
      gesture);
}

// The horizontal axis of the stage that is closest to the direction of a key in the view.
glm::vec2 KeyAxis(KeyAction action, const Similarity3& world_from_stage, const ViewCamera& view) {
  Vector3d in_camera;
  switch (action) {
    case KeyAction::kWalkLeft:
      in_camera = {-1, 0, 0};
      break;
    case KeyAction::kWalkRight:
      in_camera = {1, 0, 0};
      break;
    case KeyAction::kWalkAway:
      in_camera = {0, -1, 1};  // Also works where the view looks straight down or ahead.
      break;
    case KeyAction::kWalkNearer:
      in_camera = {0, 1, -1};
      break;
    default:
      return glm::vec2(0.0f);
  }
  const Vector3d on_stage = world_from_stage.rotation.conjugate() *
                            (view.camera_from_world.rotation.conjugate() * in_camera);
  return std::abs(on_stage.x()) > std::abs(on_stage.z())
             ? glm::vec2(std::copysign(1.0f, static_cast<float>(on_stage.x())), 0.0f)
             : glm::vec2(0.0f, std::copysign(1.0f, static_cast<float>(on_stage.z())));
}

// Handles the keys of KeyScope::kWalk, which have no other meaning while an end is selected.
void HandleKeys(editor::Workspace& workspace,
                WalkHandles& walks,
                Input& input,
                const Similarity3& world_from_stage,
                const ViewCamera& view) {
  constexpr float kStep = 0.01f;  // Metres; 10 times as much with Shift.
  if (ImGui::GetIO().WantTextInput || input.dialog_open || !walks.chosen) {
    return;
  }
  std::erase_if(input.keys, [&](const KeyPress& press) {
    const KeyAction action = ActionOf(KeyScope::kWalk, press);
    if (action == KeyAction::kLeaveWalk) {
      if (walks.drag) {
        walks.drag->given_up = true;
      }
      walks.chosen.reset();
    } else if (action != KeyAction::kNone && walks.chosen) {
      if (!press.repeats) {
        workspace.project().EndGesture();  // Each press is a separate command.
      }
      const float step = (press.modifiers & GLFW_MOD_SHIFT) != 0 ? 10.0f * kStep : kStep;
      const glm::vec2 by = step * KeyAxis(action, world_from_stage, view);
      MoveHandle(
          workspace, *walks.chosen, [&](glm::vec2 place) { return place + by; }, "walk keys");
    }
    return action != KeyAction::kNone;
  });
}

// Snaps to marks, or to steps on the floor, like the handles of objects.
glm::vec2 Snapped(const editor::Workspace& workspace,
                  const ViewOptions& options,
                  const Similarity3& world_from_stage,
                  const ViewCamera& view,
                  const WalkHandles::Handle& handle,
                  glm::vec2 place) {
  if (!options.snap && !ImGui::GetIO().KeyCtrl) {
    return place;
  }
  constexpr float kStep = 0.05f;
  constexpr float kFineStep = 0.01f;  // Used with Shift.
  constexpr double kReachPx = 8.0;
  constexpr double kOnFloor = 0.1;  // Metres; check points up to this height are marks, too.
  std::vector<glm::vec2> marks =
      editor::WalkMarks(*workspace.project().script().timeline(), handle.item);
  for (const editor::CheckPointDocument& point : workspace.project().document().check_points) {
    if (std::abs(point.position.y()) < kOnFloor) {
      marks.emplace_back(point.position.x(), point.position.z());
    }
  }
  const double reach =
      Px(kReachPx) * view.UnitsPerPixel(InWorld(world_from_stage, place)) / world_from_stage.scale;
  return editor::SnapOnFloor(place, ImGui::GetIO().KeyShift ? kFineStep : kStep, marks,
                             static_cast<float>(reach));
}

// Draws a dashed line. along: the number of pixels that were drawn before.
void DrawDashes(const Vector2d& from,
                const Vector2d& to,
                ImU32 packed,
                float width,
                double& along,
                ImDrawList& draw) {
  const double dash = Px(6.0f);
  const double gap = Px(5.0f);
  const double length = (to - from).norm();
  double at = 0.0;
  while (at < length) {
    const double in_period = std::fmod(along + at, dash + gap);
    const bool on = in_period < dash;
    const double next = std::min(at + (on ? dash : dash + gap) - in_period + 1e-6, length);
    if (on) {
      draw.AddLine(ToImGui(from + at / length * (to - from)),
                   ToImGui(from + next / length * (to - from)), packed, width);
    }
    at = next;
  }
  along += length;
}

}  // namespace

void WalkView::Update(const editor::Workspace& workspace,
                      const Selection& selection,
                      const WalkHandles& walks) {
  Basis basis{workspace.project().script().revision(),
              workspace.dry_run().number(),
              workspace.dry_run().is_current(),
              PeopleShown(workspace, selection, walks),
              walks.item,
              walks.task};
  if (basis == basis_ && !followed_) {
    return;
  }
  basis_ = std::move(basis);
  followed_ = false;
  walks_.clear();
  const drama::TimelineText* text = workspace.project().script().timeline();
  for (const std::string& person : basis_.people) {
    for (editor::WalkPath& path :
         editor::FindWalkPaths(text, workspace.dry_run().newest(), basis_.run_is_current, person)) {
      Shown& walk = walks_.emplace_back();
      walk.colour = ColourOf(workspace, person);
      walk.chosen = path.item ? path.item == basis_.item : path.task == basis_.task;
      walk.way = Close(path.way);
      walk.ticks = Seconds(path);
      walk.path = std::move(path);
    }
  }
  // The selected walk is drawn over the others.
  std::stable_partition(walks_.begin(), walks_.end(), [](const Shown& w) { return !w.chosen; });
}

void WalkView::FollowDrag(const editor::Workspace& workspace, const WalkHandles::Drag& drag) {
  for (Shown& walk : walks_) {
    if (walk.path.item != drag.handle.item) {
      continue;
    }
    std::optional<editor::WalkPoint>& point = drag.handle.begins ? walk.path.from : walk.path.to;
    if (!point || !drag.moved || drag.given_up) {
      return;
    }
    followed_ = true;
    point->place = drag.place;
    if (walk.path.to) {
      editor::PlanWalk(workspace.dry_run().newest(), walk.path.to->place, walk.path);
    }
    walk.way = Close(walk.path.way);
    walk.ticks.clear();
  }
}

std::optional<glm::vec2> WalkView::PlaceOf(const Handle& handle) const {
  for (const Shown& walk : walks_) {
    const std::optional<editor::WalkPoint>& point = handle.begins ? walk.path.from : walk.path.to;
    if (walk.path.item == handle.item && point) {
      return point->place;
    }
  }
  return std::nullopt;
}

std::optional<WalkHandles::Handle> WalkView::HandleBelow(const ViewCamera& view,
                                                         const Vector2d& pixel) const {
  std::optional<Handle> below;
  double nearest = Px(kGrabPx);
  for (auto walk = walks_.rbegin(); walk != walks_.rend(); ++walk) {
    for (const bool begins : {false, true}) {
      const std::optional<editor::WalkPoint>& point = begins ? walk->path.from : walk->path.to;
      if (!walk->path.item || !point) {
        continue;
      }
      const auto at = view.Project(InWorld(world_from_stage_, point->place));
      if (at && (*at - pixel).norm() < nearest) {
        nearest = (*at - pixel).norm();
        below = Handle{*walk->path.item, begins};
      }
    }
  }
  return below;
}

void WalkView::Press(const ViewCamera& view,
                     const Handle& handle,
                     WalkHandles& walks,
                     EditorActions& actions) const {
  const Vector2d pointer = ToEigen(ImGui::GetMousePos());
  const std::optional<glm::vec2> place = PlaceOf(handle);
  const std::optional<glm::vec2> floor = FloorBelow(world_from_stage_, view, pointer);
  if (place && floor) {
    walks.chosen = handle;
    actions.push_back(SelectTimelineItem{handle.item});
    walks.drag = WalkHandles::Drag{handle, pointer, *place - *floor, *place, false};
  }
}

// Moves the dragged end to the pointer.
void WalkView::Drag(editor::Workspace& workspace,
                    const ViewOptions& options,
                    WalkHandles& walks,
                    const ViewCamera& view) const {
  WalkHandles::Drag& drag = *walks.drag;
  const Vector2d pointer = ToEigen(ImGui::GetMousePos());
  if (!ImGui::IsMouseDown(ImGuiMouseButton_Left)) {
    if (drag.moved && !drag.given_up) {
      workspace.project().EndGesture();
      MoveHandle(
          workspace, drag.handle, [&](glm::vec2) { return drag.place; }, "");
    }
    walks.drag.reset();
    return;
  }
  drag.moved |= (pointer - drag.pressed).norm() >= Px(kClickPx);
  const std::optional<glm::vec2> floor = FloorBelow(world_from_stage_, view, pointer);
  if (drag.moved && floor && workspace.project().script().timeline() != nullptr) {
    drag.place =
        Snapped(workspace, options, world_from_stage_, view, drag.handle, *floor + drag.grip);
  }
}

void WalkView::DrawWay(const Shown& walk, const ViewCamera& view, ImDrawList& draw) const {
  const bool blocked = !walk.path.problem.empty();
  const ImU32 packed =
      Packed(blocked ? OverPicture().error : walk.colour, walk.chosen ? 1.0f : 0.9f);
  const ImU32 rim = Packed(OverPicture().window, 0.85f);  // Separates it from the points behind it.
  const float width = Px(walk.chosen ? 3.5f : 2.5f);
  const float rim_width = width + Px(4);
  const Vector3d eye = view.camera_from_world.Center();
  std::optional<Vector2d> before;
  bool was_hidden = false;
  double along = 0.0;
  for (const glm::vec2& place : walk.way) {
    const Vector3d point = InWorld(world_from_stage_, place);
    const std::optional<Vector2d> at = view.Project(point);
    const bool hidden = at && occluders_.Hide(eye, point);
    if (before && at && hidden && was_hidden) {
      double rim_along = along;
      DrawDashes(*before, *at, rim, rim_width, rim_along, draw);
      DrawDashes(*before, *at, packed, width, along, draw);
    } else if (before && at) {
      draw.AddLine(ToImGui(*before), ToImGui(*at), rim, rim_width);
      draw.AddLine(ToImGui(*before), ToImGui(*at), packed, width);
    }
    before = at;
    was_hidden = hidden;
  }
  if (blocked && walk.path.to && !walk.way.empty()) {
    const auto from = view.Project(InWorld(world_from_stage_, walk.way.back()));
    const auto to = view.Project(InWorld(world_from_stage_, walk.path.to->place));
    if (from && to) {
      DrawDashes(*from, *to, packed, Px(1.5f), along, draw);
    }
  }
}

void WalkView::DrawEnd(const Shown& walk,
                       const WalkHandles& state,
                       const ViewCamera& view,
                       ImDrawList& draw) const {
  const editor::WalkPath& path = walk.path;
  if (!path.to && path.way.empty()) {
    return;
  }
  const glm::vec2 end = path.to ? path.to->place : path.way.back().place;
  const ImVec4& colour = path.problem.empty() ? walk.colour : OverPicture().error;
  const bool held = path.item && state.chosen == Handle{*path.item, false};
  const ImU32 packed = held ? Packed(OverPicture().text) : Packed(colour);
  const auto line = [&](glm::vec2 from, glm::vec2 to) {
    DrawWorldLine(view, InWorld(world_from_stage_, from), InWorld(world_from_stage_, to), packed,
                  Px(walk.chosen ? 2.5f : 1.5f), draw);
  };
  constexpr int kSides = 24;
  const auto rim = [&](int side) {
    return end + kEndRadius * stage::Direction(2.0f * std::numbers::pi_v<float> *
                                               static_cast<float>(side) / kSides);
  };
  for (int side = 0; side < kSides; ++side) {
    line(rim(side), rim(side + 1));
  }
  if (const std::optional<float> heading = EndHeading(path)) {
    const glm::vec2 tip = end + 2.2f * kEndRadius * stage::Direction(*heading);
    constexpr float kBarb = 0.8f;  // Share of pi: the angle between an arrow and its barbs.
    line(end, tip);
    for (const float side : {-kBarb, kBarb}) {
      line(tip,
           tip + 0.7f * kEndRadius * stage::Direction(*heading + side * std::numbers::pi_v<float>));
    }
  }
}

void WalkView::Draw(const Shown& walk,
                    const WalkHandles& state,
                    const ViewCamera& view,
                    ImDrawList& draw) const {
  DrawWay(walk, view, draw);
  const editor::WalkPath& path = walk.path;
  const ImU32 packed = Packed(path.problem.empty() ? walk.colour : OverPicture().error);
  const ImU32 rim = Packed(OverPicture().window, 0.8f);
  const auto dot = [&](glm::vec2 place, float radius) {
    if (const auto at = view.Project(InWorld(world_from_stage_, place))) {
      draw.AddCircleFilled(ToImGui(*at), radius + Px(1), rim);
      draw.AddCircleFilled(ToImGui(*at), radius, packed);
    }
  };
  for (const glm::vec2& place : walk.ticks) {
    dot(place, Px(walk.chosen ? 3.0f : 2.0f));
  }
  const std::optional<glm::vec2> begin =
      path.from ? std::optional(path.from->place)
                : (walk.way.empty() ? std::nullopt : std::optional(walk.way.front()));
  if (begin) {
    dot(*begin, Px(walk.chosen ? 5.0f : 3.5f));
    const auto at = view.Project(InWorld(world_from_stage_, *begin));
    const bool held = path.item && state.chosen == Handle{*path.item, true};
    if (at && held) {
      draw.AddCircle(ToImGui(*at), Px(8), Packed(OverPicture().text), 0, Px(2));
    }
  }
  DrawEnd(walk, state, view, draw);
  if (!walk.chosen) {
    return;
  }
  const bool dragged = state.drag && state.drag->moved && !state.drag->given_up &&
                       path.item == state.drag->handle.item;
  const std::optional<glm::vec2> labelled =
      dragged ? std::optional(state.drag->place)
              : (path.to ? std::optional(path.to->place) : std::nullopt);
  const auto at = labelled ? view.Project(InWorld(world_from_stage_, *labelled)) : std::nullopt;
  if (!at) {
    return;
  }
  std::string label = path.problem;
  if (dragged) {
    label = Text("x %.2f, z %.2f m", static_cast<double>(labelled->x),
                 static_cast<double>(labelled->y)) +
            (label.empty() ? "" : ": " + label);
  } else if (label.empty() && path.task && !path.way.empty()) {
    label = Text("%.1f s", path.way.back().seconds - path.way.front().seconds);
  } else if (label.empty() && !path.way.empty()) {
    label = Tr("as planned");
  }
  if (!label.empty()) {
    LabelMark(ToImGui(*at), label,
              Packed(path.problem.empty() ? OverPicture().text : OverPicture().error), draw);
  }
}

bool WalkView::Show(const PanelContext& context,
                    const ViewCamera& view,
                    bool hovered,
                    ImDrawList& draw) {
  auto [workspace, selection, options, tools, cast, pictures, input, dialogs, actions] = context;
  WalkHandles& walks = tools.walks;
  if (workspace.project().place() == nullptr) {
    return false;
  }
  world_from_stage_ = workspace.project().place()->picked_from_stage;
  Update(workspace, selection, walks);
  occluders_.Update(workspace);
  if (walks.chosen && !PlaceOf(*walks.chosen)) {
    walks.chosen.reset();  // The handle is no longer shown.
  }
  HandleKeys(workspace, walks, input, world_from_stage_, view);
  std::optional<Handle> hot;
  if (walks.drag) {
    hot = walks.drag->handle;
  } else if (hovered) {
    hot = HandleBelow(view, ToEigen(ImGui::GetMousePos()));
    if (ImGui::IsMouseClicked(ImGuiMouseButton_Left)) {
      walks.chosen.reset();
      if (hot) {
        Press(view, *hot, walks, actions);
      }
    }
  }
  if (walks.drag) {
    Drag(workspace, options, walks, view);
  }
  if (walks.drag) {
    FollowDrag(workspace, *walks.drag);
  }
  if (hot) {
    ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
  }
  for (const Shown& walk : walks_) {
    Draw(walk, walks, view, draw);
  }
  return hot.has_value();
}

}  // namespace lararium::panels
