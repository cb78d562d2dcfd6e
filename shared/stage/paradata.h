#pragma once

// What is known of the things of a show and how certain it is (The London Charter for the
// computer-based visualisation of cultural heritage, 2.1, 2009: visitors should be able to
// tell evidence from hypothesis). docs/file-formats.md has the text's form.

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "shared/core/json.h"
#include "shared/core/status.h"

namespace lararium::stage {

enum class Certainty : uint8_t {
  kUnsaid,
  kAttested,  // found, written or painted: evidence shows it
  kInferred,  // from evidence about others of its kind
  kImagined,  // nothing speaks for it, or against it
};
inline constexpr size_t kCertaintyCount = 4;
// "", "attested", "inferred", "imagined"
std::string_view NameOf(Certainty certainty);

// What a claim is about. A part of something is called "whole/part".
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
  kScene,     // a marker of the drama; kWholeDrama
};
inline constexpr size_t kSubjectCount = 10;
inline constexpr std::string_view kWholeDrama = "drama";
// As files have it: "people", "garments", ...
std::string_view NameOf(Subject subject);

struct Claim {
  Certainty certainty = Certainty::kUnsaid;
  std::vector<std::string> sources;  // keys of Paradata::sources
  std::string author;                // of the asset or the claim; empty: Paradata's
  std::string licence;               // likewise
  std::map<std::string, std::string, std::less<>> text;  // by language; what visitors read

  // In a language, or else in English, or else in any; "" where there is none.
  std::string_view Text(std::string_view language) const;
};

struct Paradata {
  using Claims = std::map<std::string, Claim, std::less<>>;  // by name

  std::map<std::string, std::string, std::less<>> sources;  // key to full reference
  std::string author;                                       // where a claim names none
  std::string licence;
  std::array<Claims, kSubjectCount> claims;  // by Subject

  bool empty() const;
  const Claims& Of(Subject subject) const { return claims[static_cast<size_t>(subject)]; }
  // nullptr: nothing is claimed.
  const Claim* Find(Subject subject, std::string_view name) const;
};

// Checks every field; one that is not known, a source that is not listed and control
// characters are errors. place: what errors call the text.
Result<Paradata> ParseParadata(std::string_view text, const std::string& place);
std::string FormatParadata(const Paradata& paradata);

}  // namespace lararium::stage
