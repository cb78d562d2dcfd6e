#include "editor/cli/line_commands.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "editor/document/project.h"
#include "tests/support/test_files.h"

namespace lararium::editor {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class LineCommands : public testing::Test {
 protected:
  LineCommands() { EXPECT_TRUE(CreateProject(paths_, "Tavern").ok()); }

  Result<CommandResult> Run(LinesOptions options) {
    options.project = paths_.folder;
    return RunLines(options);
  }
  bake::LineTable Saved() { return *bake::LoadLines(paths_.folder); }

  const test::TemporaryFolder folder_;
  const ProjectPaths paths_{folder_ / "tavern.lararium"};
};

TEST_F(LineCommands, ALineIsWrittenTranslatedAndRemoved) {
  EXPECT_THAT(Run({})->text, HasSubstr("no lines"));
  const auto added = Run(
      {.add = "hail", .speaker = "keeper", .texts = {"la=Salvēte, hospitēs!", "en=Be greeted!"}});
  ASSERT_TRUE(added.ok()) << added.message();
  EXPECT_THAT(added->text, HasSubstr("la: Salvēte, hospitēs!"));
  ASSERT_TRUE(Run({.set = "hail", .notes = "loud", .texts = {"it=Salve = ciao", "en="}}).ok());

  const bake::LineTable table = Saved();
  EXPECT_THAT(table.languages, ElementsAre("la", "en", "it"));
  ASSERT_EQ(table.lines.size(), 1u);
  EXPECT_EQ(table.lines[0].speaker, "keeper") << "as it was";
  EXPECT_EQ(table.lines[0].notes, "loud");
  EXPECT_EQ(table.lines[0].text.at("la"), "Salvēte, hospitēs!");
  EXPECT_EQ(table.lines[0].text.at("it"), "Salve = ciao");
  EXPECT_FALSE(table.lines[0].text.contains("en"));

  ASSERT_TRUE(Run({.set = "hail", .speaker = ""}).ok());
  EXPECT_EQ(Saved().lines[0].speaker, "");
  ASSERT_TRUE(Run({.remove = "hail"}).ok());
  EXPECT_TRUE(Saved().lines.empty());
}

TEST_F(LineCommands, AFurtherLanguageIsAColumn) {
  ASSERT_TRUE(Run({.add = "hail", .texts = {"la=Salvēte!"}}).ok());
  ASSERT_TRUE(Run({.add_language = "de"}).ok());
  EXPECT_THAT(Saved().languages, ElementsAre("la", "de"));
  EXPECT_EQ(Run({})->json["languages"], Json::array({"la", "de"}));
}

TEST_F(LineCommands, WhatCannotBeIsRefusedAndNothingIsSaved) {
  ASSERT_TRUE(Run({.add = "hail", .texts = {"la=Salvēte!"}}).ok());
  const bake::LineTable before = Saved();
  const auto problem = [&](LinesOptions options) {
    return Run(std::move(options)).status().message();
  };
  EXPECT_THAT(problem({.add = "hail"}), HasSubstr("already"));
  EXPECT_THAT(problem({.add = "a line"}), HasSubstr("not a valid name"));
  EXPECT_THAT(problem({.set = "hali", .speaker = "keeper"}), HasSubstr("there are hail"));
  EXPECT_THAT(problem({.remove = "hali"}), HasSubstr("no line \"hali\""));
  EXPECT_THAT(problem({.set = "hail", .texts = {"Salvete"}}), HasSubstr("la=Salvete!"));
  EXPECT_THAT(problem({.set = "hail", .texts = {"la=Ave", "latin!=Ave"}}), HasSubstr("--text"));
  EXPECT_THAT(problem({.add_language = "latin!"}), HasSubstr("not a valid language tag"));
  EXPECT_EQ(Saved(), before);
}

}  // namespace
}  // namespace lararium::editor
