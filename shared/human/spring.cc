#include "shared/human/spring.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <utility>
#include <vector>

#include "shared/core/check.h"
#include "shared/human/fixed_steps.h"
#include "shared/human/round_cone.h"
#include "shared/human/turns.h"

namespace lararium::human {
namespace {

constexpr float kGravity = 9.81f;       // m/s^2
constexpr float kStep = 1.0f / 240.0f;  // seconds
constexpr float kLeapSpeed = 6.0f;      // m/s, speed of the roots
constexpr float kLeap = 0.08f;          // metres in addition to that speed
constexpr float kSettlingDrag = 8.0f;   // 1/s
constexpr float kFastest = 12.0f;       // m/s, relative to the root
constexpr float kLastLength = 0.07f;    // Length of a stick without a following joint, metres.
constexpr int kSweeps = 3;              // Passes over the lengths of a chain in a step.
constexpr uint32_t kNone = 0xffffffffu;

// A joint of a chain: a stick from the joint's origin to its tail, where the particle is.
struct Link {
  uint32_t joint = 0;
  uint32_t before = kNone;           // Link that carries this one; kNone at the root of a chain.
  glm::vec3 tail = glm::vec3(0.0f);  // joint frame
  float stiffness = 0.0f;            // 1/s^2
  float drag = 0.0f;                 // 1/s
  float gravity = 0.0f;              // m/s^2
};

// A joint whose matrix changes: a joint of a chain or a descendant of one.
struct MovedJoint {
  uint32_t joint = 0;
  uint32_t link = kNone;
};

// The position of a link, local frame.
struct Stick {
  Float4 head;
  Float4 tail;
};

glm::quat RotationOf(const glm::mat4& m) {
  const glm::vec3 x = Direction(glm::vec3(m[0]), glm::vec3(1, 0, 0));
  const glm::vec3 y = Direction(Across(glm::vec3(m[1]), x), AnyAcross(x));
  return glm::normalize(glm::quat_cast(glm::mat3(x, y, glm::cross(x, y))));
}

}  // namespace

struct SpringModel::Data {
  std::vector<int16_t> parents;
  std::vector<Link> links;  // chain by chain, from the root outward
  std::vector<MovedJoint> moved;
  std::vector<BodyCapsule> capsules;
  // [capsule][link]: distance kept from the surface, at most that of the bind pose.
  std::vector<float> standoff;
  size_t chain_count = 0;
};

// The local frame has the stage's axes, the actor's metres and an origin near the actor.
struct SpringState::Data {
  glm::vec3 origin_in_stage = glm::vec3(0.0f);
  float scale = 1.0f;
  bool started = false;
  bool adopts_motion = false;

  std::vector<Float4> tails;  // [link], simulated
  std::vector<Float4> before;
  std::vector<Float4> velocities;

  // Animated sticks at the last step, at the last frame and at this frame. [link]
  std::vector<Stick> animated, last, next;
  std::vector<Float4> root_motion;  // Motion of the chain's root in one step.
  // Animated rotation of the joint that carries a link; used at roots.
  std::vector<glm::quat> carrier, last_carrier, next_carrier;
  std::vector<glm::quat> relative;                 // animated rotation of the joint in its parent
  std::vector<glm::vec3> stick;                    // vector from head to tail in the joint's axes
  std::vector<float> length;                       // length of the stick
  std::vector<glm::quat> turned;                   // simulated rotation of the joint
  std::vector<Float4> ends, last_ends, next_ends;  // [2 * capsule]
  std::vector<RoundCone> cones;
  glm::quat turn = glm::quat(1.0f, 0.0f, 0.0f, 0.0f);  // local_from_actor
  glm::quat last_turn = turn;
  glm::vec3 place = glm::vec3(0.0f);

