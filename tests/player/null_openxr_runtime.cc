// An OpenXR runtime without a headset for tests. The OpenXR loader opens it like any other. Its
// head moves according to a script, its images are textures in the program's own context, and it
// logs the submitted layers. It implements only the functions that the player uses, and checks
// their order.
//
// The environment variable LARARIUM_NULL_XR has words separated by blanks. log=FILE: calls are
// written to this file. exit=N, lose=N: the runtime ends the session, or is lost, at frame N. away:
// no headset is connected. turn=A: the head turns to the left about the vertical by A radians per
// second. blends=MODES: offered blend modes, letters o (opaque), a (alpha), + (additive); default
// o. passes: a layer can show the real world (XR_FB_passthrough). press=PATH@N, repeatable: an
// input of the simple controllers is held for three frames from frame N on. aside: another program
// has the focus. timeless=N: from frame N on, times cannot be converted.

#include <epoxy/gl.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <deque>
#include <sstream>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#define XR_USE_GRAPHICS_API_OPENGL
#define XR_USE_TIMESPEC
#include <openxr/openxr.h>
#include <openxr/openxr_platform.h>

// The interface between loader and runtime (OpenXR loader specification, "Runtime interface
// negotiation"). Debian's package does not contain its header.
struct LoaderInfo {
  int type;  // 1
  uint32_t version;
  size_t size;
  uint32_t min_interface;
  uint32_t max_interface;
  XrVersion min_api;
  XrVersion max_api;
};
struct RuntimeRequest {
  int type;  // 3
  uint32_t version;
  size_t size;
  uint32_t interface;
  XrVersion api;
  PFN_xrGetInstanceProcAddr get;
};

namespace {

constexpr XrTime kPeriod = 11'111'111;  // 90 Hz
constexpr float kHalfEyes = 0.032f;     // metres
constexpr uint32_t kImages = 3;
// Spaces are identified by their handles.
const auto kSession = reinterpret_cast<XrSession>(uintptr_t{1});
const auto kRoom = reinterpret_cast<XrSpace>(uintptr_t{2});
const auto kHead = reinterpret_cast<XrSpace>(uintptr_t{3});
const auto kPassthrough = reinterpret_cast<XrPassthroughFB>(uintptr_t{4});
const auto kPassthroughLayer = reinterpret_cast<XrPassthroughLayerFB>(uintptr_t{5});

struct Swapchain {
  GLuint textures[kImages] = {};
  int width = 0;
  int height = 0;
  uint32_t next = 0;
  bool acquired = false;
};

struct Runtime {
  std::FILE* log = nullptr;
  long exit_at = -1;
  long lose_at = -1;
  long timeless_from = -1;
  bool away = false;
  double turn = 0.0;
  std::string blends = "o";
  bool passes = false;
  std::vector<std::pair<std::string, long>> presses;  // path, frame
  std::vector<std::string> paths;                     // XrPath is the index plus 1
  // The inputs that each action is bound to; an action's handle is its index plus 1.
  std::vector<std::vector<std::string>> actions;
  bool aside = false;
  bool attached = false;
  bool focused = false;
  std::vector<bool> held;  // state of each action at the last sync
  std::deque<XrSessionState> events;
  long frames = 0;
  bool running = false;
  bool waited = false;
  bool begun = false;
  bool lost = false;
  XrTime began = 0;

