#include "editor/panels/toolbar.h"

#include <GLFW/glfw3.h>
#include <imgui.h>

#include <string>

#include "editor/panels/theme.h"
#include "editor/panels/widgets.h"

namespace lararium::panels {

namespace {

void OpenDialog(EditorState& state, Dialog dialog) {
  state.dialog = dialog;
  state.fields = {};
}

void OpenTrainDialog(const app::Workspace& workspace, EditorState& state) {
  OpenDialog(state, Dialog::kTrain);
  state.fields.place = "place";
  if (const app::PlaceDocument* place = workspace.place()) {
    state.fields.place = place->name;
    state.fields.file = place->training.path;
    state.fields.images = place->training.kind == app::SourceDocument::Kind::kImages;
  }
}

std::string UndoLabel(const app::Workspace& workspace) {
  return workspace.commands().CanUndo() ? "Undo " + workspace.commands().undo_name() : "Undo";
}

std::string RedoLabel(const app::Workspace& workspace) {
  return workspace.commands().CanRedo() ? "Redo " + workspace.commands().redo_name() : "Redo";
}

void FileMenu(app::Workspace& workspace, EditorState& state) {
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
  if (ImGui::MenuItem("Train\xe2\x80\xa6")) {
    OpenTrainDialog(workspace, state);
  }
  if (ImGui::MenuItem("Bake")) {
    workspace.Bake();
  }
  ImGui::Separator();
  const bool any = workspace.place() != nullptr;
  if (ImGui::MenuItem("Add an occluder\xe2\x80\xa6", nullptr, false, any)) {
    OpenDialog(state, Dialog::kOccluder);
  }
  if (ImGui::MenuItem("Choose a light probe\xe2\x80\xa6", nullptr, false, any)) {
    OpenDialog(state, Dialog::kProbe);
  }
  if (ImGui::MenuItem("Add a person\xe2\x80\xa6")) {
    OpenDialog(state, Dialog::kCast);
  }
}

void ViewMenu(EditorState& state) {
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
  ImGui::MenuItem("Stage over the picture", nullptr, &state.show_stage);
  ImGui::MenuItem("Points", nullptr, &state.show_points);
}

bool Pressed(int glfw_key) { return ImGui::IsKeyPressed(glfw_key, false); }

void HandleControlKeys(app::Workspace& workspace, EditorState& state, bool shift) {
  if (Pressed(GLFW_KEY_S)) {
    workspace.Save();
  }
  if (Pressed(GLFW_KEY_Z)) {
    shift ? workspace.Redo() : workspace.Undo();
  }
  if (Pressed(GLFW_KEY_Y)) {
    workspace.Redo();
  }
  if (Pressed(GLFW_KEY_Q)) {
    state.quit = true;
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
    ViewMenu(state);
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
    state.gizmo = static_cast<GizmoMode>(mode);
    state.drag.reset();
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
  const ImGuiIO& io = ImGui::GetIO();
  if (io.KeyCtrl) {
    HandleControlKeys(workspace, state, io.KeyShift);
    return;
  }
  if (io.WantTextInput || io.KeyAlt) {
    return;
  }
  const std::pair<int, ViewKind> views[] = {{GLFW_KEY_1, ViewKind::kCamera},
                                            {GLFW_KEY_2, ViewKind::kAround},
                                            {GLFW_KEY_3, ViewKind::kPicks}};
  for (const auto& [key, view] : views) {
    if (Pressed(key)) {
      state.view = view;
    }
  }
  const std::pair<int, GizmoMode> modes[] = {{GLFW_KEY_W, GizmoMode::kMove},
                                             {GLFW_KEY_E, GizmoMode::kTurn},
                                             {GLFW_KEY_R, GizmoMode::kScale}};
  for (const auto& [key, mode] : modes) {
    if (Pressed(key)) {
      state.gizmo = mode;
      state.drag.reset();
    }
  }
  if (Pressed(GLFW_KEY_SPACE)) {
    workspace.SetPlaying(!workspace.playing());
  }
}

}  // namespace lararium::panels
