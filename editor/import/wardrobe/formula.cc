#include "editor/import/wardrobe/formula.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <glm/common.hpp>
#include <span>

namespace lararium::import {
namespace {

constexpr size_t kLongest = 400;  // Bytes of a formula.
constexpr int kMostNested = 24;   // Nested parentheses and functions.

using Apply = float (*)(std::span<const float> arguments);
using Arguments = std::span<const float>;

float Truth(bool value) { return value ? 1.0f : 0.0f; }

struct Operation {
  std::string_view text;
  int precedence = 0;  // Zero: a function, which is written with parentheses.
  size_t arguments = 2;
  Apply apply = nullptr;
};

// The first two put a value on the stack.
constexpr uint8_t kNumber = 0;
constexpr uint8_t kName = 1;
constexpr uint8_t kNegate = 2;
constexpr uint8_t kNot = 3;
// A longer operator is before those that it begins with.
constexpr Operation kOperations[] = {
    {"number", 0, 0, nullptr},
    {"name", 0, 0, nullptr},
    {"negative", 0, 1, [](Arguments a) { return -a[0]; }},
    {"not", 0, 1, [](Arguments a) { return Truth(a[0] == 0.0f); }},
    {"or", 1, 2, [](Arguments a) { return Truth(a[0] != 0.0f || a[1] != 0.0f); }},
    {"and", 2, 2, [](Arguments a) { return Truth(a[0] != 0.0f && a[1] != 0.0f); }},
    {"<=", 3, 2, [](Arguments a) { return Truth(a[0] <= a[1]); }},
    {">=", 3, 2, [](Arguments a) { return Truth(a[0] >= a[1]); }},
    {"<", 3, 2, [](Arguments a) { return Truth(a[0] < a[1]); }},
    {">", 3, 2, [](Arguments a) { return Truth(a[0] > a[1]); }},
    {"+", 4, 2, [](Arguments a) { return a[0] + a[1]; }},
    {"-", 4, 2, [](Arguments a) { return a[0] - a[1]; }},
    {"*", 5, 2, [](Arguments a) { return a[0] * a[1]; }},
    {"/", 5, 2, [](Arguments a) { return a[0] / a[1]; }},
    {"min", 0, 2, [](Arguments a) { return std::min(a[0], a[1]); }},
    {"max", 0, 2, [](Arguments a) { return std::max(a[0], a[1]); }},
    {"if", 0, 3, [](Arguments a) { return a[0] != 0.0f ? a[1] : a[2]; }},
    {"mix", 0, 3, [](Arguments a) { return glm::mix(a[0], a[1], a[2]); }},
    {"clamp", 0, 3, [](Arguments a) { return glm::clamp(a[0], a[1], a[2]); }},
    {"smooth", 0, 3, [](Arguments a) { return glm::smoothstep(a[0], a[1], a[2]); }},
    {"abs", 0, 1, [](Arguments a) { return std::abs(a[0]); }},
    {"sqrt", 0, 1, [](Arguments a) { return std::sqrt(a[0]); }},
    {"pow", 0, 2, [](Arguments a) { return std::pow(a[0], a[1]); }},
    {"sin", 0, 1, [](Arguments a) { return std::sin(a[0]); }},
    {"cos", 0, 1, [](Arguments a) { return std::cos(a[0]); }},
};

bool IsLetter(char c) { return (c >= 'a' && c <= 'z') || c == '_'; }
bool IsDigit(char c) { return c >= '0' && c <= '9'; }

}  // namespace

// Reads by precedence climbing.
class FormulaParser {
 public:
  FormulaParser(std::string_view text, const std::string& where) : text_(text), where_(where) {}

  Result<Formula> Parse() {
    if (text_.size() > kLongest) {
      return Status::Error(where_, "the formula is longer than 400 characters",
                           "name parts of it in \"sizes\"");
    }
    Expression(1, 0);
    if (error_.ok() && at_ < text_.size()) {
      Fail("nothing more is expected");
    }
    LARARIUM_RETURN_IF_ERROR(error_);
    return std::move(formula_);
  }

 private:
  void Fail(std::string_view problem) {
    if (error_.ok()) {
      error_ = Status::Error(where_,
                             "\"" + std::string(text_) + "\": " + std::string(problem) +
                                 " at character " + std::to_string(at_ + 1),
                             "write a number or a formula such as \"0.62 * upper_arm\"");
    }
  }

