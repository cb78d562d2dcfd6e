#include "editor/jobs/lines.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <set>
#include <system_error>
#include <utility>

#include "editor/bake/caption_font.h"
#include "editor/bake/caption_layout.h"
#include "editor/bake/line_folder.h"
#include "editor/document/check_sentences.h"
#include "editor/jobs/caption_glyphs.h"
#include "shared/bundle/show_manifest.h"
#include "shared/core/file.h"
#include "shared/show/evidence.h"
#include "shared/stage/viseme_file.h"

namespace lararium::editor {
namespace {

const CastDocument* FindActor(const ProjectDocument& document, std::string_view name) {
  const auto found = std::find_if(document.cast.begin(), document.cast.end(),
                                  [name](const CastDocument& m) { return m.name == name; });
  return found == document.cast.end() ? nullptr : &*found;
}

Status CheckLanguages(const std::vector<std::string>& wanted,
                      const std::vector<std::string>& known,
                      const std::string& place) {
  for (const std::string& language : wanted) {
    if (std::find(known.begin(), known.end(), language) == known.end()) {
      return Status::Error(place, "no line has a text in the language '" + language + "'",
                           "add a column for it to lines.csv");
    }
  }
  return Status();
}

Result<human::VisemeTrack> LoadVisemes(const SpokenLine& spoken) {
  if (!FileExists(spoken.visemes)) {
    return Status::Error(spoken.visemes.string(), "was not baked yet", "bake the project");
  }
  LARARIUM_ASSIGN_OR_RETURN(const std::string text, ReadText(spoken.visemes));
  return stage::ParseVisemes(text, spoken.visemes.string());
}

// The cues of a spoken line, with manual or automatic timing; empty where the line has no text for
// them.
Result<std::vector<stage::CaptionCue>> CuesOf(const SpokenLine& spoken,
                                              const human::VisemeTrack& visemes,
                                              const std::string& captions) {
  if (const auto placed = spoken.placed.find(captions); placed != spoken.placed.end()) {
    LARARIUM_ASSIGN_OR_RETURN(bake::CaptionFile file, LoadPlacedCaptions(placed->second));
    if (!file.cues.empty()) {
      return bake::ShownCues(std::move(file.cues));
    }
  }
  const auto text = spoken.line->text.find(captions);
  return text == spoken.line->text.end() ? std::vector<stage::CaptionCue>()
                                         : bake::LayOutCaptions(text->second, visemes);
}

Result<show::Speech> LoadLine(const SpokenLine& spoken,
                              const stage::CaptionBook& book,
                              const std::string& captions) {
  show::Speech speech;
  speech.name = spoken.line->id;
  speech.describes = spoken.describes;
  LARARIUM_ASSIGN_OR_RETURN(speech.visemes, LoadVisemes(spoken));
  LARARIUM_ASSIGN_OR_RETURN(speech.sound, ReadBytes(spoken.sound));
  const auto of_line = book.lines.find(speech.name);
  if (of_line != book.lines.end()) {
    const auto cues = of_line->second.find(captions);
    if (cues != of_line->second.end()) {
      speech.captions = cues->second;
    }
  }
  return speech;
}

}  // namespace

bool ProjectLines::IsName(const bake::Line& line, const ProjectDocument& document) {
  return line.speaker.empty() && FindActor(document, line.id) != nullptr;
}

bool ProjectLines::Describes(const bake::Line& line, const ProjectDocument& document) {
  return line.speaker == bundle::LineEntry::kDescription &&
         FindActor(document, line.speaker) == nullptr;
}

Result<ProjectLines> LoadProjectLines(const ProjectPaths& paths, const ProjectDocument& document) {
  ProjectLines lines;
  LARARIUM_ASSIGN_OR_RETURN(bake::LinesFile file, bake::ReadLines(paths.folder));
  lines.table = std::move(file.table);
  lines.note = std::move(file.note);
  lines.left_out = std::move(file.left_out);
  lines.spoken = document.speech.spoken;
  lines.captions = document.speech.captions;
  const std::vector<std::string>& known = lines.table.languages;
  LARARIUM_RETURN_IF_ERROR(
      CheckLanguages(lines.spoken, known, paths.Project().string() + ": speech.spoken"));
  LARARIUM_RETURN_IF_ERROR(
      CheckLanguages(lines.captions, known, paths.Project().string() + ": speech.captions"));
  if (lines.spoken.empty() && !known.empty()) {
    lines.spoken = {known.front()};
  }
  if (lines.captions.empty()) {
    lines.captions = known;
  }
  return lines;
}

Result<std::vector<SpokenLine>> SpokenLines(const ProjectPaths& paths,
                                            const ProjectDocument& document,
                                            const ProjectLines& lines) {
  std::map<std::string, bake::LineFolder> folders;  // The key is the language.
  std::vector<SpokenLine> spoken;
  for (const bake::Line& line : lines.table.lines) {
    if (ProjectLines::IsName(line, document)) {
      continue;
    }
    const CastDocument* speaker = FindActor(document, line.speaker);
    const bool describes = ProjectLines::Describes(line, document);
    const bake::VoiceSettings voice = describes            ? document.speech.description
                                      : speaker != nullptr ? speaker->voice
                                                           : bake::VoiceSettings();
    for (const std::string& language : describes ? lines.captions : lines.spoken) {
      const auto text = line.text.find(language);
      if (text == line.text.end()) {
        continue;
      }
      const bake::LineFolder& folder =
          folders.try_emplace(language, paths.Recordings(language), lines.table.lines)
              .first->second;
      LARARIUM_ASSIGN_OR_RETURN(const std::filesystem::path recording, folder.Recording(line.id));
      SpokenLine& added =
          spoken.emplace_back(SpokenLine{&line,
                                         language,
                                         describes,
                                         {text->second, language, voice, recording},
                                         paths.Speech(language, line.id + ".flac"),
                                         paths.Speech(language, line.id + ".visemes.json"),
                                         {}});
      for (const std::string& captions : lines.captions) {
        LARARIUM_ASSIGN_OR_RETURN(std::filesystem::path file, folder.Captions(line.id, captions));
        if (!file.empty()) {
          added.placed[captions] = std::move(file);
        }
      }
    }
  }
  return spoken;
}

LineNotes CheckLineFiles(const ProjectPaths& paths,
                         const ProjectLines& lines,
                         std::span<const SpokenLine> spoken) {
  LineNotes notes;
  if (!lines.note.empty()) {
    notes.warnings.push_back(lines.note);
  }
  for (const Status& left_out : lines.left_out) {
    notes.problems.push_back(Sentence("%s; it was left out", {left_out.message()}));
  }
  std::set<std::string> languages(lines.spoken.begin(), lines.spoken.end());
  languages.insert(lines.captions.begin(), lines.captions.end());
  for (const std::string& language : languages) {
    const bake::LineFolder folder(paths.Recordings(language), lines.table.lines);
    for (const bake::StrayFile& stray : folder.Strays()) {
      if (stray.line.empty()) {
        notes.warnings.push_back(AtPlace(stray.file.string(), Sentence("belongs to no line")));
      } else {
        notes.problems.push_back(
            AtPlace(stray.file.string(),
                    Sentence("is not used; if it is the recording of the line '%s', name it %s",
                             {stray.line, stray.line + stray.file.extension().string()})));
      }
    }
  }
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(paths.folder / "audio", error)) {
    const std::string name = entry.path().filename().string();
    std::error_code ignored;
    if (entry.is_directory(ignored) && !languages.contains(name) &&
        !bake::LineFolder(entry.path(), {}).Strays().empty()) {
      notes.problems.push_back(AtPlace(
          entry.path().string(),
          Sentence("holds recordings or captions, but '%s' is no language of the lines", {name})));
    }
  }
  for (const SpokenLine& line : spoken) {
    for (const auto& [captions, file] : line.placed) {
      const Result<bake::CaptionFile> read = LoadPlacedCaptions(file);
      for (size_t k = 0; read.ok() && k < read->notes.size(); ++k) {
        notes.problems.push_back(AtPlace(file.string(), read->notes[k]));
      }
    }
  }
  return notes;
}

