#include "editor/jobs/staging.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "editor/jobs/baking.h"
#include "editor/jobs/drawn_occluder.h"
#include "editor/jobs/lines.h"
#include "editor/jobs/object_pose.h"
#include "editor/jobs/paradata.h"
#include "editor/jobs/shared_people.h"
#include "editor/jobs/sounds.h"
#include "shared/core/file.h"
#include "shared/geometry/glm_convert.h"
#include "shared/geometry/transform.h"
#include "shared/stage/object_use.h"

namespace lararium::editor {

namespace {

using Eigen::Vector3d;
using geometry::Similarity3;

// The median of each coordinate, which outliers do not affect.
Vector3d MedianPoint(const std::vector<Eigen::Vector3f>& points) {
  Vector3d median = Vector3d::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<float> values;
    values.reserve(points.size());
    for (const Eigen::Vector3f& point : points) {
      values.push_back(point[axis]);
    }
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    median[axis] = *middle;
  }
  return median;
}

bool AnythingPicked(const stage::StagePicks& picks) {
  return !picks.origin.picks.empty() || !picks.forward.picks.empty() ||
         !picks.floor.picks.empty() || !picks.length_from.picks.empty() ||
         !picks.length_to.picks.empty();
}

}  // namespace

MapMeasures MeasureMap(const PlaceDocument& place, const vision::SceneDatabase& database) {
  MapMeasures measures;
  measures.floor = train::FindFloor(database);
  if (place.tags) {
    Result<train::TagScale> tags =
        train::MeasureTagScale(database, {place.tags->family, place.tags->size_m});
    if (tags.ok()) {
      measures.tags = std::move(*tags);
    } else {
      measures.tag_problem = tags.status().At(place.name);
    }
  }
  return measures;
}

Similarity3 GuessStage(const vision::SceneDatabase& database, const MapMeasures& measures) {
  if (database.points.empty() || database.keyframes.empty()) {
    return {};
  }
  constexpr double kTypicalDistance = 3.0;  // Metres.
  constexpr double kEyeHeight = 1.6;
  const Vector3d middle = MedianPoint(database.points);
  Vector3d up = Vector3d::Zero();
  Vector3d center = Vector3d::Zero();
  std::vector<double> distances;
  for (const vision::Keyframe& keyframe : database.keyframes) {
    const Eigen::Quaterniond map_from_camera = keyframe.camera_from_map.rotation.conjugate();
    up -= map_from_camera * Vector3d::UnitY();
    center += keyframe.camera_from_map.Center();
    distances.push_back((keyframe.camera_from_map.Center() - middle).norm());
  }
  center /= static_cast<double>(database.keyframes.size());
  std::nth_element(distances.begin(), distances.begin() + distances.size() / 2, distances.end());
  const double guessed_scale = std::max(distances[distances.size() / 2], 1e-9) / kTypicalDistance;
  const double scale = measures.tags ? 1.0 / measures.tags->metres_per_unit : guessed_scale;
  Vector3d y = up.norm() > 1e-9 ? up.normalized() : Vector3d(-Vector3d::UnitY());
  double ground = (center - middle).dot(y) - kEyeHeight * scale;  // Height above middle, map units.
  if (measures.floor) {
    y = measures.floor->normal;
    ground = -measures.floor->Height(middle);
  }
  const Vector3d away = center - middle;  // Towards the viewers, +Z.
  Vector3d z = away - away.dot(y) * y;
  z = z.norm() > 1e-9 ? z.normalized() : y.unitOrthogonal();
  Eigen::Matrix3d rotation;
  rotation << y.cross(z), y, z;
  return {scale, Eigen::Quaterniond(rotation).normalized(), middle + ground * y};
}

