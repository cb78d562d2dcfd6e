#include "shared/core/uncaught.h"

#include <gtest/gtest.h>

#include <new>
#include <stdexcept>
#include <system_error>
#include <thread>

namespace lararium {
namespace {

template <typename Exception>
void ThrowInAThread(const Exception& exception) {
  ReportUncaughtExceptions();
  std::thread([&] { throw exception; }).join();
}

TEST(UncaughtDeathTest, RunningOutOfMemoryEndsWithASentence) {
  EXPECT_EXIT(ThrowInAThread(std::bad_alloc()), testing::ExitedWithCode(1),
              "^the system has no more memory; close other programs");
  EXPECT_EXIT(ThrowInAThread(std::system_error(
                  std::make_error_code(std::errc::resource_unavailable_try_again))),
              testing::ExitedWithCode(1), "^the system has no more threads or memory");
}

TEST(UncaughtDeathTest, OtherExceptionsAbort) {
  EXPECT_EXIT(ThrowInAThread(std::runtime_error("what it says")), testing::KilledBySignal(SIGABRT),
              "internal error: what it says");
}

}  // namespace
}  // namespace lararium
