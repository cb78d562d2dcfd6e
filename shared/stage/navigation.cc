#include "shared/stage/navigation.h"

#include <DetourCommon.h>
#include <DetourCrowd.h>
#include <DetourNavMeshBuilder.h>
#include <Recast.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "shared/core/check.h"
#include "shared/geometry/glm_convert.h"

namespace lararium::stage {
namespace {

constexpr float kCellHeight = 0.05f;
constexpr float kBelowFloor = 0.3f;    // Space below the floor that is voxelised, metres.
constexpr float kMaxExtent = 100.0f;   // Largest distance of a corner from the origin, metres.
constexpr int kMaxCellsAcross = 1000;  // Larger floors get larger cells.
constexpr int kCrowdTicks = 4;
constexpr float kCrowdSeconds =
    static_cast<float>(kCrowdTicks) / static_cast<float>(Navigation::kTicksPerSecond);
constexpr int kMaxPath = 256;
constexpr float kRoom = 0.22f;  // Radius of a walker among others, metres.
constexpr unsigned char kSteering = DT_CROWD_ANTICIPATE_TURNS | DT_CROWD_OBSTACLE_AVOIDANCE |
                                    DT_CROWD_OPTIMIZE_VIS | DT_CROWD_OPTIMIZE_TOPO;
constexpr float kAcceleration = 2.5f;  // m/s^2
constexpr unsigned char kFirstGateArea = 1;
constexpr unsigned short kOpenFlag = 1;
constexpr float kSearchHeight = 1.0f;

template <auto kFree>
struct Freeing {
  template <typename T>
  void operator()(T* pointer) const {
    kFree(pointer);
  }
};
using HeightfieldPtr = std::unique_ptr<rcHeightfield, Freeing<rcFreeHeightField>>;
using CompactPtr = std::unique_ptr<rcCompactHeightfield, Freeing<rcFreeCompactHeightfield>>;
using ContoursPtr = std::unique_ptr<rcContourSet, Freeing<rcFreeContourSet>>;
using PolyMeshPtr = std::unique_ptr<rcPolyMesh, Freeing<rcFreePolyMesh>>;
using NavMeshPtr = std::unique_ptr<dtNavMesh, Freeing<dtFreeNavMesh>>;
using QueryPtr = std::unique_ptr<dtNavMeshQuery, Freeing<dtFreeNavMeshQuery>>;
using CrowdPtr = std::unique_ptr<dtCrowd, Freeing<dtFreeCrowd>>;

struct Point3 {
  explicit Point3(glm::vec2 p) : values{p.x, 0.0f, p.y} {}
  operator const float*() const { return values.data(); }  // NOLINT: Detour expects it.
  std::array<float, 3> values;
};

glm::vec2 OnFloor(const float* point) { return {point[0], point[2]}; }

Status Failed(std::string_view problem, std::string_view remedy = {}) {
  return Status::Error("navigation", problem, remedy);
}

bool Inside(const std::vector<glm::vec2>& outline, glm::vec2 p) {
  bool inside = false;
  for (size_t i = 0, k = outline.size() - 1; i < outline.size(); k = i++) {
    const glm::vec2 a = outline[i];
    const glm::vec2 b = outline[k];
    if ((a.y > p.y) != (b.y > p.y) && p.x < (b.x - a.x) * (p.y - a.y) / (b.y - a.y) + a.x) {
      inside = !inside;
    }
  }
  return inside;
}

// Builds the mesh in the steps of Recast's manual.
class MeshBuilder {
 public:
  MeshBuilder(const NavigationOptions& options,
              std::span<const NavigationSolid> solids,
              std::span<const BlockedArea> areas)
      : options_(options), solids_(solids), areas_(areas) {
    lower_ = upper_ = options.floor[0];
    for (const glm::vec2& corner : options.floor) {
      lower_ = glm::min(lower_, corner);
      upper_ = glm::max(upper_, corner);
    }
    const glm::vec2 extent = upper_ - lower_;
    cell_ = std::max(options.cell, std::max(extent.x, extent.y) / kMaxCellsAcross);
    walkable_height_ = static_cast<int>(std::ceil(options.walker_height / kCellHeight));
    walkable_climb_ = static_cast<int>(std::floor(options.step / kCellHeight));
  }

