#pragma once

// Keeps standing feet in place and blends to moving feet smoothly.

#include <array>
#include <vector>

#include "shared/human/body_rig.h"
#include "shared/human/clip.h"
#include "shared/human/skeleton.h"

namespace lararium::import {

// For each key, whether the heel or the ball of a foot stands.
struct FootContacts {
  std::vector<bool> heel, ball;
};

// Corrects the legs at every key, and lowers the hips if legs would not reach. The clip has its
// root motion: a standing foot is fixed in the frame of the keys. No foot goes further below
// the floor (y = 0) than it is at rest.
void LockFeet(const human::Skeleton& skeleton,
              const human::BodyRig& body,
              const std::array<FootContacts, 2>& contacts,
              human::Clip& clip);

}  // namespace lararium::import
