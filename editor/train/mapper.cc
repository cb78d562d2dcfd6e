#include "editor/train/mapper.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "editor/train/bundle_adjustment.h"
#include "editor/train/two_view.h"

namespace lararium::train {
namespace {

using geometry::Rigid3;

// The logarithm of a focal length, and its standard deviation.
struct KnownFocal {
  double log = 0.0;
  double deviation = 0.0;
};

// Sets of focal lengths that may be one and the same, the largest first. Autofocus changes them by
// a few percent.
std::vector<std::vector<uint32_t>> AgreeingFocals(std::span<const KnownFocal> focals) {
  constexpr double kBreathing = 0.03;
  constexpr double kDeviations = 3.0;
  std::vector<uint32_t> left(focals.size());
  std::iota(left.begin(), left.end(), 0);
  std::vector<std::vector<uint32_t>> sets;
  while (!left.empty()) {
    std::vector<uint32_t> best;
    for (const uint32_t middle : left) {
      std::vector<uint32_t> set;
      for (const uint32_t other : left) {
        const double doubt = std::hypot(focals[middle].deviation, focals[other].deviation);
        if (other == middle || std::abs(focals[other].log - focals[middle].log) <
                                   std::max(kBreathing, kDeviations * doubt)) {
          set.push_back(other);
        }
      }
      if (set.size() > best.size()) {
        best = std::move(set);
      }
    }
    std::erase_if(left,
                  [&](uint32_t i) { return std::binary_search(best.begin(), best.end(), i); });
    sets.push_back(std::move(best));
  }
  return sets;
}

class Mapper {
 public:
  Mapper(Reconstruction& reconstruction,
         std::span<const VerifiedPair> pairs,
         const MapperOptions& options,
         Progress& progress,
         Log& log)
      : reconstruction_(reconstruction),
        pairs_(pairs),
        options_(options),
        progress_(progress),
        log_(log),
        first_cameras_(reconstruction.cameras().begin(), reconstruction.cameras().end()),
        first_camera_of_image_(reconstruction.camera_of_image()) {}

  std::optional<InitialPair> Run() {
    constexpr size_t kMaxStarts = 20;
    constexpr int kMaxMaps = 3;
    const std::vector<size_t> starts = RankInitialPairs();
    int maps = 0;
    for (size_t i = 0; i < std::min(kMaxStarts, starts.size()) && maps < kMaxMaps; ++i) {
      const VerifiedPair& pair = pairs_[starts[i]];
      if (BestCovers(pair.images)) {
        continue;
      }
      if (!StartFromBestPose(pair)) {
        continue;
      }
      Grow();
      if (!options_.draft) {
        Finish();
      }
      if (progress_.Cancelled()) {
        return std::nullopt;
      }
      if (!Sound()) {
        continue;
      }
      ++maps;
      KeepIfBest();
      if (2 * best_->LocatedImages().size() > best_->image_count()) {
        break;
      }
    }
    Forget();
    if (!best_) {
      return std::nullopt;
    }
    reconstruction_ = std::move(*best_);
    return best_anchors_;
  }

 private:
  // Indices of pairs that could start a map, best first: many matches at a good angle. Beyond 10
  // degrees a wider angle does not make up for fewer matches.
  std::vector<size_t> RankInitialPairs() const {
    constexpr double kGoodAngle = 0.175;
    std::vector<std::pair<double, size_t>> ranked;
    for (size_t i = 0; i < pairs_.size(); ++i) {
      if (pairs_[i].matches.size() >= options_.min_initial_points &&
          pairs_[i].median_angle >= options_.min_initial_angle) {
        ranked.emplace_back(-static_cast<double>(pairs_[i].matches.size()) *
                                std::min(pairs_[i].median_angle, kGoodAngle),
                            i);
      }
    }
    std::sort(ranked.begin(), ranked.end());
    std::vector<size_t> order;
    for (const auto& [score, index] : ranked) {
      order.push_back(index);
    }
    return order;
  }

  bool BestCovers(const ImagePair& images) const {
    return best_ && best_->Located(images.a) && best_->Located(images.b);
  }

  // Returns whether the result is a map and not only a pair with a few stray points.
  bool Sound() const {
    return reconstruction_.LocatedImages().size() >=
               std::min<size_t>(3, reconstruction_.image_count()) &&
           reconstruction_.PointCount() >= options_.min_initial_points;
  }

