// libFuzzer harness: our part of reading models terminates for any bytes: the check of glTF's JSON,
// the extensions of VRM, and saved bone maps. JSON that the check accepts is written and accepted
// again. (Assimp itself runs in a child process; see model_isolation.h.)

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "editor/import/model/bone_map.h"
#include "editor/import/model/joint_names.h"
#include "editor/import/model/model_gltf.h"
#include "editor/import/model/vrm.h"
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
