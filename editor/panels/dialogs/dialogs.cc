#include "editor/panels/dialogs/dialogs.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <string>

#include "editor/document/document_fields.h"
#include "editor/document/titles.h"
#include "editor/import/cast/cast_presets.h"
#include "editor/import/objects/object_library.h"
#include "editor/panels/dialogs/export_panel.h"
#include "editor/panels/dialogs/key_list.h"
#include "editor/panels/dialogs/training_report_panel.h"
#include "editor/panels/inspector/occluder_inspector.h"
#include "editor/panels/viewport/check_point_panel.h"
#include "editor/panels/viewport/pick_view.h"
#include "editor/panels/viewport/view_tools.h"
#include "editor/panels/widgets/key_state.h"
#include "editor/panels/widgets/text.h"
#include "editor/panels/widgets/theme.h"
#include "editor/panels/widgets/widgets.h"
#include "shared/core/file.h"

namespace lararium::panels {

namespace {

// The last row of the open dialog; both buttons close it. Returns true when the action was chosen.
bool DialogDone(Dialogs& dialogs, const char* action, const DialogProblem& problem) {
  const DialogAnswer answer = DialogButtons(action, problem);
  if (answer != DialogAnswer::kNone) {
    dialogs.left.erase(dialogs.shown);
    dialogs.shown = Dialog::kNone;
  }
  return answer == DialogAnswer::kAct;
}

bool Exists(const editor::ProjectPaths& paths, const std::string& file) {
  return !file.empty() && FileExists(paths.Resolve(file));
}

// Parses "600, 600, 320, 240"; empty where there are not 4 or 8 numbers.
std::vector<double> ParseNumbers(const std::string& text) {
  std::vector<double> numbers;
  const char* at = text.c_str();
  while (*at != '\0') {
    char* end = nullptr;
    numbers.push_back(std::strtod(at, &end));
    if (end == at) {
      return {};
    }
    at = end;
    while (*at == ',' || *at == ' ') {
      ++at;
    }
  }
  return numbers.size() == 4 || numbers.size() == 8 ? numbers : std::vector<double>();
}

DialogProblem TrainProblem(const editor::Workspace& workspace,
                           const ChosenPlace& place,
                           const DialogFields& fields) {
  const DialogProblem problem = PlaceProblem(workspace.project().document(), place);
  return problem.any() ? problem : RecordingProblem(workspace.project().paths(), fields);
}

// Why the typed file cannot be used.
DialogProblem FileProblem(const editor::ProjectPaths& paths, const std::string& file) {
  return file.empty()           ? Missing(Tr("Choose a file."))
         : !Exists(paths, file) ? Wrong(Tr("Choose a file that exists."))
                                : DialogProblem();
}

// The recording of the input, with its intrinsics. Opens the recording, because the intrinsics need
// its image size.
Result<editor::SessionDocument> ChosenRecording(const editor::Workspace& workspace,
                                                const DialogFields& fields) {
  editor::SessionDocument recording;
  recording.source = {
      fields.images ? editor::SourceDocument::Kind::kImages : editor::SourceDocument::Kind::kVideo,
      workspace.project().paths().Shorten(workspace.project().paths().Resolve(fields.file))};
  if (const std::vector<double> numbers = ParseNumbers(fields.intrinsics); !numbers.empty()) {
    LARARIUM_ASSIGN_OR_RETURN(const auto source,
                              editor::OpenSource(workspace.project().paths(), recording.source));
    LARARIUM_ASSIGN_OR_RETURN(
        recording.intrinsics,
        geometry::CameraModel::FromNumbers(numbers, source->width(), source->height()));
  }
  return recording;
}

// Returns true when the user wants to calibrate the camera.
bool TrainDialog(editor::Workspace& workspace, Dialogs& dialogs) {
  DialogFields& fields = dialogs.fields;
  Hint(
      Tr("Learns the place from a recording: walk sideways around it, slowly, with everything in "
         "view that visitors will see."));
  bool calibrate = false;
  ChosenPlace place;
  const editor::ProjectDocument& document = workspace.project().document();
  if (BeginProperties("train")) {
    place = PlaceRows(document, fields);
    calibrate = RecordingFields(workspace.project().paths().folder, fields, Tr(kFromVideo),
                                Tr(kFromVideoHint));
    EndProperties();
  }
  if (place.title.empty()) {
    Hint(" ");  // The dialog keeps its size while the title is typed.
  } else {
    Hint(Text(place.known ? Tr("%s is trained again; its picks keep the stage where it is.")
              : document.places.empty() ? Tr("%s will be the place of the drama.")
                                        : Tr("%s will be another place of the drama."),
              place.title.c_str()));
  }
  if (ImGui::Button(Tr("Film it with a camera instead\xe2\x80\xa6"), ImVec2(-FLT_MIN, 0))) {
    dialogs.shown = Dialog::kFilm;
    return false;
  }
  if (DialogDone(dialogs, Tr("Train"), TrainProblem(workspace, place, fields))) {
    TrainRecording(workspace, place, fields);
  }
  return calibrate;
}

// Returns true when the user wants to calibrate the camera.
bool AddSessionDialog(editor::Workspace& workspace, Dialogs& dialogs) {
  DialogFields& fields = dialogs.fields;
  Hint(
      Tr("Merges a recording of the place in other light into the map, so that "
         "visitors are located in both. The stage stays where it is."));
  bool calibrate = false;
  if (BeginProperties("add session")) {
    calibrate =
        RecordingFields(workspace.project().paths().folder, fields, Tr("as the map's camera"),
                        Tr("Empty: it was filmed with the camera of the map."));
    EndProperties();
  }
  if (DialogDone(dialogs, Tr("Add"), RecordingProblem(workspace.project().paths(), fields))) {
    const Result<editor::SessionDocument> recording = ChosenRecording(workspace, fields);
    if (recording.ok()) {
      workspace.training().AddSession(*recording);
    } else {
      workspace.messages().Tell(editor::Message::Level::kError, recording.message());
    }
  }
  return calibrate;
}

template <typename Entry>
bool Taken(const std::vector<Entry>& entries, const std::string& name) {
  return std::any_of(entries.begin(), entries.end(),
                     [&](const Entry& entry) { return entry.name == name; });
}

std::string DocumentPath(const editor::Workspace& workspace, const std::string& typed) {
  return typed.empty()
             ? ""
             : workspace.project().paths().Shorten(workspace.project().paths().Resolve(typed));
}

// A name that is not in use: "box", "box2" and so on.
template <typename Entry>
std::string FreeName(const std::vector<Entry>& known, const std::string& kind) {
  std::string name = kind;
  for (int number = 2; Taken(known, name); ++number) {
    name = kind + std::to_string(number);
  }
  return name;
}

// The kind and the sizes of a shape.
void ShapeFields(editor::Workspace& workspace, editor::OccluderShape& shape) {
  std::vector<const char*> kinds;
  for (const editor::ShapeEntry& entry : editor::ShapeEntries()) {
    kinds.push_back(Tr(entry.label));
  }
  PropertyLabel(Tr("Shape"));
  int kind = static_cast<int>(shape.kind);
  if (Segmented("shape", kinds, kind)) {
    shape = editor::ShapeEntries()[static_cast<size_t>(kind)].usual;
  }
  ShapeSizes(workspace, shape);
}

// A shape or a model. Without a name it is named after its kind.
void OccluderDialog(editor::Workspace& workspace,
                    Selection& selection,
                    ViewOptions& options,
                    Dialogs& dialogs) {
  if (workspace.project().place() == nullptr) {
    dialogs.shown = Dialog::kNone;
    return;
  }
  DialogFields& fields = dialogs.fields;
  Hint(Tr("It is real, and hides who is behind it."));
  const char* const ways[] = {Tr("Shape"), Tr("Model")};
  int way = fields.own_model ? 1 : 0;
  if (Segmented("way", ways, way)) {
    fields.own_model = way == 1;
  }
  ImGui::Dummy(ImVec2(0, Px(2)));  // Such a row leaves no space below it.
  const std::vector<editor::OccluderDocument>& known = workspace.project().place()->occluders;
  const std::string usual_name =
      fields.own_model ? "" : FreeName(known, editor::EntryOf(fields.shape.kind).name);
  if (BeginProperties("occluder")) {
    PropertyLabel(Tr("Name"));
    ImGui::InputTextWithHint("##name", usual_name.c_str(), &fields.name);
    if (fields.own_model) {
      PropertyLabel(Tr("File"));
      PathField("file", fields.file, workspace.project().paths().folder, FileType::kMesh);
    } else {
      ShapeFields(workspace, fields.shape);
    }
    EndProperties();
  }
  Hint(fields.own_model ? Tr("In stage axes and metres where possible.")
                        : Tr("It is put on the stage's floor, where the camera looks."));
  editor::OccluderDocument occluder;
  occluder.name = fields.name.empty() ? usual_name : fields.name;
  DialogProblem problem = NameProblem(occluder.name);
  if (Taken(known, occluder.name)) {
    problem = Wrong(Tr("That name is taken."));
  }
  if (!problem.any() && fields.own_model) {
    problem = FileProblem(workspace.project().paths(), fields.file);
  }
  if (DialogDone(dialogs, Tr("Add"), problem)) {
    if (fields.own_model) {
      occluder.file = DocumentPath(workspace, fields.file);
    } else {
      occluder = editor::NewOccluder(occluder.name, fields.shape);
      const auto& picture = workspace.preview().picture();
      occluder.stage_from_mesh.translation =
          editor::FloorBefore(picture != nullptr ? picture->camera_from_stage : std::nullopt);
    }
    workspace.project().EditPlace(
        Sentence("add %s", {occluder.name}),
        [&](editor::PlaceDocument& place) { place.occluders.push_back(occluder); });
    selection = {Selection::Kind::kOccluder, occluder.name};
  }
  if (workspace.map().loaded().database != nullptr &&
      ImGui::Button(Tr("Draw it on the training images instead"), ImVec2(-FLT_MIN, 0))) {
    dialogs.shown = Dialog::kNone;
    DrawNewOccluder(workspace, selection, options);
  }
}

// Copies a recipe into the project, where its sliders change it; a model stays where it is.
void LoadFigure(editor::Workspace& workspace,
                const std::string& file,
                editor::CastDocument& member) {
  if (!file.ends_with(".json")) {
    member.model = DocumentPath(workspace, file);
    return;
  }
  Result<import::CastRecipe> recipe =
      import::LoadCastRecipe(workspace.project().paths().Resolve(file));
  if (recipe.ok()) {
    member.recipe = *std::move(recipe);
  } else {
    workspace.messages().Tell(editor::Message::Level::kError, recipe.message());
  }
}

// The presets as pictures; a second click on the selected one deselects it. Returns true when the
// choice has changed.
bool PresetGrid(editor::Workspace& workspace, PictureTextures& pictures, Dialogs& dialogs) {
  DialogFields& fields = dialogs.fields;
  const std::vector<std::string> names = import::CastPresetNames();
  const float gap = ImGui::GetStyle().ItemSpacing.x;
  const auto columns = static_cast<float>(std::max<size_t>(names.size(), 1));
  const float side =
      std::floor((ImGui::GetContentRegionAvail().x - (columns - 1.0f) * gap) / columns);
  bool changed = false;
  workspace.cast().pictures().WantPresets();
  for (const std::string& name : names) {
    ImGui::PushID(name.c_str());
    const ImVec2 from = ImGui::GetCursorScreenPos();
    const float height = side + ImGui::GetTextLineHeight() + Px(6);
    ImGui::BeginGroup();
    DrawThumbnail(pictures, "preset " + name, workspace.cast().pictures().PresetThumbnail(name),
                  side);
    DimText(name);
    ImGui::EndGroup();
    ImGui::SetCursorScreenPos(from);
    if (ImGui::InvisibleButton("choose", ImVec2(side, height))) {
      fields.preset = fields.preset == name ? "" : name;
      changed = true;
    }
    const bool chosen = fields.preset == name;
    if (chosen || ImGui::IsItemHovered()) {
      ImGui::GetWindowDrawList()->AddRect(from, ImVec2(from.x + side, from.y + side),
                                          Packed(chosen ? Colours().accent : Colours().dim),
                                          ImGui::GetStyle().FrameRounding, 0,
                                          Px(chosen ? 3.0f : 1.0f));
    }
    ImGui::SameLine(0, gap);
    ImGui::PopID();
  }
  ImGui::NewLine();
  return changed;
}

DialogProblem CastProblem(const editor::Workspace& workspace, const DialogFields& fields) {
  if (!fields.preset.empty() && !fields.file.empty()) {
    return Wrong(Tr("Choose a preset or a file."));
  }
  return fields.file.empty() || Exists(workspace.project().paths(), fields.file)
             ? DialogProblem()
             : Wrong(Tr("Choose a file that exists."));
}

void CastDialog(editor::Workspace& workspace,
                Selection& selection,
                PictureTextures& pictures,
                Dialogs& dialogs) {
  Hint(
      Tr("One of the people that come with the editor, a recipe of your own (.json), or a rigged "
         "figure to import. Without any: the plain figure that is built in."));
  DialogFields& fields = dialogs.fields;
  const std::string before = fields.preset;
  if (PresetGrid(workspace, pictures, dialogs) && fields.title == before) {
    fields.title = fields.preset;
  }
  TitledName person;
  const auto taken = [&](const std::string& name) {
    return Taken(workspace.project().document().cast, name);
  };
  if (BeginProperties("cast")) {
    person = TitleRows(Tr("Name"), Tr("In the drama"), "person", taken, fields.title, fields.name);
    PropertyLabel(Tr("File"));
    PathField("file", fields.file, workspace.project().paths().folder, FileType::kFigure);
    EndProperties();
  }
  DialogProblem problem = TitleProblem(person, taken);
  if (!problem.any()) {
    problem = CastProblem(workspace, fields);
  }
  if (DialogDone(dialogs, Tr("Add"), problem)) {
    editor::CastDocument member;
    member.name = person.name;
    editor::SetTitle(person.title, member);
    member.preset = fields.preset;
    LoadFigure(workspace, fields.file, member);
    workspace.project().Edit(
        Sentence("add %s", {member.label()}),
        [&](editor::ProjectDocument& document) { document.cast.push_back(member); });
    selection = {Selection::Kind::kActor, member.name};
  }
}

// The choice of an object of the library; the first one at the beginning.
void LibraryObject(std::string& model) {
  if (model.empty()) {
    const std::vector<std::string> names = import::LibraryObjectNames();
    model = names.empty() ? "" : names.front();
  }
  if (!ImGui::BeginCombo("##model", model.c_str())) {
    return;
  }
  for (const std::string& name : import::LibraryObjectNames()) {
    if (ImGui::Selectable(name.c_str(), name == model)) {
      model = name;
    }
  }
  ImGui::EndCombo();
}

// An object of the library or a model. Without a name it is named after its model.
void ObjectDialog(editor::Workspace& workspace, Selection& selection, Dialogs& dialogs) {
  Hint(Tr("A thing that people of the drama use. Where it stands is chosen afterwards."));
  DialogFields& fields = dialogs.fields;
  const char* const ways[] = {Tr("From the library"), Tr("A model of your own")};
  int way = fields.own_model ? 1 : 0;
  if (Segmented("way", ways, way)) {
    fields.own_model = way == 1;
  }
  ImGui::Dummy(ImVec2(0, Px(2)));  // Such a row leaves no space below it.
  editor::ObjectDocument object;
  if (BeginProperties("object")) {
    PropertyLabel(Tr("Model"));
    if (fields.own_model) {
      PathField("file", fields.file, workspace.project().paths().folder, FileType::kMesh);
      object.file = DocumentPath(workspace, fields.file);
    } else {
      LibraryObject(fields.model);
      object.model = fields.model;
    }
    EndProperties();
  }
  const std::vector<editor::ObjectDocument>& known = workspace.project().document().objects;
  const std::string kind = object.model + std::filesystem::path(object.file).stem().string();
  const std::string usual_name = editor::IsPlainName(kind) ? FreeName(known, kind) : "";
  if (BeginProperties("name")) {
    PropertyLabel(Tr("Name"));
    ImGui::InputTextWithHint("##name", usual_name.c_str(), &fields.name);
    EndProperties();
  }
  if (fields.own_model) {
    Hint(
        Tr("In metres, upright, as it stands. How people use it is said in NAME.object.json beside "
           "it; without that file it only stands there."));
  }
  object.name = fields.name.empty() ? usual_name : fields.name;
  DialogProblem problem =
      fields.own_model ? FileProblem(workspace.project().paths(), fields.file) : DialogProblem();
  if (!problem.any()) {
    problem = NameProblem(object.name);
  }
  if (Taken(known, object.name)) {
    problem = Wrong(Tr("That name is taken."));
  }
  if (DialogDone(dialogs, Tr("Add"), problem)) {
    workspace.project().Edit(
        Sentence("add %s", {object.name}),
        [&](editor::ProjectDocument& document) { document.objects.push_back(object); });
    selection = {Selection::Kind::kObject, object.name};
  }
}

void ProbeDialog(editor::Workspace& workspace, Selection& selection, Dialogs& dialogs) {
  Hint(
      Tr("An equirectangular HDR photograph, twice as wide as high, its centre looking along the "
         "stage's -Z. Where and when it was taken is said afterwards."));
  DialogFields& fields = dialogs.fields;
  if (BeginProperties("probe")) {
    PropertyLabel(Tr("Name"));
    ImGui::InputText("##name", &fields.name);
    PropertyLabel(Tr("File"));
    PathField("file", fields.file, workspace.project().paths().folder, FileType::kProbe);
    EndProperties();
  }
  DialogProblem problem = NameProblem(fields.name);
  if (Taken(workspace.project().place()->probes, fields.name)) {
    problem = Wrong(Tr("That name is taken."));
  }
  if (!problem.any()) {
    problem = FileProblem(workspace.project().paths(), fields.file);
  }
  if (DialogDone(dialogs, Tr("Add"), problem)) {
    editor::ProbeDocument probe;
    probe.name = fields.name;
    probe.file = DocumentPath(workspace, fields.file);
    workspace.project().EditPlace(
        Sentence("add %s", {probe.name}),
        [&](editor::PlaceDocument& place) { place.probes.push_back(probe); });
    selection = {Selection::Kind::kProbe, probe.name};
  }
}

// Asks before long work is stopped.
void LeaveDialog(editor::Workspace& workspace, Dialogs& dialogs, EditorActions& actions) {
  Hint(workspace.tasks().Running(editor::TaskKind::kTraining)
           ? Tr("The place is being trained. Leaving stops that: the place keeps the map that it "
                "has.")
           : Tr("The show is being exported. Leaving stops that: nothing is written."));
  switch (DialogButtons(Tr("Stay"), {}, Tr("Stop it and leave"))) {
    case DialogAnswer::kNone:
      break;
    case DialogAnswer::kAct:
      dialogs.shown = Dialog::kNone;
      break;
    case DialogAnswer::kCancel:
      actions.push_back(StopWorkAndLeave{});
      break;
  }
}

// Asks what a dropped model is, and opens the dialog for it.
void DroppedModelDialog(const editor::Workspace& workspace, Dialogs& dialogs) {
  const std::string file = dialogs.fields.file;
  const std::filesystem::path name = std::filesystem::path(file).filename();
  Hint(Text(Tr("What is %s?"), name.c_str()));
  const auto choice = [&](const char* label, Dialog dialog, bool possible) {
    ImGui::BeginDisabled(!possible);
    if (ImGui::Button(label, ImVec2(-FLT_MIN, Px(34)))) {
      dialogs.shown = dialog;
      dialogs.fields = {};
      dialogs.fields.file = file;
      dialogs.fields.own_model = true;
      dialogs.fields.title = dialog == Dialog::kCast ? name.stem().string() : "";
    }
    ImGui::EndDisabled();
  };
  const bool person = HasExtension(name, SpecOf(FileType::kFigure).extensions);
  choice(Tr("A person, with bones"), Dialog::kCast, person);
  choice(Tr("An object that people use"), Dialog::kObject, Fits(file, FileType::kMesh));
  choice(Tr("A real thing that hides people (occluder)"), Dialog::kOccluder,
         workspace.project().place() != nullptr && Fits(file, FileType::kMesh));
  ImGui::Dummy(ImVec2(0, Px(4)));
  if (ImGui::Button(Tr("Cancel"), ImVec2(-FLT_MIN, 0))) {
    dialogs.shown = Dialog::kNone;
  }
}

void DropMessageDialog(Dialogs& dialogs) {
  ImGui::TextWrapped("%s", dialogs.fields.title.c_str());
  ImGui::Dummy(ImVec2(0, Px(4)));
  if (ImGui::Button(Tr("Close"), ImVec2(-FLT_MIN, 0)) ||
      (!ImGui::IsWindowAppearing() && EnterIsPressed())) {
    dialogs.shown = Dialog::kNone;
  }
}

struct DialogEntry {
  Dialog dialog;
  const char* title;
};

// The dialogs that are drawn here, with their titles.
constexpr DialogEntry kDialogs[] = {{Dialog::kTrain, TrLater("Train a place")},
                                    {Dialog::kTrainingReport, TrLater("The training's report")},
                                    {Dialog::kAddSession, TrLater("Add a session")},
                                    {Dialog::kExport, TrLater("Export the show")},
                                    {Dialog::kOccluder, TrLater("Add an occluder")},
                                    {Dialog::kProbe, TrLater("Light probe")},
                                    {Dialog::kCast, TrLater("Add a person")},
                                    {Dialog::kObject, TrLater("Add an object")},
                                    {Dialog::kCheckPoint, TrLater("Add a check point")},
                                    {Dialog::kDroppedModel, TrLater("A model was dropped")},
                                    {Dialog::kDropMessage, TrLater("Dropped")},
                                    {Dialog::kLeave, TrLater("Work is not done")}};

// Returns true when the user wants to calibrate the camera.
bool DrawContent(const PanelContext& context) {
  auto [workspace, selection, options, tools, cast, pictures, input, dialogs, actions] = context;
  switch (dialogs.shown) {
    case Dialog::kTrain:
      return TrainDialog(workspace, dialogs);
    case Dialog::kAddSession:
      return AddSessionDialog(workspace, dialogs);
    case Dialog::kTrainingReport:
      TrainingReportDialog(workspace, dialogs);
      break;
    case Dialog::kExport:
      ExportDialog(workspace, dialogs, actions);
      break;
    case Dialog::kOccluder:
      OccluderDialog(workspace, selection, options, dialogs);
      break;
    case Dialog::kProbe:
      ProbeDialog(workspace, selection, dialogs);
      break;
    case Dialog::kCast:
      CastDialog(workspace, selection, pictures, dialogs);
      break;
    case Dialog::kObject:
      ObjectDialog(workspace, selection, dialogs);
      break;
    case Dialog::kCheckPoint:
      CheckPointDialog(workspace, selection, options, dialogs);
      break;
    case Dialog::kDroppedModel:
      DroppedModelDialog(workspace, dialogs);
      break;
    case Dialog::kDropMessage:
      DropMessageDialog(dialogs);
      break;
    default:
      LeaveDialog(workspace, dialogs, actions);
      break;
  }
  return false;
}

}  // namespace

std::string UselessDropText(const std::string& name) {
  return Text(Tr("%s cannot be used here. What can be dropped, one thing at a time: a video, a "
                 "folder of images, a model, a light probe (EXR, HDR) or a project."),
              name.c_str());
}

void WarningText(const std::string& text) {
  if (!text.empty()) {
    ImGui::PushStyleColor(ImGuiCol_Text, Colours().warning);
    ImGui::TextWrapped("%s", text.c_str());
    ImGui::PopStyleColor();
  }
}

DialogProblem NameProblem(const std::string& name) {
  return name.empty()                ? Missing(Tr("It needs a name."))
         : editor::IsPlainName(name) ? DialogProblem()
                                     : Wrong(Tr("The name takes letters, digits, _ and -."));
}

TitledName TitleRows(const char* title_label,
                     const char* name_label,
                     const char* otherwise,
                     const std::function<bool(const std::string&)>& taken,
                     std::string& title,
                     std::string& name) {
  PropertyLabel(title_label);
  ImGui::InputText("##title", &title);
  const std::string proposed = editor::FreeNameOf(title, otherwise, taken);
  PropertyLabel(name_label);
  ImGui::InputTextWithHint("##name", title.empty() ? "" : proposed.c_str(), &name);
  Tooltip(
      Tr("Letters, digits, _ and -. It follows from what is typed above, unless you type "
         "another one."));
  return {title, name.empty() ? proposed : name};
}

DialogProblem TitleProblem(const TitledName& titled,
                           const std::function<bool(const std::string&)>& taken) {
  if (titled.title.empty()) {
    return Missing(Tr("It needs a name."));
  }
  if (!editor::IsTitle(titled.title)) {
    return Wrong(Tr("The name is too long, or only spaces."));
  }
  return taken(titled.name) ? Wrong(Tr("That name is taken.")) : NameProblem(titled.name);
}

ChosenPlace PlaceRows(const editor::ProjectDocument& document, DialogFields& fields) {
  const auto known =
      std::find_if(document.places.begin(), document.places.end(), [&](const auto& place) {
        return place.name == fields.place || place.label() == fields.place;
      });
  if (known != document.places.end()) {
    PropertyLabel(Tr("Place"));
    ImGui::InputText("##title", &fields.place);
    return {{known->label(), known->name}, true};
  }
  const auto taken = [&](const std::string& name) { return document.FindPlace(name) != nullptr; };
  return {TitleRows(Tr("Place"), Tr("Its folder"), "place", taken, fields.place, fields.name),
          false};
}

DialogProblem PlaceProblem(const editor::ProjectDocument& document, const ChosenPlace& place) {
  return place.known ? DialogProblem() : TitleProblem(place, [&](const std::string& name) {
    return document.FindPlace(name) != nullptr;
  });
}

DialogProblem RecordingProblem(const editor::ProjectPaths& paths, const DialogFields& fields) {
  if (fields.file.empty()) {
    return Missing(Tr("Choose a recording."));
  }
  if (!Exists(paths, fields.file)) {
    return Wrong(Tr("Choose a recording that exists."));
  }
  if (!fields.intrinsics.empty() && ParseNumbers(fields.intrinsics).empty()) {
    return Wrong(Tr("Intrinsics are 4 or 8 numbers."));
  }
  return {};
}

bool RecordingFields(const std::filesystem::path& folder,
                     DialogFields& fields,
                     const char* no_intrinsics,
                     const char* no_intrinsics_hint) {
  PropertyLabel(Tr("Recording"));
  const char* const kinds[] = {Tr("Video"), Tr("Folder of images")};
  int kind = fields.images ? 1 : 0;
  if (Segmented("kind", kinds, kind)) {
    fields.images = kind == 1;
  }
  PropertyLabel(fields.images ? Tr("Folder") : Tr("File"));
  PathField("file", fields.file, folder, fields.images ? FileType::kImages : FileType::kVideo);
  PropertyLabel(Tr("Intrinsics"));
  const char* const calibrate = Tr("Calibrate\xe2\x80\xa6");
  const float button = WidestButton(std::array{calibrate}, 0.0f);
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - button -
                          ImGui::GetStyle().ItemSpacing.x);
  ImGui::InputTextWithHint("##intrinsics", no_intrinsics, &fields.intrinsics);
  if (ImGui::IsItemHovered()) {
    ImGui::SetTooltip("%s\n%s", Tr("fx, fy, cx, cy, k1, k2, p1, p2 in pixels of the recording."),
                      no_intrinsics_hint);
  }
  ImGui::SameLine();
  const bool wanted = ImGui::Button(calibrate, ImVec2(button, 0));
  Tooltip(Tr("Measures them, and their errors, with a printed chessboard."));
  return wanted;
}

