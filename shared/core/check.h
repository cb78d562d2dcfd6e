#pragma once

// For our own bugs only: a failed CHECK prints its location and aborts in every build. Bad input is
// a Status (shared/core/status.h), never a CHECK.

namespace lararium {

[[noreturn]] void CheckFailed(const char* file, int line, const char* condition);

}  // namespace lararium

#define CHECK(condition)                               \
  (static_cast<bool>(condition) ? static_cast<void>(0) \
                                : ::lararium::CheckFailed(__FILE__, __LINE__, #condition))

// For inner loops: checked in debug and sanitizer builds only.
#if defined(__OPTIMIZE__) && !defined(LARARIUM_SANITIZED)
#define DCHECK(condition) static_cast<void>(0)
#else
#define DCHECK(condition) CHECK(condition)
#endif
