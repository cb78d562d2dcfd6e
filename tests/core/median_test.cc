#include "shared/core/median.h"

#include <gtest/gtest.h>

namespace lararium {
namespace {

TEST(Median, IsTheMiddleOfAnOddNumber) { EXPECT_EQ(Median<double>({5.0, -1.0, 2.0}), 2.0); }

TEST(Median, LiesBetweenTheTwoMiddlesOfAnEvenNumber) {
  EXPECT_EQ(Median<double>({9.0, 1.0, 2.0, 4.0}), 3.0);
}

TEST(Median, OfNothingIsZero) { EXPECT_EQ(Median<double>({}), 0.0); }

}  // namespace
}  // namespace lararium
