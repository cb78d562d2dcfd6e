#include "player/app/info.h"

#include <array>
#include <bit>
#include <cstdio>
#include <string>
#include <string_view>

#include "shared/bundle/bundle.h"
#include "shared/stage/paradata.h"
#include "shared/vision/scene_database.h"

namespace lararium::player {
namespace {

// The number of filming sessions in the map of a place.
int CountSessions(const vision::SceneDatabase& map) {
  uint32_t sessions = 0;
  for (const uint32_t mask : map.session_masks) {
    sessions |= mask;
  }
  return std::popcount(sessions);
}

Status PrintPlace(const bundle::Bundle& bundle, const bundle::PlaceEntry& place) {
  LARARIUM_ASSIGN_OR_RETURN(const auto bytes, bundle.member(place.scene));
  LARARIUM_ASSIGN_OR_RETURN(const vision::SceneDatabase map,
                            vision::ParseSceneDatabase(bytes, bundle.place() + ": " + place.scene));
  std::printf("place   %s: points %zu, keyframes %zu, sessions %d, occluders %zu, bytes %zu\n",
              place.name.c_str(), map.points.size(), map.keyframes.size(), CountSessions(map),
              place.occluders.size(), bytes.size());
  return Status();
}

// Prints the number of claims for each certainty. Their sources are named in the credits.
Status PrintParadata(const bundle::Bundle& bundle) {
  const std::string& member = bundle.manifest().paradata;
  if (member.empty()) {
    return Status();
  }
  LARARIUM_ASSIGN_OR_RETURN(const auto bytes, bundle.member(member));
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  LARARIUM_ASSIGN_OR_RETURN(const stage::Paradata paradata,
                            stage::ParseParadata(text, bundle.place() + ": " + member));
  std::array<int, stage::kCertaintyCount> counts = {};
  for (const stage::Paradata::Claims& claims : paradata.claims) {
    for (const auto& [name, claim] : claims) {
      ++counts[static_cast<size_t>(claim.certainty)];
    }
  }
  std::printf("claims  attested %d, inferred %d, imagined %d, unsaid %d, sources %zu\n", counts[1],
              counts[2], counts[3], counts[0], paradata.sources.size());
  return Status();
}

}  // namespace

Status PrintInfo(const InfoOptions& options) {
  LARARIUM_ASSIGN_OR_RETURN(const bundle::Bundle bundle, bundle::Bundle::Open(options.show));
  const bundle::ShowManifest& manifest = bundle.manifest();
  std::printf("%s\n", manifest.title.c_str());
  for (const bundle::PlaceEntry& place : manifest.places) {
    LARARIUM_RETURN_IF_ERROR(PrintPlace(bundle, place));
  }
  for (const bundle::CastEntry& member : manifest.cast) {
    std::printf("cast    %s\n", member.name.c_str());
  }
  std::string spoken, captions, descriptions;
  for (const bundle::SpokenLanguage& language : manifest.spoken) {
    spoken += " " + language.name;
  }
  for (const std::string& language : manifest.captions) {
    captions += " " + language;
  }
  for (const bundle::SpokenLanguage& language : manifest.descriptions) {
    descriptions += " " + language.name;
  }
  std::printf("lines   %zu, spoken:%s, captions:%s, descriptions:%s\n", manifest.lines.size(),
              spoken.c_str(), captions.c_str(), descriptions.c_str());
  LARARIUM_RETURN_IF_ERROR(PrintParadata(bundle));
  for (const bundle::Member& member : manifest.members) {
    std::printf("member  %-32s %12llu bytes\n", member.name.c_str(),
                static_cast<unsigned long long>(member.size));
  }
  if (!manifest.credits.empty()) {
    std::printf("\n%s\n", manifest.credits.c_str());
  }
  return Status();
}

}  // namespace lararium::player
