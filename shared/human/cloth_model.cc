#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <queue>
#include <utility>

#include "shared/human/cloth_data.h"
#include "shared/human/turns.h"

namespace lararium::human {
namespace {

constexpr uint32_t kNone = 0xffffffffu;
constexpr float kTetherSlack = 1.01f;
// Edges that are this much longer count as diagonals of a quad of threads, along which cloth shears
// far more easily than it stretches.
constexpr float kDiagonalRatio = 1.15f;
constexpr float kShearCompliance = 2e-3f;  // m/N
constexpr float kHighestBulge = 0.03f;     // Metres of skin outside its capsule.
constexpr float kBulgeWidth = 0.03f;       // metres
constexpr float kBodyNear = 0.15f;         // Metres from the cloth within which bulges count.
constexpr float kThickest = 0.015f;        // Largest addition to the thickness, metres.
// Distance that parts of the cloth keep from each other, as a share of the edge length. Half the
// diagonal of a quad is 0.62 of its mean edge, so no particle slips between four others.
constexpr float kContactShare = 0.65f;
// Hinges of triangles that are lower than this share of the edge are left out: they do not describe
// the cloth's shape.
constexpr float kLeastHeight = 0.05f;
// Hinges stiffer than those of felt would work against the edges without benefit.
constexpr float kStiffestHinge = 10.0f;  // rad/(N m)

struct MeshEdge {
  uint32_t a = 0;
  uint32_t b = 0;
  std::array<uint32_t, 2> opposite = {kNone, kNone};
};

std::vector<MeshEdge> FindEdges(const std::vector<std::array<uint32_t, 3>>& triangles) {
  std::map<std::pair<uint32_t, uint32_t>, MeshEdge> edges;
  for (const std::array<uint32_t, 3>& t : triangles) {
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t a = std::min(t[k], t[(k + 1) % 3]);
      const uint32_t b = std::max(t[k], t[(k + 1) % 3]);
      if (a == b) {
        continue;
      }
      MeshEdge& edge = edges.try_emplace({a, b}, MeshEdge{a, b}).first->second;
      const uint32_t opposite = t[(k + 2) % 3];
      (edge.opposite[0] == kNone ? edge.opposite[0] : edge.opposite[1]) = opposite;
    }
  }
  std::vector<MeshEdge> list;
  for (const auto& [key, edge] : edges) {
    list.push_back(edge);
  }
  return list;
}

// Reorders constraints into batches that share no particle (greedy colouring), so that the
// processor works on several at once. particles(c) returns the particles of a constraint.
template <typename Constraint, typename Particles>
void SortIntoBatches(std::vector<Constraint>& constraints, size_t count, Particles particles) {
  std::vector<uint64_t> used(count, 0);  // Bit set of the colours used at each particle.
  std::vector<std::pair<uint32_t, Constraint>> coloured;
  for (const Constraint& constraint : constraints) {
    uint64_t taken = 0;
    for (const uint32_t p : particles(constraint)) {
      taken |= used[p];
    }
    uint32_t colour = 0;
    while (colour < 63 && (taken >> colour & 1u) != 0) {
      ++colour;
    }
    for (const uint32_t p : particles(constraint)) {
      used[p] |= uint64_t{1} << colour;
    }
    coloured.emplace_back(colour, constraint);
  }
  std::stable_sort(coloured.begin(), coloured.end(),
                   [](const auto& l, const auto& r) { return l.first < r.first; });
  for (size_t i = 0; i < constraints.size(); ++i) {
    constraints[i] = coloured[i].second;
  }
}

// Converts the cloths of a Human into particles and constraints.
class Builder {
 public:
  Builder(const Human& human, ClothModel::Data& model) : human_(human), model_(model) {}

