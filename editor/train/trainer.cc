#include "editor/train/trainer.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>

#include "editor/train/bundle_adjustment.h"
#include "editor/train/database_builder.h"
#include "editor/train/frame_locator.h"
#include "editor/train/keyframes.h"
#include "editor/train/mapper.h"
#include "editor/train/pair_selection.h"
#include "editor/train/pair_verification.h"
#include "shared/core/parallel.h"

namespace lararium::train {
namespace {

using geometry::CameraModel;
using geometry::Frame;
using vision::Features;

constexpr std::string_view kPlace = "training";
constexpr size_t kFewFeatures = 150;  // of an image; less rarely locates it

Status CancelledStatus() { return Status::Error(kPlace, "cancelled"); }

// Reads frames in order; skips single ones that cannot be read.
class FrameReader {
 public:
  FrameReader(capture::FrameSource& source, Log& log) : source_(source), log_(log) {}

  Status Rewind() { return source_.Seek(0); }

  Result<std::optional<Frame>> Next() {
    constexpr int kMaxFailures = 10;
    for (int failures = 0;; ++failures) {
      Result<std::optional<Frame>> frame = source_.Next();
      if (frame.ok() || failures == kMaxFailures) {
        return frame;
      }
      log_.warn("{}", frame.message());
    }
  }

 private:
  capture::FrameSource& source_;
  Log& log_;
};

struct SurveyedFrame {
  int64_t index = -1;
  // Only while all frames may become keyframes.
  cv::Mat bgr;
  cv::Mat grey;
};

class Trainer {
 public:
  Trainer(capture::FrameSource& source, const TrainOptions& options, Progress& progress, Log& log)
      : source_(source), reader_(source, log), options_(options), progress_(progress), log_(log) {}

  Result<TrainResult> Run() {
    LARARIUM_RETURN_IF_ERROR(Timed("reading", [&] { return Survey(); }));
    LARARIUM_RETURN_IF_ERROR(Timed("features", [&] { return Extract(); }));
    LARARIUM_RETURN_IF_ERROR(Timed("matching", [&] { return Match(); }));
    LARARIUM_RETURN_IF_ERROR(Timed("mapping", [&] { return Map(); }));
    LARARIUM_RETURN_IF_ERROR(Timed("locating", [&] { return LocateOthers(); }));
    TrainResult result;
    LARARIUM_RETURN_IF_ERROR(Timed("database", [&] { return Build(result.database); }));
    FillReport(result.database);
    result.report = std::move(report_);
    return result;
  }

 private:
  template <typename Step>
  Status Timed(const char* name, Step step) {
    progress_.Report(name, 0.0);
    const auto start = std::chrono::steady_clock::now();
    const Status status = step();
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    report_.seconds.emplace_back(name, seconds.count());
    log_.info("{}: {:.1f} s", name, seconds.count());
    if (status.ok() && progress_.Cancelled()) {
      return CancelledStatus();
    }
    return status;
  }

  // Reads everything once: measures motion, chooses keyframes, keeps their images.
  Status Survey() {
    LARARIUM_RETURN_IF_ERROR(reader_.Rewind());
    const auto max_keyframes = static_cast<size_t>(options_.max_keyframes);
    const double expected = static_cast<double>(source_.frame_count().value_or(0));
    std::vector<SurveyedFrame> frames;
    MotionMeter meter;
    while (true) {
      LARARIUM_ASSIGN_OR_RETURN(std::optional<Frame> frame, reader_.Next());
      if (!frame) {
        break;
      }
      if (progress_.Cancelled()) {
        return CancelledStatus();
      }
      motions_.push_back(meter.Measure(frame->grey));
      frames.push_back({frame->index, frame->bgr.clone(), frame->grey.clone()});
      if (frames.size() == max_keyframes + 1) {
        for (SurveyedFrame& surveyed : frames) {
          surveyed.bgr.release();
          surveyed.grey.release();
        }
      }
      if (frames.size() > max_keyframes) {
        frames.back().bgr.release();
        frames.back().grey.release();
      }
      if (expected > 0) {
        progress_.Report("reading", static_cast<double>(frames.size()) / expected);
      }
    }
    if (frames.size() < 2) {
      return Status::Error(kPlace, "the source has fewer than two frames",
                           "film the place while walking around it");
    }
    for (const SurveyedFrame& frame : frames) {
      frame_indices_.push_back(frame.index);
    }
    for (const size_t i : ChooseKeyframes(motions_, max_keyframes)) {
      images_.push_back({frames[i].index, source_.FrameName(frames[i].index), frames[i].bgr,
                         frames[i].grey, {}});
    }
    report_.frames = static_cast<int>(frames.size());
    report_.keyframes = static_cast<int>(images_.size());
    return frames.size() > max_keyframes ? ReadKeyframes() : Status();
  }

