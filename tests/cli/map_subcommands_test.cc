#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "editor/cli/subcommands.h"
#include "editor/colmap/colmap_model.h"
#include "editor/jobs/staging.h"
#include "editor/jobs/training.h"
#include "shared/bundle/bundle.h"
#include "shared/core/file.h"
#include "tests/support/synthetic_world.h"
#include "tests/support/test_files.h"

namespace lararium::editor {
namespace {

using ::testing::HasSubstr;
using vision::SceneDatabase;

class CancelAtOnce : public Progress {
 public:
  void Report(std::string_view, double) override {}
  bool Cancelled() const override { return true; }
};

// A wall of discs in the plane z = 0, with the image of each camera: features can be found in
// these images at the points of the map.
SceneDatabase WallOfDiscs() {
  test::SyntheticWorld world = test::MakeSyntheticWorld({.points = 500, .cameras = 8, .seed = 4});
  for (Eigen::Vector3d& point : world.points) {
    point = {1.3 * point.x(), point.y(), 0.0};
  }
  world.normals.assign(world.points.size(), Eigen::Vector3d::UnitZ());
  SceneDatabase db = test::MakeSceneDatabase(world);
  constexpr int kSubpixelBits = 4;
  for (size_t k = 0; k < db.keyframes.size(); ++k) {
    cv::Mat image(world.camera.height, world.camera.width, CV_8UC1, cv::Scalar(120));
    Random random(7);  // The same discs in each image.
    for (const Eigen::Vector3d& point : world.points) {
      const auto pixel = world.camera.Project(world.cameras_from_world[k] * point);
      const double radius = random.Uniform(2.5, 6.0);
      const cv::Scalar grey(random.Uniform() < 0.5 ? random.Uniform(0.0, 70.0)
                                                   : random.Uniform(170.0, 255.0));
      const double unit = 1 << kSubpixelBits;
      cv::circle(image, cv::Point2d(unit * pixel->x(), unit * pixel->y()),
                 static_cast<int>(unit * radius), grey, cv::FILLED, cv::LINE_AA, kSubpixelBits);
    }
    cv::GaussianBlur(image, db.keyframes[k].grey, cv::Size(), 1.0);
  }
  return db;
}

class MapSubcommands : public ::testing::Test {
 protected:
  // A project with one place, which is trained if a map is given.
  ProjectPaths MakeProject(const std::string& name, const SceneDatabase* map) {
    const ProjectPaths paths{folder_ / name};
    EXPECT_TRUE(CreateProject(paths, name).ok());
    if (map != nullptr) {
      ProjectDocument document = *LoadProject(paths);
      document.places.resize(1);
      document.places[0].name = "wall";
      EXPECT_TRUE(SaveProject(paths, document).ok());
      EXPECT_TRUE(SaveMap(paths, document.places[0], *map).ok());
    }
    return paths;
  }

  // A project with the untrained place "wall".
  ProjectPaths MakeUntrained() {
    const SceneDatabase small = test::MakeSceneDatabase(test::MakeSyntheticWorld({.points = 30}));
    const ProjectPaths paths = MakeProject("untrained.lararium", &small);
    std::filesystem::remove(paths.Scene("wall"));
    return paths;
  }

  Result<CommandResult> Import(const ProjectPaths& paths,
                               const std::filesystem::path& model,
                               const std::string& place = "") {
    return RunImportColmap({.project = paths.folder, .model = model, .images = {}, .place = place},
                           progress_, *log_);
  }

