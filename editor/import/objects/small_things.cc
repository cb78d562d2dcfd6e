// Small objects: food, coins, writing tablets, lamps and fires.

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <numbers>

#include "editor/import/objects/workshop.h"
#include "shared/geometry/triangle_mesh.h"

namespace lararium::import::model {
namespace {

// A flame, brightest low in its middle. Its radiance is a few times that of a white wall in a
// room, so that it does not outshine an image.
stage::PropMesh Flame(const glm::vec3& foot, float height) {
  const float h = 100.0f * height;
  stage::PropMesh flame = Potted({{0, 0},
                                  {0.14f * h, 0.12f * h},
                                  {0.19f * h, 0.32f * h},
                                  {0.11f * h, 0.68f * h},
                                  {0.03f * h, 0.93f * h},
                                  {0, h}},
                                 PlainPaint(glm::vec3(0.0f)));
  flame.emission = glm::vec3(2.2f, 1.15f, 0.32f);
  for (glm::vec3& position : flame.positions) {
    position += foot;
  }
  return flame;
}

// Recomputes normals after vertices were moved.
void RenewNormals(stage::PropMesh& mesh) {
  geometry::TriangleMesh triangles{mesh.positions, {}, mesh.indices};
  geometry::ComputeNormals(triangles);
  mesh.normals = std::move(triangles.normals);
}

}  // namespace

// A panis quadratus like those found: eight wedges around a middle.
stage::Prop Loaf() {
  stage::PropMesh mesh =
      Potted({{0, 0},
              {8, 0},
              {10, 1.4f},
              {10.2f, 3.2f},
              {8.8f, 5.4f},
              {6, 6.6f},
              {3.4f, 7.0f},
              {1.6f, 7.1f},
              {0, 7.1f}},
             CrustPaint({0.50f, 0.31f, 0.14f}, {0.27f, 0.115f, 0.04f}, 0.07f, 301));
  for (glm::vec3& p : mesh.positions) {
    const float angle = std::atan2(p.z, p.x);
    const float radius = std::hypot(p.x, p.z);
    const float wedge = std::pow(std::abs(std::cos(4.0f * angle)), 10.0f);
    const float cut =
        wedge * glm::smoothstep(0.008f, 0.03f, radius) * glm::smoothstep(0.018f, 0.045f, p.y);
    p.y -= 0.014f * cut;
    p.x *= 1.0f - 0.05f * cut;
    p.z *= 1.0f - 0.05f * cut;
  }
  RenewNormals(mesh);
  return OnePiece("loaf", std::move(mesh));
}

// A few sestertii, partly stacked.
stage::Prop Coins() {
  const Paint brass = MetalPaint({0.50f, 0.36f, 0.14f}, {0.20f, 0.14f, 0.07f}, 311);
  const stage::PropMesh coin = Potted({{0, 0},
                                       {1.7f, 0, true},
                                       {1.7f, 0.4f, true},
                                       {1.45f, 0.34f, true},
                                       {0.8f, 0.42f},
                                       {0, 0.45f}},
                                      brass);
  stage::PropMesh mesh;
  for (int i = 0; i < 5; ++i) {
    const float slip = 0.0015f * static_cast<float>(i % 3) - 0.001f;
    Append(coin, mesh, {{slip, 0.0044f * static_cast<float>(i), -slip}});
  }
  Append(coin, mesh, {{0.041f, 0.0f, 0.012f}});
  Append(coin, mesh, {{-0.012f, 0.0f, 0.040f}});
  Append(coin, mesh, {{0.022f, 0.0f, 0.045f}});
  return OnePiece("coins", std::move(mesh));
}

// Wax in a wooden frame, and its stylus.
stage::Prop Tablet() {
  const Paint wood = WoodPaint({0.30f, 0.19f, 0.10f}, 2, 321);
  stage::PropMesh mesh = Block({-0.062f, 0.0f, -0.08f}, {0.062f, 0.006f, 0.08f}, 0.001f, wood);
  for (const float side : {-1.0f, 1.0f}) {
    Append(Block({side * 0.057f - 0.005f, 0.005f, -0.08f}, {side * 0.057f + 0.005f, 0.011f, 0.08f},
                 0.001f, wood),
           mesh);
    Append(Block({-0.06f, 0.005f, side * 0.075f - 0.005f}, {0.06f, 0.011f, side * 0.075f + 0.005f},
                 0.001f, wood),
           mesh);
  }
  Append(Block({-0.053f, 0.006f, -0.071f}, {0.053f, 0.0085f, 0.071f}, 0.0005f,
               StonePaint({0.055f, 0.028f, 0.018f}, 322)),
         mesh);
  Append(Rod(std::vector<PathPoint>{{{-0.02f, 0.0115f, -0.06f}, 0.0012f},
                                    {{0.0f, 0.0125f, 0.0f}, 0.0028f},
                                    {{0.02f, 0.0125f, 0.06f}, 0.0036f}},
             MetalPaint({0.30f, 0.28f, 0.26f}, {0.12f, 0.09f, 0.07f}, 323)),
         mesh);
  return OnePiece("tablet", std::move(mesh));
}

// A burning lamp of clay.
stage::Prop OilLamp() {
  const Paint clay = ClayPaint(kTerracotta, 331);
  stage::PropMesh mesh = Potted({{0, 0},
                                 {2.2f, 0, true},
                                 {3.2f, 1},
                                 {3.7f, 2},
                                 {3.2f, 2.8f, true},
                                 {2.8f, 2.6f, true},
                                 {0.6f, 2.2f, true},
                                 {0.5f, 1.2f},
                                 {0, 1.2f}},
                                clay);
  Append(Rod(std::vector<PathPoint>{{{0.0f, 0.016f, -0.026f}, 0.013f},
                                    {{0.0f, 0.018f, -0.046f}, 0.0115f},
                                    {{0.0f, 0.020f, -0.058f}, 0.009f}},
             ClayPaint({0.20f, 0.10f, 0.06f}, 332)),
         mesh);
  Append(
      BentRod({{0, 2.0f, 3.2f}, {0, 3.6f, 4.8f}, {0, 2.6f, 6.0f}, {0, 1.0f, 4.6f}, {0, 1.0f, 3.2f}},
              0.42f, clay),
      mesh);
  stage::Prop prop = OnePiece("oil_lamp", std::move(mesh));
  AddPart("flame", glm::vec3(0.0f), Flame({0.0f, 0.026f, -0.054f}, 0.034f), prop);
  return prop;
}

// A bronze candelabrum on three feet with a plate on top.
stage::Prop LampStand() {
  const Paint bronze = MetalPaint(kBronze, kPatina, 341);
  stage::PropMesh mesh = Potted({{0, 12},
                                 {2.6f, 12},
                                 {1.6f, 15},
                                 {1.1f, 20},
                                 {1.0f, 70},
                                 {0.9f, 112},
                                 {1.8f, 114},
                                 {1.2f, 116},
                                 {6.8f, 118.6f, true},
                                 {7.2f, 119.4f, true},
                                 {6.6f, 119.4f, true},
                                 {0, 118.2f}},
                                bronze);
  for (int foot = 0; foot < 3; ++foot) {
    const float angle = 2.0f * std::numbers::pi_v<float> * static_cast<float>(foot) / 3.0f;
    const glm::vec3 out(std::cos(angle), 0.0f, std::sin(angle));
    const glm::vec3 up(0, 1, 0);
    Append(BentRod({1.0f * out + 13.0f * up, 7.0f * out + 14.0f * up, 12.0f * out + 8.0f * up,
                    14.5f * out + 2.0f * up, 17.0f * out + 1.0f * up},
                   1.0f, bronze),
           mesh);
  }
  return OnePiece("lamp_stand", std::move(mesh));
}

// Glowing charcoal in an iron pan.
stage::Prop Brazier() {
  const Paint iron = MetalPaint({0.10f, 0.09f, 0.085f}, {0.14f, 0.07f, 0.04f}, 351);
  stage::PropMesh mesh = Potted({{0, 24},
                                 {18, 24, true},
                                 {22, 30},
                                 {23.5f, 36, true},
                                 {23.5f, 37.5f, true},
                                 {22.8f, 37.5f, true},
                                 {21, 30},
                                 {17, 26, true},
                                 {0, 26}},
                                iron);
  for (int leg = 0; leg < 4; ++leg) {
    const float angle = 0.5f * std::numbers::pi_v<float> * (static_cast<float>(leg) + 0.5f);
    const glm::vec3 out(std::cos(angle), 0.0f, std::sin(angle));
    const glm::vec3 up(0, 1, 0);
    Append(BentRod({17.0f * out + 26.0f * up, 21.0f * out + 18.0f * up, 18.0f * out + 8.0f * up,
                    21.0f * out + 1.2f * up, 24.0f * out + 1.2f * up},
                   1.3f, iron),
           mesh);
  }
  stage::PropMesh coals;
  stage::PropMesh glow;
  for (int i = 0; i < 46; ++i) {
    const float turn = 2.39996f * static_cast<float>(i);  // The golden angle spreads them evenly.
    const float out = 0.165f * std::sqrt(static_cast<float>(i) / 46.0f);
    const glm::vec3 at(out * std::cos(turn), 0.292f + 0.012f * std::sin(5.0f * turn),
                       out * std::sin(turn));
    const glm::quat tumble =
        glm::angleAxis(3.1f * turn, glm::normalize(glm::vec3(1.0f, 0.4f, 0.7f)));
    const glm::vec3 half(0.028f, 0.017f, 0.02f);
    const bool glows = i % 4 == 1;
    Append(
        Block(-half, half, 0.007f,
              glows ? PlainPaint({0.09f, 0.03f, 0.01f}) : StonePaint({0.03f, 0.028f, 0.027f}, 352)),
        glows ? glow : coals, {at - glm::vec3(0.0f, glows ? 0.008f : 0.0f, 0.0f), tumble});
  }
  glow.emission = glm::vec3(0.85f, 0.17f, 0.03f);
  Append(std::move(coals), mesh);
  stage::Prop prop = OnePiece("brazier", std::move(mesh));
  prop.parts[0].meshes.push_back(std::move(glow));
  return prop;
}

}  // namespace lararium::import::model
