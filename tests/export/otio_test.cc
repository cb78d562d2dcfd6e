#include "editor/export/otio.h"

#include <gmock/gmock.h>

#include <map>
#include <set>

namespace lararium::exporter {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

// The fields that OpenTimelineIO 0.15 serialises for each schema, and their types: o object, a
// array, s text, n number, b boolean, m object or null of a schema below.
// (docs/tutorials/otio-serialized-schema.md of its repository.)
struct Field {
  const char* name;
  const char* types;                   // Letters of the allowed types; 0: null.
  std::set<std::string> schemas = {};  // Schemas of the object or of the elements.
};

const std::map<std::string, std::vector<Field>>& Schemas() {
  static const std::set<std::string> kTime = {"RationalTime.1"};
  static const std::set<std::string> kRange = {"TimeRange.1"};
  static const std::set<std::string> kMarker = {"Marker.2"};
  static const std::vector<Field> kItem = {{"name", "s"},    {"source_range", "o0", kRange},
                                           {"effects", "a"}, {"markers", "a", kMarker},
                                           {"enabled", "b"}, {"metadata", "o"}};
  const auto with = [](std::vector<Field> more) {
    more.insert(more.begin(), kItem.begin(), kItem.end());
    return more;
  };
  static const std::map<std::string, std::vector<Field>> schemas = {
      {"Timeline.1",
       {{"name", "s"},
        {"global_start_time", "o0", kTime},
        {"tracks", "o", {"Stack.1"}},
        {"metadata", "o"}}},
      {"Stack.1", with({{"children", "a", {"Track.1"}}})},
      {"Track.1", with({{"kind", "s"}, {"children", "a", {"Clip.2", "Gap.1"}}})},
      {"Gap.1", with({})},
      {"Clip.2", with({{"media_references", "o"}, {"active_media_reference_key", "s"}})},
      {"Marker.2",
       {{"name", "s"},
        {"color", "s"},
        {"comment", "s"},
        {"marked_range", "o", kRange},
        {"metadata", "o"}}},
      {"TimeRange.1", {{"start_time", "o", kTime}, {"duration", "o", kTime}}},
      {"RationalTime.1", {{"rate", "n"}, {"value", "n"}}},
      {"ExternalReference.1",
       {{"name", "s"},
        {"target_url", "s"},
        {"available_range", "o0", kRange},
        {"available_image_bounds", "0"},
        {"metadata", "o"}}},
      {"MissingReference.1",
       {{"name", "s"},
        {"available_range", "o0", kRange},
        {"available_image_bounds", "0"},
        {"metadata", "o"}}},
  };
  return schemas;
}

char TypeOf(const Json& json) {
  return json.is_object()    ? 'o'
         : json.is_array()   ? 'a'
         : json.is_string()  ? 's'
         : json.is_number()  ? 'n'
         : json.is_boolean() ? 'b'
                             : '0';
}

// Lists the errors of a document, field by field.
void Validate(const Json& json, const std::string& place, std::vector<std::string>& problems) {
  const std::string schema = json.value("OTIO_SCHEMA", "none");
  const auto found = Schemas().find(schema);
  if (found == Schemas().end()) {
    problems.push_back(place + ": schema " + schema);
    return;
  }
  std::set<std::string> known = {"OTIO_SCHEMA"};
  for (const Field& field : found->second) {
    known.insert(field.name);
    const std::string here = place + "." + field.name;
    if (!json.contains(field.name)) {
      problems.push_back(here + ": missing");
      continue;
    }
    const Json& value = json[field.name];
    if (std::string(field.types).find(TypeOf(value)) == std::string::npos) {
      problems.push_back(here + ": type");
      continue;
    }
    const auto check = [&](const Json& element, const std::string& at) {
      Validate(element, at, problems);
      if (!field.schemas.contains(element.value("OTIO_SCHEMA", ""))) {
        problems.push_back(at + ": is no child of it");
      }
    };
    if (!field.schemas.empty() && value.is_object()) {
      check(value, here);
    }
    for (size_t i = 0; !field.schemas.empty() && value.is_array() && i < value.size(); ++i) {
      check(value[i], here + "[" + std::to_string(i) + "]");
    }
  }
  for (const auto& [key, value] : json.items()) {
    if (!known.contains(key)) {
      problems.push_back(place + "." + key + ": unknown");
    }
  }
  if (schema == "Clip.2") {
    for (const auto& [key, reference] : json["media_references"].items()) {
      Validate(reference, place + ".media_references." + key, problems);
    }
    if (!json["media_references"].contains(json["active_media_reference_key"])) {
      problems.push_back(place + ": its media is not there");
    }
    if (json["source_range"].is_null()) {
      problems.push_back(place + ": without media it needs a range");
    }
  }
}

std::vector<std::string> Problems(const Json& json) {
  std::vector<std::string> problems;
  Validate(json, "timeline", problems);
  return problems;
}

// The begin of each clip of a track, seconds.
std::vector<std::pair<std::string, double>> Clips(const Json& track) {
  std::vector<std::pair<std::string, double>> clips;
  double time = 0.0;
  for (const Json& child : track["children"]) {
    if (child["OTIO_SCHEMA"] == "Clip.2") {
      clips.emplace_back(child["name"], time);
    }
    const Json& duration = child["source_range"]["duration"];
    time += duration["value"].get<double>() / duration["rate"].get<double>();
  }
  return clips;
}

ShowTimeline Example() {
  ShowTimeline timeline;
  timeline.title = "A morning";
  timeline.tracks = {
      {"keeper speech",
       true,
       {{"vale", 5.0, 6.5, {}, "speech/la/vale.flac", 1.5}, {"salvete", 1.0, 2.0}}},
      {"keeper gaze", false, {{"a", 0.0, 4.0}, {"b", 1.0, 2.0}, {"c", 4.0, 4.5}, {"d", 3.0, 3.0}}}};
  timeline.markers = {{"noon", 12.0, 12.0}};
  return timeline;
}

TEST(Otio, IsAsItsSchemasSay) {
  const Json otio = FormatOtio(Example());
  EXPECT_THAT(Problems(otio), IsEmpty());
  EXPECT_EQ(otio["OTIO_SCHEMA"], "Timeline.1");
  EXPECT_THAT(Problems(FormatOtio({})), IsEmpty());
  // Checks that the validator itself finds errors.
  Json bad = otio;
  bad["tracks"]["children"][0]["children"][1].erase("effects");
  bad["tracks"]["children"][1]["kind"] = 3;
  bad["tracks"]["markers"][0]["OTIO_SCHEMA"] = "Marker.1";
  EXPECT_EQ(Problems(bad).size(), 4u);
}

TEST(Otio, ClipsLieWhereTheirBlocksDo) {
  const Json otio = FormatOtio(Example());
  const Json& tracks = otio["tracks"]["children"];
  ASSERT_EQ(tracks.size(), 3u);
  EXPECT_THAT(Clips(tracks[0]), ElementsAre(std::pair("salvete", 1.0), std::pair("vale", 5.0)));
  EXPECT_EQ(tracks[0]["kind"], "Audio");
  const Json& vale = tracks[0]["children"][3];
  EXPECT_EQ(vale["media_references"]["DEFAULT_MEDIA"]["target_url"], "speech/la/vale.flac");
  EXPECT_EQ(vale["source_range"]["duration"]["value"], 180.0);
}

TEST(Otio, WhatOverlapsGoesToAFurtherTrackAndMomentsAreMarkers) {
  const Json otio = FormatOtio(Example());
  const Json& tracks = otio["tracks"]["children"];
  EXPECT_THAT(Clips(tracks[1]), ElementsAre(std::pair("a", 0.0), std::pair("c", 4.0)));
  EXPECT_EQ(tracks[2]["name"], "keeper gaze 2");
  EXPECT_THAT(Clips(tracks[2]), ElementsAre(std::pair("b", 1.0)));
  ASSERT_EQ(tracks[1]["markers"].size(), 1u);
  EXPECT_EQ(tracks[1]["markers"][0]["name"], "d");
  EXPECT_EQ(otio["tracks"]["markers"][0]["marked_range"]["start_time"]["value"], 1440.0);
}

}  // namespace
}  // namespace lararium::exporter