  void Build() {
    model_.skinning = human_.skinning;
    model_.joint_from_actor = human_.skeleton.joint_from_actor;
    for (const BodyCapsule& c : human_.capsules) {
      model_.capsules.push_back({c.joint, c.a, c.b, c.radius_a, c.radius_b});
    }
    for (const Cloth& cloth : human_.cloths) {
      AddCloth(cloth);
    }
    const size_t count = model_.rest.size();
    SortIntoBatches(model_.edges, count, [](const ClothEdge& e) {
      return std::array<uint32_t, 2>{e.a, e.b};
    });
    SortIntoBatches(model_.hinges, count, [](const ClothHinge& h) { return h.particles; });
    MeasureStandoffs();
    MeasureContactDistance();
  }

 private:
  void AddCloth(const Cloth& cloth) {
    ClothRange range;
    range.first = static_cast<uint32_t>(model_.rest.size());
    range.count = static_cast<uint32_t>(cloth.positions.size());
    const size_t first_triangle = model_.triangles.size();
    for (size_t t = 0; t + 2 < cloth.triangles.size(); t += 3) {
      model_.triangles.push_back({range.first + cloth.triangles[t],
                                  range.first + cloth.triangles[t + 1],
                                  range.first + cloth.triangles[t + 2]});
      model_.triangle_density.push_back(cloth.density);
    }
    AddParticles(cloth, range, first_triangle);
    const std::vector<std::array<uint32_t, 3>> triangles(
        model_.triangles.begin() + static_cast<ptrdiff_t>(first_triangle), model_.triangles.end());
    const std::vector<MeshEdge> edges = FindEdges(triangles);
    AddTethers(edges, range);
    AddEdges(cloth, edges);
    AddHinges(cloth, edges);
    Bind(cloth, range, first_triangle);
    model_.cloths.push_back(std::move(range));
  }

  float Distance(uint32_t a, uint32_t b) const { return Length(model_.rest[b] - model_.rest[a]); }

  float Area(const std::array<uint32_t, 3>& t) const {
    const Float4 origin = model_.rest[t[0]];
    return 0.5f * Length(Cross(model_.rest[t[1]] - origin, model_.rest[t[2]] - origin));
  }

  void AddParticles(const Cloth& cloth, const ClothRange& range, size_t first_triangle) {
    for (const glm::vec3& p : cloth.positions) {
      model_.rest.emplace_back(p);
    }
    model_.bind_positions.insert(model_.bind_positions.end(), cloth.positions.begin(),
                                 cloth.positions.end());
    model_.joints.insert(model_.joints.end(), cloth.joints.begin(), cloth.joints.end());
    model_.weights.insert(model_.weights.end(), cloth.weights.begin(), cloth.weights.end());
    model_.reach.insert(model_.reach.end(), cloth.reach.begin(), cloth.reach.end());
    model_.thickness.resize(model_.rest.size(), cloth.thickness);
    model_.friction.resize(model_.rest.size(), cloth.friction);
    model_.cloth_of.resize(model_.rest.size(), static_cast<uint16_t>(model_.cloths.size()));
    std::vector<float> mass(range.count, 0.0f);
    for (size_t t = first_triangle; t < model_.triangles.size(); ++t) {
      for (const uint32_t corner : model_.triangles[t]) {
        mass[corner - range.first] += cloth.density * Area(model_.triangles[t]) / 3.0f;
      }
    }
    for (uint32_t i = 0; i < range.count; ++i) {
      // Particles without a triangle have no mass and stay with the skin.
      const bool is_free = cloth.reach[i] > 0.0f && mass[i] > 1e-9f;
      model_.inverse_mass.push_back(is_free ? 1.0f / mass[i] : 0.0f);
      (is_free ? model_.free : model_.pinned).push_back(range.first + i);
    }
  }

  // True if the edge is the longest side of both its triangles.
  bool IsDiagonal(const MeshEdge& e) const {
    if (e.opposite[1] == kNone) {
      return false;
    }
    const float length = Distance(e.a, e.b);
    for (const uint32_t opposite : e.opposite) {
      if (length < kDiagonalRatio * std::max(Distance(e.a, opposite), Distance(e.b, opposite))) {
        return false;
      }
    }
    return true;
  }

