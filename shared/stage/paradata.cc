#include "shared/stage/paradata.h"

#include <algorithm>
#include <initializer_list>
#include <utility>

#include "shared/core/json.h"
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

// Reads a text without control characters. Names and references have one line; texts for visitors
// may have several.
Result<std::string> PlainText(const JsonView& view, bool one_line) {
  LARARIUM_ASSIGN_OR_RETURN(std::string text, view.Text(kMaxClaimText));
  const bool plain = std::all_of(text.begin(), text.end(), [one_line](char c) {
    return (static_cast<unsigned char>(c) >= 0x20 && c != 0x7f) || (c == '\n' && !one_line);
  });
  if (!plain) {
    return view.Problem("holds control characters", "remove them");
  }
  return text;
}

Status ParseOptionalText(const JsonView& view, std::string_view key, std::string& text) {
  if (view.Has(key)) {
    LARARIUM_ASSIGN_OR_RETURN(const JsonView field, view.Field(key));
    LARARIUM_ASSIGN_OR_RETURN(text, PlainText(field, true));
  }
  return Status();
}

// Calls parse(name, member) for each member of an object.
template <typename Parse>
Status ParseMembers(const JsonView& view, size_t max_count, Parse parse) {
  if (!view.json().is_object() || view.json().size() > max_count) {
    return view.Problem("must be an object of at most " + std::to_string(max_count) + " entries");
  }
  for (const auto& [name, ignored] : view.json().items()) {
    LARARIUM_ASSIGN_OR_RETURN(const JsonView member, view.Field(name));
    const Json name_json = name;
    const Result<std::string> plain = PlainText(JsonView(name_json, member.place()), true);
    LARARIUM_RETURN_IF_ERROR(plain.status());
    if (name.empty() || name.size() > kMaxParadataName) {
      return view.Problem("has a name that is empty or longer than " +
                          std::to_string(kMaxParadataName) + " bytes");
    }
    LARARIUM_RETURN_IF_ERROR(parse(name, member));
  }
  return Status();
}

Status ParseCertainty(const JsonView& view, Claim& claim) {
  if (!view.Has("certainty")) {
    return Status();
  }
  LARARIUM_ASSIGN_OR_RETURN(const std::string name, view.Text("certainty", kMaxParadataName));
  const auto found = std::find(kCertainties.begin() + 1, kCertainties.end(), name);
  if (found == kCertainties.end()) {
    return view.Problem("\"certainty\" is '" + name + "'",
                        "choose attested, inferred or imagined, or leave it out");
  }
  claim.certainty = static_cast<Certainty>(found - kCertainties.begin());
  return Status();
}

Status ParseSourcesOf(const JsonView& view, const Paradata& paradata, Claim& claim) {
  if (!view.Has("source")) {
    return Status();
  }
  LARARIUM_ASSIGN_OR_RETURN(const JsonView field, view.Field("source"));
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<JsonView> keys, field.Array(kMaxSources));
  for (const JsonView& key : keys) {
    LARARIUM_ASSIGN_OR_RETURN(std::string name, key.Text(kMaxParadataName));
    if (!paradata.sources.contains(name)) {
      return key.Problem("there is no source '" + name + "'", "list it in \"sources\"");
    }
    claim.sources.push_back(std::move(name));
  }
  return Status();
}

Result<Claim> ParseClaim(const JsonView& view, const Paradata& paradata) {
  LARARIUM_RETURN_IF_ERROR(view.CheckFields({"certainty", "source", "author", "licence", "text"}));
  Claim claim;
  LARARIUM_RETURN_IF_ERROR(ParseCertainty(view, claim));
  LARARIUM_RETURN_IF_ERROR(ParseSourcesOf(view, paradata, claim));
  LARARIUM_RETURN_IF_ERROR(ParseOptionalText(view, "author", claim.author));
  LARARIUM_RETURN_IF_ERROR(ParseOptionalText(view, "licence", claim.licence));
  if (view.Has("text")) {
    LARARIUM_ASSIGN_OR_RETURN(const JsonView text, view.Field("text"));
    LARARIUM_RETURN_IF_ERROR(ParseMembers(
        text, kMaxLanguages, [&](const std::string& language, const JsonView& member) -> Status {
          if (!IsLanguageTag(language)) {
            return member.Problem("'" + language + "' is not a valid language tag",
                                  "use one such as la, it or en");
          }
          LARARIUM_ASSIGN_OR_RETURN(claim.text[language], PlainText(member, false));
          return Status();
        }));
  }
  return claim;
}

