#pragma once

// Options of the subcommands for real objects on the stage and for its light.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace lararium::editor {

// All given steps are performed in this order; without any, there is only a report.
struct StageOptions {
  std::filesystem::path project = {};
  std::string place = {};               // Empty: the only place.
  std::vector<std::string> clear = {};  // Removes picks: POINT for all images, or POINT=FRAME.
  std::vector<std::string> picks = {};  // Positions of points in images: POINT=FRAME,x,y.
  int session = 0;                      // Session of these images.
  std::optional<double> length = {};    // Metres between `length_from` and `length_to`.
  std::optional<double> tag_size = {};  // Metres; tags of this size give the scale.
  std::string tag_family = {};          // Empty: unchanged.
  bool without_tags = false;
  // Manual adjustments on top of the picks.
  bool back_to_picks = false;
  std::vector<double> at = {};    // x, y, z in metres; empty: unchanged.
  std::vector<double> turn = {};  // Degrees: heading, then tilt and roll; empty: unchanged.
  std::optional<double> scale = {};
  bool on_floor = false;           // Puts the stage on the floor that was detected in the map.
  std::vector<double> nudge = {};  // Relative to the camera axes, metres; empty: unchanged.
};

// Without an edit, the subcommand only reports.
struct CheckPointsOptions {
  std::filesystem::path project = {};
  std::string place = {};       // Empty: the only place; in a report, all.
  std::string set = {};         // Point to add or move.
  std::vector<double> at = {};  // Position of the point, x, y, z in metres; empty with `here`.
  bool here = false;            // Takes the position from the staging of the place.
  std::string pick = {};        // Point to pick in a training image.
  std::string frame = {};       // Name of the image.
  std::vector<double> pixel = {};
  int session = 0;
  std::string clear = {};   // Removes the picks of a point at the place, or only in `frame`.
  std::string remove = {};  // Point to remove everywhere.
  std::string rename = {};  // Point to rename to `to`.
  std::string to = {};      // New name.
  bool lay = false;         // Registers the stage of the place by the points.
};

// Without an edit, the subcommand only lists the occluders.
struct OccluderOptions {
  std::filesystem::path project = {};
  std::string place = {};               // Empty: the only place; in a list, all.
  std::string add = {};                 // Name of an occluder to add.
  std::string shape = {};               // Kind of shape of the new occluder.
  std::filesystem::path model = {};     // Model of the new occluder instead of a shape.
  std::string draw = {};                // Name of an occluder to draw, or continue.
  std::vector<std::string> seen = {};   // FRAME,x,y,x,y,...: corners in order; "-,-": not visible.
  int session = 0;                      // Session of these images.
  std::string set = {};                 // Name of an occluder to change.
  std::string remove = {};              // Name of an occluder to remove.
  std::vector<std::string> sizes = {};  // NAME=METRES, sizes of a shape.
  std::vector<double> at = {};          // x, y, z in metres; empty: unchanged.
  std::vector<double> turn = {};        // Degrees: heading, then tilt and roll; empty: unchanged.
  std::optional<double> scale = {};
  std::string receives_shadow = {};  // "yes" or "no"; empty: unchanged.
  std::string blocks_sound = {};     // "yes" or "no"; empty: unchanged.
  std::string blocks_walking = {};   // "yes" or "no"; empty: unchanged.
};

// Without an edit, the subcommand only lists the objects. For an existing object, only the
// given properties change.
struct ObjectOptions {
  std::filesystem::path project = {};
  std::string add = {};     // Name of an object to add.
  std::string set = {};     // Name of an object to change.
  std::string remove = {};  // Name of an object to remove.
  // A new object needs one of these two.
  std::string model = {};              // Name of an object of the library.
  std::filesystem::path file = {};     // Model file, with NAME.object.json beside it.
  std::vector<double> at = {};         // x, y, z in metres; empty: unchanged.
  std::optional<double> heading = {};  // Degrees about +Y.
};

// All given edits are performed in this order; without any, there is only a list.
struct SoundOptions {
  std::filesystem::path project = {};
  std::string bring = {};  // Name under which `file` is copied into the project.
  std::filesystem::path file = {};
  std::string place = {};                  // Place of the following edits; empty: the only one.
  std::string reverb = {};                 // stage::ReverbName()
  std::optional<double> reverb_gain = {};  // dB, gain of the late reverberation.
  std::string remove_ambience = {};        // Ambient sound to remove from the place.
  std::string ambience = {};               // Ambient sound to add or change.
  std::optional<double> gain = {};         // dB
  std::vector<double> at = {};  // x, y, z in metres; empty: from all around, or unchanged.
};

// All given steps are performed in this order; without any, there is only a report.
struct AlignOptions {
  std::filesystem::path project = {};
  std::string place = {};  // Empty: the only place.
  std::string occluder = {};
  std::optional<int> remove = {};       // Number of a pair to remove, from 1.
  std::vector<double> pair = {};        // Adds a pair: x, y, z in axes and unit of the mesh.
  std::vector<std::string> picks = {};  // Positions of the new pair in images: FRAME,x,y.
  int session = 0;                      // Session of these images.
  std::optional<bool> keep_scale = {};  // Says that the scale of the model is correct.
  bool by_points = false;               // Aligns the model by the pairs.
  bool refine = false;                  // Refines the pose by the points of the map afterwards.
  // Metres of the model for refining; none: the default of train.
  std::optional<double> within = {};
  std::optional<bool> flat = {};  // Moves the corners of a drawn occluder to their plane.
};

// Makes light probes from photographs, and edits those of places.
struct ProbeOptions {
  enum class Work { kInfo, kMerge, kBall, kMatch, kScale, kList, kAdd, kSet, kRemove };
  Work work = Work::kInfo;
  std::vector<std::filesystem::path> files = {};  // The probe, the picture or the photographs.
  std::filesystem::path out = {};                 // .exr or, for a response, .json.
  std::filesystem::path response = {};      // Camera response (.json), read by merge and ball.
  std::filesystem::path response_out = {};  // Camera response, written by merge.
  std::vector<double> exposures = {};       // One per photograph; empty: EXIF data.
  std::vector<double> circle = {};          // x, y, radius of the ball; empty: detected.
  double distance = 0.0;                    // Distance of the ball in its radii; 0: far.
  double reflectance = 1.0;                 // Reflectance of the ball.
  int width = 512;                          // Width of the unwrapped probe.
  // Degrees: azimuth and elevation in the probe, then on the stage.
  std::vector<double> pairs = {};
  bool level = false;              // Turn about the vertical only.
  double turn = 0.0;               // Degrees about the vertical, stage from probe.
  std::vector<double> pixel = {};  // 8-bit R, G, B of a grey surface.
  std::vector<double> gain = {1.0, 1.0, 1.0};
  std::vector<double> albedo = {0.18};
  std::vector<double> normal = {0.0, 1.0, 0.0};
  // Fields of a probe of a place; those that are not given stay.
  std::filesystem::path project = {};
  std::string place = {};  // Empty: the only place; in a list, all.
  std::string name = {};
  std::vector<double> at = {};          // x, y, z in metres
  std::optional<double> hour = {};      // Hour of the day, 0 to 24.
  std::vector<double> rotation = {};    // Degrees: heading, then tilt and roll.
  std::optional<double> exposure = {};  // stops
  std::optional<double> warmth = {};    // See WhiteBalance, like `tint`.
  std::optional<double> tint = {};
};

}  // namespace lararium::editor
