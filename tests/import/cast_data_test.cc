// Builds the presets from the real cast library; skipped if it has not been fetched.

#include <gtest/gtest.h>

#include <atomic>
#include <glm/geometric.hpp>
#include <map>
#include <set>

#include "editor/import/cast/cast_builder.h"
#include "editor/import/cast/cast_presets.h"
#include "editor/import/cast/cast_shape.h"
#include "editor/import/cast/joint_lookup.h"
#include "editor/import/model/simplify.h"
#include "tests/support/test_files.h"

namespace lararium::import {
namespace {

// Opened once for all tests.
const CastLibrary* Library() {
  static const auto* library = [] {
    auto opened = CastLibrary::Open(test::CastLibraryDir());
    return opened.ok() ? new CastLibrary(*std::move(opened)) : nullptr;
  }();
  return library;
}

// The preset without clothes; garments have their own tests.
const human::Human& Preset(const std::string& name) {
  static std::map<std::string, human::Human> built;
  if (!built.contains(name)) {
    CastRecipe recipe = *LoadCastPreset(name);
    recipe.garments.clear();
    auto human = BuildCast(*Library(), recipe, NoProgress());
    EXPECT_TRUE(human.ok()) << human.status().message();
    built[name] = *std::move(human);
  }
  return built[name];
}

class CastPresets : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    if (Library() == nullptr) {
      GTEST_SKIP() << "needs the cast library: run scripts/fetch_cast_library.sh";
    }
  }
};

const human::SkinnedMesh& Mesh(const human::Human& human, std::string_view name) {
  for (const human::SkinnedMesh& mesh : human.meshes) {
    if (mesh.name == name) {
      return mesh;
    }
  }
  ADD_FAILURE() << "there is no part " << name;
  return human.meshes[0];
}

TEST_P(CastPresets, AreAsTallAsTheyShallBeAndStandOnTheirSoles) {
  const auto recipe = LoadCastPreset(GetParam());
  const auto body = FitBody(*Library(), *recipe);
  ASSERT_TRUE(body.ok()) << body.status().message();
  ASSERT_TRUE(recipe->height);
  EXPECT_NEAR(body->height, *recipe->height, 1e-3);
  float lowest = 1.0f;
  for (const glm::vec3& p : body->skin.positions) {
    lowest = std::min(lowest, p.y);
  }
  EXPECT_NEAR(lowest, 0.0f, 1e-5f);
}

TEST_P(CastPresets, FaceTheStage) {
  const human::Human& human = Preset(GetParam());
  EXPECT_LT(RestPosition(human.skeleton, "l_eyeball_joint").z,
            RestPosition(human.skeleton, "skullbase").z);
  EXPECT_LT(RestPosition(human.skeleton, "l_shoulder").x, 0.0f);
  EXPECT_LT(RestPosition(human.skeleton, "l_midtarsal").z,
            RestPosition(human.skeleton, "l_ankle").z);
}

TEST_P(CastPresets, KeepTheirPartsOnTheirHeads) {
  const human::Human& human = Preset(GetParam());
  const glm::vec3 skull = RestPosition(human.skeleton, "skullbase");
  for (size_t i = 1; i < human.meshes.size(); ++i) {
    for (const glm::vec3& p : human.meshes[i].positions) {
      ASSERT_LT(glm::distance(p, skull), 0.45f) << human.meshes[i].name;
    }
  }
}

TEST_P(CastPresets, AreSmallEnoughForABundle) {
  EXPECT_LT(human::SerializeHuman(Preset(GetParam())).size(), size_t{8} << 20);
}

TEST_P(CastPresets, AreTheSameEveryTime) {
  CastRecipe recipe = *LoadCastPreset(GetParam());
  recipe.garments.clear();
  const auto again = BuildCast(*Library(), recipe, NoProgress());
  ASSERT_TRUE(again.ok());
  EXPECT_EQ(human::SerializeHuman(*again), human::SerializeHuman(Preset(GetParam())));
}

TEST_P(CastPresets, HaveEveryVisemeExpressionAndBlink) {
  std::set<std::string> names;
  for (const human::FaceShape& shape : Preset(GetParam()).face) {
    names.insert(shape.name);
    EXPECT_FALSE(shape.morphs.empty()) << shape.name;
  }
  for (const char* name :
       {"sil",     "PP",    "FF",   "TH",      "DD",       "kk",      "CH",     "SS",
        "nn",      "RR",    "aa",   "E",       "ih",       "oh",      "ou",     "joy",
        "sadness", "anger", "fear", "disgust", "surprise", "blink_l", "blink_r"}) {
    EXPECT_TRUE(names.contains(name)) << name;
  }
}

