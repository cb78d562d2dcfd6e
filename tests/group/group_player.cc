#include "tests/group/group_player.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <set>

#include "shared/core/check.h"
#include "shared/stage/state_hash.h"
#include "tests/stage/test_human.h"

namespace lararium::test {
namespace {

// Each action of a visitor leads to another course of the drama.
constexpr char kScript[] = R"(
  local keeper, guest = actor("keeper"), actor("guest")
  track{ markers = {{at = 20, name = "noon"}} }
  local function react(who)
    return function()
      attempt(function() who:walk_to{ x = math.random(-3, 3), z = math.random(-3, 3) } end)
    end
  end
  on(visitor:near("keeper", 1.5), react(guest))
  on(visitor:looks_at("guest"), react(keeper))
  on(visitor:stays(2), function() guest:look_at("visitor") wait(1) guest:look_at() end)
  on(key("a"), react(keeper))
  on(osc("/door"), react(guest))
  function main()
    keeper:place{ x = -1, z = -1, heading = 180 }
    guest:place{ x = 1, z = -2, heading = 90 }
    while true do
      wait(3 + math.random())
      attempt(function() keeper:face("visitor") end)
      keeper:look_at("visitor")
    end
  end
)";

}  // namespace

drama::Visitor WanderingVisitor(uint64_t seed, double seconds) {
  const double phase = 1.7 * static_cast<double>(seed);
  const double pace = 0.31 + 0.01 * static_cast<double>(seed % 7);
  const auto x = static_cast<float>(2.5 * std::cos(phase + pace * seconds));
  const auto z = static_cast<float>(2.5 * std::sin(phase * 1.3 + 0.7 * pace * seconds));
  drama::Visitor visitor;
  visitor.tracked = std::fmod(seconds + phase, 40.0) > 3.0;  // Tracking is lost now and then.
  visitor.position = {x, 1.6f, z};
  visitor.direction = glm::normalize(
      glm::vec3(-x + std::sin(static_cast<float>(seconds + phase)), -0.3f, -z - 1.0f));
  visitor.hour = 14.99f + static_cast<float>(seconds / 3600.0);
  return visitor;
}

GroupPlayer::GroupPlayer(std::function<double()> steady)
    : steady_(std::move(steady)), feed_(steady_) {
  for (const char* name : {"keeper", "guest"}) {
    CHECK(stage_.Add(name, MakeTestHuman()).ok());
  }
  auto drama = drama::Drama::Create(kScript, "drama.lua", stage_, {}, *log_);
  CHECK(drama.ok());
  drama_ = *std::move(drama);
  feed_.SetShow("show", group::MarkersOf(kScript));
  seat_ = std::make_unique<show::GroupSeat>(feed_.group(), *drama_);
}

void GroupPlayer::Frame(const drama::Visitor& visitor) {
  const double before = seconds_;
  seconds_ = seat_->Next(visitor, false, steady_());
  constexpr double kTick = 1.0 / drama::Drama::kTicksPerSecond;
  while (drama_->time() + 1e-9 < seconds_) {
    drama_->Tick();
    const int64_t tick = std::llround(drama_->time() / kTick);
    if (tick % show::GroupSeat::kMarkTicks == 0) {
      stage::StageSnapshot snapshot;
      stage_.Capture(snapshot);
      seat_->NoteMark(tick, stage::HashState(snapshot));
    }
  }
  if (run_ == seat_->run() && !seat_->catching_up()) {
    backwards_ += seconds_ < before - 1e-9 ? 1 : 0;
    jumps_ += seconds_ > before + 0.25 ? 1 : 0;
  }
  run_ = seat_->run();
}

std::string GroupPlayer::TakeOwn() {
  std::string own = feed_.TakeOwn();
  const auto message = group::ParseGroupMessage(own);
  if (const auto* told = message.ok() ? std::get_if<group::GroupOwn>(&*message) : nullptr;
      told != nullptr && told->mark.tick > 0) {
    marks_[{told->mark_run, told->mark.tick}] = told->mark.hash;
  }
  return own;
}

ComparedStates Compare(const std::vector<const GroupPlayer*>& players, double from) {
  std::map<std::pair<uint64_t, int64_t>, std::pair<int, std::set<uint64_t>>> hashes;
  for (const GroupPlayer* player : players) {
    for (const auto& [at, hash] : player->marks()) {
      if (static_cast<double>(at.second) >= from * drama::Drama::kTicksPerSecond) {
        ++hashes[at].first;
        hashes[at].second.insert(hash);
      }
    }
  }
  ComparedStates states;
  for (const auto& [at, known] : hashes) {
    states.compared += known.first > 1 ? 1 : 0;
    states.different += known.second.size() > 1 ? 1 : 0;
  }
  return states;
}

}  // namespace lararium::test
