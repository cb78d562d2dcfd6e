#include "shared/light/lamp.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "shared/core/check.h"
#include "shared/light/cap_means.h"

namespace lararium::light {
namespace {

// Minimum width of a penumbra at the blocker, metres: the distance between receivers.
constexpr float kLeastPenumbra = 0.03f;

struct Point8 {
  Lanes x, y, z;
};

Lanes Dot(const Point8& a, const Point8& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

// A lamp as seen from eight receivers.
struct Seen {
  Point8 direction;  // unit
  Lanes distance;
  Lanes half_sine2;  // sin^2 of half its angular radius
  Lanes share;       // visible share of the lamp
};

Seen LookAt(const Lamp& lamp, const Point8& at) {
  const Point8 to = {lamp.position.x - at.x, lamp.position.y - at.y, lamp.position.z - at.z};
  Seen seen;
  const float nearest = kNearestLamp * lamp.radius + 1e-4f;
  const Lanes distance = Max(Sqrt(Dot(to, to)), Broadcast(1e-6f));
  const Lanes inverse = 1.0f / distance;
  seen.direction = {to.x * inverse, to.y * inverse, to.z * inverse};
  seen.distance = Max(distance, Broadcast(nearest));
  const Lanes sine = lamp.radius / seen.distance;
  // sin^2(a / 2) = (1 - cos a) / 2, without subtracting nearly equal numbers.
  const Lanes sine2 = sine * sine;
  seen.half_sine2 = 0.5f * sine2 / (1.0f + Sqrt(1.0f - sine2));
  seen.share = Broadcast(1.0f);
  return seen;
}

// Reduces the visible share by a ball: the overlap of two discs at the ball's distance,
// approximated by a cubic of the distance of their centres.
void Hide(const Lamp& lamp, const Point8& at, const glm::vec4& ball, Seen& seen) {
  const Point8 to = {ball.x - at.x, ball.y - at.y, ball.z - at.z};
  const Lanes along = Dot(to, seen.direction);
  const Lanes off = Sqrt(Max(Dot(to, to) - along * along, Lanes{}));
  const Lanes wide = Max(lamp.radius * along / seen.distance, Broadcast(kLeastPenumbra));
  const Lanes within = Max(ball.w - wide, wide - ball.w);  // one disc inside the other
  const Lanes t =
      Min(Max((ball.w + wide - off) / (ball.w + wide - within), Lanes{}), Broadcast(1.0f));
  const Lanes size = Min(ball.w * ball.w / (wide * wide), Broadcast(1.0f));
  const Lanes covered = t * t * (3.0f - 2.0f * t) * size;
  const auto between = (along > 0.0f) & (along < seen.distance);
  seen.share = between ? seen.share * (1.0f - covered) : seen.share;
}

// Reduces the visible share by the walls around a lamp.
void HideByWalls(const Lamp& lamp, const Point8& at, size_t valid, Seen& seen) {
  for (size_t i = 0; i < valid; ++i) {
    seen.share[i] *= PastWalls(*lamp.walls, lamp.position, {at.x[i], at.y[i], at.z[i]});
  }
}

struct Bounds {
  glm::vec3 centre = glm::vec3(0.0f);
  float radius = 0.0f;
};

Bounds BoundsOf(const Points& points, const ReceiverRange& range) {
  glm::vec3 low(1e9f), high(-1e9f);
  for (size_t i = range.begin; i < range.end; ++i) {
    const glm::vec3 point(points.x[i], points.y[i], points.z[i]);
    low = glm::min(low, point);
    high = glm::max(high, point);
  }
  return {0.5f * (low + high), 0.5f * glm::distance(low, high)};
}

// True if a ball may be between the lamp and any of the receivers, that is, if it touches the cone
// from one to the other.
bool MayHide(const Lamp& lamp, const Bounds& receivers, const glm::vec4& ball) {
  const glm::vec3 centre(ball);
  if (!(ball.w > 0.0f) || glm::distance(centre, lamp.position) < ball.w + lamp.radius) {
    return false;
  }
  const glm::vec3 axis = receivers.centre - lamp.position;
  const float t = std::clamp(
      glm::dot(centre - lamp.position, axis) / std::max(glm::dot(axis, axis), 1e-6f), 0.0f, 1.0f);
  const float wide = lamp.radius + t * receivers.radius + kLeastPenumbra;
  return glm::distance(centre, lamp.position + t * axis) < ball.w + wide;
}

// The relevant balls, up to the number that is kept at once.
constexpr size_t kMaxHiding = 256;
struct Hiding {
  std::array<glm::vec4, kMaxHiding> balls;
  size_t count = 0;
};

void FindHiding(const Lamp& lamp,
                const Bounds& receivers,
                const Spheres& blockers,
                Hiding& hiding) {
  hiding.count = 0;
  for (size_t i = 0; i < blockers.radius.size() && hiding.count < kMaxHiding; ++i) {
    const glm::vec4 ball(blockers.x[i], blockers.y[i], blockers.z[i], blockers.radius[i]);
    if (MayHide(lamp, receivers, ball)) {
      hiding.balls[hiding.count++] = ball;
    }
  }
}

template <int Count>
void AddLamp(const Lamp& lamp,
             const Points& receivers,
             const ShRows& own_log,
             const Hiding& hiding,
             ReceiverRange range,
             ShRowsRgb& radiance) {
  constexpr int kDegree = ShDegreeOf(Count);
  const std::array<float, kShCount>& normalisation = FloatShNormalisation();
  for (size_t i = range.begin; i < range.end; i += kLanes) {
    const size_t valid = std::min(kLanes, range.end - i);
    const Point8 at = {LoadFirst(&receivers.x[i], valid), LoadFirst(&receivers.y[i], valid),
                       LoadFirst(&receivers.z[i], valid)};
    Seen seen = LookAt(lamp, at);
    for (size_t ball = 0; ball < hiding.count; ++ball) {
      Hide(lamp, at, hiding.balls[ball], seen);
    }
    if (lamp.walls != nullptr) {
      HideByWalls(lamp, at, valid, seen);
    }
    Lanes basis[Count];
    EvaluateShBasis<Count>(seen.direction.x, seen.direction.y, seen.direction.z,
                           normalisation.data(), basis);
    Lanes log = {};
    for (int k = 0; k < Count; ++k) {
      log = MultiplyAdd(Load(own_log.row(k) + i), basis[k], log);
    }
    // Ratio of a disc's flux to the irradiance that it gives.
    const Lanes flux = Exp(Min(log, Broadcast(1.0f))) * seen.share /
                       (seen.distance * seen.distance * (1.0f - seen.half_sine2));
    for (int l = 0; l <= kDegree; ++l) {
      const Lanes mean = CapMean(l, seen.half_sine2) * flux;
      for (int k = l * l; k < (l + 1) * (l + 1); ++k) {
        const Lanes shape = mean * basis[k];
        for (int channel = 0; channel < 3; ++channel) {
          float* row = radiance[static_cast<size_t>(channel)].row(k) + i;
          Store(MultiplyAdd(Broadcast(lamp.intensity[channel]), shape, Load(row)), row);
        }
      }
    }
  }
}

// Hashes an integer (Steele et al., "Fast Splittable Pseudorandom Number Generators", OOPSLA 2014)
// to -1..1.
float ValueAt(uint64_t seed, int64_t index) {
  uint64_t bits = seed + 0x9e3779b97f4a7c15u * static_cast<uint64_t>(index);
  bits = (bits ^ bits >> 30) * 0xbf58476d1ce4e5b9u;
  bits = (bits ^ bits >> 27) * 0x94d049bb133111ebu;
  bits ^= bits >> 31;
  return static_cast<float>(bits >> 40) * (2.0f / 16777216.0f) - 1.0f;
}

// Smooth noise with a random value at each integer.
float Noise(uint64_t seed, double t) {
  const double whole = std::floor(t);
  const auto part = static_cast<float>(t - whole);
  const auto index = static_cast<int64_t>(whole);
  return std::lerp(ValueAt(seed, index), ValueAt(seed, index + 1),
                   part * part * (3.0f - 2.0f * part));
}

}  // namespace

Sun SeenFrom(const Lamp& lamp, const glm::vec3& point) {
  const glm::vec3 to = lamp.position - point;
  const float length = glm::length(to);
  const float distance = std::max(length, kNearestLamp * lamp.radius + 1e-4f);
  return {length > 1e-6f ? to / length : glm::vec3(0.0f, 1.0f, 0.0f),
          lamp.intensity / (distance * distance), std::asin(lamp.radius / distance)};
}

float ReachOf(const Lamp& lamp, float irradiance) {
  const float most = std::max({lamp.intensity.r, lamp.intensity.g, lamp.intensity.b});
  return std::sqrt(std::max(most, 0.0f) / std::max(irradiance, 1e-6f));
}

void AddLamps(std::span<const Lamp> lamps,
              const Points& receivers,
              const ShRows& own_log,
              const Spheres& blockers,
              ReceiverRange range,
              ShRowsRgb& radiance) {
  CheckRegisters(range, own_log);
  if (lamps.empty()) {
    return;
  }
  const Bounds bounds = BoundsOf(receivers, range);
  Hiding hiding;
  for (const Lamp& lamp : lamps) {
    FindHiding(lamp, bounds, blockers, hiding);
    switch (own_log.count()) {
      case 9:
        AddLamp<9>(lamp, receivers, own_log, hiding, range, radiance);
        break;
      case 16:
        AddLamp<16>(lamp, receivers, own_log, hiding, range, radiance);
        break;
      default:
        CHECK(own_log.count() == 25);
        AddLamp<25>(lamp, receivers, own_log, hiding, range, radiance);
    }
  }
}

float Flicker(uint64_t seed, double time, float amount) {
  const float slow = Noise(seed, 2.3 * time);
  const float quick = Noise(seed ^ 0x51ed2701u, 5.1 * time);
  const float quickest = Noise(seed ^ 0xa3b19535u, 11.0 * time);
  return std::max(1.0f + amount * (0.5f * slow + 0.3f * quick + 0.2f * quickest), 0.0f);
}

glm::vec3 ColourOfTemperature(double kelvin) {
  const double t = 1000.0 / std::clamp(kelvin, 1667.0, 25000.0);
  const bool warm = t >= 0.25;
  const double x = warm ? ((-0.2661239 * t - 0.2343589) * t + 0.8776956) * t + 0.179910
                        : ((-3.0258469 * t + 2.1070379) * t + 0.2226347) * t + 0.240390;
  double y = ((3.0817580 * x - 5.87338670) * x + 3.75112997) * x - 0.37001483;
  if (t >= 1.0 / 2.222) {
    y = ((-1.1063814 * x - 1.34811020) * x + 2.18555832) * x - 0.20219683;
  } else if (warm) {
    y = ((-0.9549476 * x - 1.37418593) * x + 2.09137015) * x - 0.16748867;
  }
  // XYZ of luminance 1 to linear sRGB (IEC 61966-2-1).
  const double big_x = x / y;
  const double big_z = (1.0 - x - y) / y;
  const glm::dvec3 rgb(3.2406 * big_x - 1.5372 - 0.4986 * big_z,
                       -0.9689 * big_x + 1.8758 + 0.0415 * big_z,
                       0.0557 * big_x - 0.2040 + 1.0570 * big_z);
  const glm::dvec3 shown = glm::max(rgb, 0.0);
  return glm::vec3(shown / glm::dot(shown, glm::dvec3(0.2126, 0.7152, 0.0722)));
}

}  // namespace lararium::light
