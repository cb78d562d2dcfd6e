#pragma once

// Light at vertices by transfer vectors: irradiance = sum_k T_k L_k for each channel
// (Sloan, Kautz & Snyder 2002, diffuse transfer), with T in the frame of the vertex's
// bone, blended between key poses, and L the light that reaches the vertex's receivers,
// turned into the frame of their bone.

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
// Key poses with less weight at a vertex are passed over.
inline constexpr float kLeastPoseWeight = 1.0f / 64.0f;

// Transfer vectors of a mesh for its key poses as files have them: T[k] = value * scale(pose,
// vertex). A scale for each coefficient besides was measured to gain nothing.
struct TransferBytes {
  int count = 0;  // coefficients: 9, 16, 25 or 36
  size_t poses = 0;
  size_t vertices = 0;
  std::vector<float> scale;    // [pose][vertex]
  std::vector<int8_t> values;  // [pose][vertex][3][count]
};

// vectors: [pose][vertex][3][count]. Each is off by half a scale at most.
TransferBytes QuantiseTransfer(std::span<const float> vectors, int count, size_t poses);

// [3][count] of one vertex and pose.
void DecodeTransfer(const TransferBytes& transfer,
                    size_t pose,
                    size_t vertex,
                    std::span<float> vectors);

// The same as it is read from frame to frame, in three fifths of the memory: what reaches a vertex
// is mostly light that comes straight from outside, alike in all channels, and what surfaces
// nearby tint of it is smooth. So the channels' mean is kept whole; by how much red and blue
// differ from it, for the first four coefficients; and for the others in what ratio. Green is what
// the mean leaves.
class Transfer {
 public:
  Transfer() = default;
  // On all cores.
  explicit Transfer(const TransferBytes& bytes);

  int count() const { return count_; }
  size_t poses() const { return poses_; }
  size_t vertices() const { return vertices_; }
  // What is kept, [3][count].
  void Decode(size_t pose, size_t vertex, std::span<float> vectors) const;

  // Of a row: the mean's coefficients as bytes, red's differences, blue's, red's ratio to the mean
  // less 1 and blue's, in 1/kRatioUnit; what all but the ratios are to be multiplied by.
  static constexpr size_t kTinted = 4;
  static constexpr float kRatioUnit = 64.0f;
  size_t red_at() const { return static_cast<size_t>(count_); }
  size_t blue_at() const { return red_at() + kTinted; }
  size_t ratios_at() const { return blue_at() + kTinted; }
  size_t scale_at() const { return ratios_at() + 4; }
  size_t stride() const { return scale_at() + sizeof(float); }
  // Whole registers of the mean may be read: they end before the row does.
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
