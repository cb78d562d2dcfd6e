#pragma once

// Objects made of the surfaces of test_surfaces.h.

#include <memory>
#include <string>
#include <utility>

#include "shared/core/check.h"
#include "shared/stage/object_use.h"
#include "tests/bake/test_surfaces.h"

namespace lararium::bake {

inline stage::PropMesh ToPropMesh(const SurfaceMesh& surface) {
  stage::PropMesh mesh;
  mesh.positions = surface.positions;
  mesh.normals = surface.normals;
  mesh.albedo = surface.albedo;
  mesh.indices = surface.indices;
  return mesh;
}

inline stage::PropPart MakePart(std::string name, const SurfaceMesh& surface) {
  stage::PropPart part;
  part.name = std::move(name);
  part.meshes = {ToPropMesh(surface)};
  return part;
}

inline std::shared_ptr<const stage::ObjectModel> MakeModel(stage::Prop prop) {
  auto model = stage::ObjectModel::Create(std::move(prop), "here");
  CHECK(model.ok());
  return *std::move(model);
}

}  // namespace lararium::bake
