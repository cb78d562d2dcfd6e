#include "editor/cli/cast_commands.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "editor/bake/speech_sound.h"
#include "shared/core/file.h"
#include "tests/support/test_files.h"

namespace lararium::editor {
namespace {

using testing::HasSubstr;

class CastCommands : public testing::Test {
 protected:
  // A cast with Ada, for whom all properties are set.
  CastCommands() {
    EXPECT_TRUE(CreateProject(paths_, "Tavern").ok());
    ProjectDocument document = *LoadProject(paths_);
    CastDocument& ada = document.cast.emplace_back();
    ada.name = "ada";
    ada.height = 1.5;
    ada.tunic = {0.1, 0.2, 0.3};
    ada.voice = {.variant = "f2", .pitch = 60, .range = 40, .rate = 120};
    ada.bones["l_hip"] = "LeftUpLeg";
    document.cast.emplace_back().name = "ben";
    EXPECT_TRUE(SaveProject(paths_, document).ok());
  }

  Result<CommandResult> Run(CastOptions options) {
    options.project = paths_.folder;
    return RunCast(options);
  }
  std::string Problem(CastOptions options) { return Run(std::move(options)).status().message(); }
  Json Saved(size_t index) { return FormatFields(LoadProject(paths_)->cast.at(index)); }

