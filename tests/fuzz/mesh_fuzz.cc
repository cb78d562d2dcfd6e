#include <span>

#include "shared/stage/mesh_file.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const auto mesh =
      lararium::stage::ParseMesh(std::as_bytes(std::span(data, size)), "fuzz.larmesh");
  if (mesh.ok()) {
    CHECK(mesh->Validate("fuzz.larmesh").ok());
  }
  return 0;
}
