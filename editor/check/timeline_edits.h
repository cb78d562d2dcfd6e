#pragma once

// Edits of timeline items as changes of the text of the script. A failed edit may leave the
// text partly changed, so callers work on a copy (ScriptDocument::Change).

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "editor/check/drama_run.h"
#include "shared/core/json.h"
#include "shared/core/status.h"
#include "shared/drama/timeline_text.h"

namespace lararium::editor {

// Selected items, sorted and unique.
using ItemSet = std::vector<drama::TimelineItem>;
bool Contains(const ItemSet& items, const drama::TimelineItem& item);
void Toggle(ItemSet& items, const drama::TimelineItem& item);
// Removes items that no longer exist.
void KeepValid(const drama::TimelineText& text, ItemSet& items);

// The begin of the first item and the end of the last.
struct TimeSpan {
  double begin = 0.0;
  double end = 0.0;
};
TimeSpan SpanOf(const drama::TimelineText& text, const ItemSet& items);

// The possible movement nearest to `seconds`: no item begins before zero, and clips, which use
// the whole body, do not overlap clips that stay. `with_later` moves all later items along
// (ripple).
double ClampMove(const drama::TimelineText& text,
                 const ItemSet& items,
                 double seconds,
                 bool with_later);
Status MoveItems(drama::TimelineText& text, const ItemSet& items, double seconds, bool with_later);

// Moves the begin or the end of items; the other end stays. Lengths are at least kShortest.
inline constexpr double kShortest = 0.05;  // seconds
// `natural` holds, for each item, its duration if it does not state one.
Status TrimBegins(drama::TimelineText& text,
                  const ItemSet& items,
                  std::span<const double> natural,
                  double seconds);
Status TrimEnds(drama::TimelineText& text,
                const ItemSet& items,
                std::span<const double> natural,
                double seconds,
                bool with_later);

// Duration of an item that states none, from a run of the drama: that of its line, of its
// gesture, or of its task; 0 if it is unknown.
double NaturalSeconds(const drama::TimelineText& text,
                      const drama::TimelineItem& item,
                      const DramaRun& run);

// `with_later` closes the gap.
Status DeleteItems(drama::TimelineText& text, const ItemSet& items, bool with_later);

// A copied item: its lane and fields, with times relative to the first copied item.
struct CopiedItem {
  drama::LaneKind lane = drama::LaneKind::kMarkers;
  std::string actor;
  Json fields;
};
std::vector<CopiedItem> CopyItems(const drama::TimelineText& text, const ItemSet& items);
// Converts to text for the clipboard and back; nullopt if the text is something else.
std::string FormatCopied(std::span<const CopiedItem> items);
std::optional<std::vector<CopiedItem>> ParseCopied(std::string_view text);
// `inserted` gets the new items. Missing lanes are added; ids stay unique.
Status PasteItems(drama::TimelineText& text,
                  std::span<const CopiedItem> items,
                  double at,
                  ItemSet& inserted);

// Adds one item, and its lane if it is missing.
Status AddItem(drama::TimelineText& text,
               drama::LaneKind kind,
               const std::string& actor,
               Json fields,
               ItemSet& inserted);

}  // namespace lararium::editor
