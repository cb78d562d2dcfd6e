#pragma once

// A project on disk: the folder NAME.lararium with project.json, drama.lua,
// cast/ and places/NAME/ (docs/file-formats.md).

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "editor/bake/line_table.h"
#include "editor/document/cast_document.h"
#include "editor/document/object_document.h"
#include "editor/document/occluder_shape.h"
#include "editor/document/project_paths.h"
#include "shared/core/json.h"
#include "shared/core/status.h"
#include "shared/geometry/camera_model.h"
#include "shared/geometry/transform.h"
#include "shared/light/camera_traits.h"
#include "shared/light/probe_blend.h"
#include "shared/stage/acoustics.h"
#include "shared/stage/picks.h"

namespace lararium::editor {

inline constexpr int kProjectSchema = 1;

// A recording. Its path is relative to the project's folder, or absolute.
struct SourceDocument {
  enum class Kind { kNone, kVideo, kImages };
  Kind kind = Kind::kNone;
  std::string path;

  bool empty() const { return kind == Kind::kNone; }
};

// A point of an occluder's model, and the picks of the same point in the training images. Pairs
// align the model (occluder_alignment.h). Picks refer to images, not to the map, so that training
// again keeps them.
struct ModelPairDocument {
  Eigen::Vector3d on_mesh = Eigen::Vector3d::Zero();  // Axes and unit of the mesh.
  stage::Anchor anchor;
};
inline constexpr size_t kMaxModelPairs = 64;

// The name of a pair in errors, for example "point 1".
std::string ModelPairName(size_t index);

// A real object that hides people: a model, a shape of given sizes, or a face that was drawn on
// training images.
struct OccluderDocument {
  enum class Kind { kModel, kShape, kDrawn };
  std::string name;
  std::string file;                       // Models only: any format that the editor imports.
  std::optional<OccluderShape> shape;     // Shapes only.
  geometry::Similarity3 stage_from_mesh;  // Models and shapes only.
  // Effects beside hiding people.
  bool receives_shadow = true;  // Shadows of people and the light of lamps appear on it.
  bool blocks_sound = true;
  bool blocks_walking = true;
  // For a drawn face: its corners, in order around the face, each picked in two or more training
  // images. They are triangulated in the current map, so that training again keeps them
  // (drawn_occluder.h).
  std::vector<stage::Anchor> corners;
  // Metres by which the occluder extends behind the drawn face; 0: only the face.
  double depth = 0.0;
  bool flat = false;  // Projects the corners onto the plane that fits them best.
  // For a model: the point pairs that align it.
  std::vector<ModelPairDocument> model_pairs;
  bool keep_scale = false;  // The scale is known; aligning does not change it.

  Kind kind() const { return shape ? Kind::kShape : file.empty() ? Kind::kDrawn : Kind::kModel; }
  bool drawn() const { return kind() == Kind::kDrawn; }
};

// A new occluder of that shape. A floor does not block sounds or people.
OccluderDocument NewOccluder(const std::string& name, const OccluderShape& shape);

// Limit for the corners of one drawn occluder.
inline constexpr size_t kMaxCorners = 64;
inline constexpr double kMaxDepth = 1e3;  // metres

// The name of a corner in errors, for example "corner 1".
std::string CornerName(size_t index);

// A recording of the place in other light, merged into the map of the first recording.
struct SessionDocument {
  SourceDocument source;
  std::optional<geometry::CameraModel> intrinsics;  // Not set: training estimates them.
};

// AprilTags of one size in the training images, which give the map its scale in metres. They are
// detected with the current map, so that training again keeps the scale.
struct TagsDocument {
  std::string family = "tag36h11";  // One of train::TagFamilies().
  double size_m = 0.0;              // Side length; see train::TagOptions.
};

// An equirectangular image of the light at a point of the stage and a time of day.
struct ProbeDocument {
  std::string name;  // Unique within its place.
  std::string file;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // Metres, stage axes.
  double hour = light::kNoon;                          // The hour of the day, 0 to 24.
  Eigen::Quaterniond stage_from_probe = Eigen::Quaterniond::Identity();
  double scale = 1.0;  // Radiance of the stage divided by radiance of the file.
  // Factors for the three colour channels, in addition to the scale.
  Eigen::Vector3d balance = Eigen::Vector3d::Ones();
};

// Picks whose anchors have their names but no images.
stage::StagePicks EmptyPicks();

// A check point, in the sense of surveying: a point of the stage that is picked at each place to
// verify where the stage lies (check_points.h). The stage is not computed from it.
struct CheckPointDocument {
  std::string name;                                    // Any text; unique within the project.
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // Metres, stage axes.
};
inline constexpr size_t kMaxCheckPoints = 256;
inline constexpr size_t kMaxCheckPointName = 200;  // bytes

// A map holds at most 32 sessions.
inline constexpr size_t kMaxAddedSessions = 31;

// Limits of the scale in the manual adjustment of the stage.
inline constexpr double kMinStageScale = 1e-4;
inline constexpr double kMaxStageScale = 1e4;

struct PlaceDocument {
  std::string name;   // The name of its folder, and in scripts.
  std::string title;  // The name in the interface; empty: the same as `name`.
  SourceDocument training;
  // The recording in the editor's camera view. Empty: the training recording.
  SourceDocument preview;
  std::optional<geometry::CameraModel> intrinsics;  // Not set: training estimates them.
  // Later recordings, in order: entry i is session i + 1 of the map. Session 0 is the training
  // recording.
  std::vector<SessionDocument> added;
  std::optional<TagsDocument> tags;  // Not set: the known length among the picks gives the scale.
  stage::StagePicks picks = EmptyPicks();
  // Manual adjustment on top of the picks: maps the stage frame to the frame that the picks define.
  geometry::Similarity3 picked_from_stage;
  Eigen::Vector3d camera_nudge = Eigen::Vector3d::Zero();  // Metres, camera axes.
  // Measured properties of the recordings' images (blur, noise). Not set: people are drawn sharp
  // and clean.
  std::optional<light::CameraTraits> camera;
  std::vector<OccluderDocument> occluders;
  std::vector<ProbeDocument> probes;  // Empty: uniform light.
  stage::Acoustics acoustics;
  // Picks of the project's check points at this place. An anchor has the name of its check point.
  std::vector<stage::Anchor> check_picks;

