#include "editor/train/survey.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "editor/train/training_status.h"
#include "shared/core/median.h"
#include "shared/core/parallel.h"

namespace lararium::train {
namespace {

using geometry::Frame;

// Reads frames in order and skips single frames that cannot be read.
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
      log_.Warn("{}", frame.message());
    }
  }

 private:
  capture::FrameSource& source_;
  Log& log_;
};

Status ReadKeyframes(FrameReader& reader,
                     std::span<TrainingImage> keyframes,
                     const Progress& progress) {
  LARARIUM_RETURN_IF_ERROR(reader.Rewind());
  for (TrainingImage& image : keyframes) {
    do {
      LARARIUM_ASSIGN_OR_RETURN(std::optional<Frame> frame, reader.Next());
      if (!frame) {
        return Status::Error(image.name, "the recording ended early when it was read a second time",
                             "check the file");
      }
      if (frame->index == image.frame_index) {
        image.bgr = frame->bgr.clone();
        image.grey = frame->grey.clone();
      }
    } while (image.grey.empty());
    if (progress.Cancelled()) {
      return CancelledStatus();
    }
  }
  return Status();
}

// Turns seconds into frame times, the median interval. Where times do not ascend, frames count as
// evenly spaced.
void CountInFrameTimes(std::span<SurveyedFrame> frames) {
  std::vector<double> intervals;
  for (size_t i = 1; i < frames.size(); ++i) {
    intervals.push_back(frames[i].time - frames[i - 1].time);
  }
  const bool ascending =
      std::all_of(intervals.begin(), intervals.end(), [](double seconds) { return seconds > 0.0; });
  const double frame_time = Median(std::move(intervals));
  for (SurveyedFrame& frame : frames) {
    frame.time = ascending ? frame.time / frame_time : static_cast<double>(frame.index);
  }
}

// The features of the part of an image that shows something.
Result<vision::Features> FeaturesOf(const TrainingImage& image,
                                    const vision::FeatureOptions& options) {
  const cv::Rect whole({0, 0}, image.grey.size());
  if (image.area.empty() || image.area == whole) {
    return vision::ExtractFeatures(image.grey, options);
  }
  LARARIUM_ASSIGN_OR_RETURN(vision::Features features,
                            vision::ExtractFeatures(image.grey(image.area).clone(), options));
  for (vision::Keypoint& keypoint : features.keypoints) {
    keypoint.x += static_cast<float>(image.area.x);
    keypoint.y += static_cast<float>(image.area.y);
  }
  return features;
}

Status CheckFeatures(std::span<const TrainingImage> images) {
  std::vector<std::string> poor;
  for (const TrainingImage& image : images) {
    if (image.features.size() < kFewFeatures) {
      poor.push_back(image.name);
    }
  }
  if (2 * poor.size() > images.size()) {
    return Status::Error(kTraining,
                         "too few features in " + std::to_string(poor.size()) + " of " +
                             std::to_string(images.size()) + " images (" + poor.front() + " to " +
                             poor.back() + ")",
                         "film textured objects in good light, in focus, without motion blur");
  }
  return Status();
}

}  // namespace

Result<Survey> SurveySource(capture::FrameSource& source,
                            int max_keyframes,
                            Progress& progress,
                            Log& log) {
  FrameReader reader(source, log);
  LARARIUM_RETURN_IF_ERROR(reader.Rewind());
  const auto max_count = static_cast<size_t>(max_keyframes);
  const auto expected = static_cast<double>(source.estimated_frame_count());
  Survey survey;
  std::vector<Frame> kept;  // Frames so far, as long as all of them may become keyframes.
  std::vector<FrameMotion> motions;
  MotionMeter meter;
  while (true) {
    LARARIUM_ASSIGN_OR_RETURN(std::optional<Frame> frame, reader.Next());
    if (!frame) {
      break;
    }
    if (progress.Cancelled()) {
      return CancelledStatus();
    }
    motions.push_back(meter.Measure(frame->grey));
    survey.frames.push_back(
        {frame->index, source.FrameName(frame->index), frame->capture_time, motions.back()});
    if (survey.frames.size() <= max_count) {
      kept.push_back({frame->index, frame->capture_time, frame->bgr.clone(), frame->grey.clone()});
    } else {
      kept.clear();
    }
    if (expected > 0) {
      progress.Report("reading", static_cast<double>(survey.frames.size()) / expected);
    }
  }
  if (survey.frames.size() < 2) {
    return Status::Error(kTraining, "the source has fewer than two frames",
                         "film the place while walking around it");
  }
  CountInFrameTimes(survey.frames);
  const std::vector<capture::SourceCamera> cameras = source.Cameras();
  for (const size_t i : ChooseKeyframes(motions, max_count)) {
    TrainingImage& image = survey.keyframes.emplace_back();
    image.frame_index = survey.frames[i].index;
    image.name = survey.frames[i].name;
    image.camera = static_cast<uint32_t>(source.CameraOf(image.frame_index));
    image.area = cameras[image.camera].area;
    if (!kept.empty()) {
      image.bgr = kept[i].bgr;
      image.grey = kept[i].grey;
    }
  }
  if (kept.empty()) {
    LARARIUM_RETURN_IF_ERROR(ReadKeyframes(reader, survey.keyframes, progress));
  }
  return survey;
}

Status ExtractFeatures(std::span<TrainingImage> images, int max_features, Progress& progress) {
  vision::FeatureOptions options;
  // Also takes faint features; the errors of many views average out.
  options.contrast_threshold = 0.02f;
  options.max_features = max_features;
  std::vector<Status> failures(images.size());
  constexpr size_t kBatch = 8;
  for (size_t begin = 0; begin < images.size(); begin += kBatch) {
    if (progress.Cancelled()) {
      return CancelledStatus();
    }
    progress.Report("features", static_cast<double>(begin) / static_cast<double>(images.size()));
    ParallelFor(std::min(kBatch, images.size() - begin), [&](size_t offset) {
      TrainingImage& image = images[begin + offset];
      Result<vision::Features> features = FeaturesOf(image, options);
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
  return CheckFeatures(images);
}

Status ForOtherFrames(capture::FrameSource& source,
                      const Survey& survey,
                      Progress& progress,
                      Log& log,
                      const std::function<void(std::span<const Frame>)>& visit) {
  FrameReader reader(source, log);
  LARARIUM_RETURN_IF_ERROR(reader.Rewind());
  constexpr size_t kBatch = 16;
  size_t keyframe = 0;
  std::vector<Frame> batch;
  for (size_t done = 0;; ++done) {
    LARARIUM_ASSIGN_OR_RETURN(std::optional<Frame> frame, reader.Next());
    if (progress.Cancelled()) {
      return CancelledStatus();
    }
    while (frame && keyframe < survey.keyframes.size() &&
           survey.keyframes[keyframe].frame_index < frame->index) {
      ++keyframe;  // The survey could read this keyframe, but this pass could not.
    }
    if (frame && keyframe < survey.keyframes.size() &&
        survey.keyframes[keyframe].frame_index == frame->index) {
      continue;
    }
    if (frame) {
      batch.push_back({frame->index, frame->capture_time, frame->bgr.clone(), frame->grey.clone()});
    }
    if (batch.size() == kBatch || !frame) {
      visit(batch);
      batch.clear();
      progress.Report("locating",
                      static_cast<double>(done) / static_cast<double>(survey.frames.size()));
    }
    if (!frame) {
      return Status();
    }
  }
}

}  // namespace lararium::train
