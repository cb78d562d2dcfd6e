#pragma once

// Light probes from HDR photographs (OpenEXR, Radiance .hdr).
//
// Storage convention (docs/file-formats.md): equirectangular, twice as wide as high, linear RGB
// radiance. Pixel (column, row), counted from the top left, is the direction of azimuth a = 2
// pi ((column + 0.5) / width - 0.5) and elevation e = pi (0.5 - (row + 0.5) / height), in the
// axes of the probe
//    (cos e sin a, sin e, -cos e cos a):
// the centre looks along -Z, the right half along +X, and the top row is the zenith (+Y). For a
// probe from a world with Z up, whose centre looks along +y and whose right half along +x, the
// same image is valid in the stage axes (x, z, -y).

#include <filesystem>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "shared/core/status.h"

namespace lararium::bake {

struct ProbeImage {
  int width = 0;
  int height = 0;
  std::vector<glm::vec3> pixels;      // Row by row, finite, not negative.
  std::vector<std::string> warnings;  // Problems that the user should know.
};

// Refuses images that are not 2:1, black, or strongly negative, and says which tool converts
// photographs and mirror balls. Repairs obvious damage with a warning: infinite texels
// (overflow of half floats) become the largest half float; NaN texels, at most one in a
// thousand, take the mean of their neighbours; slightly negative texels, left by resampling,
// become 0.
Result<ProbeImage> ReadProbeImage(const std::filesystem::path& file);

// Reads any HDR picture, for example of a mirror ball, 8 to 16384 pixels wide and high. Repairs
// and refuses damage as ReadProbeImage does.
Result<ProbeImage> ReadHdrPicture(const std::filesystem::path& file);

struct ProbePlacement {
  glm::quat stage_from_probe = glm::quat(1.0f, 0.0f, 0.0f, 0.0f);
  float radiance_scale = 1.0f;  // Stage radiance per unit in the file.
};

}  // namespace lararium::bake
