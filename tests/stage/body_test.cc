// Complete bodies at the stage's objects: checks the drawn poses, not only the state.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <numbers>

#include "shared/human/animator.h"
#include "shared/stage/stage.h"
#include "tests/human/full_body.h"
#include "tests/stage/test_props.h"

namespace lararium::stage {
namespace {

class BodyTest : public ::testing::Test {
 protected:
  BodyTest()
      : human_(std::make_shared<human::Human>(human::FullBody(0.9f, 0))),
        keeper_(*stage_.Add("keeper", human_)),
        animator_(stage_.Find(keeper_)->model) {}

  ObjectId AddObject(const char* name, stage::Prop prop, float x, float z) {
    return *stage_.AddObject(name, test::Model(std::move(prop)), {{x, 0.0f, z}});
  }
  void Place(float x, float z) {
    stage_.Place(keeper_, {x, 0.0f, z}, 0.0f);
    stage_.Show(keeper_, true);
  }
  void Tick() {
    stage_.Advance();
    stage_.Perform();
  }
  void Finish(const Result<TaskId>& task) {
    ASSERT_TRUE(task.ok()) << task.message();
    for (int tick = 0; tick < 60 * 120 && !stage_.tasks().report(*task).over(); ++tick) {
      Tick();
    }
    EXPECT_EQ(stage_.tasks().report(*task).state, TaskReport::State::kDone)
        << stage_.tasks().report(*task).message;
  }
  // Middle between the hip joints of the drawn body, stage frame.
  glm::vec3 Hips() {
    animator_.Pose(State().animation_state);
    glm::vec3 middle(0.0f);
    for (const human::BodyRig::Leg& leg : animator_.model().sitting.body.legs) {
      middle +=
          0.5f *
          human::ActorFromJoint(animator_.human().skeleton, animator_.pose(), leg.hip).position;
    }
    return StageFromActorPose(State()) * middle;
  }
  const ActorState& State() { return stage_.Find(keeper_)->state; }

  // Palm of the drawn body.
  Pose StageFromPalm(int side) {
    animator_.Pose(State().animation_state);
    const human::GripFrame palm = human::ActorFromPalm(
        animator_.model().reach, animator_.human().skeleton, animator_.pose(), side);
    return StageFromActorPose(State()) * Pose{palm.position, palm.rotation};
  }

