// thin_map FILE FRAME...: removes keyframes from a map, as if training had not chosen them.

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "shared/vision/scene_database.h"

int main(int argc, char** argv) {
  using namespace lararium;
  if (argc < 3) {
    std::fprintf(stderr, "usage: thin_map FILE FRAME...\n");
    return 2;
  }
  Result<vision::SceneDatabase> map = vision::LoadSceneDatabase(argv[1]);
  if (!map.ok()) {
    std::fprintf(stderr, "%s\n", map.message().c_str());
    return 1;
  }
  std::vector<int64_t> frames;
  for (int i = 2; i < argc; ++i) {
    frames.push_back(std::atoll(argv[i]));
  }
  std::vector<uint32_t> number(map->keyframes.size());  // New index of each kept keyframe.
  std::vector<vision::Keyframe> kept;
  std::vector<bool> stays;
  for (size_t i = 0; i < map->keyframes.size(); ++i) {
    const int64_t frame = map->keyframes[i].frame_index;
    stays.push_back(std::find(frames.begin(), frames.end(), frame) == frames.end());
    number[i] = static_cast<uint32_t>(kept.size());
    if (stays.back()) {
      kept.push_back(map->keyframes[i]);
    }
  }
  std::erase_if(map->observations, [&](const auto& o) { return !stays[o.keyframe]; });
  for (vision::Observation& observation : map->observations) {
    observation.keyframe = number[observation.keyframe];
  }
  map->keyframes = std::move(kept);
  const Status status = vision::SaveSceneDatabase(argv[1], *map);
  if (!status.ok()) {
    std::fprintf(stderr, "%s\n", status.message().c_str());
    return 1;
  }
  return 0;
}
