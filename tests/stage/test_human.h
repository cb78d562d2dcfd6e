#pragma once

#include <memory>

#include "shared/human/human.h"

namespace lararium::test {

// A human with two joints and three clips: "idle" (2 s, loops), "walk" (1 s, loops, 1.4 m) and
// "bow" (0.5 s, once). In each of them the second joint moves along x.
inline std::shared_ptr<const human::Human> MakeTestHuman() {
  auto made = std::make_shared<human::Human>();
  made->name = "test";
  made->skeleton.names = {"humanoid_root", "skullbase"};
  made->skeleton.parents = {human::Skeleton::kNoParent, 0};
  made->skeleton.rest.resize(2);
  made->skeleton.rest[1].translation = {0.0f, 1.5f, 0.0f};
  made->skeleton.joint_from_actor = {glm::mat4(1.0f), glm::mat4(1.0f)};
  made->skeleton.joint_from_actor[1][3] = glm::vec4(0.0f, -1.5f, 0.0f, 1.0f);
  const auto add = [&](const char* name, float duration, bool loops, float stride, float reach) {
    human::Clip clip;
    clip.name = name;
    clip.duration = duration;
    clip.keys_per_second = 4.0f / duration;
    clip.loops = loops;
    clip.stride = stride;
    for (int key = 0; key <= 4; ++key) {
      const float x = reach * (loops && key == 4 ? 0.0f : static_cast<float>(key));
      human::JointTransform head;
      head.translation = {x, 1.5f, 0.0f};
      clip.keys.push_back({});
      clip.keys.push_back(head);
    }
    made->clips.push_back(clip);
  };
  add("idle", 2.0f, true, 0.0f, 0.01f);
  add("walk", 1.0f, true, 1.4f, 0.02f);
  add("bow", 0.5f, false, 0.0f, 0.1f);
  return made;
}

}  // namespace lararium::test
