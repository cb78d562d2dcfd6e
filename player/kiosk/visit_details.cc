#include "player/kiosk/visit_details.h"

#include <algorithm>
#include <cmath>

namespace lararium::player {
namespace {

constexpr int64_t kMostVisits = 1'000'000'000;
constexpr size_t kMostPlaceName = 64;

void CountAt(size_t index, std::vector<int64_t>& counts) {
  counts.resize(std::max(counts.size(), index + 1));
  ++counts[index];
}

template <typename Key>
void CountFor(const Key& key, size_t most, std::map<Key, int64_t>& counts) {
  if (counts.size() < most || counts.contains(key)) {
    ++counts[key];
  }
}

bool IsSmall(int64_t count) { return count < VisitDetails::kLeastTold; }

// size: number of entries that the list can have. Entries behind its end are zero.
void RemoveSmall(size_t size, std::vector<int64_t>& counts) {
  counts.resize(size);
  size_t missing = 0;
  for (int64_t& count : counts) {
    count = IsSmall(count) ? 0 : count;
    missing += count == 0 ? 1 : 0;
  }
  if (missing == 1) {
    const auto smallest = std::min_element(counts.begin(), counts.end(), [](int64_t a, int64_t b) {
      return a != 0 && (b == 0 || a < b);
    });
    *smallest = 0;
  }
  while (!counts.empty() && counts.back() == 0) {
    counts.pop_back();
  }
}

void RemoveSmall(std::map<std::string, int64_t>& counts) {
  const size_t removed =
      std::erase_if(counts, [](const auto& entry) { return IsSmall(entry.second); });
  if (removed == 1 && !counts.empty()) {
    counts.erase(std::min_element(counts.begin(), counts.end(), [](const auto& a, const auto& b) {
      return a.second < b.second;
    }));
  }
}

void DescribeList(Fields& fields,
                  std::string_view name,
                  size_t most,
                  std::vector<int64_t>& counts) {
  fields.List(
      Optional(name, !counts.empty()), counts, most,
      [&](const FieldKey& key, int64_t& count) { fields.Integer(key, count, 0, kMostVisits); });
}

void DescribeMap(Fields& fields, std::string_view name, std::map<std::string, int64_t>& counts) {
  fields.Entries(Optional(name, !counts.empty()), counts, VisitDetails::kMostLanguages,
                 "must have at most 32 languages", [&](const FieldKey& key, int64_t& count) {
                   fields.Integer(key, count, 0, kMostVisits);
                 });
}

struct CountedCell {
  FloorCell cell;
  int64_t visits = 0;
};

void DescribeCell(Fields& fields, CountedCell& counted) {
  constexpr int kFarthest = VisitDetails::kFarthest;
  fields.Text("place", counted.cell.place, kMostPlaceName);
  fields.Integer("x", counted.cell.x, -kFarthest, kFarthest);
  fields.Integer("z", counted.cell.z, -kFarthest, kFarthest);
  fields.Integer("visits", counted.visits, 0, kMostVisits);
}

}  // namespace

void AddVisit(const VisitSummary& visit, VisitDetails& details) {
  const double minutes = visit.seconds / 60.0;
  const auto& limits = VisitDetails::kLengthMinutes;
  CountAt(
      static_cast<size_t>(std::upper_bound(limits.begin(), limits.end(), minutes) - limits.begin()),
      details.lengths);
  const double last = static_cast<double>(VisitDetails::kMostMinutes - 1);
  CountAt(static_cast<size_t>(std::clamp(std::floor(visit.drama_seconds / 60.0), 0.0, last)),
          details.ended);
  if (!visit.language.empty()) {
    CountFor(visit.language, VisitDetails::kMostLanguages, details.languages);
  }
  if (!visit.captions.empty()) {
    CountFor(visit.captions, VisitDetails::kMostLanguages, details.captions);
  }
  for (const FloorCell& cell : visit.lost) {
    CountFor(cell, VisitDetails::kMostCells, details.lost);
  }
}

void RemoveSmallCounts(VisitDetails& details) {
  RemoveSmall(VisitDetails::kLengthMinutes.size() + 1, details.lengths);
  RemoveSmall(VisitDetails::kMostMinutes, details.ended);
  RemoveSmall(details.languages);
  RemoveSmall(details.captions);
  std::erase_if(details.lost, [](const auto& entry) { return IsSmall(entry.second); });
}

void DescribeFields(Fields& fields, VisitDetails& details) {
  DescribeList(fields, "lengths", VisitDetails::kLengthMinutes.size() + 1, details.lengths);
  DescribeList(fields, "ended", VisitDetails::kMostMinutes, details.ended);
  DescribeMap(fields, "languages", details.languages);
  DescribeMap(fields, "captions", details.captions);
  std::vector<CountedCell> cells;
  for (const auto& [cell, visits] : details.lost) {
    cells.push_back({cell, visits});
  }
  fields.List(Optional("lost", !cells.empty()), cells, VisitDetails::kMostCells, DescribeCell);
  for (const CountedCell& counted : cells) {
    details.lost[counted.cell] = counted.visits;
  }
}

}  // namespace lararium::player