  Result<NavMeshPtr> Build() {
    LARARIUM_RETURN_IF_ERROR(Voxelise());
    LARARIUM_RETURN_IF_ERROR(MarkAreas());
    LARARIUM_RETURN_IF_ERROR(MakePolygons());
    return MakeNavMesh();
  }

 private:
  static Status OutOfMemory() { return Failed("there is too little memory for the floor"); }

  Status Voxelise() {
    field_.reset(rcAllocHeightfield());
    const glm::vec2 size = glm::ceil((upper_ - lower_) / cell_);
    const float bottom[3] = {lower_.x, -kBelowFloor, lower_.y};
    const float top[3] = {lower_.x + size.x * cell_, options_.walker_height + 0.5f,
                          lower_.y + size.y * cell_};
    if (!field_ ||
        !rcCreateHeightfield(&context_, *field_, static_cast<int>(size.x), static_cast<int>(size.y),
                             bottom, top, cell_, kCellHeight)) {
      return OutOfMemory();
    }
    if (!AddFloor()) {
      return OutOfMemory();
    }
    for (const NavigationSolid& solid : solids_) {
      if (!AddSolid(solid)) {
        return OutOfMemory();
      }
    }
    rcFilterLowHangingWalkableObstacles(&context_, walkable_climb_, *field_);
    rcFilterWalkableLowHeightSpans(&context_, walkable_height_, *field_);
    compact_.reset(rcAllocCompactHeightfield());
    if (!compact_ || !rcBuildCompactHeightfield(&context_, walkable_height_, walkable_climb_,
                                                *field_, *compact_)) {
      return OutOfMemory();
    }
    return Status();
  }

  bool AddFloor() {
    const auto top = static_cast<unsigned short>(std::lround(kBelowFloor / kCellHeight));
    for (int z = 0; z < field_->height; ++z) {
      for (int x = 0; x < field_->width; ++x) {
        const glm::vec2 centre = lower_ + cell_ * glm::vec2(x + 0.5f, z + 0.5f);
        if (Inside(options_.floor, centre) &&
            !rcAddSpan(&context_, *field_, x, z, top - 1, top, RC_WALKABLE_AREA, walkable_climb_)) {
          return false;
        }
      }
    }
    return true;
  }

  bool AddSolid(const NavigationSolid& solid) {
    std::vector<float> corners;
    corners.reserve(solid.mesh->indices.size() * 3);
    for (const uint32_t index : solid.mesh->indices) {
      const Eigen::Vector3d p =
          solid.stage_from_mesh * geometry::ToEigen(solid.mesh->positions[index]);
      // Clamps far corners: they do not matter, and Recast counts cells in int.
      for (int axis = 0; axis < 3; ++axis) {
        corners.push_back(static_cast<float>(std::clamp(p[axis], -1e4, 1e4)));
      }
    }
    const int triangles = static_cast<int>(solid.mesh->indices.size() / 3);
    const std::vector<unsigned char> areas(static_cast<size_t>(triangles), RC_NULL_AREA);
    return triangles == 0 || rcRasterizeTriangles(&context_, corners.data(), areas.data(),
                                                  triangles, *field_, walkable_climb_);
  }

  void Mark(const std::vector<glm::vec2>& outline, float margin, unsigned char area) {
    std::vector<float> corners;
    for (const glm::vec2& corner : outline) {
      corners.insert(corners.end(), {corner.x, 0.0f, corner.y});
    }
    const int count = static_cast<int>(outline.size());
    std::vector<float> wider(corners.size() * 4);
    int wider_count = 0;
    if (margin > 0.0f) {
      wider_count = rcOffsetPoly(corners.data(), count, margin, wider.data(), 4 * count);
    }
    rcMarkConvexPolyArea(&context_, wider_count > 0 ? wider.data() : corners.data(),
                         wider_count > 0 ? wider_count : count, -kBelowFloor,
                         options_.walker_height, area, *compact_);
  }

