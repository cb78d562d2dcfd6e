#pragma once

// All that one show needs at its places, ready to run.

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shared/bundle/bundle.h"
#include "shared/core/status.h"
#include "shared/human/face.h"
#include "shared/human/human.h"
#include "shared/light/glossy_map.h"
#include "shared/stage/object_use.h"
#include "shared/stage/place.h"
#include "shared/vision/scene_database.h"
#include "shared/vision/tracked_frame.h"

namespace lararium::show {

struct CastMember {
  std::string name;  // as the drama calls the actor
  std::shared_ptr<const human::Human> human;
};

// A thing that people use, or scenery.
struct StageObject {
  std::string name;  // as the drama calls it
  std::shared_ptr<const stage::ObjectModel> model;
  stage::Pose stage_from_object;  // at the beginning
};

// What somebody can say.
struct Speech {
  std::string name;  // as the drama calls it
  human::VisemeTrack visemes;
};

// A trained place and how the drama is staged there.
struct ShowPlace {
  stage::Place stage;
  std::shared_ptr<const vision::SceneDatabase> map;
  // What rough surfaces mirror of each of the stage's probes; may be empty.
  std::vector<light::GlossyMap> glossy = {};
};

struct ShowContent {
  std::string title;
  std::vector<ShowPlace> places;  // at least one
  std::vector<CastMember> cast;
  std::vector<StageObject> objects;
  std::vector<Speech> speech;
  std::string drama;       // Lua source
  std::string drama_file;  // what messages call it
};

// What the tracker is created with: TrackedFrame::map is then an index into places.
std::vector<std::shared_ptr<const vision::SceneDatabase>> Maps(std::span<const ShowPlace> places);

// The occluders of a place as its map has them, which hide the map's points.
std::vector<vision::OccluderMesh> OccludersInMap(const stage::Place& place);

// Tells a tracker with the maps of the places about their occluders.
void SetOccluders(std::span<const ShowPlace> places, vision::PoseSource& poses);

// The bundle's places, or only the named one. Every member is checked by its own reader.
Result<std::vector<ShowPlace>> LoadShowPlaces(const bundle::Bundle& bundle,
                                              std::string_view place = {});

// The content of a bundle at all of its places, or only at the named one. Every
// member is checked by its own reader.
Result<ShowContent> LoadShowContent(const bundle::Bundle& bundle, std::string_view place = {});

}  // namespace lararium::show
