#include "editor/train/image_mapping.h"

#include <algorithm>
#include <string>
#include <utility>

#include "editor/train/loop_closures.h"
#include "editor/train/pair_selection.h"
#include "editor/train/survey.h"
#include "editor/train/tracks.h"
#include "editor/train/training_status.h"
#include "editor/train/two_view.h"

namespace lararium::train {
namespace {

using vision::Features;

// Motion of the matches in pixels that a pure rotation of the camera does not explain.
double ParallaxPx(std::span<const TrainingImage> images,
                  const VerifiedPair& pair,
                  std::span<const TrainingCamera> cameras) {
  const geometry::CameraModel& of_a = cameras[images[pair.images.a].camera].model;
  const geometry::CameraModel& of_b = cameras[images[pair.images.b].camera].model;
  PointPairs points;
  for (const FeatureMatch& match : pair.matches) {
    const vision::Keypoint& a = images[pair.images.a].features.keypoints[match.a];
    const vision::Keypoint& b = images[pair.images.b].features.keypoints[match.b];
    points.a.push_back(of_a.PlaneFromPixel({a.x, a.y}));
    points.b.push_back(of_b.PlaneFromPixel({b.x, b.y}));
  }
  return EstimateTurning(points).median_angle * of_a.Focal();
}

Status WhyNoMap(std::span<const TrainingImage> images, const VerifiedPairs& verified) {
  constexpr double kNoParallaxPx = 3.0;
  const VerifiedPair* widest = nullptr;
  double most = -1.0;
  for (const VerifiedPair& pair : verified.pairs) {
    const double parallax = ParallaxPx(images, pair, verified.cameras);
    if (parallax > most) {
      most = parallax;
      widest = &pair;
    }
  }
  const std::string a = images[widest->images.a].name;
  const std::string b = images[widest->images.b].name;
  if (most < kNoParallaxPx) {
    return Status::Error(
        kTraining,
        "too little parallax: from " + images.front().name + " to " + images.back().name +
            " the camera turned or stood still (most between " + a + " and " + b + ")",
        "film while walking sideways past the place; do not pan on the spot");
  }
  return Status::Error(
      kTraining, "no two images fix enough points to start a map (best " + a + " and " + b + ")",
      "film textured objects that do not move, while you move the camera");
}

// Fails if too few of the images are part of the map.
Status CheckShare(std::span<const TrainingImage> images, const Reconstruction& reconstruction) {
  const std::vector<uint32_t> located = reconstruction.LocatedImages();
  if (5 * located.size() >= images.size()) {
    return Status();
  }
  return Status::Error(kTraining,
                       "only " + std::to_string(located.size()) + " of " +
                           std::to_string(images.size()) + " images fit one map (" +
                           images[located.front()].name + " to " + images[located.back()].name +
                           ")",
                       "film objects that do not move, while you move the camera slowly sideways, "
                       "with neighbouring images that overlap");
}

// Makes the camera frame of the first located image the map frame, and the median depth the unit.
void Normalise(Reconstruction& reconstruction) {
  const std::vector<uint32_t> located = reconstruction.LocatedImages();
  std::vector<double> depths;
  for (uint32_t track = 0; track < reconstruction.tracks().size(); ++track) {
    for (uint32_t element = reconstruction.tracks().begin[track];
         element < reconstruction.tracks().begin[track + 1]; ++element) {
      if (reconstruction.Observed(element)) {
        depths.push_back((reconstruction.camera_from_map(reconstruction.ImageOf(element)) *
                          reconstruction.Point(track))
                             .z());
      }
    }
  }
  const auto middle = depths.begin() + static_cast<ptrdiff_t>(depths.size() / 2);
  std::nth_element(depths.begin(), middle, depths.end());
  const geometry::Rigid3 first = reconstruction.camera_from_map(located.front());
  reconstruction.Transform({1.0 / *middle, first.rotation, first.translation / *middle});
}

// Logs which stretches of images have no pose, and why.
void WarnOfGaps(std::span<const TrainingImage> images,
                std::span<const VerifiedPair> pairs,
                const Reconstruction& reconstruction,
                Log& log) {
  std::vector<bool> linked(images.size(), false);
  for (const VerifiedPair& pair : pairs) {
    linked[pair.images.a] = linked[pair.images.a] || reconstruction.Located(pair.images.b);
    linked[pair.images.b] = linked[pair.images.b] || reconstruction.Located(pair.images.a);
  }
  for (uint32_t begin = 0; begin < images.size(); ++begin) {
    uint32_t end = begin;
    size_t most_features = 0;
    bool any_linked = false;
    while (end < images.size() && !reconstruction.Located(end)) {
      most_features = std::max(most_features, images[end].features.size());
      any_linked = any_linked || linked[end];
      ++end;
    }
    if (end == begin) {
      continue;
    }
    const char* reason =
        most_features < kFewFeatures
            ? "too few features; film textured objects in good light, without motion blur"
        : any_linked ? "their matches fix no pose; film this part again, more slowly"
                     : "they do not overlap with the rest of the map; move more slowly between";
    log.Warn("no pose for {} to {}: {}", images[begin].name, images[end - 1].name, reason);
    begin = end;
  }
}

std::vector<uint32_t> CamerasOfImages(std::span<const TrainingImage> images) {
  std::vector<uint32_t> cameras;
  for (const TrainingImage& image : images) {
    cameras.push_back(image.camera);
  }
  return cameras;
}

// A map of the images from some of the pairs; none if no pair can start one.
std::optional<SparseMap> MapPairs(std::span<const TrainingImage> images,
                                  std::span<const TrainingCamera> cameras,
                                  std::span<const VerifiedPair> pairs,
                                  const MapperOptions& options,
                                  Progress& progress,
                                  Log& log) {
  std::vector<uint32_t> feature_counts;
  std::vector<std::vector<Eigen::Vector2d>> pixels;
  for (const TrainingImage& image : images) {
    feature_counts.push_back(static_cast<uint32_t>(image.features.size()));
    std::vector<Eigen::Vector2d>& of_image = pixels.emplace_back();
    for (const vision::Keypoint& keypoint : image.features.keypoints) {
      of_image.emplace_back(keypoint.x, keypoint.y);
    }
  }
  SparseMap map;
  map.reconstruction = std::make_unique<Reconstruction>(
      std::vector<TrainingCamera>(cameras.begin(), cameras.end()), CamerasOfImages(images),
      std::move(pixels), BuildTracks(feature_counts, pairs));
  const std::optional<InitialPair> anchors =
      MapIncrementally(*map.reconstruction, pairs, options, progress, log);
  if (!anchors) {
    return std::nullopt;
  }
  map.anchors = *anchors;
  return map;
}

// The pairs of a film without those of views that only look alike. The map of neighbours alone says
// where the camera went.
std::vector<VerifiedPair> WithoutLookalikes(std::span<const TrainingImage> images,
                                            const VerifiedPairs& verified,
                                            MapperOptions options,
                                            Progress& progress,
                                            Log& log) {
  if (!verified.film_gap) {
    return verified.pairs;
  }
  // The chain needs few points, and time grows with them.
  constexpr size_t kChainFeatures = 1500;
  std::vector<std::vector<bool>> strong;  // [image][feature]
  for (const TrainingImage& image : images) {
    std::vector<bool>& of_image = strong.emplace_back(image.features.size(), false);
    for (const uint32_t feature : StrongestFeatures(image.features, kChainFeatures)) {
      of_image[feature] = true;
    }
  }
  std::vector<VerifiedPair> neighbours;
  for (const VerifiedPair& pair : verified.pairs) {
    if (pair.images.b - pair.images.a <= *verified.film_gap) {
      std::erase_if(neighbours.emplace_back(pair).matches, [&](const FeatureMatch& match) {
        return !strong[pair.images.a][match.a] || !strong[pair.images.b][match.b];
      });
    }
  }
  if (neighbours.size() == verified.pairs.size()) {
    return verified.pairs;
  }
  options.draft = true;
  const std::optional<SparseMap> chain =
      MapPairs(images, verified.cameras, neighbours, options, progress, log);
  if (!chain) {
    return verified.pairs;
  }
  LoopClosures closures =
      JudgeLoopClosures(verified.pairs, *verified.film_gap, *chain->reconstruction);
  if (closures.lookalikes > 0) {
    log.Info("{} of {} image pairs look alike, but show different parts of the place",
             closures.lookalikes, verified.pairs.size());
  }
  return std::move(closures.pairs);
}

}  // namespace

Result<VerifiedPairs> MatchImages(std::span<TrainingImage> images,
                                  const ImageMappingOptions& options,
                                  Progress& progress,
                                  Log& log) {
  std::vector<Features> features;  // Moved here and back, because a contiguous span is needed.
  for (TrainingImage& image : images) {
    features.push_back(std::move(image.features));
  }
  PairOptions pair_options;
  pair_options.seed = options.seed;
  const PairSelection selection = SelectPairs(features, pair_options);
  const std::vector<ImagePair>& candidates = selection.pairs;
  VerificationOptions verification;
  verification.trusted_gap = images.size() <= pair_options.exhaustive_up_to
                                 ? pair_options.exhaustive_up_to
                                 : pair_options.gaps.back();
  const std::vector<uint32_t> camera_of_image = CamerasOfImages(images);
  VerifiedPairs verified =
      VerifyPairs({features, options.cameras, camera_of_image}, candidates, verification, progress);
  for (size_t i = 0; i < images.size(); ++i) {
    images[i].features = std::move(features[i]);
  }
  if (progress.Cancelled()) {
    return CancelledStatus();
  }
  if (selection.ordered) {
    verified.film_gap = pair_options.gaps.back();
  }
  for (const TrainingCamera& camera : verified.cameras) {
    if (!camera.given) {
      log.Info("starting with a focal length of {:.0f} pixels", camera.model.fx);
    }
  }
  log.Info("{} of {} image pairs show the same objects", verified.pairs.size(), candidates.size());
  if (verified.pairs.empty()) {
    return Status::Error(kTraining,
                         "no two images show the same objects (" + images.front().name + " to " +
                             images.back().name + ")",
                         "move more slowly, so that neighbouring images overlap by two thirds");
  }
  return verified;
}

Result<SparseMap> MapImages(std::span<const TrainingImage> images,
                            const VerifiedPairs& verified,
                            const ImageMappingOptions& options,
                            Progress& progress,
                            Log& log) {
  MapperOptions mapper;
  mapper.refine_intrinsics =
      std::any_of(options.cameras.begin(), options.cameras.end(),
                  [](const TrainingCamera& camera) { return !camera.given; });
  // Many images of one size, each of which looks like the next, are frames of a film.
  constexpr size_t kFilm = 50;
  mapper.tell_cameras_apart =
      !verified.film_gap || options.cameras.size() > 1 || images.size() <= kFilm;
  const std::vector<VerifiedPair> pairs =
      WithoutLookalikes(images, verified, mapper, progress, log);
  std::optional<SparseMap> map = MapPairs(images, verified.cameras, pairs, mapper, progress, log);
  if (progress.Cancelled()) {
    return CancelledStatus();
  }
  if (!map) {
    return WhyNoMap(images, verified);
  }
  LARARIUM_RETURN_IF_ERROR(CheckShare(images, *map->reconstruction));
  Normalise(*map->reconstruction);
  WarnOfGaps(images, pairs, *map->reconstruction, log);
  return std::move(*map);
}

}  // namespace lararium::train
