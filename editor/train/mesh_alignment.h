#pragma once

// Lays a model of something real where that thing is: by points that are known on both, and then
// by the map's points on its surface.

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <span>

#include "shared/core/progress.h"
#include "shared/core/status.h"
#include "shared/geometry/transform.h"
#include "shared/geometry/triangle_mesh.h"

namespace lararium::train {

// A point of a mesh, in the mesh's units, and where it is on the stage, metres.
struct MeshPair {
  Eigen::Vector3d on_mesh = Eigen::Vector3d::Zero();
  Eigen::Vector3d on_stage = Eigen::Vector3d::Zero();
};

// stage_from_mesh that fits the pairs best in the sense of least squares (geometry's
// EstimateSimilarity). scale: the one that it keeps; none: it is fitted too. Fails with fewer than
// three pairs, and where their points lie on a line or nearly so, on the mesh or on the stage.
Result<geometry::Similarity3> AlignByPairs(std::span<const MeshPair> pairs,
                                           std::optional<double> scale);

// A point of the place and the nearest one of the model's surface, stage metres.
struct SurfacePair {
  Eigen::Vector3d point;
  Eigen::Vector3d on_surface;
  Eigen::Vector3d normal;  // unit, of the surface there, of either side
};

// A small motion of the model: a rotation vector, radians, about a centre, a shift, metres, and the
// logarithm of a scale, from the centre too.
using SurfaceMotion = Eigen::Matrix<double, 7, 1>;
geometry::Similarity3 MotionAbout(const Eigen::Vector3d& center, const SurfaceMotion& motion);

// How far the point lies before the surface's plane once the model has moved, metres, and the
// derivative of that by the motion where there is none yet.
double PlaneDistance(const SurfacePair& pair,
                     const Eigen::Vector3d& center,
                     const SurfaceMotion& motion);
SurfaceMotion PlaneDistanceDerivative(const SurfacePair& pair, const Eigen::Vector3d& center);

struct RefineOptions {
  // How far from the model points are looked for at first, and how far any point of it may move;
  // metres. Towards the end a fifth of it.
  double search_m = 0.3;
  bool keep_scale = false;
  int min_points = 30;  // on its surface; fewer say nothing

  Status Validate() const;
};

struct RefineReport {
  geometry::Similarity3 stage_from_mesh;
  int points = 0;  // that lie on the surface in the end
  // Root mean square of their distances from the surface, where the model lay and where it lies.
  double rms_before_m = 0.0;
  double rms_after_m = 0.0;
  double covered = 0.0;  // share of the surface with such points within search_m
  double moved_m = 0.0;  // farthest that a vertex moved
  // Ways to move, of the six or seven, that the points say nothing of: along a bare wall, say. The
  // model stays in those as it lay.
  int undetermined = 0;
};

// The model moved so that its surface lies among the map's points: iterative closest points (Besl
// & McKay, "A Method for Registration of 3-D Shapes", PAMI 1992) with distances from the surface's
// planes (Chen & Medioni, "Object Modelling by Registration of Multiple Range Images", IVC 1992),
// linearised (Low, "Linear Least-Squares Optimization for Point-to-Plane ICP Surface Registration",
// 2004). Most points of a map are no part of the model: those beyond the search distance have no
// say, nearer ones by Tukey's weights, and the distance shrinks. Points that lie beside the
// surface's edges rather than before it have none either. Ways to move that the points do not
// determine are left out (Zhang, Kaess & Singh, "On Degeneracy of Optimization-based State
// Estimation Problems", ICRA 2016).
//
// points: of the map, in stage metres. Takes a second or two with many. Fails where fewer than
// min_points are near, where a vertex would move farther than the search distance, where the mesh
// has no surface, and when cancelled.
Result<RefineReport> RefineAlignment(const geometry::TriangleMesh& mesh,
                                     const geometry::Similarity3& stage_from_mesh,
                                     std::span<const Eigen::Vector3d> points,
                                     const RefineOptions& options,
                                     Progress& progress);

}  // namespace lararium::train
