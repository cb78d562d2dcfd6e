#pragma once

// Messages between the devices of a group that plays one drama, and between a device's player and
// its link to them (docs/file-formats.md). Those from the network may come from an attacker.

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "shared/core/status.h"

namespace lararium::group {

// What a visitor does, or what the leader says of the visitors.
struct GroupEntry {
  enum class Kind : uint8_t {
    kPose,   // The visitor stands there.
    kLost,   // The camera of the visitor is not tracked. The last pose stays.
    kKey,    // A key or a message of another program; has a text.
    kJoin,   // A device joins: its name is the text, and x, y, z hold a part of its boot.
    kLeave,  // A device has left.
    kHour,   // The local time of day; x: minutes.
  };
  static constexpr int kKinds = 6;

  int32_t tick = 0;
  int16_t x = 0;  // Stage frame, 2 cm.
  int16_t y = 0;
  int16_t z = 0;
  uint16_t serial = 0;  // Consecutive number of the device's events.
  uint8_t who = 0;      // Number of the device in the log.
  Kind kind = Kind::kPose;
  uint8_t heading = 0;  // 256 steps of a turn.
  int8_t pitch = 0;

  bool has_text() const { return kind == Kind::kKey || kind == Kind::kJoin; }
  friend bool operator==(const GroupEntry&, const GroupEntry&) = default;
};

// Entries, and the texts of those that have one, in their order.
struct GroupEntries {
  std::vector<GroupEntry> entries;
  std::vector<std::string> texts;
};

// A log up to an entry: the number of entries, and a hash of all of them.
struct GroupPlace {
  uint64_t count = 0;
  uint64_t hash = 0;

  friend bool operator==(const GroupPlace&, const GroupPlace&) = default;
};

// From a moment of the group's time on, the drama is at a tick, and goes on or is held.
struct GroupPiece {
  int64_t since = 0;  // Microseconds.
  int64_t tick = 0;
  bool held = false;

  friend bool operator==(const GroupPiece&, const GroupPiece&) = default;
};

struct GroupMark {
  int64_t tick = 0;  // 0: none.
  uint64_t hash = 0;
};

// What each member says several times a second. Times are microseconds.
struct GroupBeat {
  struct Echo {
    std::string name;
    int64_t sent = 0;      // GroupBeat::sent of that member's last beat.
    int64_t received = 0;  // The group's time at which it came.
  };

  uint64_t boot = 0;   // Random number of this run of the link.
  int64_t sent = 0;    // The member's own clock.
  int64_t since = 0;   // The group's time when the member joined.
  bool guide = false;  // The device of a guide.
  bool ready = false;  // Has the group's log and time, so that it may lead.
  bool leads = false;
  bool visited = false;  // A visitor is present, as far as known.
  std::string leader;    // Name of the leader that it follows; may be empty.
  std::string show;      // Only members with the same show play together.
  uint64_t epoch = 0;    // Number of the leadership.
  uint64_t run = 0;      // Another run: the drama went to another moment.
  GroupPlace log;
  GroupMark mark;  // State of the drama at a tick of the run.
  // The fields from here on are those of a leader's beat.
  uint16_t followers = 0;
  int64_t time = 0;  // The group's time at `sent`.
  std::vector<GroupPiece> pieces;
  std::vector<Echo> echoes;
};

// A part of the leader's log.
struct GroupLogPart {
  uint64_t epoch = 0;
  uint64_t run = 0;
  GroupPlace before;  // The log without these entries and those behind them.
  GroupEntries part;
};

// What a member's visitor did that is not yet in the log.
struct GroupEvents {
  uint64_t boot = 0;
  GroupEntries events;
};

// Asks for the log from the last place on that both have.
struct GroupAsk {
  std::vector<GroupPlace> places;
};

// What a guide, the staff or a visitor wants of the drama.
struct GroupWish {
  enum class What : uint8_t {
    kHold,
    kResume,
    kGoTo,          // A marker.
    kRestart,       // Asked by the staff or a guide.
    kRestartAlone,  // Asked by a visitor: only if no other visitor is there.
  };
  static constexpr int kWhats = 5;

  uint64_t boot = 0;
  int64_t sent = 0;
  What what = What::kHold;
  std::string marker;
};

// What the player tells its link.
struct GroupOwn {
  struct Marker {
    std::string name;
    int64_t tick = 0;
  };

  std::string show;
  GroupEntry visitor;  // kPose or kLost.
  std::vector<std::string> keys;
  int32_t minute = -1;  // Local time of day; -1: unknown.
  bool restart = false;
  bool visited = false;
  uint64_t mark_run = 0;
  GroupMark mark;
  std::vector<GroupPlace> places;  // The log that it has, as in GroupAsk.
  std::vector<Marker> markers;     // Empty: those of before.
};

// What the link tells its player. Seconds of the steady clock, which both have.
struct GroupClockNews {
  struct Piece {
    double since = 0.0;
    double seconds = 0.0;
    double rate = 1.0;
  };

  uint64_t run = 0;
  std::vector<Piece> pieces;  // One, or two.
};

using GroupMessage = std::
    variant<GroupBeat, GroupLogPart, GroupEvents, GroupAsk, GroupWish, GroupOwn, GroupClockNews>;

// The names of visitors' pages begin with this; no device's name does.
inline constexpr std::string_view kPage = "page/";
inline bool IsPage(std::string_view name) { return name.starts_with(kPage); }

// Limits of a message.
inline constexpr size_t kMostGroupBytes = 60'000;
inline constexpr size_t kMostGroupEntries = 2000;  // Limit of one message.
inline constexpr size_t kMostGroupKey = 512;       // Bytes.
inline constexpr size_t kMostGroupKeys = 64;       // Limit of one message.
inline constexpr size_t kMostGroupMarkers = 500;
inline constexpr size_t kMostGroupMembers = 32;  // Devices are counted, and pages are not.
inline constexpr size_t kMostGroupPages = 16;

Result<GroupMessage> ParseGroupMessage(std::string_view bytes);
std::string FormatGroupMessage(const GroupMessage& message);

}  // namespace lararium::group
