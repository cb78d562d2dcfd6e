#pragma once

// What is wrong with a project's lines, and what a drama says of them when.

#include <map>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "editor/app/lines.h"
#include "editor/app/project.h"
#include "shared/core/sentence.h"
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

// Listens to what is described: it is heard in pauses of what people say, in all languages.
class DescriptionListener {
 public:
  // longest: seconds of each description, LongestDescriptions(). Borrows the rest.
  DescriptionListener(const stage::Stage& stage,
                      const show::ShowContent& content,
                      std::map<std::string, double> longest);

  // After a tick; time: of the drama.
  void Listen(double time);
  // That were heard.
  const std::set<std::string>& described() const { return described_; }
  // Descriptions that found no pause, lines that were begun before one had ended.
  const std::vector<Sentence>& problems() const { return problems_; }

 private:
  const std::string& NameOf(int line) const;
  void Tell(Sentence problem, double time);

  const stage::Stage& stage_;
  const show::ShowContent& content_;
  std::map<std::string, double> longest_;
  int waiting_ = -1;
  std::string last_;    // that was heard
  double ends_ = -1.0;  // when, in its longest language
  std::set<std::string> described_;
  std::vector<Sentence> problems_;
};

// How long each description takes in the language in which it is longest, seconds. Those that
// were not baked are not there.
std::map<std::string, double> LongestDescriptions(const ProjectPaths& paths,
                                                  const ProjectDocument& document,
                                                  const ProjectLines& lines);

// Lines of the script that are written out, in `a:say("line")`, in `describe("line")` and in their
// lanes of tracks: ids that the table lacks, described lines that are none, and lanes whose items
// are shorter than what is said in them.
std::vector<Sentence> CheckScriptLines(const ProjectPaths& paths,
                                       const ProjectDocument& document,
                                       const ProjectLines& lines,
                                       const std::string& script);

// Texts that lack a language, speakers that are nobody, captions that leave too little time to
// read, characters that the font lacks. Lines must be baked for the times.
std::vector<Sentence> CheckTable(const ProjectPaths& paths,
                                 const ProjectDocument& document,
                                 const ProjectLines& lines);

// Lines that were said by somebody else than their speaker, or broken off by the next. tasks:
// of the same run, which know where that was told.
std::vector<Sentence> CheckSaid(const ProjectPaths& paths,
                                const ProjectLines& lines,
                                const std::vector<SaidLine>& said,
                                std::span<const drama::TaskRecord> tasks);

}  // namespace lararium::app
