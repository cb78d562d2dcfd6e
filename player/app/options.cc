#include "player/app/options.h"

#include <CLI/CLI.hpp>
#include <array>
#include <cstdio>
#include <map>
#include <utility>

#include "player/kiosk/listen_address.h"
#include "player/kiosk/watchdog.h"

namespace lararium::player {
namespace {

constexpr int kLargestCount = 1'000'000'000;

std::map<std::string, vision::Smoothing> SmoothingNames() {
  return {{"off", vision::Smoothing::kOff},
          {"soft", vision::Smoothing::kSoft},
          {"strong", vision::Smoothing::kStrong}};
}

std::map<std::string, Listening> ListeningNames() {
  return {{"headphones", Listening::kHeadphones},
          {"speakers", Listening::kSpeakers},
          {"none", Listening::kNone}};
}

std::map<std::string, Display> DisplayNames() {
  return {{"mono", Display::kMono},
          {"side-by-side", Display::kSideBySide},
          {"openxr", Display::kOpenXr}};
}

void AddGraphicsOption(CLI::App& app, render::GraphicsChoice& graphics, const std::string& help) {
  app.add_option_function<std::string>(
         "--graphics",
         [&graphics](const std::string& name) {
           graphics = name == "gl"     ? render::GraphicsChoice(render::GraphicsApi::kOpenGl33)
                      : name == "gles" ? render::GraphicsChoice(render::GraphicsApi::kOpenGlEs30)
                                       : std::nullopt;
         },
         help)
      ->check(CLI::IsMember({"auto", "gl", "gles"}));
}

// nullopt: text is not a size.
std::optional<PictureSize> ParseSize(const std::string& text) {
  PictureSize size;
  char rest = 0;
  if (std::sscanf(text.c_str(), "%4dx%4d%c", &size.width, &size.height, &rest) != 2) {
    return std::nullopt;
  }
  const auto fits = [](int side) { return side >= 16 && side <= 8192 && side % 2 == 0; };
  return fits(size.width) && fits(size.height) ? std::optional(size) : std::nullopt;
}

void AddSizeOption(CLI::App& app, std::optional<PictureSize>& size, const std::string& help) {
  app.add_option_function<std::string>(
         "--size", [&size](const std::string& text) { size = ParseSize(text); }, help)
      ->check(CLI::Validator(
          [](const std::string& text) {
            return ParseSize(text) ? "" : "takes WIDTHxHEIGHT, both even, of 16 to 8192";
          },
          "WxH"));
}

// Adds an option that takes one of names.
template <typename Choice, size_t n>
void AddChoiceOption(CLI::App& app,
                     const char* option,
                     const std::array<std::string_view, n>& names,
                     std::optional<Choice>& choice,
                     const std::string& help) {
  app.add_option_function<std::string>(
         option,
         [&choice, names](const std::string& name) {
           choice = render::ChoiceOf<Choice>(names, name);
         },
         help)
      ->check(CLI::IsMember(std::vector<std::string>(names.begin(), names.end())));
}

// on: bool or std::optional<bool>.
template <typename Switch>
void AddSwitchOption(CLI::App& app, const char* option, Switch& on, const std::string& help) {
  app.add_option_function<std::string>(
         option, [&on](const std::string& word) { on = word == "on"; }, help)
      ->check(CLI::IsMember({"on", "off"}));
}

void AddPlayOptions(CLI::App& app, PlayOptions& play) {
  app.add_option("SHOW", play.bundle.show, "The bundle to play (.larshow)")
      ->check(CLI::ExistingFile);
  CLI::Option* trust = app.add_option("--trust", play.bundle.trust,
                                      "Play only what was signed with the key of this .pub file")
                           ->check(CLI::ExistingFile);
  app.add_option("--place", play.bundle.place, "Only this place of the bundle; all otherwise");
  app.add_option("--language", play.choices.language,
                 "Language that people speak, as la or en; otherwise as the author chose");
  app.add_option("--captions", play.choices.captions,
                 "Language of the captions, or off; otherwise as the author chose");
  AddChoiceOption(app, "--caption-size", render::kCaptionSizes, play.choices.caption_size,
                  "Letters of captions and of the guide");
  AddChoiceOption(app, "--caption-contrast", render::kCaptionContrasts,
                  play.choices.caption_contrast,
                  "high: captions, guide and menu bold, white and yellow on black");
  AddSwitchOption(app, "--descriptions", play.choices.descriptions,
                  "on: what is to be seen is described, for visitors who do not see well");
  AddSwitchOption(app, "--reduced-motion", play.choices.reduced_motion,
                  "on: nothing of what the player adds glides that can fade");

  CLI::Option_group* source = app.add_option_group("source", "Where images come from");
  source->add_option("--camera", play.camera.number,
                     "Number of a camera (0 unless told otherwise)");
  source->add_option("--video", play.camera.video, "Video file")->check(CLI::ExistingFile);
  source->add_option("--images", play.camera.images, "Folder of images")
      ->check(CLI::ExistingDirectory);
  source->require_option(0, 1);

  app.add_option("--intrinsics", play.camera.intrinsics, "fx,fy,cx,cy[,k1,k2,p1,p2] in pixels")
      ->delimiter(',')
      ->expected(4, 8)
      ->check(CLI::Number);
  app.add_option("--device", play.camera.device,
                 "Device file: the camera's calibration and look, the headset")
      ->check(CLI::ExistingFile);
  app.add_option_function<std::string>(
         "--look", [&play](const std::string& look) { play.camera.look = look == "camera"; },
         "camera: people as noisy, soft and smeared as the camera's image; plain: as drawn")
      ->check(CLI::IsMember({"camera", "plain"}));

  app.add_option("--osc", play.osc,
                 "Listen for Open Sound Control: PORT on this machine, ADDRESS:PORT or "
                 "INTERFACE:PORT on a network");
  CLI::Option* page = app.add_option(
      "--staff-page", play.staff_page.address,
      "A page for staff, by HTTP: PORT for this machine only, ADDRESS:PORT or INTERFACE:PORT for "
      "a network, 0.0.0.0:PORT for all of them");
  app.add_option("--staff-pin-file", play.staff_page.pin,
                 "File with the PIN for changing things on that page; without one it only shows")
      ->check(CLI::ExistingFile)
      ->needs(page);
  app.add_flag("--evidence", play.evidence,
               "People and things in the colours of how certain they are; F2 switches");
  app.add_option(
         "--display", play.display.mode,
         "mono; side-by-side: for both eyes through the lenses of the device file's headset, "
         "which is what happens where it has a panel; openxr: on a headset that an OpenXR "
         "runtime drives")
      ->transform(CLI::Transformer(DisplayNames()));
  app.add_flag("--headless", play.display.headless, "Draw off screen");
  AddGraphicsOption(app, play.display.graphics,
                    "gl: OpenGL 3.3; gles: OpenGL ES 3.0; auto: the first, where it can be had");
  app.add_option("--monitor", play.display.monitor,
                 "Full screen on this monitor; a kiosk is on the first unless told otherwise")
      ->check(CLI::Range(0, kLargestCount));
  AddSizeOption(app, play.display.size,
                "Size of the pictures, as 1280x720; as the camera's images unless given. A "
                "headset's panel has the device file's");
  app.add_option_function<std::string>(
         "--quality",
         [&play](const std::string& quality) {
           play.quality = quality == "auto" ? std::nullopt : std::optional(std::stoi(quality));
         },
         "0, the finest, to 5; auto: as fine as keeps the frame rate")
      ->check(CLI::IsMember({"auto", "0", "1", "2", "3", "4", "5"}));
  AddSwitchOption(app, "--sandbox", play.sandbox,
                  "on: no other programs, no network, no settings of the machine; off");
  app.add_flag("--staff", play.staff, "Show how tracking is, in a corner of the picture");
  app.add_flag("--loop", play.camera.loop, "Begin a video or folder again at its end");
  CLI::Option* kiosk = app.add_flag("--kiosk", play.kiosk.enabled,
                                    "Full screen, watched over, for one visitor after the other");
  app.add_option("--state", play.kiosk.state, "Folder in which a kiosk remembers where it was")
      ->needs(kiosk);
  app.add_option("--visit-minutes", play.kiosk.visit_minutes,
                 "How long a kiosk's visit may take, where others wait; otherwise as long as the "
                 "visitor stays")
      ->check(CLI::Range(0.5, 240.0))
      ->needs(kiosk);
  CLI::Option* updates =
      app.add_option("--updates", play.updates.url,
                     "Address (https://...) of a folder of lararium-editor publish, from which a "
                     "kiosk gets newer shows")
          ->check(CLI::Validator(
              [](const std::string& url) {
                return url.starts_with("https://") || url.starts_with("http://")
                           ? ""
                           : "takes the address of a folder on a web server";
              },
              "URL"))
          ->needs(kiosk)
          ->needs(trust);
  app.add_option("--updates-ca", play.updates.ca,
                 "Certificates (.pem) that are trusted for it instead of the system's")
      ->check(CLI::ExistingFile)
      ->needs(updates);
  app.add_option("--updates-rate", play.updates.kilobytes_per_second,
                 "Kilobytes per second that it may fetch")
      ->check(CLI::Range(1.0, 1e6))
      ->capture_default_str()
      ->needs(updates);
  app.add_option_function<std::string>(
         "--pace",
         [&play](const std::string& pace) {
           play.pace = pace == "fast" ? Pace::kFast : Pace::kRealtime;
         },
         "realtime: the newest frame wins; fast: every frame once")
      ->check(CLI::IsMember({"realtime", "fast"}));
  app.add_option("--frames", play.frames, "Stop after this many frames")
      ->check(CLI::Range(0, kLargestCount));
  app.add_option("--threads", play.threads, "Worker threads")->check(CLI::Range(0, kLargestCount));
  app.add_option("--seed", play.seed, "Of all randomness");

  app.add_option("--smoothing", play.smoothing,
                 "off; soft: corrections after re-localisation come gently; strong: a low-pass "
                 "as well, which lags a little")
      ->transform(CLI::Transformer(SmoothingNames()));

  AddSwitchOption(
      app, "--foreground", play.foreground,
      "on: visitors and things in front of the place hide the people who are drawn; off");

  app.add_option("--audio", play.listening,
                 "headphones: mixed for two ears; speakers; none. What is recorded is mixed "
                 "likewise")
      ->transform(CLI::Transformer(ListeningNames()));

  CLI::Option* benchmark =
      app.add_option("--benchmark", play.benchmark.folder,
                     "Measure the tracker on sequences with ground truth: a folder with "
                     "ground_truth.json, or a folder of such folders")
          ->check(CLI::ExistingDirectory);
  app.add_option("--foreign", play.benchmark.foreign,
                 "Images or a video of another place, which must not be tracked")
      ->check(CLI::ExistingPath)
      ->needs(benchmark);
  app.add_flag("--first-pose", play.benchmark.first_pose, "Relocalise in every frame")
      ->needs(benchmark);
  app.add_flag("--unknown-lens", play.benchmark.unknown_lens,
               "Do not tell the tracker the intrinsics of the sequences")
      ->needs(benchmark);

  CLI::Option* visitor = app.add_option("--visitor", play.visitor,
                                        "Play again what a visitor did: a file of --visitor-log")
                             ->check(CLI::ExistingFile);
  app.add_option("--visitor-log", play.output.visitor_log,
                 "Write down here what the visitor does, as far as the drama hears of it")
      ->excludes(visitor);

  app.add_option("--poses-out", play.output.poses, "Write the poses here (poses.json)");
  app.add_option("--foreground-out", play.output.foreground,
                 "Write into this folder what was found in front of the place: a grey PNG for each "
                 "frame, white in front")
      ->check(CLI::ExistingDirectory);
  app.add_option("--stats-out", play.output.stats, "Write times and counts here (stats.json)");
  app.add_option("--record", play.output.record, "Write the composite here, with its sound (.mp4)");
  app.add_option("--sound", play.output.sound, "Write the sound here (.wav)");
  app.add_option("--log", play.output.log, "Write the log here too");
}

void AddFleetOptions(CLI::App& app, FleetOptions& fleet) {
  CLI::Option* broker = app.add_option(
      "--fleet", fleet.address,
      "Join the fleet of a site: mqtts://HOST[:PORT]/SITE. Unless it is given, as the device file "
      "says");
  app.add_option("--fleet-name", fleet.name, "Name of this device there; that of the machine")
      ->needs(broker);
  CLI::Option* group =
      app.add_option("--group", fleet.group, "Play one drama together with this group's devices")
          ->needs(broker);
  app.add_flag("--guide", fleet.guide, "This is the device of the group's guide")->needs(group);
  app.add_option("--fleet-authority", fleet.authority,
                 "Certificate of the authority that signed the broker's; otherwise one that the "
                 "system trusts")
      ->check(CLI::ExistingFile)
      ->needs(broker);
  app.add_option("--fleet-password-file", fleet.password, "File with this device's password there")
      ->check(CLI::ExistingFile)
      ->needs(broker);
  app.add_option("--fleet-certificate", fleet.certificate,
                 "This device's certificate there, instead of a password")
      ->check(CLI::ExistingFile)
      ->needs(broker);
  app.add_option("--fleet-key", fleet.key, "The key of that certificate")
      ->check(CLI::ExistingFile)
      ->needs(broker);
}

CLI::App* AddFleetSetup(CLI::App& app, FleetSetupOptions& setup) {
  CLI::App* command = app.add_subcommand(
      "fleet-setup", "Write what a fleet needs: the broker's files, and a folder for each device");
  command->add_option("FOLDER", setup.folder, "A new folder, or one to be changed")->required();
  command->add_option("--host", setup.host, "The broker's IP address or name, as devices reach it");
  command->add_option("--site", setup.site, "Name of the site");
  command->add_option("--add", setup.devices,
                      "Devices to add: NAME or NAME:GROUP; or another group for one");
  command->add_option("--guide", setup.guides, "Names of devices that lead their groups");
  command->add_option("--remove", setup.removed, "Names of devices to remove");
  command->add_option("--show", setup.show, "Show the places of this bundle on the fleet's page")
      ->check(CLI::ExistingFile);
  command->add_option("--port", setup.port, "The broker's port for devices (8883)")
      ->check(CLI::Range(1, 65535));
  command->add_option("--page-port", setup.page_port, "The broker's port for fleet pages (8884)")
      ->check(CLI::Range(1, 65535));
  command->add_option("--broker-folder", setup.broker_folder,
                      "Where the broker's files will lie on its machine (/etc/mosquitto/lararium)");
  command
      ->add_option_function<std::string>(
          "--devices-prove-by",
          [&setup](const std::string& means) { setup.certificates = means == "certificates"; },
          "How devices prove their names: passwords (which is usual) or certificates")
      ->check(CLI::IsMember({"passwords", "certificates"}));
  return command;
}

CLI::App* AddFleetPage(CLI::App& app, PageServerOptions& page) {
  CLI::App* command =
      app.add_subcommand("fleet-page", "Serve the page of a fleet, by HTTPS, until it is ended");
  command->add_option("FOLDER", page.folder, "The broker's folder that fleet-setup wrote")
      ->required()
      ->check(CLI::ExistingDirectory);
  command
      ->add_option("--address", page.address,
                   "ADDRESS:PORT, INTERFACE:PORT, or PORT for this machine")
      ->capture_default_str();
  AddSwitchOption(*command, "--sandbox", page.sandbox, "on: nothing but serving; off");
  return command;
}

CLI::App* AddDoctor(CLI::App& app, DoctorOptions& doctor) {
  CLI::App* command =
      app.add_subcommand("doctor", "Look at camera, display, sound, disk and show; say what to do");
  command->add_option("SHOW", doctor.show)->check(CLI::ExistingFile);
  command->add_option("--trust", doctor.trust, "The museum's key (.pub)")->check(CLI::ExistingFile);
  command->add_option("--device", doctor.device, "Device file")->check(CLI::ExistingFile);
  command->add_option("--state", doctor.state, "The kiosk's folder");
  command->add_option("--camera", doctor.camera, "Number of the camera")
      ->check(CLI::NonNegativeNumber);
  command->add_option("--monitor", doctor.monitor, "Number of the monitor")
      ->check(CLI::NonNegativeNumber);
  command->add_option("--display", doctor.display, "As the player will be told")
      ->transform(CLI::Transformer(DisplayNames()));
  AddSizeOption(*command, doctor.size, "As the player will be told");
  AddGraphicsOption(*command, doctor.graphics, "As the player will be told");
  CLI::Option* doctor_page =
      command->add_option("--staff-page", doctor.staff_page, "As the player will be told");
  command->add_option("--staff-pin-file", doctor.staff_pin, "As the player will be told")
      ->needs(doctor_page);
  command->add_flag("--json", doctor.json, "Print one JSON object");
  return command;
}

CLI::App* AddLatency(CLI::App& app, LatencyOptions& latency) {
  CLI::App* command = app.add_subcommand(
      "latency", "Flash the display, watch it by the camera: how late is what is shown seen?");
  command->add_option("--camera", latency.camera, "Number of the camera")
      ->check(CLI::NonNegativeNumber);
  command->add_option("--monitor", latency.monitor, "Full screen on this monitor")
      ->check(CLI::NonNegativeNumber);
  command->add_option("--device", latency.device, "Device file: how the camera is run")
      ->check(CLI::ExistingFile);
  return command;
}

void Refuse(bool wrong, const char* option, const std::string& why) {
  if (wrong) {
    throw CLI::ValidationError(option, why);
  }
}

void CheckAddress(const char* option, const std::string& address) {
  const auto parsed = ParseListenAddress(option, address);
  Refuse(!parsed.ok(), option, parsed.status().message());
}

// Checks the options that playing and the doctor have in common.
void CheckScreen(const std::string& page,
                 const std::optional<Display>& display,
                 const render::GraphicsChoice& graphics) {
  if (!page.empty()) {
    CheckAddress("--staff-page", page);
  }
  Refuse(display == Display::kOpenXr && graphics == render::GraphicsApi::kOpenGlEs30,
         "--display openxr", "cannot go with --graphics gles");
}

void CheckPlayOptions(const PlayOptions& play) {
  const size_t numbers = play.camera.intrinsics.size();
  const bool recorded = !play.camera.video.empty() || !play.camera.images.empty();
  Refuse(numbers != 0 && numbers != 4 && numbers != 8, "--intrinsics", "takes 4 or 8 numbers");
  if (!play.osc.empty()) {
    CheckAddress("--osc", play.osc);
  }
  if (!play.fleet.address.empty()) {
    FleetOptions fleet = play.fleet;
    NameDevice(fleet);
    const Status status = fleet.Validate();
    Refuse(!status.ok(), "--fleet", status.message());
  }
  if (!play.benchmark.folder.empty()) {
    Refuse(!play.fleet.address.empty(), "--fleet", "cannot go with --benchmark");
    Refuse(!play.staff_page.address.empty(), "--staff-page", "cannot go with --benchmark");
    Refuse(play.camera.number || recorded, "--benchmark", "takes its images from its own folder");
    Refuse(play.kiosk.enabled, "--kiosk", "cannot go with --benchmark");
  }
  Refuse(play.camera.loop && !recorded, "--loop", "goes with --video or --images");
  if (play.display.headless) {
    Refuse(play.display.mode == Display::kOpenXr, "--display openxr", "cannot go with --headless");
    Refuse(play.display.monitor >= 0, "--monitor", "cannot go with --headless");
  }
}

}  // namespace

Command ParseCommandLine(int argc, const char* const* argv) {
  PlayOptions play;
  InfoOptions info;
  DoctorOptions doctor;
  LatencyOptions latency;
  FleetSetupOptions fleet_setup;
  PageServerOptions fleet_page;
  CLI::App app("Plays a Lararium show: people of the past on the place before the camera.");
  app.set_version_flag("--version", LARARIUM_VERSION);
  AddPlayOptions(app, play);
  AddFleetOptions(app, play.fleet);
  const CLI::App* setup_command = AddFleetSetup(app, fleet_setup);
  const CLI::App* page_command = AddFleetPage(app, fleet_page);
  CLI::App* info_command = app.add_subcommand("info", "Say what a bundle holds");
  info_command->add_option("SHOW", info.show)->required()->check(CLI::ExistingFile);
  const CLI::App* doctor_command = AddDoctor(app, doctor);
  const CLI::App* latency_command = AddLatency(app, latency);

  try {
    app.parse(argc, argv);
    if (app.get_subcommands().empty() && play.bundle.show.empty()) {
      throw CLI::RequiredError("SHOW");
    }
    CheckAddress("--address", fleet_page.address);
    CheckPlayOptions(play);
    CheckScreen(play.staff_page.address, play.display.mode, play.display.graphics);
    CheckScreen(doctor.staff_page, doctor.display, doctor.graphics);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kUsageError;
  }
  const std::pair<const CLI::App*, Command> commands[] = {{info_command, info},
                                                          {doctor_command, doctor},
                                                          {latency_command, latency},
                                                          {setup_command, fleet_setup},
                                                          {page_command, fleet_page}};
  for (const auto& [command, options] : commands) {
    if (*command) {
      return options;
    }
  }
  const bool shown_on_monitor = !play.display.headless && play.display.mode != Display::kOpenXr;
  if (play.kiosk.enabled && shown_on_monitor && play.display.monitor < 0) {
    play.display.monitor = 0;  // Full screen, so that visitors do not see the desktop.
  }
  return play;
}

}  // namespace lararium::player
