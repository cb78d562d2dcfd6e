#include "editor/import/model/bone_structure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>
#include <optional>

namespace lararium::import {
namespace {

constexpr float kLimbConfidence = 0.7f, kFingerConfidence = 0.5f;
constexpr float kSame = 0.15f;      // Share by which paired limbs may differ in length.
constexpr float kDownwards = 0.6f;  // Cosine of the angle between a segment of the leg and down.

glm::vec3 DirectionOr(const glm::vec3& v, const glm::vec3& instead) {
  const float length = glm::length(v);
  return length > 0.0f ? v / length : instead;
}

// Two similar limbs that branch from one bone.
struct Pair {
  int branch = Rig::kNoParent;
  int a = Rig::kNoParent, b = Rig::kNoParent;
  float reach = 0.0f;
};

struct Leg {
  int hip, knee, ankle, tip;
};

struct Arm {
  int shoulder, elbow, wrist;
};

class StructureFinder {
 public:
  explicit StructureFinder(const Rig& rig) : rig_(rig), children_(rig.Children()) {
    reach_.assign(rig.size(), 0.0f);
    tip_.resize(rig.size());
    std::iota(tip_.begin(), tip_.end(), 0);
    for (size_t i = rig.size(); i-- > 0;) {
      if (rig.parents[i] == Rig::kNoParent) {
        continue;
      }
      const auto parent = static_cast<size_t>(rig.parents[i]);
      const float reach = LimbReach(static_cast<int>(i));
      if (reach > reach_[parent]) {
        reach_[parent] = reach;
        tip_[parent] = tip_[i];
      }
    }
  }

  std::vector<MappedBone> Find() {
    if (!FindPairs()) {
      return {};
    }
    up_ = DirectionOr(At(arms_.branch) - At(legs_.branch), glm::vec3(0.0f));
    const auto leg_a = FindLeg(legs_.a), leg_b = FindLeg(legs_.b);
    const auto arm_a = FindArm(arms_.a), arm_b = FindArm(arms_.b);
    const int head = FindHead();
    if (!leg_a || !leg_b || !arm_a || !arm_b || head == Rig::kNoParent) {
      return {};
    }
    const glm::vec3 right = glm::cross(Forward({*leg_a, *leg_b}, {*arm_a, *arm_b}), up_);
    Add("skullbase", head, kLimbConfidence);
    const bool leg_a_right = IsRight(leg_a->ankle, leg_b->ankle, right);
    AddLeg(leg_a_right ? "r_" : "l_", *leg_a);
    AddLeg(leg_a_right ? "l_" : "r_", *leg_b);
    const bool arm_a_right = IsRight(arm_a->wrist, arm_b->wrist, right);
    AddArm(arm_a_right ? "r_" : "l_", *arm_a);
    AddArm(arm_a_right ? "l_" : "r_", *arm_b);
    return std::move(found_);
  }

 private:
  const glm::vec3& At(int bone) const { return rig_.positions[static_cast<size_t>(bone)]; }
  const std::vector<int>& Below(int bone) const { return children_[static_cast<size_t>(bone)]; }
  float Distance(int a, int b) const { return glm::distance(At(a), At(b)); }
  float Length(int bone) const {
    const int parent = rig_.parents[static_cast<size_t>(bone)];
    return parent == Rig::kNoParent ? 0.0f : Distance(parent, bone);
  }
  // Distance from the parent of this bone to the end of a limb that begins with it.
  float LimbReach(int bone) const { return Length(bone) + reach_[static_cast<size_t>(bone)]; }
  bool IsRight(int bone, int other, const glm::vec3& right) const {
    return glm::dot(At(bone) - At(other), right) > 0.0f;
  }
  void Add(const std::string& joint, int bone, float confidence) {
    found_.push_back({joint, static_cast<size_t>(bone), FoundBy::kStructure, confidence});
  }

