#pragma once

// A real broker for a fleet that fleet-setup wrote.

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>

namespace lararium::test {

// Waits until a condition holds, at most twenty seconds. Returns whether it holds.
bool Soon(const std::function<bool()>& holds);
// A TCP port of this machine that nothing uses now.
uint16_t FreePort();

class TestBroker {
 public:
  static bool installed();

  // folder: for its configuration and its log.
  explicit TestBroker(std::filesystem::path folder) : folder_(std::move(folder)) {}
  ~TestBroker() { Kill(); }
  TestBroker(const TestBroker&) = delete;
  TestBroker& operator=(const TestBroker&) = delete;

  // files: the folder with the broker's files of fleet-setup. Returns when the port is open.
  void Start(const std::string& files, uint16_t port);
  void Kill();
  std::string log() const;

 private:
  std::filesystem::path folder_;
  pid_t process_ = -1;
};

}  // namespace lararium::test