  void AddEdges(const Cloth& cloth, const std::vector<MeshEdge>& edges) {
    for (const MeshEdge& e : edges) {
      if (model_.inverse_mass[e.a] + model_.inverse_mass[e.b] == 0.0f) {
        continue;
      }
      const float compliance = IsDiagonal(e) ? std::max(kShearCompliance, cloth.stretch_compliance)
                                             : cloth.stretch_compliance;
      model_.edges.push_back({e.a, e.b, Distance(e.a, e.b), compliance});
    }
  }

  void AddHinges(const Cloth& cloth, const std::vector<MeshEdge>& edges) {
    for (const MeshEdge& e : edges) {
      if (e.opposite[1] != kNone && e.opposite[0] != e.opposite[1]) {
        AddHinge(cloth, {e.a, e.b, e.opposite[0], e.opposite[1]});
      }
    }
  }

  // The foot of each opposite corner on the edge is at share[i]. The vector from the corner to its
  // foot, divided by the height, is a unit vector; the two vectors cancel if the hinge is flat.
  void AddHinge(const Cloth& cloth, const std::array<uint32_t, 4>& particles) {
    const std::vector<Float4>& x = model_.rest;
    const Float4 edge = x[particles[1]] - x[particles[0]];
    const float length = Length(edge);
    ClothHinge hinge;
    hinge.particles = particles;
    float height_sum = 0.0f;
    Float4 normal;
    for (size_t side = 0; side < 2; ++side) {
      const Float4 arm = x[particles[2 + side]] - x[particles[0]];
      const float share = Dot(arm, edge) / (length * length);
      const float height = Length(arm - edge * share);
      if (!(height > kLeastHeight * length)) {
        return;
      }
      hinge.pull[0] += (1.0f - share) / height;
      hinge.pull[1] += share / height;
      hinge.pull[2 + side] = -1.0f / height;
      height_sum += height;
      const Float4 up = Cross(edge, arm);
      normal += up * ((side == 0 ? 1.0f : -1.0f) / Length(up));
    }
    Float4 chord;
    for (size_t i = 0; i < 4; ++i) {
      chord += x[particles[i]] * hinge.pull[i];
      hinge.push[i] = hinge.pull[i] * model_.inverse_mass[particles[i]];
      hinge.weight += hinge.pull[i] * hinge.push[i];
    }
    if (hinge.weight == 0.0f) {
      return;
    }
    const float steepness = Length(normal);
    hinge.rest = steepness > 1e-3f ? Dot(chord, normal) / steepness : 0.0f;
    // Stiffness grows with edge^2 / area (Bergou et al.); the factor is 1 for equilateral
    // triangles.
    hinge.compliance = std::max(cloth.bend_compliance, kStiffestHinge) *
                       std::clamp(0.57735f * height_sum / length, 0.1f, 10.0f);
    model_.hinges.push_back(hinge);
  }

  // Dijkstra's algorithm from all pins at once, along edges and across flattened hinges.
  void AddTethers(const std::vector<MeshEdge>& edges, const ClothRange& range) {
    std::vector<std::vector<std::pair<uint32_t, float>>> ways(range.count);
    const auto connect = [&](uint32_t a, uint32_t b, float length) {
      ways[a - range.first].emplace_back(b, length);
      ways[b - range.first].emplace_back(a, length);
    };
    for (const MeshEdge& e : edges) {
      connect(e.a, e.b, Distance(e.a, e.b));
      if (e.opposite[1] != kNone) {
        connect(e.opposite[0], e.opposite[1], DistanceAcross(e));
      }
    }
    std::vector<float> length(range.count, std::numeric_limits<float>::infinity());
    std::vector<uint32_t> pin(range.count, kNone);
    using Visit = std::pair<float, uint32_t>;
    std::priority_queue<Visit, std::vector<Visit>, std::greater<>> open;
    for (const uint32_t p : model_.pinned) {
      if (p >= range.first && p < range.first + range.count) {
        length[p - range.first] = 0.0f;
        pin[p - range.first] = p;
        open.emplace(0.0f, p);
      }
    }
    while (!open.empty()) {
      const auto [distance, p] = open.top();
      open.pop();
      if (distance > length[p - range.first]) {
        continue;
      }
      for (const auto& [q, step] : ways[p - range.first]) {
        if (distance + step < length[q - range.first]) {
          length[q - range.first] = distance + step;
          pin[q - range.first] = pin[p - range.first];
          open.emplace(distance + step, q);
        }
      }
    }
    for (uint32_t i = 0; i < range.count; ++i) {
      const uint32_t particle = range.first + i;
      if (model_.inverse_mass[particle] == 0.0f) {
        continue;
      }
      if (pin[i] != kNone) {
        model_.tethers.push_back({particle, pin[i], kTetherSlack * length[i]});
      } else if (!model_.settings.drops_loose) {
        model_.inverse_mass[particle] = 0.0f;
        model_.pinned.push_back(particle);
        std::erase(model_.free, particle);
      }
    }
  }

