// Host functions for sounds.

#include <gmock/gmock.h>

#include "tests/drama/drama_fixture.h"
#include "tests/stage/test_props.h"

namespace lararium::drama {
namespace {

using ::testing::HasSubstr;
using At = stage::StageSound::At;

class SoundWords : public DramaTest {
 protected:
  SoundWords() {
    EXPECT_TRUE(stage_.AddObject("chest", test::Model(test::MakeChest()), {}).ok());
    EXPECT_TRUE(stage_.sounds().Add("bell", 1.5).ok());
    EXPECT_TRUE(stage_.sounds().Add("flute", 20.0).ok());
  }
  std::span<const stage::StageSound> Playing() const { return stage_.sounds().playing(); }
};

TEST_F(SoundWords, PlayBeginsAtOnceAndDoesNotWait) {
  const auto drama = Make(R"(
    function main()
      wait(1)
      sound("bell"):play{ on = object("chest"), gain = -6 }
      sound("flute"):play{ at = { x = 1, z = -2 }, loop = true }
      sound("bell"):play{ on = actor("guest") }
      sound("bell"):play()
    end)");
  PlayTo(*drama, 0.9);
  EXPECT_TRUE(Playing().empty());
  PlayTo(*drama, 1.5);
  EXPECT_EQ(FirstError(*drama), "");
  ASSERT_EQ(Playing().size(), 4u);
  EXPECT_EQ(Playing()[0].at, At::kObject);
  EXPECT_EQ(Playing()[0].object, *stage_.FindObject("chest"));
  EXPECT_EQ(Playing()[0].gain_db, -6.0f);
  EXPECT_EQ(Playing()[0].ticks, 60);
  EXPECT_EQ(Playing()[1].point, glm::vec3(1.0f, 1.5f, -2.0f));
  EXPECT_TRUE(Playing()[1].loops);
  EXPECT_EQ(Playing()[2].actor, *stage_.Find("guest"));
  EXPECT_EQ(Playing()[3].at, At::kListener);
  // A sound that does not loop ends after its length.
  PlayTo(*drama, 2.6);
  EXPECT_EQ(Playing().size(), 1u);
  PlayTo(*drama, 30.0);
  EXPECT_EQ(Playing().size(), 1u);
}

TEST_F(SoundWords, ATrackPlaysSoundsForTheirLength) {
  const auto drama = Make(R"(
    track{ sounds = {
      { at = 1, sound = "flute", length = 2, object = "chest", gain = -6 },
      { at = 4, sound = "bell", from = { x = 1, y = 2, z = -2 } },
    } })");
  PlayTo(*drama, 0.9);
  EXPECT_TRUE(Playing().empty());
  PlayTo(*drama, 2.0);
  ASSERT_EQ(Playing().size(), 1u);
  EXPECT_EQ(Playing()[0].object, *stage_.FindObject("chest"));
  EXPECT_EQ(Playing()[0].gain_db, -6.0f);
  PlayTo(*drama, 3.5);
  EXPECT_TRUE(Playing().empty());
  PlayTo(*drama, 4.5);
  ASSERT_EQ(Playing().size(), 1u);
  EXPECT_EQ(Playing()[0].point, glm::vec3(1.0f, 2.0f, -2.0f));
  PlayTo(*drama, 6.0);
  EXPECT_TRUE(Playing().empty());
  EXPECT_EQ(FirstError(*drama), "");
}

TEST_F(SoundWords, StopEndsItWhereverItIsHeard) {
  const auto drama = Make(R"(
    function main()
      local flute = sound("flute")
      flute:play{ loop = true }
      flute:play{ on = actor("keeper") }
      sound("bell"):play()
      wait(0.5)
      flute:stop()
    end)");
  PlayTo(*drama, 0.4);
  EXPECT_EQ(Playing().size(), 3u);
  PlayTo(*drama, 0.6);
  ASSERT_EQ(Playing().size(), 1u);
  EXPECT_EQ(Playing()[0].sound, *stage_.sounds().Find("bell"));
}

TEST_F(SoundWords, SeekingIsPlayingThere) {
  const auto drama = Make(R"(
    function main()
      while true do
        sound("bell"):play{ on = actor("keeper") }
        wait(1.1)
      end
    end)");
  PlayTo(*drama, 4.6);
  const stage::StageSnapshot played = Snapshot();
  EXPECT_EQ(played.sounds.size(), 2u);
  PlayTo(*drama, 8.0);
  ASSERT_TRUE(drama->Seek(4.6).ok());
  EXPECT_EQ(Snapshot().sounds, played.sounds);
}

TEST_F(SoundWords, ErrorsSayWhatToDo) {
  const char* scripts[][2] = {
      {"sound('horn')", "there is no sound 'horn'; add audio/horn.wav"},
      {"sound(3)", "give the name"},
      {"sound('bell'):play{ gain = 90 }", "gain must be a number from -60 to 12"},
      {"sound('bell'):play{ on = 'keeper' }", "on must be an actor or an object"},
      {"sound('bell'):play{ at = 3 }", "at must be a point"},
      {"sound('bell'):play(3)", "give a table"},
  };
  for (const auto& [script, problem] : scripts) {
    const auto drama = Make(std::string("function main() ") + script + " end");
    EXPECT_THAT(FirstError(*drama), HasSubstr(problem)) << script;
    EXPECT_THAT(FirstError(*drama), HasSubstr("drama.lua:1")) << script;
  }
}

TEST_F(SoundWords, TooManyAtOnceAreAWarning) {
  const auto drama =
      Make("function main() for _ = 1, 100 do sound('flute'):play{ loop = true } end end");
  EXPECT_EQ(Playing().size(), stage::Sounds::kMaxPlaying);
  EXPECT_THAT(FirstError(*drama), HasSubstr("too many sounds"));
}

TEST_F(SoundWords, LengthIsInSeconds) {
  const auto drama = Make(
      "function main() wait(sound('bell'):length()) "
      "sound('flute'):play() end");
  PlayTo(*drama, 1.4);
  EXPECT_TRUE(Playing().empty());
  PlayTo(*drama, 1.6);
  EXPECT_EQ(Playing().size(), 1u);
}

TEST_F(SoundWords, SoundsFadeInAndOut) {
  const auto drama = Make(R"(
    track{ sounds = {
      { at = 1, sound = "flute", length = 4, loop = true, fade = 2, ease = "in" },
    } }
    function main()
      wait(10)
      sound("bell"):play{ loop = true, fade = 1 }
      wait(2)
      sound("bell"):stop(1)
    end)");
  PlayTo(*drama, 2.0);
  ASSERT_EQ(Playing().size(), 1u);
  EXPECT_NEAR(stage::Sounds::Share(Playing()[0]), 0.25f, 0.01f);
  PlayTo(*drama, 4.0);
  EXPECT_EQ(stage::Sounds::Share(Playing()[0]), 1.0f);
  PlayTo(*drama, 6.0);
  ASSERT_EQ(Playing().size(), 1u) << "it still fades out";
  EXPECT_NEAR(stage::Sounds::Share(Playing()[0]), 0.25f, 0.01f);
  PlayTo(*drama, 7.1);
  EXPECT_TRUE(Playing().empty());
  PlayTo(*drama, 10.5);
  EXPECT_NEAR(stage::Sounds::Share(Playing()[0]), 0.5f, 0.01f);
  PlayTo(*drama, 12.5);
  EXPECT_NEAR(stage::Sounds::Share(Playing()[0]), 0.5f, 0.01f);
  PlayTo(*drama, 13.1);
  EXPECT_TRUE(Playing().empty());
  EXPECT_EQ(FirstError(*drama), "");
}

TEST_F(SoundWords, WhatIsDescribedNobodyWaitsFor) {
  human::VisemeTrack track;
  track.duration = 1.0f;
  ASSERT_TRUE(stage_.AddSpeech("d_bar", track).ok());
  ASSERT_TRUE(stage_.AddSpeech("d_cup", track).ok());
  const auto drama = Make(R"(
    track{ descriptions = { { at = 1, line = "d_bar" } } }
    function main()
      wait(3)
      describe("d_cup", { patience = 2 })
      keeper = actor("keeper")
      keeper:place{ x = 1, z = -1 }
    end)");
  PlayTo(*drama, 1.5);
  EXPECT_EQ(FirstError(*drama), "");
  EXPECT_EQ(stage_.description().heard.line, *stage_.FindSpeech("d_bar"));
  PlayTo(*drama, 2.9);
  EXPECT_FALSE(stage_.description().heard.speaking);
  PlayTo(*drama, 3.1);
  EXPECT_EQ(stage_.description().heard.line, *stage_.FindSpeech("d_cup"));
  EXPECT_EQ(State("keeper").position.x, 1.0f) << "while it is described";
  const stage::StageSnapshot then = Snapshot();
  PlayTo(*drama, 8.0);
  ASSERT_TRUE(drama->Seek(3.1).ok());
  EXPECT_TRUE(Snapshot() == then);
}

TEST_F(SoundWords, MistakesInDescriptionsAreToldWithTheirPlace) {
  for (const auto& [call, problem] :
       {std::pair("describe('nothing')", "there is no line 'nothing'"),
        {"describe(3)", "give the id of a line"},
        {"describe('nothing', 5)", "give the id of a line"},
        {"describe('nothing', {patience = -1})", "describe: patience must be a number"}}) {
    const auto drama = Make(std::string("function main()\n  ") + call + "\nend");
    drama->Tick();
    EXPECT_THAT(FirstError(*drama), HasSubstr(problem)) << call;
    EXPECT_THAT(FirstError(*drama), HasSubstr("drama.lua:2")) << call;
  }
}

}  // namespace
}  // namespace lararium::drama
