#pragma once

// Robust estimation in constant time: Nister, "Preemptive RANSAC for live
// structure and motion estimation", ICCV 2003.

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "shared/core/check.h"
#include "shared/core/random.h"

namespace lararium::geometry {

struct PreemptiveRansacOptions {
  int hypotheses = 512;  // M, generated up front
  int block_size = 64;   // B, observations scored between two halvings
  uint64_t seed = 1;
};

// Scores all hypotheses breadth-first, block after block of the observations in random order, and
// keeps the best f(i) = floor(M 2^-floor(i / B)) of them before observation i. Reuses its memory
// between calls.
template <typename Hypothesis>
class PreemptiveRansac {
 public:
  // generate(random, hypotheses) appends the hypotheses of one random minimal sample, perhaps none.
  // It is called at most options.hypotheses times.
  //
  // cost(hypothesis, observation) returns the truncated cost of one observation; lower is better.
  //
  // Returns the best hypothesis, or nullopt if no sample gave one. The options bound the run time
  // for all inputs. Equal input gives equal results.
  template <typename Generate, typename Cost>
  std::optional<Hypothesis> Run(size_t observation_count,
                                const PreemptiveRansacOptions& options,
                                Generate&& generate,
                                Cost&& cost) {
    CHECK(options.hypotheses > 0 && options.block_size > 0);
    Random random(options.seed);
    const auto most = static_cast<size_t>(options.hypotheses);
    hypotheses_.clear();
    for (size_t sample = 0; sample < most && hypotheses_.size() < most; ++sample) {
      generate(random, hypotheses_);
    }
    if (hypotheses_.empty() || observation_count == 0) {
      return std::nullopt;
    }
    Shuffle(observation_count, random);
    ranking_.clear();
    for (size_t h = 0; h < hypotheses_.size(); ++h) {
      ranking_.push_back({0.0, static_cast<uint32_t>(h)});
    }
    ScoreBlocks(options, cost);
    return hypotheses_[std::min_element(ranking_.begin(), ranking_.end())->second];
  }

 private:
  using Ranked = std::pair<double, uint32_t>;  // cost so far, hypothesis

  void Shuffle(size_t count, Random& random) {
    order_.resize(count);
    std::iota(order_.begin(), order_.end(), 0u);
    for (size_t i = count; i > 1; --i) {
      std::swap(order_[i - 1], order_[random.Below(static_cast<uint32_t>(i))]);
    }
  }

  template <typename Cost>
  void ScoreBlocks(const PreemptiveRansacOptions& options, Cost& cost) {
    const auto block_size = static_cast<size_t>(options.block_size);
    size_t begin = 0;
    while (begin < order_.size()) {
      const size_t end = std::min(begin + block_size, order_.size());
      for (Ranked& ranked : ranking_) {
        for (size_t i = begin; i < end; ++i) {
          ranked.first += cost(hypotheses_[ranked.second], order_[i]);
        }
      }
      begin = end;
      const size_t halvings = begin / block_size;
      const size_t kept = halvings < 32 ? static_cast<size_t>(options.hypotheses) >> halvings : 0;
      if (kept < ranking_.size()) {
        const auto last = ranking_.begin() + static_cast<std::ptrdiff_t>(std::max<size_t>(kept, 1));
        std::nth_element(ranking_.begin(), last - 1, ranking_.end());
        ranking_.erase(last, ranking_.end());
      }
      if (ranking_.size() == 1) {
        break;
      }
    }
  }

  std::vector<Hypothesis> hypotheses_;
  std::vector<uint32_t> order_;
  std::vector<Ranked> ranking_;
};

}  // namespace lararium::geometry
