#include "editor/import/motion/clip_import.h"

#include <algorithm>
#include <cmath>

#include "editor/import/model/model_import.h"

namespace lararium::import {
namespace {

Result<const human::Clip*> Choose(const std::vector<human::Clip>& clips,
                                  const std::string& name,
                                  const std::string& where) {
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
  return Status::Error(where, "there is no clip '" + name + "' in it", "there are: " + names);
}

// Mean rotation over the joints between two keys, radians.
float MeanTurn(const human::Clip& clip, size_t joints, size_t key) {
  float sum = 0.0f;
  for (size_t j = 0; j < joints; ++j) {
    const glm::quat& a = clip.keys[key * joints + j].rotation;
    const glm::quat& b = clip.keys[(key + 1) * joints + j].rotation;
    sum += 2.0f * std::acos(std::min(1.0f, std::abs(glm::dot(a, b))));
  }
  return sum / static_cast<float>(joints);
}

// Seconds of the clip before the last jump among its first keys; 0 if there is none.
float CalibrationSeconds(const human::Clip& clip, size_t joints) {
  constexpr size_t kFirstKeys = 3;
  // Radians; ten times the movement of a body in a thirtieth of a second.
  constexpr float kLeap = 0.12f;
  float seconds = 0.0f;
  for (size_t key = 0; key < kFirstKeys && key + kFirstKeys < clip.KeyCount(joints); ++key) {
    if (MeanTurn(clip, joints, key) > kLeap) {
      seconds = static_cast<float>(key + 1) / clip.keys_per_second;
    }
  }
  return seconds;
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
  if (source.human.clips.size() > 1 && options.source_clip.empty()) {
    source.notes.push_back("it has " + std::to_string(source.human.clips.size()) +
                           " clips; the longest, '" + clip->name + "', is taken");
  }
  ImportedClip imported;
  RetargetOptions retarget = options.retarget;
  const float calibration =
      options.drop_calibration ? CalibrationSeconds(*clip, source.human.skeleton.size()) : 0.0f;
  if (calibration > retarget.from) {
    retarget.from = calibration;
    source.notes.push_back("its first " + std::to_string(calibration) +
                           " s are another pose, for calibration, and are left out");
  }
  auto retargeted = Retarget(source.human.skeleton, *clip, target, retarget);
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
