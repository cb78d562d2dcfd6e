#include "shared/human/cloth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <vector>

#include "shared/core/random.h"
#include "shared/core/units.h"
#include "shared/human/cloth_data.h"
#include "tests/human/walker.h"

namespace lararium::human {
namespace {

constexpr float kGravity = 9.81f;
const ClothSettings kVacuum{
    .gravity = kGravity, .air_density = 0.0f, .damping = 0.0f, .drops_loose = true};
const ClothSettings kDroppable{
    .gravity = kGravity, .air_density = 1.2f, .damping = 1.0f, .drops_loose = true};

// A person with one joint and one cloth.
struct Hanging {
  explicit Hanging(Cloth cloth, const ClothSettings& settings = kVacuum)
      : human(Dress(std::move(cloth))), model(human, settings), state(model) {
    step.actor_from_joint = identity;
    step.floor_height = -1000.0f;
    Start();
  }

  static Human Dress(Cloth cloth) {
    Human human = OneJointHuman();
    SkinnedMesh mesh;
    mesh.positions = cloth.positions;
    mesh.normals.assign(cloth.positions.size(), glm::vec3(0.0f, 0.0f, 1.0f));
    mesh.joints = cloth.joints;
    mesh.weights = cloth.weights;
    mesh.indices = cloth.triangles;
    human.meshes.push_back(mesh);
    human.cloths.push_back(std::move(cloth));
    return human;
  }

  // Starts at the skin, at rest, without settling.
  void Start() {
    step.detail = ClothDetail::kSkinned;
    StepCloth(model, step, state);
    step.detail = ClothDetail::kFull;
    state.data().weight = 1.0f;
  }

  ClothReport Step(float elapsed) {
    step.elapsed = elapsed;
    return StepCloth(model, step, state);
  }

  void Run(float seconds, float rate) {
    const int frames = static_cast<int>(std::lround(seconds * rate));
    for (int i = 0; i < frames; ++i) {
      Step(1.0f / rate);
    }
  }

  std::span<const glm::vec3> particles() const { return state.particles(0); }