Result<bake::CaptionFile> LoadPlacedCaptions(const std::filesystem::path& file) {
  LARARIUM_ASSIGN_OR_RETURN(const std::string text, ReadText(file));
  return bake::ParseCaptionFile(text, file.string());
}

Result<stage::CaptionBook> MakeCaptions(const ProjectDocument& document,
                                        const ProjectLines& lines,
                                        std::span<const SpokenLine> spoken,
                                        const std::string& language) {
  stage::CaptionBook book;
  for (const bake::Line& line : lines.table.lines) {
    if (ProjectLines::IsName(line, document)) {
      book.names[line.id] = {line.text.begin(), line.text.end()};
    }
  }
  for (const SpokenLine& line : spoken) {
    if (line.language != language || line.describes) {
      continue;
    }
    LARARIUM_ASSIGN_OR_RETURN(const human::VisemeTrack visemes, LoadVisemes(line));
    for (const std::string& captions : lines.captions) {
      LARARIUM_ASSIGN_OR_RETURN(std::vector<stage::CaptionCue> cues,
                                CuesOf(line, visemes, captions));
      if (!cues.empty()) {
        book.lines[line.line->id][captions] = std::move(cues);
      }
    }
  }
  return book;
}

Result<stage::CaptionBook> MakeDescriptions(std::span<const SpokenLine> spoken,
                                            const std::string& language) {
  stage::CaptionBook book;
  for (const SpokenLine& line : spoken) {
    if (line.language == language && line.describes) {
      LARARIUM_ASSIGN_OR_RETURN(const human::VisemeTrack visemes, LoadVisemes(line));
      LARARIUM_ASSIGN_OR_RETURN(book.lines[line.line->id][language],
                                CuesOf(line, visemes, language));
    }
  }
  return book;
}

