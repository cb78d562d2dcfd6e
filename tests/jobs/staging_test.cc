#include "editor/jobs/staging.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "editor/check/stage_report.h"
#include "editor/jobs/picked_frames.h"
#include "shared/core/random.h"
#include "tests/support/test_files.h"

namespace lararium::editor {
namespace {

using Eigen::Vector3d;
using geometry::Similarity3;
using testing::HasSubstr;

// A map of a floor at z = 0 and a wall at y = 2, metres, Z up, filmed from a height of 1.5 m.
vision::SceneDatabase RoomMap(const Similarity3& map_from_room) {
  Random random(3);
  vision::SceneDatabase map;
  map.camera = {640, 480, 500.0, 500.0, 320.0, 240.0, 0.0, 0.0, 0.0, 0.0};
  for (int i = 0; i < 2000; ++i) {
    const double x = random.Uniform(-2.0, 2.0);
    const double noise = 0.003 * random.Normal();
    const Vector3d point = i % 2 == 0 ? Vector3d(x, random.Uniform(-2.0, 2.0), noise)
                                      : Vector3d(x, 2.0 + noise, random.Uniform(0.0, 2.0));
    map.points.push_back((map_from_room * point).cast<float>());
  }
  Eigen::Matrix3d camera_from_room;
  camera_from_room << 1, 0, 0, 0, -0.3, -1, 0, 1, -0.3;  // Looks along +y and down.
  camera_from_room.rowwise().normalize();
  for (int k = 0; k < 5; ++k) {
    vision::Keyframe keyframe;
    keyframe.frame_index = 10 * k;
    keyframe.name = "frame" + std::to_string(10 * k);
    keyframe.camera_from_map =
        geometry::CameraFromB(geometry::Rigid3::FromMatrix(
                                  camera_from_room, -camera_from_room * Vector3d(k - 2, -3.0, 1.5)),
                              map_from_room.Inverse());
    map.keyframes.push_back(keyframe);
  }
  return map;
}

Similarity3 SomeGauge() {
  return {2.5, Eigen::Quaterniond(0.3, -0.5, 0.7, 0.4).normalized(), {5.0, -2.0, 1.0}};
}

double TiltInRoom(const Similarity3& map_from_stage, const Similarity3& map_from_room) {
  return std::acos(std::min(1.0, (map_from_stage.rotation * Vector3d::UnitY())
                                     .dot(map_from_room.rotation * Vector3d::UnitZ())));
}

TEST(GuessStage, StandsOnTheFloor) {
  const vision::SceneDatabase map = RoomMap(SomeGauge());
  const MapMeasures measures = MeasureMap({}, map);
  ASSERT_TRUE(measures.floor.has_value());
  const Similarity3 guess = GuessStage(map, measures);
  EXPECT_LT(TiltInRoom(guess, SomeGauge()), 0.005);
  EXPECT_NEAR((SomeGauge().Inverse() * guess.translation).z(), 0.0, 0.005);
  // -Z points away from the cameras.
  EXPECT_GT((SomeGauge().rotation.conjugate() * (guess.rotation * -Vector3d::UnitZ())).y(), 0.9);
}

TEST(GuessStage, TakesTheMetresOfTags) {
  const vision::SceneDatabase map = RoomMap(SomeGauge());
  MapMeasures measures = MeasureMap({}, map);
  measures.tags.emplace();
  measures.tags->metres_per_unit = 1.0 / SomeGauge().scale;
  EXPECT_NEAR(GuessStage(map, measures).scale, SomeGauge().scale, 1e-12);
}

TEST(MeasureMap, TellsWhyTagsGiveNoScale) {
  vision::SceneDatabase map = RoomMap({});
  map.keyframes[0].grey = cv::Mat(480, 640, CV_8UC1, cv::Scalar(90));
  PlaceDocument place;
  place.name = "tavern";
  place.tags = TagsDocument{"tag36h11", 0.2};
  const MapMeasures measures = MeasureMap(place, map);
  const ResolvedPicks resolved = ResolvePicks(place, map, measures);
  EXPECT_THAT(resolved.problem.message(), HasSubstr("tavern"));
  EXPECT_THAT(resolved.problem.message(), HasSubstr("no tag of the family"));
}

TEST(LayOnFloor, MakesTheStageLevelAndKeepsItsHeading) {
  const vision::SceneDatabase map = RoomMap(SomeGauge());
  const MapMeasures measures = MeasureMap({}, map);
  ASSERT_TRUE(measures.floor.has_value());
  const Similarity3 map_from_picked = {
      3.0, Eigen::Quaterniond(0.9, 0.1, 0.3, -0.2).normalized(), {1, 2, 3}};
  const Similarity3 by_hand = {
      1.1, Eigen::Quaterniond(0.8, -0.3, 0.1, 0.4).normalized(), {0.4, 1.0, -2.0}};
  const Similarity3 laid = LayOnFloor(map_from_picked, by_hand, *measures.floor);
  const Similarity3 map_from_stage = map_from_picked * laid;
  EXPECT_LT(TiltInRoom(map_from_stage, SomeGauge()), 0.005);
  EXPECT_NEAR((SomeGauge().Inverse() * map_from_stage.translation).z(), 0.0, 0.005);
  EXPECT_EQ(laid.scale, by_hand.scale);
  // The stage moved only along the floor's normal.
  const Vector3d moved = map_from_picked * laid.translation - map_from_picked * by_hand.translation;
  EXPECT_LT(moved.cross(measures.floor->normal).norm(), 1e-9 * moved.norm());
  // A second call changes nothing.
  const Similarity3 again = LayOnFloor(map_from_picked, laid, *measures.floor);
  EXPECT_TRUE(again.translation.isApprox(laid.translation, 1e-9));
  EXPECT_LT(again.rotation.angularDistance(laid.rotation), 1e-7);
}

TEST(ScaledToDistance, GivesTheDistanceThatWasTypedAboutTheStagesOrigin) {
  const Similarity3 map_from_picked = {
      3.0, Eigen::Quaterniond(0.9, 0.1, 0.3, -0.2).normalized(), {1, 2, 3}};
  const Similarity3 by_hand = {
      1.1, Eigen::Quaterniond(0.8, -0.3, 0.1, 0.4).normalized(), {0.4, 1.0, -2.0}};
  const Vector3d from(0.3, -1.0, 2.0);
  const Vector3d to(1.3, 0.5, -0.5);
  const Similarity3 scaled = ScaledToDistance(map_from_picked, by_hand, from, to, 1.25);
  EXPECT_NEAR(StageDistance(map_from_picked * scaled, from, to), 1.25, 1e-12);
  // The same distance in stage axes.
  const Similarity3 stage_from_map = (map_from_picked * scaled).Inverse();
  EXPECT_NEAR((stage_from_map * to - stage_from_map * from).norm(), 1.25, 1e-12);
  EXPECT_EQ(scaled.translation, by_hand.translation);
  EXPECT_EQ(scaled.rotation.coeffs(), by_hand.rotation.coeffs());
}

TEST(ScaledToDistance, StaysRightInAMapOfAnotherUnit) {
  // After another training: the map is 2.7 times as large, and the picks give the same metres.
  const Similarity3 other_from_map = {
      2.7, Eigen::Quaterniond(0.2, 0.5, -0.3, 0.7).normalized(), {5, 0, 1}};
  const Similarity3 map_from_picked = {3.0, Eigen::Quaterniond::Identity(), {1, 2, 3}};
  const Vector3d from(0.3, -1.0, 2.0);
  const Vector3d to(1.3, 0.5, -0.5);
  const Similarity3 scaled = ScaledToDistance(map_from_picked, {}, from, to, 0.8);
  EXPECT_NEAR(StageDistance(other_from_map * map_from_picked * scaled, other_from_map * from,
                            other_from_map * to),
              0.8, 1e-12);
}

TEST(StageReport, MeasuresTheStageAgainstTheFloor) {
  const vision::SceneDatabase map = RoomMap(SomeGauge());
  PlaceDocument place;
  const MapMeasures measures = MeasureMap(place, map);
  const ResolvedPicks resolved = ResolvePicks(place, map, measures);
  Json json = StageJson(place, measures, resolved);
  EXPECT_EQ(json["scale"]["from"], "nothing");
  EXPECT_NEAR(json["floor"]["stage_tilt_deg"].get<double>(), 0.0, 1e-5);
  EXPECT_NEAR(json["floor"]["stage_height_mm"].get<double>(), 0.0, 1e-6);

  place.picked_from_stage.translation = {0.0, 0.25, 0.0};
  place.picked_from_stage.rotation = Eigen::AngleAxisd(0.1, Vector3d::UnitX());
  json = StageJson(place, measures, resolved);
  EXPECT_NEAR(json["floor"]["stage_tilt_deg"].get<double>(), 5.7296, 1e-3);
  EXPECT_NEAR(json["floor"]["stage_height_mm"].get<double>(), 250.0, 1e-6);
  EXPECT_THAT(StageText(place, measures, resolved), HasSubstr("the stage lies 250.0 mm above it"));
  place.picked_from_stage.translation.y() = -0.25;
  EXPECT_THAT(StageText(place, measures, resolved), HasSubstr("the stage lies 250.0 mm below it"));
}

TEST(LoadStagedMap, SaysWhatAPlaceLacks) {
  const test::TemporaryFolder folder;
  PlaceDocument place;
  place.name = "tavern";
  EXPECT_THAT(LoadStagedMap({folder.path()}, place).message(), HasSubstr("scene.larscene"));
}

TEST(StagePlace, ShapesNeedNoBakingAndKeepWhatTheyDo) {
  const test::TemporaryFolder folder;
  PlaceDocument place;
  place.name = "tavern";
  OccluderDocument& gate = place.occluders.emplace_back();
  gate.name = "gate";
  gate.shape = EntryOf(OccluderShape::Kind::kArch).usual;
  gate.stage_from_mesh.translation = {1.0, 0.0, -2.0};
  gate.receives_shadow = false;
  // Also as an obstacle of another place, which need not be trained.
  for (const auto& staged :
       {StagePlace({folder.path()}, place, {}, {}), StageObstacles({folder.path()}, place)}) {
    ASSERT_TRUE(staged.ok()) << staged.message();
    ASSERT_EQ(staged->occluders.size(), 1u);
    const stage::Occluder& occluder = staged->occluders[0];
    EXPECT_EQ(occluder.name, "gate");
    EXPECT_EQ(occluder.mesh.positions, MakeShapeMesh(*gate.shape).positions);
    EXPECT_EQ(occluder.stage_from_mesh.translation, Vector3d(1.0, 0.0, -2.0));
    EXPECT_TRUE(!occluder.receives_shadow && occluder.blocks_sound && occluder.blocks_walking);
  }
}

TEST(Restage, FollowsSizesPoseAndWhatItDoes) {
  OccluderDocument counter;
  counter.shape = OccluderShape{OccluderShape::Kind::kBox, 2.0, 1.0, 0.5};
  counter.stage_from_mesh.scale = 0.5;
  counter.blocks_sound = counter.blocks_walking = false;
  stage::Occluder staged;
  Restage(counter, {}, staged);
  EXPECT_EQ(staged.mesh.positions, MakeShapeMesh(*counter.shape).positions);
  EXPECT_EQ(staged.stage_from_mesh.scale, 0.5);
  EXPECT_TRUE(staged.receives_shadow && !staged.blocks_sound && !staged.blocks_walking);

  OccluderDocument model;
  model.file = "counter.glb";
  const size_t corners = staged.mesh.positions.size();
  Restage(model, {}, staged);
  EXPECT_EQ(staged.mesh.positions.size(), corners) << "the mesh of a file stays";
  EXPECT_TRUE(staged.blocks_sound && staged.blocks_walking);

  OccluderDocument drawn;
  Similarity3 map_from_stage;
  map_from_stage.scale = 4.0;
  Restage(drawn, map_from_stage, staged);
  EXPECT_EQ(staged.stage_from_mesh.scale, 0.25) << "drawn in the map";
}

// Frames whose pixels all have the frame's index as value.
class CountingSource : public capture::FrameSource {
 public:
  Result<std::optional<geometry::Frame>> Next() override {
    geometry::Frame frame;
    frame.index = next_;
    frame.grey = cv::Mat(480, 640, CV_8UC1, cv::Scalar(static_cast<double>(next_)));
    ++next_;
    return std::optional(std::move(frame));
  }
  Status Seek(int64_t index) override {
    next_ = index;
    return Status();
  }
  std::optional<int64_t> frame_count() const override { return 50; }
  int width() const override { return 640; }
  int height() const override { return 480; }
  double frames_per_second() const override { return 30.0; }
  bool live() const override { return false; }
  std::string FrameName(int64_t index) const override { return "frame" + std::to_string(index); }

