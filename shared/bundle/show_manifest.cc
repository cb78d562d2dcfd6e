#include "shared/bundle/show_manifest.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <set>

#include "shared/bundle/member_name.h"
#include "shared/bundle/zip_layout.h"
#include "shared/core/json.h"
#include "shared/light/probe_weights.h"
#include "shared/stage/acoustics_file.h"

namespace lararium::bundle {
namespace {

constexpr size_t kMaxName = 200;
constexpr size_t kMaxTitle = 1000;
constexpr size_t kMaxPlaces = 64;
constexpr size_t kMaxCast = 256;
constexpr size_t kMaxObjects = 1024;
constexpr size_t kMaxLines = 4096;
constexpr size_t kMaxLanguages = 64;
constexpr size_t kMaxLanguageTag = 16;
constexpr size_t kMaxSounds = 4096;
constexpr size_t kMaxOccluders = 256;
constexpr double kMaxIrradiance = 1e6;
constexpr double kMaxProbeDistance = 1e5;  // metres
constexpr size_t kMaxCredits = 1 << 20;

// Parses the list in field `key` with parse() for each element.
template <typename T>
Result<std::vector<T>> ParseList(const JsonView& json,
                                 std::string_view key,
                                 size_t max_count,
                                 Result<T> (*parse)(const JsonView&)) {
  LARARIUM_ASSIGN_OR_RETURN(const JsonView field, json.Field(key));
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<JsonView> items, field.Array(max_count));
  std::vector<T> list;
  std::set<std::string> names;
  for (const JsonView& item : items) {
    LARARIUM_ASSIGN_OR_RETURN(T entry, parse(item));
    if (entry.name.empty() || !names.insert(entry.name).second) {
      return item.Problem("the name '" + entry.name + "' is empty or used twice");
    }
    list.push_back(std::move(entry));
  }
  return list;
}

// Same as ParseList for an optional field.
template <typename T>
Result<std::vector<T>> ParseOptionalList(const JsonView& json,
                                         std::string_view key,
                                         size_t max_count,
                                         Result<T> (*parse)(const JsonView&)) {
  if (!json.Has(key)) {
    return std::vector<T>();
  }
  return ParseList(json, key, max_count, parse);
}

Result<std::string> ParseMemberName(const JsonView& json, std::string_view key) {
  LARARIUM_ASSIGN_OR_RETURN(std::string name, json.Text(key, kMaxMemberName));
  if (!IsMemberName(name) || name == kManifestName) {
    return json.Problem("the field \"" + std::string(key) + "\" is not a valid member name");
  }
  return name;
}

Result<geometry::Similarity3> ParseSimilarity(const JsonView& json, std::string_view key) {
  LARARIUM_ASSIGN_OR_RETURN(const JsonView field, json.Field(key));
  LARARIUM_ASSIGN_OR_RETURN(const double scale, field.Number("scale", 1e-9, 1e9));
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<double> q, field.Numbers("rotation", 4));
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<double> t, field.Numbers("translation", 3));
  const Eigen::Quaterniond rotation(q[0], q[1], q[2], q[3]);
  if (!(std::abs(rotation.norm() - 1.0) < 1e-6)) {
    return field.Problem("the rotation is not a unit quaternion");
  }
  return geometry::Similarity3{scale, rotation, Eigen::Vector3d(t[0], t[1], t[2])};
}

Json FormatSimilarity(const geometry::Similarity3& a_from_b) {
  const Eigen::Quaterniond& q = a_from_b.rotation;
  const Eigen::Vector3d& t = a_from_b.translation;
  return {{"scale", a_from_b.scale},
          {"rotation", {q.w(), q.x(), q.y(), q.z()}},
          {"translation", {t.x(), t.y(), t.z()}}};
}

