#include "player/openxr/openxr_headset.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "player/openxr/openxr_buttons.h"
#include "player/openxr/openxr_calls.h"
#include "player/openxr/openxr_graphics.h"
#include "player/openxr/openxr_see_through.h"
#include "player/openxr/pose_history.h"
#include "shared/render/passes/picture_copy.h"

namespace lararium::player {
namespace {

using geometry::Rigid3;
using SteadyClock = std::chrono::steady_clock;

constexpr double kFarthestLayer = 1000.0;  // metres, cannot be distinguished from infinity
constexpr auto kLongestEnd = std::chrono::seconds(1);
constexpr auto kIdleStep = std::chrono::milliseconds(10);
const XrPosef kNowhere = {{0.0f, 0.0f, 0.0f, 1.0f}, {0.0f, 0.0f, 0.0f}};

// The runtime's images for one eye.
struct PictureImages {
  XrSwapchain swapchain = XR_NULL_HANDLE;
  std::vector<uint32_t> textures;
  int width = 0;
  int height = 0;
  bool filled = false;
  XrPosef pose = kNowhere;  // pose of the eye in the room for which the image was drawn
  XrFovf fov = {};          // field of view of that eye
};

class Session final : public OpenXrHeadset {
 public:
  Session(const Headset& headset, Log& log) : headset_(headset), log_(log) {}
  // The instance owns all other objects, also after the runtime was lost.
  ~Session() override {
    if (instance_ != XR_NULL_HANDLE) {
      xrDestroyInstance(instance_);
    }
  }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  Status Create(const std::string& title);

  std::string runtime() const override { return runtime_; }
  show::PictureEye PictureEyeOf(Eye eye) const override { return headset_.PictureEyeOf(eye); }
  Status SetPicture(Eye eye, const render::RenderTarget& picture) override;
  void Place(const geometry::CameraModel& pinhole, SteadyClock::time_point taken) override;
  std::optional<Rigid3> RoomFromCamera(SteadyClock::time_point taken) const override;
  std::optional<EyeView> ViewOf(Eye eye, int width, int height) override;
  Result<bool> Frame() override;
  std::vector<std::string> TakeButtons() override { return std::exchange(pressed_, {}); }
  Status End() override;

 private:
  Status CreateInstance(const std::string& title);
  Status FindSystem();
  Status CreateSession();
  Status ChooseFormat();
  Status CreateImages(PictureImages& images, int width, int height) const;
  Status Poll();
  Status ChangeState(XrSessionState state);
  Status SubmitFrame();
  Status LocateHead(XrTime shown);
  Result<bool> LocateEyes(XrSpace space, XrTime shown, std::array<XrView, 2>& views) const;
  Status LookAhead(const XrFrameState& frame);
  void AddQuad(Eye eye, std::vector<const XrCompositionLayerBaseHeader*>& layers);
  void AddEyes(std::vector<const XrCompositionLayerBaseHeader*>& layers);
  // nullopt: the runtime cannot convert the time.
  std::optional<XrTime> TimeOf(SteadyClock::time_point time) const;
  std::optional<Rigid3> RoomFromHead(SteadyClock::time_point time) const;
  Status Check(XrResult result, const char* what) const {
    return ToStatus(instance_, result, what);
  }

