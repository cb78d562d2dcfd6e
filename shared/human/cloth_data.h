#pragma once

// Data of ClothModel and ClothState; private to the cloth's own files.

#include <array>
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <vector>

#include "shared/human/cloth.h"
#include "shared/human/float4.h"
#include "shared/human/round_cone.h"

namespace lararium::human {

inline constexpr float kBeat = 1.0f / 120.0f;  // seconds
inline constexpr int kBeatsBetweenAir = 2;     // Beats between two evaluations of the air.
// Beats between two updates of the hinges' rest directions.
inline constexpr int kBeatsBetweenAims = 4;
inline constexpr int kBeatsBetweenPairs = 8;  // Beats between two searches for close pairs.

// Two particles that keep their distance.
struct ClothEdge {
  uint32_t a = 0;
  uint32_t b = 0;
  float length = 0.0f;
  float compliance = 0.0f;  // m/N
};

// Two triangles that share the edge of particles 0 and 1; particles 2 and 3 lie opposite. The sum
// of pull[i] * position[i] has the length 2 sin(angle / 2) and points along the hinge's normal.
struct ClothHinge {
  std::array<uint32_t, 4> particles = {};
  std::array<float, 4> pull = {};  // 1/m
  std::array<float, 4> push = {};  // pull / mass
  float weight = 0.0f;             // sum of pull * push
  float compliance = 0.0f;         // rad/(N m)
  float rest = 0.0f;               // signed chord of the angle at rest
};

// A particle and its nearest pin, with the distance along the cloth in metres.
struct ClothTether {
  uint32_t particle = 0;
  uint32_t pin = 0;
  float length = 0.0f;
};

// A vertex of the drawn mesh. Its normal is a weighted sum of the mean normal of the triangle's
// corners and of two sides of the triangle, so it turns and shears with the cloth.
struct ClothVertex {
  uint32_t vertex = 0;
  uint32_t triangle = 0;                 // Index into ClothModel::Data::triangles.
  std::array<uint32_t, 3> corners = {};  // The three particles of the triangle.
  std::array<float, 3> weights = {};
  float offset = 0.0f;
  std::array<float, 3> normal = {};  // Weights of the mean normal, side 0 to 1 and side 0 to 2.
};

// The particles and vertices of one cloth.
struct ClothRange {
  uint32_t first = 0;
  uint32_t count = 0;
  std::vector<ClothVertex> vertices;  // Vertices that follow a triangle.
  bool has_plain_skin = false;        // True if some vertices follow no triangle.
};

// A part of the body that cloth must not enter: the hull of two balls. Metres.
struct ClothCapsule {
  uint32_t joint = 0;
  glm::vec3 a = glm::vec3(0.0f);  // centres of the balls, joint frame
  glm::vec3 b = glm::vec3(0.0f);
  float radius_a = 0.0f;
  float radius_b = 0.0f;
};

struct ClothModel::Data {
  ClothSettings settings;
  std::vector<glm::mat4> joint_from_actor;
  std::vector<ClothCapsule> capsules;
  std::vector<ClothRange> cloths;

  // Arrays by particle; the particles of all cloths follow each other.
  Skinning skinning = Skinning::kLinear;
  std::vector<glm::vec3> bind_positions;  // actor frame
  std::vector<glm::vec3> bind_normals;
  std::vector<Float4> rest;  // Equal to bind_positions.
  std::vector<std::array<uint8_t, 4>> joints;
  std::vector<glm::vec4> weights;
  std::vector<float> inverse_mass;  // 1/kg; 0: pinned
  std::vector<float> reach;         // Metres that a particle may move from its plain skin.
  std::vector<float> thickness;     // Metres that a particle keeps from the body and the floor.
  std::vector<float> friction;      // Coulomb friction, without unit.
  std::vector<uint16_t> cloth_of;   // Index into cloths.
  // All particles, divided into those that follow the skin and those that are simulated.
  std::vector<uint32_t> pinned;
  std::vector<uint32_t> free;

  // Constraints in batches. No two constraints of a batch share a particle.
  std::vector<ClothEdge> edges;
  std::vector<ClothHinge> hinges;
  std::vector<ClothTether> tethers;
  std::vector<std::array<uint32_t, 3>> triangles;  // Particle indices.
  std::vector<float> triangle_density;             // kg/m^2

