#pragma once

// What the subcommands take that say what is real on the stage, and how it is lit.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace lararium::app {

// All that is given is done, in this order; without any of it there is only the report.
struct StageOptions {
  std::filesystem::path project = {};
  std::string place = {};               // empty: the only one
  std::vector<std::string> clear = {};  // forgets picks of these: POINT, or POINT=FRAME alone
  std::vector<std::string> picks = {};  // where points are seen: POINT=FRAME,x,y each
  int session = 0;                      // of these images
  std::optional<double> length = {};    // metres between length_from and length_to
  std::optional<double> tag_size = {};  // metres: tags of this size give the scale
  std::string tag_family = {};          // empty: as it is
  bool without_tags = false;
  // By hand, on top of the picks.
  bool back_to_picks = false;
  std::vector<double> at = {};    // x, y, z in metres; empty: as it is
  std::vector<double> turn = {};  // degrees: heading, then tilt and roll; empty: as it is
  std::optional<double> scale = {};
  bool on_floor = false;           // lays it on the floor that was found in the map
  std::vector<double> nudge = {};  // of the camera along its axes, metres; empty: as it is
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
  std::string clear = {};   // forgets where a point was picked at the place, or in frame alone
  std::string remove = {};  // a point, everywhere
  std::string rename = {};  // a point,
  std::string to = {};      // to this name
  bool lay = false;         // lays the stage of the place by the points
};

// Without a work: only the list.
struct OccluderOptions {
  std::filesystem::path project = {};
  std::string place = {};               // empty: the only one; of a list: all
  std::string add = {};                 // adds one of this name,
  std::string shape = {};               // which is a shape of this kind,
  std::filesystem::path model = {};     // or else this model
  std::string draw = {};                // draws one of this name, or goes on drawing it:
  std::vector<std::string> seen = {};   // FRAME,x,y,x,y,...: its corners in order; -,-: not seen
  int session = 0;                      // of these images
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

// Without a work: only the list. Of an object that is there, only what is given changes.
struct ObjectOptions {
  std::filesystem::path project = {};
  std::string add = {};     // adds one of this name
  std::string set = {};     // changes the one of this name
  std::string remove = {};  // removes it
  // One of them for one that is added.
  std::string model = {};              // of the built-in ones
  std::filesystem::path file = {};     // a model, with NAME.object.json beside it
  std::vector<double> at = {};         // x, y, z in metres; empty: as it is
  std::optional<double> heading = {};  // degrees about +Y
};

// All that is given is done, in this order; without any of it there is only the list.
struct SoundOptions {
  std::filesystem::path project = {};
  std::string bring = {};  // copies file into the project, as the sound of this name
  std::filesystem::path file = {};
  std::string place = {};                  // of the rest; empty: the only one
  std::string reverb = {};                 // stage::ReverbName()
  std::optional<double> reverb_gain = {};  // dB, of the late sound
  std::string remove_ambience = {};        // a sound that is always heard there
  std::string ambience = {};               // adds one, or changes it:
  std::optional<double> gain = {};         // dB
  std::vector<double> at = {};             // x, y, z in metres; empty: all around, or as it is
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

// Light probes from photographs, and those of places.
struct ProbeOptions {
  enum class Work { kInfo, kMerge, kBall, kMatch, kScale, kList, kAdd, kSet, kRemove };
  Work work = Work::kInfo;
  std::vector<std::filesystem::path> files = {};  // the probe, the picture or the photographs
  std::filesystem::path out = {};                 // .exr or, for a response, .json
  std::filesystem::path response = {};            // of the camera, .json: read by merge and ball
  std::filesystem::path response_out = {};        // written by merge
  std::vector<double> exposures = {};             // of each photograph; empty: from EXIF
  std::vector<double> circle = {};                // x, y, radius of the ball; empty: found
  double distance = 0.0;                          // of the ball, in its radii; 0: far
  double reflectance = 1.0;                       // of the ball
  int width = 512;                                // of the unwrapped probe
  std::vector<double> pairs = {};  // azimuth and elevation in the probe, then on the stage, degrees
  bool level = false;              // turn about the vertical only
  double turn = 0.0;               // degrees about the vertical, stage from probe
  std::vector<double> pixel = {};  // 8-bit R, G, B of a grey surface
  std::vector<double> gain = {1.0, 1.0, 1.0};
  std::vector<double> albedo = {0.18};
  std::vector<double> normal = {0.0, 1.0, 0.0};
  // Of one of a place; what is not given stays.
  std::filesystem::path project = {};
  std::string place = {};  // empty: the only one; of a list: all
  std::string name = {};
  std::vector<double> at = {};          // x, y, z in metres
  std::optional<double> hour = {};      // of the day, 0 to 24
  std::vector<double> rotation = {};    // degrees: heading, then tilt and roll
  std::optional<double> exposure = {};  // stops
  std::optional<double> warmth = {};    // WhiteBalance
  std::optional<double> tint = {};
};

}  // namespace lararium::app