  ~Runtime() {
    if (log != nullptr) {
      std::fclose(log);
    }
  }
  void Write(const std::string& line) const {
    if (log != nullptr) {
      std::fprintf(log, "%s\n", line.c_str());
      std::fflush(log);
    }
  }
};
Runtime* g_runtime = nullptr;

XrTime Now() {
  timespec now = {};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * 1'000'000'000LL + now.tv_nsec;
}

void ReadScript(Runtime& runtime, bool writes) {
  const char* script = std::getenv("LARARIUM_NULL_XR");
  std::istringstream words(script == nullptr ? "" : script);
  std::string word;
  while (words >> word) {
    const std::string value = word.substr(word.find('=') + 1);
    if (word.rfind("log=", 0) == 0) {
      runtime.log = writes ? std::fopen(value.c_str(), "w") : nullptr;
    } else if (word.rfind("exit=", 0) == 0) {
      runtime.exit_at = std::stol(value);
    } else if (word.rfind("lose=", 0) == 0) {
      runtime.lose_at = std::stol(value);
    } else if (word.rfind("timeless=", 0) == 0) {
      runtime.timeless_from = std::stol(value);
    } else if (word.rfind("turn=", 0) == 0) {
      runtime.turn = std::stod(value);
    } else if (word.rfind("blends=", 0) == 0) {
      runtime.blends = value;
    } else if (word.rfind("press=", 0) == 0) {
      const size_t at = value.find('@');
      runtime.presses.emplace_back(value.substr(0, at), std::stol(value.substr(at + 1)));
    } else if (word == "passes") {
      runtime.passes = true;
    } else if (word == "aside") {
      runtime.aside = true;
    } else if (word == "away") {
      runtime.away = true;
    }
  }
}

// The pose of the head according to the script.
XrPosef HeadAt(XrTime time) {
  const double half = 0.5 * g_runtime->turn * static_cast<double>(time - g_runtime->began) * 1e-9;
  return {{0.0f, static_cast<float>(std::sin(half)), 0.0f, static_cast<float>(std::cos(half))},
          {0.0f, 1.6f, 0.0f}};
}

// Reads red, green, blue and alpha of a texture at a position, given as shares of its size from the
// lower left corner.
std::string PixelOf(const Swapchain& chain, double x, double y) {
  const uint32_t shown = (chain.next + kImages - 1) % kImages;
  GLuint framebuffer = 0;
  GLint before = 0;
  glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &before);
  glGenFramebuffers(1, &framebuffer);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
  glFramebufferTexture2D(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D,
                         chain.textures[shown], 0);
  unsigned char rgba[4] = {};
  glReadPixels(static_cast<int>(x * chain.width), static_cast<int>(y * chain.height), 1, 1, GL_RGBA,
               GL_UNSIGNED_BYTE, rgba);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(before));
  glDeleteFramebuffers(1, &framebuffer);
  return std::to_string(rgba[0]) + "," + std::to_string(rgba[1]) + "," + std::to_string(rgba[2]) +
         "," + std::to_string(rgba[3]);
}

std::string Describe(const XrCompositionLayerProjection& projection) {
  std::string all = "projection space " + std::string(projection.space == kRoom ? "room" : "head") +
                    " flags " + std::to_string(projection.layerFlags);
  for (uint32_t i = 0; i < projection.viewCount; ++i) {
    const XrCompositionLayerProjectionView& view = projection.views[i];
    const auto& chain = *reinterpret_cast<const Swapchain*>(view.subImage.swapchain);
    char text[400];
    std::snprintf(text, sizeof(text),
                  " | position %.5f %.5f %.5f orientation %.5f %.5f %.5f %.5f fov %.5f %.5f %.5f "
                  "%.5f upper %s lower %s",
                  view.pose.position.x, view.pose.position.y, view.pose.position.z,
                  view.pose.orientation.w, view.pose.orientation.x, view.pose.orientation.y,
                  view.pose.orientation.z, view.fov.angleLeft, view.fov.angleRight,
                  view.fov.angleUp, view.fov.angleDown, PixelOf(chain, 0.5, 0.9).c_str(),
                  PixelOf(chain, 0.5, 0.1).c_str());
    all += text;
  }
  return all;
}

std::string Describe(const XrCompositionLayerQuad& quad) {
  const auto& chain = *reinterpret_cast<const Swapchain*>(quad.subImage.swapchain);
  const char* eye = quad.eyeVisibility == XR_EYE_VISIBILITY_BOTH   ? "both"
                    : quad.eyeVisibility == XR_EYE_VISIBILITY_LEFT ? "left"
                                                                   : "right";
  char text[400];
  std::snprintf(text, sizeof(text),
                "quad eye %s space %s position %.5f %.5f %.5f orientation %.5f %.5f %.5f %.5f "
                "size %.5f %.5f pixels %d %d upper %s lower %s",
                eye, quad.space == kRoom ? "room" : "head", quad.pose.position.x,
                quad.pose.position.y, quad.pose.position.z, quad.pose.orientation.w,
                quad.pose.orientation.x, quad.pose.orientation.y, quad.pose.orientation.z,
                quad.size.width, quad.size.height, quad.subImage.imageRect.extent.width,
                quad.subImage.imageRect.extent.height, PixelOf(chain, 0.5, 0.9).c_str(),
                PixelOf(chain, 0.5, 0.1).c_str());
  return text;
}

