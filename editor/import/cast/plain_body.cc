#include "editor/import/cast/plain_body.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

#include "editor/import/cast/implicit_surface.h"
#include "editor/import/cast/plain_shapes.h"
#include "editor/import/cast/plain_skin.h"
#include "shared/core/parallel.h"

namespace lararium::import {
namespace {

// One closed surface of a part.
struct Piece {
  size_t part;
  DistanceField solid;  // The solid to triangulate.
  Box box;
  float cell;  // metres
  // Overlapping pieces take normals from the solid that they share, so that no seam is visible.
  DistanceField shading;
  std::function<glm::vec3(const glm::vec3&)> albedo;
  std::function<JointShares(const glm::vec3&)> weights;
  bool both_sides = false;  // Modelled on the right, mirrored to the left.
};

enum BodyPart : size_t { kSkinPart, kHairPart, kTunicPart, kBeltPart, kSandalsPart, kPartCount };
constexpr const char* kPartNames[kPartCount] = {"skin", "hair", "tunic", "belt", "sandals"};

// ---- Colours ----

glm::vec3 FaceAlbedo(const glm::vec3& p, const PlainFigureOptions& options) {
  const glm::vec3 q = FoldX(p);
  glm::vec3 albedo = options.skin;
  const auto paint = [&](const glm::vec3& colour, float share) {
    albedo = glm::mix(albedo, colour, glm::clamp(share, 0.0f, 1.0f));
  };
  if (p.z > 0.0f) {
    return albedo;
  }
  const float cheek = glm::length((q - glm::vec3(0.042f, 1.575f, -0.065f)) / 0.026f);
  paint(options.skin * glm::vec3(1.10f, 0.86f, 0.82f), 0.6f * (1.0f - cheek));
  const float beard = glm::smoothstep(1.566f, 1.545f, p.y) * glm::smoothstep(1.485f, 1.505f, p.y);
  paint(options.skin * 0.72f, 0.45f * beard);
  const glm::vec2 mouth((q.x) / 0.023f, (p.y - 1.5485f) / 0.0095f);
  paint(options.skin * glm::vec3(0.82f, 0.58f, 0.58f), 3.0f * (1.0f - glm::length(mouth)));
  const float lip_line = std::abs(p.y - 1.5480f + 2.0f * q.x * q.x);
  paint(options.skin * 0.30f, (1.0f - lip_line / 0.0028f) * glm::smoothstep(0.026f, 0.020f, q.x));
  const glm::vec2 brow((q.x - 0.031f) / 0.022f,
                       (p.y - 1.631f + 4.0f * (q.x - 0.034f) * (q.x - 0.034f)) / 0.0065f);
  paint(options.hair, 2.0f * (1.0f - glm::length(brow)));
  const glm::vec2 lid((q.x - kPlainEye.x) / 0.0155f, (p.y - kPlainEye.y) / 0.0070f);
  paint(options.skin * 0.35f, 2.5f * (1.0f - glm::length(lid)));
  const glm::vec2 ball((q.x - kPlainEye.x) / 0.0125f, (p.y - kPlainEye.y) / 0.0042f);
  paint(glm::vec3(0.42f, 0.39f, 0.36f), 3.0f * (1.0f - glm::length(ball)));
  const glm::vec2 iris((q.x - kPlainEye.x) / 0.0058f, (p.y - kPlainEye.y) / 0.0060f);
  paint(glm::vec3(0.045f, 0.028f, 0.018f), 4.0f * (1.0f - glm::length(iris)));
  return albedo;
}

// ---- Assembly ----

// The data that the pieces refer to.
struct Body {
  Body(const human::Skeleton& skeleton, const PlainFigureOptions& figure_options)
      : options(figure_options), arm(skeleton), tunic(arm), skin(skeleton) {}

