#include "editor/panels/dialogs/new_project_dialog.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include "editor/document/user_folders.h"
#include "editor/panels/dialogs/dialogs.h"
#include "editor/panels/widgets/text.h"
#include "editor/panels/widgets/widgets.h"

namespace lararium::panels {

namespace fs = std::filesystem;

namespace {

constexpr const char* kProjectSuffix = ".lararium";

}  // namespace

void NewProjectDialog::Open(From from, const fs::path& parent) {
  open_ = true;
  from_ = from;
  fields_ = {};
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

std::string NewProjectDialog::Problem(const fs::path& parent) const {
  std::error_code ignored;
  const std::string problem = NameProblem(fields_.name);
  if (!problem.empty()) {
    return problem;
  }
  if (!fs::is_directory(parent, ignored)) {
    return Tr("Choose a folder that exists.");
  }
  if (fs::exists(parent / (fields_.name + kProjectSuffix), ignored)) {
    return Tr("A project of that name is there already.");
  }
  const bool recorded = from_ == From::kVideo || from_ == From::kImages;
  return recorded ? RecordingProblem({parent}, fields_) : "";
}

std::optional<NewProject> NewProjectDialog::DrawContent() {
  const bool filming = from_ == From::kCamera;
  const bool empty = from_ == From::kNothing;
  Hint(empty     ? Tr("A project without a place: train one later, or write the drama first.")
       : filming ? Tr("Films the place with a camera, says meanwhile what to do next and what is "
                      "still missing, and learns the place from that.")
                 : Tr("Learns a place from a recording: walk sideways around it, slowly, with "
                      "everything in view that visitors will see."));
  if (BeginProperties("new")) {
    PropertyLabel(Tr("Name"));
    ImGui::InputText("##name", &fields_.name);
    PropertyLabel(Tr("In the folder"));
    PathField("folder", parent_, editor::HomeFolder(), {});
    if (!filming && !empty &&
        RecordingFields(parent_, fields_, Tr(kFromVideo), Tr(kFromVideoHint))) {
      calibration_.Open();
    }
    EndProperties();
  }
  const fs::path parent = editor::HomeFolder() / parent_;
  const char* action = empty ? Tr("Make") : filming ? Tr("Film") : Tr("Train");
  const DialogAnswer answer = DialogButtons(action, Problem(parent));
  open_ = answer == DialogAnswer::kNone;
  if (answer != DialogAnswer::kAct) {
    return std::nullopt;
  }
  NewProject made;
  made.begin = empty     ? NewProject::Begin::kEmpty
               : filming ? NewProject::Begin::kFilming
                         : NewProject::Begin::kRecording;
  made.folder = parent / (fields_.name + kProjectSuffix);
  made.fields = fields_;
  made.fields.place = fields_.name;
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
