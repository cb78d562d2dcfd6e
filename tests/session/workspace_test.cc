#include "editor/session/workspace.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "editor/document/line_edits.h"
#include "editor/jobs/staging.h"
#include "editor/jobs/training.h"
#include "shared/core/file.h"
#include "tests/support/synthetic_world.h"
#include "tests/support/test_files.h"

namespace lararium::editor {
namespace {

using testing::HasSubstr;

class WorkspaceTest : public testing::Test {
 protected:
  WorkspaceTest() { CHECK(CreateProject(paths_, "Before").ok()); }

  std::unique_ptr<Workspace> Open() {
    Result<std::unique_ptr<Workspace>> workspace = Workspace::Open(paths_, *log_);
    CHECK(workspace.ok());
    return std::move(*workspace);
  }

  static void SetTitle(Workspace& workspace, const std::string& title) {
    workspace.project().Edit(Sentence("title"),
                             [&](ProjectDocument& document) { document.title = title; });
  }

  std::string SavedTitle() {
    const Result<ProjectDocument> document = LoadProject(paths_);
    return document.ok() ? document->title : document.message();
  }

  test::TemporaryFolder folder_;
  ProjectPaths paths_{folder_ / "show.lararium"};
  std::shared_ptr<Log> log_ = MakeSilentLog();
};

TEST_F(WorkspaceTest, SavesWhatWasEditedAndUndone) {
  const auto workspace = Open();
  SetTitle(*workspace, "One");
  SetTitle(*workspace, "Two");
  workspace->project().Undo();
  EXPECT_EQ(SavedTitle(), "Before");
  workspace->project().Save();
  EXPECT_EQ(SavedTitle(), "One");
  workspace->project().Redo();
  EXPECT_TRUE(workspace->project().commands().dirty());
  workspace->project().Save();
  EXPECT_EQ(SavedTitle(), "Two");
}

TEST_F(WorkspaceTest, RecoversUnsavedEditsAndUndoTakesThemBack) {
  const std::string script = Open()->project().script().text();
  {
    const auto workspace = Open();
    SetTitle(*workspace, "Unsaved");
    workspace->project().EditScript(Sentence("type"), "-- unsaved\n");
  }  // The unsaved edit stays in the journal.
  const auto workspace = Open();
  EXPECT_EQ(workspace->project().document().title, "Unsaved");
  EXPECT_EQ(workspace->project().script().text(), "-- unsaved\n");
  EXPECT_TRUE(workspace->project().commands().dirty());
  EXPECT_THAT(workspace->messages().entries().back().text, HasSubstr("recovered"));
  workspace->project().Undo();
  EXPECT_EQ(workspace->project().document().title, "Before");
  EXPECT_EQ(workspace->project().script().text(), script);
  workspace->project().Redo();
  EXPECT_EQ(workspace->project().document().title, "Unsaved");
  EXPECT_EQ(workspace->project().script().text(), "-- unsaved\n");
}

TEST_F(WorkspaceTest, RecoversTwiceWithoutAnEditBetween) {
  {
    const auto workspace = Open();
    SetTitle(*workspace, "Unsaved");
  }
  Open();
  EXPECT_EQ(Open()->project().document().title, "Unsaved");
}

TEST_F(WorkspaceTest, OpensBesideADamagedJournalKeepsItAndSaysSo) {
  ASSERT_TRUE(WriteFileAtomically(paths_.Journal(), "{").ok());
  const auto workspace = Open();
  EXPECT_EQ(workspace->project().document().title, "Before");
  EXPECT_THAT(workspace->messages().entries().front().text, HasSubstr("journal.damaged"));
  EXPECT_TRUE(std::filesystem::exists(paths_.folder / "journal.damaged"));
  SetTitle(*workspace, "After");
  EXPECT_TRUE(std::filesystem::exists(paths_.Journal()));
}

TEST_F(WorkspaceTest, TheDramaHasItsCommandsAmongThoseOfTheProject) {
  const auto workspace = Open();
  const std::string script = workspace->project().script().text();
  SetTitle(*workspace, "One");
  ASSERT_TRUE(workspace->project().EditTimeline(Sentence("add"), [](drama::TimelineText& text) {
    LARARIUM_RETURN_IF_ERROR(text.AddLane(drama::LaneKind::kMarkers, "").status());
    return text.Insert(0, {{"at", 1.0}, {"name", "noon"}}).status();
  }));
  SetTitle(*workspace, "Two");
  const std::string edited = workspace->project().script().text();
  EXPECT_NE(edited, script);
  workspace->project().Undo();
  EXPECT_EQ(workspace->project().document().title, "One");
  EXPECT_EQ(workspace->project().script().text(), edited);
  workspace->project().Undo();
  EXPECT_EQ(workspace->project().script().text(), script);
  EXPECT_EQ(workspace->project().document().title, "One");
  workspace->project().Redo();
  workspace->project().Redo();
  EXPECT_EQ(workspace->project().script().text(), edited);
  workspace->project().Save();
  EXPECT_FALSE(workspace->project().commands().dirty());
  EXPECT_FALSE(std::filesystem::exists(paths_.Journal()));
  EXPECT_EQ(*ReadText(paths_.Drama()), edited);
}

TEST_F(WorkspaceTest, AGestureOfTheTimelineIsOneCommand) {
  const auto workspace = Open();
  const std::string script = workspace->project().script().text();
  for (int i = 1; i <= 3; ++i) {
    workspace->project().EditScript(Sentence("type"),
                                    script + std::string(static_cast<size_t>(i), '-'), "typing");
  }
  workspace->project().EndGesture();
  workspace->project().EditScript(Sentence("type"), script + "-- more", "typing");
  workspace->project().Undo();
  EXPECT_EQ(workspace->project().script().text(), script + "---");
  workspace->project().Undo();
  EXPECT_EQ(workspace->project().script().text(), script);
}

TEST_F(WorkspaceTest, AnEditOfTheFileByHandIsTakenOver) {
  const auto workspace = Open();
  ASSERT_TRUE(WriteFileAtomically(paths_.Drama(), "-- by hand\n").ok());
  workspace->Update(2.0);
  EXPECT_EQ(workspace->project().script().text(), "-- by hand\n");
  EXPECT_FALSE(workspace->project().commands().dirty());
  workspace->project().Undo();
  EXPECT_NE(workspace->project().script().text(), "-- by hand\n");
  EXPECT_TRUE(workspace->project().commands().dirty());
}

TEST_F(WorkspaceTest, AnEditByHandBesideUnsavedOnesIsAskedAboutAndNothingIsLost) {
  const auto workspace = Open();
  workspace->project().EditScript(Sentence("type"), "-- mine\n");
  ASSERT_TRUE(WriteFileAtomically(paths_.Drama(), "-- theirs\n").ok());
  workspace->project().Save();
  EXPECT_TRUE(workspace->project().files().changed_outside());
  EXPECT_EQ(*ReadText(paths_.Drama()), "-- theirs\n");
  EXPECT_EQ(workspace->project().script().text(), "-- mine\n");
  workspace->project().AdoptExternal();
  EXPECT_EQ(workspace->project().script().text(), "-- theirs\n");
  workspace->project().Undo();
  EXPECT_EQ(workspace->project().script().text(), "-- mine\n");
  workspace->project().Save();
  EXPECT_EQ(*ReadText(paths_.Drama()), "-- mine\n");
}

TEST_F(WorkspaceTest, KeepingWhatIsHereOverwritesWhatOthersWrote) {
  const auto workspace = Open();
  workspace->project().EditScript(Sentence("type"), "-- mine\n");
  ASSERT_TRUE(WriteFileAtomically(paths_.Drama(), "-- theirs\n").ok());
  workspace->project().Save();
  workspace->project().KeepLocal();
  EXPECT_FALSE(workspace->project().files().changed_outside());
  workspace->project().Save();
  EXPECT_EQ(*ReadText(paths_.Drama()), "-- mine\n");
}

TEST_F(WorkspaceTest, AProjectThatOthersSavedIsTakenOver) {
  const auto workspace = Open();
  ProjectDocument other = workspace->project().document();
  other.title = "Theirs";
  ASSERT_TRUE(SaveProject(paths_, other).ok());
  workspace->Update(2.0);
  EXPECT_EQ(workspace->project().document().title, "Theirs");
  EXPECT_FALSE(workspace->project().commands().dirty());
}

TEST_F(WorkspaceTest, WhatOthersBrokeIsNotWrittenOverUntilSomebodyChooses) {
  const auto workspace = Open();
  const std::string good = *ReadText(paths_.Project());
  const std::string broken = good.substr(0, good.size() / 2);
  ASSERT_TRUE(WriteFileAtomically(paths_.Project(), broken).ok());
  workspace->Update(2.0);
  EXPECT_TRUE(workspace->project().files().changed_outside());
  EXPECT_THAT(workspace->project().files().damage(), HasSubstr("project.json"));
  EXPECT_THAT(workspace->messages().entries().back().text, HasSubstr("Mend it there"));
  SetTitle(*workspace, "Mine");
  workspace->project().Save();
  EXPECT_EQ(*ReadText(paths_.Project()), broken);

  workspace->project().KeepLocal();
  EXPECT_FALSE(workspace->project().files().changed_outside());
  EXPECT_EQ(*ReadText(paths_.folder / "project.json.damaged"), broken);
  workspace->project().Save();
  EXPECT_EQ(SavedTitle(), "Mine");
}

TEST_F(WorkspaceTest, WhatOthersBrokeAndMendedIsTakenOver) {
  const auto workspace = Open();
  ASSERT_TRUE(WriteFileAtomically(paths_.Project(), std::string_view("{")).ok());
  workspace->Update(2.0);
  EXPECT_FALSE(workspace->project().files().damage().empty());
  ProjectDocument other = workspace->project().document();
  other.title = "Theirs";
  ASSERT_TRUE(SaveProject(paths_, other).ok());
  workspace->Update(2.0);
  EXPECT_FALSE(workspace->project().files().changed_outside());
  EXPECT_EQ(workspace->project().document().title, "Theirs");
}

TEST_F(WorkspaceTest, AFileThatOthersRemovedIsSavedAnew) {
  const auto workspace = Open();
  std::filesystem::remove(paths_.Drama());
  workspace->Update(2.0);
  EXPECT_FALSE(workspace->project().files().changed_outside());
  EXPECT_THAT(workspace->messages().entries().back().text, HasSubstr("saving writes it again"));
  workspace->project().Save();
  EXPECT_TRUE(std::filesystem::exists(paths_.Drama()));
}

TEST_F(WorkspaceTest, AConflictWithOthersIsToldAtOnceAndOnce) {
  const auto workspace = Open();
  workspace->project().EditScript(Sentence("type"), "-- mine\n");
  ASSERT_TRUE(WriteFileAtomically(paths_.Drama(), std::string_view("-- theirs\n")).ok());
  workspace->Update(2.0);
  EXPECT_THAT(workspace->messages().entries().back().text, HasSubstr("Choose below"));
  const uint64_t told = workspace->messages().told();
  workspace->Update(2.0);
  EXPECT_EQ(workspace->messages().told(), told);
}

// Trains a place from another recording that cannot be read.
class TrainFromTest : public WorkspaceTest {
 protected:
  static SessionDocument Recording(const char* file) {
    return {{SourceDocument::Kind::kVideo, file}, std::nullopt};
  }

