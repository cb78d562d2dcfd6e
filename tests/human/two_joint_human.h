#pragma once

#include "shared/human/human.h"

namespace lararium::human {

// An upper arm from (0, 1, 0) and a forearm from (1, 1, 0), both along +x, with a
// four-vertex part and two clips: bend (a quarter turn of the forearm about z in
// one second) and turn (loops, the root once about y in two seconds).
Human TwoJointHuman();

}  // namespace lararium::human
