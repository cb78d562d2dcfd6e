#pragma once

// The synthetic world as two places of one drama: the same objects in two maps.

#include <string_view>

#include "editor/document/project.h"
#include "editor/jobs/training.h"
#include "shared/core/check.h"
#include "shared/core/file.h"
#include "tests/support/synthetic_world.h"
#include "tests/support/test_files.h"

namespace lararium::test {

// The synthetic world as a stage of a few metres.
inline const geometry::Similarity3 kStageFromWorld = {
    3.0, Eigen::Quaterniond::Identity(), {0.0, 1.0, 0.0}};

// Two maps of the same place: the maquette, where a map unit is ten metres of the stage, and the
// site.
inline const geometry::Similarity3 kMaquetteFromStage = {
    0.1, Eigen::Quaterniond(0.3, -0.5, 0.7, 0.4).normalized(), {5.0, -2.0, 1.0}};
inline const geometry::Similarity3 kSiteFromStage = {
    1.7, Eigen::Quaterniond(0.9, 0.1, -0.2, 0.3).normalized(), {-3.0, 0.5, 8.0}};

inline vision::SceneDatabase MapOf(const SyntheticWorld& world,
                                   const geometry::Similarity3& map_from_stage) {
  const geometry::Similarity3 map_from_world = map_from_stage * kStageFromWorld;
  vision::SceneDatabase map = MakeSceneDatabase(world);
  for (Eigen::Vector3f& point : map.points) {
    point = (map_from_world * point.cast<double>()).cast<float>();
  }
  for (Eigen::Vector3f& normal : map.normals) {
    normal = map_from_world.rotation.cast<float>() * normal;
  }
  for (vision::Keyframe& keyframe : map.keyframes) {
    keyframe.camera_from_map =
        geometry::CameraFromB(keyframe.camera_from_map, map_from_world.Inverse());
  }
  return map;
}

// The pick of a stage point in a keyframe of a map of the world.
inline stage::Pick See(const SyntheticWorld& world,
                       const vision::SceneDatabase& map,
                       const Eigen::Vector3d& on_stage,
                       size_t keyframe) {
  const auto pixel = world.camera.Project(world.cameras_from_world[keyframe] *
                                          (kStageFromWorld.Inverse() * on_stage));
  CHECK(pixel.has_value());
  return {map.keyframes[keyframe].frame_index, map.keyframes[keyframe].name, *pixel};
}

// A project with the maquette and the site: the maquette has a wall that is a model, the site a
// bench that was drawn on its images.
struct TwoPlacesProject {
  TwoPlacesProject() {
    CHECK(editor::CreateProject(paths_, "Two places").ok());
    editor::ProjectDocument document = *editor::LoadProject(paths_);
    document.places = {MakePlace("maquette", kMaquetteFromStage),
                       MakePlace("site", kSiteFromStage)};
    CHECK(WriteFileAtomically(paths_.folder / "wall.obj", std::string_view(R"(
v -1 0 -1.2
v 1 0 -1.2
v 1 2 -1.2
v -1 2 -1.2
v -1 0 -1
v 1 0 -1
v 1 2 -1
v -1 2 -1
f 1 4 3 2
f 5 6 7 8
f 1 5 8 4
f 2 3 7 6
f 4 8 7 3
f 1 2 6 5
)"))
              .ok());
    editor::OccluderDocument wall;
    wall.name = "wall";
    wall.file = "wall.obj";
    document.places[0].occluders = {wall};
    document.places[1].occluders = {DrawBench()};
    document.cast.emplace_back().name = "keeper";
    CHECK(editor::SaveProject(paths_, document).ok());
    CHECK(WriteFileAtomically(paths_.Drama(), std::string_view(R"(
local keeper = actor("keeper")
keeper:place{x = 0, z = 1.5}
function main()
  keeper:walk_to{x = 0, z = -2.5}
end
)"))
              .ok());
  }

  editor::PlaceDocument MakePlace(const std::string& name,
                                  const geometry::Similarity3& map_from_stage) {
    const vision::SceneDatabase map = MapOf(world_, map_from_stage);
    editor::PlaceDocument place;
    place.name = name;
    const auto pick = [&](stage::Anchor& anchor, const Eigen::Vector3d& on_stage) {
      for (const size_t keyframe : {1, 5, 10}) {
        anchor.picks.push_back(See(world_, map, on_stage, keyframe));
      }
    };
    pick(place.picks.origin, {0.0, 0.0, 0.0});
    pick(place.picks.forward, {0.0, 0.0, -1.0});
    pick(place.picks.floor, {1.0, 0.0, 0.0});
    place.picks.length_m = 1.0;
    CHECK(editor::SaveMap(paths_, place, map).ok());
    return place;
  }

  // A face 0.8 m wide across the path, in front of the wall.
  editor::OccluderDocument DrawBench() {
    editor::OccluderDocument bench;
    bench.name = "bench";
    bench.depth = 0.4;
    const Eigen::Vector3d corners[] = {
        {-0.4, 0.0, 0.6}, {0.4, 0.0, 0.6}, {0.4, 0.6, 0.6}, {-0.4, 0.6, 0.6}};
    const vision::SceneDatabase map = MapOf(world_, kSiteFromStage);
    for (const Eigen::Vector3d& corner : corners) {
      stage::Anchor& anchor = bench.corners.emplace_back();
      anchor.name = editor::CornerName(bench.corners.size() - 1);
      for (const size_t keyframe : {1, 5, 10}) {
        anchor.picks.push_back(See(world_, map, corner, keyframe));
      }
    }
    return bench;
  }

  const TemporaryFolder folder_;
  const editor::ProjectPaths paths_{folder_ / "two.lararium"};
  const SyntheticWorld world_ = MakeSyntheticWorld({.points = 60});
};

}  // namespace lararium::test
