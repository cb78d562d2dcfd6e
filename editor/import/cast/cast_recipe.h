#pragma once

// The recipe of a person of the cast: a small JSON file that people can write.
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
#include "shared/core/json_fields.h"
#include "shared/core/status.h"

namespace lararium::import {

// A fitted part and the colour to dye it with (sRGB-encoded, 0..1); without one it keeps its
// own.
struct CastDyed {
  std::string name;
  std::optional<glm::vec3> colour;
  // Only for hair: its volume relative to the model, and the angle in radians by which it is
  // rotated about the ears into the face.
  float volume = 1.0f;
  float tilt = 0.0f;
};

struct CastRecipe {
  std::string name = "person";
  float sex = 0.5f;     // 0 female .. 1 male
  float age = 25.0f;    // Years, 1..90.
  float muscle = 0.5f;  // 0..1, like the following; 0.5 is average.
  float weight = 0.5f;
  float proportions = 0.5f;  // 1 is ideal.
  float breast_size = 0.5f;
  float breast_firmness = 0.5f;
  std::optional<float> height;  // Metres; if empty, it follows from the other values.
  // Shares of caucasian, african, asian; their sum is above 0.
  glm::vec3 ethnicity{1.0f, 0.0f, 0.0f};
  // By CastModifier::name; without l- or r- it applies to both sides.
  std::map<std::string, float> modifiers;
  float asymmetry = 0.3f;  // Asymmetry of the face, 0..1, drawn from the seed.

  std::string skin;                    // If empty, chosen by age, sex and ethnicity.
  std::optional<glm::vec3> skin_tint;  // Target for the mean colour of the skin.
  float stubble = 0.0f;                // 0..1, painted where a beard would grow.
  float weathering = 0.0f;             // 0..1, effect of sun and years.
  float freckles = 0.0f;               // 0..1, on nose and cheeks.
  float sunburn = 0.0f;                // 0..1, on the parts of face and forearms that face the sky.
  CastDyed eyes{"brownlight", {}};     // One of the eye colours of the library, dyed.
  CastDyed eyebrows{"eyebrow010", {}};
  std::string eyelashes = "eyelashes02";
  std::string teeth = "Teeth_Base";
  std::string tongue = "tongue01";
  std::optional<CastDyed> hair;
  std::vector<CastDyed> beard;
  // Each is an object with a name; the code that cuts the garment reads the rest.
  std::vector<Json> garments;
  uint64_t seed = 1;
};

void DescribeFields(Fields& fields, CastRecipe& recipe);
Result<CastRecipe> LoadCastRecipe(const std::filesystem::path& file);

}  // namespace lararium::import
