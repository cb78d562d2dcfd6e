#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "shared/core/log.h"
#include "shared/drama/drama.h"
#include "tests/stage/test_human.h"

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

// The first error of a drama, or "".
inline std::string FirstError(const Drama& drama) {
  return drama.errors().empty() ? "" : drama.errors()[0].message;
}

}  // namespace lararium::drama
