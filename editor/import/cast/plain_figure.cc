#include "editor/import/cast/plain_figure.h"

#include <algorithm>

#include "editor/import/model/model_import.h"
#include "shared/core/program.h"

namespace lararium::import {
namespace {

constexpr float kFileHeight = 1.72f;  // metres

void Scale(human::Human& human, float factor) {
  for (size_t i = 0; i < human.skeleton.size(); ++i) {
    human.skeleton.rest[i].translation *= factor;
    glm::mat4& bind = human.skeleton.joint_from_actor[i];
    bind[3] = glm::vec4(factor * glm::vec3(bind[3]), 1.0f);
  }
  for (human::SkinnedMesh& mesh : human.meshes) {
    for (glm::vec3& position : mesh.positions) {
      position *= factor;
    }
  }
  for (human::Clip& clip : human.clips) {
    clip.stride *= factor;
    for (human::JointTransform& key : clip.keys) {
      key.translation *= factor;
    }
  }
}

}  // namespace

std::filesystem::path PlainFigureFile() {
  return ShippedData("lararium/library/figure", "scenes/library/figure") / "figure.glb";
}

Result<human::Human> LoadPlainFigure(const PlainFigureOptions& options) {
  LARARIUM_ASSIGN_OR_RETURN(human::Human human, ImportHuman(PlainFigureFile()));
  for (human::SkinnedMesh& mesh : human.meshes) {
    if (mesh.name == "tunic") {
      std::fill(mesh.albedo.begin(), mesh.albedo.end(), options.tunic);
    }
  }
  Scale(human, options.height / kFileHeight);
  return human;
}

}  // namespace lararium::import
