// make_room_map FILE [POINTS]: writes the map of a room with a floor, as training would,
// for tests of the window.

#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "shared/core/random.h"
#include "tests/support/synthetic_world.h"

int main(int argc, char** argv) {
  using namespace lararium;
  if (argc < 2) {
    std::fprintf(stderr, "usage: make_room_map FILE [POINTS]\n");
    return 2;
  }
  test::SyntheticWorldOptions options;
  options.points = argc > 2 ? std::atoi(argv[2]) : 1500;
  test::SyntheticWorld world = test::MakeSyntheticWorld(options);
  Random random(9);
  for (size_t i = 0; i < world.points.size(); ++i) {
    const double x = random.Uniform(-1.5, 1.5);
    const double noise = 0.003 * random.Normal();
    world.points[i] = i % 3 != 0 ? Eigen::Vector3d(x, -1.0 + noise, random.Uniform(-1.5, 1.5))
                                 : Eigen::Vector3d(x, random.Uniform(-1.0, 1.0), -1.5 + noise);
  }
  const std::filesystem::path file = argv[1];
  std::error_code ignored;
  std::filesystem::create_directories(file.parent_path(), ignored);
  const Status status = vision::SaveSceneDatabase(file, test::MakeSceneDatabase(world));
  if (!status.ok()) {
    std::fprintf(stderr, "%s\n", status.message().c_str());
    return 1;
  }
  return 0;
}
