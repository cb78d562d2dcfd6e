#pragma once

// What is wrong with a drama though it runs: people in two places at once, things that two
// want, ways through walls, people without ground, cues that nothing reaches. All of it is judged
// by what dry runs saw (editor/app/dry_run.h).

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <map>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "shared/core/sentence.h"
#include "shared/drama/drama.h"
#include "shared/stage/place.h"
#include "shared/stage/stage.h"

namespace lararium::app {

// "drama.lua:12" of the items of tracks instead of that of their track: what an edit needs.
// Leaves alone what a track computes.
void PlaceItems(const std::string& script,
                const std::string& file,
                std::vector<drama::TaskRecord>& tasks);

// Somebody is to begin something with the body while they still do something else.
std::vector<Sentence> CheckTogether(std::span<const drama::TaskRecord> tasks);

// Somebody has to wait for a thing that somebody else uses. Taking what another holds fails,
// and is told as every failure.
std::vector<Sentence> CheckTurns(std::span<const drama::TaskRecord> tasks);

// Cues of all dry runs together. visited: one of them had a visitor; without, what waits for
// a visitor is not judged.
struct CuesSeen {
  std::vector<drama::CueRecord> cues;
  std::set<std::string, std::less<>> lines;  // that were said, shown or described
  bool visited = false;
  double seconds = 0.0;  // that each run lasted
};
// Markers that begin nothing or are nowhere, triggers that no run fires or arms, lines that
// are written out in the script and that no run says.
std::vector<Sentence> CheckCues(const std::string& script,
                                const std::string& file,
                                const CuesSeen& seen);

// Follows people tick by tick: ways through occluders, standing in them, leaps while seen.
class StepListener {
 public:
  // Borrows the stage.
  StepListener(const stage::Stage& stage, std::span<const stage::Place> places);

  // After a tick; time: of the drama.
  void Listen(double time);
  // Each with the place in the script of what they were told then.
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
  using Cell = std::pair<int, int>;  // of a grid on the floor

  void AddOccluder(const stage::Occluder& occluder, Sentence name);
  // The occluder that a way on the floor goes through; nullptr: none.
  const Sentence* Crossed(const glm::vec3& from, const glm::vec3& to) const;
  const Sentence* Around(const glm::vec3& point) const;
  void Tell(Sentence what, const std::string& actor, double time);

  const stage::Stage& stage_;
  std::vector<Sentence> names_;  // of occluders, with their places where there are several
  std::vector<Triangle> triangles_;
  std::map<Cell, std::vector<uint32_t>> cells_;
  stage::StageSnapshot snapshot_;
  std::map<std::string, glm::vec3> last_;  // of who was seen in the tick before
  std::vector<Step> steps_;
};

// Looks below people's feet now and then: where nothing catches their shadows they seem to float.
class GroundListener {
 public:
  // Borrows the stage.
  GroundListener(const stage::Stage& stage, std::span<const stage::Place> places);

  // After a tick; time: of the drama.
  void Listen(double time);
  // One at most for each place: who has no ground first. None where people have some half of the
  // time.
  std::vector<Sentence> Problems() const;

 private:
  using Triangle = std::array<glm::vec3, 3>;
  struct Ground {
    std::string place;
    std::vector<Triangle> triangles;  // of what receives shadow, in the stage
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

}  // namespace lararium::app
