#pragma once

// Imports behaviours of other programs as items of tracks: the core of the Behavior Markup
// Language 1.0 (bml-initiative.org). Synchronisation constraints are resolved to times on
// import.

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

// A line of the project.
struct BmlLine {
  // The text in all languages, because BML identifies speech by its text.
  std::vector<std::string> texts;
  drama::SyncTimes times = {};
};

// What behaviours can refer to, and its timing.
struct BmlStage {
  template <typename T>
  using ByName = std::map<std::string, T, std::less<>>;

  // Actors by BML character; "" applies to blocks without a character.
  ByName<std::string> characters;
  ByName<ByName<drama::SyncTimes>> clips;  // Sync times by actor and clip.
  ByName<BmlLine> lines;                   // Lines by id.
  ByName<std::array<double, 2>> objects;   // Positions on the stage, x and z.
};

struct BmlItem {
  drama::LaneKind lane = drama::LaneKind::kGaze;
  std::string actor;
  Json fields;
};

struct BmlImport {
  std::vector<BmlItem> items;  // Sorted by begin.
  // "FILE:LINE: gesture 'g1': ..." for parts that could not be imported.
  std::vector<std::string> warnings;
};

// Reads one block, or several in an enclosing element. A block with the composition APPEND
// begins when the previous one has ended, others at `begin` (seconds of the drama). The text may be
// in any encoding (editor/text/foreign_text.h). Entities of a document type are not expanded.
// Behaviours whose time cannot be found are left out, with a warning. Errors: invalid XML, no
// <bml>, more than 2000 behaviours. `where` names the text in messages.
Result<BmlImport> ImportBml(std::string_view text,
                            const std::string& where,
                            const BmlStage& stage,
                            double begin = 0.0);

}  // namespace lararium::import
