#include "editor/import/wardrobe/posed_body.h"

#include <algorithm>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include "shared/core/check.h"

namespace lararium::import {
namespace {

std::vector<Triangle> SurfaceOf(const FittedBody& body) {
  const BaseGroup* group = body.base.FindGroup("body");
  CHECK(group != nullptr);
  std::vector<Triangle> triangles;
  for (const auto& [a, b, c, d] : group->quads) {
    triangles.push_back({a, b, c});
    if (d != c) {
      triangles.push_back({a, c, d});
    }
  }
  return triangles;
}

// True for joints at or below any of the named ones.
std::vector<bool> Below(const human::Skeleton& skeleton,
                        std::initializer_list<std::string_view> names) {
  std::vector<bool> below(skeleton.size(), false);
  for (size_t j = 0; j < skeleton.size(); ++j) {
    const bool named = std::find(names.begin(), names.end(), skeleton.names[j]) != names.end();
    below[j] = named || (skeleton.parents[j] >= 0 && below[size_t(skeleton.parents[j])]);
  }
  return below;
}

std::vector<float> ShareOf(const FittedBody& body, const std::vector<bool>& joints) {
  std::vector<float> share(body.base.positions.size(), 0.0f);
  for (size_t v = 0; v < share.size(); ++v) {
    for (int k = 0; k < 4; ++k) {
      share[v] += joints[body.base.joints[v][k]] ? body.base.weights[v][k] : 0.0f;
    }
  }
  return share;
}

glm::quat Between(const glm::vec3& from, const glm::vec3& to) {
  const glm::vec3 axis = glm::cross(from, to);
  const float w = 1.0f + glm::dot(from, to);
  return glm::normalize(glm::quat(w, axis.x, axis.y, axis.z));
}

}  // namespace

size_t JointNumber(const FittedBody& body, std::string_view joint) {
  const std::optional<size_t> found = body.skeleton.Find(joint);
  CHECK(found.has_value());
  return *found;
}

PosedBody PoseBody(const FittedBody& body, std::span<const JointTurn> turns) {
  std::vector<human::JointTransform> pose = body.skeleton.rest;
  for (const auto& [name, turn] : turns) {
    human::JointTransform& joint = pose[JointNumber(body, name)];
    joint.rotation = turn * joint.rotation;
  }
  PosedBody posed;
  std::vector<glm::mat4> actor_from_joint(body.skeleton.size());
  posed.skin.resize(body.skeleton.size());
  human::ComputeActorFromJoint(body.skeleton, pose, actor_from_joint);
  human::ComputeSkinMatrices(body.skeleton, actor_from_joint, posed.skin);
  posed.positions.resize(body.base.positions.size());
  for (size_t v = 0; v < posed.positions.size(); ++v) {
    glm::vec3 sum(0.0f);
    for (int k = 0; k < 4; ++k) {
      const float weight = body.base.weights[v][k];
      if (weight > 0.0f) {
        sum += weight * glm::vec3(posed.skin[body.base.joints[v][k]] *
                                  glm::vec4(body.base.positions[v], 1.0f));
      }
    }
    posed.positions[v] = sum;
  }
  posed.triangles = SurfaceOf(body);
  posed.normals = Normals(posed.positions, posed.triangles);
  for (const float share : ShareOf(body, Below(body.skeleton, {"l_elbow", "r_elbow"}))) {
    posed.forearm.push_back(share > 0.5f);
  }
  return posed;
}

glm::vec3 JointPlace(const FittedBody& body, const PosedBody& posed, std::string_view joint) {
  const size_t j = JointNumber(body, joint);
  const glm::vec4 bound = glm::inverse(body.skeleton.joint_from_actor[j])[3];
  return glm::vec3(posed.skin[j] * bound);
}

std::vector<JointTurn> ArmsLowered(const FittedBody& body, float angle, float share) {
  const auto place = [&body](std::string_view joint) {
    return glm::vec3(glm::inverse(body.skeleton.joint_from_actor[JointNumber(body, joint)])[3]);
  };
  std::vector<JointTurn> turns;
  const glm::quat none(1.0f, 0.0f, 0.0f, 0.0f);
  for (const bool right : {false, true}) {
    const glm::vec3 shoulder = place(right ? "r_shoulder" : "l_shoulder");
    const glm::vec3 elbow = place(right ? "r_elbow" : "l_elbow");
    const glm::vec3 wrist = place(right ? "r_wrist" : "l_wrist");
    const float side = right ? 1.0f : -1.0f;
    const glm::vec3 hanging(side * std::sin(angle), -std::cos(angle), 0.02f);
    const glm::quat turn = Between(glm::normalize(elbow - shoulder), glm::normalize(hanging));
    // The forearm hangs slightly in front of the upper arm and no further outwards.
    const glm::vec3 forearm = turn * glm::normalize(wrist - elbow);
    const glm::vec3 wanted(side * std::sin(0.5f * angle), -1.0f, -0.22f);
    const glm::quat bend = Between(forearm, glm::normalize(wanted));
    turns.emplace_back(right ? "r_shoulder" : "l_shoulder", glm::slerp(none, turn, share));
    // In the frame of the rotated upper arm.
    const glm::quat local = glm::inverse(turn) * bend * turn;
    turns.emplace_back(right ? "r_elbow" : "l_elbow", glm::slerp(none, local, share));
  }
  return turns;
}

BodyField FieldOf(const PosedBody& posed,
                  float cell,
                  float band,
                  bool forearms,
                  std::span<const Sheet* const> worn) {
  std::vector<glm::vec3> extent;
  std::vector<Triangle> triangles;
  for (const Triangle& t : posed.triangles) {
    if (forearms || !posed.forearm[t[0]]) {
      triangles.push_back(t);
      extent.push_back(posed.positions[t[0]]);
    }
  }
  for (const Sheet* sheet : worn) {
    extent.insert(extent.end(), sheet->positions.begin(), sheet->positions.end());
  }
  BodyField field(extent, cell, band);
  field.Add(posed.positions, triangles);
  for (const Sheet* sheet : worn) {
    field.Add(sheet->positions, sheet->ParticleTriangles());
  }
  field.Finish();
  return field;
}

// Uses the support function: along each direction, the ray is limited by the half planes that
// contain all points.
std::vector<float> HullRadius(std::span<const glm::vec2> points, glm::vec2 middle, int count) {
  std::vector<float> support(static_cast<size_t>(count), 0.0f);
  std::vector<glm::vec2> directions;
  for (int k = 0; k < count; ++k) {
    const float angle = glm::two_pi<float>() * static_cast<float>(k) / static_cast<float>(count);
    directions.emplace_back(std::sin(angle), std::cos(angle));
    for (const glm::vec2& p : points) {
      support[k] = std::max(support[k], glm::dot(p - middle, directions[k]));
    }
  }
  std::vector<float> radius(static_cast<size_t>(count), 1e9f);
  for (int k = 0; k < count; ++k) {
    for (int m = 0; m < count; ++m) {
      const float cosine = glm::dot(directions[k], directions[m]);
      if (cosine > 0.2f) {
        radius[k] = std::min(radius[k], support[m] / cosine);
      }
    }
  }
  return radius;
}

ArmWalls::ArmWalls(const PosedBody& posed) {
  constexpr float kFree = 1e9f;
  constexpr float kGap = 0.012f;
  std::vector<float> nearest;
  for (size_t v = 0; v < posed.positions.size(); ++v) {
    const glm::vec3& p = posed.positions[v];
    const size_t bin = static_cast<size_t>(std::max(0.0f, p.y) / kBin);
    nearest.resize(std::max(nearest.size(), bin + 2), kFree);
    if (posed.forearm[v]) {
      nearest[bin] = std::min(nearest[bin], std::abs(p.x) - kGap);
    }
  }
  side_ = nearest;
  for (size_t b = 0; b < nearest.size(); ++b) {
    for (size_t other = b > 0 ? b - 1 : b; other <= std::min(b + 1, nearest.size() - 1); ++other) {
      side_[b] = std::min(side_[b], nearest[other]);
    }
  }
}

void ArmWalls::Keep(glm::vec3& place) const {
  const size_t bin = static_cast<size_t>(std::max(0.0f, place.y) / kBin);
  if (bin < side_.size()) {
    // Moves only a part of the distance, because several layers would otherwise end in one
    // plane.
    place.x += 0.1f * (std::clamp(place.x, -side_[bin], side_[bin]) - place.x);
  }
}

glm::mat4 Blend(std::span<const glm::mat4> skin, std::span<const float> weights) {
  glm::mat4 sum(0.0f);
  for (size_t j = 0; j < weights.size(); ++j) {
    if (weights[j] > 0.0f) {
      sum += weights[j] * skin[j];
    }
  }
  return sum;
}

std::vector<bool> ArmJoints(const FittedBody& body) {
  return Below(body.skeleton, {"l_shoulder", "r_shoulder"});
}

std::vector<float> ArmShare(const FittedBody& body) { return ShareOf(body, ArmJoints(body)); }

std::vector<float> HeadShare(const FittedBody& body) {
  return ShareOf(body, Below(body.skeleton, {"vc7"}));
}

std::vector<bool> LimbOf(const FittedBody& body, std::string_view joint) {
  std::vector<bool> limb = IsBody(body);
  const std::vector<float> share = ShareOf(body, Below(body.skeleton, {joint}));
  for (size_t v = 0; v < limb.size(); ++v) {
    limb[v] = limb[v] && share[v] > 0.5f;
  }
  return limb;
}

std::vector<bool> IsBody(const FittedBody& body) {
  std::vector<bool> is_body(body.base.positions.size(), false);
  for (const Triangle& t : SurfaceOf(body)) {
    for (const uint32_t v : t) {
      is_body[v] = true;
    }
  }
  return is_body;
}

Girth::Girth(const FittedBody& body, const PosedBody& posed, float height, float half_slab) {
  const std::vector<float> arm = ArmShare(body);
  const std::vector<bool> is_body = IsBody(body);
  std::vector<glm::vec2> points;
  glm::vec2 low(1e9f);
  glm::vec2 high(-1e9f);
  for (size_t v = 0; v < posed.positions.size(); ++v) {
    const glm::vec3& p = posed.positions[v];
    if (is_body[v] && arm[v] < 0.3f && std::abs(p.y - height) < half_slab) {
      points.emplace_back(p.x, p.z);
      low = glm::min(low, points.back());
      high = glm::max(high, points.back());
    }
  }
  middle_ = glm::vec3(0.5f * (low.x + high.x), height, 0.5f * (low.y + high.y));
  radius_ = HullRadius(points, {middle_.x, middle_.z}, kAngles);
}

float Girth::Radius(float angle) const {
  float turn = angle / glm::two_pi<float>();
  turn = (turn - std::floor(turn)) * kAngles;
  const int k = static_cast<int>(turn) % kAngles;
  const float f = turn - std::floor(turn);
  return (1.0f - f) * radius_[k] + f * radius_[(k + 1) % kAngles];
}

glm::vec3 Girth::Place(float angle, float beyond, float height) const {
  const float r = Radius(angle) + beyond;
  return {middle_.x + r * std::sin(angle), height, middle_.z + r * std::cos(angle)};
}

float Girth::AngleOf(const glm::vec3& place) const {
  return std::atan2(place.x - middle_.x, place.z - middle_.z);
}

float Girth::AngleAt(float share) const {
  const float wanted = (share - std::floor(share)) * Length();
  const float step = glm::two_pi<float>() / kAngles;
  float passed = 0.0f;
  for (int k = 0; k < kAngles; ++k) {
    const float length =
        glm::distance(Place(k * step, 0.0f, 0.0f), Place((k + 1) * step, 0.0f, 0.0f));
    if (passed + length >= wanted) {
      return step * (static_cast<float>(k) + (wanted - passed) / length);
    }
    passed += length;
  }
  return glm::two_pi<float>();
}

float Girth::Length() const {
  float length = 0.0f;
  for (int k = 0; k < kAngles; ++k) {
    const float step = glm::two_pi<float>() / kAngles;
    length += glm::distance(Place(k * step, 0.0f, 0.0f), Place((k + 1) * step, 0.0f, 0.0f));
  }
  return length;
}

}  // namespace lararium::import
