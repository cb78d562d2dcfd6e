#pragma once

// The running stage: its actors and objects and what they do at one moment. A drama
// changes it in fixed ticks; whoever draws takes snapshots and interpolates between
// two of them. Nothing here draws.
//
// A tick: Advance(), then the drama's commands, then Perform().

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shared/stage/actor.h"
#include "shared/stage/navigation.h"
#include "shared/stage/object.h"
#include "shared/stage/place.h"
#include "shared/stage/sounds.h"
#include "shared/stage/tasks.h"

namespace lararium::stage {

// A line that is to be read and is not said: a title.
struct StageCaption {
  int line = -1;           // of the stage's speeches
  int64_t ticks = 0;       // since it was shown
  int64_t ticks_left = 0;  // that it is still shown

  friend bool operator==(const StageCaption&, const StageCaption&) = default;
};

// What is described to visitors who do not see it: one thing at a time, in pauses of people's
// speech. Nothing of the drama depends on it.
struct StageDescription {
  Utterance heard;         // now, or still to be read
  int waiting = -1;        // the next, of the stage's speeches; -1: none
  int64_t ticks_left = 0;  // that it still waits

  friend bool operator==(const StageDescription&, const StageDescription&) = default;
};

// The states of everybody and everything at one moment, in the order of their slots.
struct StageSnapshot {
  struct ActorEntry {
    ActorId actor;
    ActorState state;
    friend bool operator==(const ActorEntry&, const ActorEntry&) = default;
  };
  struct ObjectEntry {
    ObjectId object;
    ObjectState state;
    friend bool operator==(const ObjectEntry&, const ObjectEntry&) = default;
  };
  std::vector<ActorEntry> actors;
  std::vector<ObjectEntry> objects;
  std::optional<double> hour;      // Daylight::hour
  std::vector<StageSound> sounds;  // that the drama plays
  std::vector<StageCaption> captions;
  StageDescription description;

  friend bool operator==(const StageSnapshot&, const StageSnapshot&) = default;
};

// The time of day on the stage, which chooses between a place's probes.
struct Daylight {
  std::optional<double> hour;  // 0 to 24; none: the drama has not said
  double hours_left = 0.0;     // that it is still to move by, negative: back
  double seconds_left = 0.0;   // in this time, evenly

  friend bool operator==(const Daylight&, const Daylight&) = default;
};

class Stage {
 public:
  static constexpr double kTickSeconds = Sounds::kTickSeconds;
  static constexpr float kClipFade = 0.3f;  // seconds from one clip to the next
  // How long an utterance outlives its end, so that its captions can be read.
  static constexpr double kReadOnSeconds = 4.0;
  static constexpr size_t kMaxCaptions = 4;
  static double UtteredSeconds(const Utterance& utterance) {
    return static_cast<double>(utterance.ticks) * kTickSeconds;
  }

  Stage();
  ~Stage();
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

  // ---- who and what is there; not while a drama runs ----

  // Names are unique among actors and objects: an error says which is taken. A new
  // actor is hidden and stands at the origin.
  Result<ActorId> Add(std::string name, std::shared_ptr<const human::Human> human);
  Result<ActorId> Add(std::string name, std::shared_ptr<const human::PerformanceModel> model);
  Result<ObjectId> AddObject(std::string name,
                             std::shared_ptr<const ObjectModel> model,
                             const Pose& stage_from_object);
  // False when the id is stale.
  bool Remove(ActorId id);
  bool Remove(ObjectId id);
  // A line that somebody can say, by its id.
  Status AddSpeech(std::string name, human::VisemeTrack track);
  // The floor, and what of all places is in the way: a drama runs alike wherever it is
  // staged, so that nobody may walk where any of its places has something solid.
  Status SetFloor(const NavigationOptions& options, std::span<const Place> places);

  std::optional<ActorId> Find(std::string_view name) const;
  std::optional<ObjectId> FindObject(std::string_view name) const;
  std::optional<int> FindSpeech(std::string_view name) const;
  double SpeechSeconds(int speech) const;
  const human::VisemeTrack& SpeechTrack(int speech) const;
  // nullptr when the id is stale.
  Actor* Find(ActorId id);
  const Actor* Find(ActorId id) const;
  Object* Find(ObjectId id);
  const Object* Find(ObjectId id) const;
  // In the order of their slots.
  std::span<const ActorId> actors() const;
  std::span<const ObjectId> objects() const;

  // ---- what a drama tells ----

