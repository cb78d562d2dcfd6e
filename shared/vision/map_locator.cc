#include "shared/vision/map_locator.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "shared/core/check.h"
#include "shared/core/parallel.h"

namespace lararium::vision {
namespace {

constexpr size_t kProbes = 256;         // Number of features that vote.
constexpr size_t kProbeJobs = 4;        // Number of parallel jobs per map.
constexpr int kProbeChecks = 32;        // Descriptors compared per probe and map.
constexpr size_t kProbeNeighbours = 4;  // Per probe; usually more than one point's descriptors.
constexpr size_t kMostTried = 3;        // Number of maps that are tried until one gives a pose.
constexpr int kVotesDistinct = 2;       // Votes of a probe that only one map explains.
constexpr int kVotesInOwnMap = 1;  // Votes of a probe that another map explains nearly as well.

}  // namespace

MapLocator::MapLocator(std::span<const std::shared_ptr<const SceneDatabase>> maps,
                       const LocalizerOptions& options)
    : ratio2_(static_cast<double>(options.ratio) * options.ratio) {
  CHECK(!maps.empty());
  for (const std::shared_ptr<const SceneDatabase>& database : maps) {
    CHECK(database != nullptr);
    Map& map = maps_.emplace_back();
    map.database = database;
    map.localizer = std::make_unique<Localizer>(*database, options);
    for (size_t i = 0; maps.size() > 1 && i < kProbeJobs; ++i) {
      map.searchers.emplace_back(database->forest, database->descriptors);
    }
  }
}

Located MapLocator::Locate(const Features& features, const CameraGuess& guess) {
  if (maps_.size() == 1) {
    return {0, maps_[0].localizer->Locate(features, guess)};
  }
  ChooseProbes(features);
  SearchProbes(features);
  CountVotes();
  const size_t tried = std::min(kMostTried, ranking_.size());
  Located likeliest{ranking_[0], maps_[ranking_[0]].localizer->Locate(features, guess)};
  for (size_t i = 1; i < tried && !likeliest.location.camera_from_map; ++i) {
    const uint32_t map = ranking_[i];
    if (votes_[map] == 0) {
      break;
    }
    const Location location = maps_[map].localizer->Locate(features, guess);
    if (location.camera_from_map) {
      return {map, location};
    }
  }
  return likeliest;
}

// Chooses the features of strongest response, because training is most likely to have them too.
void MapLocator::ChooseProbes(const Features& features) {
  probes_.resize(features.size());
  std::iota(probes_.begin(), probes_.end(), 0u);
  if (probes_.size() <= kProbes) {
    return;
  }
  const auto stronger = [&](uint32_t a, uint32_t b) {
    const float ra = features.keypoints[a].response;
    const float rb = features.keypoints[b].response;
    return ra != rb ? ra > rb : a < b;
  };
  std::nth_element(probes_.begin(), probes_.begin() + kProbes, probes_.end(), stronger);
  probes_.resize(kProbes);
}

void MapLocator::SearchProbes(const Features& features) {
  nearest_.assign(probes_.size() * maps_.size(), Nearest());
  ParallelFor(maps_.size() * kProbeJobs, [&](size_t work) {
    const size_t m = work / kProbeJobs;
    const size_t job = work % kProbeJobs;
    Map& map = maps_[m];
    std::array<Neighbour, kProbeNeighbours> found;
    const size_t end = probes_.size() * (job + 1) / kProbeJobs;
    for (size_t p = probes_.size() * job / kProbeJobs; p < end; ++p) {
      const size_t count =
          map.searchers[job].Search(features.descriptors[probes_[p]], kProbeChecks, found);
      if (count == 0) {
        continue;
      }
      Nearest& nearest = nearest_[p * maps_.size() + m];
      nearest.first = found[0].squared_distance;
      // If all neighbours belong to the same point, the distance of the last one is a lower bound
      // for that of any other point.
      nearest.other = found[count - 1].squared_distance;
      const auto& point_of = map.database->descriptor_point;
      for (size_t i = 1; i < count; ++i) {
        if (point_of[found[i].descriptor] != point_of[found[0].descriptor]) {
          nearest.other = found[i].squared_distance;
          break;
        }
      }
    }
  });
}

void MapLocator::CountVotes() {
  votes_.assign(maps_.size(), 0);
  for (size_t p = 0; p < probes_.size(); ++p) {
    const std::span<const Nearest> row(&nearest_[p * maps_.size()], maps_.size());
    const auto best =
        std::min_element(row.begin(), row.end(),
                         [](const Nearest& a, const Nearest& b) { return a.first < b.first; });
    if (best->first >= ratio2_ * best->other) {
      continue;
    }
    const bool distinct = std::all_of(row.begin(), row.end(), [&](const Nearest& other) {
      return &other == &*best || best->first < ratio2_ * other.first;
    });
    votes_[best - row.begin()] += distinct ? kVotesDistinct : kVotesInOwnMap;
  }
  ranking_.resize(maps_.size());
  std::iota(ranking_.begin(), ranking_.end(), 0u);
  std::stable_sort(ranking_.begin(), ranking_.end(),
                   [&](uint32_t a, uint32_t b) { return votes_[a] > votes_[b]; });
}

}  // namespace lararium::vision
