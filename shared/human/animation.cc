#include "shared/human/animation.h"

#include <algorithm>
#include <glm/common.hpp>

namespace lararium::human {

void StartClip(Animation& animation, int clip, double rate, float fade_seconds, BodyPart part) {
  animation.previous_clip = animation.clip;
  animation.previous_time = animation.clip_time;
  animation.previous_rate = animation.rate;
  animation.previous_part = animation.part;
  animation.clip = clip;
  animation.clip_time = 0.0;
  animation.rate = rate;
  animation.part = part;
  const bool fades = fade_seconds > 0.0f;
  animation.weight = fades ? 0.0f : 1.0f;
  animation.weight_per_second = fades ? 1.0f / fade_seconds : 0.0f;
}

void UpdateAnimation(Animation& animation, double seconds) {
  animation.clip_time += seconds * animation.rate;
  if (animation.weight < 1.0f) {
    animation.previous_time += seconds * animation.previous_rate;
    const float step = static_cast<float>(seconds) * animation.weight_per_second;
    animation.weight = std::min(1.0f, animation.weight + step);
  }
}

Animation Interpolate(const Animation& previous, const Animation& current, float alpha) {
  const bool continues = previous.clip == current.clip &&
                         previous.previous_clip == current.previous_clip &&
                         previous.clip_time <= current.clip_time;
  if (!continues) {
    return current;
  }
  Animation mixed = current;
  mixed.clip_time = glm::mix(previous.clip_time, current.clip_time, static_cast<double>(alpha));
  mixed.previous_time =
      glm::mix(previous.previous_time, current.previous_time, static_cast<double>(alpha));
  mixed.weight = glm::mix(previous.weight, current.weight, alpha);
  return mixed;
}

}  // namespace lararium::human
