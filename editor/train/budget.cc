#include "editor/train/budget.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>

#include "editor/train/database_builder.h"
#include "shared/core/check.h"
#include "shared/core/parallel.h"
#include "shared/vision/localizer.h"

namespace lararium::train {
namespace {

using geometry::Rigid3;
using vision::Descriptor;
using vision::Observation;
using vision::SceneDatabase;

constexpr int kColumns = 8;  // Grid of image parts, each of which needs its own points.
constexpr int kRows = 6;
constexpr uint32_t kNone = 0xffffffff;

// ------------------------------------------------------------ points

// [points]: How much the point's descriptor differs from those of other points, 0..1.
std::vector<float> Distinctiveness(const SceneDatabase& db) {
  // Usual squared distance between two descriptors of one point from different views.
  constexpr float kUsual = 200.0f * 200.0f;
  constexpr int kChecks = 48;
  constexpr size_t kJobs = 16;
  CHECK(db.descriptors.empty() || !db.forest.roots.empty());
  std::vector<float> distinct(db.points.size(), 0.0f);
  ParallelFor(kJobs, [&](size_t job) {
    vision::ForestSearcher searcher(db.forest, db.descriptors);
    std::array<vision::Neighbour, 12> neighbours;
    const size_t end = db.points.size() * (job + 1) / kJobs;
    for (size_t point = db.points.size() * job / kJobs; point < end; ++point) {
      if (db.descriptor_begin[point] == db.descriptor_begin[point + 1]) {
        continue;
      }
      const size_t found =
          searcher.Search(db.descriptors[db.descriptor_begin[point]], kChecks, neighbours);
      float other = 2.0f * 512.0f * 512.0f;  // Squared distance of orthogonal descriptors.
      for (size_t i = 0; i < found; ++i) {
        if (db.descriptor_point[neighbours[i].descriptor] != point) {
          other = static_cast<float>(neighbours[i].squared_distance);
          break;
        }
      }
      distinct[point] = other / (other + kUsual);
    }
  });
  return distinct;
}

// Chooses points greedily. A point's gain is the sum over its observations of
//   weight / (1 + weight chosen so far in this part of the image) * hunger,
// where hunger falls to 1 as the keyframe gets enough points to be located.
class PointChooser {
 public:
  explicit PointChooser(const SceneDatabase& db)
      : begin_(db.points.size() + 1, 0),
        cells_(db.keyframes.size() * kColumns * kRows, 0.0f),
        keyframes_(db.keyframes.size(), 0.0f) {
    for (const Observation& o : db.observations) {
      ++begin_[o.point + 1];
    }
    for (size_t i = 1; i < begin_.size(); ++i) {
      begin_[i] += begin_[i - 1];
    }
    const std::vector<float> distinct = Distinctiveness(db);
    observations_.resize(db.observations.size());
    std::vector<uint32_t> next(begin_.begin(), begin_.end() - 1);
    for (const Observation& o : db.observations) {
      observations_[next[o.point]++] = {CellOf(db.camera, o),
                                        distinct[o.point] * ScaleWeight(o.scale)};
    }
  }

  std::vector<uint32_t> Choose(size_t count) {
    struct Candidate {
      float gain;  // Upper bound of the gain.
      uint32_t point;
      bool operator<(const Candidate& other) const {
        return gain != other.gain ? gain < other.gain : point > other.point;
      }
    };
    std::priority_queue<Candidate> queue;
    for (uint32_t point = 0; point + 1 < begin_.size(); ++point) {
      queue.push({Gain(point), point});
    }
    std::vector<uint32_t> chosen;
    while (chosen.size() < count && !queue.empty()) {
      const Candidate best = queue.top();
      queue.pop();
      // Gains only fall, so a candidate whose gain is not below the next upper bound is the best.
      const float gain = Gain(best.point);
      if (!queue.empty() && gain < queue.top().gain) {
        queue.push({gain, best.point});
        continue;
      }
      chosen.push_back(best.point);
      for (uint32_t s = begin_[best.point]; s < begin_[best.point + 1]; ++s) {
        cells_[observations_[s].cell] += observations_[s].weight;
        keyframes_[observations_[s].cell / (kColumns * kRows)] += observations_[s].weight;
      }
    }
    std::sort(chosen.begin(), chosen.end());
    return chosen;
  }

 private:
  struct CellObservation {
    uint32_t cell = 0;
    float weight = 0.0f;
  };

