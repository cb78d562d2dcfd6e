#include "editor/import/wardrobe/formula.h"

#include <muParser.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>

namespace lararium::import {
namespace {

constexpr size_t kLongest = 400;  // Bytes of a formula.
constexpr int kMostNested = 24;   // Nested parentheses.
constexpr const char* kLetters = "abcdefghijklmnopqrstuvwxyz";
constexpr const char* kWord = "abcdefghijklmnopqrstuvwxyz_0123456789";
constexpr std::string_view kSymbols = " .,()+-*/<>=";
constexpr std::string_view kOperators[] = {"and", "or", "not"};

double Truth(bool value) { return value ? 1.0 : 0.0; }

// Every use has its own parser, because computing changes the parser's state. Throws
// mu::ParserError.
double Compute(const std::string& text,
               const std::vector<std::string>& names,
               std::vector<double> values) {
  mu::Parser parser;
  parser.ClearFun();
  parser.ClearConst();
  parser.ClearInfixOprt();
  parser.DefineNameChars(kWord);
  parser.DefineInfixOprtChars((std::string("-") + kLetters).c_str());
  parser.DefineInfixOprt("-", [](double a) { return -a; });
  parser.DefineInfixOprt("not", [](double a) { return Truth(a == 0.0); });
  parser.DefineOprt(
      "or", [](double a, double b) { return Truth(a != 0.0 || b != 0.0); }, 1);
  parser.DefineOprt(
      "and", [](double a, double b) { return Truth(a != 0.0 && b != 0.0); }, 2);
  const auto define = [&parser](const char* name, auto apply) { parser.DefineFun(name, +apply); };
  define("abs", [](double a) { return std::abs(a); });
  define("sqrt", [](double a) { return std::sqrt(a); });
  define("sin", [](double a) { return std::sin(a); });
  define("cos", [](double a) { return std::cos(a); });
  define("min", [](double a, double b) { return std::min(a, b); });
  define("max", [](double a, double b) { return std::max(a, b); });
  define("pow", [](double a, double b) { return std::pow(a, b); });
  define("if", [](double c, double a, double b) { return c != 0.0 ? a : b; });
  define("mix", [](double a, double b, double t) { return glm::mix(a, b, t); });
  define("clamp", [](double x, double a, double b) { return glm::clamp(x, a, b); });
  define("smooth", [](double a, double b, double x) { return glm::smoothstep(a, b, x); });
  for (size_t i = 0; i < names.size(); ++i) {
    parser.DefineVar(names[i], &values[i]);
  }
  parser.SetExpr(text);
  const double value = parser.Eval();
  if (parser.GetNumResults() != 1) {
    throw mu::ParserError(mu::ecUNEXPECTED_ARG_SEP, ",", text, static_cast<int>(text.find(',')));
  }
  return value;
}

std::string FaultOf(const mu::ParserError& error) {
  const std::string token = error.GetToken().substr(0, 40);
  switch (error.GetCode()) {
    case mu::ecTOO_FEW_PARAMS:
      return "\"" + token + "\" wants more values";
    case mu::ecTOO_MANY_PARAMS:
      return "\"" + token + "\" wants fewer values";
    case mu::ecMISSING_PARENS:
      return "a \")\" is missing";
    default:
      return token.empty() ? "a number or a name is expected" : "\"" + token + "\" is not expected";
  }
}

}  // namespace

// The library has an assignment, strings, several results and "a ? b : c" too. Formulas have none
// of them, so their characters are refused here.
Result<Formula> Formula::Parse(std::string_view text, const std::string& where) {
  const auto error = [&](const std::string& problem, size_t at) {
    return Status::Error(where,
                         "\"" + std::string(text) + "\": " + problem + " at character " +
                             std::to_string(std::min(at, text.size()) + 1),
                         "write a number or a formula such as \"0.62 * upper_arm\"");
  };
  if (text.size() > kLongest) {
    return Status::Error(where, "the formula is longer than 400 characters",
                         "name parts of it in \"sizes\"");
  }
  Formula formula;
  formula.text_ = text;
  int nested = 0;
  for (size_t at = 0; at < text.size();) {
    const size_t end = std::min(text.find_first_not_of(kWord, at), text.size());
    if (end == at) {
      const char symbol = text[at];
      const bool compares = at > 0 && (text[at - 1] == '<' || text[at - 1] == '>');
      if (kSymbols.find(symbol) == std::string_view::npos || (symbol == '=' && !compares)) {
        return error("nothing like this is expected", at);
      }
      nested += symbol == '(' ? 1 : symbol == ')' ? -1 : 0;
      if (nested > kMostNested) {
        return error("too many parentheses are open", at);
      }
      ++at;
      continue;
    }
    const std::string_view word = text.substr(at, end - at);
    at = end;
    const bool calls = end < text.size() && text[end] == '(';
    const bool named =
        std::string_view(kLetters).find(word[0]) != std::string_view::npos || word[0] == '_';
    if (named && !calls && std::count(std::begin(kOperators), std::end(kOperators), word) == 0 &&
        std::count(formula.names_.begin(), formula.names_.end(), word) == 0) {
      formula.names_.emplace_back(word);
    }
  }
  try {
    Compute(formula.text_, formula.names_, std::vector<double>(formula.names_.size(), 1.0));
  } catch (const mu::ParserError& fault) {
    // The library counts from 0; a negative place stands for the end.
    return error(FaultOf(fault), static_cast<size_t>(fault.GetPos()));
  }
  return formula;
}

float Formula::Value(const Scope& scope) const {
  if (number_) {
    return *number_;
  }
  std::vector<double> values;
  for (const std::string& name : names_) {
    // A recipe's 0.62 equals that of a formula without the digits that a float does not have.
    values.push_back(std::round(1e6 * static_cast<double>(scope(name))) / 1e6);
  }
  try {
    return static_cast<float>(Compute(text_, names_, std::move(values)));
  } catch (const mu::ParserError&) {
    return std::numeric_limits<float>::quiet_NaN();
  }
}

}  // namespace lararium::import
