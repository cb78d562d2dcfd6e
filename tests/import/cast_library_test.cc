#include "editor/import/cast/cast_library.h"

#include <gtest/gtest.h>

#include "editor/import/cast/cast_builder.h"
#include "editor/import/cast/cast_rig.h"
#include "editor/import/cast/cast_shape.h"
#include "tests/import/tiny_cast_library.h"
#include "tests/support/test_files.h"

namespace lararium::import {
namespace {

using lararium::test::TemporaryFolder;
using tiny::TinyCastLibrary;

Result<CastMesh> Read(const char* text) {
  const auto json = ParseJson(text, "mesh.json");
  return ReadCastMesh(JsonView(*json, "mesh.json"));
}

bool Mentions(const std::string& message, const std::string& part) {
  return message.find(part) != std::string::npos;
}

TEST(CastMesh, DecodesQuadsAndTrianglesWithAndWithoutNormals) {
  // Type 43 has a quad, material, texture and normal for each corner; type 0 is a triangle.
  const auto mesh = Read(R"({"vertices": [0,0,0, 1,0,0, 1,1,0, 0,1,0],
      "uvs": [[0,0, 1,0, 1,1, 0,1]], "materials": [{"DbgName": "a"}, {"DbgName": "b"}],
      "faces": [43, 0,1,2,3, 1, 0,1,2,3, 9,9,9,9, 0, 2,1,0]})");
  ASSERT_TRUE(mesh.ok()) << mesh.message();
  ASSERT_EQ(mesh->faces.size(), 2u);
  EXPECT_FALSE(mesh->faces[0].is_triangle());
  EXPECT_EQ(mesh->faces[0].material, 1u);
  EXPECT_EQ(mesh->faces[0].uvs[3], 3u);
  EXPECT_TRUE(mesh->faces[1].is_triangle());
  EXPECT_EQ(mesh->faces[1].vertices[0], 2u);
}

TEST(CastMesh, RefusesFacesThatAreCutShortOrNameWhatIsNotThere) {
  const char* const kStart = R"({"vertices": [0,0,0, 1,0,0, 1,1,0], "uvs": [], "faces": )";
  for (const char* faces :
       {"[0, 0, 1]", "[0, 0, 1, 3]", "[2, 0, 1, 2]", "[32, 0, 1, 2, 0]", "[0, 0, 1, -2]",
        "[300, 0, 1, 2]", "[0, 0, 1, 2.5]", "{}", "[0, 0, 1, 4294967297]"}) {
    const auto mesh = Read((std::string(kStart) + faces + "}").c_str());
    ASSERT_FALSE(mesh.ok()) << faces;
    EXPECT_TRUE(Mentions(mesh.message(), "mesh.json")) << mesh.message();
  }
}

TEST(CastMesh, RefusesNumbersThatAreNone) {
  EXPECT_FALSE(Read(R"({"vertices": [0, 0, 1e300], "uvs": [], "faces": []})").ok());
  EXPECT_FALSE(Read(R"({"vertices": [0, 0, "1"], "uvs": [], "faces": []})").ok());
  EXPECT_FALSE(Read(R"({"vertices": [0, 0], "uvs": [], "faces": []})").ok());
  EXPECT_FALSE(Read(R"({"vertices": [0, 0, 0], "uvs": 3, "faces": []})").ok());
  EXPECT_FALSE(Read(R"({"uvs": [], "faces": []})").ok());
}

TEST(CastLibrary, OpensWhatIsWhole) {
  const TemporaryFolder folder;
  TinyCastLibrary tiny(folder.path());
  tiny.Write();
  const auto library = CastLibrary::Open(folder.path());
  ASSERT_TRUE(library.ok()) << library.message();
  EXPECT_EQ(library->base().bones.size(), tiny.vertex_count());
  const auto target = library->FindTarget("nose-hump-morehump");
  ASSERT_TRUE(target);
  EXPECT_EQ(library->Deltas(*target).size(), 3 * tiny.vertex_count());
  EXPECT_EQ(library->Deltas(*target)[0], 0x0101);
  EXPECT_NE(library->FindModifier("nose-hump-lesshump|morehump"), nullptr);
  EXPECT_EQ(library->FindModifier("nose-hump"), nullptr);
}

TEST(CastLibrary, SaysHowToGetWhatIsMissing) {
  const TemporaryFolder folder;
  const auto library = CastLibrary::Open(folder.path());
  ASSERT_FALSE(library.ok());
  EXPECT_TRUE(Mentions(library.message(), "fetch_cast_library.sh")) << library.message();
}

TEST(CastLibrary, RefusesTargetsOfAnotherSize) {
  for (const int surplus : {-2, 6}) {
    const TemporaryFolder folder;
    TinyCastLibrary(folder.path()).Write(surplus);
    const auto library = CastLibrary::Open(folder.path());
    ASSERT_FALSE(library.ok());
    EXPECT_TRUE(Mentions(library.message(), "targets.bin")) << library.message();
  }
}

TEST(CastLibrary, RefusesBonesInACircle) {
  const TemporaryFolder folder;
  TinyCastLibrary tiny(folder.path());
  tiny.rig()["bones"]["spine05"]["parent"] = "head";
  tiny.Write();
  const auto library = CastLibrary::Open(folder.path());
  ASSERT_FALSE(library.ok());
  EXPECT_TRUE(Mentions(library.message(), "bone")) << library.message();
}

TEST(CastLibrary, RefusesWeightsOfBonesThatAreNotThere) {
  const TemporaryFolder folder;
  TinyCastLibrary tiny(folder.path());
  tiny.base()["skinIndices"][0] = 100000;
  tiny.Write();
  EXPECT_FALSE(CastLibrary::Open(folder.path()).ok());
}

TEST(CastLibrary, RefusesPartsOutsideItsFolder) {
  const TemporaryFolder folder;
  TinyCastLibrary(folder.path()).Write();
  const auto library = CastLibrary::Open(folder.path());
  ASSERT_TRUE(library.ok());
  EXPECT_FALSE(library->LoadPart(CastPart::kHair, "../../models").ok());
  EXPECT_FALSE(library->LoadPart(CastPart::kHair, "none").ok());
  EXPECT_FALSE(library->LoadSkin("..").ok());
}

TEST(CastRig, EveryJointOfATinyLibraryHasItsPlace) {
  const TemporaryFolder folder;
  TinyCastLibrary(folder.path()).Write();
  const auto library = CastLibrary::Open(folder.path());
  ASSERT_TRUE(library.ok());
  const auto positions = UnshapedBase(*library);
  const auto skeleton = CastSkeleton(*library, positions);
  ASSERT_TRUE(skeleton.ok()) << skeleton.message();
  EXPECT_TRUE(skeleton->Validate("tiny").ok());
  for (const char* joint : {"humanoid_root", "vl5", "vt4", "skullbase", "l_shoulder", "r_hip",
                            "l_pinky3", "temporomandibular", "r_eyeball_joint"}) {
    EXPECT_TRUE(skeleton->Find(joint)) << joint;
  }
}

TEST(CastRig, NamesTheBoneThatARigLacks) {
  const TemporaryFolder folder;
  TinyCastLibrary tiny(folder.path());
  tiny.rig()["bones"].erase("jaw");
  tiny.rig()["bones"]["chin"] = {{"head", "jaw____head"}, {"parent", "head"}};
  tiny.rig()["bones"]["tongue00"]["parent"] = "chin";
  for (Json& end : tiny.base()["bones"]) {
    if (end["name"] == "jaw____head") {
      end["name"] = "chin____head";
    }
  }
  tiny.Write();
  const auto library = CastLibrary::Open(folder.path());
  ASSERT_TRUE(library.ok()) << library.message();
  const auto skeleton = CastSkeleton(*library, UnshapedBase(*library));
  ASSERT_FALSE(skeleton.ok());
  EXPECT_TRUE(Mentions(skeleton.message(), "'jaw'")) << skeleton.message();
}

TEST(CastRig, KeepsTheStrongestInfluences) {
  const std::vector<std::pair<uint8_t, float>> all = {{1, 0.1f}, {2, 0.3f},  {1, 0.3f},
                                                      {3, 0.2f}, {4, 0.05f}, {5, 0.01f}};
  const Influences kept = Strongest(all);
  EXPECT_EQ(kept.joints[0], 1);
  EXPECT_FLOAT_EQ(kept.weights[0], 0.4f / 0.95f);
  EXPECT_FLOAT_EQ(kept.weights.x + kept.weights.y + kept.weights.z + kept.weights.w, 1.0f);
  EXPECT_EQ(std::count(kept.joints.begin(), kept.joints.end(), 5), 0);
}

// The share of the target with this name; 0 if there is none.
float ShareOf(const CastLibrary& library, const CastRecipe& recipe, const char* name) {
  const auto shares = TargetShares(library, recipe);
  EXPECT_TRUE(shares.ok());
  float sum = 0.0f;
  for (const TargetShare& share : *shares) {
    sum += share.target == *library.FindTarget(name) ? share.share : 0.0f;
  }
  return sum;
}

TEST(CastShape, SharesAreProductsOfWhatAPersonIs) {
  const TemporaryFolder folder;
  TinyCastLibrary(folder.path()).Write();
  const auto library = CastLibrary::Open(folder.path());
  ASSERT_TRUE(library.ok());
  CastRecipe recipe;
  recipe.sex = 0.75f;
  recipe.age = 25.0f;
  recipe.muscle = 0.9f;
  recipe.weight = 0.2f;
  recipe.ethnicity = {3.0f, 1.0f, 0.0f};
  EXPECT_FLOAT_EQ(ShareOf(*library, recipe, "macrodetails/caucasian-male-young"), 0.75f * 0.75f);
  EXPECT_FLOAT_EQ(ShareOf(*library, recipe, "macrodetails/african-male-young"), 0.75f * 0.25f);
  EXPECT_FLOAT_EQ(
      ShareOf(*library, recipe, "macrodetails/universal-male-young-maxmuscle-minweight"),
      0.75f * 0.8f * 0.6f);
  EXPECT_EQ(ShareOf(*library, recipe, "macrodetails/caucasian-female-child"), 0.0f);
  recipe.age = 17.5f;
  EXPECT_FLOAT_EQ(ShareOf(*library, recipe, "macrodetails/caucasian-female-child"),
                  0.5f * 0.25f * 0.75f);
}

TEST(CastShape, SlidersGoBothWaysAndToBothSides) {
  const TemporaryFolder folder;
  TinyCastLibrary(folder.path()).Write();
  const auto library = CastLibrary::Open(folder.path());
  ASSERT_TRUE(library.ok());
  CastRecipe recipe;
  recipe.modifiers = {{"nose-hump-lesshump|morehump", -0.4f}, {"eye-size-small|big", 0.5f}};
  EXPECT_FLOAT_EQ(ShareOf(*library, recipe, "nose/nose-hump-lesshump"), 0.4f);
  EXPECT_EQ(ShareOf(*library, recipe, "nose/nose-hump-morehump"), 0.0f);
  EXPECT_FLOAT_EQ(ShareOf(*library, recipe, "eyes/l-eye-size-big"), 0.5f);
  EXPECT_FLOAT_EQ(ShareOf(*library, recipe, "eyes/r-eye-size-big"), 0.5f);
  recipe.modifiers = {{"nose-length", 1.0f}};
  const auto shares = TargetShares(*library, recipe);
  ASSERT_FALSE(shares.ok());
  EXPECT_TRUE(Mentions(shares.status().message(), "'nose-length'")) << shares.status().message();
}

TEST(CastShape, DeltasAreTenthsOfMillimetresTurnedToFaceTheStage) {
  const TemporaryFolder folder;
  TinyCastLibrary(folder.path()).Write();
  const auto library = CastLibrary::Open(folder.path());
  ASSERT_TRUE(library.ok());
  const TargetShare half[] = {{0, 0.5f}};
  const auto deltas = TargetDeltas(*library, half);
  const float expected = 0.5f * 0x0101 * 1e-4f;
  EXPECT_FLOAT_EQ(deltas[3].x, -expected);
  EXPECT_FLOAT_EQ(deltas[3].y, expected);
  EXPECT_FLOAT_EQ(deltas[3].z, -expected);
}

}  // namespace
}  // namespace lararium::import
