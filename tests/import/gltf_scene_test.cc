#include "editor/import/model/gltf_scene.h"

#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <array>
#include <cstring>

#include "tests/import/glb_figure.h"
#include "tests/import/plain_figure.h"

namespace lararium::import {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// One triangle in the plane of x and y, as mesh 0 of node 0.
test::GlbFigure Triangle() {
  test::GlbFigure model;
  model.json = {{"asset", {{"version", "2.0"}}},
                {"nodes", {{{"mesh", 0}}}},
                {"accessors", Json::array()},
                {"bufferViews", Json::array()}};
  const size_t positions = model.AddFloats({0, 0, 0, 1, 0, 0, 0, 1, 0}, 3);
  model.json["meshes"] = {{{"primitives", {{{"attributes", {{"POSITION", positions}}}}}}}};
  return model;
}

Json& PrimitiveOf(test::GlbFigure& model) { return model.json["meshes"][0]["primitives"][0]; }

template <typename T>
std::vector<std::byte> BytesOf(const std::vector<T>& values) {
  const auto bytes = std::as_bytes(std::span(values));
  return {bytes.begin(), bytes.end()};
}

template <typename T>
size_t AddAccessor(test::GlbFigure& model,
                   const std::vector<T>& values,
                   int component,
                   const char* type,
                   size_t count,
                   bool normalised = false) {
  const size_t view = model.AddBytes(BytesOf(values));
  model.json["accessors"].push_back({{"bufferView", view},
                                     {"componentType", component},
                                     {"count", count},
                                     {"type", type},
                                     {"normalized", normalised}});
  return model.json["accessors"].size() - 1;
}

class ReadGltf : public ::testing::Test {
 protected:
  Result<std::unique_ptr<aiScene>> Read(const test::GlbFigure& model) {
    LARARIUM_ASSIGN_OR_RETURN(GltfDocument document, ParseGltf(model.Glb(), "model.glb"));
    LARARIUM_RETURN_IF_ERROR(ReadGltfBuffers("/nowhere/model.glb", document));
    notes_ = {};
    return ReadGltfScene(document, "model.glb", notes_);
  }
  GltfNotes notes_;
};

TEST_F(ReadGltf, TakesAllRootsWhereThereAreNoScenes) {
  const auto scene = Read(Triangle());
  ASSERT_TRUE(scene.ok()) << scene.message();
  ASSERT_EQ((*scene)->mNumMeshes, 1u);
  EXPECT_STREQ((*scene)->mRootNode->mChildren[0]->mName.C_Str(), "n0");
  EXPECT_EQ((*scene)->mMeshes[0]->mNormals[2], aiVector3D(0, 0, 1));
  EXPECT_THAT(notes_.structure, IsEmpty());
}

TEST_F(ReadGltf, MakesTrianglesOfStripsAndFans) {
  for (const auto& [mode, second] :
       {std::pair{5, std::array{1, 3, 2}}, std::pair{6, std::array{0, 2, 3}}}) {
    test::GlbFigure model = Triangle();
    const size_t positions = model.AddFloats({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}, 3);
    PrimitiveOf(model) = {{"attributes", {{"POSITION", positions}, {"NORMAL", positions}}},
                          {"mode", mode}};
    const auto scene = Read(model);
    ASSERT_TRUE(scene.ok()) << scene.message();
    const aiMesh& mesh = *(*scene)->mMeshes[0];
    ASSERT_EQ(mesh.mNumFaces, 2u);
    for (int k = 0; k < 3; ++k) {
      EXPECT_EQ(mesh.mFaces[1].mIndices[k], static_cast<unsigned>(second[static_cast<size_t>(k)]));
    }
  }
}

TEST_F(ReadGltf, ReplacesTheElementsOfSparseAccessors) {
  test::GlbFigure model = Triangle();
  const size_t indices = model.AddBytes(BytesOf(std::vector<uint16_t>{2}));
  const size_t values = model.AddBytes(BytesOf(std::vector<float>{0, 5, 0}));
  model.json["accessors"][0]["sparse"] = {
      {"count", 1},
      {"indices", {{"bufferView", indices}, {"componentType", 5123}}},
      {"values", {{"bufferView", values}}}};
  const auto scene = Read(model);
  ASSERT_TRUE(scene.ok()) << scene.message();
  EXPECT_EQ((*scene)->mMeshes[0]->mVertices[2], aiVector3D(0, 5, 0));
  EXPECT_EQ((*scene)->mMeshes[0]->mVertices[1], aiVector3D(1, 0, 0));
  model.binary[model.json["bufferViews"][indices]["byteOffset"].get<size_t>()] = std::byte{9};
  EXPECT_THAT(Read(model).message(), HasSubstr("out of range"));
}

TEST_F(ReadGltf, ReadsNormalisedIntegers) {
  test::GlbFigure model = Triangle();
  PrimitiveOf(model)["attributes"]["COLOR_0"] = AddAccessor<uint8_t>(
      model, {255, 0, 51, 255, 255, 255, 255, 255, 0, 0, 0, 255}, 5121, "VEC4", 3, true);
  PrimitiveOf(model)["attributes"]["TEXCOORD_0"] =
      AddAccessor<uint16_t>(model, {0, 65535, 0, 0, 0, 0}, 5123, "VEC2", 3, true);
  PrimitiveOf(model)["attributes"]["NORMAL"] =
      AddAccessor<int8_t>(model, {0, 0, -128, 0, 0, 127, 0, 0, 127}, 5120, "VEC3", 3, true);
  const auto scene = Read(model);
  ASSERT_TRUE(scene.ok()) << scene.message();
  const aiMesh& mesh = *(*scene)->mMeshes[0];
  EXPECT_NEAR(mesh.mColors[0][0].b, 0.2f, 1e-6f);
  EXPECT_EQ(mesh.mTextureCoords[0][0].y, 0.0f);  // Assimp counts from the bottom.
  EXPECT_EQ(mesh.mNormals[0], aiVector3D(0, 0, -1));
}

TEST_F(ReadGltf, MovesTextureCoordinatesByTheTransformOfTheTexture) {
  test::GlbFigure model = Triangle();
  PrimitiveOf(model)["attributes"]["TEXCOORD_1"] = model.AddFloats({1, 0, 0, 1, 0, 0}, 2);
  PrimitiveOf(model)["material"] = 0;
  model.json["textures"] = Json::array({Json::object()});
  const Json transform = {
      {"offset", {0.5, 0.25}}, {"scale", {0.5, 0.5}}, {"rotation", 1.5707963}, {"texCoord", 1}};
  const Json texture = {{"index", 0}, {"extensions", {{"KHR_texture_transform", transform}}}};
  model.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", texture}}}}};
  const auto scene = Read(model);
  ASSERT_TRUE(scene.ok()) << scene.message();
  const aiVector3D* uvs = (*scene)->mMeshes[0]->mTextureCoords[0];
  // A quarter turn counter-clockwise, while v counts downwards: (1, 0) goes to (0, -1).
  EXPECT_NEAR(uvs[0].x, 0.5f, 1e-6f);
  EXPECT_NEAR(1.0f - uvs[0].y, 0.25f - 0.5f, 1e-6f);
  EXPECT_NEAR(uvs[1].x, 0.5f + 0.5f, 1e-6f);
  EXPECT_NEAR(1.0f - uvs[1].y, 0.25f, 1e-6f);
}

TEST_F(ReadGltf, KeepsStepsAndFollowsCubicCurves) {
  for (const auto& [interpolation, at_half] :
       {std::pair{"LINEAR", 1.0f}, std::pair{"STEP", 0.0f}, std::pair{"CUBICSPLINE", 1.5f}}) {
    test::GlbFigure model = Triangle();
    // The tangents of the curve: the first leaves with 4 units a second, the second has none.
    const bool cubic = std::string_view(interpolation) == "CUBICSPLINE";
    const size_t output =
        cubic ? model.AddFloats({0, 0, 0, 0, 0, 0, 4, 0, 0, 0, 0, 0, 2, 0, 0, 0, 0, 0}, 3)
              : model.AddFloats({0, 0, 0, 2, 0, 0}, 3);
    model.json["animations"] = {
        {{"samplers",
          {{{"input", model.AddFloats({1, 2}, 1)},
            {"output", output},
            {"interpolation", interpolation}}}},
         {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}}};
    const auto scene = Read(model);
    ASSERT_TRUE(scene.ok()) << scene.message();
    const aiNodeAnim& keys = *(*scene)->mAnimations[0]->mChannels[0];
    const aiVectorKey* after =
        std::find_if(keys.mPositionKeys, keys.mPositionKeys + keys.mNumPositionKeys,
                     [](const aiVectorKey& key) { return key.mTime >= 1.5; });
    const aiVectorKey* before = after - 1;
    const auto share = static_cast<float>((1.5 - before->mTime) / (after->mTime - before->mTime));
    EXPECT_NEAR(before->mValue.x + share * (after->mValue.x - before->mValue.x), at_half, 1e-3f)
        << interpolation;
    EXPECT_EQ(keys.mPositionKeys[keys.mNumPositionKeys - 1].mValue.x, 2.0f);
  }
}

TEST_F(ReadGltf, ReadsMeshoptCompression) {
  test::GlbFigure model = Triangle();
  const std::vector<float> positions = {0, 0, 0, 7, 0, 0, 0, 1, 0};
  std::vector<unsigned char> packed(meshopt_encodeVertexBufferBound(3, 12));
  packed.resize(meshopt_encodeVertexBuffer(packed.data(), packed.size(), positions.data(), 3, 12));
  Json& view = model.json["bufferViews"][model.AddBytes(BytesOf(packed))];
  const Json compression = {{"buffer", 0},
                            {"byteOffset", view["byteOffset"]},
                            {"byteLength", packed.size()},
                            {"byteStride", 12},
                            {"count", 3},
                            {"mode", "ATTRIBUTES"}};
  model.json["buffers"].push_back(
      {{"byteLength", 36}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}});
  model.json["bufferViews"][0] = {{"buffer", 1},
                                  {"byteLength", 36},
                                  {"extensions", {{"EXT_meshopt_compression", compression}}}};
  model.json["extensionsRequired"] = {"EXT_meshopt_compression"};
  const auto scene = Read(model);
  ASSERT_TRUE(scene.ok()) << scene.message();
  EXPECT_EQ((*scene)->mMeshes[0]->mVertices[1], aiVector3D(7, 0, 0));
  model.json["buffers"].back().erase("extensions");  // No view needs the data of the buffer.
  EXPECT_TRUE(Read(model).ok());
  // A newer codec has another name, and may have the data without compression as well.
  Json& extensions = model.json["bufferViews"][0]["extensions"];
  extensions = {{"KHR_meshopt_compression", compression}};
  EXPECT_TRUE(Read(model).ok());
  extensions["KHR_meshopt_compression"]["count"] = 4000;
  EXPECT_THAT(Read(model).message(), HasSubstr("cannot be decoded"));
  model.json["bufferViews"][0]["buffer"] = 0;
  EXPECT_TRUE(Read(model).ok());
}

