#include "editor/export/export.h"

#include <gmock/gmock.h>

#include "shared/bundle/bundle.h"
#include "shared/stage/mesh_file.h"
#include "shared/vision/scene_database.h"
#include "tests/stage/test_human.h"
#include "tests/stage/test_props.h"
#include "tests/support/synthetic_world.h"
#include "tests/support/test_files.h"

namespace lararium::exporter {
namespace {

using ::testing::HasSubstr;

ExportContent SmallShow() {
  const human::Human human = *test::MakeTestHuman();
  ExportContent content;
  content.title = "Small";
  content.credits = "The show: nobody";
  content.drama = "function main() end\n";
  PlaceContent place;
  place.place.name = "maquette";
  place.place.map_from_stage.scale = 2.0;
  place.place.probes.emplace_back().light.sky[0] = {1.0f, 2.0f, 3.0f};
  geometry::TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.indices = {0, 1, 2};
  place.place.occluders = {{"counter", mesh, {}}, {"wall", mesh, {}}};
  place.scene = test::OnePointScene(50.0);
  content.places = {place};
  content.cast = {{"keeper", human::SerializeHuman(human)},
                  {"guest", human::SerializeHuman(human)}};
  return content;
}

TEST(Export, PacksAllThatThePlayerNeeds) {
  const test::TemporaryFolder folder;
  const ExportContent content = SmallShow();
  NoProgress progress;
  const Status status = ExportBundle(content, folder / "a.larshow", progress);
  ASSERT_TRUE(status.ok()) << status.message();
  const auto opened = bundle::Bundle::Open(folder / "a.larshow");
  ASSERT_TRUE(opened.ok()) << opened.message();
  const bundle::ShowManifest& manifest = opened->manifest();
  EXPECT_EQ(manifest.title, "Small");
  EXPECT_EQ(manifest.credits, content.credits);
  ASSERT_EQ(manifest.places.size(), 1u);
  EXPECT_EQ(manifest.places[0].map_from_stage.scale, 2.0);
  EXPECT_EQ(manifest.places[0].probes.at(0).light.sky[0], glm::vec3(1.0f, 2.0f, 3.0f));
  ASSERT_EQ(manifest.places[0].occluders.size(), 2u);
  for (const bundle::OccluderEntry& occluder : manifest.places[0].occluders) {
    EXPECT_TRUE(stage::ParseMesh(*opened->member(occluder.mesh), occluder.mesh).ok());
  }
  EXPECT_TRUE(vision::ParseSceneDatabase(*opened->member(manifest.places[0].scene), "scene").ok());
  ASSERT_EQ(manifest.cast.size(), 2u);
  EXPECT_TRUE(human::ParseHuman(*opened->member(manifest.cast[1].human), "human").ok());
  const auto drama = *opened->member(manifest.drama);
  EXPECT_EQ(std::string(reinterpret_cast<const char*>(drama.data()), drama.size()), content.drama);
}

TEST(Export, KeepsWhatEachOccluderDoes) {
  const test::TemporaryFolder folder;
  ExportContent content = SmallShow();
  content.places[0].place.occluders[0].blocks_sound = false;
  content.places[0].place.occluders[0].blocks_walking = false;
  content.places[0].place.occluders[1].receives_shadow = false;
  NoProgress progress;
  ASSERT_TRUE(ExportBundle(content, folder / "a.larshow", progress).ok());
  const auto opened = bundle::Bundle::Open(folder / "a.larshow");
  ASSERT_TRUE(opened.ok()) << opened.message();
  const bundle::OccluderEntry& counter = opened->manifest().places[0].occluders[0];
  const bundle::OccluderEntry& wall = opened->manifest().places[0].occluders[1];
  EXPECT_TRUE(!counter.blocks_sound && !counter.blocks_walking && counter.receives_shadow);
  EXPECT_TRUE(wall.blocks_sound && wall.blocks_walking && !wall.receives_shadow);
}

TEST(Export, PacksEveryPlaceWithItsOwnMapAndOccluders) {
  const test::TemporaryFolder folder;
  ExportContent content = SmallShow();
  content.places.push_back(content.places[0]);
  content.places[1].place.name = "yard";
  content.places[1].place.occluders.pop_back();
  content.places[1].place.map_from_stage.scale = 3.0;
  content.places[1].scene = test::OnePointScene(60.0);
  NoProgress progress;
  ASSERT_TRUE(ExportBundle(content, folder / "a.larshow", progress).ok());
  const auto opened = bundle::Bundle::Open(folder / "a.larshow");
  ASSERT_TRUE(opened.ok()) << opened.message();
  const std::vector<bundle::PlaceEntry>& places = opened->manifest().places;
  ASSERT_EQ(places.size(), 2u);
  for (size_t i = 0; i < 2; ++i) {
    const auto scene = vision::ParseSceneDatabase(*opened->member(places[i].scene), "scene");
    ASSERT_TRUE(scene.ok()) << scene.message();
    EXPECT_EQ(scene->camera.fx, i == 0 ? 50.0 : 60.0);
    EXPECT_EQ(places[i].map_from_stage.scale, i == 0 ? 2.0 : 3.0);
    EXPECT_EQ(places[i].occluders.size(), i == 0 ? 2u : 1u);
  }

  content.places[1].place.name = "maquette";
  EXPECT_THAT(ExportBundle(content, folder / "b.larshow", progress).message(),
              HasSubstr("used twice"));
}

TEST(Export, ObjectsOfOneModelShareItsMember) {
  const test::TemporaryFolder folder;
  ExportContent content = SmallShow();
  const std::vector<std::byte> bytes = stage::SerializeProp(test::MakeCup());
  geometry::Rigid3 there;
  there.translation = {0.0, 0.8, 0.0};
  content.objects = {{"cup", bytes, {}},
                     {"other_cup", bytes, there},
                     {"table", stage::SerializeProp(test::MakeTable()), {}}};
  const std::string visemes = R"({"schema": 1, "duration": 0.5, "visemes": []})";
  content.lines = {{"greeting", "keeper", "la", visemes, {std::byte{1}}},
                   {"greeting", "keeper", "en", visemes, {}}};
  content.spoken = {{"la", R"({"schema": 1, "names": {}, "lines": {}})"}};
  content.descriptions = {{"en", R"({"schema": 1, "names": {}, "lines": {}})"}};
  content.captions = {"en"};
  NoProgress progress;
  const Status status = ExportBundle(content, folder / "a.larshow", progress);
  ASSERT_TRUE(status.ok()) << status.message();
  const auto opened = bundle::Bundle::Open(folder / "a.larshow");
  ASSERT_TRUE(opened.ok()) << opened.message();
  const std::vector<bundle::ObjectEntry>& objects = opened->manifest().objects;
  ASSERT_EQ(objects.size(), 3u);
  EXPECT_EQ(objects[0].prop, objects[1].prop);
  EXPECT_NE(objects[0].prop, objects[2].prop);
  EXPECT_EQ(objects[1].stage_from_object.translation.y(), 0.8);
  EXPECT_TRUE(stage::ParseProp(*opened->member(objects[2].prop), "prop").ok());
  ASSERT_EQ(opened->manifest().lines.size(), 1u);
  const bundle::LineEntry& line = opened->manifest().lines[0];
  EXPECT_EQ(line.spoken.at("la").sound, "speech/la/greeting.flac");
  EXPECT_EQ(line.spoken.at("en").visemes, "speech/en/greeting.visemes.json");
  EXPECT_EQ(opened->manifest().captions, content.captions);
  ASSERT_EQ(opened->manifest().descriptions.size(), 1u);
  EXPECT_EQ(opened->manifest().descriptions[0].captions, "speech/en/descriptions.json");

  content.objects[2].prop.resize(40);
  EXPECT_THAT(ExportBundle(content, folder / "b.larshow", progress).message(),
              HasSubstr("object 'table'"));
}

TEST(Export, ParadataGoWithTheShow) {
  const test::TemporaryFolder folder;
  ExportContent content = SmallShow();
  content.paradata =
      R"({"schema": 1, "claims": {"people": {"keeper": {"certainty": "attested"}}}})";
  NoProgress progress;
  const Status status = ExportBundle(content, folder / "a.larshow", progress);
  ASSERT_TRUE(status.ok()) << status.message();
  const auto opened = bundle::Bundle::Open(folder / "a.larshow");
  ASSERT_TRUE(opened.ok()) << opened.message();
  const auto bytes = opened->member(opened->manifest().paradata);
  ASSERT_TRUE(bytes.ok()) << bytes.message();
  EXPECT_EQ(bytes->size(), content.paradata.size());
  content.paradata = R"({"schema": 1, "claims": {"people": {"keeper": {"certainty": "sure"}}}})";
  EXPECT_THAT(ExportBundle(content, folder / "b.larshow", progress).message(),
              HasSubstr("\"certainty\" is 'sure'"));
}

TEST(Export, RefusesBrokenPartsAndKeepsTheOldFile) {
  const test::TemporaryFolder folder;
  const std::filesystem::path path = folder / "a.larshow";
  NoProgress progress;
  ASSERT_TRUE(ExportBundle(SmallShow(), path, progress).ok());

  ExportContent content = SmallShow();
  content.places[0].scene.resize(100);
  EXPECT_THAT(ExportBundle(content, path, progress).message(), HasSubstr("place 'maquette'"));

  content = SmallShow();
  content.cast[1].human[50] ^= std::byte{0xff};
  content.cast[1].human.resize(content.cast[1].human.size() / 2);
  EXPECT_THAT(ExportBundle(content, path, progress).message(), HasSubstr("cast 'guest'"));

  content = SmallShow();
  content.places[0].place.occluders[0].mesh.indices[0] = 9;
  EXPECT_THAT(ExportBundle(content, path, progress).message(), HasSubstr("occluder 'counter'"));

  content = SmallShow();
  content.places.clear();
  EXPECT_THAT(ExportBundle(content, path, progress).message(), HasSubstr("no place"));

  content = SmallShow();
  content.cast[1].name = "keeper";
  EXPECT_THAT(ExportBundle(content, path, progress).message(), HasSubstr("used twice"));

  EXPECT_TRUE(bundle::Bundle::Open(path).ok());
}

class CancelAtOnce : public Progress {
 public:
  void Report(std::string_view, double) override {}
  bool Cancelled() const override { return true; }
};

TEST(Export, CancellingWritesNothing) {
  const test::TemporaryFolder folder;
  CancelAtOnce progress;
  EXPECT_THAT(ExportBundle(SmallShow(), folder / "a.larshow", progress).message(),
              HasSubstr("cancelled"));
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace lararium::exporter
