#include "editor/import/model/model_expressions.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <string_view>

#include "shared/human/turns.h"

namespace lararium::import {
namespace {

using human::FaceShape;

constexpr float kJawOpenAngle = 0.35f;  // Radians for a mouth opened to a loud "ah".

constexpr std::array kVisemes = {"sil", "PP", "FF", "TH", "DD", "kk", "CH", "SS",
                                 "nn",  "RR", "aa", "E",  "ih", "oh", "ou"};

struct Synonym {
  std::string_view foreign;  // Lower-case letters and digits.
  std::string_view own;      // An action listed below, or one of our shapes.
};

// Actions without a side are those of ARKit without Left and Right.
constexpr Synonym kSynonyms[] = {
    // VRM, VRoid and plain words
    {"ee", "E"},
    {"happy", "joy"},
    {"happiness", "joy"},
    {"smile", "joy"},
    {"sad", "sadness"},
    {"sorrow", "sadness"},
    {"angry", "anger"},
    {"afraid", "fear"},
    {"scared", "fear"},
    {"disgusted", "disgust"},
    {"surprised", "surprise"},
    {"fclmtha", "aa"},
    {"fclmthi", "ih"},
    {"fclmthu", "ou"},
    {"fclmthe", "E"},
    {"fclmtho", "oh"},
    {"fclalljoy", "joy"},
    {"fclallsorrow", "sadness"},
    {"fclallangry", "anger"},
    {"fclallsurprised", "surprise"},
    {"fcleyeclose", "eyeBlink"},
    {"blink", "eyeBlink"},
    {"eyesclosed", "eyeBlink"},
    {"eyeclose", "eyeBlink"},
    {"mouthopen", "jawOpen"},
    // FACS
    {"au1", "browInnerUp"},
    {"au2", "browOuterUp"},
    {"au4", "browDown"},
    {"au5", "eyeWide"},
    {"au6", "cheekSquint"},
    {"au7", "eyeSquint"},
    {"au9", "noseSneer"},
    {"au10", "mouthUpperUp"},
    {"au12", "mouthSmile"},
    {"au14", "mouthDimple"},
    {"au15", "mouthFrown"},
    {"au16", "mouthLowerDown"},
    {"au17", "mouthShrugLower"},
    {"au18", "mouthPucker"},
    {"au20", "mouthStretch"},
    {"au22", "mouthFunnel"},
    {"au23", "mouthPress"},
    {"au24", "mouthPress"},
    {"au26", "jawOpen"},
    {"au27", "jawOpen"},
    {"au28", "mouthRollLower"},
    {"au43", "eyeBlink"},
    {"au45", "eyeBlink"},
    // MPEG-4 parameters
    {"openjaw", "jawOpen"},
    {"pushblip", "mouthFunnel"},
    {"raisecornerlip", "mouthSmile"},
    {"stretchcornerlip", "mouthStretch"},
    {"closeteyelid", "eyeBlink"},
    {"raiseieyebrow", "browInnerUp"},
    {"raiseoeyebrow", "browOuterUp"},
    {"squeezeeyebrow", "browDown"},
    {"liftcheek", "cheekSquint"},
    {"stretchnose", "noseSneer"},
};

struct Ingredient {
  std::string_view action;
  float weight;
};

struct Recipe {
  std::string_view shape;
  std::vector<Ingredient> ingredients;
};

// Articulation from phonetics; expressions after EMFACS (joy 6+12, sadness 1+4+15, anger
// 4+5+7+23, fear 1+2+4+5+20+26, disgust 9+15+16, surprise 1+2+5+26).
const std::vector<Recipe>& ActionRecipes() {
  static const std::vector<Recipe> kRecipes = {
      {"PP", {{"mouthPress", 0.6f}, {"mouthRollLower", 0.3f}, {"mouthRollUpper", 0.3f}}},
      {"FF", {{"mouthRollLower", 0.5f}, {"mouthUpperUp", 0.25f}, {"jawOpen", 0.05f}}},
      {"TH", {{"jawOpen", 0.15f}, {"tongueOut", 0.3f}, {"mouthLowerDown", 0.2f}}},
      {"DD", {{"jawOpen", 0.15f}, {"mouthLowerDown", 0.25f}, {"mouthUpperUp", 0.1f}}},
      {"kk", {{"jawOpen", 0.2f}, {"mouthStretch", 0.2f}}},
      {"CH", {{"mouthFunnel", 0.6f}, {"jawOpen", 0.1f}}},
      {"SS", {{"mouthStretch", 0.4f}, {"mouthLowerDown", 0.2f}, {"jawOpen", 0.05f}}},
      {"nn", {{"jawOpen", 0.12f}, {"mouthLowerDown", 0.15f}}},
      {"RR", {{"mouthFunnel", 0.35f}, {"mouthPucker", 0.15f}, {"jawOpen", 0.1f}}},
      {"aa", {{"jawOpen", 0.6f}, {"mouthLowerDown", 0.15f}}},
      {"E", {{"jawOpen", 0.3f}, {"mouthStretch", 0.35f}, {"mouthSmile", 0.1f}}},
      {"ih", {{"jawOpen", 0.2f}, {"mouthStretch", 0.25f}, {"mouthSmile", 0.15f}}},
      {"oh", {{"jawOpen", 0.4f}, {"mouthFunnel", 0.6f}}},
      {"ou", {{"mouthPucker", 0.8f}, {"jawOpen", 0.15f}, {"mouthFunnel", 0.2f}}},
      {"joy", {{"mouthSmile", 0.8f}, {"cheekSquint", 0.5f}, {"eyeSquint", 0.2f}}},
      {"sadness",
       {{"mouthFrown", 0.7f},
        {"browInnerUp", 0.8f},
        {"browDown", 0.2f},
        {"mouthShrugLower", 0.3f}}},
      {"anger",
       {{"browDown", 0.9f},
        {"eyeSquint", 0.3f},
        {"eyeWide", 0.2f},
        {"mouthPress", 0.5f},
        {"noseSneer", 0.3f}}},
      {"fear",
       {{"browInnerUp", 0.8f},
        {"eyeWide", 0.8f},
        {"browOuterUp", 0.4f},
        {"mouthStretch", 0.5f},
        {"jawOpen", 0.15f}}},
      {"disgust",
       {{"noseSneer", 0.9f},
        {"mouthFrown", 0.3f},
        {"mouthUpperUp", 0.5f},
        {"browDown", 0.4f},
        {"mouthLowerDown", 0.2f}}},
      {"surprise",
       {{"browInnerUp", 0.7f}, {"eyeWide", 0.7f}, {"browOuterUp", 0.8f}, {"jawOpen", 0.4f}}},
  };
  return kRecipes;
}

// Recipes from other shapes of ours, for figures with only the five vowels and four moods of
// VRM.
const std::vector<Recipe>& ShapeRecipes() {
  static const std::vector<Recipe> kRecipes = {
      {"PP", {{"ou", 0.1f}}},
      {"FF", {{"ih", 0.15f}}},
      {"TH", {{"ih", 0.25f}, {"aa", 0.1f}}},
      {"DD", {{"ih", 0.3f}}},
      {"kk", {{"ih", 0.15f}, {"aa", 0.2f}}},
      {"CH", {{"ou", 0.35f}, {"ih", 0.2f}}},
      {"SS", {{"ih", 0.35f}}},
      {"nn", {{"ih", 0.2f}, {"aa", 0.05f}}},
      {"RR", {{"ou", 0.3f}, {"ih", 0.1f}}},
      {"E", {{"aa", 0.4f}}},
      {"ih", {{"aa", 0.3f}}},
      {"oh", {{"aa", 0.5f}}},
      {"ou", {{"aa", 0.2f}}},
      {"fear", {{"surprise", 0.6f}, {"sadness", 0.4f}}},
      {"disgust", {{"anger", 0.6f}, {"sadness", 0.3f}}},
  };
  return kRecipes;
}

std::string Bare(std::string_view name) {
  std::string bare;
  for (const char c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0) {
      bare += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
  }
  return bare;
}

enum Side { kBoth, kOnRight, kOnLeft };

// Removes the side from the end of a name (mouthSmileLeft, eyeBlink_L) or from the middle of an
// MPEG-4 parameter (raise_l_cornerlip), and returns it.
Side TakeSide(std::string& name) {
  struct Marker {
    std::string_view text;
    Side side;
  };
  constexpr Marker kEnds[] = {{"Left", kOnLeft},    {"Right", kOnRight}, {"_left", kOnLeft},
                              {"_right", kOnRight}, {"_L", kOnLeft},     {"_R", kOnRight},
                              {"_l", kOnLeft},      {"_r", kOnRight},    {".L", kOnLeft},
                              {".R", kOnRight}};
  for (const Marker& marker : kEnds) {
    if (name.size() > marker.text.size() && name.ends_with(marker.text)) {
      name.resize(name.size() - marker.text.size());
      return marker.side;
    }
  }
  for (const Marker& marker : {Marker{"_l_", kOnLeft}, Marker{"_r_", kOnRight}}) {
    if (const size_t at = name.find(marker.text); at != std::string::npos) {
      name.erase(at, 2);
      return marker.side;
    }
  }
  return kBoth;
}

class Composer {
 public:
  Composer(const std::vector<ForeignShape>& shapes, std::optional<uint32_t> jaw) : jaw_(jaw) {
    for (const ForeignShape& shape : shapes) {
      Understand(shape);
    }
  }

