#include "editor/panels/viewport/gizmo_view.h"

#include <algorithm>
#include <numbers>
#include <vector>

#include "editor/jobs/object_pose.h"
#include "editor/panels/widgets/text.h"
#include "editor/panels/widgets/theme.h"

namespace lararium::panels {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using geometry::Similarity3;

ImU32 HandleColour(GizmoHandle handle, bool hot) {
  if (hot) {
    return Packed({1.0f, 0.86f, 0.35f, 1.0f});
  }
  return handle == GizmoHandle::kScale ? Packed(OverPicture().text)
                                       : Packed(kAxisColours[AxisOf(handle)]);
}

// Draws X, Y or Z in its colour, centred at a point.
void DrawAxisLetter(const ImVec2& at, int axis, ImU32 packed, ImDrawList& draw) {
  static constexpr const char* kLetters[] = {"X", "Y", "Z"};
  const ImVec2 size = ImGui::CalcTextSize(kLetters[axis]);
  const ImVec2 corner(at.x - 0.5f * size.x, at.y - 0.5f * size.y);
  draw.AddText(ImVec2(corner.x + Px(1), corner.y + Px(1)), Packed(OverPicture().window),
               kLetters[axis]);
  draw.AddText(corner, packed, kLetters[axis]);
}

void DrawArrow(
    const std::vector<Vector2d>& outline, int axis, ImU32 packed, bool hot, ImDrawList& draw) {
  const Vector2d along = outline[1] - outline[0];
  const double length = along.norm();
  const ImVec2 tip = ToImGui(outline[1]);
  draw.AddLine(ToImGui(outline[0]), tip, packed, Px(hot ? 3.5f : 2.5f));
  if (length > 1.0) {
    const Vector2d unit = along / length;
    const Vector2d side(-unit.y(), unit.x());
    const double size = Px(6.0f);
    draw.AddTriangleFilled(ToImGui(outline[1] + 2.0 * size * unit),
                           ToImGui(outline[1] + size * side), ToImGui(outline[1] - size * side),
                           packed);
    DrawAxisLetter(ToImGui(outline[1] + (2.0 * size + Px(10)) * unit), axis, packed, draw);
  } else {
    draw.AddCircleFilled(tip, Px(5), packed);  // The axis is seen end on.
  }
}

void DrawHandle(GizmoHandle handle,
                const std::vector<Vector2d>& outline,
                bool hot,
                ImDrawList& draw) {
  if (outline.empty()) {
    return;
  }
  const ImU32 packed = HandleColour(handle, hot);
  std::vector<ImVec2> points;
  std::transform(outline.begin(), outline.end(), std::back_inserter(points), ToImGui);
  const int count = static_cast<int>(points.size());
  if (count == 2) {
    DrawArrow(outline, AxisOf(handle), packed, hot, draw);
  } else if (handle == GizmoHandle::kScale) {
    draw.AddRectFilled(points[0], points[2], Packed(OverPicture().panel), Px(3));
    draw.AddRect(points[0], points[2], packed, Px(3), 0, Px(2));
  } else if (count == 4) {
    draw.AddConvexPolyFilled(points.data(), count,
                             (packed & 0x00ffffff) | (hot ? 0xb0u : 0x60u) << 24);
    draw.AddPolyline(points.data(), count, packed, ImDrawFlags_Closed, Px(1));
  } else {
    draw.AddPolyline(points.data(), count, packed, 0, Px(hot ? 3.5f : 2.2f));
    DrawAxisLetter(points[points.size() / 8], AxisOf(handle), packed, draw);
  }
}

const editor::ObjectDocument* FindObject(const editor::ProjectDocument& document,
                                         const std::string& name) {
  const auto found = std::find_if(document.objects.begin(), document.objects.end(),
                                  [&](const auto& object) { return object.name == name; });
  return found == document.objects.end() ? nullptr : &*found;
}

}  // namespace

std::optional<Similarity3> SelectedTransform(const editor::Workspace& workspace,
                                             const Selection& selection) {
  const editor::PlaceDocument* place = workspace.project().place();
  if (place == nullptr) {
    return std::nullopt;
  }
  if (selection.kind == Selection::Kind::kStage) {
    return place->picked_from_stage;
  }
  if (selection.kind == Selection::Kind::kOccluder) {
    const editor::OccluderDocument* occluder = place->FindOccluder(selection.name);
    if (occluder != nullptr && !occluder->drawn()) {
      return place->picked_from_stage * occluder->stage_from_mesh;
    }
  }
  if (selection.kind == Selection::Kind::kObject) {
    if (const editor::ObjectDocument* object =
            FindObject(workspace.project().document(), selection.name)) {
      const geometry::Rigid3 pose = editor::StageFromObject(*object);
      return place->picked_from_stage * Similarity3{1.0, pose.rotation, pose.translation};
    }
  }
  return std::nullopt;
}

