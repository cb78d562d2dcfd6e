#include "editor/import/model_builder.h"

#include <assimp/GltfMaterial.h>
#include <assimp/material.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <map>
#include <numeric>
#include <set>

#include "editor/import/model_expressions.h"
#include "editor/import/model_frame.h"
#include "editor/import/model_textures.h"
#include "editor/import/vrm.h"
#include "shared/core/file.h"
#include "shared/core/json.h"
#include "shared/core/lower_case.h"
#include "shared/human/finite.h"

namespace lararium::import {
namespace {

using human::Skeleton;

constexpr size_t kMaxVertices = 2'000'000;
constexpr double kMaxClipSeconds = 3600.0;
constexpr size_t kMaxKeys = 8'000'000;          // joints times keys, in all clips
constexpr size_t kMaxSamples = 400'000'000;     // nodes times keys, in all clips
constexpr size_t kMaxMorphDeltas = 20'000'000;  // vertices moved, in all morph targets
constexpr float kSmallestDelta = 1e-5f;         // metres, of a morph target
constexpr float kLeast = 0.4f, kMost = 2.4f;    // metres, of a possible person
constexpr float kStature = 1.75f;               // metres, where nothing says how tall
constexpr float kWellPlaced = 0.02f;            // metres from the floor that are left alone

bool Usable(const glm::mat4& m) {
  const float determinant = glm::determinant(glm::mat3(m));
  return human::Finite(m) && std::isfinite(determinant) && std::abs(determinant) > 1e-20f &&
         m[0].w == 0.0f && m[1].w == 0.0f && m[2].w == 0.0f && m[3].w == 1.0f;
}

glm::vec3 Apply(const glm::mat4& m, const glm::vec3& point) {
  return glm::vec3(m * glm::vec4(point, 1.0f));
}

float ScaleOf(const glm::mat4& m) { return std::cbrt(std::abs(glm::determinant(glm::mat3(m)))); }

// A matrix as rotation, one scale and translation; what it shears is left out.
human::JointTransform Decompose(const glm::mat4& m) {
  human::JointTransform result;
  result.translation = glm::vec3(m[3]);
  const float scale = ScaleOf(m);
  result.scale = glm::vec3(scale);
  const glm::vec3 x = glm::vec3(m[0]);
  const glm::vec3 z = glm::cross(x, glm::vec3(m[1]));
  const bool flat = !(glm::length(x) > 1e-12f) || !(glm::length(z) > 1e-12f);
  if (!flat && glm::determinant(glm::mat3(m)) > 0.0f) {
    const glm::vec3 ux = glm::normalize(x), uz = glm::normalize(z);
    result.rotation = glm::normalize(glm::quat_cast(glm::mat3(ux, glm::cross(uz, ux), uz)));
  }
  return result;
}

float LinearFromSrgb(float value) {
  return value <= 0.04045f ? value / 12.92f : std::pow((value + 0.055f) / 1.055f, 2.4f);
}

// What a material's name says about its surface.
human::Surface SurfaceOf(const std::string& name) {
  struct Word {
    const char* text;
    human::Surface surface;
  };
  constexpr Word kWords[] = {{"hair", human::Surface::kHair},     {"brow", human::Surface::kHair},
                             {"lash", human::Surface::kHair},     {"beard", human::Surface::kHair},
                             {"eye", human::Surface::kEye},       {"iris", human::Surface::kEye},
                             {"skin", human::Surface::kSkin},     {"body", human::Surface::kSkin},
                             {"face", human::Surface::kSkin},     {"head", human::Surface::kSkin},
                             {"cloth", human::Surface::kCloth},   {"shirt", human::Surface::kCloth},
                             {"dress", human::Surface::kCloth},   {"tunic", human::Surface::kCloth},
                             {"trouser", human::Surface::kCloth}, {"pants", human::Surface::kCloth},
                             {"toga", human::Surface::kCloth}};
  const std::string lower = LowerCase(name);
  for (const Word& word : kWords) {
    if (lower.find(word.text) != std::string::npos) {
      return word.surface;
    }
  }
  return human::Surface::kPlain;
}

struct Influence {
  int node = SceneNodes::kNoParent;
  float weight = 0.0f;
};
using Influences = std::array<Influence, 4>;

// A mesh as one node shows it, in the bind pose and the axes of the scene.
struct Part {
  const aiMesh* mesh = nullptr;
  int node = 0;
  std::string name;
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;
  std::vector<Influences> influences;
  std::vector<glm::mat3> turns;  // scene_from_mesh of directions; for morph targets
  bool mirrored = false;
};

class ModelBuilder {
 public:
  ModelBuilder(const ModelScene& model, const ImportOptions& options, Content content)
      : model_(model),
        scene_(*model.scene),
        place_(model.file.string()),
        options_(options),
        content_(content) {}

  Result<BuiltModel> Build() {
    if (model_.gltf) {
      vrm_ = ReadVrm(*model_.gltf);
    }
    LARARIUM_ASSIGN_OR_RETURN(nodes_, ListNodes(model_));
    LARARIUM_RETURN_IF_ERROR(FindBindPose());
    if (content_ == Content::kFigure) {
      LARARIUM_RETURN_IF_ERROR(GatherParts());
    }
    LARARIUM_RETURN_IF_ERROR(MapSkeleton());
    LARARIUM_RETURN_IF_ERROR(Orient());
    LARARIUM_RETURN_IF_ERROR(BuildSkeleton());
    if (content_ == Content::kFigure) {
      AddMaterials();
      for (const Part& part : parts_) {
        AddPart(part);
      }
      LARARIUM_RETURN_IF_ERROR(AddMorphs());
      AddFace();
      AddSoftParts();
    }
    for (unsigned i = 0; i < scene_.mNumAnimations; ++i) {
      LARARIUM_RETURN_IF_ERROR(AddClip(*scene_.mAnimations[i]));
    }
    return Finish();
  }

 private:
  static constexpr int kNone = SceneNodes::kNoParent;

  human::Human& human() { return built_.human; }
  const Skeleton& skeleton() const { return built_.human.skeleton; }
  void Note(const std::string& note) { built_.notes.push_back(note); }
  size_t Parent(size_t node) const { return static_cast<size_t>(nodes_.parents[node]); }

  Result<BuiltModel> Finish() {
    human().name = options_.name.empty() ? model_.file.stem().string() : options_.name;
    human().credits = options_.credits;
    if (human().credits.empty() && vrm_) {
      human().credits = vrm_->credits;
    }
    LARARIUM_RETURN_IF_ERROR(human().Validate(place_));
    return std::move(built_);
  }

  // ---- The bind pose ---------------------------------------------------------------