XrResult EnumerateInstanceExtensionProperties(const char* /*layer*/,
                                              uint32_t capacity,
                                              uint32_t* count,
                                              XrExtensionProperties* properties) {
  const char* names[] = {XR_KHR_OPENGL_ENABLE_EXTENSION_NAME,
                         XR_KHR_CONVERT_TIMESPEC_TIME_EXTENSION_NAME,
                         XR_FB_PASSTHROUGH_EXTENSION_NAME};
  // This function is called before there is an instance.
  Runtime scripted;
  ReadScript(scripted, false);
  *count = scripted.passes ? 3 : 2;
  for (uint32_t i = 0; i < *count && capacity >= *count; ++i) {
    std::snprintf(properties[i].extensionName, sizeof(properties[i].extensionName), "%s", names[i]);
    properties[i].extensionVersion = 1;
  }
  return XR_SUCCESS;
}

XrResult CreateInstance(const XrInstanceCreateInfo* create, XrInstance* instance) {
  g_runtime = new Runtime();
  ReadScript(*g_runtime, true);
  g_runtime->began = Now();
  g_runtime->Write(std::string("instance for ") + create->applicationInfo.applicationName);
  *instance = reinterpret_cast<XrInstance>(g_runtime);
  return XR_SUCCESS;
}

XrResult DestroyInstance(XrInstance /*instance*/) {
  g_runtime->Write("instance destroyed");
  delete g_runtime;
  g_runtime = nullptr;
  return XR_SUCCESS;
}

XrResult GetInstanceProperties(XrInstance /*instance*/, XrInstanceProperties* properties) {
  properties->runtimeVersion = XR_MAKE_VERSION(1, 0, 0);
  std::snprintf(properties->runtimeName, sizeof(properties->runtimeName), "null");
  return XR_SUCCESS;
}

XrResult ResultToString(XrInstance /*instance*/, XrResult result, char* name) {
  const char* known = result == XR_ERROR_SESSION_LOST         ? "XR_ERROR_SESSION_LOST"
                      : result == XR_ERROR_CALL_ORDER_INVALID ? "XR_ERROR_CALL_ORDER_INVALID"
                                                              : "XR_RESULT";
  std::snprintf(name, XR_MAX_RESULT_STRING_SIZE, "%s", known);
  return XR_SUCCESS;
}

XrResult GetSystem(XrInstance /*instance*/, const XrSystemGetInfo* get, XrSystemId* system) {
  if (g_runtime->away || get->formFactor != XR_FORM_FACTOR_HEAD_MOUNTED_DISPLAY) {
    return XR_ERROR_FORM_FACTOR_UNAVAILABLE;
  }
  *system = 1;
  return XR_SUCCESS;
}

XrResult GetSystemProperties(XrInstance /*instance*/,
                             XrSystemId /*system*/,
                             XrSystemProperties* properties) {
  auto* more = static_cast<XrSystemPassthroughPropertiesFB*>(properties->next);
  if (more != nullptr && more->type == XR_TYPE_SYSTEM_PASSTHROUGH_PROPERTIES_FB) {
    more->supportsPassthrough = g_runtime->passes ? XR_TRUE : XR_FALSE;
  }
  return XR_SUCCESS;
}

XrResult EnumerateEnvironmentBlendModes(XrInstance /*instance*/,
                                        XrSystemId /*system*/,
                                        XrViewConfigurationType /*views*/,
                                        uint32_t capacity,
                                        uint32_t* count,
                                        XrEnvironmentBlendMode* modes) {
  *count = static_cast<uint32_t>(g_runtime->blends.size());
  for (uint32_t i = 0; i < *count && capacity >= *count; ++i) {
    const char letter = g_runtime->blends[i];
    modes[i] = letter == 'a'   ? XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND
               : letter == '+' ? XR_ENVIRONMENT_BLEND_MODE_ADDITIVE
                               : XR_ENVIRONMENT_BLEND_MODE_OPAQUE;
  }
  return XR_SUCCESS;
}

XrResult CreatePassthrough(XrSession /*session*/,
                           const XrPassthroughCreateInfoFB* create,
                           XrPassthroughFB* passthrough) {
  *passthrough = kPassthrough;
  g_runtime->Write("passthrough flags " + std::to_string(create->flags));
  return XR_SUCCESS;
}