TEST_F(ReadGltf, ReadsDracoCompression) {
  draco::TriangleSoupMeshBuilder builder;
  builder.Start(1);
  const int id = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  const float corners[3][3] = {{0, 0, 0}, {7, 0, 0}, {0, 1, 0}};
  builder.SetAttributeValuesForFace(id, draco::FaceIndex(0), corners[0], corners[1], corners[2]);
  const std::unique_ptr<draco::Mesh> mesh = builder.Finalize();
  draco::EncoderBuffer buffer;
  draco::Encoder encoder;
  ASSERT_TRUE(encoder.EncodeMeshToBuffer(*mesh, &buffer).ok());
  test::GlbFigure model = Triangle();
  const size_t view =
      model.AddBytes(BytesOf(std::vector<char>(buffer.data(), buffer.data() + buffer.size())));
  model.json["accessors"] = {{{"componentType", 5126}, {"count", 3}, {"type", "VEC3"}}};
  const Json draco = {{"bufferView", view}, {"attributes", {{"POSITION", 0}}}};
  PrimitiveOf(model)["extensions"] = {{"KHR_draco_mesh_compression", draco}};
  model.json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
  const auto scene = Read(model);
  ASSERT_TRUE(scene.ok()) << scene.message();
  float largest = 0.0f;
  for (unsigned v = 0; v < (*scene)->mMeshes[0]->mNumVertices; ++v) {
    largest = std::max(largest, (*scene)->mMeshes[0]->mVertices[v].x);
  }
  EXPECT_NEAR(largest, 7.0f, 0.01f);
  model.json["bufferViews"][view]["byteLength"] = buffer.size() / 2;
  EXPECT_THAT(Read(model).message(), HasSubstr("Draco"));
}

