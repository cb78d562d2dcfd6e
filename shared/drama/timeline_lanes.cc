#include "shared/drama/timeline_lanes.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace lararium::drama {
namespace {

constexpr double kMostSeconds = 1e6;

// Marks a text for the catalogues of po/. The editor translates it.
constexpr const char* TrLater(const char* text) { return text; }

LaneField LineField() {
  return {.key = "line", .label = TrLater("Line"), .role = FieldRole::kLine};
}
LaneField ClipField() {
  return {.key = "clip", .label = TrLater("Clip"), .role = FieldRole::kClip, .initial = "idle"};
}
LaneField FadeField(double fallback, double most) {
  return {.key = "fade",
          .label = TrLater("Fade"),
          .type = FieldType::kNumber,
          .most = most,
          .fallback = fallback,
          .format = "%.2f s"};
}

std::vector<LaneSpec> MakeLanes() {
  return {
      {.kind = LaneKind::kClips,
       .name = "clips",
       .title = TrLater("Clips"),
       .item_title = TrLater("Clip"),
       .icon = "clip",
       .colour = {0.220f, 0.490f, 0.760f},  // Blue.
       .row = 6,
       .of_actor = true,
       .by_host = false,
       .leads_body = true,
       .walks = true,
       .eases = true,
       .new_length = 2.0,
       .content = "clip",
       .fields = {ClipField(),
                  {.key = "from", .label = TrLater("From"), .type = FieldType::kPoint},
                  {.key = "to", .label = TrLater("To"), .type = FieldType::kPoint},
                  {.key = "heading",
                   .label = TrLater("Heading"),
                   .type = FieldType::kNumber,
                   .least = -1e6,
                   .most = 1e6,
                   .step = 1.0,
                   .format = "%.0f\xc2\xb0",
                   .missing = TrLater("as it moves")},
                  FadeField(0.3, kMostSeconds)}},
      {.kind = LaneKind::kGestures,
       .name = "gestures",
       .title = TrLater("Gestures"),
       .item_title = TrLater("Gesture"),
       .icon = "gesture",
       .colour = {0.900f, 0.850f, 0.360f},  // Yellow.
       .row = 3,
       .of_actor = true,
       .moves_body = true,
       .duration = ItemDuration::kClip,
       .content = "clip",
       .actions = {"gesture", "play"},
       .fields = {ClipField(),
                  {.key = "part",
                   .label = TrLater("Part"),
                   .missing = TrLater("Upper body"),
                   .choices = {"upper", "arms", "head", "whole"}}}},
      {.kind = LaneKind::kSpeech,
       .name = "speech",
       .title = TrLater("Speech"),
       .item_title = TrLater("Line"),
       .icon = "speech",
       .colour = {0.337f, 0.706f, 0.914f},  // Sky blue.
       .row = 0,
       .of_actor = true,
       .audible = true,
       .line = LineUse::kSpoken,
       .duration = ItemDuration::kLine,
       .content = "line",
       .actions = {"say"},
       .fields = {LineField()}},
      {.kind = LaneKind::kWalks,
       .name = "walks",
       .title = TrLater("Walks"),
       .item_title = TrLater("Walk"),
       .icon = "walk",
       .colour = {0.160f, 0.660f, 0.520f},  // Bluish green.
       .row = 1,
       .of_actor = true,
       .moves_body = true,
       .walks = true,
       .duration = ItemDuration::kTask,
       .content = "to",
       .required = {"to", "from", "hide"},
       .actions = {"walk_to", "turn_to", "walk", "hide", ""},
       .fields = {{.key = "to",
                   .label = TrLater("To"),
                   .type = FieldType::kPoint,
                   .initial = {{"x", 0.0}, {"z", -1.0}}},
                  {.key = "from",
                   .label = TrLater("Appears at"),
                   .type = FieldType::kPoint,
                   .role = FieldRole::kEntrance,
                   // This faces the destination.
                   .initial = {{"x", -1.0}, {"z", -1.0}, {"heading", -90.0}}},
                  {.key = "speed",
                   .label = TrLater("Speed"),
                   .type = FieldType::kNumber,
                   .least = 0.1,
                   .most = 10.0,
                   .fallback = 1.2,
                   .format = "%.2f m/s"},
                  {.key = "hide", .label = TrLater("Hides"), .type = FieldType::kYesNo}}},
      {.kind = LaneKind::kUses,
       .name = "uses",
       .title = TrLater("Uses"),
       .item_title = TrLater("Use"),
       .icon = "use",
       .colour = {0.902f, 0.624f, 0.100f},  // Orange.
       .row = 2,
       .of_actor = true,
       .moves_body = true,
       .duration = ItemDuration::kTask,
       .content = "object",
       .label = {"action", "object"},
       .fields = {{.key = "object",
                   .label = TrLater("Object"),
                   .role = FieldRole::kObject,
                   .initial = "object",
                   .optional_if_action = "stand"},
                  {.key = "action", .label = TrLater("Action"), .role = FieldRole::kAction},
                  {.key = "on",
                   .label = TrLater("On"),
                   .role = FieldRole::kObject,
                   .missing = TrLater("The floor"),
                   .only_if_action = "put"},
                  {.key = "surface",
                   .label = TrLater("Surface"),
                   .role = FieldRole::kSurface,
                   .missing = TrLater("Any"),
                   .only_if_action = "put"},
                  {.key = "partner",
                   .label = TrLater("To whom"),
                   .role = FieldRole::kActor,
                   .only_if_action = "give"},
                  {.key = "to",
                   .label = TrLater("To"),
                   .type = FieldType::kPoint,
                   .only_if_action = "put",
                   .unless = "on"}}},
      {.kind = LaneKind::kGaze,
       .name = "gaze",
       .title = TrLater("Gaze"),
       .item_title = TrLater("Look"),
       .icon = "gaze",
       .colour = {0.800f, 0.520f, 0.680f},  // Reddish purple.
       .row = 4,
       .of_actor = true,
       .new_length = 3.0,
       .content = "target",
       .actions = {"look_at"},
       .fields = {{.key = "target",
                   .label = TrLater("At"),
                   .role = FieldRole::kTarget,
                   .initial = "visitor"}}},
      {.kind = LaneKind::kExpressions,
       .name = "expressions",
       .title = TrLater("Expressions"),
       .item_title = TrLater("Expression"),
       .icon = "expression",
       .colour = {0.835f, 0.400f, 0.180f},  // Vermilion.
       .row = 5,
       .of_actor = true,
       .eases = true,
       .new_length = 3.0,
       .content = "expression",
       .actions = {"express"},
       .fields = {{.key = "expression",
                   .label = TrLater("Expression"),
                   .role = FieldRole::kExpression,
                   .initial = "joy"},
                  {.key = "intensity",
                   .label = TrLater("Intensity"),
                   .type = FieldType::kNumber,
                   .most = 1.0,
                   .fallback = 1.0,
                   .format = "%.2f",
                   .initial = 0.7},
                  FadeField(0.4, 100.0)}},
      {.kind = LaneKind::kLights,
       .name = "lights",
       .title = TrLater("Lights"),
       .item_title = TrLater("Light"),
       .icon = "light",
       .colour = {0.900f, 0.850f, 0.360f},
       .row = 8,
       .by_host = false,
       .eases = true,
       .new_length = 3.0,
       .content = "light",
       .fields = {{.key = "light",
                   .label = TrLater("Light"),
                   .role = FieldRole::kLamp,
                   .initial = "lamp"},
                  {.key = "level",
                   .label = TrLater("Level"),
                   .type = FieldType::kNumber,
                   .most = 1000.0,
                   .fallback = 1.0,
                   .format = "%.2f",
                   .initial = 0.5},
                  {.key = "seconds",
                   .label = TrLater("Fades in"),
                   .type = FieldType::kNumber,
                   .most = kMostSeconds,
                   .format = "%.2f s"},
                  {.key = "colour",
                   .label = TrLater("Colour"),
                   .type = FieldType::kColour,
                   .most = 1e6,
                   .missing = TrLater("as it was")},
                  {.key = "temperature",
                   .label = TrLater("Temperature"),
                   .type = FieldType::kNumber,
                   .least = 1667.0,
                   .most = 25000.0,
                   .fallback = 2000.0,
                   .step = 10.0,
                   .format = "%.0f K",
                   .missing = TrLater("as it was")}}},
      {.kind = LaneKind::kSounds,
       .name = "sounds",
       .title = TrLater("Sounds"),
       .item_title = TrLater("Sound"),
       .icon = "sound",
       .colour = {0.220f, 0.490f, 0.760f},
       .row = 9,
       .by_host = false,
       .eases = true,
       .audible = true,
       .content = "sound",
       .fields = {{.key = "sound",
                   .label = TrLater("Sound"),
                   .role = FieldRole::kSound,
                   .initial = "bell"},
                  {.key = "gain",
                   .label = TrLater("Gain"),
                   .type = FieldType::kNumber,
                   .least = -60.0,
                   .most = 12.0,
                   .step = 0.1,
                   .format = "%.1f dB"},
                  {.key = "loop", .label = TrLater("Loops"), .type = FieldType::kYesNo},
                  {.key = "actor",
                   .label = TrLater("With actor"),
                   .role = FieldRole::kActor,
                   .missing = TrLater("Nobody")},
                  {.key = "object",
                   .label = TrLater("At object"),
                   .role = FieldRole::kObject,
                   .missing = TrLater("Nothing")},
                  {.key = "from", .label = TrLater("From"), .type = FieldType::kPoint},
                  FadeField(0.0, 1e4)}},
      {.kind = LaneKind::kCaptions,
       .name = "captions",
       .title = TrLater("Captions"),
       .item_title = TrLater("Caption"),
       .icon = "caption",
       .colour = {0.337f, 0.706f, 0.914f},
       .row = 10,
       .line = LineUse::kCaption,
       .duration = ItemDuration::kLine,
       .content = "line",
       .actions = {"caption"},
       .fields = {LineField()}},
      {.kind = LaneKind::kDescriptions,
       .name = "descriptions",
       .title = TrLater("Descriptions"),
       .item_title = TrLater("Description"),
       .icon = "description",
       .colour = {0.337f, 0.706f, 0.914f},
       .row = 11,
       .by_host = false,
       .line = LineUse::kDescription,
       .duration = ItemDuration::kLine,
       .content = "line",
       .actions = {"describe"},
       .fields = {LineField(),
                  {.key = "patience",
                   .label = TrLater("Patience"),
                   .type = FieldType::kNumber,
                   .most = 1e4,
                   .fallback = 5.0,
                   .step = 0.1,
                   .format = "%.1f s"}}},
      {.kind = LaneKind::kMarkers,
       .name = "markers",
       .title = TrLater("Markers"),
       .item_title = TrLater("Marker"),
       .icon = "marker",
       .row = 7,
       .duration = ItemDuration::kMoment,
       .content = "name",
       .actions = {"marker"},
       .fields = {{.key = "name", .label = TrLater("Name"), .initial = "marker"}}},
  };
}

const LaneField* Find(std::span<const LaneField> fields, std::string_view key) {
  const auto found = std::find_if(fields.begin(), fields.end(),
                                  [&](const LaneField& field) { return field.key == key; });
  return found == fields.end() ? nullptr : &*found;
}

}  // namespace

