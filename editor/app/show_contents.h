#pragma once

// What goes into a show, and how large that is.

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>

#include "editor/app/exporting.h"
#include "editor/app/project.h"
#include "shared/core/status.h"

namespace lararium::app {

enum class ContentKind { kPlaces, kPeople, kObjects, kSpeech, kSounds, kTexts };
inline constexpr size_t kContentKinds = 6;

struct ContentRow {
  int count = 0;    // of things, not of files; of texts the languages of captions
  int unbaked = 0;  // of them; their bytes are not known
  uint64_t bytes = 0;
};

struct ShowContents {
  std::array<ContentRow, kContentKinds> rows = {};  // by kind
  bool is_signed = false;

  ContentRow& row(ContentKind kind) { return rows[static_cast<size_t>(kind)]; }
  const ContentRow& row(ContentKind kind) const { return rows[static_cast<size_t>(kind)]; }
  uint64_t bytes() const;
  int unbaked() const;
};

// Beforehand, from the files that are there, whether or not they are stale. What maps will
// weigh is an estimate.
ShowContents ForecastShow(const ProjectPaths& paths,
                          const ProjectDocument& document,
                          const MapBudget& budget);

// Afterwards, of a bundle. Errors as Bundle::Open().
Result<ShowContents> ReadShowContents(const std::filesystem::path& show);

}  // namespace lararium::app