  void AddPlace() {
    ProjectDocument document = *LoadProject(paths_);
    document.places.emplace_back().name = "site";
    document.places[0].training = Recording("first.mp4").source;
    ASSERT_TRUE(SaveProject(paths_, document).ok());
  }

  static void WaitForTasks(Workspace& workspace) {
    do {
      workspace.Update(0.01);
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    } while (!workspace.tasks().entries().empty());
  }
};

TEST_F(TrainFromTest, APlaceWithAMapGoesOnAsItWasWhereTrainingFails) {
  AddPlace();
  ASSERT_TRUE(SaveMap(paths_, LoadProject(paths_)->places[0],
                      test::MakeSceneDatabase(test::MakeSyntheticWorld({})))
                  .ok());
  const auto workspace = Open();
  workspace->training().TrainFrom("site", "The site", Recording("second.mp4"));
  EXPECT_TRUE(workspace->AtLongWork());
  WaitForTasks(*workspace);
  EXPECT_FALSE(workspace->AtLongWork());
  EXPECT_EQ(workspace->project().place()->training.path, "first.mp4");
  EXPECT_FALSE(workspace->project().commands().dirty());
}

TEST_F(TrainFromTest, APlaceWithoutAMapNamesItsRecordingAtOnce) {
  const auto workspace = Open();
  workspace->training().TrainFrom("site", "The site", Recording("first.mp4"));
  ASSERT_NE(workspace->project().place(), nullptr);
  EXPECT_EQ(workspace->project().place()->training.path, "first.mp4");
  WaitForTasks(*workspace);
  workspace->training().TrainFrom("site", "The site", Recording("second.mp4"));
  EXPECT_EQ(workspace->project().place()->training.path, "second.mp4");
  WaitForTasks(*workspace);
  workspace->project().Undo();
  EXPECT_EQ(workspace->project().place()->training.path, "first.mp4");
}

TEST_F(WorkspaceTest, PlaysTheDramaInALoopWithoutARecording) {
  const auto workspace = Open();
  ASSERT_TRUE(workspace->project().EditTimeline(Sentence("add"), [](drama::TimelineText& text) {
    LARARIUM_RETURN_IF_ERROR(text.AddLane(drama::LaneKind::kMarkers, "").status());
    return text.Insert(0, {{"at", 3.0}, {"name", "end"}}).status();
  }));
  EXPECT_EQ(workspace->playback().duration(), 3.0);
  workspace->playback().SetPlaying(true);
  workspace->Update(2.0);
  EXPECT_NEAR(workspace->playback().time(), 2.0, 1e-9);
  workspace->Update(2.0);
  EXPECT_EQ(workspace->playback().time(), 0.0);
  workspace->playback().SetTime(-1.0);
  EXPECT_EQ(workspace->playback().time(), 0.0);
}

TEST_F(WorkspaceTest, AnotherPlaceIsShownAtTheSameMomentAndARemovedOneGivesWay) {
  ProjectDocument document = *LoadProject(paths_);
  document.places.resize(2);
  document.places[0].name = "maquette";
  document.places[1].name = "site";
  ASSERT_TRUE(SaveProject(paths_, document).ok());
  const auto workspace = Open();
  ASSERT_EQ(workspace->project().place()->name, "maquette");
  workspace->playback().SetTime(3.0);
  workspace->project().SelectPlace("site");
  EXPECT_EQ(workspace->project().place()->name, "site");
  EXPECT_EQ(workspace->playback().time(), 3.0);
  const auto remove = [&](const std::string& name) {
    workspace->project().Edit(Sentence("remove"), [&](ProjectDocument& edited) {
      std::erase_if(edited.places, [&](const auto& place) { return place.name == name; });
    });
  };
  remove("site");
  ASSERT_NE(workspace->project().place(), nullptr);
  EXPECT_EQ(workspace->project().place()->name, "maquette");
  remove("maquette");
  EXPECT_EQ(workspace->project().place(), nullptr);
  EXPECT_EQ(workspace->map().loaded().database, nullptr);
  workspace->project().Undo();
  ASSERT_NE(workspace->project().place(), nullptr);
  EXPECT_EQ(workspace->project().place()->name, "maquette");
}

TEST_F(WorkspaceTest, ARemovedSessionIsGoneFromMapAndDocumentAndNoUndoBringsItBack) {
  vision::SceneDatabase map = test::MakeSceneDatabase(test::MakeSyntheticWorld({}));
  for (size_t k = 0; k < map.keyframes.size(); ++k) {
    map.keyframes[k].session = static_cast<uint32_t>(k % 2);
  }
  ProjectDocument document = *LoadProject(paths_);
  document.places.resize(1);
  document.places[0].name = "site";
  ASSERT_TRUE(SaveProject(paths_, document).ok());
  ASSERT_TRUE(SaveMap(paths_, document.places[0], map).ok());
  const auto workspace = Open();
  workspace->project().EditPlace(Sentence("add a session"), [](PlaceDocument& place) {
    place.added.push_back({{SourceDocument::Kind::kVideo, "evening.mp4"}, {}});
  });
  workspace->project().EditPlace(Sentence("nudge"),
                                 [](PlaceDocument& place) { place.camera_nudge.x() = 0.1; });
  workspace->project().Undo();
  workspace->training().RemoveSession(1);
  while (workspace->tasks().Running(TaskKind::kTraining)) {
    workspace->Update(0.01);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_TRUE(workspace->project().place()->added.empty())
      << workspace->messages().entries().back().text;
  EXPECT_EQ(LoadMap(paths_, "site")->keyframes.size(), 6u);
  workspace->project().Redo();
  EXPECT_EQ(workspace->project().place()->camera_nudge.x(), 0.1);
  EXPECT_TRUE(workspace->project().place()->added.empty());
  workspace->project().Undo();
  workspace->project().Undo();
  EXPECT_TRUE(workspace->project().place()->added.empty());
  workspace->project().Redo();
  EXPECT_TRUE(workspace->project().place()->added.empty());
}

TEST_F(WorkspaceTest, TheFormerMapIsPutBackWithWhatItWasMadeOfAndDoingSoAgainUndoesIt) {
  ProjectDocument document = *LoadProject(paths_);
  PlaceDocument& place = document.places.emplace_back();
  place.name = "site";
  const auto take = [&](const std::string& video, int points) {
    PlaceRecordings recordings;
    recordings.training = {SourceDocument::Kind::kVideo, video};
    ASSERT_TRUE(TakeMap(paths_, place, recordings,
                        test::MakeSceneDatabase(test::MakeSyntheticWorld({.points = points})))
                    .ok());
    SetRecordings(recordings, place);
  };
  take("first.mp4", 20);
  take("second.mp4", 30);
  ASSERT_TRUE(SaveProject(paths_, document).ok());
  const auto workspace = Open();
  workspace->project().EditPlace(Sentence("nudge"),
                                 [](PlaceDocument& p) { p.camera_nudge.x() = 0.1; });
  workspace->training().RestorePreviousMap();
  EXPECT_EQ(LoadMap(paths_, "site")->points.size(), 20u)
      << workspace->messages().entries().back().text;
  EXPECT_EQ(workspace->project().place()->training.path, "first.mp4");
  workspace->project().Undo();
  EXPECT_EQ(workspace->project().place()->camera_nudge.x(), 0.0);
  EXPECT_EQ(workspace->project().place()->training.path, "first.mp4") << "as the map's file is";
  workspace->training().RestorePreviousMap();
  EXPECT_EQ(LoadMap(paths_, "site")->points.size(), 30u);
  EXPECT_EQ(workspace->project().place()->training.path, "second.mp4");
}

TEST_F(WorkspaceTest, WithoutAFormerMapPuttingItBackIsAMessage) {
  ProjectDocument document = *LoadProject(paths_);
  document.places.emplace_back().name = "site";
  ASSERT_TRUE(SaveProject(paths_, document).ok());
  const auto workspace = Open();
  workspace->training().RestorePreviousMap();
  EXPECT_THAT(workspace->messages().entries().back().text, HasSubstr("has no former map"));
}

TEST_F(WorkspaceTest, AFailedExportIsAMessageAndWritesNothing) {
  const auto workspace = Open();
  const std::filesystem::path out = folder_ / "show.larshow";
  workspace->jobs().Export({.out = out});
  while (!workspace->tasks().entries().empty()) {
    workspace->Update(0.01);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_EQ(workspace->messages().entries().back().level, Message::Level::kError);
  EXPECT_FALSE(std::filesystem::exists(out));
}

TEST_F(WorkspaceTest, LinesAreWrittenAMomentAfterTheyWereEditedAndUndoWritesThemBack) {
  const auto workspace = Open();
  ASSERT_NE(workspace->project().document().lines, nullptr);
  const auto in_file = [&] { return bake::LoadLines(paths_.folder); };
  workspace->project().EditLines(Sentence("write"), WithText({}, "hail", "keeper", "la", "Salve"));
  workspace->Update(0.1);
  EXPECT_TRUE(in_file()->lines.empty()) << "whoever types goes on";
  workspace->Update(2.0);
  workspace->Update(0.0);
  ASSERT_EQ(in_file()->lines.size(), 1u);
  workspace->project().Undo();
  workspace->project().Save();
  EXPECT_TRUE(in_file()->lines.empty());
  workspace->project().Redo();
  workspace->project().Save();
  EXPECT_EQ(in_file()->lines.size(), 1u);
}

TEST_F(WorkspaceTest, LinesThatATranslatorWritesAreTakenOverAsAnEdit) {
  const auto workspace = Open();
  ASSERT_TRUE(bake::SaveLines(paths_.folder, WithText({}, "hail", "keeper", "it", "Salve")).ok());
  workspace->project().Save();
  ASSERT_NE(workspace->project().document().lines->Find("hail"), nullptr);
  workspace->project().Undo();
  EXPECT_EQ(workspace->project().document().lines->Find("hail"), nullptr);
}

TEST_F(WorkspaceTest, LinesThatOthersLeftDamagedAreNotWrittenOver) {
  const auto workspace = Open();
  workspace->project().EditLines(Sentence("write"), WithText({}, "hail", "keeper", "la", "Salve"));
  workspace->project().Save();
  const std::string damaged = "id,speaker,notes,la\nhail,keeper,,\"half a";
  ASSERT_TRUE(WriteFileAtomically(paths_.folder / "lines.csv", damaged).ok());
  workspace->project().Save();
  workspace->Update(2.0);
  EXPECT_EQ(*ReadText(paths_.folder / "lines.csv"), damaged);
  EXPECT_THAT(workspace->messages().entries().back().text, testing::Not(testing::IsEmpty()));
}

TEST_F(WorkspaceTest, LinesThatATranslatorSavedJustNowAreNotWrittenOver) {
  const auto workspace = Open();
  workspace->project().EditLines(Sentence("write"), WithText({}, "hail", "keeper", "la", "Salve"));
  ASSERT_TRUE(bake::SaveLines(paths_.folder, WithText({}, "part", "keeper", "la", "Vale")).ok());
  workspace->Update(0.9);
  workspace->Update(0.9);
  EXPECT_NE(bake::LoadLines(paths_.folder)->Find("part"), nullptr);
  EXPECT_NE(workspace->project().document().lines->Find("part"), nullptr);
  workspace->project().Undo();
  EXPECT_NE(workspace->project().document().lines->Find("hail"), nullptr)
      << "what was typed is not lost";
}

TEST_F(WorkspaceTest, LinesThatCouldNotBeReadBackAreAMessageAndNoEdit) {
  const auto workspace = Open();
  const auto before = workspace->project().document().lines;
  workspace->project().EditLines(Sentence("write"), WithText({}, "no id", "keeper", "la", "Salve"));
  EXPECT_THAT(workspace->messages().entries().back().text,
              HasSubstr("'no id' cannot be a line's id"));
  workspace->project().EditLines(Sentence("write"),
                                 WithText({}, "hail", "keeper", "la", std::string(5000, 'a')));
  EXPECT_THAT(workspace->messages().entries().back().text, HasSubstr("longer than 4000 bytes"));
  EXPECT_EQ(workspace->project().document().lines, before);
  EXPECT_FALSE(workspace->project().commands().CanUndo());
}

// A project after the editor was killed while lines were typed, before their file was written.
class KilledWhileLinesWereTyped : public WorkspaceTest {
 protected:
  KilledWhileLinesWereTyped() {
    const std::filesystem::path aside = folder_ / "journal";
    {
      const auto workspace = Open();
      workspace->project().EditLines(Sentence("write"),
                                     WithText({}, "hail", "keeper", "la", "Salve"));
      std::filesystem::copy_file(paths_.Journal(), aside);
    }
    std::filesystem::remove(paths_.folder / "lines.csv");
    std::filesystem::copy_file(aside, paths_.Journal(),
                               std::filesystem::copy_options::overwrite_existing);
  }
};

TEST_F(KilledWhileLinesWereTyped, RecoversThemAndUndoTakesThemBack) {
  const auto workspace = Open();
  EXPECT_THAT(workspace->messages().entries().front().text, HasSubstr("recovered"));
  EXPECT_NE(workspace->project().document().lines->Find("hail"), nullptr);
  workspace->Update(2.0);
  workspace->Update(0.0);
  EXPECT_NE(bake::LoadLines(paths_.folder)->Find("hail"), nullptr) << "their file follows";
  workspace->project().Undo();
  EXPECT_TRUE(workspace->project().document().lines->lines.empty());
}

TEST_F(KilledWhileLinesWereTyped, WhatATranslatorWroteSinceStaysAndUndoBringsBackWhatWasTyped) {
  ASSERT_TRUE(bake::SaveLines(paths_.folder, WithText({}, "part", "keeper", "la", "Vale")).ok());
  const auto workspace = Open();
  EXPECT_NE(workspace->project().document().lines->Find("part"), nullptr);
  workspace->Update(2.0);
  EXPECT_NE(bake::LoadLines(paths_.folder)->Find("part"), nullptr);
  workspace->project().Undo();
  EXPECT_NE(workspace->project().document().lines->Find("hail"), nullptr);
}

TEST_F(KilledWhileLinesWereTyped, ADamagedFileOfLinesIsLeftAsItIs) {
  const std::string damaged = "id,speaker,notes,la\nhail,keeper,,\"half a";
  ASSERT_TRUE(WriteFileAtomically(paths_.folder / "lines.csv", damaged).ok());
  const auto workspace = Open();
  EXPECT_EQ(workspace->project().document().lines, nullptr);
  workspace->Update(2.0);
  EXPECT_EQ(*ReadText(paths_.folder / "lines.csv"), damaged);
  workspace->project().Undo();
  EXPECT_NE(workspace->project().document().lines->Find("hail"), nullptr);
}

TEST_F(WorkspaceTest, LinesThatReachedTheirFileAreNotRecoveredAgain) {
  Open()->project().EditLines(Sentence("write"), WithText({}, "hail", "keeper", "la", "Salve"));
  const auto workspace = Open();
  EXPECT_TRUE(workspace->messages().entries().empty())
      << workspace->messages().entries().front().text;
  EXPECT_FALSE(workspace->project().commands().CanUndo());
  EXPECT_FALSE(std::filesystem::exists(paths_.Journal()));
}

TEST_F(WorkspaceTest, EditedLinesOutliveTheWindow) {
  Open()->project().EditLines(Sentence("write"), WithText({}, "hail", "keeper", "la", "Salve"));
  EXPECT_NE(Open()->project().document().lines->Find("hail"), nullptr);
}

}  // namespace
}  // namespace lararium::editor
