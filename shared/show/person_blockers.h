#pragma once

// The spheres by which one person or object blocks light, for a pose.

#include <cstddef>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "shared/human/light_transfer.h"
#include "shared/light/receivers.h"

namespace lararium::show {

// Spheres in stage axes, metres, as a structure of arrays.
struct SphereSet {
  std::vector<float> x, y, z, radius;

  size_t size() const { return x.size(); }
  glm::vec3 centre(size_t index) const { return {x[index], y[index], z[index]}; }
  void Resize(size_t count);
  void Set(size_t index, const glm::vec3& centre, float ball_radius);
  void Clear();
  void Add(const glm::vec3& centre, float ball_radius);
  light::Spheres spheres() const { return {x, y, z, radius}; }
};

class PersonBlockers {
 public:
  explicit PersonBlockers(std::span<const human::LightTransfer::Blocker> blockers);

  // Moves the blockers to a pose. Returns whether one of them jumped there. Allocates nothing.
  bool Pose(std::span<const glm::mat4> skin, const glm::mat4& stage_from_actor);

  // The blockers in the last pose.
  const SphereSet& spheres() const { return spheres_; }

  // Appends the blockers as seen from another person: a group that is small from there becomes one
  // sphere that hides as much as its parts (Ren et al. 2006, section 5: hierarchies).
  void AppendTo(SphereSet& to, const PersonBlockers& seen_from) const;

 private:
  // Blockers [begin, end), and the one sphere that replaces them.
  struct Group {
    size_t begin = 0;
    size_t end = 0;
    glm::vec3 centre = glm::vec3(0.0f);
    float radius = 0.0f;
    float extent = 0.0f;  // Radius of a sphere around `centre` that encloses all of them.
  };

  void MergeGroups();

  std::vector<human::LightTransfer::Blocker> blockers_;  // Blockers of one group are contiguous.
  std::vector<Group> groups_;
  SphereSet spheres_;                                         // Parallel to blockers_.
  glm::vec3 low_ = glm::vec3(0.0f), high_ = glm::vec3(0.0f);  // Bounding box of spheres_.
};

}  // namespace lararium::show
