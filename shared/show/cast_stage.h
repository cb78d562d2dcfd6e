#pragma once

// The bodies of the cast, simulated from frame to frame.

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "shared/show/cast_detail.h"
#include "shared/show/light_director.h"
#include "shared/show/staged_frame.h"
#include "shared/stage/stage.h"

namespace lararium::show {

class CastStage {
 public:
  // actors: the actor of each member of the cast on `stage`. Borrows log.
  CastStage(const ShowContent& content,
            std::vector<stage::ActorId> actors,
            const stage::Stage& stage,
            Log& log);

  CastDetail& detail() { return detail_; }
  std::span<const stage::ActorId> actors() const { return actors_; }
  const CharacterInstance& body(size_t cast) const { return bodies_[cast]; }
  void SetMesh(size_t cast, CharacterMesh figure);
  // Replaces a body by that of another rig of the same person. Its hair and cloth begin at rest.
  void SetPerson(size_t cast, const std::shared_ptr<const human::AnimationRig>& model);

  // Steps the simulation of the visible actors of `drawn` to `time` (seconds), computes their
  // moving vertices and fills `people`; people run in parallel. Without a pose of the camera the
  // previous choice of details is kept. `drawn` must outlive the use of visible(). Returns the CPU
  // milliseconds of other threads.
  double Stage(const stage::StageSnapshot& drawn,
               double time,
               const geometry::CameraModel& image_camera,
               const std::optional<geometry::Rigid3>& camera_from_stage,
               const PlaceLight& light,
               StagedPeople& people);

  // The visible actors of the last Stage(), in the order of the cast.
  std::span<const VisibleActor> visible() const { return visible_; }
  // The mouth of a member in the stage's axes. Actors outside the picture, or not drawn, have a
  // mouth too.
  Mouth MouthOf(size_t cast, const stage::ActorState& state) const;

  // Until Restore(), Stage() uses other bodies, with hair and cloth at rest. Restore() also brings
  // back the choice of details.
  void SetAside();
  void Restore();

 private:
  void LayOut(const PlaceLight& light, StagedPeople& people) const;

  std::vector<stage::ActorId> actors_;
  std::vector<CharacterInstance> bodies_;        // Parallel to actors_.
  std::vector<CharacterInstance> other_bodies_;  // Bodies that are not in use; may be empty.
  CastDetail detail_;
  CastDetail::Choice choice_before_;
  std::vector<VisibleActor> visible_;
};

}  // namespace lararium::show
