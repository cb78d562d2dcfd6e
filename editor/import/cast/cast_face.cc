#include "editor/import/cast/cast_face.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <string>

#include "editor/import/cast/cast_shape.h"

namespace lararium::import {
namespace {

// Smaller displacements and changes of shading are invisible.
constexpr float kLeastMove = 4e-5f;  // metres
constexpr float kLeastTilt = 0.02f;  // Change of a unit normal.

// An expression unit of the library; units with a left and a right target combine both.
struct Unit {
  const char* name;
  const char* targets[2];
};

constexpr Unit kUnits[] = {
    {"jaw_open", {"mouth-open", nullptr}},
    {"lips_press", {"mouth-compression", nullptr}},
    {"corners_pull", {"mouth-corner-puller", nullptr}},
    {"corners_depress", {"mouth-depression", nullptr}},
    {"lips_stretch_down", {"mouth-depression-retraction", nullptr}},
    {"lips_raise", {"mouth-elevation", nullptr}},
    {"lips_evert", {"mouth-eversion", nullptr}},
    {"lips_roll", {"mouth-parling", nullptr}},
    {"lips_part", {"mouth-part-later", nullptr}},
    {"lips_protrude", {"mouth-protusion", nullptr}},
    {"lips_purse", {"mouth-pursing", nullptr}},
    {"lips_stretch", {"mouth-retraction", nullptr}},
    {"lips_stretch_up", {"mouth-upward-retraction", nullptr}},
    {"neck_tense", {"neck-platysma", nullptr}},
    {"nose_compress", {"nose-compression", nullptr}},
    {"nose_lower", {"nose-depression", nullptr}},
    {"nostrils_flare", {"nose-left-dilatation", "nose-right-dilatation"}},
    {"nose_wrinkle", {"nose-left-elevation", "nose-right-elevation"}},
    {"lid_close_l", {"eye-left-closure", nullptr}},
    {"lid_close_r", {"eye-right-closure", nullptr}},
    {"lids_widen", {"eye-left-opened-up", "eye-right-opened-up"}},
    {"lids_tighten", {"eye-left-slit", "eye-right-slit"}},
    {"brows_lower", {"eyebrows-left-down", "eyebrows-right-down"}},
    {"brows_raise", {"eyebrows-left-up", "eyebrows-right-up"}},
    {"brows_raise_inner", {"eyebrows-left-inner-up", "eyebrows-right-inner-up"}},
    {"brows_raise_outer", {"eyebrows-left-extern-up", "eyebrows-right-extern-up"}},
};

// The weight of each unit in a shape, and the rotation of tongue and jaw (degrees, about the x
// axis: up). Visemes: which articulators close or round for which sounds is textbook phonetics,
// in the order of the usual set of 15. Expressions: the action units that Ekman & Friesen
// (Facial Action Coding System, 1978) observe with the six emotions.
struct Ingredient {
  const char* unit;
  float weight;
};
struct Shape {
  const char* name;
  std::vector<Ingredient> units;
  float tongue_base_degrees = 0.0f;
  float tongue_tip_degrees = 0.0f;
};

const std::vector<Shape>& Shapes() {
  static const std::vector<Shape> shapes = {
      {"sil", {{"lips_press", 0.12f}}},
      {"PP", {{"lips_press", 0.4f}, {"lips_purse", 0.3f}}},
      {"FF", {{"lips_raise", 0.45f}, {"lips_press", 0.35f}, {"jaw_open", 0.04f}}},
      {"TH", {{"jaw_open", 0.2f}, {"lips_part", 0.12f}, {"tongue_out", 1.0f}}, 4.0f},
      {"DD", {{"jaw_open", 0.16f}, {"lips_part", 0.18f}}, 10.0f, 25.0f},
      {"kk", {{"jaw_open", 0.26f}, {"lips_part", 0.1f}}, 14.0f, -10.0f},
      {"CH", {{"lips_protrude", 0.7f}, {"lips_part", 0.25f}, {"jaw_open", 0.06f}}},
      {"SS", {{"lips_stretch", 0.5f}, {"lips_part", 0.45f}}},
      {"nn", {{"jaw_open", 0.1f}, {"lips_part", 0.25f}, {"lips_stretch", 0.2f}}, 10.0f, 25.0f},
      {"RR", {{"lips_protrude", 0.45f}, {"lips_purse", 0.3f}, {"jaw_open", 0.15f}}, 8.0f, 15.0f},
      {"aa", {{"jaw_open", 0.75f}}, -4.0f},
      {"E", {{"jaw_open", 0.36f}, {"lips_stretch", 0.55f}}},
      {"ih", {{"jaw_open", 0.18f}, {"lips_stretch", 0.6f}, {"lips_part", 0.08f}}, 6.0f},
      {"oh", {{"jaw_open", 0.45f}, {"lips_purse", 0.55f}, {"lips_protrude", 0.25f}}},
      {"ou", {{"lips_purse", 1.0f}, {"lips_protrude", 0.2f}, {"jaw_open", 0.1f}}},
      {"joy",
       {{"corners_pull", 0.85f},
        {"lips_stretch_up", 0.45f},
        {"lips_part", 0.08f},
        {"lids_tighten", 0.4f},
        {"brows_raise", 0.2f},
        {"brows_raise_outer", 0.2f}}},
      {"sadness",
       {{"brows_raise_inner", 1.5f},
        {"corners_depress", 1.1f},
        {"lips_evert", 0.35f},
        {"lids_tighten", 0.35f}}},
      {"anger",
       {{"brows_lower", 1.3f},
        {"lids_widen", 0.35f},
        {"lips_press", 0.9f},
        {"corners_depress", 0.45f},
        {"nostrils_flare", 1.0f},
        {"nose_wrinkle", 0.5f}}},
      {"fear",
       {{"brows_raise", 0.8f},
        {"brows_raise_inner", 1.2f},
        {"lids_widen", 1.1f},
        {"lips_stretch", 0.8f},
        {"lips_stretch_down", 0.4f},
        {"neck_tense", 0.5f},
        {"jaw_open", 0.22f}}},
      {"disgust",
       {{"nose_wrinkle", 1.5f},
        {"nose_compress", 0.6f},
        {"lips_raise", 0.65f},
        {"corners_depress", 0.5f},
        {"brows_lower", 0.7f},
        {"lids_tighten", 0.5f}}},
      {"surprise",
       {{"brows_raise", 1.2f},
        {"brows_raise_inner", 0.7f},
        {"lids_widen", 1.0f},
        {"jaw_open", 0.7f},
        {"lips_purse", 0.25f}}},
      {"blink_l", {{"lid_close_l", 1.0f}}},
      {"blink_r", {{"lid_close_r", 1.0f}}},
  };
  return shapes;
}

// The distance between eyes and chin, with which the movement of a unit grows.
float FaceLength(const CastLibrary& library, std::span<const glm::vec3> positions) {
  glm::vec3 eyes(0.0f);
  glm::vec3 chin(0.0f);
  for (const CastBone& bone : library.base().bones) {
    glm::vec3 head(0.0f);
    for (const uint32_t v : bone.head_vertices) {
      head += positions[v] / static_cast<float>(bone.head_vertices.size());
    }
    if (bone.name == "eye.L" || bone.name == "eye.R") {
      eyes += 0.5f * head;
    } else if (bone.name == "special04") {
      chin = head;
    }
  }
  return glm::distance(eyes, chin);
}

// The effect of a movement of base vertices on one piece; empty if there is none.
human::MorphTarget::Part PartOf(uint32_t mesh,
                                const CastPiece& piece,
                                std::span<const glm::vec3> base_deltas,
                                float scale) {
  human::MorphTarget::Part part;
  part.mesh = mesh;
  std::vector<glm::vec3> moved = piece.mesh.positions;
  bool moves = false;
  for (size_t v = 0; v < moved.size(); ++v) {
    glm::vec3 delta(0.0f);
    for (int corner = 0; corner < 3; ++corner) {
      delta += piece.base_weights[v][corner] * base_deltas[piece.base[v][corner]];
    }
    moved[v] += scale * delta;
    moves = moves || scale * glm::length(delta) > kLeastMove;
  }
  if (!moves) {
    return part;
  }
  const std::vector<glm::vec3> before =
      SmoothNormals(piece.mesh.positions, piece.source, piece.mesh.indices);
  const std::vector<glm::vec3> after = SmoothNormals(moved, piece.source, piece.mesh.indices);
  for (size_t v = 0; v < moved.size(); ++v) {
    const glm::vec3 delta = moved[v] - piece.mesh.positions[v];
    const glm::vec3 tilt = after[v] - before[v];
    if (glm::length(delta) > kLeastMove || glm::length(tilt) > kLeastTilt) {
      part.vertices.push_back(static_cast<uint32_t>(v));
      part.position_deltas.push_back(delta);
      part.normal_deltas.push_back(tilt);
    }
  }
  return part;
}

// The tip of the tongue between the teeth, for which the library has no unit.
human::MorphTarget TongueOut(std::span<const CastPiece> pieces,
                             const std::string& tongue,
                             float scale) {
  const glm::vec3 kOut(0.0f, 0.002f, -0.014f);  // Metres, for the tip of an adult's tongue.
  human::MorphTarget morph;
  morph.name = "tongue_out";
  for (size_t i = 0; i < pieces.size(); ++i) {
    const human::SkinnedMesh& mesh = pieces[i].mesh;
    if (mesh.name != tongue || mesh.positions.empty()) {
      continue;
    }
    const auto behind = [](const glm::vec3& a, const glm::vec3& b) { return a.z < b.z; };
    const auto [tip, root] =
        std::minmax_element(mesh.positions.begin(), mesh.positions.end(), behind);
    human::MorphTarget::Part part;
    part.mesh = static_cast<uint32_t>(i);
    for (size_t v = 0; v < mesh.positions.size(); ++v) {
      const float share = (root->z - mesh.positions[v].z) / std::max(root->z - tip->z, 1e-4f);
      part.vertices.push_back(static_cast<uint32_t>(v));
      part.position_deltas.push_back(scale * share * share * kOut);
      part.normal_deltas.emplace_back(0.0f);
    }
    morph.parts.push_back(std::move(part));
  }
  return morph;
}

void AddTurn(const human::Skeleton& skeleton,
             const char* joint,
             float degrees,
             human::FaceShape& shape) {
  const auto index = skeleton.Find(joint);
  if (degrees != 0.0f && index) {
    const glm::quat turn = glm::angleAxis(glm::radians(degrees), glm::vec3(1.0f, 0.0f, 0.0f));
    shape.turns.push_back({static_cast<uint32_t>(*index), turn});
  }
}

human::FaceShape Compose(const Shape& recipe, const human::Human& human) {
  human::FaceShape shape;
  shape.name = recipe.name;
  for (const Ingredient& ingredient : recipe.units) {
    for (size_t m = 0; m < human.morphs.size(); ++m) {
      if (human.morphs[m].name == ingredient.unit) {
        shape.morphs.push_back({static_cast<uint32_t>(m), ingredient.weight});
      }
    }
  }
  AddTurn(human.skeleton, "tongue_base", recipe.tongue_base_degrees, shape);
  AddTurn(human.skeleton, "tongue_tip", recipe.tongue_tip_degrees, shape);
  return shape;
}

}  // namespace

void AddFace(const CastLibrary& library,
             const CastRecipe& recipe,
             const BaseShape& shape,
             std::span<const CastPiece> pieces,
             human::Human& human) {
  const float scale =
      FaceLength(library, shape.positions) / FaceLength(library, UnshapedBase(library));
  for (const Unit& unit : kUnits) {
    std::vector<TargetShare> shares;
    for (const char* target : unit.targets) {
      if (target != nullptr) {
        const std::vector<TargetShare> more = UnitShares(library, recipe, target);
        shares.insert(shares.end(), more.begin(), more.end());
      }
    }
    const std::vector<glm::vec3> deltas = TargetDeltas(library, shares);
    human::MorphTarget morph;
    morph.name = unit.name;
    for (size_t i = 0; i < pieces.size(); ++i) {
      human::MorphTarget::Part part = PartOf(static_cast<uint32_t>(i), pieces[i], deltas, scale);
      if (!part.vertices.empty()) {
        morph.parts.push_back(std::move(part));
      }
    }
    human.morphs.push_back(std::move(morph));
  }
  human.morphs.push_back(TongueOut(pieces, recipe.tongue, scale));
  for (const Shape& shape : Shapes()) {
    human.face.push_back(Compose(shape, human));
  }
}

}  // namespace lararium::import
