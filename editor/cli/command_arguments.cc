#include "editor/cli/command_arguments.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "editor/document/angles.h"
#include "editor/document/document_fields.h"
#include "editor/text/text.h"
#include "shared/core/units.h"

namespace lararium::editor {

namespace {

// Accepts numbers that are not finite.
std::optional<double> ParseAnyNumber(std::string_view text) {
  double number = 0.0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, number);
  return error == std::errc() && rest == end ? std::optional(number) : std::nullopt;
}

}  // namespace

Result<Eigen::Vector3d> ParsePosition(const std::string& option,
                                      const std::vector<double>& numbers) {
  if (numbers.size() == 3) {
    const Eigen::Vector3d position(numbers[0], numbers[1], numbers[2]);
    if (position.allFinite() && position.cwiseAbs().maxCoeff() <= kMaxLength) {
      return position;
    }
  }
  return Status::Error(option, "is not a position on the stage", "give three numbers, in metres");
}

Eigen::Quaterniond RotationOf(const std::vector<double>& degrees) {
  Eigen::Vector3d angles = Eigen::Vector3d::Zero();
  for (size_t i = 0; i < std::min<size_t>(degrees.size(), 3); ++i) {
    angles[static_cast<Eigen::Index>(i)] = degrees[i] * kRadiansPerDegree;
  }
  return FromHeadingTiltRoll(angles);
}

std::string DescribeTurn(const Eigen::Quaterniond& rotation) {
  Eigen::Vector3d turn = HeadingTiltRoll(rotation) / kRadiansPerDegree;
  turn = (turn * 10.0).array().round() / 10.0 + 0.0;  // Avoids -0.0.
  return Text("turned %.1f,%.1f,%.1f degrees", turn.x(), turn.y(), turn.z());
}

std::string DescribePose(const geometry::Similarity3& stage_from_thing) {
  const Eigen::Vector3d& at = stage_from_thing.translation;
  std::string text = Text("at %.3f,%.3f,%.3f", at.x(), at.y(), at.z());
  const Eigen::Vector3d turn = HeadingTiltRoll(stage_from_thing.rotation) / kRadiansPerDegree;
  if (turn.cwiseAbs().maxCoeff() >= 0.05) {
    text += ", " + DescribeTurn(stage_from_thing.rotation);
  }
  if (std::abs(stage_from_thing.scale - 1.0) >= 5e-5) {
    text += Text(", scaled by %.4f", stage_from_thing.scale);
  }
  return text;
}

std::optional<double> ParseNumber(std::string_view text) {
  const std::optional<double> number = ParseAnyNumber(text);
  return number && std::isfinite(*number) ? number : std::nullopt;
}

Result<const vision::Keyframe*> FindKeyframe(const vision::SceneDatabase& map,
                                             const std::string& where,
                                             const std::string& frame,
                                             uint32_t session) {
  const auto image = std::find_if(map.keyframes.begin(), map.keyframes.end(),
                                  [&](const vision::Keyframe& keyframe) {
                                    return keyframe.name == frame && keyframe.session == session;
                                  });
  if (image == map.keyframes.end()) {
    return Status::Error(frame, "is not a training image of the map of " + where,
                         map.keyframes.empty() ? "train the place"
                                               : "they begin with " + map.keyframes[0].name +
                                                     "; `place --images` lists them");
  }
  return &*image;
}

Result<stage::Pick> PickInImage(const vision::SceneDatabase& map,
                                const std::string& where,
                                const std::string& frame,
                                uint32_t session,
                                const Eigen::Vector2d& pixel) {
  LARARIUM_ASSIGN_OR_RETURN(const vision::Keyframe* image,
                            FindKeyframe(map, where, frame, session));
  if (!map.camera.Contains(pixel)) {
    return Status::Error(frame, "the pixel lies outside of the image",
                         "it has " + std::to_string(map.camera.width) + " x " +
                             std::to_string(map.camera.height) + " pixels");
  }
  return stage::Pick{image->frame_index, image->name, pixel, session};
}

Result<stage::Pick> ParsePick(const vision::SceneDatabase& map,
                              const std::string& where,
                              uint32_t session,
                              const std::string& option,
                              const std::string& text) {
  const std::string_view all = text;
  const size_t y_at = all.rfind(',');
  const size_t x_at = y_at == std::string_view::npos || y_at == 0 ? std::string_view::npos
                                                                  : all.rfind(',', y_at - 1);
  if (x_at != std::string_view::npos) {
    const std::optional<double> x = ParseAnyNumber(all.substr(x_at + 1, y_at - x_at - 1));
    const std::optional<double> y = ParseAnyNumber(all.substr(y_at + 1));
    if (x && y) {
      return PickInImage(map, where, text.substr(0, x_at), session, {*x, *y});
    }
  }
  return Status::Error(option + " " + text, "is not a position in an image", "give FRAME,x,y");
}

}  // namespace lararium::editor
