#include "editor/session/recent_projects.h"

#include <algorithm>
#include <utility>

#include "editor/document/project_paths.h"
#include "editor/document/user_folders.h"
#include "shared/core/file.h"
#include "shared/core/json.h"

namespace lararium::editor {

namespace {

namespace fs = std::filesystem;

constexpr int kRecentSchema = 1;
constexpr size_t kMaxFileBytes = size_t{1} << 20;
constexpr size_t kMaxTitleBytes = 1024;
constexpr size_t kMaxPathBytes = 4096;
constexpr int64_t kLatest = int64_t{1} << 40;  // Far beyond any real time.

Result<RecentProject> ParseEntry(const JsonView& view) {
  LARARIUM_RETURN_IF_ERROR(view.CheckFields({"folder", "title", "opened"}));
  RecentProject project;
  LARARIUM_ASSIGN_OR_RETURN(const std::string folder, view.Text("folder", kMaxPathBytes));
  project.folder = folder;
  if (!project.folder.is_absolute()) {
    return view.Problem("\"folder\" must be an absolute path");
  }
  LARARIUM_ASSIGN_OR_RETURN(project.title, view.Text("title", kMaxTitleBytes));
  LARARIUM_ASSIGN_OR_RETURN(project.opened, view.Integer("opened", 0, kLatest));
  return project;
}

Result<std::vector<RecentProject>> Load(const fs::path& file) {
  LARARIUM_ASSIGN_OR_RETURN(const std::string text, ReadText(file, kMaxFileBytes));
  LARARIUM_ASSIGN_OR_RETURN(const Json json, ParseJson(text, file.string()));
  const JsonView view(json, file.string());
  LARARIUM_RETURN_IF_ERROR(view.CheckFields({"schema", "recent"}));
  LARARIUM_RETURN_IF_ERROR(view.Integer("schema", kRecentSchema, kRecentSchema).status());
  LARARIUM_ASSIGN_OR_RETURN(const JsonView recent, view.Field("recent"));
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<JsonView> list, recent.Array(RecentProjects::kMost));
  std::vector<RecentProject> entries;
  for (const JsonView& entry : list) {
    LARARIUM_ASSIGN_OR_RETURN(entries.emplace_back(), ParseEntry(entry));
  }
  return entries;
}

}  // namespace

bool RecentProject::Exists() const {
  std::error_code ignored;
  return fs::exists(ProjectPaths{folder}.Project(), ignored);
}

Status RecentProjects::Reload() {
  entries_.clear();
  std::error_code error;
  if (!fs::exists(file_, error)) {
    return Status();
  }
  Result<std::vector<RecentProject>> loaded = Load(file_);
  if (loaded.ok()) {
    entries_ = *std::move(loaded);
    return Status();
  }
  return SetAside(file_, loaded.status(), "open projects by their folder");
}

Status RecentProjects::Save() const {
  Json recent = Json::array();
  for (const RecentProject& project : entries_) {
    recent.push_back({{"folder", project.folder.string()},
                      {"title", project.title},
                      {"opened", project.opened}});
  }
  std::error_code error;
  fs::create_directories(file_.parent_path(), error);
  return SaveJson(file_, {{"schema", kRecentSchema}, {"recent", recent}});
}

Status RecentProjects::NoteOpened(const RecentProject& project) {
  const Status read = Reload();
  RecentProject noted = project;
  noted.folder = NormalFolder(project.folder);
  noted.title.resize(std::min(noted.title.size(), kMaxTitleBytes));
  std::erase_if(entries_, [&](const RecentProject& known) { return known.folder == noted.folder; });
  entries_.insert(entries_.begin(), std::move(noted));
  entries_.resize(std::min(entries_.size(), kMost));
  LARARIUM_RETURN_IF_ERROR(Save());
  return read;
}

Status RecentProjects::Forget(const fs::path& folder) {
  const Status read = Reload();
  std::erase_if(entries_, [&](const RecentProject& known) { return known.folder == folder; });
  LARARIUM_RETURN_IF_ERROR(Save());
  return read;
}

Status RecentProjects::Move(const fs::path& from, const fs::path& to) {
  const Status read = Reload();
  const fs::path found = NormalFolder(to);
  std::erase_if(entries_, [&](const RecentProject& known) {
    return known.folder == found && known.folder != from;
  });
  for (RecentProject& known : entries_) {
    if (known.folder == from) {
      known.folder = found;
    }
  }
  LARARIUM_RETURN_IF_ERROR(Save());
  return read;
}

}  // namespace lararium::editor
