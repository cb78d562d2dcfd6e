#include "editor/import/wardrobe/finish.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/mat3x3.hpp>
#include <unordered_map>

#include "editor/import/cast/cast_rig.h"
#include "editor/import/wardrobe/weave.h"
#include "shared/core/parallel.h"

namespace lararium::import {
namespace {

// Largest angle of view from the normal in radians; it is small for cloth that rests on cloth.
constexpr float kSkinView = 0.85f;
constexpr float kClothView = 0.35f;
// Share of the margins in which skin stays for distant views, which show only skin next to an
// edge.
constexpr float kFarMargins = 0.35f;
constexpr float kBulge = 0.03f;  // metres
// Margins from every edge beyond which a point is deep below a garment.
constexpr float kDeep = 2.0f;

constexpr float kFoldShade = 0.4f;   // Darkening at the bottom of a deep fold.
constexpr float kDeepFold = 0.025f;  // metres below the cloth around it
constexpr int kShadeRounds = 14;     // Rounds of smoothing that level the folds.

// The small cubes of space that cloth passes through.
class Screen {
 public:
  static constexpr float kCell = 0.015f;

  void Add(std::span<const glm::vec3> x, std::span<const Triangle> triangles) {
    for (const auto& [a, b, c] : triangles) {
      const float longest = std::max(
          {glm::distance(x[a], x[b]), glm::distance(x[b], x[c]), glm::distance(x[c], x[a])});
      const glm::vec3 normal = glm::cross(x[b] - x[a], x[c] - x[a]);
      const int steps = static_cast<int>(longest / (0.6f * kCell)) + 1;
      for (int i = 0; i <= steps; ++i) {
        for (int j = 0; i + j <= steps; ++j) {
          const float u = static_cast<float>(i) / static_cast<float>(steps);
          const float v = static_cast<float>(j) / static_cast<float>(steps);
          cells_[Key(x[a] + u * (x[b] - x[a]) + v * (x[c] - x[a]))] += normal;
        }
      }
    }
  }

  // Rays that leave the body under a garment hit its inner side. The floor blocks too.
  bool Blocks(const glm::vec3& from, const glm::vec3& direction, float length) const {
    for (float t = 0.002f; t < length; t += 0.5f * kCell) {
      const glm::vec3 at = from + t * direction;
      const auto cell = cells_.find(Key(at));
      if (at.y < 0.01f || (cell != cells_.end() && glm::dot(cell->second, direction) > 0.0f)) {
        return true;
      }
    }
    return false;
  }

