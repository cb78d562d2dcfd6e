#include "editor/bake/transfer_solver.h"

#include <Eigen/Core>
#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

#include "editor/bake/directions.h"
#include "shared/core/parallel.h"
#include "shared/core/random.h"

namespace lararium::bake {
namespace {

constexpr int kMaxCount = light::kShCount;
constexpr float kNear = 2e-4f;  // Metres by which a ray starts away from its surface.
constexpr size_t kSitesPerJob = 64;

class Solver {
 public:
  Solver(const TransferSites& sites, const RayScene& rays, const TransferSolving& solving)
      : sites_(sites),
        rays_(rays),
        solving_(solving),
        count_(solving.count),
        arrived_(3 * solving.count, static_cast<Eigen::Index>(sites.size())),
        inside_(sites.size()),
        seen_(solving.bounces > 0 ? sites.size() : 0) {}

  SolvedTransfer Run() {
    ForSites([this](size_t site) { GatherDirect(site); });
    Eigen::MatrixXf arriving = arrived_;
    for (int bounce = 0; bounce < solving_.bounces; ++bounce) {
      ForSites([&](size_t site) { Reflect(site, arriving); });
      Eigen::MatrixXf next(arriving.rows(), arriving.cols());
      ForSites([&](size_t site) { GatherReflected(site, arriving, next); });
      arrived_ += next;
      arriving = std::move(next);
    }
    SolvedTransfer solved{std::vector<TransferVector>(sites_.size()), std::move(inside_)};
    ForSites([&](size_t site) {
      for (int channel = 0; channel < 3; ++channel) {
        float* to = &solved.vectors[site][static_cast<size_t>(channel) * kMaxCount];
        Eigen::Map<Eigen::VectorXf>(to, count_) = Channel(arrived_, site, channel);
      }
    });
    return solved;
  }

 private:
  // The coefficients of one channel at a site.
  Eigen::Map<Eigen::VectorXf> Channel(Eigen::MatrixXf& light, size_t site, int channel) const {
    return {&light(channel * count_, static_cast<Eigen::Index>(site)), count_};
  }

  template <typename Body>
  void ForSites(const Body& body) const {
    const size_t jobs = (sites_.positions.size() + kSitesPerJob - 1) / kSitesPerJob;
    ParallelFor(jobs, [&](size_t job) {
      const size_t end = std::min((job + 1) * kSitesPerJob, sites_.positions.size());
      for (size_t site = job * kSitesPerJob; site < end; ++site) {
        body(site);
      }
    });
  }

  // Shadowed direct light, the same for all channels.
  void GatherDirect(size_t site) {
    Random random(1, site);
    const uint32_t mask_x = random.Next();
    const uint32_t mask_y = random.Next();
    const glm::vec3& normal = sites_.normals[site];
    std::array<float, kMaxCount> sum = {};
    std::array<float, kMaxCount> basis;
    const std::span<float> used(basis.data(), static_cast<size_t>(solving_.count));
    for (int ray = 0; ray < solving_.rays; ++ray) {
      const glm::vec3 direction = AroundNormal(
          normal, CosineDirection(SobolPoint(static_cast<uint32_t>(ray), mask_x, mask_y)));
      if (const auto hit = rays_.Trace(sites_.positions[site], direction, kNear)) {
        Meet(site, direction, *hit, static_cast<float>(random.Uniform()));
        continue;
      }
      light::EvaluateShBasis(direction, used);
      for (size_t i = 0; i < used.size(); ++i) {
        sum[i] += used[i];
      }
    }
    // The density of the directions is cosine / pi.
    const float each = std::numbers::pi_v<float> / static_cast<float>(solving_.rays);
    for (int channel = 0; channel < 3; ++channel) {
      Channel(arrived_, site, channel) = each * Eigen::Map<Eigen::VectorXf>(sum.data(), count_);
    }
  }

