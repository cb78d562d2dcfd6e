#include "player/info.h"

#include <cstdio>

#include "shared/bundle/bundle.h"

namespace lararium::player {

Status PrintInfo(const InfoOptions& options) {
  LARARIUM_ASSIGN_OR_RETURN(const bundle::Bundle bundle, bundle::Bundle::Open(options.show));
  const bundle::ShowManifest& manifest = bundle.manifest();
  std::printf("%s\n", manifest.title.c_str());
  for (const bundle::PlaceEntry& place : manifest.places) {
    std::printf("place   %s, %zu occluders\n", place.name.c_str(), place.occluders.size());
  }
  for (const bundle::CastEntry& member : manifest.cast) {
    std::printf("cast    %s\n", member.name.c_str());
  }
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
