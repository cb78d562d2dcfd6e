#pragma once

// The editor's command line.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace lararium::app {

struct WindowOptions {
  std::filesystem::path project;  // empty: the start page
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

struct CastOptions {
  std::filesystem::path project;
  std::string name;
  std::string preset;              // one of the people that come with the editor; else
  std::filesystem::path recipe;    // of the cast library; else
  std::filesystem::path model;     // a figure to import; else the plain built-in one
  std::filesystem::path bone_map;  // of the model
  // A recorded motion for somebody who is in the cast already; nothing else is changed.
  std::filesystem::path add_clip;
  std::string clip_name;  // empty: the file's
  bool loops = false;
  std::optional<double> height;  // of the plain figure, metres
  std::vector<double> tunic;     // of the plain figure, linear albedo; or empty
};

struct BakeOptions {
  std::filesystem::path project;
};

struct CheckOptions {
  std::filesystem::path project;
  double seconds = 300.0;  // of the drama that are run
  int seeks = 0;           // to random times of them afterwards, compared with what was there
  std::vector<std::filesystem::path> visitors = {};  // recorded ones, besides those of the project
};

// Without a work: only the report.
struct CheckPointsOptions {
  std::filesystem::path project = {};
  std::string place = {};       // empty: the only one; of a report: all
  std::string set = {};         // adds or moves a point
  std::vector<double> at = {};  // its position, x, y, z in metres; empty: here
  bool here = false;            // its position is where the place's staging puts it
  std::string pick = {};        // sets where a point is seen in a training image
  std::string frame = {};       // name of the image
  std::vector<double> pixel = {};
  int session = 0;
  std::string clear = {};   // forgets where a point was picked at the place
  std::string remove = {};  // a point, everywhere
  bool lay = false;         // lays the stage of the place by the points
};

// Without a work: only the list.
struct OccluderOptions {
  std::filesystem::path project = {};
  std::string place = {};               // empty: the only one; of a list: all
  std::string add = {};                 // adds one of this name,
  std::string shape = {};               // which is a shape of this kind,
  std::filesystem::path model = {};     // or else this model
  std::string set = {};                 // changes the one of this name
  std::string remove = {};              // removes it
  std::vector<std::string> sizes = {};  // NAME=METRES, of a shape
  std::vector<double> at = {};          // x, y, z in metres; empty: as it is
  std::vector<double> turn = {};        // degrees: heading, then tilt and roll; empty: as it is
  std::optional<double> scale = {};
  std::string receives_shadow = {};  // yes or no; empty: as it is
  std::string blocks_sound = {};     // likewise
  std::string blocks_walking = {};   // likewise
};

// All that is given is done, in this order; without any of it there is only the report.
struct AlignOptions {
  std::filesystem::path project = {};
  std::string place = {};  // empty: the only one
  std::string occluder = {};
  std::optional<int> remove = {};       // a pair, from 1
  std::vector<double> pair = {};        // adds one: x, y, z in the mesh's axes and unit
  std::vector<std::string> picks = {};  // where that is seen: FRAME,x,y each
  int session = 0;                      // of these images
  std::optional<bool> keep_scale = {};  // whether the model's scale is right
  bool by_points = false;               // lays the model by the pairs
  bool refine = false;                  // then by the map's points
  std::optional<double> within = {};    // metres of the model, for that; none: train's
  std::optional<bool> flat = {};        // of one that was drawn: its corners onto their plane
};

struct LinesOptions {
  std::filesystem::path project;
  std::filesystem::path import;  // .po, .csv or .json
  std::string language;          // of a .po; empty: as it says
};

struct CaptionsOptions {
  std::filesystem::path project;
  std::filesystem::path out;     // .srt or .vtt; exactly one of out and import
  std::filesystem::path import;  // of the whole drama: becomes captions of its lines
  std::string language;          // empty: the project's first
  std::string spoken;            // likewise
  double seconds = 60.0;         // of the drama that are run
};

struct TimelineOptions {
  std::filesystem::path project;
  std::filesystem::path out;  // .otio
  std::string spoken;         // language; empty: the project's first
  double seconds = 60.0;      // of the drama that are run
};

struct ImportBmlOptions {
  std::filesystem::path project;
  std::filesystem::path file;
  std::vector<std::string> actors;  // ID=NAME
  double begin = 0.0;               // seconds of the drama
};

struct CreditsOptions {
  std::filesystem::path project;
  std::filesystem::path out;  // .txt or .json; empty: only told
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

// Light probes from photographs.
struct ProbeOptions {
  enum class Work { kInfo, kMerge, kBall, kMatch, kScale };
  Work work = Work::kInfo;
  std::vector<std::filesystem::path> files;  // the probe, the picture or the photographs
  std::filesystem::path out;                 // .exr or, for a response, .json
  std::filesystem::path response;            // of the camera, .json: read by merge and ball
  std::filesystem::path response_out;        // written by merge
  std::vector<double> exposures;             // of each photograph; empty: from EXIF
  std::vector<double> circle;                // x, y, radius of the ball; empty: found
  double distance = 0.0;                     // of the ball, in its radii; 0: far
  double reflectance = 1.0;                  // of the ball
  int width = 512;                           // of the unwrapped probe
  std::vector<double> pairs;  // azimuth and elevation in the probe, then on the stage, degrees
  bool level = false;         // turn about the vertical only
  double turn = 0.0;          // degrees about the vertical, stage from probe
  std::vector<double> pixel;  // 8-bit R, G, B of a grey surface
  std::vector<double> gain = {1.0, 1.0, 1.0};
  std::vector<double> albedo = {0.18};
  std::vector<double> normal = {0.0, 1.0, 0.0};
};

// What a place's camera is like.
struct CameraOptions {
  std::filesystem::path project;
  std::string place;             // empty: the only one
  std::filesystem::path video;   // at most one recording; none: the training's
  std::filesystem::path images;  // likewise
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

struct ExportOptions {
  std::filesystem::path project;
  std::filesystem::path out;
  std::optional<int> points = {};   // of each place at most
  std::filesystem::path sign = {};  // a secret key; empty: the bundle is not signed
};

struct KeyOptions {
  std::filesystem::path name;  // of the pair: NAME.key and NAME.pub
};

using Subcommand = std::variant<WindowOptions,
                                NewOptions,
                                TrainOptions,
                                ImportColmapOptions,
                                ExportColmapOptions,
                                PruneOptions,
                                MeasureOptions,
                                CastOptions,
                                BakeOptions,
                                CheckOptions,
                                CheckPointsOptions,
                                OccluderOptions,
                                AlignOptions,
                                LinesOptions,
                                CaptionsOptions,
                                TimelineOptions,
                                ImportBmlOptions,
                                CreditsOptions,
                                RenderOptions,
                                PortraitOptions,
                                ReferenceOptions,
                                ProbeOptions,
                                CameraOptions,
                                CalibrateOptions,
                                ExportOptions,
                                KeyOptions>;

struct CommandLine {
  Subcommand subcommand;
  bool json = false;  // results as one object on stdout
};

// What to do, or the exit code where the command line asked for help or is wrong
// (its message is printed).
std::variant<CommandLine, int> ParseCommandLine(int argc, const char* const* argv);

}  // namespace lararium::app
