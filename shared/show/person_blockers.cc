#include "shared/show/person_blockers.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

namespace lararium::show {
namespace {

// Mean number of blockers in a group that one sphere may replace, and the largest sine of the angle
// between its centre and its rim at which it does.
constexpr size_t kBlockersOfGroup = 6;
constexpr float kSmall = 0.3f;

// A larger motion between frames is a jump; metres.
constexpr float kJump = 0.2f;

}  // namespace

void SphereSet::Resize(size_t count) {
  for (std::vector<float>* values : {&x, &y, &z, &radius}) {
    values->assign(count, 0.0f);
  }
}

void SphereSet::Set(size_t index, const glm::vec3& centre, float ball_radius) {
  x[index] = centre.x;
  y[index] = centre.y;
  z[index] = centre.z;
  radius[index] = ball_radius;
}

void SphereSet::Clear() {
  for (std::vector<float>* values : {&x, &y, &z, &radius}) {
    values->clear();
  }
}

void SphereSet::Add(const glm::vec3& centre, float ball_radius) {
  x.push_back(centre.x);
  y.push_back(centre.y);
  z.push_back(centre.z);
  radius.push_back(ball_radius);
}

// Joins the two nearest groups until few enough are left.
PersonBlockers::PersonBlockers(std::span<const human::LightTransfer::Blocker> blockers) {
  std::vector<std::vector<uint32_t>> groups;
  std::vector<glm::vec3> centres;
  for (uint32_t i = 0; i < blockers.size(); ++i) {
    groups.push_back({i});
    centres.push_back(blockers[i].centre);
  }
  const size_t wanted = (blockers.size() + kBlockersOfGroup - 1) / kBlockersOfGroup;
  while (groups.size() > wanted) {
    size_t first = 0, second = 1;
    float least = std::numeric_limits<float>::max();
    for (size_t i = 0; i < groups.size(); ++i) {
      for (size_t k = i + 1; k < groups.size(); ++k) {
        // Join small groups first, so that no group grows long.
        const float distance = glm::distance(centres[i], centres[k]) *
                               static_cast<float>(groups[i].size() + groups[k].size());
        if (distance < least) {
          least = distance;
          first = i;
          second = k;
        }
      }
    }
    const auto sizes = glm::vec2(groups[first].size(), groups[second].size());
    centres[first] = (sizes.x * centres[first] + sizes.y * centres[second]) / (sizes.x + sizes.y);
    groups[first].insert(groups[first].end(), groups[second].begin(), groups[second].end());
    groups.erase(groups.begin() + static_cast<ptrdiff_t>(second));
    centres.erase(centres.begin() + static_cast<ptrdiff_t>(second));
  }
  for (const std::vector<uint32_t>& group : groups) {
    groups_.push_back({.begin = blockers_.size(), .end = blockers_.size() + group.size()});
    for (const uint32_t index : group) {
      blockers_.push_back(blockers[index]);
    }
  }
  spheres_.Resize(blockers_.size());
}

bool PersonBlockers::Pose(std::span<const glm::mat4> skin, const glm::mat4& stage_from_actor) {
  bool jumped = false;
  for (size_t i = 0; i < blockers_.size(); ++i) {
    const human::LightTransfer::Blocker& blocker = blockers_[i];
    const glm::vec4 in_actor = skin[blocker.joint] * glm::vec4(blocker.centre, 1.0f);
    const glm::vec3 centre = stage_from_actor * in_actor;
    jumped = jumped || !(glm::distance(centre, spheres_.centre(i)) < kJump);
    spheres_.Set(i, centre, blocker.radius);
  }
  MergeGroups();
  return jumped;
}

// From a distance, covered shares of the sky add up; a sphere's share grows with the square of its
// radius.
void PersonBlockers::MergeGroups() {
  low_ = glm::vec3(std::numeric_limits<float>::max());
  high_ = -low_;
  for (Group& group : groups_) {
    glm::vec3 centre(0.0f);
    float share = 0.0f;
    for (size_t i = group.begin; i < group.end; ++i) {
      const float radius = spheres_.radius[i];
      centre += radius * radius * spheres_.centre(i);
      share += radius * radius;
      low_ = glm::min(low_, spheres_.centre(i) - radius);
      high_ = glm::max(high_, spheres_.centre(i) + radius);
    }
    group.centre = share > 0.0f ? centre / share : spheres_.centre(group.begin);
    group.radius = std::sqrt(share);
    group.extent = 0.0f;
    for (size_t i = group.begin; i < group.end; ++i) {
      group.extent = std::max(group.extent,
                              glm::distance(group.centre, spheres_.centre(i)) + spheres_.radius[i]);
    }
  }
}

void PersonBlockers::AppendTo(SphereSet& to, const PersonBlockers& seen_from) const {
  for (const Group& group : groups_) {
    const glm::vec3 nearest = glm::clamp(group.centre, seen_from.low_, seen_from.high_);
    if (group.extent < kSmall * glm::distance(nearest, group.centre)) {
      to.Add(group.centre, group.radius);
      continue;
    }
    for (size_t i = group.begin; i < group.end; ++i) {
      to.Add(spheres_.centre(i), spheres_.radius[i]);
    }
  }
}

}  // namespace lararium::show
