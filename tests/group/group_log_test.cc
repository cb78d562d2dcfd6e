#include "shared/group/group_log.h"

#include <gmock/gmock.h>

#include <glm/geometric.hpp>

#include "shared/group/own_events.h"
#include "tests/group/group_player.h"

namespace lararium::group {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;
using Kind = GroupEntry::Kind;

constexpr uint64_t kBoot = 0x1234'5678'9abcu;

GroupEntry Pose(int32_t tick, uint16_t serial, int16_t x) {
  return {.tick = tick, .x = x, .serial = serial, .kind = Kind::kPose};
}

// A log of one device with some poses.
GroupLog SmallLog(int poses) {
  GroupLog log;
  EXPECT_TRUE(log.Join(1, "tablet-01", kBoot));
  for (int i = 0; i < poses; ++i) {
    EXPECT_TRUE(log.Append(
        Pose(10 * (i + 1), static_cast<uint16_t>(i + 1), static_cast<int16_t>(50 * i)), ""));
  }
  return log;
}

TEST(GroupLog, TakesOnlyWhatCanFollow) {
  GroupLog log = SmallLog(3);
  EXPECT_FALSE(log.Append(Pose(29, 9, 0), "")) << "an earlier tick";
  GroupEntry unknown = Pose(40, 9, 0);
  unknown.who = 1;
  EXPECT_FALSE(log.Append(unknown, "")) << "a device that has not joined";
  EXPECT_FALSE(log.Append({.tick = 40, .who = 0, .kind = Kind::kJoin}, "tablet-02"))
      << "the number of another device";
  ASSERT_TRUE(log.Join(40, "tablet-01", kBoot + 1)) << "after a restart";
  EXPECT_THAT(log.devices(), SizeIs(1));
  EXPECT_FALSE(log.devices()[0].serial);
}

TEST(GroupLog, IsTheSameIfItsPlaceIs) {
  const GroupLog one = SmallLog(5);
  GroupLog two = SmallLog(5);
  EXPECT_EQ(one.place(), two.place());
  two.Truncate(5);
  EXPECT_TRUE(one.Has(two.place()));
  ASSERT_TRUE(two.Append(Pose(50, 5, 7), ""));
  EXPECT_EQ(one.size(), two.size());
  EXPECT_FALSE(one.Has(two.place()));
}

TEST(GroupLog, FindsWhereTwoLogsParted) {
  const GroupLog leader = SmallLog(1000);
  for (const size_t kept : {0u, 1u, 500u, 990u, 999u, 1001u}) {
    GroupLog own = SmallLog(1000);
    own.Truncate(kept);
    for (int i = 0; i < 10; ++i) {
      own.Append({.tick = 20'000, .x = 7, .kind = Kind::kHour}, "");
    }
    const size_t common = leader.CommonWith(own.Places());
    EXPECT_LE(common, kept);
    EXPECT_GE(common + 40, kept) << "most of what is there is not sent again";
    const auto change = own.Take(common, leader.Part(common));
    // The own entries were later than what takes their place, or there were none.
    EXPECT_EQ(change, kept == 1001
                          ? std::nullopt
                          : std::optional(GroupLog::Change{kept, leader.item(kept).entry.tick}));
  }
}

TEST(GroupLog, ChangesFromTheTickOnOfWhatWasThereBefore) {
  const GroupLog leader = SmallLog(20);
  GroupLog own = SmallLog(10);
  for (int i = 0; i < 5; ++i) {  // Entries of a split, earlier than those that replace them.
    ASSERT_TRUE(own.Append(Pose(101 + i, 50, 7), ""));
  }
  EXPECT_EQ(own.Take(11, leader.Part(11), true), (GroupLog::Change{11, 101}));
  EXPECT_EQ(own.place(), leader.place());
  EXPECT_EQ(own.Take(11, leader.Part(11), true), std::nullopt);
  const GroupLog shorter = SmallLog(15);
  EXPECT_EQ(own.Take(11, shorter.Part(11), false), std::nullopt);
  EXPECT_EQ(own.Take(11, shorter.Part(11), true), (GroupLog::Change{16, 160}));
}

TEST(GroupLog, IsSentInPartsThatMeetAgain) {
  GroupLog log = SmallLog(3000);
  for (int i = 0; i < 300; ++i) {
    ASSERT_TRUE(log.Append({.tick = 40'000, .serial = static_cast<uint16_t>(i), .kind = Kind::kKey},
                           "/" + std::string(400, 'k')));
  }
  GroupLog copy;
  int parts = 0;
  while (copy.size() < log.size()) {
    const std::string bytes =
        FormatGroupMessage(GroupLogPart{1, 2, copy.place(), log.Part(copy.size())});
    ASSERT_LE(bytes.size(), kMostGroupBytes);
    const auto message = ParseGroupMessage(bytes);
    ASSERT_TRUE(message.ok()) << message.message();
    copy.Take(copy.size(), std::get<GroupLogPart>(*message).part);
    ++parts;
  }
  EXPECT_EQ(copy.place(), log.place());
  EXPECT_GT(parts, 2);
}

TEST(GroupLog, OfAnHourIsFull) {
  GroupLog log;
  ASSERT_TRUE(log.Join(1, "tablet-01", kBoot));
  while (log.Append(Pose(1, 1, 0), "")) {
  }
  EXPECT_EQ(log.size(), GroupLog::kMostEntries);
}

TEST(GroupLogReader, GivesTheSameVisitorsAtOnceAndStepByStep) {
  GroupLog log;
  GroupLogReader steps;
  std::vector<drama::VisitorLog::Entry> by_steps;
  drama::VisitorLog joined;
  const auto read = [&] {
    by_steps.clear();
    steps.Read(log, by_steps);
    for (const auto& entry : by_steps) {
      joined.Set(entry.tick, entry.visitor);
    }
  };
  ASSERT_TRUE(log.Join(5, "b", kBoot));
  read();
  ASSERT_TRUE(log.Append(Pose(5, 1, 100), ""));
  ASSERT_TRUE(log.Append({.tick = 5, .serial = 2, .kind = Kind::kKey}, "space"));
  read();
  ASSERT_TRUE(log.Append({.tick = 5, .serial = 3, .kind = Kind::kKey}, "/door,1"));
  read();
  ASSERT_TRUE(log.Join(9, "a", kBoot));
  ASSERT_TRUE(log.Append({.tick = 9, .x = 15 * 60, .kind = Kind::kHour}, ""));
  read();
  ASSERT_TRUE(log.Append({.tick = 20, .who = 0, .kind = Kind::kLeave}, ""));
  read();
  EXPECT_EQ(joined.At(5).keys, "space /door,1");
  EXPECT_EQ(joined.At(6).keys, "");
  ASSERT_THAT(*joined.At(9).group, SizeIs(2));
  EXPECT_TRUE((*joined.At(9).group)[0].tracked);
  EXPECT_FLOAT_EQ((*joined.At(9).group)[0].position.x, 2.0f);
  EXPECT_FLOAT_EQ(joined.At(9).hour, 15.0f);
  ASSERT_THAT(*joined.At(20).group, SizeIs(1));
  EXPECT_EQ((*joined.At(20).group)[0].number, 1);
  std::vector<drama::VisitorLog::Entry> at_once;
  GroupLogReader().Read(log, at_once);
  for (const auto& entry : at_once) {
    const drama::Visitor other = joined.At(entry.tick);
    EXPECT_EQ(*entry.visitor.group, *other.group);
    EXPECT_EQ(entry.visitor.keys, other.keys);
  }
}

TEST(GroupEntries, HoldAVisitorToACentimetreAndADegree) {
  for (int i = 0; i < 500; ++i) {
    drama::Visitor visitor = test::WanderingVisitor(3, 0.37 * i);
    visitor.tracked = true;
    GroupLog log = SmallLog(0);
    GroupEntry entry = EntryOf(visitor);
    entry.tick = 2;
    ASSERT_TRUE(log.Append(entry, ""));
    std::vector<drama::VisitorLog::Entry> entries;
    GroupLogReader().Read(log, entries);
    const drama::GroupVisitor& read = entries.back().visitor.group->front();
    EXPECT_LT(glm::distance(read.position, visitor.position), 0.018f);
    EXPECT_GT(glm::dot(read.direction, visitor.direction), 0.9998f);
  }
}

TEST(GroupEntries, OfImpossiblePosesAreLost) {
  drama::Visitor visitor = {.tracked = true, .position = {1e6f, 0.0f, 0.0f}};
  EXPECT_EQ(EntryOf(visitor).kind, Kind::kLost);
  visitor.position.x = NAN;
  EXPECT_EQ(EntryOf(visitor).kind, Kind::kLost);
  visitor = {.tracked = true, .direction = glm::vec3(0.0f)};
  EXPECT_EQ(EntryOf(visitor).kind, Kind::kLost);
}

TEST(OwnEvents, AreRepeatedUntilTheLogHasThem) {
  OwnEvents events(kBoot);
  GroupLog log;
  GroupEntry pose = {.x = 100, .kind = Kind::kPose};
  events.SetPose(pose, 2, 0);
  events.AddKey("space", 10);
  const auto first = events.Take(log, "tablet-01", 10);
  ASSERT_THAT(first.events.entries, SizeIs(2));
  EXPECT_THAT(events.Take(log, "tablet-01", 100'000).events.entries, IsEmpty());
  EXPECT_THAT(events.Take(log, "tablet-01", 700'000).events.entries, SizeIs(2));
  ASSERT_TRUE(log.Join(1, "tablet-01", kBoot));
  ASSERT_TRUE(log.Append(first.events.entries[0], "") || true);
  GroupEntry key = first.events.entries[1];
  key.tick = 1;
  ASSERT_TRUE(log.Append(key, "space"));
  EXPECT_THAT(events.Take(log, "tablet-01", 1'500'000).events.entries, IsEmpty());
  log.Truncate(1);  // The drama went back to before them. The pose counts, the key does not.
  const auto again = events.Take(log, "tablet-01", 2'500'000);
  ASSERT_THAT(again.events.entries, SizeIs(1));
  EXPECT_EQ(again.events.entries[0].kind, Kind::kPose);
}

TEST(OwnEvents, OfAVisitorWhoHardlyMovesAreNone) {
  OwnEvents events(kBoot);
  const GroupLog log;
  GroupEntry pose = {.kind = Kind::kPose};
  events.SetPose(pose, 1, 0);
  EXPECT_THAT(events.Take(log, "a", 0).events.entries, SizeIs(1));
  pose.x = 4;  // 8 cm
  pose.heading = 3;
  events.SetPose(pose, 1, 5'000'000);
  EXPECT_EQ(events.Take(log, "a", 5'000'000).events.entries[0].x, 0);
  pose.x = 5;
  events.SetPose(pose, 1, 10'000'000);
  EXPECT_EQ(events.Take(log, "a", 10'000'000).events.entries[0].x, 5);
}

}  // namespace
}  // namespace lararium::group