  Status MarkAreas() {
    for (const BlockedArea& area : areas_) {
      if (!area.gate) {
        Mark(area.outline, 0.0f, RC_NULL_AREA);
      }
    }
    const int radius = static_cast<int>(std::ceil(options_.walker_radius / cell_));
    if (!rcErodeWalkableArea(&context_, radius, *compact_)) {
      return OutOfMemory();
    }
    unsigned char gate_area = kFirstGateArea;
    for (const BlockedArea& area : areas_) {
      if (area.gate) {
        Mark(Clockwise(area.outline), options_.walker_radius, gate_area++);
      }
    }
    return Status();
  }

  // Orders the corners so that rcOffsetPoly widens the outline.
  static std::vector<glm::vec2> Clockwise(std::vector<glm::vec2> outline) {
    float area = 0.0f;
    for (size_t i = 0, k = outline.size() - 1; i < outline.size(); k = i++) {
      area += outline[k].x * outline[i].y - outline[i].x * outline[k].y;
    }
    if (area > 0.0f) {
      std::reverse(outline.begin(), outline.end());
    }
    return outline;
  }

  Status MakePolygons() {
    contours_.reset(rcAllocContourSet());
    polygons_.reset(rcAllocPolyMesh());
    if (!contours_ || !polygons_ || !rcBuildDistanceField(&context_, *compact_) ||
        !rcBuildRegions(&context_, *compact_, 0, 30, 400) ||
        !rcBuildContours(&context_, *compact_, 1.0f, 0, *contours_) ||
        !rcBuildPolyMesh(&context_, *contours_, DT_VERTS_PER_POLYGON, *polygons_)) {
      return Failed("the floor is too large or too intricate", "make it smaller");
    }
    if (polygons_->npolys == 0) {
      return Failed("there is no place to walk on the stage's floor",
                    "make the floor larger or remove what stands in the way");
    }
    for (int i = 0; i < polygons_->npolys; ++i) {
      polygons_->flags[i] = polygons_->areas[i] == RC_WALKABLE_AREA ? kOpenFlag : 0;
    }
    return Status();
  }

  Result<NavMeshPtr> MakeNavMesh() {
    dtNavMeshCreateParams params = {};
    params.verts = polygons_->verts;
    params.vertCount = polygons_->nverts;
    params.polys = polygons_->polys;
    params.polyAreas = polygons_->areas;
    params.polyFlags = polygons_->flags;
    params.polyCount = polygons_->npolys;
    params.nvp = polygons_->nvp;
    params.walkableHeight = options_.walker_height;
    params.walkableRadius = options_.walker_radius;
    params.walkableClimb = options_.step;
    params.cs = polygons_->cs;
    params.ch = polygons_->ch;
    params.buildBvTree = true;
    rcVcopy(params.bmin, polygons_->bmin);
    rcVcopy(params.bmax, polygons_->bmax);
    unsigned char* data = nullptr;
    int size = 0;
    if (!dtCreateNavMeshData(&params, &data, &size)) {
      return Failed("the floor is too intricate", "make it smaller");
    }
    NavMeshPtr mesh(dtAllocNavMesh());
    if (!mesh || dtStatusFailed(mesh->init(data, size, DT_TILE_FREE_DATA))) {
      dtFree(data);
      return OutOfMemory();
    }
    return mesh;
  }

