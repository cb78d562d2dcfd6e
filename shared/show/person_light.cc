#include "shared/show/person_light.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <map>
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

// Mean number of blockers in a group that one sphere may replace, and the largest sine of the angle
// between its centre and its rim at which it does.
constexpr size_t kBlockersOfGroup = 6;
constexpr float kSmall = 0.3f;

// A larger motion between frames (metres), or a larger relative change of light, is a jump.
constexpr float kLeap = 0.2f;
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

glm::quat RotationOf(const glm::mat4& matrix) { return human::ToDualQuaternion(matrix).real; }

// The transfer vectors of one mesh.
light::Transfer Unpack(const LightTransfer& transfer,
                       std::vector<float> scale,
                       std::vector<int8_t> coefficients,
                       size_t vertices) {
  return light::Transfer(light::TransferBytes{transfer.count, transfer.key_poses.size(), vertices,
                                              std::move(scale), std::move(coefficients)});
}

UnpackedLight UnpackAll(const LightTransfer& light) {
  UnpackedLight unpacked;
  for (const LightTransfer::Mesh& mesh : light.meshes) {
    unpacked.push_back(Unpack(light, mesh.scale, mesh.coefficients, mesh.receivers.size()));
  }
  return unpacked;
}

}  // namespace

std::shared_ptr<const UnpackedLight> TakeLight(LightTransfer& transfer) {
  auto unpacked = std::make_shared<UnpackedLight>();
  for (LightTransfer::Mesh& mesh : transfer.meshes) {
    unpacked->push_back(Unpack(transfer, std::exchange(mesh.scale, {}),
                               std::exchange(mesh.coefficients, {}), mesh.receivers.size()));
  }
  return unpacked;
}

void SphereSet::Resize(size_t count) {
  for (std::vector<float>* values : {&x, &y, &z, &radius}) {
    values->assign(count, 0.0f);
  }
}

void SphereSet::Set(size_t index, const glm::vec3& centre, float ball_radius) {
  x[index] = centre.x;
  y[index] = centre.y;
  z[index] = centre.z;
  radius[index] = ball_radius;
}

void SphereSet::Clear() {
  for (std::vector<float>* values : {&x, &y, &z, &radius}) {
    values->clear();
  }
}

void SphereSet::Add(const glm::vec3& centre, float ball_radius) {
  x.push_back(centre.x);
  y.push_back(centre.y);
  z.push_back(centre.z);
  radius.push_back(ball_radius);
}

void SphereSet::Append(const SphereSet& more) {
  x.insert(x.end(), more.x.begin(), more.x.end());
  y.insert(y.end(), more.y.begin(), more.y.end());
  z.insert(z.end(), more.z.begin(), more.z.end());
  radius.insert(radius.end(), more.radius.begin(), more.radius.end());
}

PersonLight::PersonLight(std::shared_ptr<const human::Human> human,
                         std::shared_ptr<const UnpackedLight> light)
    : human_(std::move(human)),
      skin_(human_->skeleton.size(), glm::mat4(1.0f)),
      receiver_light_(human_->light.count, human_->light.receivers.size()),
      transfers_(light != nullptr
                     ? std::move(light)
                     : std::make_shared<const UnpackedLight>(UnpackAll(human_->light))),
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
  GroupBlockers();
  blockers_.Resize(human_->light.blockers.size());
  OrderReceivers();
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

void PersonLight::OrderReceivers() {
  const std::vector<LightTransfer::Receiver>& receivers = human_->light.receivers;
  std::map<uint32_t, std::vector<uint16_t>> by_joint;
  for (size_t i = 0; i < receivers.size(); ++i) {
    by_joint[receivers[i].joint].push_back(static_cast<uint16_t>(i));
  }
  slots_.resize(receivers.size());
  bind_points_.Resize(receivers.size());
  stage_points_.Resize(receivers.size());
  for (std::vector<float>* values :
       {&stage_from_bind_.w, &stage_from_bind_.x, &stage_from_bind_.y, &stage_from_bind_.z}) {
    values->resize(receivers.size());
  }
  size_t slot = 0;
  for (const auto& [joint, members] : by_joint) {
    groups_.push_back({joint, slot, slot + members.size()});
    for (const uint16_t member : members) {
      bind_points_.Set(slot, receivers[member].position, 0.0f);
      slots_[member] = static_cast<uint16_t>(slot++);
    }
  }
}

