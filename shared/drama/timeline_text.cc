#include "shared/drama/timeline_text.h"

#include <algorithm>
#include <cmath>

#include "shared/core/number_text.h"
#include "shared/drama/lua_literals.h"
#include "shared/drama/lua_tokens.h"

namespace lararium::drama {
namespace {

using Kind = LuaToken::Kind;

bool IsName(std::string_view text) {
  LuaTokens tokens(text);
  const LuaToken token = tokens.Next();
  constexpr std::string_view kKeywords[] = {
      "and",      "break",  "do",   "else", "elseif", "end",  "false", "for",
      "function", "goto",   "if",   "in",   "local",  "nil",  "not",   "or",
      "repeat",   "return", "then", "true", "until",  "while"};
  return token.kind == Kind::kName && token.begin == 0 && token.end == text.size() &&
         std::find(std::begin(kKeywords), std::end(kKeywords), text) == std::end(kKeywords);
}

// A key as Lua source before '=': without brackets if it is a valid name.
std::string LuaKey(const std::string& key) {
  return IsName(key) ? key : "[" + LuaLiteral(key) + "]";
}

// Skips blanks, but not line ends.
size_t SkipSpaces(std::string_view text, size_t at) {
  while (at < text.size() && (text[at] == ' ' || text[at] == '\t' || text[at] == '\r')) {
    ++at;
  }
  return at;
}

// Offset of the line end if only blanks and a short comment follow; otherwise `at`.
size_t RestOfLine(std::string_view text, size_t at) {
  const size_t next = SkipSpaces(text, at);
  if (next >= text.size() || text[next] == '\n') {
    return next;
  }
  const bool short_comment =
      text.substr(next).starts_with("--") && !text.substr(next).starts_with("--[");
  return short_comment ? std::min(text.find('\n', next), text.size()) : at;
}

size_t LineBegin(std::string_view text, size_t at) {
  const size_t newline = at == 0 ? std::string_view::npos : text.rfind('\n', at - 1);
  return newline == std::string_view::npos ? 0 : newline + 1;
}

bool BeginsLine(std::string_view text, size_t at) {
  return SkipSpaces(text, LineBegin(text, at)) == at;
}

std::string ItemLiteral(const Json& fields) {
  // The time and the action come first, as an author would write them.
  std::string out = "{";
  const auto add = [&](const std::string& key, const Json& value) {
    out += (out.size() > 1 ? ", " : "") + LuaKey(key) + " = " + LuaLiteral(value);
  };
  constexpr const char* kFirst[] = {"id", "at", "length"};
  for (const char* key : kFirst) {
    if (fields.contains(key)) {
      add(key, fields[key]);
    }
  }
  for (const auto& [key, value] : fields.items()) {
    if (std::find(std::begin(kFirst), std::end(kFirst), key) == std::end(kFirst)) {
      add(key, value);
    }
  }
  return out + "}";
}

// Whether a value can be written and read back: finite, not null, not too deep.
bool IsWritable(const Json& value, int depth = 1) {
  if (value.is_number()) {
    return std::isfinite(value.get<double>());
  }
  if (value.is_structured()) {
    return depth < LuaLiterals::kMaxDepth &&
           std::all_of(value.begin(), value.end(),
                       [depth](const Json& inner) { return IsWritable(inner, depth + 1); });
  }
  return value.is_string() || value.is_boolean();
}

}  // namespace

std::vector<TimelineField> TimelineText::Fields(TimelineItem item) const {
  std::vector<TimelineField> fields;
  if (!Check(item).ok()) {
    return fields;
  }
  for (LuaEntry& entry : EntriesOf(text_, lanes_[item.lane].begin[item.item], true)) {
    fields.push_back({std::move(entry.key), std::move(entry.value),
                      static_cast<uint32_t>(entry.value_begin),
                      static_cast<uint32_t>(entry.value_end)});
  }
  return fields;
}

std::optional<Json> TimelineText::Field(TimelineItem item, std::string_view key) const {
  for (TimelineField& field : Fields(item)) {
    if (field.key == key) {
      return std::move(field.value);
    }
  }
  return std::nullopt;
}

size_t TimelineText::LineOf(TimelineItem item) const {
  return Check(item).ok() ? PositionOf(text_, lanes_[item.lane].begin[item.item]).line : 0;
}

void TimelineText::Query(size_t lane, double from, double to, std::vector<uint32_t>& found) const {
  CHECK(lane < lanes_.size());
  if (indexed_[lane] == 0) {
    indexes_[lane].Build(lanes_[lane].at, lanes_[lane].length);
    indexed_[lane] = 1;
  }
  indexes_[lane].Query(from, to, found);
}

double TimelineText::Duration() const {
  double duration = 0.0;
  for (const TimelineLane& lane : lanes_) {
    for (size_t i = 0; i < lane.size(); ++i) {
      duration = std::max(duration, lane.at[i] + lane.length[i]);
    }
  }
  return duration;
}

std::string TimelineText::WithoutItems(std::span<const LaneKind> kinds) const {
  std::string text = text_;
  for (size_t i = 0; i < lanes_.size(); ++i) {
    if (std::find(kinds.begin(), kinds.end(), lanes_[i].kind) != kinds.end()) {
      std::replace_if(
          text.begin() + open_[i] + 1, text.begin() + close_[i], [](char c) { return c != '\n'; },
          ' ');
    }
  }
  return text;
}

// ---- edits ----

Status TimelineText::Check(TimelineItem item) const {
  return item.lane < lanes_.size() && item.item < lanes_[item.lane].size()
             ? Status()
             : Status::Error(place_, "there is no such item on the timeline");
}

// Replaces a part of the text and moves the offsets of everything after it.
TextEdit TimelineText::Change(size_t begin, size_t end, std::string_view with) {
  TextEdit edit = {begin, text_.substr(begin, end - begin), std::string(with)};
  text_.replace(begin, end - begin, with);
  const auto by = static_cast<int64_t>(with.size()) - static_cast<int64_t>(end - begin);
  const auto move = [by](uint32_t& offset) {
    offset = static_cast<uint32_t>(static_cast<int64_t>(offset) + by);
  };
  const auto move_begin = [&](uint32_t& offset) {
    if (offset >= end) {
      move(offset);
    }
  };
  const auto move_end = [&](uint32_t& offset) {
    if (offset > end) {
      move(offset);
    }
  };
  for (size_t i = 0; i < lanes_.size(); ++i) {
    if (close_[i] < end) {
      continue;
    }
    move_begin(open_[i]);
    move_begin(close_[i]);
    std::for_each(lanes_[i].begin.begin(), lanes_[i].begin.end(), move_begin);
    std::for_each(lanes_[i].end.begin(), lanes_[i].end.end(), move_end);
  }
  return edit;
}

// Makes a change inside the braces of one item.
Result<TextEdit> TimelineText::ReplaceWithin(TimelineItem item,
                                             size_t begin,
                                             size_t end,
                                             std::string_view with) {
  LARARIUM_RETURN_IF_ERROR(CheckRoom(with.size()));
  TextEdit edit = Change(begin, end, with);
  TimelineLane& lane = lanes_[item.lane];
  lane.length[item.item] = 0.0;
  for (const TimelineField& field : Fields(item)) {
    if (field.key == "at") {
      lane.at[item.item] = field.value.get<double>();
    } else if (field.key == "length") {
      lane.length[item.item] = field.value.get<double>();
    }
  }
  indexed_[item.lane] = 0;
  return edit;
}

// Inserts a new item before the item `place` of a lane, with the surrounding text.
Result<TextEdit> TimelineText::InsertAt(TimelineItem place,
                                        size_t begin,
                                        size_t end,
                                        const NewItem& item) {
  LARARIUM_RETURN_IF_ERROR(CheckRoom(item.lead.size() + item.text.size() + item.tail.size()));
  TextEdit edit = Change(begin, end, item.lead + item.text + item.tail);
  TimelineLane& lane = lanes_[place.lane];
  const auto at = static_cast<std::ptrdiff_t>(place.item);
  const auto from = static_cast<uint32_t>(begin + item.lead.size());
  lane.at.insert(lane.at.begin() + at, item.at);
  lane.length.insert(lane.length.begin() + at, item.length);
  lane.begin.insert(lane.begin.begin() + at, from);
  lane.end.insert(lane.end.begin() + at, from + static_cast<uint32_t>(item.text.size()));
  indexed_[place.lane] = 0;
  return edit;
}

Status TimelineText::CheckRoom(size_t bytes) const {
  return text_.size() + bytes <= kMaxBytes
             ? Status()
             : Status::Error(place_, "the script would be longer than 64 MiB");
}

namespace {

// A part of a text and its replacement.
struct Replacement {
  size_t begin = 0;
  size_t end = 0;
  std::string with;
};

Status CheckField(const std::string& where, std::string_view key, const Json& value) {
  if (key.empty() || key.size() > 100) {
    return Status::Error(where, "a field needs a name of up to 100 characters");
  }
  if (!IsWritable(value)) {
    return Status::Error(where, "'" + std::string(key) +
                                    "' must be a finite number, a text, true, false or a table");
  }
  if (key == "at" || key == "length") {
    const double number = value.is_number() ? value.get<double>() : -1.0;
    if (!(number >= 0.0 && number <= 1e6)) {
      return Status::Error(where, std::string(key) + " must be a number from 0 to 1000000");
    }
  }
  if (key == "ease" && !(value.is_string() && EaseNamed(value.get<std::string>()))) {
    return Status::Error(where, "ease is \"linear\", \"in\", \"out\" or \"smooth\"");
  }
  return Status();
}

// The replacement that sets a field of the item whose brace opens at an offset.
Replacement SetField(std::string_view text,
                     size_t offset,
                     std::string_view key,
                     const Json& value) {
  const std::vector<LuaEntry> entries = EntriesOf(text, offset, false);
  // If a name occurs more than once, the last one counts.
  const auto known = std::find_if(entries.rbegin(), entries.rend(),
                                  [key](const LuaEntry& entry) { return entry.key == key; });
  if (known != entries.rend()) {
    return {known->value_begin, known->value_end, LuaLiteral(value)};
  }
  const size_t last = entries.back().value_end;
  return {last, last, ", " + LuaKey(std::string(key)) + " = " + LuaLiteral(value)};
}

}  // namespace

Result<TextEdit> TimelineText::Set(TimelineItem item, std::string_view key, const Json& value) {
  LARARIUM_RETURN_IF_ERROR(Check(item));
  LARARIUM_RETURN_IF_ERROR(CheckField(place_, key, value));
  const Replacement change = SetField(text_, lanes_[item.lane].begin[item.item], key, value);
  return ReplaceWithin(item, change.begin, change.end, change.with);
}

Result<TextEdit> TimelineText::SetAll(std::span<const TimelineChange> changes) {
  std::vector<Replacement> replacements;
  replacements.reserve(changes.size());
  size_t growth = 0;
  for (const TimelineChange& change : changes) {
    LARARIUM_RETURN_IF_ERROR(Check(change.item));
    LARARIUM_RETURN_IF_ERROR(CheckField(place_, change.key, change.value));
    replacements.push_back(SetField(text_, lanes_[change.item.lane].begin[change.item.item],
                                    change.key, change.value));
    growth += replacements.back().with.size();
  }
  LARARIUM_RETURN_IF_ERROR(CheckRoom(growth));
  // Two new fields of one item have the same offset and must keep their order.
  std::stable_sort(replacements.begin(), replacements.end(),
                   [](const Replacement& a, const Replacement& b) { return a.begin < b.begin; });
  std::string text;
  text.reserve(text_.size() + growth);
  size_t copied = 0;
  for (const Replacement& replacement : replacements) {
    if (replacement.begin < copied) {
      return Status::Error(place_, "the same field would be changed twice");
    }
    text.append(text_, copied, replacement.begin - copied);
    text += replacement.with;
    copied = replacement.end;
  }
  text.append(text_, copied);
  TextEdit edit = Difference(text_, text);
  LARARIUM_ASSIGN_OR_RETURN(*this, Read(std::move(text), place_));
  return edit;
}

Result<TextEdit> TimelineText::Unset(TimelineItem item, std::string_view key) {
  LARARIUM_RETURN_IF_ERROR(Check(item));
  const std::vector<LuaEntry> entries = EntriesOf(text_, lanes_[item.lane].begin[item.item], false);
  const auto known = std::find_if(entries.begin(), entries.end(),
                                  [key](const LuaEntry& entry) { return entry.key == key; });
  if (known == entries.end()) {
    return Status::Error(place_, "the item has no '" + std::string(key) + "'");
  }
  if (key == "at") {
    return Status::Error(place_, "the `at` of an item cannot be removed");
  }
  // Remove the comma as well, but keep a comment before it.
  std::string kept;
  size_t end = known->value_end;
  if (known->separator != 0) {
    kept = text_.substr(end, known->separator - end);
    end = known->separator + 1;
    if (kept.find_first_not_of(" \t") == std::string::npos) {
      kept.clear();
      end = SkipSpaces(text_, end);
    }
  }
  return ReplaceWithin(item, known->begin, end, kept);
}

// The whitespace at the beginning of the line.
std::string TimelineText::IndentOf(size_t offset) const {
  const size_t line = LineBegin(text_, offset);
  return text_.substr(line, SkipSpaces(text_, line) - line);
}

Result<TextEdit> TimelineText::Insert(size_t lane, const Json& fields) {
  if (lane >= lanes_.size()) {
    return Status::Error(place_, "there is no such lane on the timeline");
  }
  if (!fields.is_object() || !fields.contains("at")) {
    return Status::Error(place_, "a new item needs `at`, the time in seconds when it begins");
  }
  for (const auto& [key, value] : fields.items()) {
    LARARIUM_RETURN_IF_ERROR(CheckField(place_, key, value));
  }
  NewItem item;
  item.text = ItemLiteral(fields);
  item.at = fields["at"].get<double>();
  item.length = fields.value("length", 0.0);
  const TimelineLane& in = lanes_[lane];
  size_t before = in.size();  // The item to insert after; size(): none.
  for (size_t i = 0; i < in.size(); ++i) {
    before = in.at[i] <= item.at ? i : before;
  }
  if (in.size() == 0) {
    // The only item gets a line of its own.
    const size_t close = close_[lane];
    const std::string outer = IndentOf(open_[lane]);
    const bool own_line = BeginsLine(text_, close);
    item.lead = (own_line ? "" : "\n") + outer + "  ";
    item.tail = own_line ? ",\n" : ",\n" + outer;
    const size_t at = own_line ? LineBegin(text_, close) : close;
    return InsertAt({lane, 0}, at, at, item);
  }
  if (before == in.size()) {
    const size_t first = in.begin[0];
    item.tail = BeginsLine(text_, first) ? ",\n" + IndentOf(first) : ", ";
    return InsertAt({lane, 0}, first, first, item);
  }
  const size_t begin = in.begin[before];
  const size_t end = in.end[before];
  const bool own_line = BeginsLine(text_, begin);
  LuaTokens tokens(text_, end);
  const LuaToken next = tokens.Next();
  const bool has_comma = next.Is(',') || next.Is(';');
  const size_t from = has_comma ? next.end : end;
  // A comment after an item belongs to it.
  const size_t to = own_line ? RestOfLine(text_, from) : from;
  item.lead = (has_comma ? "" : ",") + text_.substr(from, to - from) +
              (own_line ? "\n" + IndentOf(begin) : " ");
  item.tail = has_comma ? "," : "";
  return InsertAt({lane, before + 1}, from, to, item);
}

Result<TextEdit> TimelineText::Remove(TimelineItem item) {
  LARARIUM_RETURN_IF_ERROR(Check(item));
  const TimelineLane& lane = lanes_[item.lane];
  size_t begin = lane.begin[item.item];
  size_t end = lane.end[item.item];
  LuaTokens tokens(text_, end);
  const LuaToken next = tokens.Next();
  std::string kept;
  if (next.Is(',') || next.Is(';')) {
    kept = text_.substr(end, next.begin - end);
    end = next.end;
  }
  if (kept.find_first_not_of(" \t\r\n") == std::string::npos) {
    kept.clear();
    // Also remove the line if it becomes empty.
    const size_t rest = SkipSpaces(text_, end);
    if (BeginsLine(text_, begin) && rest < text_.size() && text_[rest] == '\n') {
      begin = LineBegin(text_, begin);
      end = rest + 1;
    } else {
      end = rest;
    }
  }
  TimelineLane& in = lanes_[item.lane];
  const auto at = static_cast<std::ptrdiff_t>(item.item);
  in.at.erase(in.at.begin() + at);
  in.length.erase(in.length.begin() + at);
  in.begin.erase(in.begin.begin() + at);
  in.end.erase(in.end.begin() + at);
  indexed_[item.lane] = 0;
  return Change(begin, end, kept);
}

Result<TextEdit> TimelineText::AddLane(LaneKind kind, const std::string& actor) {
  if (IsOfActor(kind) == actor.empty()) {
    return Status::Error(place_, actor.empty()
                                     ? "this lane needs an actor; name one"
                                     : "this lane belongs to the stage; it cannot have an actor");
  }
  for (const TimelineLane& lane : lanes_) {
    if (lane.kind == kind && lane.actor == actor) {
      return Status::Error(place_, "the timeline already has this lane");
    }
  }
  const std::string who = actor.empty() ? "" : "actor = " + LuaLiteral(actor) + ", ";
  const std::string call = (text_.empty() || text_.ends_with('\n') ? "" : "\n") +
                           std::string("\ntrack{") + who + std::string(NameOf(kind)) + " = {\n}}\n";
  TextEdit edit = {text_.size(), "", call};
  LARARIUM_RETURN_IF_ERROR(Apply(edit));
  return edit;
}

Status TimelineText::Apply(const TextEdit& edit) {
  if (edit.offset > text_.size() || edit.removed.size() > text_.size() - edit.offset ||
      text_.compare(edit.offset, edit.removed.size(), edit.removed) != 0) {
    return Status::Error(place_, "the script has been changed elsewhere", "open it again");
  }
  std::string changed = text_;
  changed.replace(edit.offset, edit.removed.size(), edit.inserted);
  LARARIUM_ASSIGN_OR_RETURN(*this, Read(std::move(changed), place_));
  return Status();
}

TextEdit Difference(std::string_view before, std::string_view after) {
  const size_t shorter = std::min(before.size(), after.size());
  const auto first = std::mismatch(before.begin(), before.begin() + shorter, after.begin());
  const auto same = static_cast<size_t>(first.first - before.begin());
  size_t tail = 0;
  while (tail < shorter - same &&
         before[before.size() - 1 - tail] == after[after.size() - 1 - tail]) {
    ++tail;
  }
  return {same, std::string(before.substr(same, before.size() - same - tail)),
          std::string(after.substr(same, after.size() - same - tail))};
}

std::string LuaLiteral(const Json& value) {
  if (value.is_number()) {
    return FormatNumber(value.get<double>());
  }
  if (value.is_boolean()) {
    return value.get<bool>() ? "true" : "false";
  }
  if (value.is_string()) {
    std::string out = "\"";
    for (const char c : value.get_ref<const std::string&>()) {
      const auto byte = static_cast<unsigned char>(c);
      if (c == '"' || c == '\\') {
        out += '\\';
        out += c;
      } else if (c == '\n') {
        out += "\\n";
      } else if (byte < 0x20 || byte == 0x7f) {
        const std::string code = std::to_string(byte);
        out += "\\" + std::string(3 - code.size(), '0') + code;
      } else {
        out += c;
      }
    }
    return out + "\"";
  }
  std::string out;
  if (value.is_array()) {
    for (const Json& inner : value) {
      out += (out.empty() ? "" : ", ") + LuaLiteral(inner);
    }
  } else if (value.is_object()) {
    for (const auto& [key, inner] : value.items()) {
      out += (out.empty() ? "" : ", ") + LuaKey(key) + " = " + LuaLiteral(inner);
    }
  }
  return "{" + out + "}";
}

}  // namespace lararium::drama