  static uint32_t CellOf(const geometry::CameraModel& camera, const Observation& o) {
    const int column = std::clamp(static_cast<int>(o.x * kColumns / camera.width), 0, kColumns - 1);
    const int row = std::clamp(static_cast<int>(o.y * kRows / camera.height), 0, kRows - 1);
    return (o.keyframe * kRows + static_cast<uint32_t>(row)) * kColumns +
           static_cast<uint32_t>(column);
  }

  // Features with a scale below kFindable are only found in an enlarged image.
  static float ScaleWeight(float scale) {
    constexpr float kFindable = 2.0f;
    return std::min(1.0f, scale / kFindable);
  }

  // A pose needs about fifteen points, and about half of the points are found in a frame.
  static float Hunger(float has) {
    constexpr float kEnough = 40.0f;
    constexpr float kMost = 9.0f;
    return 1.0f + (kMost - 1.0f) * std::max(0.0f, 1.0f - has / kEnough);
  }

  float Gain(uint32_t point) const {
    float gain = 0.0f;
    for (uint32_t s = begin_[point]; s < begin_[point + 1]; ++s) {
      const uint32_t cell = observations_[s].cell;
      gain += observations_[s].weight / (1.0f + cells_[cell]) *
              Hunger(keyframes_[cell / (kColumns * kRows)]);
    }
    return gain;
  }