XrResult CreatePassthroughLayer(XrSession /*session*/,
                                const XrPassthroughLayerCreateInfoFB* create,
                                XrPassthroughLayerFB* layer) {
  if (create->passthrough != kPassthrough ||
      create->purpose != XR_PASSTHROUGH_LAYER_PURPOSE_RECONSTRUCTION_FB) {
    return XR_ERROR_VALIDATION_FAILURE;
  }
  *layer = kPassthroughLayer;
  return XR_SUCCESS;
}

XrResult GetOpenGlRequirements(XrInstance /*instance*/,
                               XrSystemId /*system*/,
                               XrGraphicsRequirementsOpenGLKHR* requirements) {
  requirements->minApiVersionSupported = XR_MAKE_VERSION(3, 3, 0);
  requirements->maxApiVersionSupported = XR_MAKE_VERSION(4, 6, 0);
  g_runtime->Write("requirements");
  return XR_SUCCESS;
}

XrResult CreateSession(XrInstance /*instance*/,
                       const XrSessionCreateInfo* create,
                       XrSession* session) {
  const auto* binding = static_cast<const XrBaseInStructure*>(create->next);
  if (binding == nullptr || binding->type != XR_TYPE_GRAPHICS_BINDING_OPENGL_XLIB_KHR) {
    return XR_ERROR_GRAPHICS_DEVICE_INVALID;
  }
  *session = kSession;
  g_runtime->events = {XR_SESSION_STATE_IDLE, XR_SESSION_STATE_READY};
  g_runtime->Write("session");
  return XR_SUCCESS;
}

XrResult DestroySession(XrSession /*session*/) { return XR_SUCCESS; }

XrResult CreateReferenceSpace(XrSession /*session*/,
                              const XrReferenceSpaceCreateInfo* create,
                              XrSpace* space) {
  *space = create->referenceSpaceType == XR_REFERENCE_SPACE_TYPE_VIEW ? kHead : kRoom;
  return XR_SUCCESS;
}

XrResult DestroySpace(XrSpace /*space*/) { return XR_SUCCESS; }

XrResult LocateSpace(XrSpace space, XrSpace base, XrTime time, XrSpaceLocation* location) {
  if (space != kHead || base != kRoom || time <= 0) {
    return XR_ERROR_VALIDATION_FAILURE;
  }
  location->locationFlags =
      XR_SPACE_LOCATION_ORIENTATION_VALID_BIT | XR_SPACE_LOCATION_POSITION_VALID_BIT;
  location->pose = HeadAt(time);
  return XR_SUCCESS;
}

XrResult LocateViews(XrSession /*session*/,
                     const XrViewLocateInfo* locate,
                     XrViewState* state,
                     uint32_t capacity,
                     uint32_t* count,
                     XrView* views) {
  *count = 2;
  if (capacity < 2 || (locate->space != kHead && locate->space != kRoom)) {
    return XR_ERROR_VALIDATION_FAILURE;
  }
  state->viewStateFlags = XR_VIEW_STATE_ORIENTATION_VALID_BIT | XR_VIEW_STATE_POSITION_VALID_BIT;
  // Rotates about the vertical only.
  const XrPosef head =
      locate->space == kRoom ? HeadAt(locate->displayTime) : XrPosef{{0.0f, 0.0f, 0.0f, 1.0f}, {}};
  const float cosine = 1.0f - 2.0f * head.orientation.y * head.orientation.y;
  const float sine = 2.0f * head.orientation.y * head.orientation.w;
  for (int eye = 0; eye < 2; ++eye) {
    const float beside = eye == 0 ? -kHalfEyes : kHalfEyes;
    views[eye].pose = head;
    views[eye].pose.position.x += cosine * beside;
    views[eye].pose.position.z -= sine * beside;
    views[eye].fov = {-0.8f, 0.8f, 0.8f, -0.8f};
  }
  return XR_SUCCESS;
}

XrResult EnumerateSwapchainFormats(XrSession /*session*/,
                                   uint32_t capacity,
                                   uint32_t* count,
                                   int64_t* formats) {
  *count = 2;
  if (capacity >= 2) {
    formats[0] = GL_RGBA16F;
    formats[1] = GL_SRGB8_ALPHA8;
  }
  return XR_SUCCESS;
}

