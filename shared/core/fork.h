#pragma once

// A process that goes on with this program's memory, where there are threads: the child has only
// the one that forked. A lock of a library that another held at that moment nobody lets go of
// there, and whoever wants it waits for good. The heap and streams of the C library look after
// themselves; its locale does not, which translating texts reads all the while.

#include <sys/types.h>

#include <shared_mutex>

namespace lararium {

// Held, shared, by whoever may be in one of the C library's locks that a child will want.
std::shared_mutex& ForkGate();

// fork(), while nobody holds the gate; in the child it is open.
pid_t ForkApart();

}  // namespace lararium