void PersonLight::PlaceReceivers() {
  for (const Group& group : groups_) {
    const glm::mat4 stage_from_bind = stage_from_actor_ * skin_[group.joint];
    const glm::quat turn = RotationOf(stage_from_bind);
    for (size_t slot = group.begin; slot < group.end; ++slot) {
      const glm::vec4 bind(bind_points_.x[slot], bind_points_.y[slot], bind_points_.z[slot], 1.0f);
      stage_points_.Set(slot, stage_from_bind * bind, 0.0f);
      stage_from_bind_.w[slot] = turn.w;
      stage_from_bind_.x[slot] = turn.x;
      stage_from_bind_.y[slot] = turn.y;
      stage_from_bind_.z[slot] = turn.z;
    }
  }
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
        made.receivers[v].receiver[i] = slots_[mesh.receivers[v][i]];
      }
      made.receivers[v].weight = mesh.weights[v];
    }
  }
}

void PersonLight::FindKeyLogs() {
  const human::Skeleton& skeleton = human_->skeleton;
  for (const std::vector<human::JointTransform>& pose : human_->light.key_poses) {
    Pose(human::SkinOfPose(skeleton, pose), glm::mat4(1.0f));
    PlaceReceivers();
    OwnLog({0, own_log_.receivers()},
           key_logs_.emplace_back(own_log_.count(), own_log_.receivers()));
  }
}

void PersonLight::OwnLog(light::ReceiverRange range, light::ShRows& log) const {
  light::ClearLogVisibility(range, log);
  light::AddLogVisibility(blockers_.spheres(), points(), stage_from_bind_.turns(), range, log);
}

void PersonLight::Pose(std::span<const glm::mat4> skin, const glm::mat4& stage_from_actor) {
  std::copy(skin.begin(), skin.end(), skin_.begin());
  stage_from_actor_ = stage_from_actor;
  for (size_t i = 0; i < blockers_.size(); ++i) {
    const LightTransfer::Blocker& blocker = human_->light.blockers[blocker_order_[i]];
    const glm::vec4 in_actor = skin_[blocker.joint] * glm::vec4(blocker.centre, 1.0f);
    const glm::vec3 centre = stage_from_actor * in_actor;
    const glm::vec3 before(blockers_.x[i], blockers_.y[i], blockers_.z[i]);
    leapt_ = leapt_ || !(glm::distance(centre, before) < kLeap);
    blockers_.Set(i, centre, blocker.radius);
  }
  ++poses_;
  MergeGroups();
}

// Joins the two nearest groups until few enough are left.
void PersonLight::GroupBlockers() {
  const std::vector<LightTransfer::Blocker>& blockers = human_->light.blockers;
  std::vector<std::vector<uint32_t>> groups;
  std::vector<glm::vec3> centres;
  for (uint32_t i = 0; i < blockers.size(); ++i) {
    groups.push_back({i});
    centres.push_back(blockers[i].centre);
  }
  const size_t wanted = (blockers.size() + kBlockersOfGroup - 1) / kBlockersOfGroup;
  while (groups.size() > wanted) {
    size_t first = 0, second = 1;
    float least = std::numeric_limits<float>::max();
    for (size_t i = 0; i < groups.size(); ++i) {
      for (size_t k = i + 1; k < groups.size(); ++k) {
        // Join small groups first, so that no group grows long.
        const float distance = glm::distance(centres[i], centres[k]) *
                               static_cast<float>(groups[i].size() + groups[k].size());
        if (distance < least) {
          least = distance;
          first = i;
          second = k;
        }
      }
    }
    const auto sizes = glm::vec2(groups[first].size(), groups[second].size());
    centres[first] = (sizes.x * centres[first] + sizes.y * centres[second]) / (sizes.x + sizes.y);
    groups[first].insert(groups[first].end(), groups[second].begin(), groups[second].end());
    groups.erase(groups.begin() + static_cast<ptrdiff_t>(second));
    centres.erase(centres.begin() + static_cast<ptrdiff_t>(second));
  }
  for (const std::vector<uint32_t>& group : groups) {
    const size_t begin = blocker_order_.size();
    blocker_order_.insert(blocker_order_.end(), group.begin(), group.end());
    blocker_groups_.push_back({.begin = begin, .end = blocker_order_.size()});
  }
}