  std::vector<FaceShape> Compose() {
    AddBlinks();
    for (const Recipe& recipe : ActionRecipes()) {
      AddFromActions(recipe);
    }
    const std::map<std::string, FaceShape> whole = shapes_;
    for (const Recipe& recipe : ShapeRecipes()) {
      AddFromShapes(recipe, whole);
    }
    AddSilence();
    std::vector<FaceShape> result;
    for (auto& [name, shape] : shapes_) {
      result.push_back(std::move(shape));
    }
    return result;
  }

 private:
  using Morphs = std::vector<FaceShape::Morph>;

  static bool IsOwn(std::string_view name) {
    constexpr std::array kOthers = {"joy",     "sadness",  "anger",   "fear",
                                    "disgust", "surprise", "blink_l", "blink_r"};
    return std::find(kVisemes.begin(), kVisemes.end(), name) != kVisemes.end() ||
           std::find(kOthers.begin(), kOthers.end(), name) != kOthers.end();
  }

  // "viseme_PP", "PP", "viseme_4", "v_aa".
  static std::string VisemeOf(const std::string& bare) {
    for (const std::string_view prefix : {"viseme", "v", ""}) {
      if (!bare.starts_with(prefix)) {
        continue;
      }
      const std::string rest = bare.substr(prefix.size());
      for (size_t i = 0; i < kVisemes.size(); ++i) {
        if (rest == Bare(kVisemes[i]) || (prefix == "viseme" && rest == std::to_string(i))) {
          return kVisemes[i];
        }
      }
    }
    return {};
  }

