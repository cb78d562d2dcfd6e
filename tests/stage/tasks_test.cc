#include "shared/stage/tasks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <glm/geometric.hpp>
#include <numbers>
#include <set>

#include "shared/core/random.h"
#include "shared/stage/stage.h"
#include "tests/stage/test_human.h"
#include "tests/stage/test_props.h"

namespace lararium::stage {
namespace {

using ::testing::HasSubstr;
using State = TaskReport::State;

class TasksTest : public ::testing::Test {
 protected:
  TasksTest() {
    NavigationOptions floor;
    floor.floor = {{-5, -5}, {5, -5}, {5, 5}, {-5, 5}};
    EXPECT_TRUE(stage_.SetFloor(floor, {}).ok());
  }

  ActorId AddActor(const std::string& name, float x, float z) {
    const ActorId id = *stage_.Add(name, human_);
    stage_.Place(id, {x, 0.0f, z}, 0.0f);
    stage_.Show(id, true);
    return id;
  }
  ObjectId AddObject(const std::string& name, stage::Prop prop, float x, float z, float y = 0.0f) {
    return *stage_.AddObject(name, test::Model(std::move(prop)), {{x, y, z}});
  }

  void Tick() {
    stage_.Advance();
    stage_.Perform();
  }
  void Play(float seconds) {
    for (int i = 0; i < static_cast<int>(seconds * 120.0f); ++i) {
      Tick();
    }
  }
  // Ticks until the task is over or `seconds` have passed.
  TaskReport Finish(const Result<TaskId>& task, float seconds = 60.0f) {
    EXPECT_TRUE(task.ok()) << task.message();
    for (int i = 0; i < static_cast<int>(seconds * 120.0f); ++i) {
      if (stage_.tasks().report(*task).over()) {
        break;
      }
      Tick();
    }
    return stage_.tasks().report(*task);
  }

  const Actor& At(ActorId id) { return *stage_.Find(id); }
  const Object& At(ObjectId id) { return *stage_.Find(id); }

  std::shared_ptr<const human::Human> human_ = test::MakeTestHuman();
  Stage stage_;
};

TEST_F(TasksTest, AWalkGoesThroughWhatDoesNotBlockWalking) {
  NavigationOptions floor;
  floor.floor = {{-5, -5}, {5, -5}, {5, 5}, {-5, 5}};
  stage::Place place;
  Occluder& curtain = place.occluders.emplace_back();
  curtain.name = "curtain";
  const stage::PropMesh box = test::MakeBox({-6.0f, 0.0f, -0.1f}, {6.0f, 2.5f, 0.1f});
  curtain.mesh.positions = box.positions;
  curtain.mesh.indices = box.indices;
  const ActorId keeper = AddActor("keeper", 0, 2);
  for (const bool blocks : {true, false}) {
    curtain.blocks_walking = blocks;
    // The actor may stand at any of the places.
    ASSERT_TRUE(stage_.SetFloor(floor, std::array{stage::Place(), place}).ok());
    stage_.Place(keeper, {0.0f, 0.0f, 2.0f}, 0.0f);
    const TaskReport walk = Finish(stage_.tasks().Walk(keeper, {0.0f, -2.0f}, {}, 0.0f));
    if (blocks) {
      EXPECT_THAT(std::string(walk.message), HasSubstr("cannot get there"));
      EXPECT_GT(At(keeper).state.position.z, 0.3f) << "before it";
    } else {
      EXPECT_TRUE(walk.message.empty()) << walk.message;
      EXPECT_NEAR(At(keeper).state.position.z, -2.0f, 0.01f) << "beyond it";
    }
  }
}

// A gate leaf that is hinged at the origin and opens towards +z.
stage::Prop MakeGate() {
  stage::Prop gate;
  gate.name = "gate";
  gate.parts.resize(1);
  gate.parts[0].name = "leaf";
  gate.parts[0].meshes = {test::MakeBox({0.0f, 0.0f, -0.03f}, {1.0f, 1.8f, 0.03f})};
  gate.use = R"({
    "schema": 1,
    "states": ["shut", "open"],
    "parts": {"leaf": {"hinge": [0, 1, 0], "limits": [-100, 0]}},
    "places": {"front": {"at": [0.2, -0.7], "heading": 180}},
    "actions": {"open": {"to": "open", "duration": 2, "moves": [{"part": "leaf", "to": -90}]}},
    "footprint": {"outline": []}})";
  return gate;
}

