#include "shared/stage/paradata.h"

#include <algorithm>
#include <functional>
#include <utility>

#include "shared/core/json.h"
#include "shared/core/json_fields.h"
#include "shared/stage/caption_file.h"

namespace lararium::stage {
namespace {

constexpr int kSchema = 1;
constexpr size_t kMaxClaims = 10'000;  // Per subject.
constexpr size_t kMaxSources = 1000;
constexpr size_t kMaxLanguages = 64;
constexpr size_t kMaxParadataName = 200;  // Bytes.
constexpr size_t kMaxClaimText = 4000;    // Bytes.

constexpr std::array<std::string_view, kCertaintyCount> kCertainties = {"", "attested", "inferred",
                                                                        "imagined"};
constexpr std::array<std::string_view, kSubjectCount> kSubjects = {
    "people", "garments", "clips",     "objects", "sounds",
    "lines",  "places",   "occluders", "probes",  "scenes"};

// A text without control characters. Names and references have one line; texts for visitors may
// have several.
void RequirePlain(Fields& fields, const FieldKey& key, std::string_view text, bool one_line) {
  const bool plain = std::all_of(text.begin(), text.end(), [one_line](char c) {
    return (static_cast<unsigned char>(c) >= 0x20 && c != 0x7f) || (c == '\n' && !one_line);
  });
  fields.RequireAt(key, plain, "holds control characters", "remove them");
}

void DescribePlainText(Fields& fields,
                       const FieldKey& key,
                       std::string& text,
                       bool one_line = true) {
  fields.Text(key, text, kMaxClaimText);
  RequirePlain(fields, key, text, one_line);
}

void DescribeOptionalText(Fields& fields, std::string_view name, std::string& text) {
  DescribePlainText(fields, Optional(name, !text.empty()), text);
}

// Describes an object whose members have names of the author's choice.
template <typename Map, typename Describe>
void DescribeNamed(
    Fields& fields, const FieldKey& key, Map& map, size_t max_count, Describe describe) {
  fields.Entries(key, map, max_count,
                 "must be an object of at most " + std::to_string(max_count) + " entries",
                 [&](const FieldKey& name, auto& value) {
                   RequirePlain(fields, name, name.name, true);
                   fields.Require(!name.name.empty() && name.name.size() <= kMaxParadataName,
                                  "has a name that is empty or longer than " +
                                      std::to_string(kMaxParadataName) + " bytes");
                   describe(name, value);
                 });
}

void DescribeClaim(Fields& fields, const Paradata& paradata, Claim& claim) {
  constexpr std::string_view kRemedy = "choose attested, inferred or imagined, or leave it out";
  if (fields.Has("certainty", claim.certainty != Certainty::kUnsaid)) {
    fields.Choice("certainty", claim.certainty, kCertainties, "\"certainty\" is '{}'", kRemedy);
    fields.Require(claim.certainty != Certainty::kUnsaid, "\"certainty\" is ''", kRemedy);
  }
  fields.List(Optional("source", !claim.sources.empty()), claim.sources, kMaxSources,
              [&](const FieldKey& key, std::string& source) {
                fields.Text(key, source, kMaxParadataName);
                fields.RequireAt(key, paradata.sources.contains(source),
                                 "there is no source '" + source + "'", "list it in \"sources\"");
              });
  DescribeOptionalText(fields, "author", claim.author);
  DescribeOptionalText(fields, "licence", claim.licence);
  DescribeNamed(fields, Optional("text", !claim.text.empty()), claim.text, kMaxLanguages,
                [&](const FieldKey& language, std::string& text) {
                  fields.RequireAt(
                      language, IsLanguageTag(language.name),
                      "'" + std::string(language.name) + "' is not a valid language tag",
                      "use one such as la, it or en");
                  DescribePlainText(fields, language, text, false);
                });
}

// The claims in the order of their subjects' names, as in a file. While writing, only subjects with
// claims.
void DescribeClaims(Fields& fields, Paradata& paradata) {
  std::map<std::string, Paradata::Claims, std::less<>> by_subject;
  for (size_t i = 0; i < kSubjectCount; ++i) {
    if (!paradata.claims[i].empty()) {
      by_subject[std::string(kSubjects[i])] = paradata.claims[i];
    }
  }
  DescribeNamed(fields, Optional("claims"), by_subject, kSubjectCount,
                [&](const FieldKey& subject, Paradata::Claims& claims) {
                  const auto found = std::find(kSubjects.begin(), kSubjects.end(), subject.name);
                  fields.RequireAt(subject, found != kSubjects.end(),
                                   "there are no claims about '" + std::string(subject.name) + "'",
                                   "use people, objects, lines, ... (docs/file-formats.md)");
                  DescribeNamed(fields, subject, claims, kMaxClaims,
                                [&](const FieldKey& name, Claim& claim) {
                                  fields.Object(name, claim, [&](Fields& object, Claim& value) {
                                    DescribeClaim(object, paradata, value);
                                  });
                                });
                  if (fields.reading() && found != kSubjects.end()) {
                    paradata.claims[static_cast<size_t>(found - kSubjects.begin())] = claims;
                  }
                });
}

void DescribeParadata(Fields& fields, Paradata& paradata) {
  fields.Schema(kSchema,
                "was written by a newer Lararium (schema {}, this one reads up to " +
                    std::to_string(kSchema) + ")",
                "open it with that version");
  DescribeNamed(fields, Optional("sources"), paradata.sources, kMaxSources,
                [&](const FieldKey& key, std::string& reference) {
                  DescribePlainText(fields, key, reference);
                });
  DescribeOptionalText(fields, "author", paradata.author);
  DescribeOptionalText(fields, "licence", paradata.licence);
  DescribeClaims(fields, paradata);
}

}  // namespace

std::string_view NameOf(Certainty certainty) {
  return kCertainties[static_cast<size_t>(certainty)];
}
std::string_view NameOf(Subject subject) { return kSubjects[static_cast<size_t>(subject)]; }

std::string_view Claim::Text(std::string_view language) const {
  for (const std::string_view wanted : {language, std::string_view("en")}) {
    if (const auto found = text.find(wanted); found != text.end()) {
      return found->second;
    }
  }
  return text.empty() ? std::string_view() : std::string_view(text.begin()->second);
}

bool Paradata::empty() const {
  return sources.empty() && author.empty() && licence.empty() &&
         std::all_of(claims.begin(), claims.end(),
                     [](const Claims& of_kind) { return of_kind.empty(); });
}

const Claim* Paradata::Find(Subject subject, std::string_view name) const {
  const auto found = Of(subject).find(name);
  return found == Of(subject).end() ? nullptr : &found->second;
}

Result<Paradata> ParseParadata(std::string_view text, const std::string& where) {
  return ParseFields<Paradata>(text, where, DescribeParadata);
}

std::string FormatParadata(const Paradata& paradata) {
  return FormatFields(paradata, DescribeParadata).dump(1) + "\n";
}

}  // namespace lararium::stage