  // The longest chain down from a bone, including it.
  std::vector<int> MainChain(int bone) const {
    std::vector<int> chain = {bone};
    while (!Below(bone).empty()) {
      bone = *std::max_element(Below(bone).begin(), Below(bone).end(),
                               [&](int a, int b) { return LimbReach(a) < LimbReach(b); });
      chain.push_back(bone);
    }
    return chain;
  }

  // Compares two limbs bone by bone.
  bool AreAlike(int first, int second) const {
    const std::vector<int> a = MainChain(first), b = MainChain(second);
    const float reach = std::max(LimbReach(first), LimbReach(second));
    bool alike = a.size() == b.size();
    for (size_t i = 0; alike && i < a.size(); ++i) {
      alike = std::abs(Length(a[i]) - Length(b[i])) < 0.07f * reach;
    }
    return alike;
  }

  std::optional<Pair> BestPair(int branch) const {
    Pair best;
    best.branch = branch;
    const std::vector<int>& below = Below(branch);
    for (size_t i = 0; i < std::min<size_t>(below.size(), 64); ++i) {
      for (size_t k = 0; k < i; ++k) {
        const float a = LimbReach(below[i]), b = LimbReach(below[k]);
        const int tip_a = tip_[static_cast<size_t>(below[i])];
        const int tip_b = tip_[static_cast<size_t>(below[k])];
        if (a + b > best.reach && std::min(a, b) > (1.0f - kSame) * std::max(a, b) &&
            Distance(tip_a, tip_b) > 0.05f * (a + b) && AreAlike(below[i], below[k])) {
          best.a = below[k];
          best.b = below[i];
          best.reach = a + b;
        }
      }
    }
    return best.reach > 0.0f ? std::optional(best) : std::nullopt;
  }

  bool IsInPair(const Pair& pair, int bone) const {
    return rig_.IsBelow(pair.a, bone) || rig_.IsBelow(pair.b, bone);
  }

  // Reach of the other children of a pair's branch; for the arms, this finds the head.
  float BesidesPair(const Pair& pair) const {
    float reach = 0.0f;
    for (const int child : Below(pair.branch)) {
      reach = child == pair.a || child == pair.b ? reach : std::max(reach, LimbReach(child));
    }
    return reach;
  }

  // Either the branch of the legs is above that of the arms in the tree, or both hang from one
  // pelvis and the branch of the arms carries the head.
  bool FindPairs() {
    std::vector<Pair> pairs;
    for (size_t bone = 0; bone < rig_.size(); ++bone) {
      if (Below(static_cast<int>(bone)).size() >= 2) {
        if (const auto pair = BestPair(static_cast<int>(bone))) {
          pairs.push_back(*pair);
        }
      }
    }
    std::sort(pairs.begin(), pairs.end(),
              [](const Pair& a, const Pair& b) { return a.reach > b.reach; });
    pairs.resize(std::min<size_t>(pairs.size(), 64));
    float best = 0.0f;
    for (const Pair& legs : pairs) {
      for (const Pair& arms : pairs) {
        const bool apart =
            legs.branch != arms.branch && !IsInPair(legs, arms.branch) &&
            !IsInPair(arms, legs.branch) && !rig_.IsBelow(arms.branch, legs.branch) &&
            (rig_.IsBelow(legs.branch, arms.branch) || BesidesPair(arms) > BesidesPair(legs));
        const float smaller = std::min(legs.reach, arms.reach);
        if (apart && smaller > 0.4f * std::max(legs.reach, arms.reach) &&
            Distance(legs.branch, arms.branch) > 0.03f * smaller && smaller > best) {
          best = smaller;
          legs_ = legs;
          arms_ = arms;
        }
      }
    }
    return best > 0.0f;
  }