  // Distance that a particle keeps from a capsule's surface: the cloth's thickness plus what its
  // triangles cut off between particles, but not more than the distance in the bind pose. A capsule
  // is only a rough body, so a particle that lies inside it in the bind pose may stay as deep.
  // Metres, [capsule][particle].
  std::vector<float> standoff;
  float largest_standoff = 0.0f;

  float contact_distance = 0.0f;  // Metres that two parts of the cloth keep from each other.
};

// A particle that may meet the body within the next beats.
struct ClothContact {
  uint32_t particle = 0;
  uint32_t capsule = 0;
  float standoff = 0.0f;  // metres: Data::standoff of this capsule and particle
};

// A ball around particles that are adjacent in ClothModel::Data::free.
struct ClothBlock {
  static constexpr size_t kSize = 8;

  Float4 centre;        // simulation frame
  float radius = 0.0f;  // metres
};

// Two particles of different parts of the cloth that may touch.
struct ClothPair {
  uint32_t a = 0;
  uint32_t b = 0;
  float distance = 0.0f;  // Metres that the particles keep from each other.
};

// Particles sorted into cubic cells, found by hashing.
struct ClothGrid {
  static constexpr uint32_t kFree = 0xffffffffu;

  std::vector<uint32_t> slots;   // Hash table: index of a cell in each slot, or kFree.
  std::vector<uint64_t> cells;   // Keys of the cells that contain a particle.
  std::vector<uint32_t> starts;  // Start of each cell in `particles`, followed by the end.
  std::vector<uint32_t> particles;
  std::vector<uint32_t> cell_of;  // [particle]
};

// The body at one moment, in the simulation frame.
struct ClothBody {
  std::vector<Float4> skin;                            // [particle]: position under plain skinning
  std::vector<Float4> ends;                            // [2 * capsule]
  glm::quat turn = glm::quat(1.0f, 0.0f, 0.0f, 0.0f);  // local_from_actor
  glm::vec3 place = glm::vec3(0.0f);
};

// The particles as drawn, actor frame.
struct ClothDrape {
  std::vector<glm::vec3> points;
  std::vector<Float4> places;            // The values of `points` as Float4.
  std::vector<Float4> normals;           // Unit normals at the particles.
  std::vector<Float4> triangle_normals;  // Unit vectors.
};

struct ClothState::Data {
  // The simulation frame ("local") has the stage's axes, the actor's metres and an origin near the
  // actor.
  glm::vec3 origin_in_stage = glm::vec3(0.0f);
  float scale = 1.0f;  // Stage metres in one of the actor's metres.
  bool started = false;
  bool adopts_motion = false;  // If true, the cloth takes over the body's motion at the next frame.

  std::vector<Float4> positions;
  std::vector<Float4> before;  // Positions at the start of a step.
  std::vector<Float4> velocities;
  std::vector<Float4> accelerations;  // Accelerations by the air, m/s^2.
  std::vector<Float4> hinge_targets;

  ClothBody frame;                 // The body at the last frame.
  ClothBody beat;                  // The body at the last beat.
  ClothBody next;                  // The body at the end of this frame.
  ClothBody target;                // The body at the end of this beat.
  std::vector<Float4> skin_steps;  // Motion of the skin in one step.
  std::vector<RoundCone> cones;
  std::vector<glm::mat4> skin_matrices;
  std::vector<glm::vec3> skinned;  // actor frame
  std::vector<glm::vec3> skinned_normals;

  std::vector<ClothBlock> blocks;
  std::vector<ClothContact> contacts;
  std::vector<ClothPair> pairs;
  ClothGrid grid;

  double pending = 0.0;  // seconds since the last beat
  int64_t beats = 0;
  float weight = 1.0f;  // Share of the simulation in the drawn cloth.

  std::vector<glm::vec3> offsets_before;  // Offsets from the skin, actor axes, one beat ago.
  std::vector<glm::vec3> offsets;         // Offsets from the skin at the last beat.
  ClothDrape drape;

  // First particle of each cloth, followed by the total count.
  std::vector<uint32_t> first_particles;
};

// Sets the accelerations caused by moving air (cloth_air.cc).
void SetAir(const ClothModel::Data& model, const Wind& wind, ClothState::Data& state);

// Finds pairs of particles that may touch within the next beats (cloth_pairs.cc).
void FindPairs(const ClothModel::Data& model, ClothState::Data& state);

// Computes the normals from `places` (cloth_drape.cc).
void MeasureNormals(const ClothModel::Data& model, ClothDrape& drape);

// Number of slots of the grid for this number of particles.
size_t SlotCount(size_t particle_count);

}  // namespace lararium::human