  void Understand(const ForeignShape& foreign) {
    // Blender and others prefix the mesh: "Head.mouthSmileLeft".
    std::string name = foreign.name;
    if (const size_t dot = name.rfind('.'); dot != std::string::npos && name.size() - dot > 2) {
      name.erase(0, dot + 1);
    }
    if (const std::string viseme = VisemeOf(Bare(name)); !viseme.empty()) {
      AddOwn(viseme, foreign.morphs);
      return;
    }
    const Side side = TakeSide(name);
    const std::string bare = Bare(name);
    std::string own;
    for (const Synonym& synonym : kSynonyms) {
      own = synonym.foreign == bare ? std::string(synonym.own) : own;
    }
    if (own.empty()) {
      own = ActionNamed(bare);
    }
    if (own.empty() && IsOwn(bare)) {
      own = bare;
    }
    if (own.empty()) {
      return;
    }
    if (IsOwn(own)) {
      AddOwn(own, foreign.morphs);
    } else {
      actions_[own][static_cast<size_t>(side)] = foreign.morphs;
    }
  }

  // The action of ARKit with this lower-case name.
  static std::string ActionNamed(const std::string& bare) {
    if (bare == "eyeblink") {
      return "eyeBlink";
    }
    for (const Recipe& recipe : ActionRecipes()) {
      for (const Ingredient& ingredient : recipe.ingredients) {
        if (Bare(ingredient.action) == bare) {
          return std::string(ingredient.action);
        }
      }
    }
    return {};
  }