  // Of each bone by its offset matrix. A mesh says where its bones were against one
  // another when it was bound; where the whole was, its topmost bone at rest tells.
  Status FindBindPose() {
    rest_.resize(nodes_.size());
    nodes_.Globals(nodes_.local, rest_);
    bind_ = rest_;
    std::vector<bool> known(nodes_.size(), false);
    std::vector<const aiMesh*> meshes(scene_.mMeshes, scene_.mMeshes + scene_.mNumMeshes);
    std::stable_sort(meshes.begin(), meshes.end(),
                     [](const aiMesh* a, const aiMesh* b) { return a->mNumBones > b->mNumBones; });
    for (const aiMesh* mesh : meshes) {
      LARARIUM_RETURN_IF_ERROR(BindBones(*mesh, known));
    }
    for (size_t n = 0; n < nodes_.size(); ++n) {
      if (!known[n] && nodes_.parents[n] != kNone) {
        bind_[n] = bind_[Parent(n)] * nodes_.local[n];
      }
      if (!human::Finite(bind_[n])) {
        return Status::Error(place_, "bone '" + nodes_.names[n] + "' is nowhere in space",
                             "export the figure again");
      }
    }
    return Status();
  }

  Status BindBones(const aiMesh& mesh, std::vector<bool>& known) {
    std::vector<int>& bones = bones_of_[&mesh];
    int anchor = kNone;
    glm::mat4 scene_from_mesh(1.0f);
    for (unsigned b = 0; b < mesh.mNumBones; ++b) {
      const int node = nodes_.Find(mesh.mBones[b]->mName);
      if (node == kNone) {
        return Status::Error(place_, std::string("bone '") + mesh.mBones[b]->mName.C_Str() +
                                         "' is not in the scene");
      }
      bones.push_back(node);
      const glm::mat4 offset = ToGlm(mesh.mBones[b]->mOffsetMatrix);
      const auto n = static_cast<size_t>(node);
      const bool better = anchor == kNone || (known[n] && !known[static_cast<size_t>(anchor)]) ||
                          (known[n] == known[static_cast<size_t>(anchor)] && node < anchor);
      if (Usable(offset) && better) {
        anchor = node;
        scene_from_mesh = (known[n] ? bind_[n] : rest_[n]) * offset;
      }
    }
    for (unsigned b = 0; b < mesh.mNumBones; ++b) {
      const auto n = static_cast<size_t>(bones[b]);
      const glm::mat4 offset = ToGlm(mesh.mBones[b]->mOffsetMatrix);
      if (!known[n] && Usable(offset)) {
        bind_[n] = scene_from_mesh * glm::inverse(offset);
        known[n] = true;
      }
    }
    return Status();
  }

  // ---- Parts -----------------------------------------------------------------------

  Status GatherParts() {
    for (size_t n = 0; n < nodes_.size(); ++n) {
      const aiNode& node = *nodes_.nodes[n];
      for (unsigned i = 0; i < node.mNumMeshes; ++i) {
        LARARIUM_RETURN_IF_ERROR(GatherPart(n, *scene_.mMeshes[node.mMeshes[i]]));
      }
    }
    if (model_.extension == ".bvh" || parts_.empty()) {
      return Status::Error(place_, "there is no mesh in it",
                           "import it as a clip, or export it with its mesh");
    }
    return Status();
  }

  Status GatherPart(size_t node, const aiMesh& mesh) {
    vertex_count_ += mesh.mNumVertices;
    if (vertex_count_ > kMaxVertices) {
      return Status::Error(place_,
                           "there are more than " + std::to_string(kMaxVertices) + " vertices",
                           "simplify the figure");
    }
    if (!mesh.HasPositions() || !mesh.HasNormals() || mesh.mNumFaces == 0) {
      return Status();
    }
    Part part;
    part.mesh = &mesh;
    part.node = static_cast<int>(node);
    part.name = nodes_.nodes[node]->mNumMeshes == 1
                    ? nodes_.names[node]
                    : nodes_.names[node] + "." + std::to_string(parts_.size());
    LARARIUM_RETURN_IF_ERROR(GatherWeights(part));
    return PlaceVertices(part);
  }

  Status GatherWeights(Part& part) {
    const aiMesh& mesh = *part.mesh;
    const std::vector<int>& bones = bones_of_.at(&mesh);
    part.influences.resize(mesh.mNumVertices);
    for (unsigned b = 0; b < mesh.mNumBones; ++b) {
      const aiBone& bone = *mesh.mBones[b];
      for (unsigned w = 0; w < bone.mNumWeights; ++w) {
        const aiVertexWeight& weight = bone.mWeights[w];
        if (weight.mVertexId >= mesh.mNumVertices || !std::isfinite(weight.mWeight)) {
          return Status::Error(
              place_, "part '" + part.name + "': a skin weight is not a number or names no vertex",
              "export the figure again");
        }
        Insert({bones[b], weight.mWeight}, part.influences[weight.mVertexId]);
      }
    }
    const int instead = bones.empty() ? part.node : *std::min_element(bones.begin(), bones.end());
    size_t bare = 0;
    for (Influences& influences : part.influences) {
      bare += influences[0].weight > 0.0f ? 0 : 1;
      Normalise(instead, influences);
    }
    // Assimp silently drops weights that are no numbers.
    return bones.empty() || 2 * bare < part.influences.size()
               ? Status()
               : Status::Error(place_,
                               "part '" + part.name + "': most of its vertices have no skin weight",
                               "export the figure again");
  }

  // Keeps the four largest, in descending order.
  static void Insert(Influence influence, Influences& influences) {
    for (Influence& slot : influences) {
      if (influence.weight > slot.weight) {
        std::swap(influence, slot);
      }
    }
  }

  static void Normalise(int instead, Influences& influences) {
    float sum = 0.0f;
    for (const Influence& influence : influences) {
      sum += influence.weight;
    }
    if (!(sum > 1e-6f) || !std::isfinite(sum)) {
      influences = {};
      influences[0] = {instead, 1.0f};
      return;
    }
    for (Influence& influence : influences) {
      influence.weight /= sum;
    }
  }

