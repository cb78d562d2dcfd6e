// The portal's client against a portal of the test's own, on a bus of the test's own.

#include "editor/desktop/file_portal.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "tests/support/test_files.h"

namespace lararium::editor {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using Outcome = FileAnswer::Outcome;
using namespace std::chrono_literals;

constexpr auto kPatience = 10s;  // Longer than anything here takes on a busy machine.

// A program that is ended with this object.
class Program {
 public:
  explicit Program(std::vector<std::string> arguments) {
    std::array<int, 2> ends = {};
    EXPECT_EQ(pipe(ends.data()), 0);
    pid_ = fork();
    if (pid_ == 0) {
      dup2(ends[1], STDOUT_FILENO);
      close(ends[0]);
      close(ends[1]);
      std::vector<char*> argv;
      for (std::string& argument : arguments) {
        argv.push_back(argument.data());
      }
      argv.push_back(nullptr);
      execvp(argv[0], argv.data());
      _exit(127);
    }
    close(ends[1]);
    out_.reset(fdopen(ends[0], "r"));
    setvbuf(out_.get(), nullptr, _IONBF, 0);  // A line that poll() does not see is none.
  }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;
  ~Program() {
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }

  // The next line that it prints; empty at its end. Meanwhile the chooser's messages are handled.
  std::string Line(FilePortal* chooser = nullptr) {
    pollfd ready = {fileno(out_.get()), POLLIN, 0};
    while (chooser != nullptr && poll(&ready, 1, 2) == 0) {
      chooser->Update();
    }
    std::array<char, 4096> line = {};
    const bool any = std::fgets(line.data(), static_cast<int>(line.size()), out_.get()) != nullptr;
    std::string text = any ? line.data() : "";
    return text.ends_with('\n') ? text.substr(0, text.size() - 1) : text;
  }

 private:
  struct Close {
    void operator()(FILE* file) const { std::fclose(file); }
  };
  pid_t pid_ = -1;
  std::unique_ptr<FILE, Close> out_;
};

class FilePortalTest : public ::testing::Test {
 protected:
  void SetUp() override {
    const std::filesystem::path& folder = folder_.path();
    // Without the folders of services, so that no real portal is started.
    std::ofstream(folder / "bus.conf")
        << "<busconfig><type>session</type><listen>unix:dir=" << folder.string()
        << "</listen><auth>EXTERNAL</auth><policy context=\"default\">"
           "<allow send_destination=\"*\" eavesdrop=\"true\"/><allow eavesdrop=\"true\"/>"
           "<allow own=\"*\"/></policy></busconfig>";
    bus_ = std::make_unique<Program>(
        std::vector<std::string>{"dbus-daemon", "--config-file=" + (folder / "bus.conf").string(),
                                 "--nofork", "--print-address"});
    const std::string address = bus_->Line();
    if (address.empty()) {
      GTEST_SKIP() << "dbus-daemon is not installed";
    }
    setenv("DBUS_SESSION_BUS_ADDRESS", address.c_str(), 1);
  }
  void TearDown() override { setenv("DBUS_SESSION_BUS_ADDRESS", "disabled:", 1); }

  void StartPortal(const std::string& behaviour, const std::vector<std::string>& uris = {}) {
    std::vector<std::string> arguments = {LARARIUM_MOCK_PORTAL, behaviour};
    arguments.insert(arguments.end(), uris.begin(), uris.end());
    portal_ = std::make_unique<Program>(arguments);
    ASSERT_EQ(portal_->Line(), "ready");
  }

  static FileAnswer Await(FilePortal& chooser) {
    const auto end = std::chrono::steady_clock::now() + kPatience;
    while (std::chrono::steady_clock::now() < end) {
      chooser.Update();
      if (std::optional<FileAnswer> answer = chooser.TakeAnswer()) {
        return *answer;
      }
      std::this_thread::sleep_for(2ms);
    }
    ADD_FAILURE() << "no answer";
    return {};
  }

