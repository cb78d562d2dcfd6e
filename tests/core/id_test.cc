#include "shared/core/id.h"

#include <gtest/gtest.h>

#include <string>

namespace lararium {
namespace {

TEST(SlotMap, TheZeroIdNamesNothing) {
  SlotMap<std::string> map;
  map.Add("a");
  EXPECT_EQ(map.Find({}), nullptr);
  EXPECT_FALSE(Id<std::string>());
}

TEST(SlotMap, AStaleIdDoesNotReachTheNextTenant) {
  SlotMap<std::string> map;
  const Id<std::string> first = map.Add("first");
  EXPECT_TRUE(map.Remove(first));
  EXPECT_FALSE(map.Remove(first));
  const Id<std::string> second = map.Add("second");
  EXPECT_EQ(second.index, first.index);
  EXPECT_EQ(map.Find(first), nullptr);
  ASSERT_NE(map.Find(second), nullptr);
  EXPECT_EQ(*map.Find(second), "second");
  EXPECT_EQ(map.size(), 1u);
}

TEST(SlotMap, IdsComeInOrderOfTheirSlots) {
  SlotMap<int> map;
  map.Add(1);
  const Id<int> second = map.Add(2);
  map.Add(3);
  map.Remove(second);
  ASSERT_EQ(map.ids().size(), 2u);
  EXPECT_EQ(*map.Find(map.ids()[1]), 3);
}

}  // namespace
}  // namespace lararium