  Status ReadKeyframes() {
    LARARIUM_RETURN_IF_ERROR(reader_.Rewind());
    for (TrainingImage& image : images_) {
      do {
        LARARIUM_ASSIGN_OR_RETURN(std::optional<Frame> frame, reader_.Next());
        if (!frame) {
          return Status::Error(image.name, "the source ended early at its second reading",
                               "check the file");
        }
        if (frame->index == image.frame_index) {
          image.bgr = frame->bgr.clone();
          image.grey = frame->grey.clone();
        }
      } while (image.grey.empty());
      if (progress_.Cancelled()) {
        return CancelledStatus();
      }
    }
    return Status();
  }

  Status Extract() {
    vision::FeatureOptions options;
    // Faint features too: many views average out what each alone is unsure of.
    options.contrast_threshold = 0.02f;
    options.max_features = options_.max_features;
    std::vector<Status> failures(images_.size());
    constexpr size_t kBatch = 8;
    for (size_t begin = 0; begin < images_.size(); begin += kBatch) {
      if (progress_.Cancelled()) {
        return CancelledStatus();
      }
      progress_.Report("features",
                       static_cast<double>(begin) / static_cast<double>(images_.size()));
      ParallelFor(std::min(kBatch, images_.size() - begin), [&](size_t offset) {
        TrainingImage& image = images_[begin + offset];
        Result<Features> features = vision::ExtractFeatures(image.grey, options);
        if (features.ok()) {
          image.features = std::move(features).value();
        } else {
          failures[begin + offset] = features.status().At(image.name);
        }
      });
    }
    for (const Status& failure : failures) {
      LARARIUM_RETURN_IF_ERROR(failure);
    }
    return CheckFeatures();
  }

  Status CheckFeatures() const {
    std::vector<std::string> poor;
    for (const TrainingImage& image : images_) {
      if (image.features.size() < kFewFeatures) {
        poor.push_back(image.name);
      }
    }
    if (2 * poor.size() > images_.size()) {
      return Status::Error(kPlace,
                           "too few features in " + std::to_string(poor.size()) + " of " +
                               std::to_string(images_.size()) + " images (" + poor.front() +
                               " to " + poor.back() + ")",
                           "film textured things in good light, in focus, without motion blur");
    }
    return Status();
  }

  Status Match() {
    std::vector<Features> features;  // moved here and back, so that spans see them
    for (TrainingImage& image : images_) {
      features.push_back(std::move(image.features));
    }
    PairOptions pair_options;
    pair_options.seed = options_.seed;
    const std::vector<ImagePair> candidates = SelectPairs(features, pair_options);
    VerificationOptions verification;
    verification.trusted_gap = images_.size() <= pair_options.exhaustive_up_to
                                   ? pair_options.exhaustive_up_to
                                   : pair_options.neighbours;
    if (options_.intrinsics) {
      camera_ = *options_.intrinsics;
      pairs_ = VerifyPairs(features, candidates, camera_, verification, progress_);
    } else {
      VerifiedPairs verified =
          VerifyPairsUncalibrated(features, candidates, source_.width(), source_.height(),
                                  options_.focal_prior_px, verification, progress_);
      camera_ = verified.camera;
      pairs_ = std::move(verified.pairs);
      log_.info("starting with a focal length of {:.0f} pixels", camera_.fx);
    }
    for (size_t i = 0; i < images_.size(); ++i) {
      images_[i].features = std::move(features[i]);
    }
    log_.info("{} of {} image pairs show the same things", pairs_.size(), candidates.size());
    if (progress_.Cancelled()) {
      return CancelledStatus();
    }
    if (pairs_.empty()) {
      return Status::Error(kPlace,
                           "no two images show the same things (" + images_.front().name + " to " +
                               images_.back().name + ")",
                           "move more slowly, so that neighbouring images overlap by two thirds");
    }
    return Status();
  }

