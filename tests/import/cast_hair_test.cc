// Hair, mouths and complexion of the cast, on shapes small enough to compute by hand.

#include "editor/import/cast/cast_hair.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "editor/import/cast/cast_complexion.h"
#include "editor/import/cast/cast_hang.h"
#include "editor/import/cast/cast_mouth.h"
#include "editor/import/cast/cast_subdivide.h"
#include "shared/core/units.h"
#include "shared/human/skinning.h"
#include "shared/human/spring.h"

namespace lararium::import {
namespace {

// Fills in the attributes of all vertices of a piece.
void Complete(CastPiece& piece) {
  const size_t count = piece.mesh.positions.size();
  for (size_t v = piece.source.size(); v < count; ++v) {
    piece.source.push_back(static_cast<uint32_t>(v));
  }
  piece.base.resize(count, {0, 1, 2});
  piece.base_weights.resize(count, glm::vec3(1, 0, 0));
  piece.mesh.albedo.resize(count, glm::vec3(1.0f));
  piece.mesh.uvs.resize(count, glm::vec2(0.0f));
  piece.mesh.joints.resize(count, {0, 0, 0, 0});
  piece.mesh.weights.resize(count, glm::vec4(1, 0, 0, 0));
  piece.mesh.normals.resize(count, glm::vec3(0, 1, 0));
}

CastPiece Octahedron() {
  CastPiece piece;
  piece.mesh.positions = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  piece.mesh.indices = {0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5};
  Complete(piece);
  return piece;
}

// Adds a sheet of columns x rows vertices.
template <typename Place>
void AddSheet(CastPiece& piece, uint32_t columns, uint32_t rows, const Place& place) {
  const auto first = static_cast<uint32_t>(piece.mesh.positions.size());
  for (uint32_t r = 0; r < rows; ++r) {
    for (uint32_t c = 0; c < columns; ++c) {
      piece.mesh.positions.push_back(place(float(c) / float(columns - 1), float(r) / (rows - 1)));
    }
  }
  for (uint32_t r = 0; r + 1 < rows; ++r) {
    for (uint32_t c = 0; c + 1 < columns; ++c) {
      const uint32_t a = first + r * columns + c;
      const uint32_t b = a + columns;
      piece.mesh.indices.insert(piece.mesh.indices.end(), {a, b, a + 1, a + 1, b, b + 1});
    }
  }
  Complete(piece);
}

std::vector<bool> All(const CastPiece& piece) {
  return std::vector<bool>(piece.mesh.indices.size() / 3, true);
}

// A corner of valence 4 moves to (1 - 4b) v + b sum(neighbours), b = 3/32; the middle of an
// edge to 3/8 of its ends and 1/8 of the opposite vertices.
TEST(SubdivideLoop, MovesAnOctahedronAsLoopsMasksSay) {
  CastPiece piece = Octahedron();
  SubdivideLoop(piece, All(piece));
  ASSERT_EQ(piece.mesh.positions.size(), 6u + 12u);
  ASSERT_EQ(piece.mesh.indices.size(), 3u * 32u);
  EXPECT_LT(glm::distance(piece.mesh.positions[2], glm::vec3(0.0f, 0.625f, 0.0f)), 1e-6f);
  for (size_t v = 6; v < 18; ++v) {
    EXPECT_NEAR(glm::length(piece.mesh.positions[v]), 0.375f * std::sqrt(2.0f), 1e-6f);
  }
  EXPECT_TRUE(piece.mesh.Validate(1, 0, "octahedron").ok());
}

TEST(SubdivideLoop, LeavesAFlatSheetFlatAndItsStraightEdgesStraight) {
  CastPiece piece;
  AddSheet(piece, 5, 5, [](float u, float v) { return glm::vec3(u, 0.3f, v); });
  SubdivideLoop(piece, All(piece));
  for (const glm::vec3& p : piece.mesh.positions) {
    EXPECT_NEAR(p.y, 0.3f, 1e-6f);
    EXPECT_GE(std::min(p.x, p.z), -1e-6f);
    EXPECT_LE(std::max(p.x, p.z), 1.0f + 1e-6f);
  }
}

TEST(SubdivideLoop, KeepsSeamsClosed) {
  // The first and last columns of the tube share their positions and have separate coordinates.
  CastPiece piece;
  AddSheet(piece, 9, 4, [](float u, float v) {
    return glm::vec3(std::cos(2 * kPiF * u), v, std::sin(2 * kPiF * u));
  });
  for (uint32_t r = 0; r < 4; ++r) {
    piece.source[9 * r + 8] = 9 * r;
    piece.mesh.positions[9 * r + 8] = piece.mesh.positions[9 * r];
    for (uint32_t c = 0; c < 9; ++c) {
      piece.mesh.uvs[9 * r + c] = {float(c) / 8.0f, float(r) / 3.0f};
    }
  }
  SubdivideLoop(piece, All(piece));
  size_t doubled = 0;
  for (size_t a = 0; a < piece.source.size(); ++a) {
    for (size_t b = a + 1; b < piece.source.size(); ++b) {
      if (piece.source[a] == piece.source[b]) {
        ++doubled;
        EXPECT_EQ(piece.mesh.positions[a], piece.mesh.positions[b]);
        EXPECT_NEAR(std::abs(piece.mesh.uvs[a].x - piece.mesh.uvs[b].x), 1.0f, 1e-6f);
      }
    }
  }
  EXPECT_EQ(doubled, 7u);
}

TEST(SmoothSurfaces, CutsWhatIsCoarseAndLeavesWhatIsFineOrWouldBeTooMuch) {
  CastPiece piece = Octahedron();
  for (glm::vec3& p : piece.mesh.positions) {
    p *= 0.05f;
  }
  const size_t coarse = piece.mesh.indices.size();
  AddSheet(piece, 6, 6, [](float u, float v) { return glm::vec3(1 + 0.01f * u, 0, 0.01f * v); });
  const size_t fine = piece.mesh.indices.size() - coarse;
  CastPiece bounded = piece;
  SmoothSurfaces(piece, {.edge = 0.007f, .levels = 1, .triangles = 1000});
  EXPECT_EQ(piece.mesh.indices.size(), 4 * coarse + fine);
  SmoothSurfaces(bounded, {.edge = 0.007f, .levels = 3, .triangles = 60});
  EXPECT_EQ(bounded.mesh.indices.size(), coarse + fine);
  EXPECT_EQ(ConnectedSurfaces(bounded).back(), 1u);
}

// A head with a radius of 10 cm about a height of 1.6 m, on a neck.
FittedBody Head() {
  FittedBody body;
  const auto add = [&body](const char* name, int16_t parent, const glm::vec3& place,
                           const glm::vec3& before) {
    body.skeleton.names.emplace_back(name);
    body.skeleton.parents.push_back(parent);
    body.skeleton.rest.push_back({.translation = place - before});
    body.skeleton.joint_from_actor.push_back(glm::translate(glm::mat4(1.0f), -place));
  };
  const glm::vec3 neck(0.0f, 1.45f, 0.0f);
  add("vc7", human::Skeleton::kNoParent, neck, glm::vec3(0.0f));
  add("skullbase", 0, {0.0f, 1.55f, 0.0f}, neck);
  for (int i = 0; i < 40; ++i) {
    for (int k = 0; k < 20; ++k) {
      const float a = 2 * kPiF * i / 40.0f;
      const float b = kPiF * k / 19.0f;
      body.skin.positions.push_back(
          glm::vec3(0, 1.6f, 0) +
          0.1f * glm::vec3(std::sin(b) * std::cos(a), std::cos(b), std::sin(b) * std::sin(a)));
    }
  }
  body.capsules.push_back({1, {0, 0.05f, 0}, {0, 0.05f, 0}, 0.1f, 0.1f});
  return body;
}

// A cap on the head, optionally with a tail 30 cm long behind it.
CastPiece Hair(bool tail) {
  CastPiece hair;
  hair.mesh.name = "tail";
  AddSheet(hair, 9, 6, [](float u, float v) {
    const float a = kPiF * u;
    const float b = 0.2f + 1.2f * v;
    return glm::vec3(0, 1.6f, 0) +
           0.104f * glm::vec3(std::sin(b) * std::cos(a), std::cos(b), std::sin(b) * std::sin(a));
  });
  if (tail) {
    AddSheet(hair, 4, 21, [](float u, float v) {
      return glm::vec3(0.04f * (u - 0.5f), 1.62f - 0.3f * v, 0.13f + 0.02f * v);
    });
  }
  for (auto& joints : hair.mesh.joints) {
    joints.fill(1);
  }
  return hair;
}

human::Human Tailed() {
  const FittedBody body = Head();
  CastPiece hair = Hair(true);
  human::Human human;
  human.name = "tailed";
  human.skeleton = body.skeleton;
  human.springs = HangHair(hair, body, human.skeleton);
  human.meshes.push_back(hair.mesh);
  human.capsules = body.capsules;
  return human;
}

TEST(HangHair, LaysOneChainAlongATailAndLeavesTheCap) {
  const human::Human human = Tailed();
  EXPECT_TRUE(human.Validate("tailed").ok());
  ASSERT_EQ(human.springs.size(), 1u);
  const std::vector<uint32_t>& joints = human.springs[0].joints;
  EXPECT_EQ(joints.size(), 5u);  // Each is 6 cm long.
  EXPECT_EQ(human.skeleton.parents[joints[0]], 1);
  float before = 1.7f;
  for (const uint32_t joint : joints) {
    const glm::vec3 place(glm::inverse(human.skeleton.joint_from_actor[joint])[3]);
    EXPECT_NEAR(place.x, 0.0f, 0.005f);
    EXPECT_NEAR(place.z, 0.14f, 0.015f);
    EXPECT_LT(place.y, before - 0.03f);
    before = place.y;
  }
  for (size_t v = 0; v < 54; ++v) {
    EXPECT_EQ(human.meshes[0].joints[v][0], 1) << v;
  }
  EXPECT_EQ(human.meshes[0].joints.back()[0], joints.back());
}

TEST(HangHair, FindsNothingInACap) {
  const FittedBody body = Head();
  CastPiece hair = Hair(false);
  human::Skeleton skeleton = body.skeleton;
  EXPECT_TRUE(HangHair(hair, body, skeleton).empty());
  EXPECT_EQ(skeleton.size(), body.skeleton.size());
}

TEST(HangHair, LeavesTheBindPoseAsItIs) {
  const human::Human human = Tailed();
  std::vector<glm::mat4> joints(human.skeleton.size());
  std::vector<glm::mat4> skin(human.skeleton.size());
  ComputeActorFromJoint(human.skeleton, human.skeleton.rest, joints);
  ComputeSkinMatrices(human.skeleton, joints, skin);
  const human::SkinnedMesh& mesh = human.meshes[0];
  std::vector<glm::vec3> positions(mesh.positions.size());
  std::vector<glm::vec3> normals(mesh.positions.size());
  SkinMesh(mesh, skin, positions, normals, human::Skinning::kLinear);
  for (size_t v = 0; v < positions.size(); ++v) {
    EXPECT_LT(glm::distance(positions[v], mesh.positions[v]), 1e-6f);
  }
}

struct Nodding {
  explicit Nodding(human::Human person)
      : human(std::move(person)), model(human), state(model), joints(human.skeleton.size()) {}

