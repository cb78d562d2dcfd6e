#include "editor/bake/sun_split.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <span>
#include <vector>

#include "shared/core/units.h"

namespace lararium::bake {
namespace {
constexpr int kSearchWidth = 512;
constexpr double kWindow = light::kMaxSunRadius;
constexpr double kAround = 2.0 * kWindow;  // The surrounding radiance is measured up to this angle.
constexpr double kHeld = 0.98;             // Share of the window's excess that the cap contains.
constexpr double kSmallestRadius = 0.00465;  // No outdoor source of this brightness is smaller.

double Luminance(const glm::dvec3& c) { return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b; }

// Directions and solid angles of the texels of an image.
struct Texels {
  int width = 0;
  int height = 0;

  glm::dvec3 Direction(double column, double row) const {
    const double azimuth = 2.0 * kPi * (column / width - 0.5);
    const double elevation = kPi * (0.5 - row / height);
    const double level = std::cos(elevation);
    return {level * std::sin(azimuth), std::sin(elevation), -level * std::cos(azimuth)};
  }
  double SolidAngle(int row) const {
    return 2.0 * kPi / width * (std::cos(kPi * row / height) - std::cos(kPi * (row + 1) / height));
  }
  double side() const { return kPi / height; }
};

struct CapTexel {
  size_t index = 0;
  double angle = 0.0;  // Angle from the centre.
  double solid_angle = 0.0;
};

// The texels whose centre is within `radius` of a direction.
std::vector<CapTexel> Cap(const Texels& texels, const glm::dvec3& centre, double radius) {
  const double polar = std::acos(std::clamp(centre.y, -1.0, 1.0));
  const int first = std::max(0, static_cast<int>((polar - radius) / texels.side()) - 1);
  const int last =
      std::min(texels.height - 1, static_cast<int>((polar + radius) / texels.side()) + 1);
  const double least_cosine = std::cos(radius);
  std::vector<CapTexel> cap;
  for (int row = first; row <= last; ++row) {
    for (int column = 0; column < texels.width; ++column) {
      const double cosine = glm::dot(texels.Direction(column + 0.5, row + 0.5), centre);
      if (cosine >= least_cosine) {
        cap.push_back({static_cast<size_t>(row) * static_cast<size_t>(texels.width) +
                           static_cast<size_t>(column),
                       std::acos(std::min(1.0, cosine)), texels.SolidAngle(row)});
      }
    }
  }
  return cap;
}

// The direction of the brightest block of texels, with about kSearchWidth blocks in a row.
glm::dvec3 BrightestDirection(const ProbeImage& image) {
  const int block = std::max(1, image.width / kSearchWidth);
  const Texels texels{image.width, image.height};
  double most = -1.0;
  glm::dvec3 direction(0.0, 1.0, 0.0);
  for (int row = 0; row < image.height; row += block) {
    for (int column = 0; column < image.width; column += block) {
      const int down = std::min(block, image.height - row);
      const int across = std::min(block, image.width - column);
      double sum = 0.0;
      for (int y = row; y < row + down; ++y) {
        for (int x = column; x < column + across; ++x) {
          sum += Luminance(glm::dvec3(image.pixels[static_cast<size_t>(y) * image.width + x]));
        }
      }
      if (sum / (down * across) > most) {
        most = sum / (down * across);
        direction = texels.Direction(column + 0.5 * across, row + 0.5 * down);
      }
    }
  }
  return direction;
}

// The mean radiance of the ring about the window.
glm::dvec3 RadianceAround(const ProbeImage& image, std::span<const CapTexel> cap) {
  glm::dvec3 sum(0.0);
  double weight = 0.0;
  for (const CapTexel& texel : cap) {
    if (texel.angle > kWindow) {
      sum += texel.solid_angle * glm::dvec3(image.pixels[texel.index]);
      weight += texel.solid_angle;
    }
  }
  return weight > 0.0 ? sum / weight : glm::dvec3(0.0);
}

glm::dvec3 Excess(const ProbeImage& image, const CapTexel& texel, const glm::dvec3& around) {
  return glm::max(glm::dvec3(image.pixels[texel.index]) - around, glm::dvec3(0.0));
}

glm::dvec3 Centroid(const ProbeImage& image,
                    const Texels& texels,
                    std::span<const CapTexel> cap,
                    const glm::dvec3& around,
                    const glm::dvec3& before) {
  glm::dvec3 sum(0.0);
  for (const CapTexel& texel : cap) {
    if (texel.angle <= kWindow) {
      const auto column = static_cast<double>(texel.index % static_cast<size_t>(image.width));
      const auto row = static_cast<double>(texel.index / static_cast<size_t>(image.width));
      sum += texel.solid_angle * Luminance(Excess(image, texel, around)) *
             texels.Direction(column + 0.5, row + 0.5);
    }
  }
  const double length = glm::length(sum);
  return length > 0.0 ? sum / length : before;
}

// Luminance of the irradiance of a surface that faces a direction.
double FacingLuminance(const ProbeImage& image, const Texels& texels, const glm::dvec3& normal) {
  double sum = 0.0;
  for (int row = 0; row < image.height; ++row) {
    double of_row = 0.0;
    for (int column = 0; column < image.width; ++column) {
      const double cosine = glm::dot(texels.Direction(column + 0.5, row + 0.5), normal);
      if (cosine > 0.0) {
        of_row +=
            cosine *
            Luminance(glm::dvec3(image.pixels[static_cast<size_t>(row) * image.width + column]));
      }
    }
    sum += texels.SolidAngle(row) * of_row;
  }
  return sum;
}

// The angle that contains kHeld of the window's excess, plus one texel, because the outermost
// texels are partly covered. `cap` is sorted by angle.
double HoldingRadius(const ProbeImage& image,
                     const Texels& texels,
                     std::span<const CapTexel> cap,
                     const glm::dvec3& around) {
  double all = 0.0;
  for (const CapTexel& texel : cap) {
    all += texel.angle <= kWindow ? texel.solid_angle * Luminance(Excess(image, texel, around)) : 0;
  }
  double held = 0.0;
  for (const CapTexel& texel : cap) {
    held += texel.solid_angle * Luminance(Excess(image, texel, around));
    if (held >= kHeld * all) {
      return std::min(texel.angle + texels.side(), kWindow);
    }
  }
  return kWindow;
}

struct Source {
  glm::dvec3 irradiance = glm::dvec3(0.0);
  double angular_radius = 0.0;
};

// Measures the radiance of the cap beyond its surroundings. A uniform disc of radius R has a
// mean squared angle of R^2 / 2; a texel of side s adds s^2 / 6.
Source Measure(const ProbeImage& image,
               const Texels& texels,
               std::span<const CapTexel> cap,
               const glm::dvec3& around,
               double radius) {
  Source source;
  double flux = 0.0;
  double moment = 0.0;
  for (const CapTexel& texel : cap) {
    if (texel.angle > radius) {
      continue;
    }
    const glm::dvec3 excess = texel.solid_angle * Excess(image, texel, around);
    source.irradiance += std::cos(texel.angle) * excess;
    flux += Luminance(excess);
    moment += texel.angle * texel.angle * Luminance(excess);
  }
  const double squared = flux > 0.0 ? 2.0 * moment / flux : 0.0;
  const double of_texel = texels.side() * texels.side() / 3.0;
  source.angular_radius =
      std::clamp(std::sqrt(std::max(0.0, squared - of_texel)), kSmallestRadius, kWindow);
  return source;
}

}  // namespace

SplitProbe SplitSun(const ProbeImage& image) {
  constexpr int kCentrings = 3;
  const Texels texels{image.width, image.height};
  glm::dvec3 direction = BrightestDirection(image);
  std::vector<CapTexel> cap;
  glm::dvec3 around(0.0);
  for (int i = 0; i <= kCentrings; ++i) {
    cap = Cap(texels, direction, kAround);
    around = RadianceAround(image, cap);
    if (i < kCentrings) {
      direction = Centroid(image, texels, cap, around, direction);
    }
  }
  std::sort(cap.begin(), cap.end(),
            [](const CapTexel& a, const CapTexel& b) { return a.angle < b.angle; });
  const double radius = HoldingRadius(image, texels, cap, around);
  const Source source = Measure(image, texels, cap, around, radius);

  SplitProbe split{image, std::nullopt, {}, 0.0};
  split.brightest = {glm::vec3(direction), glm::vec3(source.irradiance),
                     static_cast<float>(source.angular_radius)};
  const double facing = FacingLuminance(image, texels, direction);
  split.share = facing > 0.0 ? Luminance(source.irradiance) / facing : 0.0;
  if (split.share < kLeastSunShare) {
    return split;
  }
  split.sun = split.brightest;
  for (const CapTexel& texel : cap) {
    if (texel.angle <= radius) {
      split.sky.pixels[texel.index] = glm::min(split.sky.pixels[texel.index], glm::vec3(around));
    }
  }
  return split;
}

light::ProbeLight ProjectProbeLight(const ProbeImage& image, const ProbePlacement& placement) {
  const SplitProbe split = SplitSun(image);
  return light::Placed(
      {light::ProjectEquirectangular(split.sky.pixels, image.width, image.height), split.sun},
      placement.stage_from_probe, placement.radiance_scale);
}

}  // namespace lararium::bake
