#include "editor/jobs/cast_catalogue.h"

#include <algorithm>
#include <array>
#include <utility>

#include "editor/text/text.h"
#include "shared/core/lower_case.h"

namespace lararium::editor {
namespace {

using import::CastLibrary;
using import::CastModifier;
using import::CastPart;

// The titles in their order, and the library's groups below each.
struct GroupTitle {
  const char* title;
  std::array<std::string_view, 4> groups;
};
constexpr GroupTitle kTitles[] = {{TrLater("Head"), {"head"}},
                                  {TrLater("Forehead and brows"), {"forehead", "eyebrows"}},
                                  {TrLater("Eyes"), {"eyes"}},
                                  {TrLater("Nose"), {"nose"}},
                                  {TrLater("Mouth"), {"mouth"}},
                                  {TrLater("Chin and cheeks"), {"chin", "cheek"}},
                                  {TrLater("Ears"), {"ears"}},
                                  {TrLater("Neck"), {"neck"}},
                                  {TrLater("Torso"), {"torso", "stomach", "breast"}},
                                  {TrLater("Hips"), {"hip", "buttocks", "pelvis"}},
                                  {TrLater("Arms and hands"), {}},
                                  {TrLater("Legs and feet"), {"legs"}}};
constexpr const char* kArms = "Arms and hands";
constexpr const char* kLegs = "Legs and feet";

// First words of a modifier's name that repeat the group's title.
constexpr std::string_view kSaid[] = {"head",  "forehead", "eye",  "nose",  "mouth", "ear",
                                      "cheek", "chin",     "neck", "torso", "hip",   "legs"};
constexpr std::string_view kHidden[] = {"nipple", "bulge"};

constexpr std::pair<std::string_view, std::string_view> kWords[] = {
    {"scale-vert", "height"},
    {"scale-horiz", "width"},
    {"scale-depth", "depth"},
    {"trans-vert", "higher or lower"},
    {"trans-horiz", "to the side"},
    {"trans-depth", "forward or back"},
    {"trans", "position"},
    {"scale", "size"},
    {"rot", "turn"},
    {"volume-vert", "upper or lower volume"},
    {"genu", "knees"},
    {"upperlegheight", "thigh length"},
    {"lowerlegheight", "shin length"},
    {"upperarm", "upper arm"},
    {"lowerarm", "forearm"},
    {"upperleg", "thigh"},
    {"lowerleg", "shin"},
    {"upperlip", "upper lip"},
    {"lowerlip", "lower lip"},
    {"cupidsbow", "cupid's bow"},
    {"eyefold", "lid fold"},
    {"pregnant", "belly"},
    {"vshape", "v-shape"},
    {"ext", "corner"},
    {"dist", "distance"},
    {"septumangle", "septum angle"},
    {"prognathism", "lower jaw forward"},
    {"invertedtriangular", "inverted triangle"},
    {"triangular", "triangle"}};

constexpr std::pair<std::string_view, std::string_view> kEnds[] = {
    {"decr", TrLater("less")},        {"incr", TrLater("more")},
    {"min", TrLater("less")},         {"max", TrLater("more")},
    {"lesshump", TrLater("less")},    {"morehump", TrLater("more")},
    {"lessgreek", TrLater("less")},   {"moregreek", TrLater("more")},
    {"varun", TrLater("bowed")},      {"valgus", TrLater("knock")},
    {"decrease", TrLater("less")},    {"increase", TrLater("more")},
    {"compress", TrLater("shorter")}, {"uncompress", TrLater("longer")}};

// One slider controls the left and the right side.
std::string_view WithoutSide(std::string_view name) {
  return name.starts_with("l-") || name.starts_with("r-") ? name.substr(2) : name;
}

std::string_view EndWord(std::string_view end) {
  for (const auto& [word, said] : kEnds) {
    if (end == word) {
      return said;
    }
  }
  return end;
}

// Translates the compound words of the library, such as "scale-vert" and "hand-scale"; other words
// stay as they are.
std::string Spell(std::string_view name) {
  std::string label;
  while (!name.empty()) {
    std::string_view said = name.substr(0, name.find('-'));
    size_t length = said.size();
    for (const auto& [word, ours] : kWords) {
      const bool whole =
          name.starts_with(word) && (name.size() == word.size() || name[word.size()] == '-');
      if (whole) {
        said = ours;
        length = word.size();
        break;  // Longer words come first in the table.
      }
    }
    label += (label.empty() ? "" : " ") + std::string(said);
    name.remove_prefix(std::min(length + 1, name.size()));
  }
  return label;
}

const char* TitleOf(std::string_view group, std::string_view name) {
  if (group == "armslegs") {
    const bool leg = name.find("leg") != name.npos || name.find("foot") != name.npos;
    return leg ? kLegs : kArms;
  }
  for (const GroupTitle& title : kTitles) {
    if (std::find(title.groups.begin(), title.groups.end(), group) != title.groups.end()) {
      return title.title;
    }
  }
  return nullptr;
}

// Splits "nose-hump-lesshump
// morehump" into the stem "nose-hump" and the labels of the two ends.
void SplitEnds(std::string_view name, std::string_view& stem, CastSlider& slider) {
  const size_t bar = name.find('|');
  stem = name;
  slider.more = "more";
  if (bar != name.npos) {
    const size_t hyphen = name.rfind('-', bar);
    stem = name.substr(0, std::min(hyphen, name.size()));
    slider.less = EndWord(name.substr(stem.size() + 1, bar - stem.size() - 1));
    slider.more = EndWord(name.substr(bar + 1));
  }
}

// Adds the labels of the ends to sliders that have the same label otherwise.
void TellApart(std::vector<CastSlider>& sliders) {
  std::vector<bool> alike(sliders.size(), false);
  for (size_t i = 0; i < sliders.size(); ++i) {
    for (size_t j = 0; j < sliders.size(); ++j) {
      alike[i] = alike[i] || (i != j && sliders[i].label == sliders[j].label);
    }
  }
  for (size_t i = 0; i < sliders.size(); ++i) {
    if (alike[i]) {
      sliders[i].label += " (" + sliders[i].less + ", " + sliders[i].more + ")";
    }
  }
}

std::vector<CastSliderGroup> GroupSliders(const CastLibrary& library) {
  std::vector<CastSliderGroup> groups;
  for (const GroupTitle& title : kTitles) {
    groups.push_back({title.title, {}});
  }
  for (const CastModifier& modifier : library.modifiers()) {
    auto described =
        DescribeModifier(modifier.group, modifier.name, modifier.min_target.has_value());
    if (!described) {
      continue;
    }
    const auto group = std::find_if(groups.begin(), groups.end(),
                                    [&](const auto& g) { return g.title == described->title; });
    // The slider may already exist for the other side.
    if (std::find(group->sliders.begin(), group->sliders.end(), described->slider) ==
        group->sliders.end()) {
      group->sliders.push_back(std::move(described->slider));
    }
  }
  std::erase_if(groups, [](const CastSliderGroup& group) { return group.sliders.empty(); });
  for (CastSliderGroup& group : groups) {
    TellApart(group.sliders);
  }
  return groups;
}

bool IsBeard(const std::string& part) {
  const std::string name = LowerCase(part);
  return name.find("beard") != name.npos || name.find("moustache") != name.npos;
}

}  // namespace

std::optional<GroupedSlider> DescribeModifier(std::string_view group,
                                              std::string_view name,
                                              bool has_min) {
  name = WithoutSide(name);
  const char* title = TitleOf(group, name);
  const bool hidden = std::any_of(std::begin(kHidden), std::end(kHidden),
                                  [&](std::string_view word) { return name.starts_with(word); });
  if (title == nullptr || hidden) {
    return std::nullopt;
  }
  GroupedSlider described{title, {}};
  CastSlider& slider = described.slider;
  slider.modifier = name;
  slider.min = has_min ? -1.0f : 0.0f;
  std::string_view stem;
  SplitEnds(name, stem, slider);
  const std::string_view first = stem.substr(0, stem.find('-'));
  const bool said = std::find(std::begin(kSaid), std::end(kSaid), first) != std::end(kSaid);
  if (said && first.size() < stem.size()) {
    stem.remove_prefix(first.size() + 1);
  } else if (said) {
    stem = "fullness";  // "head-skinny|fat" is about the whole head.
  }
  slider.label = Spell(stem);
  return described;
}

bool Matches(const CastSliderGroup& group, const CastSlider& slider, std::string_view search) {
  const std::string all = LowerCase(group.title + " " + slider.label + " " + slider.modifier);
  const std::string wanted = LowerCase(search);
  for (size_t at = 0; at < wanted.size();) {
    const size_t end = std::min(wanted.find(' ', at), wanted.size());
    if (all.find(wanted.substr(at, end - at)) == all.npos) {
      return false;
    }
    at = end + 1;
  }
  return true;
}

Result<CastCatalogue> ListCast(const CastLibrary& library) {
  CastCatalogue catalogue;
  catalogue.groups = GroupSliders(library);
  catalogue.skins = library.Skins();
  for (std::string& part : library.Parts(CastPart::kHair)) {
    (IsBeard(part) ? catalogue.beards : catalogue.hair).push_back(std::move(part));
  }
  catalogue.eyebrows = library.Parts(CastPart::kEyebrows);
  catalogue.eyelashes = library.Parts(CastPart::kEyelashes);
  LARARIUM_ASSIGN_OR_RETURN(const import::CastProxy eyes,
                            library.LoadPart(CastPart::kEyes, "HighPolyEyes"));
  for (const import::CastMaterial& material : eyes.mesh.materials) {
    catalogue.eyes.push_back(material.name);
  }
  for (const std::string& name : import::GarmentNames()) {
    LARARIUM_ASSIGN_OR_RETURN(import::GarmentDesign design, import::LoadGarment(name));
    catalogue.garments.emplace(name,
                               std::make_shared<const import::GarmentDesign>(std::move(design)));
  }
  return catalogue;
}

}  // namespace lararium::editor
