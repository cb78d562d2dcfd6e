#include "editor/export/web_content.h"

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "editor/export/opus_sound.h"
#include "shared/human/human.h"
#include "shared/image/decode.h"
#include "shared/image/encode.h"
#include "shared/stage/prop.h"

namespace lararium::exporter {
namespace {

// Coefficients of light transfer are multiples of this, which lets them be packed.
constexpr int kCoefficientStep = 8;
constexpr int kCoefficients = 9;  // Up to degree 2.
// Side of textures with transparency. These are hair, lashes and eyes, which are small in the
// pictures of a page.
constexpr int kMostTransparentTexels = 256;

int8_t Round(int8_t value) {
  constexpr int kMost = 127 / kCoefficientStep * kCoefficientStep;
  const int up = value < 0 ? -kCoefficientStep / 2 : kCoefficientStep / 2;
  return static_cast<int8_t>(
      std::clamp((value + up) / kCoefficientStep * kCoefficientStep, -kMost, kMost));
}

void ReduceLight(human::LightTransfer& light) {
  const size_t before = static_cast<size_t>(light.count);
  const size_t after = std::min<size_t>(before, kCoefficients);
  light.count = static_cast<int>(after);
  for (human::LightTransfer::Mesh& mesh : light.meshes) {
    std::vector<int8_t> kept;
    for (size_t i = 0; i < mesh.coefficients.size(); ++i) {
      if (i % before < after) {
        kept.push_back(Round(mesh.coefficients[i]));
      }
    }
    mesh.coefficients = std::move(kept);
  }
}

Status ReduceTextures(human::Human& human, const std::string& where) {
  for (std::shared_ptr<const human::Texture>& texture : human.textures) {
    LARARIUM_ASSIGN_OR_RETURN(cv::Mat image,
                              image::DecodeImage(texture->encoded, image::Channels::kBgra, where));
    cv::Mat alpha;
    cv::extractChannel(image, alpha, 3);
    const int side = std::max(image.cols, image.rows);
    if (side > kMostTransparentTexels && cv::countNonZero(alpha < 255) > 0) {
      const double share = static_cast<double>(kMostTransparentTexels) / side;
      cv::resize(image, image, cv::Size(), share, share, cv::INTER_AREA);
      human::Texture smaller{texture->name, {}};
      LARARIUM_ASSIGN_OR_RETURN(smaller.encoded, image::EncodePng(image, 9));
      if (smaller.encoded.size() < texture->encoded.size()) {
        texture = std::make_shared<const human::Texture>(std::move(smaller));
      }
    }
  }
  return Status();
}

Status ReducePerson(CastContent& cast) {
  LARARIUM_ASSIGN_OR_RETURN(human::Human human,
                            human::ParseHuman(cast.human, "cast '" + cast.name + "'", kWebDetail));
  LARARIUM_RETURN_IF_ERROR(ReduceTextures(human, "cast '" + cast.name + "'"));
  ReduceLight(human.light);
  cast.human = human::SerializeHuman(human);
  return Status();
}

Status ReduceProp(ObjectContent& object) {
  LARARIUM_ASSIGN_OR_RETURN(stage::Prop prop,
                            stage::ParseProp(object.prop, "object '" + object.name + "'"));
  ReduceLight(prop.light);
  object.prop = stage::SerializeProp(prop);
  return Status();
}

// Leaves a sound as it is if Opus does not make it smaller.
Result<std::vector<std::byte>> Smaller(std::span<const std::byte> sound, const std::string& where) {
  LARARIUM_ASSIGN_OR_RETURN(std::vector<std::byte> opus, EncodeOpus(sound, where));
  return opus.size() < sound.size() ? std::move(opus)
                                    : std::vector<std::byte>(sound.begin(), sound.end());
}

Status ReduceLine(SpokenContent& line) {
  if (!line.sound.empty()) {
    LARARIUM_ASSIGN_OR_RETURN(line.sound, Smaller(line.sound, "line '" + line.line + "'"));
  }
  return Status();
}

Status ReduceSound(audio::SoundData& sound) {
  LARARIUM_ASSIGN_OR_RETURN(std::vector<std::byte> smaller,
                            Smaller(sound.bytes, "sound '" + sound.name + "'"));
  const auto owner = std::make_shared<const std::vector<std::byte>>(std::move(smaller));
  sound.bytes = *owner;
  sound.owner = owner;
  return Status();
}

}  // namespace

Status ReduceForWeb(ExportContent& content, Progress& progress) {
  const auto count = static_cast<double>(content.cast.size() + content.objects.size() +
                                         content.lines.size() + content.sounds.size());
  double done = 0.0;
  const auto reduce = [&](auto& parts, auto reduce_part) -> Status {
    for (auto& part : parts) {
      progress.Report("reducing", done++ / count);
      if (progress.Cancelled()) {
        return Status::Error("export", "cancelled");
      }
      LARARIUM_RETURN_IF_ERROR(reduce_part(part));
    }
    return Status();
  };
  LARARIUM_RETURN_IF_ERROR(reduce(content.cast, ReducePerson));
  LARARIUM_RETURN_IF_ERROR(reduce(content.objects, ReduceProp));
  LARARIUM_RETURN_IF_ERROR(reduce(content.lines, ReduceLine));
  return reduce(content.sounds, ReduceSound);
}

}  // namespace lararium::exporter