Result<light::Sun> ParseSun(const JsonView& json) {
  light::Sun sun;
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<double> direction, json.Numbers("direction", 3));
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<double> irradiance, json.Numbers("irradiance", 3));
  LARARIUM_ASSIGN_OR_RETURN(const double radius,
                            json.Number("angular_radius", 0.0, light::kMaxSunRadius));
  const glm::dvec3 towards(direction[0], direction[1], direction[2]);
  if (!(std::abs(glm::length(towards) - 1.0) < 1e-3)) {
    return json.Problem("the direction of the sun is not a unit vector");
  }
  for (const double channel : irradiance) {
    if (!(channel >= 0.0 && channel < kMaxIrradiance)) {
      return json.Problem("the irradiance of the sun must be between 0 and a million");
    }
  }
  sun.direction = glm::vec3(towards);
  sun.irradiance = {irradiance[0], irradiance[1], irradiance[2]};
  sun.angular_radius = static_cast<float>(radius);
  return sun;
}

Json FormatSun(const light::Sun& sun) {
  return {{"direction", {sun.direction.x, sun.direction.y, sun.direction.z}},
          {"irradiance", {sun.irradiance.r, sun.irradiance.g, sun.irradiance.b}},
          {"angular_radius", sun.angular_radius}};
}

Result<light::ShRgb> ParseSky(const JsonView& json) {
  LARARIUM_ASSIGN_OR_RETURN(const JsonView field, json.Field("light"));
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<double> numbers, field.Numbers(3 * light::kShCount));
  light::ShRgb light;
  for (size_t i = 0; i < light.size(); ++i) {
    for (int channel = 0; channel < 3; ++channel) {
      const auto value = static_cast<float>(numbers[3 * i + static_cast<size_t>(channel)]);
      if (!std::isfinite(value)) {
        return json.Problem("the light holds a number that is too large");
      }
      light[i][channel] = value;
    }
  }
  return light;
}

Json FormatSky(const light::ShRgb& light) {
  Json numbers = Json::array();
  for (const glm::vec3& coefficient : light) {
    numbers.insert(numbers.end(), {coefficient.r, coefficient.g, coefficient.b});
  }
  return numbers;
}

Result<light::ProbeLight> ParseLight(const JsonView& json) {
  light::ProbeLight light;
  LARARIUM_ASSIGN_OR_RETURN(light.sky, ParseSky(json));
  if (json.Has("sun")) {
    LARARIUM_ASSIGN_OR_RETURN(const JsonView sun, json.Field("sun"));
    LARARIUM_ASSIGN_OR_RETURN(light.sun, ParseSun(sun));
  }
  return light;
}

Status ParseProbe(const JsonView& json, PlaceEntry& place) {
  light::PlacedProbe& probe = place.probes.emplace_back();
  std::string& glossy = place.glossy.emplace_back();
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<double> at, json.Numbers("position", 3));
  for (int axis = 0; axis < 3; ++axis) {
    if (!(std::abs(at[static_cast<size_t>(axis)]) < kMaxProbeDistance)) {
      return json.Problem("the probe is too far away");
    }
    probe.position[axis] = static_cast<float>(at[static_cast<size_t>(axis)]);
  }
  LARARIUM_ASSIGN_OR_RETURN(probe.hour, json.Number("hour", 0.0, 24.0));
  LARARIUM_ASSIGN_OR_RETURN(probe.light, ParseLight(json));
  if (json.Has("glossy")) {
    LARARIUM_ASSIGN_OR_RETURN(glossy, ParseMemberName(json, "glossy"));
  }
  return Status();
}

Status ParseProbes(const JsonView& json, PlaceEntry& place) {
  LARARIUM_ASSIGN_OR_RETURN(const JsonView field, json.Field("probes"));
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<JsonView> items,
                            field.Array(light::kMaxPlacedProbes));
  for (const JsonView& item : items) {
    LARARIUM_RETURN_IF_ERROR(ParseProbe(item, place));
  }
  return Status();
}

Json FormatProbe(const light::PlacedProbe& probe) {
  Json json = {{"position", {probe.position.x, probe.position.y, probe.position.z}},
               {"hour", probe.hour},
               {"light", FormatSky(probe.light.sky)}};
  if (probe.light.sun) {
    json["sun"] = FormatSun(*probe.light.sun);
  }
  return json;
}

