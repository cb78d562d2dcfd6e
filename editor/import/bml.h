#pragma once

// Behaviours of others as items of tracks: the core of the Behavior Markup Language 1.0
// (bml-initiative.org). Its synchronisation is worked out when it is read: tracks have times.

#include <array>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "shared/core/json.h"
#include "shared/core/status.h"
#include "shared/drama/sync_points.h"
#include "shared/drama/timeline_lanes.h"

namespace lararium::import {

inline constexpr size_t kMaxBmlBytes = 4 << 20;

// A line that somebody can say.
struct BmlLine {
  std::vector<std::string> texts;  // in all languages: speech is known by what it says
  drama::SyncTimes times = {};
};

// What behaviours can name, and how long it takes.
struct BmlStage {
  template <typename T>
  using ByName = std::map<std::string, T, std::less<>>;

  ByName<std::string> characters;          // BML's names to actors; "": of blocks that name nobody
  ByName<ByName<drama::SyncTimes>> clips;  // by actor
  ByName<BmlLine> lines;                   // by id
  ByName<std::array<double, 2>> objects;   // where they stand: x, z of the stage
};

struct BmlItem {
  drama::LaneKind lane = drama::LaneKind::kGaze;
  std::string actor;
  Json fields;
};

struct BmlImport {
  std::vector<BmlItem> items;         // by their beginning
  std::vector<std::string> warnings;  // "FILE:LINE: gesture 'g1': ...": what could not be taken
};

// One block, or several in an element around them; those whose composition is APPEND begin
// when the one before has ended, others at begin (seconds of the drama). Errors: no XML, a
// document type (which may hold entities), no <bml>, more than 2000 behaviours. place: what
// messages call the text.
Result<BmlImport> ImportBml(std::string_view text,
                            const std::string& place,
                            const BmlStage& stage,
                            double begin = 0.0);

}  // namespace lararium::import
