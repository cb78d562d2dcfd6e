#include "editor/document/journal.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "editor/document/line_edits.h"
#include "editor/session/workspace.h"
#include "shared/core/file.h"
#include "shared/core/random.h"
#include "tests/support/test_files.h"

namespace lararium::editor {
namespace {

using testing::HasSubstr;

class JournalTest : public testing::Test {
 protected:
  static ProjectDocument Titled(const std::string& title) {
    ProjectDocument document;
    document.title = title;
    return document;
  }
  static std::shared_ptr<const std::string> Script(std::string text) {
    return std::make_shared<const std::string>(std::move(text));
  }
  static std::shared_ptr<const bake::LineTable> Saying(const std::string& text) {
    return std::make_shared<const bake::LineTable>(WithText({}, "hail", "keeper", "la", text));
  }
  static ProjectDocument TitledAndSaying(const std::string& title, const std::string& text) {
    ProjectDocument document = Titled(title);
    document.lines = Saying(text);
    return document;
  }
  JournalContent MustLoad(const bake::LineTable* in_file = nullptr) {
    Result<std::optional<JournalContent>> content = LoadJournal(file_, in_file);
    CHECK(content.ok());
    CHECK(content->has_value());
    return std::move(**content);
  }

  test::TemporaryFolder folder_;
  std::filesystem::path file_ = folder_ / "journal";
};

TEST_F(JournalTest, HoldsEachEditAtOnce) {
  Journal journal(file_, Titled("saved"), Script("one"));
  EXPECT_FALSE(std::filesystem::exists(file_)) << "nothing was edited";
  ASSERT_TRUE(journal.NoteProject(Titled("edited")).ok());
  EXPECT_EQ(MustLoad().project.title, "edited");
  EXPECT_EQ(MustLoad().script, "one");
  ASSERT_TRUE(journal.NoteScript({3, "", " two"}).ok());
  ASSERT_TRUE(journal.NoteScript({0, "one", "1"}).ok());
  EXPECT_EQ(MustLoad().script, "1 two");
  EXPECT_EQ(MustLoad().edits, 3);
  EXPECT_FALSE(MustLoad().torn);
  journal.Discard(Titled("edited"), Script("1 two"));
  EXPECT_FALSE(std::filesystem::exists(file_));
  ASSERT_TRUE(journal.NoteScript({0, "1", "once"}).ok());
  EXPECT_EQ(MustLoad().project.title, "edited");
  EXPECT_EQ(MustLoad().script, "once two");
}

TEST_F(JournalTest, HoldsTheLastStepOfAGestureAndWhatFollowsIt) {
  const auto step = [](int n) {
    return std::make_shared<const ProjectDocument>(Titled(std::to_string(n)));
  };
  {
    Journal journal(file_, Titled("saved"), Script("one"));
    for (int n = 1; n <= 100; ++n) {
      ASSERT_TRUE(journal.NoteGesture(step(n)).ok());
    }
    ASSERT_TRUE(journal.NoteScript({3, "", " two"}).ok());
  }
  EXPECT_EQ(MustLoad().project.title, "100");
  EXPECT_EQ(MustLoad().script, "one two");
  std::filesystem::remove(file_);
  Journal journal(file_, Titled("saved"), Script("one"));
  for (int round = 0; round < 50; ++round) {
    ASSERT_TRUE(journal.NoteGesture(step(round)).ok());
    ASSERT_TRUE(journal.NoteProject(Titled("undone")).ok());
    EXPECT_EQ(MustLoad().project.title, "undone") << "no step is written behind a later edit";
  }
  ASSERT_TRUE(journal.NoteGesture(step(1)).ok());
  journal.Discard(Titled("1"), Script("one"));
  EXPECT_FALSE(std::filesystem::exists(file_));
}

TEST_F(JournalTest, AStepOfAGestureReachesTheFileWithoutALaterCall) {
  Journal journal(file_, Titled("saved"), Script("one"));
  ASSERT_TRUE(journal.NoteGesture(std::make_shared<const ProjectDocument>(Titled("dragged"))).ok());
  for (int wait = 0; wait < 10'000 && !std::filesystem::exists(file_); ++wait) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  // The file appears before its first record.
  for (int wait = 0; wait < 10'000 && MustLoad().edits == 0; ++wait) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_EQ(MustLoad().project.title, "dragged");
}

TEST_F(JournalTest, HoldsEachEditOfTheLinesAtOnce) {
  Journal journal(file_, TitledAndSaying("saved", "Salve"), Script("one"));
  ASSERT_TRUE(journal.NoteProject(TitledAndSaying("saved", "Salve, \"hospes\"\nmi")).ok());
  EXPECT_EQ(*MustLoad().project.lines, *Saying("Salve, \"hospes\"\nmi"));
  EXPECT_EQ(MustLoad().edits, 1);
  ASSERT_TRUE(journal.NoteProject(TitledAndSaying("edited", "Vale")).ok());
  EXPECT_EQ(*MustLoad().project.lines, *Saying("Vale"));
  EXPECT_EQ(MustLoad().project.title, "edited");
  EXPECT_EQ(MustLoad().edits, 3) << "of the project and of the lines";
  ASSERT_TRUE(journal.NoteProject(Titled("edited")).ok());
  EXPECT_EQ(*MustLoad().project.lines, *Saying("Vale")) << "a table that cannot be read is no edit";
  ASSERT_TRUE(journal.Restart(TitledAndSaying("edited", "Vale"), Script("one")).ok());
  EXPECT_EQ(*MustLoad().project.lines, *Saying("Vale"));
  EXPECT_GT(MustLoad().edits, 0) << "what it begins with was never saved";
}

TEST_F(JournalTest, LinesThatCameLaterAreHeldWithTheirEdits) {
  Journal journal(file_, Titled("saved"), Script("one"));
  ASSERT_TRUE(journal.NoteProject(TitledAndSaying("saved", "Salve")).ok());
  EXPECT_EQ(MustLoad().edits, 0) << "they are as in their file";
  ASSERT_TRUE(journal.NoteProject(TitledAndSaying("saved", "Vale")).ok());
  EXPECT_EQ(*MustLoad().project.lines, *Saying("Vale"));
  EXPECT_EQ(MustLoad().edits, 1);
}

TEST_F(JournalTest, KnowsWhetherSomebodyElseWroteTheLines) {
  Journal journal(file_, TitledAndSaying("saved", "Salve"), Script("one"));
  ASSERT_TRUE(journal.NoteProject(TitledAndSaying("saved", "Salvete")).ok());
  ASSERT_TRUE(journal.NoteProject(TitledAndSaying("saved", "Vale")).ok());
  for (const char* ours : {"Salve", "Salvete", "Vale"}) {
    EXPECT_TRUE(MustLoad(Saying(ours).get()).lines_are_ours) << ours;
  }
  EXPECT_FALSE(MustLoad(Saying("Ave").get()).lines_are_ours);
  EXPECT_FALSE(MustLoad(nullptr).lines_are_ours) << "their file cannot be read";
}

TEST_F(JournalTest, RefusesOtherVersions) {
  {
    Journal journal(file_, Titled("saved"), Script("abc"));
    ASSERT_TRUE(journal.NoteProject(Titled("edited")).ok());
  }
  std::string text = *ReadText(file_);
  ASSERT_TRUE(text.starts_with("lararium journal 2\n"));
  for (const char* other : {"lararium journal 1\n", "lararium journal 3\n"}) {
    text.replace(0, 19, other);
    ASSERT_TRUE(WriteFileAtomically(file_, text).ok());
    EXPECT_THAT(LoadJournal(file_, nullptr).message(), HasSubstr("not written by this version"));
  }
}

TEST_F(JournalTest, TheFuzzersSeedsAreWholeJournals) {
  const std::filesystem::path seeds = test::SourceDir() / "tests/fuzz";
  const auto first = LoadJournal(seeds / "journal_1", nullptr);
  ASSERT_TRUE(first.ok() && first->has_value()) << first.message();
  EXPECT_EQ((*first)->edits, 2);
  EXPECT_FALSE((*first)->torn);
  const auto second = LoadJournal(seeds / "journal_2", nullptr);
  ASSERT_TRUE(second.ok() && second->has_value()) << second.message();
  EXPECT_EQ((*second)->edits, 4);
  EXPECT_EQ(*(*second)->project.lines, *Saying("Vale, hospes"));
}

TEST_F(JournalTest, KeepsBytesThatAreNoText) {
  const std::string bytes("\xff\xfe\n\0x\n", 6);
  Journal journal(file_, Titled("saved"), Script(bytes));
  ASSERT_TRUE(journal.NoteScript({1, bytes.substr(1, 2), "\xc3\n7 9\n"}).ok());
  EXPECT_EQ(MustLoad().script, "\xff\xc3\n7 9\n" + bytes.substr(3));
}

TEST_F(JournalTest, WhereverItIsCutOffWhatLiesBeforeIsThere) {
  {
    Journal journal(file_, TitledAndSaying("saved", "Salve"), Script("abc"));
    ASSERT_TRUE(journal.NoteScript({3, "", "d"}).ok());
    ASSERT_TRUE(journal.NoteProject(TitledAndSaying("edited", "Salve")).ok());
    ASSERT_TRUE(journal.NoteProject(TitledAndSaying("edited", "Salvete")).ok());
    ASSERT_TRUE(journal.NoteScript({4, "", "e"}).ok());
  }
  const Result<std::string> whole = ReadText(file_);
  ASSERT_TRUE(whole.ok());
  int least = 4;
  for (size_t size = whole->size(); size > 0; --size) {
    ASSERT_TRUE(WriteFileAtomically(file_, std::string_view(*whole).substr(0, size)).ok());
    const auto content = LoadJournal(file_, nullptr);
    if (!content.ok()) {
      EXPECT_THAT(content.message(), HasSubstr("journal"));
      continue;  // Truncated within its beginning.
    }
    const JournalContent& left = **content;
    EXPECT_LE(left.edits, least);
    EXPECT_GE(left.edits, least - 1) << "one record at a time";
    least = left.edits;
    EXPECT_EQ(left.script, left.edits == 4 ? "abcde" : left.edits == 0 ? "abc" : "abcd");
    EXPECT_EQ(left.project.title, left.edits >= 2 ? "edited" : "saved");
    if (left.edits > 0) {
      EXPECT_EQ(*left.project.lines, *Saying(left.edits >= 3 ? "Salvete" : "Salve"));
    }
  }
  EXPECT_EQ(least, 0);
}

TEST_F(JournalTest, ADamagedByteIsNeverTakenForAnEdit) {
  {
    Journal journal(file_, Titled("saved"), Script("abc"));
    ASSERT_TRUE(journal.NoteScript({3, "", "d"}).ok());
  }
  const Result<std::string> whole = ReadText(file_);
  ASSERT_TRUE(whole.ok());
  for (size_t i = 0; i < whole->size(); ++i) {
    std::string damaged = *whole;
    damaged[i] = static_cast<char>(damaged[i] ^ 0x15);
    ASSERT_TRUE(WriteFileAtomically(file_, damaged).ok());
    const auto content = LoadJournal(file_, nullptr);
    if (content.ok()) {
      EXPECT_THAT((*content)->script, testing::AnyOf("abc", "abcd"));
      EXPECT_EQ((*content)->project.title, "saved");
    }
  }
}

// ---- An editor process that is killed ----

// The parts of the project that the test edits.
struct Edited {
  std::string title;
  std::string script;
  std::string line;

  friend bool operator==(const Edited&, const Edited&) = default;
};

constexpr uint32_t kWays = 3;  // The number of kinds of edits.

// The text that an edit of this kind changes: edit n writes n into it.
std::string& Written(Edited& edited, uint32_t way) {
  return way == 0 ? edited.title : way == 1 ? edited.script : edited.line;
}
std::string WhatEditWrites(int32_t n, uint32_t way) {
  const std::string number = std::to_string(n);
  return way == 1 ? "track{markers = {{at = " + number + ", name = 'm'}}}" : number;
}

Edited WhatIsIn(const Workspace& workspace) {
  const bake::Line* line = workspace.project().document().lines->Find("hail");
  return {workspace.project().document().title, workspace.project().script().text(),
          line == nullptr ? "" : line->text.find("la")->second};
}

// Edits the project in an endless loop, in an order that depends on the seed, and writes the number
// of each finished edit to a pipe.
[[noreturn]] void EditForEver(const ProjectPaths& paths, uint64_t seed, int pipe) {
  const std::shared_ptr<Log> log = MakeSilentLog();
  Result<std::unique_ptr<Workspace>> workspace = Workspace::Open(paths, *log);
  if (!workspace.ok()) {
    ::_exit(1);
  }
  Random random(seed);
  for (int32_t n = 1;; ++n) {
    const uint32_t way = random.Below(kWays);
    const std::string text = WhatEditWrites(n, way);
    if (way == 0) {
      (*workspace)->project().Edit(Sentence("title"), [&](ProjectDocument& d) { d.title = text; });
    } else if (way == 1) {
      (*workspace)->project().EditScript(Sentence("script"), text);
    } else {
      (*workspace)
          ->project()
          .EditLines(Sentence("line"), WithText(*(*workspace)->project().document().lines, "hail",
                                                "keeper", "la", text));
    }
    const uint32_t also = random.Below(40);
    if (also == 0) {
      (*workspace)->project().Save();
    } else if (also < 4) {
      (*workspace)->project().Undo();
      (*workspace)->project().Redo();
    } else if (also < 8) {
      (*workspace)->Update(1.5);  // Writes the file of lines.
    }
    if (::write(pipe, &n, sizeof(n)) != sizeof(n)) {
      ::_exit(0);
    }
  }
}

// The content after n edits.
Edited After(int32_t count, uint64_t seed, const Edited& before) {
  Random random(seed);
  Edited edited = before;
  for (int32_t n = 1; n <= count; ++n) {
    const uint32_t way = random.Below(kWays);
    Written(edited, way) = WhatEditWrites(n, way);
    random.Below(40);
  }
  return edited;
}

TEST(KilledEditor, LosesAtMostTheLastEdit) {
  constexpr int kKills = 200;
  test::TemporaryFolder folder;
  const ProjectPaths paths{folder / "show.lararium"};
  ASSERT_TRUE(CreateProject(paths, "0").ok());
  const std::shared_ptr<Log> log = MakeSilentLog();
  Random random(7);
  int recovered = 0;
  for (int kill = 0; kill < kKills; ++kill) {
    const uint64_t seed = 100 + static_cast<uint64_t>(kill);
    Edited before;
    {
      const auto workspace = Workspace::Open(paths, *log);
      ASSERT_TRUE(workspace.ok()) << workspace.message();
      before = WhatIsIn(**workspace);
    }
    int ends[2];
    ASSERT_EQ(::pipe(ends), 0);
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      ::close(ends[0]);
      EditForEver(paths, seed, ends[1]);
    }
    ::close(ends[1]);
    // Kills at any time, also before the first edit.
    std::this_thread::sleep_for(std::chrono::microseconds(random.Below(60'000)));
    ::kill(child, SIGKILL);
    ASSERT_EQ(::waitpid(child, nullptr, 0), child);
    int32_t done = 0;
    for (int32_t n = 0; ::read(ends[0], &n, sizeof(n)) == sizeof(n);) {
      done = n;
    }
    ::close(ends[0]);

    const auto workspace = Workspace::Open(paths, *log);
    ASSERT_TRUE(workspace.ok()) << workspace.message();
    const Edited now = WhatIsIn(**workspace);
    // The content has all reported edits, and possibly the next one.
    const bool as_done = now == After(done, seed, before);
    const bool as_one_more = now == After(done + 1, seed, before);
    // An undo that was not redone yet: the content before the current edit.
    const bool undone = now == After(std::max(done - 1, 0), seed, before);
    EXPECT_TRUE(as_done || as_one_more || undone)
        << "kill " << kill << " after " << done << " edits: \"" << now.title << "\" " << now.script
        << " " << now.line;
    recovered += done > 0 ? 1 : 0;
    // The recovered content stays unsaved for the next round.
  }
  EXPECT_GT(recovered, kKills / 4) << "too few kills hit an editor at work";
}

}  // namespace
}  // namespace lararium::editor
