#pragma once

// What a recipe can choose from, in the order and the words in which people look for it.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "editor/import/cast_library.h"
#include "shared/core/status.h"

namespace lararium::app {

// A slider of one feature: a modifier of the library, both sides together.
struct CastSlider {
  std::string modifier;  // as recipes call it, without l- and r-
  std::string label;     // "hump"
  std::string less;      // what it is towards min; empty: it begins at 0
  std::string more;      // towards 1
  float min = -1.0f;

  friend bool operator==(const CastSlider&, const CastSlider&) = default;
};

struct CastSliderGroup {
  std::string title;  // "Nose"
  std::vector<CastSlider> sliders;
};

struct CastCatalogue {
  std::vector<CastSliderGroup> groups;
  std::vector<std::string> skins;
  std::vector<std::string> hair;
  std::vector<std::string> beards;
  std::vector<std::string> eyebrows;
  std::vector<std::string> eyelashes;
  std::vector<std::string> eyes;  // colours
};

// One slider of the library in words; nothing for those that clothes hide in any case.
// group: as the library calls it. has_min: it has a target towards -1.
struct GroupedSlider {
  std::string title;
  CastSlider slider;
};
std::optional<GroupedSlider> DescribeModifier(std::string_view group,
                                              std::string_view name,
                                              bool has_min);

// Whether all words of the search are found in the slider's group, label or name; capitals
// do not count. An empty search finds all.
bool Matches(const CastSliderGroup& group, const CastSlider& slider, std::string_view search);

Result<CastCatalogue> ListCast(const import::CastLibrary& library);

}  // namespace lararium::app
