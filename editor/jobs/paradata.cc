#include "editor/jobs/paradata.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <set>
#include <utility>

#include "editor/bake/caption_font.h"
#include "editor/document/check_sentences.h"
#include "editor/document/named_entries.h"
#include "editor/jobs/lines.h"
#include "editor/jobs/sounds.h"
#include "shared/core/file.h"
#include "shared/drama/timeline_text.h"

namespace lararium::editor {
namespace {

using stage::Subject;

void AddPeople(const ProjectDocument& document, std::vector<ProjectSubject>& subjects) {
  for (const CastDocument& member : document.cast) {
    subjects.push_back({Subject::kPerson, member.name});
  }
  for (const CastDocument& member : document.cast) {
    const auto recipe = RecipeOf(member);
    if (!recipe.ok() || !recipe->has_value()) {
      continue;
    }
    for (const Json& garment : (*recipe)->garments) {
      const auto name = garment.find("name");
      if (name != garment.end() && name->is_string()) {
        subjects.push_back({Subject::kGarment, member.name + "/" + name->get<std::string>()});
      }
    }
  }
  for (const CastDocument& member : document.cast) {
    for (const ClipDocument& clip : member.clips) {
      subjects.push_back({Subject::kClip, member.name + "/" + clip.name});
    }
  }
}

void AddLinesOf(const ProjectPaths& paths,
                const ProjectDocument& document,
                std::vector<ProjectSubject>& subjects) {
  const Result<ProjectLines> lines = LoadProjectLines(paths, document);
  if (!lines.ok()) {
    return;  // The check of the lines reports this error.
  }
  for (const bake::Line& line : lines->table.lines) {
    if (!ProjectLines::IsName(line, document) && !ProjectLines::Describes(line, document)) {
      subjects.push_back({Subject::kLine, line.id});
    }
  }
}

void AddPlaces(const ProjectDocument& document, std::vector<ProjectSubject>& subjects) {
  for (const PlaceDocument& place : document.places) {
    subjects.push_back({Subject::kPlace, place.name});
  }
  for (const PlaceDocument& place : document.places) {
    for (const OccluderDocument& occluder : place.occluders) {
      subjects.push_back({Subject::kOccluder, place.name + "/" + occluder.name});
    }
  }
  for (const PlaceDocument& place : document.places) {
    for (const ProbeDocument& probe : place.probes) {
      subjects.push_back({Subject::kProbe, place.name + "/" + probe.name});
    }
  }
}

void AddScenes(const ProjectPaths& paths, std::vector<ProjectSubject>& subjects) {
  subjects.push_back({Subject::kScene, std::string(stage::kWholeDrama)});
  const Result<std::string> script = ReadText(paths.Drama());
  if (!script.ok()) {
    return;
  }
  const auto timeline = drama::TimelineText::Read(*script, paths.Drama().filename().string());
  if (!timeline.ok()) {
    return;
  }
  std::set<std::string> known = {std::string(stage::kWholeDrama)};
  for (size_t lane = 0; lane < timeline->lanes().size(); ++lane) {
    const drama::TimelineLane& markers = timeline->lanes()[lane];
    for (size_t item = 0; markers.kind == drama::LaneKind::kMarkers && item < markers.size();
         ++item) {
      const std::optional<Json> name = timeline->Field({lane, item}, "name");
      if (name && name->is_string() && known.insert(name->get<std::string>()).second) {
        subjects.push_back({Subject::kScene, name->get<std::string>()});
      }
    }
  }
}

// Finds claims about subjects that the project does not have.
void CheckClaims(const std::string& place,
                 const stage::Paradata& paradata,
                 const std::vector<ProjectSubject>& subjects,
                 ParadataReport& report) {
  std::set<std::pair<Subject, std::string>> known;
  for (const ProjectSubject& subject : subjects) {
    known.insert({subject.subject, subject.name});
  }
  for (size_t kind = 0; kind < stage::kSubjectCount; ++kind) {
    const auto subject = static_cast<Subject>(kind);
    for (const auto& [name, claim] : paradata.claims[kind]) {
      if (!known.contains({subject, name})) {
        report.problems.push_back(
            AtPlace(place + ": claims." + std::string(NameOf(subject)),
                    Sentence("'%s' is not in the project; correct its name", {name})));
      }
    }
  }
}

void CheckSources(const std::string& place,
                  const stage::Paradata& paradata,
                  ParadataReport& report) {
  std::set<std::string_view> named;
  for (const stage::Paradata::Claims& claims : paradata.claims) {
    for (const auto& [name, claim] : claims) {
      named.insert(claim.sources.begin(), claim.sources.end());
    }
  }
  for (const auto& [key, reference] : paradata.sources) {
    if (!named.contains(key)) {
      report.warnings.push_back(AtPlace(place, Sentence("no claim cites the source '%s'", {key})));
    }
  }
}

// Finds letters that the font of captions lacks.
void CheckLetters(const std::string& place,
                  const stage::Paradata& paradata,
                  ParadataReport& report) {
  std::set<uint32_t> characters;
  for (const stage::Paradata::Claims& claims : paradata.claims) {
    for (const auto& [name, claim] : claims) {
      for (const auto& [language, text] : claim.text) {
        bake::AddCharacters(text, characters);
      }
    }
  }
  const auto missing = bake::MissingCharacters(bake::CaptionFontFile(), characters);
  if (!missing.ok()) {
    report.problems.push_back(missing.message());
    return;
  }
  for (const uint32_t character : *missing) {
    char code[16];
    std::snprintf(code, sizeof(code), "U+%04X", character);
    report.problems.push_back(
        AtPlace(place, Sentence("the captions' font has no character %s", {std::string(code)})));
  }
}

// Finds caption languages for which the texts on the certainty of people and objects are missing.
void CheckTexts(const std::string& place,
                const std::vector<std::string>& captions,
                const stage::Paradata& paradata,
                ParadataReport& report) {
  for (const std::string& language : captions) {
    std::vector<std::string> names;
    for (const Subject subject : {Subject::kPerson, Subject::kObject}) {
      for (const auto& [name, claim] : paradata.Of(subject)) {
        if (!claim.text.empty() && !claim.text.contains(language)) {
          names.push_back(name);
        }
      }
    }
    if (!names.empty()) {
      report.warnings.push_back(AtPlace(
          place, Sentence("has no text in '%s' for these, so visitors read another language: %s",
                          {language, JoinNames(names)})));
    }
  }
}

}  // namespace

std::filesystem::path ParadataFile(const ProjectPaths& paths) {
  return paths.folder / "paradata.json";
}

Result<stage::Paradata> LoadParadata(const ProjectPaths& paths) {
  if (!FileExists(ParadataFile(paths))) {
    return stage::Paradata();
  }
  LARARIUM_ASSIGN_OR_RETURN(const std::string text, ReadText(ParadataFile(paths), 16 << 20));
  return stage::ParseParadata(text, ParadataFile(paths).string());
}

std::vector<ProjectSubject> ListSubjects(const ProjectPaths& paths,
                                         const ProjectDocument& document) {
  std::vector<ProjectSubject> subjects;
  AddPeople(document, subjects);
  for (const ObjectDocument& object : document.objects) {
    subjects.push_back({Subject::kObject, object.name});
  }
  for (const SoundFile& sound : FindSounds(paths)) {
    subjects.push_back({Subject::kSound, sound.name, !sound.of_library});
  }
  AddLinesOf(paths, document, subjects);
  AddPlaces(document, subjects);
  AddScenes(paths, subjects);
  return subjects;
}

ParadataReport CheckParadata(const ProjectPaths& paths, const ProjectDocument& document) {
  ParadataReport report;
  const std::string place = ParadataFile(paths).filename().string();
  const Result<stage::Paradata> paradata = LoadParadata(paths);
  if (!paradata.ok()) {
    report.problems.push_back(paradata.message());
    return report;
  }
  const std::vector<ProjectSubject> subjects = ListSubjects(paths, document);
  std::array<int, stage::kCertaintyCount> counts = {};
  std::map<Subject, std::vector<std::string>> without;
  for (const ProjectSubject& subject : subjects) {
    const stage::Claim* claim = paradata->Find(subject.subject, subject.name);
    const auto certainty = claim == nullptr ? stage::Certainty::kUnsaid : claim->certainty;
    ++counts[static_cast<size_t>(certainty)];
    if (certainty == stage::Certainty::kUnsaid && subject.needs_claim) {
      without[subject.subject].push_back(subject.name);
    }
  }
  report.json["without"] = Json::object();
  for (const auto& [subject, names] : without) {
    const std::string kind(NameOf(subject));
    report.json["without"][kind] = names;
    report.warnings.push_back(AtPlace(
        place, Sentence("does not say how certain these %s are: %s", {kind, JoinNames(names)})));
  }
  for (size_t i = 1; i < counts.size(); ++i) {
    report.json[std::string(NameOf(static_cast<stage::Certainty>(i)))] = counts[i];
  }
  CheckClaims(place, *paradata, subjects, report);
  CheckSources(place, *paradata, report);
  if (const auto lines = LoadProjectLines(paths, document); lines.ok()) {
    CheckTexts(place, lines->captions, *paradata, report);
  }
  if (!paradata->empty()) {
    CheckLetters(place, *paradata, report);
  }
  return report;
}

}  // namespace lararium::editor
