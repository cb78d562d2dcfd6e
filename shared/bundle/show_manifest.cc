#include "shared/bundle/show_manifest.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <set>
#include <span>
#include <utility>

#include "shared/bundle/fleet_address.h"
#include "shared/bundle/member_name.h"
#include "shared/bundle/zip_layout.h"
#include "shared/core/json.h"
#include "shared/core/json_fields.h"
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

void DescribeSimilarity(Fields& fields, geometry::Similarity3& a_from_b) {
  fields.Number("scale", a_from_b.scale, 1e-9, 1e9);
  const Eigen::Quaterniond& q = a_from_b.rotation;
  std::array<double, 4> wxyz = {q.w(), q.x(), q.y(), q.z()};
  fields.Numbers("rotation", wxyz);
  fields.Numbers("translation", std::span(a_from_b.translation.data(), 3));
  if (fields.reading()) {
    a_from_b.rotation = Eigen::Quaterniond(wxyz[0], wxyz[1], wxyz[2], wxyz[3]);
    fields.Require(std::abs(a_from_b.rotation.norm() - 1.0) < 1e-6,
                   "the rotation is not a unit quaternion");
  }
}

void DescribeSun(Fields& fields, light::Sun& sun) {
  light::DescribeFields(fields, sun);
  fields.Require(std::abs(glm::length(glm::dvec3(sun.direction)) - 1.0) < 1e-3,
                 "the direction of the sun is not a unit vector");
  const auto [least, most] = std::minmax({sun.irradiance.r, sun.irradiance.g, sun.irradiance.b});
  fields.Require(least >= 0.0f && most < kMaxIrradiance,
                 "the irradiance of the sun must be between 0 and a million");
}

void DescribeProbeLight(Fields& fields, light::ProbeLight& light) {
  const std::span<float> sky(&light.sky[0].x, 3 * light.sky.size());
  fields.Numbers("light", sky);
  fields.Require(std::all_of(sky.begin(), sky.end(), [](float v) { return std::isfinite(v); }),
                 "the light holds a number that is too large");
  fields.Object("sun", light.sun, DescribeSun);
}

// Describes a manifest, and collects the members that its entries name.
class ManifestDescription {
 public:
  explicit ManifestDescription(Fields& fields) : fields_(fields) {}

  void Describe(ShowManifest& manifest);

 private:
  void MemberName(std::string_view key, std::string& name) {
    fields_.Text(key, name, kMaxMemberName);
    fields_.Require(IsMemberName(name) && name != kManifestName,
                    "the field \"" + std::string(key) + "\" is not a valid member name");
  }
  void Member(std::string_view key, std::string& name) {
    MemberName(key, name);
    used_.push_back(name);
  }
  // The field is missing where the name is empty.
  void OptionalMember(std::string_view key, std::string& name) {
    if (fields_.Has(key, !name.empty())) {
      Member(key, name);
    }
  }

  // Describes a list of entries that have different names.
  template <typename T, typename Describe>
  void NamedList(const FieldKey& key, std::vector<T>& list, size_t max_count, Describe describe) {
    std::set<std::string_view> names;
    fields_.List(key, list, max_count, [&](Fields& fields, T& entry) {
      describe(entry);
      fields.Require(!entry.name.empty() && names.insert(entry.name).second,
                     "the name '" + entry.name + "' is empty or used twice");
    });
  }

  void Occluder(OccluderEntry& occluder);
  void Probe(const FieldKey& key, light::PlacedProbe& probe, PlaceEntry& place);
  void Place(PlaceEntry& place);
  void Object(ObjectEntry& object);
  void Line(LineEntry& line);
  void Languages(const FieldKey& key, std::vector<SpokenLanguage>& languages);
  void ListedMember(bundle::Member& member);

  Fields& fields_;
  std::vector<std::string> used_;
};

void ManifestDescription::Occluder(OccluderEntry& occluder) {
  fields_.Text("name", occluder.name, kMaxName);
  Member("mesh", occluder.mesh);
  fields_.Object("stage_from_mesh", occluder.stage_from_mesh, DescribeSimilarity);
  fields_.Flag("blocks_sound", occluder.blocks_sound);
  fields_.Flag("blocks_walking", occluder.blocks_walking);
  fields_.Flag("receives_shadow", occluder.receives_shadow);
}

