#pragma once

// Gathers transfer vectors key pose by key pose and packs them as files keep them.

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "editor/bake/transfer_solver.h"
#include "shared/human/light_transfer.h"

namespace lararium::bake {

// Turns a vector by a rotation of its axes.
void TurnTransfer(const glm::mat3& rotation, int count, TransferVector& vector);

class TransferPacker {
 public:
  explicit TransferPacker(int count) : count_(count) {}

  // The same meshes each time. Vectors of fronts: in the axes that they are kept in.
  void AddKeyPose(const TransferSites& sites, const SolvedTransfer& solved);
  // Sets coefficients, scale and backs of meshes, which are as many as were added.
  void Pack(std::vector<human::LightTransfer::Mesh>& meshes) const;

 private:
  int count_;
  size_t poses_ = 0;
  std::vector<std::vector<float>> vectors_;        // of each mesh: [key pose][vertex][channel][k]
  std::vector<std::vector<glm::vec3>> back_sums_;  // of each two-sided mesh: over key poses
};

}  // namespace lararium::bake
