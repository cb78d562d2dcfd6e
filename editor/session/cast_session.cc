#include "editor/session/cast_session.h"

#include <utility>

#include "editor/document/file_stamp.h"
#include "editor/document/user_folders.h"
#include "editor/jobs/cast_library_fetch.h"
#include "editor/text/text.h"

namespace lararium::editor {

CastSession::CastSession(ProjectSession& project,
                         TaskList& tasks,
                         MessageLog& messages,
                         std::shared_ptr<std::mutex> baking)
    : project_(project),
      tasks_(tasks),
      messages_(messages),
      pictures_(project.paths(), CacheFolder() / "presets", std::move(baking)) {}

const CastCatalogue* CastSession::catalogue() {
  if (catalogue_.newest() == nullptr && catalogue_problem().empty()) {
    const std::optional<std::filesystem::path> folder = FindCastLibrary();
    library_is_missing_ = !folder;
    if (!folder) {
      return nullptr;
    }
    catalogue_.Refresh(*folder, TaskKind::kCatalogue, tasks_,
                       [folder = *folder](Progress&) -> Result<CastCatalogue> {
                         LARARIUM_ASSIGN_OR_RETURN(const import::CastLibrary library,
                                                   import::CastLibrary::Open(folder));
                         return ListCast(library);
                       });
  }
  return catalogue_.newest().get();
}

std::string CastSession::catalogue_problem() const {
  return library_is_missing_ ? Tr("The cast library is not installed.")
                             : catalogue_.problem().message();
}

void CastSession::FetchLibrary() {
  tasks_.Start(TaskKind::kFetching, FetchCastLibrary, [this](const Status& status, bool cancelled) {
    messages_.Report(status, cancelled, Tr("Fetched the cast library"));
    if (status.ok() && !cancelled) {
      library_is_missing_ = false;
      catalogue_.Forget();
      pictures_.BakeAgain();
    }
  });
}

const BoneReview* CastSession::bone_review(const CastDocument& member) {
  const ProjectPaths& paths = project_.paths();
  CastDocument figure = member;
  figure.voice = {};  // The voice and the title do not change the bones.
  figure.title.clear();
  const std::string key = FormatFields(figure).dump() + FileStamp(paths.Resolve(member.model)) +
                          FileStamp(paths.Resolve(member.bone_map));
  bones_.Refresh(
      key, TaskKind::kBoneReview, tasks_,
      [paths, member](Progress&) -> Result<Reviewed> {
        LARARIUM_ASSIGN_OR_RETURN(BoneReview review, ReviewBones(paths, member));
        return Reviewed{member.name, std::move(review)};
      },
      [this](const Status& status, bool cancelled) { messages_.Report(status, cancelled, ""); });
  const Reviewed* newest = bones_.newest().get();
  return newest != nullptr && newest->name == member.name ? &newest->review : nullptr;
}

void CastSession::SaveBones(const CastDocument& member) {
  const Reviewed* newest = bones_.newest().get();
  if (newest == nullptr || newest->name != member.name || tasks_.Running(TaskKind::kBoneReview)) {
    return;  // The newest review is not of the member's current bones.
  }
  if (messages_.TellFailure(SaveBoneMap(project_.paths(), member, newest->review))) {
    return;
  }
  const std::filesystem::path file = BoneMapFile(project_.paths(), member);
  project_.Edit(Sentence("save the bones of %s", {member.name}), [&](ProjectDocument& document) {
    for (CastDocument& known : document.cast) {
      if (known.name == member.name) {
        known.bone_map = project_.paths().Shorten(file);
        known.bones.clear();
      }
    }
  });
  messages_.Tell(Message::Level::kInfo, Text(Tr("Wrote %s"), file.c_str()));
}

void CastSession::Update() {
  for (const std::string& warning : pictures_.TakeWarnings()) {
    messages_.Warn(warning);
  }
  for (const Status& problem : pictures_.TakeProblems()) {
    messages_.TellFailure(problem);
  }
}

}  // namespace lararium::editor
