#pragma once

// From the document to what can be shown: resolves picks in the map at hand and
// gathers what was baked.

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "editor/app/project.h"
#include "editor/train/april_tags.h"
#include "editor/train/floor_plane.h"
#include "shared/capture/frame_source.h"
#include "shared/core/status.h"
#include "shared/geometry/camera_model.h"
#include "shared/show/show_content.h"
#include "shared/stage/picks.h"
#include "shared/stage/place.h"
#include "shared/vision/scene_database.h"

namespace lararium::app {

// What a map says by itself about its ground and its metres.
struct MapMeasures {
  std::optional<train::FloorPlane> floor;
  std::optional<train::TagScale> tags;  // of the tags that the place names
  Status tag_problem;                   // why they give no scale
};

// The map that training gave a place.
Result<vision::SceneDatabase> LoadMap(const ProjectPaths& paths, const std::string& place);

// Takes seconds where tags are looked for, milliseconds otherwise.
MapMeasures MeasureMap(const PlaceDocument& place, const vision::SceneDatabase& database);

// A stage for a map without picks, to begin with. Its ground is the floor, the
// origin on it under the middle of the points, its metres those of the tags.
// Without a floor, the cameras' mean up is +Y and their mean height 1.6 m; without
// tags, the points' median distance from the cameras is three metres.
geometry::Similarity3 GuessStage(const vision::SceneDatabase& database,
                                 const MapMeasures& measures);

// Where the picks (before the adjustment by hand) put the stage.
struct ResolvedPicks {
  geometry::Similarity3 map_from_picked;
  std::optional<stage::StageSolution> solution;  // none where nothing was picked, or not enough
  Status problem;                                // why the picks or the tags give no stage
};

// Falls back to the guess where the picks give nothing.
ResolvedPicks ResolvePicks(const PlaceDocument& place,
                           const vision::SceneDatabase& database,
                           const MapMeasures& measures);

// The adjustment by hand that lays the stage on the floor: turned as little as
// makes it level, then moved along the floor's normal until its origin lies on it.
geometry::Similarity3 LayOnFloor(const geometry::Similarity3& map_from_picked,
                                 const geometry::Similarity3& picked_from_stage,
                                 const train::FloorPlane& floor);

// The distance of two points of the map as the stage's metres have it.
double StageDistance(const geometry::Similarity3& map_from_stage,
                     const Eigen::Vector3d& from_in_map,
                     const Eigen::Vector3d& to_in_map);

// The adjustment by hand with which that distance is so many metres: the stage scaled about its
// origin. It is relative to the metres of the picks or tags, and so stays right when training
// again gives the map another unit, as long as these give the same metres again.
// The points must be apart, metres above 0.
geometry::Similarity3 ScaledToDistance(const geometry::Similarity3& map_from_picked,
                                       const geometry::Similarity3& picked_from_stage,
                                       const Eigen::Vector3d& from_in_map,
                                       const Eigen::Vector3d& to_in_map,
                                       double metres);

// Picks, adjustment, nudge, occluders and light of a place. picks are resolved
// already. Fails where something was not baked.
// map: for the even light of places without a probe that can be used, and for occluders that
// were drawn on its images, which are left out of one without images.
Result<stage::Place> StagePlace(const ProjectPaths& paths,
                                const PlaceDocument& place,
                                const vision::SceneDatabase& map,
                                const geometry::Similarity3& map_from_picked);

// The same of what does not depend on the map: what is in the way, in stage metres. The map is
// read only where occluders were drawn, and missed where the place is not trained. Occluders that
// are not drawn to their end are not in the way.
Result<stage::Place> StageObstacles(const ProjectPaths& paths, const PlaceDocument& place);

// Brings an occluder of a place that is staged to what its document says now: where it lies, how
// large a shape is, and what it does. The meshes of models and of what was drawn stay.
void StageAnew(const OccluderDocument& occluder,
               const geometry::Similarity3& map_from_stage,
               stage::Occluder& staged);

// The light of probes that were baked, turned, brightened and moved as they are now: exact,
// and at once. Probes that were not baked, or from another file, are not there.
std::vector<light::PlacedProbe> RelitProbes(std::span<const light::PlacedProbe> baked_light,
                                            std::span<const ProbeDocument> baked,
                                            std::span<const ProbeDocument> now);

// A trained place with what its map says and where its picks put the stage.
struct StagedMap {
  std::shared_ptr<const vision::SceneDatabase> database;
  MapMeasures measures;
  ResolvedPicks picks;
};

// Reads and measures the map. Fails where the place is not trained; picks and tags
// that give nothing are in picks.problem.
Result<StagedMap> LoadStagedMap(const ProjectPaths& paths, const PlaceDocument& place);

// The project's objects as they were baked.
Result<std::vector<show::StageObject>> LoadObjects(const ProjectPaths& paths,
                                                   const ProjectDocument& document);

// What becomes of people who were never baked.
enum class Unbuilt { kFails, kStandsIn };

struct AssembleOptions {
  show::LanguageChoice languages = {};
  Unbuilt unbuilt = Unbuilt::kFails;
  float finest = 0.0f;  // of the cast, as show::LoadShowContent takes it
};

// Everything that a show needs at one place, whose map is at hand and whose picks
// are resolved. Fails where something was not baked.
Result<show::ShowContent> AssembleShow(const ProjectPaths& paths,
                                       const ProjectDocument& document,
                                       const PlaceDocument& place,
                                       std::shared_ptr<const vision::SceneDatabase> database,
                                       const geometry::Similarity3& map_from_picked,
                                       const AssembleOptions& options = {});

// The same with the map read from the project. Picks that do not resolve are an
// error here; a place without any is staged by the guess.
Result<show::ShowContent> LoadShowContent(const ProjectPaths& paths,
                                          const ProjectDocument& document,
                                          const std::string& place_name,
                                          const show::LanguageChoice& languages = {});

Result<std::unique_ptr<capture::FrameSource>> OpenSource(const ProjectPaths& paths,
                                                         const SourceDocument& source);

}  // namespace lararium::app
