#include "shared/image/picture_notes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>

#include "shared/image/codecs.h"

namespace lararium::image {
namespace {

// Numbers of a profile or of a PNG; beyond its end they are zero.
class Profile {
 public:
  explicit Profile(Bytes bytes) : bytes_(bytes) {}

  uint32_t Number(size_t at) const {
    uint32_t number = 0;
    for (size_t i = 0; i < 4; ++i) {
      number = number << 8 | Byte(at + i);
    }
    return number;
  }
  bool Says(size_t at, std::string_view text) const { return StartsWith(bytes_, at, text); }

  // The offset of a tag's data; nullopt if there is none.
  std::optional<size_t> Find(std::string_view tag) const {
    constexpr uint32_t kMostTags = 200;
    const uint32_t count = std::min(Number(128), kMostTags);
    for (uint32_t i = 0; i < count; ++i) {
      if (Says(132 + 12 * i, tag)) {
        return Number(132 + 12 * i + 4);
      }
    }
    return std::nullopt;
  }

  // The name of the profile in ASCII; other characters are left out.
  std::string Name() const {
    constexpr uint32_t kLongest = 80;
    const std::optional<size_t> at = Find("desc");
    std::string name;
    const auto add = [&](size_t first, uint32_t count, size_t step) {
      for (size_t i = 0; i < std::min(count, kLongest); ++i) {
        const uint8_t c = Byte(first + i * step);
        name += c >= ' ' && c < 127 ? std::string(1, static_cast<char>(c)) : "";
      }
    };
    if (at && Says(*at, "desc")) {
      add(*at + 12, Number(*at + 8), 1);
    } else if (at && Says(*at, "mluc")) {  // UTF-16 with the high byte first.
      add(*at + Number(*at + 24) + 1, Number(*at + 20) / 2, 2);
    }
    return name.empty() ? "unnamed" : name;
  }

  // Whether the profile is for RGB and has primaries that clearly differ from those of sRGB.
  bool Foreign() const {
    constexpr double kTolerance = 0.01;
    constexpr std::array kTags = {"rXYZ", "gXYZ", "bXYZ"};
    // IEC 61966-2-1, adapted to D50.
    constexpr std::array<std::array<double, 3>, 3> kSrgb = {
        {{0.4361, 0.2225, 0.0139}, {0.3851, 0.7169, 0.0971}, {0.1431, 0.0606, 0.7141}}};
    if (!Says(16, "RGB ")) {
      return false;
    }
    for (size_t i = 0; i < 3; ++i) {
      const std::optional<size_t> at = Find(kTags[i]);
      if (!at) {
        return true;  // A profile of tables, which are not looked at.
      }
      for (size_t axis = 0; axis < 3; ++axis) {
        const auto fixed = static_cast<int32_t>(Number(*at + 8 + 4 * axis));
        if (std::abs(fixed / 65536.0 - kSrgb[i][axis]) > kTolerance) {
          return true;
        }
      }
    }
    return false;
  }

 private:
  uint8_t Byte(size_t at) const {
    return at < bytes_.size() ? std::to_integer<uint8_t>(bytes_[at]) : 0;
  }

  Bytes bytes_;
};

// Finds a profile by its signature. JPEG, WebP and HEIC hold it near their beginning as it is; a
// JPEG cuts one of more than 64 kB, whose name and primaries come first.
std::optional<Profile> FindPlain(Bytes encoded) {
  constexpr size_t kNear = 1 << 20;
  constexpr size_t kSignatureAt = 36;
  constexpr std::string_view kSignature = "acsp";
  const Bytes near = encoded.first(std::min(encoded.size(), kNear));
  const auto found = std::search(near.begin(), near.end(), kSignature.begin(), kSignature.end(),
                                 [](std::byte b, char c) { return static_cast<char>(b) == c; });
  const auto at = static_cast<size_t>(found - near.begin());
  if (found == near.end() || at < kSignatureAt) {
    return std::nullopt;
  }
  return Profile(encoded.subspan(at - kSignatureAt));
}

struct NamedCode {
  int code;
  std::string_view name;
};

// Returns the names of the primaries and of the transfer of a PNG that says them as numbers (chunk
// cICP of the third edition of PNG, numbers of ITU-T H.273) if its colours clearly differ from
// those of sRGB; "" if they do not; nullopt if there is no such chunk. It comes before the pixels.
std::optional<std::string> FindPngCodes(Bytes encoded) {
  // Primaries of BT.709, and those of which nothing is said; transfers that are shown alike.
  constexpr std::array kPlainPrimaries = {1, 2};
  constexpr std::array kPlainTransfers = {1, 2, 6, 13, 14, 15};
  constexpr std::array<NamedCode, 3> kPrimaries = {{{9, "BT.2020"}, {11, "DCI-P3"}, {12, "P3"}}};
  constexpr std::array<NamedCode, 3> kTransfers = {{{8, "linear"}, {16, "PQ"}, {18, "HLG"}}};
  const Profile chunks(encoded);
  const auto named = [](const auto& names, int code, const char* kind) {
    const auto found = std::find_if(names.begin(), names.end(),
                                    [code](const NamedCode& name) { return name.code == code; });
    return found != names.end() ? std::string(found->name)
                                : std::string(kind) + " " + std::to_string(code);
  };
  for (size_t at = 8; at < encoded.size() && !chunks.Says(at + 4, "IDAT");
       at += size_t{12} + chunks.Number(at)) {
    if (!chunks.Says(at + 4, "cICP") || chunks.Number(at) != 4) {
      continue;
    }
    const auto primaries = static_cast<int>(chunks.Number(at + 8) >> 24);
    const auto transfer = static_cast<int>(chunks.Number(at + 8) >> 16 & 0xff);
    const auto has = [](const auto& codes, int code) {
      return std::find(codes.begin(), codes.end(), code) != codes.end();
    };
    std::string names =
        has(kPlainPrimaries, primaries) ? "" : named(kPrimaries, primaries, "primaries");
    if (!has(kPlainTransfers, transfer)) {
      names += (names.empty() ? "" : " ") + named(kTransfers, transfer, "transfer");
    }
    return names;
  }
  return std::nullopt;
}

}  // namespace

std::vector<std::string> PictureNotes(Bytes encoded) {
  std::vector<std::string> notes;
  std::vector<std::byte> held;
  std::optional<Profile> profile;
  std::optional<std::string> codes;  // Where a PNG has them, its profile is not valid.
  if (IsTiff(encoded)) {
    const TiffTraits traits = ReadTiffTraits(encoded);
    held = traits.profile;
    if (traits.pages > 1) {
      notes.push_back("has " + std::to_string(traits.pages) +
                      " pages, of which only the first is used: save each as a file of its own");
    }
  } else if (StartsWith(encoded, 1, "PNG")) {
    codes = FindPngCodes(encoded);
    held = codes ? held : ReadPngProfile(encoded);
  } else {
    profile = FindPlain(encoded);
  }
  if (!held.empty()) {
    profile = Profile(held);
  }
  const std::string colours = profile && profile->Foreign() ? profile->Name() : codes.value_or("");
  if (!colours.empty()) {
    notes.push_back("is in the colours of \"" + colours +
                    "\", which are taken for those of sRGB: save it in sRGB");
  }
  return notes;
}

}  // namespace lararium::image