  void KeepIfBest() {
    if (!best_ || reconstruction_.LocatedImages().size() > best_->LocatedImages().size()) {
      best_ = reconstruction_;
      best_anchors_ = anchors_;
    }
  }

  void Forget() {
    for (const uint32_t image : reconstruction_.LocatedImages()) {
      reconstruction_.Unlocate(image);
    }
    reconstruction_.SetCameras(first_cameras_, first_camera_of_image_);
  }

  // Two views of a plane allow two maps. Further images decide which one is right.
  bool StartFromBestPose(const VerifiedPair& pair) {
    const std::vector<Rigid3> poses = PossiblePoses(pair);
    if (poses.size() == 1) {
      return Start(pair, poses.front());
    }
    constexpr int kImagesForTrial = 3;
    double best_support = 0.0;
    Rigid3 best;
    for (const Rigid3& pose : poses) {
      if (!Start(pair, pose)) {
        continue;
      }
      for (int i = 0; i < kImagesForTrial && LocateNext(); ++i) {
      }
      Refresh();
      const double support = Support();
      if (support > best_support) {
        best_support = support;
        best = pose;
      }
    }
    return best_support > 0.0 && Start(pair, best);
  }

  std::vector<Rigid3> PossiblePoses(const VerifiedPair& pair) const {
    constexpr double kPlanarShare = 0.8;
    constexpr double kThresholdPx = 2.0;
    const double focal = 0.5 * (reconstruction_.camera(pair.images.a).Focal() +
                                reconstruction_.camera(pair.images.b).Focal());
    std::vector<Rigid3> poses = {pair.b_from_a};
    const PlanarGeometry planar = EstimatePlanarGeometry(CommonPoints(pair), kThresholdPx / focal);
    if (planar.share > kPlanarShare) {
      poses.insert(poses.end(), planar.b_from_a.begin(), planar.b_from_a.end());
    }
    return poses;
  }

  // The points of the tracks that both images of a pair observe, on the plane z = 1.
  PointPairs CommonPoints(const VerifiedPair& pair) const {
    std::map<uint32_t, uint32_t> element_in_a;  // Key: track.
    for (const uint32_t element : reconstruction_.ElementsOf(pair.images.a)) {
      element_in_a[reconstruction_.TrackOf(element)] = element;
    }
    PointPairs points;
    for (const uint32_t element : reconstruction_.ElementsOf(pair.images.b)) {
      const auto in_a = element_in_a.find(reconstruction_.TrackOf(element));
      if (in_a != element_in_a.end()) {
        points.a.push_back(reconstruction_.PlanePoint(in_a->second));
        points.b.push_back(reconstruction_.PlanePoint(element));
      }
    }
    return points;
  }

  // Number of observations that support the map; those with a large error hardly count.
  double Support() const {
    double support = 0.0;
    for (uint32_t track = 0; track < reconstruction_.tracks().size(); ++track) {
      for (const uint32_t element : reconstruction_.Observations(track)) {
        support +=
            1.0 / (1.0 + reconstruction_.SquaredErrorPx(element, reconstruction_.Point(track)));
      }
    }
    return support;
  }

  bool Start(const VerifiedPair& pair, const Rigid3& b_from_a) {
    Forget();
    finishing_ = false;
    anchors_ = {pair.images.a, pair.images.b};
    reconstruction_.Locate(anchors_[0], Rigid3{});
    reconstruction_.Locate(anchors_[1], b_from_a);
    Retriangulate();
    AdjustAll(reconstruction_, anchors_, Growing());
    FilterAll(options_.triangulation);
    last_global_ = 2;
    const size_t points = reconstruction_.PointCount();
    log_.Debug("mapping from images {} and {}: {} points", anchors_[0], anchors_[1], points);
    return points >= options_.min_initial_points;
  }

  void Grow() {
    bool refreshed = true;  // Refresh() ran since the last image was located.
    while (!progress_.Cancelled()) {
      const size_t located = reconstruction_.LocatedImages().size();
      progress_.Report("mapping", static_cast<double>(located) /
                                      static_cast<double>(reconstruction_.image_count()));
      if (LocateNext()) {
        refreshed = false;
        if (static_cast<double>(located + 1) >= kGrowth * static_cast<double>(last_global_)) {
          Refresh();
          refreshed = true;
        }
      } else if (!refreshed) {
        Refresh();
        refreshed = true;
      } else {
        return;
      }
    }
  }

