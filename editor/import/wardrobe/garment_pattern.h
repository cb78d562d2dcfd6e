#pragma once

// The description of a garment: an object in the recipe of a person, written by people.
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

#include "shared/core/json_fwd.h"

namespace lararium::import {

enum class GarmentKind : uint8_t { kTunic, kStola, kApron, kToga, kPalla, kSandals };

enum class Sleeve : uint8_t { kNone, kShort, kElbow };
enum class Stripes : uint8_t { kNone, kNarrow, kBroad };
enum class Belt : uint8_t { kNone, kCord, kLeather };

struct GarmentPattern {
  GarmentKind kind = GarmentKind::kTunic;
  // Height of the hem as a share of the leg: 0 at the hip joint, 1 at the knee, 2 at the sole.
  float hem = 1.05f;
  Sleeve sleeve = Sleeve::kShort;
  bool one_shoulder = false;  // An exomis: the right shoulder is bare.
  float ease = 1.55f;         // Width of the cloth relative to the largest girth of the body.
  Belt belt = Belt::kLeather;
  float blouse = 0.06f;                       // Metres of cloth pulled up over the belt.
  glm::vec3 colour = glm::vec3(0.6f);         // linear RGB
  glm::vec3 belt_colour = glm::vec3(0.1f);    // Linear RGB.
  glm::vec3 stripe_colour = glm::vec3(0.1f);  // Colour of stripes and borders.
  Stripes stripes = Stripes::kNone;
  bool border = false;  // A woven band along the hem.
  float wear = 0.3f;    // 0: new; 1: faded, and dirty at the hem.
  uint64_t seed = 1;
};

// The garment names that a recipe may use: "tunic", ...
std::vector<std::string> GarmentNames();
std::string NameOf(GarmentKind kind);

// The words that a field accepts: length, sleeve, belt or stripes; dye names for any other
// field.
std::vector<std::string> GarmentWords(std::string_view field);

// Describes a garment, for reading. Errors name the field and the accepted values.
void DescribeFields(Fields& fields, GarmentPattern& pattern);

}  // namespace lararium::import