void ManifestDescription::Probe(const FieldKey& key, light::PlacedProbe& probe, PlaceEntry& place) {
  fields_.Object(key, probe, [&](Fields& fields, light::PlacedProbe& /*probe*/) {
    fields.Numbers("position", std::span(&probe.position.x, 3));
    const glm::vec3 distance = glm::abs(probe.position);
    fields.Require(std::max({distance.x, distance.y, distance.z}) < kMaxProbeDistance,
                   "the probe is too far away");
    fields.Number("hour", probe.hour, 0.0, 24.0);
    DescribeProbeLight(fields, probe.light);
    std::string glossy = key.index < place.glossy.size() ? place.glossy[key.index] : "";
    OptionalMember("glossy", glossy);
    if (fields.reading()) {
      place.glossy.push_back(glossy);
    }
  });
}

void ManifestDescription::Place(PlaceEntry& place) {
  fields_.Text("name", place.name, kMaxName);
  Member("scene", place.scene);
  fields_.Object("map_from_stage", place.map_from_stage, DescribeSimilarity);
  fields_.Numbers("camera_nudge", std::span(place.camera_nudge.data(), 3));
  fields_.Object("camera", place.camera);
  NamedList("occluders", place.occluders, kMaxOccluders,
            [this](OccluderEntry& occluder) { Occluder(occluder); });
  fields_.List("probes", place.probes, light::kMaxPlacedProbes,
               [&](const FieldKey& key, light::PlacedProbe& probe) { Probe(key, probe, place); });
  fields_.Object(Optional("acoustics", place.acoustics != stage::Acoustics()), place.acoustics);
}

void ManifestDescription::Object(ObjectEntry& object) {
  fields_.Text("name", object.name, kMaxName);
  Member("prop", object.prop);
  OptionalMember("extent", object.extent);
  geometry::Similarity3 pose = {1.0, object.stage_from_object.rotation,
                                object.stage_from_object.translation};
  fields_.Object("stage_from_object", pose, DescribeSimilarity);
  fields_.Require(pose.scale == 1.0, "an object's transform has a scale");
  if (fields_.reading()) {
    object.stage_from_object = {pose.rotation, pose.translation};
  }
}

void ManifestDescription::Line(LineEntry& line) {
  fields_.Text("name", line.name, kMaxName);
  fields_.Text("speaker", line.speaker, kMaxName);
  fields_.Entries("spoken", line.spoken, kMaxLanguages, "must be an object of at most 64 languages",
                  [this](Fields& /*fields*/, SpokenEntry& spoken) {
                    Member("visemes", spoken.visemes);
                    OptionalMember("sound", spoken.sound);
                  });
}

void ManifestDescription::Languages(const FieldKey& key, std::vector<SpokenLanguage>& languages) {
  NamedList(key, languages, kMaxLanguages, [this](SpokenLanguage& language) {
    fields_.Text("name", language.name, kMaxLanguageTag);
    OptionalMember("captions", language.captions);
  });
}

void ManifestDescription::ListedMember(bundle::Member& member) {
  MemberName("name", member.name);
  fields_.Integer("size", member.size, 0, kMaxBundleBytes);
  std::string text = FormatSha256(member.sha256);
  fields_.Text("sha256", text, 64);
  if (fields_.reading()) {
    const std::optional<Sha256> hash = ParseSha256(text);
    fields_.Require(hash.has_value(), "the field \"sha256\" is not 64 hexadecimal digits");
    member.sha256 = hash.value_or(Sha256{});
  }
  fields_.Integer(Optional("packed", member.packed > 0), member.packed, 1, kMaxBundleBytes);
}

void DescribeFleet(Fields& fields, FleetEntry& fleet) {
  fields.Text("address", fleet.address, kMaxName);
  fields.Text(Optional("group", !fleet.group.empty()), fleet.group, kMaxName);
  fields.Text("password", fleet.password, kMaxName);
  fields.Check(fields.reading() ? CheckFleet(fleet, fields.where()) : Status());
}

