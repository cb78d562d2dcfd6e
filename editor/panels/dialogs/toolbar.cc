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

void OpenTrainDialog(const editor::Workspace& workspace, Dialogs& dialogs) {
  if (dialogs.Open(Dialog::kTrain)) {
    return;
  }
  if (const editor::PlaceDocument* place = workspace.project().place()) {
    dialogs.fields.place = place->label();
    dialogs.fields.file = place->training.path;
    dialogs.fields.images = place->training.kind == editor::SourceDocument::Kind::kImages;
    dialogs.fields.intrinsics = place->intrinsics ? editor::IntrinsicsText(*place->intrinsics) : "";
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

void FileMenu(editor::Workspace& workspace, Dialogs& dialogs, EditorActions& actions) {
  if (MenuItem(Tr("New or open\xe2\x80\xa6"), KeyAction::kLeave)) {
    actions.push_back(CloseProject{});
  }
  if (MenuItem(Tr("Save"), KeyAction::kSave)) {
    workspace.project().Save();
  }
  if (ImGui::MenuItem(Tr("Export\xe2\x80\xa6"))) {
    dialogs.Open(Dialog::kExport);
  }
  ImGui::Separator();
  if (MenuItem(Tr("Quit"), KeyAction::kQuit)) {
    actions.push_back(CloseWindow{});
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

void PlaceMenu(editor::Workspace& workspace,
               Selection& selection,
               ViewOptions& options,
               Dialogs& dialogs) {
  const bool training = workspace.tasks().Running(editor::TaskKind::kTraining);
  if (ImGui::MenuItem(Tr("Train\xe2\x80\xa6"), nullptr, false, !training)) {
    OpenTrainDialog(workspace, dialogs);
  }
  if (ImGui::MenuItem(Tr("Add a session\xe2\x80\xa6"), nullptr, false, CanAddSession(workspace))) {
    dialogs.Open(Dialog::kAddSession);
  }
  if (ImGui::MenuItem(Tr("The training's report\xe2\x80\xa6"), nullptr, false,
                      workspace.map().loaded().report != nullptr)) {
    dialogs.Open(Dialog::kTrainingReport);
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
    dialogs.Open(Dialog::kOccluder);
  }
  if (ImGui::MenuItem(Tr("Draw an occluder"), nullptr, false,
                      any && workspace.map().loaded().database != nullptr)) {
    DrawNewOccluder(workspace, selection, options);
  }
  if (ImGui::MenuItem(Tr("Add a light probe\xe2\x80\xa6"), nullptr, false, any)) {
    dialogs.Open(Dialog::kProbe);
  }
  if (ImGui::MenuItem(Tr("Add a check point\xe2\x80\xa6"), nullptr, false, any)) {
    dialogs.Open(Dialog::kCheckPoint);
  }
  if (ImGui::MenuItem(Tr("Add a person\xe2\x80\xa6"))) {
    dialogs.Open(Dialog::kCast);
  }
}

void DrawTab(Input& input, EditorActions& actions, BottomTab tab) {
  actions.push_back(OpenTab{tab});
  input.focus = tab == BottomTab::kTimeline ? Focus::kTimeline : Focus::kViews;
}

// The menu of the camera view's source.
void ViewSourceMenu(editor::Workspace& workspace, Dialogs& dialogs) {
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
    dialogs.Open(Dialog::kLiveCamera);
  }
  ImGui::EndMenu();
}

// Opens the settings of the onion skin, and switches it on so that the result is visible.
void AskForOnionMore(ViewOptions& options, EditorActions& actions) {
  options.view = ViewKind::kCamera;
  options.show_onion = true;
  actions.push_back(OpenOnionSettings{});
}

void ViewMenu(const PanelContext& context, BottomTab bottom, editor::Settings& settings) {
  auto [workspace, selection, options, tools, cast, pictures, input, dialogs, actions] = context;
  const std::tuple<const char*, KeyAction, ViewKind> views[] = {
      {Tr("Through the camera"), KeyAction::kCameraView, ViewKind::kCamera},
      {Tr("Around the place"), KeyAction::kAroundView, ViewKind::kAround},
      {Tr("Picks"), KeyAction::kPickView, ViewKind::kPicks}};
  for (const auto& [label, key, view] : views) {
    if (MenuItem(label, key, options.view == view)) {
      options.view = view;
    }
  }
  ImGui::Separator();
  const std::tuple<const char*, KeyAction, BottomTab> tabs[] = {
      {Tr("Timeline"), KeyAction::kTimelineTab, BottomTab::kTimeline},
      {Tr("Script"), KeyAction::kScriptTab, BottomTab::kScript},
      {Tr("Checks"), KeyAction::kChecksTab, BottomTab::kChecks},
      {Tr("Messages"), KeyAction::kMessagesTab, BottomTab::kMessages}};
  for (const auto& [label, key, tab] : tabs) {
    if (MenuItem(label, key, bottom == tab)) {
      DrawTab(input, actions, tab);
    }
  }
  ImGui::Separator();
  ImGui::MenuItem(Tr("Stage over the picture"), nullptr, &options.show_stage);
  ImGui::MenuItem(Tr("Points"), nullptr, &options.show_points);
  if (MenuItem(Tr("Matches over the picture"), KeyAction::kMatches, options.show_matches)) {
    options.show_matches = !options.show_matches;
  }
  if (MenuItem(Tr("Occluders over the picture"), KeyAction::kOccluders, options.show_occluders)) {
    options.show_occluders = !options.show_occluders;
  }
  ImGui::Separator();
  if (MenuItem(Tr("Evidence"), KeyAction::kEvidence, workspace.preview().look().evidence)) {
    workspace.preview().look().evidence = !workspace.preview().look().evidence;
  }
  if (MenuItem(Tr("Sound"), KeyAction::kSound, workspace.playback().sound())) {
    workspace.playback().SetSound(!workspace.playback().sound());
  }
  ImGui::Separator();
  LookMenu(settings);
  ImGui::Separator();
  if (ImGui::BeginMenu(Label(Tr("Colour the points by"), "point colours").c_str())) {
    for (int i = 0; i < kPointColours; ++i) {
      const auto colour = static_cast<PointColour>(i);
      if (ImGui::MenuItem(PointColourName(colour), nullptr, tools.place.colours == colour)) {
        tools.place.colours = colour;
        options.view = ViewKind::kAround;
      }
    }
    ImGui::EndMenu();
  }
  if (MenuItem(Tr("Measure"), KeyAction::kMeasure, tools.place.measure)) {
    tools.place.measure = !tools.place.measure;
  }
  if (MenuItem(Tr("Handles move in steps"), KeyAction::kSnapHandles, options.snap)) {
    options.snap = !options.snap;
  }
  ImGui::Separator();
  if (MenuItem(Tr("Before and after"), KeyAction::kWipe, options.show_compare)) {
    options.show_compare = !options.show_compare;
  }
  if (MenuItem(Tr("Onion skin"), KeyAction::kOnion, options.show_onion)) {
    options.show_onion = !options.show_onion;
  }
  if (MenuItem(Tr("Onion skin's moments\xe2\x80\xa6"), KeyAction::kOnionMore)) {
    AskForOnionMore(options, actions);
  }
  ViewSourceMenu(workspace, dialogs);
  ImGui::Separator();
  if (ImGui::MenuItem(Tr("Descriptions"), nullptr, workspace.preview().look().descriptions)) {
    workspace.preview().look().descriptions = !workspace.preview().look().descriptions;
  }
}

void SetGizmo(GizmoTool& gizmo, GizmoMode mode) {
  gizmo.mode = mode;
  gizmo.drag.reset();
}

void SelectLight(const editor::Workspace& workspace, Selection& selection, ViewOptions& options) {
  if (workspace.project().place() != nullptr && !workspace.project().place()->probes.empty()) {
    selection = {Selection::Kind::kProbe, workspace.project().place()->probes.front().name};
    options.view = ViewKind::kCamera;
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
void Do(editor::Workspace& workspace,
        Input& input,
        Dialogs& dialogs,
        EditorActions& actions,
        KeyAction action) {
  const bool own_undo =
      ImGui::GetIO().WantTextInput && input.focus != Focus::kScript && !TypesIntoWrappedField();
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
      actions.push_back(CloseProject{});
      break;
    case KeyAction::kQuit:
      actions.push_back(CloseWindow{});
      break;
    case KeyAction::kKeyList:
      dialogs.Open(Dialog::kKeys);
      break;
    case KeyAction::kEvidence:
      workspace.preview().look().evidence = !workspace.preview().look().evidence;
      break;
    case KeyAction::kTimelineTab:
      DrawTab(input, actions, BottomTab::kTimeline);
      break;
    case KeyAction::kScriptTab:
      DrawTab(input, actions, BottomTab::kScript);
      break;
    case KeyAction::kChecksTab:
      DrawTab(input, actions, BottomTab::kChecks);
      break;
    case KeyAction::kMessagesTab:
      DrawTab(input, actions, BottomTab::kMessages);
      break;
    case KeyAction::kPlay:
      workspace.playback().SetPlaying(!workspace.playback().playing());
      break;
    case KeyAction::kPanelAfter:
    case KeyAction::kPanelBefore:
      input.keyboard.Step(action == KeyAction::kPanelBefore);
      break;
    case KeyAction::kMenus:
      input.keyboard.AskForMenus();
      break;
    default:
      break;
  }
}

void DoInViews(const PanelContext& context, KeyAction action) {
  auto [workspace, selection, options, tools, cast, pictures, input, dialogs, actions] = context;
  switch (action) {
    case KeyAction::kCameraView:
      options.view = ViewKind::kCamera;
      break;
    case KeyAction::kAroundView:
      options.view = ViewKind::kAround;
      break;
    case KeyAction::kPickView:
      options.view = ViewKind::kPicks;
      break;
    case KeyAction::kMove:
      SetGizmo(tools.gizmo, GizmoMode::kMove);
      break;
    case KeyAction::kTurn:
      SetGizmo(tools.gizmo, GizmoMode::kTurn);
      break;
    case KeyAction::kScale:
      SetGizmo(tools.gizmo, GizmoMode::kScale);
      break;
    case KeyAction::kLayOnFloor:
      workspace.map().LayStageOnFloor();
      break;
    case KeyAction::kLight:
      SelectLight(workspace, selection, options);
      break;
    case KeyAction::kMatches:
      options.show_matches = !options.show_matches;
      break;
    case KeyAction::kOccluders:
      options.show_occluders = !options.show_occluders;
      break;
    case KeyAction::kWipe:
      options.show_compare = !options.show_compare;
      break;
    case KeyAction::kOnion:
      options.show_onion = !options.show_onion;
      break;
    case KeyAction::kOnionMore:
      AskForOnionMore(options, actions);
      break;
    case KeyAction::kSound:
      workspace.playback().SetSound(!workspace.playback().sound());
      break;
    case KeyAction::kPointColours:
      tools.place.colours = After(tools.place.colours);
      break;
    case KeyAction::kMeasure:
      tools.place.measure = !tools.place.measure;
      break;
    case KeyAction::kSnapHandles:
      options.snap = !options.snap;
      break;
    case KeyAction::kFrameBack:
    case KeyAction::kFrameOn:
      workspace.playback().SetPlaying(false);
      workspace.playback().StepFrames(action == KeyAction::kFrameOn ? 1 : -1);
      break;
    case KeyAction::kUnselect:
      if (tools.align.picking) {
        tools.align.picking = false;
      } else {
        ChooseNoPoints(tools.place);
      }
      break;
    default:
      break;
  }
}

bool Pressed(const Input& input, KeyAction walking) {
  return std::any_of(input.keys.begin(), input.keys.end(), [&](const KeyPress& press) {
    return ActionOf(KeyScope::kPanels, press) == walking;
  });
}

// Whether the key types nothing into a field.
bool IsNoTyping(const KeyPress& press) {
  return (press.modifiers & GLFW_MOD_CONTROL) != 0 ||
         (press.key >= GLFW_KEY_F1 && press.key <= GLFW_KEY_F25);
}

}  // namespace

void DrawMenuBar(const PanelContext& context, BottomTab bottom, editor::Settings& settings) {
  auto [workspace, selection, options, tools, cast, pictures, input, dialogs, actions] = context;
  if (!ImGui::BeginMenuBar()) {
    return;
  }
  if (ImGui::BeginMenu(Label(Tr("File"), "file").c_str())) {
    FileMenu(workspace, dialogs, actions);
    ImGui::EndMenu();
  }
  if (ImGui::BeginMenu(Label(Tr("Edit"), "edit").c_str())) {
    EditMenu(workspace);
    ImGui::EndMenu();
  }
  if (ImGui::BeginMenu(Label(Tr("Place"), "place").c_str())) {
    PlaceMenu(workspace, selection, options, dialogs);
    ImGui::EndMenu();
  }
  if (ImGui::BeginMenu(Label(Tr("View"), "view").c_str())) {
    ViewMenu(context, bottom, settings);
    ImGui::EndMenu();
  }
  if (ImGui::BeginMenu(Label(Tr("Help"), "help").c_str())) {
    if (MenuItem(Tr("Keys"), KeyAction::kKeyList)) {
      dialogs.Open(Dialog::kKeys);
    }
    if (ImGui::MenuItem(Tr("Guided tour"))) {
      actions.push_back(StartTour{});
    }
    ImGui::EndMenu();
  }
  ImGui::EndMenuBar();
}

void DrawToolbar(editor::Workspace& workspace,
                 ViewOptions& options,
                 GizmoTool& gizmo,
                 Dialogs& dialogs) {
  const float gap = Px(22);
  const bool words = WordsFit(gap);
  const editor::TaskList& tasks = workspace.tasks();
  if (DrawTool(kTrain, words, !tasks.Running(editor::TaskKind::kTraining))) {
    OpenTrainDialog(workspace, dialogs);
  }
  ImGui::SameLine();
  if (DrawTool(kAddSession, words, CanAddSession(workspace))) {
    dialogs.Open(Dialog::kAddSession);
  }
  ImGui::SameLine();
  if (DrawTool(kBake, words, !tasks.Running(editor::TaskKind::kBaking))) {
    workspace.jobs().Bake();
  }
  ImGui::SameLine();
  if (DrawTool(kExport, words, !tasks.Running(editor::TaskKind::kExporting))) {
    dialogs.Open(Dialog::kExport);
  }
  ImGui::SameLine(0.0f, gap);
  int view = static_cast<int>(options.view);
  if (DrawChoice("view", kViews, words, view)) {
    options.view = static_cast<ViewKind>(view);
  }
  ImGui::SameLine(0.0f, gap);
  int mode = static_cast<int>(gizmo.mode);
  if (DrawChoice("gizmo", kModes, words, mode)) {
    SetGizmo(gizmo, static_cast<GizmoMode>(mode));
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

void HandleShortcuts(const PanelContext& context) {
  auto [workspace, selection, options, tools, cast, pictures, input, dialogs, actions] = context;
  if (dialogs.shown != Dialog::kNone) {
    return;
  }
  if (ImGui::GetIO().WantTextInput && Pressed(input, KeyAction::kStopWalking)) {
    // Escape restores the old text as a separate command, so that undo brings the typed text back.
    workspace.project().EndGesture();
  }
  for (const KeyPress& press : input.keys) {
    if (ImGui::GetIO().WantTextInput && !IsNoTyping(press)) {
      continue;
    }
    if (const KeyAction action = ActionOf(KeyScope::kAlways, press); action != KeyAction::kNone) {
      Do(workspace, input, dialogs, actions, action);
    } else if (!HandleLightKey(workspace, selection, options, tools.light, press)) {
      DoInViews(context, ActionOf(KeyScope::kViews, press));
    }
  }
}

}  // namespace lararium::panels