Result<OccluderEntry> ParseOccluder(const JsonView& json) {
  OccluderEntry occluder;
  LARARIUM_ASSIGN_OR_RETURN(occluder.name, json.Text("name", kMaxName));
  LARARIUM_ASSIGN_OR_RETURN(occluder.mesh, ParseMemberName(json, "mesh"));
  LARARIUM_ASSIGN_OR_RETURN(occluder.stage_from_mesh, ParseSimilarity(json, "stage_from_mesh"));
  for (const auto& [key, does] : {std::pair{"blocks_sound", &occluder.blocks_sound},
                                  {"blocks_walking", &occluder.blocks_walking},
                                  {"receives_shadow", &occluder.receives_shadow}}) {
    LARARIUM_ASSIGN_OR_RETURN(const JsonView field, json.Field(key));
    LARARIUM_ASSIGN_OR_RETURN(*does, field.Boolean());
  }
  return occluder;
}

Result<PlaceEntry> ParsePlace(const JsonView& json) {
  PlaceEntry place;
  LARARIUM_ASSIGN_OR_RETURN(place.name, json.Text("name", kMaxName));
  LARARIUM_ASSIGN_OR_RETURN(place.scene, ParseMemberName(json, "scene"));
  LARARIUM_ASSIGN_OR_RETURN(place.map_from_stage, ParseSimilarity(json, "map_from_stage"));
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<double> nudge, json.Numbers("camera_nudge", 3));
  place.camera_nudge = {nudge[0], nudge[1], nudge[2]};
  if (json.Has("camera")) {
    LARARIUM_ASSIGN_OR_RETURN(const JsonView camera, json.Field("camera"));
    LARARIUM_ASSIGN_OR_RETURN(place.camera, light::ParseCameraTraits(camera));
  }
  LARARIUM_ASSIGN_OR_RETURN(place.occluders,
                            ParseList(json, "occluders", kMaxOccluders, ParseOccluder));
  LARARIUM_RETURN_IF_ERROR(ParseProbes(json, place));
  if (json.Has("acoustics")) {
    LARARIUM_ASSIGN_OR_RETURN(const JsonView acoustics, json.Field("acoustics"));
    LARARIUM_ASSIGN_OR_RETURN(place.acoustics, stage::ParseAcoustics(acoustics));
  }
  return place;
}

Result<SoundEntry> ParseSound(const JsonView& json) {
  SoundEntry sound;
  LARARIUM_ASSIGN_OR_RETURN(sound.name, json.Text("name", kMaxName));
  LARARIUM_ASSIGN_OR_RETURN(sound.file, ParseMemberName(json, "file"));
  return sound;
}

Result<CastEntry> ParseCast(const JsonView& json) {
  CastEntry cast;
  LARARIUM_ASSIGN_OR_RETURN(cast.name, json.Text("name", kMaxName));
  LARARIUM_ASSIGN_OR_RETURN(cast.human, ParseMemberName(json, "human"));
  return cast;
}

Result<ObjectEntry> ParseObject(const JsonView& json) {
  ObjectEntry object;
  LARARIUM_ASSIGN_OR_RETURN(object.name, json.Text("name", kMaxName));
  LARARIUM_ASSIGN_OR_RETURN(object.prop, ParseMemberName(json, "prop"));
  LARARIUM_ASSIGN_OR_RETURN(const geometry::Similarity3 stage_from_object,
                            ParseSimilarity(json, "stage_from_object"));
  if (stage_from_object.scale != 1.0) {
    return json.Problem("an object's transform has a scale");
  }
  object.stage_from_object = {stage_from_object.rotation, stage_from_object.translation};
  return object;
}

Result<SpokenEntry> ParseSpoken(const JsonView& json) {
  SpokenEntry spoken;
  LARARIUM_ASSIGN_OR_RETURN(spoken.visemes, ParseMemberName(json, "visemes"));
  if (json.Has("sound")) {
    LARARIUM_ASSIGN_OR_RETURN(spoken.sound, ParseMemberName(json, "sound"));
  }
  return spoken;
}