std::span<const LaneSpec> LaneSpecs() {
  static const std::vector<LaneSpec> kLanes = MakeLanes();
  return kLanes;
}

const LaneSpec& SpecOf(LaneKind kind) { return LaneSpecs()[static_cast<size_t>(kind)]; }

std::span<const LaneField> ItemFields() {
  static const std::vector<LaneField> kFields = {
      {.key = "at",
       .label = TrLater("Begins"),
       .type = FieldType::kNumber,
       .most = kMostSeconds,
       .step = 0.02,
       .format = "%.3f s"},
      {.key = "length",
       .label = TrLater("Lasts"),
       .type = FieldType::kNumber,
       .most = kMostSeconds,
       .step = 0.02,
       .format = "%.3f s",
       .missing = TrLater("as long as it takes")},
      {.key = "id", .label = TrLater("Id")},
      {.key = "ease",
       .label = TrLater("Easing"),
       .missing = TrLater("Even"),
       .choices = {kEaseNames.begin(), kEaseNames.end()}}};
  return kFields;
}

const LaneField* FindItemField(std::string_view key) { return Find(ItemFields(), key); }

const LaneField* FindField(const LaneSpec& lane, std::string_view key) {
  const LaneField* field = FindItemField(key);
  return field != nullptr ? field : Find(lane.fields, key);
}

