#include "editor/import/model/gltf_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "editor/import/model/gltf_accessors.h"
#include "editor/import/model/gltf_materials.h"
#include "editor/import/model/model_matrix.h"

namespace lararium::import {
namespace {

constexpr size_t kMaxCurveKeys = 20'000'000;
constexpr size_t kMaxInstances = 10'000;  // Most instances of one node.
constexpr size_t kNone = SIZE_MAX;
constexpr int kTriangles = 4, kStrip = 5, kFan = 6;
constexpr std::array<std::string_view, 2> kToldWhereUsed = {"KHR_texture_basisu",
                                                            "KHR_animation_pointer"};
constexpr float kCurveStep = 1.0f / 60.0f;  // Seconds between the keys that replace a curve.

// Translation, rotation and scale where an instance states none.
constexpr std::array<float, 4> kNoTranslation = {0, 0, 0, 0}, kNoRotation = {0, 0, 0, 1},
                               kNoScale = {1, 1, 1, 1};
constexpr std::array<std::span<const float>, 3> kRestOfInstance = {
    std::span(kNoTranslation).first(3), std::span(kNoRotation), std::span(kNoScale).first(3)};

std::string Number(const std::string& text, size_t index) { return text + std::to_string(index); }

aiMatrix4x4 ToAssimp(const glm::mat4& m) {
  return {m[0].x, m[1].x, m[2].x, m[3].x, m[0].y, m[1].y, m[2].y, m[3].y,
          m[0].z, m[1].z, m[2].z, m[3].z, m[0].w, m[1].w, m[2].w, m[3].w};
}

// t, r, s: translation, rotation (x, y, z, w) and scale.
glm::mat4 Compose(std::span<const float> t, std::span<const float> r, std::span<const float> s) {
  const glm::quat rotation(r[3], r[0], r[1], r[2]);
  return glm::translate(glm::mat4(1.0f), glm::vec3(t[0], t[1], t[2])) *
         glm::mat4_cast(glm::length(rotation) > 0.0f ? glm::normalize(rotation) : rotation) *
         glm::scale(glm::mat4(1.0f), glm::vec3(s[0], s[1], s[2]));
}

glm::mat4 LocalOf(const Json& node) {
  glm::mat4 matrix(1.0f);
  if (ReadNumbers(node, "matrix", std::span(glm::value_ptr(matrix), 16))) {
    return matrix;
  }
  std::array<float, 3> t = {0.0f, 0.0f, 0.0f}, s = {1.0f, 1.0f, 1.0f};
  std::array<float, 4> r = {0.0f, 0.0f, 0.0f, 1.0f};
  ReadNumbers(node, "translation", t);
  ReadNumbers(node, "rotation", r);
  ReadNumbers(node, "scale", s);
  return Compose(t, r, s);
}

// The corners of the triangles of a list, strip or fan, as indices into `indices`.
std::vector<uint32_t> Corners(size_t mode, const std::vector<uint32_t>& indices) {
  std::vector<uint32_t> corners;
  if (mode == kTriangles) {
    corners.assign(indices.begin(),
                   indices.end() - static_cast<std::ptrdiff_t>(indices.size() % 3));
    return corners;
  }
  for (size_t i = 2; i < indices.size(); ++i) {
    const bool odd = mode == kStrip && i % 2 == 1;
    const uint32_t first = mode == kFan ? indices[0] : indices[i - 2];
    corners.insert(corners.end(), {first, indices[odd ? i : i - 1], indices[odd ? i - 1 : i]});
  }
  return corners;
}

// Returns the elements that `order` names, in this order.
std::vector<float> Ordered(const std::vector<float>& values,
                           size_t components,
                           const std::vector<uint32_t>& order) {
  std::vector<float> result;
  result.reserve(order.size() * components);
  for (const uint32_t i : order) {
    const auto first = values.begin() + static_cast<std::ptrdiff_t>(i * components);
    result.insert(result.end(), first, first + static_cast<std::ptrdiff_t>(components));
  }
  return result;
}

aiVector3D* Vectors(const std::vector<float>& values) {
  auto* vectors = new aiVector3D[values.size() / 3];
  for (size_t i = 0; i < values.size() / 3; ++i) {
    vectors[i] = {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
  }
  return vectors;
}

std::vector<float> FlatNormals(const std::vector<float>& positions) {
  std::vector<float> normals;
  const auto at = [&](size_t i) { return glm::make_vec3(positions.data() + 3 * i); };
  for (size_t v = 0; v + 2 < positions.size() / 3; v += 3) {
    const glm::vec3 normal = Unit(glm::cross(at(v + 1) - at(v), at(v + 2) - at(v)));
    for (int corner = 0; corner < 3; ++corner) {
      normals.insert(normals.end(), {normal.x, normal.y, normal.z});
    }
  }
  return normals;
}

// One primitive while it is read; arrays of floats, one element per vertex.
struct Primitive {
  const Json* json = nullptr;
  std::string where;
  std::optional<DracoMesh> draco;
  size_t vertices = 0;  // Number of vertices in the file.
  std::vector<float> positions;
  std::vector<float> normals;
  std::vector<uint32_t> corners;  // Each triangle has three.
  // The vertices of the file, in the order of ours; empty if both are the same. A primitive
  // without normals is cut into triangles that share no vertex.
  std::vector<uint32_t> order;
};

class SceneReader {
 public:
  SceneReader(const GltfDocument& document, std::string where, GltfNotes& notes)
      : document_(document), accessors_(document, std::move(where)), notes_(notes) {}

  Result<std::unique_ptr<aiScene>> Read() {
    ListNodes();
    scene_->mRootNode = new aiNode("scene");
    for (const size_t root : Roots()) {
      LARARIUM_RETURN_IF_ERROR(AddNode(root, true, *scene_->mRootNode));
    }
    LARARIUM_RETURN_IF_ERROR(AddOutsideJoints());
    AddGltfMaterials(document_, accessors_, *scene_, left_out_surface_, notes_.surface);
    scene_->mMeshes = new aiMesh*[meshes_.size()];
    for (std::unique_ptr<aiMesh>& mesh : meshes_) {
      scene_->mMeshes[scene_->mNumMeshes++] = mesh.release();
    }
    LARARIUM_RETURN_IF_ERROR(AddAnimations());
    ListUnknownExtensions();
    Tell(left_out_, notes_.structure);
    Tell(left_out_surface_, notes_.surface);
    return std::move(scene_);
  }

 private:
  const Json& At(const char* list, size_t index) const { return document_.json[list][index]; }
  size_t Count(const char* list) const {
    const Json* entries = Find(document_.json, list);
    return entries == nullptr ? 0 : entries->size();
  }

  // Those that are read, and those that are told where they are used, are known.
  void ListUnknownExtensions() {
    const Json* used = Find(document_.json, "extensionsUsed");
    for (size_t i = 0; used != nullptr && used->is_array() && i < used->size(); ++i) {
      const std::string name = (*used)[i].is_string() ? (*used)[i].get<std::string>() : "";
      const auto is_known = [&](std::string_view known) { return name.starts_with(known); };
      if (name == "KHR_lights_punctual") {
        left_out_.insert("lights");
      } else if (name == "KHR_materials_variants") {
        left_out_surface_.insert("variants of materials other than the first choice");
      } else if (name == "VRMC_node_constraint" || name == "VRMC_springBone_extended_collider") {
        left_out_.insert(name);
      } else if (std::none_of(kToldWhereUsed.begin(), kToldWhereUsed.end(), is_known) &&
                 !CanReadGltfExtension(name)) {
        left_out_.insert(name.substr(0, 64));
      }
    }
  }

  // ---- Nodes ----

  void ListNodes() {
    parents_.assign(Count("nodes"), kNone);
    is_added_.assign(parents_.size(), false);
    for (size_t n = 0; n < parents_.size(); ++n) {
      if (const Json* children = Find(At("nodes", n), "children")) {
        for (const Json& child : *children) {
          parents_[child.get<size_t>()] = n;
        }
      }
    }
  }

  std::vector<size_t> Roots() {
    std::vector<size_t> roots;
    if (Count("scenes") > 0) {
      const size_t shown = WholeOr(document_.json, "scene", 0);
      if (const Json* nodes = Find(At("scenes", shown), "nodes")) {
        roots = nodes->get<std::vector<size_t>>();
      }
      if (Count("scenes") > 1) {
        notes_.structure.push_back("it has " + std::to_string(Count("scenes")) + " scenes; scene " +
                                   std::to_string(shown) + " is taken");
      }
      return roots;
    }
    for (size_t n = 0; n < parents_.size(); ++n) {
      if (parents_[n] == kNone) {
        roots.push_back(n);
      }
    }
    return roots;
  }

  Status AddNode(size_t index, bool with_mesh, aiNode& parent) {
    if (is_added_[index]) {
      return Status();
    }
    is_added_[index] = true;
    const Json& source = At("nodes", index);
    auto* node = new aiNode(Number("n", index));
    parent.addChildren(1, &node);  // Takes ownership.
    node->mTransformation = ToAssimp(LocalOf(source));
    if (const Json* visibility = FindExtension(source, "KHR_node_visibility")) {
      const Json* visible = Find(*visibility, "visible");
      with_mesh = with_mesh && (visible == nullptr || *visible != false);
    }
    if (Find(source, "camera") != nullptr) {
      left_out_.insert("cameras");
    }
    if (with_mesh && Find(source, "mesh") != nullptr) {
      LARARIUM_RETURN_IF_ERROR(AddMeshes(source, *node));
      if (const Json* instancing = FindExtension(source, "EXT_mesh_gpu_instancing")) {
        LARARIUM_RETURN_IF_ERROR(AddInstances(*instancing, *node));
      }
    }
    if (const Json* children = Find(source, "children")) {
      for (const Json& child : *children) {
        LARARIUM_RETURN_IF_ERROR(AddNode(child.get<size_t>(), with_mesh, *node));
      }
    }
    return Status();
  }

  // Joints may lie outside the scene that shows their mesh.
  Status AddOutsideJoints() {
    for (const size_t skin : used_skins_) {
      for (const Json& joint : At("skins", skin)["joints"]) {
        size_t root = joint.get<size_t>();
        while (parents_[root] != kNone && !is_added_[root]) {
          root = parents_[root];
        }
        LARARIUM_RETURN_IF_ERROR(AddNode(root, false, *scene_->mRootNode));
      }
    }
    return Status();
  }

  glm::mat4 SceneFromNode(size_t node) const {
    glm::mat4 result = LocalOf(At("nodes", node));
    while ((node = parents_[node]) != kNone) {
      result = LocalOf(At("nodes", node)) * result;
    }
    return result;
  }

  // ---- Meshes ----

  Status AddMeshes(const Json& source, aiNode& node) {
    const size_t mesh = source["mesh"].get<size_t>();
    const size_t skin = WholeOr(source, "skin", kNone);
    if (skin != kNone) {
      used_skins_.insert(skin);
    }
    const size_t count = At("meshes", mesh)["primitives"].size();
    std::vector<unsigned> indices;
    for (size_t p = 0; p < count; ++p) {
      const auto [made, is_new] =
          made_.try_emplace({mesh, p, skin, Find(source, "weights")}, kNone);
      if (is_new) {
        LARARIUM_ASSIGN_OR_RETURN(std::unique_ptr<aiMesh> built, MakeMesh(source, mesh, p, skin));
        if (built != nullptr) {
          made->second = meshes_.size();
          built->mName = Number("m", mesh) + (count > 1 ? Number("-", p) : "");
          meshes_.push_back(std::move(built));
        }
      }
      if (made->second != kNone) {
        indices.push_back(static_cast<unsigned>(made->second));
      }
    }
    node.mNumMeshes = static_cast<unsigned>(indices.size());
    node.mMeshes = new unsigned[indices.size()];
    std::copy(indices.begin(), indices.end(), node.mMeshes);
    return Status();
  }

  // Replaces the meshes of a node by a child with these meshes for each instance.
  Status AddInstances(const Json& instancing, aiNode& node) {
    const Json* attributes = Find(instancing, "attributes");
    std::array<std::vector<float>, 3> values;
    std::optional<size_t> count;
    for (const auto& [i, name] :
         {std::pair{size_t{0}, "TRANSLATION"}, {size_t{1}, "ROTATION"}, {size_t{2}, "SCALE"}}) {
      const size_t accessor = attributes == nullptr ? kNone : WholeOr(*attributes, name, kNone);
      if (accessor == kNone) {
        continue;
      }
      if (accessor >= Count("accessors") || (count && accessors_.Count(accessor) != *count) ||
          accessors_.Count(accessor) > kMaxInstances) {
        return accessors_.Problem(node.mName.C_Str(), "its instances do not fit, or are too many");
      }
      count = accessors_.Count(accessor);
      LARARIUM_ASSIGN_OR_RETURN(values[i], accessors_.Floats(accessor, kRestOfInstance[i].size()));
    }
    std::vector<aiNode*> instances;  // The node takes ownership.
    for (size_t k = 0; k < count.value_or(0); ++k) {
      std::array<std::span<const float>, 3> trs;
      for (size_t i = 0; i < trs.size(); ++i) {
        const size_t n = kRestOfInstance[i].size();
        trs[i] = values[i].empty() ? kRestOfInstance[i] : std::span(values[i]).subspan(k * n, n);
      }
      auto* instance = new aiNode(node.mName.C_Str() + Number(":", k));
      instance->mTransformation = ToAssimp(Compose(trs[0], trs[1], trs[2]));
      instance->mNumMeshes = node.mNumMeshes;
      instance->mMeshes = new unsigned[node.mNumMeshes];
      std::copy_n(node.mMeshes, node.mNumMeshes, instance->mMeshes);
      instances.push_back(instance);
    }
    if (!instances.empty()) {
      node.mNumMeshes = 0;
      delete[] std::exchange(node.mMeshes, nullptr);
      node.addChildren(static_cast<unsigned>(instances.size()), instances.data());
    }
    return Status();
  }

  // Null for a primitive of points or lines.
  Result<std::unique_ptr<aiMesh>> MakeMesh(const Json& node, size_t mesh, size_t p, size_t skin) {
    Primitive primitive;
    primitive.json = &At("meshes", mesh)["primitives"][p];
    primitive.where = Number("meshes[", mesh) + Number("].primitives[", p) + "]";
    const size_t mode = WholeOr(*primitive.json, "mode", kTriangles);
    const Json& attributes = (*primitive.json)["attributes"];
    if ((mode != kTriangles && mode != kStrip && mode != kFan) ||
        Find(attributes, "POSITION") == nullptr) {
      left_out_.insert(mode < kTriangles ? "points and lines" : "parts without positions");
      return std::unique_ptr<aiMesh>();
    }
    vertices_ += accessors_.Count(attributes["POSITION"].get<size_t>());
    if (vertices_ > kMaxVertices) {
      return accessors_.Problem(
          primitive.where, "there are more than " + std::to_string(kMaxVertices) + " vertices");
    }
    LARARIUM_RETURN_IF_ERROR(ReadDraco(primitive));
    LARARIUM_ASSIGN_OR_RETURN(primitive.positions, Attribute(primitive, "POSITION", 3));
    primitive.vertices = primitive.positions.size() / 3;
    LARARIUM_RETURN_IF_ERROR(ReadCorners(mode, primitive));
    LARARIUM_ASSIGN_OR_RETURN(primitive.normals, Attribute(primitive, "NORMAL", 3));
    if (primitive.normals.empty()) {
      primitive.positions = Ordered(primitive.positions, 3, primitive.corners);
      primitive.normals = FlatNormals(primitive.positions);
      primitive.order = std::exchange(primitive.corners, {});
      primitive.corners.resize(primitive.order.size());
      std::iota(primitive.corners.begin(), primitive.corners.end(), 0u);
    }
    auto result = std::make_unique<aiMesh>();
    result->mPrimitiveTypes = aiPrimitiveType_TRIANGLE;
    result->mNumVertices = static_cast<unsigned>(primitive.positions.size() / 3);
    result->mMaterialIndex =
        static_cast<unsigned>(WholeOr(*primitive.json, "material", Count("materials")));
    LARARIUM_RETURN_IF_ERROR(AddTargets(node, mesh, primitive, *result));
    result->mVertices = Vectors(primitive.positions);
    result->mNormals = Vectors(primitive.normals);
    AddFaces(primitive, *result);
    LARARIUM_RETURN_IF_ERROR(AddUvs(primitive, *result));
    LARARIUM_RETURN_IF_ERROR(AddColours(primitive, *result));
    if (skin != kNone && Find(attributes, "JOINTS_0") == nullptr) {
      left_out_.insert("skins of meshes without weights");
    } else if (skin != kNone) {
      LARARIUM_RETURN_IF_ERROR(AddBones(primitive, skin, *result));
    }
    return result;
  }

  Status ReadDraco(Primitive& primitive) const {
    const Json* draco = FindExtension(*primitive.json, "KHR_draco_mesh_compression");
    if (draco == nullptr) {
      return Status();
    }
    const size_t view = WholeOr(*draco, "bufferView", kNone);
    const Json* attributes = Find(*draco, "attributes");
    if (view >= Count("bufferViews") || attributes == nullptr || !attributes->is_object()) {
      return accessors_.Problem(primitive.where, "its Draco compression has no data");
    }
    std::map<std::string, uint32_t> ids;
    for (const auto& [name, id] : attributes->items()) {
      ids[name] = static_cast<uint32_t>(WholeOr(*attributes, name.c_str(), UINT32_MAX));
    }
    LARARIUM_ASSIGN_OR_RETURN(const std::span<const std::byte> bytes, accessors_.View(view));
    LARARIUM_ASSIGN_OR_RETURN(primitive.draco, DecodeDraco(bytes, ids, primitive.where));
    return Status();
  }

  // An attribute of all vertices; empty if the primitive does not have it.
  Result<std::vector<float>> Attribute(const Primitive& primitive,
                                       const std::string& name,
                                       size_t components) const {
    const Json* accessor = Find((*primitive.json)["attributes"], name.c_str());
    if (accessor == nullptr) {
      return std::vector<float>();
    }
    std::vector<float> values;
    if (primitive.draco && primitive.draco->attributes.contains(name)) {
      values = primitive.draco->attributes.at(name);
      if (values.size() != components * primitive.draco->vertices) {
        return accessors_.Problem(primitive.where, name + " has elements of another type");
      }
    } else {
      LARARIUM_ASSIGN_OR_RETURN(values, accessors_.Floats(accessor->get<size_t>(), components));
    }
    if (name != "POSITION" && values.size() != components * primitive.vertices) {
      return accessors_.Problem(primitive.where, name + " does not fit its vertices");
    }
    return primitive.order.empty() ? values : Ordered(values, components, primitive.order);
  }

  Status ReadCorners(size_t mode, Primitive& primitive) const {
    const size_t vertices = primitive.vertices;
    std::vector<uint32_t> indices(vertices);
    std::iota(indices.begin(), indices.end(), 0u);
    if (primitive.draco) {
      indices = primitive.draco->indices;
    } else if (const Json* accessor = Find(*primitive.json, "indices")) {
      LARARIUM_ASSIGN_OR_RETURN(indices, accessors_.Indices(accessor->get<size_t>()));
    }
    if (std::any_of(indices.begin(), indices.end(), [&](uint32_t i) { return i >= vertices; })) {
      return accessors_.Problem(primitive.where, "an index is out of range");
    }
    primitive.corners = Corners(primitive.draco ? kTriangles : mode, indices);
    return Status();
  }

  static void AddFaces(const Primitive& primitive, aiMesh& mesh) {
    mesh.mNumFaces = static_cast<unsigned>(primitive.corners.size() / 3);
    mesh.mFaces = new aiFace[mesh.mNumFaces];
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      mesh.mFaces[f].mNumIndices = 3;
      mesh.mFaces[f].mIndices = new unsigned[3];
      std::copy_n(primitive.corners.begin() + 3 * static_cast<std::ptrdiff_t>(f), 3,
                  mesh.mFaces[f].mIndices);
    }
  }

  // Assimp counts v from the bottom.
  Status AddUvs(const Primitive& primitive, aiMesh& mesh) {
    const size_t material = WholeOr(*primitive.json, "material", kNone);
    const GltfUvs uvs =
        ColourUvs(document_, material == kNone ? std::nullopt : std::optional(material));
    LARARIUM_ASSIGN_OR_RETURN(const std::vector<float> values,
                              Attribute(primitive, Number("TEXCOORD_", uvs.set), 2));
    if (values.empty()) {
      return Status();
    }
    mesh.mNumUVComponents[0] = 2;
    mesh.mTextureCoords[0] = new aiVector3D[mesh.mNumVertices];
    for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
      const glm::vec3 uv = uvs.transform * glm::vec3(values[2 * v], values[2 * v + 1], 1.0f);
      mesh.mTextureCoords[0][v] = {uv.x, 1.0f - uv.y, 0.0f};
      if (!uvs.repeats && (std::abs(uv.x - 0.5f) > 0.51f || std::abs(uv.y - 0.5f) > 0.51f)) {
        left_out_surface_.insert("textures that end or are mirrored at their border (they repeat)");
      }
    }
    return Status();
  }

