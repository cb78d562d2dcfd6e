#pragma once

// What a garment is to be like: an object of a person's recipe, written by people.
//
//   { "name": "tunic", "length": "knee", "sleeve": "short", "ease": 1.3, "belt": "leather",
//     "colour": "ochre", "stripes": "narrow", "stripe_colour": "purple", "seed": 3 }
//
// docs/how-to-dress-the-cast.md describes each field.

#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "shared/core/json.h"
#include "shared/core/status.h"

namespace lararium::import {

enum class GarmentKind : uint8_t { kTunic, kStola, kApron, kToga, kPalla, kSandals };

enum class Sleeve : uint8_t { kNone, kShort, kElbow };
enum class Stripes : uint8_t { kNone, kNarrow, kBroad };
enum class Belt : uint8_t { kNone, kCord, kLeather };

struct GarmentPattern {
  GarmentKind kind = GarmentKind::kTunic;
  // Height of the hem, as a share of the way from the hip joint (0) over the knee (1)
  // to the sole (2).
  float hem = 1.05f;
  Sleeve sleeve = Sleeve::kShort;
  bool one_shoulder = false;  // exomis: the right shoulder is bare
  float ease = 1.55f;         // width of the cloth over the body's widest girth
  Belt belt = Belt::kLeather;
  float blouse = 0.06f;                       // metres of cloth drawn up over the belt
  glm::vec3 colour = glm::vec3(0.6f);         // linear RGB
  glm::vec3 belt_colour = glm::vec3(0.1f);    // likewise
  glm::vec3 stripe_colour = glm::vec3(0.1f);  // of stripes, borders
  Stripes stripes = Stripes::kNone;
  bool border = false;  // a woven band along the hem
  float wear = 0.3f;    // 0 new .. 1 faded and soiled at the hem
  uint64_t seed = 1;
};

// "tunic", ... : what a recipe may name.
std::vector<std::string> GarmentNames();
bool IsGarmentName(std::string_view name);
std::string NameOf(GarmentKind kind);

// The words that a field may be: of length, sleeve, belt, stripes, or a dye's for any
// other.
std::vector<std::string> GarmentWords(std::string_view field);

// Errors name the field, and what it may be.
Result<GarmentPattern> ParseGarmentPattern(const JsonView& garment);

// A dye's name ("madder") or "#rrggbb", as linear RGB.
Result<glm::vec3> ParseDye(const JsonView& field);

}  // namespace lararium::import