  // Thigh and shin are the straight chain down; the foot begins where it turns forwards.
  std::optional<Leg> FindLeg(int first) const {
    const std::vector<int> chain = MainChain(first);
    size_t hip = chain.size(), ankle = 0;
    for (size_t i = 0; i + 1 < chain.size(); ++i) {
      const glm::vec3 segment = At(chain[i + 1]) - At(chain[i]);
      if (glm::dot(segment, -up_) > kDownwards * glm::length(segment) &&
          glm::length(segment) > 0.1f * reach_[static_cast<size_t>(first)]) {
        hip = std::min(hip, i);
        ankle = i + 1;
      }
    }
    if (hip + 2 > ankle || hip == chain.size()) {
      return std::nullopt;
    }
    const float whole = Distance(chain[hip], chain[ankle]);
    size_t knee = hip + 1;
    for (size_t i = hip + 1; i < ankle; ++i) {
      if (std::abs(Distance(chain[hip], chain[i]) - 0.5f * whole) <
          std::abs(Distance(chain[hip], chain[knee]) - 0.5f * whole)) {
        knee = i;
      }
    }
    return Leg{chain[hip], chain[knee], chain[ankle], chain.back()};
  }

  // Upper arm and forearm have similar lengths and make up most of the distance to the wrist,
  // from which the fingers branch.
  std::optional<Arm> FindArm(int first) const {
    std::vector<int> chain = MainChain(first);
    // The wrist has three fingers or more; otherwise it is the last fork, as of a thumb and a
    // mitten.
    size_t wrist = 0;
    for (size_t i = 2; i < chain.size() && wrist == 0; ++i) {
      wrist = Below(chain[i]).size() >= 3 ? i : 0;
    }
    for (size_t i = chain.size(); i-- > 2 && wrist == 0;) {
      wrist = Below(chain[i]).size() >= 2 ? i : 0;
    }
    std::optional<Arm> best;
    float lowest = std::numeric_limits<float>::max();
    const size_t first_wrist = wrist != 0 ? wrist : 2;
    const size_t last_wrist = wrist != 0 ? wrist : std::min<size_t>(chain.size() - 1, 16);
    for (size_t w = first_wrist; w <= last_wrist && w < chain.size(); ++w) {
      float way = Length(first);
      for (size_t i = 1; i <= w; ++i) {
        way += Length(chain[i]);
      }
      for (size_t e = 1; e < w; ++e) {
        for (size_t s = 0; s < e; ++s) {
          const float upper = Distance(chain[s], chain[e]), fore = Distance(chain[e], chain[w]);
          if (!(upper > 0.0f) || !(fore > 0.0f)) {
            continue;
          }
          const float cost = std::abs(upper - fore) / (upper + fore) +
                             0.5f * (1.0f - (upper + fore) / std::max(way, upper + fore));
          if (cost < lowest - 1e-4f) {
            lowest = cost;
            best = Arm{chain[s], chain[e], chain[w]};
          }
        }
      }
    }
    return best;
  }

  int FindHead() const {
    int top = Rig::kNoParent;
    for (const int child : Below(arms_.branch)) {
      const int tip = MainChain(child).back();
      const bool rises = glm::dot(At(tip) - At(arms_.branch), up_) >
                         0.4f * glm::length(At(tip) - At(arms_.branch));
      if (child != arms_.a && child != arms_.b && rises &&
          (top == Rig::kNoParent || LimbReach(child) > LimbReach(top))) {
        top = child;
      }
    }
    if (top == Rig::kNoParent) {
      return top;
    }
    const std::vector<int> chain = MainChain(top);
    for (const int bone : chain) {
      if (Below(bone).size() > 1) {
        return bone;  // Bones of the face branch from the head.
      }
    }
    return chain[chain.size() >= 3 ? chain.size() - 2 : chain.size() - 1];
  }

  glm::vec3 Across(const glm::vec3& v) const { return v - glm::dot(v, up_) * up_; }

