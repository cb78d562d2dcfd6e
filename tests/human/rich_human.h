#pragma once

#include "shared/human/human.h"

namespace lararium::human {

// The two-joint human with one of everything that a person can have. Its texture is only the
// beginning of an image.
Human RichHuman();

}  // namespace lararium::human