Result<LineEntry> ParseLine(const JsonView& json) {
  LineEntry line;
  LARARIUM_ASSIGN_OR_RETURN(line.name, json.Text("name", kMaxName));
  LARARIUM_ASSIGN_OR_RETURN(line.speaker, json.Text("speaker", kMaxName));
  LARARIUM_ASSIGN_OR_RETURN(const JsonView spoken, json.Field("spoken"));
  if (!spoken.json().is_object() || spoken.json().size() > kMaxLanguages) {
    return spoken.Problem("must be an object of at most 64 languages");
  }
  for (const auto& [language, ignored] : spoken.json().items()) {
    LARARIUM_ASSIGN_OR_RETURN(const JsonView entry, spoken.Field(language));
    LARARIUM_ASSIGN_OR_RETURN(line.spoken[language], ParseSpoken(entry));
  }
  return line;
}

Result<SpokenLanguage> ParseSpokenLanguage(const JsonView& json) {
  SpokenLanguage language;
  LARARIUM_ASSIGN_OR_RETURN(language.name, json.Text("name", kMaxLanguageTag));
  if (json.Has("captions")) {
    LARARIUM_ASSIGN_OR_RETURN(language.captions, ParseMemberName(json, "captions"));
  }
  return language;
}

// Parses the lines, their spoken and written languages, and the font.
Status ParseLines(const JsonView& json, ShowManifest& manifest) {
  LARARIUM_ASSIGN_OR_RETURN(manifest.lines, ParseOptionalList(json, "lines", kMaxLines, ParseLine));
  LARARIUM_ASSIGN_OR_RETURN(manifest.spoken,
                            ParseOptionalList(json, "spoken", kMaxLanguages, ParseSpokenLanguage));
  LARARIUM_ASSIGN_OR_RETURN(
      manifest.descriptions,
      ParseOptionalList(json, "descriptions", kMaxLanguages, ParseSpokenLanguage));
  if (json.Has("captions")) {
    LARARIUM_ASSIGN_OR_RETURN(const JsonView captions, json.Field("captions"));
    LARARIUM_ASSIGN_OR_RETURN(const std::vector<JsonView> list, captions.Array(kMaxLanguages));
    for (const JsonView& language : list) {
      LARARIUM_ASSIGN_OR_RETURN(manifest.captions.emplace_back(), language.Text(kMaxLanguageTag));
    }
  }
  if (json.Has("caption_font")) {
    LARARIUM_ASSIGN_OR_RETURN(const JsonView font, json.Field("caption_font"));
    manifest.caption_font.emplace();
    LARARIUM_ASSIGN_OR_RETURN(manifest.caption_font->metrics, ParseMemberName(font, "metrics"));
    LARARIUM_ASSIGN_OR_RETURN(manifest.caption_font->atlas, ParseMemberName(font, "atlas"));
  }
  return Status();
}

void CollectLineMembers(const ShowManifest& manifest, std::vector<std::string_view>& used) {
  for (const LineEntry& line : manifest.lines) {
    for (const auto& [language, spoken] : line.spoken) {
      used.push_back(spoken.visemes);
      if (!spoken.sound.empty()) {
        used.push_back(spoken.sound);
      }
    }
  }
  for (const std::vector<SpokenLanguage>* languages : {&manifest.spoken, &manifest.descriptions}) {
    for (const SpokenLanguage& language : *languages) {
      if (!language.captions.empty()) {
        used.push_back(language.captions);
      }
    }
  }
  if (manifest.caption_font) {
    used.push_back(manifest.caption_font->metrics);
    used.push_back(manifest.caption_font->atlas);
  }
}

Json FormatLanguages(const std::vector<SpokenLanguage>& languages) {
  Json list = Json::array();
  for (const SpokenLanguage& language : languages) {
    list.push_back({{"name", language.name}});
    if (!language.captions.empty()) {
      list.back()["captions"] = language.captions;
    }
  }
  return list;
}