  std::vector<uint32_t> begin_;  // [points + 1]: Ranges of observations_.
  std::vector<CellObservation> observations_;
  // Weight chosen so far, per image part and per keyframe.
  std::vector<float> cells_;      // [keyframes][rows][columns]
  std::vector<float> keyframes_;  // [keyframes]
};

// ------------------------------------------------------------ images

// The view of a point in one observation, as far as it matters for the patches of PatchTracker.
struct View {
  uint32_t keyframe = 0;
  Eigen::Vector3f direction;  // Unit direction from the point to the camera.
  float scale = 0.0f;
};

bool LooksAlike(const View& a, const View& b) {
  constexpr float kCosine = 0.966f;  // 15 degrees
  constexpr float kScaleRatio = 1.4f;
  return a.direction.dot(b.direction) > kCosine && a.scale < kScaleRatio * b.scale &&
         b.scale < kScaleRatio * a.scale;
}

std::vector<std::vector<View>> ViewsOfPoints(const SceneDatabase& db) {
  std::vector<Eigen::Vector3d> centers;
  for (const vision::Keyframe& keyframe : db.keyframes) {
    centers.push_back(keyframe.camera_from_map.Center());
  }
  std::vector<std::vector<View>> views(db.points.size());
  for (const Observation& o : db.observations) {
    const Eigen::Vector3d away = centers[o.keyframe] - db.points[o.point].cast<double>();
    views[o.point].push_back({o.keyframe, away.stableNormalized().cast<float>(), o.scale});
  }
  return views;
}

// ------------------------------------------------------------ pruning

// Indices of the descriptors of a point that are kept.
std::vector<uint32_t> DescriptorsWithin(const SceneDatabase& db, uint32_t point, int most) {
  const uint32_t first = db.descriptor_begin[point];
  const std::span<const Descriptor> all =
      std::span(db.descriptors).subspan(first, db.descriptor_begin[point + 1] - first);
  std::vector<uint32_t> indices;
  if (most == 0 || all.size() <= static_cast<size_t>(most)) {
    for (uint32_t d = 0; d < all.size(); ++d) {
      indices.push_back(first + d);
    }
    return indices;
  }
  std::vector<Descriptor> kept;
  AddDistinctDescriptors(all, static_cast<size_t>(most), kept);
  for (const Descriptor& descriptor : kept) {
    const auto found = std::find(all.begin(), all.end(), descriptor);
    indices.push_back(first + static_cast<uint32_t>(found - all.begin()));
  }
  return indices;
}

// Appends a descriptor of `from` to the point of `to`, with its sessions if `from` has them.
void AddDescriptor(const SceneDatabase& from,
                   uint32_t descriptor,
                   uint32_t point,
                   SceneDatabase& to) {
  to.descriptors.push_back(from.descriptors[descriptor]);
  to.descriptor_point.push_back(point);
  if (!from.descriptor_sessions.empty()) {
    to.descriptor_sessions.push_back(from.descriptor_sessions[descriptor]);
  }
}

// The database with only the given points, which must be ascending.
SceneDatabase WithPoints(const SceneDatabase& db,
                         std::span<const uint32_t> points,
                         int max_descriptors) {
  SceneDatabase kept;
  kept.camera = db.camera;
  kept.readout = db.readout;
  kept.mean_reprojection_error_px = db.mean_reprojection_error_px;
  kept.keyframes = db.keyframes;
  kept.descriptor_begin.push_back(0);
  std::vector<uint32_t> new_index(db.points.size(), kNone);
  for (const uint32_t point : points) {
    const auto index = static_cast<uint32_t>(kept.points.size());
    new_index[point] = index;
    kept.points.push_back(db.points[point]);
    kept.normals.push_back(db.normals[point]);
    kept.observation_counts.push_back(db.observation_counts[point]);
    kept.session_masks.push_back(db.session_masks[point]);
    if (!db.colours.empty()) {
      kept.colours.push_back(db.colours[point]);
    }
    if (!db.lookalikes.empty()) {
      kept.lookalikes.push_back(db.lookalikes[point]);
    }
    for (const uint32_t descriptor : DescriptorsWithin(db, point, max_descriptors)) {
      AddDescriptor(db, descriptor, index, kept);
    }
    kept.descriptor_begin.push_back(static_cast<uint32_t>(kept.descriptors.size()));
  }
  for (Observation o : db.observations) {
    o.point = new_index[o.point];
    if (o.point != kNone) {
      kept.observations.push_back(o);
    }
  }
  return kept;
}

// ------------------------------------------------------------ recall

struct HeldOutView {
  uint32_t keyframe = 0;
  vision::Features finest;  // Features as training extracts them.
  vision::Features query;   // Features as the player extracts them.
};

Result<std::vector<HeldOutView>> HeldOutViews(const SceneDatabase& db, size_t stride) {
  std::vector<HeldOutView> views;
  size_t with_image = 0;
  for (uint32_t k = 0; k < db.keyframes.size(); ++k) {
    if (!db.keyframes[k].grey.empty() && with_image++ % stride == stride / 2) {
      views.emplace_back().keyframe = k;
    }
  }
  if (views.empty()) {
    return Status::Error("budget", "too few keyframes have an image to measure recall",
                         "train the place again, without leaving images out");
  }
  std::vector<Status> problems(views.size());
  ParallelFor(views.size(), [&](size_t i) {
    const cv::Mat& grey = db.keyframes[views[i].keyframe].grey;
    vision::FeatureOptions options;
    options.contrast_threshold = 0.02f;
    auto finest = vision::ExtractFeatures(grey, options);
    options = vision::FeatureOptions();
    options.first_octave = 0;
    options.max_features = 1000;
    auto query = vision::ExtractFeatures(grey, options);
    if (finest.ok() && query.ok()) {
      views[i].finest = std::move(*finest);
      views[i].query = std::move(*query);
    } else {
      problems[i] = finest.ok() ? query.status() : finest.status();
    }
  });
  for (const Status& problem : problems) {
    LARARIUM_RETURN_IF_ERROR(problem);
  }
  return views;
}

// Sets marks[descriptor] for descriptors that came from the view: those of points that the view
// observes and that equal a feature at the same pixel, apart from compression artefacts.
void MarkDescriptorsOf(const SceneDatabase& db, const HeldOutView& view, std::vector<bool>& marks) {
  constexpr float kSamePx = 1.0f;
  constexpr uint32_t kSame = 80 * 80;
  std::vector<uint32_t> order(view.finest.size());  // Features sorted by row.
  for (uint32_t f = 0; f < order.size(); ++f) {
    order[f] = f;
  }
  const std::vector<vision::Keypoint>& keypoints = view.finest.keypoints;
  std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
    return keypoints[a].y != keypoints[b].y ? keypoints[a].y < keypoints[b].y : a < b;
  });
  for (const Observation& o : ObservationsOf(db, view.keyframe)) {
    auto f = std::lower_bound(order.begin(), order.end(), o.y - kSamePx,
                              [&](uint32_t i, float y) { return keypoints[i].y < y; });
    for (; f != order.end() && keypoints[*f].y < o.y + kSamePx; ++f) {
      for (uint32_t d = db.descriptor_begin[o.point];
           std::abs(keypoints[*f].x - o.x) < kSamePx && d < db.descriptor_begin[o.point + 1]; ++d) {
        marks[d] = marks[d] ||
                   vision::SquaredDistance(db.descriptors[d], view.finest.descriptors[*f]) < kSame;
      }
    }
  }
}

