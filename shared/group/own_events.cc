#include "shared/group/own_events.h"

#include <algorithm>
#include <cstdlib>

namespace lararium::group {
namespace {

constexpr int64_t kLeastBetweenPoses = 200'000;
constexpr int64_t kPosesOfAll = 62'500;   // All members together send a pose after this time.
constexpr int64_t kRepeat = 600'000;      // Events that are not in the log are sent again.
constexpr int64_t kKeyLives = 3'000'000;  // A later key would surprise.
constexpr size_t kMostWaitingKeys = 32;
constexpr int kMoved = 5;   // 10 cm
constexpr int kTurned = 4;  // 5.6 degrees

bool Differs(const GroupEntry& a, const GroupEntry& b) {
  const auto far = [](int one, int other, int limit) { return std::abs(one - other) >= limit; };
  return a.kind != b.kind || far(a.x, b.x, kMoved) || far(a.y, b.y, kMoved) ||
         far(a.z, b.z, kMoved) || far(a.pitch, b.pitch, kTurned) ||
         std::abs(static_cast<int8_t>(a.heading - b.heading)) >= kTurned;
}

}  // namespace

void OwnEvents::SetPose(const GroupEntry& pose, size_t members, int64_t now) {
  const int64_t between = std::max(kLeastBetweenPoses, kPosesOfAll * static_cast<int64_t>(members));
  const bool differs = has_pose_ ? Differs(pose, pose_) : pose.kind == GroupEntry::Kind::kPose;
  if (!differs || (has_pose_ && now - posed_ < between)) {
    return;
  }
  pose_ = pose;
  pose_.tick = 0;
  pose_.who = 0;
  pose_.serial = ++serial_;
  has_pose_ = true;
  posed_ = now;
  due_ = true;
}

void OwnEvents::AddKey(const std::string& text, int64_t now) {
  if (keys_.size() < kMostWaitingKeys && text.size() <= kMostGroupKey) {
    keys_.push_back({++serial_, text, now});
    due_ = true;
  }
}

GroupEvents OwnEvents::Take(const GroupLog& log, const std::string& name, int64_t now) {
  const GroupLog::Device* device = log.FindPresent(name, boot_);
  const auto is_in_log = [&](uint16_t serial) {
    return device != nullptr && device->serial && !IsLaterSerial(serial, *device->serial);
  };
  std::erase_if(
      keys_, [&](const Key& key) { return is_in_log(key.serial) || now - key.born > kKeyLives; });
  const bool poses = has_pose_ && !is_in_log(pose_.serial);
  GroupEvents events{boot_, {}};
  if ((keys_.empty() && !poses) || (!due_ && now - sent_ < kRepeat)) {
    return events;
  }
  bool posed = !poses;
  for (const Key& key : keys_) {
    if (!posed && IsLaterSerial(key.serial, pose_.serial)) {
      events.events.entries.push_back(pose_);
      posed = true;
    }
    events.events.entries.push_back({.serial = key.serial, .kind = GroupEntry::Kind::kKey});
    events.events.texts.push_back(key.text);
  }
  if (!posed) {
    events.events.entries.push_back(pose_);
  }
  due_ = false;
  sent_ = now;
  return events;
}

}  // namespace lararium::group