// Distance from a point to a leaf that has begun to open, metres.
float ToLeaf(float angle, glm::vec2 place) {
  const glm::vec2 along(std::cos(angle), -std::sin(angle));
  const float on = std::clamp(glm::dot(place, along), 0.0f, 1.0f);
  return angle < 0.0f ? glm::distance(place, on * along) : 9.0f;
}

TEST_F(TasksTest, ALeafWaitsForWhoStandsWhereItSwings) {
  const ObjectId leaf = AddObject("gate", MakeGate(), 0, 0);
  const ActorId porter = AddActor("porter", 0.2f, -2);
  const ActorId guest = AddActor("guest", 0.5f, 0.5f);
  const Result<TaskId> task = stage_.tasks().Use(porter, leaf, "open", 0.0f);
  float hit = 9.0f;
  while (!stage_.tasks().report(*task).over()) {
    Tick();
    hit = std::min(hit, ToLeaf(At(leaf).state.joints[0], At(guest).place()));
  }
  EXPECT_EQ(stage_.tasks().report(*task).state, State::kDone);
  EXPECT_LT(At(leaf).state.joints[0], -1.5f) << "it opened";
  EXPECT_GT(hit, 0.2f) << "and hit nobody";
  EXPECT_GT(glm::distance(At(guest).place(), glm::vec2(0.5f, 0.5f)), 0.3f) << "who stepped aside";
}

TEST_F(TasksTest, ALeafStopsForWhoWalksIntoItsSwing) {
  const ObjectId leaf = AddObject("gate", MakeGate(), 0, 0);
  const ActorId porter = AddActor("porter", 0.2f, -2);
  const ActorId guest = AddActor("guest", 0.6f, 1.9f);
  const Result<TaskId> task = stage_.tasks().Use(porter, leaf, "open", 0.0f);
  while (At(leaf).state.joints[0] == 0.0f) {
    Tick();
  }
  ASSERT_TRUE(
      stage_.tasks().Walk(guest, {0.5f, 0.95f}, {}, 0.0f).ok());  // Into the path of the leaf.
  float hit = 9.0f;
  int stood = 0;
  while (!stage_.tasks().report(*task).over()) {
    const float before = At(leaf).state.joints[0];
    Tick();
    const float angle = At(leaf).state.joints[0];
    stood += At(leaf).state.action >= 0 && angle == before && angle > -1.5f;
    hit = std::min(hit, ToLeaf(angle, At(guest).place()));
  }
  EXPECT_EQ(stage_.tasks().report(*task).state, State::kDone);
  EXPECT_LT(At(leaf).state.joints[0], -1.5f) << "it opened";
  EXPECT_GT(stood, 30) << "ticks in which it stood still";
  EXPECT_GT(hit, 0.15f);
}

TEST_F(TasksTest, TwoHandsOnOneGripKeepApart) {
  stage::Prop jar = test::MakeCup();
  jar.use = R"({
    "schema": 1,
    "grips": {"neck": {"at": [0.045, 0.05, 0], "palm": [-1, 0, 0], "fingers": [0, 0, -1]}},
    "carry": {"hands": {"right": "neck"}, "at": [0.2, 1.0, -0.35]}})";
  const ObjectId cup = AddObject("cup", std::move(jar), 0, 0);
  const ActorId giver = AddActor("giver", 0.5f, 0.5f);
  const ActorId receiver = AddActor("receiver", 2, 2);
  ASSERT_EQ(Finish(stage_.tasks().Take(giver, cup)).state, State::kDone);
  const Result<TaskId> task = stage_.tasks().Give(giver, cup, receiver);
  float nearest = 9.0f;
  const auto palm = [&](ActorId id, int side) {
    const human::ReachGoal goal = human::Goal(At(id).state.animation_state.reaches[side]);
    return StageFromActorPose(At(id).state) * goal.actor_from_grip.position;
  };
  while (!stage_.tasks().report(*task).over()) {
    Tick();
    for (const int side : {human::kRight, human::kLeft}) {
      const auto weight = [&](ActorId id, int s) {
        return human::Goal(At(id).state.animation_state.reaches[static_cast<size_t>(s)]).weight;
      };
      if (weight(giver, human::kRight) > 0.9f && weight(receiver, side) > 0.9f) {
        nearest = std::min(nearest, glm::distance(palm(giver, 0), palm(receiver, side)));
      }
    }
  }
  EXPECT_EQ(At(cup).state.holder, receiver);
  EXPECT_GT(nearest, 0.08f) << "a hand's height";
  EXPECT_LT(nearest, 0.2f);
}