std::string ProblemOf(const LaneField& field, const Json& value) {
  switch (field.type) {
    case FieldType::kText: {
      const bool known =
          value.is_string() &&
          (field.choices.empty() || std::find(field.choices.begin(), field.choices.end(),
                                              value.get<std::string>()) != field.choices.end());
      if (known ||
          (field.role == FieldRole::kTarget && (value.is_object() || value.is_boolean()))) {
        return "";
      }
      std::string listed;
      for (const std::string_view choice : field.choices) {
        listed += (listed.empty() ? "" : ", ") + std::string(choice);
      }
      return listed.empty() ? "must be a text" : "must be one of " + listed;
    }
    case FieldType::kNumber: {
      const double number = value.is_number() ? value.get<double>() : std::nan("");
      char problem[64] = "";
      if (!(number >= field.least && number <= field.most)) {
        std::snprintf(problem, sizeof(problem), "must be a number from %.9g to %.9g", field.least,
                      field.most);
      }
      return problem;
    }
    case FieldType::kYesNo:
      return value.is_boolean() ? "" : "must be true or false";
    case FieldType::kColour: {
      const auto is_channel = [&](const Json& channel) {
        return channel.is_number() && channel.get<double>() >= field.least &&
               channel.get<double>() <= field.most;
      };
      const bool valid = value.is_array() && value.size() == 3 &&
                         std::all_of(value.begin(), value.end(), is_channel);
      return valid ? "" : "must be linear red, green and blue of at least 0";
    }
    case FieldType::kPoint:
      break;
  }
  return value.is_object() ? "" : "must be a point such as {x = 1, z = -2}";
}

std::vector<std::string_view> RequiredFields(const LaneSpec& lane, const Json& item) {
  const LaneField* content = FindField(lane, lane.content);
  const auto action = item.find("action");
  if (content != nullptr && content->optional_if_action != nullptr && action != item.end() &&
      *action == content->optional_if_action) {
    return {};
  }
  return lane.required.empty() ? std::vector{lane.content} : lane.required;
}

std::optional<LaneKind> LaneNamed(std::string_view name) {
  for (const LaneSpec& lane : LaneSpecs()) {
    if (lane.name == name) {
      return lane.kind;
    }
  }
  return std::nullopt;
}

LaneKind LaneOfTask(std::string_view action) {
  const std::string_view word = action.substr(0, action.find(' '));
  for (const LaneSpec& lane : LaneSpecs()) {
    if (std::find(lane.actions.begin(), lane.actions.end(), word) != lane.actions.end()) {
      return lane.kind;
    }
  }
  return LaneKind::kUses;
}

}  // namespace lararium::drama
