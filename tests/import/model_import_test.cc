#include "editor/import/model/model_import.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <thread>

#include "editor/import/model/model_gltf.h"
#include "editor/import/model/model_isolation.h"
#include "editor/import/model/model_textures.h"
#include "shared/core/file.h"
#include "shared/core/random.h"
#include "tests/import/glb_figure.h"
#include "tests/import/plain_figure.h"
#include "tests/support/png.h"
#include "tests/support/test_files.h"

namespace lararium::import {
namespace {

using ::testing::HasSubstr;

constexpr char kSquare[] = R"(
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
f 1 2 3 4
)";

std::vector<std::byte> Png(int width, int height, int channels, int alpha = 255) {
  return test::Png(cv::Mat(height, width, CV_8UC(channels), cv::Scalar(40, 90, 200, alpha)));
}

class ModelImport : public ::testing::Test {
 protected:
  std::filesystem::path Write(const std::string& name, std::string_view content) {
    EXPECT_TRUE(WriteFileAtomically(folder_ / name, content).ok());
    return folder_ / name;
  }
  std::filesystem::path Write(const std::string& name, const test::GlbFigure& figure) {
    EXPECT_TRUE(WriteFileAtomically(folder_ / name, figure.Glb()).ok());
    return folder_ / name;
  }
  test::TemporaryFolder folder_;
};

glm::vec3 At(const human::Human& human, const std::string& joint) {
  return RestPosition(human.skeleton, joint);
}

TEST_F(ModelImport, SplitsPolygonsIntoTriangles) {
  std::vector<std::string> notes;
  const auto mesh = ImportMesh(Write("square.obj", kSquare), notes);
  ASSERT_TRUE(mesh.ok()) << mesh.message();
  EXPECT_EQ(mesh->indices.size(), 6u);
  EXPECT_NEAR(mesh->normals[0].z, 1.0f, 1e-6f);
}

TEST_F(ModelImport, RefusesFilesThatAreNoModels) {
  std::vector<std::string> notes;
  for (const char* name : {"a.glb", "a.gltf", "a.fbx", "a.obj", "a.dae", "a.bvh", "a.xyz"}) {
    for (const std::string_view content :
         {std::string_view(""), std::string_view("garbage"), std::string_view("{}"),
          std::string_view("glTF\x02\0\0\0\xff\xff\xff\xff", 12),
          std::string_view("Kaydara FBX Binary  \0\x1a\0\xff\xff\xff\xff", 27)}) {
      const auto file = Write(name, content);
      const auto mesh = ImportMesh(file, notes);
      ASSERT_FALSE(mesh.ok()) << name;
      EXPECT_THAT(mesh.message(), HasSubstr(name));
      EXPECT_FALSE(ImportHuman(file).ok());
      EXPECT_FALSE(ImportMotion(file).ok());
    }
  }
  EXPECT_FALSE(ImportMesh(folder_ / "absent.glb", notes).ok());
}

TEST_F(ModelImport, AsksForAnArmatureWhereThereIsNone) {
  const auto human = ImportHuman(Write("square.obj", kSquare));
  ASSERT_FALSE(human.ok());
  EXPECT_THAT(human.message(), HasSubstr("skeleton"));
}

// Scenery may have any number of parts; where the joints of a skin were moved, it is seen so.
TEST_F(ModelImport, TakesSceneryInOnePartAsItsFileShowsIt) {
  test::GlbFigure model = test::MakeGlbFigure(PlainSkeleton());
  Json& nodes = model.json["nodes"];
  const size_t moved = model.json["skins"][0]["joints"][0].get<size_t>();
  const auto translation = nodes[moved]["translation"].get<std::vector<float>>();
  const auto height = [&] {
    const auto thing = ImportThing(Write("statue.glb", model), false);
    EXPECT_TRUE(thing.ok()) << thing.message();
    EXPECT_EQ(thing->human.skeleton.size(), 1u);
    EXPECT_TRUE(thing->human.clips.empty());
    EXPECT_EQ(thing->human.credits, "by an unknown sculptor");
    float top = 0.0f;
    for (const human::SkinnedMesh& mesh : thing->human.meshes) {
      for (const glm::vec3& position : mesh.positions) {
        top = std::max(top, position.y);
      }
    }
    return top;
  };
  model.json["asset"]["copyright"] = "by an unknown sculptor";
  const float before = height();
  nodes[moved]["translation"] = {translation[0], translation[1] + 0.7f, translation[2]};
  EXPECT_NEAR(height(), before + 0.7f, 1e-4f);
  for (int i = 0; i < 300; ++i) {
    model.json["scenes"][0]["nodes"].push_back(nodes.size());
    nodes.push_back({{"mesh", 0}, {"translation", {0, 20 + i, 0}}});
  }
  EXPECT_GT(height(), before + 300.0f);
}

TEST_F(ModelImport, TakesAMeshWithBonesInThePoseOfTheirNodes) {
  test::GlbFigure model = test::MakeGlbFigure(PlainSkeleton());
  Json& nodes = model.json["nodes"];
  const size_t moved = model.json["skins"][0]["joints"][0].get<size_t>();
  const auto positions = [&] {
    std::vector<std::string> notes;
    const auto mesh = ImportMesh(Write("statue.glb", model), notes);
    EXPECT_TRUE(mesh.ok()) << mesh.message();
    return mesh.ok() ? mesh->positions : std::vector<glm::vec3>();
  };
  const std::vector<glm::vec3> before = positions();
  const auto translation = nodes[moved]["translation"].get<std::vector<float>>();
  nodes[moved]["translation"] = {translation[0], translation[1] + 0.7f, translation[2]};
  nodes.back()["translation"] = {0, 50, 0};  // The node of a mesh with a skin does not move it.
  const std::vector<glm::vec3> after = positions();
  ASSERT_FALSE(before.empty());
  ASSERT_EQ(after.size(), before.size());
  for (size_t i = 0; i < after.size(); ++i) {
    EXPECT_NEAR(glm::distance(after[i], before[i] + glm::vec3(0.0f, 0.7f, 0.0f)), 0.0f, 1e-5f);
  }
}

TEST_F(ModelImport, MakesPartsOfTheNodesOfAnObject) {
  test::GlbFigure model;
  model.json = {{"asset", {{"version", "2.0"}}},
                {"accessors", Json::array()},
                {"bufferViews", Json::array()},
                {"nodes",
                 {{{"name", "jar"}, {"mesh", 0}, {"children", {1}}},
                  {{"name", "lid"}, {"mesh", 0}, {"translation", {0, 2, 0}}}}}};
  const size_t positions = model.AddFloats({0, 0, 0, 1, 0, 0, 0, 1, 0}, 3);
  model.json["meshes"] = {{{"primitives", {{{"attributes", {{"POSITION", positions}}}}}}}};
  const auto thing = ImportThing(Write("jar.glb", model), true);
  ASSERT_TRUE(thing.ok()) << thing.message();
  const human::Human& jar = thing->human;
  const auto lid = jar.skeleton.Find("lid");
  ASSERT_TRUE(jar.skeleton.Find("jar") && lid);
  ASSERT_EQ(jar.meshes.size(), 2u);
  EXPECT_EQ(jar.meshes[1].joints[0][0], *lid);
  EXPECT_NEAR(jar.skeleton.joint_from_actor[*lid][3].y, -2.0f, 1e-5f);
}

TEST_F(ModelImport, CountsVerticesWhoseColoursAndTextureCoordinatesAreInvalid) {
  test::GlbFigure model = test::MakeGlbFigure(PlainSkeleton());
  Json& attributes = model.json["meshes"][0]["primitives"][0]["attributes"];
  const size_t count =
      model.json["accessors"][attributes["POSITION"].get<size_t>()]["count"].get<size_t>();
  std::vector<float> uvs(2 * count, 0.5f), colours(3 * count, 1.0f);
  uvs[3] = std::numeric_limits<float>::quiet_NaN();
  colours[0] = 7.0f;
  colours[5] = std::numeric_limits<float>::infinity();
  std::vector<float> joints(4 * count, 0.0f), weights(4 * count, 0.0f);
  for (size_t k = 0; k < 4; ++k) {
    joints[k] = static_cast<float>(k + 1);
    weights[k] = 0.2f;
  }
  attributes["JOINTS_1"] = model.AddFloats(joints, 4);
  attributes["WEIGHTS_1"] = model.AddFloats(weights, 4);
  attributes["TEXCOORD_0"] = model.AddFloats(uvs, 2);
  attributes["COLOR_0"] = model.AddFloats(colours, 3);
  const auto imported = ImportPerson(Write("figure.glb", model));
  ASSERT_TRUE(imported.ok()) << imported.message();
  EXPECT_THAT(imported->notes,
              ::testing::Contains(AllOf(HasSubstr("a colour outside"), HasSubstr(": 2"))));
  EXPECT_THAT(imported->notes,
              ::testing::Contains(AllOf(HasSubstr("texture coordinates"), HasSubstr(": 1"))));
  EXPECT_THAT(imported->notes,
              ::testing::Contains(AllOf(HasSubstr("more than four bones"), HasSubstr(": 1"))));
  EXPECT_EQ(imported->human.meshes[0].albedo[1], glm::vec3(1.0f));
}

TEST_F(ModelImport, SaysThatPeopleDoNotShine) {
  test::GlbFigure model = test::MakeGlbFigure(PlainSkeleton());
  model.json["materials"] = {{{"emissiveFactor", {0, 0.5, 0}}}};
  model.json["meshes"][0]["primitives"][0]["material"] = 0;
  const auto imported = ImportPerson(Write("ghost.glb", model));
  ASSERT_TRUE(imported.ok()) << imported.message();
  EXPECT_THAT(imported->notes, ::testing::Contains(HasSubstr("emission")));
}

TEST_F(ModelImport, RefusesImpossibleOptions) {
  ImportOptions options;
  options.metres_per_unit = 0.0f;
  EXPECT_FALSE(ImportHuman(Write("square.obj", kSquare), options).ok());
}

// For any axes, unit and position of the file, the figure stands in the frame of the actor.
TEST_F(ModelImport, StandsInTheActorFrame) {
  const human::Skeleton skeleton = PlainSkeleton();
  const auto turned = [](float angle, const glm::vec3& axis, float scale) {
    return glm::scale(glm::rotate(glm::mat4(1.0f), angle, axis), glm::vec3(scale));
  };
  const float quarter = 1.5707963f;
  for (const glm::mat4& file_from_actor :
       {glm::mat4(1.0f), turned(2.0f * quarter, {0, 1, 0}, 1.0f),
        turned(quarter, {1, 0, 0}, 100.0f), turned(quarter, {0, 1, 0}, 1000.0f),
        turned(-quarter, {0, 0, 1}, 39.37f),
        glm::translate(glm::mat4(1.0f), glm::vec3(7.0f, 3.0f, -2.0f))}) {
    test::GlbFigureOptions options;
    options.file_from_actor = file_from_actor;
    const auto imported = ImportPerson(Write("figure.glb", test::MakeGlbFigure(skeleton, options)));
    ASSERT_TRUE(imported.ok()) << imported.message();
    ASSERT_TRUE(imported->is_human);
    const human::Human& human = imported->human;
    const float size = RestPosition(skeleton, "skullbase").y - RestPosition(skeleton, "r_ankle").y;
    EXPECT_NEAR(At(human, "skullbase").y - At(human, "r_ankle").y, size, 0.01f * size);
    EXPECT_GT(At(human, "r_wrist").x, 0.3f);
    EXPECT_LT(At(human, "r_midtarsal").z, At(human, "r_ankle").z - 0.1f);
    EXPECT_NEAR(At(human, "r_midtarsal").y, 0.025f, 0.03f);
    EXPECT_LT(std::hypot(At(human, "humanoid_root").x, At(human, "humanoid_root").z), 0.25f);
    for (const human::JointTransform& rest : human.skeleton.rest) {
      EXPECT_NEAR(std::abs(rest.rotation.w), 1.0f, 1e-6f);
      EXPECT_EQ(rest.scale, glm::vec3(1.0f));
    }
  }
}

TEST_F(ModelImport, FindsABodyWithoutNames) {
  test::GlbFigureOptions options;
  options.name = [n = 0](const std::string&) mutable { return "Object_" + std::to_string(n++); };
  const auto imported =
      ImportPerson(Write("figure.glb", test::MakeGlbFigure(PlainSkeleton(), options)));
  ASSERT_TRUE(imported.ok()) << imported.message();
  ASSERT_TRUE(imported->is_human) << imported->bone_table;
  EXPECT_LT(At(imported->human, "l_wrist").x, -0.3f);
  EXPECT_THAT(imported->bone_table, HasSubstr("structure"));
}

TEST_F(ModelImport, TellsBonesOfOneNameApart) {
  test::GlbFigureOptions options;
  options.name = [](const std::string&) { return "bone"; };
  const auto imported =
      ImportPerson(Write("figure.glb", test::MakeGlbFigure(PlainSkeleton(), options)));
  ASSERT_TRUE(imported.ok()) << imported.message();
  EXPECT_EQ(imported->human.skeleton.size(), PlainSkeleton().size());
  EXPECT_TRUE(imported->is_human);
}

TEST_F(ModelImport, KeepsTheFourLargestWeights) {
  test::GlbFigure figure = test::MakeGlbFigure(PlainSkeleton());
  Json& attributes = figure.json["meshes"][0]["primitives"][0]["attributes"];
  const size_t count = figure.json["accessors"][0]["count"];
  std::vector<float> more;
  for (size_t v = 0; v < count; ++v) {
    more.insert(more.end(), {0.4f, 0.3f, 0.2f, 0.1f});
  }
  attributes["WEIGHTS_1"] = figure.AddFloats(more, 4);
  std::vector<std::byte> joints;
  for (size_t v = 0; v < count; ++v) {
    for (const int joint : {1, 2, 3, 4}) {
      joints.push_back(static_cast<std::byte>(joint));
    }
  }
  figure.json["accessors"].push_back({{"bufferView", figure.AddBytes(joints)},
                                      {"componentType", 5121},
                                      {"count", count},
                                      {"type", "VEC4"}});
  attributes["JOINTS_1"] = figure.json["accessors"].size() - 1;
  const auto human = ImportHuman(Write("figure.glb", figure));
  ASSERT_TRUE(human.ok()) << human.message();  // Human::Validate checks that the sums are 1.
  const glm::vec4& weights = human->meshes[0].weights.back();
  EXPECT_NEAR(weights.x, 1.0f / 1.9f, 1e-4f);
  EXPECT_NEAR(weights.w, 0.2f / 1.9f, 1e-4f);
}

// ---- Surfaces ----

void AddTexture(test::GlbFigure& figure, const std::vector<std::byte>& image) {
  Json& json = figure.json;
  json["images"].push_back({{"bufferView", figure.AddBytes(image)}, {"mimeType", "image/png"}});
  json["textures"].push_back({{"source", json["images"].size() - 1}});
  json["materials"].push_back(
      {{"name", "Skin"},
       {"alphaMode", "MASK"},
       {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", json["textures"].size() - 1}}}}}});
  json["meshes"][0]["primitives"][0]["material"] = json["materials"].size() - 1;
}

TEST_F(ModelImport, ReadsTexturesAndMakesThemSmall) {
  test::GlbFigure figure = test::MakeGlbFigure(PlainSkeleton());
  AddTexture(figure, Png(4096, 1024, 4, 100));
  const auto human = ImportHuman(Write("figure.glb", figure));
  ASSERT_TRUE(human.ok()) << human.message();
  ASSERT_EQ(human->textures.size(), 1u);
  ASSERT_EQ(human->materials.size(), 1u);
  EXPECT_EQ(human->materials[0].colour_texture, 0);
  EXPECT_EQ(human->materials[0].surface, human::Surface::kSkin);
  EXPECT_NEAR(human->materials[0].alpha_cutoff, 0.5f, 1e-6f);
  const std::vector<std::byte>& bytes = human->textures[0]->encoded;
  const cv::Mat decoded = cv::imdecode(
      cv::Mat(1, static_cast<int>(bytes.size()), CV_8U, const_cast<std::byte*>(bytes.data())),
      cv::IMREAD_UNCHANGED);
  EXPECT_EQ(decoded.size(), cv::Size(2048, 512));
  EXPECT_EQ(decoded.channels(), 4);
}

TEST_F(ModelImport, LeavesOutATextureThatIsABomb) {
  std::vector<std::byte> bomb = Png(8, 8, 3);
  for (const size_t at : {size_t{18}, size_t{22}}) {  // Width and height: 8 becomes 60 008.
    bomb[at] = std::byte{0xea};
    bomb[at + 1] = std::byte{0x68};
  }
  test::GlbFigure figure = test::MakeGlbFigure(PlainSkeleton());
  AddTexture(figure, bomb);
  const auto imported = ImportPerson(Write("figure.glb", figure));
  ASSERT_TRUE(imported.ok()) << imported.message();
  EXPECT_TRUE(imported->human.textures.empty());
  EXPECT_EQ(imported->human.materials[0].colour_texture, human::Material::kNone);
  ASSERT_FALSE(imported->notes.empty());
  EXPECT_THAT(imported->notes.back(), HasSubstr("pixels"));
}

TEST_F(ModelImport, FindsTexturesBesideTheModelAndNowhereElse) {
  const std::filesystem::path model = folder_ / "person.fbx";
  std::filesystem::create_directories(folder_ / "textures");
  Write("skin.png", "x");
  Write("textures/eye.png", "x");
  EXPECT_EQ(FindReferenced(model, "skin.png"), folder_ / "skin.png");
  EXPECT_EQ(FindReferenced(model, "C:\\Users\\somebody\\skin.png"), folder_ / "skin.png");
  EXPECT_EQ(FindReferenced(model, "/home/somebody/eye.png"), folder_ / "textures" / "eye.png");
  EXPECT_EQ(FindReferenced(model, "textures%2Feye.png"), folder_ / "textures" / "eye.png");
  for (const char* path :
       {"/etc/passwd", "../../etc/passwd", "..", "%2e%2e/%2e%2e/etc/passwd", ""}) {
    EXPECT_EQ(FindReferenced(model, path), "") << path;
  }
}

// ---- VRM ----

test::GlbFigure FigureWithTargets(const std::vector<std::string>& names) {
  test::GlbFigure figure = test::MakeGlbFigure(PlainSkeleton());
  Json& primitive = figure.json["meshes"][0]["primitives"][0];
  const size_t count = figure.json["accessors"][0]["count"];
  for (size_t t = 0; t < names.size(); ++t) {
    std::vector<float> deltas(3 * count, 0.0f);
    deltas[3 * t + 1] = 0.01f;  // Vertex t rises.
    primitive["targets"].push_back({{"POSITION", figure.AddFloats(deltas, 3)}});
  }
  figure.json["meshes"][0]["extras"]["targetNames"] = names;
  return figure;
}

const human::FaceShape* Shape(const human::Human& human, const std::string& name) {
  for (const human::FaceShape& shape : human.face) {
    if (shape.name == name) {
      return &shape;
    }
  }
  return nullptr;
}

TEST_F(ModelImport, ReadsMorphTargetsSparsely) {
  const auto human =
      ImportHuman(Write("figure.glb", FigureWithTargets({"jawOpen", "mouthPucker"})));
  ASSERT_TRUE(human.ok()) << human.message();
  ASSERT_EQ(human->morphs.size(), 2u);
  EXPECT_EQ(human->morphs[1].name, "mouthPucker");
  ASSERT_EQ(human->morphs[1].parts.size(), 1u);
  EXPECT_EQ(human->morphs[1].parts[0].vertices, std::vector<uint32_t>({1}));
  EXPECT_NEAR(human->morphs[1].parts[0].position_deltas[0].y, 0.01f, 1e-5f);
  ASSERT_NE(Shape(*human, "aa"), nullptr);
  EXPECT_EQ(Shape(*human, "aa")->morphs[0].morph, 0u);
}

TEST_F(ModelImport, ReadsVrmOfBothVersions) {
  const human::Skeleton skeleton = PlainSkeleton();
  const auto node = [&](const char* joint) { return IndexOfJoint(skeleton, joint); };
  const size_t bearer = skeleton.size();  // The node that has the mesh.
  const size_t chain[] = {node("l_elbow"), node("l_wrist"), node("l_middle1")};
  for (const bool old : {true, false}) {
    test::GlbFigure figure = FigureWithTargets({"first", "second"});
    Json& json = figure.json;
    for (Json& n : json["nodes"]) {
      n["name"] = "x";  // Only the VRM data identify the bones.
    }
    if (old) {
      Json bones = Json::array();
      for (const auto& [bone, joint] :
           {std::pair{"leftHand", "l_wrist"}, std::pair{"head", "skullbase"}}) {
        bones.push_back({{"bone", bone}, {"node", node(joint)}});
      }
      json["extensions"]["VRM"] = {
          {"meta", {{"title", "T"}, {"author", "A"}, {"licenseName", "CC0"}}},
          {"humanoid", {{"humanBones", bones}}},
          {"blendShapeMaster",
           {{"blendShapeGroups",
             Json::array({{{"name", "Joy"},
                           {"presetName", "joy"},
                           {"binds", Json::array({{{"mesh", 0}, {"index", 1}, {"weight", 50}}})}},
                          {{"presetName", "blink_l"},
                           {"binds", Json::array({{{"mesh", 0}, {"index", 99}}})}}})}}},
          {"secondaryAnimation",
           {{"boneGroups", Json::array({{{"stiffiness", 1.0}, {"bones", {chain[0]}}}})},
            {"colliderGroups",
             Json::array({{{"node", node("skullbase")},
                           {"colliders", Json::array({{{"offset", {{"x", 0}, {"y", 0.1}, {"z", 0}}},
                                                       {"radius", 0.12}}})}}})}}}};
    } else {
      json["extensions"]["VRMC_vrm"] = {
          {"meta", {{"name", "T"}, {"authors", {"A"}}, {"licenseUrl", "CC0"}}},
          {"humanoid",
           {{"humanBones",
             {{"leftHand", {{"node", node("l_wrist")}}},
              {"head", {{"node", node("skullbase")}}}}}}},
          {"expressions",
           {{"preset",
             {{"happy",
               {{"morphTargetBinds",
                 Json::array({{{"node", bearer}, {"index", 1}, {"weight", 0.5}}})}}}}}}}};
      Json joints = Json::array();
      for (const size_t joint : chain) {
        joints.push_back({{"node", joint}, {"stiffness", 1.0}});
      }
      json["extensions"]["VRMC_springBone"] = {
          {"springs", Json::array({{{"name", "sleeve"}, {"joints", joints}}})},
          {"colliders",
           Json::array({{{"node", node("skullbase")},
                         {"shape", {{"sphere", {{"offset", {0, 0.1, 0}}, {"radius", 0.12}}}}}}})}};
    }
    const auto imported = ImportPerson(Write("figure.vrm", figure));
    ASSERT_TRUE(imported.ok()) << imported.message();
    const human::Human& human = imported->human;
    EXPECT_EQ(human.credits, "T, A, CC0");
    EXPECT_THAT(imported->bone_table, HasSubstr("file"));
    EXPECT_LT(At(human, "l_wrist").x, -0.3f);
    ASSERT_NE(Shape(human, "joy"), nullptr);
    EXPECT_EQ(Shape(human, "joy")->morphs[0].morph, 1u);
    EXPECT_NEAR(Shape(human, "joy")->morphs[0].weight, 0.5f, 1e-5f);
    ASSERT_FALSE(human.springs.empty());
    EXPECT_GE(human.springs[0].joints.size(), 3u);
    EXPECT_EQ(human.springs[0].joints[0], human.skeleton.Find("l_elbow").value());
    EXPECT_GT(human.springs[0].stiffness, 100.0f);
    ASSERT_EQ(human.capsules.size(), 1u);
    EXPECT_NEAR(human.capsules[0].a.y, 0.1f, 1e-5f);
    EXPECT_NEAR(human.capsules[0].radius_a, 0.12f, 1e-5f);
  }
}

// ---- Hostile files ----

struct Hostile {
  const char* name;
  std::function<void(test::GlbFigure&)> spoil;
};

const std::vector<Hostile>& HostileFigures() {
  static const std::vector<Hostile> kHostile = {
      {"cyclic skeleton", [](auto& f) { f.json["nodes"][5]["children"].push_back(0); }},
      {"node below itself", [](auto& f) { f.json["nodes"][3]["children"] = {3}; }},
      {"child out of range", [](auto& f) { f.json["nodes"][0]["children"].push_back(1 << 30); }},
      {"negative child", [](auto& f) { f.json["nodes"][0]["children"].push_back(-1); }},
      {"huge accessor", [](auto& f) { f.json["accessors"][0]["count"] = 4'000'000'000u; }},
      {"accessor beyond its view", [](auto& f) { f.json["accessors"][0]["count"] = 5000; }},
      {"view beyond its buffer", [](auto& f) { f.json["bufferViews"][0]["byteLength"] = 1 << 29; }},
      {"buffer beyond the file", [](auto& f) { f.json["buffers"][0]["byteLength"] = 1 << 29; }},
      {"offset that wraps",
       [](auto& f) { f.json["bufferViews"][0]["byteOffset"] = 18'446'744'073'709'551'615u; }},
      {"missing buffer",
       [](auto& f) {
         f.json["buffers"].push_back(f.json["buffers"][0]);
         f.json["buffers"][1]["uri"] = "absent.bin";
         f.json["bufferViews"][0]["buffer"] = 1;
       }},
      {"buffer elsewhere", [](auto& f) { f.json["buffers"][0]["uri"] = "../../../etc/passwd"; }},
      {"buffer of the system", [](auto& f) { f.json["buffers"][0]["uri"] = "/etc/passwd"; }},
      {"data that is too short", [](auto& f) { f.json["buffers"][0]["uri"] = "data:,AAAA"; }},
      {"skin joint out of range", [](auto& f) { f.json["skins"][0]["joints"][0] = 999; }},
      {"too few bind matrices",
       [](auto& f) {
         f.json["accessors"][f.json["skins"][0]["inverseBindMatrices"].template get<size_t>()]
               ["count"] = 1;
       }},
      {"attributes of other lengths", [](auto& f) { f.json["accessors"][1]["count"] = 3; }},
      {"mesh out of range", [](auto& f) { f.json["nodes"].back()["mesh"] = 7; }},
      {"text for a number", [](auto& f) { f.json["accessors"][0]["count"] = "many"; }},
      {"list for an object", [](auto& f) { f.json["nodes"][0] = Json::array(); }},
      {"unknown compression",
       [](auto& f) { f.json["extensionsRequired"] = {"KHR_texture_basisu"}; }},
      {"version 1", [](auto& f) { f.json["asset"]["version"] = "1.0"; }},
      {"no asset", [](auto& f) { f.json.erase("asset"); }},
      {"NaN positions",
       [](auto& f) {
         const float nan = std::numeric_limits<float>::quiet_NaN();
         std::memcpy(f.binary.data() + 4, &nan, 4);
       }},
      {"infinite bind matrix",
       [](auto& f) {
         Json& skin = f.json["skins"][0];
         std::vector<float> wild(16 * skin["joints"].size(), 1e38f);
         skin["inverseBindMatrices"] = f.AddFloats(wild, 16);
         f.json["nodes"][0]["translation"] = {1e38, 1e38, 1e38};
       }},
      {"NaN weights",
       [](auto& f) {
         const size_t count = f.json["accessors"][0]["count"];
         std::vector<float> nan(4 * count, std::numeric_limits<float>::quiet_NaN());
         f.json["meshes"][0]["primitives"][0]["attributes"]["WEIGHTS_0"] = f.AddFloats(nan, 4);
       }},
      {"ten thousand bones",
       [](auto& f) {
         Json& nodes = f.json["nodes"];
         const size_t first = nodes.size();
         for (size_t i = 0; i < 10'000; ++i) {
           nodes.push_back({{"name", "extra"}});
           nodes[0]["children"].push_back(first + i);
           f.json["skins"][0]["joints"].push_back(first + i);
         }
         f.json["skins"][0].erase("inverseBindMatrices");
       }},
      {"deep nodes",
       [](auto& f) {
         Json& nodes = f.json["nodes"];
         size_t above = 0;
         for (size_t i = 0; i < 15'000; ++i) {
           nodes.push_back({{"name", "deep"}});
           nodes[above]["children"].push_back(nodes.size() - 1);
           above = nodes.size() - 1;
         }
       }},
      {"a figure of no size",
       [](auto& f) {
         std::vector<float> zeros(3 * f.json["accessors"][0]["count"].template get<size_t>());
         f.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = f.AddFloats(zeros, 3);
       }},
  };
  return kHostile;
}

TEST_F(ModelImport, AnswersHostileFiguresWithOneError) {
  for (const Hostile& hostile : HostileFigures()) {
    test::GlbFigure figure = test::MakeGlbFigure(PlainSkeleton());
    hostile.spoil(figure);
    const auto file = Write("hostile.glb", figure);
    for (const bool in_child_process : {true, false}) {
      ImportOptions options;
      options.in_child_process = in_child_process;
      const auto human = ImportPerson(file, options);
      const std::string claim =
          std::string(hostile.name) + (in_child_process ? " in a child" : " in this process");
      ASSERT_FALSE(human.ok()) << claim;
      EXPECT_THAT(human.message(), HasSubstr("hostile.glb: ")) << claim;
      EXPECT_THAT(human.message(), Not(HasSubstr("crashed"))) << claim;
      EXPECT_EQ(human.message().find('\n'), std::string::npos) << claim;
    }
  }
}

TEST_F(ModelImport, AnswersTruncatedFiguresWithOneError) {
  const std::vector<std::byte> whole = test::MakeGlbFigure(PlainSkeleton()).Glb();
  for (size_t part = 0; part < 20; ++part) {
    const std::span<const std::byte> cut(whole.data(), whole.size() * part / 20);
    ASSERT_TRUE(WriteFileAtomically(folder_ / "cut.glb", cut).ok());
    const auto human = ImportPerson(folder_ / "cut.glb");
    ASSERT_FALSE(human.ok());
    EXPECT_THAT(human.message(), HasSubstr("cut.glb"));
  }
}

TEST_F(ModelImport, StandsAnyDamage) {
  const std::vector<std::byte> whole = FigureWithTargets({"jawOpen"}).Glb();
  Random random(11);
  for (int trial = 0; trial < 60; ++trial) {
    std::vector<std::byte> bytes = whole;
    for (int flips = 0; flips < 6; ++flips) {
      bytes[random.Below(static_cast<uint32_t>(bytes.size()))] ^=
          static_cast<std::byte>(1u << random.Below(8));
    }
    ASSERT_TRUE(WriteFileAtomically(folder_ / "damaged.glb", bytes).ok());
    const auto human = ImportHuman(folder_ / "damaged.glb");
    EXPECT_TRUE(!human.ok() || human->Validate("damaged").ok());
  }
}

TEST(RunInChild, ReturnsWhatTheWorkReturns) {
  const auto bytes = RunInChild(
      "a.glb", []() -> Result<std::vector<std::byte>> { return std::vector(5, std::byte{7}); });
  ASSERT_TRUE(bytes.ok()) << bytes.message();
  EXPECT_EQ(bytes->size(), 5u);
  const auto error = RunInChild("a.glb", []() -> Result<std::vector<std::byte>> {
    return Status::Error("a.glb", "is wrong", "mend it");
  });
  EXPECT_EQ(error.message(), "a.glb: is wrong; mend it");
}

TEST(RunInChild, TurnsCrashesAndHangsIntoErrors) {
  const auto crash = RunInChild("a.glb", []() -> Result<std::vector<std::byte>> { std::abort(); });
  ASSERT_FALSE(crash.ok());
  EXPECT_THAT(crash.message(), HasSubstr("a.glb: "));
  IsolationLimits limits;
  limits.wall_seconds = 0;
  const auto hang = RunInChild(
      "a.glb",
      []() -> Result<std::vector<std::byte>> {
        while (true) {
          std::this_thread::sleep_for(std::chrono::milliseconds(50));
        }
      },
      limits);
  ASSERT_FALSE(hang.ok());
  EXPECT_THAT(hang.message(), HasSubstr("too long"));
}

}  // namespace
}  // namespace lararium::import
