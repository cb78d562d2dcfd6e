#pragma once

// Gives cloth the skin weights of the body below it.

#include <cstdint>
#include <span>
#include <vector>

#include "editor/import/cast/cast_body.h"
#include "editor/import/wardrobe/posed_body.h"
#include "editor/import/wardrobe/sheet.h"

namespace lararium::import {

// Gives each particle the weights of the body near it in this pose. kSkirted: cloth that hangs
// below the hips, between the legs, takes the weights of the helper skirt and half of the
// rotation of a leg. kTrunk: ignores the arms. kMantle: like kSkirted, but ignores the arms
// except the left upper arm. kArmless: like kSkirted, but ignores the arms, because cloth
// beside the hands does not follow them. kArms: ignores all but the arms. kLegs: ignores the arms
// and the other side of the body.
enum class WeightSource : uint8_t { kBody, kSkirted, kTrunk, kMantle, kArmless, kArms, kLegs };
// Returns the distance of each particle from the source of its weights, metres.
std::vector<float> TakeWeights(const FittedBody& body,
                               const PosedBody& posed,
                               WeightSource source,
                               Sheet& sheet);

// Smooths weights along the cloth, more at larger distances from the body, because cloth close
// to it must move with the skin.
void SmoothWeights(Sheet& sheet, int rounds, std::span<const float> distances);

// Moves particles from one pose to another. `from` and `to` are the skin matrices of the poses.
std::vector<glm::vec3> Carried(const Sheet& sheet,
                               std::span<const glm::mat4> from,
                               std::span<const glm::mat4> to);

}  // namespace lararium::import