  void AddOwn(const std::string& name, const Morphs& morphs) {
    FaceShape& shape = shapes_[name];
    if (shape.morphs.empty()) {
      shape.name = name;
      shape.morphs = morphs;
    }
  }

  static void Append(const Morphs& morphs, float weight, FaceShape& shape) {
    for (const FaceShape::Morph& morph : morphs) {
      const auto same =
          std::find_if(shape.morphs.begin(), shape.morphs.end(),
                       [&](const FaceShape::Morph& m) { return m.morph == morph.morph; });
      if (same != shape.morphs.end()) {
        same->weight += weight * morph.weight;
      } else {
        shape.morphs.push_back({morph.morph, weight * morph.weight});
      }
    }
  }

  // Each lid on its own, or half of a shape for both: together the two blinks close the eyes.
  void AddBlinks() {
    const auto blink = actions_.find("eyeBlink");
    if (blink == actions_.end()) {
      return;
    }
    for (const auto& [side, name] :
         {std::pair{kOnRight, "blink_r"}, std::pair{kOnLeft, "blink_l"}}) {
      const Morphs& one = blink->second[static_cast<size_t>(side)];
      FaceShape shape;
      shape.name = name;
      Append(one.empty() ? blink->second[kBoth] : one, one.empty() ? 0.5f : 1.0f, shape);
      if (!shape.morphs.empty() && !shapes_.contains(name)) {
        shapes_[name] = shape;
      }
    }
  }

  bool Has(std::string_view action) const {
    return actions_.contains(std::string(action)) || (action == "jawOpen" && jaw_.has_value());
  }

  void AddAction(const Ingredient& ingredient, FaceShape& shape) const {
    const auto action = actions_.find(std::string(ingredient.action));
    if (action == actions_.end()) {
      if (ingredient.action == "jawOpen" && jaw_.has_value()) {
        shape.turns.push_back({*jaw_, human::TurnX(-ingredient.weight * kJawOpenAngle)});
      }
      return;
    }
    const auto& [both, right, left] = action->second;
    if (right.empty() && left.empty()) {
      Append(both, ingredient.weight, shape);
    } else {
      Append(right, ingredient.weight, shape);
      Append(left, ingredient.weight, shape);
    }
  }

  // The first ingredient of a recipe is required.
  void AddFromActions(const Recipe& recipe) {
    if (shapes_.contains(std::string(recipe.shape)) || !Has(recipe.ingredients[0].action)) {
      return;
    }
    FaceShape shape;
    shape.name = recipe.shape;
    for (const Ingredient& ingredient : recipe.ingredients) {
      AddAction(ingredient, shape);
    }
    shapes_[shape.name] = std::move(shape);
  }

  void AddFromShapes(const Recipe& recipe, const std::map<std::string, FaceShape>& whole) {
    const std::string name(recipe.shape);
    if (shapes_.contains(name) || !whole.contains(std::string(recipe.ingredients[0].action))) {
      return;
    }
    FaceShape shape;
    shape.name = name;
    for (const Ingredient& ingredient : recipe.ingredients) {
      const auto other = whole.find(std::string(ingredient.action));
      if (other == whole.end()) {
        continue;
      }
      Append(other->second.morphs, ingredient.weight, shape);
      for (const FaceShape::Turn& turn : other->second.turns) {
        shape.turns.push_back({turn.joint, human::Share(turn.rotation, ingredient.weight)});
      }
    }
    shapes_[name] = std::move(shape);
  }

  void AddSilence() {
    const bool speaks = std::any_of(kVisemes.begin(), kVisemes.end(),
                                    [&](const char* viseme) { return shapes_.contains(viseme); });
    if (speaks) {
      shapes_["sil"].name = "sil";
    }
  }

  std::optional<uint32_t> jaw_;
  std::map<std::string, std::array<Morphs, 3>> actions_;  // Indexed by Side.
  std::map<std::string, FaceShape> shapes_;
};

}  // namespace

std::vector<FaceShape> ComposeFace(const std::vector<ForeignShape>& shapes,
                                   std::optional<uint32_t> jaw) {
  return Composer(shapes, jaw).Compose();
}

}  // namespace lararium::import
