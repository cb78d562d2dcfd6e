#include "shared/bundle/member_name.h"

#include <gtest/gtest.h>

#include <string>

namespace lararium::bundle {
namespace {

TEST(MemberName, TakesRelativePaths) {
  for (const char* name : {"manifest.json", "a", "cast/keeper.larhuman", "A-1/b_2/c.d.e", "_x"}) {
    EXPECT_TRUE(IsMemberName(name)) << name;
  }
}

TEST(MemberName, RefusesWhatLeadsElsewhere) {
  for (const char* name : {"", "/", "/a", "a/", "a//b", "..", "../x", "a/../b", "a/..", ".", "./a",
                           "a/.b", ".hidden", "a\\b", "C:a", "a b", "a\nb", "-a", "caf\xc3\xa9"}) {
    EXPECT_FALSE(IsMemberName(name)) << name;
  }
  EXPECT_FALSE(IsMemberName(std::string("a\0b", 3)));
  EXPECT_TRUE(IsMemberName(std::string(kMaxMemberName, 'a')));
  EXPECT_FALSE(IsMemberName(std::string(kMaxMemberName + 1, 'a')));
}

}  // namespace
}  // namespace lararium::bundle
