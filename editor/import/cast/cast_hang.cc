#include "editor/import/cast/cast_hang.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <string>
#include <utility>

#include "editor/import/cast/cast_rig.h"
#include "editor/import/cast/cast_subdivide.h"
#include "editor/import/cast/joint_lookup.h"

namespace lararium::import {
namespace {

constexpr float kFree = 0.015f;      // Metres from the skin beyond which hair hangs free.
constexpr float kLeastDrop = 0.08f;  // Least length of hanging parts, metres.
constexpr float kBundle = 0.05f;     // Parts whose middles are nearer hang together, metres.
constexpr float kStick = 0.055f;     // Approximate distance between joints, metres.
constexpr int kMostSticks = 6;       // Longest chain.
// Limit of the skeleton, because vertices store joints in a byte.
constexpr size_t kMostJoints = 240;
constexpr int kBundleSlices = 24;  // Slices that determine the middle of a bundle.
// Half width of the blend at a joint, relative to the distance of joints.
constexpr float kBlend = 0.35f;
constexpr float kStiffness = 70.0f;  // 1/s^2
constexpr float kDrag = 2.2f;        // 1/s
constexpr float kThin = 0.045f;      // Largest width of the end of a belt, metres.
constexpr float kOverSkirt = 0.10f;  // metres
constexpr float kLeastRadius = 0.008f, kMostRadius = 0.03f;  // metres

struct Bundle {
  std::vector<uint32_t> vertices;
  glm::vec2 middle{0.0f};  // x, z.
};

// Adds chains of joints along the vertices of a mesh.
class ChainLayer {
 public:
  ChainLayer(human::SkinnedMesh& mesh, human::Skeleton& skeleton)
      : mesh_(mesh), skeleton_(skeleton) {}

  bool has_room() const { return skeleton_.size() + kMostSticks <= kMostJoints; }

  // `path` leads from the root to the end. The vertices are moved from the carrier to the
  // chain.
  human::SpringChain Lay(const std::string& name,
                         const std::vector<uint32_t>& vertices,
                         const std::vector<glm::vec3>& path,
                         size_t carrier) {
    carrier_ = carrier;
    const float length = LengthOf(path);
    const int sticks = std::clamp(static_cast<int>(std::lround(length / kStick)), 2, kMostSticks);
    human::SpringChain chain;
    chain.name = name;
    std::vector<glm::vec3> places = Divide(path, sticks);
    size_t parent = carrier;
    for (size_t i = 0; i < places.size(); ++i) {
      parent = AddJoint(chain.name + "_" + std::to_string(i + 1), parent, places[i]);
      chain.joints.push_back(static_cast<uint32_t>(parent));
    }
    places.push_back(path.back());
    chain.stiffness = kStiffness;
    chain.drag = kDrag;
    float squares = 0.0f;
    for (const uint32_t v : vertices) {
      squares += HandOver(v, places, chain.joints);
    }
    const float spread = std::sqrt(squares / static_cast<float>(vertices.size()));
    chain.radius = std::clamp(0.7f * spread, kLeastRadius, kMostRadius);
    return chain;
  }

 private:
  static float LengthOf(const std::vector<glm::vec3>& path) {
    float length = 0.0f;
    for (size_t i = 1; i < path.size(); ++i) {
      length += glm::distance(path[i - 1], path[i]);
    }
    return length;
  }

  // Gives `count` evenly spaced points of a path, without its end.
  static std::vector<glm::vec3> Divide(const std::vector<glm::vec3>& path, int count) {
    const float step = LengthOf(path) / static_cast<float>(count);
    std::vector<glm::vec3> places = {path[0]};
    float walked = 0.0f;
    for (size_t i = 1; i < path.size(); ++i) {
      const float length = glm::distance(path[i - 1], path[i]);
      while (static_cast<int>(places.size()) < count &&
             walked + length > step * static_cast<float>(places.size())) {
        const float share = (step * static_cast<float>(places.size()) - walked) / length;
        places.push_back(glm::mix(path[i - 1], path[i], share));
      }
      walked += length;
    }
    return places;
  }

