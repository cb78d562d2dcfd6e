#include "shared/light/camera_response.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "shared/core/json.h"
#include "shared/core/srgb.h"

namespace lararium::light {
namespace {

constexpr const char* kChannels[3] = {"r", "g", "b"};
constexpr double kLargest = 1e6;

CameraResponse Uniform(const CameraResponse::Curve& curve) { return {{curve, curve, curve}}; }

float SeenThrough(const CameraResponse::Curve& curve, float exposure) {
  if (exposure >= curve.back()) {
    return 1.0f;
  }
  // If several bytes have this exposure, the last one counts.
  const auto above = std::upper_bound(curve.begin(), curve.end(), exposure);
  if (above == curve.begin()) {
    return 0.0f;
  }
  const float before = *(above - 1);
  const auto byte = static_cast<double>(above - curve.begin() - 1);
  return static_cast<float>(
      LinearFromSrgb((byte + (exposure - before) / (*above - before)) / 255.0));
}

}  // namespace

Status CameraResponse::Validate(std::string_view where) const {
  for (size_t c = 0; c < 3; ++c) {
    for (size_t i = 0; i < 256; ++i) {
      const float value = linear[c][i];
      if (!(value >= 0.0f && value < kLargest) || (i > 0 && value < linear[c][i - 1])) {
        return Status::Error(where,
                             std::string("the camera's response falls or is not a number at "
                                         "value ") +
                                 std::to_string(i) + " of channel " + kChannels[c],
                             "calibrate the camera again");
      }
    }
    if (!(linear[c][kReference] > 0.0f)) {
      return Status::Error(where, "the camera's response is 0 in the middle",
                           "calibrate the camera again");
    }
  }
  return Status();
}

glm::vec3 CameraResponse::Seen(const glm::vec3& exposure) const {
  return {light::SeenThrough(linear[0], exposure.r), light::SeenThrough(linear[1], exposure.g),
          light::SeenThrough(linear[2], exposure.b)};
}

std::array<glm::vec3, kSeenSteps> SeenTable(const CameraResponse& response) {
  std::array<glm::vec3, kSeenSteps> table;
  for (size_t i = 0; i + 1 < kSeenSteps; ++i) {
    const float u = static_cast<float>(i) / static_cast<float>(kSeenSteps - 1);
    table[i] = response.Seen(glm::vec3(u / (1.0f - u)));
  }
  table.back() = glm::vec3(1.0f);
  return table;
}

CameraResponse SrgbResponse() { return ShoulderResponse(1.0f); }

CameraResponse ShoulderResponse(float knee) {
  CameraResponse::Curve curve;
  for (size_t i = 0; i < curve.size(); ++i) {
    const double shown = LinearFromSrgb(static_cast<double>(i) / 255.0);
    const double rest = 1.0 - knee;
    // White itself would need an infinite exposure.
    const double above = std::min((shown - knee) / std::max(rest, 1e-9), 1.0 - 1.0 / 512.0);
    curve[i] =
        static_cast<float>(shown <= knee || rest <= 0.0 ? shown : knee - rest * std::log1p(-above));
  }
  return Uniform(curve);
}

FittedKnee FitKnee(const CameraResponse& response) {
  constexpr int kLow = 32;
  constexpr int kHigh = 250;
  FittedKnee best;
  best.residual = 1e9f;
  for (int step = 30; step <= 100; ++step) {
    const auto knee = static_cast<float>(step) / 100.0f;
    const CameraResponse::Curve model = ShoulderResponse(knee).linear[0];
    double squares = 0.0;
    for (const CameraResponse::Curve& curve : response.linear) {
      for (int i = kLow; i <= kHigh; ++i) {
        const double difference = std::log(std::max(curve[i], 1e-6f) / model[i]);
        squares += difference * difference;
      }
    }
    const auto residual = static_cast<float>(std::sqrt(squares / (3.0 * (kHigh - kLow + 1))));
    if (residual < best.residual) {
      best = {knee, residual};
    }
  }
  return best;
}

void DescribeFields(Fields& fields, CameraResponse& response) {
  for (size_t c = 0; c < 3; ++c) {
    fields.Numbers(kChannels[c], response.linear[c]);
  }
  fields.Check(response.Validate(fields.where()));
}

CameraResponse::Curve Monotone(const CameraResponse::Curve& curve) {
  struct Block {
    double mean = 0.0;
    size_t count = 0;
  };
  std::vector<Block> blocks;
  for (const float value : curve) {
    blocks.push_back({value, 1});
    while (blocks.size() > 1 && blocks[blocks.size() - 2].mean > blocks.back().mean) {
      const Block last = blocks.back();
      blocks.pop_back();
      Block& block = blocks.back();
      block.mean = (block.mean * static_cast<double>(block.count) +
                    last.mean * static_cast<double>(last.count)) /
                   static_cast<double>(block.count + last.count);
      block.count += last.count;
    }
  }
  CameraResponse::Curve rising;
  size_t at = 0;
  for (const Block& block : blocks) {
    std::fill_n(rising.begin() + static_cast<ptrdiff_t>(at), block.count,
                static_cast<float>(std::max(0.0, block.mean)));
    at += block.count;
  }
  const double unit = LinearFromSrgb(CameraResponse::kReference / 255.0);
  const double scale =
      unit / std::max(1e-12, static_cast<double>(rising[CameraResponse::kReference]));
  for (float& value : rising) {
    value = static_cast<float>(value * scale);
  }
  return rising;
}

}  // namespace lararium::light