  // Global adjustment with filtering and completion of the tracks.
  void Refresh() {
    last_global_ = reconstruction_.LocatedImages().size();
    AdjustAll(reconstruction_, anchors_, Growing());
    FilterAll(options_.triangulation);
    CompleteAll(options_.triangulation.max_error_px);
    Retriangulate();
  }

  void Finish() {
    constexpr int kRounds = 2;
    finishing_ = true;
    TriangulationOptions limits = options_.triangulation;
    if (options_.tell_cameras_apart) {
      TellCamerasApart();
    }
    for (int round = 0; round < kRounds && !progress_.Cancelled(); ++round) {
      progress_.Report("refining", static_cast<double>(round) / kRounds);
      CompleteAll(limits.max_error_px);
      Retriangulate();
      BundleOptions bundle = Growing();
      bundle.points_per_image = 600;
      AdjustAll(reconstruction_, anchors_, bundle);
      limits.max_error_px = options_.final_max_error_px;
      FilterAll(limits);
      DropMoving();
      DropWeakImages();
    }
    BundleOptions bundle = Growing();
    bundle.points_per_image = kFinalPointsPerImage;
    bundle.max_iterations = 50;
    bundle.function_tolerance = 1e-6;
    AdjustAll(reconstruction_, anchors_, bundle);
    FilterAll(limits);
    DropMoving();
    // Photographs by several lenses hardly determine the principal point of each.
    if (bundle.refine_intrinsics && reconstruction_.LensCount() == 1 && !progress_.Cancelled()) {
      FreeCentre(bundle, limits);
    }
  }

  // Estimates the principal point last. Many recordings hardly determine it; then the image's
  // centre is the better estimate.
  void FreeCentre(BundleOptions bundle, const TriangulationOptions& limits) {
    // Largest standard deviation and largest shift, as shares of the longer side.
    constexpr double kMaxDeviation = 0.002;
    constexpr double kMaxShift = 0.1;
    const geometry::CameraModel before = reconstruction_.camera();
    const double side = std::max(before.width, before.height);
    Reconstruction centred = reconstruction_;
    bundle.refine_centre = true;
    if (!AdjustAll(reconstruction_, anchors_, bundle)) {
      return;
    }
    FilterAll(limits);
    AdjustAll(reconstruction_, anchors_, bundle);
    const geometry::CameraModel& after = reconstruction_.camera();
    const IntrinsicsDeviation deviation =
        EstimateDeviations(reconstruction_, anchors_[0], bundle).front();
    const bool taken = deviation.cx_px > 0.0 && deviation.cx_px < kMaxDeviation * side &&
                       deviation.cy_px > 0.0 && deviation.cy_px < kMaxDeviation * side &&
                       std::hypot(after.cx - before.cx, after.cy - before.cy) < kMaxShift * side;
    log_.Info("principal point off the centre by {:.1f} +- {:.1f}, {:.1f} +- {:.1f} pixels: {}",
              after.cx - before.cx, deviation.cx_px, after.cy - before.cy, deviation.cy_px,
              taken ? "taken" : "not taken");
    if (!taken) {
      reconstruction_ = std::move(centred);
    }
  }

  // Whether it is only assumed which camera took an image.
  bool Assumed(uint32_t image) const {
    const TrainingCamera& camera = first_cameras_[first_camera_of_image_[image]];
    return camera.assumed && !camera.given;
  }