  uint32_t AddJoint(const std::string& name, size_t parent, const glm::vec3& place) {
    human::JointTransform rest;
    rest.translation = place - RestPosition(skeleton_, skeleton_.names[parent]);
    skeleton_.names.push_back(name);
    skeleton_.parents.push_back(static_cast<int16_t>(parent));
    skeleton_.rest.push_back(rest);
    skeleton_.joint_from_actor.push_back(glm::translate(glm::mat4(1.0f), -place));
    return static_cast<uint32_t>(skeleton_.size() - 1);
  }

  // Binds a vertex to the nearest joints. Returns its squared distance from the path.
  float HandOver(uint32_t v,
                 const std::vector<glm::vec3>& places,
                 const std::vector<uint32_t>& joints) {
    const glm::vec3& p = mesh_.positions[v];
    float least = 1e9f;
    float along = 0.0f;  // Position along the path from the root, in segments.
    for (size_t i = 0; i + 1 < places.size(); ++i) {
      const glm::vec3 stick = places[i + 1] - places[i];
      const float share = std::clamp(
          glm::dot(p - places[i], stick) / std::max(glm::dot(stick, stick), 1e-9f), 0.0f, 1.0f);
      const glm::vec3 off = p - (places[i] + share * stick);
      if (glm::dot(off, off) < least) {
        least = glm::dot(off, off);
        along = static_cast<float>(i) + share;
      }
    }
    // At each joint the weight passes from the previous joint to the next; at the first, from
    // the head.
    const float last = static_cast<float>(joints.size());
    const float at = std::clamp(std::round(along), 0.0f, last - 1.0f);
    const float from = at > 0.0f ? at - kBlend : 0.0f;
    float share = std::clamp((along - from) / (2.0f * kBlend), 0.0f, 1.0f);
    share = share * share * (3.0f - 2.0f * share);
    const auto k = static_cast<size_t>(at);
    const std::pair<uint8_t, float> influences[] = {
        {static_cast<uint8_t>(k > 0 ? joints[k - 1] : carrier_), 1.0f - share},
        {static_cast<uint8_t>(joints[k]), share}};
    const Influences strongest = Strongest(influences);
    mesh_.joints[v] = strongest.joints;
    mesh_.weights[v] = strongest.weights;
    return least;
  }

  human::SkinnedMesh& mesh_;
  human::Skeleton& skeleton_;
  size_t carrier_ = 0;
};

class HairHanger {
 public:
  HairHanger(CastPiece& hair, const FittedBody& body, human::Skeleton& skeleton)
      : hair_(hair),
        body_(body),
        skeleton_(skeleton),
        layer_(hair.mesh, skeleton),
        skull_(IndexOfJoint(skeleton, "skullbase")) {}

  std::vector<human::SpringChain> Run() {
    MeasureClearance();
    std::vector<human::SpringChain> chains;
    for (const Bundle& bundle : FindBundles()) {
      const std::vector<glm::vec3> path = MiddleOf(bundle);
      if (path.size() < 3 || !layer_.has_room()) {
        continue;
      }
      const std::string name = hair_.mesh.name + std::to_string(chains.size() + 1);
      chains.push_back(layer_.Lay(name, bundle.vertices, path, skull_));
    }
    return chains;
  }

 private:
  // Measures the distance of each vertex from the skin.
  void MeasureClearance() {
    for (const glm::vec3& p : hair_.mesh.positions) {
      float least = 1.0f;
      for (const glm::vec3& s : body_.skin.positions) {
        const glm::vec3 d = s - p;
        least = std::min(least, glm::dot(d, d));
      }
      clearance_.push_back(std::sqrt(least));
    }
  }