  void SkipSpace() {
    while (at_ < text_.size() && text_[at_] == ' ') {
      ++at_;
    }
  }
  bool Take(std::string_view token) {
    if (!text_.substr(at_).starts_with(token)) {
      return false;
    }
    // A word ends where its letters do.
    const size_t end = at_ + token.size();
    if (IsLetter(token[0]) && end < text_.size() && (IsLetter(text_[end]) || IsDigit(text_[end]))) {
      return false;
    }
    at_ = end;
    SkipSpace();
    return true;
  }
  void Expect(std::string_view token) {
    if (error_.ok() && !Take(token)) {
      Fail("\"" + std::string(token) + "\" is expected");
    }
  }

  void Expression(int precedence, int depth) {
    Operand(depth);
    while (error_.ok()) {
      const size_t before = at_;
      const auto* found =
          std::find_if(std::begin(kOperations), std::end(kOperations),
                       [&](const Operation& o) { return o.precedence > 0 && Take(o.text); });
      if (found == std::end(kOperations)) {
        return;
      }
      if (found->precedence < precedence) {
        at_ = before;
        return;
      }
      Expression(found->precedence + 1, depth);
      Add(static_cast<uint8_t>(found - std::begin(kOperations)));
    }
  }

  void Operand(int depth) {
    SkipSpace();
    if (depth > kMostNested) {
      Fail("too many parentheses are open");
    } else if (Take("(")) {
      Expression(1, depth + 1);
      Expect(")");
    } else if (Take("-")) {
      Operand(depth + 1);
      Add(kNegate);
    } else if (Take("not")) {
      Operand(depth + 1);
      Add(kNot);
    } else if (at_ < text_.size() && IsDigit(text_[at_])) {
      Number();
    } else if (at_ < text_.size() && IsLetter(text_[at_])) {
      Word(depth);
    } else {
      Fail("a number or a name is expected");
    }
  }

  void Number() {
    float value = 0.0f;
    const char* first = text_.data() + at_;
    const auto [end, error] =
        std::from_chars(first, text_.data() + text_.size(), value, std::chars_format::fixed);
    if (error != std::errc() || !std::isfinite(value)) {
      Fail("the number is out of range");
      return;
    }
    at_ += static_cast<size_t>(end - first);
    SkipSpace();
    formula_.steps_.push_back({kNumber, value, 0});
  }

  void Word(int depth) {
    const size_t first = at_;
    while (at_ < text_.size() && (IsLetter(text_[at_]) || IsDigit(text_[at_]))) {
      ++at_;
    }
    const std::string_view word = text_.substr(first, at_ - first);
    SkipSpace();
    if (!Take("(")) {
      formula_.steps_.push_back({kName, 0.0f, Name(word)});
      return;
    }
    const auto* found =
        std::find_if(std::begin(kOperations) + kNot, std::end(kOperations),
                     [&](const Operation& o) { return o.precedence == 0 && o.text == word; });
    if (found == std::end(kOperations)) {
      at_ = first;
      Fail("there is no function of this name");
      return;
    }
    for (size_t i = 0; i < found->arguments && error_.ok(); ++i) {
      if (i > 0) {
        Expect(",");
      }
      Expression(1, depth + 1);
    }
    Expect(")");
    Add(static_cast<uint8_t>(found - std::begin(kOperations)));
  }

  void Add(uint8_t operation) { formula_.steps_.push_back({operation, 0.0f, 0}); }

  uint32_t Name(std::string_view word) {
    std::vector<std::string>& names = formula_.names_;
    const auto found = std::find(names.begin(), names.end(), word);
    if (found == names.end()) {
      names.emplace_back(word);
      return static_cast<uint32_t>(names.size() - 1);
    }
    return static_cast<uint32_t>(found - names.begin());
  }

  std::string_view text_;
  const std::string& where_;
  size_t at_ = 0;
  Formula formula_;
  Status error_;
};

Formula::Formula(float value) : steps_{{kNumber, value, 0}} {}

Result<Formula> Formula::Parse(std::string_view text, const std::string& where) {
  return FormulaParser(text, where).Parse();
}

float Formula::Value(const Scope& scope) const {
  // A formula of at most 400 characters has no more values than this at once.
  std::array<float, kLongest> stack = {};
  size_t size = 0;
  for (const Step& step : steps_) {
    const Operation& operation = kOperations[step.operation];
    size -= operation.arguments;
    stack[size] = step.operation == kNumber ? step.number
                  : step.operation == kName ? scope(names_[step.name])
                                            : operation.apply({&stack[size], operation.arguments});
    ++size;
  }
  return stack[0];
}

}  // namespace lararium::import
