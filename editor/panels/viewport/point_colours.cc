#include "editor/panels/viewport/point_colours.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "editor/panels/widgets/palette.h"

namespace lararium::panels {

namespace {

constexpr double kShare = 0.95;
constexpr glm::u8vec4 kUnknown(96, 98, 104, 255);

glm::u8vec4 Bytes(const ImVec4& c) {
  return glm::u8vec4(glm::vec4(c.x, c.y, c.z, 1.0f) * 255.0f + 0.5f);
}

// The 95th percentile of the values; 0 where there are none.
template <typename Value>
double UpperEnd(std::vector<Value> values) {
  if (values.empty()) {
    return 0.0;
  }
  const auto index = static_cast<ptrdiff_t>(kShare * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + index, values.end());
  return static_cast<double>(values[static_cast<size_t>(index)]);
}

// A brighter grey, so that dark points are visible on the background.
glm::u8vec4 Lifted(uint8_t grey) {
  const auto shade = static_cast<uint8_t>(70 + grey * 185 / 255);
  return {shade, shade, shade, 255};
}

glm::u8vec4 ColourOfSession(uint8_t session) {
  return Bytes(session == train::kNoSingleSession ? kSeveralColour : SessionColour(session));
}

}  // namespace

PointColour After(PointColour colour) {
  return static_cast<PointColour>((static_cast<int>(colour) + 1) % kPointColours);
}

double RoundUp(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  constexpr double kSlack = 1e-9;  // Tolerance for the rounding of logarithms.
  for (const double step : {1.0, 2.0, 5.0}) {
    if (value <= step * power * (1.0 + kSlack)) {
      return step * power;
    }
  }
  return 10.0 * power;
}

ColourRange ErrorRange(const train::MapStatistics& statistics) {
  std::vector<float> known;
  std::copy_if(statistics.point_error_px.begin(), statistics.point_error_px.end(),
               std::back_inserter(known), [](float error) { return error >= 0.0f; });
  constexpr double kLeast = 0.1;  // pixels
  return {0.0, RoundUp(std::max(UpperEnd(std::move(known)), kLeast))};
}

ColourRange ViewRange(const train::MapStatistics& statistics) {
  constexpr double kFewest = 2.0;
  std::vector<uint32_t> views;
  for (uint32_t i = 0; i + 1 < statistics.first_observation.size(); ++i) {
    views.push_back(statistics.ViewsOf(i));
  }
  return {kFewest, std::max(RoundUp(std::max(UpperEnd(std::move(views)), 1.0)), 5.0)};
}

ColourRange RangeOf(const train::MapStatistics& statistics, PointColour colour) {
  switch (colour) {
    case PointColour::kError:
      return ErrorRange(statistics);
    case PointColour::kViews:
      return ViewRange(statistics);
    case PointColour::kPicture:
    case PointColour::kSessions:
      break;
  }
  return {};
}

std::vector<glm::u8vec4> ColoursOf(const train::MapStatistics& statistics, PointColour colour) {
  std::vector<glm::u8vec4> colours;
  const auto count = static_cast<uint32_t>(statistics.point_shades.size());
  colours.reserve(count);
  const ColourRange range = RangeOf(statistics, colour);
  for (uint32_t i = 0; i < count; ++i) {
    switch (colour) {
      case PointColour::kPicture:
        colours.push_back(Lifted(statistics.point_shades[i]));
        break;
      case PointColour::kError:
        colours.push_back(statistics.point_error_px[i] < 0.0f
                              ? kUnknown
                              : Bytes(RampColour(range.Share(statistics.point_error_px[i]))));
        break;
      case PointColour::kViews:
        colours.push_back(Bytes(RampColour(range.Share(statistics.ViewsOf(i)))));
        break;
      case PointColour::kSessions:
        colours.push_back(ColourOfSession(statistics.point_session[i]));
        break;
    }
  }
  return colours;
}

std::vector<uint32_t> SessionsOf(const vision::SceneDatabase& database) {
  std::set<uint32_t> sessions;
  for (const vision::Keyframe& keyframe : database.keyframes) {
    sessions.insert(keyframe.session);
  }
  return {sessions.begin(), sessions.end()};
}

}  // namespace lararium::panels