  Status Map() {
    std::vector<uint32_t> feature_counts;
    std::vector<std::vector<Eigen::Vector2d>> pixels;
    for (const TrainingImage& image : images_) {
      feature_counts.push_back(static_cast<uint32_t>(image.features.size()));
      std::vector<Eigen::Vector2d>& of_image = pixels.emplace_back();
      for (const vision::Keypoint& keypoint : image.features.keypoints) {
        of_image.emplace_back(keypoint.x, keypoint.y);
      }
    }
    reconstruction_ = std::make_unique<Reconstruction>(camera_, std::move(pixels),
                                                       BuildTracks(feature_counts, pairs_));
    MapperOptions mapper;
    mapper.refine_intrinsics = !options_.intrinsics;
    const std::optional<InitialPair> anchors =
        MapIncrementally(*reconstruction_, pairs_, mapper, progress_, log_);
    if (progress_.Cancelled()) {
      return CancelledStatus();
    }
    if (!anchors) {
      return WhyNoMap(mapper.min_initial_angle);
    }
    LARARIUM_RETURN_IF_ERROR(CheckShare());
    if (!options_.intrinsics) {
      report_.focal_deviation_px = FocalDeviation(*reconstruction_, (*anchors)[0]);
    }
    NormaliseMap();
    WarnOfGaps();
    return Status();
  }

  Status WhyNoMap(double min_angle) const {
    const auto widest = std::max_element(pairs_.begin(), pairs_.end(),
                                         [](const VerifiedPair& a, const VerifiedPair& b) {
                                           return a.median_angle < b.median_angle;
                                         });
    const std::string a = images_[widest->images.a].name;
    const std::string b = images_[widest->images.b].name;
    if (widest->median_angle < min_angle) {
      return Status::Error(
          kPlace,
          "too little parallax: from " + images_.front().name + " to " + images_.back().name +
              " the camera turned or stood still (most between " + a + " and " + b + ")",
          "film while walking sideways past the place; do not pan on the spot");
    }
    return Status::Error(
        kPlace, "no two images fix enough points to start a map (best " + a + " and " + b + ")",
        "film textured things that do not move, from a camera that does");
  }

  // A scrap of the images is no map of the place.
  Status CheckShare() const {
    const std::vector<uint32_t> located = reconstruction_->LocatedImages();
    if (5 * located.size() >= images_.size()) {
      return Status();
    }
    return Status::Error(kPlace,
                         "only " + std::to_string(located.size()) + " of " +
                             std::to_string(images_.size()) + " images fit one map (" +
                             images_[located.front()].name + " to " + images_[located.back()].name +
                             ")",
                         "film things that do not move, from a camera that does: slowly, sideways, "
                         "with neighbouring images that overlap");
  }

  // The first image's camera becomes the frame, the median depth the unit.
  void NormaliseMap() {
    const std::vector<uint32_t> located = reconstruction_->LocatedImages();
    std::vector<double> depths;
    for (uint32_t track = 0; track < reconstruction_->tracks().size(); ++track) {
      for (uint32_t element = reconstruction_->tracks().begin[track];
           element < reconstruction_->tracks().begin[track + 1]; ++element) {
        if (reconstruction_->Observed(element)) {
          depths.push_back((reconstruction_->camera_from_map(reconstruction_->ImageOf(element)) *
                            reconstruction_->Point(track))
                               .z());
        }
      }
    }
    const auto middle = depths.begin() + static_cast<ptrdiff_t>(depths.size() / 2);
    std::nth_element(depths.begin(), middle, depths.end());
    const geometry::Rigid3 first = reconstruction_->camera_from_map(located.front());
    reconstruction_->Transform({1.0 / *middle, first.rotation, first.translation / *middle});
  }

  // Says which stretches of keyframes have no pose, and why.
  void WarnOfGaps() const {
    std::vector<bool> linked(images_.size(), false);
    for (const VerifiedPair& pair : pairs_) {
      linked[pair.images.a] = linked[pair.images.a] || reconstruction_->Located(pair.images.b);
      linked[pair.images.b] = linked[pair.images.b] || reconstruction_->Located(pair.images.a);
    }
    for (uint32_t begin = 0; begin < images_.size(); ++begin) {
      uint32_t end = begin;
      size_t most_features = 0;
      bool any_linked = false;
      while (end < images_.size() && !reconstruction_->Located(end)) {
        most_features = std::max(most_features, images_[end].features.size());
        any_linked = any_linked || linked[end];
        ++end;
      }
      if (end == begin) {
        continue;
      }
      const char* reason =
          most_features < kFewFeatures
              ? "too few features; film textured things in good light, without motion blur"
          : any_linked ? "their matches fix no pose; film this part again, more slowly"
                       : "they do not overlap with the rest of the map; move more slowly between";
      log_.warn("no pose for {} to {}: {}", images_[begin].name, images_[end - 1].name, reason);
      begin = end;
    }
  }

