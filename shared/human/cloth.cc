#include "shared/human/cloth.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "shared/core/check.h"
#include "shared/human/cloth_data.h"
#include "shared/human/fixed_steps.h"
#include "shared/human/skinning.h"

namespace lararium::human {
namespace {

using Model = ClothModel::Data;
using State = ClothState::Data;

constexpr float kLeapSpeed = 6.0f;  // m/s, mean speed of the body
constexpr float kLeap = 0.08f;      // metres in addition to that speed
constexpr float kSamePose = 0.03f;  // Metres by which the skin may differ within the actor frame.
constexpr float kFarthestPlace = 1e4f;    // Metres from the origin; positions beyond are invalid.
constexpr float kFastest = 12.0f;         // m/s, cloth relative to its wearer
constexpr float kSettlingDamping = 8.0f;  // 1/s
constexpr float kContactMargin = 0.02f;   // Metres for motion within a beat.
constexpr float kSelfFriction = 0.3f;

int StepsPerBeat(ClothDetail detail) {
  switch (detail) {
    case ClothDetail::kFull:
      return 4;
    case ClothDetail::kReduced:
      return 2;
    case ClothDetail::kCoarse:
    case ClothDetail::kSkinned:
      return 1;
  }
  return 1;
}

// Parameters of one step of constraints.
struct StepContext {
  float seconds = 0.0f;
  float square = 0.0f;          // s^2
  float inverse_square = 0.0f;  // 1/s^2
  int steps_between_bends = 1;  // Bending is soft and needs fewer steps.
  float damping = 0.0f;         // Share of the relative velocity that remains.
  float farthest = 0.0f;        // Largest motion of cloth relative to the skin in a step, metres.
  float floor = 0.0f;           // height of the floor in the local frame
  bool touches_itself = false;
};

// --- The body -----------------------------------------------------------------

void ShiftBy(const Float4& shift, std::vector<Float4>& places) {
  for (Float4& place : places) {
    place += shift;
  }
}

// Moves the origin with the actor. Small coordinates keep floats exact to micrometres.
void FollowActor(const glm::vec3& actor_in_stage, State& state) {
  if (state.started &&
      glm::length(actor_in_stage - state.origin_in_stage) < kOriginRange * state.scale) {
    return;
  }
  const glm::vec3 shift = (state.origin_in_stage - actor_in_stage) / state.scale;
  state.origin_in_stage = actor_in_stage;
  if (state.started) {
    ShiftBy(Float4(shift), state.positions);
    for (ClothBody* body : {&state.frame, &state.beat}) {
      ShiftBy(Float4(shift), body->skin);
      ShiftBy(Float4(shift), body->ends);
      body->place += shift;
    }
  }
}

void SkinParticles(const Model& model, const glm::mat4& local_from_actor, State& state) {
  SkinningJob{model.bind_positions, model.bind_normals, model.joints,  model.weights,
              state.skin_matrices,  model.skinning,     state.skinned, state.skinned_normals}
      .Run();
  const auto column = [&](int c) { return Float4(glm::vec3(local_from_actor[c])); };
  const Float4 x = column(0), y = column(1), z = column(2), origin = column(3);
  for (size_t i = 0; i < state.skinned.size(); ++i) {
    const glm::vec3& p = state.skinned[i];
    state.next.skin[i] = x * p.x + y * p.y + z * p.z + origin;
  }
}

// Reads the pose into state.next. Returns false if a position is out of the valid range.
bool TakePose(const Model& model, const ClothStep& step, State& state) {
  const glm::mat4& stage_from_actor = step.stage_from_actor;
  state.scale = glm::length(glm::vec3(stage_from_actor[0]));
  FollowActor(glm::vec3(stage_from_actor[3]), state);
  glm::mat3 turn(stage_from_actor);
  turn /= state.scale;
  state.next.turn = glm::normalize(glm::quat_cast(turn));
  state.next.place = (glm::vec3(stage_from_actor[3]) - state.origin_in_stage) / state.scale;
  glm::mat4 local_from_actor(turn);
  local_from_actor[3] = glm::vec4(state.next.place, 1.0f);
  for (size_t j = 0; j < state.skin_matrices.size(); ++j) {
    state.skin_matrices[j] = step.actor_from_joint[j] * model.joint_from_actor[j];
  }
  SkinParticles(model, local_from_actor, state);
  for (size_t c = 0; c < model.capsules.size(); ++c) {
    const ClothCapsule& capsule = model.capsules[c];
    const glm::mat4 local_from_joint = local_from_actor * step.actor_from_joint[capsule.joint];
    state.next.ends[2 * c] = Float4(glm::vec3(local_from_joint * glm::vec4(capsule.a, 1.0f)));
    state.next.ends[2 * c + 1] = Float4(glm::vec3(local_from_joint * glm::vec4(capsule.b, 1.0f)));
  }
  const auto is_far = [](const Float4& p) {
    return !(Dot(p, p) < kFarthestPlace * kFarthestPlace);
  };
  return std::none_of(state.next.skin.begin(), state.next.skin.end(), is_far) &&
         std::none_of(state.next.ends.begin(), state.next.ends.end(), is_far);
}

void MixInto(const std::vector<Float4>& from,
             const std::vector<Float4>& to,
             float share,
             std::vector<Float4>& result) {
  for (size_t i = 0; i < result.size(); ++i) {
    result[i] = Mix(from[i], to[i], share);
  }
}

// Interpolates state.target between the last frame and this one.
void AimAt(float share, State& state) {
  MixInto(state.frame.skin, state.next.skin, share, state.target.skin);
  MixInto(state.frame.ends, state.next.ends, share, state.target.ends);
  state.target.turn = glm::slerp(state.frame.turn, state.next.turn, share);
}

float MeanDistance(const std::vector<Float4>& a, const std::vector<Float4>& b) {
  float sum = 0.0f;
  for (size_t i = 0; i < a.size(); ++i) {
    sum += Length(b[i] - a[i]);
  }
  return a.empty() ? 0.0f : sum / static_cast<float>(a.size());
}

// True if the body moved further than people can.
bool HasLeapt(float elapsed, const State& state) {
  return MeanDistance(state.frame.skin, state.next.skin) > kLeap + kLeapSpeed * elapsed;
}

// --- One step -----------------------------------------------------------------

// Moves pinned particles with the skin, and free particles by their velocity over the last step.
void Predict(const Model& model, const StepContext& context, State& state) {
  const Float4 gravity(glm::vec3(0.0f, -model.settings.gravity, 0.0f));
  for (const uint32_t i : model.free) {
    const Float4 position = state.positions[i];
    const Float4 skin_motion = state.skin_steps[i];
    state.beat.skin[i] += skin_motion;
    Float4 relative = (position - state.before[i] - skin_motion) * context.damping;
    const float square = Dot(relative, relative);
    if (square > context.farthest * context.farthest) {
      relative = relative * (context.farthest / std::sqrt(square));
    }
    state.before[i] = position;
    state.positions[i] =
        position + skin_motion + relative + (gravity + state.accelerations[i]) * context.square;
  }
  for (const uint32_t i : model.pinned) {
    state.beat.skin[i] += state.skin_steps[i];
    state.before[i] = state.positions[i];
    state.positions[i] = state.beat.skin[i];
  }
}

void SolveHinges(const Model& model, const StepContext& context, State& state) {
  // A constraint that is solved in every n-th step needs the impulse of n steps.
  const float inverse_square =
      context.inverse_square / static_cast<float>(context.steps_between_bends);
  Float4* x = state.positions.data();
  for (size_t h = 0; h < model.hinges.size(); ++h) {
    const ClothHinge& hinge = model.hinges[h];
    Float4& x0 = x[hinge.particles[0]];
    Float4& x1 = x[hinge.particles[1]];
    Float4& x2 = x[hinge.particles[2]];
    Float4& x3 = x[hinge.particles[3]];
    const Float4 chord =
        (x0 - x3) * hinge.pull[0] + (x1 - x3) * hinge.pull[1] + (x2 - x3) * hinge.pull[2];
    const Float4 change = (state.hinge_targets[h] - chord) *
                          (1.0f / (hinge.weight + hinge.compliance * inverse_square));
    x0 += change * hinge.push[0];
    x1 += change * hinge.push[1];
    x2 += change * hinge.push[2];
    x3 += change * hinge.push[3];
  }
}

void SolveEdges(const Model& model, const StepContext& context, State& state) {
  Float4* x = state.positions.data();
  const float* w = model.inverse_mass.data();
  for (const ClothEdge& edge : model.edges) {
    const Float4 along = x[edge.b] - x[edge.a];
    // (length - rest) / length to first order, without a square root (Jakobsen, "Advanced Character
    // Physics", GDC 2001).
    const float square = Dot(along, along);
    const float rest = edge.length * edge.length;
    const float weight = w[edge.a] + w[edge.b] + edge.compliance * context.inverse_square;
    const Float4 pull = along * ((square - rest) / ((square + rest) * weight));
    x[edge.a] += pull * w[edge.a];
    x[edge.b] -= pull * w[edge.b];
  }
}

// Moves a particle that is outside a ball onto its surface.
void KeepWithin(const Float4& centre, float radius, Float4& position) {
  const Float4 out = position - centre;
  const float square = Dot(out, out);
  if (square > radius * radius) {
    position = centre + out * (radius / std::sqrt(square));
  }
}

void SolveTethersAndReach(const Model& model, State& state) {
  Float4* x = state.positions.data();
  for (const ClothTether& tether : model.tethers) {
    KeepWithin(x[tether.pin], tether.length, x[tether.particle]);
  }
  for (const uint32_t i : model.free) {
    KeepWithin(state.beat.skin[i], model.reach[i], x[i]);
  }
}

// Keeps touching particles apart and applies Coulomb friction between them.
void SolvePairs(const Model& model, State& state) {
  Float4* x = state.positions.data();
  Float4* before = state.before.data();
  const float* w = model.inverse_mass.data();
  for (const ClothPair& pair : state.pairs) {
    const Float4 apart = x[pair.b] - x[pair.a];
    const float square = Dot(apart, apart);
    const float weight = w[pair.a] + w[pair.b];
    if (square >= pair.distance * pair.distance || square < 1e-12f || weight == 0.0f) {
      continue;
    }
    const float distance = std::sqrt(square);
    const Float4 normal = apart * (1.0f / distance);
    const float depth = pair.distance - distance;
    const Float4 motion = (x[pair.b] - before[pair.b]) - (x[pair.a] - before[pair.a]);
    const Float4 slide = motion - normal * Dot(motion, normal);
    const float length = Length(slide);
    const float kept = length > 0.0f ? std::min(kSelfFriction * depth / length, 1.0f) : 0.0f;
    const Float4 change = (normal * depth - slide * kept) * (1.0f / weight);
    x[pair.a] -= change * w[pair.a];
    x[pair.b] += change * w[pair.b];
  }
}

// Moves a particle that is `depth` inside a surface to the surface along its normal; `motion` is
// the motion of the surface. Friction is Coulomb's, and the impact is inelastic: pushing the
// particle out gives it no speed beyond the surface's.
void PushOut(const Float4& normal,
             float depth,
             const Float4& motion,
             float friction,
             Float4& position,
             Float4& before) {
  position += normal * depth;
  const Float4 relative = position - before - motion;
  const float leaving = Dot(relative, normal);
  const Float4 slide = relative - normal * leaving;
  const float length = Length(slide);
  if (length > 0.0f) {
    position -= slide * std::min(friction * depth / length, 1.0f);
  }
  if (leaving > 0.0f) {
    before += normal * std::min(leaving, depth);
  }
}

void SolveContacts(const Model& model, const StepContext& context, State& state) {
  for (const ClothContact& contact : state.contacts) {
    const uint32_t i = contact.particle;
    const RoundCone& cone = state.cones[contact.capsule];
    const NearestSphere sphere = FindNearestSphere(cone, state.positions[i]);
    const float depth = sphere.radius + contact.standoff - sphere.distance;
    if (depth > 0.0f && sphere.distance > 1e-6f) {
      PushOut(sphere.from_centre * (1.0f / sphere.distance), depth,
              Mix(cone.motion_a, cone.motion_b, sphere.along), model.friction[i],
              state.positions[i], state.before[i]);
    }
  }
  const Float4 up(glm::vec3(0.0f, 1.0f, 0.0f));
  for (const uint32_t i : model.free) {
    const float depth = context.floor + model.thickness[i] - state.positions[i].y();
    if (depth > 0.0f) {
      PushOut(up, depth, Float4(), model.friction[i], state.positions[i], state.before[i]);
    }
  }
}

// Moves the capsules by one of the steps that are left in this beat.
void MoveCapsules(const Model& model, int steps_left, State& state) {
  const float share = 1.0f / static_cast<float>(steps_left);
  for (size_t c = 0; c < model.capsules.size(); ++c) {
    const Float4 motion_a = (state.target.ends[2 * c] - state.beat.ends[2 * c]) * share;
    const Float4 motion_b = (state.target.ends[2 * c + 1] - state.beat.ends[2 * c + 1]) * share;
    state.beat.ends[2 * c] += motion_a;
    state.beat.ends[2 * c + 1] += motion_b;
    state.cones[c] = MakeRoundCone(state.beat.ends[2 * c], state.beat.ends[2 * c + 1],
                                   model.capsules[c].radius_a, model.capsules[c].radius_b);
    state.cones[c].motion_a = motion_a;
    state.cones[c].motion_b = motion_b;
  }
}

// Steps store velocities as positions before and after. Converts to that form.
void PrepareSteps(const StepContext& context, State& state) {
  const float share = context.seconds / kBeat;
  for (size_t i = 0; i < state.positions.size(); ++i) {
    state.skin_steps[i] = (state.target.skin[i] - state.beat.skin[i]) * share;
    state.before[i] = state.positions[i] - state.velocities[i] * context.seconds;
  }
}

void TakeVelocities(const StepContext& context, State& state) {
  const float inverse = 1.0f / context.seconds;
  for (size_t i = 0; i < state.positions.size(); ++i) {
    state.velocities[i] = (state.positions[i] - state.before[i]) * inverse;
  }
}

void StepOnce(const Model& model, const StepContext& context, int steps_left, State& state) {
  MoveCapsules(model, steps_left, state);
  Predict(model, context, state);
  if (steps_left % context.steps_between_bends == 0) {
    SolveHinges(model, context, state);
  }
  SolveEdges(model, context, state);
  if (context.touches_itself) {
    SolvePairs(model, state);
  }
  SolveTethersAndReach(model, state);
  SolveContacts(model, context, state);
}

// --- One beat -----------------------------------------------------------------

std::span<const uint32_t> ParticlesOf(size_t block, const Model& model) {
  const size_t first = block * ClothBlock::kSize;
  return std::span<const uint32_t>(model.free)
      .subspan(first, std::min(ClothBlock::kSize, model.free.size() - first));
}

// Returns the position of a particle in the middle of the beat.
Float4 HalfwayPlace(uint32_t i, const State& state) {
  return state.positions[i] + state.velocities[i] * (0.5f * kBeat);
}

void MeasureBlocks(const Model& model, State& state) {
  for (size_t k = 0; k < state.blocks.size(); ++k) {
    ClothBlock& block = state.blocks[k];
    const std::span<const uint32_t> particles = ParticlesOf(k, model);
    Float4 sum;
    for (const uint32_t i : particles) {
      sum += HalfwayPlace(i, state);
    }
    block.centre = sum * (1.0f / static_cast<float>(particles.size()));
    float square = 0.0f;
    for (const uint32_t i : particles) {
      const Float4 out = HalfwayPlace(i, state) - block.centre;
      square = std::max(square, Dot(out, out));
    }
    block.radius = std::sqrt(square);
  }
}

// A capsule in the middle of the beat, enlarged to cover motion within the beat.
struct WideCapsule {
  Float4 a;
  Float4 axis;
  float inverse_square = 0.0f;
  float radius = 0.0f;

