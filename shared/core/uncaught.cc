#include "shared/core/uncaught.h"

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <string_view>
#include <system_error>

namespace lararium {
namespace {

[[noreturn]] void EndForWantOf(const char* what) {
  std::fprintf(stderr, "the system has no more %s; close other programs and try again\n", what);
  std::_Exit(1);
}

[[noreturn]] void Report() {
  try {
    if (const std::exception_ptr thrown = std::current_exception()) {
      std::rethrow_exception(thrown);
    }
  } catch (const std::bad_alloc&) {
    EndForWantOf("memory");
  } catch (const std::system_error& error) {
    if (error.code() == std::errc::resource_unavailable_try_again ||
        error.code() == std::errc::not_enough_memory) {
      EndForWantOf("threads or memory");
    }
    std::fprintf(stderr, "internal error: %s\n", error.what());
  } catch (const std::exception& error) {
    // OpenCV has its own exception for this.
    if (std::string_view(error.what()).find("Insufficient memory") != std::string_view::npos) {
      EndForWantOf("memory");
    }
    std::fprintf(stderr, "internal error: %s\n", error.what());
  } catch (...) {
    std::fprintf(stderr, "internal error\n");
  }
  std::abort();
}

}  // namespace

void ReportUncaughtExceptions() { std::set_terminate(Report); }

}  // namespace lararium
