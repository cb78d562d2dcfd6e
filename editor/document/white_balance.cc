#include "editor/document/white_balance.h"

#include <cmath>

namespace lararium::editor {

glm::vec3 BalanceOf(const WhiteBalance& white) {
  return {std::exp2(0.5 * white.warmth - white.tint / 3.0), std::exp2(2.0 * white.tint / 3.0),
          std::exp2(-0.5 * white.warmth - white.tint / 3.0)};
}

WhiteBalance WhiteBalanceOf(const glm::vec3& balance) {
  const double red = std::log2(static_cast<double>(balance.r));
  const double green = std::log2(static_cast<double>(balance.g));
  const double blue = std::log2(static_cast<double>(balance.b));
  return {red - blue, green - 0.5 * (red + blue)};
}

}  // namespace lararium::editor