XrResult CreateSwapchain(XrSession /*session*/,
                         const XrSwapchainCreateInfo* create,
                         XrSwapchain* swapchain) {
  auto* chain = new Swapchain();
  chain->width = static_cast<int>(create->width);
  chain->height = static_cast<int>(create->height);
  GLint before = 0;
  glGetIntegerv(GL_TEXTURE_BINDING_2D, &before);
  glGenTextures(kImages, chain->textures);
  for (const GLuint texture : chain->textures) {
    glBindTexture(GL_TEXTURE_2D, texture);
    glTexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(create->format), chain->width, chain->height,
                 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
  }
  glBindTexture(GL_TEXTURE_2D, static_cast<GLuint>(before));
  *swapchain = reinterpret_cast<XrSwapchain>(chain);
  g_runtime->Write("swapchain " + std::to_string(chain->width) + " " +
                   std::to_string(chain->height));
  return XR_SUCCESS;
}

XrResult DestroySwapchain(XrSwapchain swapchain) {
  auto* chain = reinterpret_cast<Swapchain*>(swapchain);
  glDeleteTextures(kImages, chain->textures);
  delete chain;
  return XR_SUCCESS;
}

XrResult EnumerateSwapchainImages(XrSwapchain swapchain,
                                  uint32_t capacity,
                                  uint32_t* count,
                                  XrSwapchainImageBaseHeader* images) {
  *count = kImages;
  auto* list = reinterpret_cast<XrSwapchainImageOpenGLKHR*>(images);
  for (uint32_t i = 0; i < kImages && capacity >= kImages; ++i) {
    list[i].image = reinterpret_cast<Swapchain*>(swapchain)->textures[i];
  }
  return XR_SUCCESS;
}

XrResult AcquireSwapchainImage(XrSwapchain swapchain,
                               const XrSwapchainImageAcquireInfo* /*info*/,
                               uint32_t* index) {
  auto& chain = *reinterpret_cast<Swapchain*>(swapchain);
  if (chain.acquired) {
    return XR_ERROR_CALL_ORDER_INVALID;
  }
  chain.acquired = true;
  *index = chain.next;
  return XR_SUCCESS;
}

XrResult WaitSwapchainImage(XrSwapchain swapchain, const XrSwapchainImageWaitInfo* /*info*/) {
  return reinterpret_cast<Swapchain*>(swapchain)->acquired ? XR_SUCCESS
                                                           : XR_ERROR_CALL_ORDER_INVALID;
}

XrResult ReleaseSwapchainImage(XrSwapchain swapchain, const XrSwapchainImageReleaseInfo* /*info*/) {
  auto& chain = *reinterpret_cast<Swapchain*>(swapchain);
  if (!chain.acquired) {
    return XR_ERROR_CALL_ORDER_INVALID;
  }
  chain.acquired = false;
  chain.next = (chain.next + 1) % kImages;
  return XR_SUCCESS;
}

XrResult StringToPath(XrInstance /*instance*/, const char* text, XrPath* path) {
  if (text[0] != '/') {
    return XR_ERROR_PATH_FORMAT_INVALID;
  }
  g_runtime->paths.emplace_back(text);
  *path = g_runtime->paths.size();
  return XR_SUCCESS;
}

bool IsActionName(const char* name) {
  const std::string_view text = name;
  return !text.empty() && text.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-_.") ==
                              std::string_view::npos;
}

XrResult CreateActionSet(XrInstance /*instance*/,
                         const XrActionSetCreateInfo* create,
                         XrActionSet* set) {
  if (!IsActionName(create->actionSetName) || create->localizedActionSetName[0] == 0) {
    return XR_ERROR_NAME_INVALID;
  }
  *set = reinterpret_cast<XrActionSet>(uintptr_t{6});
  return XR_SUCCESS;
}

XrResult CreateAction(XrActionSet /*set*/, const XrActionCreateInfo* create, XrAction* action) {
  if (g_runtime->attached) {
    return XR_ERROR_ACTIONSETS_ALREADY_ATTACHED;
  }
  if (!IsActionName(create->actionName) || create->localizedActionName[0] == 0) {
    return XR_ERROR_NAME_INVALID;
  }
  g_runtime->actions.emplace_back();
  *action = reinterpret_cast<XrAction>(g_runtime->actions.size());
  return XR_SUCCESS;
}

