#pragma once

// Light probes from HDR photographs (OpenEXR, Radiance .hdr).
//
// Storage convention (docs/file-formats.md): equirectangular, twice as wide as
// high, linear RGB radiance. Pixel (column, row), counted from the top left, is
// the direction of azimuth a = 2 pi ((column + 0.5) / width - 0.5), elevation
// e = pi (0.5 - (row + 0.5) / height), in the probe's axes
//     (cos e sin a, sin e, -cos e cos a):
// the centre looks along -Z, the right half along +X, the top row is the zenith
// (+Y). A probe in a world with Z up whose centre looks along +y and whose right
// half along +x is the same image for the stage axes (x, z, -y).

#include <filesystem>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "shared/core/status.h"
#include "shared/light/spherical_harmonics.h"

namespace lararium::bake {

struct ProbeImage {
  int width = 0;
  int height = 0;
  std::vector<glm::vec3> pixels;      // row by row, finite, not negative
  std::vector<std::string> warnings;  // what a person should know about the image
};

// Refuses images that are not 2:1, black, or strongly negative, and names the tool for
// photographs and mirror balls that were taken for probes. Mends with a warning what is
// plainly damage: infinite texels (half floats that ran over) become the largest half; up to
// one in a thousand that is no number takes the mean of its neighbours; slightly negative
// ones (resampling leaves them) become 0.
Result<ProbeImage> ReadProbeImage(const std::filesystem::path& file);

// Any HDR picture, of a mirror ball for example: 8 to 16384 pixels wide and high, mended and
// refused as above.
Result<ProbeImage> ReadHdrPicture(const std::filesystem::path& file);

struct ProbePlacement {
  glm::quat stage_from_probe = glm::quat(1.0f, 0.0f, 0.0f, 0.0f);
  float radiance_scale = 1.0f;  // stage radiance for each unit in the file
};

// The light of a probe image in stage axes.
light::ShRgb ProjectProbe(const ProbeImage& image, const ProbePlacement& placement);
Result<light::ShRgb> BakeProbe(const std::filesystem::path& file, const ProbePlacement& placement);

}  // namespace lararium::bake
