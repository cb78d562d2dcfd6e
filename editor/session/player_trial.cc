#include "editor/session/player_trial.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <optional>
#include <system_error>

#include "shared/core/program.h"

namespace lararium::editor {

namespace {

namespace fs = std::filesystem;

constexpr const char* kPlayer = "lararium-player";
constexpr int kLookEvery = 100;           // Milliseconds between two polls.
constexpr size_t kKeptOutput = 64 << 10;  // Bytes of output that are kept.

// A running program and the read end of its output pipe.
struct Running {
  pid_t process = -1;
  int output = -1;
};

std::optional<Running> Start(const fs::path& program, const std::vector<std::string>& arguments) {
  std::array<int, 2> ends;
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) {
    return std::nullopt;
  }
  std::string name = program.string();
  std::vector<std::string> owned = arguments;
  std::vector<char*> argv = {name.data()};
  for (std::string& argument : owned) {
    argv.push_back(argument.data());
  }
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  ::posix_spawn_file_actions_adddup2(&actions, ends[1], STDERR_FILENO);
  Running running;
  const int error =
      ::posix_spawnp(&running.process, program.c_str(), &actions, nullptr, argv.data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  ::close(ends[1]);
  if (error != 0) {
    ::close(ends[0]);
    return std::nullopt;
  }
  running.output = ends[0];
  return running;
}

// Reads until the program closes its output; returns the last part of it.
std::string Listen(const Running& running, Progress& progress) {
  std::string said;
  bool asked = false;
  while (true) {
    if (progress.Cancelled() && !asked) {
      ::kill(running.process, SIGTERM);
      asked = true;
    }
    pollfd end = {running.output, POLLIN, 0};
    if (::poll(&end, 1, kLookEvery) <= 0) {
      continue;
    }
    std::array<char, 4096> bytes;
    const ssize_t count = ::read(running.output, bytes.data(), bytes.size());
    if (count <= 0) {
      return said;
    }
    said.append(bytes.data(), static_cast<size_t>(count));
    if (said.size() > 2 * kKeptOutput) {
      said.erase(0, said.size() - kKeptOutput);
    }
  }
}

std::string LastLine(std::string text) {
  while (!text.empty() && text.back() == '\n') {
    text.pop_back();
  }
  return text.substr(text.rfind('\n') + 1);
}

}  // namespace

fs::path FindPlayer() {
  const fs::path beside = ProgramFolder() / kPlayer;
  return ::access(beside.c_str(), X_OK) == 0 ? beside : fs::path(kPlayer);
}

std::vector<std::string> TrialArguments(const ProjectPaths& paths,
                                        const PlaceDocument& place,
                                        const fs::path& show) {
  std::vector<std::string> arguments = {show.string(), "--place", place.name};
  const SourceDocument& source = place.preview.empty() ? place.training : place.preview;
  const bool images = source.kind == SourceDocument::Kind::kImages;
  const fs::path file = paths.Resolve(source.path);
  std::error_code error;
  if (!source.empty() && fs::exists(file, error)) {
    arguments.insert(arguments.end(), {images ? "--images" : "--video", file.string(), "--loop"});
  }
  return arguments;
}

Status RunProgram(const fs::path& program,
                  const std::vector<std::string>& arguments,
                  Progress& progress) {
  const std::optional<Running> running = Start(program, arguments);
  if (!running) {
    return Status::Error(program.string(), "cannot be started",
                         "install lararium-player beside the editor");
  }
  const std::string said = Listen(*running, progress);
  ::close(running->output);
  int status = 0;
  ::waitpid(running->process, &status, 0);
  if (progress.Cancelled() || (WIFEXITED(status) && WEXITSTATUS(status) == 0)) {
    return Status();
  }
  const std::string last = LastLine(said);
  return Status::Error(program.filename().string(),
                       "ended with an error" + (last.empty() ? std::string() : ": " + last),
                       "check the show with lararium-player doctor");
}

}  // namespace lararium::editor
