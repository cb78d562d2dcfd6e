#pragma once

// Where people can walk, and how several of them do without running into each
// other: a navigation mesh of the stage's floor (Recast) with paths and a crowd
// (Detour; its avoidance samples velocities after van den Berg et al., "Reciprocal
// Velocity Obstacles", ICRA 2008). One thread, no random numbers: the same calls
// give the same positions.

#include <glm/vec2.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "shared/core/status.h"
#include "shared/geometry/transform.h"
#include "shared/geometry/triangle_mesh.h"

namespace lararium::stage {

// Points on the floor are (x, z) of the stage, metres.
struct NavigationOptions {
  // Outline of the floor at y = 0; corners in their order, not crossing itself.
  std::vector<glm::vec2> floor = {
      {-10.0f, -10.0f}, {10.0f, -10.0f}, {10.0f, 10.0f}, {-10.0f, 10.0f}};
  float walker_radius = 0.25f;  // kept from what is solid
  float walker_height = 1.7f;   // what hangs lower is in the way
  float step = 0.12f;           // what is lower is stepped over
  float cell = 0.06f;           // resolution

  Status Validate() const;
};

// A mesh that nobody walks through, such as an occluder. Borrowed.
struct NavigationSolid {
  const geometry::TriangleMesh* mesh = nullptr;
  geometry::Similarity3 stage_from_mesh;
};

// A convex outline that is kept free. Gates can be opened and shut.
struct BlockedArea {
  std::vector<glm::vec2> outline;
  bool gate = false;
};

class Navigation {
 public:
  static constexpr size_t kMaxGates = 60;
  static constexpr int kMaxWalkers = 64;
  static constexpr int kTicksPerSecond = 120;
  // How far from the mesh somebody may stand and still step onto it.
  static constexpr float kStepOn = 0.6f;

  // Errors: nothing of the floor is left, too large, too many gates.
  static Result<std::unique_ptr<Navigation>> Create(const NavigationOptions& options,
                                                    std::span<const NavigationSolid> solids,
                                                    std::span<const BlockedArea> areas);
  ~Navigation();
  Navigation(const Navigation&) = delete;
  Navigation& operator=(const Navigation&) = delete;

  // No walkers, all gates shut: as created.
  void Reset();

  // Gates are counted among the areas that are gates, in their order; shut at first.
  void OpenGate(size_t gate, bool open);

  // Where a walk from one point towards another ends.
  struct Reached {
    glm::vec2 point = glm::vec2(0.0f);   // on the mesh: as near to the target as one gets
    glm::vec2 corner = glm::vec2(0.0f);  // where the way first bends, or its end
    float length = 0.0f;                 // of the way, metres
    bool complete = false;               // the point is the target's nearest on the mesh
  };
  // None where from is further than kStepOn from the mesh.
  std::optional<Reached> FindWay(glm::vec2 from, glm::vec2 to) const;
  // The nearest point of the mesh within so many metres.
  std::optional<glm::vec2> Nearest(glm::vec2 point, float within) const;

  // Walkers: everybody on the stage, walking or standing.
  std::optional<int> AddWalker(glm::vec2 position);  // none: there are too many
  void RemoveWalker(int walker);
  // Goes to a point of the mesh by itself, avoiding others.
  void Aim(int walker, glm::vec2 target, float speed);
  // Is moved by Place() alone from now on; others avoid it.
  void Hold(int walker);
  void Place(int walker, glm::vec2 position, glm::vec2 velocity);
  // Somebody who cannot get past others takes less room: 0 as usual, 1 sideways, 2 none,
  // where nothing else helps.
  void Squeeze(int walker, int how);

  // What walkers know of their surroundings they look at anew, and what they wait for
  // they ask again: what Save() then keeps is all that they remember. Whoever saves does
  // so at fixed ticks, and settles at each of them, so that saving changes nothing.
  void Settle();
  struct State;  // of walkers and gates
  std::shared_ptr<const State> Save() const;
  void Restore(const State& state);

  // One tick. The crowd is computed at kTicksPerSecond / 4 and moves evenly between.
  // Allocates nothing.
  void Tick();
  // Of a walker that goes by itself.
  glm::vec2 position(int walker) const;
  glm::vec2 velocity(int walker) const;

 private:
  struct Parts;
  explicit Navigation(std::unique_ptr<Parts> parts);

  std::unique_ptr<Parts> parts_;
};

}  // namespace lararium::stage
