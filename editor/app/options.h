#pragma once

// The editor's command line.

#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace lararium::app {

struct WindowOptions {
  std::filesystem::path project;  // empty: the last one, or the sample
};

struct NewOptions {
  std::filesystem::path project;
  std::string title;  // empty: the folder's name
};

struct TrainOptions {
  std::filesystem::path project;
  std::string place;  // empty: the only one, or a new one called "place"

  // At most one; none: the recording that the place was trained from before.
  std::filesystem::path video;
  std::filesystem::path images;
  std::optional<int> camera;
  double seconds = 60.0;  // how long the camera records

  std::vector<double> intrinsics;  // fx, fy, cx, cy[, k1, k2, p1, p2], or empty
  std::filesystem::path poses_out;
};

struct CastOptions {
  std::filesystem::path project;
  std::string name;
  std::filesystem::path model;   // empty: the plain built-in figure
  std::optional<double> height;  // of the plain figure, metres
  std::vector<double> tunic;     // of the plain figure, linear albedo; or empty
};

struct BakeOptions {
  std::filesystem::path project;
};

struct CheckOptions {
  std::filesystem::path project;
  double seconds = 60.0;  // of the drama that are run
};

struct RenderOptions {
  std::filesystem::path project;
  std::string place;
  std::filesystem::path video;
  std::vector<double> intrinsics;
  std::filesystem::path out;
};

struct ExportOptions {
  std::filesystem::path project;
  std::filesystem::path out;
};

using Subcommand = std::variant<WindowOptions,
                                NewOptions,
                                TrainOptions,
                                CastOptions,
                                BakeOptions,
                                CheckOptions,
                                RenderOptions,
                                ExportOptions>;

struct CommandLine {
  Subcommand subcommand;
  bool json = false;  // results as one object on stdout
};

// What to do, or the exit code where the command line asked for help or is wrong
// (its message is printed).
std::variant<CommandLine, int> ParseCommandLine(int argc, const char* const* argv);

}  // namespace lararium::app
