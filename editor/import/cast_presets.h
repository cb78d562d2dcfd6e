#pragma once

// The people that come with the editor: recipes under the names of who they are.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "editor/import/cast_recipe.h"
#include "shared/core/embedded_text.h"
#include "shared/core/status.h"

namespace lararium::import {

// scenes/thermopolium/cast.
std::span<const EmbeddedText> CastPresetTexts();

std::vector<std::string> CastPresetNames();
// An error names those that there are.
Result<CastRecipe> LoadCastPreset(std::string_view name);

}  // namespace lararium::import
