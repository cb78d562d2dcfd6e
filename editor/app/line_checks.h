#pragma once

// What is wrong with a project's lines, and what a drama says of them when.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "editor/app/lines.h"
#include "editor/app/project.h"
#include "shared/drama/drama.h"
#include "shared/stage/stage.h"

namespace lararium::app {

// A line as a drama said it.
struct SaidLine {
  std::string line;
  std::string actor;
  double begin = 0.0;    // seconds of the drama
  double seconds = 0.0;  // that it was heard
  bool cut = false;      // broken off before its end
};

// Listens to a stage, tick by tick.
class LineListener {
 public:
  LineListener(const stage::Stage& stage, const show::ShowContent& content)
      : stage_(stage), content_(content) {}

  // After a tick; time: of the drama.
  void Listen(double time);
  // In the order of their beginnings.
  const std::vector<SaidLine>& said() const { return said_; }

 private:
  struct Open {
    stage::ActorId actor;
    stage::Utterance utterance;
    size_t said = 0;  // its place in there
  };

  const stage::Stage& stage_;
  const show::ShowContent& content_;
  stage::StageSnapshot snapshot_;
  std::vector<Open> open_;
  std::vector<SaidLine> said_;
};

// Lines of the script that are written out, in `a:say("line")` and in speech lanes of tracks:
// ids that the table lacks, and lanes whose items are shorter than what is said in them.
std::vector<std::string> CheckScriptLines(const ProjectPaths& paths,
                                          const ProjectDocument& document,
                                          const ProjectLines& lines,
                                          const std::string& script);

// Texts that lack a language, speakers that are nobody, captions that leave too little time to
// read, characters that the font lacks. Lines must be baked for the times.
std::vector<std::string> CheckTable(const ProjectPaths& paths,
                                    const ProjectDocument& document,
                                    const ProjectLines& lines);

// Lines that were said by somebody else than their speaker, or broken off by the next. tasks:
// of the same run, which know where that was told.
std::vector<std::string> CheckSaid(const ProjectPaths& paths,
                                   const ProjectLines& lines,
                                   const std::vector<SaidLine>& said,
                                   std::span<const drama::TaskRecord> tasks);

}  // namespace lararium::app
