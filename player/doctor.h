#pragma once

// Looks at a machine as a show will find it, and says what to do where something is wrong.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "player/device_file.h"
#include "player/drawing_probe.h"
#include "player/options.h"
#include "shared/core/log.h"
#include "shared/core/status.h"
#include "shared/show/quality_controller.h"

namespace lararium::player {

enum class Verdict { kGood, kWarning, kBad };

struct Finding {
  std::string what;  // "camera", "display", ...
  Verdict verdict = Verdict::kGood;
  std::string found;
  std::string advice = {};  // empty: nothing is to be done
};

// What was seen of a camera in a second or so.
struct CameraProbe {
  int devices = 0;  // that the system lists
  Status problem;   // why it gives no images
  int width = 0;
  int height = 0;
  int images = 0;
  double seconds = 0.0;
  double brightness = 0.0;  // mean of the grey values, 0..255
  double change = 0.0;      // mean difference from image to image
  // With a show: whether its calibration fits, and in how many images the place was found.
  std::optional<std::string> calibration_problem = std::nullopt;
  std::optional<int> tracked = std::nullopt;
};

// A window, or a monitor filled.
struct DisplayProbe {
  PictureSize size;
  std::string device;  // that draws
};

Finding JudgeCamera(const CameraProbe& probe);
// monitor: that it is to be shown on; nullopt: not known, or a window.
Finding JudgeHeadset(const Headset& headset,
                     const std::optional<geometry::CameraModel>& camera,
                     const std::optional<PictureSize>& monitor);
Finding JudgeGraphics(const Result<std::string>& device);
// wanted: pictures a second.
Finding JudgeDrawing(const DrawingProbe& probe, double wanted);
Finding JudgeDisplay(const Result<DisplayProbe>& window, bool wanted);
Finding JudgeSound(const Result<std::string>& out);
// free_bytes: where the state is kept.
Finding JudgeDisk(const Status& written, uint64_t free_bytes, const std::string& folder);
Finding JudgePower(const show::PowerState& power);
// runtime: of OpenXR, where a headset is to be driven by one.
Finding JudgeRuntime(const Result<std::string>& runtime);
// Whether the staff page's port can be listened to, and its PIN; urls: how it is asked for.
Finding JudgeStaffPage(const Status& port, const Status& pin, const std::vector<std::string>& urls);

// One line for each, and the advice below it.
std::string FormatFindings(const std::vector<Finding>& findings);
Json FindingsToJson(const std::vector<Finding>& findings);

// Looks at all of it and prints. True: a show can be played.
bool RunDoctor(const DoctorOptions& options, Log& log);

}  // namespace lararium::player