  double pending = 0.0;
  float weight = 1.0f;
  std::vector<glm::vec3> offsets_before;  // Offsets of the tails from the animation, actor axes.
  std::vector<glm::vec3> offsets;
};

namespace {

using Model = SpringModel::Data;
using State = SpringState::Data;

// --- The model ------------------------------------------------------------------

// End of a joint's stick: the next joint of the chain, otherwise the joint's first child, otherwise
// a continuation as long as the stick before it.
glm::vec3 TailOf(const Human& human, const SpringChain& chain, size_t i) {
  const Skeleton& skeleton = human.skeleton;
  const uint32_t joint = chain.joints[i];
  if (i + 1 < chain.joints.size()) {
    return skeleton.rest[chain.joints[i + 1]].translation;
  }
  for (size_t child = joint + 1; child < skeleton.size(); ++child) {
    if (skeleton.parents[child] == static_cast<int>(joint)) {
      return skeleton.rest[child].translation;
    }
  }
  const glm::vec3 reached = skeleton.rest[joint].translation;
  if (i > 0) {
    return glm::inverse(skeleton.rest[joint].rotation) * reached;
  }
  return kLastLength * Direction(glm::inverse(skeleton.rest[joint].rotation) * reached,
                                 glm::vec3(0.0f, -1.0f, 0.0f));
}

void AddChain(const Human& human, const SpringChain& chain, Model& model) {
  uint32_t before = kNone;
  for (size_t i = 0; i < chain.joints.size(); ++i) {
    glm::vec3 tail = TailOf(human, chain, i);
    if (!(glm::length(tail) > 1e-4f)) {
      tail = glm::vec3(0.0f, -kLastLength, 0.0f);
    }
    const auto link = static_cast<uint32_t>(model.links.size());
    model.links.push_back(
        {chain.joints[i], before, tail, chain.stiffness, chain.drag, kGravity * chain.gravity});
    before = link;
  }
  model.chain_count += chain.joints.empty() ? 0 : 1;
}

void FindMovedJoints(Model& model) {
  std::vector<bool> moves(model.parents.size(), false);
  for (uint32_t joint = 0; joint < model.parents.size(); ++joint) {
    const auto link = std::find_if(model.links.begin(), model.links.end(),
                                   [joint](const Link& l) { return l.joint == joint; });
    const int16_t parent = model.parents[joint];
    moves[joint] = link != model.links.end() || (parent >= 0 && moves[parent]);
    if (moves[joint]) {
      model.moved.push_back(
          {joint, link != model.links.end() ? uint32_t(link - model.links.begin()) : kNone});
    }
  }
}

void MeasureStandoffs(const Human& human, const std::vector<float>& radius, Model& model) {
  for (const BodyCapsule& capsule : model.capsules) {
    const glm::mat4 actor_from_joint = glm::inverse(human.skeleton.joint_from_actor[capsule.joint]);
    const RoundCone cone =
        MakeRoundCone(Float4(glm::vec3(actor_from_joint * glm::vec4(capsule.a, 1.0f))),
                      Float4(glm::vec3(actor_from_joint * glm::vec4(capsule.b, 1.0f))),
                      capsule.radius_a, capsule.radius_b);
    for (size_t i = 0; i < model.links.size(); ++i) {
      const Link& link = model.links[i];
      const glm::mat4 joint = glm::inverse(human.skeleton.joint_from_actor[link.joint]);
      const NearestSphere sphere =
          FindNearestSphere(cone, Float4(glm::vec3(joint * glm::vec4(link.tail, 1.0f))));
      const float as_bound = sphere.distance - sphere.radius;
      model.standoff.push_back(std::isfinite(as_bound) ? std::min(radius[i], as_bound) : radius[i]);
    }
  }
}

// --- The animation --------------------------------------------------------------

void FollowActor(const glm::vec3& actor_in_stage, State& state) {
  if (state.started &&
      glm::length(actor_in_stage - state.origin_in_stage) < kOriginRange * state.scale) {
    return;
  }
  const Float4 shift((state.origin_in_stage - actor_in_stage) / state.scale);
  state.origin_in_stage = actor_in_stage;
  for (size_t i = 0; i < state.tails.size(); ++i) {
    state.tails[i] += shift;
    for (std::vector<Stick>* sticks : {&state.animated, &state.last}) {
      (*sticks)[i].head += shift;
      (*sticks)[i].tail += shift;
    }
  }
  for (size_t i = 0; i < state.ends.size(); ++i) {
    state.ends[i] += shift;
    state.last_ends[i] += shift;
  }
}

void TakePose(const Model& model,
              const SpringStep& step,
              std::span<const JointTransform> pose,
              std::span<const glm::mat4> actor_from_joint,
              State& state) {
  const glm::mat4& stage_from_actor = step.stage_from_actor;
  state.scale = glm::length(glm::vec3(stage_from_actor[0]));
  FollowActor(glm::vec3(stage_from_actor[3]), state);
  state.turn = RotationOf(stage_from_actor);
  state.place = (glm::vec3(stage_from_actor[3]) - state.origin_in_stage) / state.scale;
  glm::mat4 local_from_actor = glm::mat4_cast(state.turn);
  local_from_actor[3] = glm::vec4(state.place, 1.0f);
  for (size_t i = 0; i < model.links.size(); ++i) {
    const Link& link = model.links[i];
    const glm::mat4 local_from_joint = local_from_actor * actor_from_joint[link.joint];
    state.next[i].head = Float4(glm::vec3(local_from_joint[3]));
    state.next[i].tail = Float4(glm::vec3(local_from_joint * glm::vec4(link.tail, 1.0f)));
    state.relative[i] = glm::normalize(pose[link.joint].rotation);
    const glm::quat turned = RotationOf(local_from_joint);
    state.next_carrier[i] = turned * glm::conjugate(state.relative[i]);
    state.stick[i] = glm::conjugate(turned) * (state.next[i].tail - state.next[i].head).xyz();
    state.length[i] = glm::length(state.stick[i]);
  }
  for (size_t c = 0; c < model.capsules.size(); ++c) {
    const BodyCapsule& capsule = model.capsules[c];
    const glm::mat4 local_from_joint = local_from_actor * actor_from_joint[capsule.joint];
    state.next_ends[2 * c] = Float4(glm::vec3(local_from_joint * glm::vec4(capsule.a, 1.0f)));
    state.next_ends[2 * c + 1] = Float4(glm::vec3(local_from_joint * glm::vec4(capsule.b, 1.0f)));
  }
}

bool HasLeapt(const Model& model, float elapsed, const State& state) {
  float furthest = 0.0f;
  for (size_t i = 0; i < model.links.size(); ++i) {
    if (model.links[i].before == kNone) {
      furthest = std::max(furthest, Length(state.next[i].head - state.last[i].head));
    }
  }
  return furthest > kLeap + kLeapSpeed * elapsed;
}

// --- One step -------------------------------------------------------------------

// Interpolates the animation between the last frame (0) and this one (1).
void MoveAnimation(const Model& model, float share, State& state) {
  for (size_t i = 0; i < model.links.size(); ++i) {
    const Float4 head_before = state.animated[i].head;
    state.animated[i].head = Mix(state.last[i].head, state.next[i].head, share);
    state.animated[i].tail = Mix(state.last[i].tail, state.next[i].tail, share);
    const uint32_t before = model.links[i].before;
    if (before == kNone) {
      state.carrier[i] = glm::slerp(state.last_carrier[i], state.next_carrier[i], share);
      state.root_motion[i] = state.animated[i].head - head_before;
    } else {
      state.root_motion[i] = state.root_motion[before];
    }
  }
  for (size_t c = 0; c < model.capsules.size(); ++c) {
    const Float4 a = Mix(state.last_ends[2 * c], state.next_ends[2 * c], share);
    const Float4 b = Mix(state.last_ends[2 * c + 1], state.next_ends[2 * c + 1], share);
    state.cones[c] = MakeRoundCone(a, b, model.capsules[c].radius_a, model.capsules[c].radius_b);
    state.cones[c].motion_a = a - state.ends[2 * c];
    state.cones[c].motion_b = b - state.ends[2 * c + 1];
    state.ends[2 * c] = a;
    state.ends[2 * c + 1] = b;
  }
}

const Float4& HeadOf(const Link& link, size_t i, const State& state) {
  return link.before == kNone ? state.animated[i].head : state.tails[link.before];
}

// Applies gravity, the pull to the animated direction as the carrying joint now lies, and the drag
// relative to the root. The last two are integrated implicitly.
void Predict(const Model& model, float further_drag, size_t i, State& state) {
  const Link& link = model.links[i];
  const Float4 head = HeadOf(link, i, state);
  const glm::quat carrier = link.before == kNone ? state.carrier[i] : state.turned[link.before];
  const glm::quat animated = carrier * state.relative[i];
  const Float4 aim(animated * state.stick[i]);
  const glm::vec3 now = Direction((state.tails[i] - head).xyz(), glm::vec3(0, -1, 0));
  state.turned[i] = Arc(Direction(aim.xyz(), now), now) * animated;
  const Float4 gravity(glm::vec3(0.0f, -link.gravity, 0.0f));
  const Float4 pull = (head + aim - state.tails[i]) * link.stiffness;
  const float drag = link.drag + further_drag;
  const Float4 root_velocity = state.root_motion[i] * (1.0f / kStep);
  Float4 relative = state.velocities[i] - root_velocity;
  relative = (relative + (gravity + pull) * kStep) *
             (1.0f / (1.0f + kStep * drag + kStep * kStep * link.stiffness));
  const float speed = Length(relative);
  relative = relative * (speed > kFastest ? kFastest / speed : 1.0f);
  state.before[i] = state.tails[i];
  state.velocities[i] = root_velocity + relative;
}

void SolveLengths(const Model& model, State& state) {
  for (size_t i = 0; i < model.links.size(); ++i) {
    const Link& link = model.links[i];
    const bool is_root = link.before == kNone;
    const Float4 along = state.tails[i] - HeadOf(link, i, state);
    const float length = Length(along) + 1e-12f;
    const Float4 change = along * ((state.length[i] - length) / length * (is_root ? 1.0f : 0.5f));
    state.tails[i] += change;
    if (!is_root) {
      state.tails[link.before] -= change;
    }
  }
}

void SolveContacts(const Model& model, State& state) {
  for (size_t c = 0; c < model.capsules.size(); ++c) {
    const RoundCone& cone = state.cones[c];
    for (size_t i = 0; i < model.links.size(); ++i) {
      const NearestSphere sphere = FindNearestSphere(cone, state.tails[i]);
      const float depth =
          sphere.radius + model.standoff[c * model.links.size() + i] - sphere.distance;
      if (!(depth > 0.0f) || sphere.distance < 1e-6f) {
        continue;
      }
      // Pushes the tail out without giving it speed beyond the surface's.
      const Float4 normal = sphere.from_centre * (1.0f / sphere.distance);
      state.tails[i] += normal * depth;
      const Float4 motion =
          state.tails[i] - state.before[i] - Mix(cone.motion_a, cone.motion_b, sphere.along);
      state.before[i] += normal * std::clamp(Dot(motion, normal), 0.0f, depth);
    }
  }
}

void ResetToAnimation(State& state) {
  for (size_t i = 0; i < state.tails.size(); ++i) {
    state.tails[i] = state.animated[i].tail;
  }
  std::fill(state.velocities.begin(), state.velocities.end(), Float4());
}

void TakeOffsets(float share, State& state) {
  std::swap(state.offsets_before, state.offsets);
  const glm::quat actor_from_local = glm::conjugate(glm::slerp(state.last_turn, state.turn, share));
  for (size_t i = 0; i < state.offsets.size(); ++i) {
    state.offsets[i] = actor_from_local * (state.tails[i] - state.animated[i].tail).xyz();
  }
}

// share is the position between the last frame and this one.
void StepOnce(const Model& model, float share, float further_drag, State& state) {
  MoveAnimation(model, share, state);
  for (size_t i = 0; i < model.links.size(); ++i) {
    Predict(model, further_drag, i, state);
  }
  for (size_t i = 0; i < model.links.size(); ++i) {
    state.tails[i] += state.velocities[i] * kStep;
  }
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    SolveLengths(model, state);
  }
  SolveContacts(model, state);
  for (size_t i = 0; i < model.links.size(); ++i) {
    state.velocities[i] = (state.tails[i] - state.before[i]) * (1.0f / kStep);
  }
  if (!AllFinite(state.tails, state.velocities)) {
    ResetToAnimation(state);
  }
  TakeOffsets(share, state);
}

// --- One frame ------------------------------------------------------------------

void MakeLast(State& state) {
  std::swap(state.last, state.next);
  std::swap(state.last_carrier, state.next_carrier);
  std::swap(state.last_ends, state.next_ends);
  state.last_turn = state.turn;
}

float FastestTail(const State& state) {
  float square = 0.0f;
  for (const Float4& velocity : state.velocities) {
    square = std::max(square, Dot(velocity, velocity));
  }
  return std::sqrt(square);
}

// Settles the chains. They start at the animation, or at their offsets from it before the cut.
void Settle(const Model& model, State& state) {
  state.last = state.next;
  state.animated = state.next;
  state.last_carrier = state.next_carrier;
  state.last_ends = state.next_ends;
  state.ends = state.next_ends;
  state.last_turn = state.turn;
  for (size_t i = 0; i < state.tails.size(); ++i) {
    state.tails[i] = state.next[i].tail + Float4(state.turn * state.offsets[i]);
  }
  std::fill(state.velocities.begin(), state.velocities.end(), Float4());
  const int steps = static_cast<int>(kSettlingSeconds / kStep);
  for (int i = 0, quiet = 0; i < steps && quiet < 8; ++i) {
    StepOnce(model, 1.0f, kSettlingDrag, state);
    quiet = FastestTail(state) < kQuietSpeed ? quiet + 1 : 0;
  }
  state.offsets_before = state.offsets;
  state.pending = 0.0;
  state.weight = 1.0f;
  state.adopts_motion = true;
}

void AdoptMotion(const Model& model, float elapsed, State& state) {
  for (size_t i = 0; i < model.links.size(); ++i) {
    const uint32_t before = model.links[i].before;
    state.velocities[i] = before == kNone
                              ? (state.next[i].head - state.last[i].head) * (1.0f / elapsed)
                              : state.velocities[before];
  }
  state.adopts_motion = false;
}

void Advance(const Model& model, float elapsed, State& state) {
  if (state.adopts_motion) {
    AdoptMotion(model, elapsed, state);
  }
  TakeSteps(kStep, elapsed, state.pending,
            [&](float share) { StepOnce(model, share, 0.0f, state); });
}

// Keeps the chains at the plain animation.
void FollowAnimation(State& state) {
  state.animated = state.next;
  state.ends = state.next_ends;
  ResetToAnimation(state);
  std::fill(state.offsets.begin(), state.offsets.end(), glm::vec3(0.0f));
  std::fill(state.offsets_before.begin(), state.offsets_before.end(), glm::vec3(0.0f));
  state.pending = 0.0;
  state.weight = 0.0f;
  state.adopts_motion = true;
}

// The tail of the last step, extrapolated by less than one step; actor frame.
glm::vec3 DrawnTail(size_t i, const State& state) {
  const float share = std::clamp(static_cast<float>(state.pending / double(kStep)), 0.0f, 1.0f);
  const glm::vec3 animated = glm::conjugate(state.turn) * (state.last[i].tail.xyz() - state.place);
  return animated + state.offsets[i] + share * (state.offsets[i] - state.offsets_before[i]);
}

// Turns the joints so that their sticks point at the tails.
void WritePose(const Model& model,
               const State& state,
               std::span<JointTransform> pose,
               std::span<glm::mat4> actor_from_joint) {
  const float smooth = state.weight * state.weight * (3.0f - 2.0f * state.weight);
  for (const MovedJoint& moved : model.moved) {
    JointTransform& joint = pose[moved.joint];
    const int16_t parent = model.parents[moved.joint];
    const glm::mat4 carrier = parent >= 0 ? actor_from_joint[parent] : glm::mat4(1.0f);
    glm::mat4& matrix = actor_from_joint[moved.joint];
    matrix = carrier * ParentFromJoint(joint);
    if (moved.link == kNone) {
      continue;
    }
    const Link& link = model.links[moved.link];
    const glm::vec3 head =
        link.before == kNone ? glm::vec3(matrix[3]) : DrawnTail(link.before, state);
    const glm::vec3 animated(matrix * glm::vec4(link.tail, 0.0f));
    const glm::vec3 now = Direction(animated, glm::vec3(0, -1, 0));
    const glm::quat turn =
        Share(Arc(now, Direction(DrawnTail(moved.link, state) - head, now)), smooth);
    const glm::quat carried = RotationOf(carrier);
    joint.rotation = glm::normalize(glm::conjugate(carried) * turn * carried * joint.rotation);
    matrix = carrier * ParentFromJoint(joint);
  }
}

}  // namespace