  // By linear blend skinning to the common bind pose: exact where all bones of a mesh
  // agree on where it is, and the best there is where it was bound in another pose.
  Status PlaceVertices(Part& part) {
    const aiMesh& mesh = *part.mesh;
    std::map<int, glm::mat4> scene_from_mesh;
    scene_from_mesh[part.node] = bind_[static_cast<size_t>(part.node)];
    const std::vector<int>& bones = bones_of_.at(&mesh);
    for (unsigned b = 0; b < mesh.mNumBones; ++b) {
      const glm::mat4 offset = ToGlm(mesh.mBones[b]->mOffsetMatrix);
      scene_from_mesh[bones[b]] =
          bind_[static_cast<size_t>(bones[b])] * (Usable(offset) ? offset : glm::mat4(1.0f));
    }
    part.positions.reserve(mesh.mNumVertices);
    part.normals.reserve(mesh.mNumVertices);
    part.turns.reserve(mesh.mNumAnimMeshes > 0 ? mesh.mNumVertices : 0);
    for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
      glm::mat4 blended(0.0f);
      for (const Influence& influence : part.influences[v]) {
        if (influence.weight > 0.0f) {
          blended += influence.weight * scene_from_mesh.at(influence.node);
        }
      }
      const glm::vec3 position = Apply(blended, ToGlm(mesh.mVertices[v]));
      if (!human::Finite(position)) {
        return Status::Error(place_, "part '" + part.name + "': a vertex is nowhere in space",
                             "export the figure again");
      }
      part.positions.push_back(position);
      part.normals.push_back(glm::mat3(blended) * ToGlm(mesh.mNormals[v]));
      if (mesh.mNumAnimMeshes > 0) {
        part.turns.emplace_back(blended);
      }
      part.mirrored = part.mirrored || glm::determinant(glm::mat3(blended)) < 0.0f;
    }
    parts_.push_back(std::move(part));
    return Status();
  }

  // ---- The skeleton ----------------------------------------------------------------

  // Candidates for joints: bones, what clips move, what the file calls a bone; with all
  // their ancestors, without FBX's pivots.
  Status MapSkeleton() {
    std::set<int> bones = Bones();
    if (bones.empty()) {
      for (size_t n = 0; n < nodes_.size(); ++n) {
        bones.insert(static_cast<int>(n));  // a puppet of rigid parts
      }
    }
    std::vector<bool> candidate(nodes_.size(), false);
    for (int node : bones) {
      for (; node != kNone && !candidate[static_cast<size_t>(node)];
           node = nodes_.parents[static_cast<size_t>(node)]) {
        candidate[static_cast<size_t>(node)] = true;
      }
    }
    std::vector<int> bone_of_node(nodes_.size(), Rig::kNoParent);
    for (size_t n = 0; n < nodes_.size(); ++n) {
      const int parent = nodes_.parents[n];
      const int above = parent == kNone ? Rig::kNoParent : bone_of_node[Parent(n)];
      bone_of_node[n] = above;  // of the nearest candidate
      if (candidate[n] && !nodes_.IsPivot(n)) {
        bone_of_node[n] = static_cast<int>(rig_.size());
        rig_.names.push_back(nodes_.names[n]);
        rig_.parents.push_back(above);
        rig_.positions.emplace_back(bind_[n][3]);
        node_of_bone_.push_back(static_cast<int>(n));
      }
    }
    map_ = MapBones(rig_, GivenMaps(bone_of_node));
    built_.is_human = map_.IsHuman();
    built_.bones = NamesOf(rig_, map_);
    built_.bone_table = Preview(rig_, map_);
    built_.joints = NamedBones(rig_, map_);
    built_.bone_names = rig_.names;
    if (Bones().empty() && !built_.is_human) {
      return Status::Error(place_, "no part of it is bound to a skeleton",
                           "import it as a prop, or export it with its armature");
    }
    return Status();
  }

  std::set<int> Bones() const {
    std::set<int> bones;
    for (const auto& [mesh, nodes] : bones_of_) {
      bones.insert(nodes.begin(), nodes.end());
    }
    if (content_ == Content::kMotion) {
      for (unsigned i = 0; i < scene_.mNumAnimations; ++i) {
        const aiAnimation& animation = *scene_.mAnimations[i];
        for (unsigned c = 0; c < animation.mNumChannels; ++c) {
          bones.insert(nodes_.Find(animation.mChannels[c]->mNodeName));
        }
      }
      bones.erase(kNone);
      // Ends of hands and feet tell where these point.
      for (size_t n = 0; n < nodes_.size(); ++n) {
        if (nodes_.parents[n] != kNone && bones.contains(nodes_.parents[n])) {
          bones.insert(static_cast<int>(n));
        }
      }
    }
    if (vrm_) {
      for (const auto& [joint, node] : vrm_->bones) {
        bones.insert(nodes_.FindGltf(node));
      }
      for (const Vrm::Spring& spring : vrm_->springs) {
        for (const size_t node : spring.nodes) {
          bones.insert(nodes_.FindGltf(node));
        }
      }
    }
    bones.erase(kNone);
    return bones;
  }

  std::vector<GivenBones> GivenMaps(const std::vector<int>& bone_of_node) {
    std::vector<GivenBones> given = {FindGiven(rig_, options_.bones)};
    for (const auto& [joint, bone] : options_.bones) {
      if (!bone.empty() && !rig_.Find(bone)) {
        Note("the bone map names '" + bone + "' for " + joint + ", which the figure does not have");
      }
    }
    if (vrm_) {
      GivenBones file;
      file.found_by = FoundBy::kFile;
      for (const auto& [joint, gltf_node] : vrm_->bones) {
        const int node = nodes_.FindGltf(gltf_node);
        const int bone = node == kNone ? kNone : bone_of_node[static_cast<size_t>(node)];
        if (bone != Rig::kNoParent && node_of_bone_[static_cast<size_t>(bone)] == node) {
          file.bones[joint] = bone;
        }
      }
      given.push_back(std::move(file));
    }
    return given;
  }

  // ---- Axes, units and place -------------------------------------------------------

  Status Orient() {
    glm::mat3 rotation(1.0f);
    if (const auto frame = FindFigureFrame(rig_, map_)) {
      rotation = frame->actor_from_scene;
      if (!frame->sides_fit_feet) {
        Note("its feet point backwards as left and right are named: check the bone map");
      }
    } else {
      rotation = glm::mat3(-1, 0, 0, 0, 1, 0, 0, 0, -1);
      Note("no human body was recognised; it is taken to stand Y up, facing +Z, as glTF's do");
    }
    glm::vec3 low, high;
    Bounds(rotation, low, high);
    LARARIUM_ASSIGN_OR_RETURN(const float scale, FindScale(high.y - low.y));
    glm::vec3 offset(0.0f);
    if (built_.is_human) {
      offset.y = std::abs(scale * low.y) < kWellPlaced ? 0.0f : -scale * low.y;
      const glm::vec3 hips = scale * (rotation * rig_.positions[map_.Find("humanoid_root")->bone]);
      if (std::hypot(hips.x, hips.z) > 0.25f) {
        offset.x = -hips.x;
        offset.z = -hips.z;
      }
    }
    actor_from_scene_ =
        glm::translate(glm::mat4(1.0f), offset) * glm::scale(glm::mat4(rotation), glm::vec3(scale));
    return human::Finite(actor_from_scene_)
               ? Status()
               : Status::Error(place_, "its size is not a number", "export the figure again");
  }

