#pragma once

// The measures of a body, as a tailor takes them, and the values of formulas on that body.

#include <map>
#include <span>
#include <string>
#include <string_view>

#include "editor/import/wardrobe/formula.h"
#include "editor/import/wardrobe/garment_pattern.h"
#include "editor/import/wardrobe/posed_body.h"

namespace lararium::import {

// The names that formulas may use: "shoulder", "hip", ...
std::span<const std::string_view> MeasureNames();

// Computes the formulas of one garment for one body. Borrows the pattern.
class Measures {
 public:
  // `laid` is the pose in which the pieces are laid on the body, and `above` the height of the
  // shoulder line above the skin, metres.
  Measures(const GarmentPattern& pattern,
           const FittedBody& body,
           const PosedBody& laid,
           float above);

  // Value of a formula; `otherwise` if the file has none. A value outside of the range or not
  // finite is moved into it, and error() says so.
  float Value(const Formula& formula,
              std::string_view what,
              float least,
              float most,
              float otherwise = 0.0f) const;
  bool IsTrue(const Formula& formula, bool otherwise) const;
  float Of(std::string_view measure) const { return values_.find(measure)->second; }

  // The first value out of range, which names the file and `what`.
  const Status& error() const { return error_; }

 private:
  float ValueOf(std::string_view name) const;

  const GarmentPattern& pattern_;
  mutable std::map<std::string, float, std::less<>> values_;  // Measures, and sizes once used.
  mutable Status error_;
};

// The colours of a garment's threads.
class Dyer {
 public:
  Dyer(const GarmentPattern& pattern, const Measures& measures);

  // Linear RGB at a distance from the hem in metres; cloth is soiled near it.
  glm::vec3 At(bool band, float from_hem) const;

 private:
  glm::vec3 colour_;
  glm::vec3 band_colour_;
  float soil_;
  float soil_height_;
};

}  // namespace lararium::import