// From a distance, covered shares of the sky add up; a sphere's share grows with the square of its
// radius.
void PersonLight::MergeGroups() {
  low_ = glm::vec3(std::numeric_limits<float>::max());
  high_ = -low_;
  const auto centre_of = [&](size_t i) {
    return glm::vec3(blockers_.x[i], blockers_.y[i], blockers_.z[i]);
  };
  for (BlockerGroup& group : blocker_groups_) {
    glm::vec3 centre(0.0f);
    float share = 0.0f;
    for (size_t i = group.begin; i < group.end; ++i) {
      const float radius = blockers_.radius[i];
      centre += radius * radius * centre_of(i);
      share += radius * radius;
      low_ = glm::min(low_, centre_of(i) - radius);
      high_ = glm::max(high_, centre_of(i) + radius);
    }
    group.centre = share > 0.0f ? centre / share : centre_of(group.begin);
    group.radius = std::sqrt(share);
    group.extent = 0.0f;
    for (size_t i = group.begin; i < group.end; ++i) {
      group.extent =
          std::max(group.extent, glm::distance(group.centre, centre_of(i)) + blockers_.radius[i]);
    }
  }
}

void PersonLight::AppendBlockers(const PersonLight& seen_from, SphereSet& to) const {
  for (const BlockerGroup& group : blocker_groups_) {
    const glm::vec3 nearest = glm::clamp(group.centre, seen_from.low_, seen_from.high_);
    if (group.extent < kSmall * glm::distance(nearest, group.centre)) {
      to.Add(group.centre, group.radius);
      continue;
    }
    for (size_t i = group.begin; i < group.end; ++i) {
      to.Add({blockers_.x[i], blockers_.y[i], blockers_.z[i]}, blockers_.radius[i]);
    }
  }
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
  light::AddLamps(near_lamps_, points(), own_stage_log_, others, {0, receiver_light_.receivers()},
                  lamp_light_);
}

void PersonLight::Update(const light::LightMatrix& light,
                         const light::Spheres& others,
                         std::span<const light::Lamp> lamps) {
  const light::ReceiverRange all = {0, receiver_light_.receivers()};
  const light::ReceiverRange now = ChooseReceivers(light);
  PlaceReceivers();
  OwnLog(now, own_log_);
  light::KeyPoseWeights(key_logs_, own_log_, {}, now, pose_weights_);
  light::SubtractKeyPoses(key_logs_, own_log_, pose_weights_, now, own_log_);
  DampBrightening(now, own_log_);
  light::TurnRows(own_log_, stage_from_bind_.turns(), light::TurnDirection::kForth, now,
                  own_stage_log_);
  AddLamps(others, lamps);
  CopyRows(own_stage_log_, now, stage_log_);
  light::AddLogVisibility(others, points(), now, stage_log_);
  light::ShadowLight(light, stage_log_, now, shadowed_);
  const bool lamps_shine = !near_lamps_.empty();
  for (size_t channel = 0; lamps_shine && channel < 3; ++channel) {
    lamp_light_[channel].Add(shadowed_[channel]);
  }
  light::TurnRows(lamps_shine ? lamp_light_ : shadowed_, stage_from_bind_.turns(),
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
  gradual_ = poses_ == 1 && !leapt_ && !relit && count > kFew;
  poses_ = 0;
  leapt_ = false;
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
