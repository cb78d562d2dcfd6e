#include "shared/show/show_content.h"

#include <algorithm>
#include <utility>

#include "shared/stage/mesh_file.h"

namespace lararium::show {
namespace {

Result<const bundle::PlaceEntry*> FindPlace(const bundle::Bundle& bundle, std::string_view name) {
  const std::vector<bundle::PlaceEntry>& places = bundle.manifest().places;
  if (name.empty()) {
    return &places.front();
  }
  const auto found = std::find_if(places.begin(), places.end(),
                                  [name](const auto& place) { return place.name == name; });
  if (found == places.end()) {
    return Status::Error(bundle.place(), "has no place \"" + std::string(name) + "\"",
                         "choose one that lararium-player info lists");
  }
  return &*found;
}

Result<stage::Place> LoadPlace(const bundle::Bundle& bundle, const bundle::PlaceEntry& entry) {
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

}  // namespace

Result<ShowContent> LoadShowContent(const bundle::Bundle& bundle, std::string_view place) {
  const bundle::ShowManifest& manifest = bundle.manifest();
  LARARIUM_ASSIGN_OR_RETURN(const bundle::PlaceEntry* entry, FindPlace(bundle, place));

  ShowContent content;
  content.title = manifest.title;
  LARARIUM_ASSIGN_OR_RETURN(const auto scene, bundle.member(entry->scene));
  LARARIUM_ASSIGN_OR_RETURN(
      vision::SceneDatabase database,
      vision::ParseSceneDatabase(scene, bundle.place() + ": " + entry->scene));
  content.database = std::make_shared<const vision::SceneDatabase>(std::move(database));
  LARARIUM_ASSIGN_OR_RETURN(content.place, LoadPlace(bundle, *entry));

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