// Only simple controllers are supported.
XrResult SuggestBindings(XrInstance /*instance*/,
                         const XrInteractionProfileSuggestedBinding* suggested) {
  if (g_runtime->attached) {
    return XR_ERROR_ACTIONSETS_ALREADY_ATTACHED;
  }
  const auto text = [](XrPath path) { return g_runtime->paths.at(path - 1); };
  if (text(suggested->interactionProfile) != "/interaction_profiles/khr/simple_controller") {
    return XR_ERROR_PATH_UNSUPPORTED;
  }
  for (uint32_t i = 0; i < suggested->countSuggestedBindings; ++i) {
    const XrActionSuggestedBinding& binding = suggested->suggestedBindings[i];
    const std::string input = text(binding.binding);
    const std::string_view tail = std::string_view(input).substr(input.find("/input/") + 7);
    if (input.rfind("/user/hand/", 0) != 0 || (tail != "select/click" && tail != "menu/click")) {
      return XR_ERROR_PATH_UNSUPPORTED;
    }
    g_runtime->actions.at(reinterpret_cast<uintptr_t>(binding.action) - 1).push_back(input);
  }
  return XR_SUCCESS;
}

XrResult AttachActionSets(XrSession /*session*/, const XrSessionActionSetsAttachInfo* attach) {
  if (g_runtime->attached) {
    return XR_ERROR_ACTIONSETS_ALREADY_ATTACHED;
  }
  g_runtime->attached = attach->countActionSets == 1;
  return g_runtime->attached ? XR_SUCCESS : XR_ERROR_VALIDATION_FAILURE;
}

bool IsHeld(const std::vector<std::string>& inputs) {
  for (const auto& [path, frame] : g_runtime->presses) {
    for (const std::string& input : inputs) {
      if (input == path && g_runtime->frames >= frame && g_runtime->frames < frame + 3) {
        return true;
      }
    }
  }
  return false;
}

XrResult SyncActions(XrSession /*session*/, const XrActionsSyncInfo* sync) {
  if (!g_runtime->attached || sync->countActiveActionSets != 1) {
    return XR_ERROR_ACTIONSET_NOT_ATTACHED;
  }
  g_runtime->held.assign(g_runtime->actions.size(), false);
  if (!g_runtime->focused) {
    return XR_SESSION_NOT_FOCUSED;
  }
  for (size_t i = 0; i < g_runtime->actions.size(); ++i) {
    g_runtime->held[i] = IsHeld(g_runtime->actions[i]);
  }
  return XR_SUCCESS;
}

XrResult GetActionStateBoolean(XrSession /*session*/,
                               const XrActionStateGetInfo* get,
                               XrActionStateBoolean* state) {
  const size_t action = reinterpret_cast<uintptr_t>(get->action) - 1;
  if (action >= g_runtime->held.size()) {
    return XR_ERROR_HANDLE_INVALID;
  }
  state->isActive = g_runtime->focused && !g_runtime->actions[action].empty() ? XR_TRUE : XR_FALSE;
  state->currentState = state->isActive == XR_TRUE && g_runtime->held[action] ? XR_TRUE : XR_FALSE;
  return XR_SUCCESS;
}

XrResult PollEvent(XrInstance /*instance*/, XrEventDataBuffer* buffer) {
  if (g_runtime->events.empty()) {
    return XR_EVENT_UNAVAILABLE;
  }
  XrEventDataSessionStateChanged changed = {};
  changed.type = XR_TYPE_EVENT_DATA_SESSION_STATE_CHANGED;
  changed.session = kSession;
  changed.state = g_runtime->events.front();
  changed.time = Now();
  g_runtime->focused = changed.state == XR_SESSION_STATE_FOCUSED;
  g_runtime->events.pop_front();
  g_runtime->Write("state " + std::to_string(changed.state));
  std::memcpy(buffer, &changed, sizeof(changed));
  return XR_SUCCESS;
}

XrResult BeginSession(XrSession /*session*/, const XrSessionBeginInfo* begin) {
  if (g_runtime->running ||
      begin->primaryViewConfigurationType != XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO) {
    return XR_ERROR_VALIDATION_FAILURE;
  }
  g_runtime->running = true;
  g_runtime->events = {XR_SESSION_STATE_SYNCHRONIZED, XR_SESSION_STATE_VISIBLE};
  if (!g_runtime->aside) {
    g_runtime->events.push_back(XR_SESSION_STATE_FOCUSED);
  }
  g_runtime->Write("begin session");
  return XR_SUCCESS;
}

