#pragma once

#include "shared/human/human.h"

namespace lararium::human {

// The two-joint human with one of everything that a person can have. Its texture only
// begins like an image.
Human RichHuman();

}  // namespace lararium::human
