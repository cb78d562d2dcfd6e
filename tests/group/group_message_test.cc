#include "shared/group/group_message.h"

#include <gmock/gmock.h>

#include "shared/core/random.h"
#include "shared/group/group_relay.h"

namespace lararium::group {
namespace {

using ::testing::HasSubstr;

GroupBeat LeadersBeat() {
  GroupBeat beat;
  beat.boot = 7;
  beat.sent = 1'000'000;
  beat.leads = beat.ready = true;
  beat.leader = "tablet-01";
  beat.show = "show";
  beat.epoch = 3;
  beat.run = 5;
  beat.log = {12, 34};
  beat.time = 2'000'000;
  beat.pieces = {{1'000'000, 240, false}, {3'000'000, 480, true}};
  beat.echoes = {{"tablet-02", 900'000, 1'900'000}};
  return beat;
}

std::vector<GroupMessage> AllMessages() {
  GroupOwn own;
  own.show = "show";
  own.keys = {"space", "/door,1"};
  own.minute = 900;
  own.places = {{1, 2}};
  own.markers = {{"noon", 2400}};
  return {
      LeadersBeat(),
      GroupLogPart{1, 2, {3, 4}, {{{.tick = 5, .kind = GroupEntry::Kind::kJoin}}, {"tablet-01"}}},
      GroupEvents{1, {{{.serial = 1, .kind = GroupEntry::Kind::kKey}}, {"space"}}},
      GroupAsk{{{1, 2}, {0, 1}}},
      GroupWish{1, 2, GroupWish::What::kGoTo, "noon"},
      own,
      GroupClockNews{1, {{1.0, 2.0, 1.0}}}};
}

TEST(GroupMessage, IsReadAsItWasWritten) {
  for (const GroupMessage& message : AllMessages()) {
    const std::string bytes = FormatGroupMessage(message);
    const auto read = ParseGroupMessage(bytes);
    ASSERT_TRUE(read.ok()) << read.message();
    EXPECT_EQ(read->index(), message.index());
    EXPECT_EQ(FormatGroupMessage(*read), bytes);
  }
  const auto beat = ParseGroupMessage(FormatGroupMessage(LeadersBeat()));
  EXPECT_EQ(std::get<GroupBeat>(*beat).pieces, LeadersBeat().pieces);
  EXPECT_EQ(std::get<GroupBeat>(*beat).echoes[0].name, "tablet-02");
}

TEST(GroupMessage, WithImpossibleValuesIsRefused) {
  const auto refused = [](const GroupMessage& message) {
    EXPECT_THAT(ParseGroupMessage(FormatGroupMessage(message)).message(),
                HasSubstr("not possible"));
  };
  GroupBeat beat = LeadersBeat();
  beat.pieces.clear();
  refused(beat);
  beat = LeadersBeat();
  beat.pieces[1].tick = -1;
  refused(beat);
  beat = LeadersBeat();
  beat.sent = INT64_MAX;
  refused(beat);
  beat = LeadersBeat();
  beat.leader = "a\nb";
  refused(beat);
  beat = LeadersBeat();
  beat.echoes.resize(kMostGroupMembers + kMostGroupPages + 1);
  refused(beat);
  refused(GroupLogPart{1, 2, {}, {{{.kind = GroupEntry::Kind::kKey}}, {}}});
  refused(GroupLogPart{1, 2, {}, {{}, {"text"}}});
  refused(GroupLogPart{1, 2, {}, {{{.tick = -1}}, {}}});
  refused(GroupLogPart{1, 2, {}, {{{.kind = static_cast<GroupEntry::Kind>(6)}}, {}}});
  refused(GroupEvents{1, {{{.kind = GroupEntry::Kind::kKey}}, {"two words"}}});
  refused(GroupEvents{1, {{{.kind = GroupEntry::Kind::kJoin}}, {"tablet-09"}}});
  refused(GroupWish{1, 2, static_cast<GroupWish::What>(5), ""});
}

TEST(GroupMessage, ThatIsDamagedOrTooLongIsRefused) {
  EXPECT_FALSE(ParseGroupMessage("").ok());
  EXPECT_FALSE(ParseGroupMessage("{\"do\": \"restart\"}").ok());
  EXPECT_THAT(ParseGroupMessage(std::string(kMostGroupBytes + 1, 'x')).message(),
              HasSubstr("longer"));
  Random random(11);
  GroupRelay relay({.name = "tablet-02", .boot = 5, .wall = [] { return int64_t{1}; }});
  for (const GroupMessage& message : AllMessages()) {
    const std::string bytes = FormatGroupMessage(message);
    for (size_t cut = 0; cut < bytes.size(); ++cut) {
      (void)relay.TakeMessage("tablet-01", bytes.substr(0, cut), 1).ok();
    }
    for (int i = 0; i < 3000; ++i) {
      std::string damaged = bytes;
      damaged[random.Below(static_cast<uint32_t>(bytes.size()))] =
          static_cast<char>(random.Below(256));
      (void)relay.TakeMessage("tablet-01", damaged, i).ok();
      relay.TakeOwn(damaged, i);
      relay.Step(i);
    }
  }
}

TEST(GroupRelay, RefusesMessagesThatOnlyPlayersSend) {
  GroupRelay relay({.name = "tablet-02", .boot = 5, .wall = [] { return int64_t{1}; }});
  EXPECT_THAT(relay.TakeMessage("tablet-01", FormatGroupMessage(GroupOwn()), 1).message(),
              HasSubstr("between a player and its link"));
}

}  // namespace
}  // namespace lararium::group
