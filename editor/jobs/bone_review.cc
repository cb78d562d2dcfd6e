#include "editor/jobs/bone_review.h"

#include <algorithm>
#include <glm/mat4x4.hpp>
#include <set>

#include "editor/import/model/model_import.h"
#include "editor/text/text.h"

namespace lararium::editor {
namespace {

using import::NamedBone;

constexpr float kSure = 0.7f;
constexpr float kBesideMiddle = 0.01f;  // metres

bool IsNeeded(const std::string& joint) {
  const auto needed = import::NeededJointNames();
  return std::find(needed.begin(), needed.end(), joint) != needed.end();
}

// The figure faces -Z, so its left side is at -X.
bool OnTheWrongSide(const std::string& joint, const human::Human& human) {
  const std::optional<size_t> index = human.skeleton.Find(joint);
  if (!index || joint.size() < 2 || joint[1] != '_') {
    return false;
  }
  std::vector<glm::mat4> actor_from_joint(human.skeleton.size());
  human::ComputeActorFromJoint(human.skeleton, human.skeleton.rest, actor_from_joint);
  const float x = actor_from_joint[*index][3].x;
  return joint[0] == 'l' ? x > kBesideMiddle : x < -kBesideMiddle;
}

std::string ProblemOf(const NamedBone& named, const human::Human& human) {
  if (OnTheWrongSide(named.joint, human)) {
    return Tr("lies on the other side of the body");
  }
  return named.confidence < kSure ? Tr("not sure") : "";
}

void AddFound(const import::ImportedHuman& imported, BoneReview& review) {
  for (const NamedBone& named : imported.joints) {
    review.rows.push_back({named.joint, named.bone, named.found_by, named.confidence,
                           ProblemOf(named, imported.human)});
  }
}

// Adds the joints that were not found; those that a person needs come first and have a problem.
void AddMissing(BoneReview& review) {
  std::set<std::string> found;
  for (const BoneRow& row : review.rows) {
    found.insert(row.joint);
  }
  std::vector<std::string> missing = import::KnownJointNames();
  std::erase_if(missing, [&](const std::string& joint) { return found.contains(joint); });
  std::stable_partition(missing.begin(), missing.end(), IsNeeded);
  for (const std::string& joint : missing) {
    review.rows.push_back(
        {joint, "", std::nullopt, 0.0f, IsNeeded(joint) ? Tr("not found; a person needs it") : ""});
  }
}

}  // namespace

Result<BoneReview> ReviewBones(const ProjectPaths& paths, const CastDocument& member) {
  import::ImportOptions options;
  const std::filesystem::path saved =
      member.bone_map.empty() ? std::filesystem::path() : paths.Resolve(member.bone_map);
  LARARIUM_ASSIGN_OR_RETURN(options.bones, GivenBoneNames(saved, member.bones));
  LARARIUM_ASSIGN_OR_RETURN(const import::ImportedHuman imported,
                            import::ImportPerson(paths.Resolve(member.model), options));
  BoneReview review;
  review.bones = imported.bone_names;
  review.map = imported.bones;
  review.notes = imported.notes;
  review.is_human = imported.is_human;
  for (const auto& [joint, bone] : options.bones) {
    if (bone.empty()) {
      review.map[joint] = "";
    }
  }
  AddFound(imported, review);
  std::set<std::string> used;
  for (const BoneRow& row : review.rows) {
    used.insert(row.bone);
  }
  std::copy_if(review.bones.begin(), review.bones.end(), std::back_inserter(review.others),
               [&](const std::string& bone) { return !used.contains(bone); });
  AddMissing(review);
  return review;
}

void ChooseBone(const std::string& joint,
                const std::optional<std::string>& bone,
                CastDocument& member) {
  if (!bone) {
    member.bones.erase(joint);
    return;
  }
  std::erase_if(member.bones,
                [&](const auto& other) { return !bone->empty() && other.second == *bone; });
  member.bones[joint] = *bone;
}

std::filesystem::path BoneMapFile(const ProjectPaths& paths, const CastDocument& member) {
  return paths.folder / "bones" / (member.name + ".json");
}

Status SaveBoneMap(const ProjectPaths& paths,
                   const CastDocument& member,
                   const BoneReview& review) {
  const std::filesystem::path file = BoneMapFile(paths, member);
  std::error_code error;
  std::filesystem::create_directories(file.parent_path(), error);
  if (error) {
    return Status::Error(file.parent_path().string(), "cannot make the folder: " + error.message());
  }
  return import::SaveBoneNames(file, review.map);
}

}  // namespace lararium::editor