TEST_F(ReadGltf, HasTheDefaultWeightsOfMorphTargets) {
  test::GlbFigure model = Triangle();
  const size_t delta = model.AddFloats({0, 0, 0, 0, 0, 4, 0, 0, 0}, 3);
  PrimitiveOf(model)["targets"] = {{{"POSITION", delta}}};
  model.json["meshes"][0]["weights"] = {0.5};
  const auto scene = Read(model);
  ASSERT_TRUE(scene.ok()) << scene.message();
  const aiMesh& mesh = *(*scene)->mMeshes[0];
  EXPECT_EQ(mesh.mVertices[1], aiVector3D(1, 0, 2));
  EXPECT_EQ(mesh.mAnimMeshes[0]->mVertices[1], aiVector3D(1, 0, 6));
}

TEST_F(ReadGltf, HasTheWeightsThatANodeGivesToAMeshOfSeveral) {
  test::GlbFigure model = Triangle();
  const size_t delta = model.AddFloats({0, 0, 0, 0, 0, 4, 0, 0, 0}, 3);
  PrimitiveOf(model)["targets"] = {{{"POSITION", delta}}};
  model.json["nodes"] = {{{"mesh", 0}}, {{"mesh", 0}, {"weights", {1.0}}}, {{"mesh", 0}}};
  const auto scene = Read(model);
  ASSERT_TRUE(scene.ok()) << scene.message();
  const aiNode& root = *(*scene)->mRootNode;
  const auto height = [&](unsigned node) {
    return (*scene)->mMeshes[root.mChildren[node]->mMeshes[0]]->mVertices[1].z;
  };
  EXPECT_EQ((*scene)->mNumMeshes, 2u);
  EXPECT_EQ(height(0), 0.0f);
  EXPECT_EQ(height(1), 4.0f);
  EXPECT_EQ(height(2), 0.0f);
}

