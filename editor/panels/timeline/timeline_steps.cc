#include "editor/panels/timeline/timeline_steps.h"

#include <algorithm>
#include <cmath>

namespace lararium::panels {

namespace {

using drama::TimelineItem;

bool CanBeReached(const TimelineLine& line, const TimelineStep& step) {
  return line.shown && (!step.items || line.stops.front().item);
}

const TimelineStop& NearestIn(const TimelineLine& line, double time) {
  return *std::min_element(line.stops.begin(), line.stops.end(),
                           [time](const TimelineStop& a, const TimelineStop& b) {
                             return std::abs(a.at - time) < std::abs(b.at - time);
                           });
}

// Moves to another line; stays where there is none.
TimelineStop StepAcross(std::span<const TimelineLine> lines,
                        size_t line,
                        const TimelineStop& from,
                        const TimelineStep& step) {
  const auto count = static_cast<std::ptrdiff_t>(lines.size());
  const std::ptrdiff_t direction = step.across > 0 ? 1 : -1;
  for (auto next = static_cast<std::ptrdiff_t>(line) + direction; next >= 0 && next < count;
       next += direction) {
    if (CanBeReached(lines[static_cast<size_t>(next)], step)) {
      return NearestIn(lines[static_cast<size_t>(next)], from.at);
    }
  }
  return from;
}

}  // namespace

bool HasStop(const TimelineRow& row, const TimelineStop& stop) {
  return stop.item
             ? std::find(row.lanes.begin(), row.lanes.end(), stop.item->lane) != row.lanes.end()
             : KeyOfGroup(row) == stop.group &&
                   std::find(row.blocks.begin(), row.blocks.end(), stop.block) != row.blocks.end();
}

std::vector<TimelineLine> LinesOf(std::span<const TimelineRow> rows,
                                  const drama::TimelineText& text,
                                  std::span<const drama::TaskRecord> tasks,
                                  const std::set<std::string>& folded) {
  std::vector<TimelineLine> lines;
  for (const TimelineRow& row : rows) {
    TimelineLine line;
    const std::string group = KeyOfGroup(row);
    line.shown = !folded.contains(group);
    for (const size_t lane : row.lanes) {
      for (size_t i = 0; i < text.lanes()[lane].size(); ++i) {
        line.stops.push_back({TimelineItem{lane, i}, 0, group, text.lanes()[lane].at[i]});
      }
    }
    for (const uint32_t block : row.blocks) {
      line.stops.push_back({std::nullopt, block, group, tasks[block].began});
    }
    std::stable_sort(line.stops.begin(), line.stops.end(),
                     [](const TimelineStop& a, const TimelineStop& b) { return a.at < b.at; });
    if (!line.stops.empty()) {
      lines.push_back(std::move(line));
    }
  }
  return lines;
}

std::optional<TimelineStop> StepFrom(std::span<const TimelineLine> lines,
                                     const std::optional<TimelineStop>& chosen,
                                     double time,
                                     const TimelineStep& step) {
  for (size_t line = 0; chosen && line < lines.size(); ++line) {
    const std::vector<TimelineStop>& stops = lines[line].stops;
    const auto at = std::find_if(stops.begin(), stops.end(),
                                 [&](const TimelineStop& stop) { return stop.IsSame(*chosen); });
    if (at == stops.end()) {
      continue;
    }
    if (step.across != 0) {
      return StepAcross(lines, line, *at, step);
    }
    const auto last = static_cast<std::ptrdiff_t>(stops.size()) - 1;
    const std::ptrdiff_t to = std::clamp<std::ptrdiff_t>(at - stops.begin() + step.along, 0, last);
    return stops[static_cast<size_t>(to)];
  }
  const auto first = std::find_if(lines.begin(), lines.end(), [&](const TimelineLine& line) {
    return CanBeReached(line, step);
  });
  return first == lines.end() ? std::nullopt : std::optional(NearestIn(*first, time));
}

void Extend(editor::ItemSet& chosen,
            const std::optional<TimelineItem>& from,
            const TimelineItem& to) {
  if (!editor::Contains(chosen, to)) {
    editor::Toggle(chosen, to);
  } else if (from && *from != to && editor::Contains(chosen, *from)) {
    editor::Toggle(chosen, *from);
  }
}

}  // namespace lararium::panels
