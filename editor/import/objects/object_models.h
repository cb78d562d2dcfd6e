#pragma once

// The objects of a Roman street kitchen, modelled here after finds in Pompeii's
// thermopolia: what people of a drama use before a designer brings models of their
// own. Sizes are those of finds.

#include <span>
#include <string_view>

#include "shared/core/status.h"
#include "shared/stage/prop.h"

namespace lararium::import {

// Their names, sorted.
std::span<const std::string_view> ObjectModelNames();

// The object and how it is used. Fails where there is none of that name.
Result<stage::Prop> BuildObjectModel(std::string_view name);

}  // namespace lararium::import
