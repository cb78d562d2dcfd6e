#include "editor/panels/toolbar.h"

#include <GLFW/glfw3.h>
#include <imgui.h>

#include <cstdio>
#include <string>

#include "editor/panels/light_panel.h"
#include "editor/panels/theme.h"
#include "editor/panels/widgets.h"

namespace lararium::panels {

namespace {

void OpenDialog(EditorState& state, Dialog dialog) {
  state.dialog = dialog;
  state.fields = {};
}

std::string IntrinsicsText(const geometry::CameraModel& camera) {
  char text[256];
  std::snprintf(text, sizeof(text), "%.9g, %.9g, %.9g, %.9g, %.9g, %.9g, %.9g, %.9g", camera.fx,
                camera.fy, camera.cx, camera.cy, camera.k1, camera.k2, camera.p1, camera.p2);
  return text;
}

void OpenTrainDialog(const app::Workspace& workspace, EditorState& state) {
  OpenDialog(state, Dialog::kTrain);
  state.fields.place = "place";
  if (const app::PlaceDocument* place = workspace.place()) {
    state.fields.place = place->name;
    state.fields.file = place->training.path;
    state.fields.images = place->training.kind == app::SourceDocument::Kind::kImages;
    state.fields.intrinsics = place->intrinsics ? IntrinsicsText(*place->intrinsics) : "";
  }
}

bool CanAddSession(app::Workspace& workspace) {
  return workspace.place() != nullptr && workspace.loaded().database != nullptr &&
         !workspace.tasks().Running(app::Workspace::kTraining);
}

std::string UndoLabel(const app::Workspace& workspace) {
  return workspace.commands().CanUndo() ? "Undo " + workspace.commands().undo_name() : "Undo";
}

std::string RedoLabel(const app::Workspace& workspace) {
  return workspace.commands().CanRedo() ? "Redo " + workspace.commands().redo_name() : "Redo";
}

void FileMenu(app::Workspace& workspace, EditorState& state) {
  if (ImGui::MenuItem("New or open\xe2\x80\xa6", "Ctrl+O")) {
    state.leave = true;
  }
  if (ImGui::MenuItem("Save", "Ctrl+S")) {
    workspace.Save();
  }
  if (ImGui::MenuItem("Export\xe2\x80\xa6")) {
    OpenDialog(state, Dialog::kExport);
  }
  ImGui::Separator();
  if (ImGui::MenuItem("Quit", "Ctrl+Q")) {
    state.quit = true;
  }
}

void EditMenu(app::Workspace& workspace) {
  if (ImGui::MenuItem(UndoLabel(workspace).c_str(), "Ctrl+Z", false,
                      workspace.commands().CanUndo())) {
    workspace.Undo();
  }
  if (ImGui::MenuItem(RedoLabel(workspace).c_str(), "Ctrl+Shift+Z", false,
                      workspace.commands().CanRedo())) {
    workspace.Redo();
  }
}

void PlaceMenu(app::Workspace& workspace, EditorState& state) {
  const bool training = workspace.tasks().Running(app::Workspace::kTraining);
  if (ImGui::MenuItem("Train\xe2\x80\xa6", nullptr, false, !training)) {
    OpenTrainDialog(workspace, state);
  }
  if (ImGui::MenuItem("Add a session\xe2\x80\xa6", nullptr, false, CanAddSession(workspace))) {
    OpenDialog(state, Dialog::kAddSession);
  }
  if (ImGui::MenuItem("Bake")) {
    workspace.Bake();
  }
  if (ImGui::MenuItem("Lay the stage on the floor", "F", false,
                      workspace.loaded().measures.floor.has_value())) {
    workspace.LayStageOnFloor();
  }
  ImGui::Separator();
  const bool any = workspace.place() != nullptr;
  if (ImGui::MenuItem("Add an occluder\xe2\x80\xa6", nullptr, false, any)) {
    OpenDialog(state, Dialog::kOccluder);
  }
  if (ImGui::MenuItem("Add a light probe\xe2\x80\xa6", nullptr, false, any)) {
    OpenDialog(state, Dialog::kProbe);
  }
  if (ImGui::MenuItem("Add a person\xe2\x80\xa6")) {
    OpenDialog(state, Dialog::kCast);
  }
}

void ViewMenu(app::Workspace& workspace, EditorState& state) {
  const std::pair<const char*, ViewKind> views[] = {{"Through the camera", ViewKind::kCamera},
                                                    {"Around the place", ViewKind::kAround},
                                                    {"Picks", ViewKind::kPicks}};
  const char* const keys[] = {"1", "2", "3"};
  for (int i = 0; i < 3; ++i) {
    if (ImGui::MenuItem(views[i].first, keys[i], state.view == views[i].second)) {
      state.view = views[i].second;
    }
  }
  ImGui::Separator();
  const std::pair<const char*, BottomTab> tabs[] = {{"Timeline", BottomTab::kTimeline},
                                                    {"Script", BottomTab::kScript},
                                                    {"Checks", BottomTab::kChecks},
                                                    {"Messages", BottomTab::kMessages}};
  const char* const tab_keys[] = {"F5", "F6", "F7", "F8"};
  for (int i = 0; i < 4; ++i) {
    if (ImGui::MenuItem(tabs[i].first, tab_keys[i], state.bottom == tabs[i].second)) {
      state.bottom = tabs[i].second;
    }
  }
  ImGui::Separator();
  ImGui::MenuItem("Stage over the picture", nullptr, &state.show_stage);
  ImGui::MenuItem("Points", nullptr, &state.show_points);
  ImGui::Separator();
  if (ImGui::MenuItem("Evidence", "F2", workspace.shows_evidence())) {
    workspace.SetEvidence(!workspace.shows_evidence());
  }
  if (ImGui::MenuItem("Sound", "M", workspace.sound())) {
    workspace.SetSound(!workspace.sound());
  }
}

void HandleControlKey(app::Workspace& workspace, EditorState& state, const KeyPress& press) {
  switch (press.key) {
    case GLFW_KEY_S:
      workspace.Save();
      break;
    case GLFW_KEY_Z:
      if (ImGui::GetIO().WantTextInput && state.focus != Focus::kScript) {
        break;  // the field that is being typed into has its own
      }
      (press.modifiers & GLFW_MOD_SHIFT) != 0 ? workspace.Redo() : workspace.Undo();
      break;
    case GLFW_KEY_Y:
      workspace.Redo();
      break;
    case GLFW_KEY_O:
      state.leave = true;
      break;
    case GLFW_KEY_Q:
      state.quit = true;
      break;
  }
}

void SetGizmo(EditorState& state, GizmoMode mode) {
  state.gizmo = mode;
  state.drag.reset();
}

void HandlePlainKey(app::Workspace& workspace, EditorState& state, int key) {
  switch (key) {
    case GLFW_KEY_1:
      state.view = ViewKind::kCamera;
      break;
    case GLFW_KEY_2:
      state.view = ViewKind::kAround;
      break;
    case GLFW_KEY_3:
      state.view = ViewKind::kPicks;
      break;
    case GLFW_KEY_L:
      if (workspace.place() != nullptr && !workspace.place()->probes.empty()) {
        state.selection = {Selection::Kind::kProbe, workspace.place()->probes.front().name};
        state.view = ViewKind::kCamera;
      }
      break;
    case GLFW_KEY_F:
      workspace.LayStageOnFloor();
      break;
    case GLFW_KEY_W:
      SetGizmo(state, GizmoMode::kMove);
      break;
    case GLFW_KEY_E:
      SetGizmo(state, GizmoMode::kTurn);
      break;
    case GLFW_KEY_R:
      SetGizmo(state, GizmoMode::kScale);
      break;
    case GLFW_KEY_F2:
      workspace.SetEvidence(!workspace.shows_evidence());
      break;
    case GLFW_KEY_M:
      workspace.SetSound(!workspace.sound());
      break;
    case GLFW_KEY_F5:
    case GLFW_KEY_F6:
    case GLFW_KEY_F7:
    case GLFW_KEY_F8:
      state.bottom = static_cast<BottomTab>(key - GLFW_KEY_F5);
      state.focus = state.bottom == BottomTab::kTimeline ? Focus::kTimeline : Focus::kViews;
      break;
    case GLFW_KEY_SPACE:
      workspace.SetPlaying(!workspace.playing());
      break;
  }
}

}  // namespace

void ShowMenuBar(app::Workspace& workspace, EditorState& state) {
  if (!ImGui::BeginMenuBar()) {
    return;
  }
  if (ImGui::BeginMenu("File")) {
    FileMenu(workspace, state);
    ImGui::EndMenu();
  }
  if (ImGui::BeginMenu("Edit")) {
    EditMenu(workspace);
    ImGui::EndMenu();
  }
  if (ImGui::BeginMenu("Place")) {
    PlaceMenu(workspace, state);
    ImGui::EndMenu();
  }
  if (ImGui::BeginMenu("View")) {
    ViewMenu(workspace, state);
    ImGui::EndMenu();
  }
  ImGui::EndMenuBar();
}

void ShowToolbar(app::Workspace& workspace, EditorState& state) {
  const float gap = Px(22);
  ImGui::BeginDisabled(workspace.tasks().Running(app::Workspace::kTraining));
  if (ImGui::Button("Train\xe2\x80\xa6")) {
    OpenTrainDialog(workspace, state);
  }
  ImGui::EndDisabled();
  ImGui::SameLine();
  ImGui::BeginDisabled(!CanAddSession(workspace));
  if (ImGui::Button("Add a session\xe2\x80\xa6")) {
    OpenDialog(state, Dialog::kAddSession);
  }
  ImGui::EndDisabled();
  ImGui::SameLine();
  ImGui::BeginDisabled(workspace.tasks().Running(app::Workspace::kBaking));
  if (ImGui::Button("Bake")) {
    workspace.Bake();
  }
  ImGui::EndDisabled();
  ImGui::SameLine();
  ImGui::BeginDisabled(workspace.tasks().Running(app::Workspace::kExporting));
  if (ImGui::Button("Export\xe2\x80\xa6")) {
    OpenDialog(state, Dialog::kExport);
  }
  ImGui::EndDisabled();

  ImGui::SameLine(0.0f, gap);
  static constexpr const char* kViews[] = {"Through the camera", "Around the place", "Picks"};
  int view = static_cast<int>(state.view);
  if (Segmented("view", kViews, view)) {
    state.view = static_cast<ViewKind>(view);
  }
  ImGui::SameLine(0.0f, gap);
  static constexpr const char* kModes[] = {"Move", "Turn", "Scale"};
  int mode = static_cast<int>(state.gizmo);
  if (Segmented("gizmo", kModes, mode)) {
    SetGizmo(state, static_cast<GizmoMode>(mode));
  }
  ImGui::SameLine(0.0f, gap);
  ImGui::BeginDisabled(!workspace.commands().CanUndo());
  if (ImGui::Button("Undo")) {
    workspace.Undo();
  }
  ImGui::EndDisabled();
  ImGui::SameLine();
  ImGui::BeginDisabled(!workspace.commands().CanRedo());
  if (ImGui::Button("Redo")) {
    workspace.Redo();
  }
  ImGui::EndDisabled();
}

void HandleShortcuts(app::Workspace& workspace, EditorState& state) {
  if (state.dialog != Dialog::kNone) {
    return;
  }
  for (const KeyPress& press : state.keys) {
    if ((press.modifiers & GLFW_MOD_CONTROL) != 0) {
      HandleControlKey(workspace, state, press);
    } else if (press.key >= GLFW_KEY_F1 && press.key <= GLFW_KEY_F25) {
      HandlePlainKey(workspace, state, press.key);  // no letters: also while somebody types
    } else if (!ImGui::GetIO().WantTextInput && (press.modifiers & GLFW_MOD_ALT) == 0) {
      if (!HandleLightKey(workspace, state, press)) {
        HandlePlainKey(workspace, state, press.key);
      }
    }
  }
}

}  // namespace lararium::panels
