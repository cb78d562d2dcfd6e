#include "editor/jobs/occluder_alignment.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "editor/cli/align_commands.h"
#include "editor/document/place_edits.h"
#include "editor/jobs/baking.h"
#include "editor/jobs/picked_frames.h"
#include "shared/core/random.h"
#include "tests/jobs/two_places.h"

namespace lararium::editor {
namespace {

using Eigen::Vector3d;
using geometry::Similarity3;
using test::kMaquetteFromStage;
using test::kSiteFromStage;
using test::MapOf;
using test::See;
using testing::HasSubstr;

// The correct pose of a model in centimetres.
const Similarity3 kStageFromMesh = {
    0.01, Eigen::Quaterniond(Eigen::AngleAxisd(0.4, Vector3d::UnitY())), {0.2, 0.3, -0.1}};

class OccluderAlignment : public testing::Test {
 protected:
  OccluderAlignment() {
    occluder_.name = "counter";
    occluder_.file = "counter.glb";
    for (const Vector3d& at : points_) {
      AddModelPair(occluder_, at);
      PickAll(occluder_.model_pairs.size() - 1, kStageFromMesh * at);
    }
  }

  // Picks a point in three images, as if it were at a position.
  void PickAll(size_t pair, const Vector3d& on_stage) {
    for (const size_t keyframe : {1, 5, 10}) {
      SetModelPick(occluder_, pair, See(world_, map_, on_stage, keyframe));
    }
  }

