#include "editor/cli/project_commands.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "editor/document/place_edits.h"
#include "shared/core/file.h"
#include "tests/jobs/two_places.h"

namespace lararium::editor {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

class ProjectCommands : public testing::Test, protected test::TwoPlacesProject {
 protected:
  Result<CommandResult> Project(ProjectOptions options) {
    options.project = paths_.folder;
    return RunProject(options);
  }
  Result<CommandResult> Place(PlaceOptions options) {
    options.project = paths_.folder;
    return RunPlace(options);
  }
  Result<CommandResult> Locate(LocateOptions options) {
    options.project = paths_.folder;
    return RunLocate(options);
  }
  ProjectDocument Saved() { return *LoadProject(paths_); }
  std::vector<std::string> Places() {
    std::vector<std::string> names;
    for (const PlaceDocument& place : Saved().places) {
      names.push_back(place.name);
    }
    return names;
  }
};

TEST_F(ProjectCommands, AProjectIsRenamedAndTheRestStays) {
  const ProjectDocument before = Saved();
  ASSERT_TRUE(Project({.title = "The tavern", .spoken = "la", .captions = "it,en"}).ok());
  ProjectDocument expected = before;
  expected.title = "The tavern";
  expected.speech.spoken = {"la"};
  expected.speech.captions = {"it", "en"};
  EXPECT_EQ(FormatProject(Saved()), FormatProject(expected));
  EXPECT_THAT(Project({})->text, HasSubstr("captions: it, en"));
  ASSERT_TRUE(Project({.credits = "Ada", .captions = ""}).ok());
  EXPECT_EQ(Saved().credits, "Ada");
  EXPECT_THAT(Saved().speech.captions, IsEmpty());
}

TEST_F(ProjectCommands, LanguagesAreTagsEachOnce) {
  const Json before = FormatProject(Saved());
  for (const char* wrong : {"latin!", "la,la", "la,", ","}) {
    EXPECT_THAT(Project({.spoken = wrong}).status().message(),
                HasSubstr("not a valid language tag"))
        << wrong;
  }
  EXPECT_EQ(FormatProject(Saved()), before);
}

TEST_F(ProjectCommands, PlacesAreAddedPutFirstAndRemoved) {
  ASSERT_TRUE(Place({.add = "yard"}).ok());
  EXPECT_THAT(Places(), ElementsAre("maquette", "site", "yard"));
  ASSERT_TRUE(Place({.first = "yard"}).ok());
  EXPECT_THAT(Places(), ElementsAre("yard", "maquette", "site"));
  ProjectDocument document = Saved();
  PutPlaceFirst("moon", document);
  EXPECT_EQ(FormatProject(document), FormatProject(Saved())) << "none is called so";
  EXPECT_THAT(Place({})->text, HasSubstr("yard: not trained"));
  ASSERT_TRUE(Place({.remove = "maquette"}).ok());
  EXPECT_THAT(Places(), ElementsAre("yard", "site"));
  EXPECT_TRUE(std::filesystem::exists(paths_.Scene("maquette"))) << "files stay";
}

TEST_F(ProjectCommands, ATitleMakesANameAndFindsThePlace) {
  ASSERT_TRUE(Place({.add = "Casa del Fauno, atrio"}).ok());
  EXPECT_THAT(Places(), ElementsAre("maquette", "site", "Casa_del_Fauno_atrio"));
  EXPECT_EQ(Saved().places[2].title, "Casa del Fauno, atrio");
  EXPECT_THAT(Place({})->text, HasSubstr("Casa_del_Fauno_atrio (Casa del Fauno, atrio): not"));
  EXPECT_THAT(Place({.add = "Casa del Fauno, atrio"}).status().message(), HasSubstr("already"));
  EXPECT_EQ(*ChoosePlace(paths_, Saved(), "Casa del Fauno, atrio"), "Casa_del_Fauno_atrio");
  ASSERT_TRUE(Place({.first = "Casa del Fauno, atrio"}).ok());
  EXPECT_EQ(Saved().places[0].name, "Casa_del_Fauno_atrio");
  // The same letters give a name of its own.
  ASSERT_TRUE(Place({.add = "Casa del Fauno: atrio"}).ok());
  EXPECT_EQ(Saved().places[3].name, "Casa_del_Fauno_atrio_2");
}

TEST_F(ProjectCommands, ATitleAloneLeavesTheFolderAndARenamingFollowsIt) {
  ASSERT_TRUE(Place({.set = "site", .title = "Größe"}).ok());
  EXPECT_THAT(Places(), ElementsAre("maquette", "site"));
  EXPECT_EQ(Saved().places[1].title, "Größe");
  ASSERT_TRUE(Place({.rename = "Größe", .to = "The bar"}).ok());
  EXPECT_THAT(Places(), ElementsAre("maquette", "The_bar"));
  EXPECT_EQ(Saved().places[1].title, "The bar");
  EXPECT_TRUE(std::filesystem::exists(paths_.Scene("The_bar")));
}

TEST_F(ProjectCommands, APlaceIsRenamedWithItsFolderAndAllThatLiesInIt) {
  ASSERT_TRUE(
      WriteFileAtomically(paths_.Place("site") / "walk.mp4", std::string_view("film")).ok());
  ProjectDocument document = Saved();
  document.places[1].training = {SourceDocument::Kind::kVideo, "places/site/walk.mp4"};
  ASSERT_TRUE(SaveProject(paths_, document).ok());

  const auto renamed = Place({.rename = "site", .to = "tavern"});
  ASSERT_TRUE(renamed.ok()) << renamed.message();
  document.places[1].name = "tavern";
  document.places[1].training.path = "places/tavern/walk.mp4";
  EXPECT_EQ(FormatProject(Saved()), FormatProject(document));
  EXPECT_TRUE(std::filesystem::exists(paths_.Scene("tavern")));
  EXPECT_FALSE(std::filesystem::exists(paths_.Place("site")));

  ASSERT_TRUE(Place({.remove = "maquette"}).ok());
  EXPECT_THAT(Place({.rename = "tavern", .to = "maquette"}).status().message(),
              HasSubstr("to a place that was removed"));
  EXPECT_THAT(Places(), ElementsAre("tavern"));
}

TEST_F(ProjectCommands, WhatTheCameraViewPlaysIsAVideoAFolderOrThatOfTheTraining) {
  ASSERT_TRUE(Place({.set = "site", .preview = folder_ / "evening.mp4"}).ok());
  EXPECT_EQ(Saved().places[1].preview.kind, SourceDocument::Kind::kVideo);
  EXPECT_EQ(Saved().places[1].preview.path, (folder_ / "evening.mp4").string());
  EXPECT_THAT(Place({})->text, HasSubstr("seen by "));
  std::filesystem::create_directories(paths_.folder / "walk");
  ASSERT_TRUE(Place({.set = "site", .preview = paths_.folder / "walk"}).ok());
  EXPECT_EQ(Saved().places[1].preview.kind, SourceDocument::Kind::kImages);
  EXPECT_EQ(Saved().places[1].preview.path, "walk") << "as documents name what lies in the project";
  ASSERT_TRUE(
      Place({.set = "site", .images_of = paths_.folder / "walk", .preview = paths_.folder / "walk"})
          .ok());
  EXPECT_TRUE(Saved().places[1].preview.empty()) << "none besides that of the training";
}

TEST_F(ProjectCommands, AsAnEditARenamedPlaceHasItsFolderUnderBothNames) {
  ProjectDocument document = Saved();
  document.places[1].training = {SourceDocument::Kind::kVideo, "places/site/walk.mp4"};
  ASSERT_TRUE(GiveFolderOtherName(paths_, "site", "tavern").ok());
  RenamePlaceInDocument(paths_, "site", "tavern", document);
  EXPECT_EQ(document.places[1].name, "tavern");
  EXPECT_EQ(document.places[1].training.path, "places/tavern/walk.mp4");
  EXPECT_TRUE(std::filesystem::exists(paths_.Scene("tavern")));
  EXPECT_TRUE(std::filesystem::exists(paths_.Scene("site"))) << "where undo finds it";

  // After undo, another recording, and redo, neither recording is lost.
  const auto film = [&](const std::string& place, const std::string& name) {
    const std::filesystem::path file = paths_.Place(place) / "films" / name;
    std::filesystem::create_directories(file.parent_path());
    ASSERT_TRUE(WriteFileAtomically(file, std::string_view("film")).ok());
  };
  film("site", "new.mp4");
  film("tavern", "kept.mp4");
  ASSERT_TRUE(GiveFolderOtherName(paths_, "site", "tavern").ok());
  EXPECT_TRUE(std::filesystem::exists(paths_.Place("tavern") / "films" / "new.mp4"));
  EXPECT_TRUE(std::filesystem::exists(paths_.Place("tavern") / "films" / "kept.mp4"));
}

TEST_F(ProjectCommands, TheFolderOfAnotherMapGivesItsNameToNoPlace) {
  EXPECT_THAT(GiveFolderOtherName(paths_, "site", "maquette").message(),
              HasSubstr("to a place that was removed"));
  EXPECT_TRUE(GiveFolderOtherName(paths_, "moon", "sea").ok()) << "not trained: without a folder";
  EXPECT_FALSE(std::filesystem::exists(paths_.Place("sea")));
}

TEST_F(ProjectCommands, ARenamingThatIsNotSavedLeavesThePlaceAsItWas) {
  ProjectDocument document = Saved();
  const Json before = FormatProject(document);
  std::filesystem::remove(paths_.Project());
  std::filesystem::create_directories(paths_.Project() / "in the way");
  EXPECT_FALSE(RenamePlace(paths_, "site", "tavern", document).ok());
  EXPECT_EQ(FormatProject(document), before);
  EXPECT_TRUE(std::filesystem::exists(paths_.Scene("site")));
  EXPECT_FALSE(std::filesystem::exists(paths_.Place("tavern")));
}

TEST_F(ProjectCommands, WhatARenamingLeftThatWasCutOffIsNotTakenForThePlace) {
  const std::filesystem::path unfinished = paths_.Place("tavern").string() + ".unfinished";
  std::filesystem::create_directories(unfinished);
  ASSERT_TRUE(WriteFileAtomically(unfinished / "part", std::string_view("?")).ok());
  ASSERT_TRUE(Place({.rename = "site", .to = "tavern"}).ok());
  EXPECT_TRUE(std::filesystem::exists(paths_.Scene("tavern")));
  EXPECT_FALSE(std::filesystem::exists(paths_.Place("tavern") / "part"));
  EXPECT_FALSE(std::filesystem::exists(unfinished));
}

TEST_F(ProjectCommands, APlaceTakesOverTheModelsOfAnother) {
  ASSERT_TRUE(Place({.set = "site", .occluders_of = "maquette"}).ok());
  const PlaceDocument site = Saved().places[1];
  ASSERT_EQ(site.occluders.size(), 2u);
  EXPECT_EQ(site.occluders[1].name, "wall");
  ASSERT_TRUE(Place({.set = "maquette", .occluders_of = "site"}).ok());
  EXPECT_EQ(Saved().places[0].occluders.size(), 1u) << "what was drawn belongs to its place";
}

TEST_F(ProjectCommands, TheImagesToPickInAreListed) {
  const auto listed = Place({.images = true});
  ASSERT_TRUE(listed.ok()) << listed.message();
  EXPECT_THAT(listed->text, HasSubstr("  0.png\n  1.png"));
  EXPECT_EQ(listed->json[0]["images"][2]["frame"], "2.png");
  EXPECT_THAT(Place({})->text, Not(HasSubstr("0.png")));
}

TEST_F(ProjectCommands, WhatNoPlaceIsCalledIsTold) {
  const Json before = FormatProject(Saved());
  EXPECT_THAT(Place({.remove = "moon"}).status().message(),
              HasSubstr("has no place \"moon\"; it has maquette, site"));
  EXPECT_THAT(Place({.add = "site"}).status().message(), HasSubstr("already"));
  EXPECT_THAT(Place({.rename = "site", .to = "a\nsite"}).status().message(),
              HasSubstr("not a valid title"));
  EXPECT_THAT(Place({.set = "site", .occluders_of = "moon"}).status().message(),
              HasSubstr("no place \"moon\""));
  EXPECT_EQ(FormatProject(Saved()), before);
}

TEST_F(ProjectCommands, WhatHasMovedIsLocatedWithWhatMovedAlong) {
  ProjectDocument document = Saved();
  document.places[0].training = {SourceDocument::Kind::kVideo, "films/a.mp4"};
  document.places[1].training = {SourceDocument::Kind::kVideo, "films/b.mp4"};
  ASSERT_TRUE(SaveProject(paths_, document).ok());
  for (const char* name : {"a.mp4", "b.mp4"}) {
    std::filesystem::create_directories(folder_ / "disk");
    ASSERT_TRUE(WriteFileAtomically(folder_ / "disk" / name, std::string_view("film")).ok());
  }
  EXPECT_THAT(Locate({})->text, HasSubstr("films/b.mp4"));
  const auto located = Locate({.from = "films/a.mp4", .to = folder_ / "disk" / "a.mp4"});
  ASSERT_TRUE(located.ok()) << located.message();
  EXPECT_THAT(located->text, HasSubstr("no file is missing"));
  EXPECT_EQ(paths_.Resolve(Saved().places[1].training.path), folder_ / "disk" / "b.mp4");
  EXPECT_THAT(Locate({.from = "films/a.mp4", .to = folder_ / "disk"}).status().message(),
              HasSubstr("is not missing"));
}

}  // namespace
}  // namespace lararium::editor
