#pragma once

// The running stage: its actors and what they do at one moment. A drama changes
// it in fixed ticks; whoever draws takes snapshots and interpolates between two
// of them. Nothing here draws.

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shared/core/id.h"
#include "shared/human/human.h"

namespace lararium::stage {

// Which clip an actor plays and how far it has come. Times count on past the
// end of a clip: looping is the sampler's business, so that times interpolate.
struct Animation {
  static constexpr int kNoClip = -1;

  int clip = kNoClip;           // index into Human::clips; none: the rest pose
  double clip_time = 0.0;       // seconds into the clip
  double rate = 1.0;            // how fast it plays
  int previous_clip = kNoClip;  // fades out while weight < 1
  double previous_time = 0.0;
  double previous_rate = 1.0;
  float weight = 1.0f;             // of clip against previous_clip, 0..1
  float weight_per_second = 0.0f;  // how fast weight grows

  friend bool operator==(const Animation&, const Animation&) = default;
};

// All that a drama changes about an actor; plain values.
struct ActorState {
  glm::vec3 position = glm::vec3(0.0f);  // stage, metres; the ground between the feet
  float heading = 0.0f;                  // radians about +Y; 0 faces -Z, a quarter turn faces -X
  Animation animation;
  bool visible = false;

  friend bool operator==(const ActorState&, const ActorState&) = default;
};

struct Actor {
  std::string name;
  std::shared_ptr<const human::Human> human;
  ActorState state;
};
using ActorId = Id<Actor>;

// The states of all actors at one moment, in the order of their slots.
struct StageSnapshot {
  struct Entry {
    ActorId actor;
    ActorState state;
    friend bool operator==(const Entry&, const Entry&) = default;
  };
  std::vector<Entry> actors;

  friend bool operator==(const StageSnapshot&, const StageSnapshot&) = default;
};

// Fades from what the actor plays to clip, from its beginning, over fade_seconds.
// A fade that was still going on is cut short.
void StartClip(Animation& animation, int clip, double rate, float fade_seconds);

class Stage {
 public:
  // Names are unique: an error says which is taken. A new actor is hidden and
  // stands at the origin in its rest pose.
  Result<ActorId> Add(std::string name, std::shared_ptr<const human::Human> human);
  // False when the id is stale.
  bool Remove(ActorId id);

  std::optional<ActorId> Find(std::string_view name) const;
  // nullptr when the id is stale.
  Actor* Find(ActorId id) { return actors_.Find(id); }
  const Actor* Find(ActorId id) const { return actors_.Find(id); }
  // In the order of their slots.
  std::span<const ActorId> actors() const { return order_; }

  // Lets clips and fades run on.
  void Advance(double seconds);
  // Every actor as Add leaves it.
  void Reset();

  // Allocates nothing once the snapshot has held as many actors.
  void Capture(StageSnapshot& snapshot) const;

 private:
  SlotMap<Actor> actors_;
  std::vector<ActorId> order_;
};

// The stage between two snapshots of neighbouring ticks, alpha 0..1. Headings
// turn the shorter way. What does not go on from previous (a new actor, one that
// was shown, hidden or put elsewhere, another clip) is as in current. Allocates
// nothing in steady state.
void Interpolate(const StageSnapshot& previous,
                 const StageSnapshot& current,
                 float alpha,
                 StageSnapshot& result);

// stage_from_actor of an actor that stands and faces as its state says.
glm::mat4 StageFromActor(const ActorState& state);

// Poses one human again and again without allocating.
class Poser {
 public:
  explicit Poser(std::shared_ptr<const human::Human> human);

  const human::Human& human() const { return *human_; }
  // Computes the pose of an animation: clips sampled and cross-faded.
  void Pose(const Animation& animation);

  // Of the last pose. What linear blend skinning takes, one for each joint.
  std::span<const glm::mat4> skin() const { return skin_; }
  std::span<const glm::mat4> actor_from_joint() const { return actor_from_joint_; }

 private:
  std::shared_ptr<const human::Human> human_;
  std::vector<human::JointTransform> pose_;
  std::vector<human::JointTransform> faded_in_;
  std::vector<glm::mat4> actor_from_joint_;
  std::vector<glm::mat4> skin_;
};

}  // namespace lararium::stage