ResolvedPicks ResolvePicks(const PlaceDocument& place,
                           const vision::SceneDatabase& database,
                           const MapMeasures& measures) {
  ResolvedPicks resolved;
  resolved.map_from_picked = GuessStage(database, measures);
  resolved.problem = measures.tag_problem;
  if (!AnythingPicked(place.picks)) {
    return resolved;
  }
  std::optional<double> map_units_per_metre;
  if (measures.tags) {
    map_units_per_metre = 1.0 / measures.tags->metres_per_unit;
  }
  Result<stage::StageSolution> solution =
      stage::SolveStage(place.picks, database, map_units_per_metre);
  if (!solution) {
    resolved.problem = solution.status().At("picks of " + place.name);
    return resolved;
  }
  resolved.map_from_picked = solution->map_from_stage;
  resolved.solution = std::move(*solution);
  return resolved;
}

Similarity3 LayOnFloor(const Similarity3& map_from_picked,
                       const Similarity3& picked_from_stage,
                       const train::FloorPlane& floor) {
  const Vector3d normal = map_from_picked.rotation.conjugate() * floor.normal;
  const Vector3d up = picked_from_stage.rotation * Vector3d::UnitY();
  const double height =
      floor.Height(map_from_picked * picked_from_stage.translation) / map_from_picked.scale;
  Similarity3 laid = picked_from_stage;
  laid.rotation = (geometry::RotationBetween(normal, up) * picked_from_stage.rotation).normalized();
  laid.translation -= height * normal;
  return laid;
}

namespace {

// metre: the length of a metre, map units.
Result<geometry::TriangleMesh> OccluderMesh(const ProjectPaths& paths,
                                            const PlaceDocument& place,
                                            const OccluderDocument& occluder,
                                            const vision::SceneDatabase& map,
                                            double metre) {
  switch (occluder.kind()) {
    case OccluderDocument::Kind::kModel:
      return LoadBakedMesh(paths, place, occluder);
    case OccluderDocument::Kind::kShape:
      return MakeShapeMesh(*occluder.shape);
    case OccluderDocument::Kind::kDrawn:
      break;
  }
  LARARIUM_ASSIGN_OR_RETURN(DrawnOccluder drawn, DrawOccluder(occluder, map, metre));
  return std::move(drawn.mesh_in_map);
}

}  // namespace

void Restage(const OccluderDocument& occluder,
             const Similarity3& map_from_stage,
             stage::Occluder& staged) {
  if (occluder.shape) {
    staged.mesh = MakeShapeMesh(*occluder.shape);
  }
  staged.stage_from_mesh = occluder.drawn() ? map_from_stage.Inverse() : occluder.stage_from_mesh;
  staged.blocks_sound = occluder.blocks_sound;
  staged.blocks_walking = occluder.blocks_walking;
  staged.receives_shadow = occluder.receives_shadow;
}

double StageDistance(const Similarity3& map_from_stage,
                     const Vector3d& from_in_map,
                     const Vector3d& to_in_map) {
  return (to_in_map - from_in_map).norm() / map_from_stage.scale;
}

Similarity3 ScaledToDistance(const Similarity3& map_from_picked,
                             const Similarity3& picked_from_stage,
                             const Vector3d& from_in_map,
                             const Vector3d& to_in_map,
                             double metres) {
  Similarity3 scaled = picked_from_stage;
  scaled.scale *=
      StageDistance(map_from_picked * picked_from_stage, from_in_map, to_in_map) / metres;
  return scaled;
}

Result<stage::Place> StagePlace(const ProjectPaths& paths,
                                const PlaceDocument& place,
                                const vision::SceneDatabase& map,
                                const Similarity3& map_from_picked) {
  stage::Place staged;
  staged.name = place.name;
  staged.map_from_stage = map_from_picked * place.picked_from_stage;
  staged.camera_nudge = place.camera_nudge;
  staged.camera = place.camera;
  for (const OccluderDocument& occluder : place.occluders) {
    if (occluder.drawn() && map.keyframes.empty()) {
      continue;
    }
    LARARIUM_ASSIGN_OR_RETURN(
        geometry::TriangleMesh mesh,
        OccluderMesh(paths, place, occluder, map, staged.map_from_stage.scale));
    stage::Occluder& made = staged.occluders.emplace_back();
    made.name = occluder.name;
    made.mesh = std::move(mesh);
    Restage(occluder, staged.map_from_stage, made);
  }
  LARARIUM_ASSIGN_OR_RETURN(staged.probes, LoadBakedProbes(paths, place, EvenRadiance(map)));
  staged.acoustics = place.acoustics;
  return staged;
}