Similarity3 WorldFromOccluder(const editor::Workspace& workspace, const std::string& name) {
  return SelectedTransform(workspace, {Selection::Kind::kOccluder, name})
      .value_or(workspace.map().loaded().picks.map_from_picked.Inverse());
}

void MoveSelected(editor::Workspace& workspace,
                  const Selection& selection,
                  const Similarity3& world_from_thing,
                  std::string_view gesture) {
  if (selection.kind == Selection::Kind::kStage) {
    workspace.project().EditPlace(
        Sentence("move the stage"),
        [&](editor::PlaceDocument& place) { place.picked_from_stage = world_from_thing; }, gesture);
  } else if (selection.kind == Selection::Kind::kOccluder) {
    workspace.project().EditPlace(
        Sentence("move %s", {selection.name}),
        [&](editor::PlaceDocument& place) {
          if (editor::OccluderDocument* occluder = place.FindOccluder(selection.name)) {
            occluder->stage_from_mesh = place.picked_from_stage.Inverse() * world_from_thing;
          }
        },
        gesture);
  } else if (selection.kind == Selection::Kind::kObject) {
    const Similarity3 stage_from_thing =
        workspace.project().place()->picked_from_stage.Inverse() * world_from_thing;
    workspace.project().Edit(
        Sentence("move %s", {selection.name}),
        [&](editor::ProjectDocument& document) {
          for (editor::ObjectDocument& object : document.objects) {
            if (object.name == selection.name) {
              editor::PlaceObject(stage_from_thing.rotation, stage_from_thing.translation, object);
            }
          }
        },
        gesture);
  }
}

namespace {

GizmoFreedom FreedomOf(const Selection& selection) {
  return selection.kind == Selection::Kind::kObject ? GizmoFreedom::kUpright : GizmoFreedom::kFree;
}

bool GivesUp(const Input& input) {
  return std::any_of(input.keys.begin(), input.keys.end(), [](const KeyPress& press) {
    return ActionOf(KeyScope::kViews, press) == KeyAction::kUnselect;
  });
}

// Snapping is on while Ctrl is held, or with the switch in the scene view.
GizmoSnap SnapOf(const editor::Workspace& workspace,
                 const ViewOptions& options,
                 const ViewCamera& view,
                 const Vector3d& origin) {
  if (!options.snap && !ImGui::GetIO().KeyCtrl) {
    return {};
  }
  constexpr double kStep = 0.05;      // Metres of the stage.
  constexpr double kFineStep = 0.01;  // Used with Shift.
  GizmoSnap snap;
  snap.move = (ImGui::GetIO().KeyShift ? kFineStep : kStep) *
              workspace.project().place()->picked_from_stage.scale;
  snap.turn = 5.0 / 180.0 * std::numbers::pi;
  snap.scale = 0.05;
  const editor::LoadedMap& loaded = workspace.map().loaded();
  if (loaded.measures.floor) {
    constexpr double kReachPx = 8.0;
    const Similarity3 world_from_map = loaded.picks.map_from_picked.Inverse();
    snap.floor = {world_from_map * loaded.measures.floor->center,
                  world_from_map.rotation * loaded.measures.floor->normal,
                  Px(kReachPx) * view.UnitsPerPixel(origin)};
  }
  return snap;
}

// Updates the drag. After a cancellation, the object stays at its old position until the button is
// released.
void Drag(editor::Workspace& workspace,
          Selection& selection,
          const ViewOptions& options,
          GizmoTool& gizmo,
          const Input& input,
          const ViewCamera& view,
          const Vector3d& origin) {
  if (!gizmo.given_up && GivesUp(input)) {
    gizmo.given_up = true;
    workspace.project().CancelGesture();
  }
  const ImVec2 moved = ImGui::GetIO().MouseDelta;
  if (!ImGui::IsMouseDown(ImGuiMouseButton_Left)) {
    gizmo.drag.reset();
    workspace.project().EndGesture();
  } else if (!gizmo.given_up && (moved.x != 0.0f || moved.y != 0.0f)) {
    const GizmoSnap snap = SnapOf(workspace, options, view, origin);
    const Vector2d pointer = ToEigen(ImGui::GetMousePos());
    MoveSelected(workspace, selection, gizmo.drag->Update(view, pointer, snap), "gizmo");
  }
}

}  // namespace

