#include "editor/cli/object_commands.h"

#include <algorithm>
#include <iterator>
#include <vector>

#include "editor/cli/command_arguments.h"
#include "editor/jobs/sounds.h"
#include "editor/text/text.h"
#include "shared/core/file.h"
#include "shared/stage/acoustics_file.h"

namespace lararium::editor {

namespace {

CommandResult ListObjects(const ProjectDocument& document) {
  CommandResult result;
  result.json = Json::array();
  for (const ObjectDocument& object : document.objects) {
    result.text += object.name + ": " +
                   (object.file.empty() ? object.model + ", from the library" : object.file) +
                   Text("; at %.3f,%.3f,%.3f, heading %.1f degrees\n", object.position.x(),
                        object.position.y(), object.position.z(), object.heading);
    result.json.push_back(FormatFields(object));
  }
  if (document.objects.empty()) {
    result.text = "no objects; add one with --add NAME --model amphora, say\n";
  }
  return result;
}

Status PlaceObject(const ObjectOptions& options, ObjectDocument& object) {
  if (!options.at.empty()) {
    LARARIUM_ASSIGN_OR_RETURN(object.position, ParsePosition("--at", options.at));
  }
  object.heading = options.heading.value_or(object.heading);
  return Status();
}

// The new model or file replaces the previous one.
void ChooseModel(const ObjectOptions& options, const ProjectPaths& paths, ObjectDocument& object) {
  if (!options.model.empty() || !options.file.empty()) {
    object.model = options.model;
    object.file = options.file.empty() ? "" : paths.Shorten(options.file);
  }
}

Status WorkOnObjects(const ObjectOptions& options,
                     const ProjectPaths& paths,
                     std::vector<ObjectDocument>& objects) {
  if (!options.add.empty()) {
    LARARIUM_RETURN_IF_ERROR(CheckNewName(objects, "--add", options.add));
    objects.emplace_back().name = options.add;
  }
  LARARIUM_ASSIGN_OR_RETURN(ObjectDocument * object,
                            FindNamed(objects, options.add + options.set + options.remove,
                                      paths.Project().string(), "has no object"));
  if (!options.remove.empty()) {
    objects.erase(objects.begin() + (object - objects.data()));
    return Status();
  }
  ChooseModel(options, paths, *object);
  return PlaceObject(options, *object);
}

// ---- sounds ----

// Changes the acoustics in their JSON form, so that its parser checks the values.
Status EditAcoustics(const SoundOptions& options, stage::Acoustics& acoustics) {
  Json json = FormatFields(acoustics);
  if (!options.reverb.empty()) {
    json["reverb"] = options.reverb;
  }
  if (options.reverb_gain) {
    json["reverb_db"] = *options.reverb_gain;
  }
  Json& ambience = json["ambience"];
  const auto named = [&ambience](const std::string& sound) {
    return std::find_if(ambience.begin(), ambience.end(),
                        [&](const Json& entry) { return entry["sound"] == sound; });
  };
  if (!options.remove_ambience.empty()) {
    const auto known = named(options.remove_ambience);
    if (known == ambience.end()) {
      return Status::Error(
          "--remove-ambience",
          "\"" + options.remove_ambience + "\" is not an ambient sound of this place",
          "`sound` without options lists them");
    }
    ambience.erase(known);
  }
  if (!options.ambience.empty()) {
    auto entry = named(options.ambience);
    if (entry == ambience.end()) {
      ambience.push_back({{"sound", options.ambience}});
      entry = std::prev(ambience.end());
    }
    if (options.gain) {
      (*entry)["gain_db"] = *options.gain;
    }
    if (!options.at.empty()) {
      (*entry)["at"] = options.at;
    }
  }
  if (ambience.empty()) {
    json.erase("ambience");
  }
  LARARIUM_ASSIGN_OR_RETURN(acoustics, ParseFields<stage::Acoustics>(JsonView(json, "acoustics")));
  return Status();
}

bool EditsAcoustics(const SoundOptions& options) {
  return !options.reverb.empty() || options.reverb_gain || !options.ambience.empty() ||
         !options.remove_ambience.empty();
}

std::string DescribeAcoustics(const stage::Acoustics& acoustics) {
  std::string text = "reverb " + std::string(stage::ReverbName(acoustics.reverb));
  for (const stage::Ambience& ambience : acoustics.ambience) {
    text += Text("; always %s, %+.1f dB", ambience.sound.c_str(),
                 static_cast<double>(ambience.gain_db));
    if (ambience.position) {
      text += Text(" at %.2f,%.2f,%.2f", static_cast<double>(ambience.position->x),
                   static_cast<double>(ambience.position->y),
                   static_cast<double>(ambience.position->z));
    }
  }
  return text;
}

Result<CommandResult> ListSounds(const ProjectPaths& paths, const ProjectDocument& document) {
  CommandResult result;
  result.json = {{"sounds", Json::array()}, {"missing", Json::array()}, {"places", Json::object()}};
  for (const SoundFile& sound : FindSounds(paths)) {
    result.text += sound.name + ": " +
                   (sound.of_library ? "of the library" : paths.Shorten(sound.file)) + "\n";
    result.json["sounds"].push_back({{"name", sound.name},
                                     {"file", paths.Shorten(sound.file)},
                                     {"of_library", sound.of_library}});
  }
  LARARIUM_ASSIGN_OR_RETURN(const std::string script, ReadText(paths.Drama()));
  for (const MissingSound& missing : FindMissingSounds(paths, document, script)) {
    result.text += "warning: " + missing.who + " asks for the sound \"" + missing.name +
                   "\", which is not there\n";
    result.json["missing"].push_back({{"name", missing.name}, {"who", missing.who}});
  }
  for (const PlaceDocument& place : document.places) {
    result.text += "place " + place.name + ": " + DescribeAcoustics(place.acoustics) + "\n";
    result.json["places"][place.name] = FormatFields(place.acoustics);
  }
  return result;
}

}  // namespace

Result<CommandResult> RunObject(const ObjectOptions& options) {
  const ProjectPaths paths{options.project};
  LARARIUM_ASSIGN_OR_RETURN(ProjectDocument document, LoadProject(paths));
  if (!options.add.empty() || !options.set.empty() || !options.remove.empty()) {
    LARARIUM_RETURN_IF_ERROR(WorkOnObjects(options, paths, document.objects));
    LARARIUM_RETURN_IF_ERROR(SaveProject(paths, document));
  }
  return ListObjects(document);
}

Result<CommandResult> RunSound(const SoundOptions& options) {
  const ProjectPaths paths{options.project};
  LARARIUM_ASSIGN_OR_RETURN(ProjectDocument document, LoadProject(paths));
  if (!options.bring.empty()) {
    LARARIUM_RETURN_IF_ERROR(BringInSound(paths, options.bring, options.file));
  }
  if (EditsAcoustics(options)) {
    LARARIUM_ASSIGN_OR_RETURN(const std::string place, ChoosePlace(paths, document, options.place));
    LARARIUM_RETURN_IF_ERROR(EditAcoustics(options, document.FindPlace(place)->acoustics));
    LARARIUM_RETURN_IF_ERROR(SaveProject(paths, document));
  }
  return ListSounds(paths, document);
}

}  // namespace lararium::editor
