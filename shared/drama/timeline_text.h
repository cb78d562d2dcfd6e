#pragma once

// The declarative part of a drama as it is written: the calls track{...} of a script.
// They are read without running the script, shown as lanes of items, and edited in
// place: what an edit does not mean stays as it is, byte for byte, comments included.
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

// One list of items in one call of track.
struct TimelineLane {
  LaneKind kind = LaneKind::kMarkers;
  std::string actor;  // whose; empty: the stage's
  // Of each item, in the order of the file.
  std::vector<double> at;       // seconds of the drama, at least 0
  std::vector<double> length;   // seconds, at least 0; 0 where none is given
  std::vector<uint32_t> begin;  // where its braces open and close: bytes of the text
  std::vector<uint32_t> end;    // behind the closing one

  size_t size() const { return at.size(); }
};

// One item: a lane of TimelineText::lanes() and its place in there. Edits move items.
struct TimelineItem {
  size_t lane = 0;
  size_t item = 0;
  friend auto operator<=>(const TimelineItem&, const TimelineItem&) = default;
};

// One thing that an item says.
struct TimelineField {
  std::string key;
  Json value;          // null where it is nothing that can be edited
  uint32_t begin = 0;  // of the value in the text, bytes
  uint32_t end = 0;
};

// What an edit did: [offset, offset + removed.size()) became inserted. Undone by its
// reverse.
struct TextEdit {
  size_t offset = 0;
  std::string removed;
  std::string inserted;

  TextEdit Reverse() const { return {offset, inserted, removed}; }
};

// The shortest single edit that makes one text of another.
TextEdit Difference(std::string_view before, std::string_view after);

// What one field of an item is to say.
struct TimelineChange {
  TimelineItem item;
  std::string key;
  Json value;
};

class TimelineText {
 public:
  static constexpr size_t kMaxBytes = 64 << 20;

  // place: what messages call the text. Errors: texts and comments that never end, a
  // call of track whose braces do not close. A call that is not written out (that
  // computes, or holds what no lane knows) is left to the script alone: problems().
  static Result<TimelineText> Read(std::string text, std::string place);

  const std::string& text() const { return text_; }
  const std::string& place() const { return place_; }
  std::span<const TimelineLane> lanes() const { return lanes_; }
  // "drama.lua:12:5: ...": what cannot be edited, or is wrong.
  std::span<const std::string> problems() const { return problems_; }

  // What an item says, in the order of the file.
  std::vector<TimelineField> Fields(TimelineItem item) const;
  std::optional<Json> Field(TimelineItem item, std::string_view key) const;
  // Line of the text, from 1.
  size_t LineOf(TimelineItem item) const;
  // The items of a lane that touch [from, to), by their beginnings.
  void Query(size_t lane, double from, double to, std::vector<uint32_t>& found) const;
  // The text with lanes of these kinds empty, and each line where it was.
  std::string WithoutItems(std::span<const LaneKind> kinds) const;
  // When the last item ends, seconds.
  double Duration() const;

  // ---- edits ----

  // Each either does all of what it is asked, or fails and does nothing.
  Result<TextEdit> Set(TimelineItem item, std::string_view key, const Json& value);
  // Many at once, in the time of reading the text. Items keep their numbers.
  Result<TextEdit> SetAll(std::span<const TimelineChange> changes);
  Result<TextEdit> Unset(TimelineItem item, std::string_view key);
  // Behind the last item of the lane that does not begin later. fields: an object with
  // `at`.
  Result<TextEdit> Insert(size_t lane, const Json& fields);
  Result<TextEdit> Remove(TimelineItem item);
  // At the end of the text. Fails where there is such a lane.
  Result<TextEdit> AddLane(LaneKind kind, const std::string& actor);
  // Any edit, such as the reverse of another one.
  Status Apply(const TextEdit& edit);

 private:
  friend class TimelineReader;

  struct NewItem {
    std::string lead;  // what comes before it
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
  std::vector<uint32_t> open_;   // of each lane: where its own braces open and close
  std::vector<uint32_t> close_;  // the closing one itself
  std::vector<std::string> problems_;
  mutable std::vector<IntervalIndex> indexes_;  // of each lane, once it was asked for
  mutable std::vector<uint8_t> indexed_;
};

// A value as Lua writes it: numbers so that they read back the same.
std::string LuaLiteral(const Json& value);

}  // namespace lararium::drama
