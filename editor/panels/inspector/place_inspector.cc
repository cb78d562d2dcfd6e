#include "editor/panels/inspector/place_inspector.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <array>
#include <cfloat>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "editor/document/occluder_shape.h"
#include "editor/document/place_edits.h"
#include "editor/document/titles.h"
#include "editor/jobs/sounds.h"
#include "editor/jobs/staging.h"
#include "editor/panels/dialogs/dialogs.h"
#include "editor/panels/dialogs/inspector_dialog.h"
#include "editor/panels/inspector/project_inspector.h"
#include "editor/panels/widgets/text.h"
#include "editor/panels/widgets/theme.h"
#include "editor/panels/widgets/widgets.h"
#include "shared/core/file.h"
#include "shared/geometry/glm_convert.h"

namespace lararium::panels {

namespace {

constexpr double kMinDb = -60.0;
constexpr double kMaxDb = 12.0;
constexpr float kEarsHeight = 1.5f;  // Metres; height of a sound that was just given a position.

// In the order of stage::Reverb.
constexpr std::array<const char*, 9> kReverbs = {TrLater("No reverberation"),
                                                 TrLater("Small room"),
                                                 TrLater("Wooden room"),
                                                 TrLater("Stone room"),
                                                 TrLater("Corridor"),
                                                 TrLater("Hall"),
                                                 TrLater("Vault"),
                                                 TrLater("Courtyard"),
                                                 TrLater("Street")};

DialogProblem LookedAtProblem(const editor::ProjectPaths& paths, const DialogFields& fields) {
  std::error_code ignored;
  const std::filesystem::path file = paths.Resolve(fields.file);
  if (fields.file.empty()) {
    return Missing(Tr("Choose a recording."));
  }
  if (!FileExists(file)) {
    return Wrong(Tr("Choose a recording that exists."));
  }
  const bool folder = std::filesystem::is_directory(file, ignored);
  if (folder != fields.images) {
    return Wrong(folder ? Tr("This is a folder; choose a file in it.")
                        : Tr("Choose a folder of images."));
  }
  return {};
}

// Sets the recording of the camera view, as one edit. Where it cannot be opened, only shows a
// message.
void LookAt(editor::Workspace& workspace,
            ViewOptions& options,
            const editor::SourceDocument& recording) {
  if (!recording.empty()) {
    const auto source = editor::OpenSource(workspace.project().paths(), recording);
    if (!source.ok()) {
      workspace.messages().Tell(editor::Message::Level::kError, source.message());
      return;
    }
    for (const std::string& note : (*source)->Notes()) {
      workspace.messages().Warn(note);
    }
  }
  const editor::SourceDocument& before = workspace.project().place()->preview;
  if (before.kind != recording.kind || before.path != recording.path) {
    workspace.project().EditPlace(Sentence("recording to look at"),
                                  [&](editor::PlaceDocument& place) { place.preview = recording; });
  }
  workspace.preview().SetViewSource(editor::PreviewSession::ViewSource::kRecording);
  options.view = ViewKind::kCamera;
}

// gesture: see CommandStack::Edit.
void EditAcoustics(editor::Workspace& workspace,
                   const Sentence& name,
                   const std::function<void(stage::Acoustics&)>& change,
                   std::string_view gesture = {}) {
  workspace.project().EditPlace(
      name, [&](editor::PlaceDocument& place) { change(place.acoustics); }, gesture);
}

void DrawReverb(editor::Workspace& workspace, const stage::Acoustics& acoustics) {
  PropertyLabel(Tr("Walls"));
  std::array<const char*, kReverbs.size()> names;
  std::transform(kReverbs.begin(), kReverbs.end(), names.begin(), [](auto n) { return Tr(n); });
  int reverb = static_cast<int>(acoustics.reverb);
  if (ImGui::Combo("##reverb", &reverb, names.data(), static_cast<int>(names.size()),
                   static_cast<int>(names.size()))) {
    EditAcoustics(workspace, Sentence("reverberation"), [&](stage::Acoustics& edited) {
      edited.reverb = static_cast<stage::Reverb>(reverb);
    });
  }
  Tooltip(Tr("What the place is built like: voices and sounds have its reverberation"));
  if (acoustics.reverb == stage::Reverb::kNone) {
    return;
  }
  double level = static_cast<double>(acoustics.reverb_db);
  if (NumberProperty(workspace, Tr("Reverberation"), level, 0.1, kMinDb, kMaxDb, "%+.1f dB")) {
    EditAcoustics(
        workspace, Sentence("reverberation"),
        [&](stage::Acoustics& edited) { edited.reverb_db = static_cast<float>(level); }, "reverb");
  }
  Tooltip(Tr("How loud the reverberation is, beside what such walls give"));
}

// The position of a listener's ears in front of the camera.
glm::vec3 BeforeTheCamera(const editor::Workspace& workspace) {
  const auto& picture = workspace.preview().picture();
  glm::vec3 at = geometry::ToGlm(
      editor::FloorBefore(picture != nullptr ? picture->camera_from_stage : std::nullopt));
  at.y += kEarsHeight;
  return at;
}

// The choice between sound from all around and from a point. Returns true when it has changed.
bool FromRow(const editor::Workspace& workspace, stage::Ambience& ambience) {
  PropertyLabel(Tr("Comes from"));
  const char* const ways[] = {Tr("All around"), Tr("A point")};
  const std::string tips[] = {Tr("It is heard alike wherever one stands and looks"),
                              Tr("It is heard from there, and less farther away")};
  int way = ambience.position ? 1 : 0;
  if (!Segmented("from", ways, way, tips)) {
    return false;
  }
  ambience.position = way == 1 ? std::optional(BeforeTheCamera(workspace)) : std::nullopt;
  return true;
}

// The position of the point. Returns true while it changes.
bool PositionRow(editor::Workspace& workspace, glm::vec3& position) {
  constexpr double kMaxMetres = 1e4;
  Eigen::Vector3d at = geometry::ToEigen(position);
  const bool changed = VectorProperty(workspace, Tr("Position"), at, 0.01, "%.2f");
  Tooltip(Tr("Metres on the stage"));
  if (changed) {
    position = geometry::ToGlm(Eigen::Vector3d(at.cwiseMax(-kMaxMetres).cwiseMin(kMaxMetres)));
  }
  return changed;
}

// The name of a sound and a button; returns true when the button removes the sound.
bool NameAndRemove(const std::string& name) {
  const float remove = WidestButton(std::array{Tr("Remove")}, 0.0f);
  const float left = ImGui::GetContentRegionAvail().x - remove - ImGui::GetStyle().ItemSpacing.x;
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(Elided(name, left).c_str());
  ImGui::SameLine(ImGui::GetContentRegionMax().x - remove);
  const bool removed = ImGui::Button(Tr("Remove"), ImVec2(remove, 0));
  Tooltip(Tr("It is no longer always heard; the project keeps its recording"));
  return removed;
}

void DrawAmbience(editor::Workspace& workspace, stage::Ambience ambience, size_t index) {
  const std::string name = ambience.sound;
  if (NameAndRemove(name)) {
    EditAcoustics(workspace, Sentence("remove %s", {name}), [&](stage::Acoustics& edited) {
      edited.ambience.erase(edited.ambience.begin() + static_cast<ptrdiff_t>(index));
    });
    return;
  }
  if (!BeginProperties("ambience")) {
    return;
  }
  double level = static_cast<double>(ambience.gain_db);
  bool dragged = NumberProperty(workspace, Tr("Level"), level, 0.1, kMinDb, kMaxDb, "%+.1f dB");
  Tooltip(Tr("How loud it is, beside its recording"));
  ambience.gain_db = static_cast<float>(level);
  const bool chosen = FromRow(workspace, ambience);
  if (ambience.position) {
    dragged |= PositionRow(workspace, *ambience.position);
  }
  EndProperties();
  if (chosen || dragged) {
    EditAcoustics(
        workspace, Sentence("sound %s", {name}),
        [&](stage::Acoustics& edited) { edited.ambience[index] = ambience; },
        chosen ? "" : "ambience " + std::to_string(index));
  }
}

// A list of the project's sounds that the place does not use yet.
void AddAmbienceCombo(editor::Workspace& workspace, const stage::Acoustics& acoustics) {
  const bool full = acoustics.ambience.size() >= stage::Acoustics::kMaxAmbience;
  ImGui::BeginDisabled(full);
  ImGui::SetNextItemWidth(-FLT_MIN);
  if (ImGui::BeginCombo("##add ambience", Tr("Add what is always heard"))) {
    for (const editor::SoundFile& sound : editor::FindSounds(workspace.project().paths())) {
      const bool heard = std::any_of(acoustics.ambience.begin(), acoustics.ambience.end(),
                                     [&](const auto& known) { return known.sound == sound.name; });
      if (!heard && ImGui::Selectable(sound.name.c_str())) {
        EditAcoustics(workspace, Sentence("add %s", {sound.name}), [&](stage::Acoustics& edited) {
          edited.ambience.push_back({sound.name, 0.0f, std::nullopt});
        });
      }
    }
    ImGui::EndCombo();
  }
  ImGui::EndDisabled();
  Tooltip(full ? Tr("There are as many as a place can have.")
               : Tr("One of the project's sounds, such as a fire or the street, goes on as long as "
                    "visitors are there"));
}

// Returns true when the dialog is finished.
bool RecordingToLookAtDialog(editor::Workspace& workspace, ViewOptions& options, Dialogs& dialogs) {
  DialogFields& fields = dialogs.fields;
  bool& other = fields.own_model;  // Uses another recording than the training.
  Hint(Tr(
      "The camera view plays it, with people in it. Another recording than the training's has to "
      "be of the lens and proportions that the place was trained with."));
  const char* const ways[] = {Tr("The training's"), Tr("Video"), Tr("Folder of images")};
  const std::string tips[] = {Tr("What the place was trained from"),
                              Tr("Another video of the place"),
                              Tr("Another folder of images of the place, in their order")};
  int way = !other ? 0 : fields.images ? 2 : 1;
  if (Segmented("way", ways, way, tips)) {
    other = way != 0;
    fields.images = way == 2;
  }
  ImGui::Dummy(ImVec2(0, Px(2)));  // Such a row leaves no space below it.
  if (other && BeginProperties("looked at")) {
    PropertyLabel(fields.images ? Tr("Folder") : Tr("File"));
    PathField("file", fields.file, workspace.project().paths().folder,
              fields.images ? FileType::kImages : FileType::kVideo);
    EndProperties();
  }
  const DialogAnswer answer = DialogButtons(
      Tr("Show"), other ? LookedAtProblem(workspace.project().paths(), fields) : DialogProblem());
  if (answer == DialogAnswer::kAct) {
    LookAt(workspace, options,
           other ? editor::RecordingAt(workspace.project().paths(), fields.file)
                 : editor::SourceDocument());
  }
  return answer != DialogAnswer::kNone;
}

// Gives the place another title, and its folder another name, as one edit. The folder has both
// names, so undo works.
void Rename(editor::Workspace& workspace,
            Selection& selection,
            const std::string& from,
            const TitledName& to) {
  const editor::ProjectPaths& paths = workspace.project().paths();
  if (to.name != from) {
    if (const Status status = editor::GiveFolderOtherName(paths, from, to.name); !status.ok()) {
      workspace.messages().Tell(editor::Message::Level::kError, status.message());
      return;
    }
  }
  workspace.project().Edit(
      Sentence("rename %s", {workspace.project().document().FindPlace(from)->label()}),
      [&](editor::ProjectDocument& document) {
        if (to.name != from) {
          editor::RenamePlaceInDocument(paths, from, to.name, document);
        }
        editor::SetTitle(to.title, *document.FindPlace(to.name));
      });
  workspace.project().SelectPlace(to.name);
  selection = {Selection::Kind::kPlace, to.name};
}

// Returns true when the dialog is finished.
bool RenameDialog(editor::Workspace& workspace,
                  Selection& selection,
                  Dialogs& dialogs,
                  const editor::PlaceDocument& place) {
  if (BeginProperties("rename")) {
    PropertyLabel(Tr("Name"));
    ImGui::InputText("##title", &dialogs.fields.title);
    PropertyLabel(Tr("Its folder"));
    ImGui::InputText("##name", &dialogs.fields.name);
    EndProperties();
  }
  const TitledName to = {dialogs.fields.title, dialogs.fields.name};
  Hint(
      Tr("If its folder gets another name, it keeps the old one beside it, so that undo finds the "
         "files."));
  DialogProblem problem = TitleProblem(to, [&](const std::string& name) {
    return name != place.name && workspace.project().document().FindPlace(name) != nullptr;
  });
  if (to.title == place.label() && to.name == place.name) {
    problem = Missing(Tr("It is called so already."));
  }
  const DialogAnswer answer = DialogButtons(Tr("Rename"), problem);
  if (answer == DialogAnswer::kAct) {
    Rename(workspace, selection, std::string(place.name), to);
  }
  return answer != DialogAnswer::kNone;
}

}  // namespace

void DrawRecordingToLookAt(editor::Workspace& workspace,
                           ViewOptions& options,
                           Dialogs& dialogs,
                           const editor::PlaceDocument& place) {
  const std::string title = Label(Tr("Recording to look at"), "looked at");
  if (ImGui::Button(Tr("Recording to look at\xe2\x80\xa6"), ImVec2(-FLT_MIN, 0))) {
    dialogs.fields = {};
    dialogs.fields.own_model = !place.preview.empty();
    dialogs.fields.images = place.preview.kind == editor::SourceDocument::Kind::kImages;
    dialogs.fields.file = place.preview.path;
    ImGui::OpenPopup(title.c_str());
  }
  Tooltip(
      Tr("What the camera view plays: the recording that the place was trained from, or another "
         "one of it"));
  DrawInspectorDialog(title, [&] { return RecordingToLookAtDialog(workspace, options, dialogs); });
}

void DrawPlaceSound(editor::Workspace& workspace,
                    Dialogs& dialogs,
                    const editor::PlaceDocument& place) {
  Heading(Tr("Sound"));
  const stage::Acoustics acoustics = place.acoustics;  // Copied, because edits replace the place.
  if (BeginProperties("sound")) {
    DrawReverb(workspace, acoustics);
    EndProperties();
  }
  for (size_t i = 0; i < acoustics.ambience.size(); ++i) {
    ImGui::PushID(static_cast<int>(i));
    DrawAmbience(workspace, acoustics.ambience[i], i);
    ImGui::PopID();
  }
  AddAmbienceCombo(workspace, acoustics);
  BringInSoundButton(workspace, dialogs);
}

void DrawPlaceName(editor::Workspace& workspace,
                   Selection& selection,
                   Dialogs& dialogs,
                   const editor::PlaceDocument& place) {
  const std::shared_ptr<const editor::ProjectDocument> document =
      workspace.project().commands().snapshot();
  // Copied, because edits replace the place.
  const std::string name = place.name;
  const std::string label = place.label();
  const std::string title = Label(Tr("Rename a place"), "rename");
  const ImVec2 wide(-FLT_MIN, 0);
  const bool busy = workspace.tasks().Running(editor::TaskKind::kTraining) ||
                    workspace.tasks().Running(editor::TaskKind::kWritingMap);
  ImGui::BeginDisabled(busy);
  if (ImGui::Button(Text(Tr("Rename %s\xe2\x80\xa6"), place.label().c_str()).c_str(), wide)) {
    dialogs.fields = {};
    dialogs.fields.title = place.label();
    dialogs.fields.name = name;
    ImGui::OpenPopup(title.c_str());
  }
  ImGui::EndDisabled();
  Tooltip(busy ? Tr("Its map is being made or written. Try again when that is done.")
               : Tr("What it is called, and what its folder is"));
  DrawInspectorDialog(title, [&] { return RenameDialog(workspace, selection, dialogs, place); });
  if (document->places.front().name == name) {
    return;
  }
  if (ImGui::Button(Text(Tr("Put %s first"), label.c_str()).c_str(), wide)) {
    workspace.project().Edit(
        Sentence("put %s first", {label}),
        [&](editor::ProjectDocument& edited) { editor::PutPlaceFirst(name, edited); });
  }
  Tooltip(Tr("The project opens with the place that is the first of the list"));
}

}  // namespace lararium::panels
