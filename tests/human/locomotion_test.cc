#include "shared/human/locomotion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <vector>

#include "shared/human/gait.h"
#include "shared/human/performance.h"
#include "shared/human/turns.h"
#include "tests/human/full_body.h"

namespace lararium::human {
namespace {

constexpr float kTick = 1.0f / 120.0f;

// A person who goes where a test says, a tick at a time, and what they look like.
class Walk {
 public:
  explicit Walk(const Human& human)
      : model_(MakePerformanceModel(std::make_shared<Human>(human))), performer_(model_) {
    performance_.seed = 7;
    Step(0.0f, 0.0f);
  }

  // Goes on for a tick: forward and turn in m/s and rad/s.
  void Step(float speed, float turn_rate) {
    previous_ = performance_;
    heading_ += turn_rate * kTick;
    position_ += speed * kTick * (TurnY(heading_) * glm::vec3(0.0f, 0.0f, -1.0f));
    UpdatePerformance(*model_, position_, heading_, kTick, floor_, performance_);
  }

  // As drawn between the last two ticks.
  void Draw(float alpha) {
    shown_ = Interpolate(previous_, performance_, alpha);
    performer_.Pose(shown_);
  }

  glm::vec3 Stage(const glm::vec3& actor) const {
    const Locomotion& at = shown_.locomotion;
    return at.position + TurnY(at.heading) * actor;
  }
  glm::vec3 InActor(JointIndex joint) const {
    return glm::vec3(performer_.actor_from_joint()[static_cast<size_t>(joint)][3]);
  }
  glm::vec3 InStage(JointIndex joint) const { return Stage(InActor(joint)); }

  const Body& body() const { return model_->locomotion.body; }
  const PerformanceModel& model() const { return *model_; }
  const Performance& shown() const { return shown_; }
  Performance& performance() { return performance_; }
  const Performer& performer() const { return performer_; }
  FloorHeight& floor() { return floor_; }
  float walked() const { return glm::length(position_); }
  glm::vec3 position() const { return position_; }

 private:
  std::shared_ptr<const PerformanceModel> model_;
  Performer performer_;
  Performance performance_, previous_, shown_;
  FloorHeight floor_;
  glm::vec3 position_ = glm::vec3(0.0f);
  float heading_ = 0.0f;
};

// Records by how much each planted foot moves from landing to leaving: the joint at its
// ball while the toes are down, the ankle while the sole is flat.
class SlideMeter {
 public:
  void Look(const Walk& walk) {
    for (int side = 0; side < 2; ++side) {
      const auto s = static_cast<size_t>(side);
      const Locomotion::Foot& foot = walk.shown().locomotion.feet[s];
      const Body::Leg& leg = walk.body().legs[s];
      if (!foot.planted) {
        ball_[s].Lift(slides_);
        ankle_[s].Lift(slides_);
        continue;
      }
      if (foot.pitch <= 0.0f) {
        ball_[s].Touch(walk.InStage(leg.toes[0]));
      }
      if (std::abs(foot.pitch) < 1e-6f) {
        ankle_[s].Touch(walk.InStage(leg.ankle));
      }
    }
  }

  size_t steps() const { return slides_.size() / 2; }
  float worst() const {
    return slides_.empty() ? 0.0f : *std::max_element(slides_.begin(), slides_.end());
  }

 private:
  class Contact {
   public:
    void Touch(const glm::vec3& at) {
      if (!touches_) {
        first_ = at;
        touches_ = true;
      }
      slide_ = std::max(slide_, glm::distance(at, first_));
    }
    void Lift(std::vector<float>& slides) {
      if (touches_) {
        slides.push_back(slide_);
      }
      touches_ = false;
      slide_ = 0.0f;
    }

   private:
    bool touches_ = false;
    glm::vec3 first_;
    float slide_ = 0.0f;
  };
  std::array<Contact, 2> ball_, ankle_;
  std::vector<float> slides_;
};

// Twenty metres with curves to both sides, a turn on the spot and all speeds.
template <typename Each>
void WalkTwentyMetres(Walk& walk, const Each& each) {
  struct Leg {
    float seconds, speed, turn_rate;
  };
  constexpr Leg kLegs[] = {{1.0f, 0.0f, 0.0f},  {3.0f, 1.3f, 0.0f},  {1.5f, 1.0f, 1.0f},
                           {2.0f, 1.5f, 0.0f},  {2.5f, 0.7f, -1.2f}, {1.5f, 0.0f, 2.0f},
                           {1.0f, 0.0f, 0.0f},  {3.0f, 0.3f, 0.3f},  {2.0f, 2.0f, 0.0f},
                           {2.0f, 1.2f, -0.8f}, {3.0f, 1.0f, 0.4f},  {1.5f, 0.0f, 0.0f}};
  float speed = 0.0f, turn_rate = 0.0f;
  for (const Leg& leg : kLegs) {
    for (float time = 0.0f; time < leg.seconds; time += kTick) {
      speed += std::clamp(leg.speed - speed, -2.5f * kTick, 2.5f * kTick);
      turn_rate += std::clamp(leg.turn_rate - turn_rate, -8.0f * kTick, 8.0f * kTick);
      walk.Step(speed, turn_rate);
      each();
    }
  }
}

TEST(Locomotion, PlantedFeetDoNotSlideOverTwentyMetresWithTurns) {
  for (const uint64_t axes : {0u, 3u}) {
    Walk walk(FullBody(0.6f, axes));
    SlideMeter meter;
    int tick = 0;
    WalkTwentyMetres(walk, [&] {
      walk.Draw(0.25f * static_cast<float>(++tick % 4));
      meter.Look(walk);
    });
    EXPECT_GT(meter.steps(), 25u);
    EXPECT_LT(meter.worst(), 0.005f);
    RecordProperty("worst_slide_micrometres", static_cast<int>(1e6f * meter.worst()));
  }
}

}  // namespace
}  // namespace lararium::human
