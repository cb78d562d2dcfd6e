#include "editor/import/wardrobe/skin_weights.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "shared/core/parallel.h"

namespace lararium::import {
namespace {

constexpr float kStill = 0.4f;  // Share of the pelvis in the weights of a skirt.
constexpr float kBlur = 0.02f;  // Metres beyond the nearest source.

// A vertex of the body from which cloth takes weights.
struct Source {
  glm::vec3 position;
  glm::vec3 normal;
  uint32_t vertex = 0;
};

// `x` is the position in the bind pose, positive to the right of the person.
bool HasPart(WeightSource source, float arm, bool forearm, float x) {
  switch (source) {
    case WeightSource::kArms:
      return arm > 0.4f;
    case WeightSource::kLegs:
    case WeightSource::kTrunk:
    case WeightSource::kArmless:
      return arm < 0.2f;
    case WeightSource::kMantle:
      return arm < 0.2f || (x < 0.0f && !forearm);
    default:
      return true;
  }
}

std::vector<Source> BodySources(const FittedBody& body,
                                const PosedBody& posed,
                                WeightSource source) {
  const std::vector<bool> is_body = IsBody(body);
  const float highest = JointPlace(body, posed, "skullbase").y;
  const std::vector<float> arm = ArmShare(body);
  std::vector<Source> sources;
  for (uint32_t v = 0; v < posed.positions.size(); ++v) {
    if (is_body[v] && posed.positions[v].y < highest &&
        HasPart(source, arm[v], posed.forearm[v], body.base.positions[v].x)) {
      sources.push_back({posed.positions[v], posed.normals[v], v});
    }
  }
  return sources;
}

std::vector<Source> SkirtSources(const FittedBody& body, const PosedBody& posed) {
  std::vector<Source> sources;
  if (const BaseGroup* group = body.base.FindGroup("helper-skirt"); group != nullptr) {
    for (const auto& quad : group->quads) {
      for (const uint32_t v : quad) {
        sources.push_back({posed.positions[v], glm::vec3(0.0f), v});
      }
    }
  }
  return sources;
}

// Adds the weights of the sources near `place`. Returns the distance of the nearest. A place that
// faces no source takes from all.
float AddFrom(const FittedBody& body,
              const std::vector<Source>& sources,
              const glm::vec3& place,
              bool own_side,
              float share,
              std::span<float> weights) {
  bool facing = true;
  const auto counts = [&](const Source& s) {
    return (!facing || glm::dot(s.normal, place - s.position) >= 0.0f) &&
           (!own_side || (s.position.x < 0.0f) == (place.x < 0.0f));
  };
  facing = std::any_of(sources.begin(), sources.end(), counts);
  float nearest = 1e9f;
  for (const Source& s : sources) {
    if (counts(s)) {
      nearest = std::min(nearest, glm::distance(s.position, place));
    }
  }
  float sum = 0.0f;
  std::vector<std::pair<uint32_t, float>> near;
  for (const Source& s : sources) {
    const float beyond = glm::distance(s.position, place) - nearest;
    if (beyond < 2.5f * kBlur && counts(s)) {
      near.emplace_back(s.vertex, std::exp(-0.5f * beyond * beyond / (kBlur * kBlur)));
      sum += near.back().second;
    }
  }
  for (const auto& [v, weight] : near) {
    for (int k = 0; k < 4; ++k) {
      weights[body.base.joints[v][k]] += share * weight / sum * body.base.weights[v][k];
    }
  }
  return nearest;
}

}  // namespace

std::vector<float> TakeWeights(const FittedBody& body,
                               const PosedBody& posed,
                               WeightSource source,
                               Sheet& sheet) {
  std::vector<float> distances(sheet.positions.size(), 0.0f);
  sheet.joint_count = body.skeleton.size();
  sheet.weights.assign(sheet.positions.size() * sheet.joint_count, 0.0f);
  const std::vector<Source> sources = BodySources(body, posed, source);
  const std::vector<Source> skirt = SkirtSources(body, posed);
  const size_t pelvis = JointNumber(body, "sacroiliac");
  const float hips = JointPlace(body, posed, "l_hip").y;
  const float knees = JointPlace(body, posed, "l_knee").y;
  ParallelFor(sheet.positions.size(), [&](size_t p) {
    const glm::vec3& place = sheet.positions[p];
    const float top = hips + 0.1f * (hips - knees);
    const float bottom = hips - 0.2f * (hips - knees);
    const bool skirted = source == WeightSource::kSkirted || source == WeightSource::kMantle ||
                         source == WeightSource::kArmless;
    float below = skirted ? std::clamp((top - place.y) / (top - bottom), 0.0f, 1.0f) : 0.0f;
    below = skirt.empty() ? 0.0f : below;
    if (below < 1.0f) {
      distances[p] = AddFrom(body, sources, place, source == WeightSource::kLegs, 1.0f - below,
                             sheet.WeightsOf(p));
    }
    if (below > 0.0f) {
      AddFrom(body, skirt, place, false, (1.0f - kStill) * below, sheet.WeightsOf(p));
      sheet.WeightsOf(p)[pelvis] += kStill * below;
      distances[p] = std::max(distances[p], 0.1f * below);
    }
  });
  return distances;
}

void SmoothWeights(Sheet& sheet, int rounds, std::span<const float> distances) {
  const auto neighbours = NeighboursOf(sheet.positions.size(), sheet.ParticleTriangles());
  for (int round = 0; round < rounds; ++round) {
    const std::vector<float> before = sheet.weights;
    for (size_t p = 0; p < neighbours.size(); ++p) {
      if (neighbours[p].empty()) {
        continue;
      }
      const float looseness = std::clamp((distances[p] - 0.012f) / 0.05f, 0.05f, 1.0f);
      const float own = 1.0f - 0.5f * looseness;
      const float share = (1.0f - own) / static_cast<float>(neighbours[p].size());
      for (size_t j = 0; j < sheet.joint_count; ++j) {
        float sum = own * before[p * sheet.joint_count + j];
        for (const uint32_t q : neighbours[p]) {
          sum += share * before[q * sheet.joint_count + j];
        }
        sheet.weights[p * sheet.joint_count + j] = sum;
      }
    }
  }
}

std::vector<glm::vec3> Carried(const Sheet& sheet,
                               std::span<const glm::mat4> from,
                               std::span<const glm::mat4> to) {
  std::vector<glm::vec3> result;
  result.reserve(sheet.positions.size());
  for (size_t p = 0; p < sheet.positions.size(); ++p) {
    const glm::mat4 to_from =
        Blend(to, sheet.WeightsOf(p)) * glm::inverse(Blend(from, sheet.WeightsOf(p)));
    result.emplace_back(to_from * glm::vec4(sheet.positions[p], 1.0f));
  }
  return result;
}

}  // namespace lararium::import
