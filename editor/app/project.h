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

#include "editor/app/cast_document.h"
#include "editor/app/object_document.h"
#include "editor/app/occluder_shape.h"
#include "editor/bake/line_table.h"
#include "shared/core/json.h"
#include "shared/core/status.h"
#include "shared/geometry/camera_model.h"
#include "shared/geometry/transform.h"
#include "shared/light/camera_traits.h"
#include "shared/light/probe_blend.h"
#include "shared/stage/acoustics.h"
#include "shared/stage/picks.h"

namespace lararium::app {

inline constexpr int kProjectSchema = 1;

// A recording. Its path is relative to the project's folder, or absolute.
struct SourceDocument {
  enum class Kind { kNone, kVideo, kImages };
  Kind kind = Kind::kNone;
  std::string path;

  bool empty() const { return kind == Kind::kNone; }
};

// A point of an occluder's model and where it was picked in the training images, to lay the model
// by (occluder_alignment.h). Picks outlive the map, so training again keeps them.
struct ModelPairDocument {
  Eigen::Vector3d on_mesh = Eigen::Vector3d::Zero();  // in the mesh's axes and unit
  stage::Anchor anchor;
};
inline constexpr size_t kMaxModelPairs = 64;

// The name of a pair in errors: "point 1" and so on.
std::string ModelPairName(size_t index);

// Something real that hides people: a model, a shape of given sizes, or a face that was drawn on
// training images.
struct OccluderDocument {
  enum class Kind { kModel, kShape, kDrawn };
  std::string name;
  std::string file;                       // of a model: any format that the editor imports
  std::optional<OccluderShape> shape;     // of a shape
  geometry::Similarity3 stage_from_mesh;  // of a model and a shape
  // What it does besides hiding people.
  bool receives_shadow = true;  // shadows of people and light of lamps are seen on it
  bool blocks_sound = true;
  bool blocks_walking = true;
  // Of one that is drawn: the corners of its face, in their order around it, each picked in two
  // or more training images. They are located in the map at hand, so that training again keeps
  // them (drawn_occluder.h).
  std::vector<stage::Anchor> corners;
  double depth = 0.0;  // metres that it goes on behind that face; 0: the face alone
  bool flat = false;   // its corners are laid onto the plane that fits them best
  // Of a model: what it is aligned by.
  std::vector<ModelPairDocument> model_pairs;
  bool keep_scale = false;  // its scale is right: aligning leaves it

  Kind kind() const { return shape ? Kind::kShape : file.empty() ? Kind::kDrawn : Kind::kModel; }
  bool drawn() const { return kind() == Kind::kDrawn; }
};

// A new one of that shape: a floor is not in the way of sounds and people.
OccluderDocument NewOccluder(const std::string& name, const OccluderShape& shape);

// Of the corners of one occluder.
inline constexpr size_t kMaxCorners = 64;
inline constexpr double kMaxDepth = 1e3;  // metres

// The name of an occluder's corner in errors: "corner 1" and so on.
std::string CornerName(size_t index);

// A recording of the place in other light, merged into the map of the first.
struct SessionDocument {
  SourceDocument source;
  std::optional<geometry::CameraModel> intrinsics;  // none: training estimates them
};

// AprilTags of one size in the training images, which give the map its metres.
// They are looked for in the map at hand, so that training again keeps the scale.
struct TagsDocument {
  std::string family = "tag36h11";  // one of train::TagFamilies()
  double size_m = 0.0;              // see train::TagOptions
};

// An equirectangular image of the light at a point of the stage and a time of day.
struct ProbeDocument {
  std::string name;  // unique in its place
  std::string file;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // metres, stage axes
  double hour = light::kNoon;                          // of the day, 0 to 24
  Eigen::Quaterniond stage_from_probe = Eigen::Quaterniond::Identity();
  double scale = 1.0;  // radiance of the stage over radiance of the file
  Eigen::Vector3d balance = Eigen::Vector3d::Ones();  // of the channels beyond that
};

// Picks with the names of their anchors set and nothing picked.
stage::StagePicks EmptyPicks();

// A point of the stage that is looked for at each place, to see whether the stage lies there as it
// should (check_points.h): what surveyors call a check point. No picks tie the stage to it.
struct CheckPointDocument {
  std::string name;                                    // unique; any text
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // metres, stage axes
};
inline constexpr size_t kMaxCheckPoints = 256;
inline constexpr size_t kMaxCheckPointName = 200;  // bytes

// A map holds at most 32 sessions.
inline constexpr size_t kMaxAddedSessions = 31;

// Of the adjustment by hand, as people may set it.
inline constexpr double kMinStageScale = 1e-4;
inline constexpr double kMaxStageScale = 1e4;

struct PlaceDocument {
  std::string name;
  SourceDocument training;
  SourceDocument preview;  // what the editor's camera view plays; none: the training
  std::optional<geometry::CameraModel> intrinsics;  // none: training estimates them
  // Recorded after the first, in their order: entry i is session i + 1 of the map,
  // the training recording is session 0.
  std::vector<SessionDocument> added;
  std::optional<TagsDocument> tags;  // none: the picks' known length gives the metres
  stage::StagePicks picks = EmptyPicks();
  // By hand, on top of the picks: the stage that they give from the stage itself.
  geometry::Similarity3 picked_from_stage;
  Eigen::Vector3d camera_nudge = Eigen::Vector3d::Zero();  // metres, camera axes
  // What the recordings' images are like, measured; none: people stay sharp and clean.
  std::optional<light::CameraTraits> camera;
  std::vector<OccluderDocument> occluders;
  std::vector<ProbeDocument> probes;  // none: even light
  stage::Acoustics acoustics;
  // Where the project's check points were picked here; the anchors have their names.
  std::vector<stage::Anchor> check_picks;

