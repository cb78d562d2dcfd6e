#pragma once

#include <memory>
#include <string>

#include "shared/stage/object_use.h"

namespace lararium::test {

// A part with one box as its mesh.
inline stage::PropMesh MakeBox(const glm::vec3& low, const glm::vec3& high) {
  stage::PropMesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.positions.emplace_back(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y,
                                i & 4 ? high.z : low.z);
    mesh.normals.emplace_back(0.0f, 1.0f, 0.0f);
    mesh.albedo.emplace_back(0.5f);
  }
  mesh.indices = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                  2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
  return mesh;
}

// A box with a lid above it.
inline stage::Prop MakeChest() {
  stage::Prop prop;
  prop.name = "chest";
  prop.parts.resize(2);
  prop.parts[0].name = "body";
  prop.parts[0].meshes = {MakeBox({-0.3f, 0.0f, -0.2f}, {0.3f, 0.7f, 0.2f})};
  prop.parts[1].name = "lid";
  prop.parts[1].parent = 0;
  prop.parts[1].parent_from_part.position = {0.0f, 0.7f, 0.2f};
  prop.parts[1].meshes = {MakeBox({-0.3f, 0.0f, -0.4f}, {0.3f, 0.05f, 0.0f})};
  prop.use = R"({
    "schema": 1,
    "states": ["shut", "open"],
    "parts": {"lid": {"hinge": [1, 0, 0], "limits": [0, 100]}},
    "grips": {"edge": {"part": "lid", "at": [0, 0.02, -0.4], "palm": [0, 0, 1], "fingers": [0, 1, 0]}},
    "places": {"front": {"at": [0, -0.6], "heading": 180}},
    "surfaces": {"inside": {"spots": [{"at": [0, 0.1, 0], "place": "front"}]}},
    "actions": {
      "open": {"from": ["shut"], "to": "open", "hands": {"right": "edge"}, "duration": 1.5,
               "moves": [{"part": "lid", "to": 90, "begin": 0.2, "end": 1.4}], "sound": "creak"},
      "shut": {"from": ["open"], "to": "shut", "hands": {"right": "edge"}, "duration": 1.0,
               "moves": [{"part": "lid", "to": 0}]}
    }})";
  return prop;
}

// A table of 0.5 m x 0.5 m with four places around it and spots for three objects.
inline stage::Prop MakeTable() {
  stage::Prop prop;
  prop.name = "table";
  prop.parts.resize(1);
  prop.parts[0].name = "top";
  prop.parts[0].meshes = {MakeBox({-0.4f, 0.0f, -0.4f}, {0.4f, 0.75f, 0.4f})};
  prop.use = R"({
    "schema": 1,
    "places": {"n": {"at": [0, -0.75], "heading": 180}, "s": {"at": [0, 0.75], "heading": 0},
               "w": {"at": [-0.75, 0], "heading": -90}, "e": {"at": [0.75, 0], "heading": 90}},
    "capacity": 2,
    "surfaces": {"top": {"spots": [{"at": [-0.25, 0.75, 0], "place": "w"},
                                   {"at": [0.25, 0.75, 0], "place": "e"},
                                   {"at": [0, 0.75, -0.25], "place": "n"}]}},
    "actions": {"wipe": {"duration": 2}}})";
  return prop;
}

// A cup that is carried upright in one hand. It has two grips, so that it can be handed over.
inline stage::Prop MakeCup() {
  stage::Prop prop;
  prop.name = "cup";
  prop.parts.resize(2);
  prop.parts[0].name = "cup";
  prop.parts[0].meshes = {MakeBox({-0.04f, 0.0f, -0.04f}, {0.04f, 0.1f, 0.04f})};
  prop.parts[1].name = "wine";
  prop.parts[1].parent = 0;
  prop.parts[1].meshes = {MakeBox({-0.03f, 0.07f, -0.03f}, {0.03f, 0.08f, 0.03f})};
  prop.use = R"({
    "schema": 1,
    "states": ["empty", "full"],
    "parts": {"wine": {"states": ["full"]}},
    "grips": {"right": {"at": [0.045, 0.05, 0], "palm": [-1, 0, 0], "fingers": [0, 0, -1], "hand": "right", "pose": "cylinder"},
              "left": {"at": [-0.045, 0.05, 0], "palm": [1, 0, 0], "fingers": [0, 0, -1], "hand": "left", "pose": "cylinder"},
              "far": {"at": [-0.045, 0.05, 0], "palm": [1, 0, 0], "fingers": [0, 0, 1], "hand": "right", "pose": "cylinder"}},
    "carry": {"hands": {"right": "right"}, "at": [0.2, 1.0, -0.35], "heading": 0},
    "actions": {"drink": {"held": true, "from": ["full"], "to": "empty", "duration": 2,
                          "path": [{"t": 0.8, "at": [0.02, 1.4, -0.2], "turn": [30, 0, 0]},
                                   {"t": 1.4, "at": [0.02, 1.4, -0.2], "turn": [50, 0, 0]}]}}})";
  return prop;
}

// An oil lamp whose flame stands 0.1 m above its foot.
inline stage::Prop MakeLamp() {
  stage::Prop prop;
  prop.name = "lamp";
  prop.parts.resize(2);
  prop.parts[0].name = "bowl";
  prop.parts[0].meshes = {MakeBox({-0.04f, 0.0f, -0.04f}, {0.04f, 0.08f, 0.04f})};
  prop.parts[1].name = "flame";
  prop.parts[1].parent = 0;
  prop.parts[1].parent_from_part.position = {0.0f, 0.08f, 0.0f};
  prop.parts[1].meshes = {MakeBox({-0.01f, 0.0f, -0.01f}, {0.01f, 0.04f, 0.01f})};
  prop.use = R"({
    "schema": 1,
    "states": ["lit", "out"],
    "parts": {"flame": {"states": ["lit"]}},
    "lights": {"flame": {"part": "flame", "at": [0, 0.02, 0], "colour": [2, 1, 0.5], "intensity": 0.5,
                         "radius": 0.02, "flicker": 0.3, "states": ["lit"]}}})";
  return prop;
}

// A stool that faces -Z.
inline stage::Prop MakeStool() {
  stage::Prop prop;
  prop.name = "stool";
  prop.parts.resize(1);
  prop.parts[0].name = "stool";
  prop.parts[0].meshes = {MakeBox({-0.19f, 0.0f, -0.17f}, {0.19f, 0.46f, 0.17f})};
  prop.use = R"({
    "schema": 1,
    "places": {"front": {"at": [0, -0.5], "heading": 0}},
    "actions": {"sit": {"seat": {"at": [0, 0.46, 0.02], "heading": 0}}}})";
  return prop;
}

inline std::shared_ptr<const stage::ObjectModel> Model(stage::Prop prop) {
  auto model = stage::ObjectModel::Create(std::move(prop), "test.larprop");
  CHECK(model.ok());
  return *std::move(model);
}

}  // namespace lararium::test
