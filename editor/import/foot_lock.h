#pragma once

// Feet that stand are held; those that do not come and go smoothly.

#include <array>
#include <vector>

#include "shared/human/body.h"
#include "shared/human/clip.h"
#include "shared/human/skeleton.h"

namespace lararium::import {

// By key: whether the heel or the ball of a foot stands.
struct FootContacts {
  std::vector<bool> heel, ball;
};

// Corrects the legs of every key, and sinks the hips where legs would not reach. The clip
// travels: what stands stands still in the frame of the keys. Nothing goes below the
// floor (y = 0) by more than the feet do at rest.
void LockFeet(const human::Skeleton& skeleton,
              const human::Body& body,
              const std::array<FootContacts, 2>& contacts,
              human::Clip& clip);

}  // namespace lararium::import
