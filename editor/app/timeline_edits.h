#pragma once

// What the hand does to items of the timeline, as changes of its text. Each fails without
// having said anything of the text: whoever calls it works on a copy (ScriptDocument::Change).

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "editor/app/drama_run.h"
#include "shared/core/json.h"
#include "shared/core/status.h"
#include "shared/drama/timeline_text.h"

namespace lararium::app {

// Items that are chosen: sorted, each once.
using ItemSet = std::vector<drama::TimelineItem>;
bool Contains(const ItemSet& items, const drama::TimelineItem& item);
void Toggle(ItemSet& items, const drama::TimelineItem& item);
// Drops items that are not there any more.
void KeepValid(const drama::TimelineText& text, ItemSet& items);

// When the first begins and the last ends.
struct TimeSpan {
  double begin = 0.0;
  double end = 0.0;
};
TimeSpan SpanOf(const drama::TimelineText& text, const ItemSet& items);

// The movement nearest to one that was asked for that items can make: none begins before
// zero, and clips, which lead a whole body, do not run into those that stay.
// with_later: all that begins later moves along (ripple).
double ClampMove(const drama::TimelineText& text,
                 const ItemSet& items,
                 double seconds,
                 bool with_later);
Status MoveItems(drama::TimelineText& text, const ItemSet& items, double seconds, bool with_later);

// Moves where they begin, or end, and the other end stays. Lengths are at least kShortest.
inline constexpr double kShortest = 0.05;  // seconds
// natural: how long items last that say no length; of each item.
Status TrimBegins(drama::TimelineText& text,
                  const ItemSet& items,
                  std::span<const double> natural,
                  double seconds);
Status TrimEnds(drama::TimelineText& text,
                const ItemSet& items,
                std::span<const double> natural,
                double seconds,
                bool with_later);

// How long an item that says no length lasts, by a run of the drama: its line, its gesture, or what
// it came to when it was played; 0: that is not known.
double NaturalSeconds(const drama::TimelineText& text,
                      const drama::TimelineItem& item,
                      const DramaRun& run);

// with_later: the gap closes.
Status DeleteItems(drama::TimelineText& text, const ItemSet& items, bool with_later);

// What is copied: lanes and fields, with times from the first of them.
struct CopiedItem {
  drama::LaneKind lane = drama::LaneKind::kMarkers;
  std::string actor;
  Json fields;
};
std::vector<CopiedItem> CopyItems(const drama::TimelineText& text, const ItemSet& items);
// As text for the clipboard, and back; nullopt: something else is in there.
std::string FormatCopied(std::span<const CopiedItem> items);
std::optional<std::vector<CopiedItem>> ParseCopied(std::string_view text);
// inserted: gets the new items. Lanes that are missing are added; ids stay unique.
Status PasteItems(drama::TimelineText& text,
                  std::span<const CopiedItem> items,
                  double at,
                  ItemSet& inserted);

// One item; its lane is added where there is none.
Status AddItem(drama::TimelineText& text,
               drama::LaneKind kind,
               const std::string& actor,
               Json fields,
               ItemSet& inserted);

}  // namespace lararium::app
