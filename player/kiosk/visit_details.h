#pragma once

// How the visits of a day were: how long, where in the drama they ended, in which languages, and
// where on the floor tracking was lost. Each is a count of visits. No entry belongs to one visit.

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "shared/core/json_fields.h"

namespace lararium::player {

// A square of the floor with sides of one metre: its smallest coordinates, metres along the axes of
// a place's stage.
struct FloorCell {
  std::string place;
  int x = 0;
  int z = 0;

  friend auto operator<=>(const FloorCell&, const FloorCell&) = default;
};

struct VisitDetails {
  // Visits that were shorter than each of these minutes and at least as long as the one before;
  // the last count of `lengths` is of longer ones.
  static constexpr std::array<double, 5> kLengthMinutes = {1.0, 2.0, 5.0, 10.0, 20.0};
  static constexpr size_t kMostMinutes = 61;  // The last one stands for all later minutes.
  static constexpr size_t kMostLanguages = 32;
  static constexpr size_t kMostCells = 200;
  static constexpr int kFarthest = 1000;  // metres
  // Smaller counts do not leave the device.
  static constexpr int64_t kLeastTold = 10;

  // Visits by length; empty if there were none.
  std::vector<int64_t> lengths = {};
  // Visits by the minute of the drama in which they ended.
  std::vector<int64_t> ended = {};
  // Visits by the spoken language at their end, and by that of captions ("off": none).
  std::map<std::string, int64_t> languages = {};
  std::map<std::string, int64_t> captions = {};
  // Visits that lost tracking in a square. A visit counts once for each.
  std::map<FloorCell, int64_t> lost = {};

  bool empty() const { return *this == VisitDetails(); }
  friend bool operator==(const VisitDetails&, const VisitDetails&) = default;
};

// Details of which copies share the memory. Statistics of many days are copied on the thread that
// draws, and only one day changes.
class SharedDetails {
 public:
  SharedDetails() = default;
  SharedDetails(VisitDetails details)  // NOLINT: converts on purpose
      : details_(std::make_shared<const VisitDetails>(std::move(details))) {}

  const VisitDetails& operator*() const {
    static const VisitDetails kNone;
    return details_ ? *details_ : kNone;
  }
  const VisitDetails* operator->() const { return &**this; }
  friend bool operator==(const SharedDetails& a, const SharedDetails& b) { return *a == *b; }

 private:
  std::shared_ptr<const VisitDetails> details_;  // nullptr: none.
};

// Summary of one visit, made when it is over.
struct VisitSummary {
  double seconds = 0.0;
  double drama_seconds = 0.0;  // Time of the drama at which it ended.
  std::string language = {};   // Empty: the show has none.
  std::string captions = {};
  std::vector<FloorCell> lost = {};  // Each square is there once.
};
// Counts beyond the limits above are left out.
void AddVisit(const VisitSummary& visit, VisitDetails& details);

// Removes all counts below kLeastTold. Each visit has one length, one end and one language, so a
// count that is missing alone follows from the number of visits; the smallest other one is then
// removed with it.
void RemoveSmallCounts(VisitDetails& details);

// Describes the fields of a day (docs/file-formats.md). All may be missing.
void DescribeFields(Fields& fields, VisitDetails& details);

}  // namespace lararium::player
