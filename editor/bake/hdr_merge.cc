#include "editor/bake/hdr_merge.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/photo.hpp>

#include "shared/capture/frame_source.h"
#include "shared/core/random.h"

namespace lararium::bake {
namespace {

constexpr const char* kPlace = "brackets";
constexpr int kLeastShown = 16;  // bytes between which a photograph shows a pixel well
constexpr int kMostShown = 240;

cv::Mat Times(std::span<const Bracket> brackets) {
  cv::Mat times(static_cast<int>(brackets.size()), 1, CV_32FC1);
  for (size_t i = 0; i < brackets.size(); ++i) {
    times.at<float>(static_cast<int>(i)) = static_cast<float>(brackets[i].exposure);
  }
  return times;
}

// The sum of the variances of all photographs about each pixel, in squared grey levels.
cv::Mat Unevenness(std::span<const Bracket> brackets) {
  cv::Mat sum = cv::Mat::zeros(brackets[0].bgr.size(), CV_32FC1);
  for (const Bracket& bracket : brackets) {
    cv::Mat grey;
    cv::Mat values;
    cv::Mat mean;
    cv::Mat squares;
    cv::cvtColor(bracket.bgr, grey, cv::COLOR_BGR2GRAY);
    grey.convertTo(values, CV_32F);
    cv::boxFilter(values, mean, CV_32F, {5, 5});
    cv::boxFilter(values.mul(values), squares, CV_32F, {5, 5});
    sum += squares - mean.mul(mean);
  }
  return sum;
}

// The most even of some pixels of each grey level of a photograph, so that no brightness is
// without.
void ChooseOfLevels(const cv::Mat& smooth,
                    const cv::Mat& uneven,
                    Random& random,
                    std::vector<cv::Point>& chosen) {
  constexpr size_t kOfLevel = 2;
  constexpr int kTries = 32;
  constexpr int kStep = 8;  // levels
  std::array<std::vector<cv::Point>, 256> levels;
  for (int y = 0; y < smooth.rows; ++y) {
    for (int x = 0; x < smooth.cols; ++x) {
      levels[smooth.at<cv::Vec3b>(y, x)[1]].emplace_back(x, y);
    }
  }
  for (size_t level = kStep / 2; level < 254; level += kStep) {
    const std::vector<cv::Point>& all = levels[level];
    std::vector<cv::Point> tried;
    for (int i = 0; i < kTries && !all.empty(); ++i) {
      tried.push_back(all[random.Below(static_cast<uint32_t>(all.size()))]);
    }
    std::sort(tried.begin(), tried.end(), [&](const cv::Point& a, const cv::Point& b) {
      return uneven.at<float>(a) < uneven.at<float>(b);
    });
    tried.resize(std::min(tried.size(), kOfLevel));
    chosen.insert(chosen.end(), tried.begin(), tried.end());
  }
}

// Pixels where the photographs change little, a strip of them as one image for each: blur,
// noise and small motions count little there.
std::vector<cv::Mat> ChooseSamples(std::span<const Bracket> brackets) {
  const cv::Mat uneven = Unevenness(brackets);
  std::vector<cv::Mat> smooth;
  std::vector<cv::Point> chosen;
  Random random(1);
  for (const Bracket& bracket : brackets) {
    smooth.emplace_back();
    cv::boxFilter(bracket.bgr, smooth.back(), -1, {3, 3});
    ChooseOfLevels(smooth.back(), uneven, random, chosen);
  }
  std::vector<cv::Mat> strips;
  for (const cv::Mat& image : smooth) {
    cv::Mat strip(1, static_cast<int>(chosen.size()), CV_8UC3);
    for (size_t i = 0; i < chosen.size(); ++i) {
      strip.at<cv::Vec3b>(static_cast<int>(i)) = image.at<cv::Vec3b>(chosen[i]);
    }
    strips.push_back(strip);
  }
  return strips;
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

// How far a byte may be trusted: not at all where it is clipped, or may be but for noise and
// the ringing of JPEG.
float Trust(uchar byte) {
  constexpr int kBlack = 4;
  constexpr int kWhite = 247;
  return static_cast<float>(std::max(0, std::min(byte - kBlack, kWhite - byte)));
}

// Of one channel of a pixel: exposures summed over times summed, so that photographs with
// more light, and less noise, count more.
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
                         "give one for each, or none where the files have EXIF data");
  }
  std::vector<Bracket> brackets;
  for (size_t i = 0; i < files.size(); ++i) {
    Bracket bracket{files[i].string(), {}, 0.0};
    try {
      bracket.bgr = cv::imread(files[i].string(), cv::IMREAD_COLOR | cv::IMREAD_IGNORE_ORIENTATION);
    } catch (const std::exception& error) {
      return Status::Error(bracket.name, std::string("cannot be read: ") + error.what());
    }
    if (bracket.bgr.empty()) {
      return Status::Error(bracket.name, "cannot be read as a photograph", "use JPEG or PNG");
    }
    bracket.exposure =
        exposures.empty() ? capture::ExifExposure(files[i]).value_or(0.0) : exposures[i];
    brackets.push_back(std::move(bracket));
  }
  LARARIUM_RETURN_IF_ERROR(Validate(brackets));
  return brackets;
}

Result<CalibratedResponse> CalibrateResponse(std::span<const Bracket> brackets) {
  LARARIUM_RETURN_IF_ERROR(Validate(brackets));
  constexpr int kLeastSamples = 64;
  constexpr float kSmoothness = 30.0f;
  const std::vector<cv::Mat> strips = ChooseSamples(brackets);
  const int count = strips[0].cols;
  if (count < kLeastSamples) {
    return Status::Error(
        kPlace, "too few even places to calibrate the camera from",
        "photograph something with plain bright and dark surfaces, without moving");
  }
  CalibratedResponse calibrated;
  try {
    // The solver is dense in the number of samples.
    const int used = std::min(count, 300);
    std::vector<cv::Mat> thinned;
    for (const cv::Mat& strip : strips) {
      cv::Mat thin(1, used, CV_8UC3);
      for (int i = 0; i < used; ++i) {
        thin.at<cv::Vec3b>(i) = strip.at<cv::Vec3b>(static_cast<int>(int64_t{i} * count / used));
      }
      thinned.push_back(thin);
    }
    cv::Mat curve;
    cv::createCalibrateDebevec(used, kSmoothness, false)->process(thinned, curve, Times(brackets));
    if (curve.total() != 256 || curve.type() != CV_32FC3 || !cv::checkRange(curve)) {
      return Status::Error(kPlace, "give no response of the camera",
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
    return Status::Error(kPlace, std::string("give no response of the camera: ") + error.what());
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
          // No photograph shows it: what the shortest or the longest allows.
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
