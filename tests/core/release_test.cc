#include "shared/core/release.h"

#include <gtest/gtest.h>

namespace lararium {
namespace {

TEST(Release, GivesTheMemoryOfAVectorBack) {
  std::vector<int> items(1000, 7);
  Release(items);
  EXPECT_TRUE(items.empty());
  EXPECT_EQ(items.capacity(), 0u);
}

}  // namespace
}  // namespace lararium
