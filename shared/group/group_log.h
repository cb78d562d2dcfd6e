#pragma once

// The log of a group's drama: what its visitors do, in the order and from the ticks that the leader
// has chosen. Devices that have the same log play the same drama.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "shared/drama/visitor.h"
#include "shared/group/group_message.h"

namespace lararium::group {

class GroupLog {
 public:
  static constexpr size_t kMostEntries = 65'536;
  static constexpr size_t kMostDevices = 255;

  struct Item {
    GroupEntry entry;
    std::string text;   // Empty unless GroupEntry::has_text().
    uint64_t hash = 0;  // Hash of this and all earlier items.
  };
  // A device that is or was in the log; its index is GroupEntry::who.
  struct Device {
    std::string name;
    uint64_t boot = 0;  // The lowest 48 bits of GroupBeat::boot.
    bool present = false;
    std::optional<uint16_t> serial;  // Serial of its last entry.
  };

  size_t size() const { return items_.size(); }
  const Item& item(size_t index) const { return items_[index]; }
  const std::vector<Device>& devices() const { return devices_; }
  const Device* Find(const std::string& name) const;
  // Finds a device that is present and has not started again since it joined; nullptr: there is
  // none.
  const Device* FindPresent(const std::string& name, uint64_t boot) const;
  int32_t last_tick() const { return items_.empty() ? 0 : items_.back().entry.tick; }

  // False: an entry cannot follow, because its tick is earlier or its device is not known, or the
  // log is full.
  bool Append(const GroupEntry& entry, const std::string& text);
  // Adds a device, or marks that it has started again.
  bool Join(int32_t tick, const std::string& name, uint64_t boot);
  // Keeps the first items.
  void Truncate(size_t count);
  // Keeps the items up to a tick.
  void TruncateAfter(int32_t tick);

  GroupPlace place() const { return PlaceAt(size()); }
  GroupPlace PlaceAt(size_t count) const;
  bool Has(const GroupPlace& place) const {
    return place.count <= size() && PlaceAt(place.count).hash == place.hash;
  }
  // Some places, the last ones close together.
  std::vector<GroupPlace> Places() const;
  // The last of the places that this log has; 0: none.
  size_t CommonWith(std::span<const GroupPlace> places) const;

  // Returns at most `most` items from an index on, which fit into a message.
  GroupEntries Part(size_t from, size_t most = kMostGroupEntries) const;
  // The first item that has changed, and the first tick of which the log says something else now:
  // that of the new item, or of the one that was there, which may be earlier.
  struct Change {
    size_t index = 0;
    int32_t tick = 0;

    friend bool operator==(const Change&, const Change&) = default;
  };
  // Replaces what differs from a part that begins at an index; nullopt: all were there. Stops at an
  // entry that cannot follow. last: items behind the part are dropped.
  std::optional<Change> Take(size_t from, const GroupEntries& part, bool last = false);

 private:
  void Apply(const Item& item);

  std::vector<Item> items_;
  std::vector<Device> devices_;
};

// Whether a device gave this serial to a later event. Serials begin again after 65,535.
inline bool IsLaterSerial(uint16_t serial, uint16_t other) {
  return static_cast<int16_t>(serial - other) > 0;
}

// What a visitor does, as an entry of kind kPose or kLost. Poses far outside of any stage, and
// values that are no numbers, are as if the camera were not tracked.
GroupEntry EntryOf(const drama::Visitor& visitor);

// Reads a log into visitors of a drama.
class GroupLogReader {
 public:
  // Appends what the items from where it stands say, as entries of a visitor log. The first of them
  // may be of the same tick as the last one before.
  void Read(const GroupLog& log, std::vector<drama::VisitorLog::Entry>& entries);
  size_t read() const { return read_; }

 private:
  size_t read_ = 0;
  int32_t tick_ = 0;
  drama::Visitor visitor_;
  std::vector<drama::GroupVisitor> group_;
};

}  // namespace lararium::group