  // Distance between the opposite corners of an edge whose triangles are unfolded into one plane.
  // Infinite if the straight line does not cross the edge.
  float DistanceAcross(const MeshEdge& e) const {
    const float edge = std::max(Distance(e.a, e.b), 1e-9f);
    std::array<float, 2> along, aside;
    for (size_t side = 0; side < 2; ++side) {
      const float from_a = Distance(e.a, e.opposite[side]);
      const float from_b = Distance(e.b, e.opposite[side]);
      along[side] = (from_a * from_a - from_b * from_b + edge * edge) / (2.0f * edge);
      aside[side] = std::sqrt(std::max(from_a * from_a - along[side] * along[side], 0.0f));
    }
    const float width = aside[0] + aside[1];
    const float crossing = along[0] * aside[1] + along[1] * aside[0];  // multiplied by width
    if (crossing < 0.0f || crossing > edge * width) {
      return std::numeric_limits<float>::infinity();
    }
    return std::hypot(along[1] - along[0], width);
  }

  // For each vertex, the first vertex at the same position. Both sides of a seam are thus bound
  // alike, and the seam stays closed.
  static std::vector<uint32_t> FindTwins(const std::vector<glm::vec3>& positions) {
    std::map<std::array<float, 3>, uint32_t> first_at;
    std::vector<uint32_t> twins;
    for (uint32_t v = 0; v < positions.size(); ++v) {
      const glm::vec3& p = positions[v];
      twins.push_back(first_at.try_emplace({p.x, p.y, p.z}, v).first->second);
    }
    return twins;
  }

  void Bind(const Cloth& cloth, ClothRange& range, size_t first_triangle) {
    const std::vector<glm::vec3> normals = ParticleNormals(range, first_triangle);
    model_.bind_normals.insert(model_.bind_normals.end(), normals.begin(), normals.end());
    const SkinnedMesh& mesh = human_.meshes[cloth.mesh];
    const std::vector<uint32_t> twins = FindTwins(mesh.positions);
    for (uint32_t v = 0; v < cloth.vertex_triangle.size(); ++v) {
      const uint32_t twin = twins[v];
      if (cloth.vertex_triangle[twin] == Cloth::kUnbound) {
        range.has_plain_skin = true;
        continue;
      }
      ClothVertex vertex;
      vertex.vertex = v;
      vertex.triangle = static_cast<uint32_t>(first_triangle) + cloth.vertex_triangle[twin];
      vertex.corners = model_.triangles[vertex.triangle];
      const glm::vec3 w = cloth.vertex_weights[twin];
      vertex.weights = {w.x, w.y, 1.0f - w.x - w.y};
      vertex.offset = w.z;
      glm::vec3 mean(0.0f);
      for (size_t k = 0; k < 3; ++k) {
        mean += vertex.weights[k] * normals[vertex.corners[k] - range.first];
      }
      vertex.normal = SharesOf(mesh.normals[v], mean, vertex.corners);
      range.vertices.push_back(vertex);
    }
  }