TEST_F(TasksTest, AnActionWalksThereMovesThePartsAndChangesTheState) {
  const ActorId keeper = AddActor("keeper", 2, -3);
  const ObjectId chest = AddObject("chest", test::MakeChest(), 0, 0);
  const Result<TaskId> task = stage_.tasks().Use(keeper, chest, "open", 0.0f);
  ASSERT_TRUE(task.ok());
  bool acted = false;
  float highest = 0.0f;
  while (!stage_.tasks().report(*task).over()) {
    Tick();
    const ObjectState& state = At(chest).state;
    if (state.action == 0 && !acted) {
      acted = true;
      EXPECT_LT(glm::distance(At(keeper).place(), glm::vec2(0.0f, -0.6f)), 1e-3f);
      EXPECT_NEAR(std::abs(TurnBetween(At(keeper).state.heading, std::numbers::pi_v<float>)), 0.0f,
                  1e-3f);
    }
    if (acted && state.action == 0) {
      // The hand follows the lid's edge.
      const auto& reach = At(keeper).state.animation_state.reaches[human::kRight];
      const Pose grip = state.stage_from_object * ObjectFromGrip(*At(chest).model, state.joints, 0);
      const Pose hand =
          StageFromActorPose(At(keeper).state) * Pose{reach.to.position, reach.to.rotation};
      EXPECT_LT(glm::distance(grip.position, hand.position), 1e-4f);
      highest = std::max(highest, hand.position.y);
    }
  }
  EXPECT_TRUE(acted);
  EXPECT_EQ(stage_.tasks().report(*task).state, State::kDone);
  EXPECT_EQ(At(chest).state.state, 1);
  EXPECT_FLOAT_EQ(At(chest).state.joints[0], std::numbers::pi_v<float> / 2.0f);
  EXPECT_NEAR(highest, 0.7f + 0.4f, 0.05f) << "the lid stands upright";
  EXPECT_EQ(At(chest).state.action, -1);
  Play(1.0f);
  EXPECT_EQ(At(keeper).state.animation_state.reaches[human::kRight].to_weight, 0.0f);
}

TEST_F(TasksTest, WhatIsNotPossibleInAStateFailsAndSaysWhy) {
  const ActorId keeper = AddActor("keeper", 2, -3);
  const ObjectId chest = AddObject("chest", test::MakeChest(), 0, 0);
  const TaskReport report = Finish(stage_.tasks().Use(keeper, chest, "shut", 0.0f));
  EXPECT_EQ(report.state, State::kFailed);
  EXPECT_THAT(std::string(report.message),
              HasSubstr("'keeper' cannot 'shut' 'chest': it is 'shut'"));
  const auto unknown = stage_.tasks().Use(keeper, chest, "paint", 0.0f);
  ASSERT_FALSE(unknown.ok());
  EXPECT_THAT(unknown.message(), HasSubstr("it has open, shut"));
}

