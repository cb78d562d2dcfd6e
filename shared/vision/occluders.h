#pragma once

// Real things that hide map points, as a designer modelled them. A model may be
// wrong, so an occluder is believed only while what it hides is indeed not seen.

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "shared/geometry/transform.h"
#include "shared/geometry/triangle_mesh.h"

namespace lararium::vision {

struct OccluderMesh {
  std::vector<Eigen::Vector3f> positions;  // map
  std::vector<uint32_t> indices;           // three for each triangle, any winding
};

// Elsewhere than it was modelled.
OccluderMesh Placed(const geometry::TriangleMesh& mesh,
                    const geometry::Similarity3& target_from_mesh);

// Triangles in a tree of boxes.
class OccluderTree {
 public:
  // CHECKs the indices.
  explicit OccluderTree(const OccluderMesh& mesh);

  struct Hit {
    float distance = 0.0f;
    Eigen::Vector3f normal;  // unit, of either side
  };
  // The first triangle in a unit direction between two distances.
  std::optional<Hit> FirstHit(const Eigen::Vector3f& eye,
                              const Eigen::Vector3f& direction,
                              float nearest,
                              float farthest) const;

  struct Nearest {
    float distance = 0.0f;
    Eigen::Vector3f point;
    Eigen::Vector3f normal;  // unit, of its triangle, of either side
  };
  // The nearest point of all triangles; nullopt: none is nearer than `within`.
  std::optional<Nearest> NearestTo(const Eigen::Vector3f& point, float within) const;

  // Whether a triangle lies between, and the point farther than bias behind the
  // triangle's plane: what lies on a surface, or nearly, is not hidden by it.
  bool Hides(const Eigen::Vector3f& eye, const Eigen::Vector3f& point, float bias) const;

 private:
  struct Triangle {
    Eigen::Vector3f corner;
    Eigen::Vector3f edge1;
    Eigen::Vector3f edge2;
    Eigen::Vector3f normal;  // unit
  };
  struct Node {
    Eigen::Vector3f least;
    Eigen::Vector3f most;
    uint32_t begin = 0;  // leaf: of its triangles; otherwise the right child (the left one is next)
    uint32_t count = 0;  // 0: no leaf
  };
  static constexpr uint32_t kLeaf = 4;    // triangles at most
  static constexpr size_t kDeepest = 48;  // halving 2^32 triangles

  // Visits the triangles that a ray meets, as (triangle, where), where > 0 in the lengths of way;
  // `last` is where it ends and may be brought nearer. A visit that returns true is the last.
  template <typename Visit>
  void ForEachHit(const Eigen::Vector3f& eye,
                  const Eigen::Vector3f& way,
                  const float& last,
                  const Visit& visit) const;

  void Build(std::span<uint32_t> order,
             std::span<const Triangle> triangles,
             std::span<const Eigen::Vector3f> middles);

  std::vector<Node> nodes_;
  std::vector<Triangle> triangles_;  // in the order of the leaves
};

// The occluders of one map, and how far each is believed.
class OccluderSet {
 public:
  static constexpr uint32_t kNone = std::numeric_limits<uint32_t>::max();

  // Nothing is known of them yet.
  void Set(std::span<const OccluderMesh> meshes);
  bool empty() const { return trees_.empty(); }

  // One that hides the point from the eye, a believed one if there is any; kNone
  // without. bias: map units, see OccluderTree.
  uint32_t HiddenBy(const Eigen::Vector3d& eye, const Eigen::Vector3d& point, double bias) const;
  bool believed(uint32_t occluder) const { return beliefs_[occluder].believed; }

  // A point that the occluder hides was looked for nevertheless.
  void Note(uint32_t occluder, bool seen);
  // Believes nothing until it is shown again; whether anything was believed.
  bool Doubt();

 private:
  struct Belief {
    float looked = 0.0f;  // points, those of long ago count less
    float seen = 0.0f;
    bool believed = false;
  };

  std::vector<OccluderTree> trees_;
  std::vector<Belief> beliefs_;  // of the trees
};

}  // namespace lararium::vision
