#pragma once

// The table of the lanes of a timeline: the fields of their items, and what the editor, the checks
// and the exports need to know about them. docs/internals/drama.md says how to add a lane.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shared/core/ease.h"
#include "shared/core/json.h"

namespace lararium::drama {

enum class LaneKind : uint8_t {
  kClips,     // Clips of the whole body along paths; the actor is led by the track.
  kGestures,  // Clips that play once on a part of the body.
  kSpeech,
  kWalks,
  kUses,  // Using, taking, putting and giving objects, and sitting.
  kGaze,
  kExpressions,
  kLights,
  kSounds,
  kCaptions,
  kDescriptions,
  kMarkers,
};

enum class FieldType : uint8_t {
  kText,
  kNumber,
  kYesNo,
  kPoint,
  kColour,  // An array of red, green and blue: linear, at least 0, of any brightness.
};

// What the value of a field refers to. The editor offers a choice of these.
enum class FieldRole : uint8_t {
  kNone,
  kLine,
  kClip,
  kObject,
  kLamp,     // An object that has lights.
  kAction,   // An action of the object in the field `object`.
  kSurface,  // A surface of the object in the field `on`.
  kActor,
  kTarget,  // An actor, an object or the visitor.
  kExpression,
  kSound,
  kEntrance,  // The point where the actor appears.
};

struct LaneField {
  const char* key;
  const char* label;  // English text of the interface.
  FieldType type = FieldType::kText;
  FieldRole role = FieldRole::kNone;

  // Numbers. The range is the one that Lua accepts.
  double least = 0.0;
  double most = 0.0;
  double fallback = 0.0;         // The value of a missing number.
  double step = 0.01;            // Change of the value for each pixel of a drag.
  const char* format = nullptr;  // A format of printf with the unit.

  // English text of the interface for a missing value. Null: a missing text cannot be chosen, and a
  // missing number is shown as `fallback`.
  const char* missing = nullptr;
  std::vector<std::string_view> choices = {};  // The valid texts; empty: the role defines them.
  Json initial = nullptr;                      // The value in a new item; null: left out.
  const char* only_if_action = nullptr;        // The value of `action` for which the field is used.
  // The value of `action` for which an item is complete without this field.
  const char* optional_if_action = nullptr;
  const char* unless = nullptr;  // Key of a field that makes this one meaningless.
};

// What defines the duration of an item without `length`.
enum class ItemDuration : uint8_t { kNothing, kLine, kClip, kTask, kMoment };

// How the line of an item reaches the visitors.
enum class LineUse : uint8_t { kNone, kSpoken, kCaption, kDescription };

struct LaneSpec {
  LaneKind kind;
  std::string_view name;       // Name of the field of track{...}.
  const char* title;           // English text of the interface.
  const char* item_title;      // English text of the interface.
  std::string_view icon = {};  // Name of an icon of panels/widgets/icons.cc.
  std::array<float, 3> colour = {0.780f, 0.800f, 0.840f};  // sRGB; the default is grey.
  int row = 100;  // Rows of the editor's timeline are sorted by it.

  bool of_actor = false;
  bool by_host = true;      // TimelinePlayer plays the items, lua/std does not.
  bool leads_body = false;  // Items control the whole body and do not overlap.
  bool moves_body = false;  // Items cannot be combined with a lane that leads the body.
  bool walks = false;       // Items move the actor from `from` to `to`.
  bool eases = false;       // Items use the field `ease`.
  bool audible = false;
  LineUse line = LineUse::kNone;
  ItemDuration duration = ItemDuration::kNothing;
  double new_length = 0.0;  // Seconds; the length of a new item, 0: none is written.

  std::string_view content;                  // Key of the field that names the content of an item.
  std::vector<std::string_view> label = {};  // Keys of the fields in the label; empty: `content`.
  std::vector<std::string_view> required = {};  // An item needs one of them; empty: `content`.
  // First words of the actions of the stage's tasks that belong to this lane.
  std::vector<std::string_view> actions = {};
  std::vector<LaneField> fields = {};
};

// Index: LaneKind.
std::span<const LaneSpec> LaneSpecs();
const LaneSpec& SpecOf(LaneKind kind);
// The fields that items of all lanes have.
std::span<const LaneField> ItemFields();
// Finds a field of items of a lane, including those of all lanes; nullptr if there is none.
const LaneField* FindField(const LaneSpec& lane, std::string_view key);
const LaneField* FindItemField(std::string_view key);
// What is wrong with the value of a field, such as "must be a number from 0 to 1"; empty: nothing.
std::string ProblemOf(const LaneField& field, const Json& value);
// The keys of which an item with these fields needs one: those of `required`, or `content` alone.
// Empty: the item needs none of them for its action.
std::vector<std::string_view> RequiredFields(const LaneSpec& lane, const Json& item);

std::optional<LaneKind> LaneNamed(std::string_view name);
// The lane that the action of a task belongs to ("walk_to", "say salvete").
LaneKind LaneOfTask(std::string_view action);

inline std::string_view NameOf(LaneKind kind) { return SpecOf(kind).name; }
inline bool IsOfActor(LaneKind kind) { return SpecOf(kind).of_actor; }

}  // namespace lararium::drama