  // In actor axes and units of the file. Downwards only the legs count: a cloak may hang
  // lower, a spear stand deeper.
  void Bounds(const glm::mat3& rotation, glm::vec3& low, glm::vec3& high) const {
    low = glm::vec3(std::numeric_limits<float>::max());
    high = -low;
    bool legs_seen = false;
    const auto extend = [&](const glm::vec3& p, bool is_leg) {
      high = glm::max(high, p);
      if (is_leg && !legs_seen) {
        low = p;
        legs_seen = true;
      }
      low = is_leg || !legs_seen ? glm::min(low, p) : low;
    };
    for (const Part& part : parts_) {
      for (size_t v = 0; v < part.positions.size(); ++v) {
        extend(rotation * part.positions[v], IsLeg(part.influences[v][0].node));
      }
    }
    if (parts_.empty()) {
      for (size_t bone = 0; bone < rig_.size(); ++bone) {
        extend(rotation * rig_.positions[bone], IsLeg(node_of_bone_[bone]));
      }
    }
  }

  bool IsLeg(int node) const {
    for (const char* knee : {"r_knee", "l_knee"}) {
      const MappedBone* mapped = map_.Find(knee);
      if (mapped == nullptr) {
        return false;
      }
      const int top = node_of_bone_[mapped->bone];
      int up = node;
      while (up > top) {
        up = nodes_.parents[static_cast<size_t>(up)];
      }
      if (up == top) {
        return true;
      }
    }
    return false;
  }

  static bool Possible(float metres) { return metres > kLeast && metres < kMost; }

  Result<float> FindScale(float height) {
    if (!(height > 0.0f) || !std::isfinite(height)) {
      return Status::Error(place_, "the figure has no height", "export it again");
    }
    if (options_.metres_per_unit) {
      return *options_.metres_per_unit;
    }
    const float stated = model_.StatedMetresPerUnit();
    if (!built_.is_human) {
      return stated;
    }
    if (model_.HasUnits() || content_ == Content::kFigure) {
      if (Possible(stated * height)) {
        return stated;
      }
      float best = 0.0f;
      for (const float scale : {1.0f, 0.01f, 0.001f, 0.0254f, 0.3048f}) {
        const auto far = [&](float s) { return std::abs(std::log(s * height / kStature)); };
        if (Possible(scale * height) && (best == 0.0f || far(scale) < far(best))) {
          best = scale;
        }
      }
      if (best > 0.0f) {
        Note("its unit is taken to be " + std::to_string(best) + " m, for a height of " +
             std::to_string(best * height) + " m");
        return best;
      }
      Note("no unit gives a possible height; it is made 1.75 m tall");
    }
    return kStature / height;
  }

  // ---- Joints ----------------------------------------------------------------------

  // What is mapped, moves vertices or swings, and what lies between.
  std::vector<bool> NeededBones() const {
    std::set<int> nodes;
    for (const Part& part : parts_) {
      for (const Influences& influences : part.influences) {
        for (const Influence& influence : influences) {
          nodes.insert(influence.weight > 0.0f ? influence.node : kNone);
        }
      }
    }
    if (vrm_) {
      for (const Vrm::Spring& spring : vrm_->springs) {
        for (const size_t node : spring.nodes) {
          nodes.insert(nodes_.FindGltf(node));
        }
      }
    }
    const std::set<int> bones = Bones();
    std::vector<bool> needed(rig_.size(), false);
    for (size_t bone = 0; bone < rig_.size(); ++bone) {
      const int node = node_of_bone_[bone];
      const bool moves = content_ == Content::kMotion ? bones.contains(node) : nodes.contains(node);
      needed[bone] = moves && (bones.contains(node) || bones.empty());
    }
    for (const MappedBone& mapped : map_.bones) {
      needed[mapped.bone] = true;
    }
    return needed;
  }

  Status BuildSkeleton() {
    std::vector<bool> needed = NeededBones();
    std::vector<bool> has_needed_below = needed;
    for (size_t bone = rig_.size(); bone-- > 0;) {
      if (has_needed_below[bone] && rig_.parents[bone] != Rig::kNoParent) {
        has_needed_below[static_cast<size_t>(rig_.parents[bone])] = true;
      }
    }
    std::vector<int> joint_of_bone(rig_.size(), Skeleton::kNoParent);
    size_t count = 0;
    for (size_t bone = 0; bone < rig_.size(); ++bone) {
      const int above = rig_.parents[bone] == Rig::kNoParent
                            ? int{Skeleton::kNoParent}
                            : joint_of_bone[static_cast<size_t>(rig_.parents[bone])];
      joint_of_bone[bone] = above;
      if (needed[bone] || (above != Skeleton::kNoParent && has_needed_below[bone])) {
        if (++count <= Skeleton::kMaxJoints) {
          joint_of_bone[bone] = AddJoint(bone, above);
        }
      }
    }
    if (count == 0) {
      return Status::Error(place_, "no bone of it moves anything", "export it with its armature");
    }
    if (count > Skeleton::kMaxJoints) {
      return Status::Error(place_,
                           "its skeleton needs " + std::to_string(count) + " joints, more than " +
                               std::to_string(Skeleton::kMaxJoints),
                           "remove bones of hair, clothes or face before exporting");
    }
    joint_of_node_.assign(nodes_.size(), 0);
    for (size_t bone = 0; bone < rig_.size(); ++bone) {
      joint_of_node_[static_cast<size_t>(node_of_bone_[bone])] = std::max(joint_of_bone[bone], 0);
    }
    std::vector<bool> is_candidate(nodes_.size(), false);
    for (const int node : node_of_bone_) {
      is_candidate[static_cast<size_t>(node)] = true;
    }
    for (size_t n = 0; n < nodes_.size(); ++n) {
      if (!is_candidate[n] && nodes_.parents[n] != kNone) {
        joint_of_node_[n] = joint_of_node_[Parent(n)];
      }
    }
    return Status();
  }

  int AddJoint(size_t bone, int parent) {
    const auto node = static_cast<size_t>(node_of_bone_[bone]);
    Skeleton& skeleton = human().skeleton;
    std::string name = rig_.names[bone].substr(0, 256);
    for (const MappedBone& mapped : map_.bones) {
      name = mapped.bone == bone ? mapped.joint : name;
    }
    const bool is_mapped = map_.Find(name) != nullptr && map_.Find(name)->bone == bone;
    if (name.empty() || skeleton.Find(name) || (!is_mapped && map_.Find(name) != nullptr)) {
      name += "#" + std::to_string(skeleton.size());
    }
    const glm::vec3 position = Apply(actor_from_scene_, glm::vec3(bind_[node][3]));
    human::JointTransform rest;
    rest.translation =
        parent == Skeleton::kNoParent ? position : position - joint_position_[size_t(parent)];
    skeleton.names.push_back(name);
    skeleton.parents.push_back(static_cast<int16_t>(parent));
    skeleton.rest.push_back(rest);
    skeleton.joint_from_actor.push_back(glm::translate(glm::mat4(1.0f), -position));
    joint_position_.push_back(position);
    node_of_joint_.push_back(node);
    return static_cast<int>(skeleton.size()) - 1;
  }

