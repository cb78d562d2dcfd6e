#pragma once

// What the subcommands take that make of a project what is seen.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace lararium::app {

struct BakeOptions {
  std::filesystem::path project;
};

struct CheckOptions {
  std::filesystem::path project;
  double seconds = 300.0;  // of the drama that are run
  int seeks = 0;           // to random times of them afterwards, compared with what was there
  std::vector<std::filesystem::path> visitors = {};  // recorded ones, besides those of the project
};

struct RenderOptions {
  std::filesystem::path project;
  std::string place;
  std::filesystem::path video;
  std::vector<double> intrinsics;
  std::filesystem::path out;
  std::filesystem::path sound;
  bool evidence = false;  // in the colours of how certain things are
};

// People in a studio; several side by side.
struct PortraitOptions {
  std::vector<std::filesystem::path> humans;  // .larhuman, at least one
  std::filesystem::path out;                  // .png or .jpg
  std::string view = "front";                 // front, side, back, bust, face, three-quarter
  std::vector<std::string> shapes;            // NAME or NAME=weight, of the face
  std::string clip;                           // empty: standing about
  double time = 0.0;                          // seconds into the clip
  double walk = 0.0;                          // seconds of walking; the picture shows their end
  int width = 720;                            // pixels, of each person
  int height = 1080;
  bool sheet = false;  // everyone from several sides, and each shape of the first face
};

// A person in a probe's light, in linear radiance; or a moment of a project's show.
struct ReferenceOptions {
  std::filesystem::path human;  // .larhuman, standing at the stage's origin; or a project
  std::string place;            // of the project; empty: the only one
  std::filesystem::path video;  // of the place, whose frame it is; empty: no camera image
  std::filesystem::path probe;  // HDR image; of a project: the place's
  double probe_turn = 0.0;      // degrees about the vertical, stage from probe
  double probe_scale = 1.0;
  std::filesystem::path camera;  // poses.json; its world is the stage
  int frame = 0;                 // of the camera file, or of the video
  std::string clip;              // empty: the rest pose
  double time = 0.0;             // seconds into the clip; of a project: of the drama
  std::optional<double> ground;  // albedo of a floor of 4 x 4 m, if there is one
  bool without_person = false;   // the floor alone
  std::string method = "path";   // path, prt, sh, phong
  int samples = 256;             // of each pixel, by path
  int bounces = 4;
  uint64_t seed = 1;
  std::filesystem::path out;  // .exr; of a project: .png or .jpg
};

struct ExportOptions {
  std::filesystem::path project;
  std::filesystem::path out;
  std::optional<int> points = {};   // of each place at most
  std::filesystem::path sign = {};  // a secret key; empty: the bundle is not signed
};

struct KeyOptions {
  std::filesystem::path name;  // of the pair: NAME.key and NAME.pub
};

}  // namespace lararium::app