  Status AddColours(const Primitive& primitive, aiMesh& mesh) {
    const Json* accessor = Find((*primitive.json)["attributes"], "COLOR_0");
    if (accessor == nullptr) {
      return Status();
    }
    const size_t components = accessors_.Components(accessor->get<size_t>());
    LARARIUM_ASSIGN_OR_RETURN(const std::vector<float> values,
                              Attribute(primitive, "COLOR_0", components));
    if (components < 3) {
      return accessors_.Problem(primitive.where, "its colours have no three components");
    }
    mesh.mColors[0] = new aiColor4D[mesh.mNumVertices];
    for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
      const float* colour = values.data() + components * v;
      mesh.mColors[0][v] = {colour[0], colour[1], colour[2], 1.0f};
      if (components == 4 && colour[3] < 1.0f && !IsOpaque(primitive)) {
        left_out_surface_.insert("transparency of vertex colours");
      }
    }
    return Status();
  }

  bool IsOpaque(const Primitive& primitive) const {
    const size_t material = WholeOr(*primitive.json, "material", kNone);
    return material == kNone ||
           TextOr(At("materials", material), "alphaMode", "OPAQUE") == "OPAQUE";
  }

  // Adds the morph targets, and moves the vertices by their default weights.
  Status AddTargets(const Json& node, size_t mesh, Primitive& primitive, aiMesh& result) const {
    const Json* targets = Find(*primitive.json, "targets");
    if (targets == nullptr) {
      return Status();
    }
    std::vector<float> weights(targets->size(), 0.0f);
    if (!ReadNumbers(node, "weights", weights)) {
      ReadNumbers(At("meshes", mesh), "weights", weights);
    }
    std::vector<std::array<std::vector<float>, 2>> deltas(targets->size());
    for (size_t t = 0; t < targets->size(); ++t) {
      for (const auto& [i, name, base] : {std::tuple{0, "POSITION", &primitive.positions},
                                          std::tuple{1, "NORMAL", &primitive.normals}}) {
        const Json* accessor = Find((*targets)[t], name);
        if (accessor == nullptr) {
          continue;
        }
        std::vector<float>& delta = deltas[t][static_cast<size_t>(i)];
        LARARIUM_ASSIGN_OR_RETURN(delta, accessors_.Floats(accessor->get<size_t>(), 3));
        if (delta.size() != 3 * primitive.vertices) {
          return accessors_.Problem(primitive.where, "a morph target does not fit its vertices");
        }
        if (!primitive.order.empty()) {
          delta = Ordered(delta, 3, primitive.order);
        }
        for (size_t k = 0; weights[t] != 0.0f && k < delta.size(); ++k) {
          (*base)[k] += weights[t] * delta[k];
        }
      }
    }
    result.mAnimMeshes = new aiAnimMesh*[deltas.size()];
    for (auto& [positions, normals] : deltas) {
      auto* target = result.mAnimMeshes[result.mNumAnimMeshes++] = new aiAnimMesh;
      target->mNumVertices = result.mNumVertices;
      target->mVertices = Moved(primitive.positions, positions);
      target->mNormals = Moved(primitive.normals, normals);
    }
    return Status();
  }