void TrainRecording(editor::Workspace& workspace,
                    const TitledName& place,
                    const DialogFields& fields) {
  const Result<editor::SessionDocument> recording = ChosenRecording(workspace, fields);
  if (!recording.ok()) {
    workspace.messages().Tell(editor::Message::Level::kError, recording.message());
    return;
  }
  workspace.training().TrainFrom(place.name, place.title, *recording);
}

bool DrawDialogs(const PanelContext& context) {
  auto [workspace, selection, options, tools, cast, pictures, input, dialogs, actions] = context;
  if (dialogs.shown == Dialog::kNone && workspace.training().TakeNewReport()) {
    dialogs.shown = Dialog::kTrainingReport;
  }
  if (dialogs.shown == Dialog::kKeys && !DrawKeyList(input.keys)) {
    dialogs.shown = Dialog::kNone;
  }
  for (const DialogEntry& entry : kDialogs) {
    if (dialogs.shown != entry.dialog) {
      continue;
    }
    bool open = true;
    bool calibrate = false;
    // Copied before Escape restores the text of a field.
    const DialogFields typed = dialogs.fields;
    DrawModal(Label(Tr(entry.title), "dialog").c_str(), 520, open, [&] {
      calibrate = DrawContent(context);
      open = context.dialogs.shown == entry.dialog && !calibrate;
    });
    if (!open && !calibrate && dialogs.shown == entry.dialog) {  // A dialog can open another one.
      dialogs.left[entry.dialog] = typed;
      dialogs.shown = Dialog::kNone;
    }
    return calibrate;
  }
  return false;
}

}  // namespace lararium::panels
