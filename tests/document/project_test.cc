#include "editor/document/project.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "editor/document/place_recordings.h"
#include "shared/core/file.h"
#include "tests/support/test_files.h"

namespace lararium::editor {
namespace {

using testing::HasSubstr;

ProjectDocument FullDocument() {
  PlaceDocument place;
  place.name = "thermopolium";
  place.title = "Größe, l'atrio";
  place.training = {SourceDocument::Kind::kVideo, "training.mp4"};
  place.preview = {SourceDocument::Kind::kImages, "/elsewhere/frames"};
  place.intrinsics = geometry::CameraModel{640, 480, 600.5, 601.25, 319.5, 239.5, -0.1, 0.01};
  place.picks.origin.picks = {{12, "000012.png", {320.25, 410.5}}, {40, "000040.png", {300, 400}}};
  place.picks.forward.picks = {{12, "", {333.0, 320.0}, 1}};
  place.added = {{{SourceDocument::Kind::kVideo, "evening.mp4"}, place.intrinsics},
                 {{SourceDocument::Kind::kImages, "night"}, {}}};
  place.tags = TagsDocument{"tag25h9", 0.125};
  place.picks.length_m = 2.75;
  place.picked_from_stage = {0.1, Eigen::Quaterniond(0.5, 0.5, -0.5, 0.5), {0.1, 0.2, 0.3}};
  place.camera_nudge = {0.01, -0.02, 0.03};
  place.camera = light::CameraTraits{640, 0.01f, 0.0005f, 0.75f, 0.625f, 0.5f};
  OccluderDocument counter;
  counter.name = "counter";
  counter.file = "counter.glb";
  counter.stage_from_mesh = {1.0, Eigen::Quaterniond(0, 0, 1, 0), {1, 2, 3}};
  counter.model_pairs = {{{10.5, -2.0, 4000.0}, {"point 1", {{12, "000012.png", {5, 6}}}}},
                         {{0, 0, 1}, {"point 2", {{3, "a.png", {7, 8}, 1}}}}};
  counter.keep_scale = true;
  place.occluders = {counter};
  place.probes = {
      {"noon", "probe.exr", {0.5, 1.2, -1.0}, 12.5, Eigen::Quaterniond(0.6, 0, 0.8, 0), 2.0},
      {"dusk", "dusk.exr", {0.5, 1.2, -1.0}, 19.0, Eigen::Quaterniond::Identity(), 0.5}};
  OccluderDocument drawn;
  drawn.name = "wall";
  drawn.depth = 0.25;
  drawn.flat = true;
  for (size_t i = 0; i < 3; ++i) {
    const double x = 10.0 * static_cast<double>(i);
    drawn.corners.push_back({CornerName(i), {{3, "a.png", {x, 1}}, {9, "b.png", {x, 2}, 1}}});
  }
  place.occluders.push_back(drawn);
  OccluderDocument gate;
  gate.name = "gate";
  gate.shape = OccluderShape{OccluderShape::Kind::kArch, 4.0, 3.5, 0.5, 2.0, 1.25};
  gate.stage_from_mesh = {1.0, Eigen::Quaterniond(0, 0, 1, 0), {-1, 0, 2}};
  gate.receives_shadow = gate.blocks_walking = false;
  place.occluders.push_back(gate);
  place.check_picks = {
      {"counter, left", {{12, "000012.png", {1.5, 2.5}}, {40, "b.png", {3, 4}, 1}}}};
  PlaceDocument untouched;
  untouched.name = "maquette";
  ProjectDocument document;
  document.title = "Vetutius";
  document.credits = "by hand";
  document.check_points = {{"counter, left", {-1.25, 0.9, 0.5}}, {"door", {0, 2, -3}}};
  document.places = {place, untouched};
  document.cast.resize(4);
  document.cast[0].name = "Publia";
  document.cast[0].model = "models/publia.glb";
  document.cast[0].bone_map = "models/publia.bones.json";
  document.cast[0].clips = {{"stroll", "motion/01_01.bvh", true}, {"bow", "motion/bow.bvh"}};
  document.cast[1].name = "Vetutius";
  document.cast[1].height = 1.64;
  document.cast[1].tunic = {0.3, 0.1, 0.05};
  document.cast[2].name = "Asellina";
  document.cast[2].recipe.emplace();
  document.cast[2].recipe->age = 31.0f;
  document.cast[3].name = "Puella";
  document.cast[3].preset = "girl";
  document.speech.description = {"f3", 45, 40, 165};
  document.objects = {{"jug", "jug", "", {0.5, 0.95, -1.2}, 30.0},
                      {"statue", "", "props/statue.glb", {1.0, 0.0, 0.0}, 0.0}};
  return document;
}

Status ParseError(const Json& json) { return ParseProject(json, "project.json").status(); }

TEST(Project, SurvivesWritingAndReading) {
  const test::TemporaryFolder folder;
  const ProjectPaths paths{folder.path()};
  const ProjectDocument document = FullDocument();
  ASSERT_TRUE(SaveProject(paths, document).ok());
  const Result<ProjectDocument> loaded = LoadProject(paths);
  ASSERT_TRUE(loaded.ok()) << loaded.message();
  EXPECT_EQ(FormatProject(*loaded), FormatProject(document));
  EXPECT_EQ(loaded->places[0].picks.origin.picks[1].frame_index, 40);
  EXPECT_EQ(loaded->places[0].picks.origin.name, "origin");
  EXPECT_EQ(loaded->places[0].picks.forward.picks[0].session, 1u);
  ASSERT_EQ(loaded->places[0].added.size(), 2u);
  EXPECT_EQ(loaded->places[0].added[0].source.path, "evening.mp4");
  EXPECT_EQ(loaded->places[0].added[0].intrinsics, document.places[0].intrinsics);
  EXPECT_FALSE(loaded->places[0].added[1].intrinsics.has_value());
  EXPECT_EQ(loaded->places[0].tags->family, "tag25h9");
  EXPECT_EQ(loaded->places[0].tags->size_m, 0.125);
  EXPECT_EQ(loaded->places[0].camera, document.places[0].camera);
  EXPECT_FALSE(loaded->places[1].camera.has_value());
  EXPECT_EQ(loaded->places[0].intrinsics, document.places[0].intrinsics);
  EXPECT_TRUE(loaded->places[1].training.empty());
  const OccluderDocument& counter = loaded->places[0].occluders[0];
  EXPECT_EQ(counter.kind(), OccluderDocument::Kind::kModel);
  EXPECT_TRUE(counter.receives_shadow && counter.blocks_sound && counter.blocks_walking);
  const OccluderDocument& gate = loaded->places[0].occluders[2];
  ASSERT_EQ(gate.kind(), OccluderDocument::Kind::kShape);
  EXPECT_EQ(gate.shape->kind, OccluderShape::Kind::kArch);
  EXPECT_EQ(gate.shape->spring, 1.25);
  EXPECT_EQ(gate.stage_from_mesh.translation, Eigen::Vector3d(-1, 0, 2));
  EXPECT_TRUE(!gate.receives_shadow && gate.blocks_sound && !gate.blocks_walking);
  const OccluderDocument& wall = loaded->places[0].occluders[1];
  EXPECT_TRUE(wall.drawn());
  ASSERT_EQ(wall.corners.size(), 3u);
  EXPECT_EQ(wall.corners[2].name, "corner 3");
  EXPECT_EQ(wall.corners[2].picks[1].session, 1u);
  EXPECT_EQ(wall.corners[2].picks[1].pixel, Eigen::Vector2d(20, 2));
  EXPECT_EQ(wall.depth, 0.25);
  EXPECT_TRUE(wall.flat);
  EXPECT_TRUE(counter.keep_scale);
  ASSERT_EQ(counter.model_pairs.size(), 2u);
  EXPECT_EQ(counter.model_pairs[0].on_mesh, Eigen::Vector3d(10.5, -2.0, 4000.0));
  EXPECT_EQ(counter.model_pairs[1].anchor.name, "point 2");
  EXPECT_EQ(counter.model_pairs[1].anchor.picks[0].session, 1u);
  EXPECT_EQ(counter.model_pairs[1].anchor.picks[0].pixel, Eigen::Vector2d(7, 8));
  EXPECT_EQ(loaded->speech.description, document.speech.description);
  ASSERT_EQ(loaded->check_points.size(), 2u);
  EXPECT_EQ(loaded->check_points[0].name, "counter, left");
  EXPECT_EQ(loaded->check_points[0].position, Eigen::Vector3d(-1.25, 0.9, 0.5));
  ASSERT_EQ(loaded->places[0].check_picks.size(), 1u);
  EXPECT_EQ(loaded->places[0].check_picks[0].name, "counter, left");
  EXPECT_EQ(loaded->places[0].check_picks[0].picks[1].session, 1u);
}

TEST(Project, CheckPointsHaveNamesOfTheirOwn) {
  Json json = FormatProject(FullDocument());
  json["check_points"][1]["name"] = "counter, left";
  EXPECT_THAT(ParseError(json).message(), HasSubstr("used twice"));
  json["check_points"][1]["name"] = "";
  EXPECT_THAT(ParseError(json).message(), HasSubstr("check_points[1]"));
  json["check_points"][1]["name"] = "door";
  json["check_points"][1]["position"] = {0, 1};
  EXPECT_THAT(ParseError(json).message(), HasSubstr("position"));
  json["check_points"] = Json::array();
  EXPECT_TRUE(ParseProject(json, "project.json").ok()) << "picks of none are kept";
}

TEST(Project, ANewOneLoadsAndLacksNothing) {
  const test::TemporaryFolder folder;
  const ProjectPaths paths{folder / "new.lararium"};
  ASSERT_TRUE(CreateProject(paths, "New").ok());
  const Result<ProjectDocument> loaded = LoadProject(paths);
  ASSERT_TRUE(loaded.ok()) << loaded.message();
  EXPECT_EQ(loaded->title, "New");
  EXPECT_TRUE(FindMissingFiles(paths, *loaded).empty());
}

TEST(Project, IsNeverMadeOverSomethingElse) {
  const test::TemporaryFolder folder;
  ASSERT_TRUE(WriteFileAtomically(folder / "thesis.txt", "years of work").ok());
  EXPECT_THAT(CreateProject({folder.path()}, "New").message(), HasSubstr("not an empty folder"));
}

TEST(Project, SaysHowToMakeOneWhereThereIsNone) {
  const test::TemporaryFolder folder;
  EXPECT_THAT(LoadProject({folder.path()}).message(), HasSubstr("lararium-editor new"));
}

TEST(Project, RefusesWhatANewerVersionWrote) {
  Json json = FormatProject(FullDocument());
  json["schema"] = kProjectSchema + 1;
  EXPECT_THAT(ParseError(json).message(), HasSubstr("newer Lararium"));
}

TEST(Project, RefusesUnknownFieldsRatherThanDropThem) {
  Json json = FormatProject(FullDocument());
  json["places"][0]["colour"] = "red";
  EXPECT_THAT(ParseError(json).message(),
              testing::AllOf(HasSubstr("places[0]"), HasSubstr("\"colour\"")));
}

TEST(Project, ErrorsNameTheField) {
  Json json = FormatProject(FullDocument());
  json["places"][0]["occluders"][0]["scale"] = -1.0;
  EXPECT_THAT(ParseError(json).message(), HasSubstr("places[0].occluders[0].scale"));
}

// Invalid values that manual editing or a damaged disk can put into the file.
struct Damage {
  const char* name;
  const char* pointer;
  Json value;
};

class DamagedProject : public testing::TestWithParam<Damage> {};

TEST_P(DamagedProject, IsAnError) {
  Json json = FormatProject(FullDocument());
  ASSERT_TRUE(ParseError(json).ok());
  json[Json::json_pointer(GetParam().pointer)] = GetParam().value;
  EXPECT_FALSE(ParseError(json).ok());
}

INSTANTIATE_TEST_SUITE_P(
    Fields,
    DamagedProject,
    testing::Values(
        Damage{"schema", "/schema", "one"},
        Damage{"title", "/title", 3},
        Damage{"places", "/places", Json::object()},
        Damage{"path_as_name", "/places/0/name", "../etc"},
        Damage{"empty_name", "/places/0/name", ""},
        Damage{"two_lines", "/places/0/title", "a\nb"},
        Damage{"long_title", "/cast/0/title", std::string(201, 'a')},
        Damage{"title_number", "/cast/0/title", 3},
        Damage{"same_name", "/places/0/name", "maquette"},
        Damage{"no_source", "/places/0/training", Json::object()},
        Damage{"rotation", "/places/0/adjust/rotation", {1, 1, 0, 0}},
        Damage{"short_vector", "/places/0/camera_nudge", {1, 2}},
        Damage{"huge_vector", "/places/0/camera_nudge", {1, 2, 1e300}},
        Damage{"focal", "/places/0/intrinsics/fx", 0.0},
        Damage{"frame", "/places/0/picks/origin/0/frame_index", -4},
        Damage{"pixel", "/places/0/picks/origin/0/pixel", {1e300, 0}},
        Damage{"length", "/places/0/picks/length_m", 0.0},
        Damage{"session", "/places/0/picks/origin/0/session", 32},
        Damage{"added", "/places/0/added/0/source", Json::object()},
        Damage{"added_focal", "/places/0/added/0/intrinsics/fy", -1.0},
        Damage{"family", "/places/0/tags/family", "tag1h1"},
        Damage{"tag_size", "/places/0/tags/size_m", 0.0},
        Damage{"model_and_corners", "/places/0/occluders/0/corners", Json::array()},
        Damage{"corner", "/places/0/occluders/1/corners/1", "there"},
        Damage{"corner_pixel", "/places/0/occluders/1/corners/1/0/pixel", {1e300, 0}},
        Damage{"depth", "/places/0/occluders/1/depth", -0.1},
        Damage{"no_model", "/places/0/occluders/0/file", ""},
        Damage{"flat_model", "/places/0/occluders/0/flat", true},
        Damage{"flat", "/places/0/occluders/1/flat", "yes"},
        Damage{"drawn_pairs", "/places/0/occluders/1/model_pairs", Json::array()},
        Damage{"drawn_scale", "/places/0/occluders/1/keep_scale", true},
        Damage{"keep_scale", "/places/0/occluders/0/keep_scale", 1},
        Damage{"pairs", "/places/0/occluders/0/model_pairs", Json::object()},
        Damage{"many_pairs", "/places/0/occluders/0/model_pairs",
               std::vector<Json>(65, {{"on_mesh", {0, 0, 0}}, {"picks", Json::array()}})},
        Damage{"pair_field", "/places/0/occluders/0/model_pairs/0/name", "a"},
        Damage{"pair_point", "/places/0/occluders/0/model_pairs/0/on_mesh", {0, 1}},
        Damage{"far_pair", "/places/0/occluders/0/model_pairs/0/on_mesh", {0, 1e300, 0}},
        Damage{"pair_picks", "/places/0/occluders/0/model_pairs/0/picks", "there"},
        Damage{"pair_pixel", "/places/0/occluders/0/model_pairs/0/picks/0/pixel", {0, -1e300}},
        Damage{"model_and_shape", "/places/0/occluders/2/file", "gate.glb"},
        Damage{"shape", "/places/0/occluders/2/shape", "arch"},
        Damage{"shape_kind", "/places/0/occluders/2/shape/kind", "gate"},
        Damage{"shape_size", "/places/0/occluders/2/shape/opening", 4.0},
        Damage{"shape_girth", "/places/0/occluders/2/shape/girth", 1.0},
        Damage{"shape_place", "/places/0/occluders/2/translation", {1e9, 0, 0}},
        Damage{"shadow", "/places/0/occluders/2/receives_shadow", 1},
        Damage{"walking", "/places/0/occluders/2/blocks_walking", "no"},
        Damage{"shape_flat", "/places/0/occluders/2/flat", true},
        Damage{"shape_pairs", "/places/0/occluders/2/model_pairs", Json::array()},
        Damage{"probe", "/places/0/probes/0/scale", -1.0},
        Damage{"probe_twice", "/places/0/probes/1/name", "noon"},
        Damage{"hour", "/places/0/probes/1/hour", 24.5},
        Damage{"cast", "/cast/0", "Publia"},
        Damage{"giant", "/cast/1/height", 3.0},
        Damage{"glowing", "/cast/1/tunic", {2.0, 0.1, 0.1}},
        Damage{"two_figures", "/cast/2/model", "models/publia.glb"},
        Damage{"recipe", "/cast/2/recipe/age", -5},
        Damage{"clip_twice", "/cast/0/clips/1/name", "stroll"},
        Damage{"clip_loops", "/cast/0/clips/0/loops", 1},
        Damage{"object_twice", "/objects/1/name", "jug"},
        Damage{"two_models", "/objects/0/file", "props/statue.glb"},
        Damage{"far_object", "/objects/0/position", {1e9, 0.0, 0.0}}),
    [](const auto& info) { return info.param.name; });

TEST(Project, MissingFilesAreNamed) {
  const test::TemporaryFolder folder;
  const ProjectPaths paths{folder.path()};
  ProjectDocument document = FullDocument();
  document.places.resize(1);
  std::string all;
  for (const Status& missing : FindMissingFiles(paths, document)) {
    all += missing.message() + "\n";
  }
  for (const char* name : {"drama.lua", "scene.larscene", "training.mp4", "/elsewhere/frames",
                           "counter.glb", "probe.exr", "publia.glb"}) {
    EXPECT_THAT(all, HasSubstr(name));
  }
}

TEST(ProjectPaths, KeepRelativeWhatLiesInside) {
  const ProjectPaths paths{"/show.lararium"};
  EXPECT_EQ(paths.Shorten("/show.lararium/cast/a.larhuman"), "cast/a.larhuman");
  EXPECT_EQ(paths.Shorten("/videos/a.mp4"), "/videos/a.mp4");
  EXPECT_EQ(paths.Resolve("cast/a.larhuman"), "/show.lararium/cast/a.larhuman");
  EXPECT_EQ(paths.Resolve("/videos/a.mp4"), "/videos/a.mp4");
}

TEST(ForgetSession, LetsGoOfItsPicksAndMovesLaterSessionsUp) {
  PlaceDocument place;
  place.added = {{{SourceDocument::Kind::kVideo, "evening.mp4"}, {}},
                 {{SourceDocument::Kind::kVideo, "night.mp4"}, {}},
                 {{SourceDocument::Kind::kVideo, "rain.mp4"}, {}}};
  const auto picked = [](uint32_t session) { return stage::Pick{5, "5", {1, 2}, session}; };
  const stage::Anchor anchor{"", {picked(0), picked(1), picked(2), picked(3)}};
  place.picks.floor = anchor;
  place.picks.length_to = anchor;
  place.occluders.resize(1);
  place.occluders[0].corners = {anchor};
  place.occluders[0].model_pairs.resize(1);
  place.occluders[0].model_pairs[0].anchor = anchor;
  place.check_picks = {anchor};
  EXPECT_EQ(PicksInSessionsFrom(place, 2), 10u);
  ForgetSession(place, 2);
  ASSERT_EQ(place.added.size(), 2u);
  EXPECT_EQ(place.added[0].source.path, "evening.mp4");
  EXPECT_EQ(place.added[1].source.path, "rain.mp4");
  for (const stage::Anchor* left :
       {&place.picks.floor, &place.picks.length_to, &place.occluders[0].corners[0],
        &place.check_picks[0], &place.occluders[0].model_pairs[0].anchor}) {
    ASSERT_EQ(left->picks.size(), 3u);
    EXPECT_EQ(left->picks[1].session, 1u);
    EXPECT_EQ(left->picks[2].session, 2u);
  }
}

TEST(ForgetSession, LeavesTheTrainingAndWhatIsNotThere) {
  PlaceDocument place;
  place.added.resize(1);
  ForgetSession(place, 0);
  ForgetSession(place, 2);
  EXPECT_EQ(place.added.size(), 1u);
}

}  // namespace
}  // namespace lararium::editor
