#pragma once

// The player's command line.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "player/fleet/fleet_options.h"
#include "player/fleet/fleet_setup.h"
#include "player/fleet/page_server.h"
#include "shared/render/gl/graphics_context.h"
#include "shared/render/text/caption_style.h"
#include "shared/vision/pose_smoother.h"

namespace lararium::player {

enum class Pace { kRealtime, kFast };

// Output of sound. kHeadphones is binaural (HRTF).
enum class Listening { kHeadphones, kSpeakers, kNone };

// How pictures are shown: as one picture; side by side for a headset that appears as a monitor; or
// on a headset that an OpenXR runtime drives.
enum class Display { kMono, kSideBySide, kOpenXr };

// Pixels.
struct PictureSize {
  int width = 0;
  int height = 0;
};

// The bundle to play.
struct BundleOptions {
  std::filesystem::path show;
  // Public key: only bundles that it signed are played. Empty: any bundle is played.
  std::filesystem::path trust;
  std::string place;  // empty: all places of the bundle
};

// What a visitor could choose as well.
struct ChoiceOptions {
  std::string language;  // spoken language; empty: the author's choice
  std::string captions;  // language of captions; empty: the author's choice; "off": no captions
  // If one of these four is not given: the choice of a kiosk's last visitor, otherwise normal or
  // off.
  std::optional<render::CaptionSize> caption_size;
  std::optional<render::CaptionContrast> caption_contrast;
  std::optional<bool> descriptions;
  std::optional<bool> reduced_motion;
};

struct CameraOptions {
  // Source of images; at most one is set. If none is set: camera 0.
  std::optional<int> number;
  std::filesystem::path video;
  std::filesystem::path images;
  bool loop = false;  // A recorded source starts again at its end.

  std::vector<double> intrinsics;  // fx, fy, cx, cy[, k1, k2, p1, p2], or empty
  std::filesystem::path device;    // The device file.
  bool look = true;                // People get the noise, softness and blur of the camera's image.
};

struct DisplayOptions {
  // nullopt: side by side if the device file describes a headset's panel, otherwise mono.
  std::optional<Display> mode;
  render::GraphicsChoice graphics;  // used for windows and headless
  bool headless = false;
  int monitor = -1;                 // monitor for full screen; -1: a window
  std::optional<PictureSize> size;  // size of pictures; nullopt: that of the camera's images
};

struct PageOptions {
  std::string address;        // The address of the staff page; empty: no page.
  std::filesystem::path pin;  // The file with the PIN of the staff; empty: the page is read-only.
};

struct KioskOptions {
  bool enabled = false;         // The player is supervised and serves one visitor after another.
  std::filesystem::path state;  // The folder for the state.
  double visit_minutes = 0.0;   // The longest visit; 0: no limit.
};

// The server from which a kiosk gets newer shows (updater.h).
struct UpdateOptions {
  std::string url;           // empty: from nowhere
  std::filesystem::path ca;  // Certificates that are trusted; empty: those of the system.
  double kilobytes_per_second = 1000.0;
};

// Measures the tracker on sequences instead of playing.
struct SequenceOptions {
  std::filesystem::path folder;  // The folder of sequences; empty: the show is played.
  std::vector<std::filesystem::path> foreign;  // Images of other places.
  bool first_pose = false;                     // Relocalises in every frame.
  bool unknown_lens = false;                   // The tracker is not told the intrinsics.
};

// Files that are written; those with an empty path are not.
struct OutputOptions {
  std::filesystem::path visitor_log;  // The visitor's actions are written to it.
  std::filesystem::path poses;
  std::filesystem::path foreground;  // Folder of images, one for each frame.
  std::filesystem::path stats;
  std::filesystem::path record;  // .mp4
  std::filesystem::path sound;   // .wav
  std::filesystem::path log;
};

struct PlayOptions {
  BundleOptions bundle;
  ChoiceOptions choices;
  CameraOptions camera;
  DisplayOptions display;
  PageOptions staff_page;
  FleetOptions fleet;  // The device file's are used if these have no address.
  KioskOptions kiosk;
  UpdateOptions updates;
  SequenceOptions benchmark;
  OutputOptions output;

  std::string osc;        // The address that receives OSC messages; empty: none.
  bool evidence = false;  // The show starts in the evidence view.
  bool staff = false;     // Shows the state of tracking in a corner of the picture.
  bool sandbox = true;    // Gives up rights that playing does not need (sandbox.h).
  // Level of render::QualityLadder(), 0 is the finest. nullopt: adapted to the speed of the
  // machine, or the finest with --pace fast.
  std::optional<int> quality;
  // nullopt: headphones; none with --headless.
  std::optional<Listening> listening;
  Pace pace = Pace::kRealtime;
  int64_t frames = 0;  // number of frames to play; 0: all
  int threads = 0;     // 0: one for each core
  uint64_t seed = 1;
  vision::Smoothing smoothing = vision::Smoothing::kSoft;
  bool foreground = true;         // Real people and things in front of the place hide drawn ones.
  std::filesystem::path visitor;  // Recorded actions that are replayed.
};

struct InfoOptions {
  std::filesystem::path show;
};

// Options of the check of a machine (doctor.h).
struct DoctorOptions {
  std::filesystem::path show;  // empty: no show is checked
  std::filesystem::path trust;
  std::filesystem::path device;
  std::filesystem::path state;
  std::string staff_page;  // empty: no staff page is checked
  std::filesystem::path staff_pin;
  int camera = 0;
  int monitor = -1;                 // -1: any
  std::optional<PictureSize> size;  // size of pictures; nullopt: that of the camera's images
  std::optional<Display> display;
  render::GraphicsChoice graphics;
  bool json = false;
};

// Options of the measurement of latency (latency.h).
struct LatencyOptions {
  int camera = 0;
  std::filesystem::path device;  // device file with the camera's settings; empty: its defaults
  int monitor = -1;              // -1: a window
};

// The options of the chosen command; or the exit code if the command line asked for help or is
// wrong, after the message was printed.
using Command = std::variant<PlayOptions,
                             InfoOptions,
                             DoctorOptions,
                             LatencyOptions,
                             FleetSetupOptions,
                             PageServerOptions,
                             int>;
Command ParseCommandLine(int argc, const char* const* argv);

}  // namespace lararium::player
