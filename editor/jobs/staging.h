#pragma once

// Prepares the content of a show from the document: resolves picks in the current map and collects
// baked products.

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "editor/document/project.h"
#include "editor/train/april_tags.h"
#include "editor/train/floor_plane.h"
#include "shared/capture/frame_source.h"
#include "shared/core/status.h"
#include "shared/geometry/camera_model.h"
#include "shared/show/show_content.h"
#include "shared/stage/picks.h"
#include "shared/stage/place.h"
#include "shared/vision/scene_database.h"

namespace lararium::editor {

// The floor and the scale in metres that a map provides by itself.
struct MapMeasures {
  std::optional<train::FloorPlane> floor;
  std::optional<train::TagScale> tags;  // The scale that the place's tags give.
  Status tag_problem;                   // Why the tags give no scale.
};

// Loads the trained map of a place.
Result<vision::SceneDatabase> LoadMap(const ProjectPaths& paths, const std::string& place);

// Takes seconds where tags are detected, milliseconds otherwise.
MapMeasures MeasureMap(const PlaceDocument& place, const vision::SceneDatabase& database);

// An initial stage for a map without picks. The ground is the floor, the origin lies on it below
// the mean of the points, and the scale is that of the tags. Without a floor, the cameras' mean up
// is +Y and their mean height 1.6 m; without tags, the points' median distance from the cameras is
// three metres.
geometry::Similarity3 GuessStage(const vision::SceneDatabase& database,
                                 const MapMeasures& measures);

// The stage from the picks, before the manual adjustment.
struct ResolvedPicks {
  geometry::Similarity3 map_from_picked;
  std::optional<stage::StageSolution> solution;  // Not set: there are no picks, or not enough.
  Status problem;                                // Why the picks or the tags give no stage.
};

// Uses GuessStage() where the picks give no stage.
ResolvedPicks ResolvePicks(const PlaceDocument& place,
                           const vision::SceneDatabase& database,
                           const MapMeasures& measures);

// The manual adjustment that levels the stage on the floor: the smallest rotation that makes it
// level, then a move along the floor's normal until the origin lies on the floor.
geometry::Similarity3 LayOnFloor(const geometry::Similarity3& map_from_picked,
                                 const geometry::Similarity3& picked_from_stage,
                                 const train::FloorPlane& floor);

// The distance of two points of the map in stage metres.
double StageDistance(const geometry::Similarity3& map_from_stage,
                     const Eigen::Vector3d& from_in_map,
                     const Eigen::Vector3d& to_in_map);

// The manual adjustment that gives the two points the distance metres, by scaling the stage about
// its origin. It is relative to the scale of the picks or tags, so it stays correct when training
// again changes the map unit. The points must differ, and metres must be above 0.
geometry::Similarity3 ScaledToDistance(const geometry::Similarity3& map_from_picked,
                                       const geometry::Similarity3& picked_from_stage,
                                       const Eigen::Vector3d& from_in_map,
                                       const Eigen::Vector3d& to_in_map,
                                       double metres);

// Combines picks, adjustment, nudge, occluders and light of a place. map_from_picked: from the
// resolved picks. map: for the uniform light where no probe can be used, and for drawn occluders,
// which are left out where the map has no images. Fails where something was not baked.
Result<stage::Place> StagePlace(const ProjectPaths& paths,
                                const PlaceDocument& place,
                                const vision::SceneDatabase& map,
                                const geometry::Similarity3& map_from_picked);

// The obstacles alone, in stage metres, without a map. The map is read only for drawn occluders,
// and it is an error when they exist but the place is not trained. Drawn occluders that are not
// complete are left out.
Result<stage::Place> StageObstacles(const ProjectPaths& paths, const PlaceDocument& place);

// Updates a staged occluder from its document: pose, size of a shape, and effects. Meshes of models
// and of drawn faces stay.
void Restage(const OccluderDocument& occluder,
             const geometry::Similarity3& map_from_stage,
             stage::Occluder& staged);

// Applies the present rotation, brightness and position of the probes to baked light: exact and
// fast. Leaves out probes that were not baked, or that were baked from another file.
std::vector<light::PlacedProbe> RelitProbes(std::span<const light::PlacedProbe> baked_light,
                                            std::span<const ProbeDocument> baked,
                                            std::span<const ProbeDocument> now);

// A trained place: its map, what the map provides, and the stage from the picks.
struct StagedMap {
  std::shared_ptr<const vision::SceneDatabase> database;
  MapMeasures measures;
  ResolvedPicks picks;
};

// Reads and measures the map. Fails where the place is not trained. Errors of picks and tags are in
// picks.problem.
Result<StagedMap> LoadStagedMap(const ProjectPaths& paths, const PlaceDocument& place);

// The project's baked objects.
Result<std::vector<show::StageObject>> LoadObjects(const ProjectPaths& paths,
                                                   const ProjectDocument& document);

// What to do with people who were never baked.
enum class Unbuilt { kFails, kStandsIn };

struct AssembleOptions {
  show::LanguageChoice languages = {};
  Unbuilt unbuilt = Unbuilt::kFails;
  float finest = 0.0f;  // The finest detail of the cast, as in show::LoadShowContent.
};

// Everything that a show needs at one place whose map is loaded and whose picks are resolved. Fails
// where something was not baked.
Result<show::ShowContent> AssembleShow(const ProjectPaths& paths,
                                       const ProjectDocument& document,
                                       const PlaceDocument& place,
                                       std::shared_ptr<const vision::SceneDatabase> database,
                                       const geometry::Similarity3& map_from_picked,
                                       const AssembleOptions& options = {});

// Reads the map from the project first. Picks that do not resolve are an error; a place without
// picks uses GuessStage().
Result<show::ShowContent> LoadShowContent(const ProjectPaths& paths,
                                          const ProjectDocument& document,
                                          const std::string& place_name,
                                          const show::LanguageChoice& languages = {});

Result<std::unique_ptr<capture::FrameSource>> OpenSource(const ProjectPaths& paths,
                                                         const SourceDocument& source);

}  // namespace lararium::editor
