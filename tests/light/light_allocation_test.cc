// The light computation of a frame allocates nothing once its buffers exist.

#include <gtest/gtest.h>

#include "shared/light/key_poses.h"
#include "shared/light/probe_blend.h"
#include "shared/light/receivers.h"
#include "shared/light/transfer.h"
#include "tests/light/sh_test_support.h"
#include "tests/support/allocation_counter.h"

namespace lararium::light {
namespace {

constexpr size_t kReceivers = 20, kVertices = 30;
constexpr ReceiverRange kAll = {0, kReceivers};

struct Frame {
  explicit Frame(int count)
      : balls({{{0.3f, 1.0f, 0.2f}, 0.3f}, {{-0.5f, 1.2f, 0.0f}, 0.2f}}),
        points(std::vector<glm::vec3>(kReceivers, glm::vec3(0.1f, 0.2f, 0.3f))),
        turns(std::vector<glm::quat>(kReceivers, glm::quat(1.0f, 0.0f, 0.0f, 0.0f))),
        log(count, kReceivers),
        delta(count, kReceivers),
        keys(3, ShRows(count, kReceivers)),
        shadowed{log, log, log},
        turned{log, log, log},
        packed(count, kReceivers),
        transfer(QuantiseTransfer(
            std::vector<float>(3 * kVertices * 3 * static_cast<size_t>(count), 0.1f), count, 3)),
        receivers(kVertices),
        weights(kReceivers * kMaxKeyPoses),
        irradiance(kVertices) {
    for (VertexReceivers& of : receivers) {
      of = {{0, 5, 7, 19}, {100, 80, 50, 25}};
    }
    light[0] = glm::vec3(1.0f);
  }

  void Run() {
    const int count = log.count();
    ClearLogVisibility(kAll, log);
    AddLogVisibility(balls.spheres(), points.points(), turns.turns(), kAll, log);
    KeyPoseWeights(keys, log, {}, kAll, weights);
    SubtractKeyPoses(keys, log, weights, kAll, delta);
    ShadowLight(LightMatrix(light, count), delta, kAll, shadowed);
    TurnRows(shadowed, turns.turns(), TurnDirection::kBack, kAll, turned);
    PackReceiverLight(turned, packed);
    LightVerticesJob{&transfer, receivers, &packed, weights, irradiance}.Run(0, kVertices);
  }

  BallArrays balls;
  PointArrays points;
  TurnArrays turns;
  ShRgb light = {};
  ShRows log, delta;
  std::vector<ShRows> keys;
  ShRowsRgb shadowed, turned;
  ReceiverLight packed;
  Transfer transfer;
  std::vector<VertexReceivers> receivers;
  std::vector<float> weights;
  std::vector<glm::vec3> irradiance;
};

TEST(LightAllocation, AFrameAllocatesNothing) {
  for (const int count : {9, 16, 25}) {
    Frame frame(count);
    frame.Run();  // The first call creates the tables.
    test::AllocationCounter counter;
    frame.Run();
    EXPECT_EQ(counter.Stop(), 0) << count;
    EXPECT_GT(frame.irradiance[0].r, 0.0f);
  }
}

TEST(LightAllocation, BlendingProbesAllocatesNothing) {
  std::vector<PlacedProbe> probes(12);
  for (size_t i = 0; i < probes.size(); ++i) {
    probes[i].position.x = static_cast<float>(i / 3);
    probes[i].hour = 6.0 + 5.0 * static_cast<double>(i % 3);
  }
  test::AllocationCounter counter;
  Blend(probes, {1.7f, 0.0f, 0.5f}, 13.0);
  EXPECT_EQ(counter.Stop(), 0);
}

}  // namespace
}  // namespace lararium::light