TEST_F(TasksTest, TakenObjectsAreCarriedAndPutDownOnASpot) {
  const ActorId keeper = AddActor("keeper", 2, -3);
  const ObjectId table = AddObject("table", test::MakeTable(), 0, 0);
  const ObjectId cup = AddObject("cup", test::MakeCup(), 0, 0);
  ASSERT_TRUE(stage_.PlaceOn(cup, {table, 0, 1, 0.0f}).ok());
  EXPECT_NEAR(At(cup).state.stage_from_object.position.x, 0.25f, 1e-6f);

  EXPECT_EQ(Finish(stage_.tasks().Take(keeper, cup)).state, State::kDone);
  EXPECT_EQ(At(cup).state.holder, keeper);
  EXPECT_FALSE(At(cup).state.support.object);
  EXPECT_EQ(At(cup).state.hand, human::kRight);
  EXPECT_EQ(At(cup).state.in_hand, 1.0f);
  EXPECT_LT(glm::distance(At(keeper).place(), glm::vec2(0.75f, 0.0f)), 1e-3f) << "the spot's place";

  EXPECT_EQ(Finish(stage_.tasks().Walk(keeper, {3, 3}, 1.0f, 0.0f)).state, State::kDone);
  const Pose carried =
      StageFromActorPose(At(keeper).state).Inverse() * At(cup).state.stage_from_object;
  const float scale = At(keeper).eye_height() / 1.58f;
  EXPECT_LT(glm::distance(carried.position, scale * glm::vec3(0.2f, 1.0f, -0.35f)), 1e-4f);

  PutTarget target;
  target.object = table;
  EXPECT_EQ(Finish(stage_.tasks().Put(keeper, cup, target)).state, State::kDone);
  EXPECT_FALSE(At(cup).state.holder);
  EXPECT_EQ(At(cup).state.support.object, table);
  EXPECT_NEAR(At(cup).state.stage_from_object.position.y, 0.75f, 1e-6f);
}

TEST_F(TasksTest, WhatStandsOnAFullTableCannotBePut) {
  const ActorId keeper = AddActor("keeper", 2, -3);
  const ObjectId table = AddObject("table", test::MakeTable(), 0, 0);
  std::array<ObjectId, 4> cups;
  for (int i = 0; i < 4; ++i) {
    cups[static_cast<size_t>(i)] = AddObject("cup" + std::to_string(i), test::MakeCup(), 2, 2);
  }
  for (int i = 0; i < 3; ++i) {
    ASSERT_TRUE(
        stage_.PlaceOn(cups[static_cast<size_t>(i)], {table, 0, static_cast<int8_t>(i), 0.0f})
            .ok());
  }
  EXPECT_FALSE(stage_.PlaceOn(cups[3], {table, 0, 0, 0.0f}).ok());
  EXPECT_EQ(Finish(stage_.tasks().Take(keeper, cups[3])).state, State::kDone);
  PutTarget target;
  target.object = table;
  const TaskReport report = Finish(stage_.tasks().Put(keeper, cups[3], target));
  EXPECT_EQ(report.state, State::kFailed);
  EXPECT_THAT(std::string(report.message), HasSubstr("there is no free spot on 'table'"));
  target = {};
  target.place = {1.0f, 3.0f};
  EXPECT_EQ(Finish(stage_.tasks().Put(keeper, cups[3], target)).state, State::kDone);
  EXPECT_LT(glm::distance(At(cups[3]).state.stage_from_object.position, glm::vec3(1, 0, 3)), 1e-5f);
}

TEST_F(TasksTest, WhoGivesMeetsTheOtherAndBothHoldItForAMoment) {
  const ActorId giver = AddActor("giver", -3, 0);
  const ActorId receiver = AddActor("receiver", 2, 1);
  const ObjectId cup = AddObject("cup", test::MakeCup(), -2.5f, 0.5f, 0.0f);
  ASSERT_EQ(Finish(stage_.tasks().Take(giver, cup)).state, State::kDone);
  const auto task = stage_.tasks().Give(giver, cup, receiver);
  ASSERT_TRUE(task.ok());
  int both = 0;
  while (!stage_.tasks().report(*task).over()) {
    Tick();
    const auto reaches = [&](ActorId id) {
      const auto& all = At(id).state.animation_state.reaches;
      return (all[0].to_weight > 0.0f && human::Progress(all[0]) >= 1.0f) ||
             (all[1].to_weight > 0.0f && human::Progress(all[1]) >= 1.0f);
    };
    both += reaches(giver) && reaches(receiver) ? 1 : 0;
  }
  EXPECT_EQ(stage_.tasks().report(*task).state, State::kDone)
      << stage_.tasks().report(*task).message;
  EXPECT_EQ(At(cup).state.holder, receiver);
  EXPECT_GT(both, 20) << "a third of a second";
  const float apart = glm::distance(At(giver).place(), At(receiver).place());
  EXPECT_GT(apart, 0.6f);
  EXPECT_LT(apart, 1.1f);
  // They face each other.
  const float facing = HeadingOf(At(giver).place() - At(receiver).place());
  EXPECT_LT(std::abs(TurnBetween(At(receiver).state.heading, facing)), 0.05f);
}

