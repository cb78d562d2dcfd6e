#pragma once

// What a person of the cast is made of: a small JSON file that people can write.
//
//   { "schema": 1, "name": "keeper", "sex": "male", "age": 45, "height": 1.70,
//     "weight": 0.8, "muscle": 0.55, "ethnicity": {"caucasian": 0.7, "african": 0.3},
//     "modifiers": {"nose-hump-lesshump|morehump": 0.5, "ear-size-small|big": 0.2},
//     "skin": {"name": "middleage_caucasian_male", "tint": "#c9a182", "stubble": 0.4},
//     "eyes": {"name": "brownlight", "colour": "#4a2f1c"}, "hair": {"name": "short02", "colour":
//     "#2a1c14"}, "beard": [{"name": "Full_beard", "colour": "#2a1c14"}], "garments": [{"name":
//     "tunic", ...}], "seed": 7 }

#include <filesystem>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "shared/core/json.h"
#include "shared/core/status.h"

namespace lararium::import {

// A fitted part and the colour that it is dyed to (sRGB-encoded, 0..1); none: as it is.
struct CastDyed {
  std::string name;
  std::optional<glm::vec3> colour;
  // Of hair: how far it stands off, of what it was modelled with; and how far it is drawn
  // into the face, radians about the ears.
  float volume = 1.0f;
  float tilt = 0.0f;
};

struct CastRecipe {
  std::string name = "person";
  float sex = 0.5f;     // 0 female .. 1 male
  float age = 25.0f;    // years, 1..90
  float muscle = 0.5f;  // 0..1, as are the next; 0.5 is average
  float weight = 0.5f;
  float proportions = 0.5f;  // 1: ideal
  float breast_size = 0.5f;
  float breast_firmness = 0.5f;
  std::optional<float> height;             // metres; none: what the rest gives
  glm::vec3 ethnicity{1.0f, 0.0f, 0.0f};   // caucasian, african, asian; any sum above 0
  std::map<std::string, float> modifiers;  // CastModifier::name; without l-, r-: both sides
  float asymmetry = 0.3f;                  // of the face, 0..1, drawn from the seed

  std::string skin;                    // none: by age, sex and ethnicity
  std::optional<glm::vec3> skin_tint;  // mean colour that the skin is brought to
  float stubble = 0.0f;                // 0..1, painted where a beard would grow
  float weathering = 0.0f;             // 0..1, sun and years
  float freckles = 0.0f;               // 0..1, on nose and cheeks
  float sunburn = 0.0f;                // 0..1, of what faces the sky on face and forearms
  CastDyed eyes{"brownlight", {}};     // one of the colours that there are, dyed
  CastDyed eyebrows{"eyebrow010", {}};
  std::string eyelashes = "eyelashes02";
  std::string teeth = "Teeth_Base";
  std::string tongue = "tongue01";
  std::optional<CastDyed> hair;
  std::vector<CastDyed> beard;
  std::vector<Json> garments;  // each an object with a name; its cutter reads the rest
  uint64_t seed = 1;
};

Result<CastRecipe> ParseCastRecipe(const JsonView& root);
Result<CastRecipe> LoadCastRecipe(const std::filesystem::path& file);
Json ToJson(const CastRecipe& recipe);

}  // namespace lararium::import
