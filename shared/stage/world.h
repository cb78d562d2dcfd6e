#pragma once

// The actors and objects on a stage, for the code that moves them. Internal to shared/stage.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "shared/core/id.h"
#include "shared/human/face.h"
#include "shared/stage/actor.h"
#include "shared/stage/navigation.h"
#include "shared/stage/object.h"

namespace lararium::stage {

struct World {
  struct Speech {
    std::string name;
    human::VisemeTrack track;
    std::optional<human::VisemeTrack> timing;  // The line takes the time of `track` without it.
  };

  SlotMap<Actor> actors;
  std::vector<ActorId> actor_ids;  // Sorted by slot.
  SlotMap<Object> objects;
  std::vector<ObjectId> object_ids;
  std::vector<Speech> speeches;
  std::shared_ptr<Navigation> navigation;  // Null until the first task.
  std::vector<glm::vec3> visitors;         // Eyes of visitors, stage frame.
  size_t turn = 0;                         // Each turn, actors look at the next visitor.

  Actor& actor(ActorId id) { return *actors.Find(id); }
  Object& object(ObjectId id) { return *objects.Find(id); }
  // The visitor at whom an actor may look now: two actors begin with different ones.
  std::optional<glm::vec3> VisitorFor(ActorId id) const {
    return visitors.empty() ? std::nullopt
                            : std::optional(visitors[(turn + id.index) % visitors.size()]);
  }
};

// Quotes a name for a message to the author of the drama.
inline std::string Quoted(const std::string& name) { return "'" + name + "'"; }

// The current pose of a grip in the actor's frame.
human::GripFrame ActorFromGrip(const Actor& actor, const Object& object, int grip);
// The object in a hand of an actor (human::kRight or kLeft); zero: none.
ObjectId InHand(const World& world, ActorId actor, int side);

}  // namespace lararium::stage
