#include "editor/bake/path_tracer.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "editor/bake/directions.h"
#include "shared/core/parallel.h"
#include "shared/core/random.h"
#include "shared/core/units.h"
#include "shared/geometry/glm_convert.h"

namespace lararium::bake {
namespace {

struct SurfacePoint {
  glm::vec3 position = glm::vec3(0.0f);
  glm::vec3 normal = glm::vec3(0.0f, 1.0f, 0.0f);  // Interpolated, on the side of the ray.
  glm::vec3 face = glm::vec3(0.0f, 1.0f, 0.0f);  // Normal of the triangle, on the side of the ray.
  glm::vec3 albedo = glm::vec3(0.0f);
  glm::vec3 emission = glm::vec3(0.0f);
};

// Random numbers of one path. They are well stratified over the paths of a pixel for the most
// important dimensions (the position in the pixel and the two directions from the first hit),
// and independent for later ones.
class PathRandom {
 public:
  PathRandom(const PathTracing& tracing, uint64_t pixel) : random_(tracing.seed, pixel) {
    for (SobolSeeds& seeds : seeds_) {
      seeds = {random_.Next(), random_.Next(), random_.Next()};
    }
  }

  void StartPath(int sample) {
    sample_ = static_cast<uint32_t>(sample);
    pair_ = 0;
  }
  glm::vec2 DrawPair() {
    if (pair_ < seeds_.size()) {
      return ShuffledSobolPoint(sample_, seeds_[pair_++]);
    }
    const uint32_t x = random_.Next();
    return {static_cast<float>(x >> 8) * 0x1p-24f,
            static_cast<float>(random_.Next() >> 8) * 0x1p-24f};
  }

 private:
  Random random_;
  std::array<SobolSeeds, 3> seeds_;
  uint32_t sample_ = 0;
  size_t pair_ = 0;
};

float PowerHeuristic(float density, float other) {
  const float a = density * density;
  return a > 0.0f ? a / (a + other * other) : 0.0f;
}

class Tracer {
 public:
  Tracer(std::span<const SurfaceMesh> meshes, const RayScene& rays, const Environment& environment)
      : meshes_(meshes), rays_(rays), environment_(environment) {}

  // Radiance towards the origin from the first mesh that a ray hits.
  struct Seen {
    uint32_t mesh = 0;
    glm::vec3 radiance = glm::vec3(0.0f);
  };
  std::optional<Seen> Trace(const glm::vec3& origin,
                            const glm::vec3& direction,
                            int bounces,
                            PathRandom& random) const;

 private:
  SurfacePoint PointOf(const glm::vec3& origin,
                       const glm::vec3& direction,
                       const RayHit& hit) const;
  glm::vec3 SampleProbe(const SurfacePoint& point, PathRandom& random) const;

  std::span<const SurfaceMesh> meshes_;
  const RayScene& rays_;
  const Environment& environment_;
};

SurfacePoint Tracer::PointOf(const glm::vec3& origin,
                             const glm::vec3& direction,
                             const RayHit& hit) const {
  const SurfaceMesh& mesh = meshes_[hit.mesh];
  SurfacePoint point;
  point.position = origin + hit.distance * direction;
  const bool behind = glm::dot(hit.face, direction) > 0.0f;
  point.face = behind ? -hit.face : hit.face;
  point.normal = mesh.NormalAt(hit.triangle, hit.barycentric);
  point.normal = behind ? -point.normal : point.normal;
  point.albedo = mesh.AlbedoAt(hit.triangle, hit.barycentric);
  point.emission = mesh.emission;
  return point;
}

// Light from a direction sampled from the probe, divided by the albedo.
glm::vec3 Tracer::SampleProbe(const SurfacePoint& point, PathRandom& random) const {
  const Environment::Sample sample = environment_.Draw(random.DrawPair());
  const float cosine = glm::dot(point.normal, sample.direction);
  if (sample.density <= 0.0f || cosine <= 0.0f || glm::dot(point.face, sample.direction) <= 0.0f ||
      rays_.Blocked(point.position, sample.direction)) {
    return glm::vec3(0.0f);
  }
  const float weight = PowerHeuristic(sample.density, cosine / kPiF);
  return environment_.Radiance(sample.direction) * (cosine / kPiF * weight / sample.density);
}

std::optional<Tracer::Seen> Tracer::Trace(const glm::vec3& origin,
                                          const glm::vec3& direction,
                                          int bounces,
                                          PathRandom& random) const {
  std::optional<RayHit> hit = rays_.Trace(origin, direction);
  if (!hit) {
    return std::nullopt;
  }
  const uint32_t seen = hit->mesh;
  SurfacePoint point = PointOf(origin, direction, *hit);
  glm::vec3 throughput(1.0f);
  glm::vec3 radiance(0.0f);
  for (int bounce = 0;; ++bounce) {
    radiance += throughput * point.emission;
    throughput *= point.albedo;
    radiance += throughput * SampleProbe(point, random);
    const glm::vec3 next = AroundNormal(point.normal, CosineDirection(random.DrawPair()));
    if (glm::dot(point.face, next) <= 0.0f) {
      break;
    }
    hit = rays_.Trace(point.position, next);
    if (!hit) {
      const float density = std::max(glm::dot(point.normal, next), 0.0f) / kPiF;
      const float weight = PowerHeuristic(density, environment_.Density(next));
      radiance += throughput * environment_.Radiance(next) * weight;
      break;
    }
    if (bounce >= bounces) {
      break;
    }
    point = PointOf(point.position, next, *hit);
  }
  return Seen{seen, radiance};
}

// Rays of an ideal pinhole camera in stage axes.
struct Lens {
  Lens(const geometry::CameraModel& camera, const geometry::Rigid3& camera_from_stage)
      : pinhole(camera) {
    const geometry::Rigid3 stage_from_camera = camera_from_stage.Inverse();
    eye = geometry::ToGlm(stage_from_camera.translation);
    turn = glm::mat3_cast(geometry::ToGlm(stage_from_camera.rotation));
  }