// The map without the descriptors and observations of the held-out views and without points that
// are then left without any. Keyframes keep their index.
SceneDatabase WithoutViews(const SceneDatabase& db, std::span<const HeldOutView> views) {
  std::vector<bool> of_views(db.descriptors.size(), false);
  std::vector<bool> held_out(db.keyframes.size(), false);
  for (const HeldOutView& view : views) {
    MarkDescriptorsOf(db, view, of_views);
    held_out[view.keyframe] = true;
  }
  SceneDatabase rest = db;
  std::erase_if(rest.observations, [&](const Observation& o) { return held_out[o.keyframe]; });
  std::vector<uint32_t> counts(db.points.size(), 0);
  for (const Observation& o : rest.observations) {
    ++counts[o.point];
  }
  rest.descriptors.clear();
  rest.descriptor_point.clear();
  rest.descriptor_sessions.clear();
  rest.descriptor_begin = {0};
  std::vector<uint32_t> points;
  for (uint32_t point = 0; point < db.points.size(); ++point) {
    const size_t before = rest.descriptors.size();
    for (uint32_t d = db.descriptor_begin[point]; d < db.descriptor_begin[point + 1]; ++d) {
      if (!of_views[d]) {
        AddDescriptor(db, d, point, rest);
      }
    }
    rest.descriptor_begin.push_back(static_cast<uint32_t>(rest.descriptors.size()));
    if (counts[point] >= 2 && rest.descriptors.size() > before) {
      points.push_back(point);
    }
  }
  return WithPoints(rest, points, 0);
}

double MeanDifferencePx(const SceneDatabase& db, uint32_t keyframe, const Rigid3& found) {
  double sum = 0.0;
  size_t count = 0;
  for (const Observation& o : ObservationsOf(db, keyframe)) {
    const Eigen::Vector3d point = db.points[o.point].cast<double>();
    const auto expected = db.camera.Project(db.keyframes[keyframe].camera_from_map * point);
    const auto actual = db.camera.Project(found * point);
    if (expected && actual) {
      sum += (*actual - *expected).norm();
      ++count;
    }
  }
  return count == 0 ? 0.0 : sum / static_cast<double>(count);
}

BudgetRow MeasureBudget(const SceneDatabase& db,
                        const SceneDatabase& rest,
                        std::span<const HeldOutView> views,
                        const BudgetOptions& options) {
  BudgetRow row;
  {
    const SceneDatabase whole = Prune(db, options);
    row.points = static_cast<int>(whole.points.size());
    row.descriptors = static_cast<int>(whole.descriptors.size());
    row.images =
        static_cast<int>(std::count_if(whole.keyframes.begin(), whole.keyframes.end(),
                                       [](const vision::Keyframe& k) { return !k.grey.empty(); }));
    row.bytes = vision::SerializeSceneDatabase(whole).size();
  }
  const SceneDatabase pruned = Prune(rest, options);
  vision::Localizer localizer(pruned, vision::LocalizerOptions());
  std::vector<double> differences;
  for (const HeldOutView& view : views) {
    const vision::Location location = localizer.Locate(view.query, db.camera);
    if (location.camera_from_map) {
      row.mean_inliers += location.inliers;
      differences.push_back(MeanDifferencePx(db, view.keyframe, *location.camera_from_map));
    }
  }
  row.recall = static_cast<double>(differences.size()) / static_cast<double>(views.size());
  if (!differences.empty()) {
    const auto middle = differences.begin() + static_cast<ptrdiff_t>(differences.size() / 2);
    std::nth_element(differences.begin(), middle, differences.end());
    row.median_difference_px = *middle;
    row.mean_inliers /= static_cast<double>(differences.size());
  }
  return row;
}

}  // namespace

Status BudgetOptions::Validate() const {
  constexpr std::string_view kOptions = "budget";
  if (max_points < 100) {
    return Status::Error(kOptions, "max_points must be at least 100");
  }
  if (max_descriptors_per_point < 0) {
    return Status::Error(kOptions, "max_descriptors_per_point must not be negative");
  }
  if (!(image_coverage >= 0.0 && image_coverage <= 1.0)) {
    return Status::Error(kOptions, "image_coverage must lie between 0 and 1");
  }
  return Status();
}

