#pragma once

// Aligns the model of a real object with the place: first by corresponding points, then by the map
// points on its surface.

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <span>

#include "shared/core/progress.h"
#include "shared/core/status.h"
#include "shared/geometry/transform.h"
#include "shared/geometry/triangle_mesh.h"

namespace lararium::train {

// A point of a mesh in the mesh's units, and its position on the stage in metres.
struct MeshPair {
  Eigen::Vector3d on_mesh = Eigen::Vector3d::Zero();
  Eigen::Vector3d on_stage = Eigen::Vector3d::Zero();
};

// The stage_from_mesh that fits the pairs best by least squares (geometry::EstimateSimilarity). If
// scale is given it is kept; otherwise it is fitted, too. Fails with fewer than three pairs, and if
// their points nearly lie on a line, on the mesh or on the stage.
Result<geometry::Similarity3> AlignByPairs(std::span<const MeshPair> pairs,
                                           std::optional<double> scale);

// A map point and the nearest point of the model's surface, in stage metres.
struct SurfacePair {
  Eigen::Vector3d point;
  Eigen::Vector3d on_surface;
  Eigen::Vector3d normal;  // Unit normal of the surface; its sign follows the winding.
};

// A small motion of the model: rotation vector about a centre (radians), shift (metres), and the
// logarithm of a scale about the same centre.
using SurfaceMotion = Eigen::Matrix<double, 7, 1>;
geometry::Similarity3 MotionAbout(const Eigen::Vector3d& center, const SurfaceMotion& motion);

// Signed distance, in metres, of the point from the surface's plane after the motion of the model.
// The second function is its derivative by the motion at zero motion.
double PlaneDistance(const SurfacePair& pair,
                     const Eigen::Vector3d& center,
                     const SurfaceMotion& motion);
SurfaceMotion PlaneDistanceDerivative(const SurfacePair& pair, const Eigen::Vector3d& center);

struct RefineOptions {
  // Initial search distance for map points around the model, and the largest distance by which a
  // vertex may move, metres. The search distance shrinks during the refinement.
  double search_m = 0.3;
  bool keep_scale = false;
  int min_points = 30;  // Minimum number of map points on the surface.

  Status Validate() const;
};

struct RefineReport {
  geometry::Similarity3 stage_from_mesh;
  int points = 0;  // Number of map points on the surface after the refinement.
  // Root mean square distance of these points from the surface before and after the refinement.
  double rms_before_m = 0.0;
  double rms_after_m = 0.0;
  double covered = 0.0;  // Share of the surface that has such points within search_m.
  double moved_m = 0.0;  // Largest distance by which a vertex moved.
  // Number of degrees of freedom, of six or seven, that the points do not determine, for example
  // along a bare wall. The model does not move in these.
  int undetermined = 0;
};

// Moves the model so that its surface fits the map points: iterative closest points (Besl & McKay,
// "A Method for Registration of 3-D Shapes", PAMI 1992) with point-to-plane distances (Chen &
// Medioni, "Object Modelling by Registration of Multiple Range Images", IVC 1992), linearised (Low,
// "Linear Least-Squares Optimization for Point-to-Plane ICP Surface Registration", 2004). Most map
// points do not belong to the model: points beyond the search distance are ignored, nearer ones get
// Tukey's weights, and the distance shrinks. Points beside the edges of the surface are ignored,
// too. Degrees of freedom that the points do not determine are left out (Zhang, Kaess & Singh, "On
// Degeneracy of Optimization-based State Estimation Problems", ICRA 2016).
//
// points are map points in stage metres. Takes a second or two with many points. Fails if fewer
// than min_points are near, if a vertex would move farther than the search distance, if the mesh
// has no surface, and if cancelled.
Result<RefineReport> RefineAlignment(const geometry::TriangleMesh& mesh,
                                     const geometry::Similarity3& stage_from_mesh,
                                     std::span<const Eigen::Vector3d> points,
                                     const RefineOptions& options,
                                     Progress& progress);

}  // namespace lararium::train
