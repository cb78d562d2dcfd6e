#pragma once

// A search without a prior as messages between two workers of a page: numbers, which both write and
// read in one order. The pixels are posted beside the question.

#include <cstdint>
#include <span>
#include <vector>

#include "shared/core/status.h"
#include "shared/vision/localizer.h"
#include "shared/vision/map_locator.h"

namespace lararium::web {

struct SearchQuestion {
  uint32_t number = 0;  // The answer carries it, too.
  vision::CameraGuess guess;
};

struct SearchAnswer {
  uint32_t number = 0;
  vision::Located located;
  std::vector<vision::LocatedPoint> points;  // See Localizer::points().
};

std::vector<double> Numbers(const SearchQuestion& question);
std::vector<double> Numbers(const SearchAnswer& answer);

// Every number is checked for its type; indices of points and maps are not checked.
Result<SearchQuestion> ParseQuestion(std::span<const double> numbers);
Result<SearchAnswer> ParseAnswer(std::span<const double> numbers);

}  // namespace lararium::web
