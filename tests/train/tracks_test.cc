#include "editor/train/tracks.h"

#include <gtest/gtest.h>

namespace lararium::train {
namespace {

VerifiedPair Pair(uint32_t a, uint32_t b, std::vector<FeatureMatch> matches) {
  VerifiedPair pair;
  pair.images = {a, b};
  pair.matches = std::move(matches);
  return pair;
}

TEST(BuildTracks, JoinsMatchesAcrossImages) {
  const std::vector<uint32_t> counts = {3, 3, 3};
  const Tracks tracks =
      BuildTracks(counts, std::vector{Pair(0, 1, {{0, 1}, {2, 2}}), Pair(1, 2, {{1, 0}})});
  ASSERT_EQ(tracks.size(), 2u);
  ASSERT_EQ(tracks[0].size() + tracks[1].size(), 5u);
  const auto longest = tracks[0].size() == 3 ? tracks[0] : tracks[1];
  ASSERT_EQ(longest.size(), 3u);
  for (uint32_t image = 0; image < 3; ++image) {
    EXPECT_EQ(longest[image].image, image);
  }
  EXPECT_EQ(longest[0].feature, 0u);
  EXPECT_EQ(longest[1].feature, 1u);
  EXPECT_EQ(longest[2].feature, 0u);
}

TEST(BuildTracks, NeverPutsAnImageTwiceIntoATrack) {
  // The chain 0:0 - 1:0 - 2:0 - 0:1 would contain two features of image 0.
  const std::vector<uint32_t> counts = {2, 1, 1};
  const Tracks tracks = BuildTracks(
      counts, std::vector{Pair(0, 1, {{0, 0}}), Pair(1, 2, {{0, 0}}), Pair(0, 2, {{1, 0}})});
  ASSERT_EQ(tracks.size(), 1u);
  EXPECT_EQ(tracks[0].size(), 3u);
}

TEST(BuildTracks, TrustsPairsOfMostMatchesFirst) {
  // The single false match of images 0 and 2 must not keep the true ones out.
  const std::vector<uint32_t> counts = {2, 2, 2};
  const Tracks tracks =
      BuildTracks(counts, std::vector{Pair(0, 2, {{0, 1}}), Pair(0, 1, {{0, 0}, {1, 1}}),
                                      Pair(1, 2, {{0, 0}, {1, 1}})});
  ASSERT_EQ(tracks.size(), 2u);
  for (size_t t = 0; t < 2; ++t) {
    ASSERT_EQ(tracks[t].size(), 3u);
    EXPECT_EQ(tracks[t][0].feature, tracks[t][2].feature);
  }
}

TEST(BuildTracks, OfNoMatchesIsEmpty) {
  const std::vector<uint32_t> counts = {2, 2};
  EXPECT_EQ(BuildTracks(counts, {}).size(), 0u);
}

}  // namespace
}  // namespace lararium::train
