#include "shared/group/group_log.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <memory>
#include <numbers>

namespace lararium::group {
namespace {

constexpr float kPerMetre = 50.0f;
constexpr float kStepsOfTurn = 256.0f;  // Steps of a whole turn.
constexpr float kFullTurn = 2.0f * std::numbers::pi_v<float>;
constexpr size_t kMostPartBytes = kMostGroupBytes - 4096;

uint64_t Mix(uint64_t hash, uint64_t word) {
  hash = (hash ^ word) * 0x9e3779b97f4a7c15u;
  return hash ^ (hash >> 29);
}

uint64_t HashOf(uint64_t before, const GroupEntry& entry, const std::string& text) {
  std::array<uint64_t, 2> words = {};
  static_assert(sizeof(words) == sizeof(entry));
  std::memcpy(words.data(), &entry, sizeof(entry));
  uint64_t hash = Mix(Mix(before, words[0]), words[1]);
  for (const char c : text) {
    hash = Mix(hash, static_cast<unsigned char>(c));
  }
  return hash;
}

glm::vec3 PositionOf(const GroupEntry& entry) {
  return glm::vec3(entry.x, entry.y, entry.z) / kPerMetre;
}

glm::vec3 DirectionOf(const GroupEntry& entry) {
  const float heading = static_cast<float>(entry.heading) * kFullTurn / kStepsOfTurn;
  const float pitch = static_cast<float>(entry.pitch) * kFullTurn / kStepsOfTurn;
  return {-std::sin(heading) * std::cos(pitch), std::sin(pitch),
          -std::cos(heading) * std::cos(pitch)};
}

// The part of a device's boot that the log keeps.
uint64_t ShortBoot(uint64_t boot) { return boot & 0xffffffffffffu; }

// The numbers of a boot as a join entry has them.
void SetBoot(uint64_t boot, GroupEntry& entry) {
  entry.x = static_cast<int16_t>(boot & 0xffff);
  entry.y = static_cast<int16_t>(boot >> 16 & 0xffff);
  entry.z = static_cast<int16_t>(boot >> 32 & 0xffff);
}
uint64_t BootOf(const GroupEntry& entry) {
  return static_cast<uint64_t>(static_cast<uint16_t>(entry.x)) |
         static_cast<uint64_t>(static_cast<uint16_t>(entry.y)) << 16 |
         static_cast<uint64_t>(static_cast<uint16_t>(entry.z)) << 32;
}

}  // namespace

const GroupLog::Device* GroupLog::Find(const std::string& name) const {
  const auto found = std::find_if(devices_.begin(), devices_.end(),
                                  [&](const Device& device) { return device.name == name; });
  return found == devices_.end() ? nullptr : &*found;
}

const GroupLog::Device* GroupLog::FindPresent(const std::string& name, uint64_t boot) const {
  const Device* device = Find(name);
  const bool found = device != nullptr && device->present && device->boot == ShortBoot(boot);
  return found ? device : nullptr;
}

bool GroupLog::Append(const GroupEntry& entry, const std::string& text) {
  using Kind = GroupEntry::Kind;
  const bool is_new = entry.kind == Kind::kJoin && entry.who == devices_.size();
  const bool is_known = entry.who < devices_.size() || entry.kind == Kind::kHour;
  const bool has_name =
      entry.kind != Kind::kJoin || is_new || (is_known && devices_[entry.who].name == text);
  if (entry.tick < std::max(last_tick(), 1) || !(is_new || is_known) || !has_name ||
      devices_.size() > kMostDevices || items_.size() >= kMostEntries) {
    return false;
  }
  items_.push_back({entry, text, HashOf(place().hash, entry, text)});
  Apply(items_.back());
  return true;
}

void GroupLog::Apply(const Item& item) {
  const GroupEntry& entry = item.entry;
  switch (entry.kind) {
    case GroupEntry::Kind::kHour:
      return;
    case GroupEntry::Kind::kJoin:
      devices_.resize(std::max<size_t>(devices_.size(), size_t{entry.who} + 1));
      devices_[entry.who] = {item.text, BootOf(entry), true, std::nullopt};
      return;
    case GroupEntry::Kind::kLeave:
      devices_[entry.who].present = false;
      return;
    default:
      devices_[entry.who].serial = entry.serial;
  }
}

bool GroupLog::Join(int32_t tick, const std::string& name, uint64_t boot) {
  const Device* known = Find(name);
  GroupEntry entry = {
      .tick = tick,
      .who = static_cast<uint8_t>(known == nullptr ? devices_.size() : known - devices_.data()),
      .kind = GroupEntry::Kind::kJoin};
  SetBoot(boot, entry);
  return (known != nullptr || devices_.size() < kMostDevices) && Append(entry, name);
}

void GroupLog::Truncate(size_t count) {
  if (count >= items_.size()) {
    return;
  }
  items_.resize(count);
  devices_.clear();
  for (const Item& item : items_) {
    Apply(item);
  }
}

void GroupLog::TruncateAfter(int32_t tick) {
  const auto end =
      std::upper_bound(items_.begin(), items_.end(), tick,
                       [](int32_t t, const Item& item) { return t < item.entry.tick; });
  Truncate(static_cast<size_t>(end - items_.begin()));
}

GroupPlace GroupLog::PlaceAt(size_t count) const {
  return {count, count == 0 ? 1 : items_[count - 1].hash};
}

std::vector<GroupPlace> GroupLog::Places() const {
  std::vector<GroupPlace> places;
  for (size_t back = 0; back < size(); back = 2 * back + 1) {
    places.push_back(PlaceAt(size() - back));
  }
  return places;
}

size_t GroupLog::CommonWith(std::span<const GroupPlace> places) const {
  size_t common = 0;
  for (const GroupPlace& place : places) {
    if (Has(place)) {
      common = std::max<size_t>(common, place.count);
    }
  }
  return common;
}

GroupEntries GroupLog::Part(size_t from, size_t most) const {
  GroupEntries part;
  size_t bytes = 0;
  for (size_t i = from; i < size() && part.entries.size() < most; ++i) {
    const Item& item = items_[i];
    bytes += sizeof(GroupEntry) + (item.entry.has_text() ? item.text.size() + 12 : 0);
    if (bytes > kMostPartBytes) {
      break;
    }
    part.entries.push_back(item.entry);
    if (item.entry.has_text()) {
      part.texts.push_back(item.text);
    }
  }
  return part;
}

std::optional<GroupLog::Change> GroupLog::Take(size_t from, const GroupEntries& part, bool last) {
  std::optional<Change> changed;
  const auto drop_from = [&](size_t at) {
    if (at < size()) {
      changed = changed.value_or(Change{at, items_[at].entry.tick});
      Truncate(at);
    }
  };
  size_t text = 0;
  const std::string none;
  for (size_t i = 0; i < part.entries.size(); ++i) {
    const GroupEntry& entry = part.entries[i];
    const std::string& words = entry.has_text() ? part.texts[text++] : none;
    const size_t at = from + i;
    if (at < size() && items_[at].entry == entry && items_[at].text == words) {
      continue;
    }
    drop_from(at);
    if (at != size() || !Append(entry, words)) {
      return changed;
    }
    changed = changed.value_or(Change{at, entry.tick});
    changed->tick = std::min(changed->tick, entry.tick);
  }
  if (last) {
    drop_from(from + part.entries.size());
  }
  return changed;
}

GroupEntry EntryOf(const drama::Visitor& visitor) {
  GroupEntry entry;
  const glm::vec3 steps = visitor.position * kPerMetre;
  const glm::vec3& ahead = visitor.direction;
  const auto fits = [](float value) { return std::abs(value) < 32'000.0f; };
  if (!fits(steps.x) || !fits(steps.y) || !fits(steps.z) || !(glm::length(ahead) > 0.5f)) {
    entry.kind = GroupEntry::Kind::kLost;
    return entry;
  }
  entry.kind = visitor.tracked ? GroupEntry::Kind::kPose : GroupEntry::Kind::kLost;
  entry.x = static_cast<int16_t>(std::lround(steps.x));
  entry.y = static_cast<int16_t>(std::lround(steps.y));
  entry.z = static_cast<int16_t>(std::lround(steps.z));
  const float heading = std::atan2(-ahead.x, -ahead.z);
  const float pitch = std::asin(std::clamp(ahead.y / glm::length(ahead), -1.0f, 1.0f));
  entry.heading = static_cast<uint8_t>(std::lround(heading * kStepsOfTurn / kFullTurn) & 0xff);
  entry.pitch = static_cast<int8_t>(std::lround(pitch * kStepsOfTurn / kFullTurn));
  return entry;
}

void GroupLogReader::Read(const GroupLog& log, std::vector<drama::VisitorLog::Entry>& entries) {
  while (read_ < log.size()) {
    const GroupLog::Item& item = log.item(read_++);
    const GroupEntry& entry = item.entry;
    if (entry.tick != tick_) {
      tick_ = entry.tick;
      visitor_.keys.clear();
    }
    const auto one = std::find_if(group_.begin(), group_.end(),
                                  [&](const auto& visitor) { return visitor.number == entry.who; });
    switch (entry.kind) {
      case GroupEntry::Kind::kKey:
        drama::AddKey(item.text, visitor_.keys);
        break;
      case GroupEntry::Kind::kHour:
        visitor_.hour = static_cast<float>(entry.x) / 60.0f;
        break;
      case GroupEntry::Kind::kJoin:
        if (one == group_.end()) {
          group_.push_back({.number = entry.who});
          std::sort(group_.begin(), group_.end(),
                    [](const auto& a, const auto& b) { return a.number < b.number; });
        }
        break;
      case GroupEntry::Kind::kLeave:
        if (one != group_.end()) {
          group_.erase(one);
        }
        break;
      default:
        if (one != group_.end()) {
          one->tracked = entry.kind == GroupEntry::Kind::kPose;
          one->position = PositionOf(entry);
          one->direction = DirectionOf(entry);
        }
    }
    // The next item may be of the same tick.
    if (read_ == log.size() || log.item(read_).entry.tick != tick_) {
      visitor_.group = std::make_shared<const std::vector<drama::GroupVisitor>>(group_);
      entries.push_back({tick_, visitor_});
    }
  }
}

}  // namespace lararium::group
