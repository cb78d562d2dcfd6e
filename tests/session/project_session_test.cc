#include "editor/session/project_session.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "shared/core/file.h"
#include "tests/support/test_files.h"

namespace lararium::editor {
namespace {

using testing::ElementsAre;
using Event = ProjectSession::Event;

// A project that is opened without the other parts of a workspace.
class ProjectSessionTest : public testing::Test {
 protected:
  ProjectSessionTest() { CHECK(CreateProject(paths_, "Before").ok()); }

  std::unique_ptr<ProjectSession> Open() {
    Result<std::unique_ptr<ProjectSession>> project = ProjectSession::Open(paths_, messages_);
    CHECK(project.ok());
    return *std::move(project);
  }

  test::TemporaryFolder folder_;
  ProjectPaths paths_{folder_ / "show.lararium"};
  MessageLog messages_;
};

TEST_F(ProjectSessionTest, TellsObserversOfEditsAndOfThePlace) {
  const auto project = Open();
  std::vector<Event> events;
  project->Subscribe([&](Event event) { events.push_back(event); });
  project->Edit(Sentence("add"),
                [](ProjectDocument& document) { document.places.emplace_back().name = "site"; });
  EXPECT_EQ(project->place_name(), "site");
  EXPECT_THAT(events, ElementsAre(Event::kPlaceSelected, Event::kEdited));
  events.clear();
  project->EditScript(Sentence("type"), "-- one\n");
  EXPECT_TRUE(events.empty()) << "the script has a revision";
  project->Undo();
  EXPECT_THAT(events, ElementsAre(Event::kEdited));
}

TEST_F(ProjectSessionTest, NamesOfEditsAreSentencesThatAreTranslatedWhenTheyAreShown) {
  const auto project = Open();
  project->Edit(Sentence("remove %s", {std::string("chair")}),
                [](ProjectDocument& document) { document.title = "Without"; });
  EXPECT_EQ(project->commands().undo_name().English(), "remove chair");
  const auto italian = [](const char*) { return "togli %s"; };
  EXPECT_EQ(project->commands().undo_name().Translated(italian), "togli chair");
}

TEST_F(ProjectSessionTest, TheStepsOfADragAreRecoveredAfterACrash) {
  {
    const auto project = Open();
    for (int step = 1; step <= 20; ++step) {
      project->Edit(
          Sentence("drag"),
          [&](ProjectDocument& document) { document.title = std::to_string(step); }, "drag");
    }
    project->EditScript(Sentence("type"), "-- after\n");
  }  // The journal is written when the project is closed, at the latest.
  EXPECT_EQ(Open()->document().title, "20");
}

TEST_F(ProjectSessionTest, FilesKnowWhatOtherProgramsWrote) {
  ProjectFiles files(paths_, std::make_shared<const std::string>(*ReadText(paths_.Drama())),
                     std::make_shared<const ProjectDocument>(*LoadProject(paths_)), messages_);
  const auto here = std::make_shared<const std::string>("-- here\n");
  ProjectDocument document = *LoadProject(paths_);
  EXPECT_FALSE(files.Hold(*here, document));
  ASSERT_TRUE(WriteFileAtomically(paths_.Drama(), std::string_view("-- theirs\n")).ok());
  files.DetectChanges(here, document);
  EXPECT_TRUE(files.changed_outside());
  ASSERT_NE(files.TakeScript(), nullptr);
  EXPECT_FALSE(files.changed_outside());
  EXPECT_TRUE(files.Hold("-- theirs\n", document));
  ASSERT_TRUE(files.Save(here, std::make_shared<const ProjectDocument>(document)).ok());
  files.DetectChanges(here, document);
  EXPECT_FALSE(files.changed_outside()) << "the file is as this program wrote it";
  EXPECT_EQ(*ReadText(paths_.Drama()), "-- here\n");
}

}  // namespace
}  // namespace lararium::editor
