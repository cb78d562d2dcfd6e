#pragma once

// What the subcommands take that make projects and the maps of places.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace lararium::app {

struct NewOptions {
  std::filesystem::path project;
  std::string title;  // empty: the folder's name
};

// Without anything that changes: only what the project holds.
struct ProjectOptions {
  std::filesystem::path project = {};
  std::optional<std::string> title = {};
  std::optional<std::string> credits = {};
  // Language tags with commas between them, the first that of whoever chooses none; "": those of
  // the lines.
  std::optional<std::string> spoken = {};
  std::optional<std::string> captions = {};
};

// Without a work: only the list.
struct PlaceOptions {
  std::filesystem::path project = {};
  std::string add = {};     // adds one of this name, to be trained
  std::string set = {};     // changes the one of this name
  std::string first = {};   // puts it before the others: the window opens with it
  std::string rename = {};  // with its folder,
  std::string to = {};      // to this name
  std::string remove = {};  // its files stay
  // Of one that is added or changed, at most one of video and images: what it is trained from.
  std::filesystem::path video = {};
  std::filesystem::path images_of = {};
  std::filesystem::path preview = {};  // what the camera view plays
  std::string occluders_of = {};       // takes the shapes and models of this place over
  bool images = false;                 // lists the training images, to pick in, too
};

// Without a path: only the list of what is not where the project says.
struct LocateOptions {
  std::filesystem::path project = {};
  std::string from = {};          // as the list has it
  std::filesystem::path to = {};  // where it is now; a sound is copied from there
  bool alone = false;             // others that made the same move are left
};

struct TrainOptions {
  std::filesystem::path project;
  std::string place;  // empty: the only one, or a new one called "place"

  // At most one; none: the recording that the place was trained from before.
  std::filesystem::path video;
  std::filesystem::path images;
  std::string camera;     // a number, or a recording that is played as one
  double seconds = 60.0;  // how long the camera records

  std::vector<double> intrinsics;     // fx, fy, cx, cy[, k1, k2, p1, p2], or empty
  bool add = false;                   // merge the recording into the map that is there
  std::optional<int> remove_session;  // take this one out of it instead, from 1 on
  bool put_back = false;              // the map from before the last training instead
  std::optional<int> points;          // of the database at most
  std::optional<double> tag_size;     // metres: AprilTags of this size fix the scale
  std::string tag_family = "tag36h11";
  std::filesystem::path poses_out;
  std::filesystem::path report;  // the capture report, HTML
};

struct ImportColmapOptions {
  std::filesystem::path project;
  std::filesystem::path model;   // a model, text or binary, or a project with one
  std::filesystem::path images;  // empty: in the project, or beside the model
  std::string place;             // empty: the only one, or a new one called "place"
};

struct ExportColmapOptions {
  std::filesystem::path project;
  std::filesystem::path model;  // the folder to write
  std::string place;            // empty: the only one
  bool text = false;
  bool with_images = false;  // the keyframes as files beside the model
};

struct PruneOptions {
  std::filesystem::path project;
  std::string place;          // empty: the only one
  std::optional<int> points;  // none: only tell what smaller maps would lose
};

// The distance of two points of a map, by their numbers.
struct MeasureOptions {
  std::filesystem::path project;
  std::string place;  // empty: the only one
  int from = 0;
  int to = 0;
  std::optional<double> metres;  // that it is in truth: the stage is scaled so
};

// What a place's camera is like, or which cameras are connected.
struct CameraOptions {
  bool list = false;              // those that are connected, and nothing else
  std::filesystem::path project;  // but for that
  std::string place;              // empty: the only one
  std::filesystem::path video;    // at most one recording; none: the training's
  std::filesystem::path images;   // likewise
  std::filesystem::path response;
  std::optional<double> knee;     // instead of one fitted to the response
  std::optional<double> shutter;  // share of the time between frames; none: learnt
  std::filesystem::path device_out;
  bool forget = false;
};

// Of a camera, with a chessboard.
struct CalibrateOptions {
  // One of them, unless a board is printed.
  std::filesystem::path video;
  std::filesystem::path images;
  std::string camera;  // a number, or a recording that is played as one
  int columns = 9;     // inner corners of the board
  int rows = 6;
  double square = 0.0;    // of the board, metres; 0: not known
  double seconds = 60.0;  // how long the camera is looked at
  std::filesystem::path device_out;
  std::filesystem::path print_board;  // .svg
};

}  // namespace lararium::app
