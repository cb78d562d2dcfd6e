#include "editor/panels/timeline/timeline_new_item.h"

#include <algorithm>

#include "editor/check/drama_run.h"
#include "editor/check/walk_paths.h"
#include "editor/document/line_edits.h"
#include "shared/bundle/show_manifest.h"

namespace lararium::panels {

using drama::LaneKind;

namespace {

// A line of the actor that the timeline does not use yet, otherwise a new one.
std::string LineFor(const editor::Workspace& workspace, const std::string& actor) {
  const bake::LineTable none;
  const auto& table = workspace.document().lines;
  const bake::LineTable& lines = table != nullptr ? *table : none;
  for (const bake::Line& line : lines.lines) {
    const bool named = workspace.script().text().find('"' + line.id + '"') != std::string::npos;
    if (line.speaker == actor && !actor.empty() && !named) {
      return line.id;
    }
  }
  return editor::FreeLineId(lines, actor.empty() ? "text" : actor);
}

// Whether a walk of the timeline gives a person a position by that time.
bool IsPlaced(const drama::TimelineText& text, const std::string& actor, double at) {
  for (size_t lane = 0; lane < text.lanes().size(); ++lane) {
    const drama::TimelineLane& walks = text.lanes()[lane];
    for (size_t i = 0; walks.kind == LaneKind::kWalks && walks.actor == actor && i < walks.size();
         ++i) {
      if (walks.at[i] <= at && editor::WalkPointOf(text, {lane, i}, editor::kWalkFrom)) {
        return true;
      }
    }
  }
  return false;
}

// Whether a person is not on stage by that time, as far as it is known. A walk must then say where
// the person appears.
bool IsYetToAppear(const editor::Workspace& workspace, const std::string& actor, double at) {
  const drama::TimelineText* text = workspace.script().timeline();
  if (text != nullptr && IsPlaced(*text, actor, at)) {
    return false;
  }
  const editor::DramaRun* run = workspace.drama_run();
  if (run == nullptr) {
    return true;
  }
  const auto trail = std::find_if(run->trails.begin(), run->trails.end(),
                                  [&](const editor::Trail& each) { return each.actor == actor; });
  return trail == run->trails.end() || !trail->At(at);
}

}  // namespace

Json NewFields(const editor::Workspace& workspace,
               LaneKind kind,
               const std::string& actor,
               double at) {
  Json fields = {{"at", at}};
  const editor::StageWords none;
  const editor::StageWords& words =
      workspace.drama_run() != nullptr ? workspace.drama_run()->words : none;
  const auto first = [](const auto& list, const char* otherwise) {
    return list.empty() ? std::string(otherwise) : list.front().name;
  };
  switch (kind) {
    case LaneKind::kSpeech:
    case LaneKind::kCaptions:
      fields["line"] = LineFor(workspace, actor);
      break;
    case LaneKind::kDescriptions:
      fields["line"] = LineFor(workspace, bundle::LineEntry::kDescription);
      break;
    case LaneKind::kGestures:
    case LaneKind::kClips: {
      const editor::StageWords::Person* person = words.FindPerson(actor);
      fields["clip"] = person != nullptr ? first(person->clips, "idle") : "idle";
      if (kind == LaneKind::kClips) {
        fields["length"] = 2.0;
      }
      break;
    }
    case LaneKind::kWalks:
      fields["to"] = {{"x", 0.0}, {"z", -1.0}};
      if (IsYetToAppear(workspace, actor, at)) {
        fields["from"] = {{"x", -1.0}, {"z", -1.0}, {"heading", -90.0}};  // Facing the destination.
      }
      break;
    case LaneKind::kUses:
      fields["object"] = first(words.things, "object");
      break;
    case LaneKind::kGaze:
      fields["target"] = "visitor";
      fields["length"] = 3.0;
      break;
    case LaneKind::kExpressions:
      fields["expression"] = "joy";
      fields["intensity"] = 0.7;
      fields["length"] = 3.0;
      break;
    case LaneKind::kLights: {
      fields["light"] = "lamp";
      for (const editor::StageWords::Thing& thing : words.things) {
        if (thing.burns) {
          fields["light"] = thing.name;
          break;
        }
      }
      fields["level"] = 0.5;
      fields["length"] = 3.0;
      break;
    }
    case LaneKind::kSounds:
      fields["sound"] = words.sounds.empty() ? "bell" : words.sounds.front();
      break;
    case LaneKind::kMarkers:
      fields["name"] = "marker";
      break;
  }
  return fields;
}

}  // namespace lararium::panels
