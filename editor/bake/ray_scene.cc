#include "editor/bake/ray_scene.h"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>
#include <vector>

namespace lararium::bake {
namespace {

constexpr uint8_t kSolid = 128;

// The data that Embree's filter needs for a mesh with coverage.
struct Coverage {
  std::vector<glm::vec2> uvs;
  std::vector<uint32_t> indices;
  cv::Mat image;

  bool Covers(uint32_t triangle, float u, float v) const {
    const glm::vec2& a = uvs[indices[3 * triangle]];
    const glm::vec2& b = uvs[indices[3 * triangle + 1]];
    const glm::vec2& c = uvs[indices[3 * triangle + 2]];
    const glm::vec2 uv = (1.0f - u - v) * a + u * b + v * c;
    return image.at<uint8_t>(WrappedTexel(uv, image.size())) >= kSolid;
  }
};

// Embree's filter gets one ray at a time here, because only single rays are cast.
void PassWhereUncovered(const RTCFilterFunctionNArguments* arguments) {
  const auto* coverage = static_cast<const Coverage*>(arguments->geometryUserPtr);
  const auto* hit = reinterpret_cast<const RTCHit*>(arguments->hit);
  if (!coverage->Covers(hit->primID, hit->u, hit->v)) {
    arguments->valid[0] = 0;
  }
}

RTCRay MakeRay(const glm::vec3& origin, const glm::vec3& direction, float near) {
  RTCRay ray = {};
  ray.org_x = origin.x;
  ray.org_y = origin.y;
  ray.org_z = origin.z;
  ray.tnear = near;
  ray.dir_x = direction.x;
  ray.dir_y = direction.y;
  ray.dir_z = direction.z;
  ray.tfar = std::numeric_limits<float>::infinity();
  ray.mask = 0xffffffffu;
  return ray;
}

// Embree 3 takes a context for each query, Embree 4 none.
#if RTC_VERSION_MAJOR >= 4
void Intersect(RTCScene scene, RTCRayHit& query) { rtcIntersect1(scene, &query); }
void FindOcclusion(RTCScene scene, RTCRay& ray) { rtcOccluded1(scene, &ray); }
#else
void Intersect(RTCScene scene, RTCRayHit& query) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene, &context, &query);
}
void FindOcclusion(RTCScene scene, RTCRay& ray) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(scene, &context, &ray);
}
#endif

}  // namespace

cv::Point WrappedTexel(const glm::vec2& uv, const cv::Size& size) {
  const auto texel = [](float coordinate, int count) {
    const float wrapped = coordinate - std::floor(coordinate);
    return std::clamp(static_cast<int>(wrapped * static_cast<float>(count)), 0, count - 1);
  };
  return {texel(uv.x, size.width), texel(uv.y, size.height)};
}

struct RayScene::State {
  State() = default;
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() {
    if (scene != nullptr) {
      rtcReleaseScene(scene);
    }
    if (device != nullptr) {
      rtcReleaseDevice(device);
    }
  }

  bool Add(const RayMesh& mesh);

  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  std::vector<std::unique_ptr<Coverage>> coverages;
};

bool RayScene::State::Add(const RayMesh& mesh) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* positions = static_cast<glm::vec3*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                              sizeof(glm::vec3), std::max<size_t>(mesh.positions.size(), 1)));
  auto* indices = static_cast<uint32_t*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(uint32_t), std::max<size_t>(mesh.indices.size() / 3, 1)));
  const bool made = positions != nullptr && indices != nullptr;
  if (made) {
    // A degenerate triangle keeps the index of a mesh without triangles.
    positions[0] = glm::vec3(0.0f);
    std::fill_n(indices, 3, 0u);
    std::copy(mesh.positions.begin(), mesh.positions.end(), positions);
    std::copy(mesh.indices.begin(), mesh.indices.end(), indices);
    if (!mesh.coverage.empty()) {
      coverages.push_back(
          std::make_unique<Coverage>(Coverage{{mesh.uvs.begin(), mesh.uvs.end()},
                                              {mesh.indices.begin(), mesh.indices.end()},
                                              mesh.coverage}));
      rtcSetGeometryUserData(geometry, coverages.back().get());
      rtcSetGeometryIntersectFilterFunction(geometry, PassWhereUncovered);
      rtcSetGeometryOccludedFilterFunction(geometry, PassWhereUncovered);
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
  }
  rtcReleaseGeometry(geometry);
  return made;
}

RayScene::RayScene(std::unique_ptr<State> state) : state_(std::move(state)) {}
RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;
RayScene::~RayScene() = default;

Result<RayScene> RayScene::Create(std::span<const RayMesh> meshes) {
  auto state = std::make_unique<State>();
  state->device = rtcNewDevice(nullptr);
  if (state->device == nullptr) {
    return Status::Error("ray casting", "Embree cannot be started on this processor");
  }
  state->scene = rtcNewScene(state->device);
  rtcSetSceneFlags(state->scene, RTC_SCENE_FLAG_ROBUST);
  bool anything = false;
  for (const RayMesh& mesh : meshes) {
    anything |= !mesh.indices.empty();
    if (!state->Add(mesh)) {
      return Status::Error("ray casting", "out of memory");
    }
  }
  if (!anything) {
    return Status::Error("ray casting", "the model has no triangles");
  }
  rtcCommitScene(state->scene);
  if (rtcGetDeviceError(state->device) != RTC_ERROR_NONE) {
    return Status::Error("ray casting", "out of memory");
  }
  return RayScene(std::move(state));
}

std::optional<RayHit> RayScene::Trace(const glm::vec3& origin,
                                      const glm::vec3& direction,
                                      float near) const {
  RTCRayHit query = {};
  query.ray = MakeRay(origin, direction, near);
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  Intersect(state_->scene, query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
    return std::nullopt;
  }
  const glm::vec3 face(query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z);
  return RayHit{query.ray.tfar, query.hit.geomID, query.hit.primID,
                glm::vec3(1.0f - query.hit.u - query.hit.v, query.hit.u, query.hit.v),
                face / std::max(glm::length(face), 1e-30f)};
}

bool RayScene::Blocked(const glm::vec3& origin, const glm::vec3& direction, float near) const {
  RTCRay ray = MakeRay(origin, direction, near);
  FindOcclusion(state_->scene, ray);
  return ray.tfar < 0.0f;
}

}  // namespace lararium::bake