  const test::TemporaryFolder folder_;
  const ProjectPaths paths_{folder_ / "tavern.lararium"};
};

TEST_F(CastCommands, OnlyWhatIsGivenChanges) {
  Json expected = Saved(0);
  expected["height"] = 1.6;
  const auto taller = Run({.name = "ada", .height = 1.6});
  ASSERT_TRUE(taller.ok()) << taller.message();
  EXPECT_EQ(Saved(0), expected);

  expected["voice"]["rate"] = 200;
  expected["voice"]["variant"] = "f4";
  ASSERT_TRUE(Run({.name = "ada", .voice_variant = "f4", .voice_rate = 200}).ok());
  EXPECT_EQ(Saved(0), expected);

  expected["bones"]["r_hip"] = "RightUpLeg";
  expected["bones"]["l_hip"] = "";
  ASSERT_TRUE(Run({.name = "ada", .bones = {"r_hip=RightUpLeg", "l_hip="}}).ok());
  EXPECT_EQ(Saved(0), expected);

  expected["bones"].erase("l_hip");
  ASSERT_TRUE(Run({.name = "ada", .bones = {"l_hip"}}).ok());
  EXPECT_EQ(Saved(0), expected);

  ASSERT_TRUE(Run({.name = "ada"}).ok());
  EXPECT_EQ(Saved(0), expected) << "asked for nothing";
}

TEST_F(CastCommands, AnotherFigureKeepsVoiceAndTheRest) {
  ProjectDocument document = *LoadProject(paths_);
  document.cast[0].preset = "keeper";
  ASSERT_TRUE(SaveProject(paths_, document).ok());
  ASSERT_TRUE(Run({.name = "ada", .plain = true}).ok());
  const CastDocument ada = LoadProject(paths_)->cast[0];
  EXPECT_EQ(ada.preset, "");
  EXPECT_EQ(ada.voice, document.cast[0].voice);
  EXPECT_EQ(ada.bones, document.cast[0].bones);
}

TEST_F(CastCommands, WhoIsNewIsAddedAsThePlainFigure) {
  const auto added = Run({.name = "cleo", .height = 1.2});
  ASSERT_TRUE(added.ok()) << added.message();
  EXPECT_THAT(added->text, HasSubstr("cleo: clips"));
  EXPECT_EQ(Saved(2)["height"], 1.2);
  EXPECT_THAT(Run({})->text, HasSubstr("cleo: plain figure"));
  EXPECT_EQ(Run({})->json.size(), 3u);
}

TEST_F(CastCommands, ATitleMakesANameAndFindsThePerson) {
  ASSERT_TRUE(Run({.name = "Größe", .height = 1.2}).ok());
  EXPECT_EQ(Saved(2)["name"], "Groesse");
  EXPECT_EQ(Saved(2)["title"], "Größe");
  ASSERT_TRUE(Run({.name = "Größe", .title = "The tall one", .height = 1.3}).ok());
  EXPECT_EQ(Saved(2)["name"], "Groesse");
  EXPECT_EQ(Saved(2)["height"], 1.3);
  EXPECT_THAT(Run({})->text, HasSubstr("Groesse (The tall one): plain figure"));
  ASSERT_TRUE(Run({.name = "Groesse", .title = "Groesse"}).ok());
  EXPECT_FALSE(Saved(2).contains("title"));
  ASSERT_TRUE(Run({.name = "東京"}).ok());
  EXPECT_EQ(Saved(3)["name"], "person");
}

TEST_F(CastCommands, OneIsTakenOutAndTheOthersStay) {
  const Json ada = Saved(0);
  ASSERT_TRUE(Run({.remove = "ben"}).ok());
  EXPECT_EQ(LoadProject(paths_)->cast.size(), 1u);
  EXPECT_EQ(Saved(0), ada);
}

TEST_F(CastCommands, AMotionIsRenamedAndTheLinesThatStillSayItAreTold) {
  ProjectDocument document = *LoadProject(paths_);
  const std::filesystem::path motion = std::filesystem::path(LARARIUM_MOTION);
  document.cast[0].clips = {{"wave", motion.string(), true}};
  ASSERT_TRUE(SaveProject(paths_, document).ok());
  ASSERT_TRUE(WriteFileAtomically(paths_.Drama(), std::string_view("\nada:play(\"wave\")\n")).ok());

  const auto renamed = Run({.name = "ada", .rename_clip = "wave", .to = "hail"});
  ASSERT_TRUE(renamed.ok()) << renamed.message();
  EXPECT_EQ(Saved(0)["clips"][0]["name"], "hail");
  EXPECT_EQ(Saved(0)["clips"][0]["loops"], true);
  EXPECT_THAT(renamed->text, HasSubstr("drama.lua:2: says \"wave\" still"));
  EXPECT_EQ(renamed->json["still_said"][0]["line"], 2);
  EXPECT_THAT(Problem({.name = "ada", .rename_clip = "wave", .to = "hail"}),
              HasSubstr("it has hail"));
}

TEST_F(CastCommands, TheVoiceIsWrittenToListenTo) {
  const auto first = Run({.name = "ada", .listen = folder_ / "ada.flac"});
  ASSERT_TRUE(first.ok()) << first.message();
  EXPECT_THAT(first->text, HasSubstr("ada.flac"));
  ASSERT_TRUE(Run({.name = "ada", .listen = folder_ / "fast.flac", .voice_rate = 300}).ok());
  const auto slow = bake::ReadSound(folder_ / "ada.flac");
  const auto fast = bake::ReadSound(folder_ / "fast.flac");
  ASSERT_TRUE(slow.ok() && fast.ok());
  EXPECT_LT(fast->duration(), 0.7 * slow->duration());
}

TEST_F(CastCommands, WhatCannotBeIsRefusedAndNothingIsSaved) {
  const Json before = FormatProject(*LoadProject(paths_));
  EXPECT_THAT(Problem({.remove = "bob"}), HasSubstr("no person \"bob\"; it has ada, ben"));
  EXPECT_THAT(Problem({.name = "bob", .add_clip = "walk.bvh"}), HasSubstr("no person \"bob\""));
  EXPECT_THAT(Problem({.name = "bob", .remove_clip = "walk"}), HasSubstr("no person \"bob\""));
  EXPECT_THAT(Problem({.name = "ada", .remove_clip = "walk"}), HasSubstr("no recorded motion"));
  EXPECT_THAT(Problem({.name = "bob", .rename_clip = "walk", .to = "go"}),
              HasSubstr("no person \"bob\""));
  EXPECT_THAT(Problem({.name = "ada", .rename_clip = "walk", .to = "go"}),
              HasSubstr("no recorded motion"));
  EXPECT_THAT(Problem({.name = "ada", .add_clip = folder_ / "none.bvh"}), HasSubstr("none.bvh"));
  EXPECT_THAT(Problem({.name = "ada", .add_clip = folder_ / "a walk.bvh"}),
              HasSubstr("--clip-name"));
  EXPECT_THAT(Problem({.name = "ada", .voice_rate = 1000}), HasSubstr("voice of ada"));
  EXPECT_THAT(Problem({.name = "a\nname"}), HasSubstr("is not a valid title"));
  EXPECT_THAT(Problem({.name = "ada", .title = ""}), HasSubstr("is not a valid title"));
  EXPECT_EQ(FormatProject(*LoadProject(paths_)), before);
}

}  // namespace
}  // namespace lararium::editor
