#pragma once

// A deliberate breach: geometry must not know vision. layers.cmake must see it.
#include "shared/vision/features.h"