  bool Reaches(const Float4& point, float further) const {
    const Float4 from_a = point - a;
    const float along = std::clamp(Dot(from_a, axis) * inverse_square, 0.0f, 1.0f);
    const Float4 apart = from_a - axis * along;
    return Dot(apart, apart) < (radius + further) * (radius + further);
  }
};

WideCapsule MakeWideCapsule(const Model& model, size_t c, const State& state) {
  const Float4& a0 = state.beat.ends[2 * c];
  const Float4& a1 = state.target.ends[2 * c];
  const Float4& b0 = state.beat.ends[2 * c + 1];
  const Float4& b1 = state.target.ends[2 * c + 1];
  WideCapsule wide;
  wide.a = Mix(a0, a1, 0.5f);
  wide.axis = Mix(b0, b1, 0.5f) - wide.a;
  wide.inverse_square = 1.0f / std::max(Dot(wide.axis, wide.axis), 1e-12f);
  wide.radius = std::max(model.capsules[c].radius_a, model.capsules[c].radius_b) +
                model.largest_standoff + kContactMargin +
                0.5f * std::max(Length(a1 - a0), Length(b1 - b0));
  return wide;
}

// Finds which particles may touch which capsules during this beat.
void FindContacts(const Model& model, State& state) {
  state.contacts.clear();
  MeasureBlocks(model, state);
  const size_t count = model.rest.size();
  for (size_t c = 0; c < model.capsules.size(); ++c) {
    const WideCapsule capsule = MakeWideCapsule(model, c, state);
    for (size_t k = 0; k < state.blocks.size(); ++k) {
      if (!capsule.Reaches(state.blocks[k].centre, state.blocks[k].radius)) {
        continue;
      }
      for (const uint32_t i : ParticlesOf(k, model)) {
        if (capsule.Reaches(HalfwayPlace(i, state), 0.0f)) {
          state.contacts.push_back({i, static_cast<uint32_t>(c), model.standoff[c * count + i]});
        }
      }
    }
  }
}

// Computes the rest chord of each hinge along its current normal.
void AimHinges(const Model& model, State& state) {
  const Float4* x = state.positions.data();
  for (size_t h = 0; h < model.hinges.size(); ++h) {
    const ClothHinge& hinge = model.hinges[h];
    const Float4 origin = x[hinge.particles[0]];
    const Float4 edge = x[hinge.particles[1]] - origin;
    const Float4 left = Cross(edge, x[hinge.particles[2]] - origin);
    const Float4 right = Cross(x[hinge.particles[3]] - origin, edge);
    const Float4 normal =
        left * (1.0f / (Length(left) + 1e-12f)) + right * (1.0f / (Length(right) + 1e-12f));
    const float length = Length(normal);
    state.hinge_targets[h] = length > 1e-3f ? normal * (hinge.rest / length) : Float4();
  }
}

void ResetToSkin(State& state) {
  state.positions = state.beat.skin;
  std::fill(state.velocities.begin(), state.velocities.end(), Float4());
  std::fill(state.accelerations.begin(), state.accelerations.end(), Float4());
  std::fill(state.offsets.begin(), state.offsets.end(), glm::vec3(0.0f));
  std::fill(state.offsets_before.begin(), state.offsets_before.end(), glm::vec3(0.0f));
  state.pairs.clear();
}

void TakeOffsets(State& state) {
  std::swap(state.offsets_before, state.offsets);
  const glm::mat3 actor_from_local = glm::mat3_cast(glm::conjugate(state.target.turn));
  for (size_t i = 0; i < state.offsets.size(); ++i) {
    state.offsets[i] = actor_from_local * (state.positions[i] - state.beat.skin[i]).xyz();
  }
}

// Runs from the last beat to state.target. Returns false if the cloth had to be reset.
bool Beat(
    const Model& model, const ClothStep& step, ClothDetail detail, float damping, State& state) {
  const int steps = StepsPerBeat(detail);
  StepContext context;
  context.seconds = kBeat / static_cast<float>(steps);
  context.square = context.seconds * context.seconds;
  context.inverse_square = 1.0f / context.square;
  context.farthest = kFastest * context.seconds;
  context.steps_between_bends = std::min(steps, 2);
  context.damping = std::exp(-damping * context.seconds);
  context.floor = std::isfinite(step.floor_height)
                      ? (step.floor_height - state.origin_in_stage.y) / state.scale
                      : -2.0f * kFarthestPlace;
  context.touches_itself = steps > 1;
  if (state.beats % kBeatsBetweenAir == 0) {
    SetAir(model, step.wind, state);
  }
  FindContacts(model, state);
  if (context.touches_itself && state.beats % kBeatsBetweenPairs == 0) {
    FindPairs(model, state);
  }
  if (state.beats % kBeatsBetweenAims == 0) {
    AimHinges(model, state);
  }
  PrepareSteps(context, state);
  for (int left = steps; left > 0; --left) {
    StepOnce(model, context, left, state);
  }
  TakeVelocities(context, state);
  ++state.beats;
  const bool whole = AllFinite(state.positions, state.velocities);
  if (!whole) {
    ResetToSkin(state);
  }
  TakeOffsets(state);
  return whole;
}

// Returns the largest speed over the last beat, relative to the body. A whole beat is used because
// velocities oscillate within it.
float FastestParticle(const State& state) {
  float square = 0.0f;
  for (size_t i = 0; i < state.offsets.size(); ++i) {
    const glm::vec3 motion = state.offsets[i] - state.offsets_before[i];
    square = std::max(square, glm::dot(motion, motion));
  }
  return std::sqrt(square) / kBeat;
}

// Settles the cloth while the body stays at state.next.
bool Settle(const Model& model, const ClothStep& step, float seconds, State& state) {
  state.frame = state.next;
  state.beat = state.next;
  state.target = state.next;
  bool whole = true;
  const int beats = static_cast<int>(std::clamp(seconds, 0.0f, 60.0f) / kBeat);
  for (int i = 0, quiet = 0; i < beats && quiet < 4; ++i) {
    whole = Beat(model, step, ClothDetail::kReduced, kSettlingDamping, state) && whole;
    quiet = FastestParticle(state) < kQuietSpeed ? quiet + 1 : 0;
  }
  std::fill(state.velocities.begin(), state.velocities.end(), Float4());
  state.offsets_before = state.offsets;
  state.pending = 0.0;
  state.adopts_motion = true;
  return whole;
}

// Moves the cloth to its wearer's new position. If the pose has changed too, the cloth returns to
// the skin.
void Carry(State& state) {
  std::fill(state.velocities.begin(), state.velocities.end(), Float4());
  if (!state.started) {
    state.positions = state.next.skin;
    return;
  }
  const glm::quat turn = state.next.turn * glm::conjugate(state.frame.turn);
  float difference = 0.0f;
  const auto carried = [&](const Float4& p) {
    return Float4(turn * (p.xyz() - state.frame.place) + state.next.place);
  };
  for (size_t i = 0; i < state.positions.size(); ++i) {
    difference += Length(state.next.skin[i] - carried(state.frame.skin[i]));
  }
  const bool same = difference < kSamePose * static_cast<float>(state.positions.size());
  for (size_t i = 0; i < state.positions.size(); ++i) {
    state.positions[i] = same ? carried(state.positions[i]) : state.next.skin[i];
  }
}

// The body has no velocity just after a cut; the next frame provides it.
void AdoptMotion(float elapsed, State& state) {
  for (size_t i = 0; i < state.velocities.size(); ++i) {
    state.velocities[i] = (state.next.skin[i] - state.frame.skin[i]) * (1.0f / elapsed);
  }
  state.adopts_motion = false;
}

// --- One frame ----------------------------------------------------------------

bool Advance(const Model& model, const ClothStep& step, State& state) {
  const ClothDetail detail =
      step.detail == ClothDetail::kSkinned ? ClothDetail::kCoarse : step.detail;
  bool whole = true;
  TakeSteps(kBeat, step.elapsed, state.pending, [&](float share) {
    AimAt(share, state);
    whole = Beat(model, step, detail, model.settings.damping, state) && whole;
  });
  return whole;
}

void Draw(const Model& model, State& state) {
  const float share = std::clamp(static_cast<float>(state.pending / double(kBeat)), 0.0f, 1.0f);
  const glm::mat3 actor_from_local = glm::mat3_cast(glm::conjugate(state.frame.turn));
  const float smooth = state.weight * state.weight * (3.0f - 2.0f * state.weight);
  for (size_t i = 0; i < state.drape.points.size(); ++i) {
    const glm::vec3 skin = actor_from_local * (state.frame.skin[i].xyz() - state.frame.place);
    const glm::vec3 offset =
        state.offsets[i] + (state.offsets[i] - state.offsets_before[i]) * share;
    state.drape.points[i] = skin + smooth * offset;
    state.drape.places[i] = Float4(state.drape.points[i]);
  }
  MeasureNormals(model, state.drape);
}

void Fade(const ClothStep& step, State& state) {
  const float change = step.elapsed / kFadeSeconds;
  const float towards = step.detail == ClothDetail::kSkinned ? -change : change;
  state.weight = std::clamp(state.weight + towards, 0.0f, 1.0f);
}

// Keeps the cloth on the plain skin, ready to continue from there.
void FollowSkin(State& state) {
  state.frame = state.next;
  state.beat = state.next;
  state.target = state.next;
  ResetToSkin(state);
  state.pending = 0.0;
  state.adopts_motion = true;
}

}  // namespace

ClothReport StepCloth(const ClothModel& model, const ClothStep& step, ClothState& cloth_state) {
  const Model& data = model.data();
  State& state = cloth_state.data();
  CHECK(step.actor_from_joint.size() == data.joint_from_actor.size());
  ClothReport report;
  if (data.rest.empty() ||
      !IsPossible(step.stage_from_actor, step.actor_from_joint, step.elapsed) ||
      !TakePose(data, step, state)) {
    return report;
  }
  const bool cut = !state.started || step.elapsed < 0.0f || step.elapsed > kLongestFrame ||
                   HasLeapt(step.elapsed, state);
  if (step.detail == ClothDetail::kSkinned && (cut || state.weight == 0.0f)) {
    state.weight = 0.0f;
    FollowSkin(state);
  } else if (cut) {
    Carry(state);
    report.reset = !Settle(data, step, kSettlingSeconds, state);
    report.jumped = true;
    state.weight = 1.0f;
  } else {
    if (step.elapsed > 0.0f) {
      if (state.adopts_motion) {
        AdoptMotion(step.elapsed, state);
      }
      report.reset = !Advance(data, step, state);
      Fade(step, state);
    }
    std::swap(state.frame, state.next);
  }
  state.started = true;
  Draw(data, state);
  return report;
}

}  // namespace lararium::human
