#pragma once

// What the timeline shows of an item, computed when it is first needed.

#include <cstdint>
#include <string>
#include <unordered_map>

#include "editor/check/timeline_edits.h"
#include "editor/session/workspace.h"
#include "shared/drama/timeline_text.h"

namespace lararium::panels {

class TimelineItems {
 public:
  // The longest duration, in seconds, that an item without a length is drawn with.
  static constexpr double kLongNatural = 60.0;

  struct Face {
    std::string label;
    std::string line;      // The spoken line; empty: none.
    double natural = 0.0;  // Seconds that an item without a length lasts; 0: not known.
  };
  // The script must have a timeline with that item. The reference is valid until Clear().
  const Face& FaceOf(const editor::Workspace& workspace, const drama::TimelineItem& item);
  // The time span that an item is drawn with.
  editor::TimeSpan SpanOf(const editor::Workspace& workspace, const drama::TimelineItem& item);
  // Call when the script or the dry run has changed.
  void Clear() { faces_.clear(); }

 private:
  std::unordered_map<uint64_t, Face> faces_;
};

}  // namespace lararium::panels
