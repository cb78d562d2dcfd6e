#pragma once

namespace lararium {

// From now on, an exception that no code catches, in any thread, ends the program with one sentence
// on stderr. If memory or threads ran out, the exit status is 1; other exceptions are faults of the
// program and abort it, as they do by default.
void ReportUncaughtExceptions();

}  // namespace lararium
