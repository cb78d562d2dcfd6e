// make_room_map FILE [POINTS [SESSIONS]]: writes the map of a room with a floor, as training would,
// for tests of the window. With several sessions, each filmed a part of the path, some points were
// observed in one session only, observations have small errors, and images show the points.

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "shared/core/random.h"
#include "tests/support/synthetic_world.h"

namespace {

using namespace lararium;

// Every third point was observed only in the session of its number. Errors of observations grow to
// the right.
void SplitIntoSessions(vision::SceneDatabase& db, uint32_t sessions) {
  Random random(5);
  const auto cameras = static_cast<uint32_t>(db.keyframes.size());
  for (uint32_t k = 0; k < cameras; ++k) {
    db.keyframes[k].session = k * sessions / cameras;
    db.keyframes[k].grey.setTo(60 + 100 * k / cameras);
  }
  std::erase_if(db.observations, [&](const vision::Observation& o) {
    return o.point % 3 == 0 && db.keyframes[o.keyframe].session != o.point / 3 % sessions;
  });
  std::fill(db.session_masks.begin(), db.session_masks.end(), 0u);
  std::fill(db.observation_counts.begin(), db.observation_counts.end(), 0u);
  for (vision::Observation& o : db.observations) {
    cv::Mat& grey = db.keyframes[o.keyframe].grey;
    const cv::Rect dot(static_cast<int>(o.x) - 2, static_cast<int>(o.y) - 2, 5, 5);
    grey(dot & cv::Rect(0, 0, grey.cols, grey.rows)).setTo(80 + o.point * 13 % 170);
    const double noise_px = 0.3 + 0.4 * (1.5 + static_cast<double>(db.points[o.point].x()));
    o.x += static_cast<float>(noise_px * random.Normal());
    o.y += static_cast<float>(noise_px * random.Normal());
    db.session_masks[o.point] |= 1u << db.keyframes[o.keyframe].session;
    ++db.observation_counts[o.point];
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: make_room_map FILE [POINTS [SESSIONS]]\n");
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
  vision::SceneDatabase database = test::MakeSceneDatabase(world);
  if (const int sessions = argc > 3 ? std::atoi(argv[3]) : 1; sessions > 1) {
    SplitIntoSessions(database, static_cast<uint32_t>(sessions));
  }
  const Status status = vision::SaveSceneDatabase(file, database);
  if (!status.ok()) {
    std::fprintf(stderr, "%s\n", status.message().c_str());
    return 1;
  }
  return 0;
}
