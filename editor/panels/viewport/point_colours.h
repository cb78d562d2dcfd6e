#pragma once

// The colours of a map's points in the scene view: those of the images, or a property of the
// points.

#include <cstdint>
#include <glm/gtc/type_precision.hpp>
#include <vector>

#include "editor/train/map_statistics.h"
#include "shared/vision/scene_database.h"

namespace lararium::panels {

enum class PointColour { kPicture, kError, kViews, kSessions };
inline constexpr int kPointColours = 4;

// The next one; after the last, the first.
PointColour After(PointColour colour);

// The values at the ends of the colour ramp. Values outside have the colour of the nearer end.
struct ColourRange {
  double low = 0.0;
  double high = 1.0;

  // The position of a value, 0 to 1 within the range.
  double Share(double value) const { return (value - low) / (high - low); }
};

// The smallest of 1, 2 and 5 times a power of ten that is at least value. value > 0.
double RoundUp(double value);

// The upper end is the 95th percentile of the points, rounded up, so that a few outliers do not
// compress the scale.
ColourRange ErrorRange(const train::MapStatistics& statistics);
ColourRange ViewRange(const train::MapStatistics& statistics);
// The range of colours that are a ramp; 0 to 1 for others. Reads all points.
ColourRange RangeOf(const train::MapStatistics& statistics, PointColour colour);

// [points], opaque sRGB.
std::vector<glm::u8vec4> ColoursOf(const train::MapStatistics& statistics, PointColour colour);

// The sessions of the keyframes, ascending.
std::vector<uint32_t> SessionsOf(const vision::SceneDatabase& database);

}  // namespace lararium::panels