 private:
  static uint64_t Key(const glm::vec3& p) {
    const auto cell = [](float v) {
      return uint64_t(static_cast<uint32_t>(static_cast<int>(std::floor(v / kCell)) + (1 << 20)));
    };
    return cell(p.x) << 42 | cell(p.y) << 21 | cell(p.z);
  }
  std::unordered_map<uint64_t, glm::vec3> cells_;  // The value is the outward direction.
};

// Directions within a cone about a normal.
std::vector<glm::vec3> ConeAbout(const glm::vec3& normal, float widest) {
  const glm::vec3 other = std::abs(normal.x) < 0.7f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
  const glm::vec3 u = glm::normalize(glm::cross(normal, other));
  const glm::vec3 v = glm::cross(normal, u);
  std::vector<glm::vec3> directions = {normal};
  for (const float tilt : {0.5f * widest, widest}) {
    for (int k = 0; k < 6; ++k) {
      const float turn = glm::pi<float>() * (static_cast<float>(k) + 2.0f * tilt) / 3.0f;
      directions.push_back(std::cos(tilt) * normal +
                           std::sin(tilt) * (std::cos(turn) * u + std::sin(turn) * v));
    }
  }
  return directions;
}

bool IsNear(const glm::vec3& p, std::span<const glm::vec3> places, float distance) {
  return std::any_of(places.begin(), places.end(), [&](const glm::vec3& q) {
    const glm::vec3 d = p - q;
    return glm::dot(d, d) < distance * distance;
  });
}

// Points along the openings and hems of a garment, separately where it is fixed and where it
// swings.
struct Rims {
  std::vector<glm::vec3> fixed;
  std::vector<glm::vec3> loose;
};

Rims RimsOf(const DrapedGarment& draped) {
  Rims rims;
  for (const auto& [a, b] : OpenEdges(draped.sheet.ParticleTriangles())) {
    const bool swings = !draped.reach.empty() && draped.reach[a] + draped.reach[b] > 0.02f;
    (swings ? rims.loose : rims.fixed)
        .push_back(0.5f * (draped.sheet.positions[a] + draped.sheet.positions[b]));
  }
  return rims;
}

// Says for each position with an outward normal whether it is invisible from outside under the
// garment, including its margins.
std::vector<bool> CoveredBy(const DrapedGarment& draped,
                            std::span<const glm::vec3> places,
                            std::span<const glm::vec3> normals,
                            float widest,
                            float fixed_margin,
                            float loose_margin) {
  Screen screen;
  screen.Add(draped.sheet.positions, draped.sheet.ParticleTriangles());
  const Rims rims = RimsOf(draped);
  std::vector<uint8_t> covered(places.size(), 0);
  ParallelFor(places.size(), [&](size_t i) {
    if (glm::dot(normals[i], normals[i]) < 0.5f) {
      return;
    }
    if (IsNear(places[i], rims.fixed, fixed_margin) ||
        IsNear(places[i], rims.loose, loose_margin)) {
      return;
    }
    // Far from all edges no view under the cloth is possible. Rays that miss cloth resting on
    // cloth pass between folds, and parts that bulge slightly through it still count as below.
    const bool deep = widest < kSkinView && !IsNear(places[i], rims.fixed, kDeep * fixed_margin) &&
                      !IsNear(places[i], rims.loose, kDeep * loose_margin);
    const std::vector<glm::vec3> directions = ConeAbout(normals[i], widest);
    const auto blocked =
        std::count_if(directions.begin(), directions.end(), [&](const glm::vec3& direction) {
          return screen.Blocks(places[i] - (deep ? kBulge : 0.0f) * direction, direction, 0.6f);
        });
    covered[i] = blocked >= ptrdiff_t(deep ? directions.size() / 2 : directions.size());
  });
  return {covered.begin(), covered.end()};
}

// The body in the pose in which a garment was draped.
struct BodyBelow {
  std::vector<glm::vec3> places;
  // Zero if the vertex does not belong to the body or has no direction.
  std::vector<glm::vec3> normals;
};

BodyBelow PoseBelow(const DrapedGarment& draped, const FittedBody& body) {
  std::vector<glm::vec3> places;
  for (size_t v = 0; v < body.base.positions.size(); ++v) {
    glm::vec3 sum(0.0f);
    for (int k = 0; k < 4; ++k) {
      sum += body.base.weights[v][k] * glm::vec3(draped.skin[body.base.joints[v][k]] *
                                                 glm::vec4(body.base.positions[v], 1.0f));
    }
    places.push_back(sum);
  }
  const PosedBody bound = PoseBody(body, {});
  std::vector<glm::vec3> normals = Normals(places, bound.triangles);
  const std::vector<bool> is_body = IsBody(body);
  for (size_t v = 0; v < normals.size(); ++v) {
    normals[v] = is_body[v] ? normals[v] : glm::vec3(0.0f);
  }
  return {std::move(places), std::move(normals)};
}

// Converts values of base vertices to values of the vertices of FittedBody::skin.
std::vector<bool> SkinOf(const FittedBody& body, const std::vector<bool>& of_base) {
  std::vector<bool> of_skin;
  for (const uint32_t base : body.base_of_skin) {
    of_skin.push_back(of_base[base]);
  }
  return of_skin;
}

void FindHiddenSkin(const DrapedGarment& draped, const FittedBody& body, Garment& garment) {
  if (!draped.covers) {
    garment.hidden.assign(body.base_of_skin.size(), false);
    garment.covered = garment.hidden;
    return;
  }
  const auto [places, normals] = PoseBelow(draped, body);
  garment.hidden = SkinOf(
      body, CoveredBy(draped, places, normals, kSkinView, draped.hide_margin, draped.loose_margin));
  garment.covered =
      SkinOf(body, CoveredBy(draped, places, normals, kClothView, kFarMargins * draped.hide_margin,
                             kFarMargins * draped.loose_margin));
}

Influences StrongestOf(std::span<const float> weights) {
  std::vector<std::pair<uint8_t, float>> influences;
  for (size_t j = 0; j < weights.size(); ++j) {
    if (weights[j] > 1e-4f) {
      influences.emplace_back(static_cast<uint8_t>(j), weights[j]);
    }
  }
  return Strongest(influences);
}

// The matrix that moves a particle with these influences from the bind pose.
glm::mat4 BlendOf(const Influences& influences, std::span<const glm::mat4> skin) {
  glm::mat4 sum(0.0f);
  for (int k = 0; k < 4; ++k) {
    sum += influences.weights[k] * skin[influences.joints[k]];
  }
  return sum;
}

// Averages each value with its neighbours `rounds` times.
template <typename Value>
void Smooth(const std::vector<std::vector<uint32_t>>& neighbours,
            int rounds,
            std::vector<Value>& values) {
  for (int round = 0; round < rounds; ++round) {
    const std::vector<Value> before = values;
    for (size_t p = 0; p < values.size(); ++p) {
      Value sum = before[p];
      for (const uint32_t q : neighbours[p]) {
        sum += before[q];
      }
      values[p] = sum / static_cast<float>(neighbours[p].size() + 1);
    }
  }
}

// Darkens cloth in proportion to its depth below its surroundings, where little light arrives.
std::vector<float> FoldShades(const Sheet& sheet) {
  const std::vector<Triangle> triangles = sheet.ParticleTriangles();
  const auto neighbours = NeighboursOf(sheet.positions.size(), triangles);
  std::vector<glm::vec3> smooth = sheet.positions;
  Smooth(neighbours, kShadeRounds, smooth);
  const std::vector<glm::vec3> normals = Normals(smooth, triangles);
  std::vector<float> shade(sheet.positions.size(), 1.0f);
  for (size_t p = 0; p < shade.size(); ++p) {
    const float depth = glm::dot(normals[p], smooth[p] - sheet.positions[p]);
    shade[p] = 1.0f - kFoldShade * std::clamp(depth / kDeepFold, -0.3f, 1.0f);
  }
  Smooth(neighbours, 1, shade);
  return shade;
}

// Appends a sheet in the bind pose.
void AddSheet(const Sheet& sheet,
              std::span<const glm::mat4> skin,
              const std::function<glm::vec3(size_t vertex)>& albedo,
              human::SkinnedMesh& mesh) {
  const uint32_t first = static_cast<uint32_t>(mesh.positions.size());
  const std::vector<glm::vec3> normals = Normals(sheet.positions, sheet.ParticleTriangles());
  std::vector<Influences> influences;
  std::vector<glm::vec3> places;
  std::vector<glm::vec3> turned;
  for (size_t p = 0; p < sheet.positions.size(); ++p) {
    influences.push_back(StrongestOf(sheet.WeightsOf(p)));
    const glm::mat4 back = glm::inverse(BlendOf(influences[p], skin));
    places.emplace_back(back * glm::vec4(sheet.positions[p], 1.0f));
    turned.push_back(glm::normalize(glm::mat3(back) * normals[p]));
  }
  for (size_t v = 0; v < sheet.flat.size(); ++v) {
    const uint32_t p = sheet.particle[v];
    mesh.positions.push_back(places[p]);
    mesh.normals.push_back(turned[p]);
    mesh.albedo.push_back(glm::clamp(albedo(v), 0.0f, 1.0f));
    mesh.uvs.push_back(sheet.flat[v] / kWeaveTile);
    mesh.joints.push_back(influences[p].joints);
    mesh.weights.push_back(influences[p].weights);
  }
  for (const Triangle& t : sheet.triangles) {
    mesh.indices.insert(mesh.indices.end(), {first + t[0], first + t[1], first + t[2]});
  }
}

// Weights of the first two corners of a triangle, and the offset along its normal (Cloth).
glm::vec3 OnTriangle(const glm::vec3& p,
                     const glm::vec3& a,
                     const glm::vec3& b,
                     const glm::vec3& c) {
  const glm::vec3 ab = b - a;
  const glm::vec3 ac = c - a;
  const glm::vec3 cross = glm::cross(ab, ac);
  const float area = std::max(glm::dot(cross, cross), 1e-16f);
  const float wb = glm::dot(glm::cross(p - a, ac), cross) / area;
  const float wc = glm::dot(glm::cross(ab, p - a), cross) / area;
  return {1.0f - wb - wc, wb, glm::dot(p - a, cross) / std::sqrt(area)};
}

class ClothMaker {
 public:
  ClothMaker(const DrapedGarment& draped, const human::SkinnedMesh& mesh)
      : draped_(draped),
        mesh_(mesh),
        particle_(draped.coarse_positions.size(), human::Cloth::kUnbound) {}

