#pragma once

// Packs the parts of a project that visitors need into a bundle.

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "shared/audio/sound_library.h"
#include "shared/bundle/show_manifest.h"
#include "shared/bundle/signature.h"
#include "shared/bundle/web_folder.h"
#include "shared/core/progress.h"
#include "shared/core/status.h"
#include "shared/light/glossy_map.h"
#include "shared/stage/place.h"

namespace lararium::exporter {

struct PlaceContent {
  stage::Place place;                    // Includes the meshes of its occluders.
  std::vector<std::byte> scene;          // A serialised scene database (.larscene).
  std::vector<light::GlossyMap> glossy;  // One map for each probe of the place; may be empty.
};

struct CastContent {
  std::string name;
  std::vector<std::byte> human;  // A serialised human (.larhuman).
  // The human without meshes (bundle::CastEntry::motion). If this is not empty, `human` has no
  // clips.
  std::vector<std::byte> motion = {};
};

struct ObjectContent {
  std::string name;
  std::vector<std::byte> prop;  // A serialised prop (.larprop).
  geometry::Rigid3 stage_from_object;
  // The prop without drawn surfaces (bundle::ObjectEntry::extent); may be empty.
  std::vector<std::byte> extent = {};
};

// A line spoken in one language.
struct SpokenContent {
  std::string line;  // Id of the line.
  std::string speaker;
  std::string language;
  std::string visemes;           // JSON, read by stage::ParseVisemes.
  std::vector<std::byte> sound;  // FLAC; empty if the line has no sound.
};

// The captions while lines are spoken in one language.
struct CaptionContent {
  std::string language;  // The spoken language.
  std::string captions;  // JSON, read by stage::ParseCaptions.
};

// All content of a bundle as plain data.
struct ExportContent {
  std::string title;
  std::string credits;
  std::string drama;  // Lua source
  std::vector<PlaceContent> places;
  std::vector<CastContent> cast;
  std::vector<ObjectContent> objects;
  std::vector<SpokenContent> lines;
  std::vector<CaptionContent> spoken;  // The first is the default.
  // The languages of audio descriptions and their captions; the first is the default.
  std::vector<CaptionContent> descriptions;
  std::vector<std::string> captions;  // Languages of captions; the first is the default.
  // JSON, read by render::ParseCaptionFont; empty if there are no captions.
  std::string caption_metrics;
  std::vector<std::byte> caption_atlas;  // PNG
  std::vector<audio::SoundData> sounds;
  std::string paradata;  // JSON, read by stage::ParseParadata; empty if there are none.
};

// Checks the parts with the parsers of the player, writes the bundle, and opens it again as the
// player does. If `key` is given, it signs the bundle. On failure an existing file stays
// unchanged.
Status ExportBundle(const ExportContent& content,
                    const std::filesystem::path& path,
                    Progress& progress,
                    const bundle::SecretKey* key = nullptr);

// A folder for browsers, with the page and with what it needs of the show.
struct WebExport {
  std::filesystem::path folder;
  std::filesystem::path page;  // Folder of the page's files, as the preset `web` builds it.
  // Where the folder will be served, for a page with a QR code to be printed; empty: none.
  std::string address = {};
  // The fleet that pages join; they do so with more of the page's files.
  std::optional<bundle::FleetEntry> fleet = {};
};
// Checks that the page is there and that the folder may be written.
Status CheckWebExport(const WebExport& web);
// Checks the parts like ExportBundle(), and writes the folder. On failure an existing one stays
// unchanged.
Result<bundle::WebFolderReport> ExportWebFolder(ExportContent content,
                                                const WebExport& web,
                                                const bundle::SecretKey& key,
                                                Progress& progress);

}  // namespace lararium::exporter