SpringModel::SpringModel(const Human& human) : data_(std::make_unique<Data>()) {
  data_->parents = human.skeleton.parents;
  data_->capsules = human.capsules;
  std::vector<float> radius;
  for (const SpringChain& chain : human.springs) {
    AddChain(human, chain, *data_);
    radius.resize(data_->links.size(), chain.radius);
  }
  FindMovedJoints(*data_);
  MeasureStandoffs(human, radius, *data_);
}

SpringModel::SpringModel(SpringModel&&) noexcept = default;
SpringModel& SpringModel::operator=(SpringModel&&) noexcept = default;
SpringModel::~SpringModel() = default;

size_t SpringModel::chain_count() const { return data_->chain_count; }

SpringState::SpringState(const SpringModel& model) : data_(std::make_unique<Data>()) {
  Data& d = *data_;
  const size_t links = model.data().links.size();
  const size_t capsules = model.data().capsules.size();
  for (std::vector<Float4>* of_links : {&d.tails, &d.before, &d.velocities, &d.root_motion}) {
    of_links->resize(links);
  }
  for (std::vector<Stick>* sticks : {&d.animated, &d.last, &d.next}) {
    sticks->resize(links);
  }
  for (std::vector<glm::quat>* turns :
       {&d.carrier, &d.last_carrier, &d.next_carrier, &d.relative, &d.turned}) {
    turns->assign(links, kNoTurn);
  }
  for (std::vector<glm::vec3>* vectors : {&d.stick, &d.offsets, &d.offsets_before}) {
    vectors->assign(links, glm::vec3(0.0f));
  }
  d.length.resize(links);
  for (std::vector<Float4>* ends : {&d.ends, &d.last_ends, &d.next_ends}) {
    ends->resize(2 * capsules);
  }
  d.cones.resize(capsules);
}

