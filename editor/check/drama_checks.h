#pragma once

// Checks for problems of dramas that run without errors: people in two places at once, two
// people who need the same object, paths through walls, people without ground, cues that never
// fire. All checks use the records of dry runs (editor/check/dry_run.h).

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "shared/core/sentence.h"
#include "shared/drama/drama.h"
#include "shared/stage/place.h"
#include "shared/stage/stage.h"

namespace lararium::editor {

// Replaces the location of tasks from a track by that of their items, such as "drama.lua:12",
// which an edit needs. Does not change tasks of computed tracks.
void PlaceItems(const std::string& script,
                const std::string& file,
                std::vector<drama::TaskRecord>& tasks);

// The problem with a script that is not UTF-8, with its line.
std::optional<Sentence> CheckEncoding(const std::string& script, const std::string& file);

// Whether the name occurs in the script, outside of texts and comments.
bool Names(const std::string& script, std::string_view name);

// Finds people who begin a bodily action while another one is still running.
std::vector<Sentence> CheckTogether(std::span<const drama::TaskRecord> tasks);

// Finds people who wait for an object that another person uses. Taking an object that another
// person holds fails; PlayDry reports it as a failure.
std::vector<Sentence> CheckTurns(std::span<const drama::TaskRecord> tasks);

// Cues of all dry runs together. `visited` says that a run had a visitor; otherwise cues that
// wait for a visitor are not checked.
struct CuesSeen {
  std::vector<drama::CueRecord> cues;
  std::set<std::string, std::less<>> lines;  // Lines that were said, shown or described.
  bool visited = false;
  double seconds = 0.0;  // Duration of each run.
};
// Finds markers that do not exist or trigger nothing, triggers that no run arms or fires, and
// lines named in the script that no run says.
std::vector<Sentence> CheckCues(const std::string& script,
                                const std::string& file,
                                const CuesSeen& seen);

// Checks people at each tick for paths through occluders, positions inside them, and jumps
// while visible.
class StepListener {
 public:
  // Keeps a reference to the stage.
  StepListener(const stage::Stage& stage, std::span<const stage::Place> places);

  // Call after each tick with the time of the drama.
  void Listen(double time);
  // Each problem has the location in the script of the last instruction to that person.
  std::vector<Sentence> Problems(const std::string& script,
                                 const std::string& file,
                                 std::span<const drama::TaskRecord> tasks) const;

 private:
  struct Triangle {
    const Sentence* occluder = nullptr;
    std::array<glm::vec3, 3> corners;
  };
  struct Step {
    std::string actor;
    double time = 0.0;
    Sentence what;
  };
  using Cell = std::pair<int, int>;  // Cell of a grid on the floor.

  void AddOccluder(const stage::Occluder& occluder, Sentence name);
  // The occluder that a path on the floor crosses; nullptr if there is none.
  const Sentence* Crossed(const glm::vec3& from, const glm::vec3& to) const;
  const Sentence* Around(const glm::vec3& point) const;
  void Tell(Sentence what, const std::string& actor, double time);

  const stage::Stage& stage_;
  // Names of occluders, with their place if there are several places.
  std::vector<Sentence> names_;
  std::vector<Triangle> triangles_;
  std::map<Cell, std::vector<uint32_t>> cells_;
  stage::StageSnapshot snapshot_;
  std::map<std::string, glm::vec3> last_;  // Positions of visible actors at the previous tick.
  std::vector<Step> steps_;
};

// Finds occluders that are too far from the stage, too large or too small to hide anybody: their
// unit or their coordinates are others than the stage's.
std::vector<Sentence> CheckOccluders(std::span<const stage::Place> places);

// Samples the ground below the feet of people; without a surface for shadows they seem to
// float.
class GroundListener {
 public:
  // Keeps a reference to the stage.
  GroundListener(const stage::Stage& stage, std::span<const stage::Place> places);

  // Call after each tick with the time of the drama.
  void Listen(double time);
  // At most one problem per place, about the first person without ground. None if people have
  // ground for at least half of the samples.
  std::vector<Sentence> Problems() const;

 private:
  using Triangle = std::array<glm::vec3, 3>;
  struct Ground {
    std::string place;
    std::vector<Triangle> triangles;  // Surfaces that receive shadows, in the stage frame.
    int looked = 0;
    int missing = 0;
    std::string first_actor;
    double first_time = 0.0;
  };

  const stage::Stage& stage_;
  std::vector<Ground> grounds_;
  stage::StageSnapshot snapshot_;
  double next_ = 0.0;
};

}  // namespace lararium::editor
