#pragma once

// Paradata: what is known about the contents of a show and how certain it is (The London Charter
// for the computer-based visualisation of cultural heritage, 2.1, 2009: visitors should be able to
// tell evidence from hypothesis). docs/file-formats.md describes the file.

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "shared/core/status.h"

namespace lararium::stage {

enum class Certainty : uint8_t {
  kUnsaid,
  kAttested,  // Shown by evidence: a find, a text or a picture.
  kInferred,  // Inferred from evidence about others of its kind.
  kImagined,  // No evidence speaks for or against it.
};
inline constexpr size_t kCertaintyCount = 4;
// The name in files: "", "attested", "inferred", "imagined".
std::string_view NameOf(Certainty certainty);

// What a claim is about. The name of a part is "whole/part".
enum class Subject : uint8_t {
  kPerson,
  kGarment,  // "keeper/tunic"
  kClip,     // "keeper/wave"
  kObject,
  kSound,
  kLine,
  kPlace,
  kOccluder,  // "maquette/counter"
  kProbe,     // "maquette/noon"
  kScene,     // A marker of the drama, or kWholeDrama.
};
inline constexpr size_t kSubjectCount = 10;
inline constexpr std::string_view kWholeDrama = "drama";
// The name in files: "people", "garments", ...
std::string_view NameOf(Subject subject);

struct Claim {
  Certainty certainty = Certainty::kUnsaid;
  std::vector<std::string> sources;  // Keys of Paradata::sources.
  // Author and licence of the asset or the claim; empty: those of Paradata.
  std::string author;
  std::string licence;
  std::map<std::string, std::string, std::less<>> text;  // Texts for visitors, by language.

  // The text in this language, else in English, else in any language; "" if there is none.
  std::string_view Text(std::string_view language) const;
};

struct Paradata {
  using Claims = std::map<std::string, Claim, std::less<>>;  // Keys are names.

  std::map<std::string, std::string, std::less<>> sources;  // Full references by key.
  // Author and licence of claims that name none.
  std::string author;
  std::string licence;
  std::array<Claims, kSubjectCount> claims;  // Indexed by Subject.

  bool empty() const;
  const Claims& Of(Subject subject) const { return claims[static_cast<size_t>(subject)]; }
  // nullptr: there is no claim.
  const Claim* Find(Subject subject, std::string_view name) const;
};

// Checks every field. Errors: an unknown field, a source that is not listed, control characters.
// Messages begin with `where`.
Result<Paradata> ParseParadata(std::string_view text, const std::string& where);
std::string FormatParadata(const Paradata& paradata);

}  // namespace lararium::stage