  Tasks& tasks() { return tasks_; }
  const Tasks& tasks() const { return tasks_; }
  Sounds& sounds() { return sounds_; }
  const Sounds& sounds() const { return sounds_; }
  // At once. An actor stops whatever it was doing; an object leaves whoever had it.
  void Place(ActorId id, const glm::vec3& position, float heading);
  void Show(ActorId id, bool visible);
  void Place(ObjectId id, const Pose& stage_from_object);
  Status PlaceOn(ObjectId id, const Support& support);  // fails where the spot is taken
  void SetState(ObjectId id, int state);
  // Its lights, as a factor of what its file says, in some seconds; a colour at once.
  void SetLightLevel(ObjectId id, float level, float seconds, Ease ease = Ease::kLinear);
  void SetLightColour(ObjectId id, const glm::vec3& colour);
  // Says it from its beginning; a negative speech: falls silent.
  void Say(ActorId id, int speech);
  // Shows its captions, without anybody saying it. At most kMaxCaptions at once: the oldest
  // gives way.
  void Caption(int speech, double seconds);
  std::span<const StageCaption> captions() const { return captions_; }
  // Describes it as soon as nobody speaks and nothing else is described, from the next tick on;
  // not at all where that takes longer than so many seconds, or another is to be described.
  void Describe(int speech, double patience);
  const StageDescription& description() const { return description_; }
  // Plays a clip once on a part of the body, then goes on as before.
  void Gesture(ActorId id, int clip, human::BodyPart part);

  // Goes to an hour, 0 to 24, over some seconds, the shorter way round the clock; at once
  // where no hour was set before.
  void SetHour(double hour, double seconds);
  const Daylight& daylight() const { return daylight_; }
  // The best place for somebody to step to that is so far from a point, or a little
  // further; none: there is no way to any.
  std::optional<glm::vec2> FindAway(ActorId id, glm::vec2 from, float metres);

  // Where the visitor's eyes are, in the stage frame; none: nobody knows. Only gazes
  // depend on it.
  void SetVisitor(const std::optional<glm::vec3>& position);

  // ---- time ----

  // Walks, tasks, objects, clips and speech go on for one tick.
  void Advance();
  // Bodies, gazes and faces follow, after whatever the drama told in this tick.
  void Perform();
  // Everybody and everything as at the beginning.
  void Reset();

  // Allocates nothing once the snapshot has held as many.
  void Capture(StageSnapshot& snapshot) const;

  // All that a stage remembers: a place in time to come back to, from which it goes on
  // bit for bit as it did. Only for the stage that it was taken of, with the same people
  // and things. The visitor is not part of it.
  struct Gate {
    ObjectId object;
    bool open = false;
  };
  struct Checkpoint {
    std::vector<Actor> actors;
    std::vector<Object> objects;
    Daylight daylight;
    Sounds::Checkpoint sounds;
    std::vector<StageCaption> captions;
    StageDescription description;
    std::shared_ptr<const Tasks::State> tasks;
    std::shared_ptr<Navigation> navigation;  // floors that were built are not built again
    std::shared_ptr<const Navigation::State> walkers;
    std::vector<Gate> gates;
    bool floor_changed = false;
  };
  // Before Save(), and at each tick at which a drama might save: see Navigation::Settle.
  void Settle();
  Checkpoint Save() const;
  void Restore(const Checkpoint& checkpoint);

 private:
  bool IsNameTaken(std::string_view name) const;
  Status BuildNavigation();
  void RestartWalks();
  void UpdateGates();
  void AnimateWalk(Actor& actor) const;
  void AdvanceDaylight();
  void AdvanceLights();
  void AdvanceUtterance(ActorId id);
  void AdvanceCaptions();
  void AdvanceDescription();

  std::unique_ptr<World> world_;
  Tasks tasks_;
  Daylight daylight_;
  Sounds sounds_;
  std::vector<StageCaption> captions_;
  StageDescription description_;
  NavigationOptions floor_;
  std::vector<std::pair<geometry::TriangleMesh, geometry::Similarity3>> solids_;
  std::vector<Gate> gates_;    // in the order of the navigation's
  bool floor_changed_ = true;  // since the navigation was built
};

// The stage between two snapshots of neighbouring ticks, alpha 0..1. Headings turn the
// shorter way. What does not go on from previous (new, shown, hidden or put elsewhere)
// is as in current. Allocates nothing in steady state.
void Interpolate(const StageSnapshot& previous,
                 const StageSnapshot& current,
                 float alpha,
                 StageSnapshot& result);

}  // namespace lararium::stage
