#include "editor/cli/probe_commands.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>
#include <opencv2/core.hpp>

#include "editor/bake/exr_image.h"
#include "editor/bake/hdr_merge.h"
#include "editor/bake/mirror_ball.h"
#include "editor/bake/probe_match.h"
#include "editor/bake/sun_split.h"
#include "editor/cli/place_probe_commands.h"
#include "editor/jobs/camera_measure.h"
#include "shared/capture/frame_source.h"
#include "shared/core/lower_case.h"
#include "shared/core/units.h"
#include "shared/light/camera_response.h"

namespace lararium::editor {
namespace {

std::string Text(const char* format, auto... values) {
  std::array<char, 512> text;
  std::snprintf(text.data(), text.size(), format, values...);
  return text.data();
}

Json Triple(const glm::vec3& v) { return Json::array({v.x, v.y, v.z}); }

double Azimuth(const glm::vec3& d) { return std::atan2(d.x, -d.z) * kDegreesPerRadian; }
double Elevation(const glm::vec3& d) {
  return std::asin(std::clamp(d.y, -1.0f, 1.0f)) * kDegreesPerRadian;
}
glm::vec3 Direction(double azimuth_deg, double elevation_deg) {
  const double azimuth = azimuth_deg / kDegreesPerRadian;
  const double elevation = elevation_deg / kDegreesPerRadian;
  return {std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
          -std::cos(elevation) * std::cos(azimuth)};
}

std::string Lines(const std::vector<std::string>& warnings) {
  std::string text;
  for (const std::string& warning : warnings) {
    text += "warning: " + warning + "\n";
  }
  return text;
}

Json SunJson(const bake::SplitProbe& split) {
  const light::Sun& found = split.brightest;
  return {{"is_sun", split.sun.has_value()},
          {"azimuth_deg", Azimuth(found.direction)},
          {"elevation_deg", Elevation(found.direction)},
          {"radius_deg", found.angular_radius * kDegreesPerRadian},
          {"irradiance", Triple(found.irradiance)},
          {"share", split.share}};
}

Result<CommandResult> Info(const ProbeOptions& options) {
  LARARIUM_ASSIGN_OR_RETURN(const bake::ProbeImage image, bake::ReadProbeImage(options.files[0]));
  const bake::SplitProbe split = bake::SplitSun(image);
  const light::ProbeLight light = bake::ProjectProbeLight(image, {});
  const light::Sun& found = split.brightest;
  const glm::vec3 up = light.Irradiance({0.0f, 1.0f, 0.0f});
  CommandResult result;
  result.text =
      Lines(image.warnings) +
      Text("%d x %d; a level floor gets irradiance %.3f %.3f %.3f\n", image.width, image.height,
           up.r, up.g, up.b) +
      Text(
          "%s at azimuth %.1f, elevation %.1f, radius %.2f degrees; irradiance %.3f %.3f "
          "%.3f, %.1f %% of what falls on a surface facing it\n",
          split.sun ? "a sun" : "no sun: the brightest place is", Azimuth(found.direction),
          Elevation(found.direction), found.angular_radius * kDegreesPerRadian, found.irradiance.r,
          found.irradiance.g, found.irradiance.b, 100.0 * split.share);
  result.json = {{"width", image.width},
                 {"height", image.height},
                 {"floor_irradiance", Triple(up)},
                 {"brightest", SunJson(split)},
                 {"warnings", image.warnings}};
  return result;
}

struct Merged {
  bake::MergedImage image;
  light::CameraResponse response;
};

Result<Merged> Merge(const ProbeOptions& options) {
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<bake::Bracket> brackets,
                            bake::ReadBrackets(options.files, options.exposures));
  Merged merged;
  if (options.response.empty()) {
    LARARIUM_ASSIGN_OR_RETURN(const bake::CalibratedResponse calibrated,
                              bake::CalibrateResponse(brackets));
    merged.response = calibrated.response;
  } else {
    LARARIUM_ASSIGN_OR_RETURN(merged.response, LoadCameraResponse(options.response));
  }
  LARARIUM_ASSIGN_OR_RETURN(merged.image, bake::MergeBrackets(brackets, merged.response));
  return merged;
}

Status WriteLinear(const std::filesystem::path& file, const cv::Mat& linear) {
  std::vector<glm::vec4> pixels;
  pixels.reserve(linear.total());
  for (int y = 0; y < linear.rows; ++y) {
    for (int x = 0; x < linear.cols; ++x) {
      const cv::Vec3f& p = linear.at<cv::Vec3f>(y, x);
      pixels.emplace_back(p[0], p[1], p[2], 1.0f);
    }
  }
  return bake::WriteExr(file, linear.cols, linear.rows, pixels);
}

Json MergeJson(const Merged& merged) {
  const light::FittedKnee knee = light::FitKnee(merged.response);
  return {{"residual_stops", merged.image.residual / std::log(2.0)},
          {"clipped", merged.image.clipped},
          {"unexposed", merged.image.unexposed},
          {"knee", knee.knee},
          {"knee_residual", knee.residual}};
}

std::string MergeText(const Merged& merged) {
  const light::FittedKnee knee = light::FitKnee(merged.response);
  std::string text =
      Text("the exposures agree within %.3f stops; the camera is linear up to %.2f (%.3f off)\n",
           merged.image.residual / std::log(2.0), knee.knee, knee.residual);
  if (merged.image.clipped > 0) {
    text += Text(
        "warning: %zu pixels are white even in the shortest exposure; lamps and the sun "
        "are too weak\n",
        merged.image.clipped);
  }
  return text;
}

Result<CommandResult> RunMerge(const ProbeOptions& options) {
  LARARIUM_ASSIGN_OR_RETURN(const Merged merged, Merge(options));
  LARARIUM_RETURN_IF_ERROR(WriteLinear(options.out, merged.image.linear));
  if (!options.response_out.empty()) {
    LARARIUM_RETURN_IF_ERROR(SaveJson(options.response_out, FormatFields(merged.response)));
  }
  CommandResult result;
  result.text = "wrote " + options.out.string() + "\n" + MergeText(merged);
  result.json = MergeJson(merged);
  result.json["out"] = options.out.string();
  return result;
}

// Linear R, G, B of the picture of a ball: merged from photographs, an HDR picture, or one
// photograph.
Result<cv::Mat> BallPicture(const ProbeOptions& options, std::string& notes) {
  if (options.files.size() > 1) {
    LARARIUM_ASSIGN_OR_RETURN(const Merged merged, Merge(options));
    notes += MergeText(merged);
    return merged.image.linear;
  }
  const std::string extension = LowerCase(options.files[0].extension().string());
  if (extension == ".exr" || extension == ".hdr" || extension == ".pic") {
    LARARIUM_ASSIGN_OR_RETURN(const bake::ProbeImage image, bake::ReadHdrPicture(options.files[0]));
    notes += Lines(image.warnings);
    cv::Mat linear(image.height, image.width, CV_32FC3);
    for (size_t i = 0; i < image.pixels.size(); ++i) {
      const glm::vec3& p = image.pixels[i];
      linear.at<cv::Vec3f>(static_cast<int>(i / image.width), static_cast<int>(i % image.width)) = {
          p.r, p.g, p.b};
    }
    return linear;
  }
  LARARIUM_ASSIGN_OR_RETURN(const cv::Mat bgr, capture::ReadPhotograph(options.files[0]));
  light::CameraResponse response = light::SrgbResponse();
  if (!options.response.empty()) {
    LARARIUM_ASSIGN_OR_RETURN(response, LoadCameraResponse(options.response));
  }
  notes +=
      "warning: one photograph has too small a range of brightness; lamps and the sun are too "
      "weak\n";
  cv::Mat linear(bgr.size(), CV_32FC3);
  for (int y = 0; y < bgr.rows; ++y) {
    for (int x = 0; x < bgr.cols; ++x) {
      const cv::Vec3b& b = bgr.at<cv::Vec3b>(y, x);
      const glm::vec3 value = response.Linear(b[2], b[1], b[0]);
      linear.at<cv::Vec3f>(y, x) = {value.r, value.g, value.b};
    }
  }
  return linear;
}

// Converts to perceived brightness for the detection of the outline.
cv::Mat Shown(const cv::Mat& linear) {
  const cv::Scalar mean = cv::mean(linear);
  const double scale = 0.4 / std::max(1e-9, (mean[0] + mean[1] + mean[2]) / 3.0);
  cv::Mat shown(linear.size(), CV_8UC1);
  for (int y = 0; y < linear.rows; ++y) {
    for (int x = 0; x < linear.cols; ++x) {
      const cv::Vec3f& p = linear.at<cv::Vec3f>(y, x);
      const double value = scale * (p[0] + p[1] + p[2]) / 3.0;
      shown.at<uchar>(y, x) = cv::saturate_cast<uchar>(255.0 * std::pow(value, 1.0 / 2.2));
    }
  }
  return shown;
}

Result<CommandResult> Ball(const ProbeOptions& options) {
  CommandResult result;
  LARARIUM_ASSIGN_OR_RETURN(const cv::Mat linear, BallPicture(options, result.text));
  bake::BallView view;
  view.distance = options.distance;
  view.reflectance = glm::vec3(static_cast<float>(options.reflectance));
  if (options.circle.size() == 3) {
    view.circle = {options.circle[0], options.circle[1], options.circle[2], 0.0};
  } else {
    const auto found = bake::FindBall(Shown(linear));
    if (!found) {
      return Status::Error(options.files[0].string(), "no ball was found in the picture",
                           "give its outline: --circle x,y,radius");
    }
    view.circle = *found;
  }
  LARARIUM_ASSIGN_OR_RETURN(const bake::ProbeImage probe,
                            bake::UnwrapBall(linear, view, options.width));
  std::vector<glm::vec4> pixels;
  for (const glm::vec3& pixel : probe.pixels) {
    pixels.emplace_back(pixel, 1.0f);
  }
  LARARIUM_RETURN_IF_ERROR(bake::WriteExr(options.out, probe.width, probe.height, pixels));
  const bake::BallCircle& c = view.circle;
  result.text = "wrote " + options.out.string() + "\n" + result.text +
                Text("ball at %.1f, %.1f with radius %.1f pixels (edges %.2f off)\n", c.x, c.y,
                     c.radius, c.residual_px);
  result.json = {{"out", options.out.string()},
                 {"circle", {c.x, c.y, c.radius}},
                 {"residual_px", c.residual_px}};
  return result;
}

Result<CommandResult> Match(const ProbeOptions& options) {
  LARARIUM_ASSIGN_OR_RETURN(
      const bake::DirectionMatch match,
      MatchProbe(options, options.files[0], glm::quat(1.0f, 0.0f, 0.0f, 0.0f)));
  const glm::quat& q = match.stage_from_probe;
  CommandResult result;
  result.text = Text("rotation (w, x, y, z) %.5f, %.5f, %.5f, %.5f; %.2f degrees off\n", q.w, q.x,
                     q.y, q.z, match.residual * kDegreesPerRadian);
  result.json = {{"rotation", {q.w, q.x, q.y, q.z}},
                 {"residual_deg", match.residual * kDegreesPerRadian}};
  return result;
}

glm::vec3 Vector(const std::vector<double>& v) {
  return v.size() == 3 ? glm::vec3(v[0], v[1], v[2]) : glm::vec3(static_cast<float>(v[0]));
}

Result<CommandResult> Scale(const ProbeOptions& options) {
  LARARIUM_ASSIGN_OR_RETURN(const bake::ProbeImage image, bake::ReadProbeImage(options.files[0]));
  LARARIUM_ASSIGN_OR_RETURN(const bake::GreyPatch patch, GreyPatchOf(options));
  const bake::ProbePlacement placement = {
      glm::angleAxis(glm::radians(static_cast<float>(options.turn)), glm::vec3(0.0f, 1.0f, 0.0f)),
      1.0f};
  LARARIUM_ASSIGN_OR_RETURN(
      const bake::ScaleMatch match,
      bake::MatchScale(bake::ProjectProbeLight(image, placement), {&patch, 1}));
  CommandResult result;
  result.text =
      Text("brightness %.4f; channels beyond it %.3f %.3f %.3f; %.2f stops off\n", match.scale,
           match.balance.r, match.balance.g, match.balance.b, match.residual);
  result.json = {{"scale", match.scale},
                 {"balance", Triple(match.balance)},
                 {"residual_stops", match.residual}};
  return result;
}

}  // namespace

