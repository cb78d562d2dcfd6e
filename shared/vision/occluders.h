#pragma once

// Real objects that hide map points, as modelled by a designer. A model may be wrong, so an
// occluder is trusted only while the points behind it are in fact not found in the images.

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
  std::vector<Eigen::Vector3f> positions;  // Map frame, map units.
  std::vector<uint32_t> indices;           // Three per triangle, in either winding.
};

// Transforms the mesh into the target frame.
OccluderMesh Placed(const geometry::TriangleMesh& mesh,
                    const geometry::Similarity3& target_from_mesh);

// A bounding volume hierarchy over triangles.
class OccluderTree {
 public:
  // CHECKs that the indices are in range.
  explicit OccluderTree(const OccluderMesh& mesh);

  struct Hit {
    float distance = 0.0f;
    Eigen::Vector3f normal;  // Unit normal; its sign follows the winding, not the viewer.
  };
  // The first triangle that a ray with a unit direction hits between two distances.
  std::optional<Hit> FirstHit(const Eigen::Vector3f& eye,
                              const Eigen::Vector3f& direction,
                              float nearest,
                              float farthest) const;

  struct Nearest {
    float distance = 0.0f;
    Eigen::Vector3f point;
    Eigen::Vector3f normal;  // Unit normal of the triangle; its sign follows the winding.
  };
  // The nearest point of all triangles; nullopt if none is nearer than `within`.
  std::optional<Nearest> NearestTo(const Eigen::Vector3f& point, float within) const;

  // Returns whether a triangle lies between the eye and the point, and the point lies farther than
  // bias behind the triangle's plane. The bias keeps a surface from hiding the points on it.
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
    // In a leaf: index of its first triangle. In an inner node: index of the right child; the left
    // child is the next node.
    uint32_t begin = 0;
    uint32_t count = 0;  // Number of triangles of a leaf; 0 marks an inner node.
  };
  static constexpr uint32_t kLeaf = 4;    // Maximum number of triangles in a leaf.
  static constexpr size_t kDeepest = 48;  // Stack size; enough for 2^32 triangles.

  // Calls visit(triangle, where) for the triangles that the ray eye + where * way hits, where > 0,
  // in no particular order. `last` is the end of the ray in the same unit; visit may lower it. A
  // visit that returns true ends the traversal.
  template <typename Visit>
  void ForEachHit(const Eigen::Vector3f& eye,
                  const Eigen::Vector3f& way,
                  const float& last,
                  const Visit& visit) const;

  void Build(std::span<uint32_t> order,
             std::span<const Triangle> triangles,
             std::span<const Eigen::Vector3f> middles);

  std::vector<Node> nodes_;
  std::vector<Triangle> triangles_;  // Ordered by leaf.
};

// The occluders of one map, and whether each is trusted.
class OccluderSet {
 public:
  static constexpr uint32_t kNone = std::numeric_limits<uint32_t>::max();

  // Replaces the occluders. None of them is trusted yet.
  void Set(std::span<const OccluderMesh> meshes);
  bool empty() const { return trees_.empty(); }

  // Index of an occluder that hides the point from the eye, preferably a trusted one; kNone if
  // there is none. bias is in map units, see OccluderTree::Hides.
  uint32_t HiddenBy(const Eigen::Vector3d& eye, const Eigen::Vector3d& point, double bias) const;
  bool believed(uint32_t occluder) const { return beliefs_[occluder].believed; }

  // Records whether a point that the occluder should hide was found in the image.
  void Note(uint32_t occluder, bool seen);
  // Withdraws trust from all occluders until new evidence arrives. Returns whether any was trusted.
  bool Doubt();

 private:
  struct Belief {
    float looked = 0.0f;  // Number of noted points; older ones fade.
    float seen = 0.0f;    // Number of noted points that were found, faded in the same way.
    bool believed = false;
  };

  std::vector<OccluderTree> trees_;
  std::vector<Belief> beliefs_;  // Parallel to trees_.
};

}  // namespace lararium::vision