  // Expresses the vector as a sum of the normal and two sides of a triangle. A degenerate triangle
  // gives the normal alone.
  std::array<float, 3> SharesOf(const glm::vec3& vector,
                                const glm::vec3& normal,
                                const std::array<uint32_t, 3>& corners) const {
    const glm::vec3 origin = model_.bind_positions[corners[0]];
    const glm::vec3 first = model_.bind_positions[corners[1]] - origin;
    const glm::vec3 second = model_.bind_positions[corners[2]] - origin;
    const float volume = glm::dot(normal, glm::cross(first, second));
    const float size = glm::length(first) * glm::length(second);
    if (!(std::abs(volume) > 1e-2f * size)) {
      return {1.0f, 0.0f, 0.0f};
    }
    return {glm::dot(vector, glm::cross(first, second)) / volume,
            glm::dot(normal, glm::cross(vector, second)) / volume,
            glm::dot(normal, glm::cross(first, vector)) / volume};
  }

  std::vector<glm::vec3> ParticleNormals(const ClothRange& range, size_t first_triangle) const {
    std::vector<glm::vec3> normals(range.count, glm::vec3(0.0f));
    for (size_t t = first_triangle; t < model_.triangles.size(); ++t) {
      const std::array<uint32_t, 3>& corners = model_.triangles[t];
      const Float4 origin = model_.rest[corners[0]];
      const Float4 normal =
          Cross(model_.rest[corners[1]] - origin, model_.rest[corners[2]] - origin);
      for (const uint32_t corner : corners) {
        normals[corner - range.first] += normal.xyz();
      }
    }
    for (glm::vec3& normal : normals) {
      normal = Direction(normal, glm::vec3(0.0f, 1.0f, 0.0f));
    }
    return normals;
  }

  void MeasureStandoffs() {
    const std::vector<float> spacing = LongestEdges();
    std::vector<RoundCone> cones;
    for (const ClothCapsule& capsule : model_.capsules) {
      cones.push_back(BoundCone(capsule));
    }
    const std::vector<std::vector<Bulge>> bulges = FindBulges(cones);
    for (size_t c = 0; c < cones.size(); ++c) {
      const std::vector<float> drops = MeasureDrops(cones[c]);
      for (size_t i = 0; i < model_.rest.size(); ++i) {
        const NearestSphere sphere = FindNearestSphere(cones[c], model_.rest[i]);
        const float around = sphere.radius + model_.thickness[i];
        const float arrow = std::min(spacing[i] * spacing[i] / (8.0f * around + 1e-6f), kThickest);
        const float as_bound = sphere.distance - sphere.radius;
        const float bulge = as_bound < kBodyNear ? HeightOfBulge(i, bulges[c]) : 0.0f;
        const float wanted = model_.thickness[i] + std::max(arrow, drops[i]) + bulge;
        model_.standoff.push_back(std::isfinite(as_bound) ? std::min(wanted, as_bound) : wanted);
        model_.largest_standoff = std::max(model_.largest_standoff, wanted);
      }
    }
  }

  // Returns the capsule's cone in the bind pose, actor frame.
  RoundCone BoundCone(const ClothCapsule& capsule) const {
    const glm::mat4 actor_from_joint = glm::inverse(model_.joint_from_actor[capsule.joint]);
    const auto to_actor = [&](const glm::vec3& p) {
      return Float4(glm::vec3(actor_from_joint * glm::vec4(p, 1.0f)));
    };
    return MakeRoundCone(to_actor(capsule.a), to_actor(capsule.b), capsule.radius_a,
                         capsule.radius_b);
  }

  // For each particle: metres by which the drawn cloth comes nearer to a capsule than the triangles
  // between particles, that is, the depth of its folds.
  std::vector<float> MeasureDrops(const RoundCone& cone) const {
    const auto height = [&cone](const Float4& place) {
      const NearestSphere sphere = FindNearestSphere(cone, place);
      return sphere.distance - sphere.radius;
    };
    std::vector<float> heights, drops(model_.rest.size(), 0.0f);
    for (const Float4& place : model_.rest) {
      heights.push_back(height(place));
    }
    for (size_t c = 0; c < model_.cloths.size(); ++c) {
      const ClothRange& range = model_.cloths[c];
      const SkinnedMesh& mesh = human_.meshes[human_.cloths[c].mesh];
      for (const ClothVertex& vertex : range.vertices) {
        float between = 0.0f;
        for (int k = 0; k < 3; ++k) {
          between += vertex.weights[k] * heights[vertex.corners[k]];
        }
        const float drop =
            std::min(between - height(Float4(mesh.positions[vertex.vertex])), kThickest);
        for (const uint32_t corner : vertex.corners) {
          drops[corner] = std::max(drops[corner], drop);
        }
      }
    }
    return drops;
  }

