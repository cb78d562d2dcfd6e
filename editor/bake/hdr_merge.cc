#include "editor/bake/hdr_merge.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <opencv2/photo.hpp>

#include "shared/capture/frame_source.h"

namespace lararium::bake {
namespace {

constexpr const char* kPlace = "brackets";
// A photograph shows a pixel well if its byte is within these limits.
constexpr int kLeastShown = 16;
constexpr int kMostShown = 240;

std::vector<cv::Mat> Images(std::span<const Bracket> brackets) {
  std::vector<cv::Mat> images;
  for (const Bracket& bracket : brackets) {
    images.push_back(bracket.bgr);
  }
  return images;
}

cv::Mat Times(std::span<const Bracket> brackets) {
  cv::Mat times(static_cast<int>(brackets.size()), 1, CV_32FC1);
  for (size_t i = 0; i < brackets.size(); ++i) {
    times.at<float>(static_cast<int>(i)) = static_cast<float>(brackets[i].exposure);
  }
  return times;
}

// Counts the pixels that two photographs both show well.
size_t CountTelling(std::span<const Bracket> brackets) {
  size_t telling = 0;
  for (int y = 0; y < brackets[0].bgr.rows; ++y) {
    for (int x = 0; x < brackets[0].bgr.cols; ++x) {
      int shown = 0;
      for (const Bracket& bracket : brackets) {
        const uchar green = bracket.bgr.at<cv::Vec3b>(y, x)[1];
        shown += green > kLeastShown && green < kMostShown ? 1 : 0;
      }
      telling += shown > 1 ? 1 : 0;
    }
  }
  return telling;
}

double Residual(std::span<const Bracket> brackets, const light::CameraResponse& response) {
  constexpr int kStep = 7;
  double squares = 0.0;
  size_t count = 0;
  const cv::Size size = brackets[0].bgr.size();
  for (int y = 0; y < size.height; y += kStep) {
    for (int x = 0; x < size.width; x += kStep) {
      for (size_t i = 1; i < brackets.size(); ++i) {
        const cv::Vec3b& a = brackets[i - 1].bgr.at<cv::Vec3b>(y, x);
        const cv::Vec3b& b = brackets[i].bgr.at<cv::Vec3b>(y, x);
        for (int c = 0; c < 3; ++c) {
          if (std::min(a[c], b[c]) < kLeastShown || std::max(a[c], b[c]) > kMostShown) {
            continue;
          }
          const light::CameraResponse::Curve& curve = response.linear[2 - c];
          const double difference =
              std::log(std::max(curve[a[c]], 1e-6f) / brackets[i - 1].exposure) -
              std::log(std::max(curve[b[c]], 1e-6f) / brackets[i].exposure);
          squares += difference * difference;
          ++count;
        }
      }
    }
  }
  return count > 0 ? std::sqrt(squares / static_cast<double>(count)) : 0.0;
}

// Reliability of a byte: 0 where it is clipped, or could be clipped apart from noise and JPEG
// ringing.
float Trust(uchar byte) {
  constexpr int kBlack = 4;
  constexpr int kWhite = 247;
  return static_cast<float>(std::max(0, std::min(byte - kBlack, kWhite - byte)));
}

// Accumulates one channel of a pixel: the sum of exposures over the sum of times, so that
// photographs with more light, and less noise, have more weight.
struct Sum {
  float light = 0.0f;
  float time = 0.0f;
};

Sum SumOfChannel(std::span<const Bracket> brackets,
                 const light::CameraResponse::Curve& curve,
                 const cv::Point& at,
                 int bgr_channel) {
  Sum sum;
  for (const Bracket& bracket : brackets) {
    const uchar byte = bracket.bgr.at<cv::Vec3b>(at)[bgr_channel];
    const float trust = Trust(byte);
    sum.light += trust * curve[byte];
    sum.time += trust * static_cast<float>(bracket.exposure);
  }
  return sum;
}

}  // namespace

Status Validate(std::span<const Bracket> brackets) {
  if (brackets.size() < 2 || brackets.size() > 32) {
    return Status::Error(kPlace, "there are " + std::to_string(brackets.size()) + " photographs",
                         "give 2 to 32 of one view");
  }
  double least = brackets[0].exposure;
  double most = least;
  for (const Bracket& bracket : brackets) {
    if (bracket.bgr.type() != CV_8UC3 || bracket.bgr.empty()) {
      return Status::Error(bracket.name, "is not a colour photograph of 8 bits");
    }
    if (bracket.bgr.size() != brackets[0].bgr.size()) {
      return Status::Error(bracket.name, "has another size than " + brackets[0].name,
                           "give photographs of one camera and view");
    }
    if (!(bracket.exposure > 1e-9 && bracket.exposure < 1e9)) {
      return Status::Error(bracket.name, "its exposure is not known",
                           "give the exposure time of each photograph");
    }
    least = std::min(least, bracket.exposure);
    most = std::max(most, bracket.exposure);
  }
  if (most < 1.5 * least) {
    return Status::Error(kPlace, "the exposures are nearly the same",
                         "take them one to three stops apart");
  }
  return Status();
}

Result<std::vector<Bracket>> ReadBrackets(std::span<const std::filesystem::path> files,
                                          std::span<const double> exposures) {
  if (!exposures.empty() && exposures.size() != files.size()) {
    return Status::Error(kPlace,
                         std::to_string(exposures.size()) + " exposures for " +
                             std::to_string(files.size()) + " photographs",
                         "give one for each, or none if the files have EXIF data");
  }
  std::vector<Bracket> brackets;
  for (size_t i = 0; i < files.size(); ++i) {
    Bracket bracket{files[i].string(), {}, 0.0};
    LARARIUM_ASSIGN_OR_RETURN(bracket.bgr, capture::ReadPhotograph(files[i]));
    bracket.exposure =
        exposures.empty() ? capture::ExifExposure(files[i]).value_or(0.0) : exposures[i];
    brackets.push_back(std::move(bracket));
  }
  LARARIUM_RETURN_IF_ERROR(Validate(brackets));
  return brackets;
}

Result<CalibratedResponse> CalibrateResponse(std::span<const Bracket> brackets) {
  LARARIUM_RETURN_IF_ERROR(Validate(brackets));
  // Samples on a grid over the photographs; the solver is dense in the number of samples.
  constexpr int kSamples = 300;
  constexpr float kSmoothness = 20.0f;
  if (CountTelling(brackets) < kSamples) {
    return Status::Error(kPlace, "too few pixels are well exposed in two photographs",
                         "take them one to three stops apart");
  }
  CalibratedResponse calibrated;
  try {
    cv::Mat curve;
    cv::createCalibrateDebevec(kSamples, kSmoothness, false)
        ->process(Images(brackets), curve, Times(brackets));
    if (curve.total() != 256 || curve.type() != CV_32FC3 || !cv::checkRange(curve)) {
      return Status::Error(kPlace, "do not determine the response of the camera",
                           "check that the exposures are those of the photographs");
    }
    for (int c = 0; c < 3; ++c) {
      light::CameraResponse::Curve raw;
      for (int i = 0; i < 256; ++i) {
        raw[i] = curve.at<cv::Vec3f>(i)[2 - c];
      }
      calibrated.response.linear[c] = light::Monotone(raw);
    }
  } catch (const std::exception& error) {
    return Status::Error(
        kPlace, std::string("do not determine the response of the camera: ") + error.what());
  }
  LARARIUM_RETURN_IF_ERROR(calibrated.response.Validate(kPlace));
  calibrated.residual = Residual(brackets, calibrated.response);
  return calibrated;
}

Result<MergedImage> MergeBrackets(std::span<const Bracket> brackets,
                                  const light::CameraResponse& response) {
  LARARIUM_RETURN_IF_ERROR(Validate(brackets));
  LARARIUM_RETURN_IF_ERROR(response.Validate(kPlace));
  const auto [shortest, longest] = std::minmax_element(
      brackets.begin(), brackets.end(),
      [](const Bracket& a, const Bracket& b) { return a.exposure < b.exposure; });
  MergedImage merged;
  merged.linear.create(brackets[0].bgr.size(), CV_32FC3);
  for (int y = 0; y < merged.linear.rows; ++y) {
    for (int x = 0; x < merged.linear.cols; ++x) {
      bool clipped = false;
      bool unexposed = false;
      for (int c = 0; c < 3; ++c) {
        const light::CameraResponse::Curve& curve = response.linear[c];
        Sum sum = SumOfChannel(brackets, curve, {x, y}, 2 - c);
        if (sum.time <= 0.0f) {
          // No photograph shows the pixel; use the limit of the shortest or longest exposure.
          const bool bright = longest->bgr.at<cv::Vec3b>(y, x)[2 - c] >= 128;
          const Bracket& bound = bright ? *shortest : *longest;
          sum = {curve[bound.bgr.at<cv::Vec3b>(y, x)[2 - c]], static_cast<float>(bound.exposure)};
          (bright ? clipped : unexposed) = true;
        }
        merged.linear.at<cv::Vec3f>(y, x)[c] = sum.light / sum.time;
      }
      merged.clipped += clipped ? 1 : 0;
      merged.unexposed += unexposed ? 1 : 0;
    }
  }
  merged.residual = Residual(brackets, response);
  return merged;
}

}  // namespace lararium::bake