TEST_F(TasksTest, WhatAnotherHoldsIsNotTaken) {
  const ActorId a = AddActor("a", -2, 0);
  const ActorId b = AddActor("b", 2, 0);
  const ObjectId cup = AddObject("cup", test::MakeCup(), 0, 0);
  const auto first = stage_.tasks().Take(a, cup);
  const auto second = stage_.tasks().Take(b, cup);
  EXPECT_EQ(Finish(first).state, State::kDone);
  const TaskReport report = Finish(second);
  EXPECT_EQ(report.state, State::kFailed);
  EXPECT_THAT(std::string(report.message), HasSubstr("it is in the hands of 'a'"));
  EXPECT_EQ(At(cup).state.holder, a);
}

TEST_F(TasksTest, AHeldObjectGoesToTheMouthAndBack) {
  const ActorId guest = AddActor("guest", 0.6f, 0);
  const ObjectId cup = AddObject("cup", test::MakeCup(), 0, 0);
  stage_.SetState(cup, 1);
  ASSERT_EQ(Finish(stage_.tasks().Take(guest, cup)).state, State::kDone);
  const auto task = stage_.tasks().Use(guest, cup, "drink", 0.0f);
  float highest = 0.0f;
  while (!stage_.tasks().report(*task).over()) {
    Tick();
    highest = std::max(highest, At(cup).state.stage_from_object.position.y);
  }
  EXPECT_NEAR(highest, 1.4f * At(guest).eye_height() / 1.58f, 1e-3f);
  EXPECT_EQ(At(cup).state.state, 0);
  std::array<glm::mat4, 2> places;
  std::array<uint8_t, 2> shown;
  ComputeParts(*At(cup).model, At(cup).state, At(cup).state.stage_from_object, places, shown);
  EXPECT_EQ(shown[0], 1);
  EXPECT_EQ(shown[1], 0) << "the wine is drunk";
  const auto again = Finish(stage_.tasks().Use(guest, cup, "drink", 0.0f));
  EXPECT_EQ(again.state, State::kFailed);
}

TEST_F(TasksTest, WhoWaitsStandsInLineAndIsServedInTurn) {
  const ObjectId chest = AddObject("chest", test::MakeChest(), 0, 0);
  std::array<ActorId, 3> actors;
  std::array<TaskId, 3> tasks;
  for (int i = 0; i < 3; ++i) {
    actors[static_cast<size_t>(i)] =
        AddActor("a" + std::to_string(i), -3.0f + 1.5f * static_cast<float>(i), -3.5f);
  }
  for (int i = 0; i < 3; ++i) {
    const char* action = i == 1 ? "shut" : "open";
    tasks[static_cast<size_t>(i)] =
        *stage_.tasks().Use(actors[static_cast<size_t>(i)], chest, action, 6.0f);
  }
  std::vector<int> order;
  bool stood_in_line = false;
  for (int tick = 0; tick < 120 * 90 && order.size() < 3; ++tick) {
    Tick();
    for (int i = 0; i < 3; ++i) {
      const bool over = stage_.tasks().report(tasks[static_cast<size_t>(i)]).over();
      if (over && std::find(order.begin(), order.end(), i) == order.end()) {
        EXPECT_EQ(stage_.tasks().report(tasks[static_cast<size_t>(i)]).state, State::kDone)
            << stage_.tasks().report(tasks[static_cast<size_t>(i)]).message;
        order.push_back(i);
      }
    }
    // The last actor waits behind the second.
    stood_in_line =
        stood_in_line ||
        (order.empty() && glm::distance(At(actors[2]).place(), glm::vec2(0.0f, -2.3f)) < 0.4f);
  }
  EXPECT_EQ(order, (std::vector<int>{0, 1, 2}));
  EXPECT_TRUE(stood_in_line);
}

