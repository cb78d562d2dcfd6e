#pragma once

// A garment of a person: an object in the recipe, written by people.
//
//   { "name": "tunic", "length": "knee", "sleeve": "short", "ease": 1.3, "belt": "leather",
//     "colour": "ochre", "stripes": "narrow", "stripe_colour": "purple", "seed": 3 }
//
// The garment's file (garment_design.h) says which fields there are.
// docs/how-to-dress-the-cast.md describes those of the garments that come with the editor.

#include <cstdint>
#include <glm/vec3.hpp>
#include <map>
#include <memory>
#include <string>

#include "editor/import/wardrobe/garment_design.h"
#include "shared/core/json_fields.h"

namespace lararium::import {

struct GarmentPattern {
  std::shared_ptr<const GarmentDesign> design;
  // The values of all parameters of the design, by name.
  std::map<std::string, float, std::less<>> numbers;      // A flag is 0 or 1.
  std::map<std::string, glm::vec3, std::less<>> colours;  // Linear RGB.
  uint64_t seed = 1;

  const glm::vec3& Colour(const std::string& parameter) const {
    return colours.find(parameter)->second;
  }
};

// Describes a garment, for reading. Errors name the field and the accepted values.
void DescribeFields(Fields& fields, GarmentPattern& pattern);
// Describes a garment of a design that has been read.
void DescribeFields(Fields& fields,
                    std::shared_ptr<const GarmentDesign> design,
                    GarmentPattern& pattern);

// A garment of which a recipe sets nothing.
GarmentPattern UsualPattern(std::shared_ptr<const GarmentDesign> design);

// Describes one of the words of a parameter or a number in its range, for reading.
void DescribeWordOrNumber(Fields& fields,
                          const FieldKey& key,
                          const GarmentParameter& parameter,
                          float& value);

}  // namespace lararium::import
