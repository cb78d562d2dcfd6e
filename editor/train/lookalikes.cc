#include "editor/train/lookalikes.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>

#include "editor/train/budget.h"
#include "shared/core/median.h"
#include "shared/core/parallel.h"
#include "shared/core/random.h"
#include "shared/geometry/transform.h"
#include "shared/vision/descriptor_forest.h"

namespace lararium::train {
namespace {

using Eigen::Vector3d;
using geometry::Similarity3;
using vision::Observation;
using vision::SceneDatabase;

constexpr uint32_t kSimilar = 200 * 200;  // Squared distance of similar descriptors.
constexpr size_t kNeighbours = 48;        // Number of descriptors that are compared for each point.
constexpr int kChecks = 256;
constexpr int kMostMotions = 8;  // Number of motions that are searched for each keyframe.
constexpr int kSamples = 1500;   // Number of triples that are tried for each motion.
// A motion must explain this number of points and this share of those that the keyframe observed.
constexpr size_t kLeastPoints = 24;
constexpr double kLeastShare = 0.15;
constexpr double kLargestError = 0.02;  // Largest error of a point, as a share of the depth.
// A point that moves by a smaller share of the depth is the same point.
constexpr double kLeastShift = 0.1;
constexpr double kScaleTolerance = 0.05;
constexpr int kCellPx = 32;

// A point and another one that looks like it.
struct Twin {
  uint32_t point = 0;
  uint32_t other = 0;
};

// [points]: Points with similar descriptors.
std::vector<std::vector<uint32_t>> SimilarPoints(const SceneDatabase& db) {
  constexpr size_t kJobs = 8;
  std::vector<std::vector<uint32_t>> similar(db.points.size());
  ParallelFor(kJobs, [&](size_t job) {
    vision::ForestSearcher searcher(db.forest, db.descriptors);
    std::array<vision::Neighbour, kNeighbours> found;
    for (size_t point = job; point < db.points.size(); point += kJobs) {
      const size_t count =
          searcher.Search(db.descriptors[db.descriptor_begin[point]], kChecks, found);
      std::vector<uint32_t>& others = similar[point];
      for (size_t i = 0; i < count && found[i].squared_distance < kSimilar; ++i) {
        const uint32_t other = db.descriptor_point[found[i].descriptor];
        if (other != point && std::find(others.begin(), others.end(), other) == others.end()) {
          others.push_back(other);
        }
      }
    }
  });
  return similar;
}

// Searches one keyframe's points for motions onto their look-alikes.
class MotionSearch {
 public:
  MotionSearch(const SceneDatabase& db, std::vector<Twin> twins, double depth, uint64_t seed)
      : db_(db), twins_(std::move(twins)), depth_(depth), random_(seed) {}

  // Calls found(points) with the points that each motion explains.
  template <typename Found>
  void Run(size_t least, Found found) {
    for (int i = 0; i < kMostMotions && twins_.size() >= least; ++i) {
      std::vector<uint32_t> best;
      for (int sample = 0; sample < kSamples; ++sample) {
        if (const std::optional<Similarity3> motion = Sample()) {
          std::vector<uint32_t> points = Explained(*motion);
          if (points.size() > best.size()) {
            best = std::move(points);
            best_motion_ = *motion;
          }
        }
      }
      if (best.size() < least) {
        return;
      }
      found(best);
      std::erase_if(twins_, [&](const Twin& twin) { return Fits(best_motion_, twin); });
    }
  }

 private:
  Vector3d Position(uint32_t point) const { return db_.points[point].cast<double>(); }

  // The motion of three random twins, if they move as one body and far enough.
  std::optional<Similarity3> Sample() {
    std::array<Vector3d, 3> from;
    std::array<Vector3d, 3> to;
    for (size_t i = 0; i < 3; ++i) {
      const Twin& twin = twins_[random_.Below(static_cast<uint32_t>(twins_.size()))];
      from[i] = Position(twin.point);
      to[i] = Position(twin.other);
      if ((to[i] - from[i]).norm() < kLeastShift * depth_) {
        return std::nullopt;
      }
      for (size_t j = 0; j < i; ++j) {
        const double before = (from[i] - from[j]).norm();
        if (before < kLeastShift * depth_ ||
            std::abs((to[i] - to[j]).norm() - before) > kScaleTolerance * before) {
          return std::nullopt;
        }
      }
    }
    const Result<Similarity3> motion = geometry::EstimateSimilarity(to, from);
    return motion.ok() ? std::optional(*motion) : std::nullopt;
  }

  bool Fits(const Similarity3& motion, const Twin& twin) const {
    return (motion * Position(twin.point) - Position(twin.other)).squaredNorm() <
           kLargestError * kLargestError * depth_ * depth_;
  }

