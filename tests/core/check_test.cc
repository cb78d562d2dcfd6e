#include "shared/core/check.h"

#include <gtest/gtest.h>

#ifdef __has_feature
#define CLANG_HAS(feature) __has_feature(feature)
#else
#define CLANG_HAS(feature) 0
#endif

namespace lararium {
namespace {

#if !defined(__OPTIMIZE__) || defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || \
    CLANG_HAS(address_sanitizer) || CLANG_HAS(thread_sanitizer)
TEST(Check, InnerLoopsAreCheckedInDebugAndSanitizerBuilds) {
  EXPECT_DEATH(DCHECK(1 + 1 == 3), "1 \\+ 1 == 3");
}
#else
TEST(Check, InnerLoopsPayNothingForChecks) {
  [[maybe_unused]] int evaluated = 0;
  DCHECK(++evaluated > 1);
  EXPECT_EQ(evaluated, 0);
}
#endif

TEST(Check, AbortsInEveryBuild) { EXPECT_DEATH(CHECK(1 + 1 == 3), "1 \\+ 1 == 3"); }

}  // namespace
}  // namespace lararium
