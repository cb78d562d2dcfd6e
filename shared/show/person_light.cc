#include "shared/show/person_light.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "shared/core/check.h"
#include "shared/human/skinning.h"

namespace lararium::show {
namespace {

using human::LightTransfer;

// Number of visibility coefficients: limited by both its table and the transfer.
int VisibilityCount(const LightTransfer& transfer) { return std::min(transfer.count, 25); }

// Blockers that have moved away since the key poses can brighten only light that the transfer has
// not removed. Half of it came nearest to path-traced poses in measurements.
constexpr float kBrightening = 0.5f;

// A sphere of this radius, centred this far above the feet, encloses a person; metres.
constexpr float kBodyReach = 1.0f;

// A larger relative change of light is a jump.
constexpr float kRelit = 0.02f;
// Objects have at most this many receivers; they are lit only after a change, and then completely.
constexpr size_t kFew = 64;
// Number of frames in which all receivers are updated.
constexpr size_t kParts = 3;
// Vertices are updated in blocks of this size, every other block in a frame.
constexpr size_t kBlock = 64;
// A receiver's light changed in this frame, or in the previous one, when half of the vertices
// waited.
constexpr uint8_t kChangedNow = 1;
constexpr uint8_t kChangedBefore = 2;

// A change by this part of a receiver's light is one 8-bit step. Key poses change that light by a
// third at most.
constexpr int kSeenParts = 128;
constexpr float kSeenWeight = 1.0f / 48.0f;

void DampBrightening(light::ReceiverRange range, light::ShRows& log) {
  for (size_t receiver = range.begin; receiver < range.end; ++receiver) {
    if (log.at(0, receiver) > 0.0f) {
      for (int k = 0; k < log.count(); ++k) {
        log.at(k, receiver) *= kBrightening;
      }
    }
  }
}

void CopyRows(const light::ShRows& from, light::ReceiverRange range, light::ShRows& to) {
  for (int k = 0; k < from.count(); ++k) {
    std::copy(from.row(k) + range.begin, from.row(k) + range.end, to.row(k) + range.begin);
  }
}

light::ShRowsRgb RowsRgb(int count, size_t slots) {
  return {light::ShRows(count, slots), light::ShRows(count, slots), light::ShRows(count, slots)};
}

// As TakeLight(), but leaves the vectors where they are.
std::shared_ptr<const UnpackedLight> CopyLight(LightTransfer transfer) {
  return TakeLight(transfer);
}

}  // namespace

std::shared_ptr<const UnpackedLight> TakeLight(LightTransfer& transfer) {
  auto unpacked = std::make_shared<UnpackedLight>();
  for (LightTransfer::Mesh& mesh : transfer.meshes) {
    unpacked->push_back(light::Transfer(
        light::TransferBytes{transfer.count, transfer.key_poses.size(), mesh.receivers.size(),
                             std::exchange(mesh.scale, {}), std::exchange(mesh.coefficients, {})}));
  }
  return unpacked;
}

PersonLight::PersonLight(std::shared_ptr<const human::Human> human,
                         std::shared_ptr<const UnpackedLight> light)
    : human_(std::move(human)),
      blockers_(human_->light.blockers),
      receivers_(human_->light.receivers),
      skin_(human_->skeleton.size(), glm::mat4(1.0f)),
      receiver_light_(human_->light.count, human_->light.receivers.size()),
      transfers_(light != nullptr ? std::move(light) : CopyLight(human_->light)),
      used_light_(receiver_light_) {
  CHECK(transfers_->size() == human_->light.meshes.size());
  const size_t slots = receiver_light_.receivers();
  const int count = VisibilityCount(human_->light);
  own_log_ = own_stage_log_ = stage_log_ = light::ShRows(count, slots);
  shadowed_ = turned_ = lamp_light_ = RowsRgb(count, slots);
  near_lamps_.reserve(light::kMaxLamps);
  pose_weights_.resize(slots * light::kMaxKeyPoses);
  used_weights_ = pose_weights_;
  changed_.assign(slots, 1);
  MakeMeshes();
  FindKeyLogs();
}

void PersonLight::SetMesh(std::shared_ptr<const human::Human> human,
                          std::shared_ptr<const UnpackedLight> light) {
  human_ = std::move(human);
  transfers_ = std::move(light);
  CHECK(transfers_->size() == human_->light.meshes.size());
  meshes_.clear();
  MakeMeshes();
}

void PersonLight::MakeMeshes() {
  for (size_t i = 0; i < human_->meshes.size(); ++i) {
    const LightTransfer::Mesh& mesh = human_->light.meshes[i];
    MeshLight& made = meshes_.emplace_back();
    made.levels = render::FindMeshLevels(*human_, i);
    made.irradiance.resize(mesh.receivers.size());
    made.receivers.resize(mesh.receivers.size());
    for (size_t v = 0; v < made.receivers.size(); ++v) {
      for (size_t i = 0; i < light::kReceiversOfVertex; ++i) {
        made.receivers[v].receiver[i] = receivers_.slot(mesh.receivers[v][i]);
      }
      made.receivers[v].weight = mesh.weights[v];
    }
  }
}

void PersonLight::FindKeyLogs() {
  const human::Skeleton& skeleton = human_->skeleton;
  for (const std::vector<human::JointTransform>& pose : human_->light.key_poses) {
    Pose(human::SkinOfPose(skeleton, pose), glm::mat4(1.0f));
    receivers_.Pose(skin_, stage_from_actor_);
    OwnLog({0, own_log_.receivers()},
           key_logs_.emplace_back(own_log_.count(), own_log_.receivers()));
  }
}

void PersonLight::OwnLog(light::ReceiverRange range, light::ShRows& log) const {
  light::ClearLogVisibility(range, log);
  light::AddLogVisibility(blockers_.spheres().spheres(), receivers_.points(),
                          receivers_.stage_from_bind(), range, log);
}

void PersonLight::Pose(std::span<const glm::mat4> skin, const glm::mat4& stage_from_actor) {
  std::copy(skin.begin(), skin.end(), skin_.begin());
  stage_from_actor_ = stage_from_actor;
  jumped_ = blockers_.Pose(skin_, stage_from_actor_) || jumped_;
  ++poses_;
}

void PersonLight::AddLamps(const light::Spheres& others, std::span<const light::Lamp> lamps) {
  near_lamps_.clear();
  const glm::vec3 middle = stage_from_actor_ * glm::vec4(0.0f, kBodyReach, 0.0f, 1.0f);
  for (const light::Lamp& lamp : lamps) {
    const float reach = light::ReachOf(lamp, light::kLeastLampIrradiance) + kBodyReach;
    if (near_lamps_.size() < light::kMaxLamps && glm::distance(lamp.position, middle) < reach) {
      near_lamps_.push_back(lamp);
    }
  }
  if (near_lamps_.empty()) {
    return;
  }
  for (light::ShRows& rows : lamp_light_) {
    rows.Clear();
  }
  light::AddLamps(near_lamps_, receivers_.points(), own_stage_log_, others,
                  {0, receiver_light_.receivers()}, lamp_light_);
}

void PersonLight::Update(const light::LightMatrix& light,
                         const light::Spheres& others,
                         std::span<const light::Lamp> lamps) {
  const light::ReceiverRange all = {0, receiver_light_.receivers()};
  const light::ReceiverRange now = ChooseReceivers(light);
  receivers_.Pose(skin_, stage_from_actor_);
  OwnLog(now, own_log_);
  light::KeyPoseWeights(key_logs_, own_log_, {}, now, pose_weights_);
  light::SubtractKeyPoses(key_logs_, own_log_, pose_weights_, now, own_log_);
  DampBrightening(now, own_log_);
  light::TurnRows(own_log_, receivers_.stage_from_bind(), light::TurnDirection::kForth, now,
                  own_stage_log_);
  AddLamps(others, lamps);
  CopyRows(own_stage_log_, now, stage_log_);
  light::AddLogVisibility(others, receivers_.points(), now, stage_log_);
  light::ShadowLight(light, stage_log_, now, shadowed_);
  const bool lamps_shine = !near_lamps_.empty();
  for (size_t channel = 0; lamps_shine && channel < 3; ++channel) {
    lamp_light_[channel].Add(shadowed_[channel]);
  }
  light::TurnRows(lamps_shine ? lamp_light_ : shadowed_, receivers_.stage_from_bind(),
                  light::TurnDirection::kBack, all, turned_);
  light::PackReceiverLight(turned_, receiver_light_);
  FindChanged();
}

light::ReceiverRange PersonLight::ChooseReceivers(const light::LightMatrix& light) {
  const size_t count = receiver_light_.receivers();
  bool relit = false;
  for (size_t k = 0; k < static_cast<size_t>(light.count()); ++k) {
    const float moved = std::abs(light.channel(1)[k] - seen_light_[k]);
    relit = relit || !(moved <= kRelit * std::abs(seen_light_[0]));
  }
  std::copy_n(light.channel(1), light.count(), seen_light_.begin());
  gradual_ = poses_ == 1 && !jumped_ && !relit && count > kFew;
  poses_ = 0;
  jumped_ = false;
  if (!gradual_) {
    return {0, count};
  }
  part_ = (part_ + 1) % kParts;
  return {light::PaddedToLanes(count * part_ / kParts),
          std::min(count, light::PaddedToLanes(count * (part_ + 1) / kParts))};
}

void PersonLight::FindChanged() {
  const bool rescaled = receiver_light_.unit() != used_light_.unit();
  used_light_.set_unit(receiver_light_.unit());
  const size_t stride = receiver_light_.stride();
  for (size_t i = 0; i < changed_.size(); ++i) {
    const int16_t* light = receiver_light_.row(i);
    int16_t* used = used_light_.row(i);
    const float* weights = &pose_weights_[i * light::kMaxKeyPoses];
    float* used_weights = &used_weights_[i * light::kMaxKeyPoses];
    int brightest = 0, moved = 0;
    for (size_t k = 0; k < stride; ++k) {
      moved = std::max(moved, std::abs(light[k] - used[k]));
    }
    for (size_t channel = 0; channel < 3; ++channel) {
      brightest = std::max(brightest, std::abs(int{light[channel * stride / 3]}));
    }
    float weighed = 0.0f;
    for (size_t k = 0; k < light::kMaxKeyPoses; ++k) {
      weighed = std::max(weighed, std::abs(weights[k] - used_weights[k]));
    }
    const bool changed = rescaled || moved * kSeenParts > brightest || weighed > kSeenWeight;
    changed_[i] =
        static_cast<uint8_t>((changed_[i] << 1 & kChangedBefore) | (changed ? kChangedNow : 0));
    if (changed) {
      std::copy_n(light, stride, used);
      std::copy_n(weights, light::kMaxKeyPoses, used_weights);
    }
  }
}

void PersonLight::LightBlocks(const light::LightVerticesJob& job, size_t count) const {
  if (!gradual_) {
    job.Run(0, count);
    return;
  }
  for (size_t begin = odd_blocks_ ? kBlock : 0; begin < count; begin += 2 * kBlock) {
    job.Run(begin, std::min(begin + kBlock, count));
  }
}

void PersonLight::LightVertices(float detail, std::span<glm::vec3> irradiance) {
  auto to = irradiance.begin();
  odd_blocks_ = !odd_blocks_;
  for (size_t i = 0; i < meshes_.size(); ++i) {
    MeshLight& mesh = meshes_[i];
    const size_t wanted = render::LevelAllowed(mesh.levels, detail).vertices;
    light::LightVerticesJob job{&(*transfers_)[i], mesh.receivers, &used_light_, used_weights_,
                                mesh.irradiance};
    // Vertices that a coarser level left out are lit completely.
    job.Run(std::min(mesh.lit, wanted), wanted);
    job.changed = changed_;
    LightBlocks(job, std::min(mesh.lit, wanted));
    mesh.lit = wanted;
    std::copy_n(mesh.irradiance.begin(), wanted, to);
    to += static_cast<ptrdiff_t>(mesh.irradiance.size());
  }
}

}  // namespace lararium::show
