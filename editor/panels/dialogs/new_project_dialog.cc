#include "editor/panels/dialogs/new_project_dialog.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>

#include "editor/document/user_folders.h"
#include "editor/panels/widgets/text.h"
#include "editor/panels/widgets/widgets.h"
#include "shared/core/file.h"

namespace lararium::panels {

namespace fs = std::filesystem;

namespace {

constexpr const char* kProjectSuffix = ".lararium";

// Whether the folder has a project of that name.
bool IsTaken(const fs::path& parent, const std::string& name) {
  return FileExists(parent / (name + kProjectSuffix));
}

}  // namespace

void NewProjectDialog::Open(From from, const fs::path& parent, const fs::path& recording) {
  open_ = true;
  from_ = from;
  fields_ = {};
  fields_.file = recording.string();
  fields_.title = recording.stem().string();
  std::replace(fields_.title.begin(), fields_.title.end(), '_', ' ');
  fields_.images = from == From::kImages;
  parent_ = parent.string();
}

const char* NewProjectDialog::Title() const {
  switch (from_) {
    case From::kVideo:
      return Tr("New from video");
    case From::kImages:
      return Tr("New from images");
    case From::kCamera:
      return Tr("New from camera");
    case From::kNothing:
      break;
  }
  return Tr("New, empty");
}

DialogProblem NewProjectDialog::Problem(const fs::path& parent, const TitledName& project) const {
  std::error_code ignored;
  const bool recorded = from_ == From::kVideo || from_ == From::kImages;
  if (!fs::is_directory(parent, ignored)) {
    return Wrong(Tr("Choose a folder that exists."));
  }
  const DialogProblem problem =
      TitleProblem(project, [&](const std::string& name) { return IsTaken(parent, name); });
  return problem.any() || !recorded ? problem : RecordingProblem({parent}, fields_);
}

std::optional<NewProject> NewProjectDialog::DrawContent() {
  const bool filming = from_ == From::kCamera;
  const bool empty = from_ == From::kNothing;
  Hint(empty     ? Tr("A project without a place: train one later, or write the drama first.")
       : filming ? Tr("Films the place with a camera, says meanwhile what to do next and what is "
                      "still missing, and learns the place from that.")
                 : Tr("Learns a place from a recording: walk sideways around it, slowly, with "
                      "everything in view that visitors will see."));
  fs::path parent = editor::HomeFolder() / parent_;
  TitledName project;
  if (BeginProperties("new")) {
    project = TitleRows(
        Tr("Name"), Tr("Its folder"), "project",
        [&](const std::string& name) { return IsTaken(parent, name); }, fields_.title,
        fields_.name);
    PropertyLabel(Tr("In the folder"));
    PathField("folder", parent_, editor::HomeFolder(), FileType::kFolder);
    if (!filming && !empty &&
        RecordingFields(parent_, fields_, Tr(kFromVideo), Tr(kFromVideoHint))) {
      calibration_.Open();
    }
    EndProperties();
  }
  parent = editor::HomeFolder() / parent_;
  const char* action = empty ? Tr("Make") : filming ? Tr("Film") : Tr("Train");
  const DialogAnswer answer = DialogButtons(action, Problem(parent, project));
  open_ = answer == DialogAnswer::kNone;
  if (answer != DialogAnswer::kAct) {
    return std::nullopt;
  }
  NewProject made;
  made.begin = empty     ? NewProject::Begin::kEmpty
               : filming ? NewProject::Begin::kFilming
                         : NewProject::Begin::kRecording;
  made.folder = parent / (project.name + kProjectSuffix);
  made.title = project.title;
  made.fields = fields_;
  made.fields.place = project.title;
  made.fields.name.clear();
  made.fields.file = (parent / fields_.file).string();
  return made;
}

std::optional<NewProject> NewProjectDialog::Show(PictureTextures& pictures) {
  std::optional<NewProject> made;
  if (!open_) {
    return made;
  }
  if (calibration_.is_open()) {
    calibration_.Show({editor::HomeFolder() / parent_}, pictures, fields_);
    return made;
  }
  bool open = true;
  DrawModal(Label(Title(), "dialog").c_str(), 560, open, [&] {
    made = DrawContent();
    open = open_ && !calibration_.is_open();
  });
  open_ = open || calibration_.is_open();
  return made;
}

}  // namespace lararium::panels
