#include "editor/panels/inspector/timeline_inspector.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "editor/document/line_edits.h"
#include "editor/panels/timeline/timeline_draw.h"
#include "editor/panels/timeline/timeline_maths.h"
#include "editor/panels/timeline/timeline_rows.h"
#include "editor/panels/widgets/text.h"
#include "editor/panels/widgets/theme.h"
#include "editor/panels/widgets/widgets.h"
#include "editor/panels/widgets/wrapped_field.h"
#include "shared/bundle/show_manifest.h"
#include "shared/human/face.h"
#include "shared/stage/caption_file.h"

namespace lararium::panels {

using drama::LaneKind;
using drama::TimelineItem;

namespace {

// The item that is shown, with its present fields.
struct Item {
  editor::Workspace& workspace;
  std::string& new_language;
  TimelineItem at;
  LaneKind kind = LaneKind::kMarkers;
  std::string actor;
  std::vector<drama::TimelineField> fields = {};

  const Json* Find(const std::string& key) const {
    const auto found = std::find_if(fields.rbegin(), fields.rend(),
                                    [&](const auto& field) { return field.key == key; });
    return found == fields.rend() ? nullptr : &found->value;
  }
  std::string TextOr(const std::string& key, const std::string& otherwise) const {
    const Json* value = Find(key);
    return value != nullptr && value->is_string() ? value->get<std::string>() : otherwise;
  }
  double NumberOr(const std::string& key, double otherwise) const {
    const Json* value = Find(key);
    return value != nullptr && value->is_number() ? value->get<double>() : otherwise;
  }
  void Set(const std::string& key, const Json& value) {
    workspace.project().EditTimeline(
        Sentence("set %s", {key}),
        [&](drama::TimelineText& text) { return text.Set(at, key, value).status(); },
        "timeline field " + key + std::to_string(at.lane) + "." + std::to_string(at.item));
  }
  void Unset(const std::string& key) {
    workspace.project().EditTimeline(Sentence("clear %s", {key}), [&](drama::TimelineText& text) {
      return text.Unset(at, key).status();
    });
  }
};

// Draws a button beside a value that removes it.
void ClearButton(Item& item, const std::string& key) {
  ImGui::SameLine();
  if (ImGui::Button("\xc3\x97", ImVec2(ImGui::GetFrameHeight(), 0))) {
    item.Unset(key);
    item.workspace.project().EndGesture();
  }
  Tooltip(Tr("Without it"));
}
float WidthBesideClearButton() {
  return ImGui::GetContentRegionAvail().x - ImGui::GetFrameHeight() - Px(8);
}

void NumberField(Item& item, const drama::LaneField& field) {
  double value = item.NumberOr(field.key, field.fallback);
  const bool is_optional = field.missing != nullptr;
  const bool has_value = item.Find(field.key) != nullptr;
  PropertyLabel(Tr(field.label));
  ImGui::PushID(field.key);
  if (is_optional && has_value) {
    ImGui::SetNextItemWidth(WidthBesideClearButton());
  }
  if (DragNumber(value, field.step, &field.least, &field.most,
                 is_optional && !has_value ? Tr(field.missing) : field.format)) {
    item.Set(field.key, std::round(value * 1000.0) / 1000.0);
  }
  EndGestureWithItem(item.workspace);
  if (is_optional && has_value) {
    ClearButton(item, field.key);
  }
  ImGui::PopID();
}

void TextField(Item& item, const char* label, const std::string& key) {
  PropertyLabel(label);
  std::string value = item.TextOr(key, "");
  ImGui::PushID(key.c_str());
  if (ImGui::InputText("##text", &value)) {
    if (value.empty()) {
      item.Unset(key);
    } else {
      item.Set(key, value);
    }
  }
  EndGestureWithItem(item.workspace);
  ImGui::PopID();
}

// A choice from a list of names, or a text field where the list is empty.
void NameField(Item& item,
               const char* label,
               const std::string& key,
               std::vector<std::string> names,
               const char* none) {
  const std::string value = item.TextOr(key, "");
  if (names.empty()) {
    TextField(item, label, key);
    return;
  }
  PropertyLabel(label);
  std::string chosen = value;
  if (NameCombo(("##" + key).c_str(), chosen, names, none)) {
    if (chosen.empty()) {
      item.Unset(key);
    } else {
      item.Set(key, chosen);
    }
    item.workspace.project().EndGesture();
  }
}

void BoolField(Item& item, const char* label, const std::string& key) {
  const Json* value = item.Find(key);
  bool on = value != nullptr && value->is_boolean() && value->get<bool>();
  PropertyLabel(label);
  ImGui::PushID(key.c_str());
  if (ImGui::Checkbox("##on", &on)) {
    if (on) {
      item.Set(key, true);
    } else {
      item.Unset(key);
    }
    item.workspace.project().EndGesture();
  }
  ImGui::PopID();
}

// A colour, {red, green, blue}.
void ColourField(Item& item, const drama::LaneField& field) {
  const Json* value = item.Find(field.key);
  PropertyLabel(Tr(field.label));
  ImGui::PushID(field.key);
  if (value == nullptr || !drama::ProblemOf(field, *value).empty()) {
    if (ImGui::Button(Tr("Set"))) {
      item.Set(field.key, Json::array({1.0, 1.0, 1.0}));
      item.workspace.project().EndGesture();
    }
    ImGui::PopID();
    return;
  }
  auto colour = value->get<std::array<double, 3>>();
  ImGui::SetNextItemWidth(WidthBesideClearButton());
  if (ImGui::DragScalarN("##colour", ImGuiDataType_Double, colour.data(), 3, 0.01f, &field.least,
                         &field.most, "%.2f", ImGuiSliderFlags_AlwaysClamp)) {
    for (double& channel : colour) {
      channel = std::round(channel * 1000.0) / 1000.0;
    }
    item.Set(field.key, colour);
  }
  EndGestureWithItem(item.workspace);
  ClearButton(item, field.key);
  ImGui::PopID();
}

// A point on the floor, {x =, z =, heading =}.
void PointField(Item& item, const char* label, const std::string& key) {
  const Json* value = item.Find(key);
  Json point = value != nullptr && value->is_object() ? *value : Json::object();
  PropertyLabel(label);
  ImGui::PushID(key.c_str());
  if (point.empty()) {
    if (ImGui::Button(Tr("Set"))) {
      item.Set(key, {{"x", 0.0}, {"z", 0.0}});
      item.workspace.project().EndGesture();
    }
    ImGui::PopID();
    return;
  }
  std::array<double, 2> place = {point.value("x", 0.0), point.value("z", 0.0)};
  ImGui::SetNextItemWidth(WidthBesideClearButton());
  if (ImGui::DragScalarN("##place", ImGuiDataType_Double, place.data(), 2, 0.01f, nullptr, nullptr,
                         "%.2f m")) {
    point["x"] = std::round(place[0] * 1000.0) / 1000.0;
    point["z"] = std::round(place[1] * 1000.0) / 1000.0;
    item.Set(key, point);
  }
  EndGestureWithItem(item.workspace);
  ClearButton(item, key);
  double heading = point.value("heading", 0.0);
  ImGui::SetNextItemWidth(-FLT_MIN);
  if (ImGui::DragScalar("##heading", ImGuiDataType_Double, &heading, 1.0f, nullptr, nullptr,
                        "%.0f\xc2\xb0")) {
    point["heading"] = std::round(heading * 10.0) / 10.0;
    item.Set(key, point);
  }
  EndGestureWithItem(item.workspace);
  ImGui::PopID();
}

const editor::StageWords* WordsOf(const editor::Workspace& workspace) {
  return workspace.dry_run().newest() != nullptr ? &workspace.dry_run().newest()->words : nullptr;
}

template <typename List>
std::vector<std::string> Names(const List& list) {
  std::vector<std::string> names;
  for (const auto& entry : list) {
    names.push_back(entry.name);
  }
  return names;
}

std::vector<std::string> ExpressionNames() {
  std::vector<std::string> names;
  for (int i = 0; i < human::kExpressionCount; ++i) {
    names.emplace_back(human::NameOf(static_cast<human::Expression>(i)));
  }
  return names;
}

std::vector<std::string> ClipNames(const Item& item) {
  const editor::StageWords* words = WordsOf(item.workspace);
  const editor::StageWords::Person* person =
      words != nullptr ? words->FindPerson(item.actor) : nullptr;
  return person != nullptr ? Names(person->clips) : std::vector<std::string>();
}

std::vector<std::string> ThingNames(const editor::Workspace& workspace, bool burning) {
  std::vector<std::string> names;
  if (const editor::StageWords* words = WordsOf(workspace)) {
    for (const editor::StageWords::Thing& thing : words->things) {
      if (!burning || thing.burns) {
        names.push_back(thing.name);
      }
    }
  }
  return names;
}

std::vector<std::string> PeopleNames(const editor::Workspace& workspace) {
  return Names(workspace.project().document().cast);
}

std::vector<std::string> TargetNames(const editor::Workspace& workspace) {
  std::vector<std::string> names = {"visitor"};
  for (const std::string& name : PeopleNames(workspace)) {
    names.push_back(name);
  }
  for (const std::string& name : ThingNames(workspace, false)) {
    names.push_back(name);
  }
  return names;
}

// The values that a text field can have; empty: any text.
std::vector<std::string> ChoicesOf(const Item& item, const drama::LaneField& field) {
  using enum drama::FieldRole;
  const editor::StageWords* words = WordsOf(item.workspace);
  const auto thing = [&](const char* key) {
    return words != nullptr ? words->FindThing(item.TextOr(key, "")) : nullptr;
  };
  switch (field.role) {
    case kClip:
      return ClipNames(item);
    case kObject:
      return ThingNames(item.workspace, false);
    case kLamp:
      return ThingNames(item.workspace, true);
    case kActor:
      return PeopleNames(item.workspace);
    case kTarget:
      return TargetNames(item.workspace);
    case kExpression:
      return ExpressionNames();
    case kSound:
      return words != nullptr ? words->sounds : std::vector<std::string>();
    case kSurface:
      return thing("on") != nullptr ? thing("on")->surfaces : std::vector<std::string>();
    case kAction: {
      std::vector<std::string> actions;
      if (thing("object") != nullptr) {
        actions = thing("object")->actions;
        actions.insert(actions.end(), {"take", "put", "give"});
      }
      actions.emplace_back("stand");
      return actions;
    }
    case kNone:
    case kLine:
    case kEntrance:
      break;
  }
  return {field.choices.begin(), field.choices.end()};
}

// The speaker of lines for this item.
std::string SpeakerOf(const Item& item) {
  return drama::SpecOf(item.kind).line == drama::LineUse::kDescription
             ? bundle::LineEntry::kDescription
             : item.actor;
}

// The text of the line in one language.
void LineText(Item& item, const bake::LineTable& table, const std::string& language) {
  const std::string id = item.TextOr("line", "");
  const bake::Line* line = table.Find(id);
  std::string text;
  if (line != nullptr && line->text.contains(language)) {
    text = line->text.find(language)->second;
  }
  PropertyLabel(language.c_str());
  ImGui::PushID(language.c_str());
  if (WrappedField("says", text, 2, 6)) {
    item.workspace.project().EditLines(Sentence("write %s", {id}),
                                       editor::WithText(table, id, SpeakerOf(item), language, text),
                                       "line " + id + " " + language);
  }
  EndGestureWithItem(item.workspace);
  ImGui::PopID();
}

// A field for the tag of a new language; Enter adds it.
void NewLanguage(Item& item, const bake::LineTable& table) {
  std::string& tag = item.new_language;
  PropertyLabel(Tr("Language"));
  ImGui::InputTextWithHint("##language", Tr("la, it, en: then Enter"), &tag);
  if (ImGui::IsItemDeactivatedAfterEdit() && stage::IsLanguageTag(tag)) {
    bake::LineTable next = editor::WithLanguage(table, tag);
    if (next != table) {
      item.workspace.project().EditLines(Sentence("add the language %s", {tag}), std::move(next));
    }
    tag.clear();
  }
}

// The choice of the line, and its text in each language.
void LineFields(Item& item) {
  const auto table = item.workspace.project().document().lines;  // Kept alive during the edit.
  if (table == nullptr) {
    TextField(item, Tr("Line"), "line");
    return;
  }
  std::vector<std::string> ids;
  for (const bake::Line& line : table->lines) {
    ids.push_back(line.id);
  }
  const std::string id = item.TextOr("line", "");
  if (table->Find(id) == nullptr) {
    ids.insert(ids.begin(), id);
  }
  NameField(item, Tr("Line"), "line", ids, nullptr);
  for (const std::string& language : table->languages) {
    LineText(item, *table, language);
  }
  // The first language: the author starts with their own.
  if (table->languages.empty()) {
    LineText(item, *table, TrIn("the language's tag", "en"));
  }
  NewLanguage(item, *table);
  PropertyLabel("");
  if (ImGui::Button(Tr("Another line"))) {
    const std::string next =
        editor::FreeLineId(*table, SpeakerOf(item).empty() ? "text" : SpeakerOf(item));
    item.workspace.project().EditLines(Sentence("add the line %s", {next}),
                                       editor::WithLine(*table, next, SpeakerOf(item)));
    item.Set("line", next);
    item.workspace.project().EndGesture();
  }
}

void DrawField(Item& item, const drama::LaneField& field) {
  const bool is_of_other_action =
      field.only_if_action != nullptr && item.TextOr("action", "") != field.only_if_action;
  if (is_of_other_action || (field.unless != nullptr && !item.TextOr(field.unless, "").empty())) {
    return;
  }
  switch (field.type) {
    case drama::FieldType::kNumber:
      NumberField(item, field);
      break;
    case drama::FieldType::kYesNo:
      BoolField(item, Tr(field.label), field.key);
      break;
    case drama::FieldType::kColour:
      ColourField(item, field);
      break;
    case drama::FieldType::kPoint:
      PointField(item, Tr(field.label), field.key);
      break;
    case drama::FieldType::kText:
      if (field.role == drama::FieldRole::kLine) {
        LineFields(item);
      } else {
        NameField(item, Tr(field.label), field.key, ChoicesOf(item, field),
                  field.missing != nullptr ? Tr(field.missing) : nullptr);
      }
      break;
  }
}

void DrawItem(editor::Workspace& workspace,
              EditorActions& actions,
              std::string& new_language,
              const TimelineItem& at) {
  const drama::TimelineText& text = *workspace.project().script().timeline();
  const drama::TimelineLane& lane = text.lanes()[at.lane];
  Item item{workspace, new_language, at, lane.kind, lane.actor, text.Fields(at)};
  Heading(ItemTitle(lane.kind));
  if (!lane.actor.empty()) {
    ImGui::SameLine();
    DimText(workspace.project().document().PersonLabel(lane.actor));
  }
  if (BeginProperties("item", 84.0f)) {
    const drama::LaneSpec& spec = drama::SpecOf(lane.kind);
    for (const char* key : {"at", "length"}) {
      DrawField(item, *drama::FindItemField(key));
    }
    for (const drama::LaneField& field : spec.fields) {
      DrawField(item, field);
    }
    if (spec.eases) {
      DrawField(item, *drama::FindItemField("ease"));
    }
    DrawField(item, *drama::FindItemField("id"));
    EndProperties();
  }
  const size_t line = workspace.project().script().timeline() != nullptr
                          ? workspace.project().script().timeline()->LineOf(at)
                          : 0;
  if (line > 0 && ImGui::Button(Text(Tr("Show line %zu of the script"), line).c_str())) {
    actions.push_back(GoToScriptLine{static_cast<int>(line)});
  }
}

void DrawBlock(editor::Workspace& workspace,
               EditorActions& actions,
               const drama::TaskRecord& task) {
  Heading(task.from_timeline ? Tr("As it was played") : Tr("Of the script"));
  if (BeginProperties("block", 84.0f)) {
    PropertyText(Tr("Who"), workspace.project().document().PersonLabel(task.actor));
    PropertyText(Tr("Does"), task.action + (task.object.empty() ? "" : " " + task.object));
    PropertyText(Tr("Begins"), Text("%.2f s", task.began));
    PropertyText(Tr("Ends"), Text("%.2f s", task.ended));
    EndProperties();
  }
  if (!task.message.empty()) {
    ImGui::PushStyleColor(ImGuiCol_Text, task.failed ? Colours().error : Colours().dim);
    ImGui::TextWrapped("%s", task.message.c_str());
    ImGui::PopStyleColor();
  }
  const int line = LineOfPlace(task.where, workspace.project().paths().Drama().filename().string());
  if (line > 0 && ImGui::Button(Text(Tr("Show line %d of the script"), line).c_str())) {
    actions.push_back(GoToScriptLine{line});
  }
  Hint(
      Tr("The script does this when it runs. Change it there; what is written in track{...} can "
         "be changed here."));
}

}  // namespace

void DrawTimelineInspector(editor::Workspace& workspace,
                           EditorActions& actions,
                           const editor::ItemSet& selection,
                           std::optional<uint32_t> block,
                           std::string& new_language) {
  const drama::TimelineText* text = workspace.project().script().timeline();
  const editor::DramaRun* run = workspace.dry_run().newest();
  if (text == nullptr) {
    Heading(Tr("The script cannot be read"));
    ImGui::TextWrapped("%s", workspace.project().script().problem().message().c_str());
    return;
  }
  if (selection.size() == 1) {
    DrawItem(workspace, actions, new_language, selection.front());
  } else if (selection.size() > 1) {
    const editor::TimeSpan span = editor::SpanOf(*text, selection);
    Heading(TrCount("%d item", "%d items", static_cast<int>(selection.size())).c_str());
    DimText(FormatTime(span.begin, 0.01) + " \xe2\x80\x93 " + FormatTime(span.end, 0.01));
    Hint(
        Tr("Drag to move them, drag an end to trim them, Delete to remove them, Ctrl+D to "
           "duplicate them."));
  } else if (block && run != nullptr && *block < run->tasks.size()) {
    DrawBlock(workspace, actions, run->tasks[*block]);
  } else {
    Hint(Tr("Choose an item to see what it says. Double-click a lane, or press A, to add one."));
  }
}

}  // namespace lararium::panels