Result<stage::Place> StageObstacles(const ProjectPaths& paths, const PlaceDocument& place) {
  const bool any_drawn = std::any_of(place.occluders.begin(), place.occluders.end(),
                                     [](const OccluderDocument& o) { return o.drawn(); });
  if (!any_drawn || !FileExists(paths.Scene(place.name))) {
    return StagePlace(paths, place, {}, {});
  }
  LARARIUM_ASSIGN_OR_RETURN(const StagedMap map, LoadStagedMap(paths, place));
  // While a user draws an occluder, the rest of the stage stays usable.
  return StagePlace(paths, WithoutDrafts(place, *map.database), *map.database,
                    map.picks.map_from_picked);
}

std::vector<light::PlacedProbe> RelitProbes(std::span<const light::PlacedProbe> baked_light,
                                            std::span<const ProbeDocument> baked,
                                            std::span<const ProbeDocument> now) {
  if (now.empty() || baked_light.size() != baked.size()) {
    return {baked_light.begin(), baked_light.end()};
  }
  std::vector<light::PlacedProbe> relit;
  for (const ProbeDocument& probe : now) {
    for (size_t i = 0; i < baked.size(); ++i) {
      const ProbeDocument& before = baked[i];
      if (before.name != probe.name || before.file != probe.file || !(before.scale > 0.0)) {
        continue;
      }
      const Eigen::Quaterniond turn = probe.stage_from_probe * before.stage_from_probe.conjugate();
      light::PlacedProbe& placed = relit.emplace_back(baked_light[i]);
      placed.position = geometry::ToGlm(probe.position);
      placed.hour = probe.hour;
      placed.light = light::Balanced(light::Placed(placed.light, geometry::ToGlm(turn),
                                                   static_cast<float>(probe.scale / before.scale)),
                                     geometry::ToGlm(probe.balance.cwiseQuotient(before.balance)));
    }
  }
  return relit;
}

Result<std::vector<show::StageObject>> LoadObjects(const ProjectPaths& paths,
                                                   const ProjectDocument& document) {
  std::vector<show::StageObject> objects;
  for (const ObjectDocument& object : document.objects) {
    LARARIUM_ASSIGN_OR_RETURN(stage::Prop prop, LoadBakedProp(paths, object));
    LARARIUM_ASSIGN_OR_RETURN(auto model, stage::ObjectModel::Create(std::move(prop), object.name));
    auto light = show::TakeLight(model->light());
    objects.push_back({object.name, std::move(model), InitialPose(object), std::move(light)});
  }
  return objects;
}

namespace {

// Uses the plain figure for a person who was not baked, unless options.unbuilt is kFails.
Result<show::CastMember> LoadMember(const ProjectPaths& paths,
                                    const CastDocument& member,
                                    const AssembleOptions& options) {
  Result<show::CastMember> baked = ShareBakedHuman(paths, member, options.finest);
  if (baked.ok() || options.unbuilt == Unbuilt::kFails) {
    return baked;
  }
  LARARIUM_ASSIGN_OR_RETURN(human::Human figure, MakeStandIn(paths, member));
  return show::CastMember{member.name, std::make_shared<const human::Human>(std::move(figure))};
}

Status LoadCast(const ProjectPaths& paths,
                const ProjectDocument& document,
                const AssembleOptions& options,
                show::ShowContent& content) {
  if (options.finest > 0.0f) {
    std::vector<std::filesystem::path> files;
    for (const CastDocument& member : document.cast) {
      files.push_back(BakedHumanFile(paths, member));
    }
    // Created before the files are read, so that a change in between is detected.
    content.finer = ReadsAgain(files);
  }
  for (const CastDocument& member : document.cast) {
    LARARIUM_ASSIGN_OR_RETURN(content.cast.emplace_back(), LoadMember(paths, member, options));
  }
  return Status();
}

}  // namespace

