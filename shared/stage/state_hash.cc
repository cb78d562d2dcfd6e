#include "shared/stage/state_hash.h"

#include <cstring>
#include <type_traits>

namespace lararium::stage {
namespace {

// FNV-1a over 64-bit words, with a better mixing of high bits.
class Hash {
 public:
  template <typename T>
  Hash& Add(const T& value) {
    static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T>);
    uint64_t word = 0;
    static_assert(sizeof(value) <= sizeof(word));
    std::memcpy(&word, &value, sizeof(value));
    value_ = (value_ ^ word) * 0x100000001b3u;
    value_ ^= value_ >> 29;
    return *this;
  }
  Hash& Add(const glm::vec3& v) { return Add(v.x).Add(v.y).Add(v.z); }
  Hash& Add(const Utterance& u) { return Add(u.line).Add(u.ticks).Add(u.speaking); }
  uint64_t value() const { return value_; }

 private:
  uint64_t value_ = 0xcbf29ce484222325u;
};

}  // namespace

uint64_t HashState(const StageSnapshot& snapshot) {
  Hash hash;
  for (const auto& [id, actor] : snapshot.actors) {
    const human::AnimationState& body = actor.animation_state;
    hash.Add(id.index).Add(actor.position).Add(actor.heading).Add(actor.visible);
    hash.Add(body.time).Add(body.gaze.kind).Add(body.gaze.target).Add(actor.utterance);
  }
  for (const auto& [id, object] : snapshot.objects) {
    const Pose& pose = object.stage_from_object;
    hash.Add(id.index).Add(pose.position).Add(pose.rotation.w).Add(pose.rotation.x);
    hash.Add(pose.rotation.y).Add(pose.rotation.z).Add(object.state).Add(object.visible);
    hash.Add(object.holder.index).Add(object.hand).Add(object.action);
    for (const float joint : object.joints) {
      hash.Add(joint);
    }
  }
  hash.Add(snapshot.hour.value_or(-1.0));
  for (const StageSound& sound : snapshot.sounds) {
    hash.Add(sound.number).Add(sound.sound).Add(sound.ticks).Add(sound.stopped);
  }
  for (const StageCaption& caption : snapshot.captions) {
    hash.Add(caption.line).Add(caption.ticks).Add(caption.ticks_left);
  }
  hash.Add(snapshot.description.heard).Add(snapshot.description.waiting);
  return hash.value();
}

}  // namespace lararium::stage