  static aiVector3D* Moved(const std::vector<float>& base, std::vector<float>& delta) {
    if (delta.empty()) {
      return nullptr;
    }
    std::transform(base.begin(), base.end(), delta.begin(), delta.begin(), std::plus<float>());
    return Vectors(delta);
  }

  // ---- Skins ----

  Status AddBones(const Primitive& primitive, size_t skin, aiMesh& mesh) {
    const Json& joints = At("skins", skin)["joints"];
    std::vector<std::vector<aiVertexWeight>> weights(joints.size());
    const Json& attributes = (*primitive.json)["attributes"];
    for (size_t set = 0; Find(attributes, Number("JOINTS_", set).c_str()) != nullptr; ++set) {
      LARARIUM_ASSIGN_OR_RETURN(const std::vector<float> of,
                                Attribute(primitive, Number("JOINTS_", set), 4));
      LARARIUM_ASSIGN_OR_RETURN(const std::vector<float> by,
                                Attribute(primitive, Number("WEIGHTS_", set), 4));
      for (size_t i = 0; i < std::min(of.size(), by.size()); ++i) {
        if (by[i] <= 0.0f) {
          continue;
        }
        if (!(of[i] < static_cast<float>(joints.size()))) {
          return accessors_.Problem(primitive.where, "a vertex names a joint that does not exist");
        }
        weights[static_cast<size_t>(of[i])].emplace_back(static_cast<unsigned>(i / 4), by[i]);
      }
    }
    LARARIUM_ASSIGN_OR_RETURN(const std::vector<glm::mat4> joint_from_mesh,
                              BindMatrices(skin, weights, mesh));
    mesh.mBones = new aiBone*[joints.size()];
    for (size_t j = 0; j < joints.size(); ++j) {
      auto* bone = mesh.mBones[mesh.mNumBones++] = new aiBone;
      bone->mName = Number("n", joints[j].get<size_t>());
      bone->mOffsetMatrix = ToAssimp(joint_from_mesh[j]);
      bone->mNumWeights = static_cast<unsigned>(weights[j].size());
      bone->mWeights = new aiVertexWeight[weights[j].size()];
      std::copy(weights[j].begin(), weights[j].end(), bone->mWeights);
    }
    return Status();
  }

