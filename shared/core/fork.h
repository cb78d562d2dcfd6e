#pragma once

// Safe use of fork() in a program with threads. The child process has only the thread that forked.
// If another thread holds a library's lock at that moment, the lock stays locked in the child for
// ever, and any use of it blocks. The heap and the streams of the C library handle this themselves;
// its locale, which every translation of a text reads, does not.

#include <sys/types.h>

#include <shared_mutex>

namespace lararium {

// Code that may take a lock of the C library that a child needs holds this gate in shared mode.
std::shared_mutex& ForkGate();

// Calls fork() while no thread holds the gate; in the child the gate is open.
pid_t ForkApart();

}  // namespace lararium