  std::vector<Bundle> FindBundles() const {
    std::vector<Bundle> bundles;
    for (Bundle& lock : Hanging()) {
      const auto same = std::find_if(bundles.begin(), bundles.end(), [&](const Bundle& bundle) {
        return glm::distance(bundle.middle, lock.middle) < kBundle;
      });
      if (same == bundles.end()) {
        bundles.push_back(std::move(lock));
      } else {
        same->vertices.insert(same->vertices.end(), lock.vertices.begin(), lock.vertices.end());
      }
    }
    return bundles;
  }

  // The connected surfaces that hang, largest first.
  std::vector<Bundle> Hanging() const {
    const std::vector<uint32_t> surface_of = ConnectedSurfaces(hair_);
    std::vector<Bundle> surfaces;
    std::vector<bool> seen(hair_.mesh.positions.size(), false);
    for (size_t i = 0; i < hair_.mesh.indices.size(); ++i) {
      const uint32_t surface = surface_of[i / 3];
      surfaces.resize(std::max<size_t>(surfaces.size(), surface + 1));
      const uint32_t v = hair_.mesh.indices[i];
      if (!seen[v]) {
        seen[v] = true;
        surfaces[surface].vertices.push_back(v);
      }
    }
    std::erase_if(surfaces, [this](const Bundle& surface) { return !Hangs(surface); });
    for (Bundle& surface : surfaces) {
      for (const uint32_t v : surface.vertices) {
        const glm::vec3& p = hair_.mesh.positions[v];
        surface.middle += glm::vec2(p.x, p.z) / static_cast<float>(surface.vertices.size());
      }
    }
    std::stable_sort(surfaces.begin(), surfaces.end(), [](const Bundle& a, const Bundle& b) {
      return a.vertices.size() > b.vertices.size();
    });
    return surfaces;
  }

  bool Hangs(const Bundle& surface) const {
    float low = 1e9f;
    float high = -1e9f;
    size_t free = 0;
    for (const uint32_t v : surface.vertices) {
      low = std::min(low, hair_.mesh.positions[v].y);
      high = std::max(high, hair_.mesh.positions[v].y);
      free += clearance_[v] > kFree ? 1 : 0;
    }
    return high - low > kLeastDrop && low < RestPosition(skeleton_, "skullbase").y &&
           2 * free > surface.vertices.size();
  }

  // The middles of level slices, from where the bundle leaves the head down to its end.
  std::vector<glm::vec3> MiddleOf(const Bundle& bundle) const {
    float low = 1e9f;
    float high = -1e9f;
    for (const uint32_t v : bundle.vertices) {
      low = std::min(low, hair_.mesh.positions[v].y);
      high = std::max(high, hair_.mesh.positions[v].y);
    }
    struct Slice {
      glm::vec3 sum{0.0f};
      int count = 0;
      int free = 0;
    };
    std::vector<Slice> slices(kBundleSlices);
    for (const uint32_t v : bundle.vertices) {
      const float share = (high - hair_.mesh.positions[v].y) / (high - low);
      Slice& slice = slices[static_cast<size_t>(std::clamp(share, 0.0f, 0.999f) * kBundleSlices)];
      slice.sum += hair_.mesh.positions[v];
      ++slice.count;
      slice.free += clearance_[v] > kFree ? 1 : 0;
    }
    std::vector<glm::vec3> path;
    for (const Slice& slice : slices) {
      if (slice.count > 0 && (!path.empty() || 2 * slice.free > slice.count)) {
        path.push_back(slice.sum / static_cast<float>(slice.count));
      }
    }
    if (!path.empty()) {
      path.back().y = low;
    }
    return path;
  }

