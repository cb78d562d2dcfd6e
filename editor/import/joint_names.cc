#include "editor/import/joint_names.h"

#include <cctype>
#include <iterator>

namespace lararium::import {
namespace {

enum class Side { kMiddle, kLeft, kRight };

struct Synonym {
  std::string_view bare;    // lower case, without side, prefix and separators
  std::string_view h_anim;  // without side
};

constexpr Synonym kMiddleJoints[] = {
    {"hips", "humanoid_root"}, {"pelvis", "humanoid_root"}, {"spine", "vl5"},  {"spine01", "vl5"},
    {"spine1", "vt10"},        {"spine02", "vt10"},         {"spine2", "vt4"}, {"spine03", "vt4"},
    {"chest", "vt10"},         {"upperchest", "vt4"},       {"neck", "vc4"},   {"neck01", "vc4"},
    {"head", "skullbase"}};

constexpr Synonym kPairedJoints[] = {{"upleg", "hip"},
                                     {"thigh", "hip"},
                                     {"upperleg", "hip"},
                                     {"leg", "knee"},
                                     {"calf", "knee"},
                                     {"shin", "knee"},
                                     {"lowerleg", "knee"},
                                     {"foot", "ankle"},
                                     {"toebase", "midtarsal"},
                                     {"ball", "midtarsal"},
                                     {"toe", "midtarsal"},
                                     {"toes", "midtarsal"},
                                     {"shoulder", "sternoclavicular"},
                                     {"clavicle", "sternoclavicular"},
                                     {"arm", "shoulder"},
                                     {"upperarm", "shoulder"},
                                     {"forearm", "elbow"},
                                     {"lowerarm", "elbow"},
                                     {"hand", "wrist"},
                                     {"wrist", "wrist"},
                                     {"handthumb1", "thumb1"},
                                     {"thumb01", "thumb1"},
                                     {"handindex1", "index1"},
                                     {"index01", "index1"},
                                     {"handmiddle1", "middle1"},
                                     {"middle01", "middle1"},
                                     {"handring1", "ring1"},
                                     {"ring01", "ring1"},
                                     {"handpinky1", "pinky1"},
                                     {"pinky01", "pinky1"}};

bool EndsWith(std::string_view text, std::string_view end) {
  return text.size() > end.size() && text.substr(text.size() - end.size()) == end;
}

// Takes the side off a lower-case name: left..., ..._l, ....l, l_... .
Side TakeSide(std::string& name) {
  struct Marker {
    std::string_view text;
    Side side;
  };
  constexpr Marker kPrefixes[] = {{"left", Side::kLeft}, {"right", Side::kRight}};
  constexpr Marker kSuffixes[] = {
      {"_l", Side::kLeft}, {"_r", Side::kRight}, {".l", Side::kLeft}, {".r", Side::kRight}};
  for (const Marker& marker : kPrefixes) {
    if (name.starts_with(marker.text)) {
      name.erase(0, marker.text.size());
      return marker.side;
    }
  }
  for (const Marker& marker : kSuffixes) {
    if (EndsWith(name, marker.text)) {
      name.resize(name.size() - marker.text.size());
      return marker.side;
    }
  }
  return Side::kMiddle;
}

std::string WithoutSeparators(const std::string& name) {
  std::string bare;
  for (const char c : name) {
    if (c != '_' && c != '.' && c != '-' && c != ' ') {
      bare += c;
    }
  }
  return bare;
}

std::string Lookup(const Synonym* begin, const Synonym* end, const std::string& bare) {
  for (const Synonym* synonym = begin; synonym != end; ++synonym) {
    if (synonym->bare == bare) {
      return std::string(synonym->h_anim);
    }
  }
  return {};
}

}  // namespace

std::string HAnimName(std::string_view name) {
  std::string lower;
  for (const char c : name) {
    lower += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  if (const size_t colon = lower.rfind(':'); colon != std::string::npos) {
    lower.erase(0, colon + 1);
  }
  const Side side = TakeSide(lower);
  const std::string bare = WithoutSeparators(lower);
  if (side == Side::kMiddle) {
    const std::string found = Lookup(std::begin(kMiddleJoints), std::end(kMiddleJoints), bare);
    return found.empty() ? std::string(name) : found;
  }
  const std::string found = Lookup(std::begin(kPairedJoints), std::end(kPairedJoints), bare);
  return found.empty() ? std::string(name) : (side == Side::kLeft ? "l_" : "r_") + found;
}

}  // namespace lararium::import
