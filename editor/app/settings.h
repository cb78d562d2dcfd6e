#pragma once

// How somebody wants the editor, whatever they work on.

#include <array>
#include <filesystem>
#include <string>

#include "shared/core/status.h"

namespace lararium::app {

enum class Theme { kDark, kLight };

struct Settings {
  Theme theme = Theme::kDark;
  double scale = 1.0;    // of the interface, beyond that of the display; one of kScales
  std::string language;  // one of kLanguages

  friend bool operator==(const Settings&, const Settings&) = default;
};

inline constexpr std::array<double, 4> kScales = {1.0, 1.25, 1.5, 2.0};
// Those of the catalogues in po/, and English; the first is that of the environment.
inline constexpr std::array<const char*, 3> kLanguages = {"", "en", "it"};

// Without a file: as above. One that cannot be read is moved aside, as SetAside() does.
Result<Settings> LoadSettings(const std::filesystem::path& file);
// Makes the folder too.
Status SaveSettings(const std::filesystem::path& file, const Settings& settings);

}  // namespace lararium::app