  size_t JointOf(int node) const {
    return static_cast<size_t>(joint_of_node_[static_cast<size_t>(node)]);
  }

  // ---- Surfaces --------------------------------------------------------------------

  void AddMaterials() {
    std::set<unsigned> used;
    for (const Part& part : parts_) {
      used.insert(part.mesh->mMaterialIndex);
    }
    material_of_.assign(scene_.mNumMaterials, human::Material::kNone);
    for (const unsigned index : used) {
      if (index < scene_.mNumMaterials && human().materials.size() < 1000) {
        material_of_[index] = static_cast<int16_t>(human().materials.size());
        AddMaterial(*scene_.mMaterials[index]);
      }
    }
  }

  void AddMaterial(const aiMaterial& source) {
    human::Material material;
    material.name = source.GetName().C_Str();
    material.surface = SurfaceOf(material.name);
    material.colour = ColourOf(source);
    int two_sided = 0;
    material.two_sided = source.Get(AI_MATKEY_TWOSIDED, two_sided) == AI_SUCCESS && two_sided != 0;
    float roughness = material.roughness;
    if (source.Get(AI_MATKEY_ROUGHNESS_FACTOR, roughness) == AI_SUCCESS && roughness >= 0.0f) {
      material.roughness = std::min(roughness, 1.0f);
    }
    if (IsMetal(source) && material.surface == human::Surface::kPlain) {
      material.surface = human::Surface::kMetal;
    }
    BuiltModel::Use use;
    use.colour = FindImage(source, {aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE});
    use.normal = FindImage(source, {aiTextureType_NORMALS});
    SetAlpha(source, use.colour >= 0, material);
    human().materials.push_back(material);
    built_.uses.push_back(use);
  }

  // As glTF says it. Which texels of a texture are metal is not asked.
  static bool IsMetal(const aiMaterial& material) {
    float metallic = 0.0f;
    return material.Get(AI_MATKEY_METALLIC_FACTOR, metallic) == AI_SUCCESS && metallic >= 0.5f &&
           material.GetTextureCount(aiTextureType_METALNESS) == 0;
  }

  glm::vec3 ColourOf(const aiMaterial& material) const {
    aiColor4D colour;
    if (material.Get(AI_MATKEY_BASE_COLOR, colour) != AI_SUCCESS &&
        material.Get(AI_MATKEY_COLOR_DIFFUSE, colour) != AI_SUCCESS) {
      return glm::vec3(1.0f);
    }
    glm::vec3 result(colour.r, colour.g, colour.b);
    for (int c = 0; c < 3; ++c) {
      result[c] = std::isfinite(result[c]) ? std::clamp(result[c], 0.0f, 1.0f) : 1.0f;
      result[c] = model_.gltf ? result[c] : LinearFromSrgb(result[c]);
    }
    return result;
  }

  void SetAlpha(const aiMaterial& source, bool textured, human::Material& material) {
    aiString mode;
    float cutoff = 0.5f;
    if (source.Get(AI_MATKEY_GLTF_ALPHAMODE, mode) == AI_SUCCESS) {
      source.Get(AI_MATKEY_GLTF_ALPHACUTOFF, cutoff);
      const bool blends = mode == aiString("BLEND");
      if (mode == aiString("MASK") || (blends && textured)) {
        material.alpha_cutoff = std::isfinite(cutoff) ? std::clamp(cutoff, 0.01f, 1.0f) : 0.5f;
      }
    } else if (textured && source.GetTextureCount(aiTextureType_OPACITY) > 0) {
      material.alpha_cutoff = 0.5f;
    }
  }

  // The index of an image, added if it is new; -1 where there is none that can be used.
  int FindImage(const aiMaterial& material, std::initializer_list<aiTextureType> types) {
    aiString path;
    for (const aiTextureType type : types) {
      if (material.GetTexture(type, 0, &path) == AI_SUCCESS && path.length > 0) {
        const std::string uri = path.C_Str();
        if (const auto found = image_of_uri_.find(uri); found != image_of_uri_.end()) {
          return found->second;
        }
        const int index = AddImage(uri);
        image_of_uri_[uri] = index;
        return index;
      }
    }
    return -1;
  }

  int AddImage(const std::string& uri) {
    BuiltModel::Image image;
    image.name = uri.substr(0, 256);
    if (const aiTexture* embedded = scene_.GetEmbeddedTexture(uri.c_str())) {
      if (embedded->mHeight != 0) {
        Note("texture '" + image.name + "' is embedded as bare pixels, which is not supported");
        return -1;
      }
      const auto* begin = reinterpret_cast<const std::byte*>(embedded->pcData);
      image.encoded.assign(begin, begin + embedded->mWidth);
      image.name = embedded->mFilename.length > 0 ? embedded->mFilename.C_Str() : image.name;
    } else {
      const std::filesystem::path file = FindTexture(model_.file, uri);
      auto bytes = file.empty() ? Result<std::vector<std::byte>>(
                                      Status::Error(image.name, "is not in the model's folder"))
                                : ReadBytes(file, size_t{256} << 20);
      if (!bytes.ok()) {
        Note("texture " + bytes.message());
        return -1;
      }
      image.encoded = std::move(*bytes);
      image.name = file.filename().string();
    }
    built_.images.push_back(std::move(image));
    return static_cast<int>(built_.images.size()) - 1;
  }

  // ---- Meshes ----------------------------------------------------------------------

  void AddPart(const Part& part) {
    const aiMesh& mesh = *part.mesh;
    human::SkinnedMesh skinned;
    skinned.name = part.name;
    skinned.material = mesh.mMaterialIndex < material_of_.size() ? material_of_[mesh.mMaterialIndex]
                                                                 : human::Material::kNone;
    const glm::mat3 turn = glm::mat3(actor_from_scene_);
    const glm::vec3 colour = VertexColour(skinned.material);
    for (size_t v = 0; v < part.positions.size(); ++v) {
      skinned.positions.push_back(Apply(actor_from_scene_, part.positions[v]));
      skinned.normals.push_back(Unit(turn * part.normals[v]));
      skinned.albedo.push_back(colour * Clamped(mesh, v));
      std::array<uint8_t, 4> joints = {};
      glm::vec4 weights(0.0f);
      for (int k = 0; k < 4; ++k) {
        const Influence& influence = part.influences[v][static_cast<size_t>(k)];
        if (influence.weight > 0.0f) {
          joints[static_cast<size_t>(k)] = static_cast<uint8_t>(JointOf(influence.node));
          weights[k] = influence.weight;
        }
      }
      skinned.joints.push_back(joints);
      skinned.weights.push_back(weights);
    }
    AddUvs(mesh, skinned);
    AddTriangles(part, skinned);
    human().meshes.push_back(std::move(skinned));
  }

