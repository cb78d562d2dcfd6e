#include "shared/render/detail.h"

#include <gtest/gtest.h>

#include <array>

#include "shared/core/random.h"
#include "shared/render/clip_space.h"
#include "tests/render/test_people.h"

namespace lararium::render {
namespace {

constexpr geometry::CameraModel kDetailDisplay{640, 480, 600.0, 600.0, 319.5, 239.5};

const std::array kLevels = {DetailLevel{0.0f, 40'000}, DetailLevel{0.001f, 20'000},
                            DetailLevel{0.004f, 8'000}, DetailLevel{0.016f, 2'000}};

TEST(FindDetailLevels, SumsWhatEachMeshShowsAtAnError) {
  human::Human human = MakeHuman(BendingBox(glm::vec3(0.5f)), 3);
  human.meshes.push_back(human.meshes[0]);
  std::vector<uint32_t> half = human.meshes[0].indices;
  half.resize(half.size() / 6 * 3);
  human.meshes[0].coarser = {{0.002f, half}};
  human.meshes[1].coarser = {{0.001f, half}, {0.004f, {0, 1, 2}}};
  const std::vector<DetailLevel> levels = FindDetailLevels(human);
  ASSERT_EQ(levels.size(), 4u);
  const size_t all = human.meshes[0].indices.size() / 3;
  EXPECT_EQ(levels[0].triangles, 2 * all);
  EXPECT_EQ(levels[1].triangles, all + half.size() / 3);
  EXPECT_EQ(levels[2].triangles, 2 * (half.size() / 3));
  EXPECT_EQ(levels[3].triangles, half.size() / 3 + 1);
  EXPECT_FLOAT_EQ(levels[3].error, 0.004f * human::ErrorShare(human::Surface::kPlain));
}

TEST(FindMeshLevels, CountsTheFirstVerticesThatALevelAndAllCoarserOnesTake) {
  human::Human human = MakeHuman(BendingBox(glm::vec3(0.5f)), 3);
  human::SkinnedMesh& mesh = human.meshes[0];
  mesh.indices = {0, 1, 2, 5, 4, 3};
  mesh.coarser = {{0.001f, {0, 1, 2}}, {0.002f, {1, 2, 3}}, {0.004f, {}}};
  const std::vector<MeshLevel> levels = FindMeshLevels(human, 0);
  ASSERT_EQ(levels.size(), 4u);
  const size_t vertices[] = {6, 4, 4, 0};
  const size_t triangles[] = {2, 1, 1, 0};
  for (size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(levels[i].vertices, vertices[i]) << i;
    EXPECT_EQ(levels[i].triangles, triangles[i]) << i;
  }
  EXPECT_EQ(&LevelAllowed(levels, 0.0f), &levels[0]);
  EXPECT_EQ(&LevelAllowed(levels, 0.003f * human::ErrorShare(human::Surface::kPlain)), &levels[2]);
  EXPECT_EQ(&LevelAllowed(levels, 1.0f), &levels[3]);
}

TEST(FindMeshLevels, OfWhatWasReadCoarselyAreTheCoarserOnesOfAll) {
  human::Human human = MakeHuman(BendingBox(glm::vec3(0.5f)), 3);
  human.meshes[0].coarser = {{0.002f, {0, 1, 2}}, {0.004f, {0, 1, 1}}};
  const float finest = 0.003f * human::ErrorShare(human::Surface::kPlain);
  const auto coarse = human::ParseHuman(human::SerializeHuman(human), "here", finest);
  ASSERT_TRUE(coarse.ok()) << coarse.message();
  const std::vector<MeshLevel> all = FindMeshLevels(human, 0);
  const std::vector<MeshLevel> levels = FindMeshLevels(*coarse, 0);
  ASSERT_EQ(all.size(), 3u);
  ASSERT_EQ(levels.size(), 2u);
  for (size_t i = 0; i < levels.size(); ++i) {
    EXPECT_EQ(levels[i].error, all[i + 1].error);
    EXPECT_EQ(levels[i].triangles, all[i + 1].triangles);
    EXPECT_EQ(levels[i].vertices, all[i + 1].vertices);
  }
}

TEST(FindMeshLevels, CountErrorsOfSkinAndEyesMoreThanOthers) {
  human::Human human = MakeHuman(BendingBox(glm::vec3(0.5f)), 3);
  human.meshes[0].coarser = {{0.002f, {0, 1, 2}}};
  human.meshes[0].material = 0;
  human.materials.resize(1);
  const auto error = [&human](human::Surface surface) {
    human.materials[0].surface = surface;
    return FindMeshLevels(human, 0)[1].error;
  };
  EXPECT_FLOAT_EQ(error(human::Surface::kSkin), 0.002f * human::ErrorShare(human::Surface::kSkin));
  EXPECT_FLOAT_EQ(error(human::Surface::kEye), error(human::Surface::kSkin));
  EXPECT_LT(error(human::Surface::kCloth), error(human::Surface::kSkin));
  EXPECT_LT(error(human::Surface::kHair), error(human::Surface::kSkin));
}

TEST(PixelsPerMetre, IsWhatTheCameraSees) {
  const geometry::Rigid3 camera_from_stage = LookAt({1, 2, 3}, {0, 1, 0}, {0, 1, 0});
  const glm::vec3 point(0.0f, 1.0f, 0.0f);
  const double distance = std::sqrt(1.0 + 1.0 + 9.0);
  EXPECT_NEAR(PixelsPerMetre(kDetailDisplay, camera_from_stage, point), 600.0 / distance, 1e-3);
  EXPECT_NEAR(PixelsPerMetre(kDetailDisplay, camera_from_stage, {1, 2, 3}), 1200.0, 1e-3);
}

TEST(MaySee, IsTrueOfEveryBallThatReachesIntoThePicture) {
  const geometry::Rigid3 camera_from_stage =
      LookAt({0.5, 1.7, 2.0}, {0.0, 1.0, -1.0}, {0.0, 1.0, 0.0});
  Random random(7);
  int seen = 0;
  int hidden = 0;
  for (int i = 0; i < 2000; ++i) {
    const glm::vec3 centre{random.Uniform(-6, 6), random.Uniform(-4, 4), random.Uniform(-6, 6)};
    bool touches = false;
    for (int k = 0; k < 30; ++k) {
      const Eigen::Vector3d offset =
          Eigen::Vector3d{random.Normal(), random.Normal(), random.Normal()}.normalized();
      const auto pixel = kDetailDisplay.Project(
          camera_from_stage * (Eigen::Vector3d(centre.x, centre.y, centre.z) + offset));
      touches |= pixel && kDetailDisplay.Contains(*pixel);
    }
    const bool may_see = MaySee(kDetailDisplay, camera_from_stage, centre, 1.0f);
    EXPECT_TRUE(may_see || !touches) << "seed 7, ball " << i;
    seen += may_see ? 1 : 0;
    hidden += may_see ? 0 : 1;
  }
  EXPECT_GT(seen, 100);
  EXPECT_GT(hidden, 500);
}

TEST(DetailChooser, AllowsWhatAFractionOfAPixelHides) {
  DetailChooser chooser({.tolerance_px = 0.5f, .triangle_budget = 1'000'000});
  std::array requests = {DetailRequest{kLevels, 1000.0f}, DetailRequest{kLevels, 100.0f},
                         DetailRequest{kLevels, 0.0f}};
  chooser.Choose(requests);
  EXPECT_FLOAT_EQ(requests[0].detail, 0.0005f);
  EXPECT_FLOAT_EQ(requests[1].detail, 0.005f);
  EXPECT_FLOAT_EQ(requests[2].detail, 0.0f);
}

TEST(DetailChooser, NobodyFlickersWhoStaysAboutAsFarAway) {
  DetailChooser chooser;
  std::array requests = {DetailRequest{kLevels, 125.0f}};
  chooser.Choose(requests);
  const float first = requests[0].detail;
  Random random(3);
  for (int i = 0; i < 100; ++i) {
    requests[0].pixels_per_metre = 125.0f * static_cast<float>(random.Uniform(0.85, 1.15));
    chooser.Choose(requests);
    EXPECT_EQ(requests[0].detail, first) << "seed 3, picture " << i;
  }
  requests[0].pixels_per_metre = 250.0f;
  chooser.Choose(requests);
  EXPECT_LT(requests[0].detail, first);
}

size_t Triangles(const DetailRequest& request) {
  size_t triangles = 0;
  for (const DetailLevel& level : request.levels) {
    triangles = level.error <= request.detail ? level.triangles : triangles;
  }
  return triangles;
}

TEST(DetailChooser, KeepsToTheBudgetAndLetsGoOfItLater) {
  DetailChooser chooser({.tolerance_px = 0.5f, .triangle_budget = 50'000});
  std::vector<DetailRequest> requests(5, DetailRequest{kLevels, 600.0f});
  chooser.Choose(requests);
  size_t sum = 0;
  for (const DetailRequest& request : requests) {
    sum += Triangles(request);
  }
  EXPECT_LE(sum, 50'000u);
  requests.resize(1);
  chooser.Choose(requests);
  EXPECT_EQ(Triangles(requests[0]), 40'000u);
}

}  // namespace
}  // namespace lararium::render