SpringState::SpringState(const SpringState& other) : data_(std::make_unique<Data>(*other.data_)) {}

SpringState& SpringState::operator=(const SpringState& other) {
  *data_ = *other.data_;
  return *this;
}

SpringState::SpringState(SpringState&&) noexcept = default;
SpringState& SpringState::operator=(SpringState&&) noexcept = default;
SpringState::~SpringState() = default;

void StepSprings(const SpringModel& model,
                 const SpringStep& step,
                 SpringState& spring_state,
                 std::span<JointTransform> pose,
                 std::span<glm::mat4> actor_from_joint) {
  const Model& data = model.data();
  State& state = spring_state.data();
  CHECK(pose.size() == data.parents.size() && actor_from_joint.size() == data.parents.size());
  if (data.links.empty() || !IsPossible(step.stage_from_actor, actor_from_joint, step.elapsed)) {
    return;
  }
  TakePose(data, step, pose, actor_from_joint, state);
  const bool cut = !state.started || step.elapsed < 0.0f || step.elapsed > kLongestFrame ||
                   HasLeapt(data, step.elapsed, state);
  if (!step.simulated && (cut || state.weight == 0.0f)) {
    FollowAnimation(state);
  } else if (cut) {
    Settle(data, state);
  } else if (step.elapsed > 0.0f) {
    Advance(data, step.elapsed, state);
    const float change = step.elapsed / kFadeSeconds;
    state.weight = std::clamp(state.weight + (step.simulated ? change : -change), 0.0f, 1.0f);
  }
  MakeLast(state);
  state.started = true;
  WritePose(data, state, pose, actor_from_joint);
}

}  // namespace lararium::human
