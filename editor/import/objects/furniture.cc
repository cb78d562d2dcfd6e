// Furniture and doors of the kitchen.

#include <cmath>
#include <numbers>

#include "editor/import/objects/grain.h"
#include "editor/import/objects/workshop.h"

namespace lararium::import::model {
namespace {

// The colour of a board; each board has its own.
glm::vec3 Tone(uint32_t seed) {
  return kOak * (1.25f + 0.22f * ValueNoise(glm::vec3(3.7f * static_cast<float>(seed)), 9));
}

// A sawn board between two corners in centimetres.
stage::PropMesh Board(const glm::vec3& low_cm, const glm::vec3& high_cm, int grain, uint32_t seed) {
  stage::PropMesh board = Block(0.01f * low_cm, 0.01f * high_cm, 0.004f, PlainPaint(Tone(seed)));
  PanelWithWood(grain, board);
  // The texture of each board comes from a different part of the tree.
  for (glm::vec2& uv : board.uvs) {
    uv += glm::vec2(0.37f, 0.61f) * static_cast<float>(seed);
  }
  return board;
}

// An object of boards and legs, which share the image of wood.
stage::Prop Wooden(std::string name, stage::PropMesh mesh) {
  stage::Prop prop = OnePiece(std::move(name), std::move(mesh));
  prop.textures.push_back(std::make_shared<const human::Texture>(WoodGrain()));
  prop.materials.push_back({.name = "wood", .colour_texture = 0, .roughness = 0.7f});
  prop.parts[0].meshes[0].material = 0;
  return prop;
}

// A turned leg that leans outward at its foot.
void AddLeg(const glm::vec3& top_cm, const glm::vec3& foot_cm, uint32_t seed, stage::PropMesh& to) {
  const glm::vec3 top = 0.01f * top_cm;
  const glm::vec3 way = 0.01f * (foot_cm - top_cm);
  stage::PropMesh leg = Rod(std::vector<PathPoint>{{top, 0.018f},
                                                   {top + 0.15f * way, 0.026f},
                                                   {top + 0.3f * way, 0.017f},
                                                   {top + 0.7f * way, 0.021f},
                                                   {top + 0.9f * way, 0.015f},
                                                   {top + way, 0.022f}},
                            PlainPaint(0.85f * Tone(seed)));
  PanelWithWood(1, leg);
  Append(leg, to);
}

}  // namespace

// A mensa tripes: round, on three legs.
stage::Prop Table() {
  stage::PropMesh mesh =
      Potted({{0, 70}, {36, 70, true}, {38, 71}, {38, 72.6f}, {37, 73.5f, true}, {0, 73.5f}},
             PlainPaint(Tone(201)));
  PanelWithWood(0, mesh);
  for (int leg = 0; leg < 3; ++leg) {
    const float angle = 2.0f * std::numbers::pi_v<float> * (static_cast<float>(leg) + 0.25f) / 3.0f;
    const glm::vec3 out(std::cos(angle), 0.0f, std::sin(angle));
    AddLeg(24.0f * out + glm::vec3(0, 70, 0), 32.0f * out, 202 + leg, mesh);
  }
  return Wooden("table", std::move(mesh));
}

stage::Prop Stool() {
  stage::PropMesh mesh = Board({-19, 42, -17}, {19, 46, 17}, 0, 211);
  for (const float x : {-1.0f, 1.0f}) {
    for (const float z : {-1.0f, 1.0f}) {
      AddLeg({14 * x, 42, 12 * z}, {18 * x, 0, 15 * z}, 212, mesh);
    }
    stage::PropMesh state =
        BentRod({{16 * x, 18, -13.5f}, {16 * x, 18, 13.5f}}, 1.2f, PlainPaint(Tone(213)));
    PanelWithWood(2, state);
    Append(state, mesh);
  }
  return Wooden("stool", std::move(mesh));
}

stage::Prop Bench() {
  stage::PropMesh mesh = Board({-60, 42, -16}, {60, 46.5f, 16}, 0, 221);
  for (const float x : {-1.0f, 1.0f}) {
    Append(Board({x * 46 - 2.5f, 0, -14}, {x * 46 + 2.5f, 42, 14}, 1, 222), mesh);
  }
  Append(Board({-46, 20, -2}, {46, 27, 2}, 0, 223), mesh);
  return Wooden("bench", std::move(mesh));
}

// An arca: oak with iron bands; the lid rotates about its back edge.
stage::Prop Chest() {
  const Paint iron = MetalPaint(kIron, kRust, 231);
  stage::PropMesh body;
  stage::PropMesh bands;
  Append(Board({-40, 4, -24}, {40, 8, 24}, 0, 232), body);
  Append(Board({-40, 8, -24}, {40, 42, -21.5f}, 0, 233), body);
  Append(Board({-40, 8, 21.5f}, {40, 42, 24}, 0, 234), body);
  for (const float x : {-1.0f, 1.0f}) {
    Append(Board({x * 38.7f - 1.3f, 8, -21.5f}, {x * 38.7f + 1.3f, 42, 21.5f}, 2, 235), body);
    for (const float z : {-1.0f, 1.0f}) {
      Append(Board({x * 37 - 4, 0, z * 21 - 4}, {x * 37 + 4, 6, z * 21 + 4}, 1, 236), body);
    }
    Append(Block({0.01f * (x * 26 - 2), 0.06f, -0.2435f}, {0.01f * (x * 26 + 2), 0.42f, 0.2435f},
                 0.001f, iron),
           bands);
  }
  Append(Block({-0.05f, 0.28f, -0.248f}, {0.05f, 0.38f, -0.238f}, 0.002f, iron), bands);
  stage::Prop prop = Wooden("chest", std::move(body));
  prop.parts[0].meshes.push_back(std::move(bands));
  // In the frame of the hinge: the front edge is at -z.
  stage::PropMesh lid_bands;
  stage::PropMesh lid = Board({-41, 0, -49}, {41, 3.2f, 0}, 0, 237);
  for (const float x : {-1.0f, 1.0f}) {
    Append(Block({0.01f * (x * 26 - 2), -0.001f, -0.4935f}, {0.01f * (x * 26 + 2), 0.035f, 0.002f},
                 0.001f, iron),
           lid_bands);
  }
  AddPart("lid", {0.0f, 0.42f, 0.245f}, std::move(lid), prop);
  prop.parts[1].meshes[0].material = 0;
  prop.parts[1].meshes.push_back(std::move(lid_bands));
  return prop;
}

// A leaf of boards in a frame; it rotates about its left post as seen from the front.
stage::Prop Door() {
  stage::PropMesh frame;
  stage::PropMesh sill;
  for (const float x : {-1.0f, 1.0f}) {
    Append(Board({x * 48 - 6, 0, -7}, {x * 48 + 6, 212, 7}, 1, 241), frame);
  }
  Append(Board({-54, 200, -7}, {54, 214, 7}, 0, 242), frame);
  Append(Block({-0.54f, 0.0f, -0.09f}, {0.54f, 0.02f, 0.09f}, 0.006f,
               StonePaint(glm::vec3(0.36f, 0.34f, 0.31f), 243)),
         sill);
  stage::Prop prop = Wooden("door", std::move(frame));
  prop.parts[0].meshes.push_back(std::move(sill));
  const Paint iron = MetalPaint(kIron, kRust, 244);
  stage::PropMesh leaf;
  stage::PropMesh fittings;
  for (int board = 0; board < 5; ++board) {
    const float low = 0.4f + 16.6f * static_cast<float>(board);
    Append(Board({low, 2.5f, -2}, {low + 16.2f, 199, 2}, 1, 245 + board), leaf);
  }
  for (const float height : {28.0f, 100.0f, 172.0f}) {
    Append(Board({1, height, -4}, {82, height + 12, -1.5f}, 0, 250), leaf);
    for (int nail = 0; nail < 5; ++nail) {
      const float x = 0.087f + 0.166f * static_cast<float>(nail);
      Append(Rod(std::vector<PathPoint>{{{x, 0.01f * height + 0.06f, -0.038f}, 0.012f},
                                        {{x, 0.01f * height + 0.06f, -0.046f}, 0.006f}},
                 iron),
             fittings);
    }
  }
  Append(BentRod({{74, 100, -4}, {74, 101, -8}, {74, 112, -8}, {74, 113, -4}}, 0.8f, iron),
         fittings);
  AddPart("leaf", {-0.418f, 0.0f, 0.0f}, std::move(leaf), prop);
  prop.parts[1].meshes[0].material = 0;
  prop.parts[1].meshes.push_back(std::move(fittings));
  return prop;
}

stage::Prop Basket() {
  const Paint wicker = PlainPaint(glm::vec3(0.48f, 0.32f, 0.16f));
  stage::PropMesh mesh = Potted({{0, 0},
                                 {14, 0, true},
                                 {17, 8},
                                 {19, 20},
                                 {20.4f, 21.5f},
                                 {19.6f, 23},
                                 {18, 21.5f},
                                 {16, 8},
                                 {13, 1.5f, true},
                                 {0, 1.5f}},
                                wicker);
  for (const float side : {-1.0f, 1.0f}) {
    Append(BentRod({{side * 18.5f, 20, -6},
                    {side * 20, 27, -4.5f},
                    {side * 20.3f, 29, 0},
                    {side * 20, 27, 4.5f},
                    {side * 18.5f, 20, 6}},
                   0.9f, wicker),
           mesh);
  }
  WeaveOfWicker(mesh);
  stage::Prop prop = OnePiece("basket", std::move(mesh));
  prop.textures.push_back(std::make_shared<const human::Texture>(WickerWeave()));
  prop.materials.push_back({.name = "wicker", .colour_texture = 0, .roughness = 0.9f});
  prop.parts[0].meshes[0].material = 0;
  return prop;
}

}  // namespace lararium::import::model
