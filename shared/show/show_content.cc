#include "shared/show/show_content.h"

#include <algorithm>
#include <span>
#include <utility>

#include "shared/stage/mesh_file.h"

namespace lararium::show {
namespace {

// Those of the bundle's places that are wanted.
Result<std::span<const bundle::PlaceEntry>> ChoosePlaces(const bundle::Bundle& bundle,
                                                         std::string_view name) {
  const std::span<const bundle::PlaceEntry> places = bundle.manifest().places;
  if (name.empty()) {
    return places;
  }
  const auto found = std::find_if(places.begin(), places.end(),
                                  [name](const auto& place) { return place.name == name; });
  if (found == places.end()) {
    return Status::Error(bundle.place(), "has no place \"" + std::string(name) + "\"",
                         "choose one that lararium-player info lists");
  }
  return places.subspan(static_cast<size_t>(found - places.begin()), 1);
}

Result<stage::Place> LoadStage(const bundle::Bundle& bundle, const bundle::PlaceEntry& entry) {
  stage::Place place;
  place.name = entry.name;
  place.map_from_stage = entry.map_from_stage;
  place.camera_nudge = entry.camera_nudge;
  place.light = entry.light;
  for (const bundle::OccluderEntry& occluder : entry.occluders) {
    LARARIUM_ASSIGN_OR_RETURN(const auto bytes, bundle.member(occluder.mesh));
    LARARIUM_ASSIGN_OR_RETURN(geometry::TriangleMesh mesh,
                              stage::ParseMesh(bytes, bundle.place() + ": " + occluder.mesh));
    place.occluders.push_back({occluder.name, std::move(mesh), occluder.stage_from_mesh});
  }
  return place;
}

Result<ShowPlace> LoadPlace(const bundle::Bundle& bundle, const bundle::PlaceEntry& entry) {
  ShowPlace place;
  LARARIUM_ASSIGN_OR_RETURN(const auto scene, bundle.member(entry.scene));
  LARARIUM_ASSIGN_OR_RETURN(vision::SceneDatabase map,
                            vision::ParseSceneDatabase(scene, bundle.place() + ": " + entry.scene));
  place.map = std::make_shared<const vision::SceneDatabase>(std::move(map));
  LARARIUM_ASSIGN_OR_RETURN(place.stage, LoadStage(bundle, entry));
  return place;
}

}  // namespace

std::vector<std::shared_ptr<const vision::SceneDatabase>> Maps(std::span<const ShowPlace> places) {
  std::vector<std::shared_ptr<const vision::SceneDatabase>> maps;
  for (const ShowPlace& place : places) {
    maps.push_back(place.map);
  }
  return maps;
}

std::vector<vision::OccluderMesh> OccludersInMap(const stage::Place& place) {
  std::vector<vision::OccluderMesh> meshes;
  for (const stage::Occluder& occluder : place.occluders) {
    const geometry::Similarity3 map_from_mesh = place.map_from_stage * occluder.stage_from_mesh;
    vision::OccluderMesh& mesh = meshes.emplace_back();
    for (const glm::vec3& p : occluder.mesh.positions) {
      mesh.positions.push_back((map_from_mesh * Eigen::Vector3d(p.x, p.y, p.z)).cast<float>());
    }
    mesh.indices = occluder.mesh.indices;
  }
  return meshes;
}

void SetOccluders(std::span<const ShowPlace> places, vision::PoseSource& poses) {
  for (size_t i = 0; i < places.size(); ++i) {
    poses.SetOccluders(static_cast<uint32_t>(i), OccludersInMap(places[i].stage));
  }
}

Result<std::vector<ShowPlace>> LoadShowPlaces(const bundle::Bundle& bundle,
                                              std::string_view place) {
  LARARIUM_ASSIGN_OR_RETURN(const auto entries, ChoosePlaces(bundle, place));
  std::vector<ShowPlace> places;
  for (const bundle::PlaceEntry& entry : entries) {
    LARARIUM_ASSIGN_OR_RETURN(places.emplace_back(), LoadPlace(bundle, entry));
  }
  return places;
}

Result<ShowContent> LoadShowContent(const bundle::Bundle& bundle, std::string_view place) {
  const bundle::ShowManifest& manifest = bundle.manifest();
  ShowContent content;
  content.title = manifest.title;
  LARARIUM_ASSIGN_OR_RETURN(content.places, LoadShowPlaces(bundle, place));

  for (const bundle::CastEntry& member : manifest.cast) {
    LARARIUM_ASSIGN_OR_RETURN(const auto bytes, bundle.member(member.human));
    LARARIUM_ASSIGN_OR_RETURN(human::Human human,
                              human::ParseHuman(bytes, bundle.place() + ": " + member.human));
    content.cast.push_back({member.name, std::make_shared<const human::Human>(std::move(human))});
  }

  LARARIUM_ASSIGN_OR_RETURN(const auto drama, bundle.member(manifest.drama));
  content.drama.assign(reinterpret_cast<const char*>(drama.data()), drama.size());
  content.drama_file = manifest.drama;
  return content;
}

}  // namespace lararium::show