  static glm::vec3 Unit(const glm::vec3& v) {
    const float length = glm::length(v);
    return length > 1e-12f && std::isfinite(length) ? v / length : glm::vec3(0.0f, 1.0f, 0.0f);
  }

  // A plain material's colour goes to the vertices, a textured one's stays with it.
  glm::vec3 VertexColour(int16_t material) {
    if (material == human::Material::kNone ||
        built_.uses[static_cast<size_t>(material)].colour >= 0) {
      return glm::vec3(1.0f);
    }
    if (plain_colour_.empty()) {
      for (human::Material& m : human().materials) {
        plain_colour_.push_back(m.colour);
      }
      for (size_t i = 0; i < plain_colour_.size(); ++i) {
        if (built_.uses[i].colour < 0) {
          human().materials[i].colour = glm::vec3(1.0f);
        }
      }
    }
    return plain_colour_[static_cast<size_t>(material)];
  }

  static glm::vec3 Clamped(const aiMesh& mesh, size_t v) {
    if (!mesh.HasVertexColors(0)) {
      return glm::vec3(1.0f);
    }
    const aiColor4D& c = mesh.mColors[0][v];
    const glm::vec3 colour(c.r, c.g, c.b);
    return human::Finite(colour) ? glm::clamp(colour, 0.0f, 1.0f) : glm::vec3(1.0f);
  }

  // Assimp counts v from the bottom.
  static void AddUvs(const aiMesh& mesh, human::SkinnedMesh& skinned) {
    if (!mesh.HasTextureCoords(0)) {
      return;
    }
    for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
      const glm::vec2 uv(mesh.mTextureCoords[0][v].x, 1.0f - mesh.mTextureCoords[0][v].y);
      skinned.uvs.push_back(human::Finite(uv) ? uv : glm::vec2(0.0f));
    }
  }

  static void AddTriangles(const Part& part, human::SkinnedMesh& skinned) {
    for (unsigned f = 0; f < part.mesh->mNumFaces; ++f) {
      const aiFace& face = part.mesh->mFaces[f];
      if (face.mNumIndices == 3) {
        const unsigned* i = face.mIndices;
        skinned.indices.insert(skinned.indices.end(),
                               {i[0], i[part.mirrored ? 2 : 1], i[part.mirrored ? 1 : 2]});
      }
    }
  }

  // ---- The face --------------------------------------------------------------------

  // The glTF mesh of a part ("m<i>" or "m<i>-<primitive>"); none for other formats.
  std::optional<size_t> GltfMesh(const Part& part) const {
    const std::string name = part.mesh->mName.C_Str();
    if (!model_.gltf || name.size() < 2 || name.size() > 16 || name[0] != 'm' ||
        std::isdigit(static_cast<unsigned char>(name[1])) == 0) {
      return std::nullopt;
    }
    return std::stoul(name.substr(1));
  }

  // Parts share a target where its name is theirs in common; in a VRM, whose expressions
  // name meshes, only the primitives of one mesh do.
  Status AddMorphs() {
    size_t deltas = 0;
    for (size_t p = 0; p < parts_.size(); ++p) {
      const Part& part = parts_[p];
      const auto gltf_mesh = GltfMesh(part);
      const std::vector<std::string> names =
          gltf_mesh ? model_.gltf->TargetNames(*gltf_mesh) : std::vector<std::string>();
      for (unsigned t = 0; t < part.mesh->mNumAnimMeshes; ++t) {
        std::string name = t < names.size() ? names[t] : part.mesh->mAnimMeshes[t]->mName.C_Str();
        if (name.empty()) {
          name = "target " + std::to_string(t);
        }
        const std::string key =
            vrm_ && gltf_mesh ? std::to_string(*gltf_mesh) + "/" + std::to_string(t) : name;
        LARARIUM_ASSIGN_OR_RETURN(human::MorphTarget::Part moved,
                                  Morph(p, *part.mesh->mAnimMeshes[t]));
        deltas += moved.vertices.size();
        if (deltas > kMaxMorphDeltas || human().morphs.size() > 4096) {
          return Status::Error(place_, "its morph targets are too many or too large",
                               "remove those that are not needed");
        }
        human::MorphTarget& target = TargetFor(key, name, static_cast<uint32_t>(p));
        if (!moved.vertices.empty()) {
          target.parts.push_back(std::move(moved));
        }
      }
    }
    return Status();
  }

  human::MorphTarget& TargetFor(std::string key, const std::string& name, uint32_t mesh) {
    const auto has_mesh = [&](const human::MorphTarget& target) {
      return std::any_of(target.parts.begin(), target.parts.end(),
                         [&](const auto& part) { return part.mesh == mesh; });
    };
    while (morph_of_.contains(key) && has_mesh(human().morphs[morph_of_.at(key)])) {
      key += "'";  // one mesh with two targets of one name
    }
    if (!morph_of_.contains(key)) {
      morph_of_[key] = static_cast<uint32_t>(human().morphs.size());
      human().morphs.push_back({name.substr(0, 256), {}});
    }
    return human().morphs[morph_of_.at(key)];
  }

  Result<human::MorphTarget::Part> Morph(size_t p, const aiAnimMesh& target) const {
    const Part& part = parts_[p];
    human::MorphTarget::Part moved;
    moved.mesh = static_cast<uint32_t>(p);
    if (!target.HasPositions() || target.mNumVertices != part.mesh->mNumVertices) {
      return moved;
    }
    const glm::mat3 turn = glm::mat3(actor_from_scene_);
    for (unsigned v = 0; v < target.mNumVertices; ++v) {
      const glm::mat3 actor_from_mesh = turn * part.turns[v];
      const glm::vec3 delta =
          actor_from_mesh * (ToGlm(target.mVertices[v]) - ToGlm(part.mesh->mVertices[v]));
      if (!human::Finite(delta)) {
        return Status::Error(place_, "part '" + part.name + "': a morph target is not a number",
                             "export the figure again");
      }
      if (glm::length(delta) < kSmallestDelta) {
        continue;
      }
      glm::vec3 normal_delta(0.0f);
      if (target.HasNormals()) {
        normal_delta = Unit(actor_from_mesh * ToGlm(target.mNormals[v])) -
                       Unit(actor_from_mesh * ToGlm(part.mesh->mNormals[v]));
      }
      moved.vertices.push_back(v);
      moved.position_deltas.push_back(delta);
      moved.normal_deltas.push_back(human::Finite(normal_delta) ? normal_delta : glm::vec3(0.0f));
    }
    return moved;
  }