  const test::TemporaryFolder folder_;
  NoProgress progress_;
  const std::shared_ptr<Log> log_ = MakeSilentLog();
};

// ---- COLMAP ----

TEST_F(MapSubcommands, AModelGoesToColmapAndComesBackAsAnotherProjectsPlace) {
  const SceneDatabase map = WallOfDiscs();
  const ProjectPaths from = MakeProject("from.lararium", &map);
  for (const bool text : {true, false}) {
    const std::filesystem::path model = folder_ / (text ? "text" : "binary");
    const auto written = RunExportColmap(
        {.project = from.folder, .model = model, .place = "", .text = text, .with_images = true});
    ASSERT_TRUE(written.ok()) << written.message();
    EXPECT_EQ(written->json["keyframes"], map.keyframes.size());
    EXPECT_TRUE(std::filesystem::exists(model / (text ? "images.txt" : "images.bin")));
    EXPECT_FALSE(std::filesystem::exists(model / (text ? "images.bin" : "images.txt")));
  }

  const ProjectPaths to = MakeProject("to.lararium", nullptr);
  const auto imported = Import(to, folder_ / "text", "yard");
  ASSERT_TRUE(imported.ok()) << imported.message();
  const auto taken = LoadMap(to, "yard");
  ASSERT_TRUE(taken.ok()) << taken.message();
  EXPECT_EQ(imported->json["points"], taken->points.size());
  EXPECT_EQ(taken->camera, map.camera);
  ASSERT_EQ(taken->keyframes.size(), map.keyframes.size());
  for (size_t k = 0; k < map.keyframes.size(); ++k) {
    const Eigen::Vector3d center = map.keyframes[k].camera_from_map.Center();
    EXPECT_LT((taken->keyframes[k].camera_from_map.Center() - center).norm(), 1e-9);
  }
  EXPECT_GT(taken->points.size(), map.points.size() / 2);
  EXPECT_LT(taken->mean_reprojection_error_px, 0.5);

  // Training the place again would start from the same images.
  const auto document = LoadProject(to);
  ASSERT_TRUE(document.ok()) << document.message();
  const PlaceDocument* place = document->FindPlace("yard");
  ASSERT_NE(place, nullptr);
  EXPECT_EQ(to.Resolve(place->training.path), folder_ / "text" / "images");
  EXPECT_EQ(place->intrinsics, map.camera);
}

TEST_F(MapSubcommands, TextAndBinaryModelsGiveTheSameModel) {
  const SceneDatabase map = test::MakeSceneDatabase(test::MakeSyntheticWorld({.points = 60}));
  const ProjectPaths paths = MakeProject("p.lararium", &map);
  for (const bool text : {true, false}) {
    ASSERT_TRUE(RunExportColmap({.project = paths.folder,
                                 .model = folder_ / (text ? "text" : "binary"),
                                 .place = "wall",
                                 .text = text})
                    .ok());
  }
  const auto text = train::LoadColmapModel(folder_ / "text");
  const auto binary = train::LoadColmapModel(folder_ / "binary");
  ASSERT_TRUE(text.ok() && binary.ok());
  EXPECT_FALSE(std::filesystem::exists(folder_ / "text" / "images"));
  ASSERT_EQ(text->points.size(), binary->points.size());
  for (size_t i = 0; i < text->points.size(); ++i) {
    EXPECT_EQ(text->points[i].position, binary->points[i].position);
  }
}

TEST_F(MapSubcommands, ExportToColmapLeavesAFolderWithContentAlone) {
  const SceneDatabase map = test::MakeSceneDatabase(test::MakeSyntheticWorld({.points = 60}));
  const ProjectPaths paths = MakeProject("p.lararium", &map);
  ASSERT_TRUE(WriteFileAtomically(folder_ / "mine.txt", std::string_view("keep")).ok());
  const auto refused = RunExportColmap(
      {.project = paths.folder, .model = folder_.path(), .place = "", .text = true});
  EXPECT_THAT(refused.message(), HasSubstr("exists already"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "cameras.txt"));
}

TEST_F(MapSubcommands, AnImportThatFailsLeavesTheProjectAsItWas) {
  const SceneDatabase map = test::MakeSceneDatabase(test::MakeSyntheticWorld({.points = 60}));
  const ProjectPaths paths = MakeProject("p.lararium", &map);
  const std::string before = *ReadText(paths.Project());
  const std::string map_before = *ReadText(paths.Scene("wall"));
  std::filesystem::create_directories(folder_ / "empty");
  EXPECT_THAT(Import(paths, folder_ / "empty").message(), HasSubstr("has no cameras.bin"));
  ASSERT_TRUE(
      RunExportColmap({.project = paths.folder, .model = folder_ / "model", .place = ""}).ok());
  EXPECT_THAT(Import(paths, folder_ / "model").message(), HasSubstr("has no folder images"));
  EXPECT_THAT(Import(paths, folder_ / "model", "no\nname").message(),
              HasSubstr("not a valid title"));
  EXPECT_EQ(*ReadText(paths.Project()), before);
  EXPECT_EQ(*ReadText(paths.Scene("wall")), map_before);
}

// ---- prune ----

TEST_F(MapSubcommands, PruneTellsWhatSmallerMapsLoseAndThenMakesTheOneAskedFor) {
  const SceneDatabase map = WallOfDiscs();
  const ProjectPaths from = MakeProject("from.lararium", &map);
  ASSERT_TRUE(
      RunExportColmap(
          {.project = from.folder, .model = folder_ / "model", .place = "", .with_images = true})
          .ok());
  const ProjectPaths paths = MakeProject("p.lararium", nullptr);
  ASSERT_TRUE(Import(paths, folder_ / "model").ok());
  const size_t points = LoadMap(paths, "place")->points.size();
  const std::string before = *ReadText(paths.Scene("place"));

  const auto measured = RunPrune({paths.folder, "", {}}, progress_);
  ASSERT_TRUE(measured.ok()) << measured.message();
  ASSERT_EQ(measured->json["budgets"].size(), 1u);  // A small map is not halved.
  EXPECT_EQ(measured->json["budgets"][0]["points"], points);
  EXPECT_EQ(*ReadText(paths.Scene("place")), before);

  CancelAtOnce cancelled;
  EXPECT_THAT(RunPrune({paths.folder, "", 150}, cancelled).message(), HasSubstr("cancelled"));
  EXPECT_EQ(*ReadText(paths.Scene("place")), before);

  const auto pruned = RunPrune({paths.folder, "", 150}, progress_);
  ASSERT_TRUE(pruned.ok()) << pruned.message();
  const Json& rows = pruned->json["budgets"];
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[1]["points"], 150);
  EXPECT_LT(rows[1]["bytes"], rows[0]["bytes"]);
  EXPECT_LT(rows[1]["descriptors"], rows[0]["descriptors"]);
  EXPECT_EQ(rows[0]["recall"], 1.0);
  EXPECT_THAT(pruned->text, HasSubstr("150 points stay"));
  const auto left = LoadMap(paths, "place");
  ASSERT_TRUE(left.ok()) << left.message();
  EXPECT_EQ(left->points.size(), 150u);
  EXPECT_EQ(left->keyframes.size(), map.keyframes.size());
}

TEST_F(MapSubcommands, PruneShowsAMapThatIsSmallerThanAskedForOnce) {
  const SceneDatabase map = WallOfDiscs();
  const ProjectPaths paths = MakeProject("p.lararium", &map);
  const auto pruned = RunPrune({paths.folder, "", 100'000}, progress_);
  ASSERT_TRUE(pruned.ok()) << pruned.message();
  EXPECT_EQ(pruned->json["budgets"].size(), 1u);
  EXPECT_EQ(LoadMap(paths, "wall")->points.size(), map.points.size());
}

// ---- export ----

TEST_F(MapSubcommands, ABundlesPlacesHaveNoMorePointsThanAskedFor) {
  const SceneDatabase map = WallOfDiscs();
  const ProjectPaths paths = MakeProject("p.lararium", &map);
  ProjectDocument document = *LoadProject(paths);
  document.places.push_back(document.places[0]);
  document.places[1].name = "small";
  ASSERT_TRUE(SaveProject(paths, document).ok());
  const SceneDatabase small = test::MakeSceneDatabase(test::MakeSyntheticWorld({.points = 130}));
  ASSERT_TRUE(SaveMap(paths, document.places[1], small).ok());

  const std::filesystem::path out = folder_ / "show.larshow";
  const auto packed = RunExport({.project = paths.folder, .out = out, .points = 200}, progress_);
  ASSERT_TRUE(packed.ok()) << packed.message();
  const auto bundle = bundle::Bundle::Open(out);
  ASSERT_TRUE(bundle.ok()) << bundle.message();
  ASSERT_EQ(bundle->manifest().places.size(), 2u);
  for (size_t i = 0; i < 2; ++i) {
    const auto scene =
        vision::ParseSceneDatabase(*bundle->member(bundle->manifest().places[i].scene), "scene");
    ASSERT_TRUE(scene.ok()) << scene.message();
    EXPECT_EQ(scene->points.size(), i == 0 ? 200u : 130u);
  }
  // The project keeps its points.
  EXPECT_EQ(LoadMap(paths, "wall")->points.size(), map.points.size());

  const std::string before = *ReadText(out);
  CancelAtOnce cancelled;
  EXPECT_THAT(RunExport({.project = paths.folder, .out = out}, cancelled).message(),
              HasSubstr("cancelled"));
  EXPECT_EQ(*ReadText(out), before);
}

// ---- missing content ----

TEST_F(MapSubcommands, APlaceThatIsNotTrainedIsNamedWithItsRemedy) {
  const ProjectPaths paths = MakeUntrained();
  const auto says = HasSubstr("scene.larscene: was not found; train the place \"wall\"");
  EXPECT_THAT(RunPrune({paths.folder, "", {}}, progress_).message(), says);
  EXPECT_THAT(RunExportColmap({paths.folder, folder_ / "m", ""}).message(), says);
  EXPECT_THAT(
      RunExport({.project = paths.folder, .out = folder_ / "a.larshow"}, progress_).message(),
      says);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "m"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "a.larshow"));

  // Reported once, although several checks need the map.
  const auto checked = RunCheck({.project = paths.folder, .seconds = 0.0}, progress_);
  ASSERT_TRUE(checked.ok()) << checked.message();
  EXPECT_TRUE(checked->failed);
  EXPECT_EQ(checked->json["problems"].size(), 1u) << checked->text;
  EXPECT_THAT(checked->text, says);
}

TEST_F(MapSubcommands, APlaceThatTheProjectLacksIsNamed) {
  const ProjectPaths paths = MakeUntrained();
  const auto says = HasSubstr("has no place \"yard\"");
  EXPECT_THAT(RunPrune({paths.folder, "yard", {}}, progress_).message(), says);
  EXPECT_THAT(
      RunExportColmap({.project = paths.folder, .model = folder_ / "m", .place = "yard"}).message(),
      says);
}

TEST_F(MapSubcommands, TrainingRefusesFoldersThatAreNotThereBeforeItStarts) {
  const ProjectPaths paths = MakeUntrained();
  TrainCommandOptions options;
  options.project = paths.folder;
  options.report = folder_ / "none/report.html";
  EXPECT_THAT(RunTrain(options, progress_, *log_).message(), HasSubstr("none: is not a folder"));
  options.report.clear();
  options.poses_out = folder_ / "nowhere/poses.json";
  EXPECT_THAT(RunTrain(options, progress_, *log_).message(), HasSubstr("nowhere: is not a folder"));
}

TEST_F(MapSubcommands, MeasureScalesTheStageByAKnownDistance) {
  const SceneDatabase db = test::MakeSceneDatabase(test::MakeSyntheticWorld({}));
  const ProjectPaths paths = MakeProject("measured.lararium", &db);
  MeasureOptions options;
  options.project = paths.folder;
  options.from = 3;
  options.to = 11;
  Result<CommandResult> result = RunMeasure(options);
  ASSERT_TRUE(result.ok()) << result.message();
  const double said = result->json["distance_m"].get<double>();
  EXPECT_EQ(LoadProject(paths)->places[0].picked_from_stage.scale, 1.0);
  options.metres = 1.25 * said;
  result = RunMeasure(options);
  ASSERT_TRUE(result.ok()) << result.message();
  EXPECT_NEAR(result->json["residual_percent"].get<double>(), -20.0, 1e-6);
  EXPECT_NEAR(LoadProject(paths)->places[0].picked_from_stage.scale, 0.8, 1e-9);
  options.metres.reset();
  EXPECT_NEAR(RunMeasure(options)->json["distance_m"].get<double>(), 1.25 * said, 1e-6);
  options.to = 3;
  EXPECT_THAT(RunMeasure(options).status().message(),
              HasSubstr("at the same position as the other one"));
  options.to = 400;
  EXPECT_THAT(RunMeasure(options).status().message(), HasSubstr("not one of the map's 400 points"));
}

TEST_F(MapSubcommands, TrainTakesASessionOutOfTheMapAndTheProject) {
  SceneDatabase db = test::MakeSceneDatabase(test::MakeSyntheticWorld({}));
  for (size_t k = 0; k < db.keyframes.size(); ++k) {
    db.keyframes[k].session = static_cast<uint32_t>(k % 3);
  }
  std::fill(db.session_masks.begin(), db.session_masks.end(), 7u);
  const ProjectPaths paths = MakeProject("several.lararium", &db);
  ProjectDocument document = *LoadProject(paths);
  document.places[0].added = {{{SourceDocument::Kind::kVideo, "evening.mp4"}, {}},
                              {{SourceDocument::Kind::kVideo, "night.mp4"}, {}}};
  ASSERT_TRUE(SaveProject(paths, document).ok());
  TrainCommandOptions options;
  options.project = paths.folder;
  options.remove_session = 3;
  EXPECT_THAT(RunTrain(options, progress_, *log_).status().message(),
              HasSubstr("not one of the 2"));
  options.remove_session = 1;
  const Result<CommandResult> result = RunTrain(options, progress_, *log_);
  ASSERT_TRUE(result.ok()) << result.message();
  EXPECT_THAT(result->text, HasSubstr("removed evening.mp4, 4 keyframes"));
  const ProjectDocument after = *LoadProject(paths);
  ASSERT_EQ(after.places[0].added.size(), 1u);
  EXPECT_EQ(after.places[0].added[0].source.path, "night.mp4");
  const SceneDatabase map = *LoadMap(paths, "wall");
  EXPECT_EQ(map.keyframes.size(), 8u);
  EXPECT_EQ(map.keyframes[1].session, 1u);  // Session 1 is the recording at night.
  // A session that was added and removed by undo does not change the map.
  document = after;
  document.places[0].added.resize(2);
  document.places[0].added[1].source = {SourceDocument::Kind::kVideo, "rain.mp4"};
  ASSERT_TRUE(SaveProject(paths, document).ok());
  EXPECT_THAT(RunTrain(options, progress_, *log_).status().message(),
              HasSubstr("other recordings than the project"));
}

}  // namespace
}  // namespace lararium::editor
