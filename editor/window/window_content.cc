#include "editor/window/window_content.h"

#include <imgui.h>

#include <chrono>
#include <utility>

#include "editor/document/titles.h"
#include "editor/document/user_folders.h"
#include "editor/panels/dialogs/dialogs.h"
#include "editor/panels/widgets/file_chooser.h"
#include "editor/panels/widgets/keyboard_focus.h"
#include "editor/session/project_picture.h"
#include "editor/session/sample.h"
#include "editor/session/task_text.h"
#include "editor/text/text.h"
#include "shared/core/program.h"

namespace lararium::editor {

using panels::StartChoice;

namespace {

const char* DialogIsOpenText() {
  return Tr("A dialog is open that has no use for what was dropped: close it, then drop it again.");
}

std::filesystem::path SettingsFile() { return ConfigFolder() / "editor.json"; }
std::filesystem::path SizesFile() { return StateFolder() / "window.json"; }

}  // namespace

Settings RestoreSettings(Log& log) {
  Result<Settings> settings = LoadSettings(SettingsFile());
  if (!settings.ok()) {
    log.Warn("{}", settings.message());
    settings = Settings();
  }
  LoadTexts(TextFolder(), settings->language);
  return *settings;
}

WindowSizes RestoreWindowSizes(Log& log) {
  const Result<WindowSizes> sizes = LoadWindowSizes(SizesFile());
  if (!sizes.ok()) {
    log.Warn("{}", sizes.message());
    return WindowSizes();
  }
  return *sizes;
}

void KeepWindowSizes(const WindowSizes& sizes, Log& log) {
  if (const Status status = SaveWindowSizes(SizesFile(), sizes); !status.ok()) {
    log.Warn("{}", status.message());
  }
}

WindowContent::WindowContent(std::unique_ptr<Workspace> workspace,
                             const Settings& settings,
                             const PanelSizes& panels,
                             Log& log)
    : log_(log),
      settings_(settings),
      panels_(panels),
      recent_(StateFolder() / "recent.json"),
      shipped_(ShippedSample(ProgramFolder())) {
  if (const Status status = recent_.Reload(); !status.ok()) {
    start_.SetProblem(status.message());
  }
  panels::FileChooser::Current().SetRecent(recent_.entries());
  if (workspace != nullptr) {
    Enter(std::move(workspace));
  }
}

WindowContent::~WindowContent() { KeepPicture(); }

std::string WindowContent::Title() const {
  if (workspace_ == nullptr) {
    return "Lararium";
  }
  return workspace_->project().document().title +
         (workspace_->project().commands().dirty() ? " \xe2\x80\xa2" : "") +
         " \xe2\x80\x93 Lararium";
}

void WindowContent::AddCharacter(char32_t character) {
  if (keys_.empty() || keys_.back().character != 0) {
    keys_.push_back({});  // Typed by an input method, not by a key.
  }
  keys_.back().character = character;
}

void WindowContent::Enter(std::unique_ptr<Workspace> workspace) {
  workspace_ = std::move(workspace);
  pictured_ = false;
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  const RecentProject project{workspace_->project().paths().folder,
                              workspace_->project().document().title,
                              std::chrono::duration_cast<std::chrono::seconds>(now).count()};
  if (const Status status = recent_.NoteOpened(project); !status.ok()) {
    log_.Warn("{}", status.message());  // Not fatal.
  }
  panels::FileChooser::Current().SetRecent(recent_.entries());
}

void WindowContent::Leave() {
  KeepPicture();
  layout_.reset();
  workspace_.reset();
  tour_ = plays_ = false;
  start_ = {};
  if (const Status status = recent_.Reload(); !status.ok()) {
    start_.SetProblem(status.message());
  }
}

void WindowContent::RequestQuit() {
  if (layout_ != nullptr && workspace_->AtLongWork()) {
    layout_->RequestQuit();
  } else {
    quit_ = true;
  }
}

void WindowContent::KeepPicture() {
  if (workspace_ != nullptr && workspace_->preview().picture() != nullptr) {
    pictured_ = true;
    const PreviewPicture& picture = *workspace_->preview().picture();
    const Status status = SaveProjectPicture(workspace_->project().paths().folder, picture.bgr);
    if (!status.ok()) {
      log_.Warn("{}", status.message());
    }
  }
}

void WindowContent::Open(const std::filesystem::path& project) {
  Result<std::unique_ptr<Workspace>> workspace = Workspace::Open({project}, log_);
  if (workspace.ok()) {
    Enter(std::move(*workspace));
  } else {
    start_.SetProblem(workspace.message());
  }
}

Status WindowContent::MakeNew(const panels::NewProject& made) {
  const ProjectPaths paths{made.folder};
  LARARIUM_RETURN_IF_ERROR(CreateProject(paths, made.title));
  LARARIUM_ASSIGN_OR_RETURN(std::unique_ptr<Workspace> workspace, Workspace::Open(paths, log_));
  Enter(std::move(workspace));
  switch (made.begin) {
    case panels::NewProject::Begin::kRecording:
      panels::TrainRecording(
          *workspace_, {made.title, FreeNameOf(made.title, "place", [](auto&) { return false; })},
          made.fields);
      break;
    case panels::NewProject::Begin::kFilming:
      film_ = made.fields.place;
      break;
    case panels::NewProject::Begin::kEmpty:
      break;
  }
  workspace_->project().Save();
  return Status();
}

void WindowContent::Follow(const StartChoice& choice) {
  if (choice.kind == StartChoice::Kind::kNothing) {
    return;
  }
  copying_.reset();
  Status problem;
  switch (choice.kind) {
    case StartChoice::Kind::kNothing:
    case StartChoice::Kind::kStopCopying:
      return;
    case StartChoice::Kind::kQuit:
      quit_ = true;
      return;
    case StartChoice::Kind::kOpen:
      Open(choice.project);
      return;
    case StartChoice::Kind::kNew:
      problem = MakeNew(choice.made);
      break;
    case StartChoice::Kind::kSample:
      CopySample();
      return;
  }
  if (!problem.ok()) {
    start_.SetProblem(problem.message());
  }
}

void WindowContent::Drop(const std::vector<std::filesystem::path>& paths) {
  dropped_ = panels::ClassifyDrop(paths);
  has_dropped_ = true;
  panels::FileChooser::Current().Drop(dropped_.file);
}

// Handles what no field has taken.
void WindowContent::TakeDrop() {
  using Kind = panels::DroppedFile::Kind;
  panels::FileChooser& chooser = panels::FileChooser::Current();
  if (!has_dropped_ || chooser.OffersDrop()) {
    return;
  }
  has_dropped_ = false;
  if (chooser.drop_taken()) {
    return;
  }
  if (workspace_ == nullptr) {
    DropOnStart(dropped_);
  } else if (layout_ == nullptr || layout_->has_dialog() || panels::KeysBelongToMenus()) {
    workspace_->messages().Tell(Message::Level::kWarning, DialogIsOpenText());
  } else if (dropped_.kind != Kind::kProject) {
    layout_->Drop(*workspace_, dropped_);
  } else if (NormalFolder(dropped_.file) == NormalFolder(workspace_->project().paths().folder)) {
    layout_->TellOfDrop(Tr("This project is open already."));
  } else {
    next_ = dropped_.file;
    layout_->RequestLeave();
  }
}

void WindowContent::DropOnStart(const panels::DroppedFile& dropped) {
  using Kind = panels::DroppedFile::Kind;
  using From = panels::NewProjectDialog::From;
  const std::string name = dropped.file.filename().string();
  if (start_.has_dialog()) {
    start_.SetProblem(DialogIsOpenText());
    return;
  }
  switch (dropped.kind) {
    case Kind::kProject:
      Open(dropped.file);
      return;
    case Kind::kVideo:
    case Kind::kImages:
      start_.BeginNew(dropped.kind == Kind::kVideo ? From::kVideo : From::kImages, recent_,
                      dropped.file);
      return;
    case Kind::kModel:
    case Kind::kFigure:
    case Kind::kProbe:
      start_.SetProblem(panels::Text(
          Tr("%s belongs into a project: open or make one, then drop it again."), name.c_str()));
      return;
    case Kind::kOther:
      start_.SetProblem(panels::UselessDropText(name));
      return;
  }
}

void WindowContent::CopySample() {
  own_sample_ = std::make_shared<std::filesystem::path>();
  copying_ = std::make_unique<BackgroundTask>(
      TaskKind::kCopying, [own = own_sample_, shipped = shipped_](Progress& progress) {
        LARARIUM_ASSIGN_OR_RETURN(*own, OwnSample(shipped, DataFolder(), progress));
        return Status();
      });
}

void WindowContent::OpenCopiedSample() {
  const Status copied = *copying_->outcome();
  copying_.reset();
  if (!copied.ok()) {
    start_.SetProblem(copied.message());
    return;
  }
  Open(SampleProject(*own_sample_));
  tour_ = plays_ = workspace_ != nullptr;
  if (workspace_ != nullptr && !IsTrained(*own_sample_)) {
    workspace_->messages().Tell(
        Message::Level::kInfo,
        Tr("The sample is not prepared yet: its place is trained now, then its people and voices "
           "are baked. That takes some minutes, once."));
    workspace_->training().Train();
  }
}

void WindowContent::BeginSample() {
  const bool shown = workspace_->preview().picture() != nullptr;
  const bool acted = !keys_.empty() || ImGui::IsAnyMouseDown();
  if (tour_ && (shown || acted || workspace_->tasks().Running(TaskKind::kTraining))) {
    layout_->BeginTour();
    tour_ = false;
  }
  if (plays_ && (shown || acted)) {
    workspace_->playback().SetPlaying(!acted);
    plays_ = false;
  }
}

void WindowContent::Update(double seconds) {
  if (copying_ != nullptr && copying_->outcome()) {
    OpenCopiedSample();
  }
  if (workspace_ == nullptr) {
    return;
  }
  workspace_->Update(seconds);
  if (!pictured_) {
    KeepPicture();  // Needed if the project is never closed properly.
  }
}

Status WindowContent::Show() {
  const Settings before = settings_;
  TakeDrop();
  if (workspace_ == nullptr) {
    const StartChoice choice =
        start_.Show(recent_, keys_, !shipped_.empty(), copying_.get(), settings_);
    keys_.clear();
    Follow(choice);
  } else {
    LARARIUM_RETURN_IF_ERROR(DrawProject());
  }
  if (settings_.language != before.language) {
    LoadTexts(TextFolder(), settings_.language);
  }
  if (settings_ != before) {
    if (const Status status = SaveSettings(SettingsFile(), settings_); !status.ok()) {
      log_.Warn("{}", status.message());
    }
  }
  return Status();
}

Status WindowContent::DrawProject() {
  if (layout_ == nullptr) {
    LARARIUM_ASSIGN_OR_RETURN(layout_, Layout::Create());
  }
  BeginSample();
  if (!film_.empty()) {
    layout_->BeginFilming(std::exchange(film_, ""));
  }
  for (const panels::KeyPress& press : std::exchange(keys_, {})) {
    layout_->AddKey(press);
  }
  layout_->Show(*workspace_, settings_, panels_);
  quit_ |= layout_->quit_requested();
  if (layout_->leave_requested()) {
    Leave();
    if (!next_.empty()) {
      Open(std::exchange(next_, {}));
    }
  } else if (!layout_->leaving()) {
    next_.clear();  // The user stays.
  }
  return Status();
}

}  // namespace lararium::editor