  // A point of the skin outside all capsules.
  struct Bulge {
    Float4 place;
    float height = 0.0f;  // metres above the nearest capsule
  };

  // Points of the drawn skin, grouped by the nearest capsule.
  std::vector<std::vector<Bulge>> FindBulges(const std::vector<RoundCone>& cones) const {
    std::vector<std::vector<Bulge>> bulges(cones.size());
    for (const SkinnedMesh& mesh : human_.meshes) {
      if (mesh.material < 0 || human_.materials[mesh.material].surface != Surface::kSkin) {
        continue;
      }
      std::vector<bool> is_drawn(mesh.positions.size(), false);
      for (const uint32_t v : mesh.indices) {
        is_drawn[v] = true;
      }
      for (size_t v = 0; v < is_drawn.size() && !cones.empty(); ++v) {
        if (is_drawn[v]) {
          AddBulge(cones, Float4(mesh.positions[v]), bulges);
        }
      }
    }
    return bulges;
  }

  static void AddBulge(const std::vector<RoundCone>& cones,
                       const Float4& place,
                       std::vector<std::vector<Bulge>>& bulges) {
    float least = std::numeric_limits<float>::infinity();
    size_t nearest = 0;
    for (size_t c = 0; c < cones.size(); ++c) {
      const NearestSphere sphere = FindNearestSphere(cones[c], place);
      const float height = sphere.distance - sphere.radius;
      if (height < least) {
        least = height;
        nearest = c;
      }
    }
    if (least > 0.0f) {
      bulges[nearest].push_back({place, std::min(least, kHighestBulge)});
    }
  }

  // Height of the highest bulge around the particle's position on the body.
  float HeightOfBulge(size_t particle, const std::vector<Bulge>& bulges) const {
    const Float4& x = model_.rest[particle];
    float least = kBodyNear * kBodyNear;
    for (const Bulge& bulge : bulges) {
      const Float4 apart = bulge.place - x;
      least = std::min(least, Dot(apart, apart));
    }
    const float around = std::sqrt(least) + kBulgeWidth;
    float highest = 0.0f;
    for (const Bulge& bulge : bulges) {
      const Float4 apart = bulge.place - x;
      if (Dot(apart, apart) < around * around) {
        highest = std::max(highest, bulge.height);
      }
    }
    return highest;
  }

  // Longest edge at each particle, metres.
  std::vector<float> LongestEdges() const {
    std::vector<float> longest(model_.rest.size(), 0.0f);
    for (const ClothEdge& edge : model_.edges) {
      for (const uint32_t i : {edge.a, edge.b}) {
        longest[i] = std::max(longest[i], edge.length);
      }
    }
    return longest;
  }

  void MeasureContactDistance() {
    double sum = 0.0;
    for (const ClothEdge& edge : model_.edges) {
      sum += edge.length;
    }
    if (!model_.edges.empty()) {
      model_.contact_distance =
          kContactShare * static_cast<float>(sum / double(model_.edges.size()));
    }
  }

  const Human& human_;
  ClothModel::Data& model_;
};

}  // namespace

ClothModel::ClothModel(const Human& human, const ClothSettings& settings)
    : data_(std::make_unique<Data>()) {
  data_->settings = settings;
  Builder(human, *data_).Build();
}

ClothModel::ClothModel(ClothModel&&) noexcept = default;
ClothModel& ClothModel::operator=(ClothModel&&) noexcept = default;
ClothModel::~ClothModel() = default;

size_t ClothModel::cloth_count() const { return data_->cloths.size(); }
size_t ClothModel::particle_count() const { return data_->rest.size(); }

}  // namespace lararium::human