  const test::SyntheticWorld world_ = test::MakeSyntheticWorld({.points = 60});
  const vision::SceneDatabase map_ = MapOf(world_, kSiteFromStage);
  const std::vector<Vector3d> points_ = {{-60, 10, 30}, {70, 0, 20}, {0, 110, -20}, {40, 60, 70}};
  OccluderDocument occluder_;
};

TEST_F(OccluderAlignment, ByPointsLiesWhereTheyWerePicked) {
  EXPECT_GT(ReportAlignment(occluder_, map_, kSiteFromStage).rms_m, 1.0);
  const auto aligned = AlignByPoints(occluder_, map_, kSiteFromStage);
  ASSERT_TRUE(aligned.ok()) << aligned.message();
  EXPECT_NEAR(aligned->scale, kStageFromMesh.scale, 1e-9);
  EXPECT_LT(aligned->rotation.angularDistance(kStageFromMesh.rotation), 1e-7);
  EXPECT_LT((aligned->translation - kStageFromMesh.translation).norm(), 1e-7);

  occluder_.stage_from_mesh = *aligned;
  const AlignmentReport report = ReportAlignment(occluder_, map_, kSiteFromStage);
  EXPECT_EQ(report.located, 4);
  EXPECT_LT(report.rms_m, 1e-6);
  EXPECT_LT(report.rms_px, 1e-3);
  // The same picks in another map of the place.
  const vision::SceneDatabase again = MapOf(world_, kMaquetteFromStage);
  EXPECT_LT(ReportAlignment(occluder_, again, kMaquetteFromStage).rms_m, 1e-4);
}

TEST_F(OccluderAlignment, TellsTheWorstPairInCentimetresAndPixels) {
  occluder_.stage_from_mesh = kStageFromMesh;
  PickAll(2, kStageFromMesh * points_[2] + Vector3d(0.0, 0.08, 0.0));
  const AlignmentReport report = ReportAlignment(occluder_, map_, kSiteFromStage);
  EXPECT_EQ(report.worst, 2u);
  EXPECT_NEAR(report.pairs[2].distance_m, 0.08, 1e-6);
  EXPECT_NEAR(report.rms_m, 0.04, 1e-6);
  EXPECT_GT(report.pairs[2].distance_px, 1.0);
  EXPECT_LT(report.pairs[0].distance_px, 1e-3);
}

TEST_F(OccluderAlignment, KeepsAScaleThatIsRight) {
  occluder_.keep_scale = true;
  occluder_.stage_from_mesh.scale = 0.011;
  const auto aligned = AlignByPoints(occluder_, map_, kSiteFromStage);
  ASSERT_TRUE(aligned.ok()) << aligned.message();
  EXPECT_EQ(aligned->scale, 0.011);
  EXPECT_LT(aligned->rotation.angularDistance(kStageFromMesh.rotation), 1e-7);
}

TEST_F(OccluderAlignment, PairsThatAreNotPickedSayNothing) {
  occluder_.model_pairs[0].anchor.picks.clear();
  EXPECT_TRUE(AlignByPoints(occluder_, map_, kSiteFromStage).ok());
  occluder_.model_pairs[1].anchor.picks.clear();
  const std::string message = AlignByPoints(occluder_, map_, kSiteFromStage).message();
  EXPECT_THAT(message, HasSubstr("occluder 'counter'"));
  EXPECT_THAT(message, HasSubstr("2 of its points"));
  const AlignmentReport report = ReportAlignment(occluder_, map_, kSiteFromStage);
  EXPECT_EQ(report.located, 2);
  EXPECT_FALSE(report.worst.has_value());
  EXPECT_THAT(report.pairs[0].problem.message(), HasSubstr("point 1"));
}

TEST_F(OccluderAlignment, RemovingAPairRenamesThoseBehindIt) {
  RemoveModelPair(occluder_, 1);
  ASSERT_EQ(occluder_.model_pairs.size(), 3u);
  EXPECT_EQ(occluder_.model_pairs[1].on_mesh, points_[2]);
  EXPECT_EQ(occluder_.model_pairs[1].anchor.name, "point 2");
  EXPECT_EQ(occluder_.model_pairs[2].anchor.name, "point 3");
  EXPECT_TRUE(WithoutPicks(occluder_).model_pairs[2].anchor.picks.empty());
}

class AlignSubcommand : public testing::Test, protected test::TwoPlacesProject {
 protected:
  Result<CommandResult> Run(AlignOptions options) {
    NoProgress silent;
    options.project = paths_.folder;
    options.place = options.place.empty() ? "maquette" : options.place;
    options.occluder = options.occluder.empty() ? "wall" : options.occluder;
    return RunAlign(options, silent);
  }
  std::string Problem(const AlignOptions& options) { return Run(options).status().message(); }
  OccluderDocument Wall() { return LoadProject(paths_)->places[0].occluders[0]; }
  std::string PickText(const Vector3d& on_stage, size_t keyframe) {
    const stage::Pick pick = See(world_, MapOf(world_, kMaquetteFromStage), on_stage, keyframe);
    char text[128];
    std::snprintf(text, sizeof text, "%s,%.9g,%.9g", pick.frame.c_str(), pick.pixel.x(),
                  pick.pixel.y());
    return text;
  }
};

TEST_F(AlignSubcommand, AddsPairsAndLaysTheModelByThem) {
  const Similarity3 truth = {
      1.1, Eigen::Quaterniond(Eigen::AngleAxisd(0.1, Vector3d::UnitY())), {0.1, 0.0, 0.2}};
  for (const Vector3d& at : {Vector3d(-1, 0, -1), {1, 0, -1}, {1, 2, -1}, {-1, 2, -1}}) {
    const auto added = Run({.pair = {at.x(), at.y(), at.z()},
                            .picks = {PickText(truth * at, 2), PickText(truth * at, 9)}});
    ASSERT_TRUE(added.ok()) << added.message();
  }
  auto report = Run({});
  ASSERT_TRUE(report.ok()) << report.message();
  ASSERT_EQ(report->json["pairs"].size(), 4u);
  EXPECT_GT(report->json["rms_cm"].get<double>(), 10.0);
  EXPECT_THAT(report->text, HasSubstr("point 4: "));
  EXPECT_TRUE(report->json["worst"].is_number());
  EXPECT_EQ(Wall().stage_from_mesh.scale, 1.0);

  report = Run({.by_points = true});
  ASSERT_TRUE(report.ok()) << report.message();
  EXPECT_LT(report->json["rms_cm"].get<double>(), 1e-2);
  EXPECT_LT((Wall().stage_from_mesh.translation - truth.translation).norm(), 1e-4);
  EXPECT_NEAR(Wall().stage_from_mesh.scale, 1.1, 1e-4);

  ASSERT_TRUE(Run({.remove = 1, .keep_scale = true}).ok());
  EXPECT_EQ(Wall().model_pairs.size(), 3u);
  EXPECT_TRUE(Wall().keep_scale);
  ASSERT_TRUE(Run({.keep_scale = false}).ok());
  EXPECT_FALSE(Wall().keep_scale);
}

TEST_F(AlignSubcommand, RefinesOnTheMapsPoints) {
  // Points on the front and the sides of the wall, as in the map of the maquette.
  vision::SceneDatabase map = MapOf(world_, kMaquetteFromStage);
  Random random(5);
  for (size_t i = 0; i < map.points.size(); ++i) {
    const double x = random.Uniform(-1, 1);
    const double y = random.Uniform(0, 2);
    const double z = random.Uniform(-1.2, -1.0);
    const Vector3d at = i % 3 == 0   ? Vector3d(x, y, -1.0)
                        : i % 3 == 1 ? Vector3d(i % 2 == 0 ? -1.0 : 1.0, y, z)
                                     : Vector3d(x, 2.0, z);
    map.points[i] = (kMaquetteFromStage * at).cast<float>();
  }
  ProjectDocument document = *LoadProject(paths_);
  ASSERT_TRUE(SaveMap(paths_, document.places[0], map).ok());
  document.places[0].occluders[0].stage_from_mesh.translation = {0.03, 0.02, -0.04};
  document.cast.clear();
  ASSERT_TRUE(SaveProject(paths_, document).ok());
  EXPECT_THAT(Problem({.refine = true}), HasSubstr("bake"));
  NoProgress silent;
  ASSERT_TRUE(Bake(paths_, document, silent).ok());
  const auto report = Run({.keep_scale = true, .refine = true, .within = 0.15});
  ASSERT_TRUE(report.ok()) << report.message();
  EXPECT_LT(Wall().stage_from_mesh.translation.norm(), 2e-3);
  EXPECT_EQ(report->json["refined"]["points"], 60);
  EXPECT_LT(report->json["refined"]["rms_after_cm"].get<double>(), 0.1);
  EXPECT_GT(report->json["refined"]["rms_before_cm"].get<double>(), 1.0);
  EXPECT_THAT(report->text, HasSubstr("points of the map lie on it"));
  EXPECT_THAT(Problem({.refine = true, .within = 0.001}), testing::Not(HasSubstr("aborted")));
}

TEST_F(AlignSubcommand, FlattensWhatWasDrawn) {
  auto report = Run({.place = "site", .occluder = "bench"});
  ASSERT_TRUE(report.ok()) << report.message();
  EXPECT_EQ(report->json["flat"], false);
  ASSERT_TRUE(Run({.place = "site", .occluder = "bench", .flat = true}).ok());
  EXPECT_TRUE(LoadProject(paths_)->places[1].occluders[0].flat);
  EXPECT_THAT(Problem({.place = "site", .occluder = "bench", .refine = true}),
              HasSubstr("was drawn"));
  EXPECT_THAT(Problem({.flat = true}), HasSubstr("--flat"));
}

TEST_F(AlignSubcommand, TellsWhatItLacks) {
  const std::string frame = test::MakeSceneDatabase(world_).keyframes[0].name;
  EXPECT_THAT(Problem({.occluder = "roof"}), HasSubstr("it has wall"));
  EXPECT_THAT(Problem({.place = "moon"}), HasSubstr("has no place \"moon\""));
  EXPECT_THAT(Problem({.by_points = true}), HasSubstr("0 of its points"));
  EXPECT_THAT(Problem({.remove = 1}), HasSubstr("does not exist"));
  for (const char* pick : {"nine", "1,2", "a,b,c", "a,,1", ",", "a,1,2x", ""}) {
    EXPECT_THAT(Problem({.pair = {0, 0, 0}, .picks = {pick}}), HasSubstr("in")) << pick;
  }
  EXPECT_THAT(Problem({.pair = {0, 0, 0}, .picks = {"nine,1,2"}}),
              HasSubstr("is not a training image"));
  EXPECT_THAT(Problem({.pair = {0, 0, 0}, .picks = {frame + ",9999,1"}}),
              HasSubstr("outside of the image"));
  EXPECT_THAT(Problem({.pair = {0, 0, 0}, .picks = {frame + ",nan,1"}}),
              HasSubstr("outside of the image"));
  EXPECT_TRUE(Wall().model_pairs.empty());  // Nothing was saved.
}

}  // namespace
}  // namespace lararium::editor
