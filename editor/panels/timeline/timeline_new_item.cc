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
  const auto& table = workspace.project().document().lines;
  const bake::LineTable& lines = table != nullptr ? *table : none;
  for (const bake::Line& line : lines.lines) {
    const bool named =
        workspace.project().script().text().find('"' + line.id + '"') != std::string::npos;
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
  const drama::TimelineText* text = workspace.project().script().timeline();
  if (text != nullptr && IsPlaced(*text, actor, at)) {
    return false;
  }
  const editor::DramaRun* run = workspace.dry_run().newest();
  if (run == nullptr) {
    return true;
  }
  const auto trail = std::find_if(run->trails.begin(), run->trails.end(),
                                  [&](const editor::Trail& each) { return each.actor == actor; });
  return trail == run->trails.end() || !trail->At(at);
}

// The value of a field in a new item; null: the field is left out.
Json InitialValue(const editor::Workspace& workspace,
                  const editor::StageWords& words,
                  const drama::LaneSpec& lane,
                  const drama::LaneField& field,
                  const std::string& actor) {
  if (field.role == drama::FieldRole::kLine) {
    return LineFor(workspace, lane.line == drama::LineUse::kDescription
                                  ? bundle::LineEntry::kDescription
                                  : actor);
  }
  if (field.initial.is_null()) {
    return field.initial;
  }
  if (field.role == drama::FieldRole::kSound && !words.sounds.empty()) {
    return words.sounds.front();
  }
  const editor::StageWords::Person* person = words.FindPerson(actor);
  if (field.role == drama::FieldRole::kClip && person != nullptr && !person->clips.empty()) {
    return person->clips.front().name;
  }
  for (const editor::StageWords::Thing& thing : words.things) {
    if (field.role == drama::FieldRole::kObject ||
        (field.role == drama::FieldRole::kLamp && thing.burns)) {
      return thing.name;
    }
  }
  return field.initial;
}

}  // namespace

Json NewFields(const editor::Workspace& workspace,
               LaneKind kind,
               const std::string& actor,
               double at) {
  const editor::StageWords none;
  const editor::StageWords& words =
      workspace.dry_run().newest() != nullptr ? workspace.dry_run().newest()->words : none;
  const drama::LaneSpec& lane = drama::SpecOf(kind);
  Json fields = {{"at", at}};
  if (lane.new_length > 0.0) {
    fields["length"] = lane.new_length;
  }
  for (const drama::LaneField& field : lane.fields) {
    Json value = InitialValue(workspace, words, lane, field, actor);
    const bool entrance = field.role == drama::FieldRole::kEntrance;
    if (!value.is_null() && (!entrance || IsYetToAppear(workspace, actor, at))) {
      fields[field.key] = std::move(value);
    }
  }
  return fields;
}

}  // namespace lararium::panels