  // Finds out by which cameras the images were taken of which it is only assumed: estimates the
  // intrinsics of each image by themselves, then joins those whose focal lengths agree.
  void TellCamerasApart() {
    std::map<uint32_t, std::vector<uint32_t>> groups;  // Key: the lens that was assumed.
    for (const uint32_t image : reconstruction_.LocatedImages()) {
      if (Assumed(image)) {
        groups[LensOf(first_cameras_, first_camera_of_image_[image])].push_back(image);
      }
    }
    std::erase_if(groups, [](const auto& group) { return group.second.size() < 2; });
    if (groups.empty()) {
      return;
    }
    for (const auto& [lens, images] : groups) {
      for (const uint32_t image : images) {
        reconstruction_.GiveOwnCamera(image, reconstruction_.camera(image));
      }
    }
    BundleOptions bundle = Growing();
    bundle.max_iterations = 100;
    bundle.function_tolerance = 1e-6;
    bundle.points_per_image = 600;
    constexpr int kRounds = 3;
    for (int round = 0; round < kRounds && !progress_.Cancelled(); ++round) {
      AdjustAll(reconstruction_, anchors_, bundle);
      FilterAll(options_.triangulation);
      CompleteAll(options_.triangulation.max_error_px);
      Retriangulate();
    }
    const std::vector<IntrinsicsDeviation> deviations =
        EstimateDeviations(reconstruction_, anchors_[0], bundle);
    std::vector<TrainingCamera> cameras = first_cameras_;
    std::vector<uint32_t> camera_of_image = first_camera_of_image_;
    for (uint32_t i = 0; i < cameras.size(); ++i) {
      cameras[i].model = reconstruction_.cameras()[i].model;
    }
    for (const auto& [lens, images] : groups) {
      std::vector<KnownFocal> focals;
      for (const uint32_t image : images) {
        const double focal = reconstruction_.camera(image).fx;
        const double deviation = deviations[reconstruction_.CameraOf(image)].focal_px / focal;
        focals.push_back({std::log(focal), deviation});
      }
      const std::vector<std::vector<uint32_t>> sets = AgreeingFocals(focals);
      for (size_t set = 0; set < sets.size(); ++set) {
        // Begins with the intrinsics that are known best.
        const uint32_t best = *std::min_element(
            sets[set].begin(), sets[set].end(),
            [&](uint32_t a, uint32_t b) { return focals[a].deviation < focals[b].deviation; });
        TrainingCamera known = first_cameras_[first_camera_of_image_[images[best]]];
        known.model = reconstruction_.camera(images[best]);
        // Key: an assumed camera. Value: the camera that took its images of this set. The largest
        // set keeps the cameras that were assumed.
        std::map<uint32_t, uint32_t> of_set;
        std::optional<uint32_t> own_lens;
        for (uint32_t i = 0; set == 0 && i < first_cameras_.size(); ++i) {
          if (LensOf(first_cameras_, i) == lens) {
            of_set[i] = i;
          }
        }
        for (const uint32_t member : sets[set]) {
          const uint32_t assumed = first_camera_of_image_[images[member]];
          const auto next = static_cast<uint32_t>(cameras.size());
          if (of_set.emplace(assumed, next).second) {
            cameras.push_back(first_cameras_[assumed]);
            cameras.back().lens_of = own_lens;
            own_lens = own_lens.value_or(next);
          }
          camera_of_image[images[member]] = of_set[assumed];
        }
        for (const auto& [assumed, index] : of_set) {
          cameras[index].model = TurnedModel(known, cameras[index]);
        }
      }
      log_.Info("{} images of one size were taken by {} cameras", images.size(), sets.size());
    }
    reconstruction_.SetCameras(std::move(cameras), std::move(camera_of_image));
    AdjustAll(reconstruction_, anchors_, bundle);
    FilterAll(options_.triangulation);
  }

  BundleOptions Growing() const {
    constexpr size_t kImagesForIntrinsics = 4;
    BundleOptions bundle;
    bundle.max_iterations = 20;
    bundle.function_tolerance = 1e-4;
    bundle.points_per_image = 300;
    bundle.refine_intrinsics = options_.refine_intrinsics &&
                               reconstruction_.LocatedImages().size() >= kImagesForIntrinsics;
    // A few images hardly determine the distortion of many cameras.
    bundle.refine_radial = reconstruction_.LensCount() == 1 || finishing_;
    return bundle;
  }

  // Number of points that an image observes, weighted by how evenly they fill it: occupied cells of
  // grids from 2x2 to 16x16 (Schoenberger & Frahm, CVPR 2016, section 4.2).
  size_t VisibilityScore(uint32_t image) const {
    constexpr int kLevels = 4;
    const geometry::CameraModel& camera = reconstruction_.camera(image);
    size_t score = 0;
    std::vector<uint8_t> occupied;
    for (int level = 1; level <= kLevels; ++level) {
      const int cells = 1 << level;
      occupied.assign(static_cast<size_t>(cells * cells), 0);
      for (const uint32_t element : reconstruction_.ElementsOf(image)) {
        if (!reconstruction_.HasPoint(reconstruction_.TrackOf(element))) {
          continue;
        }
        const Eigen::Vector2d& pixel = reconstruction_.Pixel(element);
        const int x = std::clamp(static_cast<int>(pixel.x() * cells / camera.width), 0, cells - 1);
        const int y = std::clamp(static_cast<int>(pixel.y() * cells / camera.height), 0, cells - 1);
        uint8_t& cell = occupied[static_cast<size_t>(y * cells + x)];
        score += cell == 0 ? static_cast<size_t>(cells) * cells : 0;
        cell = 1;
      }
    }
    return score;
  }

