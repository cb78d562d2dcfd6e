#pragma once

// Path finding and collision avoidance for walking actors: a navigation mesh of the stage's floor
// (Recast) with paths and a crowd (Detour; its avoidance samples velocities after van den Berg et
// al., "Reciprocal Velocity Obstacles", ICRA 2008). Single-threaded and without random numbers: the
// same calls give the same positions.

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

// Points on the floor are (x, z) in the stage frame, metres.
struct NavigationOptions {
  // Outline of the floor at y = 0: a simple polygon, corners in order.
  std::vector<glm::vec2> floor = {
      {-10.0f, -10.0f}, {10.0f, -10.0f}, {10.0f, 10.0f}, {-10.0f, 10.0f}};
  float walker_radius = 0.25f;  // Distance kept from solids, metres.
  float walker_height = 1.7f;   // Anything that hangs lower is an obstacle, metres.
  float step = 0.12f;           // Walkers step over anything lower, metres.
  float cell = 0.06f;           // Size of a voxel in x and z, metres.

  Status Validate() const;
};

// A mesh that blocks walkers, such as an occluder. `mesh` is borrowed.
struct NavigationSolid {
  const geometry::TriangleMesh* mesh = nullptr;
  geometry::Similarity3 stage_from_mesh;
};

// A convex outline that walkers must not enter, unless it is a gate and open.
struct BlockedArea {
  std::vector<glm::vec2> outline;
  bool gate = false;
};

class Navigation {
 public:
  static constexpr size_t kMaxGates = 60;
  static constexpr int kMaxWalkers = 64;
  static constexpr int kTicksPerSecond = 120;
  // How far from the mesh a walker may stand and still step onto it, metres.
  static constexpr float kStepOn = 0.6f;

  // Errors: no walkable floor is left, the floor is too large, or there are too many gates.
  static Result<std::unique_ptr<Navigation>> Create(const NavigationOptions& options,
                                                    std::span<const NavigationSolid> solids,
                                                    std::span<const BlockedArea> areas);
  ~Navigation();
  Navigation(const Navigation&) = delete;
  Navigation& operator=(const Navigation&) = delete;

  // Removes all walkers and shuts all gates, as after Create.
  void Reset();

  // `gate` counts only the areas that are gates, in their order. Gates are shut at first.
  void OpenGate(size_t gate, bool open);

  // Result of a path search.
  struct Reached {
    glm::vec2 point = glm::vec2(0.0f);   // The reachable point nearest to the target, on the mesh.
    glm::vec2 corner = glm::vec2(0.0f);  // First corner of the path, or its end.
    float length = 0.0f;                 // Length of the path, metres.
    bool complete = false;               // `point` is the point of the mesh nearest to the target.
  };
  // None if `from` is further than kStepOn from the mesh.
  std::optional<Reached> FindWay(glm::vec2 from, glm::vec2 to) const;
  // The nearest point of the mesh that is at most `within` metres away.
  std::optional<glm::vec2> Nearest(glm::vec2 point, float within) const;

  // Every visible actor is a walker, whether it walks or stands. None: there are kMaxWalkers.
  std::optional<int> AddWalker(glm::vec2 position);
  void RemoveWalker(int walker);
  // From now on the crowd moves the walker to a point of the mesh, m/s, avoiding others.
  void Aim(int walker, glm::vec2 target, float speed);
  // From now on only Place() moves the walker; others avoid it.
  void Hold(int walker);
  void Place(int walker, glm::vec2 position, glm::vec2 velocity);
  // Shrinks a walker that cannot pass others. `how`: 0 normal radius, 1 sideways, 2 almost none and
  // without avoidance, as a last resort.
  void Squeeze(int walker, int how);

  // Drops what walkers have cached of their surroundings and restarts pending path queries, so that
  // Save() keeps their whole state. Callers that save do so at fixed ticks and call Settle() at
  // each of them, saved or not, so that saving does not change the result.
  void Settle();
  struct State;  // State of walkers and gates.
  std::shared_ptr<const State> Save() const;
  void Restore(const State& state);

  // Advances by one tick. The crowd is updated at kTicksPerSecond / 4 and interpolated in between.
  // Allocates nothing.
  void Tick();
  // Stage frame (x, z): metres, metres per second.
  glm::vec2 position(int walker) const;
  glm::vec2 velocity(int walker) const;

 private:
  struct Parts;
  explicit Navigation(std::unique_ptr<Parts> parts);

  std::unique_ptr<Parts> parts_;
};

}  // namespace lararium::stage