  // Notes for the interreflections that a ray from a site met a surface: one corner of the triangle
  // stands for the point, chosen by a random number with its barycentric weight as probability.
  void Meet(size_t site, const glm::vec3& direction, const RayHit& hit, float random) {
    const bool behind = glm::dot(hit.face, direction) > 0.0f;
    const size_t first = behind ? sites_.first_back[hit.mesh] : sites_.first[hit.mesh];
    if (first == TransferSites::kNone) {
      inside_[site] += 1.0f / static_cast<float>(solving_.rays);
    } else if (solving_.bounces > 0) {
      const glm::vec3& weights = hit.barycentric;
      const size_t corner = random < weights.x ? 0 : random < weights.x + weights.y ? 1 : 2;
      seen_[site].push_back(static_cast<uint32_t>(
          first + sites_.meshes[hit.mesh].indices[3 * hit.triangle + corner]));
    }
  }

  // Turns the light that arrives at a site into what each ray that meets it carries. Radiance is
  // albedo / pi and the density cosine / pi, so pi cancels.
  void Reflect(size_t site, Eigen::MatrixXf& light) const {
    for (int channel = 0; channel < 3; ++channel) {
      Channel(light, site, channel) *=
          sites_.albedo[site][channel] / static_cast<float>(solving_.rays);
    }
  }

  void GatherReflected(size_t site, const Eigen::MatrixXf& carried, Eigen::MatrixXf& light) const {
    auto sum = light.col(static_cast<Eigen::Index>(site));
    sum.setZero();
    for (const uint32_t other : seen_[site]) {
      sum += carried.col(other);
    }
  }

  const TransferSites& sites_;
  const RayScene& rays_;
  const TransferSolving& solving_;
  int count_;
  // The light at each site, one column each: the coefficients of the channels in turn.
  Eigen::MatrixXf arrived_;
  std::vector<float> inside_;                // SolvedTransfer::inside.
  std::vector<std::vector<uint32_t>> seen_;  // The sites that the rays of each site met.
};

}  // namespace

TransferSites::TransferSites(std::vector<SurfaceMesh> surfaces) : meshes(std::move(surfaces)) {
  const auto add = [this](const SurfaceMesh& mesh, float side) {
    const size_t begin = positions.size();
    positions.insert(positions.end(), mesh.positions.begin(), mesh.positions.end());
    for (uint32_t v = 0; v < mesh.positions.size(); ++v) {
      normals.push_back(side * mesh.normals[v]);
      albedo.push_back(mesh.AlbedoAt(v));
    }
    return begin;
  };
  for (const SurfaceMesh& mesh : meshes) {
    first.push_back(add(mesh, 1.0f));
  }
  for (const SurfaceMesh& mesh : meshes) {
    first_back.push_back(mesh.two_sided ? add(mesh, -1.0f) : kNone);
  }
}

SolvedTransfer SolveTransfer(const TransferSites& sites,
                             const RayScene& rays,
                             const TransferSolving& solving) {
  return Solver(sites, rays, solving).Run();
}

void SpreadTransfer(std::span<const uint32_t> indices,
                    int passes,
                    std::vector<bool> marks,
                    std::span<TransferVector> vectors) {
  for (int pass = 0; pass < passes; ++pass) {
    std::vector<TransferVector> sums(vectors.size());
    std::vector<float> weights(vectors.size(), 0.0f);
    for (size_t i = 0; i < indices.size(); ++i) {
      const uint32_t to = indices[i];
      const uint32_t from = indices[i % 3 == 2 ? i - 2 : i + 1];
      for (const auto& [a, b] : {std::pair(from, to), std::pair(to, from)}) {
        if (!marks[a] && marks[b]) {
          for (size_t k = 0; k < sums[b].size(); ++k) {
            sums[b][k] += vectors[a][k];
          }
          weights[b] += 1.0f;
        }
      }
    }
    for (size_t v = 0; v < vectors.size(); ++v) {
      if (weights[v] > 0.0f) {
        for (size_t k = 0; k < sums[v].size(); ++k) {
          vectors[v][k] = sums[v][k] / weights[v];
        }
        marks[v] = false;
      }
    }
  }
}

glm::vec3 ShareOfEvenLight(const TransferVector& vector) {
  // The first harmonic is a constant: for radiance 1 / that constant, the unshadowed irradiance
  // is pi divided by it.
  const float first = light::EvaluateShBasis(glm::vec3(0.0f, 1.0f, 0.0f))[0];
  const glm::vec3 arrives(vector[0], vector[light::kShCount], vector[2 * light::kShCount]);
  return glm::clamp(arrives / (std::numbers::pi_v<float> * first), 0.0f, 1.0f);
}

}  // namespace lararium::bake
