#include "editor/import/wardrobe/dye.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "shared/core/srgb.h"

namespace lararium::import {
namespace {

// Dyes and natural colours of wool and leather; sRGB.
constexpr std::pair<const char*, uint32_t> kDyes[] = {
    {"undyed", 0xd9cbb0},      {"white", 0xe9e4d6},  {"ochre", 0xb98a3e},  {"madder", 0x9c3f2c},
    {"rust", 0x8a4a2a},        {"woad", 0x4a6480},   {"indigo", 0x2e3f5c}, {"walnut", 0x6a4c33},
    {"brown", 0x7d634a},       {"grey", 0x8d857a},   {"black", 0x37312d},  {"weld", 0xc9ab4c},
    {"green", 0x6b7146},       {"purple", 0x5a2440}, {"rose", 0xb4796c},   {"leather", 0x5c3a22},
    {"dark leather", 0x3a2618}};

}  // namespace

std::vector<std::string> DyeNames() {
  std::vector<std::string> names;
  for (const auto& [name, unused] : kDyes) {
    names.emplace_back(name);
  }
  return names;
}

void DescribeDye(Fields& fields, std::string_view key, glm::vec3& colour) {
  if (!fields.Has(key)) {
    return;
  }
  std::string text;
  uint32_t rgb = 0;
  fields.Text(key, text, 100);
  if (text.size() == 7 && text[0] == '#' &&
      text.find_first_not_of("0123456789abcdefABCDEF", 1) == std::string::npos) {
    rgb = static_cast<uint32_t>(std::stoul(text.substr(1), nullptr, 16));
  } else {
    const auto* dye = std::find_if(std::begin(kDyes), std::end(kDyes),
                                   [&](const auto& entry) { return text == entry.first; });
    std::string known;
    for (const auto& [name, unused] : kDyes) {
      known += (known.empty() ? "" : ", ") + std::string(name);
    }
    fields.RequireAt(key, dye != std::end(kDyes), "there is no dye '" + text.substr(0, 40) + "'",
                     "write #rrggbb or one of: " + known);
    rgb = dye != std::end(kDyes) ? dye->second : 0;
  }
  for (int k = 0; k < 3; ++k) {
    colour[k] = LinearFromSrgb(static_cast<float>(rgb >> (16 - 8 * k) & 0xffu) / 255.0f);
  }
}

}  // namespace lararium::import