  // If the skin has no bind matrices, the format says that vertices are in the frames of their
  // joints. Some programs mean the rest pose instead, so the vertices decide: they are near
  // their joints.
  Result<std::vector<glm::mat4>> BindMatrices(
      size_t skin, const std::vector<std::vector<aiVertexWeight>>& weights, const aiMesh& mesh) {
    const Json& joints = At("skins", skin)["joints"];
    std::vector<glm::mat4> matrices(joints.size(), glm::mat4(1.0f));
    if (const Json* accessor = Find(At("skins", skin), "inverseBindMatrices")) {
      LARARIUM_ASSIGN_OR_RETURN(const std::vector<float> values,
                                accessors_.Floats(accessor->get<size_t>(), 16));
      for (size_t j = 0; j < joints.size(); ++j) {
        matrices[j] = glm::make_mat4(values.data() + 16 * j);
        // Exporters round the last row.
        matrices[j] = glm::transpose(
            glm::mat4(glm::transpose(matrices[j])[0], glm::transpose(matrices[j])[1],
                      glm::transpose(matrices[j])[2], glm::vec4(0.0f, 0.0f, 0.0f, 1.0f)));
      }
      return matrices;
    }
    std::vector<glm::mat4> at_rest(joints.size());
    double in_joints = 0.0, in_rest = 0.0;
    for (size_t j = 0; j < joints.size(); ++j) {
      const glm::mat4 scene_from_joint = SceneFromNode(joints[j].get<size_t>());
      at_rest[j] = IsUsable(scene_from_joint) ? glm::inverse(scene_from_joint) : glm::mat4(1.0f);
      for (const aiVertexWeight& weight : weights[j]) {
        const aiVector3D& p = mesh.mVertices[weight.mVertexId];
        const glm::vec3 position(p.x, p.y, p.z);
        in_joints += glm::length(position);
        in_rest += glm::length(Apply(at_rest[j], position));
      }
    }
    if (in_rest < in_joints) {
      notes_.structure.push_back(
          "its skin states no bind matrices; its pose at rest is taken instead");
      return at_rest;
    }
    return matrices;
  }

