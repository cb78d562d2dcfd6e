#pragma once

// Checks whether a machine is ready for a show, and says how to solve each problem.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "player/app/device_file.h"
#include "player/app/drawing_probe.h"
#include "player/app/options.h"
#include "shared/core/log.h"
#include "shared/core/status.h"
#include "shared/show/quality_controller.h"

namespace lararium::player {

enum class Verdict { kGood, kWarning, kBad };

struct Finding {
  std::string what;  // "camera", "display", ...
  Verdict verdict = Verdict::kGood;
  std::string found;
  std::string advice = {};  // empty: nothing to do
};

// Measurements of a camera over about a second.
struct CameraProbe {
  int devices = 0;  // number of cameras that the system lists
  Status problem;   // why the camera gives no images
  int width = 0;
  int height = 0;
  int images = 0;
  double seconds = 0.0;
  double brightness = 0.0;  // mean of the grey values, 0..255
  double change = 0.0;      // mean difference of consecutive images, 0..255
  // Only with a show: why its calibration does not fit; in how many images the place was found.
  std::optional<std::string> calibration_problem = std::nullopt;
  std::optional<int> tracked = std::nullopt;
};

// A window, or a full-screen window on a monitor.
struct DisplayProbe {
  PictureSize size;
  std::string device;  // graphics device that draws it
};

Finding JudgeCamera(const CameraProbe& probe);
// monitor: size of the monitor for the headset; nullopt: unknown, or a window.
Finding JudgeHeadset(const Headset& headset,
                     const std::optional<geometry::CameraModel>& camera,
                     const std::optional<PictureSize>& monitor);
Finding JudgeGraphics(const Result<std::string>& device);
// wanted: required pictures per second.
Finding JudgeDrawing(const DrawingProbe& probe, double wanted);
Finding JudgeDisplay(const Result<DisplayProbe>& window, bool wanted);
Finding JudgeSound(const Result<std::string>& out);
// written: result of writing the state. free_bytes: free space on the disk of the state's folder.
Finding JudgeDisk(const Status& written, uint64_t free_bytes, const std::string& folder);
Finding JudgePower(const show::PowerState& power);
// runtime: name of the OpenXR runtime that drives the headset, or why there is none.
Finding JudgeRuntime(const Result<std::string>& runtime);
// port: whether the port of the staff page is free. pin: whether its PIN is valid. urls: addresses
// of the page.
Finding JudgeStaffPage(const Status& port, const Status& pin, const std::vector<std::string>& urls);
Finding JudgeFleet(const Status& connected, const FleetOptions& fleet);

// One line for each finding, with its advice below.
std::string FormatFindings(const std::vector<Finding>& findings);
Json FindingsToJson(const std::vector<Finding>& findings);

// Performs all checks and prints the findings. Returns true if a show can be played.
bool RunDoctor(const DoctorOptions& options, Log& log);

}  // namespace lararium::player
