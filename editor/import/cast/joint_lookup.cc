#include "editor/import/cast/joint_lookup.h"

#include "shared/core/check.h"

namespace lararium::import {

size_t IndexOfJoint(const human::Skeleton& skeleton, std::string_view name) {
  const auto index = skeleton.Find(name);
  CHECK(index.has_value());
  return *index;
}

glm::vec3 RestPosition(const human::Skeleton& skeleton, std::string_view name) {
  return -glm::vec3(skeleton.joint_from_actor[IndexOfJoint(skeleton, name)][3]);
}

}  // namespace lararium::import
