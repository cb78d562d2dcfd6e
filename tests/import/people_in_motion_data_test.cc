// Measures the body motion of the presets as drawn: sliding feet, hands away from their grips,
// eyes away from their targets, hips away from their seats. Prints one table. Skipped if the
// cast library has not been fetched.

#include <gtest/gtest.h>

#include <cstdio>
#include <glm/geometric.hpp>

#include "editor/import/cast/cast_builder.h"
#include "editor/import/cast/cast_presets.h"
#include "editor/import/objects/object_import.h"
#include "editor/import/objects/object_library.h"
#include "shared/human/animator.h"
#include "shared/human/turns.h"
#include "shared/stage/stage.h"
#include "tests/support/test_files.h"

namespace lararium::import {
namespace {

using stage::Pose;
using stage::TaskReport;

// Without clothes, because they move no joints.
std::shared_ptr<const human::Human> Preset(const std::string& name) {
  static const auto library = CastLibrary::Open(test::CastLibraryDir());
  if (!library.ok()) {
    return nullptr;
  }
  CastRecipe recipe = *LoadCastPreset(name);
  recipe.garments.clear();
  auto human = BuildCast(*library, recipe, NoProgress());
  EXPECT_TRUE(human.ok()) << human.status().message();
  return human.ok() ? std::make_shared<const human::Human>(*std::move(human)) : nullptr;
}

// One person on a stage with objects, measured tick by tick.
class Watched {
 public:
  explicit Watched(std::shared_ptr<const human::Human> human)
      : actor_(*stage_.Add("somebody", human)), animator_(stage_.Find(actor_)->model) {
    stage_.Place(actor_, {0.0f, 0.0f, 0.0f}, 0.0f);
    stage_.Show(actor_, true);
  }

  stage::ObjectId Add(const char* model, glm::vec3 at, const char* name = nullptr) {
    std::vector<std::string> notes;
    auto object =
        stage::ObjectModel::Create(*ImportObject(*FindLibraryObject(model), notes), model);
    EXPECT_TRUE(object.ok());
    return *stage_.AddObject(name == nullptr ? model : name, *object, {at});
  }
  const stage::Object& Find(stage::ObjectId id) const { return *stage_.Find(id); }
  stage::Tasks& tasks() { return stage_.tasks(); }
  stage::ActorId actor() const { return actor_; }
  const stage::ActorState& State() { return stage_.Find(actor_)->state; }
  const human::SittingModel& sitting() const { return animator_.model().sitting; }

  void Tick() {
    stage_.Advance();
    stage_.Perform();
    animator_.Pose(State().animation_state);
    WatchHands();
    WatchFeet();
  }
  void Finish(const Result<stage::TaskId>& task) {
    ASSERT_TRUE(task.ok()) << task.message();
    for (int tick = 0; tick < 90 * 120 && !tasks().report(*task).over(); ++tick) {
      Tick();
    }
    EXPECT_EQ(tasks().report(*task).state, TaskReport::State::kDone)
        << tasks().report(*task).message;
  }
  // The largest values since the last call, millimetres.
  float Missed() { return 1e3f * std::exchange(missed_, 0.0f); }
  int held() const { return held_; }
  float Slid() { return 1e3f * std::exchange(slid_, 0.0f); }

  glm::vec3 Hips() const {
    return 0.5f *
           (At(sitting().body.legs[0].hip).position + At(sitting().body.legs[1].hip).position);
  }
  // Error of the worse eye, degrees.
  float GazeError(const glm::vec3& target) {
    const human::BodyRig& body = sitting().body;
    const glm::vec3 at = human::TurnY(-State().heading) * (target - State().position);
    float worst = 0.0f;
    for (const human::JointIndex eye : body.eyes) {
      const human::JointFrame frame = At(eye);
      const glm::vec3 line_of_sight = frame.rotation *
                                      glm::conjugate(body.rest[static_cast<size_t>(eye)].rotation) *
                                      glm::vec3(0.0f, 0.0f, -1.0f);
      const float cosine = glm::dot(line_of_sight, glm::normalize(at - frame.position));
      worst = std::max(worst, std::acos(std::clamp(cosine, -1.0f, 1.0f)));
    }
    return worst * 180.0f / kPiF;
  }
  void LookAt(const glm::vec3& point) {
    stage::Attention::Choice choice;
    choice.target = stage::Attention::Target::kPoint;
    choice.point = point;
    stage_.Find(actor_)->attention.told = choice;
  }

