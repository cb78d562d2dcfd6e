#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "shared/core/random.h"
#include "shared/human/cloth_data.h"
#include "shared/human/finite.h"

namespace lararium::human {
namespace {

// Drag coefficients of a plate across and along the flow.
constexpr float kNormalDrag = 1.3f;
constexpr float kTangentDrag = 0.05f;
constexpr float kStrongestWind = 40.0f;  // m/s, a gale
constexpr int kGusts = 4;
constexpr float kSlowestGust = 0.2f;  // 1/s; each further wave is faster by kGustRatio
constexpr float kGustRatio = 2.3f;

// Waves of air that travel with the mean wind. They are cheap, endless and allow seeking.
struct Gusts {
  float frequency[kGusts] = {};  // radians/s
  float phase[kGusts] = {};
  glm::vec3 direction[kGusts] = {};
};

Gusts MakeGusts(const Wind& wind) {
  Random random(wind.seed);
  Gusts gusts;
  float frequency = kSlowestGust;
  for (int k = 0; k < kGusts; ++k, frequency *= kGustRatio) {
    gusts.frequency[k] = 2.0f * std::numbers::pi_v<float> * frequency *
                         static_cast<float>(random.Uniform(0.8, 1.25));
    gusts.phase[k] = static_cast<float>(random.Uniform(0.0, 2.0 * std::numbers::pi));
    gusts.direction[k] = {static_cast<float>(random.Normal()) * 0.4f,
                          static_cast<float>(random.Normal()) * 0.2f,
                          static_cast<float>(random.Normal()) * 0.4f};
  }
  return gusts;
}

// Returns the wind as a sum of waves of equal power; the RMS of the gusts is `gust`.
glm::vec3 WindAt(const Wind& wind, const Gusts& gusts, float time, const glm::vec3& place) {
  const float speed = glm::length(wind.velocity);
  if (speed < 1e-3f) {
    return wind.velocity;
  }
  const glm::vec3 ahead = wind.velocity / speed;
  const float travelled = glm::dot(ahead, place) / speed;
  const float share = std::isfinite(wind.gust) ? std::clamp(wind.gust, 0.0f, 4.0f) : 0.0f;
  const float amplitude = share * speed * std::sqrt(2.0f / kGusts);
  glm::vec3 velocity = wind.velocity;
  for (int k = 0; k < kGusts; ++k) {
    const float wave = std::sin(gusts.frequency[k] * (time - travelled) + gusts.phase[k]);
    velocity += amplitude * wave * (ahead + gusts.direction[k]);
  }
  return velocity;
}

}  // namespace

void SetAir(const ClothModel::Data& model, const Wind& wind, ClothState::Data& state) {
  std::fill(state.accelerations.begin(), state.accelerations.end(), Float4());
  const float half_density = 0.5f * model.settings.air_density;
  if (half_density <= 0.0f) {
    return;
  }
  Wind local = wind;
  local.velocity = Finite(wind.velocity) ? wind.velocity / state.scale : glm::vec3(0.0f);
  const float speed = glm::length(local.velocity);
  local.velocity *= speed > kStrongestWind ? kStrongestWind / speed : 1.0f;
  const auto time = static_cast<float>(double(state.beats) * double(kBeat));
  // One gust value serves the whole person, because gusts are larger than a person.
  const Float4 air(WindAt(local, MakeGusts(local), time,
                          state.next.place + state.origin_in_stage / state.scale));
  for (size_t t = 0; t < model.triangles.size(); ++t) {
    const std::array<uint32_t, 3>& corner = model.triangles[t];
    const Float4 origin = state.positions[corner[0]];
    const Float4 normal = Cross(state.positions[corner[1]] - origin,
                                state.positions[corner[2]] - origin);  // length: twice the area
    const Float4 velocity =
        (state.velocities[corner[0]] + state.velocities[corner[1]] + state.velocities[corner[2]]) *
        (1.0f / 3.0f);
    const Float4 flow = air - velocity;
    const float square = Dot(normal, normal) + 1e-20f;
    const float speed = Length(flow);
    const Float4 across = normal * (Dot(flow, normal) / square);
    const Float4 drag = across * kNormalDrag + (flow - across) * kTangentDrag;
    // The impulse until the next evaluation must not reverse the flow.
    const float rate = half_density * speed * kNormalDrag / model.triangle_density[t];
    const float area = 0.5f * std::sqrt(square);
    const Float4 force = drag * (half_density * speed * area /
                                 std::max(2.0f * rate * kBeatsBetweenAir * kBeat, 1.0f));
    for (const uint32_t i : corner) {
      state.accelerations[i] += force * (model.inverse_mass[i] * (1.0f / 3.0f));
    }
  }
}

}  // namespace lararium::human
