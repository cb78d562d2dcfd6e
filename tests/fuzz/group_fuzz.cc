// libFuzzer harness: any bytes as a message of another device of a group, of the player to its
// link, and of the link to its player; repeated.

#include <string>
#include <string_view>

#include "shared/core/check.h"
#include "shared/group/group_feed.h"
#include "shared/group/group_relay.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace lararium::group;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  if (const auto message = ParseGroupMessage(bytes); message.ok()) {
    const auto again = ParseGroupMessage(FormatGroupMessage(*message));
    CHECK(again.ok() && again->index() == message->index());
  }
  GroupRelay relay({.name = "tablet-02", .boot = 5, .wall = [] { return int64_t{1}; }});
  GroupFeed feed([] { return 1.0; });
  GroupOwn player;
  player.show = "show";
  const std::string own = FormatGroupMessage(player);
  for (int64_t now = 1; now < 8'000'000; now += 500'000) {
    relay.TakeOwn(now < 4'000'000 ? std::string_view(own) : bytes, now);
    const bool is_message = relay.TakeMessage("tablet-01", bytes, now).ok();
    CHECK(!is_message || ParseGroupMessage(bytes).ok());
    relay.Step(now);
    for (const std::string& news : relay.TakeForPlayer(now)) {
      feed.Take(news);
    }
    feed.Take(bytes);
  }
  CHECK(relay.member().TakeNotes().size() < 20);
  return 0;
}
