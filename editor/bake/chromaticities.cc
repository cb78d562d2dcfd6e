#include "editor/bake/chromaticities.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/matrix.hpp>

namespace lararium::bake {
namespace {

constexpr Chromaticities kBt709 = {{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}, {0.3127, 0.3290}};

glm::dvec3 Xyz(const glm::dvec2& xy) { return {xy.x / xy.y, 1.0, (1.0 - xy.x - xy.y) / xy.y}; }

// The matrix whose white has the luminance 1 (SMPTE RP 177).
glm::dmat3 XyzFromRgb(const Chromaticities& of) {
  const glm::dmat3 primaries(Xyz(of.red), Xyz(of.green), Xyz(of.blue));
  const glm::dvec3 shares = glm::inverse(primaries) * Xyz(of.white);
  return {primaries[0] * shares.r, primaries[1] * shares.g, primaries[2] * shares.b};
}

glm::dmat3 Adaptation(const glm::dvec2& from, const glm::dvec2& to) {
  const glm::dmat3 bradford = glm::transpose(
      glm::dmat3(0.8951, 0.2664, -0.1614, -0.7502, 1.7135, 0.0367, 0.0389, -0.0685, 1.0296));
  const glm::dvec3 gain = (bradford * Xyz(to)) / (bradford * Xyz(from));
  return glm::inverse(bradford) * glm::dmat3(gain.r, 0.0, 0.0, 0.0, gain.g, 0.0, 0.0, 0.0, gain.b) *
         bradford;
}

bool Nearly(const Chromaticities& a, const Chromaticities& b) {
  constexpr double kTolerance = 2e-3;
  const auto near = [](const glm::dvec2& p, const glm::dvec2& q) {
    return std::max(std::abs(p.x - q.x), std::abs(p.y - q.y)) < kTolerance;
  };
  return near(a.red, b.red) && near(a.green, b.green) && near(a.blue, b.blue) &&
         near(a.white, b.white);
}

bool AllFinite(const glm::dmat3& m) {
  for (int i = 0; i < 9; ++i) {
    if (!std::isfinite(m[i / 3][i % 3])) {
      return false;
    }
  }
  return true;
}

}  // namespace

Status ConvertToBt709(const Chromaticities& from, ProbeImage& image, const std::string& where) {
  if (Nearly(from, kBt709)) {
    return Status();
  }
  const glm::dmat3 exact =
      glm::inverse(XyzFromRgb(kBt709)) * Adaptation(from.white, kBt709.white) * XyzFromRgb(from);
  if (!AllFinite(exact)) {
    return Status::Error(where, "its primaries are no colours",
                         "save it again with those of BT.709");
  }
  const glm::mat3 bt709_from_file(exact);
  for (glm::vec3& pixel : image.pixels) {
    const glm::vec3 converted = bt709_from_file * pixel;
    if (!std::isfinite(converted.r + converted.g + converted.b)) {
      continue;
    }
    const bool possible = std::min({pixel.r, pixel.g, pixel.b}) >= 0.0f;
    pixel = possible ? glm::max(converted, glm::vec3(0.0f)) : converted;
  }
  image.warnings.push_back("its colours were converted from its own primaries to those of BT.709");
  return Status();
}

}  // namespace lararium::bake