Result<bake::DirectionMatch> MatchProbe(const ProbeOptions& options,
                                        const std::filesystem::path& file,
                                        const glm::quat& stage_from_probe) {
  const std::vector<double>& n = options.pairs;
  if (n.size() == 8) {
    return bake::MatchDirections({Direction(n[0], n[1]), Direction(n[2], n[3])},
                                 {Direction(n[4], n[5]), Direction(n[6], n[7])});
  }
  bake::DirectionPair pair;
  if (n.size() == 2) {
    LARARIUM_ASSIGN_OR_RETURN(const bake::ProbeImage image, bake::ReadProbeImage(file));
    pair = {bake::SplitSun(image).brightest.direction, Direction(n[0], n[1])};
  } else if (n.size() == 4) {
    pair = {Direction(n[0], n[1]), Direction(n[2], n[3])};
  } else {
    return Status::Error("the directions", "take 2, 4 or 8 numbers");
  }
  bake::DirectionMatch match;
  match.stage_from_probe = options.level
                               ? bake::TurnedTo(stage_from_probe, pair.in_probe, pair.in_stage)
                               : bake::DraggedTo(stage_from_probe, pair.in_probe, pair.in_stage);
  const float cosine = glm::dot(match.stage_from_probe * pair.in_probe, pair.in_stage);
  match.residual = std::acos(std::clamp(cosine, -1.0f, 1.0f));
  return match;
}