  std::optional<human::Cloth> Make() {
    triangle_.assign(draped_.coarse_triangles.size(), human::Cloth::kUnbound);
    for (size_t t = 0; t < triangle_.size(); ++t) {
      const Triangle& corners = draped_.coarse_triangles[t];
      if (std::any_of(corners.begin(), corners.end(),
                      [this](uint32_t p) { return draped_.reach[p] > 0.0f; })) {
        triangle_[t] = static_cast<uint32_t>(cloth_.triangles.size() / 3);
        for (const uint32_t p : corners) {
          cloth_.triangles.push_back(Particle(p));
        }
      }
    }
    if (cloth_.triangles.empty()) {
      return std::nullopt;
    }
    Bind();
    return std::move(cloth_);
  }

 private:
  uint32_t Particle(uint32_t p) {
    if (particle_[p] == human::Cloth::kUnbound) {
      particle_[p] = static_cast<uint32_t>(cloth_.positions.size());
      const Influences influences = StrongestOf(draped_.sheet.WeightsOf(p));
      const glm::mat4 back = glm::inverse(BlendOf(influences, draped_.skin));
      cloth_.positions.emplace_back(back * glm::vec4(draped_.coarse_positions[p], 1.0f));
      cloth_.joints.push_back(influences.joints);
      cloth_.weights.push_back(influences.weights);
      cloth_.reach.push_back(draped_.reach[p]);
    }
    return particle_[p];
  }

