#pragma once

// What is made from the project's sources ahead of a show: the light of each
// place, the meshes of its occluders, the humans of the cast, the objects. Each product keeps
// the hash of all that went into it and is made again only when that changes.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "editor/app/project.h"
#include "editor/app/shared_people.h"
#include "shared/core/progress.h"
#include "shared/core/status.h"
#include "shared/geometry/triangle_mesh.h"
#include "shared/human/human.h"
#include "shared/light/glossy_map.h"
#include "shared/light/probe_blend.h"
#include "shared/stage/prop.h"
#include "shared/vision/scene_database.h"

namespace lararium::app {

// What people of recipes are built from: the folder that LARARIUM_CAST_LIBRARY names,
// else "cast-library" in one of the folders above the program.
std::optional<std::filesystem::path> FindCastLibrary();

struct BakeReport {
  std::vector<std::string> baked;      // what was made
  std::vector<std::string> unchanged;  // what was up to date
  std::vector<std::string> warnings;
};

enum class BakeWhat { kAll, kAllButPeople };

// Makes what is missing or stale. Stops at the first failure; what was made
// until then is complete and stays. A probe that cannot be read is a warning: even light
// stands in for it.
Result<BakeReport> Bake(const ProjectPaths& paths,
                        const ProjectDocument& document,
                        Progress& progress,
                        BakeWhat what = BakeWhat::kAll);

// Of the cast, who is not baked as the project has them now.
std::vector<std::string> PeopleToBake(const ProjectPaths& paths, const ProjectDocument& document);

// One human alone, made where it is missing or stale, without light transfer.
Result<human::Human> BakeHuman(const ProjectPaths& paths, const CastDocument& member);

// The products. An error where they were never baked says so.
// The light of each of the place's probes; even light of that radiance for one that could not
// be baked, and where the place has none.
Result<std::vector<light::PlacedProbe>> LoadBakedProbes(const ProjectPaths& paths,
                                                        const PlaceDocument& place,
                                                        float even_radiance);
// By the map's photometric reference: even light in which surfaces of usual albedo look as
// bright as the map's points do.
float EvenRadiance(const vision::SceneDatabase& map);
// What rough surfaces mirror of each of them, none where a probe is bad or was not baked;
// empty where the place has no probes.
Result<std::vector<light::GlossyMap>> LoadBakedReflections(const ProjectPaths& paths,
                                                           const PlaceDocument& place);
Result<geometry::TriangleMesh> LoadBakedMesh(const ProjectPaths& paths,
                                             const PlaceDocument& place,
                                             const OccluderDocument& occluder);
// With its light transfer, where that is up to date.
Result<human::Human> LoadBakedHuman(const ProjectPaths& paths, const CastDocument& member);
// The same in some detail, with all others who show them now (SharePerson).
Result<show::CastMember> ShareBakedHuman(const ProjectPaths& paths,
                                         const CastDocument& member,
                                         float finest);
// The plain figure, for who was not baked.
Result<human::Human> MakeStandIn(const ProjectPaths& paths, const CastDocument& member);
// The file that it is loaded from.
std::filesystem::path BakedHumanFile(const ProjectPaths& paths, const CastDocument& member);
Result<stage::Prop> LoadBakedProp(const ProjectPaths& paths, const ObjectDocument& object);

}  // namespace lararium::app
