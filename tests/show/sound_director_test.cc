#include "shared/show/sound_director.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <spdlog/sinks/ostream_sink.h>

#include <glm/geometric.hpp>
#include <sstream>

#include "shared/geometry/glm_convert.h"
#include "shared/show/show.h"
#include "tests/audio/test_sounds.h"
#include "tests/show/small_show.h"
#include "tests/stage/test_props.h"

namespace lararium::show {
namespace {

using audio::Bus;
using audio::Voice;

stage::Prop WithUse(stage::Prop prop, const char* use) {
  prop.use = use;
  return prop;
}

// A chest that rattles while being opened and hums while open.
constexpr const char* kChest = R"({"schema": 1, "states": ["shut", "open"],
  "places": {"front": {"at": [0, -0.6], "heading": 180}},
  "sounds": [{"name": "hum", "states": ["open"], "at": [0, 0.5, 0], "gain_db": -6}],
  "actions": {"open": {"from": ["shut"], "to": "open", "duration": 1,
                       "sound": {"name": "rattle", "begin": 0.25, "end": 0.75, "loop": true}}}})";

class Director : public testing::Test {
 protected:
  Director() : log_("test", std::make_shared<spdlog::sinks::ostream_sink_mt>(text_)) {
    content_ = test::SmallContent();
    content_.sounds = {test::Sound("rattle", test::Encode(test::Noise(0.5), 1)),
                       test::Sound("hum", test::Encode(test::Noise(2.0), 1)),
                       test::Sound("street", test::Encode(test::Noise(1.0), 1))};
    content_.objects = {{"chest", test::Model(WithUse(test::MakeChest(), kChest)), {{2, 0, 0}}}};
    content_.places[0].stage.acoustics.reverb = stage::Reverb::kStoneRoom;
    content_.places[0].stage.acoustics.ambience = {{"street", -20.0f, std::nullopt},
                                                   {"hum", 0.0f, glm::vec3(3, 1, 0)}};
  }

  SoundDirector Make() {
    auto director = SoundDirector::Create(content_, log_);
    EXPECT_TRUE(director.ok()) << director.message();
    return std::move(*director);
  }

  std::ostringstream text_;
  Log log_;
  ShowContent content_;
};

const Voice* Find(const audio::SoundScene& scene, int clip, bool head_locked = false) {
  for (const Voice& voice : scene.voices) {
    if (voice.clip == clip && voice.head_locked == head_locked) {
      return &voice;
    }
  }
  return nullptr;
}

TEST_F(Director, APlaceIsHeardAsItIs) {
  SoundDirector director = Make();
  audio::SoundScene scene;
  director.Begin(4.0, 0, std::nullopt, scene);
  EXPECT_EQ(scene.reverb, stage::Reverb::kStoneRoom);
  const Voice* street = Find(scene, director.library()->Find("street"), true);
  const Voice* hum = Find(scene, director.library()->Find("hum"));
  ASSERT_TRUE(street != nullptr && hum != nullptr);
  EXPECT_EQ(street->bus, Bus::kAmbience);
  EXPECT_TRUE(street->loops);
  EXPECT_NEAR(street->gain, 0.1f, 1e-5f);
  EXPECT_EQ(hum->position, glm::vec3(3, 1, 0));
  director.Begin(4.0, 1, std::nullopt, scene);
  EXPECT_TRUE(scene.voices.empty());
  EXPECT_EQ(scene.reverb, stage::Reverb::kNone);
}

TEST_F(Director, TheEarsAreAtTheCameraAndStayWithoutAPose) {
  SoundDirector director = Make();
  audio::SoundScene scene;
  // Three metres behind the origin, looking at it; camera axes.
  const geometry::Rigid3 pose{Eigen::Quaterniond(0.0, 1.0, 0.0, 0.0), {0.0, 1.5, 3.0}};
  director.Begin(0.0, 0, pose, scene);
  EXPECT_LT(glm::distance(scene.listener.position, geometry::ToGlm(pose.Center())), 1e-5f);
  EXPECT_LT(glm::distance(scene.listener.forward, glm::vec3(0, 0, -1)), 1e-5f);
  EXPECT_LT(glm::distance(scene.listener.up, glm::vec3(0, 1, 0)), 1e-5f);
  const glm::vec3 before = scene.listener.position;
  director.Begin(0.0, 0, std::nullopt, scene);
  EXPECT_EQ(scene.listener.position, before);
}

