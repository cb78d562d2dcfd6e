#pragma once

// The objects of a Roman street kitchen, modelled in code after finds in Pompeii's thermopolia,
// with their sizes. Dramas use them until a designer provides other models.

#include <span>
#include <string_view>

#include "shared/core/status.h"
#include "shared/stage/prop.h"

namespace lararium::import {

// The names, sorted.
std::span<const std::string_view> ObjectModelNames();

// Builds the object with its use. Fails if the name is unknown.
Result<stage::Prop> BuildObjectModel(std::string_view name);

}  // namespace lararium::import