  // `pitch` rotates the head about x; positive lifts the face.
  void Step(float pitch) {
    pose = human.skeleton.rest;
    pose[1].rotation = glm::angleAxis(pitch, glm::vec3(1, 0, 0));
    ComputeActorFromJoint(human.skeleton, pose, joints);
    human::SpringStep step;
    step.stage_from_actor = stage_from_actor;
    step.elapsed = 1.0f / 60.0f;
    StepSprings(model, step, state, pose, joints);
  }
  glm::vec3 Tip() const { return glm::vec3(joints[human.springs[0].joints.back()][3]); }

  human::Human human;
  human::SpringModel model;
  human::SpringState state;
  std::vector<human::JointTransform> pose;
  std::vector<glm::mat4> joints;
  glm::mat4 stage_from_actor{1.0f};
};

TEST(HangHair, FallsAsTheHeadBowsAndStaysOutsideIt) {
  Nodding person(Tailed());
  for (int frame = 0; frame < 300; ++frame) {
    person.Step(-0.9f * std::min(1.0f, float(frame) / 30.0f));
    const glm::mat4& skull = person.joints[1];
    const glm::vec3 middle(skull * glm::vec4(0, 0.05f, 0, 1));
    for (size_t i = 1; i < person.human.springs[0].joints.size(); ++i) {
      const glm::vec3 p(person.joints[person.human.springs[0].joints[i]][3]);
      EXPECT_GT(glm::distance(p, middle), 0.1f) << frame;
    }
  }
  // Stiff hair would stand behind the bowed head; the last joint hangs much lower.
  const glm::mat4& skull = person.joints[1];
  const glm::mat4 bound = person.human.skeleton.joint_from_actor[1];
  const glm::vec3 rest_tip(glm::inverse(
      person.human.skeleton.joint_from_actor[person.human.springs[0].joints.back()])[3]);
  const glm::vec3 stiff(skull * bound * glm::vec4(rest_tip, 1.0f));
  EXPECT_LT(person.Tip().y, stiff.y - 0.03f);
}

TEST(HangHair, HangsQuietRightAfterATeleport) {
  Nodding person(Tailed());
  for (int frame = 0; frame < 240; ++frame) {
    person.Step(0.0f);
  }
  const glm::vec3 before = person.Tip();
  person.stage_from_actor = glm::translate(glm::mat4(1.0f), glm::vec3(30.0f, 0.0f, -4.0f));
  for (int frame = 0; frame < 30; ++frame) {
    person.Step(0.0f);
    EXPECT_LT(glm::distance(person.Tip(), before), 0.01f) << frame;
  }
}

// A skirt of simulated cloth, with a belt around it and the end of a cord, which are not
// simulated.
Garment Belted() {
  CastPiece piece;
  piece.mesh.name = "tunic";
  AddSheet(piece, 6, 6, [](float u, float v) { return glm::vec3(0.4f * u, 1.0f - 0.5f * v, 0); });
  const size_t skirt = piece.mesh.positions.size();
  AddSheet(piece, 6, 2, [](float u, float v) { return glm::vec3(0.4f * u, 1.0f + 0.1f * v, 0); });
  AddSheet(piece, 3, 9,
           [](float u, float v) { return glm::vec3(0.2f + 0.01f * u, 1.0f - 0.16f * v, -0.02f); });
  Garment garment;
  garment.mesh = piece.mesh;
  garment.cloth.emplace();
  garment.cloth->vertex_triangle.assign(piece.mesh.positions.size(), human::Cloth::kUnbound);
  std::fill_n(garment.cloth->vertex_triangle.begin(), skirt, 0u);
  return garment;
}

TEST(HangTails, TakesTheEndOfACordAndNeitherSkirtNorBelt) {
  Garment garment = Belted();
  human::Skeleton skeleton = Head().skeleton;
  const size_t before = skeleton.size();
  const std::vector<human::SpringChain> chains = HangTails(garment, skeleton);
  ASSERT_EQ(chains.size(), 1u);
  EXPECT_EQ(chains[0].joints.size(), skeleton.size() - before);
  EXPECT_EQ(skeleton.parents[chains[0].joints[0]], 0);
  const glm::vec3 root(glm::inverse(skeleton.joint_from_actor[chains[0].joints[0]])[3]);
  EXPECT_LT(glm::distance(root, glm::vec3(0.205f, 1.0f, -0.02f)), 1e-4f);
  for (size_t v = 0; v < 48; ++v) {
    EXPECT_EQ(garment.mesh.joints[v][0], 0) << v;
  }
  EXPECT_EQ(garment.mesh.joints.back()[0], chains[0].joints.back());
}

TEST(HangTails, FindsNothingWhereAllIsCloth) {
  Garment garment = Belted();
  garment.cloth->vertex_triangle.assign(garment.mesh.positions.size(), 0u);
  human::Skeleton skeleton = Head().skeleton;
  EXPECT_TRUE(HangTails(garment, skeleton).empty());
  garment.cloth.reset();
  EXPECT_TRUE(HangTails(garment, skeleton).empty());
}

TEST(CoverOver, IsWhatThePictureCoversAtTheHit) {
  human::SkinnedMesh hair;
  hair.positions = {{-1, 0.01f, -1}, {1, 0.01f, -1}, {-1, 0.01f, 1}, {1, 0.01f, 1}};
  hair.uvs = {{0, 0}, {1, 0}, {0, 1}, {1, 1}};
  hair.indices = {0, 1, 2, 1, 3, 2};
  const Coverage halves{2, 1, {0, 255}};
  const glm::vec3 up(0, 1, 0);
  EXPECT_EQ(CoverOver({-0.5f, 0, 0}, up, hair, halves), 0.0f);
  EXPECT_EQ(CoverOver({0.5f, 0, 0}, up, hair, halves), 1.0f);
  // Without a picture everything is covered.
  EXPECT_EQ(CoverOver({-0.5f, 0, 0}, up, hair, {}), 1.0f);
  EXPECT_EQ(CoverOver({0.5f, -0.05f, 0}, up, hair, halves), 0.0f);  // Too far away.
  EXPECT_EQ(CoverOver({0.5f, 0, 0}, -up, hair, halves), 0.0f);
}

TEST(ShadeMouth, DarkensTheMoreTheFartherInAndOnlyTheMouth) {
  std::vector<CastPiece> pieces(3);
  pieces[0].mesh.name = "skin";
  // The outer and inner side of the lip, the throat, and a nose.
  pieces[0].mesh.positions = {
      {0, 1.50f, -0.105f}, {0, 1.495f, -0.102f}, {0, 1.50f, -0.06f}, {0, 1.55f, -0.12f}};
  pieces[0].mesh.normals = {{0, 0, -1}, {0, 0, 1}, {0, 0, -1}, {0, 0, -1}};
  pieces[1].mesh.name = "teeth";
  pieces[1].mesh.positions = {{0, 1.505f, -0.10f}, {-0.02f, 1.49f, -0.06f}, {0.02f, 1.5f, -0.08f}};
  pieces[1].mesh.normals.assign(3, {0, 0, -1});
  pieces[2].mesh.name = "tongue";
  pieces[2].mesh.positions = {{0, 1.5f, -0.09f}, {0, 1.5f, -0.06f}};
  pieces[2].mesh.normals.assign(2, {0, 1, 0});
  for (CastPiece& piece : pieces) {
    piece.mesh.albedo.assign(piece.mesh.positions.size(), glm::vec3(1.0f));
  }
  ShadeMouth(pieces, "teeth", "tongue");
  const std::vector<glm::vec3>& skin = pieces[0].mesh.albedo;
  EXPECT_EQ(skin[0], glm::vec3(1.0f));
  EXPECT_LT(skin[1].r, 0.5f);
  EXPECT_LT(skin[2].r, 0.05f);
  EXPECT_EQ(skin[3], glm::vec3(1.0f));
  EXPECT_GT(pieces[1].mesh.albedo[0].r, 0.6f);
  EXPECT_LT(pieces[1].mesh.albedo[1].r, 0.05f);
  EXPECT_LT(pieces[1].mesh.albedo[2].r, pieces[1].mesh.albedo[0].r);
  EXPECT_GT(pieces[2].mesh.albedo[0].r, pieces[2].mesh.albedo[1].r);
}

}  // namespace
}  // namespace lararium::import
