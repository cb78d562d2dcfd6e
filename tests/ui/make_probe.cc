// Writes a small light probe: a grey sky and a sun to the right, 30 degrees high.
//
//   make_probe OUT.exr

#include <cstdio>
#include <cstdlib>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "editor/bake/exr_image.h"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: make_probe OUT.exr\n");
    return 2;
  }
  constexpr int kWidth = 256;
  constexpr int kHeight = 128;
  std::vector<glm::vec4> pixels;
  for (int row = 0; row < kHeight; ++row) {
    for (int column = 0; column < kWidth; ++column) {
      const float ground = row < kHeight / 2 ? 0.5f : 0.15f;
      const bool is_sun = std::abs(row - kHeight / 3) < 2 && std::abs(column - 3 * kWidth / 4) < 2;
      pixels.emplace_back(is_sun ? glm::vec4(3000.0f, 2700.0f, 2200.0f, 1.0f)
                                 : glm::vec4(glm::vec3(ground), 1.0f));
    }
  }
  const lararium::Status status = lararium::bake::WriteExr(argv[1], kWidth, kHeight, pixels);
  if (!status.ok()) {
    std::fprintf(stderr, "%s\n", status.message().c_str());
  }
  return status.ok() ? 0 : 1;
}