// The largest movement of a vertex of a part by a face shape, metres.
float MostMoved(const human::Human& human, const std::string& shape, uint32_t mesh, float side) {
  float most = 0.0f;
  for (const human::FaceShape& face : human.face) {
    for (size_t i = 0; face.name == shape && i < face.morphs.size(); ++i) {
      for (const human::MorphTarget::Part& part : human.morphs[face.morphs[i].morph].parts) {
        for (size_t v = 0; part.mesh == mesh && v < part.vertices.size(); ++v) {
          if (human.meshes[mesh].positions[part.vertices[v]].x * side > 0.0f) {
            most = std::max(most, face.morphs[i].weight * glm::length(part.position_deltas[v]));
          }
        }
      }
    }
  }
  return most;
}

TEST_P(CastPresets, CloseTheEyeThatBlinks) {
  const human::Human& human = Preset(GetParam());
  EXPECT_GT(MostMoved(human, "blink_l", 0, -1.0f), 0.006f);
  EXPECT_LT(MostMoved(human, "blink_l", 0, 1.0f), 0.001f);
  EXPECT_GT(MostMoved(human, "blink_r", 0, 1.0f), 0.006f);
  EXPECT_GT(MostMoved(human, "aa", 0, 1.0f), 0.01f);
}

TEST_P(CastPresets, TurnTheirEyesAboutTheMiddleOfTheBall) {
  const human::Human& human = Preset(GetParam());
  const human::SkinnedMesh& eyes = Mesh(human, "HighPolyEyes");
  for (const char* joint : {"l_eyeball_joint", "r_eyeball_joint"}) {
    const size_t index = IndexOfJoint(human.skeleton, joint);
    const glm::vec3 centre = RestPosition(human.skeleton, joint);
    float least = 1.0f;
    float most = 0.0f;
    for (size_t v = 0; v < eyes.positions.size(); ++v) {
      if (eyes.joints[v][0] == index) {
        EXPECT_EQ(eyes.weights[v][0], 1.0f);
        least = std::min(least, glm::distance(eyes.positions[v], centre));
        most = std::max(most, glm::distance(eyes.positions[v], centre));
      }
    }
    EXPECT_GT(least, 0.010f);         // The front of the ball is hollow and contains the iris.
    EXPECT_LT(most - least, 0.006f);  // The cornea protrudes 2 mm from the ball.
  }
}

TEST_P(CastPresets, AreCoarserFromAfar) {
  for (const human::SkinnedMesh& mesh : Preset(GetParam()).meshes) {
    if (mesh.indices.size() > 3000) {
      EXPECT_GE(mesh.coarser.size(), 2u) << mesh.name;
    }
  }
  const human::SkinnedMesh& skin = Preset(GetParam()).meshes[0];
  ASSERT_EQ(skin.coarser.size(), static_cast<size_t>(kLevelsOfDetail));
  EXPECT_LT(skin.coarser[2].indices.size(), 0.15 * skin.indices.size());
  EXPECT_LT(skin.coarser[2].error, 0.01f);
  EXPECT_LT(skin.coarser[3].indices.size(), 0.08 * skin.indices.size());
  EXPECT_LT(skin.coarser[3].error, 0.02f);
}

float OutsideCapsules(const human::Human& human, const glm::vec3& p) {
  float least = 1e9f;
  for (const human::BodyCapsule& capsule : human.capsules) {
    const glm::vec3 origin = RestPosition(human.skeleton, human.skeleton.names[capsule.joint]);
    const glm::vec3 a = origin + capsule.a;
    const glm::vec3 ab = capsule.b - capsule.a;
    const float squared = glm::dot(ab, ab);
    const float t = squared > 0.0f ? glm::clamp(glm::dot(p - a, ab) / squared, 0.0f, 1.0f) : 0.0f;
    least = std::min(
        least, glm::distance(p, a + t * ab) - glm::mix(capsule.radius_a, capsule.radius_b, t));
  }
  return least;
}

// Checks the parts under clothes: trunk, upper arms and thighs.
TEST_P(CastPresets, HaveCapsulesThatFollowTheirSkin) {
  const human::Human& human = Preset(GetParam());
  std::set<size_t> clothed;
  for (const char* joint : {"sacroiliac", "vl1", "vt10", "vt4", "vt1", "l_hip", "r_hip",
                            "l_shoulder", "r_shoulder", "l_knee", "r_knee"}) {
    clothed.insert(IndexOfJoint(human.skeleton, joint));
  }
  std::vector<float> outside;
  const human::SkinnedMesh& skin = human.meshes[0];
  for (size_t v = 0; v < skin.positions.size(); ++v) {
    if (skin.weights[v][0] > 0.6f && clothed.contains(skin.joints[v][0])) {
      outside.push_back(OutsideCapsules(human, skin.positions[v]));
    }
  }
  std::sort(outside.begin(), outside.end());
  EXPECT_LT(outside[outside.size() * 95 / 100], 0.025f);
  EXPECT_GT(outside[outside.size() * 5 / 100], -0.045f);
}

