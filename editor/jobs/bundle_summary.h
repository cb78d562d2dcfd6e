#pragma once

// The content of a bundle and its size.

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>

#include "editor/document/project.h"
#include "editor/jobs/exporting.h"
#include "shared/core/status.h"

namespace lararium::editor {

enum class ContentKind { kPlaces, kPeople, kObjects, kSpeech, kSounds, kTexts };
inline constexpr size_t kContentKinds = 6;

struct ContentRow {
  int count = 0;    // Counts objects rather than files; for texts, the languages of captions.
  int unbaked = 0;  // How many of count are not baked; bytes does not include them.
  uint64_t bytes = 0;
};

struct BundleSummary {
  std::array<ContentRow, kContentKinds> rows = {};  // Indexed by ContentKind.
  bool is_signed = false;

  ContentRow& row(ContentKind kind) { return rows[static_cast<size_t>(kind)]; }
  const ContentRow& row(ContentKind kind) const { return rows[static_cast<size_t>(kind)]; }
  uint64_t bytes() const;
  int unbaked() const;
};

// A forecast before the export, from the files that exist, even when they are stale. The size of
// maps is an estimate.
BundleSummary ForecastShow(const ProjectPaths& paths,
                           const ProjectDocument& document,
                           const MapBudget& budget);

// The content of an exported bundle. Errors as from Bundle::Open().
Result<BundleSummary> ReadBundleSummary(const std::filesystem::path& show);

}  // namespace lararium::editor