TEST_F(Director, WhatIsDoneWithAThingIsHeardWhileItIsDone) {
  SoundDirector director = Make();
  const int rattle = director.library()->Find("rattle");
  stage::ObjectState state;
  const stage::Pose pose{{2, 0, 0}};
  for (const float action_time : {0.0f, 0.5f, 0.9f}) {
    state.action = 0;
    state.action_time = action_time;
    audio::SoundScene scene;
    director.Begin(10.0, 1, std::nullopt, scene);
    director.AddObject(0, state, pose, 10.0, scene);
    const Voice* voice = Find(scene, rattle);
    ASSERT_EQ(voice != nullptr, action_time == 0.5f);
    if (voice != nullptr) {
      EXPECT_NEAR(voice->began, 10.0 - 0.25, 1e-6);
      EXPECT_TRUE(voice->loops);
      EXPECT_NEAR(voice->position.x, 2.0f, 0.5f);
    }
  }
}

TEST_F(Director, AThingSoundsInItsStates) {
  SoundDirector director = Make();
  const int hum = director.library()->Find("hum");
  stage::ObjectState state;
  for (const int open : {0, 1}) {
    state.state = open;
    audio::SoundScene scene;
    director.Begin(10.0, 1, std::nullopt, scene);
    director.AddObject(0, state, stage::Pose{{2, 0, 0}}, 10.0, scene);
    const Voice* voice = Find(scene, hum);
    ASSERT_EQ(voice != nullptr, open == 1);
    if (voice != nullptr) {
      EXPECT_EQ(voice->position, glm::vec3(2.0f, 0.5f, 0.0f));
      EXPECT_LE(voice->began, 0.0);
    }
  }
}

TEST_F(Director, WallsHideAndCurtainsDoNot) {
  stage::Occluder wall;
  wall.mesh.positions = {{-9, -9, 1}, {9, -9, 1}, {9, 9, 1}, {-9, 9, 1}};
  wall.mesh.indices = {0, 1, 2, 0, 2, 3};
  for (const bool blocks : {true, false}) {
    wall.blocks_sound = blocks;
    content_.places[0].stage.occluders = {wall};
    SoundDirector director = Make();
    audio::SoundScene scene;
    director.Begin(0.0, 0, std::nullopt, scene);  // The listener is at z = 2.
    director.Finish(0, scene);
    EXPECT_EQ(Find(scene, director.library()->Find("hum"))->obstruction, blocks ? 1.0f : 0.0f);
    EXPECT_EQ(Find(scene, director.library()->Find("street"), true)->obstruction, 0.0f);
  }
}

TEST_F(Director, WhatIsNotThereIsSilentAndSaid) {
  content_.sounds.erase(content_.sounds.begin());  // rattle
  SoundDirector director = Make();
  EXPECT_THAT(text_.str(), testing::HasSubstr("object 'chest': there is no sound 'rattle'"));
  stage::ObjectState state;
  state.action = 0;
  state.action_time = 0.5f;
  audio::SoundScene scene;
  director.Begin(0.0, 1, std::nullopt, scene);
  director.AddObject(0, state, {}, 0.0, scene);
  EXPECT_TRUE(scene.voices.empty());
}

TEST_F(Director, DamagedSoundsAreAnError) {
  content_.sounds.push_back(test::Sound("broken", {}));
  EXPECT_THAT(SoundDirector::Create(content_, log_).message(), testing::HasSubstr("broken: "));
}

TEST_F(Director, AShowSaysWhatItsDramaPlays) {
  content_.drama = R"(
    function main()
      actor("one"):place{ x = 1, z = 0 }
      wait(0.5)
      sound("street"):play{ on = actor("one") }
    end)";
  const auto show = Show::Create(content_, {}, log_);
  ASSERT_TRUE(show.ok()) << show.message();
  test::FakePoses poses;
  test::FakeSource source(100);
  StagedFrame staged;
  for (const double time : {0.4, 0.7, 0.2, 0.7}) {  // Forward, back and forward again.
    (*show)->StageFrame(poses.Track(**source.Next()), time, staged);
    const Voice* voice = Find(staged.sound, (*show)->sounds()->Find("street"));
    ASSERT_EQ(voice != nullptr, time == 0.7) << time;
    if (voice != nullptr) {
      EXPECT_NEAR(voice->began, 0.5, 1e-9);
      EXPECT_NEAR(voice->position.x, 1.0f, 0.2f);
    }
    EXPECT_EQ(staged.sound.time, time);
  }
}

}  // namespace
}  // namespace lararium::show
