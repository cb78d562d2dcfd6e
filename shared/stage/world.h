#pragma once

// Everybody and everything on a stage, for the parts of the stage that move it.
// Private to the room.

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
  };

  SlotMap<Actor> actors;
  std::vector<ActorId> actor_ids;  // in the order of their slots
  SlotMap<Object> objects;
  std::vector<ObjectId> object_ids;
  std::vector<Speech> speeches;
  std::shared_ptr<Navigation> navigation;  // none until somebody walks
  std::optional<glm::vec3> visitor;        // stage

  Actor& actor(ActorId id) { return *actors.Find(id); }
  Object& object(ObjectId id) { return *objects.Find(id); }
};

// A name in what the drama's author is told.
inline std::string Quoted(const std::string& name) { return "'" + name + "'"; }

// Frame of a grip as it is now, in somebody's frame.
human::GripFrame ActorFromGrip(const Actor& actor, const Object& object, int grip);
// What somebody's hand holds; zero: nothing.
ObjectId InHand(const World& world, ActorId actor, int side);

}  // namespace lararium::stage