  const OccluderDocument* FindOccluder(std::string_view occluder) const;
  OccluderDocument* FindOccluder(std::string_view occluder);
};

// Of all of a place, for errors: "a, b".
std::string OccluderNames(const PlaceDocument& place);

// The languages of the drama, of those of its lines. The first of each is what visitors hear
// and read unless they choose another.
struct SpeechDocument {
  std::vector<std::string> spoken;       // voices are baked in these; none: the first of the lines
  std::vector<std::string> captions;     // none: all of the lines
  bake::VoiceSettings description = {};  // of what is described, where it is not recorded

  bool empty() const {
    return spoken.empty() && captions.empty() && description == bake::VoiceSettings();
  }
};

// All that a curator edits, but the drama, which is a file of its own.
struct ProjectDocument {
  std::string title;
  std::string credits;
  std::vector<PlaceDocument> places;
  std::vector<CastDocument> cast;
  std::vector<ObjectDocument> objects;
  std::vector<CheckPointDocument> check_points;
  SpeechDocument speech;
  // The table of lines while a window has the project open: a file of its own, which
  // project.json knows nothing of. nullptr: not read, or it cannot be.
  std::shared_ptr<const bake::LineTable> lines = nullptr;

  const PlaceDocument* FindPlace(std::string_view name) const;
  PlaceDocument* FindPlace(std::string_view name);
};

// Forgets a further recording of a place, from 1 on, and what was picked in it; the numbers of
// those after it, in picks too, move up. Nothing where there is none of that number.
void ForgetSession(PlaceDocument& place, uint32_t session);

// Where things lie in a project's folder.
struct ProjectPaths {
  std::filesystem::path folder;

  std::filesystem::path Project() const { return folder / "project.json"; }
  // What was edited; exists only between an edit and its saving (journal.h).
  std::filesystem::path Journal() const { return folder / "journal"; }
  std::filesystem::path Drama() const { return folder / "drama.lua"; }
  std::filesystem::path Cast() const { return folder / "cast"; }
  std::filesystem::path Human(const std::string& cast_name) const {
    return Cast() / (cast_name + ".larhuman");
  }
  // The same with its light transfer, which takes longer to bake.
  std::filesystem::path LitHuman(const std::string& cast_name) const {
    return Cast() / (cast_name + ".lit.larhuman");
  }
  std::filesystem::path Prop(const std::string& object) const {
    return folder / "props" / (object + ".larprop");
  }
  // A line as it was baked in one language: with ".flac" its sound, with ".visemes.json"
  // what the mouth does.
  std::filesystem::path Speech(const std::string& language, const std::string& file) const {
    return folder / "speech" / language / file;
  }
  // What the author has of it: audio/LANGUAGE/LINE.wav and the like.
  std::filesystem::path Recordings(const std::string& language) const {
    return folder / "audio" / language;
  }
  // A built-in sound as it was baked.
  std::filesystem::path Sound(const std::string& name) const {
    return folder / "sounds" / (name + ".flac");
  }
  std::filesystem::path Place(const std::string& name) const { return folder / "places" / name; }
  std::filesystem::path Scene(const std::string& place) const {
    return Place(place) / "scene.larscene";
  }

  // The file that a path of the document means, and the path to write for a file.
  std::filesystem::path Resolve(const std::string& path) const;
  std::string Shorten(const std::filesystem::path& file) const;
};

// Every field is checked; fields that this version does not know are an error,
// so that saving never drops them. place: what errors call the text.
Result<ProjectDocument> ParseProject(const Json& json, const std::string& place);
Json FormatProject(const ProjectDocument& document);
Json FormatPicks(const stage::StagePicks& picks);
Json FormatOccluder(const OccluderDocument& occluder);

Result<ProjectDocument> LoadProject(const ProjectPaths& paths);
Status SaveProject(const ProjectPaths& paths, const ProjectDocument& document);

// Makes the folder with an empty drama, no place and no cast. Refuses a
// folder that has something in it.
Status CreateProject(const ProjectPaths& paths, const std::string& title);

// One Status for each file that the project needs and that is not there (missing_files.h).
std::vector<Status> FindMissingFiles(const ProjectPaths& paths, const ProjectDocument& document);

}  // namespace lararium::app
