#include "editor/import/wardrobe/sandals.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include "editor/import/wardrobe/skin_weights.h"

namespace lararium::import {
namespace {

constexpr int kStrapColumns = 40;
constexpr uint8_t kSole = 0;
constexpr uint8_t kStrap = 1;

// One foot in the bind pose, with its own axes: ahead, to the outer side, up.
class Foot {
 public:
  Foot(const FittedBody& body, const PosedBody& bound, bool right) {
    const size_t ankle = JointNumber(body, right ? "r_ankle" : "l_ankle");
    const size_t toes = JointNumber(body, right ? "r_midtarsal" : "l_midtarsal");
    const size_t knee = JointNumber(body, right ? "r_knee" : "l_knee");
    const std::vector<bool> is_body = IsBody(body);
    ankle_ = JointPlace(body, bound, body.skeleton.names[ankle]);
    for (size_t v = 0; v < bound.positions.size(); ++v) {
      float share = 0.0f;
      for (int k = 0; k < 4; ++k) {
        const size_t joint = body.base.joints[v][k];
        share += joint == ankle || joint == toes ||
                         (joint == knee && bound.positions[v].y < ankle_.y + 0.12f)
                     ? body.base.weights[v][k]
                     : 0.0f;
      }
      if (is_body[v] && share > 0.5f) {
        points_.push_back(bound.positions[v]);
      }
    }
    const glm::vec3 tip = JointPlace(body, bound, body.skeleton.names[toes]);
    ahead_ = glm::normalize(glm::vec3(tip.x - ankle_.x, 0.0f, tip.z - ankle_.z));
    side_ = glm::cross(ahead_, glm::vec3(0.0f, 1.0f, 0.0f));
    for (const glm::vec3& p : points_) {
      const float along = glm::dot(p - ankle_, ahead_);
      heel_ = std::min(heel_, along);
      toe_ = std::max(toe_, along);
    }
  }

  float length() const { return toe_ - heel_; }
  glm::vec3 ankle() const { return ankle_; }
  glm::vec3 ahead() const { return ahead_; }
  glm::vec3 side() const { return side_; }
  // The point on the floor at this share of the length from the heel, on the middle line.
  glm::vec3 Along(float share) const {
    glm::vec3 p = ankle_ + ahead_ * (heel_ + share * length());
    p.y = 0.0f;
    return p;
  }

  // The outline of the foot on the floor about a middle, from its low points.
  std::vector<float> Footprint(const glm::vec3& middle) const {
    std::vector<glm::vec2> flat;
    for (const glm::vec3& p : points_) {
      if (p.y < 0.035f) {
        flat.emplace_back(glm::dot(p - middle, side_), glm::dot(p - middle, ahead_));
      }
    }
    return HullRadius(flat, glm::vec2(0.0f), kStrapColumns);
  }

  // The outline of the section by a plane through `middle` that u and v span.
  std::vector<float> Section(const glm::vec3& middle,
                             const glm::vec3& u,
                             const glm::vec3& v,
                             float half_slab) const {
    const glm::vec3 normal = glm::cross(u, v);
    std::vector<glm::vec2> flat;
    for (const glm::vec3& p : points_) {
      if (std::abs(glm::dot(p - middle, normal)) < half_slab) {
        flat.emplace_back(glm::dot(p - middle, u), glm::dot(p - middle, v));
      }
    }
    return HullRadius(flat, glm::vec2(0.0f), kStrapColumns);
  }

  // Height of the instep at this share of the length, beside the middle line.
  float Instep(float share, float aside) const {
    const glm::vec3 at = Along(share);
    float height = 0.0f;
    for (const glm::vec3& p : points_) {
      const glm::vec3 d = p - at;
      if (std::abs(glm::dot(d, ahead_)) < 0.012f && std::abs(glm::dot(d, side_) - aside) < 0.012f) {
        height = std::max(height, p.y);
      }
    }
    return height;
  }

