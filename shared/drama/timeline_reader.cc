// Reading a timeline; queries and edits are in timeline_text.cc.

#include <utility>

#include "shared/drama/lua_literals.h"
#include "shared/drama/lua_tokens.h"
#include "shared/drama/timeline_text.h"

namespace lararium::drama {
namespace {

using ReaderKind = LuaToken::Kind;

constexpr size_t kMaxProblems = 100;
constexpr std::string_view kRemedy = "write it out, or leave it to the script";

}  // namespace

// Finds and reads the calls of track in a text.
class TimelineReader {
 public:
  explicit TimelineReader(TimelineText& out) : out_(out) {}

  Status Read() {
    LuaTokens tokens(out_.text_);
    LuaToken before;
    LuaToken last;
    for (LuaToken token = tokens.Next(); token.kind != ReaderKind::kEnd; token = tokens.Next()) {
      if (token.kind == ReaderKind::kBad) {
        return Status::Error(At(token.begin), token.problem);
      }
      const bool is_behind = last.kind == ReaderKind::kName && Text(last) == "track" &&
                             !before.Is('.') && !before.Is(':');
      if (is_behind && token.Is('(')) {
        continue;  // track({...}) is the same call.
      }
      if (is_behind && token.Is('{')) {
        LARARIUM_ASSIGN_OR_RETURN(const size_t end, ReadCall(token.begin));
        tokens = LuaTokens(out_.text_, end);
      }
      before = last;
      last = token;
    }
    return Status();
  }

 private:
  std::string_view Text(const LuaToken& token) const {
    return std::string_view(out_.text_).substr(token.begin, token.end - token.begin);
  }
  std::string At(size_t offset) const {
    const LuaPosition position = PositionOf(out_.text_, offset);
    return out_.place_ + ":" + std::to_string(position.line) + ":" +
           std::to_string(position.column);
  }
  void Report(size_t offset, const std::string& problem, std::string_view remedy) {
    if (out_.problems_.size() < kMaxProblems) {
      out_.problems_.push_back(Status::Error(At(offset), problem, remedy).message());
    }
  }

  struct Lane {
    TimelineLane lane;
    uint32_t open = 0;
    uint32_t close = 0;
  };

  // Reads the call whose table opens at an offset. Returns the offset to continue from.
  Result<size_t> ReadCall(size_t open) {
    LuaLiterals literals(out_.text_, open);
    std::vector<Lane> lanes;
    std::string actor;
    size_t end = 0;
    const bool read = literals.Entries(end, [&](LuaEntry& entry) {
      if (entry.key == "actor") {
        Json name;
        const LuaToken token = literals.token();
        if (!literals.Value(0, name, entry.value_end)) {
          return false;
        }
        actor = name.is_string() ? name.get<std::string>() : "";
        return !actor.empty() || literals.Fail(token, "the name of the actor must be a text");
      }
      const auto kind = LaneNamed(entry.key);
      if (!kind) {
        return literals.Fail(literals.token(), "track has no lane '" + entry.key + "'");
      }
      lanes.emplace_back().lane.kind = *kind;
      return ReadLane(literals, lanes.back());
    });
    if (!read) {
      if (literals.token().kind == ReaderKind::kBad || literals.token().kind == ReaderKind::kEnd) {
        return Status::Error(At(literals.problem().offset), literals.problem().text);
      }
      Report(literals.problem().offset, literals.problem().text, kRemedy);
      return open + 1;
    }
    for (Lane& lane : lanes) {
      if (IsOfActor(lane.lane.kind)) {
        if (actor.empty()) {
          Report(open, "'" + std::string(NameOf(lane.lane.kind)) + "' need an actor",
                 "add actor = \"name\"");
          continue;
        }
        lane.lane.actor = actor;
      }
      out_.lanes_.push_back(std::move(lane.lane));
      out_.open_.push_back(lane.open);
      out_.close_.push_back(lane.close);
    }
    return end;
  }

  static bool ReadLane(LuaLiterals& literals, Lane& lane) {
    const LuaToken open = literals.token();
    if (!open.Is('{')) {
      return literals.Fail(open, "write a list of items {...} here");
    }
    lane.open = static_cast<uint32_t>(open.begin);
    size_t end = 0;
    const bool read = literals.Entries(end, [&](LuaEntry& entry) {
      if (!entry.key.empty() || !literals.token().Is('{')) {
        return literals.Fail(literals.token(), "write an item {at = 0, ...} here");
      }
      return ReadItem(literals, lane.lane);
    });
    lane.close = static_cast<uint32_t>(end - 1);
    return read;
  }

  static bool ReadItem(LuaLiterals& literals, TimelineLane& lane) {
    const LuaToken open = literals.token();
    double at = -1.0;
    double length = 0.0;
    size_t end = 0;
    const bool read = literals.Entries(end, [&](LuaEntry& entry) {
      const LuaToken token = literals.token();
      if (entry.key.empty()) {
        return literals.Fail(token, "every value of an item needs a name");
      }
      Json value;
      if (!literals.Value(1, value, entry.value_end)) {
        return false;
      }
      const LaneField* field = FindItemField(entry.key);
      if (field == nullptr || entry.key == "id") {
        return true;  // Lua checks the fields of each lane when the script runs.
      }
      if (const std::string problem = ProblemOf(*field, value); !problem.empty()) {
        return literals.Fail(token, entry.key + " " + problem);
      }
      if (entry.key == "at" || entry.key == "length") {
        (entry.key == "at" ? at : length) = value.get<double>();
      }
      return true;
    });
    if (!read) {
      return false;
    }
    if (at < 0.0) {
      return literals.Fail(open, "this item has no `at`; add the time in seconds when it begins");
    }
    lane.at.push_back(at);
    lane.length.push_back(length);
    lane.begin.push_back(static_cast<uint32_t>(open.begin));
    lane.end.push_back(static_cast<uint32_t>(end));
    return true;
  }

  TimelineText& out_;
};

Result<TimelineText> TimelineText::Read(std::string text, std::string where) {
  if (text.size() > kMaxBytes) {
    return Status::Error(where, "the script is longer than 64 MiB");
  }
  TimelineText timeline;
  timeline.text_ = std::move(text);
  timeline.place_ = std::move(where);
  LARARIUM_RETURN_IF_ERROR(TimelineReader(timeline).Read());
  timeline.indexes_.resize(timeline.lanes_.size());
  timeline.indexed_.assign(timeline.lanes_.size(), 0);
  return timeline;
}

}  // namespace lararium::drama