bool DrawGizmo(editor::Workspace& workspace,
               Selection& selection,
               const ViewOptions& options,
               GizmoTool& gizmo,
               const Input& input,
               const ViewCamera& view,
               bool hovered,
               ImDrawList& draw) {
  const std::optional<Similarity3> transform = SelectedTransform(workspace, selection);
  if (!transform || !view.Project(transform->translation)) {
    gizmo.drag.reset();
    return false;
  }
  const Vector2d pointer = ToEigen(ImGui::GetMousePos());
  const GizmoLayout layout(*transform, view);
  const GizmoFreedom freedom = FreedomOf(selection);
  std::optional<GizmoHandle> hot;
  if (gizmo.drag) {
    hot = gizmo.drag->handle();
  } else if (hovered) {
    hot = PickHandle(layout, gizmo.mode, view, pointer, freedom);
  }
  if (hot && !gizmo.drag && ImGui::IsMouseClicked(ImGuiMouseButton_Left)) {
    workspace.project().EndGesture();
    gizmo.drag = GizmoDrag::Begin(*hot, *transform, view, pointer);
    gizmo.given_up = false;
  }
  if (gizmo.drag) {
    Drag(workspace, selection, options, gizmo, input, view, transform->translation);
  }
  for (const GizmoHandle handle : HandlesOf(gizmo.mode, freedom)) {
    DrawHandle(handle, layout.Outline(handle, view), hot == handle, draw);
  }
  draw.AddCircleFilled(ToImGui(*view.Project(layout.origin)), Px(4), Packed(OverPicture().text));
  return hot.has_value();
}

void DrawWorldLine(const ViewCamera& view,
                   const Vector3d& from,
                   const Vector3d& to,
                   ImU32 colour,
                   float width,
                   ImDrawList& draw) {
  constexpr double kClip = 0.02;  // World units in front of the eye.
  Vector3d a = view.camera_from_world * from;
  Vector3d b = view.camera_from_world * to;
  if (a.z() < kClip && b.z() < kClip) {
    return;
  }
  if (a.z() < kClip) {
    a = b + (a - b) * (b.z() - kClip) / (b.z() - a.z());
  } else if (b.z() < kClip) {
    b = a + (b - a) * (a.z() - kClip) / (a.z() - b.z());
  }
  draw.AddLine(ToImGui(view.PixelOf(a)), ToImGui(view.PixelOf(b)), colour, width);
}

void DrawStage(const editor::Workspace& workspace, const ViewCamera& view, ImDrawList& draw) {
  const editor::PlaceDocument* place = workspace.project().place();
  if (place == nullptr) {
    return;
  }
  constexpr int kHalf = 3;  // Metres.
  const Similarity3& world_from_stage = place->picked_from_stage;
  const ImU32 grid = Packed(OverPicture().text, 0.22f);
  for (int i = -kHalf; i <= kHalf; ++i) {
    DrawWorldLine(view, world_from_stage * Vector3d(i, 0, -kHalf),
                  world_from_stage * Vector3d(i, 0, kHalf), grid, Px(1), draw);
    DrawWorldLine(view, world_from_stage * Vector3d(-kHalf, 0, i),
                  world_from_stage * Vector3d(kHalf, 0, i), grid, Px(1), draw);
  }
  for (int axis = 0; axis < 3; ++axis) {
    DrawWorldLine(view, world_from_stage.translation, world_from_stage * Vector3d::Unit(axis),
                  Packed(kAxisColours[axis]), Px(2), draw);
    if (const auto end = view.Project(world_from_stage * (1.1 * Vector3d::Unit(axis)))) {
      DrawAxisLetter(ToImGui(*end), axis, Packed(kAxisColours[axis]), draw);
    }
  }
}

void DrawCross(const ImVec2& at, ImU32 packed, ImDrawList& draw) {
  const float arm = Px(9);
  const float gap = Px(3);
  for (const auto& [dx, dy] : {std::pair{1.0f, 0.0f}, {-1.0f, 0.0f}, {0.0f, 1.0f}, {0.0f, -1.0f}}) {
    draw.AddLine(ImVec2(at.x + dx * gap, at.y + dy * gap), ImVec2(at.x + dx * arm, at.y + dy * arm),
                 packed, Px(2));
  }
}

void DrawLabel(const ImVec2& at, const std::string& text, ImU32 packed, ImDrawList& draw) {
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  draw.AddRectFilled(ImVec2(at.x - Px(5), at.y - Px(2)),
                     ImVec2(at.x + size.x + Px(5), at.y + size.y + Px(2)),
                     Packed(OverPicture().window, 0.8f), Px(3));
  draw.AddText(at, packed, text.c_str());
}

void LabelMark(const ImVec2& mark, const std::string& text, ImU32 packed, ImDrawList& draw) {
  // Labels of marks near the right edge are placed on their left.
  const float width = ImGui::CalcTextSize(text.c_str()).x;
  const bool fits = mark.x + Px(18) + width <= draw.GetClipRectMax().x;
  const float x = fits ? mark.x + Px(13) : mark.x - Px(13) - width;
  DrawLabel(ImVec2(x, mark.y - 0.5f * ImGui::GetTextLineHeight()), text, packed, draw);
}

}  // namespace lararium::panels
