#pragma once

// Checks the lines of a project and their use in the drama.

#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "editor/document/project.h"
#include "editor/jobs/lines.h"
#include "shared/core/sentence.h"
#include "shared/drama/drama.h"
#include "shared/stage/stage.h"

namespace lararium::editor {

// A record of a line that was said.
struct SaidLine {
  std::string line;
  std::string actor;
  double begin = 0.0;    // Seconds of the drama.
  double seconds = 0.0;  // Duration that was audible.
  bool cut = false;      // Interrupted before its end.
};

// Records the lines said on a stage, tick by tick.
class LineListener {
 public:
  LineListener(const stage::Stage& stage, const show::ShowContent& content)
      : stage_(stage), content_(content) {}

  // Call after each tick with the time of the drama.
  void Listen(double time);
  // Sorted by begin.
  const std::vector<SaidLine>& said() const { return said_; }

 private:
  struct Open {
    stage::ActorId actor;
    stage::Utterance utterance;
    size_t said = 0;  // Index into `said_`.
  };

  const stage::Stage& stage_;
  const show::ShowContent& content_;
  stage::StageSnapshot snapshot_;
  std::vector<Open> open_;
  std::vector<SaidLine> said_;
};

// Checks that audio descriptions fit into pauses of the speech in all languages.
class DescriptionListener {
 public:
  // `longest` is the result of LongestDescriptions(). Keeps references to the other arguments.
  DescriptionListener(const stage::Stage& stage,
                      const show::ShowContent& content,
                      std::map<std::string, double> longest);

  // Call after each tick with the time of the drama.
  void Listen(double time);
  // Ids of the descriptions that were played.
  const std::set<std::string>& described() const { return described_; }
  // Descriptions without a pause, and lines that began before a description had ended.
  const std::vector<Sentence>& problems() const { return problems_; }

 private:
  const std::string& NameOf(int line) const;
  void Tell(Sentence problem, double time);

  const stage::Stage& stage_;
  const show::ShowContent& content_;
  std::map<std::string, double> longest_;
  int waiting_ = -1;
  std::string last_;    // The last description played.
  double ends_ = -1.0;  // End of `last_` in its longest language.
  std::set<std::string> described_;
  std::vector<Sentence> problems_;
};

// Duration of each description in the language in which it is longest, seconds. Descriptions
// that were not baked are missing.
std::map<std::string, double> LongestDescriptions(const ProjectPaths& paths,
                                                  const ProjectDocument& document,
                                                  const ProjectLines& lines);

// Checks lines that the script names, in `a:say("line")`, in `describe("line")` and in the
// lanes for them: ids that the table lacks, ids in describe() that are not descriptions, and
// items shorter than their line. `spoken` are all lines (SpokenLines()).
std::vector<Sentence> CheckScriptLines(const ProjectPaths& paths,
                                       const ProjectDocument& document,
                                       const ProjectLines& lines,
                                       std::span<const SpokenLine> spoken,
                                       const std::string& script);

// Finds texts that lack a language, unknown speakers, captions with too little time to read,
// and characters that the font lacks. The times require baked lines.
std::vector<Sentence> CheckTable(const ProjectPaths& paths,
                                 const ProjectDocument& document,
                                 const ProjectLines& lines,
                                 std::span<const SpokenLine> spoken);

// Finds lines that another person than their speaker says, or that the next line interrupts.
// `tasks` belong to the same run and give the locations in the script.
std::vector<Sentence> CheckSaid(const ProjectPaths& paths,
                                const ProjectLines& lines,
                                const std::vector<SaidLine>& said,
                                std::span<const drama::TaskRecord> tasks);

}  // namespace lararium::editor
