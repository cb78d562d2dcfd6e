#include "shared/core/memory.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cstdlib>
#include <iostream>

namespace lararium {
namespace {

#ifndef LARARIUM_SANITIZED  // Sanitizers need more addresses than the limit leaves.
// Exits with 0 if 1 GB can be had, and otherwise with 1 after the error was printed.
[[noreturn]] void AskForAGigabyte(uint64_t limit) {
  const rlimit addresses = {limit, limit};
  if (limit > 0 && ::setrlimit(RLIMIT_AS, &addresses) != 0) {
    std::_Exit(2);
  }
  const Status status = RequireAddressSpace(1'000'000'000, "drawing");
  std::cerr << status.message();
  std::_Exit(status.ok() ? 0 : 1);
}

TEST(AddressSpaceDeathTest, IsRefusedOnlyByALimit) {
  EXPECT_EXIT(AskForAGigabyte(0), testing::ExitedWithCode(0), "^$");
  EXPECT_EXIT(AskForAGigabyte(900'000'000), testing::ExitedWithCode(1),
              "^drawing: this program may not use 1000 MB more memory; .*ulimit -v");
}
#endif

}  // namespace
}  // namespace lararium