void FormatLines(const ShowManifest& manifest, Json& json) {
  json["lines"] = Json::array();
  json["spoken"] = FormatLanguages(manifest.spoken);
  if (!manifest.descriptions.empty()) {
    json["descriptions"] = FormatLanguages(manifest.descriptions);
  }
  json["captions"] = manifest.captions;
  for (const LineEntry& line : manifest.lines) {
    Json spoken = Json::object();
    for (const auto& [language, entry] : line.spoken) {
      spoken[language] = {{"visemes", entry.visemes}};
      if (!entry.sound.empty()) {
        spoken[language]["sound"] = entry.sound;
      }
    }
    json["lines"].push_back(
        {{"name", line.name}, {"speaker", line.speaker}, {"spoken", std::move(spoken)}});
  }
  if (manifest.caption_font) {
    json["caption_font"] = {{"metrics", manifest.caption_font->metrics},
                            {"atlas", manifest.caption_font->atlas}};
  }
}

Result<Member> ParseMember(const JsonView& json) {
  Member member;
  LARARIUM_ASSIGN_OR_RETURN(member.name, ParseMemberName(json, "name"));
  LARARIUM_ASSIGN_OR_RETURN(const int64_t size, json.Integer("size", 0, kMaxBundleBytes));
  LARARIUM_ASSIGN_OR_RETURN(const std::string text, json.Text("sha256", 64));
  const std::optional<Sha256> hash = ParseSha256(text);
  if (!hash) {
    return json.Problem("the field \"sha256\" is not 64 hexadecimal digits");
  }
  member.size = static_cast<uint64_t>(size);
  member.sha256 = *hash;
  return member;
}

// Checks that every named member is listed.
Status CheckReferences(const ShowManifest& manifest, const JsonView& json) {
  std::set<std::string_view> known;
  for (const Member& member : manifest.members) {
    known.insert(member.name);
  }
  std::vector<std::string_view> used = {manifest.drama};
  for (const CastEntry& cast : manifest.cast) {
    used.push_back(cast.human);
  }
  for (const ObjectEntry& object : manifest.objects) {
    used.push_back(object.prop);
  }
  CollectLineMembers(manifest, used);
  if (!manifest.paradata.empty()) {
    used.push_back(manifest.paradata);
  }
  for (const SoundEntry& sound : manifest.sounds) {
    used.push_back(sound.file);
  }
  for (const PlaceEntry& place : manifest.places) {
    used.push_back(place.scene);
    for (const std::string& glossy : place.glossy) {
      if (!glossy.empty()) {
        used.push_back(glossy);
      }
    }
    for (const OccluderEntry& occluder : place.occluders) {
      used.push_back(occluder.mesh);
    }
  }
  for (const std::string_view name : used) {
    if (!known.contains(name)) {
      return json.Problem("the member '" + std::string(name) + "' is used but not listed",
                          "export the bundle again");
    }
  }
  return Status();
}

}  // namespace

bool Describes(const ShowManifest& manifest, const LineEntry& line) {
  return line.speaker == LineEntry::kDescription &&
         std::none_of(manifest.cast.begin(), manifest.cast.end(),
                      [&](const CastEntry& cast) { return cast.name == line.speaker; });
}

