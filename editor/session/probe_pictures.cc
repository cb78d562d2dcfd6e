#include "editor/session/probe_pictures.h"

#include <filesystem>

#include "editor/document/file_stamp.h"

namespace lararium::editor {

const ProbePicture* ProbePictures::Find(const ProbeDocument& probe) {
  const std::filesystem::path file = project_.paths().Resolve(probe.file);
  const std::string key = file.string() + FileStamp(file);
  picture_.Refresh(key, TaskKind::kProbe, tasks_,
                   [file](Progress&) { return LoadProbePicture(file); });
  return picture_.Find(key);
}

}  // namespace lararium::editor
