#include "editor/bake/exr_image.h"

#include <ImfArray.h>
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfOutputFile.h>
#include <ImfPartType.h>
#include <ImfRgbaFile.h>
#include <ImfStandardAttributes.h>

#include <algorithm>
#include <array>
#include <exception>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "editor/bake/chromaticities.h"
#include "shared/core/file.h"
#include "shared/core/lower_case.h"

namespace lararium::bake {
namespace {

// Three channels with colours.
struct Layer {
  int part = 0;
  // The name of the layer, of the part, or both; empty for plain R, G and B.
  std::string name;
  std::array<std::string, 3> channels;
  int rank = 0;  // Layers of lower ranks are preferred.
};

constexpr int kPlain = 0;
constexpr int kMain = 1;
constexpr int kOther = 2;

int RankOf(const std::string& name) {
  if (name.empty()) {
    return kPlain;
  }
  const std::string lower = LowerCase(name);
  for (const char* main : {"rgb", "beauty", "combined", "color", "colour", "default", "main"}) {
    if (lower.find(main) != std::string::npos) {
      return kMain;
    }
  }
  return kOther;
}

// Returns the channel of a layer with one of its usual names; empty if there is none.
std::string FindChannel(const Imf::ChannelList& channels, const std::string& prefix, char colour) {
  const std::string upper(1, colour);
  const std::string long_name = colour == 'R' ? "red" : colour == 'G' ? "green" : "blue";
  for (const std::string& suffix : {upper, LowerCase(upper), long_name}) {
    const Imf::Channel* found = channels.findChannel(prefix + suffix);
    if (found != nullptr && found->xSampling == 1 && found->ySampling == 1) {
      return prefix + suffix;
    }
  }
  return {};
}

std::vector<Layer> FindLayers(const Imf::MultiPartInputFile& input) {
  std::vector<Layer> layers;
  for (int part = 0; part < input.parts(); ++part) {
    const Imf::Header& header = input.header(part);
    if (header.hasType() && Imf::isDeepData(header.type())) {
      continue;
    }
    std::vector<std::string> prefixes = {""};
    for (auto at = header.channels().begin(); at != header.channels().end(); ++at) {
      const std::string name = at.name();
      const size_t dot = name.rfind('.');
      const std::string prefix = dot == std::string::npos ? "" : name.substr(0, dot + 1);
      if (std::find(prefixes.begin(), prefixes.end(), prefix) == prefixes.end()) {
        prefixes.push_back(prefix);
      }
    }
    for (const std::string& prefix : prefixes) {
      Layer layer{
          part,
          (input.parts() > 1 && header.hasName() ? header.name() : std::string()) +
              (prefix.empty() ? "" : "." + prefix.substr(0, prefix.size() - 1)),
          {FindChannel(header.channels(), prefix, 'R'), FindChannel(header.channels(), prefix, 'G'),
           FindChannel(header.channels(), prefix, 'B')}};
      if (layer.name.starts_with('.')) {
        layer.name.erase(0, 1);
      }
      layer.rank = RankOf(layer.name);
      if (std::none_of(layer.channels.begin(), layer.channels.end(),
                       [](const std::string& channel) { return channel.empty(); })) {
        layers.push_back(std::move(layer));
      }
    }
  }
  std::stable_sort(layers.begin(), layers.end(),
                   [](const Layer& a, const Layer& b) { return a.rank < b.rank; });
  return layers;
}

// Pixels of a data window.
struct Window {
  Imath::Box2i bounds;
  int64_t width = 0;
  std::vector<glm::vec3> pixels;
};

constexpr int64_t kMaxWindowSide = 32768;

Status MakeWindow(const Imath::Box2i& bounds, const std::string& where, Window& window) {
  window.bounds = bounds;
  window.width = int64_t{bounds.max.x} - bounds.min.x + 1;
  const int64_t height = int64_t{bounds.max.y} - bounds.min.y + 1;
  if (window.width > kMaxWindowSide || height > kMaxWindowSide) {
    return Status::Error(where,
                         "its data window is " + std::to_string(window.width) + " x " +
                             std::to_string(height) + " pixels",
                         "save it smaller");
  }
  window.pixels.resize(static_cast<size_t>(window.width * height));
  return Status();
}

void ReadColours(Imf::MultiPartInputFile& input, const Layer& layer, Window& window) {
  Imf::FrameBuffer buffer;
  for (int c = 0; c < 3; ++c) {
    buffer.insert(
        layer.channels[static_cast<size_t>(c)],
        Imf::Slice::Make(Imf::FLOAT, &window.pixels[0][c], window.bounds, sizeof(glm::vec3),
                         sizeof(glm::vec3) * static_cast<size_t>(window.width)));
  }
  Imf::InputPart part(input, layer.part);
  part.setFrameBuffer(buffer);
  part.readPixels(window.bounds.min.y, window.bounds.max.y);
}

// Luminance and chroma at half the resolution, or luminance alone.
void ReadLuminance(const std::filesystem::path& file, Window& window) {
  Imf::RgbaInputFile input(file.c_str());
  std::vector<Imf::Rgba> pixels(window.pixels.size());
  input.setFrameBuffer(pixels.data() - window.bounds.min.x - window.bounds.min.y * window.width, 1,
                       static_cast<size_t>(window.width));
  input.readPixels(window.bounds.min.y, window.bounds.max.y);
  std::transform(pixels.begin(), pixels.end(), window.pixels.begin(),
                 [](const Imf::Rgba& pixel) { return glm::vec3(pixel.r, pixel.g, pixel.b); });
}

// Puts the data window into the display window.
ProbeImage Displayed(const Window& window, const Imath::Box2i& display) {
  ProbeImage image{display.max.x - display.min.x + 1, display.max.y - display.min.y + 1, {}, {}};
  image.pixels.resize(static_cast<size_t>(image.width) * static_cast<size_t>(image.height));
  size_t filled = 0;
  const Imath::Box2i& data = window.bounds;
  for (int y = std::max(data.min.y, display.min.y); y <= std::min(data.max.y, display.max.y); ++y) {
    for (int x = std::max(data.min.x, display.min.x); x <= std::min(data.max.x, display.max.x);
         ++x) {
      const auto to =
          static_cast<size_t>(int64_t{y - display.min.y} * image.width + x - display.min.x);
      const auto from =
          static_cast<size_t>((int64_t{y} - data.min.y) * window.width + x - data.min.x);
      image.pixels[to] = window.pixels[from];
      ++filled;
    }
  }
  if (filled < image.pixels.size()) {
    image.warnings.push_back("its data window fills only " +
                             std::to_string(100 * filled / image.pixels.size()) +
                             " % of its display window; the rest is black");
  }
  return image;
}

void NoteLayers(const std::vector<Layer>& layers, ProbeImage& image) {
  if (layers.empty() || layers.front().rank == kPlain ||
      (layers.size() == 1 && layers.front().rank == kMain)) {
    return;
  }
  std::string others;
  for (size_t i = 1; i < layers.size(); ++i) {
    others += (i == 1 ? "; left out: " : ", ") + layers[i].name;
  }
  image.warnings.push_back("its layer \"" + layers.front().name + "\" is used" + others);
}

std::string ChannelNames(const Imf::ChannelList& channels) {
  constexpr size_t kEnough = 200;
  std::string names;
  for (auto at = channels.begin(); at != channels.end() && names.size() < kEnough; ++at) {
    names += (names.empty() ? "" : ", ") + std::string(at.name());
  }
  return names;
}

}  // namespace

Result<ProbeImage> ReadExr(const std::filesystem::path& file,
                           const std::function<Status(int64_t width, int64_t height)>& check) {
  const std::string where = file.string();
  try {
    Imf::MultiPartInputFile input(file.c_str());
    const std::vector<Layer> layers = FindLayers(input);
    const Imf::Header& header = input.header(layers.empty() ? 0 : layers.front().part);
    if (layers.empty() && (input.parts() != 1 || header.channels().findChannel("Y") == nullptr ||
                           (header.hasType() && Imf::isDeepData(header.type())))) {
      return Status::Error(
          where,
          "has no channels R, G and B of full resolution, but " + ChannelNames(header.channels()),
          "save the probe as plain RGB");
    }
    if (Imf::hasEnvmap(header) && Imf::envmap(header) == Imf::ENVMAP_CUBE) {
      return Status::Error(where, "is a cube map", "convert it to a map of latitude and longitude");
    }
    const Imath::Box2i& display = header.displayWindow();
    LARARIUM_RETURN_IF_ERROR(check(int64_t{display.max.x} - display.min.x + 1,
                                   int64_t{display.max.y} - display.min.y + 1));
    Window window;
    LARARIUM_RETURN_IF_ERROR(MakeWindow(header.dataWindow(), where, window));
    if (layers.empty()) {
      ReadLuminance(file, window);
    } else {
      ReadColours(input, layers.front(), window);
    }
    ProbeImage image = Displayed(window, display);
    NoteLayers(layers, image);
    if (Imf::hasChromaticities(header)) {
      const Imf::Chromaticities& c = Imf::chromaticities(header);
      const auto xy = [](const Imath::V2f& v) { return glm::dvec2(v.x, v.y); };
      LARARIUM_RETURN_IF_ERROR(
          ConvertToBt709({xy(c.red), xy(c.green), xy(c.blue), xy(c.white)}, image, where));
    }
    return image;
  } catch (const std::exception& error) {
    return Status::Error(where, std::string("cannot be read as OpenEXR: ") + error.what());
  }
}

Status WriteExr(const std::filesystem::path& file,
                int width,
                int height,
                std::span<const glm::vec4> pixels) {
  LARARIUM_ASSIGN_OR_RETURN(FileReplacement replacement, FileReplacement::Begin(file));
  try {
    Imf::Header header(width, height);
    Imf::FrameBuffer buffer;
    const char* names[4] = {"R", "G", "B", "A"};
    for (int channel = 0; channel < 4; ++channel) {
      header.channels().insert(names[channel], Imf::Channel(Imf::FLOAT));
      buffer.insert(
          names[channel],
          Imf::Slice::Make(Imf::FLOAT, &pixels[0][channel], header.dataWindow(), sizeof(glm::vec4),
                           sizeof(glm::vec4) * static_cast<size_t>(width)));
    }
    Imf::OutputFile output(replacement.unfinished().c_str(), header);
    output.setFrameBuffer(buffer);
    output.writePixels(height);
  } catch (const std::exception& error) {
    return Status::Error(file.string(), std::string("cannot be written: ") + error.what());
  }
  return replacement.Commit();
}

}  // namespace lararium::bake