Result<ShowManifest> ParseShowManifest(std::string_view text, const std::string& where) {
  LARARIUM_ASSIGN_OR_RETURN(const Json root, ParseJson(text, where));
  const JsonView json(root, where);
  LARARIUM_ASSIGN_OR_RETURN(const int64_t schema,
                            json.Integer("schema", 1, std::numeric_limits<int32_t>::max()));
  if (schema != ShowManifest::kSchema) {
    return json.Problem(
        "the bundle has version " + std::to_string(schema) + ", this program reads version " +
            std::to_string(ShowManifest::kSchema),
        schema > ShowManifest::kSchema ? "update the player" : "export the bundle again");
  }
  ShowManifest manifest;
  LARARIUM_ASSIGN_OR_RETURN(manifest.title, json.Text("title", kMaxTitle));
  LARARIUM_ASSIGN_OR_RETURN(manifest.credits, json.Text("credits", kMaxCredits));
  LARARIUM_ASSIGN_OR_RETURN(manifest.drama, ParseMemberName(json, "drama"));
  LARARIUM_ASSIGN_OR_RETURN(manifest.places, ParseList(json, "places", kMaxPlaces, ParsePlace));
  LARARIUM_ASSIGN_OR_RETURN(manifest.cast, ParseList(json, "cast", kMaxCast, ParseCast));
  LARARIUM_ASSIGN_OR_RETURN(manifest.objects,
                            ParseOptionalList(json, "objects", kMaxObjects, ParseObject));
  LARARIUM_RETURN_IF_ERROR(ParseLines(json, manifest));
  LARARIUM_ASSIGN_OR_RETURN(manifest.sounds,
                            ParseOptionalList(json, "sounds", kMaxSounds, ParseSound));
  if (json.Has("paradata")) {
    LARARIUM_ASSIGN_OR_RETURN(manifest.paradata, ParseMemberName(json, "paradata"));
  }
  LARARIUM_ASSIGN_OR_RETURN(manifest.members,
                            ParseList(json, "members", kMaxMembers - 1, ParseMember));
  if (manifest.places.empty()) {
    return json.Problem("the show has no place", "export the bundle again");
  }
  LARARIUM_RETURN_IF_ERROR(CheckReferences(manifest, json));
  return manifest;
}

std::string FormatShowManifest(const ShowManifest& manifest) {
  Json json = {{"schema", ShowManifest::kSchema}, {"title", manifest.title},
               {"credits", manifest.credits},     {"drama", manifest.drama},
               {"places", Json::array()},         {"cast", Json::array()},
               {"objects", Json::array()},        {"members", Json::array()}};
  for (const PlaceEntry& place : manifest.places) {
    Json occluders = Json::array();
    for (const OccluderEntry& occluder : place.occluders) {
      occluders.push_back({{"name", occluder.name},
                           {"mesh", occluder.mesh},
                           {"stage_from_mesh", FormatSimilarity(occluder.stage_from_mesh)},
                           {"blocks_sound", occluder.blocks_sound},
                           {"blocks_walking", occluder.blocks_walking},
                           {"receives_shadow", occluder.receives_shadow}});
    }
    const Eigen::Vector3d& nudge = place.camera_nudge;
    json["places"].push_back({{"name", place.name},
                              {"scene", place.scene},
                              {"map_from_stage", FormatSimilarity(place.map_from_stage)},
                              {"camera_nudge", {nudge.x(), nudge.y(), nudge.z()}},
                              {"occluders", std::move(occluders)},
                              {"probes", Json::array()}});
    if (place.camera) {
      json["places"].back()["camera"] = light::FormatCameraTraits(*place.camera);
    }
    for (size_t i = 0; i < place.probes.size(); ++i) {
      Json probe = FormatProbe(place.probes[i]);
      if (i < place.glossy.size() && !place.glossy[i].empty()) {
        probe["glossy"] = place.glossy[i];
      }
      json["places"].back()["probes"].push_back(std::move(probe));
    }
    if (place.acoustics != stage::Acoustics()) {
      json["places"].back()["acoustics"] = stage::FormatAcoustics(place.acoustics);
    }
  }
  for (const CastEntry& cast : manifest.cast) {
    json["cast"].push_back({{"name", cast.name}, {"human", cast.human}});
  }
  for (const ObjectEntry& object : manifest.objects) {
    const geometry::Rigid3& pose = object.stage_from_object;
    json["objects"].push_back(
        {{"name", object.name},
         {"prop", object.prop},
         {"stage_from_object", FormatSimilarity({1.0, pose.rotation, pose.translation})}});
  }
  FormatLines(manifest, json);
  for (const SoundEntry& sound : manifest.sounds) {
    json["sounds"].push_back({{"name", sound.name}, {"file", sound.file}});
  }
  if (!manifest.paradata.empty()) {
    json["paradata"] = manifest.paradata;
  }
  for (const Member& member : manifest.members) {
    json["members"].push_back(
        {{"name", member.name}, {"size", member.size}, {"sha256", FormatSha256(member.sha256)}});
  }
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace lararium::bundle
