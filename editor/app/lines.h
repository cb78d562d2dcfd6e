#pragma once

// The lines of a project as they are said and read.

#include <filesystem>
#include <string>
#include <vector>

#include "editor/app/project.h"
#include "editor/bake/line_table.h"
#include "editor/bake/speech.h"
#include "shared/core/sentence.h"
#include "shared/core/status.h"
#include "shared/render/caption_font.h"
#include "shared/show/show_content.h"
#include "shared/stage/caption_file.h"
#include "shared/stage/paradata.h"

namespace lararium::app {

// The table and the languages of the show, the first of each being that of visitors who
// choose none.
struct ProjectLines {
  bake::LineTable table;
  std::vector<std::string> spoken;
  std::vector<std::string> captions;

  // A row that tells what captions call an actor: nobody says it.
  static bool IsName(const bake::Line& line, const ProjectDocument& document);
  // What visitors who do not see well hear instead: in the language that others would read.
  static bool Describes(const bake::Line& line, const ProjectDocument& document);
};
Result<ProjectLines> LoadProjectLines(const ProjectPaths& paths, const ProjectDocument& document);

// A line that has a text in a language that is spoken; a description, in one of captions.
struct SpokenLine {
  const bake::Line* line = nullptr;  // of the table
  std::string language;
  bool describes = false;
  bake::SpeechSource source;
  std::filesystem::path sound;    // where it is baked
  std::filesystem::path visemes;  // likewise
};
Result<std::vector<SpokenLine>> SpokenLines(const ProjectPaths& paths,
                                            const ProjectDocument& document,
                                            const ProjectLines& lines);

// What is to be read while the lines are said in a language. Fails where one was not baked.
Result<stage::CaptionBook> MakeCaptions(const ProjectPaths& paths,
                                        const ProjectDocument& document,
                                        const ProjectLines& lines,
                                        const std::string& language);

// What is to be read while descriptions are heard in a language: the same in that language. Fails
// where one was not baked.
Result<stage::CaptionBook> MakeDescriptions(const ProjectPaths& paths,
                                            const ProjectDocument& document,
                                            const ProjectLines& lines,
                                            const std::string& language);

// The letters of all captions and names. Adds a warning for characters that the font has not.
// paradata: which the evidence view writes.
Result<render::CaptionFont> MakeCaptionFont(const ProjectLines& lines,
                                            const stage::Paradata& paradata,
                                            std::vector<Sentence>& warnings);

// Adds lines, letters and speakers' names to content, whose cast is there. Fails where a line was
// not baked, or a language is none of the project's.
Status AddLines(const ProjectPaths& paths,
                const ProjectDocument& document,
                const show::LanguageChoice& languages,
                show::ShowContent& content);

}  // namespace lararium::app
