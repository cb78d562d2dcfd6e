#include "shared/stage/acoustics_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>

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

// Gain in dB; 0 if the field is missing.
Result<float> ParseDb(const JsonView& json, std::string_view key) {
  if (!json.Has(key)) {
    return 0.0f;
  }
  LARARIUM_ASSIGN_OR_RETURN(const double db, json.Number(key, kMinDb, kMaxDb));
  return static_cast<float>(db);
}

Result<Ambience> ParseAmbience(const JsonView& json) {
  LARARIUM_RETURN_IF_ERROR(json.CheckFields({"sound", "gain_db", "at"}));
  Ambience ambience;
  LARARIUM_ASSIGN_OR_RETURN(ambience.sound, json.Text("sound", kMaxAcousticsText));
  LARARIUM_ASSIGN_OR_RETURN(ambience.gain_db, ParseDb(json, "gain_db"));
  if (json.Has("at")) {
    LARARIUM_ASSIGN_OR_RETURN(const std::vector<double> at, json.Numbers("at", 3));
    if (std::any_of(at.begin(), at.end(), [](double c) { return std::abs(c) > kMaxMetres; })) {
      return json.Problem("\"at\" lies too far away", "use coordinates of at most 10000 metres");
    }
    ambience.position = glm::vec3(at[0], at[1], at[2]);
  }
  return ambience;
}

Result<Reverb> ParseReverb(const JsonView& json) {
  LARARIUM_ASSIGN_OR_RETURN(const std::string name, json.Text("reverb", kMaxAcousticsText));
  const auto found = std::find(kReverbs.begin(), kReverbs.end(), name);
  if (found != kReverbs.end()) {
    return static_cast<Reverb>(found - kReverbs.begin());
  }
  std::string known;
  for (const std::string_view reverb : kReverbs) {
    known += (known.empty() ? "" : ", ") + std::string(reverb);
  }
  return json.Problem("there is no reverb '" + name + "'", "choose one of " + known);
}

}  // namespace

std::string_view ReverbName(Reverb reverb) { return kReverbs[static_cast<size_t>(reverb)]; }

Result<Acoustics> ParseAcoustics(const JsonView& json) {
  LARARIUM_RETURN_IF_ERROR(json.CheckFields({"reverb", "reverb_db", "ambience"}));
  Acoustics acoustics;
  if (json.Has("reverb")) {
    LARARIUM_ASSIGN_OR_RETURN(acoustics.reverb, ParseReverb(json));
  }
  LARARIUM_ASSIGN_OR_RETURN(acoustics.reverb_db, ParseDb(json, "reverb_db"));
  if (json.Has("ambience")) {
    LARARIUM_ASSIGN_OR_RETURN(const JsonView field, json.Field("ambience"));
    LARARIUM_ASSIGN_OR_RETURN(const auto items, field.Array(Acoustics::kMaxAmbience));
    for (const JsonView& item : items) {
      LARARIUM_ASSIGN_OR_RETURN(acoustics.ambience.emplace_back(), ParseAmbience(item));
    }
  }
  return acoustics;
}

Json FormatAcoustics(const Acoustics& acoustics) {
  Json json = {{"reverb", ReverbName(acoustics.reverb)}, {"reverb_db", acoustics.reverb_db}};
  for (const Ambience& ambience : acoustics.ambience) {
    Json entry = {{"sound", ambience.sound}, {"gain_db", ambience.gain_db}};
    if (ambience.position) {
      entry["at"] = {ambience.position->x, ambience.position->y, ambience.position->z};
    }
    json["ambience"].push_back(std::move(entry));
  }
  return json;
}

}  // namespace lararium::stage
