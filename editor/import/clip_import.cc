#include "editor/import/clip_import.h"

#include <algorithm>

#include "editor/import/model_import.h"

namespace lararium::import {
namespace {

Result<const human::Clip*> Choose(const std::vector<human::Clip>& clips,
                                  const std::string& name,
                                  const std::string& place) {
  if (name.empty()) {
    return &*std::max_element(
        clips.begin(), clips.end(),
        [](const human::Clip& a, const human::Clip& b) { return a.duration < b.duration; });
  }
  std::string names;
  for (const human::Clip& clip : clips) {
    if (clip.name == name) {
      return &clip;
    }
    names += (names.empty() ? "" : ", ") + clip.name;
  }
  return Status::Error(place, "there is no clip '" + name + "' in it", "there are: " + names);
}

}  // namespace

Result<ImportedClip> ImportClip(const std::filesystem::path& file,
                                const human::Skeleton& target,
                                const ClipImportOptions& options) {
  ImportOptions import_options;
  import_options.bones = options.bones;
  LARARIUM_ASSIGN_OR_RETURN(ImportedHuman source, ImportMotion(file, import_options));
  LARARIUM_ASSIGN_OR_RETURN(const human::Clip* clip,
                            Choose(source.human.clips, options.source_clip, file.string()));
  ImportedClip imported;
  auto retargeted = Retarget(source.human.skeleton, *clip, target, options.retarget);
  if (!retargeted.ok()) {
    return retargeted.status().At(file.string());
  }
  imported.clip = std::move(*retargeted);
  imported.bones = std::move(source.bones);
  imported.bone_table = std::move(source.bone_table);
  imported.notes = std::move(source.notes);
  return imported;
}

Status AddClip(human::Clip clip, human::Human& person) {
  LARARIUM_RETURN_IF_ERROR(clip.Validate(person.skeleton.size(), person.name));
  const auto same = std::find_if(person.clips.begin(), person.clips.end(),
                                 [&](const human::Clip& c) { return c.name == clip.name; });
  if (same != person.clips.end()) {
    *same = std::move(clip);
  } else {
    person.clips.push_back(std::move(clip));
  }
  return Status();
}

}  // namespace lararium::import
