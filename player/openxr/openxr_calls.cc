#include "player/openxr/openxr_calls.h"

#include <cstdio>
#include <string>

namespace lararium::player {
namespace {

bool IsLoss(XrResult result) {
  return result == XR_ERROR_SESSION_LOST || result == XR_ERROR_INSTANCE_LOST ||
         result == XR_ERROR_RUNTIME_FAILURE || result == XR_SESSION_LOSS_PENDING;
}

}  // namespace

geometry::Rigid3 FromXr(const XrPosef& pose) {
  const XrQuaternionf& q = pose.orientation;
  const XrVector3f& p = pose.position;
  return {Eigen::Quaterniond(q.w, q.x, -q.y, -q.z).normalized(), Eigen::Vector3d(p.x, -p.y, -p.z)};
}

XrPosef ToXr(const geometry::Rigid3& pose) {
  const Eigen::Quaternionf q = pose.rotation.cast<float>();
  const Eigen::Vector3f p = pose.translation.cast<float>();
  return {{q.x(), -q.y(), -q.z(), q.w()}, {p.x(), -p.y(), -p.z()}};
}

Status ToStatus(XrInstance instance, XrResult result, const char* what) {
  if (XR_SUCCEEDED(result) && !IsLoss(result)) {
    return Status();
  }
  char name[XR_MAX_RESULT_STRING_SIZE] = {};
  if (instance == XR_NULL_HANDLE || XR_FAILED(xrResultToString(instance, result, name))) {
    std::snprintf(name, sizeof(name), "error %d", static_cast<int>(result));
  }
  if (IsLoss(result)) {
    return Status::Error(kOpenXrPlace, std::string("the runtime was lost (") + name + ")",
                         "start the headset's runtime again, then the player");
  }
  return Status::Error(kOpenXrPlace, std::string(what) + " failed (" + name + ")",
                       "see the messages of the headset's runtime");
}

}  // namespace lararium::player