  const NavigationOptions& options_;
  std::span<const NavigationSolid> solids_;
  std::span<const BlockedArea> areas_;
  glm::vec2 lower_;
  glm::vec2 upper_;
  float cell_;
  int walkable_height_;
  int walkable_climb_;
  rcContext context_{false};
  HeightfieldPtr field_;
  CompactPtr compact_;
  ContoursPtr contours_;
  PolyMeshPtr polygons_;
};

// A point of the mesh with the polygon that it lies in.
struct MeshPoint {
  dtPolyRef polygon = 0;
  glm::vec2 point = glm::vec2(0.0f);
};

struct Walker {
  bool goes = false;                  // The crowd moves it; false: only Place() does.
  glm::vec2 from = glm::vec2(0.0f);   // Position at the last step of the crowd.
  glm::vec2 to = glm::vec2(0.0f);     // Position at the next step.
  glm::vec2 speed = glm::vec2(0.0f);  // Velocity, m/s; that given to Place() if held.
};

// Copies all of a settled agent except its corridor and its cached surroundings.
void CopyAgent(const dtCrowdAgent& from, dtCrowdAgent& to) {
  to.active = from.active;
  to.state = from.state;
  to.partial = from.partial;
  to.topologyOptTime = from.topologyOptTime;
  std::copy(std::begin(from.neis), std::end(from.neis), std::begin(to.neis));
  to.nneis = from.nneis;
  to.desiredSpeed = from.desiredSpeed;
  dtVcopy(to.npos, from.npos);
  dtVcopy(to.disp, from.disp);
  dtVcopy(to.dvel, from.dvel);
  dtVcopy(to.nvel, from.nvel);
  dtVcopy(to.vel, from.vel);
  to.params = from.params;
  std::copy(std::begin(from.cornerVerts), std::end(from.cornerVerts), std::begin(to.cornerVerts));
  std::copy(std::begin(from.cornerFlags), std::end(from.cornerFlags), std::begin(to.cornerFlags));
  std::copy(std::begin(from.cornerPolys), std::end(from.cornerPolys), std::begin(to.cornerPolys));
  to.ncorners = from.ncorners;
  to.targetState = from.targetState;
  to.targetRef = from.targetRef;
  dtVcopy(to.targetPos, from.targetPos);
  to.targetPathqRef = from.targetPathqRef;
  to.targetReplan = from.targetReplan;
  to.targetReplanTime = from.targetReplanTime;
}

}  // namespace

struct Navigation::State {
  struct Agent {
    int walker = 0;
    std::array<float, 3> position = {};  // Start of the corridor.
    std::array<float, 3> target = {};
    std::vector<dtPolyRef> path;
    dtCrowdAgent plain;
  };
  std::vector<std::unique_ptr<Agent>> agents;  // Pointers, because dtCrowdAgent cannot be moved.
  std::array<Walker, kMaxWalkers> walkers = {};
  std::vector<uint8_t> gates;  // 1: open.
  int ticks = 0;
};

struct Navigation::Parts {
  NavMeshPtr mesh;
  QueryPtr query;
  CrowdPtr crowd;
  dtQueryFilter filter;
  std::array<Walker, kMaxWalkers> walkers = {};
  std::vector<std::vector<dtPolyRef>> gates;
  std::vector<uint8_t> open;  // Per gate; 1: open.
  mutable std::array<dtPolyRef, kMaxPath> path = {};
  mutable std::array<float, 3 * kMaxPath> corners = {};
  int ticks = 0;  // Ticks since the last step of the crowd.

  std::optional<MeshPoint> Nearest(glm::vec2 point, float within) const {
    const float extents[3] = {within, kSearchHeight, within};
    float nearest[3];
    MeshPoint found;
    const dtStatus status =
        query->findNearestPoly(Point3(point), extents, &filter, &found.polygon, nearest);
    if (dtStatusFailed(status) || found.polygon == 0) {
      return std::nullopt;
    }
    found.point = OnFloor(nearest);
    if (glm::distance(found.point, point) > within) {
      return std::nullopt;
    }
    return found;
  }

  // The nearest point at any distance.
  std::optional<MeshPoint> Nearest(glm::vec2 point) const {
    for (const float within : {0.5f, 2.0f, 8.0f, 2.0f * kMaxExtent}) {
      if (const auto found = Nearest(point, within)) {
        return found;
      }
    }
    return std::nullopt;
  }

  // Computes corner and length of the path through the first `polygons` entries of `path`.
  void MeasureWay(glm::vec2 from, int polygons, Reached& reached) const {
    int count = 0;
    query->findStraightPath(Point3(from), Point3(reached.point), path.data(), polygons,
                            corners.data(), nullptr, nullptr, &count, kMaxPath);
    reached.corner = reached.point;
    reached.length = 0.0f;
    for (int i = 1; i < count; ++i) {
      const glm::vec2 corner = OnFloor(&corners[3 * static_cast<size_t>(i)]);
      if (i == 1) {
        reached.corner = corner;
      }
      reached.length += glm::distance(corner, OnFloor(&corners[3 * static_cast<size_t>(i - 1)]));
    }
  }

