#include "editor/panels/dialogs/toolbar.h"

#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "editor/jobs/calibrating.h"
#include "editor/panels/dialogs/look.h"
#include "editor/panels/inspector/light_panel.h"
#include "editor/panels/viewport/pick_view.h"
#include "editor/panels/viewport/place_cards.h"
#include "editor/panels/widgets/icons.h"
#include "editor/panels/widgets/text.h"
#include "editor/panels/widgets/theme.h"
#include "editor/panels/widgets/widgets.h"
#include "editor/panels/widgets/wrapped_field.h"

namespace lararium::panels {

namespace {

bool MenuItem(const char* label, KeyAction key, bool chosen = false, bool possible = true) {
  return ImGui::MenuItem(label, KeyText(key).c_str(), chosen, possible);
}

void OpenTrainDialog(const editor::Workspace& workspace, EditorState& state) {
  if (OpenDialog(state, Dialog::kTrain)) {
    return;
  }
  state.fields.place = "place";
  if (const editor::PlaceDocument* place = workspace.project().place()) {
    state.fields.place = place->name;
    state.fields.file = place->training.path;
    state.fields.images = place->training.kind == editor::SourceDocument::Kind::kImages;
    state.fields.intrinsics = place->intrinsics ? editor::IntrinsicsText(*place->intrinsics) : "";
  }
}

bool CanAddSession(editor::Workspace& workspace) {
  return workspace.project().place() != nullptr && workspace.map().loaded().database != nullptr &&
         !workspace.tasks().Running(editor::TaskKind::kTraining);
}

std::string UndoLabel(const editor::Workspace& workspace) {
  return workspace.project().commands().CanUndo()
             ? Text(Tr("Undo %s"),
                    workspace.project().commands().undo_name().Translated(Tr).c_str())
             : Tr("Undo");
}

std::string RedoLabel(const editor::Workspace& workspace) {
  return workspace.project().commands().CanRedo()
             ? Text(Tr("Redo %s"),
                    workspace.project().commands().redo_name().Translated(Tr).c_str())
             : Tr("Redo");
}

void FileMenu(editor::Workspace& workspace, EditorState& state) {
  if (MenuItem(Tr("New or open\xe2\x80\xa6"), KeyAction::kLeave)) {
    state.leave = true;
  }
  if (MenuItem(Tr("Save"), KeyAction::kSave)) {
    workspace.project().Save();
  }
  if (ImGui::MenuItem(Tr("Export\xe2\x80\xa6"))) {
    OpenDialog(state, Dialog::kExport);
  }
  ImGui::Separator();
  if (MenuItem(Tr("Quit"), KeyAction::kQuit)) {
    state.quit = true;
  }
}

void EditMenu(editor::Workspace& workspace) {
  if (MenuItem(UndoLabel(workspace).c_str(), KeyAction::kUndo, false,
               workspace.project().commands().CanUndo())) {
    workspace.project().Undo();
  }
  if (MenuItem(RedoLabel(workspace).c_str(), KeyAction::kRedo, false,
               workspace.project().commands().CanRedo())) {
    workspace.project().Redo();
  }
}

void PlaceMenu(editor::Workspace& workspace, EditorState& state) {
  const bool training = workspace.tasks().Running(editor::TaskKind::kTraining);
  if (ImGui::MenuItem(Tr("Train\xe2\x80\xa6"), nullptr, false, !training)) {
    OpenTrainDialog(workspace, state);
  }
  if (ImGui::MenuItem(Tr("Add a session\xe2\x80\xa6"), nullptr, false, CanAddSession(workspace))) {
    OpenDialog(state, Dialog::kAddSession);
  }
  if (ImGui::MenuItem(Tr("The training's report\xe2\x80\xa6"), nullptr, false,
                      workspace.map().loaded().report != nullptr)) {
    OpenDialog(state, Dialog::kTrainingReport);
  }
  if (ImGui::MenuItem(Tr("Put the former map back"), nullptr, false,
                      workspace.map().loaded().has_previous && !training)) {
    workspace.training().RestorePreviousMap();
  }
  if (ImGui::MenuItem(Tr("Bake"))) {
    workspace.jobs().Bake();
  }
  if (MenuItem(Tr("Lay the stage on the floor"), KeyAction::kLayOnFloor, false,
               workspace.map().loaded().measures.floor.has_value())) {
    workspace.map().LayStageOnFloor();
  }
  ImGui::Separator();
  const bool any = workspace.project().place() != nullptr;
  if (ImGui::MenuItem(Tr("Add an occluder\xe2\x80\xa6"), nullptr, false, any)) {
    OpenDialog(state, Dialog::kOccluder);
  }
  if (ImGui::MenuItem(Tr("Draw an occluder"), nullptr, false,
                      any && workspace.map().loaded().database != nullptr)) {
    DrawNewOccluder(workspace, state);
  }
  if (ImGui::MenuItem(Tr("Add a light probe\xe2\x80\xa6"), nullptr, false, any)) {
    OpenDialog(state, Dialog::kProbe);
  }
  if (ImGui::MenuItem(Tr("Add a check point\xe2\x80\xa6"), nullptr, false, any)) {
    OpenDialog(state, Dialog::kCheckPoint);
  }
  if (ImGui::MenuItem(Tr("Add a person\xe2\x80\xa6"))) {
    OpenDialog(state, Dialog::kCast);
  }
}

void DrawTab(EditorState& state, BottomTab tab) {
  state.bottom = tab;
  state.focus = tab == BottomTab::kTimeline ? Focus::kTimeline : Focus::kViews;
}

// The menu of the camera view's source.
void ViewSourceMenu(editor::Workspace& workspace, EditorState& state) {
  using Source = editor::PreviewSession::ViewSource;
  const Source now = workspace.preview().view_source();
  if (!ImGui::BeginMenu(Label(Tr("The camera is"), "source").c_str(),
                        workspace.project().place() != nullptr)) {
    return;
  }
  if (ImGui::MenuItem(Tr("The place's recording"), nullptr, now == Source::kRecording)) {
    workspace.preview().SetViewSource(Source::kRecording);
  }
  if (ImGui::MenuItem(Tr("The training's recording"), nullptr, now == Source::kTraining,
                      workspace.preview().has_own_recording())) {
    workspace.preview().SetViewSource(Source::kTraining);
  }
  if (ImGui::MenuItem(Tr("A live camera\xe2\x80\xa6"), nullptr, now == Source::kLive)) {
    OpenDialog(state, Dialog::kLiveCamera);
  }
  ImGui::EndMenu();
}

// Opens the settings of the onion skin, and switches it on so that the result is visible.
void AskForOnionMore(EditorState& state) {
  state.view = ViewKind::kCamera;
  state.show_onion = true;
  state.open_onion = true;
}

void ViewMenu(editor::Workspace& workspace, EditorState& state) {
  const std::tuple<const char*, KeyAction, ViewKind> views[] = {
      {Tr("Through the camera"), KeyAction::kCameraView, ViewKind::kCamera},
      {Tr("Around the place"), KeyAction::kAroundView, ViewKind::kAround},
      {Tr("Picks"), KeyAction::kPickView, ViewKind::kPicks}};
  for (const auto& [label, key, view] : views) {
    if (MenuItem(label, key, state.view == view)) {
      state.view = view;
    }
  }
  ImGui::Separator();
  const std::tuple<const char*, KeyAction, BottomTab> tabs[] = {
      {Tr("Timeline"), KeyAction::kTimelineTab, BottomTab::kTimeline},
      {Tr("Script"), KeyAction::kScriptTab, BottomTab::kScript},
      {Tr("Checks"), KeyAction::kChecksTab, BottomTab::kChecks},
      {Tr("Messages"), KeyAction::kMessagesTab, BottomTab::kMessages}};
  for (const auto& [label, key, tab] : tabs) {
    if (MenuItem(label, key, state.bottom == tab)) {
      DrawTab(state, tab);
    }
  }
  ImGui::Separator();
  ImGui::MenuItem(Tr("Stage over the picture"), nullptr, &state.show_stage);
  ImGui::MenuItem(Tr("Points"), nullptr, &state.show_points);
  if (MenuItem(Tr("Matches over the picture"), KeyAction::kMatches, state.show_matches)) {
    state.show_matches = !state.show_matches;
  }
  if (MenuItem(Tr("Occluders over the picture"), KeyAction::kOccluders, state.show_occluders)) {
    state.show_occluders = !state.show_occluders;
  }
  ImGui::Separator();
  if (MenuItem(Tr("Evidence"), KeyAction::kEvidence, workspace.preview().look().evidence)) {
    workspace.preview().look().evidence = !workspace.preview().look().evidence;
  }
  if (MenuItem(Tr("Sound"), KeyAction::kSound, workspace.playback().sound())) {
    workspace.playback().SetSound(!workspace.playback().sound());
  }
  ImGui::Separator();
  LookMenu(state.settings);
  ImGui::Separator();
  if (ImGui::BeginMenu(Label(Tr("Colour the points by"), "point colours").c_str())) {
    for (int i = 0; i < kPointColours; ++i) {
      const auto colour = static_cast<PointColour>(i);
      if (ImGui::MenuItem(PointColourName(colour), nullptr, state.place.colours == colour)) {
        state.place.colours = colour;
        state.view = ViewKind::kAround;
      }
    }
    ImGui::EndMenu();
  }
  if (MenuItem(Tr("Measure"), KeyAction::kMeasure, state.place.measure)) {
    state.place.measure = !state.place.measure;
  }
  if (MenuItem(Tr("Handles move in steps"), KeyAction::kSnapHandles, state.place.snap)) {
    state.place.snap = !state.place.snap;
  }
  ImGui::Separator();
  if (MenuItem(Tr("Before and after"), KeyAction::kWipe, state.show_compare)) {
    state.show_compare = !state.show_compare;
  }
  if (MenuItem(Tr("Onion skin"), KeyAction::kOnion, state.show_onion)) {
    state.show_onion = !state.show_onion;
  }
  if (MenuItem(Tr("Onion skin's moments\xe2\x80\xa6"), KeyAction::kOnionMore)) {
    AskForOnionMore(state);
  }
  ViewSourceMenu(workspace, state);
  ImGui::Separator();
  if (ImGui::MenuItem(Tr("Descriptions"), nullptr, workspace.preview().look().descriptions)) {
    workspace.preview().look().descriptions = !workspace.preview().look().descriptions;
  }
}

void SetGizmo(EditorState& state, GizmoMode mode) {
  state.gizmo = mode;
  state.drag.reset();
}

void SelectLight(const editor::Workspace& workspace, EditorState& state) {
  if (workspace.project().place() != nullptr && !workspace.project().place()->probes.empty()) {
    state.selection = {Selection::Kind::kProbe, workspace.project().place()->probes.front().name};
    state.view = ViewKind::kCamera;
  }
}

// A button of the toolbar.
struct Tool {
  Icon icon;
  const char* label;
  const char* does;  // nullptr: the text from the list of keys.
  KeyAction key = KeyAction::kNone;
};

constexpr Tool kTrain = {Icon::kTrain, TrLater("Train\xe2\x80\xa6"),
                         TrLater("Learns a place from a recording")};
constexpr Tool kAddSession = {
    Icon::kAddSession, TrLater("Add a session\xe2\x80\xa6"),
    TrLater("Merges a recording of this place in other light into its map")};
constexpr Tool kBake = {Icon::kBake, TrLater("Bake"),
                        TrLater("Builds people, their light and their voices; only what changed")};
constexpr Tool kExport = {Icon::kExport, TrLater("Export\xe2\x80\xa6"),
                          TrLater("Packs the show for visitors")};
constexpr std::array<Tool, 3> kViews = {{
    {Icon::kCameraView, TrLater("Through the camera"), nullptr, KeyAction::kCameraView},
    {Icon::kAroundView, TrLater("Around the place"), nullptr, KeyAction::kAroundView},
    {Icon::kPicks, TrLater("Picks"), nullptr, KeyAction::kPickView},
}};
constexpr std::array<Tool, 3> kModes = {{
    {Icon::kMove, TrLater("Move"), nullptr, KeyAction::kMove},
    {Icon::kTurn, TrLater("Turn"), nullptr, KeyAction::kTurn},
    {Icon::kScale, TrLater("Scale"), nullptr, KeyAction::kScale},
}};
constexpr Tool kUndo = {Icon::kUndo, TrLater("Undo"), nullptr, KeyAction::kUndo};
constexpr Tool kRedo = {Icon::kRedo, TrLater("Redo"), nullptr, KeyAction::kRedo};

std::string NameOf(const Tool& tool, bool words) {
  return words ? WithIcon(tool.icon, Tr(tool.label)) : IconText(tool.icon);
}

// Where buttons have no text, the tip begins with it.
std::string TipOf(const Tool& tool, bool words) {
  const std::string does = tool.does != nullptr ? Tr(tool.does) : TextOf(tool.key);
  const std::string tip = words ? does : std::string(Tr(tool.label)) + ": " + does;
  return tool.key != KeyAction::kNone ? WithKey(tip.c_str(), tool.key) : tip;
}

// Whether all buttons with text fit into one row; otherwise they have only icons. gap: between
// groups, pixels.
bool WordsFit(float gap) {
  const ImGuiStyle& style = ImGui::GetStyle();
  float width = 3.0f * gap;
  const auto add = [&](const Tool& tool) {
    width += ImGui::CalcTextSize(NameOf(tool, true).c_str()).x + 2.0f * style.FramePadding.x +
             style.ItemSpacing.x;
  };
  for (const Tool& tool : {kTrain, kAddSession, kBake, kExport, kUndo, kRedo}) {
    add(tool);
  }
  for (const auto& group : {kViews, kModes}) {
    std::for_each(group.begin(), group.end(), add);
  }
  return width <= ImGui::GetContentRegionAvail().x;
}

bool DrawTool(const Tool& tool, bool words, bool possible) {
  ImGui::BeginDisabled(!possible);
  const bool pressed = ImGui::Button(Label(NameOf(tool, words).c_str(), tool.label).c_str());
  ImGui::EndDisabled();
  Tip(TipOf(tool, words));
  return pressed;
}

bool DrawChoice(const char* id, std::span<const Tool> tools, bool words, int& chosen) {
  std::vector<std::string> names;
  std::vector<std::string> tips;
  for (const Tool& tool : tools) {
    names.push_back(NameOf(tool, words));
    tips.push_back(TipOf(tool, words));
  }
  std::vector<const char*> labels;
  for (const std::string& name : names) {
    labels.push_back(name.c_str());
  }
  return Segmented(id, labels, chosen, tips);
}

// Performs an action that is available everywhere.
void Do(editor::Workspace& workspace, EditorState& state, KeyAction action) {
  const bool own_undo =
      ImGui::GetIO().WantTextInput && state.focus != Focus::kScript && !TypesIntoWrappedField();
  switch (action) {
    case KeyAction::kSave:
      workspace.project().Save();
      break;
    case KeyAction::kUndo:
    case KeyAction::kRedo:
      if (!own_undo) {  // The active text field may have its own undo.
        action == KeyAction::kUndo ? workspace.project().Undo() : workspace.project().Redo();
      }
      break;
    case KeyAction::kLeave:
      state.leave = true;
      break;
    case KeyAction::kQuit:
      state.quit = true;
      break;
    case KeyAction::kKeyList:
      OpenDialog(state, Dialog::kKeys);
      break;
    case KeyAction::kEvidence:
      workspace.preview().look().evidence = !workspace.preview().look().evidence;
      break;
    case KeyAction::kTimelineTab:
      DrawTab(state, BottomTab::kTimeline);
      break;
    case KeyAction::kScriptTab:
      DrawTab(state, BottomTab::kScript);
      break;
    case KeyAction::kChecksTab:
      DrawTab(state, BottomTab::kChecks);
      break;
    case KeyAction::kMessagesTab:
      DrawTab(state, BottomTab::kMessages);
      break;
    case KeyAction::kPlay:
      workspace.playback().SetPlaying(!workspace.playback().playing());
      break;
    case KeyAction::kPanelAfter:
    case KeyAction::kPanelBefore:
      state.keyboard.Step(action == KeyAction::kPanelBefore);
      break;
    case KeyAction::kMenus:
      state.keyboard.AskForMenus();
      break;
    default:
      break;
  }
}

void DoInViews(editor::Workspace& workspace, EditorState& state, KeyAction action) {
  switch (action) {
    case KeyAction::kCameraView:
      state.view = ViewKind::kCamera;
      break;
    case KeyAction::kAroundView:
      state.view = ViewKind::kAround;
      break;
    case KeyAction::kPickView:
      state.view = ViewKind::kPicks;
      break;
    case KeyAction::kMove:
      SetGizmo(state, GizmoMode::kMove);
      break;
    case KeyAction::kTurn:
      SetGizmo(state, GizmoMode::kTurn);
      break;
    case KeyAction::kScale:
      SetGizmo(state, GizmoMode::kScale);
      break;
    case KeyAction::kLayOnFloor:
      workspace.map().LayStageOnFloor();
      break;
    case KeyAction::kLight:
      SelectLight(workspace, state);
      break;
    case KeyAction::kMatches:
      state.show_matches = !state.show_matches;
      break;
    case KeyAction::kOccluders:
      state.show_occluders = !state.show_occluders;
      break;
    case KeyAction::kWipe:
      state.show_compare = !state.show_compare;
      break;
    case KeyAction::kOnion:
      state.show_onion = !state.show_onion;
      break;
    case KeyAction::kOnionMore:
      AskForOnionMore(state);
      break;
    case KeyAction::kSound:
      workspace.playback().SetSound(!workspace.playback().sound());
      break;
    case KeyAction::kPointColours:
      state.place.colours = After(state.place.colours);
      break;
    case KeyAction::kMeasure:
      state.place.measure = !state.place.measure;
      break;
    case KeyAction::kSnapHandles:
      state.place.snap = !state.place.snap;
      break;
    case KeyAction::kFrameBack:
    case KeyAction::kFrameOn:
      workspace.playback().SetPlaying(false);
      workspace.playback().StepFrames(action == KeyAction::kFrameOn ? 1 : -1);
      break;
    case KeyAction::kUnselect:
      if (state.align.picking) {
        state.align.picking = false;
      } else {
        ChooseNoPoints(state);
      }
      break;
    default:
      break;
  }
}

bool Pressed(const EditorState& state, KeyAction walking) {
  return std::any_of(state.keys.begin(), state.keys.end(), [&](const KeyPress& press) {
    return ActionOf(KeyScope::kPanels, press) == walking;
  });
}

// Whether the key types nothing into a field.
bool IsNoTyping(const KeyPress& press) {
  return (press.modifiers & GLFW_MOD_CONTROL) != 0 ||
         (press.key >= GLFW_KEY_F1 && press.key <= GLFW_KEY_F25);
}

}  // namespace

void DrawMenuBar(editor::Workspace& workspace, EditorState& state) {
  if (!ImGui::BeginMenuBar()) {
    return;
  }
  if (ImGui::BeginMenu(Label(Tr("File"), "file").c_str())) {
    FileMenu(workspace, state);
    ImGui::EndMenu();
  }
  if (ImGui::BeginMenu(Label(Tr("Edit"), "edit").c_str())) {
    EditMenu(workspace);
    ImGui::EndMenu();
  }
  if (ImGui::BeginMenu(Label(Tr("Place"), "place").c_str())) {
    PlaceMenu(workspace, state);
    ImGui::EndMenu();
  }
  if (ImGui::BeginMenu(Label(Tr("View"), "view").c_str())) {
    ViewMenu(workspace, state);
    ImGui::EndMenu();
  }
  if (ImGui::BeginMenu(Label(Tr("Help"), "help").c_str())) {
    if (MenuItem(Tr("Keys"), KeyAction::kKeyList)) {
      OpenDialog(state, Dialog::kKeys);
    }
    if (ImGui::MenuItem(Tr("Guided tour"))) {
      state.begin_tour = true;
    }
    ImGui::EndMenu();
  }
  ImGui::EndMenuBar();
}

void DrawToolbar(editor::Workspace& workspace, EditorState& state) {
  const float gap = Px(22);
  const bool words = WordsFit(gap);
  const editor::TaskList& tasks = workspace.tasks();
  if (DrawTool(kTrain, words, !tasks.Running(editor::TaskKind::kTraining))) {
    OpenTrainDialog(workspace, state);
  }
  ImGui::SameLine();
  if (DrawTool(kAddSession, words, CanAddSession(workspace))) {
    OpenDialog(state, Dialog::kAddSession);
  }
  ImGui::SameLine();
  if (DrawTool(kBake, words, !tasks.Running(editor::TaskKind::kBaking))) {
    workspace.jobs().Bake();
  }
  ImGui::SameLine();
  if (DrawTool(kExport, words, !tasks.Running(editor::TaskKind::kExporting))) {
    OpenDialog(state, Dialog::kExport);
  }
  ImGui::SameLine(0.0f, gap);
  int view = static_cast<int>(state.view);
  if (DrawChoice("view", kViews, words, view)) {
    state.view = static_cast<ViewKind>(view);
  }
  ImGui::SameLine(0.0f, gap);
  int mode = static_cast<int>(state.gizmo);
  if (DrawChoice("gizmo", kModes, words, mode)) {
    SetGizmo(state, static_cast<GizmoMode>(mode));
  }
  ImGui::SameLine(0.0f, gap);
  if (DrawTool(kUndo, words, workspace.project().commands().CanUndo())) {
    workspace.project().Undo();
  }
  ImGui::SameLine();
  if (DrawTool(kRedo, words, workspace.project().commands().CanRedo())) {
    workspace.project().Redo();
  }
}

void HandleShortcuts(editor::Workspace& workspace, EditorState& state) {
  if (state.dialog != Dialog::kNone) {
    return;
  }
  if (ImGui::GetIO().WantTextInput && Pressed(state, KeyAction::kStopWalking)) {
    // Escape restores the old text as a separate command, so that undo brings the typed text back.
    workspace.project().EndGesture();
  }
  for (const KeyPress& press : state.keys) {
    if (ImGui::GetIO().WantTextInput && !IsNoTyping(press)) {
      continue;
    }
    if (const KeyAction action = ActionOf(KeyScope::kAlways, press); action != KeyAction::kNone) {
      Do(workspace, state, action);
    } else if (!HandleLightKey(workspace, state, press)) {
      DoInViews(workspace, state, ActionOf(KeyScope::kViews, press));
    }
  }
}

}  // namespace lararium::panels