Result<render::CaptionFont> MakeCaptionFont(const ProjectLines& lines,
                                            std::span<const SpokenLine> spoken,
                                            const stage::Paradata& paradata,
                                            std::vector<Sentence>& warnings) {
  std::set<uint32_t> characters = bake::CommonCharacters();
  for (const bake::Line& line : lines.table.lines) {
    for (const std::string& language : lines.captions) {
      const auto text = line.text.find(language);
      if (text != line.text.end()) {
        bake::AddCharacters(text->second, characters);
      }
    }
  }
  for (const SpokenLine& line : spoken) {
    for (const auto& [language, file] : line.placed) {
      LARARIUM_ASSIGN_OR_RETURN(const bake::CaptionFile captions, LoadPlacedCaptions(file));
      for (const bake::FileCue& cue : captions.cues) {
        bake::AddCharacters(cue.text, characters);
      }
    }
  }
  for (const stage::Paradata::Claims& claims : paradata.claims) {
    for (const auto& [name, claim] : claims) {
      for (const auto& [language, text] : claim.text) {
        bake::AddCharacters(text, characters);
      }
    }
  }
  for (const std::string& language : lines.captions) {
    for (size_t i = 0; i < stage::kCertaintyCount; ++i) {
      const auto certainty = static_cast<stage::Certainty>(i);
      bake::AddCharacters(show::EvidenceWord(certainty, language), characters);
    }
  }
  LARARIUM_ASSIGN_OR_RETURN(bake::CaptionFontBake made,
                            bake::BakeCaptionFont(bake::CaptionFontFile(), characters));
  for (const uint32_t character : made.missing) {
    char code[16];
    std::snprintf(code, sizeof(code), "U+%04X", character);
    warnings.push_back(Sentence("captions: the font has no character %s", {std::string(code)}));
  }
  return std::move(made.font);
}

Status AddLines(const ProjectPaths& paths,
                const ProjectDocument& document,
                const show::LanguageChoice& languages,
                show::ShowContent& content) {
  LARARIUM_ASSIGN_OR_RETURN(const ProjectLines lines, LoadProjectLines(paths, document));
  const std::string place = paths.Project().string();
  LARARIUM_ASSIGN_OR_RETURN(const std::string language,
                            show::ChooseLanguage(lines.spoken, languages.spoken, "speech", place));
  std::string captions;
  if (languages.captions != show::kNoCaptions) {
    LARARIUM_ASSIGN_OR_RETURN(
        captions, show::ChooseLanguage(lines.captions, languages.captions, "captions", place));
  }
  LARARIUM_ASSIGN_OR_RETURN(auto spoken, SpokenLines(paths, document, lines));
  LARARIUM_ASSIGN_OR_RETURN(stage::CaptionBook book,
                            MakeCaptions(document, lines, spoken, language));
  const std::string described = !captions.empty()        ? captions
                                : lines.captions.empty() ? language
                                                         : lines.captions.front();
  LARARIUM_ASSIGN_OR_RETURN(stage::CaptionBook descriptions, MakeDescriptions(spoken, described));
  book.lines.merge(descriptions.lines);
  // Each line in the wanted language, otherwise in the first language that it has.
  std::stable_partition(spoken.begin(), spoken.end(), [&](const SpokenLine& line) {
    return line.language == (line.describes ? described : language);
  });
  for (const SpokenLine& line : spoken) {
    const bool is_there =
        std::any_of(content.speech.begin(), content.speech.end(),
                    [&](const show::Speech& speech) { return speech.name == line.line->id; });
    if (!is_there) {
      LARARIUM_ASSIGN_OR_RETURN(content.speech.emplace_back(), LoadLine(line, book, captions));
    }
  }
  content.language = captions.empty() ? language : captions;
  if (!captions.empty() || !content.paradata.empty()) {
    std::vector<Sentence> ignored;
    LARARIUM_ASSIGN_OR_RETURN(content.caption_font,
                              MakeCaptionFont(lines, spoken, content.paradata, ignored));
  }
  for (show::CastMember& member : content.cast) {
    const auto names = book.names.find(member.name);
    if (names != book.names.end() && names->second.contains(captions)) {
      member.title = names->second.find(captions)->second;
    }
  }
  return Status();
}

}  // namespace lararium::editor
