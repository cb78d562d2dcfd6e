#pragma once

// A number of a garment's file that depends on the body, such as "0.62 * upper_arm" or
// "if(belt > 0, blouse, 0)". docs/how-to-make-a-garment.md describes the language.

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "shared/core/status.h"

namespace lararium::import {

class Formula {
 public:
  using Scope = std::function<float(std::string_view name)>;

  Formula() = default;
  explicit Formula(float value);

  // Errors begin with `where` and quote the place in the text.
  static Result<Formula> Parse(std::string_view text, const std::string& where);

  // The names that it uses, each once.
  const std::vector<std::string>& names() const { return names_; }
  bool empty() const { return steps_.empty(); }
  // Computes in the order in which the text is written; may be infinite or not a number. Requires
  // that it is not empty.
  float Value(const Scope& scope) const;

 private:
  friend class FormulaParser;

  struct Step {
    uint8_t operation = 0;  // Index into the table of operations; see formula.cc.
    float number = 0.0f;
    uint32_t name = 0;  // Index into names_.
  };

  std::vector<Step> steps_;  // Postfix order.
  std::vector<std::string> names_;
};

}  // namespace lararium::import
