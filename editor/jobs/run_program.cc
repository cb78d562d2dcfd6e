#include "editor/jobs/run_program.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <optional>
#include <string_view>

namespace lararium::editor {

namespace {

namespace fs = std::filesystem;

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
  posix_spawnattr_t attributes;
  ::posix_spawnattr_init(&attributes);
  ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  ::posix_spawnattr_setpgroup(&attributes, 0);
  Running running;
  const int error = ::posix_spawnp(&running.process, program.c_str(), &actions, &attributes,
                                   argv.data(), environ);
  ::posix_spawnattr_destroy(&attributes);
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
std::string Listen(const Running& running, Progress& progress, const SaysLine& says) {
  std::string said;
  std::string line;
  bool asked = false;
  while (true) {
    if (progress.Cancelled() && !asked) {
      ::kill(-running.process, SIGTERM);  // The program and those that it started.
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
    const std::string_view part(bytes.data(), static_cast<size_t>(count));
    said.append(part);
    for (const char c : part) {
      if (c != '\n') {
        line.push_back(c);
        continue;
      }
      if (says) {
        says(line);
      }
      line.clear();
    }
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

Status RunProgram(const fs::path& program,
                  const std::vector<std::string>& arguments,
                  const ProgramRemedies& remedies,
                  Progress& progress,
                  const SaysLine& says) {
  const std::optional<Running> running = Start(program, arguments);
  if (!running) {
    return Status::Error(program.string(), "cannot be started", remedies.missing);
  }
  const std::string said = Listen(*running, progress, says);
  ::close(running->output);
  int status = 0;
  ::waitpid(running->process, &status, 0);
  if (progress.Cancelled() || (WIFEXITED(status) && WEXITSTATUS(status) == 0)) {
    return Status();
  }
  const std::string last = LastLine(said);
  return Status::Error(program.filename().string(),
                       "ended with an error" + (last.empty() ? std::string() : ": " + last),
                       remedies.failed);
}

}  // namespace lararium::editor
