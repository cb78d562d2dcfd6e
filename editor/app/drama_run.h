#pragma once

// A drama played through without being drawn: what its script makes people do, for the
// timeline to show.

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "editor/app/project.h"
#include "editor/app/sounds.h"
#include "editor/app/walk_trails.h"
#include "shared/core/log.h"
#include "shared/core/progress.h"
#include "shared/core/status.h"
#include "shared/drama/drama.h"
#include "shared/human/face.h"
#include "shared/show/show_content.h"
#include "shared/stage/stage.h"

namespace lararium::app {

// What a drama can name, for whoever writes it.
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
    bool burns = false;  // it has a light
  };
  // A line as it is spoken in the first language.
  struct Line {
    static constexpr double kPeaksPerSecond = 100.0;

    std::string name;
    double seconds = 0.0;
    std::vector<uint8_t> peaks;  // of the sound, 255 is full scale; empty: there is none
    std::vector<human::VisemeTrack::Key> visemes;
  };
  std::vector<Person> people;
  std::vector<Thing> things;
  std::vector<Line> lines;
  std::vector<std::string> sounds;

  const Person* FindPerson(std::string_view name) const;
  const Thing* FindThing(std::string_view name) const;
  // 0: not known.
  double ClipSeconds(std::string_view person, std::string_view clip) const;
  const Line* FindLine(std::string_view name) const;
};

struct DramaRun {
  std::vector<drama::TaskRecord> tasks;  // in the order of their beginnings
  std::vector<std::string> problems;     // "drama.lua:12: ...": what failed, each once
  double seconds = 0.0;                  // that were played
  double last = 0.0;                     // when the last task ended
  std::vector<Trail> trails;             // where everybody went
  // Where people walk, as it was at the end, with every door open; nullptr: nobody walked.
  std::shared_ptr<const stage::Navigation> floor;
  StageWords words;
  std::vector<MissingSound> missing_sounds;  // also where the drama could not be run
};

// A script at its beginning on the stage of a project.
struct StagedDrama {
  stage::Stage stage;
  show::ShowContent content;
  std::shared_ptr<Log> log;
  std::unique_ptr<drama::Drama> drama;
};

// spoken: the language, "" is the project's first. Fails where the stage lacks something, or the
// script does not compile.
Result<std::unique_ptr<StagedDrama>> StageDrama(const ProjectPaths& paths,
                                                const ProjectDocument& document,
                                                const std::string& spoken,
                                                const std::string& script);

// Ticks for so long. Fails only where it is cancelled.
Status PlayDry(
    drama::Drama& drama,
    double seconds,
    Progress& progress,
    const std::function<void()>& after_tick = [] {});

// Stages a drama and plays it.
Result<DramaRun> RunDrama(const ProjectPaths& paths,
                          const ProjectDocument& document,
                          const std::string& spoken,
                          const std::string& script,
                          double seconds,
                          Progress& progress);

}  // namespace lararium::app