  void AddFace() {
    std::vector<ForeignShape> shapes;
    if (vrm_) {
      for (const Vrm::Expression& expression : vrm_->expressions) {
        ForeignShape shape{expression.name, {}};
        for (const Vrm::Expression::Bind& bind : expression.binds) {
          const auto morph =
              morph_of_.find(std::to_string(bind.mesh) + "/" + std::to_string(bind.target));
          if (morph != morph_of_.end()) {
            shape.morphs.push_back({morph->second, bind.weight});
          }
        }
        shapes.push_back(std::move(shape));
      }
    }
    for (size_t m = 0; m < human().morphs.size(); ++m) {
      shapes.push_back({human().morphs[m].name, {{static_cast<uint32_t>(m), 1.0f}}});
    }
    std::optional<uint32_t> jaw;
    if (const auto joint = skeleton().Find("temporomandibular")) {
      jaw = static_cast<uint32_t>(*joint);
    }
    human().face = ComposeFace(shapes, jaw);
    if (!shapes.empty() && human().face.empty()) {
      Note("no expression or viseme was recognised among its " + std::to_string(shapes.size()) +
           " morph targets");
    }
  }

  // ---- What swings -----------------------------------------------------------------

  // A VRM spring moves once in 1/60 s by stiffness/60 towards the pose and keeps
  // 1 - drag of its velocity; for a bone of length l that is an acceleration of
  // 60 stiffness / l per radian under a drag of -60 ln(1 - drag).
  void AddSoftParts() {
    if (!vrm_) {
      return;
    }
    constexpr float kRate = 60.0f;
    for (const Vrm::Spring& spring : vrm_->springs) {
      human::SpringChain chain;
      chain.name = spring.name.empty() ? "spring" : spring.name;
      float length = 0.0f;
      for (const size_t gltf_node : spring.nodes) {
        const int node = nodes_.FindGltf(gltf_node);
        const auto joint = static_cast<uint32_t>(node == kNone ? 0 : JointOf(node));
        const bool follows = chain.joints.empty() ||
                             skeleton().parents[joint] == static_cast<int>(chain.joints.back());
        if (node == kNone || !follows || node_of_joint_[joint] != static_cast<size_t>(node)) {
          break;
        }
        if (!chain.joints.empty()) {
          length += glm::length(skeleton().rest[joint].translation);
        }
        chain.joints.push_back(joint);
      }
      if (chain.joints.size() < 2) {
        continue;
      }
      length = std::max(length / static_cast<float>(chain.joints.size() - 1), 0.01f);
      chain.stiffness = kRate * spring.stiffness / length;
      chain.drag = -kRate * std::log(1.0f - spring.drag);
      chain.gravity = kRate * spring.gravity / 9.81f;
      chain.radius = spring.radius;
      human().springs.push_back(std::move(chain));
    }
    for (const Vrm::Collider& collider : vrm_->colliders) {
      AddCollider(collider);
    }
  }

  void AddCollider(const Vrm::Collider& collider) {
    const int node = nodes_.FindGltf(collider.node);
    if (node == kNone) {
      return;
    }
    const size_t joint = JointOf(node);
    const glm::mat4 actor_from_node = actor_from_scene_ * bind_[static_cast<size_t>(node)];
    human::BodyCapsule capsule;
    capsule.joint = static_cast<uint32_t>(joint);
    capsule.a = Apply(actor_from_node, collider.a) - joint_position_[joint];
    capsule.b = Apply(actor_from_node, collider.b) - joint_position_[joint];
    capsule.radius_a = capsule.radius_b = collider.radius * ScaleOf(actor_from_node);
    if (capsule.Validate(skeleton().size(), place_).ok()) {
      human().capsules.push_back(capsule);
    }
  }

  // ---- Clips -----------------------------------------------------------------------

  Status AddClip(const aiAnimation& animation) {
    const AnimationSampler sampler(animation, nodes_);
    const double duration = sampler.duration();
    const std::string name = ClipName(animation.mName.C_Str());
    if (!std::isfinite(duration) || duration < 0.0 || duration > kMaxClipSeconds) {
      return Status::Error(place_, "clip '" + name + "' has an impossible duration");
    }
    const auto intervals =
        static_cast<size_t>(std::max(1.0, std::round(duration * options_.keys_per_second)));
    const size_t keys = duration > 0.0 ? intervals + 1 : 1;
    key_count_ += keys * skeleton().size();
    sample_count_ += keys * nodes_.size();
    if (key_count_ > kMaxKeys || sample_count_ > kMaxSamples) {
      return Status::Error(place_, "the clips are too long", "split or shorten them");
    }
    human::Clip clip;
    clip.name = name;
    clip.duration = static_cast<float>(duration);
    clip.keys_per_second = duration > 0.0
                               ? static_cast<float>(static_cast<double>(intervals) / duration)
                               : options_.keys_per_second;
    std::vector<glm::mat4> local = nodes_.local, scene_from_node(nodes_.size());
    for (size_t key = 0; key < keys; ++key) {
      const double at =
          keys > 1 ? duration * static_cast<double>(key) / static_cast<double>(intervals) : 0.0;
      sampler.Sample(at, local);
      nodes_.Globals(local, scene_from_node);
      LARARIUM_RETURN_IF_ERROR(AddKey(scene_from_node, clip));
    }
    clip.loops = EndsWhereItBegins(clip);
    human().clips.push_back(std::move(clip));
    return Status();
  }

  // "Armature|Walk" is Walk.
  std::string ClipName(std::string name) const {
    if (const size_t bar = name.rfind('|'); bar != std::string::npos) {
      name.erase(0, bar + 1);
    }
    name = name.empty() ? "clip " + std::to_string(built_.human.clips.size() + 1)
                        : name.substr(0, 256);
    const auto taken = [&](const human::Clip& clip) { return clip.name == name; };
    while (std::any_of(built_.human.clips.begin(), built_.human.clips.end(), taken)) {
      name += "'";
    }
    return name;
  }

  // One pose of the file's nodes as transforms between our joints. A joint's frame is the
  // actor's, moved to where the joint is bound, and then as the node moved from there.
  Status AddKey(const std::vector<glm::mat4>& scene_from_node, human::Clip& clip) const {
    const glm::mat4 scene_from_actor = glm::inverse(actor_from_scene_);
    std::vector<human::JointTransform> globals(skeleton().size());
    for (size_t joint = 0; joint < globals.size(); ++joint) {
      const size_t node = node_of_joint_[joint];
      human::JointTransform& global = globals[joint];
      if (Usable(bind_[node])) {
        const glm::mat4 motion = actor_from_scene_ * scene_from_node[node] *
                                 glm::inverse(bind_[node]) * scene_from_actor;
        global = Decompose(motion * glm::translate(glm::mat4(1.0f), joint_position_[joint]));
      } else {
        global.translation = Apply(actor_from_scene_, glm::vec3(scene_from_node[node][3]));
      }
      if (std::abs(global.scale.x - 1.0f) < 1e-4f) {
        global.scale = glm::vec3(1.0f);
      }
      clip.keys.push_back(Local(globals, joint));
      if (!human::Valid(clip.keys.back())) {
        return Status::Error(place_,
                             "clip '" + clip.name + "': joint '" + skeleton().names[joint] +
                                 "' has an impossible key",
                             "export the clip again");
      }
    }
    return Status();
  }