  // Locates the best of the images that have no pose yet. Returns false if none can be located.
  bool LocateNext() {
    std::vector<std::pair<size_t, uint32_t>> candidates;
    for (uint32_t image = 0; image < reconstruction_.image_count(); ++image) {
      if (!reconstruction_.Located(image)) {
        candidates.emplace_back(VisibilityScore(image), image);
      }
    }
    std::sort(candidates.begin(), candidates.end(), [](const auto& a, const auto& b) {
      return a.first != b.first ? a.first > b.first : a.second < b.second;
    });
    for (const auto& [score, image] : candidates) {
      if (score == 0 || progress_.Cancelled()) {
        return false;
      }
      if (LocateOne(image)) {
        return true;
      }
    }
    return false;
  }

  bool LocateOne(uint32_t image) {
    std::vector<Eigen::Vector2d> pixels;
    std::vector<Eigen::Vector3d> points;
    for (const uint32_t element : reconstruction_.ElementsOf(image)) {
      if (reconstruction_.HasPoint(reconstruction_.TrackOf(element))) {
        pixels.push_back(reconstruction_.Pixel(element));
        points.push_back(reconstruction_.Point(reconstruction_.TrackOf(element)));
      }
    }
    std::optional<Resection> resection =
        LocateImage(reconstruction_.camera(image), pixels, points, options_.resection);
    if (options_.tell_cameras_apart && Assumed(image)) {
      SolveLens(image, pixels, points, resection);
    }
    if (!resection) {
      return false;
    }
    reconstruction_.Locate(image, resection->camera_from_map);
    ExtendBy(image);
    AdjustAround(image);
    FilterAround(image);
    log_.Debug("located image {}: {} of {} points, {} in the map", image, resection->inliers.size(),
               points.size(), reconstruction_.PointCount());
    return true;
  }

  // Solves for the intrinsics too if those of the assumed camera are a mere guess or explain the
  // image badly. If the solution explains clearly more, it belongs to the camera or, if others were
  // located with that one already, to a camera of its own.
  void SolveLens(uint32_t image,
                 std::span<const Eigen::Vector2d> pixels,
                 std::span<const Eigen::Vector3d> points,
                 std::optional<Resection>& resection) {
    constexpr double kExplained = 0.7;     // Share of the points.
    constexpr double kClearlyMore = 1.15;  // Ratio of numbers of points.
    constexpr double kOtherFocal = 0.03;
    const uint32_t camera = reconstruction_.CameraOf(image);
    const std::vector<uint32_t> located = reconstruction_.LocatedImages();
    const uint32_t lens = LensOf(reconstruction_.cameras(), camera);
    const bool seen = std::any_of(located.begin(), located.end(), [&](uint32_t i) {
      return LensOf(reconstruction_.cameras(), reconstruction_.CameraOf(i)) == lens;
    });
    const double inliers = resection ? static_cast<double>(resection->inliers.size()) : 0.0;
    if (seen && inliers > kExplained * static_cast<double>(pixels.size())) {
      return;
    }
    const geometry::CameraModel before = reconstruction_.camera(image);
    std::optional<LensResection> found =
        LocateImageAndLens(reconstruction_.cameras()[camera], pixels, points, options_.resection);
    if (!found || static_cast<double>(found->resection.inliers.size()) < kClearlyMore * inliers ||
        std::abs(std::log(found->camera.fx / before.fx)) < kOtherFocal) {
      return;
    }
    resection = std::move(found->resection);
    log_.Debug("image {}: focal length {:.0f} instead of {:.0f} pixels", image, found->camera.fx,
               before.fx);
    if (seen) {
      reconstruction_.GiveOwnCamera(image, found->camera);
    } else {
      reconstruction_.SetCamera(camera, found->camera);
    }
  }

  // Adds observations of known points in a new image, then new points.
  void ExtendBy(uint32_t image) {
    for (const uint32_t element : reconstruction_.ElementsOf(image)) {
      const uint32_t track = reconstruction_.TrackOf(element);
      if (reconstruction_.HasPoint(track)) {
        reconstruction_.Complete(track, options_.triangulation.max_error_px);
      } else {
        reconstruction_.Triangulate(track, options_.triangulation);
      }
    }
  }

