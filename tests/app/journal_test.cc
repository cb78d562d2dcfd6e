#include "editor/app/journal.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "editor/app/workspace.h"
#include "shared/core/file.h"
#include "shared/core/random.h"
#include "tests/support/test_files.h"

namespace lararium::app {
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
  JournalContent MustLoad() {
    Result<std::optional<JournalContent>> content = LoadJournal(file_);
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

TEST_F(JournalTest, KeepsBytesThatAreNoText) {
  const std::string bytes("\xff\xfe\n\0x\n", 6);
  Journal journal(file_, Titled("saved"), Script(bytes));
  ASSERT_TRUE(journal.NoteScript({1, bytes.substr(1, 2), "\xc3\n7 9\n"}).ok());
  EXPECT_EQ(MustLoad().script, "\xff\xc3\n7 9\n" + bytes.substr(3));
}

TEST_F(JournalTest, WhereverItIsCutOffWhatLiesBeforeIsThere) {
  {
    Journal journal(file_, Titled("saved"), Script("abc"));
    ASSERT_TRUE(journal.NoteScript({3, "", "d"}).ok());
    ASSERT_TRUE(journal.NoteProject(Titled("edited")).ok());
    ASSERT_TRUE(journal.NoteScript({4, "", "e"}).ok());
  }
  const Result<std::string> whole = ReadText(file_);
  ASSERT_TRUE(whole.ok());
  int least = 3;
  for (size_t size = whole->size(); size > 0; --size) {
    ASSERT_TRUE(WriteFileAtomically(file_, std::string_view(*whole).substr(0, size)).ok());
    const auto content = LoadJournal(file_);
    if (!content.ok()) {
      EXPECT_THAT(content.message(), HasSubstr("journal"));
      continue;  // cut off within its beginning
    }
    const JournalContent& left = **content;
    EXPECT_LE(left.edits, least);
    EXPECT_GE(left.edits, least - 1) << "one record at a time";
    least = left.edits;
    EXPECT_EQ(left.script, left.edits == 3 ? "abcde" : left.edits == 0 ? "abc" : "abcd");
    EXPECT_EQ(left.project.title, left.edits >= 2 ? "edited" : "saved");
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
    const auto content = LoadJournal(file_);
    if (content.ok()) {
      EXPECT_THAT((*content)->script, testing::AnyOf("abc", "abcd"));
      EXPECT_EQ((*content)->project.title, "saved");
    }
  }
}

// ---- a whole editor that is killed ----

// Edits the project for ever, in an order that follows from the seed, and says on a pipe
// which edit is done. After edit n the title is "n" and the script ends in "-- n".
[[noreturn]] void EditForEver(const ProjectPaths& paths, uint64_t seed, int pipe) {
  const std::shared_ptr<Log> log = MakeSilentLog();
  Result<std::unique_ptr<Workspace>> workspace = Workspace::Open(paths, *log);
  if (!workspace.ok()) {
    ::_exit(1);
  }
  Random random(seed);
  for (int32_t n = 1;; ++n) {
    const std::string number = std::to_string(n);
    if (random.Below(2) == 0) {
      (*workspace)->Edit("title", [&](ProjectDocument& d) { d.title = number; });
    } else {
      (*workspace)->EditScript("script", "track{markers = {{at = " + number + ", name = 'm'}}}");
    }
    const uint32_t also = random.Below(40);
    if (also == 0) {
      (*workspace)->Save();
    } else if (also < 4) {
      (*workspace)->Undo();
      (*workspace)->Redo();
    }
    if (::write(pipe, &n, sizeof(n)) != sizeof(n)) {
      ::_exit(0);
    }
  }
}

struct Edited {
  std::string title;
  std::string script;
};

// What is there after n edits.
Edited After(int32_t count, uint64_t seed, const Edited& before) {
  Random random(seed);
  Edited edited = before;
  for (int32_t n = 1; n <= count; ++n) {
    const std::string number = std::to_string(n);
    if (random.Below(2) == 0) {
      edited.title = number;
    } else {
      edited.script = "track{markers = {{at = " + number + ", name = 'm'}}}";
    }
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
      before = {(*workspace)->document().title, (*workspace)->script().text()};
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
    // At any moment from before its first edit on.
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
    const Edited now = {(*workspace)->document().title, (*workspace)->script().text()};
    // All that was said to be done, and perhaps the one at work.
    const Edited expected = After(done, seed, before);
    const Edited one_more = After(done + 1, seed, before);
    const bool as_done = now.title == expected.title && now.script == expected.script;
    const bool as_one_more = now.title == one_more.title && now.script == one_more.script;
    // An undo that was not redone yet: the edit before the one at work.
    const Edited one_less = After(std::max(done - 1, 0), seed, before);
    const bool undone = now.title == one_less.title && now.script == one_less.script;
    EXPECT_TRUE(as_done || as_one_more || undone)
        << "kill " << kill << " after " << done << " edits: \"" << now.title << "\" " << now.script;
    recovered += done > 0 ? 1 : 0;
    // What was recovered stays recovered: nobody has saved it.
  }
  EXPECT_GT(recovered, kKills / 4) << "too few kills hit an editor at work";
}

}  // namespace
}  // namespace lararium::app
