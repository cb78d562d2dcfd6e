#pragma once

// Collects the transfer vectors of all key poses and packs them for the file.

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "editor/bake/transfer_solver.h"
#include "shared/human/light_transfer.h"

namespace lararium::bake {

// Rotates a vector of coefficients by a rotation of its axes.
void TurnTransfer(const glm::mat3& rotation, int count, TransferVector& vector);

class TransferPacker {
 public:
  explicit TransferPacker(int count) : count_(count) {}

  // Adds a key pose; the meshes are the same each time. Vectors of fronts are in the axes in
  // which they are stored.
  void AddKeyPose(const TransferSites& sites, const SolvedTransfer& solved);
  // Sets coefficients, scale and backs of `meshes`, which are parallel to the meshes added.
  void Pack(std::vector<human::LightTransfer::Mesh>& meshes) const;

 private:
  int count_;
  size_t poses_ = 0;
  std::vector<std::vector<float>> vectors_;  // [mesh], then flat [key pose][vertex][channel][k].
  std::vector<std::vector<glm::vec3>>
      back_sums_;  // [mesh][vertex], sums over key poses; empty if one-sided.
};

}  // namespace lararium::bake
