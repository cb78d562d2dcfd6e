#pragma once

// The lines of a project, spoken and written.

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "editor/bake/caption_file.h"
#include "editor/bake/line_table.h"
#include "editor/bake/speech.h"
#include "editor/document/project.h"
#include "shared/core/sentence.h"
#include "shared/core/status.h"
#include "shared/render/text/caption_font.h"
#include "shared/show/show_content.h"
#include "shared/stage/caption_file.h"
#include "shared/stage/paradata.h"

namespace lararium::editor {

// The table of lines and the languages of the show. The first of each list is the default for
// visitors.
struct ProjectLines {
  bake::LineTable table;
  std::vector<std::string> spoken;
  std::vector<std::string> captions;
  // See bake::LinesFile.
  std::string note;
  std::vector<Status> left_out;

  // Whether a row contains the name of an actor in captions; such a row is not spoken.
  static bool IsName(const bake::Line& line, const ProjectDocument& document);
  // Whether a row is an audio description for visitors with low vision, in the language of
  // captions.
  static bool Describes(const bake::Line& line, const ProjectDocument& document);
};
Result<ProjectLines> LoadProjectLines(const ProjectPaths& paths, const ProjectDocument& document);

// A line in a language in which it has a text: a spoken language, or, for a description, a caption
// language.
struct SpokenLine {
  const bake::Line* line = nullptr;  // An entry of ProjectLines::table.
  std::string language;
  bool describes = false;
  bake::SpeechSource source;
  std::filesystem::path sound;    // The baked sound.
  std::filesystem::path visemes;  // The baked visemes.
  // Files of captions with manual timing, by the language of the captions.
  std::map<std::string, std::filesystem::path> placed;
};
Result<std::vector<SpokenLine>> SpokenLines(const ProjectPaths& paths,
                                            const ProjectDocument& document,
                                            const ProjectLines& lines);

// What is wrong with the files of the lines, of which `spoken` are all: rows and captions that were
// left out, recordings whose name only nearly fits a line (problems); encodings that were guessed
// and files that belong to no line (warnings).
struct LineNotes {
  std::vector<Sentence> problems;
  std::vector<Sentence> warnings;
};
LineNotes CheckLineFiles(const ProjectPaths& paths,
                         const ProjectLines& lines,
                         std::span<const SpokenLine> spoken);

// Reads a file of SpokenLine::placed.
Result<bake::CaptionFile> LoadPlacedCaptions(const std::filesystem::path& file);

// The captions while the lines are spoken in a language. `spoken` are all lines (SpokenLines()).
// Fails where a line was not baked.
Result<stage::CaptionBook> MakeCaptions(const ProjectDocument& document,
                                        const ProjectLines& lines,
                                        std::span<const SpokenLine> spoken,
                                        const std::string& language);

// The captions while descriptions are heard in a language, in the same language. Fails where one
// was not baked.
Result<stage::CaptionBook> MakeDescriptions(std::span<const SpokenLine> spoken,
                                            const std::string& language);

// Adds lines, glyphs and speakers' names to content, whose cast must be set. Fails where a line was
// not baked, or where the project does not have a language.
Status AddLines(const ProjectPaths& paths,
                const ProjectDocument& document,
                const show::LanguageChoice& languages,
                show::ShowContent& content);

}  // namespace lararium::editor