  void Bind() {
    cloth_.vertex_triangle.assign(mesh_.positions.size(), human::Cloth::kUnbound);
    cloth_.vertex_weights.assign(mesh_.positions.size(), glm::vec3(0.0f));
    for (size_t t = 0; t < draped_.sheet.triangles.size(); ++t) {
      const uint32_t coarse = triangle_[draped_.coarse_of[t]];
      if (coarse == human::Cloth::kUnbound) {
        continue;
      }
      for (const uint32_t v : draped_.sheet.triangles[t]) {
        if (cloth_.vertex_triangle[v] == human::Cloth::kUnbound) {
          cloth_.vertex_triangle[v] = coarse;
          const auto corner = [&](int k) {
            return cloth_.positions[cloth_.triangles[3 * coarse + size_t(k)]];
          };
          cloth_.vertex_weights[v] =
              OnTriangle(mesh_.positions[v], corner(0), corner(1), corner(2));
        }
      }
    }
  }

  const DrapedGarment& draped_;
  const human::SkinnedMesh& mesh_;
  human::Cloth cloth_;
  std::vector<uint32_t> particle_;
  std::vector<uint32_t> triangle_;
};

}  // namespace

Result<Garment> FinishGarment(const DrapedGarment& draped,
                              const DrapedGarment& whole,
                              const GarmentPattern& pattern,
                              const FittedBody& body) {
  Garment garment;
  const std::string& name = pattern.design->name;
  garment.mesh.name = name;
  const std::vector<float> shade = FoldShades(draped.sheet);
  AddSheet(
      draped.sheet, draped.skin,
      [&](size_t v) {
        return draped.dye(draped.sheet.panel[v], draped.sheet.flat[v]) *
               shade[draped.sheet.particle[v]];
      },
      garment.mesh);
  for (const Trim& trim : draped.trims) {
    AddSheet(
        trim.sheet, draped.skin, [&](size_t) { return trim.colour; }, garment.mesh);
  }
  garment.material.name = name;
  garment.material.surface = human::Surface::kCloth;
  garment.material.roughness = 0.9f;
  garment.material.two_sided = true;
  const Weave weave = pattern.design->fabric.weave;
  LARARIUM_ASSIGN_OR_RETURN(garment.colour, WeaveColour(weave, pattern.seed));
  LARARIUM_ASSIGN_OR_RETURN(garment.normal, WeaveNormals(weave, pattern.seed));
  if (!draped.reach.empty()) {
    garment.cloth = ClothMaker(draped, garment.mesh).Make();
    if (garment.cloth) {
      garment.cloth->name = name;
    }
  }
  FindHiddenSkin(whole, body, garment);
  return garment;
}

namespace {

// `only_wraps` restricts this to garments under which nothing needs to move.
std::vector<bool> CoveredByAny(std::span<const DrapedGarment> outer,
                               const Sheet& sheet,
                               const std::vector<bool>& arm_joints,
                               bool only_wraps) {
  const auto moves_with_arm = [&](size_t p) {
    float share = 0.0f;
    for (size_t j = 0; j < arm_joints.size(); ++j) {
      share += arm_joints[j] ? sheet.WeightsOf(p)[j] : 0.0f;
    }
    return share > 0.5f;
  };
  const std::vector<glm::vec3> normals = Normals(sheet.positions, sheet.ParticleTriangles());
  std::vector<bool> covered(sheet.positions.size(), false);
  for (const DrapedGarment& garment : outer) {
    if (!garment.covers || (only_wraps && !garment.wraps)) {
      continue;
    }
    const std::vector<bool> by_this = CoveredBy(garment, sheet.positions, normals, kClothView,
                                                garment.cover_margin, garment.cover_margin);
    for (size_t p = 0; p < covered.size(); ++p) {
      const glm::vec3& x = sheet.positions[p];
      const bool in_arm = x.x < garment.covers_left_of && x.y > garment.covers_above;
      const bool in_trunk = x.y < garment.covers_trunk_below && !moves_with_arm(p);
      covered[p] = covered[p] || by_this[p] || in_arm || in_trunk;
    }
  }
  return covered;
}

// Says for each simulated triangle whether any part of the sheet that follows it is visible.
std::vector<bool> SeenGroups(const std::vector<bool>& covered, const DrapedGarment& garment) {
  std::vector<bool> seen(garment.coarse_triangles.size(), false);
  for (size_t t = 0; t < garment.sheet.triangles.size(); ++t) {
    for (const uint32_t p : garment.sheet.Particles(garment.sheet.triangles[t])) {
      seen[garment.coarse_of[t]] = seen[garment.coarse_of[t]] || !covered[p];
    }
  }
  return seen;
}

// Stops simulating pieces that are no longer attached and would fall.
void DropLoosePieces(const DrapedGarment& garment, std::vector<bool>& moving) {
  std::vector<bool> held(garment.coarse_positions.size(), false);
  for (size_t p = 0; p < held.size(); ++p) {
    held[p] = garment.reach[p] == 0.0f;
  }
  for (bool grows = true; grows;) {
    grows = false;
    for (size_t t = 0; t < moving.size(); ++t) {
      const Triangle& corners = garment.coarse_triangles[t];
      const auto count =
          std::count_if(corners.begin(), corners.end(), [&](uint32_t p) { return held[p]; });
      if (moving[t] && count > 0 && count < 3) {
        for (const uint32_t p : corners) {
          held[p] = true;
        }
        grows = true;
      }
    }
  }
  for (size_t t = 0; t < moving.size(); ++t) {
    moving[t] = moving[t] && held[garment.coarse_triangles[t][0]];
  }
}

}  // namespace

void LeaveOutCovered(std::span<const DrapedGarment> outer,
                     const FittedBody& body,
                     DrapedGarment& inner) {
  if (inner.coarse_triangles.empty()) {
    return;
  }
  const std::vector<bool> arm_joints = ArmJoints(body);
  for (Trim& trim : inner.trims) {
    std::vector<bool> covered = CoveredByAny(outer, trim.sheet, arm_joints, false);
    // Hides a belt that is mostly covered.
    const auto count = std::count(covered.begin(), covered.end(), true);
    if (2 * count > ptrdiff_t(covered.size())) {
      covered.assign(covered.size(), true);
    }
    std::erase_if(trim.sheet.triangles, [&](const Triangle& t) {
      const Triangle corners = trim.sheet.Particles(t);
      return std::any_of(corners.begin(), corners.end(), [&](uint32_t p) { return covered[p]; });
    });
    DropUnusedVertices(trim.sheet);
  }
  // Removes complete simulated triangles, so that edges are as even as the threads.
  const std::vector<bool> drawn =
      SeenGroups(CoveredByAny(outer, inner.sheet, arm_joints, false), inner);
  std::vector<bool> moving = SeenGroups(CoveredByAny(outer, inner.sheet, arm_joints, true), inner);
  DropLoosePieces(inner, moving);
  std::vector<uint32_t> renamed(moving.size(), 0);
  std::vector<Triangle> coarse;
  for (size_t t = 0; t < moving.size(); ++t) {
    renamed[t] = static_cast<uint32_t>(coarse.size());
    if (moving[t]) {
      coarse.push_back(inner.coarse_triangles[t]);
    }
  }
  std::vector<Triangle> kept;
  std::vector<uint32_t> kept_of;
  for (size_t t = 0; t < inner.sheet.triangles.size(); ++t) {
    const uint32_t group = inner.coarse_of[t];
    if (drawn[group] && moving[group]) {
      kept.push_back(inner.sheet.triangles[t]);
      kept_of.push_back(renamed[group]);
    }
  }
  inner.sheet.triangles = std::move(kept);
  inner.coarse_of = std::move(kept_of);
  inner.coarse_triangles = std::move(coarse);
  DropUnusedVertices(inner.sheet);
}

}  // namespace lararium::import
