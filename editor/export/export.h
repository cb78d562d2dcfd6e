#pragma once

// Packs what visitors need of a project into a bundle.

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "shared/audio/sound_library.h"
#include "shared/bundle/signature.h"
#include "shared/core/progress.h"
#include "shared/core/status.h"
#include "shared/light/glossy_map.h"
#include "shared/stage/place.h"

namespace lararium::exporter {

struct PlaceContent {
  stage::Place place;                    // with its occluders' meshes
  std::vector<std::byte> scene;          // a serialised scene database (.larscene)
  std::vector<light::GlossyMap> glossy;  // of each of the place's probes; may be empty
};

struct CastContent {
  std::string name;
  std::vector<std::byte> human;  // a serialised human (.larhuman)
};

struct ObjectContent {
  std::string name;
  std::vector<std::byte> prop;  // a serialised prop (.larprop)
  geometry::Rigid3 stage_from_object;
};

// A line as it is said in one language.
struct SpokenContent {
  std::string line;  // its id
  std::string speaker;
  std::string language;
  std::string visemes;           // JSON: stage::ParseVisemes
  std::vector<std::byte> sound;  // FLAC; empty: nothing is heard
};

// What is to be read while lines are said in one language.
struct CaptionContent {
  std::string language;  // that is spoken
  std::string captions;  // JSON: stage::ParseCaptions
};

// Everything that goes into a bundle, as plain data.
struct ExportContent {
  std::string title;
  std::string credits;
  std::string drama;  // Lua source
  std::vector<PlaceContent> places;
  std::vector<CastContent> cast;
  std::vector<ObjectContent> objects;
  std::vector<SpokenContent> lines;
  std::vector<CaptionContent> spoken;        // the first unless another is asked for
  std::vector<CaptionContent> descriptions;  // of what is described, in each language
  std::vector<std::string> captions;         // languages, likewise
  std::string caption_metrics;               // JSON: render::ParseCaptionFont; empty: no captions
  std::vector<std::byte> caption_atlas;      // PNG
  std::vector<audio::SoundData> sounds;
  std::string paradata;  // JSON: stage::ParseParadata; empty: none
};

// Checks the parts with the player's own parsers, writes the bundle, and opens it
// again as the player would. key: signs it. On failure a file that was there before is left as
// it was.
Status ExportBundle(const ExportContent& content,
                    const std::filesystem::path& path,
                    Progress& progress,
                    const bundle::SecretKey* key = nullptr);

}  // namespace lararium::exporter