 private:
  int64_t next_ = 0;
};

TEST(KeepPickedFrames, AddsLocatedFramesThatWerePickedIn) {
  vision::SceneDatabase map = RoomMap({});
  PlaceDocument place;
  place.picks.origin.picks = {{10, "frame10", {1, 1}},      // Already a keyframe.
                              {13, "frame13", {1, 1}},      // Located.
                              {14, "frame14", {1, 1}},      // Not located.
                              {17, "frame17", {1, 1}, 1}};  // A frame of another session.
  place.picks.length_to.picks = {{13, "frame13", {2, 2}}};
  OccluderDocument occluder;
  occluder.corners = {{"corner 1", {{15, "frame15", {3, 3}}}}};
  place.occluders = {occluder};
  train::TrainReport report;
  for (const int64_t frame : {10, 13, 15, 17}) {
    geometry::Rigid3 pose;
    pose.translation.x() = static_cast<double>(frame);
    report.located.push_back({frame, "frame" + std::to_string(frame), pose, frame == 10});
  }
  CountingSource source;
  ASSERT_TRUE(KeepPickedFrames(place, 0, report, source, map).ok());
  ASSERT_EQ(map.keyframes.size(), 7u);
  EXPECT_EQ(map.keyframes.back().frame_index, 15);
  const vision::Keyframe& added = map.keyframes[5];
  EXPECT_EQ(added.frame_index, 13);
  EXPECT_EQ(added.name, "frame13");
  EXPECT_EQ(added.camera_from_map.translation.x(), 13.0);
  EXPECT_EQ(added.grey.at<uint8_t>(100, 100), 13);
}

}  // namespace
}  // namespace lararium::editor
