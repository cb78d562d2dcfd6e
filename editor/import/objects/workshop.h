#pragma once

// One function for each object modelled in code. Private to objects/.

#include <string>
#include <string_view>
#include <vector>

#include "editor/import/objects/modelling.h"
#include "shared/stage/prop.h"

namespace lararium::import {

inline const glm::vec3 kTerracotta(0.44f, 0.20f, 0.11f);
inline const glm::vec3 kPaleClay(0.55f, 0.41f, 0.28f);
inline const glm::vec3 kSigillata(0.38f, 0.085f, 0.04f);
inline const glm::vec3 kBronze(0.46f, 0.30f, 0.12f);
inline const glm::vec3 kPatina(0.16f, 0.14f, 0.07f);
inline const glm::vec3 kIron(0.10f, 0.09f, 0.085f);
inline const glm::vec3 kRust(0.15f, 0.075f, 0.04f);
inline const glm::vec3 kOak(0.26f, 0.155f, 0.08f);

// A prop of one part with one mesh.
stage::Prop OnePiece(std::string name, stage::PropMesh mesh);
// Adds a part that moves relative to the first.
void AddPart(std::string name, const glm::vec3& origin, stage::PropMesh mesh, stage::Prop& prop);

// A turned surface; the outline gives {radius, height} in centimetres.
stage::PropMesh Potted(std::vector<OutlinePoint> outline_cm, const Paint& paint);
// A rod of constant thickness through points in centimetres.
stage::PropMesh BentRod(std::vector<glm::vec3> points_cm, float radius_cm, const Paint& paint);

// The text of its NAME.object.json; empty for scenery.
std::string_view ObjectModelUse(std::string_view name);

namespace model {

stage::Prop Amphora();
stage::Prop StorageJar();
stage::Prop Jug();
stage::Prop Ladle();
stage::Prop Cup();
stage::Prop Beaker();
stage::Prop Bowl();
stage::Prop Plate();
stage::Prop Mortar();
stage::Prop Bucket();

stage::Prop Table();
stage::Prop Stool();
stage::Prop Bench();
stage::Prop Chest();
stage::Prop Door();
stage::Prop Basket();

stage::Prop Loaf();
stage::Prop Coins();
stage::Prop Tablet();
stage::Prop OilLamp();
stage::Prop LampStand();
stage::Prop Brazier();

}  // namespace model
}  // namespace lararium::import
