#include "editor/bake/radiance.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace lararium::bake {
namespace {

constexpr int kMaxSide = 1 << 16;

using Pixel = std::array<uint8_t, 4>;  // red, green, blue, exponent

std::optional<int> WholeNumber(std::string_view text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = error == std::errc() && end == text.data() + text.size();
  return whole && value > 0 && value <= kMaxSide ? std::optional(value) : std::nullopt;
}

class Reader {
 public:
  Reader(std::span<const std::byte> bytes, const std::string& where)
      : text_(reinterpret_cast<const char*>(bytes.data()), bytes.size()), place_(where) {}

  Result<ProbeImage> Read() {
    LARARIUM_RETURN_IF_ERROR(ReadHeader());
    // A pixel takes four bytes, and a run of two bytes gives at most 127 of them; a shorter
    // text cannot be a complete picture.
    const auto pixels = static_cast<uint64_t>(width_) * static_cast<uint64_t>(height_);
    if (pixels > 64 * static_cast<uint64_t>(text_.size())) {
      return Damaged("it is too short for its size");
    }
    ProbeImage image{width_, height_, {}, {}};
    image.pixels.reserve(pixels);
    std::vector<Pixel> row(static_cast<size_t>(width_));
    for (int y = 0; y < height_; ++y) {
      if (!ReadRow(row)) {
        return Damaged("row " + std::to_string(y + 1) + " of " + std::to_string(height_));
      }
      for (const Pixel& pixel : row) {
        image.pixels.push_back(Linear(pixel));
      }
    }
    return image;
  }

 private:
  Status Damaged(const std::string& where) const {
    return Status::Error(place_, "the Radiance image is damaged or cut short (" + where + ")",
                         "export it again, or as OpenEXR");
  }

  static glm::vec3 Linear(const Pixel& pixel) {
    return pixel[3] == 0 ? glm::vec3(0.0f)
                         : glm::vec3(pixel[0], pixel[1], pixel[2]) *
                               std::ldexp(1.0f, static_cast<int>(pixel[3]) - 136);
  }

  // Takes the text up to the end of the line; nullopt if the line has no end.
  std::optional<std::string_view> Line() {
    const size_t end = text_.find('\n');
    if (end == std::string_view::npos) {
      return std::nullopt;
    }
    std::string_view line = text_.substr(0, end);
    text_.remove_prefix(end + 1);
    if (line.ends_with('\r')) {
      line.remove_suffix(1);
    }
    return line;
  }

  Status ReadHeader() {
    std::optional<std::string_view> line = Line();
    if (!line || !line->starts_with("#?")) {
      return Status::Error(place_, "not a Radiance .hdr image");
    }
    while ((line = Line()) && !line->empty()) {
      if (line->starts_with("FORMAT=") && *line != "FORMAT=32-bit_rle_rgbe") {
        return Status::Error(place_, "has colours other than red, green and blue",
                             "export it as RGBE, or as OpenEXR");
      }
    }
    line = line ? Line() : std::nullopt;
    if (!line) {
      return Damaged("its header");
    }
    return ReadSize(*line);
  }

  Status ReadSize(std::string_view line) {
    const size_t x = line.find(" +X ");
    if (line.starts_with("-Y ") && x != std::string_view::npos && x > 3) {
      const std::optional<int> height = WholeNumber(line.substr(3, x - 3));
      const std::optional<int> width = WholeNumber(line.substr(x + 4));
      if (height && width) {
        height_ = *height;
        width_ = *width;
        return Status();
      }
    }
    return Status::Error(place_,
                         "its size \"" + std::string(line.substr(0, 40)) + "\" is not known",
                         "export it with rows from the top, as \"-Y height +X width\"");
  }

  std::optional<uint8_t> Byte() {
    if (text_.empty()) {
      return std::nullopt;
    }
    const auto byte = static_cast<uint8_t>(text_.front());
    text_.remove_prefix(1);
    return byte;
  }

  std::optional<Pixel> TakePixel() {
    if (text_.size() < 4) {
      return std::nullopt;
    }
    Pixel pixel = {};
    for (uint8_t& value : pixel) {
      value = *Byte();
    }
    return pixel;
  }

  bool ReadRow(std::vector<Pixel>& row) {
    const std::optional<Pixel> first = TakePixel();
    if (!first) {
      return false;
    }
    const bool runs = (*first)[0] == 2 && (*first)[1] == 2 && (*first)[2] < 128 &&
                      row.size() >= 8 && row.size() < 32768;
    if (!runs) {
      return ReadPlainRow(*first, row);
    }
    if (static_cast<size_t>((*first)[2] << 8 | (*first)[3]) != row.size()) {
      return false;
    }
    for (size_t channel = 0; channel < 4; ++channel) {
      if (!ReadChannel(channel, row)) {
        return false;
      }
    }
    return true;
  }

  // Reads runs of one value (code 128 + length) and sequences of different values (code =
  // length).
  bool ReadChannel(size_t channel, std::vector<Pixel>& row) {
    for (size_t at = 0; at < row.size();) {
      const std::optional<uint8_t> code = Byte();
      const bool run = code && *code > 128;
      const size_t length = !code ? 0 : run ? *code - 128u : *code;
      if (length == 0 || at + length > row.size()) {
        return false;
      }
      std::optional<uint8_t> value = run ? Byte() : std::nullopt;
      for (size_t i = 0; i < length; ++i, ++at) {
        if (!run) {
          value = Byte();
        }
        if (!value) {
          return false;
        }
        row[at][channel] = *value;
      }
    }
    return true;
  }

  // Reads pixel by pixel. The pixel 1, 1, 1, n repeats the previous one n times; immediately
  // following repeat pixels give the higher digits of the count.
  bool ReadPlainRow(Pixel pixel, std::vector<Pixel>& row) {
    int shift = 0;
    for (size_t at = 0; at < row.size();) {
      if (pixel[0] == 1 && pixel[1] == 1 && pixel[2] == 1) {
        const size_t count = shift < 24 ? size_t{pixel[3]} << shift : row.size() + 1;
        if (at == 0 || count > row.size() - at) {
          return false;
        }
        for (size_t i = 0; i < count; ++i, ++at) {
          row[at] = row[at - 1];
        }
        shift += 8;
      } else {
        row[at++] = pixel;
        shift = 0;
      }
      if (at < row.size()) {
        const std::optional<Pixel> next = TakePixel();
        if (!next) {
          return false;
        }
        pixel = *next;
      }
    }
    return true;
  }

  std::string_view text_;  // The text not yet read.
  const std::string& place_;
  int width_ = 0;
  int height_ = 0;
};

}  // namespace

Result<ProbeImage> ParseRadiance(std::span<const std::byte> bytes, const std::string& where) {
  return Reader(bytes, where).Read();
}

}  // namespace lararium::bake