  // Ascending, without duplicates, because twins_ is sorted by point.
  std::vector<uint32_t> Explained(const Similarity3& motion) const {
    std::vector<uint32_t> points;
    for (const Twin& twin : twins_) {
      if ((points.empty() || points.back() != twin.point) && Fits(motion, twin)) {
        points.push_back(twin.point);
      }
    }
    return points;
  }

  const SceneDatabase& db_;
  std::vector<Twin> twins_;
  double depth_;
  Random random_;
  Similarity3 best_motion_;
};

double MedianDepth(const SceneDatabase& db, std::span<const Observation> view) {
  std::vector<double> depths;
  for (const Observation& o : view) {
    depths.push_back(
        (db.keyframes[o.keyframe].camera_from_map * db.points[o.point].cast<double>()).z());
  }
  return Median(std::move(depths));
}

// Counts marked points in the cells of an image.
class MarkGrid {
 public:
  MarkGrid(const SceneDatabase& db,
           std::span<const Observation> view,
           std::span<const uint8_t> marks)
      : columns_(db.camera.width / kCellPx + 3),
        cells_(static_cast<size_t>(columns_ * (db.camera.height / kCellPx + 3))) {
    for (const Observation& o : view) {
      Cell& cell = cells_[static_cast<size_t>(Index(o))];
      ++cell.points;
      cell.marked += marks[o.point] != 0 ? 1 : 0;
    }
  }

  // Whether most points in the cell of the observation and around it are marked.
  bool MostMarked(const Observation& o) const {
    Cell sum;
    for (int y = -1; y <= 1; ++y) {
      for (int x = -1; x <= 1; ++x) {
        const Cell& cell = cells_[static_cast<size_t>(Index(o) + y * columns_ + x)];
        sum.points += cell.points;
        sum.marked += cell.marked;
      }
    }
    return 2 * sum.marked > sum.points;
  }

 private:
  struct Cell {
    int points = 0;
    int marked = 0;
  };

  // There is a border of one cell. Observations lie within half a pixel of the image.
  int Index(const Observation& o) const {
    return (static_cast<int>(std::max(o.y, 0.0f)) / kCellPx + 1) * columns_ +
           static_cast<int>(std::max(o.x, 0.0f)) / kCellPx + 1;
  }

  int columns_;
  std::vector<Cell> cells_;
};

// Marks points that are not marked, if most of their neighbours are in most images.
void MarkAmongMarked(const SceneDatabase& db,
                     std::span<const std::span<const Observation>> views,
                     std::vector<uint8_t>& marks) {
  std::vector<uint32_t> among(marks.size(), 0);
  std::vector<uint32_t> seen(marks.size(), 0);
  for (const std::span<const Observation> view : views) {
    const MarkGrid grid(db, view, marks);
    for (const Observation& o : view) {
      ++seen[o.point];
      among[o.point] += grid.MostMarked(o) ? 1 : 0;
    }
  }
  for (size_t point = 0; point < marks.size(); ++point) {
    marks[point] = marks[point] != 0 || 2 * among[point] > seen[point] ? 1 : 0;
  }
}

}  // namespace

std::vector<uint8_t> FindLookalikes(const SceneDatabase& db, uint64_t seed) {
  const std::vector<std::vector<uint32_t>> similar = SimilarPoints(db);
  std::vector<std::span<const Observation>> views;
  for (uint32_t keyframe = 0; keyframe < db.keyframes.size(); ++keyframe) {
    views.push_back(ObservationsOf(db, keyframe));
  }
  std::vector<std::vector<uint32_t>> explained(views.size());  // [keyframes]
  ParallelFor(views.size(), [&](size_t view) {
    std::vector<Twin> twins;
    for (const Observation& o : views[view]) {
      for (const uint32_t other : similar[o.point]) {
        twins.push_back({o.point, other});
      }
    }
    const auto least = std::max(
        kLeastPoints, static_cast<size_t>(kLeastShare * static_cast<double>(views[view].size())));
    MotionSearch(db, std::move(twins), MedianDepth(db, views[view]), seed)
        .Run(least, [&](const std::vector<uint32_t>& points) {
          explained[view].insert(explained[view].end(), points.begin(), points.end());
        });
  });
  std::vector<uint8_t> marks(db.points.size(), 0);
  bool any = false;
  for (const std::vector<uint32_t>& points : explained) {
    for (const uint32_t point : points) {
      marks[point] = 1;
      any = true;
    }
  }
  if (!any) {
    return {};
  }
  MarkAmongMarked(db, views, marks);
  return marks;
}

}  // namespace lararium::train
