#include "editor/panels/timeline/timeline_items.h"

#include <algorithm>
#include <utility>

#include "editor/document/timeline_fields.h"
#include "editor/panels/timeline/timeline_labels.h"

namespace lararium::panels {

using drama::TimelineItem;
using drama::TimelineLane;
using drama::TimelineText;

const TimelineItems::Face& TimelineItems::FaceOf(const editor::Workspace& workspace,
                                                 const TimelineItem& item) {
  const auto [entry, is_new] = faces_.try_emplace(uint64_t{item.lane} << 40 | item.item);
  Face& face = entry->second;
  if (!is_new) {
    return face;
  }
  const TimelineText& text = *workspace.project().script().timeline();
  const TimelineLane& lane = text.lanes()[item.lane];
  Json fields = Json::object();
  for (drama::TimelineField& field : text.Fields(item)) {
    fields[field.key] = std::move(field.value);
  }
  face.label = LabelOf(lane.kind, fields);
  face.line = editor::TextOf(fields, "line");
  const editor::DramaRun* run = workspace.dry_run().newest();
  if (run == nullptr || lane.length[item.item] > 0.0) {
    return face;
  }
  face.natural = editor::NaturalSeconds(text, item, *run);
  face.natural = std::min(face.natural, kLongNatural);
  return face;
}

editor::TimeSpan TimelineItems::SpanOf(const editor::Workspace& workspace,
                                       const TimelineItem& item) {
  const TimelineLane& lane = workspace.project().script().timeline()->lanes()[item.lane];
  editor::TimeSpan span{lane.at[item.item], lane.at[item.item] + lane.length[item.item]};
  if (lane.length[item.item] <= 0.0 &&
      drama::SpecOf(lane.kind).duration != drama::ItemDuration::kMoment) {
    span.end = span.begin + FaceOf(workspace, item).natural;
  }
  return span;
}

}  // namespace lararium::panels
