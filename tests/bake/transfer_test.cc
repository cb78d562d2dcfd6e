#include "editor/bake/transfer.h"

#include <gtest/gtest.h>

#include <cmath>

#include "shared/core/parallel.h"
#include "shared/light/spherical_harmonics.h"
#include "tests/bake/test_surfaces.h"

namespace lararium::bake {
namespace {

using human::LightTransfer;

LightTransfer Bake(const human::Human& human, const TransferOptions& options) {
  NoProgress progress;
  CHECK(human.Validate("here").ok());
  auto transfer = BakeTransfer(human, options, progress);
  CHECK(transfer.ok());
  const Status valid = transfer->Validate(human.meshes, human.skeleton.size(), "here");
  EXPECT_TRUE(valid.ok()) << valid.message();
  return *std::move(transfer);
}

// T_k of a vertex.
std::vector<float> Vector(
    const LightTransfer& transfer, size_t mesh, size_t pose, size_t vertex, size_t channel = 0) {
  const LightTransfer::Mesh& from = transfer.meshes[mesh];
  const size_t row = pose * from.receivers.size() + vertex;
  const auto count = static_cast<size_t>(transfer.count);
  std::vector<float> vector;
  for (size_t k = 0; k < count; ++k) {
    vector.push_back(from.scale[row] *
                     static_cast<float>(from.coefficients[(row * 3 + channel) * count + k]));
  }
  return vector;
}

// Irradiance divided by pi for a sky of radiance 1.
float UnderUniformSky(const std::vector<float>& vector) {
  return vector[0] * std::sqrt(4.0f * kPiF) / kPiF;
}

float Distance(const std::vector<float>& a, const std::vector<float>& b) {
  float sum = 0.0f;
  for (size_t k = 0; k < a.size(); ++k) {
    sum += (a[k] - b[k]) * (a[k] - b[k]);
  }
  return std::sqrt(sum);
}

std::vector<float> ClampedCosine(const glm::vec3& normal, int count) {
  const auto basis = light::EvaluateShBasis(normal);
  std::vector<float> vector;
  for (int k = 0; k < count; ++k) {
    vector.push_back(light::ClampedCosineFactor(light::ShBandOf(k)) *
                     basis[static_cast<size_t>(k)]);
  }
  return vector;
}

TEST(Transfer, OfWhatNothingShadowsIsTheClampedCosine) {
  const SurfaceMesh sphere = MakeCap({0, 1, 0}, 0.5f, kPiF, false, glm::vec3(0.5f), 12, 16);
  const human::Human human = MakeRigidHuman({glm::vec3(0.0f)}, {{sphere, 0}});
  for (const int count : {9, 36}) {
    const LightTransfer transfer =
        Bake(human, {.count = count, .rays = 256, .bounces = 2, .blockers = 4, .receivers = 20});
    ASSERT_EQ(transfer.count, count);
    ASSERT_EQ(transfer.key_poses.size(), 1u);
    for (size_t v = 0; v < sphere.positions.size(); ++v) {
      const std::vector<float> expected = ClampedCosine(sphere.normals[v], count);
      for (size_t channel = 0; channel < 3; ++channel) {
        // The norm of the complete vector is about 1.5.
        EXPECT_LT(Distance(Vector(transfer, 0, 0, v, channel), expected), 0.06f) << v;
      }
    }
  }
}

// A vertex in the middle between two parallel discs loses their form factor; reflections return
// a part in proportion to the albedo.
TEST(Transfer, BetweenTwoDiscsTheFormFactorIsHidden) {
  const float radius = 1.0f;
  const float height = 0.8f;
  const float factor = radius * radius / (radius * radius + height * height);
  const SurfaceMesh lower = MakeDisc({0, 1, 0}, {0, 1, 0}, radius, glm::vec3(0.0f));
  const SurfaceMesh upper = MakeDisc({0, 1.0f + height, 0}, {0, -1, 0}, radius, glm::vec3(0.0f));
  const human::Human human = MakeRigidHuman({glm::vec3(0.0f)}, {{lower, 0}, {upper, 0}});
  const LightTransfer transfer = Bake(human, {.rays = 1024, .bounces = 1});
  EXPECT_NEAR(UnderUniformSky(Vector(transfer, 0, 0, 0)), 1.0f - factor, 0.01f);
  EXPECT_NEAR(UnderUniformSky(Vector(transfer, 1, 0, 0)), 1.0f - factor, 0.01f);
  // The remaining light comes from the sides: none from straight above, and much less along the
  // normal than for the clamped cosine.
  const std::vector<float> open = ClampedCosine({0, 1, 0}, transfer.count);
  EXPECT_LT(Vector(transfer, 0, 0, 0)[1], 0.5f * open[1]);
  EXPECT_GT(Vector(transfer, 0, 0, 0)[1], 0.0f);
  EXPECT_LT(Vector(transfer, 1, 0, 0)[1], 0.0f);
}

// The back of the lower of two parallel sheets receives everything but the form factor of a
// black disc beneath it. A closed surface has no transfer for its back.
TEST(Transfer, TheBackOfASheetLosesTheFormFactorOfWhatIsBehindIt) {
  const float factor = 1.0f / (1.0f + 0.8f * 0.8f);
  const human::Human human = MakeRigidHuman(
      {glm::vec3(0.0f)}, {{MakeDisc({0, 2, 0}, {0, 1, 0}, 1.0f, glm::vec3(0.5f)), 0},
                          {MakeDisc({0, 1.2f, 0}, {0, 1, 0}, 1.0f, glm::vec3(0.0f)), 0},
                          {MakeSphere({5, 1, 0}, 0.3f, glm::vec3(0.5f)), 0}});
  const LightTransfer transfer = Bake(human, {.rays = 1024, .bounces = 0});
  ASSERT_EQ(transfer.meshes[0].backs.size(), human.meshes[0].positions.size());
  for (size_t channel = 0; channel < 3; ++channel) {
    EXPECT_NEAR(transfer.meshes[0].backs[0][channel] / 255.0f, 1.0f - factor, 0.02f);
    EXPECT_NEAR(transfer.meshes[1].backs[0][channel] / 255.0f, 1.0f, 0.02f);
  }
  EXPECT_TRUE(transfer.meshes[2].backs.empty());
}

// As in path_tracer_test.cc: a bowl receives half of its reflected light.
TEST(Transfer, BouncesInABowlAddUpAsInAnIntegratingSphere) {
  const glm::vec3 albedo(1.0f, 0.5f, 0.0f);
  const SurfaceMesh bowl = MakeCap({0, 1, 0}, 0.5f, 0.5f * kPiF, true, albedo, 10, 20);
  const human::Human human = MakeRigidHuman({glm::vec3(0.0f)}, {{bowl, 0}});
  for (const int bounces : {0, 1, 3}) {
    const LightTransfer transfer = Bake(human, {.rays = 256, .bounces = bounces});
    for (const size_t vertex : {size_t{0}, size_t{25}, size_t{125}}) {
      for (size_t channel = 0; channel < 3; ++channel) {
        float expected = 0.0f;
        for (int k = 0; k <= bounces; ++k) {
          expected +=
              0.5f * std::pow(0.5f * albedo[static_cast<int>(channel)], static_cast<float>(k));
        }
        EXPECT_NEAR(UnderUniformSky(Vector(transfer, 0, 0, vertex, channel)), expected, 0.03f)
            << vertex << ", " << bounces << " bounces";
      }
    }
  }
}

// A bell over the middle of a disc blocks all light there. Only the three outer rings of a
// closed pocket are lightened; further inside it stays dark.
TEST(Transfer, OfAClosedPocketIsThatOfItsRim) {
  const SurfaceMesh disc = MakeDisc({0, 1, 0}, {0, 1, 0}, 1.0f, glm::vec3(0.0f));
  const SurfaceMesh bell = MakeSphere({0, 1, 0}, 0.05f, glm::vec3(0.0f));
  const human::Human small = MakeRigidHuman({glm::vec3(0.0f)}, {{disc, 0}, {bell, 0}});
  const LightTransfer opened = Bake(small, {.rays = 256, .bounces = 0});
  EXPECT_NEAR(UnderUniformSky(Vector(opened, 0, 0, 0)), 1.0f, 0.02f) << "the middle";
  EXPECT_NEAR(UnderUniformSky(Vector(opened, 0, 0, 1)), 1.0f, 0.02f) << "the rim";

  // Ring k of the bowl is at k / 10 of its depth; the lid is a wide sphere about its lower
  // half.
  const SurfaceMesh bowl = MakeCap({0, 1, 0}, 0.5f, 0.5f * kPiF, true, glm::vec3(0.0f), 10, 20);
  const SurfaceMesh lid = MakeSphere({0, 0.5f, 0}, 0.4f, glm::vec3(0.0f));
  const human::Human deep = MakeRigidHuman({glm::vec3(0.0f)}, {{bowl, 0}, {lid, 0}});
  const LightTransfer closed = Bake(deep, {.rays = 256, .bounces = 0});
  EXPECT_LT(UnderUniformSky(Vector(closed, 0, 0, 0)), 0.01f) << "its lowest point";
}

// Two boxes side by side that rotate together, far from a third one at the root.
human::Human MakeTurningPair() {
  human::Human human = MakeRigidHuman(
      {glm::vec3(0.0f), glm::vec3(2, 0, 0)},
      {{MakeBox({-0.05f, -0.05f, -0.05f}, {0.05f, 0.05f, 0.05f}, glm::vec3(0.5f)), 0},
       {MakeBox({1.8f, -0.1f, -0.1f}, {1.95f, 0.1f, 0.1f}, glm::vec3(0.8f, 0.5f, 0.2f)), 1},
       {MakeBox({2.05f, -0.2f, -0.1f}, {2.2f, 0.2f, 0.1f}, glm::vec3(0.2f, 0.5f, 0.8f)), 1}});
  human::Clip clip;
  clip.name = "turn";
  clip.duration = 1.0f;
  clip.keys_per_second = 1.0f;
  for (const float angle : {0.0f, 0.5f * kPiF}) {
    std::vector<human::JointTransform> pose = human.skeleton.rest;
    pose[1].rotation = glm::angleAxis(angle, glm::vec3(0, 0, 1));
    clip.keys.insert(clip.keys.end(), pose.begin(), pose.end());
  }
  human.clips = {clip};
  return human;
}

TEST(Transfer, TurnsWithTheBone) {
  const human::Human human = MakeTurningPair();
  const LightTransfer transfer = Bake(human, {.rays = 1024, .key_poses = 2, .blockers = 8});
  ASSERT_EQ(transfer.key_poses.size(), 2u);
  ASSERT_NEAR(std::abs(glm::dot(transfer.key_poses[1][1].rotation,
                                glm::angleAxis(0.5f * kPiF, glm::vec3(0, 0, 1)))),
              1.0f, 1e-4f);
  float shadowed = 0.0f;
  for (size_t mesh = 1; mesh < 3; ++mesh) {
    for (size_t v = 0; v < human.meshes[mesh].positions.size(); ++v) {
      for (size_t channel = 0; channel < 3; ++channel) {
        const std::vector<float> before = Vector(transfer, mesh, 0, v, channel);
        const std::vector<float> after = Vector(transfer, mesh, 1, v, channel);
        EXPECT_LT(Distance(before, after), 0.06f) << mesh << ", " << v;
        shadowed = std::max(shadowed, Distance(before, ClampedCosine(human.meshes[mesh].normals[v],
                                                                     transfer.count)));
      }
    }
  }
  // The boxes do shadow each other.
  EXPECT_GT(shadowed, 0.4f);
}

TEST(Transfer, IsTheSameOnAnyNumberOfCores) {
  const human::Human human = MakeTurningPair();
  const TransferOptions options = {.count = 9, .rays = 64, .key_poses = 3, .blockers = 8};
  const LightTransfer many = Bake(human, options);
  const ThreadLimit limit(1);
  const LightTransfer one = Bake(human, options);
  ASSERT_EQ(many.meshes.size(), one.meshes.size());
  for (size_t m = 0; m < many.meshes.size(); ++m) {
    EXPECT_EQ(many.meshes[m].coefficients, one.meshes[m].coefficients);
    EXPECT_EQ(many.meshes[m].scale, one.meshes[m].scale);
    EXPECT_EQ(many.meshes[m].receivers, one.meshes[m].receivers);
    EXPECT_EQ(many.meshes[m].weights, one.meshes[m].weights);
  }
  ASSERT_EQ(many.blockers.size(), one.blockers.size());
  for (size_t i = 0; i < many.blockers.size(); ++i) {
    EXPECT_EQ(many.blockers[i].centre, one.blockers[i].centre);
    EXPECT_EQ(many.blockers[i].radius, one.blockers[i].radius);
  }
}

class CancelAtOnce : public Progress {
 public:
  void Report(std::string_view, double) override {}
  bool Cancelled() const override { return true; }
};

TEST(Transfer, EndsWhenCancelled) {
  CancelAtOnce impatient;
  EXPECT_FALSE(BakeTransfer(MakeTurningPair(), {.rays = 16}, impatient).ok());
}

}  // namespace
}  // namespace lararium::bake
