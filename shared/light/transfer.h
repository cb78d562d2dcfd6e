#pragma once

// Light at vertices by transfer vectors: irradiance = sum_k T_k L_k for each channel
// (Sloan, Kautz & Snyder 2002, diffuse transfer), with T in the frame of the vertex's
// bone, blended between key poses, and L the light that reaches the vertex's receivers,
// turned into the frame of their bone.

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

#include "shared/core/status.h"
#include "shared/light/lanes.h"
#include "shared/light/sh_rows.h"

namespace lararium::light {

inline constexpr size_t kMaxKeyPoses = 8;
inline constexpr size_t kReceiversOfVertex = 4;
// Key poses with less weight at a vertex are passed over.
inline constexpr float kLeastPoseWeight = 1.0f / 64.0f;

// Transfer vectors of a mesh for its key poses, as bytes: T[k] = value * scale(pose,
// vertex). A scale for each coefficient besides was measured to gain nothing.
struct Transfer {
  int count = 0;  // coefficients: 9, 16, 25 or 36
  size_t poses = 0;
  size_t vertices = 0;
  std::vector<float> scale;  // [pose][vertex]
  // [pose][vertex][3][count], as files have them, and tail() more: whole registers are read, of
  // which light has nothing where they reach beyond a channel.
  std::vector<int8_t> values;

  size_t padded_count() const { return PaddedToShortLanes(static_cast<size_t>(count)); }
  size_t tail() const { return padded_count() - static_cast<size_t>(count); }
  const int8_t* row(size_t pose, size_t vertex) const {
    return values.data() + (pose * vertices + vertex) * 3 * static_cast<size_t>(count);
  }
};

// What is wrong with sizes or numbers, for readers of files. place: file and part.
Status CheckTransfer(const Transfer& transfer, const std::string& place);

// vectors: [pose][vertex][3][count]. Each is off by half a scale at most.
Transfer QuantiseTransfer(std::span<const float> vectors, int count, size_t poses);

// [3][count] of one vertex and pose.
void DecodeTransfer(const Transfer& transfer, size_t pose, size_t vertex, std::span<float> vectors);

// Light of receivers as vertices read it: [receiver][3][padded count], in whole numbers of
// unit(), so that a register holds sixteen of them. Made once; filling it does not allocate.
class ReceiverLight {
 public:
  ReceiverLight(int count, size_t receivers)
      : count_(count), receivers_(receivers), values_(receivers * stride(), 0) {}

  int count() const { return count_; }
  size_t receivers() const { return receivers_; }
  size_t stride() const { return 3 * PaddedToShortLanes(static_cast<size_t>(count_)); }
  int16_t* row(size_t receiver) { return values_.data() + receiver * stride(); }
  const int16_t* row(size_t receiver) const { return values_.data() + receiver * stride(); }
  float unit() const { return unit_; }
  void set_unit(float unit) { unit_ = unit; }

 private:
  int count_;
  size_t receivers_;
  float unit_ = 0.0f;
  std::vector<int16_t> values_;
};

// light: in the receivers' bone frames (sh_turn.h). Each is off by half a unit at most: by
// 1/64000 to 1/32000 of the largest coefficient that any receiver has. The unit stays while it
// is within these, so that what was packed before can be compared.
void PackReceiverLight(const ShRowsRgb& light, ReceiverLight& packed);

// The receivers that light a vertex. Weights in 1/255, sum 255, the largest first; those
// after a weight of 0 are not looked at.
struct VertexReceivers {
  std::array<uint16_t, kReceiversOfVertex> receiver{};
  std::array<uint8_t, kReceiversOfVertex> weight{};
};

// irradiance[v] for the vertices [begin, end), never negative: transfer and light blended
// at the vertex and multiplied. pose_weights: [receiver][kMaxKeyPoses] (key_poses.h).
// Several ranges may run together. Allocates nothing.
struct LightVerticesJob {
  const Transfer* transfer = nullptr;
  std::span<const VertexReceivers> receivers;  // [vertex]
  const ReceiverLight* light = nullptr;
  std::span<const float> pose_weights;
  std::span<glm::vec3> irradiance;  // [vertex]
  // Of each receiver whether its light has changed; vertices none of whose receivers has stay as
  // they are. Empty: all have.
  std::span<const uint8_t> changed = {};

  void Run(size_t begin, size_t end) const;
};

}  // namespace lararium::light
