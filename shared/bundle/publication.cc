#include "shared/bundle/publication.h"

#include <limits>
#include <optional>
#include <span>

#include "shared/bundle/zip_layout.h"
#include "shared/core/json.h"
#include "shared/core/json_fields.h"

namespace lararium::bundle {
namespace {

constexpr char kPublishAgain[] = "publish the show again with the museum's key";

// newest.json: the publication as a text, which is what was signed.
struct Envelope {
  std::string publication;
  std::string signature;
};

void DescribeEnvelope(Fields& fields, Envelope& envelope) {
  fields.Text("publication", envelope.publication, kMaxNewestBytes);
  fields.Text("signature", envelope.signature, 2 * std::tuple_size_v<Signature>);
}

void DescribePublication(Fields& fields, Publication& publication) {
  fields.Schema(1, "was written by a newer editor", "install the player of the same version");
  fields.Integer("serial", publication.serial, 1, std::numeric_limits<int64_t>::max());
  std::string hash = FormatSha256(publication.manifest);
  fields.Text("manifest", hash, 64);
  const std::optional<Sha256> parsed = ParseSha256(hash);
  fields.RequireAt("manifest", parsed.has_value(), "is no SHA-256", kPublishAgain);
  publication.manifest = parsed.value_or(Sha256());
  fields.Integer("manifest_size", publication.manifest_size, 1, int64_t{kMaxManifestBytes});
  fields.Integer("size", publication.size, 1, int64_t{kMaxBundleBytes});
}

std::span<const std::byte> BytesOf(std::string_view text) {
  return std::as_bytes(std::span(text.data(), text.size()));
}

}  // namespace

std::string FormatPublication(const Publication& publication, const SecretKey& key) {
  const std::string text = DumpJson(FormatFields(publication, DescribePublication));
  const std::string signature = FormatSignature(Sign(BytesOf(text), key, Signed::kPublication));
  return DumpJson(FormatFields(Envelope{text, signature}, DescribeEnvelope)) + "\n";
}

Result<Publication> ParsePublication(std::string_view text,
                                     const PublicKey& trusted,
                                     const std::string& where) {
  LARARIUM_ASSIGN_OR_RETURN(const Envelope envelope,
                            ParseFields<Envelope>(text, where, DescribeEnvelope));
  const std::optional<Signature> signature = ParseSignature(envelope.signature);
  if (!signature || !Verifies(BytesOf(envelope.publication), std::as_bytes(std::span(*signature)),
                              trusted, Signed::kPublication)) {
    return Status::Error(where, "is not signed with the trusted key, or was altered",
                         kPublishAgain);
  }
  return ParseFields<Publication>(envelope.publication, where, DescribePublication,
                                  UnknownFields::kIgnore);
}

}  // namespace lararium::bundle
