#include "shared/light/transfer.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "tests/light/sh_test_support.h"

namespace lararium::light {
namespace {

// Transfer vectors of skin by quadrature: clamped cosine about a normal, with a cap of the sky
// hidden, times an albedo. [vertex][3][count]
std::vector<float> SkinTransfer(Random& random, size_t vertices, int count) {
  std::vector<float> vectors;
  const std::vector<glm::vec3> directions = EvenDirections(600);
  for (size_t v = 0; v < vertices; ++v) {
    const glm::vec3 normal = RandomDirection(random);
    const glm::vec3 hidden = RandomDirection(random);
    const double edge = random.Uniform(0.3, 1.0);
    const auto brightness = static_cast<float>(std::pow(random.Uniform(0.1, 1.0), 2.0));
    const glm::vec3 albedo = brightness * glm::vec3(0.8f, 0.5f, 0.35f);
    std::vector<float> shape(static_cast<size_t>(count));
    for (const glm::vec3& direction : directions) {
      const float cosine = glm::dot(direction, normal);
      if (cosine > 0.0f && glm::dot(direction, hidden) < edge) {
        std::vector<float> basis(shape.size());
        EvaluateShBasis(direction, basis);
        for (size_t k = 0; k < shape.size(); ++k) {
          shape[k] += basis[k] * cosine * 4.0f * std::numbers::pi_v<float> / 600.0f;
        }
      }
    }
    for (int channel = 0; channel < 3; ++channel) {
      for (const float value : shape) {
        vectors.push_back(value * albedo[channel]);
      }
    }
  }
  return vectors;
}

// Root mean square of the decoding error relative to that of each vertex's vectors.
template <typename Decode>
double RelativeError(const Decode& decode, const std::vector<float>& vectors, size_t row) {
  std::vector<float> decoded(row);
  const size_t vertices = vectors.size() / row;
  double sum = 0.0;
  for (size_t v = 0; v < vertices; ++v) {
    decode(v, decoded);
    double error = 0.0, size = 0.0;
    for (size_t i = 0; i < row; ++i) {
      const double original = vectors[v * row + i];
      error += std::pow(decoded[i] - original, 2);
      size += original * original;
    }
    sum += error / size / static_cast<double>(vertices);
  }
  return std::sqrt(sum);
}

// Decodes [3][count] values of one vertex and pose.
void DecodeTransfer(const TransferBytes& transfer,
                    size_t pose,
                    size_t vertex,
                    std::span<float> vectors) {
  const size_t index = pose * transfer.vertices + vertex;
  const int8_t* row = transfer.values.data() + index * vectors.size();
  for (size_t i = 0; i < vectors.size(); ++i) {
    vectors[i] = row[i] * transfer.scale[index];
  }
}

class TransferOf : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Counts, TransferOf, testing::Values(9, 16, 25, 36));

TEST_P(TransferOf, BytesAreWithinHalfAStep) {
  Random random(61);
  const std::vector<float> vectors = SkinTransfer(random, 60, GetParam());
  const TransferBytes transfer = QuantiseTransfer(vectors, GetParam(), 2);
  const auto count = static_cast<size_t>(GetParam());
  std::vector<float> decoded(3 * count);
  for (size_t pose = 0; pose < 2; ++pose) {
    for (size_t v = 0; v < 30; ++v) {
      DecodeTransfer(transfer, pose, v, decoded);
      for (size_t i = 0; i < decoded.size(); ++i) {
        const float step = transfer.scale[pose * 30 + v];
        EXPECT_NEAR(decoded[i], vectors[(pose * 30 + v) * 3 * count + i], 0.501f * step);
      }
    }
  }
}

TEST_P(TransferOf, BytesLoseOnePerCent) {
  Random random(62);
  const std::vector<float> vectors = SkinTransfer(random, 200, GetParam());
  const TransferBytes transfer = QuantiseTransfer(vectors, GetParam(), 1);
  const double error = RelativeError(
      [&](size_t v, std::span<float> decoded) { DecodeTransfer(transfer, 0, v, decoded); }, vectors,
      3 * static_cast<size_t>(GetParam()));
  std::printf("  %d coefficients: relative error %.4f\n", GetParam(), error);
  EXPECT_LT(error, 0.012);
}

// If all channels have the same shape, the ratios keep it.
TEST_P(TransferOf, RowsLoseHalfAPerCentMoreWhereOneAlbedoTintsAll) {
  Random random(62);
  const std::vector<float> vectors = SkinTransfer(random, 200, GetParam());
  const Transfer transfer(QuantiseTransfer(vectors, GetParam(), 1));
  const double error =
      RelativeError([&](size_t v, std::span<float> decoded) { transfer.Decode(0, v, decoded); },
                    vectors, 3 * static_cast<size_t>(GetParam()));
  std::printf("  %d coefficients: relative error %.4f\n", GetParam(), error);
  EXPECT_LT(error, 0.017);
}

// White light from outside, plus light from a red, a green and a blue wall, each with its own lobe
// and a tenth as bright.
TEST_P(TransferOf, RowsKeepWhatWallsNearbyTint) {
  Random random(65);
  const auto count = static_cast<size_t>(GetParam());
  std::vector<float> vectors;
  for (size_t v = 0; v < 200; ++v) {
    const auto lobe = [&](float size) {
      std::vector<float> basis(count);
      EvaluateShBasis(RandomDirection(random), basis);
      for (size_t k = 0; k < count; ++k) {
        const float band = std::floor(std::sqrt(static_cast<float>(k)));
        basis[k] *= size / (1.0f + band * band);  // same decay as a clamped cosine
      }
      return basis;
    };
    const std::vector<float> white = lobe(1.0f);
    for (int channel = 0; channel < 3; ++channel) {
      const std::vector<float> tint = lobe(0.1f);
      for (size_t k = 0; k < count; ++k) {
        vectors.push_back(white[k] + tint[k]);
      }
    }
  }
  const Transfer transfer(QuantiseTransfer(vectors, GetParam(), 1));
  const double error =
      RelativeError([&](size_t v, std::span<float> decoded) { transfer.Decode(0, v, decoded); },
                    vectors, 3 * count);
  std::printf("  %d coefficients: relative error %.4f\n", GetParam(), error);
  EXPECT_LT(error, 0.04);  // The mean alone gives 0.054 to 0.056.
}

TEST(Transfer, BlackVerticesStayBlack) {
  const std::vector<float> vectors(2 * 27, 0.0f);
  const TransferBytes bytes = QuantiseTransfer(vectors, 9, 1);
  std::vector<float> decoded(27, 1.0f);
  DecodeTransfer(bytes, 0, 1, decoded);
  EXPECT_EQ(decoded, std::vector<float>(27, 0.0f));
  decoded.assign(27, 1.0f);
  Transfer(bytes).Decode(0, 1, decoded);
  EXPECT_EQ(decoded, std::vector<float>(27, 0.0f));
}

struct LitMesh {
  Transfer transfer;
  std::vector<VertexReceivers> receivers;
  ShRowsRgb light;
  std::vector<float> pose_weights;
};

LitMesh MakeMesh(int count, size_t vertices, size_t poses, size_t receivers) {
  Random random(64);
  LitMesh mesh;
  const std::vector<float> vectors = SkinTransfer(random, vertices * poses, count);
  mesh.transfer = Transfer(QuantiseTransfer(vectors, count, poses));
  for (size_t v = 0; v < vertices; ++v) {
    VertexReceivers& of = mesh.receivers.emplace_back();
    for (uint16_t& receiver : of.receiver) {
      receiver = static_cast<uint16_t>(random.Below(static_cast<uint32_t>(receivers)));
    }
    of.weight = {150, 70, 35, 0};
  }
  for (ShRows& rows : mesh.light) {
    rows = ShRows(count, receivers);
    for (int k = 0; k < count; ++k) {
      for (size_t i = 0; i < receivers; ++i) {
        rows.at(k, i) = static_cast<float>(random.Normal()) + (k == 0 ? 6.0f : 0.0f);
      }
    }
  }
  mesh.pose_weights.resize(receivers * kMaxKeyPoses);
  for (size_t i = 0; i < receivers; ++i) {
    const auto first = static_cast<float>(random.Uniform(0.1, 0.9));
    mesh.pose_weights[i * kMaxKeyPoses] = first;
    mesh.pose_weights[i * kMaxKeyPoses + 1] = 1.0f - first;
  }
  return mesh;
}

// The sum in the header, computed in doubles.
glm::dvec3 Expected(const LitMesh& mesh, size_t v) {
  const VertexReceivers& receivers = mesh.receivers[v];
  const int count = mesh.transfer.count();
  glm::dvec3 irradiance(0.0);
  for (size_t pose = 0; pose < mesh.transfer.poses(); ++pose) {
    double weight = 0.0;
    for (size_t r = 0; r < kReceiversOfVertex; ++r) {
      weight += receivers.weight[r] / 255.0 *
                mesh.pose_weights[receivers.receiver[r] * kMaxKeyPoses + pose];
    }
    std::vector<float> vectors(static_cast<size_t>(3 * count));
    mesh.transfer.Decode(pose, v, vectors);
    for (int channel = 0; channel < 3; ++channel) {
      for (int k = 0; k < count; ++k) {
        double light = 0.0;
        for (size_t r = 0; r < kReceiversOfVertex; ++r) {
          light += receivers.weight[r] / 255.0 *
                   mesh.light[static_cast<size_t>(channel)].at(k, receivers.receiver[r]);
        }
        irradiance[channel] += weight * light * vectors[static_cast<size_t>(channel * count + k)];
      }
    }
  }
  return glm::max(irradiance, 0.0);
}

TEST_P(TransferOf, VerticesAreLitByTheSumOfTheHeader) {
  const LitMesh mesh = MakeMesh(GetParam(), 50, 3, 21);
  ReceiverLight packed(GetParam(), 21);
  PackReceiverLight(mesh.light, packed);
  std::vector<glm::vec3> irradiance(50);
  const LightVerticesJob job{&mesh.transfer, mesh.receivers, &packed, mesh.pose_weights,
                             irradiance};
  job.Run(0, 17);
  job.Run(17, 50);
  for (size_t v = 0; v < irradiance.size(); ++v) {
    const glm::dvec3 expected = Expected(mesh, v);
    for (int channel = 0; channel < 3; ++channel) {
      // The largest coefficients are about 10 here, rounded to 1/64000 of that, and once more
      // for each receiver.
      EXPECT_NEAR(irradiance[v][channel], expected[channel], 5e-4 * (1.0 + expected[channel]));
    }
  }
}

// Pruning a weight below 1/64 costs at most that share of the difference of the poses.
TEST(LightVertices, SmallWeightsAreLeftOutAndTheOthersMakeUpForThem) {
  LitMesh mesh = MakeMesh(16, 20, 3, 4);
  for (size_t i = 0; i < 4; ++i) {
    mesh.pose_weights[i * kMaxKeyPoses] = 0.6f;
    mesh.pose_weights[i * kMaxKeyPoses + 1] = 0.39f;
    mesh.pose_weights[i * kMaxKeyPoses + 2] = 0.01f;
  }
  ReceiverLight packed(16, 4);
  PackReceiverLight(mesh.light, packed);
  std::vector<glm::vec3> irradiance(20);
  LightVerticesJob{&mesh.transfer, mesh.receivers, &packed, mesh.pose_weights, irradiance}.Run(0,
                                                                                               20);
  LitMesh pruned = mesh;
  for (size_t i = 0; i < 4; ++i) {
    pruned.pose_weights[i * kMaxKeyPoses] = 0.6f / 0.99f;
    pruned.pose_weights[i * kMaxKeyPoses + 1] = 0.39f / 0.99f;
    pruned.pose_weights[i * kMaxKeyPoses + 2] = 0.0f;
  }
  for (size_t v = 0; v < 20; ++v) {
    EXPECT_NEAR(irradiance[v].g, Expected(pruned, v).g, 5e-4);
  }
}

}  // namespace
}  // namespace lararium::light