  // ---- Animations ----

  Status AddAnimations() {
    const size_t count = Count("animations");
    scene_->mAnimations = new aiAnimation*[count];
    for (size_t a = 0; a < count; ++a) {
      auto* animation = scene_->mAnimations[scene_->mNumAnimations++] = new aiAnimation;
      animation->mName = TextOr(At("animations", a), "name", "");
      animation->mTicksPerSecond = 1.0;
      std::map<size_t, std::unique_ptr<aiNodeAnim>> of_node;
      for (const Json& channel : At("animations", a)["channels"]) {
        LARARIUM_RETURN_IF_ERROR(AddChannel(At("animations", a), channel, of_node));
      }
      animation->mChannels = new aiNodeAnim*[of_node.size()];
      for (auto& [node, keys] : of_node) {
        keys->mNodeName = Number("n", node);
        animation->mChannels[animation->mNumChannels++] = keys.release();
      }
    }
    return Status();
  }

  Status AddChannel(const Json& animation,
                    const Json& channel,
                    std::map<size_t, std::unique_ptr<aiNodeAnim>>& of_node) {
    const Json& target = channel["target"];
    const std::string path = TextOr(target, "path", "");
    const size_t node = WholeOr(target, "node", kNone);
    const size_t components = path == "rotation" ? 4 : 3;
    if (path == "weights" || path == "pointer") {
      left_out_.insert(path == "weights" ? "motion of morph targets in clips"
                                         : "motion of anything but nodes (KHR_animation_pointer)");
      return Status();
    }
    if (path != "rotation" && path != "translation" && path != "scale") {
      left_out_.insert("motion of '" + path.substr(0, 64) + "' in clips");
      return Status();
    }
    if (node == kNone || !is_added_[node]) {
      left_out_.insert(node == kNone ? "curves of clips that name no node"
                                     : "motion of nodes outside the scene");
      return Status();
    }
    const Json& sampler = animation["samplers"][channel["sampler"].get<size_t>()];
    LARARIUM_ASSIGN_OR_RETURN(const Keys keys, ReadKeys(sampler, components));
    std::unique_ptr<aiNodeAnim>& curve = of_node[node];
    if (curve == nullptr) {
      curve = std::make_unique<aiNodeAnim>();
    }
    const auto size = static_cast<unsigned>(keys.times.size());
    if (path == "rotation" && curve->mRotationKeys == nullptr) {
      curve->mNumRotationKeys = size;
      curve->mRotationKeys = new aiQuatKey[size];
      for (unsigned k = 0; k < size; ++k) {
        const float* q = keys.values.data() + 4 * k;
        curve->mRotationKeys[k] = {keys.times[k], aiQuaternion(q[3], q[0], q[1], q[2])};
      }
      return Status();
    }
    if (path == "rotation") {
      left_out_.insert("second curves of clips for one node");
      return Status();
    }
    auto& list = path == "scale" ? curve->mScalingKeys : curve->mPositionKeys;
    if (list != nullptr) {
      left_out_.insert("second curves of clips for one node");
    } else {
      (path == "scale" ? curve->mNumScalingKeys : curve->mNumPositionKeys) = size;
      list = new aiVectorKey[size];
      for (unsigned k = 0; k < size; ++k) {
        const float* v = keys.values.data() + 3 * k;
        list[k] = {keys.times[k], aiVector3D(v[0], v[1], v[2])};
      }
    }
    return Status();
  }