  PlainFigureOptions options;
  PlainArm arm;
  PlainLeg leg;
  PlainTunic tunic;
  PlainSkin skin;
};

// The face has finer cells than the rest of the head.
void AddHead(const Body& body, std::vector<Piece>& pieces) {
  const auto albedo = [&body](const glm::vec3& p) { return FaceAlbedo(p, body.options); };
  const auto weights = [&body](const glm::vec3& p) { return body.skin.Spine(p); };
  const auto face_side = [](const glm::vec3& p) {
    return std::max({p.z + 0.030f, 1.498f - p.y, p.y - 1.69f});
  };
  const DistanceField face = [=](const glm::vec3& p) {
    return SmoothIntersection(PlainHead(p), face_side(p), 0.004f);
  };
  const DistanceField rest = [=](const glm::vec3& p) {
    return SmoothIntersection(PlainHead(p), -face_side(p) - 0.010f, 0.006f);
  };
  pieces.push_back({kSkinPart,
                    face,
                    {{-0.08f, 1.48f, -0.13f}, {0.08f, 1.70f, -0.02f}},
                    0.0036f,
                    PlainHead,
                    albedo,
                    weights});
  pieces.push_back({kSkinPart,
                    rest,
                    {{-0.19f, 1.21f, -0.10f}, {0.19f, 1.73f, 0.14f}},
                    0.0100f,
                    PlainHead,
                    albedo,
                    weights});
  pieces.push_back({kHairPart,
                    PlainHair,
                    {{-0.11f, 1.50f, -0.12f}, {0.11f, 1.74f, 0.14f}},
                    0.0085f,
                    PlainHair,
                    [&body](const glm::vec3&) { return body.options.hair; },
                    weights});
}

void AddArms(const Body& body, std::vector<Piece>& pieces) {
  const DistanceField whole = [&body](const glm::vec3& p) { return body.arm.Distance(p); };
  const auto albedo = [&body](const glm::vec3&) { return body.options.skin; };
  const auto weights = [&body](const glm::vec3& p) { return body.skin.Arm(p, body.arm); };
  const DistanceField limb = [&body, whole](const glm::vec3& p) {
    return SmoothIntersection(whole(p), body.arm.BeyondWrist(p) - 0.004f, 0.003f);
  };
  const DistanceField hand = [&body, whole](const glm::vec3& p) {
    return SmoothIntersection(whole(p), -body.arm.BeyondWrist(p) - 0.004f, 0.003f);
  };
  pieces.push_back({kSkinPart,
                    limb,
                    {{0.10f, 0.90f, -0.08f}, {0.52f, 1.47f, 0.11f}},
                    0.0120f,
                    whole,
                    albedo,
                    weights,
                    true});
  pieces.push_back({kSkinPart,
                    hand,
                    {{0.38f, 0.73f, -0.13f}, {0.58f, 0.96f, 0.07f}},
                    0.0065f,
                    whole,
                    albedo,
                    weights,
                    true});
}

void AddLegs(const Body& body, std::vector<Piece>& pieces) {
  const DistanceField whole = [&body](const glm::vec3& p) { return body.leg.Distance(p); };
  const DistanceField sandal = [&body](const glm::vec3& p) { return body.leg.Sandal(p); };
  const auto weights = [&body](const glm::vec3& p) { return body.skin.Leg(p); };
  const DistanceField limb = [whole](const glm::vec3& p) {
    return SmoothIntersection(whole(p), 0.101f - p.y, 0.004f);
  };
  const DistanceField foot = [whole](const glm::vec3& p) {
    return SmoothIntersection(whole(p), p.y - 0.109f, 0.004f);
  };
  const auto skin = [&body](const glm::vec3&) { return body.options.skin; };
  pieces.push_back({kSkinPart,
                    limb,
                    {{0.0f, 0.08f, -0.10f}, {0.19f, 0.88f, 0.11f}},
                    0.0170f,
                    whole,
                    skin,
                    weights,
                    true});
  pieces.push_back({kSkinPart,
                    foot,
                    {{0.03f, 0.0f, -0.21f}, {0.17f, 0.16f, 0.10f}},
                    0.0085f,
                    whole,
                    skin,
                    weights,
                    true});
  pieces.push_back({kSandalsPart,
                    sandal,
                    {{0.02f, -0.01f, -0.22f}, {0.18f, 0.18f, 0.11f}},
                    0.0070f,
                    sandal,
                    [&body](const glm::vec3&) { return body.options.sandals; },
                    weights,
                    true});
}

void AddClothes(const Body& body, std::vector<Piece>& pieces) {
  const DistanceField tunic = [&body](const glm::vec3& p) { return body.tunic.Distance(p); };
  const DistanceField belt = [&body](const glm::vec3& p) { return body.tunic.Belt(p); };
  const auto weights = [&body](const glm::vec3& p) { return body.skin.Cloth(p); };
  pieces.push_back({kTunicPart,
                    tunic,
                    {{-0.42f, 0.46f, -0.22f}, {0.42f, 1.50f, 0.22f}},
                    0.0130f,
                    tunic,
                    [&body](const glm::vec3&) { return body.options.tunic; },
                    weights});
  pieces.push_back({kBeltPart,
                    belt,
                    {{-0.19f, 0.89f, -0.16f}, {0.19f, 1.07f, 0.14f}},
                    0.0085f,
                    belt,
                    [&body](const glm::vec3&) { return body.options.belt; },
                    weights});
}

// Sums the shares of each joint, keeps the four largest and normalises them to 1.
void StoreWeights(JointShares shares, human::SkinnedMesh& mesh) {
  std::sort(shares.begin(), shares.end());
  JointShares merged;
  for (const auto& [joint, weight] : shares) {
    if (!merged.empty() && merged.back().first == joint) {
      merged.back().second += weight;
    } else {
      merged.emplace_back(joint, weight);
    }
  }
  std::stable_sort(merged.begin(), merged.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  merged.resize(4);
  const float sum = merged[0].second + merged[1].second + merged[2].second + merged[3].second;
  std::array<uint8_t, 4> joints;
  glm::vec4 weights;
  for (int k = 0; k < 4; ++k) {
    joints[k] = static_cast<uint8_t>(merged[k].first);
    weights[k] = merged[k].second / sum;
  }
  mesh.joints.push_back(joints);
  mesh.weights.push_back(weights);
}

human::SkinnedMesh BuildPiece(const Piece& piece) {
  geometry::TriangleMesh surface = Polygonise(piece.solid, piece.box, piece.cell);
  human::SkinnedMesh mesh;
  for (size_t v = 0; v < surface.positions.size(); ++v) {
    const glm::vec3& p = surface.positions[v];
    // Excludes the caps that close a piece inside the shared solid.
    const bool on_shared = std::abs(piece.shading(p)) < 0.008f;
    mesh.normals.push_back(on_shared ? FieldNormal(piece.shading, p) : surface.normals[v]);
    mesh.albedo.push_back(piece.albedo(p));
    StoreWeights(piece.weights(p), mesh);
  }
  mesh.positions = std::move(surface.positions);
  mesh.indices = std::move(surface.indices);
  return mesh;
}

human::SkinnedMesh Mirrored(human::SkinnedMesh mesh, const human::Skeleton& skeleton) {
  for (size_t v = 0; v < mesh.positions.size(); ++v) {
    mesh.positions[v].x = -mesh.positions[v].x;
    mesh.normals[v].x = -mesh.normals[v].x;
    for (uint8_t& joint : mesh.joints[v]) {
      joint = static_cast<uint8_t>(MirroredJoint(skeleton, joint));
    }
  }
  for (size_t i = 0; i < mesh.indices.size(); i += 3) {
    std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
  }
  return mesh;
}

void AppendMesh(const human::SkinnedMesh& from, human::SkinnedMesh& to) {
  const uint32_t first = static_cast<uint32_t>(to.positions.size());
  const auto append = [](const auto& a, auto& b) { b.insert(b.end(), a.begin(), a.end()); };
  append(from.positions, to.positions);
  append(from.normals, to.normals);
  append(from.albedo, to.albedo);
  append(from.joints, to.joints);
  append(from.weights, to.weights);
  for (const uint32_t index : from.indices) {
    to.indices.push_back(first + index);
  }
}

}  // namespace

std::vector<human::SkinnedMesh> PlainMeshes(const human::Skeleton& skeleton,
                                            const PlainFigureOptions& options) {
  const Body body(skeleton, options);
  std::vector<Piece> pieces;
  AddHead(body, pieces);
  AddArms(body, pieces);
  AddLegs(body, pieces);
  AddClothes(body, pieces);
  std::vector<human::SkinnedMesh> surfaces(pieces.size());
  ParallelFor(pieces.size(), [&](size_t i) { surfaces[i] = BuildPiece(pieces[i]); });
  std::vector<human::SkinnedMesh> parts(kPartCount);
  for (size_t i = 0; i < kPartCount; ++i) {
    parts[i].name = kPartNames[i];
  }
  for (size_t i = 0; i < pieces.size(); ++i) {
    human::SkinnedMesh& part = parts[pieces[i].part];
    AppendMesh(surfaces[i], part);
    if (pieces[i].both_sides) {
      AppendMesh(Mirrored(std::move(surfaces[i]), skeleton), part);
    }
  }
  return parts;
}

}  // namespace lararium::import
