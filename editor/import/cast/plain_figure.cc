#include "editor/import/cast/plain_figure.h"

#include "editor/import/cast/plain_body.h"
#include "editor/import/cast/plain_motion.h"
#include "editor/import/cast/plain_skeleton.h"

namespace lararium::import {
namespace {

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

human::Human BuildPlainFigure(const PlainFigureOptions& options) {
  human::Human human;
  human.name = "plain";
  human.skeleton = PlainSkeleton();
  human.meshes = PlainMeshes(human.skeleton, options);
  human.clips = PlainClips(human.skeleton);
  human.credits = "Lararium's built-in figure, Apache-2.0";
  Scale(human, options.height / kPlainHeight);
  return human;
}

}  // namespace lararium::import
