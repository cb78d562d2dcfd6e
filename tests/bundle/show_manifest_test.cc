#include "shared/bundle/show_manifest.h"

#include <gmock/gmock.h>

#include "shared/core/json.h"
#include "tests/bundle/example_show.h"

namespace lararium::bundle {
namespace {

using ::testing::HasSubstr;

ShowManifest Listed() {
  ShowManifest manifest = test::ExampleManifest();
  uint64_t size = 1;
  for (const char* name :
       {"drama.lua", "places/0/scene.larscene", "places/0/occluder0.larmesh", "cast/0.larhuman"}) {
    manifest.members.push_back({name, size++, ComputeSha256({})});
  }
  return manifest;
}

Result<ShowManifest> Parse(const Json& json) {
  return ParseShowManifest(json.dump(), "show.larshow: manifest.json");
}

TEST(ShowManifest, RoundTrips) {
  const ShowManifest manifest = Listed();
  const std::string text = FormatShowManifest(manifest);
  const auto parsed = ParseShowManifest(text, "manifest.json");
  ASSERT_TRUE(parsed.ok()) << parsed.message();
  EXPECT_EQ(FormatShowManifest(*parsed), text);
  EXPECT_EQ(parsed->title, manifest.title);
  ASSERT_EQ(parsed->places[0].probes.size(), 1u);
  const light::PlacedProbe& probe = parsed->places[0].probes[0];
  const light::PlacedProbe& expected = manifest.places[0].probes[0];
  EXPECT_EQ(probe.position, expected.position);
  EXPECT_EQ(probe.hour, 9.5);
  EXPECT_EQ(probe.light.sky, expected.light.sky);
  ASSERT_TRUE(probe.light.sun);
  EXPECT_EQ(probe.light.sun->direction, expected.light.sun->direction);
  EXPECT_EQ(probe.light.sun->irradiance, expected.light.sun->irradiance);
  EXPECT_EQ(probe.light.sun->angular_radius, 0.005f);
  EXPECT_EQ(parsed->places[0].map_from_stage.scale, 0.37);
  EXPECT_EQ(parsed->places[0].map_from_stage.rotation.coeffs(),
            manifest.places[0].map_from_stage.rotation.coeffs());
  EXPECT_EQ(parsed->places[0].camera_nudge, manifest.places[0].camera_nudge);
  EXPECT_EQ(parsed->places[0].camera, manifest.places[0].camera);
  EXPECT_EQ(parsed->places[0].occluders[0].mesh, "places/0/occluder0.larmesh");
  EXPECT_EQ(parsed->cast[0].human, "cast/0.larhuman");
  EXPECT_EQ(parsed->members[3].size, 4u);
}

TEST(ShowManifest, ProbesMayHaveNoSun) {
  Json json = Json::parse(FormatShowManifest(Listed()));
  json["places"][0]["probes"][0].erase("sun");
  const auto parsed = Parse(json);
  ASSERT_TRUE(parsed.ok()) << parsed.message();
  EXPECT_FALSE(parsed->places[0].probes.at(0).light.sun);
}

TEST(ShowManifest, ProbesMayHaveReflections) {
  ShowManifest manifest = Listed();
  manifest.places[0].glossy = {"places/0/probe0.gloss"};
  EXPECT_THAT(ParseShowManifest(FormatShowManifest(manifest), "m").message(),
              HasSubstr("'places/0/probe0.gloss' is used but not listed"));
  manifest.members.push_back({"places/0/probe0.gloss", 1, ComputeSha256({})});
  const auto parsed = ParseShowManifest(FormatShowManifest(manifest), "m");
  ASSERT_TRUE(parsed.ok()) << parsed.message();
  EXPECT_EQ(parsed->places[0].glossy, manifest.places[0].glossy);
}

TEST(ShowManifest, PeopleAndThingsMayHaveApartWhatTheDramaNeeds) {
  ShowManifest manifest = Listed();
  manifest.cast[0].motion = "cast/0.motion.larhuman";
  EXPECT_THAT(ParseShowManifest(FormatShowManifest(manifest), "m").message(),
              HasSubstr("'cast/0.motion.larhuman' is used but not listed"));
  manifest.members.push_back({"cast/0.motion.larhuman", 1, ComputeSha256({})});
  const auto parsed = ParseShowManifest(FormatShowManifest(manifest), "m");
  ASSERT_TRUE(parsed.ok()) << parsed.message();
  EXPECT_EQ(parsed->cast[0].motion, manifest.cast[0].motion);
  manifest.objects = {{"cup", "drama.lua", {}, "props/0.extent.larprop"}};
  EXPECT_THAT(ParseShowManifest(FormatShowManifest(manifest), "m").message(),
              HasSubstr("'props/0.extent.larprop' is used but not listed"));
}

TEST(ShowManifest, ParadataAreAMember) {
  ShowManifest manifest = Listed();
  manifest.paradata = "paradata.json";
  EXPECT_THAT(ParseShowManifest(FormatShowManifest(manifest), "m").message(),
              HasSubstr("'paradata.json' is used but not listed"));
  manifest.members.push_back({"paradata.json", 1, ComputeSha256({})});
  const auto parsed = ParseShowManifest(FormatShowManifest(manifest), "m");
  ASSERT_TRUE(parsed.ok()) << parsed.message();
  EXPECT_EQ(parsed->paradata, manifest.paradata);
}

TEST(ShowManifest, AFolderMayNameTheFleetOfItsPages) {
  ShowManifest manifest = Listed();
  manifest.fleet = {"wss://broker.museum.example/pompeii", "red", "abc"};
  const auto parsed = ParseShowManifest(FormatShowManifest(manifest), "manifest.json");
  ASSERT_TRUE(parsed.ok()) << parsed.message();
  ASSERT_TRUE(parsed->fleet);
  EXPECT_EQ(parsed->fleet->address, manifest.fleet->address);
  EXPECT_EQ(parsed->fleet->group, "red");
  EXPECT_EQ(parsed->fleet->password, "abc");
  const auto refusal = [](const FleetEntry& fleet) {
    return CheckFleet(fleet, "--fleet").message();
  };
  EXPECT_THAT(refusal({"ws://host/site", "", "abc"}), HasSubstr("wss://HOST/SITE"));
  EXPECT_THAT(refusal({"wss://host", "", "abc"}), HasSubstr("name of a site"));
  EXPECT_THAT(refusal({"wss://host/site", "a/b", "abc"}), HasSubstr("not a valid name"));
  EXPECT_THAT(refusal({"wss://host/site", "", ""}), HasSubstr("visitors.password"));
  manifest.fleet->address = "mqtts://host/site";
  EXPECT_THAT(ParseShowManifest(FormatShowManifest(manifest), "manifest.json").message(),
              HasSubstr("wss://HOST/SITE"));
}

TEST(ShowManifest, BundlesAndFoldersOfOneDramaHaveOneDramaVersion) {
  const ShowManifest bundle = Listed();
  ShowManifest folder = bundle;
  folder.page.push_back({"index.html", 3, ComputeSha256({})});
  folder.places[0].map_from_stage.scale = 0.38;
  folder.cast[0].motion = "cast/0.motion.larhuman";
  for (Member& member : folder.members) {
    if (member.name.starts_with("cast/") || member.name.ends_with(".larscene")) {
      member.size = 900;
    }
    member.packed = 1;
  }
  EXPECT_EQ(DramaVersion(bundle), DramaVersion(folder));
  EXPECT_NE(ShowVersion(bundle), ShowVersion(folder));
  EXPECT_EQ(DramaVersion(bundle).size(), 12u);
  for (const char* deciding : {"drama.lua", "places/0/occluder0.larmesh"}) {
    ShowManifest other = bundle;
    for (Member& member : other.members) {
      member.size += member.name == deciding ? 1 : 0;
    }
    EXPECT_NE(DramaVersion(other), DramaVersion(bundle)) << deciding;
  }
}

TEST(ShowManifest, ANewerSchemaAsksForANewerPlayer) {
  Json json = Json::parse(FormatShowManifest(Listed()));
  json["schema"] = ShowManifest::kSchema + 1;
  EXPECT_THAT(Parse(json).message(), HasSubstr("update the player"));
}

TEST(ShowManifest, AnEarlierSchemaAsksForANewExport) {
  Json json = Json::parse(FormatShowManifest(Listed()));
  json["schema"] = ShowManifest::kSchema - 1;
  EXPECT_THAT(Parse(json).message(), HasSubstr("export the bundle again"));
}

TEST(ShowManifest, RefusesEveryMissingField) {
  const Json json = Json::parse(FormatShowManifest(Listed()));
  for (const auto& [key, value] : json.items()) {
    Json without = json;
    without.erase(key);
    EXPECT_THAT(Parse(without).message(), HasSubstr(key));
  }
}

TEST(ShowManifest, KeepsObjectsLinesAndLanguages) {
  ShowManifest manifest = Listed();
  manifest.members.push_back({"props/0.larprop", 1, ComputeSha256({})});
  manifest.members.push_back({"speech/0.json", 1, ComputeSha256({})});
  geometry::Rigid3 pose;
  pose.rotation = Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitY());
  pose.translation = {1.0, 0.5, -2.0};
  manifest.objects = {{"jar", "props/0.larprop", pose}, {"jar2", "props/0.larprop", {}}};
  manifest.members.push_back({"speech/0.flac", 1, ComputeSha256({})});
  manifest.members.push_back({"captions.json", 1, ComputeSha256({})});
  manifest.members.push_back({"font.json", 1, ComputeSha256({})});
  manifest.members.push_back({"font.png", 1, ComputeSha256({})});
  manifest.lines = {{"greeting",
                     "keeper",
                     {{"la", {"speech/0.json", "speech/0.flac"}}, {"en", {"speech/0.json", ""}}}}};
  manifest.spoken = {{"la", "captions.json"}, {"en", ""}};
  manifest.members.push_back({"descriptions.json", 1, ComputeSha256({})});
  manifest.descriptions = {{"it", "descriptions.json"}, {"en", ""}};
  manifest.captions = {"it", "en"};
  manifest.caption_font = {"font.json", "font.png"};
  const auto parsed = ParseShowManifest(FormatShowManifest(manifest), "manifest.json");
  ASSERT_TRUE(parsed.ok()) << parsed.message();
  ASSERT_EQ(parsed->objects.size(), 2u);
  EXPECT_EQ(parsed->objects[0].stage_from_object.translation, pose.translation);
  EXPECT_EQ(parsed->objects[0].stage_from_object.rotation.coeffs(), pose.rotation.coeffs());
  EXPECT_EQ(parsed->objects[1].prop, "props/0.larprop");
  const LineEntry& line = parsed->lines.at(0);
  EXPECT_EQ(line.name, "greeting");
  EXPECT_EQ(line.speaker, "keeper");
  EXPECT_EQ(line.spoken.at("la").sound, "speech/0.flac");
  EXPECT_EQ(line.spoken.at("en").sound, "");
  EXPECT_EQ(parsed->spoken.at(0).captions, "captions.json");
  EXPECT_EQ(parsed->captions, manifest.captions);
  ASSERT_EQ(parsed->descriptions.size(), 2u);
  EXPECT_EQ(parsed->descriptions[0].name, "it");
  EXPECT_EQ(parsed->descriptions[0].captions, "descriptions.json");
  EXPECT_EQ(parsed->caption_font->atlas, "font.png");
  for (const char* missing : {"speech/0.flac", "captions.json", "descriptions.json", "font.png"}) {
    ShowManifest without = manifest;
    std::erase_if(without.members, [&](const Member& member) { return member.name == missing; });
    EXPECT_THAT(ParseShowManifest(FormatShowManifest(without), "m").message(),
                HasSubstr("is used but not listed"));
  }
}

TEST(ShowManifest, RefusesObjectsThatAreNotThereOrHaveAScale) {
  ShowManifest manifest = Listed();
  manifest.objects = {{"jar", "props/0.larprop", {}}};
  EXPECT_THAT(ParseShowManifest(FormatShowManifest(manifest), "m").message(),
              HasSubstr("'props/0.larprop' is used but not listed"));
  manifest.members.push_back({"props/0.larprop", 1, ComputeSha256({})});
  Json json = Json::parse(FormatShowManifest(manifest));
  json["objects"][0]["stage_from_object"]["scale"] = 2.0;
  EXPECT_THAT(Parse(json).message(), HasSubstr("scale"));
}

TEST(ShowManifest, RefusesEveryFieldOfAnotherType) {
  const Json flat = Json::parse(FormatShowManifest(Listed())).flatten();
  for (const auto& [path, value] : flat.items()) {
    for (const Json& wrong : {Json(true), Json(nullptr), Json::object()}) {
      Json changed = flat.unflatten();
      changed[Json::json_pointer(path)] = wrong;
      EXPECT_FALSE(Parse(changed).ok()) << path << " " << wrong;
    }
  }
}

TEST(ShowManifest, RefusesWhatCannotBe) {
  const struct {
    const char* path;
    Json value;
    const char* problem;
  } kWrong[] = {
      {"/places/0/map_from_stage/scale", 0, "between"},
      {"/places/0/map_from_stage/rotation", {1, 1, 0, 0}, "unit quaternion"},
      {"/places/0/probes/0/light/4", 1e300, "too large"},
      {"/places/0/probes/0/light", Json::array({1}), "108 numbers"},
      {"/places/0/probes/0/sun/direction", {1, 1, 0}, "unit vector"},
      {"/places/0/probes/0/sun/irradiance", {1, -1, 0}, "irradiance of the sun"},
      {"/places/0/probes/0/sun/angular_radius", 0.2, "angular_radius"},
      {"/places/0/probes/0/position", {1e9, 0, 0}, "too far away"},
      {"/places/0/probes/0/hour", 25, "hour"},
      {"/places/0/scene", "../x", "member name"},
      {"/places/0/scene", "other", "not listed"},
      {"/places", Json::array(), "no place"},
      {"/cast/0/name", "", "empty or used twice"},
      {"/members/0/sha256", "12", "hexadecimal"},
      {"/members/0/size", -1, "whole number"},
      {"/members/1/name", "drama.lua", "used twice"},
      {"/members/1/name", "manifest.json", "member name"},
      {"/title", std::string(2000, 'x'), "longer"},
  };
  for (const auto& wrong : kWrong) {
    Json json = Json::parse(FormatShowManifest(Listed()));
    json[Json::json_pointer(wrong.path)] = wrong.value;
    const auto parsed = Parse(json);
    ASSERT_FALSE(parsed.ok()) << wrong.path;
    EXPECT_THAT(parsed.message(), HasSubstr(wrong.problem)) << wrong.path;
    EXPECT_THAT(parsed.message(), HasSubstr("show.larshow: manifest.json"));
  }
}

TEST(ShowManifest, HoldsSeveralPlacesUnderDifferentNames) {
  ShowManifest manifest = Listed();
  manifest.places.push_back(manifest.places[0]);
  manifest.places[1].name = "yard";
  manifest.places[1].map_from_stage.scale = 2.0;
  const auto parsed = ParseShowManifest(FormatShowManifest(manifest), "manifest.json");
  ASSERT_TRUE(parsed.ok()) << parsed.message();
  ASSERT_EQ(parsed->places.size(), 2u);
  EXPECT_EQ(parsed->places[0].map_from_stage.scale, 0.37);
  EXPECT_EQ(parsed->places[1].name, "yard");
  EXPECT_EQ(parsed->places[1].map_from_stage.scale, 2.0);

  Json json = Json::parse(FormatShowManifest(manifest));
  json["places"][1]["name"] = "maquette";
  EXPECT_THAT(Parse(json).message(), HasSubstr("used twice"));
  json["places"][1]["name"] = "yard";
  json["places"][1]["scene"] = "places/1/scene.larscene";
  EXPECT_THAT(Parse(json).message(), HasSubstr("not listed"));
  json["places"] = Json(std::vector<Json>(65, json["places"][0]));
  EXPECT_FALSE(Parse(json).ok());
}

TEST(ShowManifest, SurvivesDeepNesting) {
  EXPECT_FALSE(ParseShowManifest(std::string(100'000, '['), "manifest.json").ok());
}

TEST(ShowManifest, KeepsSoundsAndAcoustics) {
  ShowManifest manifest = Listed();
  manifest.members.push_back({"sounds/0", 1, ComputeSha256({})});
  manifest.sounds = {{"bell", "sounds/0"}};
  manifest.places[0].acoustics.reverb = stage::Reverb::kVault;
  manifest.places[0].acoustics.ambience = {{"bell", -6.0f, std::nullopt}};
  const auto parsed = ParseShowManifest(FormatShowManifest(manifest), "manifest.json");
  ASSERT_TRUE(parsed.ok()) << parsed.message();
  EXPECT_EQ(parsed->sounds.at(0).name, "bell");
  EXPECT_EQ(parsed->sounds.at(0).file, "sounds/0");
  EXPECT_EQ(parsed->places[0].acoustics, manifest.places[0].acoustics);
  manifest.members.pop_back();
  EXPECT_THAT(ParseShowManifest(FormatShowManifest(manifest), "m").message(),
              HasSubstr("'sounds/0' is used but not listed"));
}

TEST(ShowManifest, KeepsWhatAnOccluderDoes) {
  for (bool OccluderEntry::*does : {&OccluderEntry::blocks_sound, &OccluderEntry::blocks_walking,
                                    &OccluderEntry::receives_shadow}) {
    ShowManifest manifest = Listed();
    manifest.places[0].occluders[0].*does = false;
    const auto parsed = ParseShowManifest(FormatShowManifest(manifest), "manifest.json");
    ASSERT_TRUE(parsed.ok()) << parsed.message();
    const OccluderEntry& read = parsed->places[0].occluders[0];
    EXPECT_FALSE(read.*does);
    EXPECT_EQ(int{read.blocks_sound} + int{read.blocks_walking} + int{read.receives_shadow}, 2);
  }
}

}  // namespace
}  // namespace lararium::bundle
