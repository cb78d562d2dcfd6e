#include "shared/stage/acoustics_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "shared/core/json.h"

namespace lararium::stage {
namespace {

constexpr double kMinDb = -60.0;
constexpr double kMaxDb = 12.0;
constexpr double kMaxMetres = 1e4;
constexpr size_t kMaxAcousticsText = 200;

// Indexed by Reverb.
constexpr std::array<std::string_view, 9> kReverbs = {"none",       "small_room", "wooden_room",
                                                      "stone_room", "corridor",   "hall",
                                                      "vault",      "courtyard",  "street"};

void DescribeAmbience(Fields& fields, Ambience& ambience) {
  fields.Text("sound", ambience.sound, kMaxAcousticsText);
  fields.Number(Optional("gain_db"), ambience.gain_db, kMinDb, kMaxDb);
  if (fields.Has("at", ambience.position.has_value())) {
    glm::vec3 at = ambience.position.value_or(glm::vec3(0.0f));
    fields.Numbers("at", std::span(&at.x, 3));
    fields.Require(std::max({std::abs(at.x), std::abs(at.y), std::abs(at.z)}) <= kMaxMetres,
                   "\"at\" lies too far away", "use coordinates of at most 10000 metres");
    if (fields.reading()) {
      ambience.position = at;
    }
  }
}

}  // namespace

std::string_view ReverbName(Reverb reverb) { return kReverbs[static_cast<size_t>(reverb)]; }

void DescribeFields(Fields& fields, Acoustics& acoustics) {
  fields.RefuseUnknown();
  fields.Choice(Optional("reverb"), acoustics.reverb, kReverbs, "there is no reverb '{}'",
                "choose one of {}");
  fields.Number(Optional("reverb_db"), acoustics.reverb_db, kMinDb, kMaxDb);
  fields.List(Optional("ambience", !acoustics.ambience.empty()), acoustics.ambience,
              Acoustics::kMaxAmbience, DescribeAmbience);
}

}  // namespace lararium::stage
