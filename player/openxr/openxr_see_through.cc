#include "player/openxr/openxr_see_through.h"

#include <algorithm>
#include <cstring>

namespace lararium::player {
namespace {

bool RuntimeHas(const char* extension) {
  uint32_t count = 0;
  if (XR_FAILED(xrEnumerateInstanceExtensionProperties(nullptr, 0, &count, nullptr))) {
    return false;
  }
  std::vector<XrExtensionProperties> all(
      count, Typed<XrExtensionProperties>(XR_TYPE_EXTENSION_PROPERTIES));
  if (XR_FAILED(xrEnumerateInstanceExtensionProperties(nullptr, count, &count, all.data()))) {
    return false;
  }
  return std::any_of(all.begin(), all.end(), [&](const XrExtensionProperties& has) {
    return std::strcmp(has.extensionName, extension) == 0;
  });
}

// True if both the runtime and the connected headset support XR_FB_passthrough.
bool SystemPasses(XrInstance instance, XrSystemId system) {
  if (FunctionOf<PFN_xrCreatePassthroughFB>(instance, "xrCreatePassthroughFB") == nullptr) {
    return false;
  }
  auto passes = Typed<XrSystemPassthroughPropertiesFB>(XR_TYPE_SYSTEM_PASSTHROUGH_PROPERTIES_FB);
  auto properties = Typed<XrSystemProperties>(XR_TYPE_SYSTEM_PROPERTIES);
  properties.next = &passes;
  return XR_SUCCEEDED(xrGetSystemProperties(instance, system, &properties)) &&
         passes.supportsPassthrough == XR_TRUE;
}

}  // namespace

std::vector<const char*> OpenXrSeeThrough::Extensions() {
  if (RuntimeHas(XR_FB_PASSTHROUGH_EXTENSION_NAME)) {
    return {XR_FB_PASSTHROUGH_EXTENSION_NAME};
  }
  return {};
}

Status OpenXrSeeThrough::Begin(XrInstance instance,
                               XrSystemId system,
                               XrSession session,
                               Log& log) {
  uint32_t count = 0;
  LARARIUM_RETURN_IF_ERROR(ToStatus(
      instance, xrEnumerateEnvironmentBlendModes(instance, system, kEyesOfHead, 0, &count, nullptr),
      "asking how layers are blended"));
  std::vector<XrEnvironmentBlendMode> modes(count);
  LARARIUM_RETURN_IF_ERROR(ToStatus(
      instance,
      xrEnumerateEnvironmentBlendModes(instance, system, kEyesOfHead, count, &count, modes.data()),
      "asking how layers are blended"));
  const auto offers = [&](XrEnvironmentBlendMode mode) {
    return std::find(modes.begin(), modes.end(), mode) != modes.end();
  };
  if (offers(XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND)) {
    blend_mode_ = XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND;
    log.Info("what is real is shown by the headset, people are blended over it");
    return Status();
  }
  if (SystemPasses(instance, system)) {
    log.Info("what is real is shown by the headset, below people (XR_FB_passthrough)");
    return BeginPassthrough(instance, session);
  }
  if (offers(XR_ENVIRONMENT_BLEND_MODE_ADDITIVE)) {
    blend_mode_ = XR_ENVIRONMENT_BLEND_MODE_ADDITIVE;
    log.Warn("the headset can only add light: people are seen through, and cast no shadows");
    return Status();
  }
  return Status::Error(kOpenXrPlace, "the headset cannot show the real world itself",
                       "set \"see_through\" of the device file's \"headset\" to \"camera\"");
}

// The created objects are destroyed with the instance.
Status OpenXrSeeThrough::BeginPassthrough(XrInstance instance, XrSession session) {
  const auto create = FunctionOf<PFN_xrCreatePassthroughFB>(instance, "xrCreatePassthroughFB");
  const auto create_layer =
      FunctionOf<PFN_xrCreatePassthroughLayerFB>(instance, "xrCreatePassthroughLayerFB");
  if (create == nullptr || create_layer == nullptr) {
    return Status::Error(kOpenXrPlace, "the runtime lacks a function of its own extensions",
                         "update the runtime");
  }
  auto of = Typed<XrPassthroughCreateInfoFB>(XR_TYPE_PASSTHROUGH_CREATE_INFO_FB);
  of.flags = XR_PASSTHROUGH_IS_RUNNING_AT_CREATION_BIT_FB;
  XrPassthroughFB passthrough = XR_NULL_HANDLE;
  LARARIUM_RETURN_IF_ERROR(
      ToStatus(instance, create(session, &of, &passthrough), "showing what is real"));
  auto of_layer = Typed<XrPassthroughLayerCreateInfoFB>(XR_TYPE_PASSTHROUGH_LAYER_CREATE_INFO_FB);
  of_layer.passthrough = passthrough;
  of_layer.flags = XR_PASSTHROUGH_IS_RUNNING_AT_CREATION_BIT_FB;
  of_layer.purpose = XR_PASSTHROUGH_LAYER_PURPOSE_RECONSTRUCTION_FB;
  layer_ = Typed<XrCompositionLayerPassthroughFB>(XR_TYPE_COMPOSITION_LAYER_PASSTHROUGH_FB);
  layer_.flags = XR_COMPOSITION_LAYER_BLEND_TEXTURE_SOURCE_ALPHA_BIT;
  return ToStatus(instance, create_layer(session, &of_layer, &layer_.layerHandle),
                  "showing what is real");
}

const XrCompositionLayerBaseHeader* OpenXrSeeThrough::layer() const {
  return layer_.layerHandle == XR_NULL_HANDLE
             ? nullptr
             : reinterpret_cast<const XrCompositionLayerBaseHeader*>(&layer_);
}

}  // namespace lararium::player
