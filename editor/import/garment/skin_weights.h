#pragma once

// Which joints move a piece of cloth: those that move the body below it.

#include <cstdint>
#include <span>
#include <vector>

#include "editor/import/cast_body.h"
#include "editor/import/garment/posed_body.h"
#include "editor/import/garment/sheet.h"

namespace lararium::import {

// Gives each particle the weights of the body near it in this pose. kSkirted: what
// hangs below the hips, between the legs, takes those of the helper skirt, and half as
// much of a leg's turn. kTrunk: as if the body had no arms.
// kMantle: as kSkirted, but as if it had the left upper arm alone.
// kArmless: as kSkirted, but as if it had no arms: what hangs beside hands is not theirs.
enum class WeightSource : uint8_t { kBody, kSkirted, kTrunk, kMantle, kArmless };
// Returns how far each particle is from what it took them from, metres.
std::vector<float> TakeWeights(const FittedBody& body,
                               const PosedBody& posed,
                               WeightSource source,
                               Sheet& sheet);

// Evens weights out along the cloth, the more the further it is from the body: what
// lies close must move as the skin does.
void SmoothWeights(Sheet& sheet, int rounds, std::span<const float> distances);

// Where each particle is in another pose, given its place in one. from, to: skin
// matrices.
std::vector<glm::vec3> Carried(const Sheet& sheet,
                               std::span<const glm::mat4> from,
                               std::span<const glm::mat4> to);

}  // namespace lararium::import