  Human human;
  std::vector<glm::mat4> identity{glm::mat4(1.0f)};
  ClothModel model;
  ClothState state;
  ClothStep step;
};

float LargestStrain(const ClothModel& model, std::span<const glm::vec3> x) {
  float largest = 0.0f;
  for (const ClothEdge& edge : model.data().edges) {
    const bool is_thread = edge.compliance < 1e-4f;
    const float strain = glm::distance(x[edge.a], x[edge.b]) / edge.length - 1.0f;
    largest = is_thread ? std::max(largest, strain) : largest;
  }
  return largest;
}

float MeanStrain(const ClothModel& model, std::span<const glm::vec3> x) {
  double sum = 0.0;
  for (const ClothEdge& edge : model.data().edges) {
    const bool is_thread = edge.compliance < 1e-4f;
    const double strain = double(glm::distance(x[edge.a], x[edge.b])) / double(edge.length) - 1.0;
    sum += is_thread ? std::max(strain, 0.0) : 0.0;
  }
  return static_cast<float>(sum / double(model.data().edges.size()));
}

double Energy(const ClothModel& model, const ClothState& state) {
  const ClothModel::Data& m = model.data();
  const ClothState::Data& s = state.data();
  double energy = 0.0;
  for (const uint32_t i : m.free) {
    const double mass = 1.0 / double(m.inverse_mass[i]);
    energy += 0.5 * mass * double(Dot(s.velocities[i], s.velocities[i])) +
              mass * double(kGravity) * double(s.positions[i].y());
  }
  return energy;
}

TEST(Cloth, FallsFreelyAsGalileoSays) {
  Hanging sheet(Sheet(4, 4, 0.05f, 1.0f));
  sheet.Run(0.5f, 120.0f);
  const float seconds = 0.5f;
  for (size_t i = 0; i < sheet.particles().size(); ++i) {
    const float fallen = sheet.human.cloths[0].positions[i].y - sheet.particles()[i].y;
    EXPECT_NEAR(fallen, 0.5f * kGravity * seconds * seconds, 0.006f);
  }
}

TEST(Cloth, PinnedTriangleSwingsWithThePendulumsPeriod) {
  Cloth cloth;
  cloth.positions = {{-0.2f, 0.0f, 0.0f}, {0.2f, 0.0f, 0.0f}, {0.0f, -0.4f, 0.0f}};
  const float tilt = 0.1f;
  cloth.positions[2] = {0.0f, -0.4f * std::cos(tilt), 0.4f * std::sin(tilt)};
  cloth.joints.assign(3, {0, 0, 0, 0});
  cloth.weights.assign(3, {1, 0, 0, 0});
  cloth.reach = {0.0f, 0.0f, 10.0f};
  cloth.triangles = {0, 1, 2};
  cloth.vertex_triangle.assign(3, Cloth::kUnbound);
  cloth.vertex_weights.assign(3, glm::vec3(0.0f));
  Hanging pendulum(cloth);
  std::vector<double> crossings;
  float before = tilt;
  for (int frame = 0; frame < 1200; ++frame) {
    pendulum.Step(1.0f / 120.0f);
    const float z = pendulum.particles()[2].z;
    if (before < 0.0f && z >= 0.0f) {
      crossings.push_back((frame + double(-before / (z - before))) / 120.0);
    }
    before = z;
  }
  ASSERT_GE(crossings.size(), 5u);
  const double period =
      (crossings.back() - crossings.front()) / static_cast<double>(crossings.size() - 1);
  const double expected = 2.0 * double(kPiF) * std::sqrt(0.4 / double(kGravity)) *
                          (1.0 + double(tilt) * double(tilt) / 16.0);
  EXPECT_NEAR(period, expected, 0.005 * expected);
}

TEST(Cloth, StripBetweenTwoPinsHangsAsACatenary) {
  constexpr int kCells = 40;
  constexpr float kCell = 0.025f;  // 1 m of cloth
  Cloth cloth = Sheet(kCells, 1, kCell, 0.0f);
  cloth.bend_compliance = 1e6f;
  for (const int column : {0, kCells}) {
    cloth.reach[column] = cloth.reach[column + kCells + 1] = 0.0f;
  }
  // The strip lies along z in y; the pins stand 0.7 m apart.
  for (glm::vec3& p : cloth.positions) {
    p = {p.x, 0.0f, p.y};
  }
  Hanging strip(cloth,
                {.gravity = kGravity, .air_density = 0.0f, .damping = 2.0f, .drops_loose = false});
  // The pins are moved together by giving the right-hand pins a second joint, whose pose changes in
  // small steps.
  Human human = strip.human;
  human.skeleton.names.push_back("right");
  human.skeleton.parents.push_back(Skeleton::kNoParent);
  human.skeleton.rest.emplace_back();
  human.skeleton.joint_from_actor.emplace_back(1.0f);
  for (const int column : {kCells, 2 * kCells + 1}) {
    human.cloths[0].joints[column] = {1, 0, 0, 0};
  }
  const ClothModel model(
      human, {.gravity = kGravity, .air_density = 0.0f, .damping = 2.0f, .drops_loose = false});
  ClothState state(model);
  std::vector<glm::mat4> joints(2, glm::mat4(1.0f));
  ClothStep step;
  step.actor_from_joint = joints;
  step.floor_height = -1000.0f;
  step.elapsed = 1.0f / 60.0f;
  for (int frame = 0; frame < 600; ++frame) {
    const float closed = std::min(static_cast<float>(frame) / 120.0f, 1.0f) * 0.3f;
    joints[1] = glm::translate(glm::mat4(1.0f), glm::vec3(-closed, 0.0f, 0.0f));
    StepCloth(model, step, state);
  }
  // length = 2 a sinh(span / 2a), sag = a (cosh(span / 2a) - 1); bisection in a.
  double low = 0.01, high = 10.0;
  for (int i = 0; i < 100; ++i) {
    const double a = 0.5 * (low + high);
    (2.0 * a * std::sinh(0.35 / a) > 1.0 ? low : high) = a;
  }
  const double sag = low * (std::cosh(0.35 / low) - 1.0);
  const std::span<const glm::vec3> x = state.particles(0);
  EXPECT_NEAR(x[kCells / 2].y, -sag, 0.04 * sag);
  for (int column = 0; column <= kCells; ++column) {
    const double from_middle = double(x[column].x) - 0.35;
    const double y = low * (std::cosh(from_middle / low) - 1.0) - sag;
    EXPECT_NEAR(x[column].y, y, 0.015) << column;
  }
}

// The energy of a hinge is chord^2 / (2 compliance). The moment of a weight at the arm's end thus
// gives tan(angle) = compliance * weight * arm.
TEST(Cloth, HingeBendsUnderAWeightByItsCompliance) {
  Cloth cloth;
  const float h = 0.1f * std::sqrt(3.0f) / 2.0f;  // equilateral triangles of 10 cm
  cloth.positions = {{0, 0, -0.05f}, {0, 0, 0.05f}, {-h, 0, 0}, {h, 0, 0}};
  cloth.joints.assign(4, {0, 0, 0, 0});
  cloth.weights.assign(4, {1, 0, 0, 0});
  cloth.reach = {0.0f, 0.0f, 0.0f, 10.0f};
  cloth.triangles = {0, 1, 2, 1, 0, 3};
  cloth.vertex_triangle.assign(4, Cloth::kUnbound);
  cloth.vertex_weights.assign(4, glm::vec3(0.0f));
  cloth.density = 0.25f;
  cloth.bend_compliance = 1500.0f;
  Hanging hinge(cloth,
                {.gravity = kGravity, .air_density = 0.0f, .damping = 5.0f, .drops_loose = false});
  hinge.Run(5.0f, 60.0f);
  const float mass = 0.25f * 0.5f * 0.1f * h / 3.0f;
  const float expected = std::atan(1500.0f * mass * kGravity * h);
  EXPECT_GT(expected, 0.2f);
  const glm::vec3 tip = hinge.particles()[3];
  EXPECT_NEAR(std::atan2(-tip.y, tip.x), expected, 0.01f * expected);
}

TEST(Cloth, FlatSheetSinksAtItsTerminalSpeed) {
  Cloth cloth = Sheet(6, 6, 0.05f, 0.0f);
  for (glm::vec3& p : cloth.positions) {
    p = {p.x, 0.0f, p.y};
  }
  cloth.density = 0.02f;
  cloth.bend_compliance = 0.0f;
  ClothSettings undamped = kDroppable;
  undamped.damping = 0.0f;
  Hanging sheet(cloth, undamped);
  sheet.Run(2.0f, 60.0f);
  const float expected = std::sqrt(2.0f * 0.02f * kGravity / (1.2f * 1.3f));
  EXPECT_NEAR(-sheet.state.data().velocities[24].y(), expected, 0.03f * expected);
}

TEST(Cloth, SwingingSheetGainsNoEnergy) {
  Cloth cloth = Sheet(10, 10, 0.05f, 0.0f);
  for (int column = 0; column <= 10; ++column) {
    cloth.reach[column] = 0.0f;
  }
  for (glm::vec3& p : cloth.positions) {
    p = {p.x, 0.0f, p.y};  // held level, then released
  }
  Hanging sheet(cloth);
  const double start = Energy(sheet.model, sheet.state);
  double highest = start;
  for (int frame = 0; frame < 600; ++frame) {
    sheet.Step(1.0f / 60.0f);
    highest = std::max(highest, Energy(sheet.model, sheet.state));
  }
  const double mass = 0.25 * 0.5 * 0.5;
  EXPECT_LT(highest - start, 0.01 * mass * double(kGravity) * 0.5);
}

TEST(Cloth, HangingSheetHardlyStretches) {
  Cloth cloth = Sheet(16, 24, 0.03f, 0.0f);
  for (int column = 0; column <= 16; ++column) {
    cloth.reach[column] = 0.0f;
  }
  for (const ClothDetail detail :
       {ClothDetail::kFull, ClothDetail::kReduced, ClothDetail::kCoarse}) {
    Hanging sheet(cloth, {});
    sheet.step.detail = detail;
    sheet.Run(4.0f, 60.0f);
    EXPECT_LT(LargestStrain(sheet.model, sheet.particles()), 0.06f);
    const float length = -sheet.particles().back().y;
    EXPECT_NEAR(length, 0.72f, 0.02f * 0.72f);
  }
}

TEST(Cloth, HangsAlikeAt25And120FramesASecond) {
  Cloth cloth = Sheet(12, 12, 0.04f, 0.0f);
  cloth.reach[0] = cloth.reach[12] = 0.0f;
  Hanging slow(cloth, {}), fast(cloth, {});
  slow.Run(8.0f, 25.0f);
  fast.Run(8.0f, 120.0f);
  for (size_t i = 0; i < slow.particles().size(); ++i) {
    EXPECT_LT(glm::distance(slow.particles()[i], fast.particles()[i]), 0.002f) << i;
  }
}

TEST(Cloth, SlidesToAStopAsFrictionSays) {
  Cloth cloth = Sheet(4, 4, 0.05f, 0.0f);
  for (glm::vec3& p : cloth.positions) {
    p = {p.x, 0.0f, p.y};
  }
  cloth.friction = 0.5f;
  cloth.thickness = 0.0f;
  Hanging sheet(cloth);
  sheet.step.floor_height = 0.0f;
  sheet.state.data().adopts_motion = false;
  for (Float4& velocity : sheet.state.data().velocities) {
    velocity = Float4(glm::vec3(1.0f, 0.0f, 0.0f));
  }
  sheet.Run(1.0f, 60.0f);
  const float expected = 1.0f / (2.0f * 0.5f * kGravity);
  EXPECT_NEAR(sheet.particles()[12].x - cloth.positions[12].x, expected, 0.05f * expected);
}

TEST(Cloth, IsBitForBitTheSameAndASnapshotReplays) {
  const Human human = SkirtedWalker(20, 12);
  const ClothModel model(human);
  ClothState first(model), second(model);
  WalkerPose walker;
  ClothStep step;
  step.wind.velocity = {2.0f, 0.0f, 0.0f};
  const auto frame = [&](int i, ClothState& state) {
    PoseWalker(human, i / 30.0, walker);
    step.actor_from_joint = walker.actor_from_joint;
    step.stage_from_actor = walker.stage_from_actor;
    step.elapsed = 1.0f / 30.0f;
    StepCloth(model, step, state);
  };
  for (int i = 0; i < 30; ++i) {
    frame(i, first);
    frame(i, second);
  }
  ClothState snapshot = first;
  for (int i = 30; i < 60; ++i) {
    frame(i, first);
  }
  for (int i = 30; i < 60; ++i) {
    frame(i, snapshot);
    frame(i, second);
  }
  for (size_t i = 0; i < model.particle_count(); ++i) {
    EXPECT_EQ(first.particles(0)[i], second.particles(0)[i]);
    EXPECT_EQ(first.particles(0)[i], snapshot.particles(0)[i]);
  }
}

struct WalkReport {
  float deepest = 0.0f;
  float strain = 0.0f;
  int resets = 0;
  int jumps = 0;
};

WalkReport Walk(const Human& human,
                ClothState& state,
                const ClothModel& model,
                double from,
                double seconds,
                double rate) {
  WalkReport report;
  WalkerPose walker;
  ClothStep step;
  step.wind.velocity = {1.0f, 0.0f, 0.5f};
  const int frames = static_cast<int>(seconds * rate);
  for (int i = 0; i <= frames; ++i) {
    PoseWalker(human, from + i / rate, walker);
    step.actor_from_joint = walker.actor_from_joint;
    step.stage_from_actor = walker.stage_from_actor;
    step.elapsed = static_cast<float>(1.0 / rate);
    const ClothReport frame = StepCloth(model, step, state);
    report.resets += frame.reset ? 1 : 0;
    report.jumps += frame.jumped ? 1 : 0;
    if (i % 4 == 0) {
      report.deepest = std::max(
          report.deepest, DeepestPenetration(human, state.particles(0), walker.actor_from_joint));
    }
    report.strain = std::max(report.strain, MeanStrain(model, state.particles(0)));
  }
  return report;
}

TEST(Cloth, WalkerNeverComesThroughTheSkirt) {
  const Human human = SkirtedWalker(36, 14);
  const ClothModel model(human);
  for (const double rate : {25.0, 120.0}) {
    ClothState state(model);
    const WalkReport report = Walk(human, state, model, 0.0, 12.0, rate);
    EXPECT_LT(report.deepest, 0.01f) << rate;
    EXPECT_LT(report.strain, 0.02f) << rate;
    EXPECT_EQ(report.resets, 0);
    EXPECT_EQ(report.jumps, 1);  // the first frame
  }
}

TEST(Cloth, WalksAlikeAt25And120FramesASecond) {
  const Human human = SkirtedWalker(24, 16);
  const ClothModel model(human);
  ClothState slow(model), fast(model);
  Walk(human, slow, model, 0.0, 4.0, 25.0);
  Walk(human, fast, model, 0.0, 4.0, 120.0);
  double sum = 0.0;
  for (size_t i = 0; i < model.particle_count(); ++i) {
    sum += double(glm::distance(slow.particles(0)[i], fast.particles(0)[i]));
  }
  EXPECT_LT(sum / double(model.particle_count()), 0.06);
}

TEST(Cloth, IsCarriedAlongByATeleportAndReportsIt) {
  const Human human = SkirtedWalker(20, 12);
  const ClothModel model(human);
  ClothState state(model);
  WalkerPose walker;
  PoseWalker(human, 9.0, walker);
  ClothStep step;
  step.actor_from_joint = walker.actor_from_joint;
  step.elapsed = 1.0f / 60.0f;
  EXPECT_TRUE(StepCloth(model, step, state).jumped);
  for (int i = 0; i < 480; ++i) {
    EXPECT_FALSE(StepCloth(model, step, state).jumped);
  }
  const std::vector<glm::vec3> before(state.particles(0).begin(), state.particles(0).end());
  step.stage_from_actor =
      glm::rotate(glm::translate(glm::mat4(1.0f), glm::vec3(30.0f, 1.0f, -20.0f)), 2.0f,
                  glm::vec3(0.0f, 1.0f, 0.0f));
  step.floor_height = 1.0f;
  EXPECT_TRUE(StepCloth(model, step, state).jumped);
  for (int i = 0; i < 60; ++i) {
    for (size_t k = 0; k < before.size(); ++k) {
      ASSERT_LT(glm::distance(before[k], state.particles(0)[k]), 0.02f);
    }
    EXPECT_FALSE(StepCloth(model, step, state).jumped);
  }
}

TEST(Cloth, ShowsASettledShapeAfterASeek) {
  const Human human = SkirtedWalker(20, 12);
  const ClothModel model(human);
  ClothState state(model);
  WalkerPose walker;
  ClothStep step;
  for (const double time : {0.3, 8.0, 17.9, 25.0}) {
    PoseWalker(human, time, walker);
    step.actor_from_joint = walker.actor_from_joint;
    step.stage_from_actor = walker.stage_from_actor;
    step.elapsed = 5.0f;
    EXPECT_TRUE(StepCloth(model, step, state).jumped);
    const std::vector<glm::vec3> shown(state.particles(0).begin(), state.particles(0).end());
    step.elapsed = 1.0f / 60.0f;
    for (int i = 0; i < 30; ++i) {
      StepCloth(model, step, state);
    }
    for (size_t k = 0; k < shown.size(); ++k) {
      EXPECT_LT(glm::distance(shown[k], state.particles(0)[k]), 0.06f) << time;
    }
  }
}

TEST(Cloth, IgnoresInputThatIsNotFinite) {
  const Human human = SkirtedWalker(16, 8);
  const ClothModel model(human);
  ClothState state(model);
  WalkerPose walker;
  PoseWalker(human, 0.0, walker);
  ClothStep step;
  step.actor_from_joint = walker.actor_from_joint;
  step.elapsed = 1.0f / 60.0f;
  StepCloth(model, step, state);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinite = std::numeric_limits<float>::infinity();
  for (const float bad : {nan, infinite, 1e30f}) {
    ClothStep broken = step;
    broken.stage_from_actor[3].x = bad;
    StepCloth(model, broken, state);
    std::vector<glm::mat4> pose = walker.actor_from_joint;
    pose[2][1].y = bad;
    broken = step;
    broken.actor_from_joint = pose;
    StepCloth(model, broken, state);
    broken = step;
    broken.wind.velocity.x = bad;
    broken.wind.gust = bad;
    broken.floor_height = bad;
    StepCloth(model, broken, state);
    broken = step;
    broken.elapsed = bad;
    StepCloth(model, broken, state);
    StepCloth(model, step, state);
    for (const glm::vec3& p : state.particles(0)) {
      ASSERT_LT(glm::length(p), 3.0f) << bad;
    }
  }
}

TEST(Cloth, ReturnsToTheSkinWhenAParticleIsLost) {
  const Human human = SkirtedWalker(16, 8);
  const ClothModel model(human);
  ClothState state(model);
  WalkerPose walker;
  PoseWalker(human, 0.0, walker);
  ClothStep step;
  step.actor_from_joint = walker.actor_from_joint;
  step.elapsed = 1.0f / 60.0f;
  StepCloth(model, step, state);
  state.data().positions[50] = Float4(glm::vec3(std::numeric_limits<float>::quiet_NaN()));
  EXPECT_TRUE(StepCloth(model, step, state).reset);
  for (const glm::vec3& p : state.particles(0)) {
    EXPECT_LT(glm::length(p), 2.0f);
  }
  EXPECT_FALSE(StepCloth(model, step, state).reset);
}

TEST(Cloth, SurvivesRandomJolts) {
  const Human human = SkirtedWalker(12, 6);
  const ClothModel model(human);
  ClothState state(model);
  WalkerPose walker;
  ClothStep step;
  Random random(7);
  for (int i = 0; i < 500; ++i) {
    PoseWalker(human, random.Uniform(0.0, 30.0), walker);
    step.actor_from_joint = walker.actor_from_joint;
    const glm::vec3 place = glm::vec3{random.Normal(), random.Normal(), random.Normal()} * 0.05f;
    step.stage_from_actor =
        glm::rotate(glm::translate(glm::mat4(1.0f), place),
                    static_cast<float>(random.Normal()) * 0.1f, glm::vec3(0.0f, 1.0f, 0.0f));
    step.wind.velocity = glm::vec3{random.Normal(), random.Normal(), random.Normal()} * 10.0f;
    step.elapsed = static_cast<float>(random.Uniform(0.0, 0.05));
    step.detail = static_cast<ClothDetail>(random.Below(4));
    StepCloth(model, step, state);
    for (const glm::vec3& p : state.particles(0)) {
      ASSERT_LT(glm::length(p - glm::vec3(0.0f, 0.8f, 0.0f)), 2.0f);
    }
  }
}

TEST(Cloth, ChangesItsDetailWithoutAJump) {
  const Human human = SkirtedWalker(20, 12);
  const ClothModel model(human);
  ClothState state(model);
  WalkerPose walker;
  ClothStep step;
  std::vector<glm::vec3> before;
  const ClothDetail order[] = {ClothDetail::kFull, ClothDetail::kReduced, ClothDetail::kCoarse,
                               ClothDetail::kSkinned, ClothDetail::kFull};
  float fastest = 0.0f;
  for (int i = 0; i < 600; ++i) {
    PoseWalker(human, 8.0 + 0.0 * i, walker);
    step.actor_from_joint = walker.actor_from_joint;
    step.elapsed = 1.0f / 60.0f;
    step.detail = order[i / 120];
    StepCloth(model, step, state);
    for (size_t k = 0; k < before.size(); ++k) {
      fastest = std::max(fastest, glm::distance(before[k], state.particles(0)[k]));
    }
    before.assign(state.particles(0).begin(), state.particles(0).end());
  }
  EXPECT_LT(fastest, 0.03f);
}

TEST(Cloth, SheetsThatFallOnOneAnotherStayApart) {
  Cloth low = Sheet(8, 8, 0.03f, 0.0f);
  for (glm::vec3& p : low.positions) {
    p = {p.x, 0.0f, p.y};
  }
  Cloth high = low;
  for (glm::vec3& p : high.positions) {
    p += glm::vec3(0.008f, 0.1f, 0.005f);
  }
  std::fill(low.reach.begin(), low.reach.end(), 0.0f);
  Human human = Hanging::Dress(low);
  human.meshes.push_back(human.meshes[0]);
  high.mesh = 1;
  human.cloths.push_back(high);
  const ClothModel model(human, kDroppable);
  ClothState state(model);
  const std::vector<glm::mat4> identity{glm::mat4(1.0f)};
  ClothStep step;
  step.actor_from_joint = identity;
  step.floor_height = -1.0f;
  step.elapsed = 1.0f / 60.0f;
  for (int i = 0; i < 180; ++i) {
    StepCloth(model, step, state);
  }
  for (size_t k = 0; k < state.particles(1).size(); ++k) {
    const glm::vec3 p = state.particles(1)[k];
    if (p.x < 0.24f && p.z > -0.24f) {
      EXPECT_GT(p.y, 0.0f) << k;
    }
  }
}

TEST(Cloth, WhatNoPinHoldsStaysWithTheSkin) {
  Hanging sheet(Sheet(6, 6, 0.05f, 1.0f), {});
  sheet.Run(2.0f, 60.0f);
  for (size_t i = 0; i < sheet.particles().size(); ++i) {
    EXPECT_LT(glm::distance(sheet.particles()[i], sheet.human.cloths[0].positions[i]), 1e-5f);
  }
}

TEST(Cloth, SeamsOfTheDrawnMeshStayClosed) {
  Human human = SkirtedWalker(16, 8);
  SkinnedMesh& mesh = human.meshes[0];
  Cloth& cloth = human.cloths[0];
  // Two vertices at the same position, bound to the triangles on both sides of an edge.
  for (const uint32_t triangle : {20u, 21u}) {
    mesh.positions.push_back(0.5f * (mesh.positions[40] + mesh.positions[56]) +
                             glm::vec3(0.01f, 0.0f, 0.0f));
    mesh.normals.push_back(mesh.normals[40]);
    mesh.albedo.push_back(mesh.albedo[40]);
    mesh.joints.push_back(mesh.joints[40]);
    mesh.weights.push_back(mesh.weights[40]);
    cloth.vertex_triangle.push_back(triangle);
    cloth.vertex_weights.emplace_back(0.5f, 0.5f, 0.01f);
  }
  const ClothModel model(human);
  ClothState state(model);
  WalkerPose walker;
  ClothStep step;
  step.elapsed = 1.0f / 60.0f;
  std::vector<glm::vec3> x(mesh.positions.size()), n(x.size());
  const std::vector<glm::mat4> skin(human.skeleton.size(), glm::mat4(1.0f));
  for (int i = 0; i < 60; ++i) {
    PoseWalker(human, i / 60.0, walker);
    step.actor_from_joint = walker.actor_from_joint;
    StepCloth(model, step, state);
    DrapeMesh(model, state, 0, mesh, skin, x, n);
    EXPECT_EQ(x[x.size() - 1], x[x.size() - 2]);
  }
}

// A capsule is only a rough body. If the drawn skin is outside it, the cloth must stay outside the
// skin.
TEST(Cloth, LiesOnSkinThatStandsOutOfItsCapsule) {
  std::array<float, 2> heights = {};
  for (const bool has_skin : {false, true}) {
    Cloth cloth = Sheet(10, 10, 0.03f, 0.0f);
    for (glm::vec3& p : cloth.positions) {
      p = {p.x - 0.15f, 0.15f, p.y + 0.15f};
    }
    Human human = Hanging::Dress(cloth);
    human.capsules.push_back({0, {-0.2f, 0.0f, 0.0f}, {0.2f, 0.0f, 0.0f}, 0.08f, 0.08f});
    if (has_skin) {
      human.materials.emplace_back();
      human.materials.back().surface = Surface::kSkin;
      SkinnedMesh skin;
      for (int i = 0; i < 30; ++i) {
        skin.positions.emplace_back(-0.15f + 0.01f * static_cast<float>(i), 0.1f, 0.0f);
        skin.indices.push_back(static_cast<uint32_t>(i));
      }
      skin.material = 0;
      human.meshes.push_back(skin);
    }
    const ClothModel model(human, kDroppable);
    ClothState state(model);
    const std::vector<glm::mat4> identity{glm::mat4(1.0f)};
    ClothStep step;
    step.actor_from_joint = identity;
    step.floor_height = -1.0f;
    step.elapsed = 1.0f / 60.0f;
    StepCloth(model, step, state);
    heights[has_skin ? 1 : 0] = state.particles(0)[60].y;
  }
  EXPECT_NEAR(heights[0], 0.08f + 0.006f, 0.004f);
  EXPECT_NEAR(heights[1] - heights[0], 0.02f, 0.003f);
}

TEST(Cloth, DrapedMeshTurnsWithTheBodyAndItsNormalsToo) {
  Human human = SkirtedWalker(16, 8);
  for (float& reach : human.cloths[0].reach) {
    reach = 0.0f;
  }
  human.cloths[0].vertex_triangle[3] = Cloth::kUnbound;
  for (size_t v = 0; v < human.meshes[0].normals.size(); ++v) {
    human.meshes[0].normals[v] =
        glm::normalize(glm::vec3(std::sin(float(v)), 0.3f, std::cos(float(v))));
    human.cloths[0].weights[v] = human.meshes[0].weights[v] = {1, 0, 0, 0};
    human.cloths[0].vertex_weights[v].z = 0.004f;
  }
  const ClothModel model(human);
  ClothState state(model);
  WalkerPose walker;
  PoseWalker(human, 0.0, walker);
  const auto drape = [&](const glm::mat4& turn, std::vector<glm::vec3>& x,
                         std::vector<glm::vec3>& n) {
    std::vector<glm::mat4> joints(walker.actor_from_joint.size());
    std::vector<glm::mat4> skin(joints.size());
    for (size_t j = 0; j < joints.size(); ++j) {
      skin[j] = turn;
      joints[j] = turn * glm::inverse(human.skeleton.joint_from_actor[j]);
    }
    ClothStep step;
    step.actor_from_joint = joints;
    step.elapsed = 1.0f;
    StepCloth(model, step, state);
    x.resize(human.meshes[0].positions.size());
    n.resize(x.size());
    DrapeMesh(model, state, 0, human.meshes[0], skin, x, n);
  };
  std::vector<glm::vec3> rest_x, rest_n, x, n;
  drape(glm::mat4(1.0f), rest_x, rest_n);
  const glm::mat4 turn = glm::rotate(glm::mat4(1.0f), 1.2f, glm::normalize(glm::vec3(1, 2, 3)));
  drape(turn, x, n);
  EXPECT_LT(glm::distance(rest_x[3], human.meshes[0].positions[3]), 1e-6f);
  for (size_t v = 0; v < x.size(); ++v) {
    EXPECT_LT(glm::distance(rest_n[v], human.meshes[0].normals[v]), 1e-4f);
    EXPECT_LT(glm::distance(x[v], glm::vec3(turn * glm::vec4(rest_x[v], 1.0f))), 1e-4f);
    EXPECT_LT(glm::distance(n[v], glm::vec3(turn * glm::vec4(rest_n[v], 0.0f))), 1e-4f);
  }
}

TEST(RoundCone, NearestSphereGivesTheDistanceToTheHull) {
  Random random(3);
  for (int trial = 0; trial < 200; ++trial) {
    const auto point = [&] {
      return Float4(glm::vec3{random.Normal(), random.Normal(), random.Normal()});
    };
    const Float4 a = point(), b = point(), p = point();
    const auto radius_a = static_cast<float>(random.Uniform(0.0, 1.0));
    const auto radius_b = static_cast<float>(random.Uniform(0.0, 1.0));
    const NearestSphere sphere = FindNearestSphere(MakeRoundCone(a, b, radius_a, radius_b), p);
    float expected = std::numeric_limits<float>::infinity();
    for (int i = 0; i <= 2000; ++i) {
      const float share = static_cast<float>(i) / 2000.0f;
      expected = std::min(expected,
                          Length(p - Mix(a, b, share)) - radius_a - share * (radius_b - radius_a));
    }
    EXPECT_NEAR(sphere.distance - sphere.radius, expected, 2e-3f);
  }
}

}  // namespace
}  // namespace lararium::human
