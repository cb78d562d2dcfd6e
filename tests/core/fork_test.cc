#include "shared/core/fork.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <shared_mutex>
#include <thread>
#include <vector>

namespace lararium {
namespace {

TEST(ForkApart, FindsNobodyInTheGateAndLeavesItOpen) {
  std::atomic<int> inside = 0;
  std::vector<std::jthread> threads;
  for (int i = 0; i < 3; ++i) {
    threads.emplace_back([&inside](const std::stop_token& stop) {
      while (!stop.stop_requested()) {
        {
          const std::shared_lock lock(ForkGate());
          ++inside;
          std::this_thread::yield();
          --inside;
        }
        std::this_thread::yield();
      }
    });
  }
  for (int i = 0; i < 50; ++i) {
    const pid_t child = ForkApart();
    if (child == 0) {
      _exit(inside == 0 && ForkGate().try_lock() ? 0 : 1);
    }
    ASSERT_GT(child, 0);
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    EXPECT_EQ(status, 0) << i;
  }
}

}  // namespace
}  // namespace lararium