 private:
  std::vector<glm::vec3> points_;
  glm::vec3 ankle_ = glm::vec3(0.0f);
  glm::vec3 ahead_ = glm::vec3(0.0f, 0.0f, -1.0f);
  glm::vec3 side_ = glm::vec3(1.0f, 0.0f, 0.0f);
  float heel_ = 1e9f;
  float toe_ = -1e9f;
};

glm::vec2 Direction(int k) {
  const float angle = glm::two_pi<float>() * static_cast<float>(k % kStrapColumns) / kStrapColumns;
  return {std::sin(angle), std::cos(angle)};
}

// Adds the sole slightly below the floor, because the foot stands on it at floor level.
void AddSole(const Foot& foot, Sheet& sheet) {
  const glm::vec3 middle = foot.Along(0.5f);
  const std::vector<float> outline = foot.Footprint(middle);
  struct Ring {
    float beyond;
    float height;
  };
  constexpr Ring kRings[] = {{-1.0f, 0.004f},   {0.002f, 0.004f},  {0.005f, 0.002f},
                             {0.005f, -0.007f}, {0.002f, -0.009f}, {-1.0f, -0.009f}};
  GridPanel grid;
  grid.columns = kStrapColumns + 1;
  grid.rows = std::size(kRings);
  grid.mirrored = true;
  grid.flat = [&](size_t column, size_t row) {
    return glm::vec2(0.015f * float(column), 0.01f * float(row));
  };
  grid.place = [&](size_t column, size_t row) {
    const Ring& ring = kRings[row];
    const int k = static_cast<int>(column) % kStrapColumns;
    const float radius = ring.beyond < -0.5f ? 0.0f : outline[k] + ring.beyond;
    const glm::vec2 d = radius * Direction(k);
    return middle + foot.side() * d.x + foot.ahead() * d.y + glm::vec3(0.0f, ring.height, 0.0f);
  };
  AddPanel(sheet, grid, kSole);
}

// A band around the foot in a plane, with half of its width to either side.
void AddBand(const Foot& foot,
             const glm::vec3& middle,
             const glm::vec3& u,
             const glm::vec3& v,
             float half,
             Sheet& sheet) {
  const glm::vec3 normal = glm::cross(u, v);
  std::vector<std::vector<float>> sections;
  for (const float off : {-half, 0.0f, half}) {
    sections.push_back(foot.Section(middle + off * normal, u, v, 0.012f));
  }
  constexpr float kRise[] = {0.0005f, 0.0035f, 0.0035f, 0.0035f, 0.0005f};
  constexpr float kOff[] = {-1.0f, -0.8f, 0.0f, 0.8f, 1.0f};
  GridPanel grid;
  grid.columns = kStrapColumns + 1;
  grid.rows = 5;
  grid.flat = [&](size_t column, size_t row) {
    return glm::vec2(0.01f * float(column), half * (kOff[row] + 1.0f));
  };
  grid.place = [&](size_t column, size_t row) {
    const int k = static_cast<int>(column) % kStrapColumns;
    const std::vector<float>& section = sections[row < 2 ? 0 : row == 2 ? 1 : 2];
    const glm::vec2 d = (section[k] + 0.001f + kRise[row]) * Direction(k);
    glm::vec3 place = middle + u * d.x + v * d.y + normal * (half * kOff[row]);
    place.y = std::max(place.y, -0.004f);
    return place;
  };
  AddPanel(sheet, grid, kStrap);
}

// A strap along the instep, from between the toes to the ankle.
void AddThong(const Foot& foot, float from, float to, float aside, Sheet& sheet) {
  GridPanel grid;
  grid.columns = 5;
  grid.rows = 12;
  grid.mirrored = true;
  constexpr float kHalf = 0.0055f;
  grid.flat = [](size_t column, size_t row) { return 0.01f * glm::vec2(column, row); };
  grid.place = [&](size_t column, size_t row) {
    const float share = glm::mix(from, to, float(row) / 11.0f);
    const float across = float(column) / 2.0f - 1.0f;
    glm::vec3 p = foot.Along(share) + foot.side() * (aside + kHalf * across);
    float height = 0.0f;
    for (const float near : {-0.03f, 0.0f, 0.03f}) {
      height += foot.Instep(share + near, aside) / 3.0f;
    }
    p.y = height + 0.001f + 0.0035f * (1.0f - across * across * across * across);
    return p;
  };
  AddPanel(sheet, grid, kStrap);
}

void AddSandal(const Foot& foot, float size, Sheet& sheet) {
  AddSole(foot, sheet);
  const glm::vec3 up(0.0f, 1.0f, 0.0f);
  const auto raised = [&](float share, float height) {
    return foot.Along(share) + glm::vec3(0.0f, height, 0.0f);
  };
  AddBand(foot, raised(0.70f, 0.02f), foot.side(), up, 0.008f * size, sheet);
  AddBand(foot, raised(0.52f, 0.03f), foot.side(), glm::normalize(up + 0.35f * foot.ahead()),
          0.007f * size, sheet);
  // One around the ankle, and one from the heel over the instep.
  const glm::vec3 ankle = foot.ankle() + glm::vec3(0.0f, 0.035f * size, 0.0f);
  AddBand(foot, ankle, foot.ahead(), foot.side(), 0.0065f * size, sheet);
  AddBand(foot, foot.ankle() - glm::vec3(0.0f, 0.012f, 0.0f), foot.side(),
          glm::normalize(foot.ahead() + 0.75f * up), 0.0065f * size, sheet);
  AddThong(foot, 0.52f, 0.80f, 0.0f, sheet);
}

}  // namespace

Result<DrapedGarment> CutSandals(const GarmentPattern& pattern, const FittedBody& body) {
  const PosedBody bound = PoseBody(body, {});
  DrapedGarment result;
  for (const bool right : {false, true}) {
    const Foot foot(body, bound, right);
    AddSandal(foot, foot.length() / 0.26f, result.sheet);
  }
  result.skin = bound.skin;
  TakeWeights(body, bound, WeightSource::kBody, result.sheet);
  result.dye = [colour = pattern.Colour(pattern.design->fabric.colour)](uint8_t panel,
                                                                        const glm::vec2&) {
    return panel == kSole ? 0.8f * colour : colour;
  };
  result.covers = false;
  return result;
}

}  // namespace lararium::import
