// libFuzzer harness: reading any bytes as a recipe and as a mesh of the cast library terminates,
// and an accepted input refers only to existing items.

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "editor/import/cast/cast_mesh.h"
#include "editor/import/cast/cast_recipe.h"
#include "shared/core/check.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace lararium;
  const auto json = ParseJson(std::string_view(reinterpret_cast<const char*>(data), size), "fuzz");
  if (!json.ok()) {
    return 0;
  }
  const JsonView root(*json, "fuzz");
  if (const auto mesh = import::ReadCastMesh(root); mesh.ok()) {
    for (const import::CastFace& face : mesh->faces) {
      for (const uint32_t vertex : face.vertices) {
        CHECK(vertex < mesh->positions.size());
      }
    }
  }
  if (const auto recipe = ParseFields<import::CastRecipe>(root); recipe.ok()) {
    const Json written = FormatFields(*recipe);
    CHECK(ParseFields<import::CastRecipe>(JsonView(written, "again")).ok());
  }
  return 0;
}