XrResult EndSession(XrSession /*session*/) {
  if (!g_runtime->running) {
    return XR_ERROR_SESSION_NOT_STOPPING;
  }
  g_runtime->running = false;
  g_runtime->events = {XR_SESSION_STATE_IDLE, XR_SESSION_STATE_EXITING};
  g_runtime->Write("end session");
  return XR_SUCCESS;
}

XrResult RequestExitSession(XrSession /*session*/) {
  g_runtime->Write("exit requested");
  g_runtime->events.push_back(XR_SESSION_STATE_STOPPING);
  return XR_SUCCESS;
}

XrResult WaitFrame(XrSession /*session*/, const XrFrameWaitInfo* /*info*/, XrFrameState* state) {
  if (!g_runtime->running || g_runtime->waited) {
    return XR_ERROR_CALL_ORDER_INVALID;
  }
  if (g_runtime->frames == g_runtime->lose_at) {
    g_runtime->Write("lost");
    return XR_ERROR_SESSION_LOST;
  }
  std::this_thread::sleep_for(std::chrono::nanoseconds(kPeriod));
  g_runtime->waited = true;
  state->predictedDisplayTime = Now() + 2 * kPeriod;
  state->predictedDisplayPeriod = kPeriod;
  state->shouldRender = XR_TRUE;
  return XR_SUCCESS;
}

XrResult BeginFrame(XrSession /*session*/, const XrFrameBeginInfo* /*info*/) {
  if (!g_runtime->waited || g_runtime->begun) {
    return XR_ERROR_CALL_ORDER_INVALID;
  }
  g_runtime->waited = false;
  g_runtime->begun = true;
  return XR_SUCCESS;
}

XrResult EndFrame(XrSession /*session*/, const XrFrameEndInfo* end) {
  if (!g_runtime->begun) {
    return XR_ERROR_CALL_ORDER_INVALID;
  }
  g_runtime->begun = false;
  const char blend = end->environmentBlendMode == XR_ENVIRONMENT_BLEND_MODE_OPAQUE        ? 'o'
                     : end->environmentBlendMode == XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND ? 'a'
                                                                                          : '+';
  if (g_runtime->blends.find(blend) == std::string::npos) {
    return XR_ERROR_ENVIRONMENT_BLEND_MODE_UNSUPPORTED;
  }
  g_runtime->Write("frame " + std::to_string(g_runtime->frames) + " layers " +
                   std::to_string(end->layerCount) + " blend " + blend);
  for (uint32_t i = 0; i < end->layerCount; ++i) {
    const XrCompositionLayerBaseHeader* layer = end->layers[i];
    if (layer->type == XR_TYPE_COMPOSITION_LAYER_QUAD) {
      g_runtime->Write(Describe(*reinterpret_cast<const XrCompositionLayerQuad*>(layer)));
    } else if (layer->type == XR_TYPE_COMPOSITION_LAYER_PROJECTION) {
      g_runtime->Write(Describe(*reinterpret_cast<const XrCompositionLayerProjection*>(layer)));
    } else if (layer->type == XR_TYPE_COMPOSITION_LAYER_PASSTHROUGH_FB &&
               reinterpret_cast<const XrCompositionLayerPassthroughFB*>(layer)->layerHandle ==
                   kPassthroughLayer) {
      g_runtime->Write("what is real");
    } else {
      return XR_ERROR_LAYER_INVALID;
    }
  }
  if (++g_runtime->frames == g_runtime->exit_at) {
    g_runtime->events.push_back(XR_SESSION_STATE_STOPPING);
  }
  return XR_SUCCESS;
}

XrResult ConvertTimespec(XrInstance /*instance*/, const timespec* time, XrTime* converted) {
  if (g_runtime->timeless_from >= 0 && g_runtime->frames >= g_runtime->timeless_from) {
    return XR_ERROR_TIME_INVALID;
  }
  *converted = time->tv_sec * 1'000'000'000LL + time->tv_nsec;
  return XR_SUCCESS;
}