  // Adjusts the new image and the images that share most points with it.
  void AdjustAround(uint32_t image) {
    constexpr size_t kNeighbours = 5;
    constexpr size_t kMinShared = 10;  // Fewer shared points do not constrain a pose.
    std::vector<size_t> shared(reconstruction_.image_count(), 0);
    for (const uint32_t element : reconstruction_.ElementsOf(image)) {
      if (!reconstruction_.Observed(element)) {
        continue;
      }
      for (const uint32_t e : reconstruction_.Observations(reconstruction_.TrackOf(element))) {
        ++shared[reconstruction_.ImageOf(e)];
      }
    }
    shared[image] = 0;
    shared[anchors_[0]] = 0;  // The first anchor stays fixed; it defines the axes.
    std::vector<uint32_t> order(shared.size());
    for (uint32_t i = 0; i < order.size(); ++i) {
      order[i] = i;
    }
    std::stable_sort(order.begin(), order.end(),
                     [&](uint32_t a, uint32_t b) { return shared[a] > shared[b]; });
    std::vector<uint32_t> images = {image};
    for (size_t i = 0; i < std::min(kNeighbours, order.size()) && shared[order[i]] >= kMinShared;
         ++i) {
      images.push_back(order[i]);
    }
    BundleOptions bundle;
    bundle.max_iterations = 10;
    bundle.points_per_image = 500;
    AdjustLocally(reconstruction_, images, bundle);
  }

  void FilterAround(uint32_t image) {
    for (const uint32_t element : reconstruction_.ElementsOf(image)) {
      if (reconstruction_.HasPoint(reconstruction_.TrackOf(element))) {
        reconstruction_.Filter(reconstruction_.TrackOf(element), options_.triangulation);
      }
    }
  }

  template <typename Visit>
  void ForAllTracks(bool with_point, Visit visit) {
    for (uint32_t track = 0; track < reconstruction_.tracks().size(); ++track) {
      if (reconstruction_.HasPoint(track) == with_point) {
        visit(track);
      }
    }
  }
  void FilterAll(const TriangulationOptions& limits) {
    ForAllTracks(true, [&](uint32_t track) { reconstruction_.Filter(track, limits); });
  }
  void DropMoving() {
    ForAllTracks(true, [&](uint32_t track) { reconstruction_.DropIfMoving(track); });
  }
  void CompleteAll(double max_error_px) {
    ForAllTracks(true, [&](uint32_t track) { reconstruction_.Complete(track, max_error_px); });
  }
  void Retriangulate() {
    ForAllTracks(
        false, [&](uint32_t track) { reconstruction_.Triangulate(track, options_.triangulation); });
  }

  // Removes images that have hardly any observation left after filtering.
  void DropWeakImages() {
    for (const uint32_t image : reconstruction_.LocatedImages()) {
      const auto elements = reconstruction_.ElementsOf(image);
      const auto observations =
          std::count_if(elements.begin(), elements.end(),
                        [&](uint32_t element) { return reconstruction_.Observed(element); });
      if (static_cast<size_t>(observations) < options_.resection.min_inliers / 2 &&
          image != anchors_[0] && image != anchors_[1]) {
        reconstruction_.Unlocate(image);
      }
    }
  }

  // Factor by which the number of images grows between global adjustments.
  static constexpr double kGrowth = 1.25;

  Reconstruction& reconstruction_;
  std::span<const VerifiedPair> pairs_;
  MapperOptions options_;
  Progress& progress_;
  Log& log_;
  std::vector<TrainingCamera> first_cameras_;
  std::vector<uint32_t> first_camera_of_image_;
  InitialPair anchors_ = {0, 0};
  std::optional<Reconstruction> best_;
  InitialPair best_anchors_ = {0, 0};
  size_t last_global_ = 0;
  bool finishing_ = false;  // The map has grown, and is refined.
};

}  // namespace

std::optional<InitialPair> MapIncrementally(Reconstruction& reconstruction,
                                            std::span<const VerifiedPair> pairs,
                                            const MapperOptions& options,
                                            Progress& progress,
                                            Log& log) {
  return Mapper(reconstruction, pairs, options, progress, log).Run();
}

}  // namespace lararium::train
