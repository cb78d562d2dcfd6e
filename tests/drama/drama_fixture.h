#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>

#include "shared/core/log.h"
#include "shared/drama/drama.h"
#include "tests/stage/test_human.h"
#include "tests/stage/test_props.h"

namespace lararium::drama {

// A stage with the actors "keeper" and "guest", and dramas on it.
class DramaTest : public ::testing::Test {
 protected:
  DramaTest() {
    for (const char* name : {"keeper", "guest"}) {
      EXPECT_TRUE(stage_.Add(name, test::MakeTestHuman()).ok());
    }
  }

  std::unique_ptr<Drama> Make(const std::string& script, const DramaOptions& options = {}) {
    auto drama = Drama::Create(script, "drama.lua", stage_, options, *log_);
    EXPECT_TRUE(drama.ok()) << drama.message();
    return drama.ok() ? *std::move(drama) : nullptr;
  }

  // Ticks until the drama's time is `time`.
  static void PlayTo(Drama& drama, double time) {
    while (drama.time() < time - 1e-9) {
      drama.Tick();
    }
  }

  const stage::ActorState& State(const char* name) {
    return stage_.Find(*stage_.Find(name))->state;
  }
  stage::StageSnapshot Snapshot() const {
    stage::StageSnapshot snapshot;
    stage_.Capture(snapshot);
    return snapshot;
  }

  stage::Stage stage_;
  std::shared_ptr<Log> log_ = MakeSilentLog();
};

// A stage with a table, a chest, a cup and the speech "greeting" as well.
class FurnishedDramaTest : public DramaTest {
 protected:
  FurnishedDramaTest() {
    Add("table", test::MakeTable(), {{-1.5f, 0.0f, 0.0f}});
    Add("chest", test::MakeChest(), {{1.5f, 0.0f, 0.0f}});
    Add("cup", test::MakeCup(), {{0.0f, 0.0f, -2.0f}});
    human::VisemeTrack track;
    track.keys = {{0.0f, human::Viseme::kAa, 1.0f}, {0.5f, human::Viseme::kOu, 1.0f}};
    track.duration = 1.0f;
    EXPECT_TRUE(stage_.AddSpeech("greeting", track).ok());
  }

  void Add(const char* name, stage::Prop prop, const stage::Pose& pose) {
    EXPECT_TRUE(stage_.AddObject(name, test::Model(std::move(prop)), pose).ok());
  }
};

// The first error of a drama, or "".
inline std::string FirstError(const Drama& drama) {
  return drama.errors().empty() ? "" : drama.errors()[0].message;
}

}  // namespace lararium::drama
