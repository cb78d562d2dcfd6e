#pragma once

// Helpers for calls of OpenXR: structures, axes and errors. Private to the OpenXR headset.

#include <ctime>
#include <string_view>

#include "shared/core/status.h"
#include "shared/geometry/transform.h"

#define XR_USE_GRAPHICS_API_OPENGL
#define XR_USE_TIMESPEC
#include <openxr/openxr.h>
#include <openxr/openxr_platform.h>

namespace lararium::player {

inline constexpr std::string_view kOpenXrPlace = "OpenXR";
inline constexpr auto kEyesOfHead = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO;

// OpenXR's axes are x right, y up, z backward; ours x right, y down, z forward.
geometry::Rigid3 FromXr(const XrPosef& pose);
XrPosef ToXr(const geometry::Rigid3& pose);

// OpenXR's structures begin with their type.
template <typename T>
T Typed(XrStructureType type) {
  T value = {};
  value.type = type;
  return value;
}

// Converts a result to a status. what: name of the call in the error. instance may be null: the
// error then contains only the number of the result. If the runtime was lost, the error says so and
// what to do.
Status ToStatus(XrInstance instance, XrResult result, const char* what);

// Returns a function of an extension; nullptr: the runtime lacks it.
template <typename Function>
Function FunctionOf(XrInstance instance, const char* name) {
  PFN_xrVoidFunction found = nullptr;
  xrGetInstanceProcAddr(instance, name, &found);
  return reinterpret_cast<Function>(found);
}

}  // namespace lararium::player