TEST_F(ReadGltf, RepeatsAMeshForEachInstance) {
  test::GlbFigure model = Triangle();
  const size_t moves = model.AddFloats({1, 0, 0, 0, 5, 0}, 3);
  const size_t sizes = model.AddFloats({1, 1, 1, 3, 3, 3}, 3);
  model.json["nodes"][0]["extensions"] = {
      {"EXT_mesh_gpu_instancing", {{"attributes", {{"TRANSLATION", moves}, {"SCALE", sizes}}}}}};
  model.json["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
  const auto scene = Read(model);
  ASSERT_TRUE(scene.ok()) << scene.message();
  const aiNode& node = *(*scene)->mRootNode->mChildren[0];
  EXPECT_EQ(node.mNumMeshes, 0u);
  ASSERT_EQ(node.mNumChildren, 2u);
  EXPECT_EQ(node.mChildren[1]->mMeshes[0], 0u);
  EXPECT_EQ(node.mChildren[1]->mTransformation * aiVector3D(1, 0, 0), aiVector3D(3, 5, 0));
  model.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["SCALE"] = 0;
  EXPECT_THAT(Read(model).message(), HasSubstr("instances do not fit"));
}

TEST_F(ReadGltf, LeavesMeshesWithoutWeightsWhereTheyAre) {
  test::GlbFigure model = test::MakeGlbFigure(PlainSkeleton());
  PrimitiveOf(model)["attributes"].erase("JOINTS_0");
  const auto scene = Read(model);
  ASSERT_TRUE(scene.ok()) << scene.message();
  EXPECT_EQ((*scene)->mMeshes[0]->mNumBones, 0u);
  EXPECT_THAT(notes_.structure, Contains(HasSubstr("meshes without weights")));
}

TEST_F(ReadGltf, TellsCurvesThatMoveNothing) {
  test::GlbFigure model = Triangle();
  model.json["nodes"].push_back({{"name", "elsewhere"}});
  model.json["scenes"] = {{{"nodes", {0}}}};
  const Json sampler = {{"input", model.AddFloats({0, 1}, 1)},
                        {"output", model.AddFloats({0, 0, 0, 2, 0, 0}, 3)}};
  const auto note = [&](const Json& target) {
    const Json channel = {{"sampler", 0}, {"target", target}};
    model.json["animations"] = {{{"samplers", {sampler}}, {"channels", {channel}}}};
    const auto scene = Read(model);
    return scene.ok() && !notes_.structure.empty() ? notes_.structure.back() : scene.message();
  };
  EXPECT_THAT(note({{"path", "translation"}}), HasSubstr("name no node"));
  EXPECT_THAT(note({{"node", 1}, {"path", "translation"}}), HasSubstr("outside the scene"));
  EXPECT_THAT(note({{"node", 0}, {"path", "visible"}}), HasSubstr("motion of 'visible'"));
}

TEST_F(ReadGltf, LeavesOutHiddenNodes) {
  test::GlbFigure model = Triangle();
  model.json["nodes"] = {{{"children", {1}}}, {{"mesh", 0}}};
  EXPECT_EQ((*Read(model))->mNumMeshes, 1u);
  model.json["nodes"][0]["extensions"] = {{"KHR_node_visibility", {{"visible", false}}}};
  EXPECT_EQ((*Read(model))->mNumMeshes, 0u);
}

TEST_F(ReadGltf, TellsExtensionsThatItDoesNotKnow) {
  test::GlbFigure model = Triangle();
  model.json["extensionsUsed"] = {"KHR_lights_punctual", "KHR_mesh_quantization", "X_smell"};
  model.json["cameras"] = Json::array({Json::object()});
  model.json["nodes"][0]["camera"] = 0;
  ASSERT_TRUE(Read(model).ok());
  EXPECT_THAT(notes_.structure, Contains(HasSubstr("X_smell, cameras, lights")));
}

TEST_F(ReadGltf, FindsJointsOutsideTheScene) {
  test::GlbFigure model = test::MakeGlbFigure(PlainSkeleton());
  const size_t mesh_node = model.json["nodes"].size() - 1;
  model.json["scenes"] = {{{"nodes", {mesh_node}}}};
  const auto scene = Read(model);
  ASSERT_TRUE(scene.ok()) << scene.message();
  const aiMesh& mesh = *(*scene)->mMeshes[0];
  for (unsigned b = 0; b < mesh.mNumBones; ++b) {
    EXPECT_NE((*scene)->mRootNode->FindNode(mesh.mBones[b]->mName), nullptr);
  }
}

TEST_F(ReadGltf, TakesThePoseAtRestWhereASkinHasNoBindMatricesButVerticesThatFitIt) {
  test::GlbFigure model = test::MakeGlbFigure(PlainSkeleton());
  const auto whole = Read(model);
  model.json["skins"][0].erase("inverseBindMatrices");
  const auto without = Read(model);
  ASSERT_TRUE(whole.ok() && without.ok());
  EXPECT_THAT(notes_.structure, Contains(HasSubstr("no bind matrices")));
  for (unsigned b = 0; b < (*whole)->mMeshes[0]->mNumBones; ++b) {
    EXPECT_TRUE((*whole)->mMeshes[0]->mBones[b]->mOffsetMatrix.Equal(
        (*without)->mMeshes[0]->mBones[b]->mOffsetMatrix, 1e-4f));
  }
}

TEST_F(ReadGltf, TellsWhatIsNotTakenOver) {
  test::GlbFigure model = Triangle();
  PrimitiveOf(model)["material"] = 0;
  model.json["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", 0}}}, {"mode", 0}});
  model.json["materials"] = {
      {{"emissiveFactor", {1, 1, 1}},
       {"emissiveTexture", {{"index", 0}}},
       {"alphaMode", "BLEND"},
       {"extensions", {{"KHR_materials_unlit", Json::object()}, {"KHR_materials_sheen", 0}}}}};
  const auto scene = Read(model);
  ASSERT_TRUE(scene.ok()) << scene.message();
  ASSERT_EQ(notes_.structure.size(), 1u);
  EXPECT_THAT(notes_.structure[0], HasSubstr("points and lines"));
  ASSERT_EQ(notes_.surface.size(), 1u);
  for (const char* what :
       {"textures of emission", "half transparency", "unlit", "KHR_materials_sheen"}) {
    EXPECT_THAT(notes_.surface[0], HasSubstr(what));
  }
}