  CastPiece& hair_;
  const FittedBody& body_;
  const human::Skeleton& skeleton_;
  ChainLayer layer_;
  size_t skull_;
  std::vector<float> clearance_;  // Metres, for each vertex.
};

// The connected surfaces of a garment that no simulated cloth moves.
std::vector<std::vector<uint32_t>> UnboundSurfaces(const Garment& garment) {
  CastPiece piece;
  piece.mesh.indices = garment.mesh.indices;
  for (uint32_t v = 0; v < garment.mesh.positions.size(); ++v) {
    piece.source.push_back(v);
  }
  const std::vector<uint32_t> surface_of = ConnectedSurfaces(piece);
  std::vector<std::vector<uint32_t>> surfaces;
  std::vector<bool> seen(piece.source.size(), false);
  std::vector<bool> bound;
  for (size_t i = 0; i < piece.mesh.indices.size(); ++i) {
    const uint32_t v = piece.mesh.indices[i];
    const uint32_t surface = surface_of[i / 3];
    surfaces.resize(std::max<size_t>(surfaces.size(), surface + 1));
    bound.resize(surfaces.size(), false);
    bound[surface] = bound[surface] || garment.cloth->vertex_triangle[v] != human::Cloth::kUnbound;
    if (!seen[v]) {
      seen[v] = true;
      surfaces[surface].push_back(v);
    }
  }
  for (size_t i = 0; i < surfaces.size(); ++i) {
    if (bound[i]) {
      surfaces[i].clear();
    }
  }
  std::erase_if(surfaces, [](const auto& surface) { return surface.empty(); });
  return surfaces;
}

// The middle of a long, thin part that hangs straight; empty if the part is not one.
std::vector<glm::vec3> ThinMiddle(const human::SkinnedMesh& mesh,
                                  const std::vector<uint32_t>& vertices) {
  glm::vec3 low(1e9f);
  glm::vec3 high(-1e9f);
  for (const uint32_t v : vertices) {
    low = glm::min(low, mesh.positions[v]);
    high = glm::max(high, mesh.positions[v]);
  }
  const glm::vec3 size = high - low;
  if (size.y < kLeastDrop || size.x > kThin || size.z > kThin) {
    return {};
  }
  const auto middle_at = [&](float from, float to) {
    glm::vec3 sum(0.0f);
    float count = 0.0f;
    for (const uint32_t v : vertices) {
      const float share = (high.y - mesh.positions[v].y) / size.y;
      if (share >= from && share <= to) {
        sum += mesh.positions[v];
        count += 1.0f;
      }
    }
    return sum / std::max(count, 1.0f);
  };
  std::vector<glm::vec3> path = {middle_at(0.0f, 0.2f), middle_at(0.4f, 0.6f),
                                 middle_at(0.8f, 1.0f)};
  path.front().y = high.y;
  path.back().y = low.y;
  return path;
}

}  // namespace

std::vector<human::SpringChain> HangHair(CastPiece& hair,
                                         const FittedBody& body,
                                         human::Skeleton& skeleton) {
  return HairHanger(hair, body, skeleton).Run();
}

std::vector<human::SpringChain> HangTails(Garment& garment, human::Skeleton& skeleton) {
  std::vector<human::SpringChain> chains;
  if (!garment.cloth || garment.cloth->vertex_triangle.size() != garment.mesh.positions.size()) {
    return chains;
  }
  ChainLayer layer(garment.mesh, skeleton);
  for (const std::vector<uint32_t>& tail : UnboundSurfaces(garment)) {
    const std::vector<glm::vec3> path = ThinMiddle(garment.mesh, tail);
    if (path.empty() || !layer.has_room()) {
      continue;
    }
    const uint32_t top = *std::max_element(tail.begin(), tail.end(), [&](uint32_t a, uint32_t b) {
      return garment.mesh.positions[a].y < garment.mesh.positions[b].y;
    });
    // Two garments of one kind may be worn.
    const std::string name = garment.mesh.name + "_tail" + std::to_string(skeleton.size());
    chains.push_back(layer.Lay(name, tail, path, garment.mesh.joints[top][0]));
    // The skirt under a belt end keeps it at its distance from the legs.
    chains.back().radius = kOverSkirt;
  }
  return chains;
}

}  // namespace lararium::import