  struct Keys {
    std::vector<double> times;
    std::vector<float> values;
    void Add(double time, std::span<const float> value) {
      times.push_back(time);
      values.insert(values.end(), value.begin(), value.end());
    }
  };

  // The keys of a sampler; between them, values change evenly.
  Result<Keys> ReadKeys(const Json& sampler, size_t components) {
    const Json* input = Find(sampler, "input");
    const Json* output = Find(sampler, "output");
    if (input == nullptr || output == nullptr) {
      return accessors_.Problem("animations", "a sampler has no keys");
    }
    LARARIUM_ASSIGN_OR_RETURN(const std::vector<float> times,
                              accessors_.Floats(input->get<size_t>(), 1));
    LARARIUM_ASSIGN_OR_RETURN(const std::vector<float> values,
                              accessors_.Floats(output->get<size_t>(), components));
    const std::string interpolation = TextOr(sampler, "interpolation", "LINEAR");
    const size_t per_key = interpolation == "CUBICSPLINE" ? 3 : 1;
    if (values.size() != times.size() * components * per_key) {
      return accessors_.Problem("animations", "a sampler has another number of values than times");
    }
    Keys keys;
    const std::span all(values);
    for (size_t k = 0; k < times.size(); ++k) {
      if (interpolation == "STEP" && k > 0) {
        keys.Add(times[k], all.subspan((k - 1) * components, components));
      }
      if (interpolation == "CUBICSPLINE" && k > 0) {
        AddCurve(times[k - 1], times[k], all.subspan(3 * (k - 1) * components, 6 * components),
                 keys);
      }
      keys.Add(times[k], all.subspan((per_key * k + per_key / 2) * components, components));
      if (key_count_ + keys.times.size() > kMaxCurveKeys) {
        return accessors_.Problem("animations", "there are too many keys");
      }
    }
    key_count_ += keys.times.size();
    return keys;
  }

