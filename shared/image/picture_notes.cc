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

// The offset of a text near the beginning of a file.
std::optional<size_t> FindNear(Bytes encoded, std::string_view text) {
  constexpr size_t kNear = 1 << 20;
  const Bytes near = encoded.first(std::min(encoded.size(), kNear));
  const auto found = std::search(near.begin(), near.end(), text.begin(), text.end(),
                                 [](std::byte b, char c) { return static_cast<char>(b) == c; });
  return found == near.end() ? std::nullopt
                             : std::optional(static_cast<size_t>(found - near.begin()));
}

// Finds a profile by its signature. JPEG, WebP and HEIC hold it near their beginning as it is; a
// JPEG cuts one of more than 64 kB, whose name and primaries come first.
std::optional<Profile> FindPlain(Bytes encoded) {
  constexpr size_t kSignatureAt = 36;
  const std::optional<size_t> at = FindNear(encoded, "acsp");
  return at && *at >= kSignatureAt ? std::optional(Profile(encoded.subspan(*at - kSignatureAt)))
                                   : std::nullopt;
}

struct NamedCode {
  uint32_t code;
  std::string_view name;
};

// Names primaries and a transfer that are given by numbers of ITU-T H.273; "" if their colours do
// not clearly differ from those of sRGB.
std::string ForeignColours(uint32_t primaries, uint32_t transfer) {
  // Primaries of BT.709, those of which nothing is said, and a reserved number. The transfers are
  // shown alike.
  constexpr std::array<uint32_t, 3> kPlainPrimaries = {0, 1, 2};
  constexpr std::array<uint32_t, 7> kPlainTransfers = {0, 1, 2, 6, 13, 14, 15};
  constexpr std::array<NamedCode, 3> kPrimaries = {{{9, "BT.2020"}, {11, "DCI-P3"}, {12, "P3"}}};
  constexpr std::array<NamedCode, 3> kTransfers = {{{8, "linear"}, {16, "PQ"}, {18, "HLG"}}};
  std::string names;
  const auto add = [&names](uint32_t code, const auto& plain, const auto& named, const char* kind) {
    if (std::find(plain.begin(), plain.end(), code) != plain.end()) {
      return;
    }
    const auto found = std::find_if(named.begin(), named.end(),
                                    [code](const NamedCode& name) { return name.code == code; });
    names += names.empty() ? "" : " ";
    names += found != named.end() ? std::string(found->name)
                                  : std::string(kind) + " " + std::to_string(code);
  };
  add(primaries, kPlainPrimaries, kPrimaries, "primaries");
  add(transfer, kPlainTransfers, kTransfers, "transfer");
  return names;
}

// Returns the foreign colours of a PNG that gives its colours by numbers (chunk cICP of the third
// edition of PNG); nullopt if there is no such chunk. It comes before the pixels.
std::optional<std::string> FindPngColours(Bytes encoded) {
  const Profile chunks(encoded);
  for (size_t at = 8; at < encoded.size() && !chunks.Says(at + 4, "IDAT");
       at += size_t{12} + chunks.Number(at)) {
    if (chunks.Says(at + 4, "cICP") && chunks.Number(at) == 4) {
      const uint32_t codes = chunks.Number(at + 8);
      return ForeignColours(codes >> 24, codes >> 16 & 0xff);
    }
  }
  return std::nullopt;
}

// Returns the foreign colours of a HEIC or AVIF file that gives its colours by numbers (box "colr"
// of ISO/IEC 14496-12, kind "nclx").
std::string FindHeifColours(Bytes encoded) {
  constexpr std::string_view kBox = "colrnclx";
  const std::optional<size_t> at = FindNear(encoded, kBox);
  const uint32_t codes = at ? Profile(encoded).Number(*at + kBox.size()) : 0;
  return at ? ForeignColours(codes >> 16, codes & 0xffff) : "";
}

}  // namespace

std::vector<std::string> PictureNotes(Bytes encoded) {
  std::vector<std::string> notes;
  std::vector<std::byte> held;
  std::optional<Profile> profile;
  std::string colours;
  if (IsTiff(encoded)) {
    const TiffTraits traits = ReadTiffTraits(encoded);
    held = traits.profile;
    if (traits.pages > 1) {
      notes.push_back("has " + std::to_string(traits.pages) +
                      " pages, of which only the first is used: save each as a file of its own");
    }
  } else if (StartsWith(encoded, 1, "PNG")) {
    const std::optional<std::string> found = FindPngColours(encoded);
    colours = found.value_or("");
    held = found ? held : ReadPngProfile(encoded);  // The numbers are valid instead of a profile.
  } else {
    profile = FindPlain(encoded);
    colours = profile || !IsHeif(encoded) ? "" : FindHeifColours(encoded);
  }
  if (!held.empty()) {
    profile = Profile(held);
  }
  if (profile && profile->Foreign()) {
    colours = profile->Name();
  }
  if (!colours.empty()) {
    notes.push_back("is in the colours of \"" + colours +
                    "\", which are taken for those of sRGB: save it in sRGB");
  }
  return notes;
}

}  // namespace lararium::image
