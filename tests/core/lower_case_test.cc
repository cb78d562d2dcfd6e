#include "shared/core/lower_case.h"

#include <gtest/gtest.h>

namespace lararium {
namespace {

TEST(LowerCase, MakesLettersSmallAndLeavesAllElse) {
  EXPECT_EQ(LowerCase(""), "");
  EXPECT_EQ(LowerCase("AZaz @[`{ 09.JPEG"), "azaz @[`{ 09.jpeg");
}

TEST(LowerCase, LeavesLettersOfSeveralBytes) {
  EXPECT_EQ(LowerCase("\xc3\x89tienne \xce\xa3"), "\xc3\x89tienne \xce\xa3");
}

}  // namespace
}  // namespace lararium
