#pragma once

// Generates products from the project's sources ahead of a show: the light of each place, the
// meshes of its occluders, the people of the cast, the objects. Each product stores the hash of all
// its inputs and is generated again only when that changes.

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "editor/document/project.h"
#include "editor/jobs/lines.h"
#include "editor/jobs/shared_people.h"
#include "shared/core/progress.h"
#include "shared/core/status.h"
#include "shared/geometry/triangle_mesh.h"
#include "shared/human/human.h"
#include "shared/light/glossy_map.h"
#include "shared/light/probe_blend.h"
#include "shared/stage/prop.h"
#include "shared/vision/scene_database.h"

namespace lararium::editor {

struct BakeReport {
  std::vector<std::string> baked;      // Names of the products that were generated.
  std::vector<std::string> unchanged;  // Names of the products that were up to date.
  std::vector<std::string> warnings;   // Warnings of all products, made now or before.
};

// kUnlitPeople: without their light transfer, which takes most of the time.
enum class BakeWhat { kAll, kAllButPeople, kPeople, kUnlitPeople };

// Generates products that are missing or stale. Stops at the first failure; products that were
// finished before stay. A probe that cannot be read gives a warning, and uniform light replaces it.
Result<BakeReport> Bake(const ProjectPaths& paths,
                        const ProjectDocument& document,
                        Progress& progress,
                        BakeWhat what = BakeWhat::kAll);

// The file that an object is imported from: its own, or that of its model in the library. Fails if
// the library lacks the model.
Result<std::filesystem::path> ObjectFile(const ProjectPaths& paths, const ObjectDocument& object);

// The warnings with which a product was made, such as a texture that its model names and that
// cannot be read. Empty if it was not made.
std::vector<std::string> ProductWarnings(const std::filesystem::path& product);
// The warnings of all products of a project as they are on disk; no product is made. `spoken` are
// all lines (SpokenLines()).
std::vector<std::string> WarningsOfProducts(const ProjectPaths& paths,
                                            const ProjectDocument& document,
                                            std::span<const SpokenLine> spoken);

// Copies a product with the hash of its inputs, where both are there, so that baking the same
// inputs at the other place has nothing to do. A copy that fails is a product that has to be baked.
void CopyProduct(const std::filesystem::path& from, const std::filesystem::path& to);

// The names of the cast members whose product is missing or stale.
std::vector<std::string> PeopleToBake(const ProjectPaths& paths, const ProjectDocument& document);

struct BakedHuman {
  human::Human human;
  std::vector<std::string> warnings;
};
// Generates one person without light transfer, where it is missing or stale.
Result<BakedHuman> BakeHuman(const ProjectPaths& paths, const CastDocument& member);

//
// These functions load products. They fail where a product was never baked.
//
// The light of each probe of the place. Uniform light of the given radiance replaces a probe that
// could not be baked, and is the only light where the place has none.
Result<std::vector<light::PlacedProbe>> LoadBakedProbes(const ProjectPaths& paths,
                                                        const PlaceDocument& place,
                                                        float even_radiance);
// The radiance of uniform light in which surfaces of a typical albedo look as bright as the map's
// points do.
float EvenRadiance(const vision::SceneDatabase& map);
// The specular reflections on rough surfaces, for each probe. An entry is empty where a probe is
// invalid or was not baked. The list is empty where the place has no probes.
Result<std::vector<light::GlossyMap>> LoadBakedReflections(const ProjectPaths& paths,
                                                           const PlaceDocument& place);
Result<geometry::TriangleMesh> LoadBakedMesh(const ProjectPaths& paths,
                                             const PlaceDocument& place,
                                             const OccluderDocument& occluder);
// With the light transfer, if that is up to date.
Result<human::Human> LoadBakedHuman(const ProjectPaths& paths, const CastDocument& member);
// The person in limited detail, shared with everything else that shows it (SharePerson).
Result<show::CastMember> ShareBakedHuman(const ProjectPaths& paths,
                                         const CastDocument& member,
                                         float finest);
// The plain figure, for a member that was not baked.
Result<human::Human> MakeStandIn(const ProjectPaths& paths, const CastDocument& member);
// The file that LoadBakedHuman() reads.
std::filesystem::path BakedHumanFile(const ProjectPaths& paths, const CastDocument& member);
Result<stage::Prop> LoadBakedProp(const ProjectPaths& paths, const ObjectDocument& object);

}  // namespace lararium::editor
