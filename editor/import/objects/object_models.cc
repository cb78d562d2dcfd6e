#include "editor/import/objects/object_models.h"

#include <algorithm>
#include <array>
#include <string>

#include "editor/import/objects/workshop.h"

namespace lararium::import {
namespace {

struct ObjectModelEntry {
  std::string_view name;
  stage::Prop (*build)();
};

// Objects that shine more than clay and wood: red slip, thin-walled ware, metal.
struct Polish {
  std::string_view name;
  float roughness;
  human::Surface surface = human::Surface::kPlain;
};
// The brazier's iron is rust.
constexpr std::array<Polish, 9> kPolished = {{{"beaker", 0.5f},
                                              {"brazier", 0.55f},
                                              {"bucket", 0.35f, human::Surface::kMetal},
                                              {"coins", 0.4f, human::Surface::kMetal},
                                              {"cup", 0.3f},
                                              {"jug", 0.55f},
                                              {"ladle", 0.35f, human::Surface::kMetal},
                                              {"lamp_stand", 0.4f, human::Surface::kMetal},
                                              {"plate", 0.3f}}};

constexpr std::array<ObjectModelEntry, 22> kModels = {{
    {"amphora", model::Amphora},  {"basket", model::Basket},
    {"beaker", model::Beaker},    {"bench", model::Bench},
    {"bowl", model::Bowl},        {"brazier", model::Brazier},
    {"bucket", model::Bucket},    {"chest", model::Chest},
    {"coins", model::Coins},      {"cup", model::Cup},
    {"door", model::Door},        {"jug", model::Jug},
    {"ladle", model::Ladle},      {"lamp_stand", model::LampStand},
    {"loaf", model::Loaf},        {"mortar", model::Mortar},
    {"oil_lamp", model::OilLamp}, {"plate", model::Plate},
    {"stool", model::Stool},      {"storage_jar", model::StorageJar},
    {"table", model::Table},      {"tablet", model::Tablet},
}};

constexpr auto kNames = [] {
  std::array<std::string_view, kModels.size()> names;
  std::transform(kModels.begin(), kModels.end(), names.begin(),
                 [](const ObjectModelEntry& entry) { return entry.name; });
  return names;
}();
static_assert(std::is_sorted(kNames.begin(), kNames.end()));

void DropUnusedCoordinates(stage::Prop& prop) {
  for (stage::PropPart& part : prop.parts) {
    for (stage::PropMesh& mesh : part.meshes) {
      if (mesh.material == human::Material::kNone) {
        mesh.uvs.clear();
      }
    }
  }
}

// Gives a material to meshes without one.
void PolishModel(std::string_view name, stage::Prop& prop) {
  const auto polish = std::find_if(kPolished.begin(), kPolished.end(),
                                   [name](const Polish& entry) { return entry.name == name; });
  if (polish == kPolished.end()) {
    return;
  }
  for (stage::PropPart& part : prop.parts) {
    for (stage::PropMesh& mesh : part.meshes) {
      if (mesh.material == human::Material::kNone) {
        mesh.material = static_cast<int16_t>(prop.materials.size());
      }
    }
  }
  prop.materials.push_back(
      {.name = "polished", .surface = polish->surface, .roughness = polish->roughness});
}

}  // namespace

std::span<const std::string_view> ObjectModelNames() { return kNames; }

Result<stage::Prop> BuildObjectModel(std::string_view name) {
  const auto entry = std::lower_bound(kNames.begin(), kNames.end(), name);
  if (entry == kNames.end() || *entry != name) {
    std::string known;
    for (const std::string_view other : kNames) {
      known += (known.empty() ? "" : ", ") + std::string(other);
    }
    return Status::Error("object model \"" + std::string(name) + "\"",
                         "is not among the built-in ones", "name one of " + known);
  }
  stage::Prop prop = kModels[static_cast<size_t>(entry - kNames.begin())].build();
  DropUnusedCoordinates(prop);
  PolishModel(name, prop);
  prop.use = ObjectModelUse(name);
  prop.credits = "Modelled for Lararium after finds in Pompeii";
  return prop;
}

}  // namespace lararium::import
