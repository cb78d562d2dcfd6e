#pragma once

// Runs a drama without pictures and records what its script makes people do, for the timeline.

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "editor/check/walk_trails.h"
#include "editor/document/project.h"
#include "editor/jobs/sounds.h"
#include "shared/core/log.h"
#include "shared/core/progress.h"
#include "shared/core/status.h"
#include "shared/drama/drama.h"
#include "shared/human/face.h"
#include "shared/show/show_content.h"
#include "shared/stage/stage.h"

namespace lararium::editor {

// The names that a drama can use, for completion in the editor.
struct StageWords {
  struct Timed {
    std::string name;
    double seconds = 0.0;
  };
  struct Person {
    std::string name;
    std::vector<Timed> clips;
  };
  struct Thing {
    std::string name;
    std::vector<std::string> actions;
    std::vector<std::string> surfaces;
    bool burns = false;  // The object has a light.
  };
  // A line as spoken in the first language.
  struct Line {
    static constexpr double kPeaksPerSecond = 100.0;

    std::string name;
    double seconds = 0.0;
    std::vector<uint8_t> peaks;  // Peaks of the sound, 255 is full scale; empty if there is none.
    std::vector<human::VisemeTrack::Key> visemes;
  };
  std::vector<Person> people;
  std::vector<Thing> things;
  std::vector<Line> lines;
  std::vector<std::string> sounds;

  const Person* FindPerson(std::string_view name) const;
  const Thing* FindThing(std::string_view name) const;
  // 0 if it is unknown.
  double ClipSeconds(std::string_view person, std::string_view clip) const;
  const Line* FindLine(std::string_view name) const;
};

struct DramaRun {
  std::vector<drama::TaskRecord> tasks;  // Sorted by begin.
  std::vector<std::string> problems;     // "drama.lua:12: ...", each failure once.
  double seconds = 0.0;                  // Duration of the run.
  double last = 0.0;                     // End of the last task.
  std::vector<Trail> trails;             // Paths of all people.
  // The walkable floor at the end, with all doors open; nullptr if no one walked.
  std::shared_ptr<const stage::Navigation> floor;
  StageWords words;
  std::vector<MissingSound> missing_sounds;  // Set even if the drama could not run.
};

// A script at its beginning on the stage of a project.
struct StagedDrama {
  stage::Stage stage;
  show::ShowContent content;
  std::shared_ptr<Log> log;
  std::unique_ptr<drama::Drama> drama;
};

// `spoken` is a language tag; "" means the first language of the project. Fails if content of
// the stage is missing or the script does not compile.
Result<std::unique_ptr<StagedDrama>> StageDrama(const ProjectPaths& paths,
                                                const ProjectDocument& document,
                                                const std::string& spoken,
                                                const std::string& script);

// Runs the drama for `seconds`. Fails only if it is cancelled.
Status PlayDry(
    drama::Drama& drama,
    double seconds,
    Progress& progress,
    const std::function<void()>& after_tick = [] {});

// Stages a drama and runs it.
Result<DramaRun> RunDrama(const ProjectPaths& paths,
                          const ProjectDocument& document,
                          const std::string& spoken,
                          const std::string& script,
                          double seconds,
                          Progress& progress);

}  // namespace lararium::editor