  glm::vec3 Direction(const glm::vec2& pixel) const {
    const glm::vec3 in_camera(
        (pixel.x - static_cast<float>(pinhole.cx)) / static_cast<float>(pinhole.fx),
        (pixel.y - static_cast<float>(pinhole.cy)) / static_cast<float>(pinhole.fy), 1.0f);
    return glm::normalize(turn * in_camera);
  }

  geometry::CameraModel pinhole;
  glm::vec3 eye = glm::vec3(0.0f);
  glm::mat3 turn = glm::mat3(1.0f);
};

void TraceRow(const Tracer& tracer,
              const Lens& lens,
              const PathTracing& tracing,
              int row,
              RadianceImage& image) {
  for (int column = 0; column < image.width; ++column) {
    const size_t index =
        static_cast<size_t>(row) * static_cast<size_t>(image.width) + static_cast<size_t>(column);
    PathRandom random(tracing, index);
    glm::vec4 drawn(0.0f);
    glm::vec4 real(0.0f);
    for (int sample = 0; sample < tracing.samples; ++sample) {
      random.StartPath(sample);
      const glm::vec2 pixel = glm::vec2(column, row) + random.DrawPair() - 0.5f;
      const auto seen = tracer.Trace(lens.eye, lens.Direction(pixel), tracing.bounces, random);
      if (seen) {
        (seen->mesh < tracing.first_real ? drawn : real) += glm::vec4(seen->radiance, 1.0f);
      }
    }
    image.pixels[index] = drawn / static_cast<float>(tracing.samples);
    if (!image.real.empty()) {
      image.real[index] = real / static_cast<float>(tracing.samples);
    }
  }
}

}  // namespace

Result<RadianceImage> TracePaths(std::span<const SurfaceMesh> meshes,
                                 const Environment& environment,
                                 const geometry::CameraModel& pinhole,
                                 const geometry::Rigid3& camera_from_stage,
                                 const PathTracing& tracing,
                                 Progress& progress) {
  LARARIUM_ASSIGN_OR_RETURN(const RayScene rays, RaysAt(meshes));
  const Tracer tracer(meshes, rays, environment);
  const Lens lens(pinhole, camera_from_stage);
  RadianceImage image{pinhole.width, pinhole.height, {}, {}};
  image.pixels.resize(static_cast<size_t>(image.width) * static_cast<size_t>(image.height));
  image.real.resize(tracing.first_real < meshes.size() ? image.pixels.size() : 0);
  // Renders in bands and reports progress between them from this thread.
  constexpr size_t kBand = 16;
  const auto height = static_cast<size_t>(image.height);
  for (size_t band = 0; band < height && !progress.Cancelled(); band += kBand) {
    progress.Report("tracing", static_cast<double>(band) / image.height);
    ParallelFor(std::min(kBand, height - band), [&](size_t i) {
      TraceRow(tracer, lens, tracing, static_cast<int>(band + i), image);
    });
  }
  if (progress.Cancelled()) {
    return Status::Error("reference image", "cancelled");
  }
  return image;
}

}  // namespace lararium::bake
