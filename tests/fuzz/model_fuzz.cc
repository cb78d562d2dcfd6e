// libFuzzer harness: whatever the bytes are, our part of reading models ends: the check of
// glTF's JSON, what VRM adds, and saved bone maps. What the check accepts is written and
// accepted again. (Assimp itself runs in a child process; see model_isolation.h.)

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "editor/import/bone_map.h"
#include "editor/import/joint_names.h"
#include "editor/import/model_gltf.h"
#include "editor/import/vrm.h"
#include "shared/core/check.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace lararium::import;
  const std::span<const std::byte> bytes(reinterpret_cast<const std::byte*>(data), size);
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  (void)ParseBoneNames(text, "fuzz").ok();
  (void)ParseBoneName(text);
  if (!LooksLikeGltf(bytes)) {
    return 0;
  }
  const auto document = ParseGltf(bytes, "fuzz");
  if (document.ok()) {
    (void)ReadVrm(*document);
    for (size_t mesh = 0; mesh < 4; ++mesh) {
      (void)document->TargetNames(mesh);
    }
    CHECK(ParseGltf(SerializeWithIndexNames(*document), "fuzz").ok());
  }
  return 0;
}
