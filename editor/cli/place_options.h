#pragma once

// Options of the subcommands that create projects and the maps of places.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "editor/jobs/calibrating.h"
#include "editor/jobs/camera_measure.h"

namespace lararium::editor {

struct NewOptions {
  std::filesystem::path project;
  std::string title;  // Empty: the name of the folder.
};

// Without a change, the subcommand only reports the content of the project.
struct ProjectOptions {
  std::filesystem::path project = {};
  std::optional<std::string> title = {};
  std::optional<std::string> credits = {};
  // Language tags separated by commas. Visitors who choose none get the first. "" selects the
  // languages of the lines.
  std::optional<std::string> spoken = {};
  std::optional<std::string> captions = {};
};

// Without an edit, the subcommand only lists the places.
struct PlaceOptions {
  std::filesystem::path project = {};
  std::string add = {};     // Name of a new place, to be trained.
  std::string set = {};     // Name of a place to change.
  std::string first = {};   // Name of a place to move to the front; the window opens with it.
  std::string rename = {};  // Name of a place to rename, with its folder, to `to`.
  std::string to = {};      // New name.
  std::string remove = {};  // Name of a place to remove; its files stay.
  std::optional<std::string> title = {};  // Title of the place that is added or changed.
  // Training recording of the place that is added or changed: a video or a folder of images.
  std::filesystem::path video = {};
  std::filesystem::path images_of = {};
  std::filesystem::path preview = {};  // Recording that the camera view plays.
  std::string occluders_of = {};       // Copies the shapes and models of this place.
  bool images = false;                 // Also lists the training images, for picking.
};

// Without a path, the subcommand only lists the missing files.
struct LocateOptions {
  std::filesystem::path project = {};
  std::string from = {};          // Missing path as listed.
  std::filesystem::path to = {};  // New path; a sound is copied from it.
  bool alone = false;             // Does not update other files that were moved in the same way.
};

struct TrainCommandOptions {
  std::filesystem::path project;
  std::string place;  // Empty: the only place, or a new one named "place".

  // At most one recording; without one, the previous recording of the place is used.
  std::filesystem::path video;
  std::filesystem::path images;
  std::string camera;     // Number of a camera, or a recording played as a camera.
  double seconds = 60.0;  // Duration of the camera recording.

  std::vector<double> intrinsics;     // fx, fy, cx, cy[, k1, k2, p1, p2]; may be empty.
  bool add = false;                   // Merges the recording into the existing map.
  std::optional<int> remove_session;  // Removes this added recording instead, from 1.
  bool put_back = false;              // Restores the map from before the last training instead.
  std::optional<int> points;          // Limit for the points of the map.
  std::optional<double> tag_size;     // Metres; AprilTags of this size fix the scale.
  std::string tag_family = "tag36h11";
  std::filesystem::path poses_out;
  std::filesystem::path report;  // Capture report, HTML.
};

struct ImportColmapOptions {
  std::filesystem::path project;
  std::filesystem::path model;   // A text or binary model, or a COLMAP project that contains one.
  std::filesystem::path images;  // Empty: in the project, or beside the model.
  std::string place;             // Empty: the only place, or a new one named "place".
};

struct ExportColmapOptions {
  std::filesystem::path project;
  std::filesystem::path model;  // Folder to write.
  std::string place;            // Empty: the only place.
  bool text = false;
  bool with_images = false;  // Writes the keyframes as files beside the model.
};

struct PruneOptions {
  std::filesystem::path project;
  std::string place;          // Empty: the only place.
  std::optional<int> points;  // None: only report what smaller maps would lose.
};

// The distance between two points of a map, by their indices.
struct MeasureOptions {
  std::filesystem::path project;
  std::string place;  // Empty: the only place.
  int from = 0;
  int to = 0;
  std::optional<double> metres;  // True distance; rescales the stage to it.
};

}  // namespace lararium::editor
