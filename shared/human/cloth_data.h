#pragma once

// What ClothModel and ClothState hold; private to the cloth's own files.

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
inline constexpr int kBeatsBetweenAir = 2;     // evaluations of the air
inline constexpr int kBeatsBetweenAims = 4;    // of where hinges rest
inline constexpr int kBeatsBetweenPairs = 8;   // searches for pairs

// Two particles that keep their distance.
struct ClothEdge {
  uint32_t a = 0;
  uint32_t b = 0;
  float length = 0.0f;
  float compliance = 0.0f;  // m/N
};

// Two triangles that share the edge (particles 0, 1); 2 and 3 lie opposite. The sum of
// pull[i] * position[i] has the length 2 sin(angle / 2) and points along the hinge's
// normal.
struct ClothHinge {
  std::array<uint32_t, 4> particles = {};
  std::array<float, 4> pull = {};  // 1/m
  std::array<float, 4> push = {};  // pull / mass
  float weight = 0.0f;             // sum of pull * push
  float compliance = 0.0f;         // rad/(N m)
  float rest = 0.0f;               // signed chord of the angle at rest
};

// A particle and the nearest pin along the cloth.
struct ClothTether {
  uint32_t particle = 0;
  uint32_t pin = 0;
  float length = 0.0f;
};

// A vertex of the drawn mesh. Its normal is the sum of the corners' mean normal and two
// sides of its triangle, each times its share: it turns and shears with the cloth.
struct ClothVertex {
  uint32_t vertex = 0;
  uint32_t triangle = 0;                 // of ClothModel::Data::triangles
  std::array<uint32_t, 3> corners = {};  // its particles
  std::array<float, 3> weights = {};
  float offset = 0.0f;
  std::array<float, 3> normal = {};  // shares: mean normal, side 0 to 1, side 0 to 2
};

// The particles and vertices of one cloth.
struct ClothRange {
  uint32_t first = 0;
  uint32_t count = 0;
  std::vector<ClothVertex> vertices;  // that follow a triangle
  bool has_plain_skin = false;        // some vertices follow no triangle
};

// A part of the body that cloth stays out of: two balls and the cone about them. Metres.
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

  // [particle], all cloths one after the other
  Skinning skinning = Skinning::kLinear;
  std::vector<glm::vec3> bind_positions;  // actor frame
  std::vector<glm::vec3> bind_normals;
  std::vector<Float4> rest;  // the same positions
  std::vector<std::array<uint8_t, 4>> joints;
  std::vector<glm::vec4> weights;
  std::vector<float> inverse_mass;  // 1/kg; 0: pinned
  std::vector<float> reach;         // metres that it may be from its plain skin
  std::vector<float> thickness;     // metres that it keeps from body and floor
  std::vector<float> friction;      // Coulomb's, without unit
  std::vector<uint16_t> cloth_of;   // index in cloths
  // All particles, parted into those that follow the skin and those that move.
  std::vector<uint32_t> pinned;
  std::vector<uint32_t> free;

  // Constraints in batches in which no two share a particle, one batch after the other.
  std::vector<ClothEdge> edges;
  std::vector<ClothHinge> hinges;
  std::vector<ClothTether> tethers;
  std::vector<std::array<uint32_t, 3>> triangles;  // their particles
  std::vector<float> triangle_density;             // kg/m^2

  // What a particle keeps from a capsule's surface: the cloth's thickness and what its
  // triangles cut off between particles, but no more than it has as bound. A capsule is
  // a rough body: what lies in it from the start may stay as deep. Metres, [capsule][particle].
  std::vector<float> standoff;
  float largest_standoff = 0.0f;

  float contact_distance = 0.0f;  // metres kept between two places of cloth
};

// A particle that may meet the body within the next beats.
struct ClothContact {
  uint32_t particle = 0;
  uint32_t capsule = 0;
  float standoff = 0.0f;  // metres: Data::standoff of both
};

// A ball around particles that follow one another in ClothModel::Data::free.
struct ClothBlock {
  static constexpr size_t kSize = 8;

  Float4 centre;        // frame of simulation
  float radius = 0.0f;  // metres
};

// Two particles, of different places of the cloth, that may touch.
struct ClothPair {
  uint32_t a = 0;
  uint32_t b = 0;
  float distance = 0.0f;  // metres that they keep
};

// Particles sorted into cubic cells, found by hashing.
struct ClothGrid {
  static constexpr uint32_t kFree = 0xffffffffu;

  std::vector<uint32_t> slots;   // of the hash table: index of a cell
  std::vector<uint64_t> cells;   // that hold a particle
  std::vector<uint32_t> starts;  // of each cell in particles, and the end
  std::vector<uint32_t> particles;
  std::vector<uint32_t> cell_of;  // [particle]
};

// The body at one moment, in the frame of simulation.
struct ClothBody {
  std::vector<Float4> skin;                            // [particle]: as plain skin
  std::vector<Float4> ends;                            // [2 * capsule]
  glm::quat turn = glm::quat(1.0f, 0.0f, 0.0f, 0.0f);  // local_from_actor
  glm::vec3 place = glm::vec3(0.0f);
};

struct ClothState::Data {
  // Frame of simulation ("local"): stage axes, actor's metres, about an origin near the
  // actor.
  glm::vec3 origin_in_stage = glm::vec3(0.0f);
  float scale = 1.0f;  // stage metres in one of the actor's
  bool started = false;
  bool adopts_motion = false;  // of the body, at the next frame

  std::vector<Float4> positions;
  std::vector<Float4> before;  // at the start of a step
  std::vector<Float4> velocities;
  std::vector<Float4> accelerations;  // by the air
  std::vector<Float4> hinge_targets;

  ClothBody frame;                 // at the last frame
  ClothBody beat;                  // at the last beat
  ClothBody next;                  // at the end of this frame
  ClothBody target;                // at the end of this beat
  std::vector<Float4> skin_steps;  // motion of the skin in one step
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
  float weight = 1.0f;  // of the simulation in what is drawn

  std::vector<glm::vec3> offsets_before;  // from the skin, actor axes, one beat ago
  std::vector<glm::vec3> offsets;         // at the last beat
  std::vector<glm::vec3> drawn;           // actor frame
  std::vector<Float4> places;             // the same
  std::vector<Float4> normals;            // unit, at particles
  std::vector<Float4> triangle_normals;   // unit

  std::vector<uint32_t> first_particles;  // of each cloth, and the end
};

// Sets the accelerations to what moving air does (cloth_air.cc).
void SetAir(const ClothModel::Data& model, const Wind& wind, ClothState::Data& state);

// Finds pairs of particles that may touch within the next beats (cloth_pairs.cc).
void FindPairs(const ClothModel::Data& model, ClothState::Data& state);

// Normals of the cloth as drawn (cloth_drape.cc).
void MeasureNormals(const ClothModel::Data& model, ClothState::Data& state);

// Slots of the grid for so many particles.
size_t SlotCount(size_t particle_count);

}  // namespace lararium::human
