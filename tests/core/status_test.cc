#include "shared/core/status.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>

namespace lararium {
namespace {

TEST(Status, DefaultIsSuccess) {
  EXPECT_TRUE(Status().ok());
  EXPECT_TRUE(Status().At("file").ok());
}

TEST(Status, ErrorNamesPlaceProblemAndRemedy) {
  EXPECT_EQ(Status::Error("a.json", "not a number", "give one").message(),
            "a.json: not a number; give one");
  EXPECT_EQ(Status::Error("", "broken").message(), "broken");
  EXPECT_EQ(Status::Error("b", "broken").At("a").message(), "a: b: broken");
}

TEST(Status, AnErrorWithoutWordsIsStillAnError) { EXPECT_FALSE(Status::Error("", "").ok()); }

Result<int> Half(int value) {
  if (value % 2 != 0) {
    return Status::Error("half", "odd");
  }
  return value / 2;
}

Status Quarter(int value, int* quarter) {
  LARARIUM_ASSIGN_OR_RETURN(const int half, Half(value));
  LARARIUM_ASSIGN_OR_RETURN(*quarter, Half(half));
  return Status();
}

TEST(Result, MacrosPassValuesAndFailures) {
  int quarter = 0;
  EXPECT_TRUE(Quarter(12, &quarter).ok());
  EXPECT_EQ(quarter, 3);
  EXPECT_EQ(Quarter(6, &quarter).message(), "half: odd");
}

TEST(Result, CarriesMoveOnlyValues) {
  Result<std::unique_ptr<int>> result(std::make_unique<int>(7));
  const std::unique_ptr<int> value = *std::move(result);
  EXPECT_EQ(*value, 7);
}

TEST(ResultDeathTest, TakingTheValueOfAFailureAborts) {
  EXPECT_DEATH((void)Half(1).value(), "CHECK failed");
}

}  // namespace
}  // namespace lararium