 private:
  human::JointFrame At(human::JointIndex joint) const {
    return human::ActorFromJoint(animator_.human().skeleton, animator_.pose(), joint);
  }
  // Measures hands that have reached their grips.
  void WatchHands() {
    for (const int side : {human::kRight, human::kLeft}) {
      const human::ReachGoal goal =
          human::Goal(State().animation_state.reaches[static_cast<size_t>(side)]);
      if (goal.weight >= 1.0f) {
        const human::GripFrame palm = human::ActorFromPalm(
            animator_.model().reach, animator_.human().skeleton, animator_.pose(), side);
        ++held_;
        missed_ = std::max(missed_, glm::distance(palm.position, goal.actor_from_grip.position));
      }
    }
  }
  // Measures the movement of a flat foot from where it was planted.
  void WatchFeet() {
    for (size_t side = 0; side < 2; ++side) {
      const human::Locomotion::Foot& foot = State().animation_state.locomotion.feet[side];
      const bool hangs = State().animation_state.sitting.amount > 0.0f && feet_hang;
      const bool flat = foot.planted && std::abs(foot.pitch) < 1e-4f && !hangs;
      const glm::vec3 ankle =
          StageFromActorPose(State()) * At(sitting().body.legs[side].ankle).position;
      if (flat && stands_[side]) {
        slid_ = std::max(slid_, glm::distance(ankle, stood_[side]));
      } else {
        stood_[side] = ankle;
      }
      stands_[side] = flat;
    }
  }

  stage::Stage stage_;
  stage::ActorId actor_;
  human::Animator animator_;
  float missed_ = 0.0f, slid_ = 0.0f;
  int held_ = 0;
  std::array<bool, 2> stands_ = {false, false};
  std::array<glm::vec3, 2> stood_ = {};

 public:
  bool feet_hang = false;  // The person is too small for the seat.
};

class PeopleInMotion : public testing::TestWithParam<std::string> {};

TEST_P(PeopleInMotion, KeepTheirFeetHandsEyesAndSeats) {
  const auto human = Preset(GetParam());
  if (human == nullptr) {
    GTEST_SKIP() << "needs the cast library: run scripts/fetch_cast_library.sh";
  }
  std::printf("%-10s", GetParam().c_str());
  const auto report = [](const char* what, float value, const char* unit) {
    std::printf(" | %s %.2f %s", what, static_cast<double>(value), unit);
  };
  {
    Watched one(human);
    for (const glm::vec2 goal : {glm::vec2(0, -5), glm::vec2(4, -3), glm::vec2(-3, -1),
                                 glm::vec2(-2, 3), glm::vec2(2, 3)}) {  // A path of 23 m.
      one.Finish(one.tasks().Walk(one.actor(), goal, {}, 0.0f));
    }
    const float slid = one.Slid();
    report("slide", slid, "mm");
    EXPECT_LT(slid, 5.0f);
  }
  for (const char* model : {"chest", "mortar", "door"}) {
    Watched one(human);
    const auto object =
        one.Add(model, {0.0f, model == std::string("mortar") ? 0.75f : 0.0f, -2.0f});
    for (int round = 0; round < 2; ++round) {
      for (const stage::ObjectAction& action : one.Find(object).use().actions) {
        if (action.from >> one.Find(object).state.state & 1u) {
          one.Finish(one.tasks().Use(one.actor(), object, action.name, 0.0f));
        }
      }
    }
    EXPECT_GT(one.held(), 30) << "ticks in which a hand was at its grip";
    const float missed = one.Missed();
    report(model, missed, "mm");
    EXPECT_LT(missed, 5.0f) << model;
  }
  for (const char* model : {"basket", "plate", "cup"}) {
    Watched one(human);
    const auto object = one.Add(model, {0.0f, 0.0f, -2.0f});
    one.Finish(one.tasks().Take(one.actor(), object));
    one.Finish(one.tasks().Put(one.actor(), object, {{}, -1, {1.0f, -1.0f}, {}}));
    const float missed = one.Missed();
    report((std::string(model) + " off and on the floor").c_str(), missed, "mm");
    EXPECT_LT(missed, 5.0f) << model;
  }
  {
    Watched one(human);
    float worst = 0.0f;
    for (const glm::vec3& point : {glm::vec3(1, 1.5f, -2), glm::vec3(-2, 0.9f, -2),
                                   glm::vec3(0, 1.9f, -3), glm::vec3(2, 1.2f, -0.7f)}) {
      one.LookAt(point);
      for (int tick = 0; tick < 300; ++tick) {
        one.Tick();
        worst = tick > 200 ? std::max(worst, one.GazeError(point)) : worst;
      }
    }
    report("gaze", worst, "degrees");
    EXPECT_LT(worst, 2.0f);
  }
  {
    Watched one(human);
    const auto stool = one.Add("stool", {0.0f, 0.0f, -2.0f});
    const float leg = one.sitting().body.leg_length();
    one.feet_hang = leg < 0.7f;
    one.Finish(one.tasks().Use(one.actor(), stool, "sit", 0.0f));
    const float off = 1e3f * std::abs(one.Hips().y - 0.46f - one.sitting().seat_to_hips);
    one.Finish(one.tasks().Stand(one.actor()));
    const float slid = one.Slid();
    report("hips off the stool", off, "mm");
    report("slide there", slid, "mm");
    EXPECT_LT(off, 10.0f);
    EXPECT_LT(slid, 5.0f);
  }
  std::printf("\n");
}

INSTANTIATE_TEST_SUITE_P(Presets,
                         PeopleInMotion,
                         testing::ValuesIn(CastPresetNames()),
                         [](const auto& info) { return info.param; });

}  // namespace
}  // namespace lararium::import