  Headset headset_;
  Log& log_;
  render::PictureCopy copy_;
  std::string runtime_;
  XrInstance instance_ = XR_NULL_HANDLE;
  XrSystemId system_ = XR_NULL_SYSTEM_ID;
  XrSession session_ = XR_NULL_HANDLE;
  XrSpace room_ = XR_NULL_HANDLE;
  XrSpace head_ = XR_NULL_HANDLE;
  PFN_xrConvertTimespecTimeToTimeKHR to_xr_time_ = nullptr;
  int64_t format_ = 0;
  bool running_ = false;
  bool exited_ = false;
  std::array<PictureImages, 2> images_;  // index: Eye
  PoseHistory heads_;                    // room_from_head
  bool placed_ = false;
  bool in_room_ = false;  // false: the layer is fixed to the head, whose pose is not known
  XrPosef layer_pose_ = kNowhere;
  XrExtent2Df layer_size_ = {1.0f, 1.0f};
  OpenXrSeeThrough see_through_;
  OpenXrButtons buttons_;
  std::vector<std::string> pressed_;
  std::optional<std::array<XrView, 2>> next_eyes_;  // predicted for the next frame, in the room
  std::array<EyeView, 2> drawn_for_;                // views of the pictures that are being drawn
  // Layers of the frame that is being submitted.
  std::array<XrCompositionLayerQuad, 2> quads_ = {};
  std::array<XrCompositionLayerProjectionView, 2> projected_ = {};
  XrCompositionLayerProjection projection_ = {};
};

Status Session::Create(const std::string& title) {
  LARARIUM_RETURN_IF_ERROR(CreateInstance(title));
  LARARIUM_RETURN_IF_ERROR(FindSystem());
  LARARIUM_RETURN_IF_ERROR(CreateSession());
  return ChooseFormat();
}

Status Session::CreateInstance(const std::string& title) {
  ::setenv("XR_LOADER_DEBUG", "none", 0);  // our own error message is enough
  std::vector<const char*> extensions = {XR_KHR_OPENGL_ENABLE_EXTENSION_NAME,
                                         XR_KHR_CONVERT_TIMESPEC_TIME_EXTENSION_NAME};
  if (headset_.runtime_shows_room) {
    const std::vector<const char*> more = OpenXrSeeThrough::Extensions();
    extensions.insert(extensions.end(), more.begin(), more.end());
  }
  auto create = Typed<XrInstanceCreateInfo>(XR_TYPE_INSTANCE_CREATE_INFO);
  std::snprintf(create.applicationInfo.applicationName,
                sizeof(create.applicationInfo.applicationName), "%s", title.c_str());
  std::snprintf(create.applicationInfo.engineName, sizeof(create.applicationInfo.engineName), "%s",
                "Lararium");
  create.applicationInfo.apiVersion = XR_CURRENT_API_VERSION;
  create.enabledExtensionCount = static_cast<uint32_t>(extensions.size());
  create.enabledExtensionNames = extensions.data();
  const XrResult result = xrCreateInstance(&create, &instance_);
  if (result == XR_ERROR_EXTENSION_NOT_PRESENT) {
    return Status::Error(kOpenXrPlace,
                         "the runtime lacks XR_KHR_opengl_enable or "
                         "XR_KHR_convert_timespec_time",
                         "use another runtime, such as Monado or SteamVR");
  }
  if (XR_FAILED(result)) {
    instance_ = XR_NULL_HANDLE;
    return Status::Error(kOpenXrPlace, "there is no usable runtime",
                         "install and start the headset's runtime (such as Monado or SteamVR); "
                         "XR_RUNTIME_JSON selects a runtime other than the system's");
  }
  auto properties = Typed<XrInstanceProperties>(XR_TYPE_INSTANCE_PROPERTIES);
  xrGetInstanceProperties(instance_, &properties);
  runtime_ = properties.runtimeName;
  log_.Info("OpenXR runtime {}", runtime_);
  return Status();
}

Status Session::FindSystem() {
  auto get = Typed<XrSystemGetInfo>(XR_TYPE_SYSTEM_GET_INFO);
  get.formFactor = XR_FORM_FACTOR_HEAD_MOUNTED_DISPLAY;
  const XrResult result = xrGetSystem(instance_, &get, &system_);
  if (result == XR_ERROR_FORM_FACTOR_UNAVAILABLE) {
    return Status::Error(kOpenXrPlace, "no headset is connected",
                         "connect it, and start its runtime");
  }
  LARARIUM_RETURN_IF_ERROR(Check(result, "finding the headset"));
  to_xr_time_ =
      FunctionOf<PFN_xrConvertTimespecTimeToTimeKHR>(instance_, "xrConvertTimespecTimeToTimeKHR");
  const auto requirements = FunctionOf<PFN_xrGetOpenGLGraphicsRequirementsKHR>(
      instance_, "xrGetOpenGLGraphicsRequirementsKHR");
  if (to_xr_time_ == nullptr || requirements == nullptr) {
    return Status::Error(kOpenXrPlace, "the runtime lacks a function of its own extensions",
                         "update the runtime");
  }
  // OpenXR demands this call before a session is created. Its result is not needed: all supported
  // drivers have the required version.
  auto asked = Typed<XrGraphicsRequirementsOpenGLKHR>(XR_TYPE_GRAPHICS_REQUIREMENTS_OPENGL_KHR);
  return Check(requirements(instance_, system_, &asked), "asking for what it needs of OpenGL");
}

Status Session::CreateSession() {
  const std::shared_ptr<const void> binding = CurrentGraphicsBinding();
  if (binding == nullptr) {
    return Status::Error(kOpenXrPlace, "the window has no OpenGL context of X11",
                         "start the player in an X11 session or with XWayland");
  }
  auto create = Typed<XrSessionCreateInfo>(XR_TYPE_SESSION_CREATE_INFO);
  create.next = binding.get();
  create.systemId = system_;
  LARARIUM_RETURN_IF_ERROR(Check(xrCreateSession(instance_, &create, &session_), "a session"));
  for (const auto& [type, space] : {std::pair(XR_REFERENCE_SPACE_TYPE_LOCAL, &room_),
                                    std::pair(XR_REFERENCE_SPACE_TYPE_VIEW, &head_)}) {
    auto reference = Typed<XrReferenceSpaceCreateInfo>(XR_TYPE_REFERENCE_SPACE_CREATE_INFO);
    reference.referenceSpaceType = type;
    reference.poseInReferenceSpace = kNowhere;
    LARARIUM_RETURN_IF_ERROR(
        Check(xrCreateReferenceSpace(session_, &reference, space), "a reference space"));
  }
  LARARIUM_RETURN_IF_ERROR(buttons_.Begin(instance_, session_));
  return headset_.runtime_shows_room ? see_through_.Begin(instance_, system_, session_, log_)
                                     : Status();
}

Status Session::ChooseFormat() {
  uint32_t count = 0;
  LARARIUM_RETURN_IF_ERROR(
      Check(xrEnumerateSwapchainFormats(session_, 0, &count, nullptr), "asking for formats"));
  std::vector<int64_t> formats(count);
  LARARIUM_RETURN_IF_ERROR(Check(
      xrEnumerateSwapchainFormats(session_, count, &count, formats.data()), "asking for formats"));
  for (const int64_t wanted :
       {render::PictureCopy::kEncodedFormat, render::PictureCopy::kPlainFormat}) {
    if (std::find(formats.begin(), formats.end(), wanted) != formats.end()) {
      format_ = wanted;
      return Status();
    }
  }
  return Status::Error(kOpenXrPlace, "the runtime does not accept pictures with 8 bits per colour",
                       "update the runtime");
}

Status Session::CreateImages(PictureImages& images, int width, int height) const {
  if (images.swapchain != XR_NULL_HANDLE) {
    xrDestroySwapchain(images.swapchain);
  }
  images = {};
  auto create = Typed<XrSwapchainCreateInfo>(XR_TYPE_SWAPCHAIN_CREATE_INFO);
  create.usageFlags = XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT | XR_SWAPCHAIN_USAGE_TRANSFER_DST_BIT;
  create.format = format_;
  create.sampleCount = create.faceCount = create.arraySize = create.mipCount = 1;
  create.width = static_cast<uint32_t>(width);
  create.height = static_cast<uint32_t>(height);
  LARARIUM_RETURN_IF_ERROR(
      Check(xrCreateSwapchain(session_, &create, &images.swapchain), "making images"));
  uint32_t count = 0;
  LARARIUM_RETURN_IF_ERROR(
      Check(xrEnumerateSwapchainImages(images.swapchain, 0, &count, nullptr), "asking for images"));
  std::vector<XrSwapchainImageOpenGLKHR> list(
      count, Typed<XrSwapchainImageOpenGLKHR>(XR_TYPE_SWAPCHAIN_IMAGE_OPENGL_KHR));
  LARARIUM_RETURN_IF_ERROR(
      Check(xrEnumerateSwapchainImages(images.swapchain, count, &count,
                                       reinterpret_cast<XrSwapchainImageBaseHeader*>(list.data())),
            "asking for images"));
  for (const XrSwapchainImageOpenGLKHR& image : list) {
    images.textures.push_back(image.image);
  }
  images.width = width;
  images.height = height;
  return Status();
}

Status Session::SetPicture(Eye eye, const render::RenderTarget& picture) {
  if (!running_) {
    return Status();
  }
  PictureImages& images = images_[eye];
  if (images.width != picture.width() || images.height != picture.height()) {
    LARARIUM_RETURN_IF_ERROR(CreateImages(images, picture.width(), picture.height()));
  }
  uint32_t index = 0;
  LARARIUM_RETURN_IF_ERROR(
      Check(xrAcquireSwapchainImage(images.swapchain, nullptr, &index), "taking an image"));
  auto wait = Typed<XrSwapchainImageWaitInfo>(XR_TYPE_SWAPCHAIN_IMAGE_WAIT_INFO);
  wait.timeout = XR_INFINITE_DURATION;
  LARARIUM_RETURN_IF_ERROR(
      Check(xrWaitSwapchainImage(images.swapchain, &wait), "waiting for an image"));
  copy_.Into(images.textures[std::min<size_t>(index, images.textures.size() - 1)], picture);
  images.filled = true;
  const geometry::CameraModel& camera = drawn_for_[eye].camera;
  const auto across = static_cast<float>(std::atan2(0.5 * camera.width, camera.fx));
  const auto along = static_cast<float>(std::atan2(0.5 * camera.height, camera.fy));
  images.pose = ToXr(drawn_for_[eye].room_from_eye);
  images.fov = {-across, across, along, -along};
  return Check(xrReleaseSwapchainImage(images.swapchain, nullptr), "handing over an image");
}

std::optional<XrTime> Session::TimeOf(SteadyClock::time_point time) const {
  const auto since = std::chrono::duration_cast<std::chrono::nanoseconds>(time.time_since_epoch());
  const timespec monotonic = {since.count() / 1'000'000'000, since.count() % 1'000'000'000};
  XrTime converted = 0;
  return XR_SUCCEEDED(to_xr_time_(instance_, &monotonic, &converted)) ? std::optional(converted)
                                                                      : std::nullopt;
}

std::optional<Rigid3> Session::RoomFromHead(SteadyClock::time_point time) const {
  const std::optional<XrTime> xr_time = TimeOf(time);
  return xr_time ? heads_.At(*xr_time) : std::nullopt;
}

void Session::Place(const geometry::CameraModel& pinhole, SteadyClock::time_point taken) {
  const double distance = std::min(headset_.picture_distance, kFarthestLayer);
  const double across = distance / pinhole.fx;
  const double along = distance / pinhole.fy;
  layer_size_ = {static_cast<float>(across * pinhole.width),
                 static_cast<float>(along * pinhole.height)};
  const Rigid3 camera_from_layer{
      .translation = Eigen::Vector3d(across * (0.5 * (pinhole.width - 1) - pinhole.cx),
                                     along * (0.5 * (pinhole.height - 1) - pinhole.cy), distance)};
  const Rigid3 head_from_layer = headset_.head_from_camera * camera_from_layer;
  const std::optional<Rigid3> room_from_head = RoomFromHead(taken);
  in_room_ = room_from_head.has_value();
  layer_pose_ = ToXr(in_room_ ? *room_from_head * head_from_layer : head_from_layer);
  placed_ = true;
}

std::optional<Rigid3> Session::RoomFromCamera(SteadyClock::time_point taken) const {
  const std::optional<Rigid3> room_from_head = RoomFromHead(taken);
  return room_from_head ? std::optional(*room_from_head * headset_.head_from_camera) : std::nullopt;
}

// The view is symmetric and the same for both eyes, so that something drawn at the middle of both
// pictures appears as one object far away. Pixels are square.
std::optional<EyeView> Session::ViewOf(Eye eye, int width, int height) {
  if (!next_eyes_) {
    return std::nullopt;
  }
  double slope = 0.0;  // size of a pixel on the plane one metre in front of the eye
  for (const XrView& view : *next_eyes_) {
    const double across = std::max(std::tan(-view.fov.angleLeft), std::tan(view.fov.angleRight));
    const double along = std::max(std::tan(view.fov.angleUp), std::tan(-view.fov.angleDown));
    slope = std::max({slope, 2.0 * across / width, 2.0 * along / height});
  }
  EyeView& view = drawn_for_[eye];
  view.camera = {width, height, 1.0 / slope, 1.0 / slope, 0.5 * (width - 1), 0.5 * (height - 1)};
  view.room_from_eye = FromXr((*next_eyes_)[eye].pose);
  return view;
}

Status Session::ChangeState(XrSessionState state) {
  switch (state) {
    case XR_SESSION_STATE_READY: {
      auto begin = Typed<XrSessionBeginInfo>(XR_TYPE_SESSION_BEGIN_INFO);
      begin.primaryViewConfigurationType = kEyesOfHead;
      running_ = true;
      return Check(xrBeginSession(session_, &begin), "beginning the session");
    }
    case XR_SESSION_STATE_STOPPING:
      running_ = false;
      return Check(xrEndSession(session_), "ending the session");
    case XR_SESSION_STATE_EXITING:
      exited_ = true;
      return Status();
    case XR_SESSION_STATE_LOSS_PENDING:
      return Check(XR_SESSION_LOSS_PENDING, "");
    default:
      return Status();
  }
}

Status Session::Poll() {
  while (true) {
    auto event = Typed<XrEventDataBuffer>(XR_TYPE_EVENT_DATA_BUFFER);
    const XrResult result = xrPollEvent(instance_, &event);
    LARARIUM_RETURN_IF_ERROR(Check(result, "asking for events"));
    if (result == XR_EVENT_UNAVAILABLE) {
      return Status();
    }
    if (event.type == XR_TYPE_EVENT_DATA_INSTANCE_LOSS_PENDING) {
      return Check(XR_ERROR_INSTANCE_LOST, "");
    }
    if (event.type == XR_TYPE_EVENT_DATA_SESSION_STATE_CHANGED) {
      XrEventDataSessionStateChanged changed = {};
      std::memcpy(&changed, &event, sizeof(changed));
      LARARIUM_RETURN_IF_ERROR(ChangeState(changed.state));
    }
  }
}

// Stores the current pose of the head, and the poses of the eyes in it.
Status Session::LocateHead(XrTime shown) {
  const std::optional<XrTime> now = TimeOf(SteadyClock::now());
  auto location = Typed<XrSpaceLocation>(XR_TYPE_SPACE_LOCATION);
  if (now) {
    LARARIUM_RETURN_IF_ERROR(
        Check(xrLocateSpace(head_, room_, *now, &location), "locating the head"));
  }
  if (now && (location.locationFlags & XR_SPACE_LOCATION_ORIENTATION_VALID_BIT) != 0) {
    Rigid3 room_from_head = FromXr(location.pose);
    if ((location.locationFlags & XR_SPACE_LOCATION_POSITION_VALID_BIT) == 0) {
      room_from_head.translation.setZero();  // the headset tracks only its rotation
    }
    heads_.Add(*now, room_from_head);
  }
  std::array<XrView, 2> views;
  LARARIUM_RETURN_IF_ERROR(LocateEyes(head_, shown, views).status());
  for (const Eye eye : {kLeft, kRight}) {
    headset_.head_from_eye[eye] = FromXr(views[eye].pose);
  }
  return Status();
}

// Locates the eyes. Returns false if their poses are not known.
Result<bool> Session::LocateEyes(XrSpace space, XrTime shown, std::array<XrView, 2>& views) const {
  auto locate = Typed<XrViewLocateInfo>(XR_TYPE_VIEW_LOCATE_INFO);
  locate.viewConfigurationType = kEyesOfHead;
  locate.displayTime = shown;
  locate.space = space;
  auto state = Typed<XrViewState>(XR_TYPE_VIEW_STATE);
  views.fill(Typed<XrView>(XR_TYPE_VIEW));
  uint32_t count = 0;
  LARARIUM_RETURN_IF_ERROR(
      Check(xrLocateViews(session_, &locate, &state, 2, &count, views.data()), "locating eyes"));
  constexpr XrViewStateFlags kKnown =
      XR_VIEW_STATE_ORIENTATION_VALID_BIT | XR_VIEW_STATE_POSITION_VALID_BIT;
  return (state.viewStateFlags & kKnown) == kKnown;
}

// Predicts the poses of the eyes at the time when the next picture is shown.
Status Session::LookAhead(const XrFrameState& frame) {
  std::array<XrView, 2> views;
  const XrTime next = frame.predictedDisplayTime + frame.predictedDisplayPeriod;
  LARARIUM_ASSIGN_OR_RETURN(const bool known, LocateEyes(room_, next, views));
  next_eyes_ = known ? std::optional(views) : std::nullopt;
  return Status();
}

void Session::AddQuad(Eye eye, std::vector<const XrCompositionLayerBaseHeader*>& layers) {
  const PictureImages& images = images_[eye];
  if (!placed_ || !images.filled) {
    return;
  }
  XrCompositionLayerQuad& quad = quads_[eye];
  quad = Typed<XrCompositionLayerQuad>(XR_TYPE_COMPOSITION_LAYER_QUAD);
  quad.space = in_room_ ? room_ : head_;
  quad.eyeVisibility = !headset_.stereo ? XR_EYE_VISIBILITY_BOTH
                       : eye == kLeft   ? XR_EYE_VISIBILITY_LEFT
                                        : XR_EYE_VISIBILITY_RIGHT;
  quad.subImage.swapchain = images.swapchain;
  quad.subImage.imageRect = {{0, 0}, {images.width, images.height}};
  quad.pose = layer_pose_;
  quad.size = layer_size_;
  layers.push_back(reinterpret_cast<const XrCompositionLayerBaseHeader*>(&quad));
}

// Adds the runtime's own layer of the room, and over it people as drawn for each eye.
void Session::AddEyes(std::vector<const XrCompositionLayerBaseHeader*>& layers) {
  if (see_through_.layer() != nullptr) {
    layers.push_back(see_through_.layer());
  }
  if (!images_[kLeft].filled || !images_[kRight].filled) {
    return;
  }
  for (const Eye eye : {kLeft, kRight}) {
    XrCompositionLayerProjectionView& view = projected_[eye];
    view = Typed<XrCompositionLayerProjectionView>(XR_TYPE_COMPOSITION_LAYER_PROJECTION_VIEW);
    view.pose = images_[eye].pose;
    view.fov = images_[eye].fov;
    view.subImage.swapchain = images_[eye].swapchain;
    view.subImage.imageRect = {{0, 0}, {images_[eye].width, images_[eye].height}};
  }
  projection_ = Typed<XrCompositionLayerProjection>(XR_TYPE_COMPOSITION_LAYER_PROJECTION);
  projection_.layerFlags = XR_COMPOSITION_LAYER_BLEND_TEXTURE_SOURCE_ALPHA_BIT;
  projection_.space = room_;
  projection_.viewCount = static_cast<uint32_t>(projected_.size());
  projection_.views = projected_.data();
  layers.push_back(reinterpret_cast<const XrCompositionLayerBaseHeader*>(&projection_));
}

Status Session::SubmitFrame() {
  auto wait = Typed<XrFrameWaitInfo>(XR_TYPE_FRAME_WAIT_INFO);
  auto frame = Typed<XrFrameState>(XR_TYPE_FRAME_STATE);
  LARARIUM_RETURN_IF_ERROR(Check(xrWaitFrame(session_, &wait, &frame), "waiting for a frame"));
  auto begin = Typed<XrFrameBeginInfo>(XR_TYPE_FRAME_BEGIN_INFO);
  LARARIUM_RETURN_IF_ERROR(Check(xrBeginFrame(session_, &begin), "beginning a frame"));
  LARARIUM_RETURN_IF_ERROR(LocateHead(frame.predictedDisplayTime));
  std::vector<const XrCompositionLayerBaseHeader*> layers;
  if (frame.shouldRender == XR_TRUE && headset_.runtime_shows_room) {
    AddEyes(layers);
  } else if (frame.shouldRender == XR_TRUE) {
    AddQuad(kLeft, layers);
    AddQuad(kRight, layers);
  }
  auto end = Typed<XrFrameEndInfo>(XR_TYPE_FRAME_END_INFO);
  end.displayTime = frame.predictedDisplayTime;
  end.environmentBlendMode = see_through_.blend_mode();
  end.layerCount = static_cast<uint32_t>(layers.size());
  end.layers = layers.data();
  LARARIUM_RETURN_IF_ERROR(Check(xrEndFrame(session_, &end), "handing over a frame"));
  return headset_.runtime_shows_room ? LookAhead(frame) : Status();
}

Result<bool> Session::Frame() {
  LARARIUM_RETURN_IF_ERROR(Poll());
  if (exited_) {
    return false;
  }
  if (running_) {
    LARARIUM_RETURN_IF_ERROR(buttons_.Take(pressed_));
    LARARIUM_RETURN_IF_ERROR(SubmitFrame());
  } else {
    std::this_thread::sleep_for(kIdleStep);
  }
  return true;
}

Status Session::End() {
  if (!running_) {
    return Status();
  }
  LARARIUM_RETURN_IF_ERROR(Check(xrRequestExitSession(session_), "asking for the end"));
  const SteadyClock::time_point begin = SteadyClock::now();
  while (SteadyClock::now() - begin < kLongestEnd) {
    LARARIUM_ASSIGN_OR_RETURN(const bool more, Frame());
    if (!more) {
      return Status();
    }
  }
  log_.Warn("{}: the runtime did not end the session in time", kOpenXrPlace);
  return Status();
}

}  // namespace

Result<std::unique_ptr<OpenXrHeadset>> OpenXrHeadset::Open(const Headset& headset,
                                                           const std::string& title,
                                                           Log& log) {
  auto session = std::make_unique<Session>(headset, log);
  LARARIUM_RETURN_IF_ERROR(session->Create(title));
  return std::unique_ptr<OpenXrHeadset>(std::move(session));
}

}  // namespace lararium::player