TEST_F(TasksTest, AsManyUseItAtOnceAsItHasRoomFor) {
  const ObjectId table = AddObject("table", test::MakeTable(), 0, 0);
  std::array<ActorId, 3> actors = {AddActor("a", -3, 0), AddActor("b", 3, 0), AddActor("c", 0, 3)};
  for (const ActorId id : actors) {
    ASSERT_TRUE(stage_.tasks().Use(id, table, "wipe", 10.0f).ok());
  }
  int most = 0;
  for (int tick = 0; tick < 120 * 40; ++tick) {
    Tick();
    int at_table = 0;
    for (const ActorId id : actors) {
      const glm::vec2 place = At(id).place();
      at_table += glm::length(place) < 0.76f ? 1 : 0;
    }
    most = std::max(most, at_table);
  }
  EXPECT_EQ(most, 2);
}

TEST_F(TasksTest, WhoStandsInTheWayStepsAside) {
  const ActorId keeper = AddActor("keeper", 3, -3);
  const ActorId idler = AddActor("idler", 0, -0.6f);
  const ObjectId chest = AddObject("chest", test::MakeChest(), 0, 0);
  EXPECT_EQ(Finish(stage_.tasks().Use(keeper, chest, "open", 0.0f)).state, State::kDone);
  EXPECT_GT(glm::distance(At(idler).place(), glm::vec2(0.0f, -0.6f)), 0.5f);
}

TEST_F(TasksTest, AStoppedTaskLetsGo) {
  const ActorId keeper = AddActor("keeper", 0, -2);
  const ObjectId chest = AddObject("chest", test::MakeChest(), 0, 0);
  const auto task = stage_.tasks().Use(keeper, chest, "open", 30.0f);
  ASSERT_TRUE(task.ok());
  Play(8.0f);
  ASSERT_EQ(At(chest).state.action, 0);
  stage_.tasks().Stop(*task);
  EXPECT_EQ(stage_.tasks().report(*task).state, State::kFailed);
  Play(1.0f);
  EXPECT_EQ(At(chest).state.action, -1);
  EXPECT_EQ(At(keeper).state.animation_state.reaches[human::kRight].to_weight, 0.0f);
  EXPECT_EQ(Finish(stage_.tasks().Walk(keeper, {2, 2}, {}, 0.0f)).state, State::kDone);
}

TEST_F(TasksTest, WhoseActorIsPlacedElsewhereFails) {
  const ActorId keeper = AddActor("keeper", 0, -2);
  const auto task = stage_.tasks().Walk(keeper, {3, 3}, {}, 0.0f);
  Play(1.0f);
  stage_.Place(keeper, {1, 0, 1}, 0.0f);
  Tick();
  const TaskReport report = stage_.tasks().report(*task);
  EXPECT_EQ(report.state, State::kFailed);
  EXPECT_THAT(std::string(report.message), HasSubstr("was placed elsewhere"));
  EXPECT_EQ(At(keeper).state.position, glm::vec3(1, 0, 1));
}

// Random requests of many actors for few objects: every task ends, no two actors hold the same
// object, and no hand holds two objects.
class DemandTest : public TasksTest, public ::testing::WithParamInterface<uint64_t> {
 protected:
  static constexpr int kActors = 7;
  static constexpr int kCups = 4;

  void SetUp() override {
    table_ = AddObject("table", test::MakeTable(), -2, 0);
    chest_ = AddObject("chest", test::MakeChest(), 2, 0);
    for (int i = 0; i < kCups; ++i) {
      cups_.push_back(AddObject("cup" + std::to_string(i), test::MakeCup(),
                                0.7f * static_cast<float>(i) - 1.0f, 3));
    }
    for (int i = 0; i < kActors; ++i) {
      actors_.push_back(AddActor("a" + std::to_string(i), static_cast<float>(i) - 3.0f, -3));
    }
  }

  uint32_t Below(size_t count) { return random_.Below(static_cast<uint32_t>(count)); }