  const std::string& label() const { return title.empty() ? name : title; }
  const OccluderDocument* FindOccluder(std::string_view occluder) const;
  OccluderDocument* FindOccluder(std::string_view occluder);
};

// The names of all occluders of a place, for errors: "a, b".
std::string OccluderNames(const PlaceDocument& place);

// The languages of the drama, out of those in the table of lines. Visitors hear and read the first
// of each list unless they choose another.
struct SpeechDocument {
  // Languages in which voices are baked. Empty: the first language of the lines.
  std::vector<std::string> spoken;
  std::vector<std::string> captions;     // Empty: all languages of the lines.
  bake::VoiceSettings description = {};  // The voice of audio descriptions that are not recorded.

  bool empty() const {
    return spoken.empty() && captions.empty() && description == bake::VoiceSettings();
  }
};

// Everything that a curator edits, except the drama, which is a separate file.
struct ProjectDocument {
  std::string title;
  std::string credits;
  std::vector<PlaceDocument> places;
  std::vector<CastDocument> cast;
  std::vector<ObjectDocument> objects;
  std::vector<CheckPointDocument> check_points;
  SpeechDocument speech;
  // The table of lines while a window has the project open. It is a separate file, not part of
  // project.json. nullptr: not read, or not readable.
  std::shared_ptr<const bake::LineTable> lines = nullptr;

  const PlaceDocument* FindPlace(std::string_view name) const;
  PlaceDocument* FindPlace(std::string_view name);
  // The title of the person with a name of the drama; the name itself where there is none.
  std::string PersonLabel(const std::string& name) const;
};

// Removes an added recording of a place (session: 1 or higher) and the picks in it. Later sessions,
// also those of the picks, move down by one number. Does nothing where there is no such session.
void ForgetSession(PlaceDocument& place, uint32_t session);

// Checks every field. Unknown fields are an error, so that saving never drops them. where: the name
// of the text in errors.
Result<ProjectDocument> ParseProject(const Json& json, const std::string& where);
Json FormatProject(const ProjectDocument& document);
Json FormatPicks(const stage::StagePicks& picks);
void DescribeFields(Fields& fields, OccluderDocument& occluder);
void DescribeFields(Fields& fields, ProbeDocument& probe);

Result<ProjectDocument> LoadProject(const ProjectPaths& paths);
Status SaveProject(const ProjectPaths& paths, const ProjectDocument& document);

// Makes the folder with an empty drama, no place and no cast. Fails where the folder exists and is
// not empty.
Status CreateProject(const ProjectPaths& paths, const std::string& title);

// One Status for each missing file that the project needs (missing_files.h).
std::vector<Status> FindMissingFiles(const ProjectPaths& paths, const ProjectDocument& document);

// The name of the place that an option gives by its name or title, or of the only one.
Result<std::string> ChoosePlace(const ProjectPaths& paths,
                                const ProjectDocument& document,
                                const std::string& name);

}  // namespace lararium::editor
