#include "shared/vision/scene_database.h"

#include <gtest/gtest.h>

#include <limits>
#include <opencv2/core.hpp>

#include "shared/core/file.h"
#include "shared/core/random.h"
#include "shared/vision/scene_database_generated.h"
#include "tests/support/synthetic_world.h"
#include "tests/support/test_files.h"

namespace lararium::vision {
namespace {

using geometry::Rigid3;

SceneDatabase SmallDatabase() {
  test::SyntheticWorld world = test::MakeSyntheticWorld({.points = 40, .cameras = 2});
  world.camera = world.camera.Resized(64, 48);
  SceneDatabase database = test::MakeSceneDatabase(world);
  Random random(7);
  for (size_t i = 0; i < database.points.size(); ++i) {
    database.colours.push_back(
        Eigen::Vector3d{random.Uniform(0, 1), random.Uniform(0, 1), -1.0}.cast<float>());
  }
  database.keyframes[1].gain = {0.5f, 1.25f, 2.0f};
  database.readout = {0.01, 0.7};
  database.keyframes[0].motion << 0.01, -0.02, 0.003, 0.1, 0.02, -0.05;
  return database;
}

// Changes a table's vtable so that the field is absent.
void ForgetField(flatbuffers::Table* table, flatbuffers::voffset_t field) {
  auto* vtable = const_cast<uint8_t*>(table->GetVTable());
  flatbuffers::WriteScalar<flatbuffers::voffset_t>(vtable + field, 0);
}

void ExpectSame(const SceneDatabase& a, const SceneDatabase& b) {
  EXPECT_EQ(a.camera, b.camera);
  EXPECT_EQ(a.readout, b.readout);
  EXPECT_EQ(a.mean_reprojection_error_px, b.mean_reprojection_error_px);
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.normals, b.normals);
  EXPECT_EQ(a.observation_counts, b.observation_counts);
  EXPECT_EQ(a.session_masks, b.session_masks);
  EXPECT_EQ(a.colours, b.colours);
  EXPECT_EQ(a.descriptor_begin, b.descriptor_begin);
  EXPECT_EQ(a.descriptors, b.descriptors);
  EXPECT_EQ(a.descriptor_point, b.descriptor_point);
  EXPECT_EQ(a.forest.roots, b.forest.roots);
  EXPECT_EQ(a.forest.order, b.forest.order);
  EXPECT_EQ(a.forest.nodes.size(), b.forest.nodes.size());
  ASSERT_EQ(a.keyframes.size(), b.keyframes.size());
  for (size_t i = 0; i < a.keyframes.size(); ++i) {
    EXPECT_EQ(a.keyframes[i].name, b.keyframes[i].name);
    EXPECT_EQ(a.keyframes[i].frame_index, b.keyframes[i].frame_index);
    EXPECT_EQ(a.keyframes[i].camera_from_map.translation,
              b.keyframes[i].camera_from_map.translation);
    EXPECT_EQ(a.keyframes[i].gain, b.keyframes[i].gain);
    EXPECT_EQ(a.keyframes[i].motion, b.keyframes[i].motion);
    ASSERT_EQ(a.keyframes[i].grey.size(), b.keyframes[i].grey.size());
    if (a.keyframes[i].grey.empty()) {
      continue;
    }
    EXPECT_LT(cv::norm(a.keyframes[i].grey, b.keyframes[i].grey, cv::NORM_INF), 3.0);
  }
  ASSERT_EQ(a.observations.size(), b.observations.size());
  for (size_t i = 0; i < a.observations.size(); ++i) {
    EXPECT_EQ(a.observations[i].point, b.observations[i].point);
    EXPECT_EQ(a.observations[i].x, b.observations[i].x);
  }
}

TEST(SceneDatabase, SurvivesTheRoundTrip) {
  const test::TemporaryFolder folder;
  SceneDatabase database = SmallDatabase();
  database.mean_reprojection_error_px = 0.25;
  ASSERT_TRUE(SaveSceneDatabase(folder / "a.larscene", database).ok());
  const auto loaded = LoadSceneDatabase(folder / "a.larscene");
  ASSERT_TRUE(loaded.ok()) << loaded.message();
  ExpectSame(database, *loaded);
}

TEST(SceneDatabase, AKeyframeSawAPointAtTheTimeOfItsPixel) {
  const SceneDatabase database = SmallDatabase();
  for (uint32_t keyframe = 0; keyframe < 2; ++keyframe) {
    const Rigid3& middle = database.keyframes[keyframe].camera_from_map;
    int moved = 0;
    for (const Eigen::Vector3f& p : database.points) {
      const Eigen::Vector3d point = p.cast<double>();
      const auto pixel = database.PixelIn(keyframe, point);
      if (!pixel || !database.camera.Contains(*pixel)) {
        continue;
      }
      const auto again = database.camera.Project(database.PoseAt(keyframe, *pixel) * point);
      ASSERT_TRUE(again);
      EXPECT_LT((*again - *pixel).norm(), 1e-3);
      moved += (*pixel - *database.camera.Project(middle * point)).norm() > 0.01 ? 1 : 0;
    }
    EXPECT_EQ(moved > 0, keyframe == 0);  // The motion of the other one is not known.
  }
}

TEST(SceneDatabase, KeyframesMayHaveNoImage) {
  SceneDatabase database = SmallDatabase();
  database.keyframes[1].grey = cv::Mat();
  const auto parsed = ParseSceneDatabase(SerializeSceneDatabase(database), "bare");
  ASSERT_TRUE(parsed.ok()) << parsed.message();
  ExpectSame(database, *parsed);
}

// Files of version 0.1 lack the fields that were added later.
TEST(SceneDatabase, ReadsFilesWithoutColour) {
  SceneDatabase database = SmallDatabase();
  database.colours.clear();
  database.keyframes[1].gain = {1.0f, 1.0f, 1.0f};
  std::vector<std::byte> bytes = SerializeSceneDatabase(database);
  auto* scene = flatbuffers::GetMutableRoot<flatbuffers::Table>(bytes.data());
  using Keyframes = flatbuffers::Vector<flatbuffers::Offset<flatbuffers::Table>>;
  auto* keyframes = scene->GetPointer<Keyframes*>(fb::Scene::VT_KEYFRAMES);
  for (flatbuffers::uoffset_t i = 0; i < keyframes->size(); ++i) {
    ForgetField(keyframes->GetMutableObject(i), fb::Keyframe::VT_GAIN);
  }
  const auto parsed = ParseSceneDatabase(bytes, "old");
  ASSERT_TRUE(parsed.ok()) << parsed.message();
  ExpectSame(database, *parsed);
}

TEST(SceneDatabase, GivesTheSameBytesForTheSameContent) {
  EXPECT_EQ(SerializeSceneDatabase(SmallDatabase()), SerializeSceneDatabase(SmallDatabase()));
}

TEST(SceneDatabase, MayBeEmpty) {
  SceneDatabase empty;
  empty.camera = SmallDatabase().camera;
  empty.descriptor_begin = {0};
  const auto parsed = ParseSceneDatabase(SerializeSceneDatabase(empty), "empty");
  ASSERT_TRUE(parsed.ok()) << parsed.message();
  EXPECT_TRUE(parsed->points.empty());
}

TEST(SceneDatabase, RefusesEveryTruncation) {
  const std::vector<std::byte> bytes = SerializeSceneDatabase(SmallDatabase());
  for (size_t size = 0; size < bytes.size(); size += 64) {
    const std::vector<std::byte> cut(bytes.begin(), bytes.begin() + size);
    const auto parsed = ParseSceneDatabase(cut, "cut.larscene");
    ASSERT_FALSE(parsed.ok()) << size << " bytes";
    EXPECT_NE(parsed.message().find("cut.larscene"), std::string::npos);
  }
}

TEST(SceneDatabase, SurvivesFlippedBits) {
  const std::vector<std::byte> bytes = SerializeSceneDatabase(SmallDatabase());
  Random random(1);
  for (int i = 0; i < 2000; ++i) {
    std::vector<std::byte> damaged = bytes;
    const size_t flips = 1 + random.Below(8);
    for (size_t k = 0; k < flips; ++k) {
      const uint32_t bit = random.Below(static_cast<uint32_t>(8 * bytes.size()));
      damaged[bit / 8] ^= std::byte{1} << (bit % 8);
    }
    // A damaged file that is accepted must still be valid.
    const auto parsed = ParseSceneDatabase(damaged, "damaged");
    if (parsed.ok()) {
      ASSERT_TRUE(parsed->Validate().ok());
    }
  }
}

TEST(SceneDatabase, SurvivesHugeNumbersEverywhere) {
  const std::vector<std::byte> bytes = SerializeSceneDatabase(SmallDatabase());
  for (size_t at = 0; at + 4 <= bytes.size(); at += 12) {
    std::vector<std::byte> damaged = bytes;
    std::fill_n(damaged.begin() + at, 4, std::byte{0xff});
    const auto parsed = ParseSceneDatabase(damaged, "damaged");
    if (parsed.ok()) {
      ASSERT_TRUE(parsed->Validate().ok());
    }
  }
}

TEST(SceneDatabase, RefusesOtherFiles) {
  EXPECT_FALSE(ParseSceneDatabase({}, "empty").ok());
  const std::vector<std::byte> zeros(4096);
  EXPECT_FALSE(ParseSceneDatabase(zeros, "zeros").ok());
  const test::TemporaryFolder folder;
  EXPECT_FALSE(LoadSceneDatabase(folder / "none.larscene").ok());
}

// Each edit breaks one invariant of the header.
TEST(SceneDatabase, SaysWhatIsBroken) {
  const SceneDatabase good = SmallDatabase();
  ASSERT_TRUE(good.Validate().ok());
  const auto refuses = [&](const char* what, const auto& edit) {
    SceneDatabase bad = good;
    edit(bad);
    EXPECT_FALSE(bad.Validate().ok()) << what;
    const test::TemporaryFolder folder;
    EXPECT_FALSE(SaveSceneDatabase(folder / "bad.larscene", bad).ok()) << what;
    EXPECT_FALSE(std::filesystem::exists(folder / "bad.larscene")) << what;
  };
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  refuses("camera", [](SceneDatabase& db) { db.camera.fx = 0.0; });
  refuses("mean error", [](SceneDatabase& db) { db.mean_reprojection_error_px = -1.0; });
  refuses("point", [](SceneDatabase& db) { db.points[3].y() = kNan; });
  refuses("far point", [](SceneDatabase& db) { db.points[3].y() = 1e30f; });
  refuses("normal", [](SceneDatabase& db) { db.normals[3] *= 2.0f; });
  refuses("normals", [](SceneDatabase& db) { db.normals.pop_back(); });
  refuses("counts", [](SceneDatabase& db) { db.observation_counts.pop_back(); });
  refuses("sessions", [](SceneDatabase& db) { db.session_masks.pop_back(); });
  refuses("ranges", [](SceneDatabase& db) { db.descriptor_begin.pop_back(); });
  refuses("order of ranges", [](SceneDatabase& db) { db.descriptor_begin[2] = 30; });
  refuses("descriptor_point", [](SceneDatabase& db) { db.descriptor_point[5] = 6; });
  refuses("forest", [](SceneDatabase& db) { db.forest.roots.clear(); });
  refuses("pose",
          [](SceneDatabase& db) { db.keyframes[0].camera_from_map.rotation.coeffs() *= 1.1; });
  refuses("motion", [](SceneDatabase& db) { db.keyframes[0].motion[4] = kNan; });
  refuses("readout time", [](SceneDatabase& db) { db.readout.y() = -3.0; });
  refuses("keyframe image", [](SceneDatabase& db) {
    db.keyframes[1].grey = cv::Mat(48, 63, CV_8UC1, cv::Scalar(0));
  });
  refuses("colours", [](SceneDatabase& db) { db.colours.pop_back(); });
  refuses("colour", [](SceneDatabase& db) { db.colours[3].y() = kNan; });
  refuses("bright colour", [](SceneDatabase& db) { db.colours[3].y() = 1e30f; });
  refuses("gain", [](SceneDatabase& db) { db.keyframes[1].gain[2] = 0.0f; });
  refuses("no gain", [](SceneDatabase& db) { db.keyframes[1].gain[0] = kNan; });
  refuses("session", [](SceneDatabase& db) { db.keyframes[1].session = 32; });
  refuses("observed point", [](SceneDatabase& db) { db.observations[0].point = 40; });
  refuses("observed keyframe", [](SceneDatabase& db) { db.observations.back().keyframe = 2; });
  refuses("observed place", [](SceneDatabase& db) { db.observations[0].x = kNan; });
  refuses("observed scale", [](SceneDatabase& db) { db.observations[0].scale = 0.0f; });
  refuses("order of observations",
          [](SceneDatabase& db) { std::swap(db.observations.front(), db.observations.back()); });
}

}  // namespace
}  // namespace lararium::vision
