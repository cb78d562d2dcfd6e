#include "editor/bake/radiance.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "editor/bake/chromaticities.h"

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

std::string_view Trimmed(std::string_view text) {
  const size_t begin = text.find_first_not_of(" \t");
  return begin == std::string_view::npos
             ? std::string_view()
             : text.substr(begin, text.find_last_not_of(" \t") - begin + 1);
}

// Returns exactly N numbers, separated by blanks.
template <size_t N>
std::optional<std::array<double, N>> Numbers(std::string_view text) {
  std::array<double, N> numbers = {};
  for (double& number : numbers) {
    text = Trimmed(text);
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || !std::isfinite(number)) {
      return std::nullopt;
    }
    text.remove_prefix(static_cast<size_t>(end - text.data()));
  }
  return Trimmed(text).empty() ? std::optional(numbers) : std::nullopt;
}

// How rows of the file lie in the image. Each is a column of the image if `columns`; they begin at
// the image's right or bottom if `from_far`, and so does each of them if `reversed`.
struct Arrangement {
  bool columns = false;
  bool from_far = false;
  bool reversed = false;
};

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
    ProbeImage image{width_, height_, std::vector<glm::vec3>(pixels), std::move(warnings_)};
    const auto [columns, from_far, reversed] = arrangement_;
    const int rows = columns ? width_ : height_;
    const int length = columns ? height_ : width_;
    std::vector<Pixel> row(static_cast<size_t>(length));
    for (int i = 0; i < rows; ++i) {
      if (!ReadRow(row)) {
        return Damaged("row " + std::to_string(i + 1) + " of " + std::to_string(rows));
      }
      const int across = from_far ? rows - 1 - i : i;
      for (int j = 0; j < length; ++j) {
        const int along = reversed ? length - 1 - j : j;
        const int x = columns ? across : along;
        const int y = columns ? along : across;
        image
            .pixels[static_cast<size_t>(y) * static_cast<size_t>(width_) + static_cast<size_t>(x)] =
            Linear(row[static_cast<size_t>(j)]) * scale_;
      }
    }
    if (primaries_) {
      LARARIUM_RETURN_IF_ERROR(ConvertToBt709(*primaries_, image, place_));
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
      LARARIUM_RETURN_IF_ERROR(ReadVariable(*line));
    }
    line = line ? Line() : std::nullopt;
    if (!line) {
      return Damaged("its header");
    }
    return ReadSize(*line);
  }

  // Programs that change the brightness of a picture state the factors: the light is what is
  // stored, divided by the product of all of them. Unknown variables and comments are ignored.
  Status ReadVariable(std::string_view line) {
    const size_t equals = line.find('=');
    if (line.starts_with('#') || equals == std::string_view::npos) {
      return Status();
    }
    const std::string_view name = Trimmed(line.substr(0, equals));
    const std::string_view value = Trimmed(line.substr(equals + 1));
    if (name == "FORMAT" && value != "32-bit_rle_rgbe") {
      return Status::Error(place_, "has colours other than red, green and blue",
                           "export it as RGBE, or as OpenEXR");
    }
    if (name == "EXPOSURE") {
      const auto exposure = Numbers<1>(value);
      return exposure ? DivideBy({(*exposure)[0], (*exposure)[0], (*exposure)[0]}, line)
                      : NoFactor(line);
    }
    if (name == "COLORCORR") {
      const auto factors = Numbers<3>(value);
      return factors ? DivideBy(*factors, line) : NoFactor(line);
    }
    if (name == "PRIMARIES") {
      const auto numbers = Numbers<8>(value);
      if (!numbers) {
        return NoFactor(line);
      }
      const std::array<double, 8>& n = *numbers;
      primaries_ = Chromaticities{{n[0], n[1]}, {n[2], n[3]}, {n[4], n[5]}, {n[6], n[7]}};
    }
    if (name == "GAMMA" || name == "PIXASPECT") {
      const auto number = Numbers<1>(value);
      if (!number || (*number)[0] != 1.0) {
        warnings_.push_back("its header's \"" + std::string(line.substr(0, 40)) +
                            "\" is not honoured: export it without");
      }
    }
    return Status();
  }

  Status NoFactor(std::string_view line) const {
    return Status::Error(
        place_, "its header's \"" + std::string(line.substr(0, 40)) + "\" has no possible value",
        "export it again, or as OpenEXR");
  }

  Status DivideBy(const std::array<double, 3>& factors, std::string_view line) {
    for (int c = 0; c < 3; ++c) {
      scale_[c] = static_cast<float>(scale_[c] / factors[static_cast<size_t>(c)]);
      if (!(factors[static_cast<size_t>(c)] > 0.0) || !std::isnormal(scale_[c])) {
        return NoFactor(line);
      }
    }
    return Status();
  }

  // Reads "-Y height +X width" and the seven other orders of axes and directions. The first axis is
  // that across the file's rows.
  Status ReadSize(std::string_view line) {
    std::array<std::string_view, 4> words;
    std::string_view rest = Trimmed(line);
    for (std::string_view& word : words) {
      word = rest.substr(0, rest.find(' '));
      rest = Trimmed(rest.substr(word.size()));
    }
    const std::string_view across = words[0];
    const std::string_view along = words[2];
    const std::optional<int> rows = WholeNumber(words[1]);
    const std::optional<int> length = WholeNumber(words[3]);
    const auto names = [](std::string_view word, char axis) {
      return word.size() == 2 && (word[0] == '+' || word[0] == '-') && word[1] == axis;
    };
    const bool columns = names(across, 'X') && names(along, 'Y');
    if (!rest.empty() || !rows || !length ||
        (!columns && !(names(across, 'Y') && names(along, 'X')))) {
      return Status::Error(place_,
                           "its size \"" + std::string(line.substr(0, 40)) + "\" is not known",
                           "export it with rows from the top, as \"-Y height +X width\"");
    }
    // Y points up and X to the right.
    const auto from_far = [](std::string_view word) {
      return word[0] == (word[1] == 'Y' ? '+' : '-');
    };
    arrangement_ = {columns, from_far(across), from_far(along)};
    width_ = columns ? *rows : *length;
    height_ = columns ? *length : *rows;
    return Status();
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
  Arrangement arrangement_;
  glm::vec3 scale_ = glm::vec3(1.0f);  // Radiance for each unit that is stored.
  std::optional<Chromaticities> primaries_;
  std::vector<std::string> warnings_;
};

}  // namespace

Result<ProbeImage> ParseRadiance(std::span<const std::byte> bytes, const std::string& where) {
  return Reader(bytes, where).Read();
}

}  // namespace lararium::bake
