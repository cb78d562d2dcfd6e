#include "editor/cli/timeline_item_commands.h"

#include <algorithm>
#include <map>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "editor/check/drama_run.h"
#include "editor/check/timeline_edits.h"
#include "editor/cli/command_arguments.h"
#include "editor/document/script_document.h"
#include "shared/core/file.h"

namespace lararium::editor {

namespace {

using drama::LaneKind;
using drama::TimelineItem;
using drama::TimelineText;

using drama::FieldType;
using drama::LaneField;
using drama::LaneSpec;

// Parses "x,z" or "x,z,heading".
Result<Json> ParsePoint(const std::string& option, std::string_view text) {
  Json point = Json::object();
  for (const char* key : {"x", "z", "heading"}) {
    const size_t end = std::min(text.find(','), text.size());
    const std::optional<double> number = ParseNumber(text.substr(0, end));
    if (!number) {
      break;
    }
    point[key] = *number;
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  if (point.size() < 2 || !text.empty()) {
    return Status::Error(option, "is not a point", "give x,z or x,z,heading in metres and degrees");
  }
  return point;
}

// Parses "red,green,blue".
Result<Json> ParseColour(const std::string& option, std::string_view text) {
  Json colour = Json::array();
  for (bool more = true; more;) {
    const size_t end = std::min(text.find(','), text.size());
    const std::optional<double> number = ParseNumber(text.substr(0, end));
    if (!number) {
      return Status::Error(option, "is not a colour",
                           "give linear red,green,blue such as 1,0.5,0.2");
    }
    colour.push_back(*number);
    more = end < text.size();
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return colour;
}

Result<Json> ParseValue(const std::string& option, FieldType type, std::string_view text) {
  switch (type) {
    case FieldType::kText:
      return Json(text);
    case FieldType::kNumber:
      if (const std::optional<double> number = ParseNumber(text)) {
        return Json(*number);
      }
      return Status::Error(option, "is not a number");
    case FieldType::kYesNo:
      if (text == "yes" || text == "no") {
        return Json(text == "yes");
      }
      return Status::Error(option, "is neither yes nor no");
    case FieldType::kColour:
      return ParseColour(option, text);
    case FieldType::kPoint:
      break;
  }
  return ParsePoint(option, text);
}

// Parses "KEY=VALUE" for an item of that lane.
Result<std::pair<std::string, Json>> ParseField(const LaneSpec& lane, const std::string& text) {
  const size_t equals = text.find('=');
  const std::string key = text.substr(0, equals);
  const std::string option = "--field " + text;
  const LaneField* field = drama::FindField(lane, key);
  if (field != nullptr && equals != std::string::npos) {
    LARARIUM_ASSIGN_OR_RETURN(
        Json value, ParseValue(option, field->type, std::string_view(text).substr(equals + 1)));
    if (const std::string problem = drama::ProblemOf(*field, value); !problem.empty()) {
      return Status::Error(option, problem);
    }
    return std::pair(key, std::move(value));
  }
  std::string known;
  for (const auto fields : {drama::ItemFields(), std::span<const LaneField>(lane.fields)}) {
    for (const LaneField& each : fields) {
      known += (known.empty() ? "" : ", ") + std::string(each.key);
    }
  }
  return Status::Error(option, "is not a field of an item of " + std::string(lane.name),
                       "write KEY=VALUE; it has " + known);
}

// Checks that an item has one of the fields that its lane requires.
Status CheckComplete(const LaneSpec& lane, const Json& fields) {
  const std::vector<std::string_view> required = drama::RequiredFields(lane, fields);
  if (required.empty()) {
    return Status();
  }
  std::string listed;
  for (const std::string_view key : required) {
    if (fields.contains(key)) {
      return Status();
    }
    const FieldType type = drama::FindField(lane, key)->type;
    listed += listed.empty() ? "" : key == required.back() ? " or " : ", ";
    listed += std::string(key) + (type == FieldType::kPoint   ? "=X,Z"
                                  : type == FieldType::kYesNo ? "=yes"
                                                              : "=...");
  }
  return Status::Error("--add " + std::string(lane.name), "is incomplete", "add --field " + listed);
}

// "keeper/speech/1" is the first line that keeper says, in the order of the file.
struct NamedItem {
  std::string name;
  TimelineItem item;
};
std::vector<NamedItem> NameItems(const TimelineText& text) {
  std::vector<NamedItem> named;
  std::map<std::string, int> counts;
  for (size_t lane = 0; lane < text.lanes().size(); ++lane) {
    const drama::TimelineLane& in = text.lanes()[lane];
    const std::string owner =
        (in.actor.empty() ? "" : in.actor + "/") + std::string(drama::NameOf(in.kind)) + "/";
    for (size_t item = 0; item < in.size(); ++item) {
      named.push_back({owner + std::to_string(++counts[owner]), {lane, item}});
    }
  }
  return named;
}

class TimelineWorker {
 public:
  TimelineWorker(ProjectPaths paths,
                 ProjectDocument document,
                 const std::string& script,
                 const TimelineOptions& options,
                 Progress& progress)
      : paths_(std::move(paths)),
        document_(std::move(document)),
        script_(script, paths_.Drama().filename().string()),
        options_(options),
        progress_(progress) {}

  Result<CommandResult> Run() {
    LARARIUM_RETURN_IF_ERROR(script_.problem());
    const std::vector<std::string> before = Problems();
    const std::string text = script_.text();
    LARARIUM_RETURN_IF_ERROR(
        script_.Change([this](TimelineText& changed) { return Work(changed); }).status());
    // The line numbers of problems may have changed.
    if (const std::vector<std::string> after = Problems(); after.size() > before.size()) {
      const auto added = std::find_if(after.begin(), after.end(), [&](const std::string& problem) {
        return std::find(before.begin(), before.end(), problem) == before.end();
      });
      return Status::Error(*added, "nothing was changed");
    }
    if (script_.text() != text) {
      LARARIUM_RETURN_IF_ERROR(WriteFileAtomically(paths_.Drama(), script_.text()));
    }
    return List();
  }

 private:
  std::vector<std::string> Problems() const {
    const auto problems = script_.timeline()->problems();
    return {problems.begin(), problems.end()};
  }

  Status Work(TimelineText& text) {
    if (!options_.add.empty()) {
      return Add(text);
    }
    if (options_.items.empty()) {
      return Status();
    }
    LARARIUM_ASSIGN_OR_RETURN(const ItemSet items, Chosen(text));
    LARARIUM_RETURN_IF_ERROR(Set(text, items));
    LARARIUM_RETURN_IF_ERROR(Trim(text, items));
    if (options_.move) {
      LARARIUM_RETURN_IF_ERROR(MoveItems(text, items, *options_.move, options_.ripple));
    }
    ItemSet copies;
    if (options_.copy_to) {
      return PasteItems(text, CopyItems(text, items), *options_.copy_to, copies);
    }
    return options_.remove ? DeleteItems(text, items, options_.ripple) : Status();
  }

  Status Add(TimelineText& text) {
    const std::optional<LaneKind> kind = drama::LaneNamed(options_.add);
    if (!kind) {
      return Status::Error("--add " + options_.add, "is not a lane", "docs/drama.md lists them");
    }
    if (drama::IsOfActor(*kind)) {
      LARARIUM_RETURN_IF_ERROR(
          FindNamed(document_.cast, options_.actor, paths_.Project().string(), "has no person")
              .status());
    } else if (!options_.actor.empty()) {
      return Status::Error(
          "--actor", "cannot be combined with " + options_.add + ", which belong to the stage");
    }
    Json fields = {{"at", options_.at.value_or(0.0)}};
    for (const std::string& given : options_.fields) {
      LARARIUM_ASSIGN_OR_RETURN(auto field, ParseField(drama::SpecOf(*kind), given));
      fields[field.first] = std::move(field.second);
    }
    LARARIUM_RETURN_IF_ERROR(CheckComplete(drama::SpecOf(*kind), fields));
    ItemSet added;
    return AddItem(text, *kind, options_.actor, std::move(fields), added);
  }

  // Finds an item by its name in the list, or by its id.
  Result<TimelineItem> Find(const TimelineText& text, const std::string& which) const {
    for (const NamedItem& named : NameItems(text)) {
      const std::optional<Json> id = text.Field(named.item, "id");
      if (named.name == which || (id && *id == Json(which))) {
        return named.item;
      }
    }
    return Status::Error(text.place(), "has no item \"" + which + "\"",
                         "`timeline` without options lists them");
  }

  Result<ItemSet> Chosen(const TimelineText& text) const {
    ItemSet items;
    for (const std::string& which : options_.items) {
      LARARIUM_ASSIGN_OR_RETURN(const TimelineItem item, Find(text, which));
      if (!Contains(items, item)) {
        Toggle(items, item);
      }
    }
    return items;
  }

  Status Set(TimelineText& text, const ItemSet& items) const {
    std::vector<drama::TimelineChange> changes;
    for (const TimelineItem& item : items) {
      for (const std::string& given : options_.fields) {
        LARARIUM_ASSIGN_OR_RETURN(auto field,
                                  ParseField(drama::SpecOf(text.lanes()[item.lane].kind), given));
        changes.push_back({item, field.first, std::move(field.second)});
      }
    }
    LARARIUM_RETURN_IF_ERROR(text.SetAll(changes).status());
    for (const TimelineItem& item : items) {
      for (const std::string& key : options_.unset) {
        LARARIUM_RETURN_IF_ERROR(text.Unset(item, key).status());
      }
    }
    return Status();
  }

  Status Trim(TimelineText& text, const ItemSet& items) {
    if (!options_.trim_begin && !options_.trim_end) {
      return Status();
    }
    LARARIUM_ASSIGN_OR_RETURN(const std::vector<double> naturals, Naturals(text, items));
    if (options_.trim_begin) {
      LARARIUM_RETURN_IF_ERROR(TrimBegins(text, items, naturals, *options_.trim_begin));
    }
    return options_.trim_end ? TrimEnds(text, items, naturals, *options_.trim_end, options_.ripple)
                             : Status();
  }

  // The durations of items that state none.
  Result<std::vector<double>> Naturals(const TimelineText& text, const ItemSet& items) {
    std::vector<double> naturals(items.size(), kShortest);
    const bool all_say = std::all_of(items.begin(), items.end(), [&](const TimelineItem& item) {
      return text.lanes()[item.lane].length[item.item] > 0.0;
    });
    if (!all_say) {
      LARARIUM_ASSIGN_OR_RETURN(const DramaRun run,
                                RunDrama(paths_, document_, options_.spoken, script_.text(),
                                         options_.seconds, progress_));
      for (size_t i = 0; i < items.size(); ++i) {
        naturals[i] = std::max(NaturalSeconds(text, items[i], run), kShortest);
      }
    }
    return naturals;
  }

  CommandResult List() const {
    const TimelineText& text = *script_.timeline();
    CommandResult result;
    result.json = Json::array();
    for (const NamedItem& named : NameItems(text)) {
      Json fields = Json::object();
      result.text += named.name + ":";
      for (const drama::TimelineField& field : text.Fields(named.item)) {
        result.text +=
            " " + field.key + "=" +
            (field.value.is_string() ? field.value.get<std::string>() : field.value.dump());
        fields[field.key] = field.value;
      }
      result.text += "\n";
      result.json.push_back(
          {{"name", named.name}, {"line", text.LineOf(named.item)}, {"item", fields}});
    }
    for (const std::string& problem : text.problems()) {
      result.text += "warning: " + problem + "\n";
    }
    if (text.lanes().empty()) {
      result.text += "nothing is written on the timeline; add something with --add LANE\n";
    }
    return result;
  }

  ProjectPaths paths_;
  ProjectDocument document_;
  ScriptDocument script_;
  const TimelineOptions& options_;
  Progress& progress_;
};

}  // namespace

Result<CommandResult> EditTimeline(const TimelineOptions& options, Progress& progress) {
  const ProjectPaths paths{options.project};
  LARARIUM_ASSIGN_OR_RETURN(ProjectDocument document, LoadProject(paths));
  LARARIUM_ASSIGN_OR_RETURN(const std::string script, ReadText(paths.Drama()));
  return TimelineWorker(paths, std::move(document), script, options, progress).Run();
}

}  // namespace lararium::editor
