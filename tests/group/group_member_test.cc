// Groups of simulated devices.

#include "shared/group/group_member.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cstdio>

#include "tests/group/simulated_group.h"
#include "tests/support/thorough.h"

namespace lararium::group {
namespace {

using test::SimulatedGroup;
using ::testing::HasSubstr;

// 2 to 80 ms, with jitter and 2 % loss.
const SimulatedGroup::Network kBad = {
    .delays = {2'000, 10'000, 20'000, 30'000, 40'000, 50'000, 65'000, 80'000},
    .jitter = 8'000,
    .loss = 0.02};
// How long the longest test plays.
const int kSeconds = test::IsThorough() ? 600 : 12;
// How long a broker is away; a split lasts twice as long.
const double kAway = test::IsThorough() ? 30.0 : 4.0;
const SimulatedGroup::Network kGood = {.delays = {2'000}, .jitter = 1'000, .loss = 0.0};

double Percentile95(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values.empty() ? 1e9 : values[values.size() * 95 / 100];
}

// Whether all follow one leader, have the same log but for what is under way, and are within 20 ms.
bool IsInStep(SimulatedGroup& group) {
  const GroupLog& first = group.device(0).member().log();
  for (size_t i = 0; i < group.size(); ++i) {
    const GroupMember& member = group.device(i).member();
    const size_t both = std::min(first.size(), member.log().size());
    if (!member.ready() || member.leader() != group.device(0).member().leader() ||
        !first.Has(member.log().PlaceAt(both)) || first.size() > both + 50 ||
        member.schedule().run != group.device(0).member().schedule().run) {
      return false;
    }
  }
  return group.Spread() <= 0.02;
}

// Plays until all are in step for half a second. Returns how long that took; -1: too long.
double SecondsUntilInStep(SimulatedGroup& group, double most) {
  const double begin = group.now();
  double since = begin;
  while (group.now() - begin < most) {
    group.Play(1.0 / 60.0);
    since = IsInStep(group) ? since : group.now();
    if (group.now() - since > 0.5) {
      return since - begin;
    }
  }
  return -1.0;
}

int64_t Leaders(SimulatedGroup& group) {
  int64_t leaders = 0;
  for (size_t i = 0; i < group.size(); ++i) {
    leaders += group.device(i).runs && group.device(i).member().leads() ? 1 : 0;
  }
  return leaders;
}

TEST(Group, OfEightInABadNetworkPlaysOneDrama) {
  SimulatedGroup group(kBad, 1);
  for (int i = 0; i < 8; ++i) {
    group.Add();
    group.Play(0.2);
  }
  group.Play(4.0);
  std::vector<double> spreads;
  int events = 0;
  for (int second = 0; second < kSeconds; ++second) {
    if (second % 3 == 0) {
      group.device(static_cast<size_t>(events) % 8).keys = events % 2 == 0 ? "a" : "/door,1";
      ++events;
    }
    group.Play(1.0, [&] { spreads.push_back(group.Spread()); });
  }
  group.Play(3.0);
  int64_t backwards = 0;
  int64_t jumps = 0;
  for (size_t i = 0; i < group.size(); ++i) {
    backwards += group.device(i).player->backwards();
    jumps += group.device(i).player->jumps();
  }
  std::printf(
      "%d s, %d keys: p95 of the largest difference %.1f ms, worst %.1f ms; %zu states "
      "compared, %zu differ; log %zu entries; %.1f kB/s\n",
      kSeconds, events, 1e3 * Percentile95(spreads),
      1e3 * *std::max_element(spreads.begin(), spreads.end()), group.Compare().compared,
      group.Compare().different, group.device(0).member().log().size(),
      1e-3 * static_cast<double>(group.bytes_sent()) / group.now());
  EXPECT_LE(Percentile95(spreads), 0.02);
  EXPECT_GE(group.Compare().compared + 10, static_cast<size_t>(kSeconds));
  EXPECT_EQ(group.Compare().different, 0u);
  EXPECT_EQ(Leaders(group), 1);
  EXPECT_EQ(backwards, 0);
  EXPECT_EQ(jumps, 0);
  // The drama would have been another one without the visitors.
  EXPECT_GT(group.device(0).player->drama().cues().size(), 4u);
}

TEST(Group, TakesLateDevicesInWithinASecondOfHearingThem) {
  SimulatedGroup group(kBad, 2);
  for (int i = 0; i < 4; ++i) {
    group.Add();
  }
  group.Play(kSeconds * 0.7);
  group.Add();
  const double took = SecondsUntilInStep(group, 10.0);
  std::printf("in step after %.2f s\n", took);
  EXPECT_GE(took, 0.0);
  EXPECT_LE(took, 1.0);
  group.Play(10.0);
  EXPECT_EQ(group.Compare().different, 0u);
  EXPECT_FALSE(group.device(4).player->marks().empty());
}

TEST(Group, GoesOnWhenItsLeaderIsKilled) {
  for (const bool told : {true, false}) {
    SimulatedGroup group(kBad, 3);
    for (int i = 0; i < 4; ++i) {
      group.Add();
      group.Play(1.0);
    }
    group.Play(10.0);
    ASSERT_TRUE(group.device(0).member().leads()) << "the one that has been there longest";
    group.Kill(0, told);
    const double before = group.device(1).seconds();
    const double begin = group.now();
    while (Leaders(group) == 0 && group.now() < begin + 5.0) {
      group.Play(1.0 / 60.0);
    }
    std::printf("another leader after %.2f s\n", group.now() - begin);
    EXPECT_LE(group.now() - begin, told ? 0.5 : 2.5);
    EXPECT_TRUE(group.device(1).member().leads()) << "the next one";
    EXPECT_LE(group.Spread(), 0.02) << "nothing is seen of it";
    group.device(2).keys = "a";
    group.Play(10.0);
    EXPECT_NEAR(group.device(1).seconds() - before, group.now() - begin, 0.05);
    EXPECT_EQ(group.Compare().different, 0u);
    EXPECT_EQ(Leaders(group), 1);
  }
}

TEST(Group, GoesOnWithoutItsBrokerAndIsInStepAgain) {
  SimulatedGroup group(kBad, 4);
  for (int i = 0; i < 4; ++i) {
    group.Add();
  }
  group.Play(8.0);
  const double before = group.device(3).seconds();
  group.SetBroker(false);
  group.Play(kAway);
  for (size_t i = 0; i < group.size(); ++i) {
    EXPECT_NEAR(group.device(i).seconds() - before, kAway, 0.1) << "the show went on";
    EXPECT_TRUE(group.device(i).member().leads()) << "each for itself";
  }
  group.SetBroker(true);
  const double took = SecondsUntilInStep(group, 10.0);
  const double back = group.device(0).seconds();
  group.Play(8.0);
  std::printf("in step after %.2f s\n", took);
  EXPECT_GE(took, 0.0);
  EXPECT_LE(took, 2.0);
  EXPECT_EQ(Leaders(group), 1);
  EXPECT_EQ(group.Compare(back + 1.0).different, 0u);
}

TEST(Group, ThatWasSplitBecomesOneWithTheLargerSide) {
  SimulatedGroup group(kBad, 5);
  const size_t kDevices = test::IsThorough() ? 8 : 5;
  const size_t kCut = kDevices * 3 / 8;  // The leader is one of these.
  for (size_t i = 0; i < kDevices; ++i) {
    group.Add();
    group.Play(0.5);
  }
  group.Play(6.0);
  ASSERT_TRUE(group.device(0).member().leads());
  for (size_t i = 0; i < kCut; ++i) {
    group.device(i).side = 1;
  }
  group.Play(2.0 * kAway);
  EXPECT_EQ(Leaders(group), 2);
  EXPECT_GT(group.Compare().different, 0u) << "each side has its own drama meanwhile";
  for (size_t i = 0; i < kCut; ++i) {
    group.device(i).side = 0;
  }
  // States that were noted until now belong to two dramas.
  const double back = group.device(kCut).seconds() + 4.0;
  const double took = SecondsUntilInStep(group, 10.0);
  group.Play(10.0);
  std::printf("in step after %.2f s\n", took);
  EXPECT_GE(took, 0.0);
  EXPECT_LE(took, 2.0);
  EXPECT_EQ(Leaders(group), 1);
  for (size_t i = 0; i < kCut; ++i) {
    EXPECT_FALSE(group.device(i).member().leads());
  }
  EXPECT_EQ(group.Compare(back).different, 0u);
}

TEST(Group, IsLedByItsGuideWhoComesLast) {
  SimulatedGroup group(kGood, 6);
  group.Add();
  group.Add();
  group.Play(10.0);
  group.Add(true);
  group.Play(5.0);
  EXPECT_TRUE(group.device(2).member().leads());
  EXPECT_EQ(Leaders(group), 1);
  EXPECT_GT(group.device(2).seconds(), 12.0) << "with the drama of the group";
  EXPECT_EQ(group.Compare().different, 0u);
}

TEST(Group, IsHeldAndGoesOnAndToAMarkerWhereTheGuideWants) {
  SimulatedGroup group(kBad, 7);
  for (int i = 0; i < 3; ++i) {
    group.Add();
  }
  group.Play(10.0);
  using What = GroupWish::What;
  const auto want = [&](What what, const char* marker = "") {
    // The clock of a device is passed by its next frame; any time of before will do.
    group.device(2).relay->member().Want(
        what, marker, false,
        group.device(2).clock_offset + static_cast<int64_t>(1e6 * group.now()));
  };
  want(What::kHold);
  group.Play(2.0);
  const double held = group.device(0).seconds();
  group.Play(3.0);
  EXPECT_DOUBLE_EQ(group.device(0).seconds(), held);
  EXPECT_LE(group.Spread(), 0.02);
  want(What::kResume);
  group.Play(3.0);
  EXPECT_NEAR(group.device(0).seconds(), held + 2.4, 0.4);
  want(What::kGoTo, "noon");
  group.Play(3.0);
  EXPECT_NEAR(group.device(1).seconds(), 22.6, 0.4);
  EXPECT_LE(group.Spread(), 0.02);
  want(What::kRestart);
  group.Play(3.0);
  EXPECT_NEAR(group.device(1).seconds(), 2.6, 0.4);
  group.Play(10.0);
  EXPECT_LE(group.Spread(), 0.02);
  EXPECT_EQ(group.Compare().different, 0u);
  EXPECT_GT(group.Compare().compared, 20u);
}

TEST(Group, IgnoresWhatWasSentBefore) {
  SimulatedGroup group(kGood, 8);
  group.Add();
  group.Add();
  group.Play(5.0);
  // A wish of a device and its repetition.
  GroupMember& leader = group.device(0).relay->member();
  const GroupWish wish = {0, 5, GroupWish::What::kRestart, ""};
  const uint64_t run = leader.schedule().run;
  leader.Receive("tablet-1", wish, group.device(0).clock_offset + 5'000'000);
  EXPECT_EQ(leader.schedule().run, run) << "of another start of that device";
  leader.Receive("nobody", wish, group.device(0).clock_offset + 5'000'000);
  EXPECT_EQ(leader.schedule().run, run) << "of a device that is not there";
}

TEST(Group, OfOtherShowsAreApart) {
  SimulatedGroup group(kGood, 9);
  group.Add();
  group.Add().player->feed().SetShow("another", {});
  group.Play(5.0);
  EXPECT_EQ(Leaders(group), 2);
  const auto notes = group.device(0).relay->member().TakeNotes();
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_THAT(notes[0], HasSubstr("\"tablet-1\" plays another show"));
}

TEST(Group, APageLeadsOnlyWhereNoDeviceIs) {
  SimulatedGroup group(kGood, 11);
  group.AddPage();
  group.AddPage();
  group.Play(8.0);
  EXPECT_EQ(Leaders(group), 1);
  EXPECT_LE(group.Spread(), 0.02) << "pages among themselves";
  // A device begins the drama, although pages have played it for longer.
  group.Add();
  group.Play(6.0);
  EXPECT_TRUE(group.device(2).member().leads());
  EXPECT_EQ(Leaders(group), 1);
  EXPECT_LE(group.Spread(), 0.02);
  EXPECT_LT(group.device(0).seconds(), 7.0);
  group.device(0).keys = "a";
  group.Play(4.0);
  EXPECT_EQ(group.Compare().different, 0u) << "what a page's visitor does counts everywhere";
  EXPECT_EQ(group.device(2).member().log().devices().size(), 3u);
  group.Kill(2, true);
  group.Play(4.0);
  EXPECT_EQ(Leaders(group), 1) << "a page takes over";
  EXPECT_GT(group.device(0).seconds(), 10.0);
}

TEST(Group, APageMovesTheDramaOfNoDevice) {
  SimulatedGroup group(kGood, 12);
  group.Add();
  group.AddPage();
  group.Play(6.0);
  ASSERT_TRUE(group.device(1).member().ready());
  for (const GroupWish::What what :
       {GroupWish::What::kHold, GroupWish::What::kGoTo, GroupWish::What::kRestart}) {
    group.device(1).relay->member().Want(
        what, "noon", false,
        group.device(1).clock_offset + static_cast<int64_t>(1e6 * group.now()));
    group.Play(2.0);
  }
  EXPECT_NEAR(group.device(0).seconds(), 10.4, 0.3);
  EXPECT_FALSE(group.device(0).member().schedule().held());
}

TEST(Group, AFloodOfPagesLeavesRoomForDevices) {
  SimulatedGroup group(kGood, 13);
  for (size_t i = 0; i < 20; ++i) {
    group.AddPage();
  }
  group.Play(4.0);
  group.Add();
  group.Add();
  group.Play(8.0);
  EXPECT_LE(group.device(20).member().members(), 2 + kMostGroupPages);
  EXPECT_TRUE(group.device(21).member().ready());
  EXPECT_NE(group.device(20).member().leads(), group.device(21).member().leads());
}

TEST(Group, EventsOfAPageAreLimited) {
  SimulatedGroup group(kGood, 14);
  group.Add();
  group.AddPage();
  group.Play(6.0);
  const size_t before = group.device(0).log_size();
  GroupEvents events;
  for (uint16_t serial = 1000; serial < 1009; ++serial) {
    events.events.entries.push_back({.serial = serial, .kind = GroupEntry::Kind::kKey});
    events.events.texts.emplace_back("a");
  }
  GroupMember& leader = group.device(0).relay->member();
  ASSERT_TRUE(leader.leads());
  events.boot = group.device(1).boot;
  const int64_t now = group.device(0).clock_offset + static_cast<int64_t>(1e6 * group.now());
  for (int i = 0; i < 5; ++i) {
    for (GroupEntry& entry : events.events.entries) {
      entry.serial = static_cast<uint16_t>(entry.serial + 20);
    }
    leader.Receive(group.device(1).name, events, now);
  }
  EXPECT_EQ(leader.log().size(), before + 9) << "the first of five messages";
}

}  // namespace
}  // namespace lararium::group
