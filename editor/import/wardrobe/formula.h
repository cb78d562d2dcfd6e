#pragma once

// A number of a garment's file that depends on the body, such as "0.62 * upper_arm" or
// "if(belt > 0, blouse, 0)". docs/how-to-make-a-garment.md describes the language.

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "shared/core/status.h"

namespace lararium::import {

class Formula {
 public:
  using Scope = std::function<float(std::string_view name)>;

  Formula() = default;
  explicit Formula(float value) : number_(value) {}

  // Errors begin with `where` and quote the place in the text.
  static Result<Formula> Parse(std::string_view text, const std::string& where);

  // The names that it uses, each once.
  const std::vector<std::string>& names() const { return names_; }
  bool empty() const { return !number_ && text_.empty(); }
  // May be infinite or not a number. Requires that it is not empty. Threads may share a formula.
  float Value(const Scope& scope) const;

 private:
  std::optional<float> number_;
  std::string text_;
  std::vector<std::string> names_;
};

}  // namespace lararium::import