  std::shared_ptr<const human::Human> human_;
  Stage stage_;
  ActorId keeper_;
  human::Animator animator_;
};

TEST_F(BodyTest, TheHandStaysOnTheGripOfAMovingPart) {
  const ObjectId chest = AddObject("chest", test::MakeChest(), 0, 0);
  Place(1, -3);
  const auto task = stage_.tasks().Use(keeper_, chest, "open", 0.0f);
  ASSERT_TRUE(task.ok());
  float worst = 0.0f;
  int ticks = 0;
  while (!stage_.tasks().report(*task).over()) {
    Tick();
    const Object& object = *stage_.Find(chest);
    if (object.state.action == 0 && ++ticks % 6 == 0) {
      const Pose grip =
          object.state.stage_from_object * ObjectFromGrip(*object.model, object.state.joints, 0);
      worst = std::max(worst, glm::distance(StageFromPalm(human::kRight).position, grip.position));
    }
  }
  EXPECT_GT(ticks, 100);
  EXPECT_LT(worst, 0.005f);
}

// A place with an axis-aligned solid box.
stage::Place PlaceWith(const stage::PropMesh& solid) {
  stage::Place place;
  Occluder& occluder = place.occluders.emplace_back();
  occluder.name = "solid";
  occluder.mesh.positions = solid.positions;
  occluder.mesh.indices = solid.indices;
  return place;
}

TEST_F(BodyTest, PeopleReachOverACounterFromEitherSide) {
  // 0.6 m deep, 1 m high, with a wall at one end and the other one free.
  NavigationOptions floor;
  floor.floor = {{-3, -3}, {3, -3}, {3, 3}, {-3, 3}};
  const std::array places = {
      PlaceWith(test::MakeBox({-1.5f, 0.0f, -0.3f}, {1.0f, 1.0f, 0.3f})),
      PlaceWith(test::MakeBox({-3.5f, 0.0f, -3.0f}, {-1.5f, 2.5f, 3.0f})),
  };
  std::vector<ObjectId> things;
  for (const glm::vec2 at : {glm::vec2(0.3f, 0.0f), glm::vec2(0.0f, 0.2f), glm::vec2(-0.3f, -0.2f),
                             glm::vec2(-1.2f, 0.0f)}) {
    things.push_back(*stage_.AddObject("thing" + std::to_string(things.size()),
                                       test::Model(test::MakeCup()), {{at.x, 1.0f, at.y}}));
  }
  ASSERT_TRUE(stage_.SetFloor(floor, places).ok());
  for (const float side : {1.5f, -1.5f}) {
    for (const ObjectId thing : things) {
      Place(0.0f, side);
      // Turned so that an actor on that side can take it.
      const glm::vec3 lies = stage_.Find(thing)->state.stage_from_object.position;
      const float turn = side > 0.0f ? 0.0f : std::numbers::pi_v<float>;
      stage_.Place(thing, {lies, glm::angleAxis(turn, glm::vec3(0.0f, 1.0f, 0.0f))});
      const auto task = stage_.tasks().Take(keeper_, thing);
      float missed = 1.0f;
      bool held = false;
      while (!stage_.tasks().report(*task).over()) {
        Tick();
        const ObjectState& state = stage_.Find(thing)->state;
        if (state.holder && !held) {  // The moment in which it is taken.
          held = true;
          const Pose grip = state.stage_from_object * ObjectFromGrip(*stage_.Find(thing)->model,
                                                                     state.joints, state.hands[0]);
          missed = glm::distance(StageFromPalm(human::kRight).position, grip.position);
        }
        const glm::vec3& at = State().position;
        EXPECT_FALSE(at.x > -1.5f && at.x < 1.0f && std::abs(at.z) < 0.42f) << "in the counter";
      }
      EXPECT_EQ(stage_.tasks().report(*task).state, TaskReport::State::kDone)
          << stage_.tasks().report(*task).message;
      EXPECT_GT(State().position.z * side, 0.0f) << "on the side where it came from";
      EXPECT_LT(missed, 0.005f);
      stage_.Place(thing, {lies});
    }
  }
}

TEST_F(BodyTest, WhatIsCarriedStaysInTheHandAndUpright) {
  const ObjectId cup = AddObject("cup", test::MakeCup(), 0, 0);
  Place(1, -3);
  auto task = stage_.tasks().Take(keeper_, cup);
  while (!stage_.tasks().report(*task).over()) {
    Tick();
  }
  task = stage_.tasks().Walk(keeper_, {-3, 3}, {}, 0.0f);
  float furthest = 0.0f;
  float most_tilted = 1.0f;
  for (int tick = 0; !stage_.tasks().report(*task).over(); ++tick) {
    Tick();
    if (tick % 10 != 0) {
      continue;
    }
    const Object& object = *stage_.Find(cup);
    const Pose palm = StageFromPalm(human::kRight);
    const human::GripFrame in_actor = human::ActorFromPalm(
        animator_.model().reach, animator_.human().skeleton, animator_.pose(), human::kRight);
    const Pose drawn = DrawnPose(*object.model, object.state, StageFromActor(State()), in_actor);
    const Pose grip = drawn * ObjectFromGrip(*object.model, object.state.joints,
                                             object.state.hands[human::kRight]);
    furthest = std::max(furthest, glm::distance(grip.position, palm.position));
    most_tilted = std::min(most_tilted, (drawn.rotation * glm::vec3(0, 1, 0)).y);
  }
  EXPECT_LT(furthest, 1e-4f);
  EXPECT_GT(most_tilted, 0.995f) << "within 6 degrees";
}

TEST_F(BodyTest, SitsOnAStoolDrinksThereAndGetsUp) {
  const ObjectId stool = AddObject("stool", test::MakeStool(), 0, 0);
  const ObjectId cup = AddObject("cup", test::MakeCup(), 1.5f, -1.5f);
  stage_.SetState(cup, 1);
  Place(1, -3);
  Finish(stage_.tasks().Take(keeper_, cup));
  Finish(stage_.tasks().Use(keeper_, stool, "sit", 0.0f));
  ASSERT_TRUE(stage_.tasks().Sits(keeper_));
  const human::SittingModel& model = animator_.model().sitting;
  EXPECT_NEAR(Hips().y, 0.46f + model.seat_to_hips, 0.01f);
  EXPECT_LT(glm::length(glm::vec2(Hips().x, Hips().z - 0.02f)), 0.05f) << "over the seat";
  EXPECT_LT(std::abs(State().heading), 0.05f);

  const auto drink = stage_.tasks().Use(keeper_, cup, "drink", 0.0f);
  const glm::vec3 feet = State().position;
  float nearest = 1.0f;
  float missed = 0.0f;
  while (!stage_.tasks().report(*drink).over()) {
    Tick();
    const Object& object = *stage_.Find(cup);
    const Pose palm = StageFromPalm(human::kRight);
    const Pose grip = object.state.stage_from_object *
                      ObjectFromGrip(*object.model, object.state.joints, object.state.hands[0]);
    missed = std::max(missed, glm::distance(palm.position, grip.position));
    const glm::vec3 mouth =
        StageFromUpperBody(*stage_.Find(keeper_)) * glm::vec3(0.0f, 1.5f, -0.1f);
    nearest = std::min(nearest, glm::distance(object.state.stage_from_object.position, mouth));
  }
  EXPECT_LT(missed, 0.005f);
  EXPECT_LT(nearest, 0.2f);
  EXPECT_TRUE(stage_.tasks().Sits(keeper_)) << "nobody gets up to drink";
  EXPECT_EQ(State().position, feet);

  Finish(stage_.tasks().Walk(keeper_, {1, -2}, {}, 0.0f));
  EXPECT_EQ(State().animation_state.sitting.amount, 0.0f);
  EXPECT_LT(glm::distance(stage_.Find(keeper_)->place(), glm::vec2(1, -2)), 0.05f);
}

TEST_F(BodyTest, FeetStandWhileTheBodySitsDownAndGetsUp) {
  const ObjectId stool = AddObject("stool", test::MakeStool(), 0, 0);
  Place(1, -3);
  const auto sit = stage_.tasks().Use(keeper_, stool, "sit", 0.0f);
  std::array<glm::vec3, 2> stood;
  float slid = 0.0f;
  bool watching = false;
  const auto watch = [&] {
    animator_.Pose(State().animation_state);
    for (size_t side = 0; side < 2; ++side) {
      const human::JointFrame ankle =
          human::ActorFromJoint(animator_.human().skeleton, animator_.pose(),
                                animator_.model().sitting.body.legs[side].ankle);
      const glm::vec3 at = StageFromActorPose(State()) * ankle.position;
      slid = watching ? std::max(slid, glm::distance(at, stood[side])) : 0.0f;
      stood[side] = watching ? stood[side] : at;
    }
    watching = true;
  };
  while (!stage_.tasks().report(*sit).over()) {
    Tick();
    if (State().animation_state.sitting.amount > 0.0f) {
      watch();
    }
  }
  const auto stand = stage_.tasks().Stand(keeper_);
  while (State().animation_state.sitting.amount > 0.0f) {
    Tick();
    watch();
  }
  EXPECT_TRUE(watching);
  EXPECT_LT(slid, 0.005f);
  Finish(stand);
}

TEST_F(BodyTest, FeetDoNotSlideOnTheCrowdsWays) {
  AddObject("table", test::MakeTable(), 0, 0);
  Place(-3, -2);
  Tick();
  float worst = 0.0f;
  std::array<human::Locomotion::Foot, 2> before = State().animation_state.locomotion.feet;
  std::array<float, 2> slid = {0.0f, 0.0f};
  for (const glm::vec2 goal : {glm::vec2(3, 2), glm::vec2(-2, 2.5f), glm::vec2(2, -3)}) {
    const auto task = stage_.tasks().Walk(keeper_, goal, {}, 0.0f);
    while (!stage_.tasks().report(*task).over()) {
      Tick();
      for (size_t side = 0; side < 2; ++side) {
        const human::Locomotion::Foot& foot = State().animation_state.locomotion.feet[side];
        if (foot.planted && before[side].planted) {
          slid[side] += glm::distance(foot.print.position, before[side].print.position);
          worst = std::max(worst, slid[side]);
        } else {
          slid[side] = 0.0f;
        }
        before[side] = foot;
      }
    }
    EXPECT_EQ(stage_.tasks().report(*task).state, TaskReport::State::kDone);
  }
  EXPECT_LT(worst, 0.005f);
}

}  // namespace
}  // namespace lararium::stage