  Status LocateOthers() {
    if (images_.size() == frame_indices_.size()) {
      return Status();
    }
    const FrameLocator locator(*reconstruction_, images_);
    LARARIUM_RETURN_IF_ERROR(reader_.Rewind());
    size_t keyframe = 0;
    std::vector<std::pair<int64_t, cv::Mat>> batch;
    constexpr size_t kBatch = 16;
    for (size_t done = 0;; ++done) {
      LARARIUM_ASSIGN_OR_RETURN(std::optional<Frame> frame, reader_.Next());
      if (progress_.Cancelled()) {
        return CancelledStatus();
      }
      if (frame && keyframe < images_.size() && images_[keyframe].frame_index == frame->index) {
        ++keyframe;
        continue;
      }
      if (frame) {
        batch.emplace_back(frame->index, frame->grey.clone());
      }
      if (batch.size() == kBatch || !frame) {
        LocateBatch(locator, batch);
        batch.clear();
        progress_.Report("locating",
                         static_cast<double>(done) / static_cast<double>(frame_indices_.size()));
      }
      if (!frame) {
        return Status();
      }
    }
  }

  void LocateBatch(const FrameLocator& locator,
                   std::span<const std::pair<int64_t, cv::Mat>> batch) {
    std::vector<std::optional<geometry::Rigid3>> poses(batch.size());
    ParallelFor(batch.size(),
                [&](size_t i) { poses[i] = locator.Locate(batch[i].second, batch[i].first); });
    for (size_t i = 0; i < batch.size(); ++i) {
      if (poses[i]) {
        report_.located.push_back(
            {batch[i].first, source_.FrameName(batch[i].first), *poses[i], false});
      }
    }
  }

  Status Build(vision::SceneDatabase& database) {
    DatabaseOptions options;
    options.max_points = options_.max_points;
    options.session = options_.session;
    options.seed = options_.seed;
    database = BuildDatabase(*reconstruction_, images_, options);
    return database.Validate();
  }

  void FillReport(const vision::SceneDatabase& database) {
    for (const uint32_t image : reconstruction_->LocatedImages()) {
      report_.located.push_back({images_[image].frame_index, images_[image].name,
                                 reconstruction_->camera_from_map(image), true});
    }
    std::sort(
        report_.located.begin(), report_.located.end(),
        [](const LocatedFrame& a, const LocatedFrame& b) { return a.frame_index < b.frame_index; });
    size_t next = 0;
    for (const int64_t index : frame_indices_) {
      if (next < report_.located.size() && report_.located[next].frame_index == index) {
        ++next;
      } else {
        report_.unlocated.push_back(source_.FrameName(index));
      }
    }
    report_.points = static_cast<int>(database.points.size());
    report_.observations = static_cast<int>(database.observations.size());
    report_.mean_reprojection_error_px = database.mean_reprojection_error_px;
    report_.camera = database.camera;
    report_.intrinsics_estimated = !options_.intrinsics.has_value();
  }

  capture::FrameSource& source_;
  FrameReader reader_;
  TrainOptions options_;
  Progress& progress_;
  Log& log_;
  TrainReport report_;
  std::vector<int64_t> frame_indices_;  // of all frames
  std::vector<FrameMotion> motions_;    // likewise
  std::vector<TrainingImage> images_;   // the keyframes
  CameraModel camera_;
  std::vector<VerifiedPair> pairs_;
  std::unique_ptr<Reconstruction> reconstruction_;
};

}  // namespace

Status TrainOptions::Validate() const {
  constexpr std::string_view kOptions = "training options";
  if (intrinsics) {
    LARARIUM_RETURN_IF_ERROR(intrinsics->Validate());
  }
  if (focal_prior_px && !(*focal_prior_px > 0.0 && std::isfinite(*focal_prior_px))) {
    return Status::Error(kOptions, "focal_prior_px must be positive");
  }
  if (session >= 32) {
    return Status::Error(kOptions, "session must be below 32");
  }
  if (max_keyframes < 2 || max_keyframes > 2000) {
    return Status::Error(kOptions, "max_keyframes must lie between 2 and 2000");
  }
  if (max_features < 100 || max_features > 50'000) {
    return Status::Error(kOptions, "max_features must lie between 100 and 50000");
  }
  if (max_points < 100 || max_points > 10'000'000) {
    return Status::Error(kOptions, "max_points must lie between 100 and 10000000");
  }
  return Status();
}

Result<TrainResult> Train(capture::FrameSource& source,
                          const TrainOptions& options,
                          Progress& progress,
                          Log& log) {
  LARARIUM_RETURN_IF_ERROR(options.Validate());
  if (source.live()) {
    return Status::Error(kPlace, "a live camera has no end", "record a video first");
  }
  if (options.intrinsics && (options.intrinsics->width != source.width() ||
                             options.intrinsics->height != source.height())) {
    return Status::Error(kPlace, "the intrinsics are for another image size than the source's",
                         "give those of the images as they are");
  }
  return Trainer(source, options, progress, log).Run();
}

}  // namespace lararium::train
