#include "editor/session/recent_projects.h"

#include <algorithm>
#include <utility>

#include "editor/document/project_paths.h"
#include "editor/document/user_folders.h"

namespace lararium::editor {

namespace {

namespace fs = std::filesystem;

constexpr int kRecentSchema = 1;
constexpr size_t kMaxTitleBytes = 1024;
constexpr size_t kMaxPathBytes = 4096;
constexpr int64_t kLatest = int64_t{1} << 40;  // Far beyond any real time.

void DescribeEntry(Fields& fields, RecentProject& project) {
  std::string folder = project.folder.string();
  fields.Text("folder", folder, kMaxPathBytes);
  if (fields.reading()) {
    project.folder = folder;
    fields.Require(project.folder.is_absolute(), "\"folder\" must be an absolute path");
  }
  fields.Text("title", project.title, kMaxTitleBytes);
  fields.Integer("opened", project.opened, 0, kLatest);
}

void DescribeList(Fields& fields, std::vector<RecentProject>& recent) {
  fields.Schema(kRecentSchema);
  fields.List("recent", recent, RecentProjects::kMost, DescribeEntry);
}

}  // namespace

Status RecentProjects::Reload() {
  auto loaded = LoadUserFile<std::vector<RecentProject>>(file_, "open projects by their folder",
                                                         DescribeList);
  entries_ = loaded.ok() ? *std::move(loaded) : std::vector<RecentProject>();
  return loaded.status();
}

Status RecentProjects::Save() const { return SaveUserFile(file_, entries_, DescribeList); }

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