std::span<const Observation> ObservationsOf(const SceneDatabase& db, uint32_t keyframe) {
  const auto less = [](const Observation& o, uint32_t wanted) { return o.keyframe < wanted; };
  const auto first =
      std::lower_bound(db.observations.begin(), db.observations.end(), keyframe, less);
  const auto last = std::lower_bound(first, db.observations.end(), keyframe + 1, less);
  return {first, last};
}

std::vector<uint32_t> ChoosePoints(const SceneDatabase& database, size_t count) {
  if (count >= database.points.size()) {
    std::vector<uint32_t> all(database.points.size());
    for (uint32_t i = 0; i < all.size(); ++i) {
      all[i] = i;
    }
    return all;
  }
  return PointChooser(database).Choose(count);
}

std::vector<uint32_t> ChooseImages(const SceneDatabase& database, double coverage) {
  const std::vector<std::vector<View>> views = ViewsOfPoints(database);
  // shows[k]: Observations that look like those in keyframe k, as (point, index into views[point]).
  std::vector<std::vector<std::pair<uint32_t, uint32_t>>> shows(database.keyframes.size());
  for (uint32_t point = 0; point < views.size(); ++point) {
    for (const View& image : views[point]) {
      for (uint32_t v = 0; v < views[point].size(); ++v) {
        if (!database.keyframes[image.keyframe].grey.empty() &&
            LooksAlike(image, views[point][v])) {
          shows[image.keyframe].emplace_back(point, v);
        }
      }
    }
  }
  std::vector<std::vector<bool>> shown(views.size());
  for (size_t point = 0; point < views.size(); ++point) {
    shown[point].resize(views[point].size(), false);
  }
  const auto gain = [&](uint32_t k) {
    return std::count_if(shows[k].begin(), shows[k].end(), [&](const auto& observation) {
      return !shown[observation.first][observation.second];
    });
  };
  const double wanted = coverage * static_cast<double>(database.observations.size());
  double covered = 0.0;
  std::vector<uint32_t> chosen;
  while (covered < wanted) {
    uint32_t best = 0;
    ptrdiff_t most = 0;
    for (uint32_t k = 0; k < shows.size(); ++k) {
      if (const ptrdiff_t more = gain(k); more > most) {
        most = more;
        best = k;
      }
    }
    if (most == 0) {
      break;
    }
    for (const auto& [point, v] : shows[best]) {
      shown[point][v] = true;
    }
    covered += static_cast<double>(most);
    chosen.push_back(best);
  }
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

SceneDatabase Prune(const SceneDatabase& database, const BudgetOptions& options) {
  CHECK(options.Validate().ok());
  const std::vector<uint32_t> points =
      ChoosePoints(database, static_cast<size_t>(options.max_points));
  SceneDatabase pruned = WithPoints(database, points, options.max_descriptors_per_point);
  if (options.image_coverage < 1.0) {
    std::vector<bool> keeps(pruned.keyframes.size(), false);
    for (const uint32_t k : ChooseImages(pruned, options.image_coverage)) {
      keeps[k] = true;
    }
    for (size_t k = 0; k < keeps.size(); ++k) {
      if (!keeps[k]) {
        pruned.keyframes[k].grey = cv::Mat();
      }
    }
  }
  if (options.pictured_observations) {
    std::erase_if(pruned.observations, [&pruned](const Observation& o) {
      return pruned.keyframes[o.keyframe].grey.empty();
    });
  }
  vision::ForestOptions forest;
  forest.seed = options.seed;
  pruned.forest = vision::BuildForest(pruned.descriptors, forest);
  return pruned;
}

Result<std::vector<BudgetRow>> MeasureBudgets(const SceneDatabase& database,
                                              std::span<const BudgetOptions> budgets,
                                              size_t stride,
                                              Progress& progress) {
  CHECK(stride >= 2);
  for (const BudgetOptions& options : budgets) {
    LARARIUM_RETURN_IF_ERROR(options.Validate());
  }
  progress.Report("views", 0.0);
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<HeldOutView> views, HeldOutViews(database, stride));
  SceneDatabase rest = WithoutViews(database, views);
  rest.forest = vision::BuildForest(rest.descriptors, vision::ForestOptions());
  std::vector<BudgetRow> rows;
  for (const BudgetOptions& options : budgets) {
    if (progress.Cancelled()) {
      return Status::Error("budget", "cancelled");
    }
    progress.Report("measuring",
                    static_cast<double>(rows.size()) / static_cast<double>(budgets.size()));
    rows.push_back(MeasureBudget(database, rest, views, options));
  }
  return rows;
}

}  // namespace lararium::train