Result<bake::GreyPatch> GreyPatchOf(const ProbeOptions& options) {
  light::CameraResponse response = light::SrgbResponse();
  if (!options.response.empty()) {
    LARARIUM_ASSIGN_OR_RETURN(response, LoadCameraResponse(options.response));
  }
  bake::GreyPatch patch;
  for (int c = 0; c < 3; ++c) {
    patch.linear[c] =
        response
            .linear[c][static_cast<size_t>(std::clamp(std::lround(options.pixel[c]), 0L, 255L))];
  }
  patch.gain = Vector(options.gain);
  patch.albedo = Vector(options.albedo);
  const glm::vec3 normal = Vector(options.normal);
  if (!(glm::length(normal) > 1e-3f)) {
    return Status::Error("--normal", "is not a direction");
  }
  patch.normal = glm::normalize(normal);
  return patch;
}

Result<CommandResult> RunProbe(const ProbeOptions& options) {
  switch (options.work) {
    case ProbeOptions::Work::kMerge:
      return RunMerge(options);
    case ProbeOptions::Work::kBall:
      return Ball(options);
    case ProbeOptions::Work::kMatch:
      return Match(options);
    case ProbeOptions::Work::kScale:
      return Scale(options);
    case ProbeOptions::Work::kList:
    case ProbeOptions::Work::kAdd:
    case ProbeOptions::Work::kSet:
    case ProbeOptions::Work::kRemove:
      return RunPlaceProbe(options);
    case ProbeOptions::Work::kInfo:
      break;
  }
  return Info(options);
}

}  // namespace lararium::editor