  human::JointTransform Local(const std::vector<human::JointTransform>& globals,
                              size_t joint) const {
    const int16_t parent = skeleton().parents[joint];
    if (parent == Skeleton::kNoParent) {
      return globals[joint];
    }
    const human::JointTransform& above = globals[static_cast<size_t>(parent)];
    const human::JointTransform& global = globals[joint];
    const glm::quat back = glm::conjugate(above.rotation);
    const float scale = std::max(above.scale.x, 1e-6f);
    return {glm::normalize(back * global.rotation),
            back * (global.translation - above.translation) / scale, global.scale / scale};
  }

  bool EndsWhereItBegins(const human::Clip& clip) const {
    const size_t joint_count = skeleton().size();
    const size_t last = clip.keys.size() - joint_count;
    for (size_t joint = 0; joint < joint_count; ++joint) {
      const human::JointTransform& a = clip.keys[joint];
      const human::JointTransform& b = clip.keys[last + joint];
      if (!(std::abs(glm::dot(a.rotation, b.rotation)) > 1.0f - 1e-5f) ||
          !(glm::distance(a.translation, b.translation) < 1e-3f)) {
        return false;
      }
    }
    return last > 0;
  }

  const ModelScene& model_;
  const aiScene& scene_;
  std::string place_;
  const ImportOptions& options_;
  Content content_;
  std::optional<Vrm> vrm_;

  SceneNodes nodes_;
  std::vector<glm::mat4> rest_, bind_;  // scene_from_node: as the nodes say; as skins say
  std::map<const aiMesh*, std::vector<int>> bones_of_;
  std::vector<Part> parts_;

  Rig rig_;
  std::vector<int> node_of_bone_;
  BoneMap map_;
  glm::mat4 actor_from_scene_ = glm::mat4(1.0f);

  std::vector<int> joint_of_node_;  // or of the nearest node above that is a joint
  std::vector<size_t> node_of_joint_;
  std::vector<glm::vec3> joint_position_;  // bind pose, actor frame

  std::vector<int16_t> material_of_;
  std::vector<glm::vec3> plain_colour_;
  std::map<std::string, int> image_of_uri_;
  std::map<std::string, uint32_t> morph_of_;
  size_t vertex_count_ = 0, key_count_ = 0, sample_count_ = 0;
  BuiltModel built_;
};

void AppendBlock(std::vector<std::byte>& bytes, std::span<const std::byte> block) {
  const uint64_t size = block.size();
  const auto* begin = reinterpret_cast<const std::byte*>(&size);
  bytes.insert(bytes.end(), begin, begin + sizeof(size));
  bytes.insert(bytes.end(), block.begin(), block.end());
}

// The next block; empty and at the end where there is none.
std::span<const std::byte> TakeBlock(std::span<const std::byte>& bytes) {
  uint64_t size = 0;
  if (bytes.size() < sizeof(size)) {
    return bytes = {};
  }
  std::memcpy(&size, bytes.data(), sizeof(size));
  bytes = bytes.subspan(sizeof(size));
  if (size > bytes.size()) {
    return bytes = {};
  }
  const auto block = bytes.first(size);
  bytes = bytes.subspan(size);
  return block;
}

}  // namespace

Result<BuiltModel> BuildModel(const ModelScene& model,
                              const ImportOptions& options,
                              Content content) {
  return ModelBuilder(model, options, content).Build();
}

Result<std::vector<std::byte>> PackModel(const BuiltModel& model) {
  Json head = {{"bones", model.bones},           {"is_human", model.is_human},
               {"bone_table", model.bone_table}, {"notes", model.notes},
               {"images", Json::array()},        {"uses", Json::array()},
               {"joints", Json::array()},        {"bone_names", model.bone_names}};
  for (const NamedBone& named : model.joints) {
    head["joints"].push_back(
        {named.joint, named.bone, static_cast<int>(named.found_by), named.confidence});
  }
  for (const BuiltModel::Image& image : model.images) {
    head["images"].push_back(image.name);
  }
  for (const BuiltModel::Use& use : model.uses) {
    head["uses"].push_back({use.colour, use.normal});
  }
  const std::string text = head.dump(-1, ' ', false, Json::error_handler_t::replace);
  std::vector<std::byte> bytes;
  AppendBlock(bytes, std::as_bytes(std::span(text)));
  AppendBlock(bytes, human::SerializeHuman(model.human));
  for (const BuiltModel::Image& image : model.images) {
    AppendBlock(bytes, image.encoded);
  }
  return bytes;
}

Result<BuiltModel> UnpackModel(std::span<const std::byte> bytes, const std::string& place) {
  const auto text = TakeBlock(bytes);
  LARARIUM_ASSIGN_OR_RETURN(
      const Json head, ParseJson({reinterpret_cast<const char*>(text.data()), text.size()}, place));
  BuiltModel model;
  LARARIUM_ASSIGN_OR_RETURN(model.human, human::ParseHuman(TakeBlock(bytes), place));
  // Written by PackModel in the child, which a hostile file may have taken over.
  try {
    model.bones = head.at("bones").get<BoneNames>();
    model.is_human = head.at("is_human").get<bool>();
    model.bone_table = head.at("bone_table").get<std::string>();
    model.bone_names = head.at("bone_names").get<std::vector<std::string>>();
    for (const Json& named : head.at("joints")) {
      const int found_by =
          std::clamp(named.at(2).get<int>(), 0, static_cast<int>(FoundBy::kStructure));
      model.joints.push_back({named.at(0).get<std::string>(), named.at(1).get<std::string>(),
                              static_cast<FoundBy>(found_by), named.at(3).get<float>()});
    }
    model.notes = head.at("notes").get<std::vector<std::string>>();
    for (const Json& name : head.at("images")) {
      const auto block = TakeBlock(bytes);
      model.images.push_back({name.get<std::string>(), {block.begin(), block.end()}});
    }
    const auto images = static_cast<int>(model.images.size());
    for (const Json& use : head.at("uses")) {
      model.uses.push_back({use.at(0).get<int>(), use.at(1).get<int>()});
      if (model.uses.back().colour >= images || model.uses.back().normal >= images) {
        return Status::Error(place, "its reader's answer makes no sense");
      }
    }
  } catch (const Json::exception&) {
    return Status::Error(place, "its reader's answer makes no sense");
  }
  if (model.uses.size() != model.human.materials.size()) {
    return Status::Error(place, "its reader's answer makes no sense");
  }
  return model;
}

}  // namespace lararium::import
