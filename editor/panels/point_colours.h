#pragma once

// The colours of a map's points around the place: as photographed, or by what is known of them.

#include <cstdint>
#include <glm/gtc/type_precision.hpp>
#include <span>
#include <vector>

#include "editor/train/map_statistics.h"
#include "shared/vision/scene_database.h"

namespace lararium::panels {

enum class PointColour { kPicture, kError, kViews, kSessions };
inline constexpr int kPointColours = 4;

// The next one, and after the last the first.
PointColour After(PointColour colour);

// What the ends of the ramp stand for; what lies beyond has the colour of that end.
struct ColourRange {
  double low = 0.0;
  double high = 1.0;

  // 0 to 1.
  double Share(double value) const { return (value - low) / (high - low); }
};

// The least of 1, 2 and 5 times a power of ten that is not less. value > 0.
double RoundUp(double value);

// So that a few outliers do not make all others look alike, the upper end is what 95 of 100
// points do not exceed, rounded up.
ColourRange ErrorRange(const train::MapStatistics& statistics);
ColourRange ViewRange(const train::MapStatistics& statistics);
// Of colours that are a ramp; 0 to 1 otherwise. Looks at all points.
ColourRange RangeOf(const train::MapStatistics& statistics, PointColour colour);

// [points], opaque sRGB.
std::vector<glm::u8vec4> ColoursOf(const train::MapStatistics& statistics, PointColour colour);

// The sessions that keyframes are of, ascending.
std::vector<uint32_t> SessionsOf(const vision::SceneDatabase& database);

}  // namespace lararium::panels
