// libFuzzer harness: any bytes as an archive, as a manifest, and as a publication, also a signed
// one. (The manifest's CRC-32 and the members' hashes normally protect the manifest; here it is
// reached directly.)

#include <span>
#include <string>
#include <string_view>

#include "shared/bundle/publication.h"
#include "shared/bundle/show_manifest.h"
#include "shared/bundle/zip_reader.h"
#include "shared/core/json.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace lararium::bundle;
  const auto bytes = std::as_bytes(std::span(data, size));
  if (const auto members = ReadZip(bytes, "fuzz.larshow"); members.ok()) {
    for (const ZipMember& member : *members) {
      CHECK(member.data.empty() ||
            (member.data.data() >= bytes.data() &&
             member.data.data() + member.data.size() <= bytes.data() + bytes.size()));
    }
  }
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  if (const auto manifest = ParseShowManifest(text, "manifest.json"); manifest.ok()) {
    CHECK(ParseShowManifest(FormatShowManifest(*manifest), "manifest.json").ok());
  }
  static const SecretKey key = MakeSecretKey();
  (void)ParsePublication(text, key.public_key(), "newest.json").ok();
  const lararium::Json envelope = {
      {"publication", std::string(text)},
      {"signature", FormatSignature(Sign(bytes, key, Signed::kPublication))}};
  (void)ParsePublication(lararium::DumpJson(envelope), key.public_key(), "newest.json").ok();
  return 0;
}
