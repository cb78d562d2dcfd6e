#include "editor/check/timeline_edits.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

namespace lararium::editor {

using drama::LaneKind;
using drama::TimelineChange;
using drama::TimelineItem;
using drama::TimelineLane;
using drama::TimelineText;

namespace {

// Rounds to milliseconds, the resolution in which times are written.
double Rounded(double seconds) { return std::round(seconds * 1000.0) / 1000.0; }

double At(const TimelineText& text, const TimelineItem& item) {
  return text.lanes()[item.lane].at[item.item];
}
double LengthOf(const TimelineText& text, const TimelineItem& item) {
  return text.lanes()[item.lane].length[item.item];
}

ItemSet All(const TimelineText& text) {
  ItemSet all;
  for (size_t lane = 0; lane < text.lanes().size(); ++lane) {
    for (size_t item = 0; item < text.lanes()[lane].size(); ++item) {
      all.push_back({lane, item});
    }
  }
  return all;
}

// The items, and all that begin at `from` or later.
ItemSet WithLater(const TimelineText& text, const ItemSet& items, double from) {
  ItemSet moved = All(text);
  std::erase_if(moved, [&](const TimelineItem& item) {
    return At(text, item) < from - 1e-9 && !Contains(items, item);
  });
  return moved;
}

// Limits the movement of clips to the gaps before and after those that stay.
void ClampToNeighbours(const TimelineLane& lane,
                       const std::vector<uint8_t>& moves,
                       double& least,
                       double& most) {
  for (size_t i = 0; i < lane.size(); ++i) {
    if (moves[i] == 0) {
      continue;
    }
    const double end = lane.at[i] + lane.length[i];
    if (i > 0 && moves[i - 1] == 0) {
      least = std::max(least, lane.at[i - 1] + lane.length[i - 1] - lane.at[i]);
    }
    if (i + 1 < lane.size() && moves[i + 1] == 0) {
      most = std::min(most, lane.at[i + 1] - end);
    }
  }
}

Status Shift(TimelineText& text, const ItemSet& items, double seconds) {
  std::vector<TimelineChange> changes;
  changes.reserve(items.size());
  for (const TimelineItem& item : items) {
    changes.push_back({item, "at", Rounded(std::max(At(text, item) + seconds, 0.0))});
  }
  return text.SetAll(changes).status();
}

double LengthOr(const TimelineText& text, const TimelineItem& item, double natural) {
  const double length = LengthOf(text, item);
  return length > 0.0 ? length : natural;
}

std::string TextField(const TimelineText& text, const TimelineItem& item, std::string_view key) {
  const std::optional<Json> value = text.Field(item, key);
  return value && value->is_string() ? value->get<std::string>() : "";
}

// The duration of the task of an item in the run; 0 if it is unknown.
double PlayedSeconds(std::span<const drama::TaskRecord> tasks,
                     const TimelineLane& lane,
                     double at) {
  constexpr double kLate = 0.05;  // Seconds, because a task begins with a tick.
  auto task =
      std::lower_bound(tasks.begin(), tasks.end(), at - 1e-6,
                       [](const drama::TaskRecord& t, double time) { return t.began < time; });
  for (; task != tasks.end() && task->began <= at + kLate; ++task) {
    if (task->from_timeline && task->actor == lane.actor &&
        drama::LaneOfTask(task->action) == lane.kind) {
      return task->ended - task->began;
    }
  }
  return 0.0;
}

// Finds the lane of this kind and actor, or adds it.
Result<size_t> LaneFor(TimelineText& text, LaneKind kind, const std::string& actor) {
  const auto find = [&]() -> size_t {
    for (size_t i = 0; i < text.lanes().size(); ++i) {
      if (text.lanes()[i].kind == kind && text.lanes()[i].actor == actor) {
        return i;
      }
    }
    return text.lanes().size();
  };
  if (find() == text.lanes().size()) {
    LARARIUM_RETURN_IF_ERROR(text.AddLane(kind, actor).status());
  }
  const size_t lane = find();
  return lane < text.lanes().size()
             ? Result<size_t>(lane)
             : Status::Error(text.place(), "the lane was not added", "look at the script");
}

std::set<std::string> Ids(const TimelineText& text) {
  std::set<std::string> ids;
  for (const TimelineItem& item : All(text)) {
    const std::optional<Json> id = text.Field(item, "id");
    if (id && id->is_string()) {
      ids.insert(id->get<std::string>());
    }
  }
  return ids;
}

// "greeting" becomes "greeting 2".
std::string UniqueId(const std::string& wanted, std::set<std::string>& taken) {
  std::string stem = wanted;
  while (!stem.empty() && stem.back() >= '0' && stem.back() <= '9') {
    stem.pop_back();
  }
  while (!stem.empty() && stem.back() == ' ') {
    stem.pop_back();
  }
  std::string id = wanted;
  for (int number = 2; taken.contains(id); ++number) {
    id = stem + ' ' + std::to_string(number);
  }
  taken.insert(id);
  return id;
}

// The index at which TimelineText::Insert puts an item.
size_t PlaceFor(const TimelineLane& lane, double at) {
  size_t place = 0;
  for (size_t i = 0; i < lane.size(); ++i) {
    place = lane.at[i] <= at ? i + 1 : place;
  }
  return place;
}

Status InsertInto(TimelineText& text, size_t lane, const Json& fields, ItemSet& inserted) {
  const size_t place = PlaceFor(text.lanes()[lane], fields["at"].get<double>());
  LARARIUM_RETURN_IF_ERROR(text.Insert(lane, fields).status());
  for (TimelineItem& other : inserted) {
    other.item += other.lane == lane && other.item >= place ? 1 : 0;
  }
  inserted.push_back({lane, place});
  std::sort(inserted.begin(), inserted.end());
  return Status();
}

}  // namespace

bool Contains(const ItemSet& items, const TimelineItem& item) {
  return std::binary_search(items.begin(), items.end(), item);
}

void Toggle(ItemSet& items, const TimelineItem& item) {
  const auto at = std::lower_bound(items.begin(), items.end(), item);
  if (at != items.end() && *at == item) {
    items.erase(at);
  } else {
    items.insert(at, item);
  }
}

void KeepValid(const TimelineText& text, ItemSet& items) {
  std::erase_if(items, [&](const TimelineItem& item) {
    return item.lane >= text.lanes().size() || item.item >= text.lanes()[item.lane].size();
  });
}

TimeSpan SpanOf(const TimelineText& text, const ItemSet& items) {
  TimeSpan span{items.empty() ? 0.0 : std::numeric_limits<double>::max(), 0.0};
  for (const TimelineItem& item : items) {
    span.begin = std::min(span.begin, At(text, item));
    span.end = std::max(span.end, At(text, item) + LengthOf(text, item));
  }
  return span;
}

double ClampMove(const TimelineText& text, const ItemSet& items, double seconds, bool with_later) {
  const double begin = SpanOf(text, items).begin;
  const ItemSet moved = with_later ? WithLater(text, items, begin) : items;
  double least = -begin;
  double most = std::numeric_limits<double>::max();
  std::vector<uint8_t> moves;
  for (size_t lane = 0; lane < text.lanes().size(); ++lane) {
    if (!drama::SpecOf(text.lanes()[lane].kind).leads_body) {
      continue;
    }
    moves.assign(text.lanes()[lane].size(), 0);
    for (const TimelineItem& item : moved) {
      if (item.lane == lane) {
        moves[item.item] = 1;
      }
    }
    ClampToNeighbours(text.lanes()[lane], moves, least, most);
  }
  return std::min(std::max(seconds, least), std::max(most, 0.0));
}

Status MoveItems(TimelineText& text, const ItemSet& items, double seconds, bool with_later) {
  const double by = ClampMove(text, items, seconds, with_later);
  return Shift(text, with_later ? WithLater(text, items, SpanOf(text, items).begin) : items, by);
}

Status TrimBegins(TimelineText& text,
                  const ItemSet& items,
                  std::span<const double> natural,
                  double seconds) {
  std::vector<TimelineChange> changes;
  for (size_t i = 0; i < items.size(); ++i) {
    const double length = LengthOr(text, items[i], natural[i]);
    const double at = At(text, items[i]);
    const double by = std::clamp(seconds, -at, std::max(length - kShortest, 0.0));
    changes.push_back({items[i], "at", Rounded(at + by)});
    changes.push_back({items[i], "length", Rounded(length - by)});
  }
  return text.SetAll(changes).status();
}

Status TrimEnds(TimelineText& text,
                const ItemSet& items,
                std::span<const double> natural,
                double seconds,
                bool with_later) {
  std::vector<TimelineChange> changes;
  double end = 0.0;
  for (size_t i = 0; i < items.size(); ++i) {
    const double length = LengthOr(text, items[i], natural[i]);
    end = std::max(end, At(text, items[i]) + length);
    changes.push_back({items[i], "length", Rounded(std::max(length + seconds, kShortest))});
  }
  if (with_later) {
    for (const TimelineItem& item : WithLater(text, {}, end)) {
      if (!Contains(items, item)) {
        changes.push_back({item, "at", Rounded(std::max(At(text, item) + seconds, 0.0))});
      }
    }
  }
  return text.SetAll(changes).status();
}

double NaturalSeconds(const TimelineText& text, const TimelineItem& item, const DramaRun& run) {
  const TimelineLane& lane = text.lanes()[item.lane];
  const drama::LaneSpec& spec = drama::SpecOf(lane.kind);
  const std::string content = TextField(text, item, spec.content);
  switch (spec.duration) {
    case drama::ItemDuration::kLine: {
      const StageWords::Line* known = run.words.FindLine(content);
      return known != nullptr ? known->seconds : 0.0;
    }
    case drama::ItemDuration::kClip:
      return run.words.ClipSeconds(lane.actor, content);
    case drama::ItemDuration::kTask:
      return PlayedSeconds(run.tasks, lane, lane.at[item.item]);
    case drama::ItemDuration::kNothing:
    case drama::ItemDuration::kMoment:
      break;
  }
  return 0.0;
}

Status DeleteItems(TimelineText& text, const ItemSet& items, bool with_later) {
  const TimeSpan span = SpanOf(text, items);
  for (auto item = items.rbegin(); item != items.rend(); ++item) {
    LARARIUM_RETURN_IF_ERROR(text.Remove(*item).status());
  }
  if (!with_later || items.empty()) {
    return Status();
  }
  return Shift(text, WithLater(text, {}, span.end), span.begin - span.end);
}

std::vector<CopiedItem> CopyItems(const TimelineText& text, const ItemSet& items) {
  std::vector<CopiedItem> copied;
  const double begin = SpanOf(text, items).begin;
  for (const TimelineItem& item : items) {
    const TimelineLane& lane = text.lanes()[item.lane];
    CopiedItem copy{lane.kind, lane.actor, Json::object()};
    for (drama::TimelineField& field : text.Fields(item)) {
      copy.fields[field.key] = std::move(field.value);
    }
    copy.fields["at"] = Rounded(lane.at[item.item] - begin);
    copied.push_back(std::move(copy));
  }
  return copied;
}

std::string FormatCopied(std::span<const CopiedItem> items) {
  Json list = Json::array();
  for (const CopiedItem& item : items) {
    list.push_back(
        {{"lane", drama::NameOf(item.lane)}, {"actor", item.actor}, {"item", item.fields}});
  }
  return DumpJson(Json{{"lararium_timeline", list}}, 1);
}

std::optional<std::vector<CopiedItem>> ParseCopied(std::string_view text) {
  const Result<Json> json = ParseJson(text, "clipboard");
  if (!json.ok() || !json->is_object() || !json->contains("lararium_timeline")) {
    return std::nullopt;
  }
  const auto list = JsonView((*json)["lararium_timeline"], "clipboard").Array(1'000'000);
  if (!list.ok()) {
    return std::nullopt;
  }
  std::vector<CopiedItem> items;
  for (const JsonView& entry : *list) {
    const Result<std::string> lane = entry.Text("lane");
    const Result<std::string> actor = entry.Text("actor");
    const Result<JsonView> fields = entry.Field("item");
    const auto kind = lane.ok() ? drama::LaneNamed(*lane) : std::nullopt;
    if (!kind || !actor.ok() || !fields.ok() || !fields->json().is_object() ||
        !fields->Number("at", 0.0, 1e6).ok()) {
      return std::nullopt;
    }
    items.push_back({*kind, *actor, fields->json()});
  }
  return items;
}

Status PasteItems(TimelineText& text,
                  std::span<const CopiedItem> items,
                  double at,
                  ItemSet& inserted) {
  inserted.clear();
  std::set<std::string> ids = Ids(text);
  for (const CopiedItem& item : items) {
    LARARIUM_ASSIGN_OR_RETURN(const size_t lane, LaneFor(text, item.lane, item.actor));
    Json fields = item.fields;
    fields["at"] = Rounded(fields["at"].get<double>() + std::max(at, 0.0));
    if (const auto id = fields.find("id"); id != fields.end() && id->is_string()) {
      *id = UniqueId(id->get<std::string>(), ids);
    }
    LARARIUM_RETURN_IF_ERROR(InsertInto(text, lane, fields, inserted));
  }
  return Status();
}

Status AddItem(
    TimelineText& text, LaneKind kind, const std::string& actor, Json fields, ItemSet& inserted) {
  const CopiedItem item{kind, actor, std::move(fields)};
  return PasteItems(text, {&item, 1}, 0.0, inserted);
}

}  // namespace lararium::editor
