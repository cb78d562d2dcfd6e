#pragma once

// Light at vertices by transfer vectors: irradiance = sum_k T_k L_k for each channel (Sloan, Kautz
// & Snyder 2002, diffuse transfer). T is in the frame of the vertex's bone and blended between key
// poses. L is the light that reaches the vertex's receivers, rotated into the frame of their bone.

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "shared/light/lanes.h"
#include "shared/light/sh_rows.h"

namespace lararium::light {

inline constexpr size_t kMaxKeyPoses = 8;
inline constexpr size_t kReceiversOfVertex = 4;
// Key poses with less weight at a vertex are skipped.
inline constexpr float kLeastPoseWeight = 1.0f / 64.0f;

// Transfer vectors of a mesh for its key poses in their file format: T[k] = value * scale(pose,
// vertex). A separate scale for each coefficient gave no measurable gain.
struct TransferBytes {
  int count = 0;  // coefficients: 9, 16, 25 or 36
  size_t poses = 0;
  size_t vertices = 0;
  std::vector<float> scale;    // [pose][vertex]
  std::vector<int8_t> values;  // [pose][vertex][3][count]
};

// vectors: [pose][vertex][3][count]. The error of each value is at most half a scale.
TransferBytes QuantiseTransfer(std::span<const float> vectors, int count, size_t poses);

// Transfer vectors in the form that is read in each frame, in three fifths of the memory. Most
// light at a vertex comes straight from outside and is equal in all channels, and the tint by
// nearby surfaces is smooth. Therefore the mean of the channels is kept in full; the differences of
// red and blue from it are kept for the first four coefficients, and only as ratios for the others.
// Green follows from the mean.
class Transfer {
 public:
  Transfer() = default;
  // Converts on all cores.
  explicit Transfer(const TransferBytes& bytes);

  int count() const { return count_; }
  size_t poses() const { return poses_; }
  size_t vertices() const { return vertices_; }
  // Decodes the stored values, [3][count].
  void Decode(size_t pose, size_t vertex, std::span<float> vectors) const;

  // Layout of a row: the mean's coefficients as bytes; the differences of red and of blue; the
  // ratios to the mean, less 1, of red and of blue, in 1/kRatioUnit; and the scale of everything
  // but the ratios.
  static constexpr size_t kTinted = 4;
  static constexpr float kRatioUnit = 64.0f;
  size_t red_at() const { return static_cast<size_t>(count_); }
  size_t blue_at() const { return red_at() + kTinted; }
  size_t ratios_at() const { return blue_at() + kTinted; }
  size_t scale_at() const { return ratios_at() + 4; }
  size_t stride() const { return scale_at() + sizeof(float); }
  // Reading the mean in whole registers is safe: they end before the row does.
  const int8_t* row(size_t pose, size_t vertex) const {
    return rows_.get() + (pose * vertices_ + vertex) * stride();
  }
  size_t pose_stride() const { return vertices_ * stride(); }

 private:
  int count_ = 0;
  size_t poses_ = 0;
  size_t vertices_ = 0;
  std::shared_ptr<const int8_t[]> rows_;  // [pose][vertex]
};

// Light of receivers in the form that vertices read: [receiver][3][padded count], as integers in
// units of unit(), so that a register holds sixteen of them. Only the constructor allocates.
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

// light: in the receivers' bone frames (sh_turn.h). The error of each value is at most half a unit,
// that is, 1/64000 to 1/32000 of the largest coefficient of all receivers. The unit is kept while
// it is within these limits, so that packed values of different frames can be compared.
void PackReceiverLight(const ShRowsRgb& light, ReceiverLight& packed);

// The receivers that light a vertex. Weights are in 1/255 with the sum 255, the largest first;
// receivers after a weight of 0 are ignored.
struct VertexReceivers {
  std::array<uint16_t, kReceiversOfVertex> receiver{};
  std::array<uint8_t, kReceiversOfVertex> weight{};
};

// Computes irradiance[v], never negative, for the vertices [begin, end): blends transfer and light
// at the vertex and multiplies them. pose_weights: [receiver][kMaxKeyPoses] (key_poses.h). Several
// ranges may run in parallel. Allocates nothing.
struct LightVerticesJob {
  const Transfer* transfer = nullptr;
  std::span<const VertexReceivers> receivers;  // [vertex]
  const ReceiverLight* light = nullptr;
  std::span<const float> pose_weights;
  std::span<glm::vec3> irradiance;  // [vertex]
  // For each receiver, whether its light has changed. Vertices without a changed receiver keep
  // their value. Empty: all receivers have changed.
  std::span<const uint8_t> changed = {};

  void Run(size_t begin, size_t end) const;
};

}  // namespace lararium::light
