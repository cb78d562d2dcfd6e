#pragma once

// The user's settings of the editor, which are the same for all projects.

#include <array>
#include <filesystem>
#include <string>

#include "shared/core/status.h"

namespace lararium::editor {

enum class Theme { kDark, kLight };

struct Settings {
  Theme theme = Theme::kDark;
  double scale = 1.0;    // The interface's scale in addition to the display's; one of kScales.
  std::string language;  // One of kLanguages.

  friend bool operator==(const Settings&, const Settings&) = default;
};

inline constexpr std::array<double, 4> kScales = {1.0, 1.25, 1.5, 2.0};
// English and the catalogues in po/; the empty entry means the language of the environment.
inline constexpr std::array<const char*, 3> kLanguages = {"", "en", "it"};

// Returns the defaults where there is no file. A file that cannot be read is moved aside by
// SetAside(), which gives the error.
Result<Settings> LoadSettings(const std::filesystem::path& file);
// Also makes the folder.
Status SaveSettings(const std::filesystem::path& file, const Settings& settings);

}  // namespace lararium::editor
