#pragma once

// The running stage: its actors and objects and their state at one moment. A drama changes it in
// fixed ticks. Renderers take snapshots and interpolate between two of them. Nothing here draws.
//
// Order of one tick: Advance(), the drama's commands, Perform().

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

// A line that is shown as text without being spoken, such as a title.
struct StageCaption {
  int line = -1;           // Index into World::speeches.
  int64_t ticks = 0;       // Ticks since it appeared.
  int64_t ticks_left = 0;  // Ticks until it disappears.

  friend bool operator==(const StageCaption&, const StageCaption&) = default;
};

// The audio description for visitors who cannot see: one line at a time, in pauses of the speech.
// Nothing in the drama depends on it.
struct StageDescription {
  Utterance heard;         // The current line, or one whose captions are still shown.
  int waiting = -1;        // The next line, an index into World::speeches; -1: none.
  int64_t ticks_left = 0;  // Ticks until the waiting line is dropped.

  friend bool operator==(const StageDescription&, const StageDescription&) = default;
};

// The states of all actors and objects at one moment, in the order of their slots.
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
  std::vector<StageSound> sounds;  // Sounds::playing()
  std::vector<StageCaption> captions;
  StageDescription description;

  friend bool operator==(const StageSnapshot&, const StageSnapshot&) = default;
};

// The time of day on the stage, which chooses between a place's probes.
struct Daylight {
  std::optional<double> hour;  // 0 to 24; none: the drama has not set one.
  double hours_left = 0.0;     // Hours still to go in a transition; negative: backwards.
  double seconds_left = 0.0;   // Remaining time of the transition, which is linear.

  friend bool operator==(const Daylight&, const Daylight&) = default;
};

class Stage {
 public:
  static constexpr double kTickSeconds = Sounds::kTickSeconds;
  static constexpr float kClipFade = 0.3f;  // Crossfade between clips, seconds.
  // How long an utterance stays after its end, so that its captions can be read.
  static constexpr double kReadOnSeconds = 4.0;
  static constexpr size_t kMaxCaptions = 4;
  static double UtteredSeconds(const Utterance& utterance) {
    return static_cast<double>(utterance.ticks) * kTickSeconds;
  }

  Stage();
  ~Stage();
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

  // ---- contents of the stage; must not change while a drama runs ----

  // Names must be unique among actors and objects. A new actor is hidden and stands at the origin.
  Result<ActorId> Add(std::string name, std::shared_ptr<const human::Human> human);
  Result<ActorId> Add(std::string name, std::shared_ptr<const human::AnimationRig> model);
  Result<ObjectId> AddObject(std::string name,
                             std::shared_ptr<const ObjectModel> model,
                             const Pose& stage_from_object);
  // Adds a line that actors can say; `name` is the id of the line. The line takes the time of
  // `timing`, if there is one, and else that of `track`, which moves the mouth.
  Status AddSpeech(std::string name,
                   human::VisemeTrack track,
                   std::optional<human::VisemeTrack> timing = std::nullopt);
  // Sets the floor and the occluders of all places. A drama must run the same way in every place,
  // so actors avoid the solids of all of them.
  Status SetFloor(const NavigationOptions& options, std::span<const Place> places);

  std::optional<ActorId> Find(std::string_view name) const;
  std::optional<ObjectId> FindObject(std::string_view name) const;
  std::optional<int> FindSpeech(std::string_view name) const;
  double SpeechSeconds(int speech) const;
  const human::VisemeTrack& SpeechTrack(int speech) const;  // Timing of the line.
  // nullptr when the id is stale.
  Actor* Find(ActorId id);
  const Actor* Find(ActorId id) const;
  Object* Find(ObjectId id);
  const Object* Find(ObjectId id) const;
  // In the order of their slots.
  std::span<const ActorId> actors() const;
  std::span<const ObjectId> objects() const;

  // ---- commands of the drama ----

  Tasks& tasks() { return tasks_; }
  const Tasks& tasks() const { return tasks_; }
  Sounds& sounds() { return sounds_; }
  const Sounds& sounds() const { return sounds_; }
  // Takes effect at once. An actor stops its tasks; an object is taken out of its holder's hands.
  void Place(ActorId id, const glm::vec3& position, float heading);
  void Show(ActorId id, bool visible);
  void Place(ObjectId id, const Pose& stage_from_object);
  Status PlaceOn(ObjectId id, const Support& support);  // Error: the spot is taken.
  void SetState(ObjectId id, int state);
  // Changes the lights of an object: the level, a factor of the intensity in its file, within
  // `seconds`; the colour at once.
  void SetLightLevel(ObjectId id, float level, float seconds, Ease ease = Ease::kLinear);
  void SetLightColour(ObjectId id, const glm::vec3& colour);
  // Starts a line from its beginning; a negative `speech` silences the actor.
  void Say(ActorId id, int speech);
  // Shows the captions of a line that no one says. With more than kMaxCaptions, the oldest
  // disappears.
  void Caption(int speech, double seconds);
  std::span<const StageCaption> captions() const { return captions_; }
  // Queues a line of the audio description. It starts, from the next tick on, as soon as no one
  // speaks and no other description is heard. It is dropped after `patience` seconds or when
  // another one is queued.
  void Describe(int speech, double patience);
  const StageDescription& description() const { return description_; }
  // Plays a clip once on a part of the body, then resumes the previous clip.
  void Gesture(ActorId id, int clip, human::BodyPart part);

  // Moves the time of day to `hour` (0 to 24) within `seconds`, the shorter way round the clock; at
  // once if no hour was set before.
  void SetHour(double hour, double seconds);
  const Daylight& daylight() const { return daylight_; }
  // The best point to step to that is `metres` or a little more from a point; none: no such point
  // can be reached.
  std::optional<glm::vec2> FindAway(ActorId id, glm::vec2 from, float metres);

  // Positions of the eyes of visitors, stage frame; none: unknown. Only gazes depend on them. An
  // actor looks at one of them, and in the next turn at the next.
  void SetVisitors(std::span<const glm::vec3> positions, size_t turn);
  // The eyes of the visitor at whom an actor may look; none: unknown.
  std::optional<glm::vec3> VisitorFor(ActorId actor) const;

  // ---- time ----

  // Advances walks, tasks, objects, clips and speech by one tick.
  void Advance();
  // Updates bodies, gazes and faces. Call it after the drama's commands of this tick.
  void Perform();
  // Returns all actors and objects to their initial state.
  void Reset();

  // Does not allocate when the snapshot has enough capacity.
  void Capture(StageSnapshot& snapshot) const;

  // The complete state of a stage. After Restore() the stage continues bit for bit as it did after
  // Save(). Valid only for the same stage with the same actors and objects. The visitor is not part
  // of it.
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
    std::shared_ptr<Navigation> navigation;  // Shared, so that it need not be rebuilt.
    std::shared_ptr<const Navigation::State> walkers;
    std::vector<Gate> gates;
    bool floor_changed = false;
  };
  // Call it before Save(), and at each tick at which a drama might save: see Navigation::Settle.
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
  std::vector<Gate> gates_;    // Same order as the gates of Navigation.
  bool floor_changed_ = true;  // The navigation must be rebuilt.
};

// The stage between two snapshots of consecutive ticks, alpha 0..1. Headings turn the shorter way.
// Entries that are new, were shown or hidden, or jumped are taken from `current`. Does not allocate
// in steady state.
void Interpolate(const StageSnapshot& previous,
                 const StageSnapshot& current,
                 float alpha,
                 StageSnapshot& result);

}  // namespace lararium::stage