  Result<TaskId> Demand(ActorId actor) {
    const ObjectId cup = cups_[Below(cups_.size())];
    PutTarget target;
    switch (random_.Below(8)) {
      case 0:
        return stage_.tasks().Walk(actor, {random_.Uniform(-4, 4), random_.Uniform(-4, 4)}, {}, 0);
      case 1:
        return stage_.tasks().Use(actor, table_, "wipe", 0.0f);
      case 2:
        return stage_.tasks().Use(actor, chest_, random_.Below(2) == 0 ? "open" : "shut", 0.0f);
      case 3:
      case 4:
        return stage_.tasks().Take(actor, cup);
      case 5:
        target.object = table_;
        return stage_.tasks().Put(actor, Held(actor).value_or(cup), target);
      case 6:
        target.place = {random_.Uniform(-4, 4), random_.Uniform(1.5, 4)};
        return stage_.tasks().Put(actor, Held(actor).value_or(cup), target);
      default: {
        const ActorId to = actors_[Below(actors_.size())];
        return to == actor ? stage_.tasks().Turn(actor, 1.0f, 0.0f)
                           : stage_.tasks().Give(actor, Held(actor).value_or(cup), to);
      }
    }
  }

  std::optional<ObjectId> Held(ActorId actor) {
    for (const ObjectId cup : cups_) {
      if (At(cup).state.holder == actor) {
        return cup;
      }
    }
    return std::nullopt;
  }

  void CheckHands() {
    std::set<std::pair<uint32_t, int>> hands;
    std::set<std::tuple<uint32_t, int, int>> spots;
    for (const ObjectId cup : cups_) {
      const ObjectState& state = At(cup).state;
      ASSERT_EQ(bool(state.holder), state.hands != kNoHands);
      ASSERT_FALSE(state.holder && state.support.object);
      for (int side = 0; side < 2; ++side) {
        if (state.hands[static_cast<size_t>(side)] >= 0) {
          ASSERT_TRUE(hands.insert({state.holder.index, side}).second) << "a hand holds two things";
        }
      }
      if (state.support.object) {
        ASSERT_TRUE(
            spots.insert({state.support.object.index, state.support.surface, state.support.spot})
                .second)
            << "two things stand on one spot";
      }
    }
  }

  Random random_ = Random(GetParam());
  ObjectId table_;
  ObjectId chest_;
  std::vector<ObjectId> cups_;
  std::vector<ActorId> actors_;
};

TEST_P(DemandTest, EverythingEndsAndNobodyHoldsWhatAnotherHolds) {
  constexpr int kSeconds = 240;
  constexpr float kLongest = 120.0f;  // Maximum seconds of one task.
  struct Open {
    TaskId id;
    float seconds = 0.0f;
  };
  std::vector<std::optional<Open>> open(actors_.size());
  int done = 0;
  int failed = 0;
  int gave = 0;
  for (int tick = 0; tick < kSeconds * 120; ++tick) {
    for (size_t i = 0; i < actors_.size(); ++i) {
      if (!open[i] && random_.Below(60) == 0) {
        const auto task = Demand(actors_[i]);
        ASSERT_TRUE(task.ok()) << task.message();
        open[i] = Open{*task};
      }
    }
    std::array<ActorId, kCups> holders;
    for (size_t i = 0; i < cups_.size(); ++i) {
      holders[i] = At(cups_[i]).state.holder;
    }
    Tick();
    for (size_t i = 0; i < cups_.size(); ++i) {
      const ActorId now = At(cups_[i]).state.holder;
      gave += holders[i] && now && holders[i] != now ? 1 : 0;
    }
    CheckHands();
    if (HasFatalFailure()) {
      return;
    }
    for (std::optional<Open>& task : open) {
      if (!task) {
        continue;
      }
      task->seconds += 1.0f / 120.0f;
      ASSERT_LT(task->seconds, kLongest) << "a task does not end: " << task->id;
      const TaskReport report = stage_.tasks().report(task->id);
      if (report.over()) {
        report.state == State::kDone ? ++done : ++failed;
        if (report.state == State::kFailed) {
          RecordProperty("why", std::string(report.message));
          EXPECT_THAT(std::string(report.message), ::testing::Not(HasSubstr("in the way")));
        }
        stage_.tasks().Forget(task->id);
        task.reset();
      }
    }
  }
  EXPECT_GT(done, 50);
  EXPECT_GT(gave, 0);
  RecordProperty("done", done);
  RecordProperty("failed", failed);
}

INSTANTIATE_TEST_SUITE_P(Seeds, DemandTest, ::testing::Values(1, 2, 3));

}  // namespace
}  // namespace lararium::stage
