#include "editor/bake/transfer_solver.h"

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

// A hit of a ray from a site: the corners of the triangle, as sites, and their weights.
struct Meeting {
  std::array<uint32_t, 3> corners = {};
  std::array<float, 3> weights = {};
};

class Solver {
 public:
  Solver(const TransferSites& sites, const RayScene& rays, const TransferSolving& solving)
      : sites_(sites),
        rays_(rays),
        solving_(solving),
        result_{std::vector<TransferVector>(sites.size()), std::vector<float>(sites.size())},
        meetings_(solving.bounces > 0 ? sites.size() : 0) {}

  SolvedTransfer Run() {
    ForSites([this](size_t site) { GatherDirect(site); });
    std::vector<TransferVector> arriving = result_.vectors;
    for (int bounce = 0; bounce < solving_.bounces; ++bounce) {
      std::vector<TransferVector> next(arriving.size());
      ForSites([&](size_t site) { next[site] = GatherReflected(site, arriving); });
      ForSites([&](size_t site) {
        for (size_t i = 0; i < next[site].size(); ++i) {
          result_.vectors[site][i] += next[site][i];
        }
      });
      arriving = std::move(next);
    }
    return std::move(result_);
  }

 private:
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
        Meet(site, direction, *hit);
        continue;
      }
      light::EvaluateShBasis(direction, used);
      for (size_t i = 0; i < used.size(); ++i) {
        sum[i] += used[i];
      }
    }
    // The density of the directions is cosine / pi.
    const float each = std::numbers::pi_v<float> / static_cast<float>(solving_.rays);
    for (size_t i = 0; i < used.size(); ++i) {
      for (size_t channel = 0; channel < 3; ++channel) {
        result_.vectors[site][channel * kMaxCount + i] = each * sum[i];
      }
    }
  }

  // Stores a hit of a ray from a site for the interreflections.
  void Meet(size_t site, const glm::vec3& direction, const RayHit& hit) {
    const bool behind = glm::dot(hit.face, direction) > 0.0f;
    const size_t first = behind ? sites_.first_back[hit.mesh] : sites_.first[hit.mesh];
    if (first == TransferSites::kNone) {
      result_.inside[site] += 1.0f / static_cast<float>(solving_.rays);
      return;
    }
    if (solving_.bounces == 0) {
      return;
    }
    Meeting meeting;
    const SurfaceMesh& mesh = sites_.meshes[hit.mesh];
    for (size_t corner = 0; corner < 3; ++corner) {
      meeting.corners[corner] =
          static_cast<uint32_t>(first + mesh.indices[3 * hit.triangle + corner]);
      meeting.weights[corner] = hit.barycentric[static_cast<int>(corner)];
    }
    meetings_[site].push_back(meeting);
  }

  // Light reflected from the surfaces that the rays of a site hit, given the light arriving
  // there.
  TransferVector GatherReflected(size_t site, const std::vector<TransferVector>& arriving) const {
    TransferVector sum = {};
    const auto count = static_cast<size_t>(solving_.count);
    for (const Meeting& meeting : meetings_[site]) {
      for (size_t corner = 0; corner < 3; ++corner) {
        const uint32_t other = meeting.corners[corner];
        for (size_t channel = 0; channel < 3; ++channel) {
          // Radiance is albedo / pi and the density cosine / pi, so pi cancels.
          const float share = meeting.weights[corner] *
                              sites_.albedo[other][static_cast<int>(channel)] /
                              static_cast<float>(solving_.rays);
          const float* from = &arriving[other][channel * kMaxCount];
          float* to = &sum[channel * kMaxCount];
          for (size_t i = 0; i < count; ++i) {
            to[i] += share * from[i];
          }
        }
      }
    }
    return sum;
  }

  const TransferSites& sites_;
  const RayScene& rays_;
  const TransferSolving& solving_;
  SolvedTransfer result_;
  std::vector<std::vector<Meeting>> meetings_;
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
