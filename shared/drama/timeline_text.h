#pragma once

// Source text of the declarative part of a drama: the calls track{...} of a script. They are read
// without running the script, shown as lanes of items, and edited in place. An edit changes no
// other byte of the text, comments included.
//
//   track{ actor = "keeper",
//     speech = {
//       {id = "hail", at = 2, length = 1.5, line = "salvete"},  -- to the visitor
//     },
//   }

#include <compare>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shared/core/json.h"
#include "shared/core/status.h"
#include "shared/drama/interval_index.h"
#include "shared/drama/timeline_lanes.h"

namespace lararium::drama {

// One list of items in one call of track{...}.
struct TimelineLane {
  LaneKind kind = LaneKind::kMarkers;
  std::string actor;  // Name of the actor; empty: a lane of the stage.
  // One element per item, in the order of the file.
  std::vector<double> at;       // Time of the drama, seconds, at least 0.
  std::vector<double> length;   // Seconds, at least 0; 0 if none is given.
  std::vector<uint32_t> begin;  // Byte offset of the opening brace.
  std::vector<uint32_t> end;    // Byte offset after the closing brace.

  size_t size() const { return at.size(); }
};

// One item: index into TimelineText::lanes() and index of the item in that lane. Edits change these
// indices.
struct TimelineItem {
  size_t lane = 0;
  size_t item = 0;
  friend auto operator<=>(const TimelineItem&, const TimelineItem&) = default;
};

// One field of an item.
struct TimelineField {
  std::string key;
  Json value;          // Null if the value cannot be edited.
  uint32_t begin = 0;  // Byte offsets of the value.
  uint32_t end = 0;
};

// An edit: [offset, offset + removed.size()) was replaced by `inserted`. Reverse() undoes it.
struct TextEdit {
  size_t offset = 0;
  std::string removed;
  std::string inserted;

  TextEdit Reverse() const { return {offset, inserted, removed}; }
};

// The shortest single edit that turns `before` into `after`.
TextEdit Difference(std::string_view before, std::string_view after);

// A new value for one field of an item.
struct TimelineChange {
  TimelineItem item;
  std::string key;
  Json value;
};

class TimelineText {
 public:
  static constexpr size_t kMaxBytes = 64 << 20;

  // Messages begin with `where`. Errors: texts or comments that never end, a call of track whose
  // braces do not close. A call that is not written as literals, or that has unknown lanes, cannot
  // be edited; problems() lists it.
  static Result<TimelineText> Read(std::string text, std::string where);

  const std::string& text() const { return text_; }
  const std::string& place() const { return place_; }
  std::span<const TimelineLane> lanes() const { return lanes_; }
  // Calls and items that cannot be edited or are wrong: "drama.lua:12:5: ...".
  std::span<const std::string> problems() const { return problems_; }

  // The fields of an item, in the order of the file.
  std::vector<TimelineField> Fields(TimelineItem item) const;
  std::optional<Json> Field(TimelineItem item, std::string_view key) const;
  // Line number of an item, from 1.
  size_t LineOf(TimelineItem item) const;
  // Appends the items of a lane that touch [from, to), ordered by their begins.
  void Query(size_t lane, double from, double to, std::vector<uint32_t>& found) const;
  // The text with empty lanes of these kinds. Line numbers do not change.
  std::string WithoutItems(std::span<const LaneKind> kinds) const;
  // The end of the last item, seconds.
  double Duration() const;

  // ---- edits ----

  // Each edit either succeeds completely or fails and changes nothing.
  Result<TextEdit> Set(TimelineItem item, std::string_view key, const Json& value);
  // Makes many changes in the time of one read of the text. Indices of items do not change.
  Result<TextEdit> SetAll(std::span<const TimelineChange> changes);
  Result<TextEdit> Unset(TimelineItem item, std::string_view key);
  // Inserts an item after the last item of the lane that does not start later. `fields` is an
  // object with `at`.
  Result<TextEdit> Insert(size_t lane, const Json& fields);
  Result<TextEdit> Remove(TimelineItem item);
  // Adds an empty lane at the end of the text. Error: the lane exists.
  Result<TextEdit> AddLane(LaneKind kind, const std::string& actor);
  // Applies any edit, such as the reverse of another one.
  Status Apply(const TextEdit& edit);

 private:
  friend class TimelineReader;

  struct NewItem {
    std::string lead;  // Text before the item, such as a comma and the indentation.
    std::string text;
    std::string tail;
    double at = 0.0;
    double length = 0.0;
  };

  TextEdit Change(size_t begin, size_t end, std::string_view with);
  Result<TextEdit> ReplaceWithin(TimelineItem item,
                                 size_t begin,
                                 size_t end,
                                 std::string_view with);
  Result<TextEdit> InsertAt(TimelineItem place, size_t begin, size_t end, const NewItem& item);
  Status CheckRoom(size_t bytes) const;
  Status Check(TimelineItem item) const;
  std::string IndentOf(size_t offset) const;

  std::string text_;
  std::string place_;
  std::vector<TimelineLane> lanes_;
  // Byte offsets of the opening and the closing brace of each lane.
  std::vector<uint32_t> open_;
  std::vector<uint32_t> close_;
  std::vector<std::string> problems_;
  mutable std::vector<IntervalIndex> indexes_;  // One per lane, built on first use.
  mutable std::vector<uint8_t> indexed_;
};

// A value as Lua source. Numbers read back exactly.
std::string LuaLiteral(const Json& value);

}  // namespace lararium::drama