  void ListGates(size_t count) {
    gates.resize(count);
    open.assign(count, 0);
    const dtNavMesh& tiles = *mesh;
    const dtMeshTile* tile = tiles.getTile(0);
    const dtPolyRef base = tiles.getPolyRefBase(tile);
    for (int i = 0; i < tile->header->polyCount; ++i) {
      const unsigned area = tile->polys[i].getArea();
      if (area >= kFirstGateArea && area < kFirstGateArea + count) {
        gates[area - kFirstGateArea].push_back(base | static_cast<dtPolyRef>(i));
      }
    }
  }

  bool StartCrowd() {
    crowd.reset(dtAllocCrowd());
    if (!crowd || !crowd->init(kMaxWalkers, kRoom, mesh.get())) {
      return false;
    }
    crowd->getEditableFilter(0)->setIncludeFlags(kOpenFlag);
    dtObstacleAvoidanceParams avoidance = *crowd->getObstacleAvoidanceParams(0);
    avoidance.velBias = 0.5f;
    avoidance.adaptiveDivs = 5;
    avoidance.adaptiveRings = 2;
    avoidance.adaptiveDepth = 2;
    avoidance.weightToi = 2.5f;
    crowd->setObstacleAvoidanceParams(0, &avoidance);
    return true;
  }

  dtCrowdAgent& Agent(int walker) { return *crowd->getEditableAgent(walker); }