  glm::vec3 Forward(const std::array<Leg, 2>& legs, const std::array<Arm, 2>& arms) const {
    glm::vec3 toes(0.0f), knees(0.0f), elbows(0.0f);
    for (const Leg& leg : legs) {
      toes += Across(At(leg.tip) - At(leg.ankle));
      knees += Across(At(leg.knee) - 0.5f * (At(leg.hip) + At(leg.ankle)));
    }
    for (const Arm& arm : arms) {
      elbows += Across(At(arm.elbow) - 0.5f * (At(arm.shoulder) + At(arm.wrist)));
    }
    const float leg_length = Distance(legs[0].hip, legs[0].ankle);
    const glm::vec3 across_hips =
        DirectionOr(Across(At(legs[0].hip) - At(legs[1].hip)), glm::vec3(0.0f));
    const auto middle = [&](const glm::vec3& v) {
      return v - glm::dot(v, across_hips) * across_hips;
    };
    for (const glm::vec3& v : {middle(toes), middle(knees), -middle(elbows)}) {
      if (glm::length(v) > 0.01f * leg_length) {
        return glm::normalize(v);
      }
    }
    return DirectionOr(middle(Across(glm::vec3(0.0f, 0.0f, 1.0f))), glm::vec3(0.0f, 0.0f, 1.0f));
  }

  void AddLeg(const std::string& side, const Leg& leg) {
    Add(side + "hip", leg.hip, kLimbConfidence);
    Add(side + "knee", leg.knee, kLimbConfidence);
    Add(side + "ankle", leg.ankle, kLimbConfidence);
    const std::vector<int> foot = rig_.Chain(leg.ankle, leg.tip);
    if (!foot.empty()) {
      Add(side + "midtarsal", foot.front(), kFingerConfidence);
    }
  }

  void AddArm(const std::string& side, const Arm& arm) {
    Add(side + "shoulder", arm.shoulder, kLimbConfidence);
    Add(side + "elbow", arm.elbow, kLimbConfidence);
    Add(side + "wrist", arm.wrist, kLimbConfidence);
    AddFingers(side, arm.wrist);
  }

  // The thumb has the largest angle to the hand; the other fingers are ordered by distance from
  // it.
  void AddFingers(const std::string& side, int wrist) {
    std::vector<std::vector<int>> fingers;
    for (const int child : Below(wrist)) {
      std::vector<int> chain = MainChain(child);
      if (chain.size() >= 2) {
        fingers.push_back(std::move(chain));
      }
    }
    if (fingers.size() < 3 || fingers.size() > 5) {
      return;
    }
    const auto direction = [&](const std::vector<int>& finger) {
      return DirectionOr(At(finger[1]) - At(finger[0]), glm::vec3(0.0f));
    };
    glm::vec3 mean(0.0f);
    for (const std::vector<int>& finger : fingers) {
      mean += direction(finger);
    }
    std::sort(fingers.begin(), fingers.end(), [&](const auto& a, const auto& b) {
      return glm::dot(direction(a), mean) < glm::dot(direction(b), mean);
    });
    std::sort(fingers.begin() + 1, fingers.end(), [&](const auto& a, const auto& b) {
      return Distance(a[0], fingers[0][1]) < Distance(b[0], fingers[0][1]);
    });
    constexpr const char* kNames[] = {"thumb", "index", "middle", "ring", "pinky"};
    for (size_t f = 0; f < fingers.size(); ++f) {
      const size_t count = std::min<size_t>(fingers[f].size(), 3);
      for (size_t i = 0; i < count; ++i) {
        Add(side + kNames[f] + std::to_string(i + 1), fingers[f][i], kFingerConfidence);
      }
    }
  }

  const Rig& rig_;
  std::vector<std::vector<int>> children_;
  std::vector<float> reach_;  // Length of the longest chain down from each bone.
  std::vector<int> tip_;      // The last bone of that chain.
  glm::vec3 up_ = glm::vec3(0.0f);
  Pair legs_, arms_;
  std::vector<MappedBone> found_;
};

}  // namespace

std::vector<MappedBone> MapByStructure(const Rig& rig) {
  constexpr size_t kMaxBones = 4096;
  if (rig.size() == 0 || rig.size() > kMaxBones) {
    return {};
  }
  return StructureFinder(rig).Find();
}

}  // namespace lararium::import