  // The answer of a portal with that behaviour to a plain request.
  FileAnswer AnswerOf(const std::string& behaviour, const std::vector<std::string>& uris = {}) {
    StartPortal(behaviour, uris);
    FilePortal chooser(timeout_);
    chooser.Open(Video(), "");
    return Await(chooser);
  }

  static FileRequest Video() {
    return {FileRequest::Kind::kFile, "Choose a video", {{"Videos", {".mp4"}}}, "/tmp", ""};
  }

  test::TemporaryFolder folder_;
  std::chrono::milliseconds timeout_ = 5s;
  std::unique_ptr<Program> bus_;
  std::unique_ptr<Program> portal_;
};

TEST_F(FilePortalTest, TakesTheChosenFile) {
  const FileAnswer answer = AnswerOf("choose", {"file:///media/Gr%C3%B6%C3%9Fe%20eins.mp4"});
  EXPECT_EQ(answer.outcome, Outcome::kChosen) << answer.problem;
  EXPECT_EQ(answer.file, "/media/Größe eins.mp4");
}

TEST_F(FilePortalTest, SaysWhatItWants) {
  StartPortal("cancel");
  FilePortal chooser(timeout_);
  chooser.Open({FileRequest::Kind::kFile,
                "Choose a video",
                {{"Videos", {".mp4", ".mov"}}, {"3D", {".glb"}}},
                "/home/a b",
                ""},
               "x11:2a00003");
  EXPECT_EQ(Await(chooser).outcome, Outcome::kCancelled);
  EXPECT_EQ(portal_->Line(),
            "OpenFile parent=x11:2a00003 title=Choose a video modal=1 "
            "filters=Videos:*.[mM][pP]4,*.[mM][oO][vV],;3D:*.[gG][lL][bB],; "
            "current_folder=/home/a b");
  chooser.Open({FileRequest::Kind::kFolder, "Choose a folder", {}, "", ""}, "");
  EXPECT_EQ(Await(chooser).outcome, Outcome::kCancelled);
  EXPECT_EQ(portal_->Line(), "OpenFile parent= title=Choose a folder modal=1 directory=1");
  chooser.Open({FileRequest::Kind::kSave, "Write", {}, "/tmp", "a.larshow"}, "");
  EXPECT_EQ(Await(chooser).outcome, Outcome::kCancelled);
  EXPECT_EQ(portal_->Line(),
            "SaveFile parent= title=Write modal=1 current_name=a.larshow current_folder=/tmp");
}

TEST_F(FilePortalTest, NeverWaits) {
  StartPortal("wait");
  FilePortal chooser(timeout_);
  chooser.Open(Video(), "");
  const auto began = std::chrono::steady_clock::now();
  for (int i = 0; i < 200; ++i) {
    chooser.Update();
  }
  EXPECT_LT(std::chrono::steady_clock::now() - began, 1s);
  EXPECT_TRUE(chooser.busy());
  EXPECT_FALSE(chooser.TakeAnswer());
}

TEST_F(FilePortalTest, ClosesTheDialogThatIsNoLongerWanted) {
  StartPortal("wait");
  FilePortal chooser(timeout_);
  chooser.Open(Video(), "");
  ASSERT_NE(portal_->Line(&chooser), "");
  chooser.Close();
  EXPECT_FALSE(chooser.busy());
  EXPECT_EQ(portal_->Line(&chooser), "Close");
}

TEST_F(FilePortalTest, SaysWhenTheDialogEndsOtherwise) {
  EXPECT_EQ(AnswerOf("cancel").outcome, Outcome::kCancelled);
  for (const char* behaviour : {"end", "error", "bad-reply", "vanish", "no-chooser"}) {
    const FileAnswer answer = AnswerOf(behaviour);
    EXPECT_EQ(answer.outcome, Outcome::kFailed) << behaviour;
    EXPECT_NE(answer.problem, "") << behaviour;
  }
}

TEST_F(FilePortalTest, GivesUpOnAPortalThatDoesNotReply) {
  timeout_ = 300ms;
  EXPECT_EQ(AnswerOf("silent").outcome, Outcome::kFailed);
  EXPECT_EQ(AnswerOf("no-version").outcome, Outcome::kFailed);
}

TEST_F(FilePortalTest, FailsAtOnceWithoutPortalOrBus) {
  FilePortal without_portal(timeout_);
  without_portal.Open(Video(), "");
  EXPECT_EQ(Await(without_portal).outcome, Outcome::kFailed);
  setenv("DBUS_SESSION_BUS_ADDRESS", "disabled:", 1);
  FilePortal without_bus(timeout_);
  without_bus.Open(Video(), "");
  EXPECT_EQ(without_bus.TakeAnswer().value_or(FileAnswer{Outcome::kChosen, {}, ""}).outcome,
            Outcome::kFailed);
  setenv("DBUS_SESSION_BUS_ADDRESS", "unix:path=/nowhere/at/all", 1);
  FilePortal without_socket(timeout_);
  without_socket.Open(Video(), "");
  EXPECT_EQ(Await(without_socket).outcome, Outcome::kFailed);
}

TEST_F(FilePortalTest, FailsWhenTheBusEnds) {
  StartPortal("wait");
  FilePortal chooser(timeout_);
  chooser.Open(Video(), "");
  ASSERT_NE(portal_->Line(&chooser), "");
  bus_.reset();
  EXPECT_EQ(Await(chooser).outcome, Outcome::kFailed);
  chooser.Open(Video(), "");
  EXPECT_EQ(Await(chooser).outcome, Outcome::kFailed);
}

TEST_F(FilePortalTest, AsksNoOldPortalForFolders) {
  StartPortal("version-1", {"file:///tmp/a.mp4"});
  FilePortal chooser(timeout_);
  chooser.Open({FileRequest::Kind::kFolder, "Choose a folder", {}, "", ""}, "");
  EXPECT_EQ(Await(chooser).outcome, Outcome::kFailed);
  chooser.Open(Video(), "");
  EXPECT_EQ(Await(chooser).file, "/tmp/a.mp4");
}

TEST_F(FilePortalTest, TakesAnswersThatComeEarlyOrUnderAnOldHandle) {
  EXPECT_EQ(AnswerOf("early", {"file:///tmp/a.mp4"}).file, "/tmp/a.mp4");
  EXPECT_EQ(AnswerOf("old-handle", {"file:///tmp/a.mp4"}).file, "/tmp/a.mp4");
}

TEST_F(FilePortalTest, RefusesAnswersThatNameNoFileOfThisComputer) {
  for (const char* uri : {"http://example.org/a.mp4", "file://elsewhere/a.mp4", "file:///a%00.mp4",
                          "file:///a%F6.mp4", "file:a.mp4", "a.mp4"}) {
    const FileAnswer answer = AnswerOf("choose", {uri});
    EXPECT_EQ(answer.outcome, Outcome::kRefused) << uri;
    EXPECT_THAT(answer.problem, HasSubstr("; ")) << uri;  // A problem and its remedy.
  }
}

TEST_F(FilePortalTest, RefusesAnswersOfWrongShape) {
  for (const char* behaviour : {"wrong-signature", "wrong-type", "no-uris", "choose"}) {
    EXPECT_EQ(AnswerOf(behaviour).outcome, Outcome::kFailed) << behaviour;
  }
  EXPECT_EQ(AnswerOf("choose", {"file:///a", "file:///b"}).outcome, Outcome::kFailed);
}

TEST_F(FilePortalTest, TakesNoAnswerOfAnotherProgram) {
  EXPECT_EQ(AnswerOf("stranger", {"file:///etc/passwd"}).outcome, Outcome::kCancelled);
}

TEST_F(FilePortalTest, SendsNoTextThatWouldEndTheConnection) {
  StartPortal("choose", {"file:///tmp/a.larshow"});
  FilePortal chooser(timeout_);
  chooser.Open({FileRequest::Kind::kSave, "\xFF", {}, "/tmp/\xF6", "\xF6.larshow"}, "");
  EXPECT_EQ(Await(chooser).file, "/tmp/a.larshow");
  EXPECT_THAT(portal_->Line(), Not(HasSubstr("current_name")));
}

}  // namespace
}  // namespace lararium::editor
