#pragma once

// The player's command line.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "shared/render/caption_style.h"
#include "shared/render/graphics_context.h"
#include "shared/vision/pose_smoother.h"

namespace lararium::player {

enum class Pace { kRealtime, kFast };

// Where sound is heard. Headphones: mixed for two ears (HRTF).
enum class Listening { kHeadphones, kSpeakers, kNone };

// How pictures are shown: as they are, for both eyes of a headset that appears as a monitor, or on
// one that an OpenXR runtime drives.
enum class Display { kMono, kSideBySide, kOpenXr };

// Pixels.
struct PictureSize {
  int width = 0;
  int height = 0;
};

struct PlayOptions {
  std::filesystem::path show;
  std::filesystem::path trust;  // public key; only what it signed is played. Empty: anything
  std::string place;            // empty: all of the bundle

  std::string language;  // that people speak; empty: as the author chose
  std::string captions;  // likewise what is to be read; "off": nothing
  // None: as the last visitor of a kiosk chose, normal else.
  std::optional<render::CaptionSize> caption_size;
  std::optional<render::CaptionContrast> caption_contrast;
  std::optional<bool> descriptions;    // likewise off
  std::optional<bool> reduced_motion;  // likewise

  // Where images come from; at most one is set. None: camera 0.
  std::optional<int> camera;
  std::filesystem::path video;
  std::filesystem::path images;

  std::vector<double> intrinsics;  // fx, fy, cx, cy[, k1, k2, p1, p2], or empty
  std::filesystem::path device;
  bool camera_look = true;  // people as noisy, soft and smeared as the camera's image

  bool evidence = false;  // begins in the evidence view

  std::string osc;  // where to listen for messages; empty: nowhere

  std::string staff_page;           // where staff ask for their page; empty: there is none
  std::filesystem::path staff_pin;  // the file with their PIN; empty: the page only shows

  // None: side by side where the device file has a headset's panel.
  std::optional<Display> display;
  render::GraphicsChoice graphics;  // what pictures are drawn with, windows and headless
  bool headless = false;
  int monitor = -1;                 // full screen there; -1: a window
  std::optional<PictureSize> size;  // of the pictures; none: as the camera's images
  // The level of quality, 0 the finest; none: as the device can keep up. In --pace fast the finest.
  std::optional<int> quality;
  bool sandbox = true;          // gives up what it does not need of the system
  bool staff = false;           // how tracking is, in a corner of the picture
  bool kiosk = false;           // watched over, full screen, for one visitor after the other
  std::filesystem::path state;  // the kiosk's folder
  double visit_minutes = 0.0;   // that a kiosk's visit takes at most; 0: as long as they stay
  bool loop = false;            // a recorded source begins again at its end
  Pace pace = Pace::kRealtime;
  int64_t frames = 0;  // 0: all
  int threads = 0;     // 0: as many as cores
  uint64_t seed = 1;
  vision::Smoothing smoothing = vision::Smoothing::kSoft;
  // Not given: headphones, or none where nothing is shown on a screen.
  std::optional<Listening> listening;

  // Instead of playing: measure the tracker on the sequences there.
  std::filesystem::path benchmark;
  std::vector<std::filesystem::path> foreign;  // images of other places
  bool first_pose = false;                     // find every frame anew

  // What the visitor does: recorded there, or played again from there.
  std::filesystem::path visitor_log;
  std::filesystem::path visitor;

  std::filesystem::path poses_out;
  std::filesystem::path stats_out;
  std::filesystem::path record;
  std::filesystem::path sound;  // .wav
  std::filesystem::path log;
};

struct InfoOptions {
  std::filesystem::path show;
};

// Looks at the machine.
struct DoctorOptions {
  std::filesystem::path show;  // empty: without one
  std::filesystem::path trust;
  std::filesystem::path device;
  std::filesystem::path state;
  std::string staff_page;  // empty: none is wanted
  std::filesystem::path staff_pin;
  int camera = 0;
  int monitor = -1;                 // any
  std::optional<PictureSize> size;  // of the pictures; none: as the camera's images
  std::optional<Display> display;
  render::GraphicsChoice graphics;
  bool json = false;
};

// Measures how late what is shown is seen.
struct LatencyOptions {
  int camera = 0;
  std::filesystem::path device;  // how the camera is run; empty: as it comes
  int monitor = -1;              // a window
};

// What to do, or the exit code where the command line asked for help or is wrong
// (its message is printed).
using Command = std::variant<PlayOptions, InfoOptions, DoctorOptions, LatencyOptions, int>;
Command ParseCommandLine(int argc, const char* const* argv);

}  // namespace lararium::player
