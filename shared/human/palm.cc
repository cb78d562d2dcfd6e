#include "shared/human/palm.h"

#include <glm/geometric.hpp>

#include "shared/human/turns.h"

namespace lararium::human {
namespace {

class PalmFinder {
 public:
  PalmFinder(const BodyRig& body, int side) : body_(body), side_(side) {}

  Palm Find() const {
    const BodyRig::Arm& arm = body_.arms[static_cast<size_t>(side_)];
    const glm::vec3 wrist = Rest(arm.wrist);
    const glm::vec3 forearm = wrist - Rest(arm.elbow);
    glm::vec3 knuckles(0.0f);
    int count = 0;
    for (int finger = 1; finger < BodyRig::kFingers; ++finger) {
      if (Knuckle(finger) != kNoJoint) {
        knuckles += Rest(Knuckle(finger)) - wrist;
        ++count;
      }
    }
    Palm palm;
    const glm::vec3 way = count > 0 ? knuckles / static_cast<float>(count) : 0.35f * forearm;
    palm.length = glm::length(way);
    palm.along = Direction(way, Direction(forearm, glm::vec3(0.0f, -1.0f, 0.0f)));
    const glm::vec3 thumb = Across(TowardsThumb(wrist), palm.along);
    palm.thumb = Direction(thumb, AnyAcross(palm.along));
    // Right hand, palm down, fingers forward: the thumb is on the left, the back is up.
    palm.back = SideSign(side_) * glm::cross(palm.along, palm.thumb);
    return palm;
  }

 private:
  glm::vec3 Rest(JointIndex joint) const { return body_.rest[static_cast<size_t>(joint)].position; }
  JointIndex Knuckle(int finger) const {
    return body_.fingers[static_cast<size_t>(side_)][static_cast<size_t>(finger)].joints[0];
  }

  glm::vec3 TowardsThumb(const glm::vec3& wrist) const {
    constexpr int kIndex = 1, kLittle = 4;
    if (Knuckle(kIndex) != kNoJoint && Knuckle(kLittle) != kNoJoint) {
      return Rest(Knuckle(kIndex)) - Rest(Knuckle(kLittle));
    }
    if (Knuckle(BodyRig::kThumb) != kNoJoint) {
      return Rest(Knuckle(BodyRig::kThumb)) - wrist;
    }
    return {0.0f, 0.0f, -1.0f};  // The thumbs of hanging arms are in front.
  }

  const BodyRig& body_;
  int side_;
};

}  // namespace

Palm FindPalm(const BodyRig& body, int side) { return PalmFinder(body, side).Find(); }

}  // namespace lararium::human