  // Updates the crowd with the positions of the walkers that it does not move.
  void PlaceHeld() {
    for (int i = 0; i < kMaxWalkers; ++i) {
      dtCrowdAgent& agent = Agent(i);
      const Walker& walker = walkers[static_cast<size_t>(i)];
      if (!agent.active || walker.goes) {
        continue;
      }
      if (glm::distance(OnFloor(agent.npos), walker.to) > 1e-4f) {
        const auto on_mesh = Nearest(walker.to);
        agent.state = on_mesh ? DT_CROWDAGENT_STATE_WALKING : DT_CROWDAGENT_STATE_INVALID;
        if (on_mesh) {
          agent.corridor.reset(on_mesh->polygon, Point3(on_mesh->point));
          agent.boundary.reset();
        }
      }
      dtVcopy(agent.npos, Point3(walker.to));
      dtVset(agent.vel, walker.speed.x, 0.0f, walker.speed.y);
    }
  }
};

Status NavigationOptions::Validate() const {
  if (floor.size() < 3 || floor.size() > 1000) {
    return Failed("the floor's outline must have from 3 to 1000 corners");
  }
  for (const glm::vec2& corner : floor) {
    if (!(std::abs(corner.x) <= kMaxExtent && std::abs(corner.y) <= kMaxExtent)) {
      return Failed("the floor reaches further than 100 m from the origin", "make it smaller");
    }
  }
  if (!(walker_radius >= 0.0f && walker_radius <= 2.0f && walker_height >= 0.5f &&
        walker_height <= 4.0f && step >= 0.0f && step <= 1.0f && cell >= 0.01f && cell <= 1.0f)) {
    return Failed("the size of the walkers or of the cells is out of range");
  }
  return Status();
}

Navigation::Navigation(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
Navigation::~Navigation() = default;

Result<std::unique_ptr<Navigation>> Navigation::Create(const NavigationOptions& options,
                                                       std::span<const NavigationSolid> solids,
                                                       std::span<const BlockedArea> areas) {
  LARARIUM_RETURN_IF_ERROR(options.Validate());
  const auto gates = static_cast<size_t>(
      std::count_if(areas.begin(), areas.end(), [](const BlockedArea& a) { return a.gate; }));
  if (gates > kMaxGates) {
    return Failed("there are more than " + std::to_string(kMaxGates) + " doors");
  }
  auto parts = std::make_unique<Parts>();
  LARARIUM_ASSIGN_OR_RETURN(parts->mesh, MeshBuilder(options, solids, areas).Build());
  parts->filter.setIncludeFlags(kOpenFlag);
  parts->query.reset(dtAllocNavMeshQuery());
  if (!parts->query || dtStatusFailed(parts->query->init(parts->mesh.get(), 2048)) ||
      !parts->StartCrowd()) {
    return Failed("there is too little memory for the floor");
  }
  parts->ListGates(gates);
  return std::unique_ptr<Navigation>(new Navigation(std::move(parts)));
}

void Navigation::Reset() {
  for (size_t gate = 0; gate < parts_->gates.size(); ++gate) {
    OpenGate(gate, false);
  }
  parts_->walkers = {};
  parts_->ticks = 0;
  CHECK(parts_->StartCrowd());
}

void Navigation::OpenGate(size_t gate, bool open) {
  CHECK(gate < parts_->gates.size());
  parts_->open[gate] = open ? 1 : 0;
  for (const dtPolyRef polygon : parts_->gates[gate]) {
    parts_->mesh->setPolyFlags(polygon, open ? kOpenFlag : 0);
  }
}

std::optional<Navigation::Reached> Navigation::FindWay(glm::vec2 from, glm::vec2 to) const {
  const Parts& parts = *parts_;
  const auto start = parts.Nearest(from, kStepOn);
  const auto end = parts.Nearest(to);
  if (!start || !end) {
    return std::nullopt;
  }
  int count = 0;
  parts.query->findPath(start->polygon, end->polygon, Point3(start->point), Point3(end->point),
                        &parts.filter, parts.path.data(), &count, kMaxPath);
  if (count == 0) {
    return std::nullopt;
  }
  Reached reached;
  const dtPolyRef last = parts.path[static_cast<size_t>(count - 1)];
  reached.complete = last == end->polygon;
  reached.point = end->point;
  if (!reached.complete) {
    float nearest[3];
    parts.query->closestPointOnPoly(last, Point3(to), nearest, nullptr);
    reached.point = OnFloor(nearest);
  }
  parts.MeasureWay(start->point, count, reached);
  return reached;
}

std::optional<glm::vec2> Navigation::Nearest(glm::vec2 point, float within) const {
  const auto found = parts_->Nearest(point, within);
  return found ? std::optional(found->point) : std::nullopt;
}

std::optional<int> Navigation::AddWalker(glm::vec2 position) {
  dtCrowdAgentParams params = {};
  params.radius = kRoom;
  params.height = 1.7f;
  params.maxAcceleration = kAcceleration;
  params.maxSpeed = 1.2f;
  params.collisionQueryRange = 2.5f;
  params.pathOptimizationRange = 6.0f;
  params.separationWeight = 0.0f;
  params.updateFlags = kSteering;
  const int walker = parts_->crowd->addAgent(Point3(position), &params);
  if (walker < 0) {
    return std::nullopt;
  }
  parts_->walkers[static_cast<size_t>(walker)] = {.from = position, .to = position};
  return walker;
}

void Navigation::RemoveWalker(int walker) { parts_->crowd->removeAgent(walker); }

void Navigation::Aim(int walker, glm::vec2 target, float speed) {
  parts_->PlaceHeld();  // The walk begins at the current position.
  dtCrowdAgentParams params = parts_->Agent(walker).params;
  params.maxSpeed = speed;
  parts_->crowd->updateAgentParameters(walker, &params);
  if (const auto on_mesh = parts_->Nearest(target)) {
    parts_->crowd->requestMoveTarget(walker, on_mesh->polygon, Point3(on_mesh->point));
    parts_->walkers[static_cast<size_t>(walker)].goes = true;
  }
}

void Navigation::Hold(int walker) {
  Walker& held = parts_->walkers[static_cast<size_t>(walker)];
  held.from = held.to = position(walker);
  held.speed = velocity(walker);
  held.goes = false;
  parts_->crowd->resetMoveTarget(walker);
}

void Navigation::Place(int walker, glm::vec2 position, glm::vec2 velocity) {
  Walker& held = parts_->walkers[static_cast<size_t>(walker)];
  held.from = held.to = position;
  held.speed = velocity;
}

void Navigation::Squeeze(int walker, int how) {
  constexpr float kRooms[] = {kRoom, 0.1f, 0.02f};
  dtCrowdAgentParams params = parts_->Agent(walker).params;
  params.radius = kRooms[how];
  params.updateFlags = kSteering;
  if (how == 2) {
    params.updateFlags &= static_cast<unsigned char>(~DT_CROWD_OBSTACLE_AVOIDANCE);
  }
  parts_->crowd->updateAgentParameters(walker, &params);
}

void Navigation::Settle() {
  bool waits = false;
  for (int i = 0; i < kMaxWalkers; ++i) {
    dtCrowdAgent& agent = parts_->Agent(i);
    if (!agent.active) {
      continue;
    }
    agent.boundary.reset();
    if (agent.targetState == DT_CROWDAGENT_TARGET_WAITING_FOR_PATH) {
      agent.targetState = DT_CROWDAGENT_TARGET_WAITING_FOR_QUEUE;
      agent.targetPathqRef = DT_PATHQ_INVALID;
      waits = true;
    }
  }
  if (waits) {
    Restore(*Save());  // Removes the old path queries from the queue.
  }
}

std::shared_ptr<const Navigation::State> Navigation::Save() const {
  auto state = std::make_shared<State>();
  for (int i = 0; i < kMaxWalkers; ++i) {
    const dtCrowdAgent& agent = parts_->Agent(i);
    if (!agent.active) {
      continue;
    }
    auto saved = std::make_unique<State::Agent>();
    saved->walker = i;
    std::copy_n(agent.corridor.getPos(), 3, saved->position.begin());
    std::copy_n(agent.corridor.getTarget(), 3, saved->target.begin());
    saved->path.assign(agent.corridor.getPath(),
                       agent.corridor.getPath() + agent.corridor.getPathCount());
    CopyAgent(agent, saved->plain);
    state->agents.push_back(std::move(saved));
  }
  state->walkers = parts_->walkers;
  state->gates = parts_->open;
  state->ticks = parts_->ticks;
  return state;
}

void Navigation::Restore(const State& state) {
  for (size_t gate = 0; gate < parts_->gates.size(); ++gate) {
    OpenGate(gate, state.gates[gate] != 0);
  }
  parts_->walkers = state.walkers;
  parts_->ticks = state.ticks;
  CHECK(parts_->StartCrowd());
  for (const auto& saved : state.agents) {
    dtCrowdAgent& agent = parts_->Agent(saved->walker);
    CopyAgent(saved->plain, agent);
    agent.boundary.reset();
    agent.corridor.reset(saved->path.empty() ? 0 : saved->path.front(), saved->position.data());
    if (!saved->path.empty()) {
      agent.corridor.setCorridor(saved->target.data(), saved->path.data(),
                                 static_cast<int>(saved->path.size()));
    }
  }
}

void Navigation::Tick() {
  parts_->ticks = (parts_->ticks + 1) % kCrowdTicks;
  const bool anybody = std::any_of(parts_->walkers.begin(), parts_->walkers.end(),
                                   [](const Walker& walker) { return walker.goes; });
  if (parts_->ticks != 1 || !anybody) {
    return;
  }
  parts_->PlaceHeld();
  parts_->crowd->update(kCrowdSeconds, nullptr);
  for (int i = 0; i < kMaxWalkers; ++i) {
    Walker& walker = parts_->walkers[static_cast<size_t>(i)];
    if (walker.goes) {
      walker.from = walker.to;
      walker.to = OnFloor(parts_->Agent(i).npos);
      walker.speed = (walker.to - walker.from) / kCrowdSeconds;
    }
  }
}

glm::vec2 Navigation::position(int walker) const {
  const Walker& of = parts_->walkers[static_cast<size_t>(walker)];
  const float passed = parts_->ticks == 0
                           ? 1.0f
                           : static_cast<float>(parts_->ticks) / static_cast<float>(kCrowdTicks);
  return of.goes ? glm::mix(of.from, of.to, passed) : of.to;
}

glm::vec2 Navigation::velocity(int walker) const {
  return parts_->walkers[static_cast<size_t>(walker)].speed;
}

}  // namespace lararium::stage
