#pragma once

// The options of a recipe, in the order and the words of the interface.

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "editor/import/cast/cast_library.h"
#include "editor/import/wardrobe/garment_design.h"
#include "shared/core/status.h"

namespace lararium::editor {

// A slider for one feature: a modifier of the library that controls the left and the right side
// together.
struct CastSlider {
  std::string modifier;  // The name in recipes, without the prefixes l- and r-.
  std::string label;     // Example: "hump".
  std::string less;      // The label of the end at min; empty: the slider begins at 0.
  std::string more;      // The label of the end at 1.
  float min = -1.0f;

  friend bool operator==(const CastSlider&, const CastSlider&) = default;
};

struct CastSliderGroup {
  std::string title;  // Example: "Nose".
  std::vector<CastSlider> sliders;
};

struct CastCatalogue {
  std::vector<CastSliderGroup> groups;
  std::vector<std::string> skins;
  std::vector<std::string> hair;
  std::vector<std::string> beards;
  std::vector<std::string> eyebrows;
  std::vector<std::string> eyelashes;
  std::vector<std::string> eyes;  // Colours.
  std::map<std::string, std::shared_ptr<const import::GarmentDesign>, std::less<>> garments;
};

// Describes one modifier of the library. Returns nullopt for those that clothes always hide. group:
// the name in the library. has_min: the modifier has a target towards -1.
struct GroupedSlider {
  std::string title;
  CastSlider slider;
};
std::optional<GroupedSlider> DescribeModifier(std::string_view group,
                                              std::string_view name,
                                              bool has_min);

// Whether the slider's group, label or name contains each word of the search, ignoring case. An
// empty search matches everything.
bool Matches(const CastSliderGroup& group, const CastSlider& slider, std::string_view search);

Result<CastCatalogue> ListCast(const import::CastLibrary& library);

}  // namespace lararium::editor
