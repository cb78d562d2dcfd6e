// make_seeds FOLDER: writes a valid file of each kind whose format may change and that a harness
// starts from. Each contains a little of everything.

#include <cstdio>
#include <filesystem>

#include "shared/bundle/show_manifest.h"
#include "shared/core/check.h"
#include "shared/core/file.h"
#include "shared/stage/mesh_file.h"
#include "shared/stage/prop.h"
#include "tests/bundle/example_show.h"
#include "tests/human/full_body.h"
#include "tests/human/rich_human.h"
#include "tests/stage/test_props.h"

namespace lararium {
namespace {

stage::Prop RichProp(const human::Human& human) {
  stage::Prop prop = test::MakeChest();
  prop.textures = human.textures;
  prop.materials = human.materials;
  stage::PropMesh& lid = prop.parts[1].meshes[0];
  lid.material = 0;
  lid.uvs.assign(lid.positions.size(), {0.5f, 0.25f});
  prop.parts[0].meshes[0].emission = {2.0f, 1.0f, 0.5f};
  CHECK(prop.Validate("seed").ok());
  return prop;
}

std::string Manifest() {
  bundle::ShowManifest manifest = test::ExampleManifest();
  for (const char* name :
       {"drama.lua", "places/0/scene.larscene", "places/0/occluder0.larmesh", "cast/0.larhuman"}) {
    manifest.members.push_back({name, 1, bundle::ComputeSha256({})});
  }
  std::string text = bundle::FormatShowManifest(manifest);
  CHECK(bundle::ParseShowManifest(text, "seed").ok());
  return text;
}

// A 16-bit WAV with one channel, little-endian.
std::vector<std::byte> Wave() {
  std::vector<std::byte> bytes;
  const auto add = [&bytes](uint32_t value, int size) {
    for (int i = 0; i < size; ++i) {
      bytes.push_back(static_cast<std::byte>(value >> (8 * i)));
    }
  };
  const auto add_text = [&bytes](std::string_view text) {
    for (const char c : text) {
      bytes.push_back(static_cast<std::byte>(c));
    }
  };
  constexpr uint32_t kSamples = 64;
  constexpr uint32_t kRate = 8000;
  add_text("RIFF");
  add(36 + 2 * kSamples, 4);
  add_text("WAVEfmt ");
  add(16, 4);
  add(1, 2);  // linear
  add(1, 2);  // channels
  add(kRate, 4);
  add(2 * kRate, 4);
  add(2, 2);
  add(16, 2);
  add_text("data");
  add(2 * kSamples, 4);
  for (uint32_t i = 0; i < kSamples; ++i) {
    add(500 * (i % 16), 2);
  }
  return bytes;
}

Status WriteSeeds(const std::filesystem::path& folder) {
  const human::Human human = human::RichHuman();
  CHECK(human.Validate("seed").ok());
  LARARIUM_RETURN_IF_ERROR(
      WriteFileAtomically(folder / "human.larhuman", human::SerializeHuman(human)));
  LARARIUM_RETURN_IF_ERROR(WriteFileAtomically(folder / "body.larhuman",
                                               human::SerializeHuman(human::FullBody(0.4f, 0))));
  LARARIUM_RETURN_IF_ERROR(
      WriteFileAtomically(folder / "prop.larprop", stage::SerializeProp(RichProp(human))));
  LARARIUM_RETURN_IF_ERROR(WriteFileAtomically(folder / "manifest.json", Manifest()));
  LARARIUM_RETURN_IF_ERROR(WriteFileAtomically(folder / "sound.wav", Wave()));
  geometry::TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.normals.assign(3, {0, 0, 1});
  mesh.indices = {0, 1, 2};
  return WriteFileAtomically(folder / "mesh.larmesh", stage::SerializeMesh(mesh));
}

}  // namespace
}  // namespace lararium

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: make_seeds FOLDER\n");
    return 2;
  }
  const lararium::Status status = lararium::WriteSeeds(argv[1]);
  if (!status.ok()) {
    std::fprintf(stderr, "%s\n", status.message().c_str());
  }
  return status.ok() ? 0 : 1;
}
