#include "editor/bake/environment.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "shared/core/units.h"

namespace lararium::bake {
namespace {

float Luminance(const glm::vec3& c) { return 0.2126f * c.r + 0.7152f * c.g + 0.0722f * c.b; }

// Gives continuous column and row; texel centres are at halves.
glm::vec2 ImageFromDirection(const glm::vec3& d, int width, int height) {
  const float azimuth = std::atan2(d.x, -d.z);
  const float elevation = std::asin(std::clamp(d.y, -1.0f, 1.0f));
  return {(azimuth / (2.0f * kPiF) + 0.5f) * static_cast<float>(width),
          (0.5f - elevation / kPiF) * static_cast<float>(height)};
}

glm::vec3 DirectionFromImage(float column, float row, int width, int height) {
  const float azimuth = 2.0f * kPiF * (column / static_cast<float>(width) - 0.5f);
  const float elevation = kPiF * (0.5f - row / static_cast<float>(height));
  const float level = std::cos(elevation);
  return {level * std::sin(azimuth), std::sin(elevation), -level * std::cos(azimuth)};
}

// The mean luminance over a texel when it is interpolated with its neighbours. Next to a small
// sun this is far from dark.
float InterpolatedLuminance(const ProbeImage& image, int column, int row) {
  constexpr float kShare[3] = {0.125f, 0.75f, 0.125f};
  float sum = 0.0f;
  for (int down = -1; down <= 1; ++down) {
    const int y = std::clamp(row + down, 0, image.height - 1);
    for (int across = -1; across <= 1; ++across) {
      const int x = (column + across + image.width) % image.width;
      sum += kShare[down + 1] * kShare[across + 1] *
             Luminance(image.pixels[static_cast<size_t>(y) * static_cast<size_t>(image.width) +
                                    static_cast<size_t>(x)]);
    }
  }
  return sum;
}

// Replaces values by their cumulative sums divided by the total, and returns the total.
float Cumulate(std::span<float> values) {
  double sum = 0.0;
  for (float& value : values) {
    sum += value;
    value = static_cast<float>(sum);
  }
  for (float& value : values) {
    value = sum > 0.0 ? static_cast<float>(value / sum) : 1.0f;
  }
  values.back() = 1.0f;
  return static_cast<float>(sum);
}

// The index of the interval that contains x, and the position in it (0..1).
std::pair<int, float> FindInterval(std::span<const float> ends, float x) {
  const auto found = std::upper_bound(ends.begin(), ends.end(), x);
  const auto index = static_cast<int>(
      std::min<ptrdiff_t>(found - ends.begin(), static_cast<ptrdiff_t>(ends.size()) - 1));
  const float begin = index == 0 ? 0.0f : ends[static_cast<size_t>(index) - 1];
  const float length = ends[static_cast<size_t>(index)] - begin;
  return {index, length > 0.0f ? std::clamp((x - begin) / length, 0.0f, 1.0f) : 0.5f};
}

}  // namespace

Environment::Environment(ProbeImage image, const ProbePlacement& placement)
    : image_(std::move(image)),
      stage_from_probe_(placement.stage_from_probe),
      probe_from_stage_(glm::conjugate(placement.stage_from_probe)),
      scale_(placement.radiance_scale),
      row_ends_(static_cast<size_t>(image_.height)),
      column_ends_(image_.pixels.size()) {
  const auto width = static_cast<size_t>(image_.width);
  for (size_t row = 0; row < row_ends_.size(); ++row) {
    const float elevation =
        kPiF * (0.5f - (static_cast<float>(row) + 0.5f) / static_cast<float>(image_.height));
    for (size_t column = 0; column < width; ++column) {
      column_ends_[row * width + column] =
          InterpolatedLuminance(image_, static_cast<int>(column), static_cast<int>(row)) *
          std::cos(elevation);
    }
    row_ends_[row] = Cumulate(std::span(column_ends_).subspan(row * width, width));
  }
  Cumulate(row_ends_);
}

glm::vec3 Environment::Radiance(const glm::vec3& direction) const {
  const glm::vec2 at =
      ImageFromDirection(probe_from_stage_ * direction, image_.width, image_.height);
  const float x = at.x - 0.5f;
  const float y = std::clamp(at.y - 0.5f, 0.0f, static_cast<float>(image_.height - 1));
  const int left = static_cast<int>(std::floor(x));
  const int top = std::min(static_cast<int>(y), image_.height - 1);
  const auto texel = [&](int column, int row) {
    const int wrapped = ((column % image_.width) + image_.width) % image_.width;
    const int clamped = std::min(row, image_.height - 1);
    return image_.pixels[static_cast<size_t>(clamped) * static_cast<size_t>(image_.width) +
                         static_cast<size_t>(wrapped)];
  };
  const float fx = x - static_cast<float>(left);
  const float fy = y - static_cast<float>(top);
  return scale_ * ((1.0f - fy) * ((1.0f - fx) * texel(left, top) + fx * texel(left + 1, top)) +
                   fy * ((1.0f - fx) * texel(left, top + 1) + fx * texel(left + 1, top + 1)));
}

Environment::Texel Environment::TexelOf(const glm::vec3& in_probe) const {
  const glm::vec2 at = ImageFromDirection(in_probe, image_.width, image_.height);
  return {std::clamp(static_cast<int>(at.x), 0, image_.width - 1),
          std::clamp(static_cast<int>(at.y), 0, image_.height - 1)};
}

float Environment::TexelDensity(const Texel& texel) const {
  const auto width = static_cast<size_t>(image_.width);
  const auto row = static_cast<size_t>(texel.row);
  const auto column = static_cast<size_t>(texel.column);
  const float row_share = row_ends_[row] - (row == 0 ? 0.0f : row_ends_[row - 1]);
  const float* ends = &column_ends_[row * width];
  const float share = ends[column] - (column == 0 ? 0.0f : ends[column - 1]);
  // Draw samples a row uniformly in elevation; the solid angle shrinks towards the poles.
  const float top = kPiF * (0.5f - static_cast<float>(row) / static_cast<float>(image_.height));
  const float bottom = top - kPiF / static_cast<float>(image_.height);
  const float solid_angle =
      2.0f * kPiF / static_cast<float>(image_.width) * (std::sin(top) - std::sin(bottom));
  return row_share * share / std::max(solid_angle, 1e-12f);
}

Environment::Sample Environment::Draw(const glm::vec2& random) const {
  const auto [row, down] = FindInterval(row_ends_, random.y);
  const auto width = static_cast<size_t>(image_.width);
  const auto [column, across] = FindInterval(
      std::span(column_ends_).subspan(static_cast<size_t>(row) * width, width), random.x);
  // Uniform in solid angle within the texel.
  const float top =
      std::sin(kPiF * (0.5f - static_cast<float>(row) / static_cast<float>(image_.height)));
  const float bottom =
      std::sin(kPiF * (0.5f - static_cast<float>(row + 1) / static_cast<float>(image_.height)));
  const float height = std::asin(std::clamp(top + down * (bottom - top), -1.0f, 1.0f));
  const float exact_row = (0.5f - height / kPiF) * static_cast<float>(image_.height);
  const glm::vec3 in_probe = DirectionFromImage(static_cast<float>(column) + across, exact_row,
                                                image_.width, image_.height);
  return {stage_from_probe_ * in_probe, TexelDensity({column, row})};
}

float Environment::Density(const glm::vec3& direction) const {
  return TexelDensity(TexelOf(probe_from_stage_ * direction));
}

}  // namespace lararium::bake
