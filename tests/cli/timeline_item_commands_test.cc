#include "editor/cli/timeline_item_commands.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "editor/document/project.h"
#include "shared/core/file.h"
#include "tests/support/test_files.h"

namespace lararium::editor {
namespace {

using testing::HasSubstr;
using testing::Not;

const char* const kScript = R"(-- the tavern
track{actor = "keeper",
  speech = {
    {id = "hail", at = 1, length = 2, line = "salvete"},  -- to all
    {at = 5, length = 1, line = "quid"},
  },
}
track{markers = {{at = 6, name = "noon"}}}
function main() end
)";

class TimelineItems : public testing::Test {
 protected:
  TimelineItems() {
    EXPECT_TRUE(CreateProject(paths_, "Tavern").ok());
    ProjectDocument document = *LoadProject(paths_);
    document.cast.emplace_back().name = "keeper";
    EXPECT_TRUE(SaveProject(paths_, document).ok());
    EXPECT_TRUE(WriteFileAtomically(paths_.Drama(), std::string_view(kScript)).ok());
  }

  Result<CommandResult> Run(TimelineOptions options) {
    options.project = paths_.folder;
    return EditTimeline(options, progress_);
  }
  std::string Script() { return *ReadText(paths_.Drama()); }

  const test::TemporaryFolder folder_;
  const ProjectPaths paths_{folder_ / "tavern.lararium"};
  NoProgress progress_;
};

TEST_F(TimelineItems, AreListedByWhoseTheyAre) {
  const auto listed = Run({});
  ASSERT_TRUE(listed.ok()) << listed.message();
  EXPECT_THAT(listed->text, HasSubstr("keeper/speech/2: at=5"));
  EXPECT_THAT(listed->text, HasSubstr("markers/1: at=6"));
  EXPECT_EQ(listed->json[0]["item"]["line"], "salvete");
  EXPECT_EQ(listed->json[0]["line"], 4);
  EXPECT_EQ(Script(), kScript);
}

TEST_F(TimelineItems, OnlyStandingUpIsAddedWithoutAnObject) {
  const auto use = [this](std::string action) {
    return Run({.add = "uses", .actor = "keeper", .at = 1.0, .fields = {"action=" + action}});
  };
  EXPECT_THAT(use("sit").message(), HasSubstr("is incomplete"));
  const auto stands = use("stand");
  EXPECT_TRUE(stands.ok()) << stands.message();
  EXPECT_THAT(Script(), HasSubstr("action = \"stand\""));
}

TEST_F(TimelineItems, OneIsAddedWithItsLaneAndTheTextAroundItStays) {
  const auto added = Run({.add = "walks",
                          .actor = "keeper",
                          .at = 2.5,
                          .fields = {"to=1.5,-2,90", "speed=0.8", "id=to the door"}});
  ASSERT_TRUE(added.ok()) << added.message();
  EXPECT_EQ(added->json.size(), 4u);
  EXPECT_THAT(added->text, HasSubstr("keeper/walks/1: "));
  EXPECT_THAT(Script(), HasSubstr("to = {heading = 90, x = 1.5, z = -2}"));
  EXPECT_THAT(Script(), HasSubstr("-- to all"));
  ASSERT_TRUE(
      Run({.add = "sounds", .at = 0, .fields = {"sound=bell", "object=door", "loop=yes"}}).ok());
  EXPECT_THAT(Script(), HasSubstr("loop = true"));
}

TEST_F(TimelineItems, TakeTheColourOfALight) {
  ASSERT_TRUE(
      Run({.add = "lights", .at = 1.0, .fields = {"light=lamp", "colour=1,0.5,0.25"}}).ok());
  EXPECT_THAT(Script(), HasSubstr("colour = {1, 0.5, 0.25}"));
  for (const char* wrong : {"colour=red", "colour=1,0.5", "colour=1,1,1,1", "colour=1,-1,0"}) {
    EXPECT_THAT(
        Run({.add = "lights", .at = 1.0, .fields = {"light=lamp", wrong}}).status().message(),
        HasSubstr("red"))
        << wrong;
  }
}

TEST_F(TimelineItems, AreMovedTrimmedSetCopiedAndDeleted) {
  ASSERT_TRUE(Run({.items = {"hail"}, .move = 0.5}).ok());
  EXPECT_THAT(Script(), HasSubstr("{id = \"hail\", at = 1.5, length = 2, line = \"salvete\"}"));
  ASSERT_TRUE(Run({.items = {"keeper/speech/1"}, .trim_begin = 0.5, .trim_end = 1.0}).ok());
  EXPECT_THAT(Script(), HasSubstr("at = 2, length = 2.5"));
  ASSERT_TRUE(
      Run({.items = {"keeper/speech/2"}, .fields = {"line=vale"}, .unset = {"length"}}).ok());
  EXPECT_THAT(Script(), HasSubstr("at = 5, line = \"vale\""));
  ASSERT_TRUE(Run({.items = {"hail"}, .copy_to = 20.0}).ok());
  EXPECT_THAT(Run({})->text, HasSubstr("keeper/speech/3:"));
  EXPECT_THAT(Run({})->text, HasSubstr("id=hail 2")) << "ids stay unique";
  ASSERT_TRUE(Run({.items = {"hail", "markers/1"}, .remove = true}).ok());
  EXPECT_THAT(Script(), Not(HasSubstr("noon")));
  EXPECT_THAT(Script(), Not(HasSubstr("id = \"hail\",")));
}

TEST_F(TimelineItems, WithRippleWhatBeginsLaterMovesAlong) {
  ASSERT_TRUE(Run({.items = {"hail"}, .move = 1.0, .ripple = true}).ok());
  EXPECT_THAT(Script(), HasSubstr("at = 6, length = 1, line = \"quid\""));
  EXPECT_THAT(Script(), HasSubstr("{at = 7, name = \"noon\"}"));
  ASSERT_TRUE(Run({.items = {"hail"}, .remove = true, .ripple = true}).ok());
  EXPECT_THAT(Script(), HasSubstr("{at = 4, length = 1, line = \"quid\"}")) << "the gap closes";
}

TEST_F(TimelineItems, WhatCannotBeIsRefusedAndNothingIsWritten) {
  const auto problem = [&](TimelineOptions options) {
    return Run(std::move(options)).status().message();
  };
  EXPECT_THAT(problem({.items = {"hall"}, .move = 1.0}), HasSubstr("no item \"hall\""));
  EXPECT_THAT(problem({.add = "songs", .at = 1.0}), HasSubstr("not a lane"));
  EXPECT_THAT(problem({.add = "speech", .actor = "cook", .at = 1.0, .fields = {"line=vale"}}),
              HasSubstr("no person \"cook\"; it has keeper"));
  EXPECT_THAT(problem({.add = "markers", .actor = "keeper", .at = 1.0, .fields = {"name=a"}}),
              HasSubstr("belong to the stage"));
  EXPECT_THAT(problem({.add = "speech", .actor = "keeper", .at = 1.0}), HasSubstr("line=..."));
  EXPECT_THAT(problem({.add = "walks", .actor = "keeper", .at = 1.0}), HasSubstr("hide=yes"));
  EXPECT_THAT(problem({.items = {"hail"}, .fields = {"lin=vale"}}), HasSubstr("it has at, length"));
  EXPECT_THAT(problem({.items = {"hail"}, .fields = {"at=soon"}}), HasSubstr("is not a number"));
  EXPECT_THAT(problem({.items = {"hail"}, .fields = {"at=-1"}}),
              HasSubstr("must be a number from 0 to 1000000"));
  EXPECT_THAT(problem({.add = "lights", .fields = {"light=lamp", "temperature=100"}}),
              HasSubstr("must be a number from 1667 to 25000"));
  EXPECT_THAT(problem({.add = "walks", .actor = "keeper", .at = 1.0, .fields = {"to=1"}}),
              HasSubstr("is not a point"));
  EXPECT_THAT(problem({.add = "walks", .actor = "keeper", .at = 1.0, .fields = {"hide=maybe"}}),
              HasSubstr("neither yes nor no"));
  EXPECT_EQ(Script(), kScript);
}

}  // namespace
}  // namespace lararium::editor
