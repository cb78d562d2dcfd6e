// Skinning on the CPU: our job against a plain loop over Eigen's types, with the same vertices,
// influences and matrices. per_vertex is the cost of a vertex; BenchDualQuaternions measures the
// cost of a joint.

#include <benchmark/benchmark.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <vector>

#include "shared/core/random.h"
#include "shared/human/skinning.h"

namespace lararium::human {
namespace {

constexpr size_t kJoints = 72;  // People of the cast have as many.

// Vertices in the order of a body: neighbours share joints; a third each follow one, two and four
// joints.
struct Body {
  explicit Body(size_t count) {
    Random random(1);
    for (size_t i = 0; i < kJoints; ++i) {
      glm::mat4 matrix = glm::mat4_cast(glm::normalize(
          glm::quat(3.0f, glm::vec3{random.Normal(), random.Normal(), random.Normal()})));
      matrix[3] = glm::vec4{random.Normal(), random.Normal(), random.Normal(), 1.0f};
      skin.push_back(matrix);
    }
    for (size_t v = 0; v < count; ++v) {
      positions.push_back({random.Normal(), random.Normal(), random.Normal()});
      normals.push_back(glm::normalize(positions.back()));
      const auto joint = [&](size_t offset) {
        return static_cast<uint8_t>((v * kJoints / count + offset) % kJoints);
      };
      joints.push_back({joint(0), joint(1), joint(2), joint(3)});
      weights.push_back(v % 3 == 0   ? glm::vec4(1.0f, 0.0f, 0.0f, 0.0f)
                        : v % 3 == 1 ? glm::vec4(0.7f, 0.3f, 0.0f, 0.0f)
                                     : glm::vec4(0.5f, 0.3f, 0.15f, 0.05f));
    }
    posed.resize(count);
    posed_normals.resize(count);
  }

  std::vector<glm::mat4> skin;
  std::vector<glm::vec3> positions, normals, posed, posed_normals;
  std::vector<std::array<uint8_t, 4>> joints;
  std::vector<glm::vec4> weights;
};

void CountVertices(benchmark::State& state) {
  state.counters["per_vertex"] = benchmark::Counter(
      1e-9 * static_cast<double>(state.range(0)),
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void RunJob(benchmark::State& state, Skinning skinning) {
  Body body(static_cast<size_t>(state.range(0)));
  for (auto _ : state) {
    SkinningJob{body.positions, body.normals, body.joints, body.weights,
                body.skin,      skinning,     body.posed,  body.posed_normals}
        .Run();
    benchmark::DoNotOptimize(body.posed.data());
    benchmark::ClobberMemory();
  }
  CountVertices(state);
}

void BenchSkinningLinear(benchmark::State& state) { RunJob(state, Skinning::kLinear); }
void BenchSkinningDualQuaternion(benchmark::State& state) {
  RunJob(state, Skinning::kDualQuaternion);
}
BENCHMARK(BenchSkinningLinear)->Arg(15'000);
BENCHMARK(BenchSkinningDualQuaternion)->Arg(15'000);

// The straightforward implementation: blends the matrices, then transforms point and normal.
void BenchSkinningPlainEigen(benchmark::State& state) {
  Body body(static_cast<size_t>(state.range(0)));
  std::vector<Eigen::Matrix4f> skin;
  for (const glm::mat4& matrix : body.skin) {
    skin.push_back(Eigen::Map<const Eigen::Matrix4f>(glm::value_ptr(matrix)));
  }
  const size_t count = body.positions.size();
  std::vector<Eigen::Vector3f> positions(count), normals(count), posed(count), turned(count);
  for (size_t v = 0; v < count; ++v) {
    positions[v] = Eigen::Map<const Eigen::Vector3f>(glm::value_ptr(body.positions[v]));
    normals[v] = Eigen::Map<const Eigen::Vector3f>(glm::value_ptr(body.normals[v]));
  }
  for (auto _ : state) {
    for (size_t v = 0; v < count; ++v) {
      Eigen::Matrix4f blend = Eigen::Matrix4f::Zero();
      for (int k = 0; k < 4; ++k) {
        blend += body.weights[v][k] * skin[body.joints[v][k]];
      }
      posed[v] = (blend * positions[v].homogeneous()).head<3>();
      turned[v] = (blend.topLeftCorner<3, 3>() * normals[v]).normalized();
    }
    benchmark::DoNotOptimize(posed.data());
    benchmark::DoNotOptimize(turned.data());
    benchmark::ClobberMemory();
  }
  CountVertices(state);
}
BENCHMARK(BenchSkinningPlainEigen)->Arg(15'000);

// Converts all joints of one person.
void BenchDualQuaternions(benchmark::State& state) {
  const Body body(100);
  std::vector<DualQuaternion> packed(kJoints);
  for (auto _ : state) {
    for (size_t i = 0; i < kJoints; ++i) {
      packed[i] = ToDualQuaternion(body.skin[i]);
    }
    benchmark::DoNotOptimize(packed.data());
  }
  state.counters["per_joint"] = benchmark::Counter(
      1e-9 * kJoints, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(BenchDualQuaternions);

}  // namespace
}  // namespace lararium::human
