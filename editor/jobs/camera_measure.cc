#include "editor/jobs/camera_measure.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <utility>
#include <vector>

#include "editor/jobs/calibrating.h"
#include "editor/jobs/staging.h"
#include "shared/core/json.h"
#include "shared/vision/image_quality.h"

namespace lararium::editor {
namespace {

constexpr int64_t kFrames = 24;  // The number of frames that are measured.
constexpr size_t kFewest = 4;

Result<std::vector<cv::Mat>> SampleFrames(capture::FrameSource& source, Progress& progress) {
  std::vector<cv::Mat> images;
  const int64_t stride = std::max<int64_t>(1, source.estimated_frame_count() / kFrames);
  for (int64_t i = 0; i < kFrames; ++i) {
    progress.Report("measuring the camera", static_cast<double>(i) / kFrames);
    if (progress.Cancelled()) {
      return Status::Error("camera", "cancelled");
    }
    if (stride > 1) {
      LARARIUM_RETURN_IF_ERROR(source.Seek(i * stride));
    }
    LARARIUM_ASSIGN_OR_RETURN(const auto frame, source.Next());
    if (!frame) {
      break;
    }
    images.push_back(frame->bgr.clone());
  }
  return images;
}

// The blur of the sharpest quarter of the images, combined.
std::optional<double> SharpestQuarter(std::span<const cv::Mat> images) {
  std::vector<std::pair<double, size_t>> blurs;
  for (size_t i = 0; i < images.size(); ++i) {
    if (const auto blur = vision::EstimateSharpness(images.subspan(i, 1))) {
      blurs.emplace_back(*blur, i);
    }
  }
  std::sort(blurs.begin(), blurs.end());
  blurs.resize(std::min(blurs.size(), std::max(kFewest, blurs.size() / 4)));
  std::vector<cv::Mat> sharpest;
  for (const auto& [blur, i] : blurs) {
    sharpest.push_back(images[i]);
  }
  return sharpest.empty() ? std::nullopt : vision::EstimateSharpness(sharpest);
}

Status WriteDevice(const CameraOptions& options, const light::CameraTraits& traits) {
  return options.device_out.empty()
             ? Status()
             : SaveDeviceField(options.device_out, "look", FormatFields(traits));
}

Result<std::unique_ptr<capture::FrameSource>> Recording(const CameraOptions& options,
                                                        const ProjectPaths& paths,
                                                        const PlaceDocument& place) {
  if (!options.video.empty()) {
    return capture::OpenVideo(options.video);
  }
  if (!options.images.empty()) {
    return capture::OpenImageFolder(options.images);
  }
  return OpenSource(paths, place.training);
}

void KeepWhatNoRecordingShows(const PlaceDocument& place, light::CameraTraits& traits) {
  if (place.camera) {
    traits.knee = place.camera->knee;
    traits.response = place.camera->response;
    traits.shutter = place.camera->shutter;
  }
}

}  // namespace

Result<light::CameraTraits> MeasureCamera(capture::FrameSource& source, Progress& progress) {
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<cv::Mat> images, SampleFrames(source, progress));
  const std::optional<double> blur = SharpestQuarter(images);
  if (!blur) {
    return Status::Error("camera", "no frame of the recording shows clear edges",
                         "measure on a recording of the place in good light");
  }
  const vision::ImageNoise noise = vision::EstimateNoise(images).value_or(vision::ImageNoise());
  light::CameraTraits traits;
  traits.width = source.width();
  traits.noise_floor = std::min(static_cast<float>(noise.floor), light::kMaxNoise);
  traits.noise_slope = std::min(static_cast<float>(noise.slope), light::kMaxNoise);
  traits.blur_px = std::min(static_cast<float>(*blur), light::kMaxBlurPx);
  return traits;
}

Result<light::CameraTraits> MeasureCamera(const ProjectPaths& paths,
                                          const PlaceDocument& place,
                                          Progress& progress) {
  LARARIUM_ASSIGN_OR_RETURN(const auto source, OpenSource(paths, place.training));
  LARARIUM_ASSIGN_OR_RETURN(light::CameraTraits traits, MeasureCamera(*source, progress));
  KeepWhatNoRecordingShows(place, traits);
  return traits;
}

Result<light::CameraResponse> LoadCameraResponse(const std::filesystem::path& file) {
  LARARIUM_ASSIGN_OR_RETURN(const Json json, LoadJson(file));
  return ParseFields<light::CameraResponse>(JsonView(json, file.string()), UnknownFields::kIgnore);
}

std::string CameraText(const light::CameraTraits& traits) {
  std::array<char, 256> text;
  std::snprintf(text.data(), text.size(),
                "noise %.4f, %.6f of the value; edges %.2f px soft at %d px width; highlights from "
                "%.2f on%s; shutter %s\n",
                traits.noise_floor, traits.noise_slope, traits.blur_px, traits.width, traits.knee,
                traits.response ? " (the response is measured)" : "",
                traits.shutter ? std::to_string(*traits.shutter).substr(0, 4).c_str()
                               : "learnt while tracking");
  return text.data();
}

CommandResult CameraList(std::span<const capture::ConnectedCamera> cameras) {
  CommandResult result;
  result.json["cameras"] = Json::array();
  for (const capture::ConnectedCamera& camera : cameras) {
    const bool known = camera.problem.empty();
    result.text +=
        std::to_string(camera.number) + "  " + (known ? camera.name : camera.problem) + "\n";
    result.json["cameras"].push_back(
        {{"number", camera.number},
         {known ? "name" : "problem", known ? camera.name : camera.problem}});
  }
  if (cameras.empty()) {
    result.text = "no camera is connected\n";
  }
  return result;
}

Result<CommandResult> RunCamera(const CameraOptions& options, Progress& progress) {
  if (options.list) {
    return CameraList(capture::ConnectedCameras());
  }
  const ProjectPaths paths{options.project};
  LARARIUM_ASSIGN_OR_RETURN(ProjectDocument document, LoadProject(paths));
  LARARIUM_ASSIGN_OR_RETURN(const std::string name, ChoosePlace(paths, document, options.place));
  PlaceDocument& place = *document.FindPlace(name);
  if (options.forget) {
    place.camera.reset();
    LARARIUM_RETURN_IF_ERROR(SaveProject(paths, document));
    return CommandResult{"people of " + name + " stay sharp and clean\n", {{"camera", nullptr}}};
  }
  LARARIUM_ASSIGN_OR_RETURN(const auto source, Recording(options, paths, place));
  LARARIUM_ASSIGN_OR_RETURN(light::CameraTraits traits, MeasureCamera(*source, progress));
  KeepWhatNoRecordingShows(place, traits);
  CommandResult result;
  if (!options.response.empty()) {
    LARARIUM_ASSIGN_OR_RETURN(const light::CameraResponse response,
                              LoadCameraResponse(options.response));
    const light::FittedKnee fitted = light::FitKnee(response);
    traits.knee = fitted.knee;
    traits.response = response;
    result.json["knee_residual"] = fitted.residual;
  }
  if (options.knee) {
    traits.knee = static_cast<float>(*options.knee);
    traits.response.reset();
  }
  if (options.shutter) {
    traits.shutter = static_cast<float>(*options.shutter);
  }
  place.camera = traits;
  LARARIUM_RETURN_IF_ERROR(WriteDevice(options, traits));
  LARARIUM_RETURN_IF_ERROR(SaveProject(paths, document));
  result.text = CameraText(traits);
  result.json["camera"] = FormatFields(traits);
  AddWarnings(source->Notes(), result);
  return result;
}

}  // namespace lararium::editor