TEST_P(CastPresets, SayWhoMadeTheirParts) {
  const human::Human& human = Preset(GetParam());
  EXPECT_NE(human.credits.find("MakeHuman"), std::string::npos);
  EXPECT_NE(human.credits.find("AGPL"), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(All,
                         CastPresets,
                         testing::ValuesIn(CastPresetNames()),
                         [](const auto& info) { return info.param; });

// Cancels at the first query, and between two steps of draping.
TEST_P(CastPresets, AreNotBuiltWhereThatIsCancelled) {
  class CancelledAfter : public NoProgress {
   public:
    explicit CancelledAfter(int questions) : left_(questions) {}
    bool Cancelled() const override { return left_-- <= 0; }

   private:
    mutable std::atomic<int> left_;
  };
  const CastRecipe recipe = *LoadCastPreset(GetParam());
  for (const int questions : {0, 100}) {
    const auto human = BuildCast(*Library(), recipe, CancelledAfter(questions));
    ASSERT_FALSE(human.ok());
    EXPECT_NE(human.message().find("cancelled"), std::string::npos) << human.message();
  }
}

// Wears only sandals, because other garments take long to cut.
TEST_P(CastPresets, StandOnTheSolesOfTheirSandals) {
  CastRecipe recipe = *LoadCastPreset(GetParam());
  std::erase_if(recipe.garments, [](const Json& g) { return g["name"] != "sandals"; });
  ASSERT_EQ(recipe.garments.size(), 1u);
  const auto human = BuildCast(*Library(), recipe, NoProgress());
  ASSERT_TRUE(human.ok()) << human.status().message();
  float lowest = 1.0f;
  for (const human::SkinnedMesh& mesh : human->meshes) {
    for (const glm::vec3& p : mesh.positions) {
      lowest = std::min(lowest, p.y);
    }
  }
  EXPECT_NEAR(lowest, 0.0f, 1e-5f);
  // The joints moved together with the body.
  for (size_t joint = 0; joint < human->skeleton.size(); ++joint) {
    const glm::vec3 bound(glm::inverse(human->skeleton.joint_from_actor[joint])[3]);
    const glm::vec3 rest = RestPosition(human->skeleton, human->skeleton.names[joint]);
    EXPECT_LT(glm::distance(bound, rest), 1e-5f) << human->skeleton.names[joint];
  }
  EXPECT_GT(RestPosition(human->skeleton, "l_ankle").y,
            RestPosition(Preset(GetParam()).skeleton, "l_ankle").y + 0.004f);
}

TEST_P(CastPresets, WearHairThatSwingsOnlyWhereItHangs) {
  const human::Human& human = Preset(GetParam());
  EXPECT_EQ(human.springs.size(), GetParam() == "girl" ? 1u : 0u);
  for (const human::SpringChain& chain : human.springs) {
    const human::Skeleton& skeleton = human.skeleton;
    EXPECT_EQ(skeleton.names[static_cast<size_t>(skeleton.parents[chain.joints[0]])], "skullbase");
    const float root = RestPosition(skeleton, skeleton.names[chain.joints.front()]).y;
    const float end = RestPosition(skeleton, skeleton.names[chain.joints.back()]).y;
    EXPECT_GT(root - end, 0.15f);
  }
}

TEST(CastLibraryData, TargetsMoveWhatTheirNamesSay) {
  if (Library() == nullptr) {
    GTEST_SKIP() << "needs the cast library: run scripts/fetch_cast_library.sh";
  }
  const std::vector<glm::vec3> base = UnshapedBase(*Library());
  const std::pair<const char*, const char*> kNear[] = {{"l-foot-scale-incr", "foot.L"},
                                                       {"r-hand-scale-incr", "finger3-1.R"},
                                                       {"l-eye-size-big", "eye.L"},
                                                       {"neck-scale-vert-more", "neck02"},
                                                       {"chin-width-max", "special04"}};
  for (const auto& [target, bone] : kNear) {
    const auto found = Library()->FindTarget(target);
    ASSERT_TRUE(found) << target;
    const TargetShare whole[] = {{*found, 1.0f}};
    const std::vector<glm::vec3> deltas = TargetDeltas(*Library(), whole);
    glm::vec3 centre(0.0f);
    float sum = 0.0f;
    for (size_t v = 0; v < base.size(); ++v) {
      centre += glm::length(deltas[v]) * base[v];
      sum += glm::length(deltas[v]);
    }
    const auto& bones = Library()->base().bones;
    const auto where = std::ranges::find(bones, bone, &CastBone::name);
    ASSERT_NE(where, bones.end());
    EXPECT_LT(glm::distance(centre / sum, base[where->head_vertices[0]]), 0.15f) << target;
  }
}

TEST(CastLibraryData, EverySliderHasItsTargets) {
  if (Library() == nullptr) {
    GTEST_SKIP() << "needs the cast library: run scripts/fetch_cast_library.sh";
  }
  EXPECT_GT(Library()->modifiers().size(), 200u);
  for (const CastModifier& modifier : Library()->modifiers()) {
    EXPECT_TRUE(modifier.max_target) << modifier.name;
    EXPECT_EQ(modifier.min_target.has_value(), modifier.name.find('|') != std::string::npos)
        << modifier.name;
  }
}

}  // namespace
}  // namespace lararium::import