  // Adds the keys between two keys of a cubic spline (glTF 2.0, appendix C), each of which is an
  // in-tangent, a value and an out-tangent.
  static void AddCurve(float first, float last, std::span<const float> two_keys, Keys& keys) {
    const size_t n = two_keys.size() / 6;
    const float span = last - first;
    const auto pieces = static_cast<int>(std::clamp(span / kCurveStep, 1.0f, 6000.0f));
    std::vector<float> value(n);
    for (int i = 1; std::isfinite(span) && i < pieces; ++i) {
      const float t = static_cast<float>(i) / static_cast<float>(pieces);
      const float t2 = t * t, t3 = t2 * t;
      for (size_t c = 0; c < n; ++c) {
        value[c] = (2 * t3 - 3 * t2 + 1) * two_keys[n + c] +
                   span * (t3 - 2 * t2 + t) * two_keys[2 * n + c] +
                   (3 * t2 - 2 * t3) * two_keys[4 * n + c] + span * (t3 - t2) * two_keys[3 * n + c];
      }
      keys.Add(first + span * t, value);
    }
  }

  static void Tell(const std::set<std::string>& left_out, std::vector<std::string>& notes) {
    std::string list;
    for (const std::string& what : left_out) {
      list += (list.empty() ? "" : ", ") + what;
    }
    if (!list.empty()) {
      notes.push_back("not taken over from its file: " + list);
    }
  }

  const GltfDocument& document_;
  const GltfAccessors accessors_;
  GltfNotes& notes_;
  std::set<std::string> left_out_, left_out_surface_;
  std::unique_ptr<aiScene> scene_ = std::make_unique<aiScene>();
  std::vector<std::unique_ptr<aiMesh>> meshes_;
  // The key is mesh, primitive, skin and the morph weights of the node, null for the mesh's own.
  std::map<std::tuple<size_t, size_t, size_t, const Json*>, size_t> made_;
  std::set<size_t> used_skins_;
  std::vector<size_t> parents_;  // Each node has an entry.
  std::vector<bool> is_added_;   // Each node has an entry.
  size_t vertices_ = 0, key_count_ = 0;
};

}  // namespace

Result<std::unique_ptr<aiScene>> ReadGltfScene(const GltfDocument& document,
                                               const std::string& where,
                                               GltfNotes& notes) {
  return SceneReader(document, where, notes).Read();
}

}  // namespace lararium::import