void ManifestDescription::Describe(ShowManifest& manifest) {
  fields_.Schema(ShowManifest::kSchema,
                 "the bundle has version {}, this program reads version " +
                     std::to_string(ShowManifest::kSchema),
                 "update the player", "export the bundle again");
  fields_.Text("title", manifest.title, kMaxTitle);
  fields_.Text("credits", manifest.credits, kMaxCredits);
  Member("drama", manifest.drama);
  NamedList("places", manifest.places, kMaxPlaces, [this](PlaceEntry& place) { Place(place); });
  NamedList("cast", manifest.cast, kMaxCast, [this](CastEntry& cast) {
    fields_.Text("name", cast.name, kMaxName);
    Member("human", cast.human);
    OptionalMember("motion", cast.motion);
  });
  NamedList("objects", manifest.objects, kMaxObjects,
            [this](ObjectEntry& object) { Object(object); });
  NamedList("lines", manifest.lines, kMaxLines, [this](LineEntry& line) { Line(line); });
  Languages("spoken", manifest.spoken);
  Languages(Optional("descriptions", !manifest.descriptions.empty()), manifest.descriptions);
  fields_.List("captions", manifest.captions, kMaxLanguages,
               [this](const FieldKey& key, std::string& language) {
                 fields_.Text(key, language, kMaxLanguageTag);
               });
  fields_.Object("caption_font", manifest.caption_font,
                 [this](Fields& /*fields*/, CaptionFontEntry& font) {
                   Member("metrics", font.metrics);
                   Member("atlas", font.atlas);
                 });
  NamedList(Optional("sounds", !manifest.sounds.empty()), manifest.sounds, kMaxSounds,
            [this](SoundEntry& sound) {
              fields_.Text("name", sound.name, kMaxName);
              Member("file", sound.file);
            });
  OptionalMember("paradata", manifest.paradata);
  NamedList("members", manifest.members, kMaxMembers - 1,
            [this](bundle::Member& member) { ListedMember(member); });
  NamedList(Optional("page", !manifest.page.empty()), manifest.page, kMaxMembers - 1,
            [this](bundle::Member& file) { ListedMember(file); });
  fields_.Object("fleet", manifest.fleet, DescribeFleet);
  fields_.Require(!manifest.places.empty(), "the show has no place", "export the bundle again");
  std::set<std::string_view> listed;
  for (const bundle::Member& member : manifest.members) {
    listed.insert(member.name);
  }
  for (const std::string& name : used_) {
    fields_.Require(listed.contains(name), "the member '" + name + "' is used but not listed",
                    "export the bundle again");
  }
}

void DescribeManifest(Fields& fields, ShowManifest& manifest) {
  ManifestDescription(fields).Describe(manifest);
}

}  // namespace

Status CheckFleet(const FleetEntry& fleet, const std::string& where) {
  LARARIUM_RETURN_IF_ERROR(ParseFleetAddress(where, fleet.address, kPageScheme).status());
  if (!fleet.group.empty()) {
    LARARIUM_RETURN_IF_ERROR(CheckFleetName(where + " group", fleet.group));
  }
  const bool plain = std::all_of(fleet.password.begin(), fleet.password.end(),
                                 [](char c) { return c > ' ' && c <= '~'; });
  return plain && !fleet.password.empty()
             ? Status()
             : Status::Error(where, "the password of visitors' pages is empty or no plain text",
                             "take the file visitors.password of the fleet's folder");
}

bool Describes(const ShowManifest& manifest, const LineEntry& line) {
  return line.speaker == LineEntry::kDescription &&
         std::none_of(manifest.cast.begin(), manifest.cast.end(),
                      [&](const CastEntry& cast) { return cast.name == line.speaker; });
}

Result<ShowManifest> ParseShowManifest(std::string_view text, const std::string& where) {
  return ParseFields<ShowManifest>(text, where, DescribeManifest, UnknownFields::kIgnore);
}

std::string FormatShowManifest(const ShowManifest& manifest) {
  const Json json = FormatFields(manifest, DescribeManifest);
  return DumpJson(json, 1) + "\n";
}

std::string ShowVersion(const ShowManifest& manifest) {
  constexpr size_t kDigits = 12;
  const std::string text = FormatShowManifest(manifest);
  return FormatSha256(ComputeSha256(std::as_bytes(std::span(text)))).substr(0, kDigits);
}

std::string DramaVersion(ShowManifest manifest) {
  std::set<std::string> deciding = {manifest.drama};
  for (PlaceEntry& place : manifest.places) {
    for (const OccluderEntry& occluder : place.occluders) {
      deciding.insert(occluder.mesh);
    }
    PlaceEntry kept;
    kept.name = place.name;
    kept.occluders = std::move(place.occluders);
    place = std::move(kept);
  }
  for (CastEntry& person : manifest.cast) {
    person.motion.clear();
  }
  for (ObjectEntry& object : manifest.objects) {
    object.extent.clear();
  }
  for (const LineEntry& line : manifest.lines) {
    for (const auto& [language, spoken] : line.spoken) {
      deciding.insert(spoken.visemes);
    }
  }
  for (const std::vector<SpokenLanguage>* languages : {&manifest.spoken, &manifest.descriptions}) {
    for (const SpokenLanguage& language : *languages) {
      deciding.insert(language.captions);
    }
  }
  std::erase_if(manifest.members,
                [&](const Member& member) { return !deciding.contains(member.name); });
  for (Member& member : manifest.members) {
    member.packed = 0;
  }
  std::sort(manifest.members.begin(), manifest.members.end(),
            [](const Member& a, const Member& b) { return a.name < b.name; });
  manifest.credits.clear();
  manifest.caption_font.reset();
  manifest.page.clear();
  manifest.fleet.reset();
  return ShowVersion(manifest);
}

}  // namespace lararium::bundle