XrResult GetInstanceProcAddr(XrInstance instance, const char* name, PFN_xrVoidFunction* function);

struct Entry {
  std::string_view name;
  PFN_xrVoidFunction function;
};
template <typename F>
PFN_xrVoidFunction Erased(F* function) {
  return reinterpret_cast<PFN_xrVoidFunction>(function);
}
const Entry kEntries[] = {
    {"xrEnumerateInstanceExtensionProperties", Erased(EnumerateInstanceExtensionProperties)},
    {"xrGetInstanceProcAddr", Erased(GetInstanceProcAddr)},
    {"xrCreateInstance", Erased(CreateInstance)},
    {"xrDestroyInstance", Erased(DestroyInstance)},
    {"xrGetInstanceProperties", Erased(GetInstanceProperties)},
    {"xrResultToString", Erased(ResultToString)},
    {"xrGetSystem", Erased(GetSystem)},
    {"xrGetSystemProperties", Erased(GetSystemProperties)},
    {"xrEnumerateEnvironmentBlendModes", Erased(EnumerateEnvironmentBlendModes)},
    {"xrCreatePassthroughFB", Erased(CreatePassthrough)},
    {"xrCreatePassthroughLayerFB", Erased(CreatePassthroughLayer)},
    {"xrGetOpenGLGraphicsRequirementsKHR", Erased(GetOpenGlRequirements)},
    {"xrCreateSession", Erased(CreateSession)},
    {"xrDestroySession", Erased(DestroySession)},
    {"xrCreateReferenceSpace", Erased(CreateReferenceSpace)},
    {"xrDestroySpace", Erased(DestroySpace)},
    {"xrLocateSpace", Erased(LocateSpace)},
    {"xrLocateViews", Erased(LocateViews)},
    {"xrEnumerateSwapchainFormats", Erased(EnumerateSwapchainFormats)},
    {"xrCreateSwapchain", Erased(CreateSwapchain)},
    {"xrDestroySwapchain", Erased(DestroySwapchain)},
    {"xrEnumerateSwapchainImages", Erased(EnumerateSwapchainImages)},
    {"xrAcquireSwapchainImage", Erased(AcquireSwapchainImage)},
    {"xrWaitSwapchainImage", Erased(WaitSwapchainImage)},
    {"xrReleaseSwapchainImage", Erased(ReleaseSwapchainImage)},
    {"xrStringToPath", Erased(StringToPath)},
    {"xrCreateActionSet", Erased(CreateActionSet)},
    {"xrCreateAction", Erased(CreateAction)},
    {"xrSuggestInteractionProfileBindings", Erased(SuggestBindings)},
    {"xrAttachSessionActionSets", Erased(AttachActionSets)},
    {"xrSyncActions", Erased(SyncActions)},
    {"xrGetActionStateBoolean", Erased(GetActionStateBoolean)},
    {"xrPollEvent", Erased(PollEvent)},
    {"xrBeginSession", Erased(BeginSession)},
    {"xrEndSession", Erased(EndSession)},
    {"xrRequestExitSession", Erased(RequestExitSession)},
    {"xrWaitFrame", Erased(WaitFrame)},
    {"xrBeginFrame", Erased(BeginFrame)},
    {"xrEndFrame", Erased(EndFrame)},
    {"xrConvertTimespecTimeToTimeKHR", Erased(ConvertTimespec)},
};

XrResult GetInstanceProcAddr(XrInstance /*instance*/,
                             const char* name,
                             PFN_xrVoidFunction* function) {
  *function = nullptr;
  for (const Entry& entry : kEntries) {
    if (entry.name == name) {
      *function = entry.function;
      return XR_SUCCESS;
    }
  }
  return XR_ERROR_FUNCTION_UNSUPPORTED;
}

}  // namespace

extern "C" __attribute__((visibility("default"))) XrResult xrNegotiateLoaderRuntimeInterface(
    const LoaderInfo* loader, RuntimeRequest* request) {
  if (loader == nullptr || request == nullptr || loader->type != 1 || request->type != 3 ||
      loader->min_interface > 1 || loader->max_interface < 1) {
    return XR_ERROR_INITIALIZATION_FAILED;
  }
  request->interface = 1;
  request->api = XR_CURRENT_API_VERSION;
  request->get = GetInstanceProcAddr;
  return XR_SUCCESS;
}
