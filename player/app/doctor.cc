#include "player/app/doctor.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <opencv2/core.hpp>
#include <system_error>
#include <utility>

#include "player/app/camera_choice.h"
#include "player/fleet/fleet_client.h"
#include "player/kiosk/kiosk.h"
#include "player/kiosk/power_sensors.h"
#include "player/kiosk/web_address.h"
#include "player/openxr/openxr_headset.h"
#include "player/staff/staff_page.h"
#include "shared/audio/audio_out.h"
#include "shared/bundle/bundle.h"
#include "shared/capture/frame_source.h"
#include "shared/core/free_space.h"
#include "shared/core/json.h"
#include "shared/render/gl/graphics_context.h"
#include "shared/render/gl/window.h"
#include "shared/show/show.h"
#include "shared/vision/tracker.h"

namespace lararium::player {
namespace {

constexpr int kProbeImages = 45;
constexpr double kProbeSeconds = 4.0;
constexpr double kSlowest = 20.0;  // images per second; people move smoothly at this rate
constexpr double kDark = 12.0;     // grey value, 0..255
constexpr double kFrozen = 0.01;
constexpr uint64_t kLeastFree = uint64_t{64} << 20;
constexpr double kHot = 80.0;
constexpr double kUsualRate = 30.0;  // images per second of a usual camera
constexpr double kNearlyAll = 0.95;

std::string Text(const char* format, double value) {
  char text[128];
  std::snprintf(text, sizeof(text), format, value);
  return text;
}

int CountCameras() {
  int count = 0;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator("/dev", ignored)) {
    count += entry.path().filename().string().rfind("video", 0) == 0 ? 1 : 0;
  }
  return count;
}

Status Images(capture::FrameSource& source, vision::PoseSource* poses, CameraProbe& probe) {
  cv::Mat before;
  const auto begin = std::chrono::steady_clock::now();
  while (probe.images < kProbeImages && probe.seconds < kProbeSeconds) {
    LARARIUM_ASSIGN_OR_RETURN(const std::optional<geometry::Frame> frame, source.Next());
    if (!frame) {
      break;
    }
    ++probe.images;
    probe.brightness += cv::mean(frame->grey)[0];
    if (!before.empty()) {
      cv::Mat difference;
      cv::absdiff(before, frame->grey, difference);
      probe.change += cv::mean(difference)[0];
    }
    before = frame->grey.clone();
    if (poses != nullptr) {
      probe.tracked = probe.tracked.value_or(0) + (poses->Track(*frame).camera_from_map ? 1 : 0);
    }
    probe.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  }
  probe.brightness /= std::max(probe.images, 1);
  probe.change /= std::max(probe.images - 1, 1);
  return Status();
}

Result<std::unique_ptr<vision::PoseSource>> TrackerOf(const CameraOptions& camera,
                                                      const show::ShowContent& content,
                                                      const CameraProbe& probe) {
  std::vector<TrainedCamera> trained;
  for (const show::ShowPlace& place : content.places) {
    trained.push_back({place.stage.name, place.map->camera});
  }
  LARARIUM_ASSIGN_OR_RETURN(const CameraChoice choice,
                            ChooseCamera(camera, trained, probe.width, probe.height));
  return vision::CreateTracker(show::Maps(content.places), choice.camera,
                               {.known_camera = choice.known});
}

CameraProbe ProbeCamera(const DoctorOptions& options,
                        const Device& device,
                        const show::ShowContent* content) {
  CameraProbe probe;
  probe.devices = CountCameras();
  CameraOptions camera;
  camera.device = options.device;
  Result<std::unique_ptr<capture::FrameSource>> source =
      capture::OpenCamera(options.camera, device.capture);
  if (!source.ok()) {
    probe.problem = source.status();
    return probe;
  }
  probe.width = (*source)->width();
  probe.height = (*source)->height();
  std::unique_ptr<vision::PoseSource> poses;
  if (content != nullptr) {
    auto tracker = TrackerOf(camera, *content, probe);
    if (tracker.ok()) {
      poses = std::move(*tracker);
    } else {
      probe.calibration_problem = tracker.message();
    }
  }
  probe.problem = Images(**source, poses.get(), probe);
  return probe;
}

// Describes the device and the API of the current context.
std::string DescribeGraphics() {
  return render::GraphicsDeviceName() + " with " +
         std::string(render::Name(render::CurrentGraphicsApi()));
}

Result<std::string> OpenGraphics(render::GraphicsChoice graphics) {
  LARARIUM_ASSIGN_OR_RETURN(const render::OffscreenContext context,
                            render::CreateOffscreenContext(graphics));
  return DescribeGraphics();
}

Result<DisplayProbe> OpenDisplay(const DoctorOptions& options) {
  render::WindowOptions wanted;
  wanted.visible = false;
  wanted.graphics = options.graphics;
  if (options.monitor >= 0) {
    wanted.monitor = options.monitor;
  }
  LARARIUM_ASSIGN_OR_RETURN(const render::Window window, render::Window::Create(wanted));
  const render::Window::Size size = window.framebuffer_size();
  return DisplayProbe{{size.width, size.height}, DescribeGraphics()};
}

// Opens a session in the same way as the player.
Result<std::string> OpenRuntime(const Headset& headset, Log& log) {
  render::WindowOptions hidden;
  hidden.visible = false;
  LARARIUM_ASSIGN_OR_RETURN(const render::Window window, render::Window::Create(hidden));
  LARARIUM_ASSIGN_OR_RETURN(const std::unique_ptr<OpenXrHeadset> opened,
                            OpenXrHeadset::Open(headset, "Lararium", log));
  return opened->runtime();
}

Result<std::string> OpenSoundDevice() {
  LARARIUM_ASSIGN_OR_RETURN(const std::unique_ptr<audio::AudioOut> out,
                            audio::CreateAudioOut(audio::AudioOutKind::kDevice));
  return out->name();
}

Result<show::ShowContent> OpenShow(const DoctorOptions& options) {
  bundle::OpenOptions opening;
  if (!options.trust.empty()) {
    LARARIUM_ASSIGN_OR_RETURN(opening.trusted, bundle::LoadPublicKey(options.trust));
  }
  LARARIUM_ASSIGN_OR_RETURN(const bundle::Bundle bundle,
                            bundle::Bundle::Open(options.show, opening));
  return show::LoadShowContent(bundle);
}

std::string SizeText(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

// The horizontal and vertical angle of a part of the plane z = 1.
std::string AngleText(const Eigen::AlignedBox2d& box) {
  const auto degrees = [](double from, double to) {
    return Text("%.0f", (std::atan(to) - std::atan(from)) * 180.0 / std::numbers::pi);
  };
  return degrees(box.min().x(), box.max().x()) + " x " + degrees(box.min().y(), box.max().y()) +
         " degrees";
}

// Checks the show, and whether its drama starts.
std::vector<Finding> JudgeShow(const Result<show::ShowContent>& content, bool trusted, Log& log) {
  if (!content.ok()) {
    return {{"bundle", Verdict::kBad, content.message(), "copy the show to this machine again"}};
  }
  std::vector<Finding> findings = {
      {"bundle", trusted ? Verdict::kGood : Verdict::kWarning,
       "\"" + content->title + "\", undamaged" +
           (trusted ? " and signed with the trusted key" : ""),
       trusted ? "" : "play with --trust KEY.pub, so that no other show can be slipped in"}};
  for (const show::ShowPlace& place : content->places) {
    const size_t points = place.map->points.size();
    const bool images = std::any_of(place.map->keyframes.begin(), place.map->keyframes.end(),
                                    [](const auto& keyframe) { return !keyframe.grey.empty(); });
    findings.push_back(
        {"map", images ? Verdict::kGood : Verdict::kWarning,
         "place " + place.stage.name + ": " + std::to_string(points) + " points, " +
             std::to_string(place.map->keyframes.size()) + " keyframes",
         images ? "" : "export with images of keyframes: visitors are guided by them"});
  }
  const auto show = show::Show::Create(*content, {}, log);
  if (!show.ok()) {
    findings.push_back({"drama", Verdict::kBad, show.message(), "ask the author of the show"});
  } else if (!(*show)->drama().errors().empty()) {
    findings.push_back({"drama", Verdict::kWarning, (*show)->drama().errors().front().message,
                        "ask the author of the show; it plays without this part"});
  }
  return findings;
}

Finding LookAtDisk(std::filesystem::path folder) {
  if (folder.empty()) {
    folder = DefaultStateFolder();
  }
  const Status written = SaveKioskState(folder / "doctor", {});
  const std::optional<uint64_t> space = FreeSpaceOf(folder);
  std::error_code ignored;
  std::filesystem::remove_all(folder / "doctor", ignored);
  return JudgeDisk(written, space.value_or(0), folder.string());
}

Finding LookAtStaffPage(const DoctorOptions& options) {
  const Result<ListenAddress> address = ParseListenAddress("--staff-page", options.staff_page);
  if (!address.ok()) {
    return JudgeStaffPage(address.status(), {}, {});
  }
  const Result<int> port = ListenForPage("staff page", "--staff-page", *address);
  if (port.ok()) {
    ::close(*port);
  }
  const Status pin =
      options.staff_pin.empty() ? Status() : StaffPin::Load(options.staff_pin).status();
  return JudgeStaffPage(port.status(), pin, PageUrls("http", *address));
}

Finding LookAtFleet(FleetOptions fleet) {
  NameDevice(fleet);
  const Status valid = fleet.Validate();
  return JudgeFleet(valid.ok() ? TryFleet(fleet) : valid, fleet);
}

}  // namespace

Finding JudgeCamera(const CameraProbe& probe) {
  const auto bad = [](std::string found, std::string advice) {
    return Finding{"camera", Verdict::kBad, std::move(found), std::move(advice)};
  };
  if (probe.devices == 0) {
    return bad("none is connected",
               "plug it in; then \"ls /dev/video*\" must list it. Try another cable or socket");
  }
  if (!probe.problem.ok()) {
    return bad(probe.problem.message(),
               "close other programs that use it, and let the user be in the group \"video\"");
  }
  if (probe.images == 0) {
    return bad("gives no images", "unplug it, wait a little, plug it in again");
  }
  const double rate = probe.images / std::max(probe.seconds, 1e-3);
  const std::string found =
      SizeText(probe.width, probe.height) + ", " + Text("%.1f images a second", rate);
  if (probe.brightness < kDark) {
    return bad(found + ", all dark", "take off the lens cap, or turn on the light");
  }
  if (probe.calibration_problem) {
    return bad(found + "; " + *probe.calibration_problem,
               "give the size that it was calibrated for in the device file's \"capture\"");
  }
  if (probe.change < kFrozen) {
    return {"camera", Verdict::kWarning, found + ", which do not change",
            "move it; if that changes nothing, unplug it and plug it in again"};
  }
  if (probe.tracked == 0) {
    return {"camera", Verdict::kWarning, found + "; the place was not found in them",
            "point it at the place of the show, in the light that it was filmed in"};
  }
  if (rate < kSlowest) {
    return {"camera", Verdict::kWarning, found,
            "more light lets it expose for less long; or set \"format\" MJPG and "
            "\"frames_per_second\" in the device file's \"capture\""};
  }
  const std::string tracked = probe.tracked
                                  ? "; the place was found in " + std::to_string(*probe.tracked) +
                                        " of " + std::to_string(probe.images)
                                  : "";
  return {"camera", Verdict::kGood, found + tracked};
}

Finding JudgeHeadset(const Headset& headset,
                     const std::optional<geometry::CameraModel>& camera,
                     const std::optional<PictureSize>& monitor) {
  const double apart =
      (headset.head_from_eye[kRight].translation - headset.head_from_eye[kLeft].translation).norm();
  std::string found = Text("eyes %.0f mm apart, ", 1000.0 * apart);
  found += headset.stereo ? "a picture for each" : "one picture for both";
  found += std::isinf(headset.picture_distance) ? " at infinity"
                                                : Text(", %.1f m away", headset.picture_distance);
  if (!headset.panel) {
    return {"headset", Verdict::kGood, found + ", without a panel"};
  }
  const Panel& panel = *headset.panel;
  found = "panel " + SizeText(panel.width(), panel.height()) + ", each eye sees " +
          AngleText(panel.lenses[kLeft].SeenBox()) + ", " + found;
  if (camera) {
    const geometry::CameraModel pinhole = camera->DisplayPinhole();
    const Eigen::AlignedBox2d box(
        pinhole.PlaneFromPixel({-0.5, -0.5}),
        pinhole.PlaneFromPixel({pinhole.width - 0.5, pinhole.height - 0.5}));
    found += "; the camera sees " + AngleText(box);
  }
  if (monitor && (monitor->width != panel.width() || monitor->height != panel.height())) {
    return {"headset", Verdict::kWarning,
            found + "; the monitor has " + SizeText(monitor->width, monitor->height),
            "set the monitor to the panel's own size, or choose another with --monitor: scaled, "
            "the picture does not fit the lenses"};
  }
  return {"headset", Verdict::kGood, found};
}

Finding JudgeRuntime(const Result<std::string>& runtime) {
  if (!runtime.ok()) {
    return {"openxr", Verdict::kBad, runtime.message(), "the player will not start with it"};
  }
  return {"openxr", Verdict::kGood, "a headset, driven by " + *runtime};
}

Finding JudgeGraphics(const Result<std::string>& device) {
  if (!device.ok()) {
    return {"graphics", Verdict::kBad, device.message(),
            "install the driver of the graphics card, or libgl1-mesa-dri"};
  }
  const bool software = render::DrawsOnProcessor(*device);
  return {"graphics", software ? Verdict::kWarning : Verdict::kGood, *device,
          software ? "this draws on the processor: with a graphics card's driver people are finer"
                   : ""};
}

Finding JudgeDrawing(const DrawingProbe& probe, double wanted) {
  if (!probe.problem.ok()) {
    return {"drawing", Verdict::kBad, probe.problem.message(),
            "install the driver of the graphics card, or ask the author of the show"};
  }
  // A rate slightly below the wanted one is good enough: a rare late picture is not noticed.
  const auto fast = std::ranges::find_if(
      probe.rates, [wanted](double rate) { return rate >= kNearlyAll * wanted; });
  const bool any = fast != probe.rates.end();
  const size_t level =
      any ? static_cast<size_t>(fast - probe.rates.begin()) : probe.rates.size() - 1;
  const std::string found = Text("%.0f pictures a second, ", probe.rates[level]) +
                            SizeText(probe.size.width, probe.size.height) + ", at level " +
                            std::to_string(level) + " of quality (0 the finest, " +
                            std::to_string(probe.rates.size() - 1) + " the coarsest)";
  if (any) {
    return {"drawing", Verdict::kGood, found};
  }
  return {"drawing", Verdict::kWarning, found + Text("; the camera gives %.0f images", wanted),
          "play with a smaller --size, or on a machine with a graphics card"};
}

Finding JudgeDisplay(const Result<DisplayProbe>& window, bool wanted) {
  if (window.ok()) {
    return {"display", Verdict::kGood,
            SizeText(window->size.width, window->size.height) + ", drawn by " + window->device};
  }
  return {"display", wanted ? Verdict::kBad : Verdict::kWarning, window.message(),
          "log in to the desktop, connect the headset or monitor, and choose it with --monitor"};
}

Finding JudgeSound(const Result<std::string>& out) {
  if (out.ok()) {
    return {"sound", Verdict::kGood, *out};
  }
  return {"sound", Verdict::kWarning, out.message(),
          "connect headphones and let the user be in the group \"audio\"; without it the show is "
          "silent"};
}

Finding JudgeDisk(const Status& written, uint64_t free_bytes, const std::string& folder) {
  if (!written.ok()) {
    return {
        "disk", Verdict::kWarning, written.message(),
        "give a writable folder with --state; without it a show starts from the beginning after "
        "a failure"};
  }
  const std::string found =
      folder + ": " + Text("%.0f MiB free", static_cast<double>(free_bytes) / (1 << 20));
  if (free_bytes < kLeastFree) {
    return {"disk", Verdict::kWarning, found, "make room"};
  }
  return {"disk", Verdict::kGood, found};
}

Finding JudgePower(const show::PowerState& power) {
  std::string found = power.celsius ? Text("%.0f degrees", *power.celsius) : "no thermometer";
  found += power.battery ? Text(", battery %.0f %%", 100.0 * *power.battery) : ", on mains";
  if (power.celsius && *power.celsius >= kHot) {
    return {"power", Verdict::kWarning, found, "let it cool and clean its fan: quality is reduced"};
  }
  if (power.battery && *power.battery < show::QualityOptions().low_battery) {
    return {"power", Verdict::kWarning, found, "charge it: quality is reduced"};
  }
  return {"power", Verdict::kGood, found};
}

Finding JudgeStaffPage(const Status& port,
                       const Status& pin,
                       const std::vector<std::string>& urls) {
  for (const Status& status : {port, pin}) {
    if (!status.ok()) {
      return {"staff", Verdict::kBad, status.message(), "the player will not start with it"};
    }
  }
  std::string found;
  for (const std::string& url : urls) {
    found += (found.empty() ? "" : ", ") + url;
  }
  return {"staff", Verdict::kGood, found};
}

Finding JudgeFleet(const Status& connected, const FleetOptions& fleet) {
  if (!connected.ok()) {
    return {"fleet", Verdict::kBad, connected.message(),
            "docs/how-to-run-a-fleet.md has what to do; the show plays without it"};
  }
  return {"fleet", Verdict::kGood, fleet.address + " knows \"" + fleet.name + "\""};
}

std::string FormatFindings(const std::vector<Finding>& findings) {
  std::string text;
  for (const Finding& finding : findings) {
    const char* verdict = finding.verdict == Verdict::kGood      ? "good   "
                          : finding.verdict == Verdict::kWarning ? "warning"
                                                                 : "BAD    ";
    std::string what = finding.what;
    what.resize(std::max<size_t>(what.size(), 9), ' ');
    text += std::string(verdict) + "  " + what + " " + finding.found + "\n";
    if (!finding.advice.empty()) {
      text += "                    do: " + finding.advice + "\n";
    }
  }
  return text;
}

Json FindingsToJson(const std::vector<Finding>& findings) {
  Json list = Json::array();
  for (const Finding& finding : findings) {
    const char* verdict = finding.verdict == Verdict::kGood      ? "good"
                          : finding.verdict == Verdict::kWarning ? "warning"
                                                                 : "bad";
    list.push_back({{"what", finding.what},
                    {"verdict", verdict},
                    {"found", finding.found},
                    {"advice", finding.advice}});
  }
  return {{"findings", list}};
}

bool RunDoctor(const DoctorOptions& options, Log& log) {
  std::vector<Finding> findings;
  std::optional<show::ShowContent> content;
  if (!options.show.empty()) {
    Result<show::ShowContent> opened = OpenShow(options);
    for (Finding& finding : JudgeShow(opened, !options.trust.empty(), log)) {
      findings.push_back(std::move(finding));
    }
    if (opened.ok()) {
      content = std::move(*opened);
    }
  }
  Device device;
  if (!options.device.empty()) {
    Result<Device> loaded = LoadDevice(options.device);
    if (loaded.ok()) {
      device = std::move(*loaded);
    } else {
      findings.push_back({"device", Verdict::kBad, loaded.message(),
                          "mend the device file: the player will not start with it"});
    }
  }
  const CameraProbe camera = ProbeCamera(options, device, content ? &*content : nullptr);
  findings.push_back(JudgeCamera(camera));
  const Result<std::string> graphics = OpenGraphics(options.graphics);
  findings.push_back(JudgeGraphics(graphics));
  if (content && graphics.ok()) {
    const double wanted = camera.images > 1 ? camera.images / camera.seconds : kUsualRate;
    findings.push_back(
        JudgeDrawing(ProbeDrawing(*content, options.size, options.graphics, wanted, log), wanted));
  }
  const Result<DisplayProbe> display = OpenDisplay(options);
  findings.push_back(JudgeDisplay(display, true));
  if (device.headset) {
    const bool filled = options.monitor >= 0 && display.ok();
    findings.push_back(JudgeHeadset(*device.headset, device.camera,
                                    filled ? std::optional(display->size) : std::nullopt));
  }
  if (options.display == Display::kOpenXr) {
    findings.push_back(JudgeRuntime(OpenRuntime(device.headset.value_or(Headset()), log)));
  }
  findings.push_back(JudgeSound(OpenSoundDevice()));
  findings.push_back(LookAtDisk(options.state));
  findings.push_back(JudgePower(ReadPower()));
  if (!options.staff_page.empty()) {
    findings.push_back(LookAtStaffPage(options));
  }
  if (device.fleet) {
    findings.push_back(LookAtFleet(*device.fleet));
  }
  const bool bad = std::any_of(findings.begin(), findings.end(),
                               [](const Finding& f) { return f.verdict == Verdict::kBad; });
  if (options.json) {
    std::printf("%s\n", FindingsToJson(findings).dump(2).c_str());
  } else {
    std::printf("%s", FormatFindings(findings).c_str());
  }
  return !bad;
}

}  // namespace lararium::player
