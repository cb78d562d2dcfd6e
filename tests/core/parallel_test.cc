#include "shared/core/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <vector>

namespace lararium {
namespace {

TEST(ParallelFor, VisitsEachIndexOnce) {
  std::vector<std::atomic<int>> visits(1000);
  ParallelFor(visits.size(), [&](size_t i) { ++visits[i]; });
  for (const std::atomic<int>& count : visits) {
    EXPECT_EQ(count, 1);
  }
  ParallelFor(0, [](size_t) { FAIL(); });
}

TEST(ParallelFor, WorksWithOneThreadToo) {
  const ThreadLimit limit(1);
  std::atomic<int> sum = 0;
  ParallelFor(10, [&](size_t i) { sum += static_cast<int>(i); });
  EXPECT_EQ(sum, 45);
}

}  // namespace
}  // namespace lararium
