#include "editor/import/cast/cast_shape.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>
#include <map>
#include <utility>

#include "shared/core/random.h"

namespace lararium::import {
namespace {

constexpr float kMetresPerUnit = 0.1f;
// No shape moves a vertex more than 1.5 m. One target of the library (r-eye-bag-max) moves
// helper vertices by two metres, and the eyelashes would follow them.
constexpr float kMostDelta = 15000.0f;  // Multiples of CastLibrary::kDeltaUnit.

// The lips of the base mesh are slightly open; this negative share of the open mouth closes
// them.
constexpr float kLipsClosed = 0.04f;
constexpr std::string_view kEthnicityNames[] = {"caucasian", "african", "asian"};

using Factors = std::map<std::string, float, std::less<>>;

// Library frame (facing +Z) to actor frame (facing -Z).
glm::vec3 ToActor(const glm::vec3& p) { return {-p.x, p.y, -p.z}; }

// Weights of three words for a quantity from 0 to 1: least, average and most.
void AddThree(Factors& factors,
              float value,
              const std::string& least,
              const std::string& average,
              const std::string& most) {
  const float low = std::max(0.0f, 1.0f - 2.0f * value);
  const float high = std::max(0.0f, 2.0f * value - 1.0f);
  factors[least] = low;
  factors[most] = high;
  factors[average] = 1.0f - low - high;
}

// Shapes exist for ages 1 (baby), 10 (child), 25 (young) and 90 (old); other ages blend the two
// neighbours.
void AddAges(Factors& factors, float years) {
  constexpr std::pair<const char*, float> kAges[] = {
      {"baby", 1.0f}, {"child", 10.0f}, {"young", 25.0f}, {"old", 90.0f}};
  for (const auto& [name, age] : kAges) {
    factors[name] = 0.0f;
  }
  for (int i = 0; i < 3; ++i) {
    const auto [younger, from] = kAges[i];
    const auto [older, to] = kAges[i + 1];
    if (years <= to || i == 2) {
      const float share = std::clamp((years - from) / (to - from), 0.0f, 1.0f);
      factors[younger] = 1.0f - share;
      factors[older] = share;
      return;
    }
  }
}

Factors FactorsOf(const CastRecipe& recipe) {
  Factors factors;
  AddAges(factors, recipe.age);
  factors["male"] = recipe.sex;
  factors["female"] = 1.0f - recipe.sex;
  const float sum = recipe.ethnicity.x + recipe.ethnicity.y + recipe.ethnicity.z;
  for (int i = 0; i < 3; ++i) {
    factors[std::string(kEthnicityNames[i])] = recipe.ethnicity[i] / sum;
  }
  AddThree(factors, recipe.muscle, "minmuscle", "averagemuscle", "maxmuscle");
  AddThree(factors, recipe.weight, "minweight", "averageweight", "maxweight");
  AddThree(factors, recipe.proportions, "uncommonproportions", "regularproportions",
           "idealproportions");
  AddThree(factors, recipe.breast_size, "mincup", "averagecup", "maxcup");
  AddThree(factors, recipe.breast_firmness, "minfirmness", "averagefirmness", "maxfirmness");
  return factors;
}

// The product of the factors named in the file name of the target; words that are not factors
// ("universal") are ignored.
float Share(std::string_view target, const Factors& factors) {
  float share = 1.0f;
  target.remove_prefix(target.rfind('/') + 1);
  while (!target.empty() && share > 0.0f) {
    const size_t end = std::min(target.find('-'), target.size());
    const auto factor = factors.find(target.substr(0, end));
    if (factor != factors.end()) {
      share *= factor->second;
    }
    target.remove_prefix(std::min(end + 1, target.size()));
  }
  return share;
}

bool IsBreastMacro(std::string_view name) {
  return name.starts_with("breast/") && name.find("firmness") != std::string_view::npos;
}

void Add(std::vector<TargetShare>& shares, const std::optional<size_t>& target, float share) {
  if (target && share > 0.0f) {
    shares.push_back({*target, share});
  }
}

void AddModifier(std::vector<TargetShare>& shares, const CastModifier& modifier, float value) {
  Add(shares, value < 0.0f ? modifier.min_target : modifier.max_target, std::abs(value));
}

// The sliders whose name begins with the same word.
std::string Like(const CastLibrary& library, const std::string& name) {
  const std::string word = name.substr(0, name.find('-') + 1);
  std::string like;
  for (const CastModifier& modifier : library.modifiers()) {
    if (!word.empty() && modifier.name.find(word) != std::string::npos) {
      like += (like.empty() ? "" : ", ") + modifier.name;
    }
  }
  return like.empty() ? "none; src/json/modifiers of the cast library names all" : like;
}

Status AddModifiers(const CastLibrary& library,
                    const CastRecipe& recipe,
                    std::vector<TargetShare>& shares) {
  for (const auto& [name, value] : recipe.modifiers) {
    const CastModifier* whole = library.FindModifier(name);
    const CastModifier* left = library.FindModifier("l-" + name);
    const CastModifier* right = library.FindModifier("r-" + name);
    if (whole == nullptr && (left == nullptr || right == nullptr)) {
      return Status::Error(recipe.name + ": modifiers", "there is no slider '" + name + "'",
                           "similar ones: " + Like(library, name));
    }
    for (const CastModifier* modifier : {whole, left, right}) {
      if (modifier != nullptr) {
        AddModifier(shares, *modifier, value);
      }
    }
  }
  return Status();
}

// Adds small amounts of the one-sided targets, because no face is symmetric.
void AddAsymmetry(const CastLibrary& library,
                  const CastRecipe& recipe,
                  std::vector<TargetShare>& shares) {
  Random random(recipe.seed);
  for (size_t i = 0; i < library.targets().size(); ++i) {
    if (library.targets()[i].starts_with("asym/asym-")) {
      const double draw = std::max(0.0, random.Normal());
      Add(shares, i, recipe.asymmetry * static_cast<float>(std::min(draw, 2.0)) * 0.5f);
    }
  }
}

// The shares of macrodetails/height at full "minheight" or "maxheight".
std::vector<TargetShare> HeightShares(const CastLibrary& library,
                                      const CastRecipe& recipe,
                                      const std::string& extreme) {
  Factors factors = FactorsOf(recipe);
  factors["minheight"] = extreme == "minheight" ? 1.0f : 0.0f;
  factors["maxheight"] = extreme == "maxheight" ? 1.0f : 0.0f;
  std::vector<TargetShare> shares;
  for (size_t i = 0; i < library.targets().size(); ++i) {
    if (library.targets()[i].starts_with("macrodetails/height/")) {
      Add(shares, i, Share(library.targets()[i], factors));
    }
  }
  return shares;
}

struct Extent {
  float low = 1e9f;
  float high = -1e9f;
};

// Extent of the body alone, which is group 0.
Extent VerticalExtent(const CastLibrary& library, std::span<const glm::vec3> positions) {
  Extent extent;
  for (const CastFace& face : library.base().mesh.faces) {
    if (face.material == 0) {
      for (const uint32_t v : face.vertices) {
        extent.low = std::min(extent.low, positions[v].y);
        extent.high = std::max(extent.high, positions[v].y);
      }
    }
  }
  return extent;
}

void AddScaled(std::vector<glm::vec3>& positions, std::span<const glm::vec3> deltas, float scale) {
  for (size_t i = 0; i < positions.size(); ++i) {
    positions[i] += scale * deltas[i];
  }
}

// Adds as much of the tall or the short shape as brings the crown to the wanted height; outside
// their range, scales the whole body.
void BringToHeight(const CastLibrary& library,
                   const CastRecipe& recipe,
                   std::vector<glm::vec3>& positions) {
  const auto height_of = [&library](std::span<const glm::vec3> p) {
    const Extent extent = VerticalExtent(library, p);
    return extent.high - extent.low;
  };
  const float wanted = *recipe.height;
  const bool taller = wanted > height_of(positions);
  const std::vector<glm::vec3> deltas =
      TargetDeltas(library, HeightShares(library, recipe, taller ? "maxheight" : "minheight"));
  float low = 0.0f;
  float high = 1.0f;
  for (int i = 0; i < 20; ++i) {
    const float middle = 0.5f * (low + high);
    std::vector<glm::vec3> trial = positions;
    AddScaled(trial, deltas, middle);
    ((height_of(trial) < wanted) == taller ? low : high) = middle;
  }
  AddScaled(positions, deltas, low);
  const float scale = wanted / height_of(positions);
  for (glm::vec3& p : positions) {
    p *= scale;
  }
}

}  // namespace

Result<std::vector<TargetShare>> TargetShares(const CastLibrary& library,
                                              const CastRecipe& recipe) {
  const Factors factors = FactorsOf(recipe);
  std::vector<TargetShare> shares;
  for (size_t i = 0; i < library.targets().size(); ++i) {
    const std::string& name = library.targets()[i];
    const bool macro =
        name.starts_with("macrodetails/") && !name.starts_with("macrodetails/height");
    if (macro || IsBreastMacro(name)) {
      Add(shares, i, Share(name, factors));
    }
  }
  LARARIUM_RETURN_IF_ERROR(AddModifiers(library, recipe, shares));
  AddAsymmetry(library, recipe, shares);
  for (const TargetShare& open : UnitShares(library, recipe, "mouth-open")) {
    shares.push_back({open.target, -kLipsClosed * open.share});
  }
  return shares;
}

std::vector<TargetShare> UnitShares(const CastLibrary& library,
                                    const CastRecipe& recipe,
                                    std::string_view unit) {
  const float sum = recipe.ethnicity.x + recipe.ethnicity.y + recipe.ethnicity.z;
  std::vector<TargetShare> shares;
  for (int i = 0; i < 3; ++i) {
    const std::string name =
        "expression/units/" + std::string(kEthnicityNames[i]) + "/" + std::string(unit);
    Add(shares, library.FindTarget(name), recipe.ethnicity[i] / sum);
  }
  return shares;
}

std::vector<glm::vec3> TargetDeltas(const CastLibrary& library,
                                    std::span<const TargetShare> shares) {
  std::vector<glm::vec3> sum(library.base().mesh.positions.size(), glm::vec3(0.0f));
  for (const TargetShare& share : shares) {
    const std::span<const int16_t> deltas = library.Deltas(share.target);
    const float scale = share.share * CastLibrary::kDeltaUnit;
    for (size_t v = 0; v < sum.size(); ++v) {
      const glm::vec3 delta(deltas[3 * v], deltas[3 * v + 1], deltas[3 * v + 2]);
      if (glm::all(glm::lessThan(glm::abs(delta), glm::vec3(kMostDelta)))) {
        sum[v] += scale * ToActor(delta);
      }
    }
  }
  return sum;
}

std::vector<glm::vec3> UnshapedBase(const CastLibrary& library) {
  std::vector<glm::vec3> positions;
  positions.reserve(library.base().mesh.positions.size());
  for (const glm::vec3& p : library.base().mesh.positions) {
    positions.push_back(kMetresPerUnit * ToActor(p));
  }
  return positions;
}

Result<std::vector<glm::vec3>> ShapeBase(const CastLibrary& library, const CastRecipe& recipe) {
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<TargetShare> shares, TargetShares(library, recipe));
  std::vector<glm::vec3> positions = UnshapedBase(library);
  AddScaled(positions, TargetDeltas(library, shares), 1.0f);
  if (recipe.height) {
    BringToHeight(library, recipe, positions);
  }
  const float sole = VerticalExtent(library, positions).low;
  for (glm::vec3& p : positions) {
    p.y -= sole;
  }
  return positions;
}

}  // namespace lararium::import
