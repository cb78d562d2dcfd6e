#include "editor/panels/widgets/palette.h"

#include <algorithm>
#include <iterator>

#include "shared/core/srgb.h"

namespace lararium::panels {

namespace {

ImVec4 Rgb(unsigned value) {
  return {static_cast<float>(value >> 16 & 0xff) / 255.0f,
          static_cast<float>(value >> 8 & 0xff) / 255.0f, static_cast<float>(value & 0xff) / 255.0f,
          1.0f};
}

const Palette kDark = {.accent = Rgb(0xd96b49),
                       .chosen = Rgb(0x9c4328),
                       .text = Rgb(0xe3e5e9),
                       .dim = Rgb(0xa8adb6),
                       .good = Rgb(0x42b0e0),
                       .warning = Rgb(0xeabf5f),
                       .error = Rgb(0xf27871),
                       .window = Rgb(0x191b1f),
                       .panel = Rgb(0x212429),
                       .frame = Rgb(0x2e3239),
                       .hover = Rgb(0x3b4049),
                       .line = Rgb(0x33373f),
                       .keyword = Rgb(0xc792ea),
                       .string = Rgb(0xa5d087),
                       .number = Rgb(0xf5b476),
                       .call = Rgb(0x73bff1)};

const Palette kLight = {.accent = Rgb(0xb84f2b),
                        .chosen = Rgb(0xf1b194),
                        .text = Rgb(0x1e2126),
                        .dim = Rgb(0x4a505a),
                        .good = Rgb(0x00658a),
                        .warning = Rgb(0x8a5a00),
                        .error = Rgb(0x900028),
                        .window = Rgb(0xe6e8eb),
                        .panel = Rgb(0xf8f9fa),
                        .frame = Rgb(0xd9dce1),
                        .hover = Rgb(0xc9cdd3),
                        .line = Rgb(0xcdd1d6),
                        .keyword = Rgb(0x75339e),
                        .string = Rgb(0x2b6619),
                        .number = Rgb(0x8f4a00),
                        .call = Rgb(0x0d5a9e)};

}  // namespace

ImVec4 SessionColour(uint32_t session) {
  static const ImVec4 kColours[kSessionColours] = {Rgb(0x56b4e9), Rgb(0xe69f00), Rgb(0x1fb58c),
                                                   Rgb(0xf0e442), Rgb(0xd98cb9), Rgb(0xe8672c),
                                                   Rgb(0x6f86e0), Rgb(0xa5854f)};
  return kColours[session % kSessionColours];
}

ImVec4 LaneColour(drama::LaneKind kind) {
  const auto& [red, green, blue] = drama::SpecOf(kind).colour;
  return {red, green, blue, 1.0f};
}

ImVec4 RampColour(double t) {
  static const ImVec4 kSteps[] = {Rgb(0x3f6cb0), Rgb(0x6c86a6), Rgb(0x94a08f), Rgb(0xc4bf68),
                                  Rgb(0xffe94a)};
  constexpr int kLast = static_cast<int>(std::size(kSteps)) - 1;
  const double at = std::clamp(t, 0.0, 1.0) * kLast;
  const int step = std::min(static_cast<int>(at), kLast - 1);
  return Over(WithAlpha(kSteps[step + 1], static_cast<float>(at - step)), kSteps[step]);
}

const Palette& PaletteOf(Theme theme) { return theme == Theme::kLight ? kLight : kDark; }

ImVec4 Over(const ImVec4& front, const ImVec4& ground) {
  const auto mix = [&](float a, float b) { return b + (a - b) * front.w; };
  return {mix(front.x, ground.x), mix(front.y, ground.y), mix(front.z, ground.z), 1.0f};
}

double Luminance(const ImVec4& colour) {
  return 0.2126 * LinearFromSrgb<double>(colour.x) + 0.7152 * LinearFromSrgb<double>(colour.y) +
         0.0722 * LinearFromSrgb<double>(colour.z);
}

double Contrast(const ImVec4& a, const ImVec4& b) {
  const auto [low, high] = std::minmax({Luminance(a), Luminance(b)});
  return (high + 0.05) / (low + 0.05);
}

ImVec4 InkOn(const ImVec4& ground) {
  const ImVec4 black = Rgb(0x000000);
  const ImVec4 white = Rgb(0xffffff);
  return Contrast(black, ground) >= Contrast(white, ground) ? black : white;
}

}  // namespace lararium::panels