TEST_F(ReadGltf, NamesWhatIsWrongWithItsData) {
  const auto error = [&](auto change) {
    test::GlbFigure model = Triangle();
    change(model);
    const auto scene = Read(model);
    return scene.ok() ? std::string("no error") : scene.message();
  };
  EXPECT_THAT(error([](auto& m) {
                PrimitiveOf(m)["indices"] = AddAccessor<uint16_t>(m, {0, 1, 3}, 5123, "SCALAR", 3);
              }),
              HasSubstr("meshes[0].primitives[0]: an index is out of range"));
  EXPECT_THAT(error([](auto& m) { m.json["accessors"][0]["type"] = "VEC2"; }),
              HasSubstr("accessors[0]: has elements of another type"));
  EXPECT_THAT(error([](auto& m) {
                m.json["buffers"][0]["uri"] = "data:application/octet-stream;base64,!!";
              }),
              HasSubstr("base64"));
  EXPECT_THAT(error([](auto& m) { m.json["buffers"][0]["uri"] = "gone.bin"; }),
              HasSubstr("'gone.bin' is missing"));
  EXPECT_THAT(error([](auto& m) {
                PrimitiveOf(m)["extensions"] = {{"KHR_draco_mesh_compression", Json::object()}};
              }),
              HasSubstr("has no data"));
}

}  // namespace
}  // namespace lararium::import