Json FormatClaim(const Claim& claim) {
  Json json = Json::object();
  if (claim.certainty != Certainty::kUnsaid) {
    json["certainty"] = NameOf(claim.certainty);
  }
  if (!claim.sources.empty()) {
    json["source"] = claim.sources;
  }
  if (!claim.author.empty()) {
    json["author"] = claim.author;
  }
  if (!claim.licence.empty()) {
    json["licence"] = claim.licence;
  }
  for (const auto& [language, text] : claim.text) {
    json["text"][language] = text;
  }
  return json;
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
  LARARIUM_ASSIGN_OR_RETURN(const Json root, ParseJson(text, where));
  const JsonView view(root, where);
  LARARIUM_ASSIGN_OR_RETURN(const int64_t schema, view.Integer("schema", 1, 1'000'000));
  if (schema > kSchema) {
    return view.Problem("was written by a newer Lararium (schema " + std::to_string(schema) +
                            ", this one reads up to " + std::to_string(kSchema) + ")",
                        "open it with that version");
  }
  LARARIUM_RETURN_IF_ERROR(view.CheckFields({"schema", "sources", "author", "licence", "claims"}));
  Paradata paradata;
  LARARIUM_RETURN_IF_ERROR(ParseOptionalText(view, "author", paradata.author));
  LARARIUM_RETURN_IF_ERROR(ParseOptionalText(view, "licence", paradata.licence));
  if (view.Has("sources")) {
    LARARIUM_ASSIGN_OR_RETURN(const JsonView sources, view.Field("sources"));
    LARARIUM_RETURN_IF_ERROR(ParseMembers(
        sources, kMaxSources, [&](const std::string& key, const JsonView& member) -> Status {
          LARARIUM_ASSIGN_OR_RETURN(paradata.sources[key], PlainText(member, true));
          return Status();
        }));
  }
  if (view.Has("claims")) {
    LARARIUM_ASSIGN_OR_RETURN(const JsonView claims, view.Field("claims"));
    LARARIUM_RETURN_IF_ERROR(ParseMembers(
        claims, kSubjectCount, [&](const std::string& kind, const JsonView& member) -> Status {
          const auto found = std::find(kSubjects.begin(), kSubjects.end(), kind);
          if (found == kSubjects.end()) {
            return member.Problem("there are no claims about '" + kind + "'",
                                  "use people, objects, lines, ... (docs/file-formats.md)");
          }
          Paradata::Claims& of_kind =
              paradata.claims[static_cast<size_t>(found - kSubjects.begin())];
          return ParseMembers(
              member, kMaxClaims, [&](const std::string& name, const JsonView& claim) -> Status {
                LARARIUM_ASSIGN_OR_RETURN(of_kind[name], ParseClaim(claim, paradata));
                return Status();
              });
        }));
  }
  return paradata;
}

std::string FormatParadata(const Paradata& paradata) {
  Json json = {{"schema", kSchema}, {"sources", Json::object()}, {"claims", Json::object()}};
  for (const auto& [key, reference] : paradata.sources) {
    json["sources"][key] = reference;
  }
  if (!paradata.author.empty()) {
    json["author"] = paradata.author;
  }
  if (!paradata.licence.empty()) {
    json["licence"] = paradata.licence;
  }
  for (size_t kind = 0; kind < kSubjectCount; ++kind) {
    for (const auto& [name, claim] : paradata.claims[kind]) {
      json["claims"][std::string(kSubjects[kind])][name] = FormatClaim(claim);
    }
  }
  return json.dump(1) + "\n";
}

}  // namespace lararium::stage
