#pragma once

// The recipes of the people that come with the editor, by name.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "editor/import/cast/cast_recipe.h"
#include "shared/core/embedded_text.h"
#include "shared/core/status.h"

namespace lararium::import {

// The files in scenes/thermopolium/cast.
std::span<const EmbeddedText> CastPresetTexts();

std::vector<std::string> CastPresetNames();
// Errors list the names that exist.
Result<CastRecipe> LoadCastPreset(std::string_view name);

}  // namespace lararium::import
