#include "editor/jobs/bundle_summary.h"

#include <algorithm>
#include <map>
#include <string>
#include <string_view>
#include <system_error>

#include "editor/jobs/baking.h"
#include "editor/jobs/lines.h"
#include "editor/jobs/sounds.h"
#include "shared/bundle/bundle.h"

namespace lararium::editor {

namespace {

namespace fs = std::filesystem;

// Bytes of a point with its descriptors and its share of the keyframes' images, in a map that was
// pruned for visitors: the sample's map with 10 000 points has 15.0 MB.
constexpr uint64_t kBytesPerPoint = 1500;

// Returns false where the file does not exist.
bool AddFile(const fs::path& file, ContentRow& row) {
  std::error_code error;
  const auto bytes = fs::file_size(file, error);
  row.bytes += error ? 0 : bytes;
  return !error;
}

void ForecastPlaces(const ProjectPaths& paths,
                    const ProjectDocument& document,
                    const MapBudget& budget,
                    ContentRow& row) {
  for (const PlaceDocument& place : document.places) {
    ContentRow map;
    row.unbaked += AddFile(paths.Scene(place.name), map) ? 0 : 1;
    row.bytes += std::min(map.bytes, static_cast<uint64_t>(budget.max_points) * kBytesPerPoint);
  }
  row.count = static_cast<int>(document.places.size());
}

void ForecastSpeech(const ProjectPaths& paths,
                    const ProjectDocument& document,
                    const ProjectLines& lines,
                    ContentRow& row) {
  const auto spoken = SpokenLines(paths, document, lines);
  if (!spoken.ok()) {
    return;
  }
  for (const SpokenLine& line : *spoken) {
    const bool baked = AddFile(line.sound, row) && AddFile(line.visemes, row);
    row.unbaked += baked ? 0 : 1;
  }
  row.count = static_cast<int>(spoken->size());
}

}  // namespace

uint64_t BundleSummary::bytes() const {
  uint64_t sum = 0;
  for (const ContentRow& row : rows) {
    sum += row.bytes;
  }
  return sum;
}

int BundleSummary::unbaked() const {
  int sum = 0;
  for (const ContentRow& row : rows) {
    sum += row.unbaked;
  }
  return sum;
}

BundleSummary ForecastShow(const ProjectPaths& paths,
                           const ProjectDocument& document,
                           const MapBudget& budget) {
  BundleSummary contents;
  ForecastPlaces(paths, document, budget, contents.row(ContentKind::kPlaces));
  ContentRow& people = contents.row(ContentKind::kPeople);
  for (const CastDocument& member : document.cast) {
    people.unbaked += AddFile(BakedHumanFile(paths, member), people) ? 0 : 1;
  }
  people.count = static_cast<int>(document.cast.size());
  ContentRow& objects = contents.row(ContentKind::kObjects);
  for (const ObjectDocument& object : document.objects) {
    objects.unbaked += AddFile(paths.Prop(object.name), objects) ? 0 : 1;
  }
  objects.count = static_cast<int>(document.objects.size());
  ContentRow& sounds = contents.row(ContentKind::kSounds);
  for (const SoundFile& sound : FindSounds(paths)) {
    sounds.unbaked += AddFile(sound.file, sounds) ? 0 : 1;
    ++sounds.count;
  }
  ContentRow& texts = contents.row(ContentKind::kTexts);
  AddFile(paths.Drama(), texts);
  if (const Result<ProjectLines> lines = LoadProjectLines(paths, document); lines.ok()) {
    ForecastSpeech(paths, document, *lines, contents.row(ContentKind::kSpeech));
    texts.count = static_cast<int>(lines->captions.size());
  }
  return contents;
}

Result<BundleSummary> ReadBundleSummary(const fs::path& show) {
  LARARIUM_ASSIGN_OR_RETURN(const bundle::Bundle opened, bundle::Bundle::Open(show));
  const bundle::ShowManifest& manifest = opened.manifest();
  BundleSummary contents;
  // Sizes of members that were not counted yet; some are shared.
  std::map<std::string_view, uint64_t> sizes;
  for (const bundle::Member& member : manifest.members) {
    sizes[member.name] = member.size;
  }
  const auto add = [&](ContentKind kind, const std::string& name) {
    if (const auto found = sizes.find(name); found != sizes.end()) {
      contents.row(kind).bytes += found->second;
      sizes.erase(found);
    }
  };
  for (const bundle::PlaceEntry& place : manifest.places) {
    add(ContentKind::kPlaces, place.scene);
    for (const bundle::OccluderEntry& occluder : place.occluders) {
      add(ContentKind::kPlaces, occluder.mesh);
    }
    for (const std::string& glossy : place.glossy) {
      add(ContentKind::kPlaces, glossy);
    }
  }
  for (const bundle::CastEntry& member : manifest.cast) {
    add(ContentKind::kPeople, member.human);
  }
  for (const bundle::ObjectEntry& object : manifest.objects) {
    add(ContentKind::kObjects, object.prop);
  }
  int spoken = 0;
  for (const bundle::LineEntry& line : manifest.lines) {
    for (const auto& [language, entry] : line.spoken) {
      add(ContentKind::kSpeech, entry.visemes);
      add(ContentKind::kSpeech, entry.sound);
      ++spoken;
    }
  }
  for (const bundle::SoundEntry& sound : manifest.sounds) {
    add(ContentKind::kSounds, sound.file);
  }
  for (const auto& [name, size] : sizes) {
    contents.row(ContentKind::kTexts).bytes += size;
  }
  contents.row(ContentKind::kPlaces).count = static_cast<int>(manifest.places.size());
  contents.row(ContentKind::kPeople).count = static_cast<int>(manifest.cast.size());
  contents.row(ContentKind::kObjects).count = static_cast<int>(manifest.objects.size());
  contents.row(ContentKind::kSpeech).count = spoken;
  contents.row(ContentKind::kSounds).count = static_cast<int>(manifest.sounds.size());
  contents.row(ContentKind::kTexts).count = static_cast<int>(manifest.captions.size());
  contents.is_signed = opened.is_signed();
  return contents;
}

}  // namespace lararium::editor
