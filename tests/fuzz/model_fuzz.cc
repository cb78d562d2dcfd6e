// libFuzzer harness: our part of reading models terminates for any bytes: glTF, the extensions of
// VRM, BVH, survey coordinates, and saved bone maps. (Assimp itself runs in a child process; see
// model_isolation.h.)

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "editor/import/model/bone_map.h"
#include "editor/import/model/bvh_scene.h"
#include "editor/import/model/gltf_scene.h"
#include "editor/import/model/joint_names.h"
#include "editor/import/model/model_gltf.h"
#include "editor/import/model/survey_offset.h"
#include "editor/import/model/vrm.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace lararium::import;
  const std::span<const std::byte> bytes(reinterpret_cast<const std::byte*>(data), size);
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  (void)ParseBoneNames(text, "fuzz").ok();
  (void)ParseBoneName(text);
  std::vector<std::string> notes;
  if (LooksLikeBvh(text)) {
    (void)ReadBvhScene(text, "fuzz", notes).ok();
  }
  for (const char* extension : {".obj", ".ply"}) {
    std::vector<std::byte> copy(bytes.begin(), bytes.end());
    (void)TakeOffSurvey(extension, copy);
  }
  if (!LooksLikeGltf(bytes)) {
    return 0;
  }
  auto document = ParseGltf(bytes, "fuzz");
  if (document.ok()) {
    (void)ReadVrm(*document);
    for (size_t mesh = 0; mesh < 4; ++mesh) {
      (void)document->TargetNames(mesh);
    }
    GltfNotes gltf_notes;
    if (ReadGltfBuffers("/nowhere/fuzz.gltf", *document).ok()) {
      (void)ReadGltfScene(*document, "fuzz", gltf_notes).ok();
    }
  }
  return 0;
}