Result<show::ShowContent> AssembleShow(const ProjectPaths& paths,
                                       const ProjectDocument& document,
                                       const PlaceDocument& place,
                                       std::shared_ptr<const vision::SceneDatabase> database,
                                       const Similarity3& map_from_picked,
                                       const AssembleOptions& options) {
  show::ShowContent content;
  content.title = document.title;
  LARARIUM_ASSIGN_OR_RETURN(stage::Place staged,
                            StagePlace(paths, place, *database, map_from_picked));
  LARARIUM_ASSIGN_OR_RETURN(std::vector<light::GlossyMap> glossy,
                            LoadBakedReflections(paths, place));
  content.places.push_back({std::move(staged), std::move(database), std::move(glossy)});
  for (const PlaceDocument& other : document.places) {
    if (other.name != place.name) {
      LARARIUM_ASSIGN_OR_RETURN(content.elsewhere.emplace_back(), StageObstacles(paths, other));
    }
  }
  LARARIUM_RETURN_IF_ERROR(LoadCast(paths, document, options, content));
  LARARIUM_ASSIGN_OR_RETURN(content.objects, LoadObjects(paths, document));
  LARARIUM_ASSIGN_OR_RETURN(content.paradata, LoadParadata(paths));
  LARARIUM_RETURN_IF_ERROR(AddLines(paths, document, options.languages, content));
  LARARIUM_ASSIGN_OR_RETURN(content.sounds, LoadSounds(paths));
  LARARIUM_ASSIGN_OR_RETURN(content.drama, ReadText(paths.Drama()));
  content.drama_file = paths.Drama().filename().string();
  return content;
}

Result<show::ShowContent> LoadShowContent(const ProjectPaths& paths,
                                          const ProjectDocument& document,
                                          const std::string& place_name,
                                          const show::LanguageChoice& languages) {
  const PlaceDocument* place = document.FindPlace(place_name);
  if (place == nullptr) {
    return Status::Error(paths.Project().string(), "has no place \"" + place_name + "\"");
  }
  LARARIUM_ASSIGN_OR_RETURN(const StagedMap map, LoadStagedMap(paths, *place));
  LARARIUM_RETURN_IF_ERROR(map.picks.problem);
  return AssembleShow(paths, document, *place, map.database, map.picks.map_from_picked,
                      {.languages = languages});
}

Result<StagedMap> LoadStagedMap(const ProjectPaths& paths, const PlaceDocument& place) {
  LARARIUM_ASSIGN_OR_RETURN(vision::SceneDatabase database, LoadMap(paths, place.name));
  StagedMap map;
  map.measures = MeasureMap(place, database);
  map.picks = ResolvePicks(place, database, map.measures);
  map.database = std::make_shared<const vision::SceneDatabase>(std::move(database));
  return map;
}

Result<vision::SceneDatabase> LoadMap(const ProjectPaths& paths, const std::string& place) {
  const std::filesystem::path file = paths.Scene(place);
  if (!FileExists(file)) {
    return Status::Error(file.string(), "was not found", "train the place \"" + place + "\"");
  }
  return vision::LoadSceneDatabase(file);
}

Result<std::unique_ptr<capture::FrameSource>> OpenSource(const ProjectPaths& paths,
                                                         const SourceDocument& source) {
  switch (source.kind) {
    case SourceDocument::Kind::kVideo:
      return capture::OpenVideo(paths.Resolve(source.path));
    case SourceDocument::Kind::kImages:
      return capture::OpenImageFolder(paths.Resolve(source.path));
    case SourceDocument::Kind::kNone:
      break;
  }
  return Status::Error(paths.Project().string(), "has no recording of the place",
                       "train it from a video or a folder of images");
}

}  // namespace lararium::editor
