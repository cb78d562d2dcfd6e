#include "shared/core/fork.h"

#include <unistd.h>

#include <memory>

namespace lararium {

std::shared_mutex& ForkGate() {
  static std::shared_mutex gate;
  return gate;
}

pid_t ForkApart() {
  std::shared_mutex& gate = ForkGate();
  gate.lock();
  const pid_t child = fork();
  if (child == 0) {
    std::construct_at(&gate);  // The thread's id differs here: it cannot unlock.
  } else {
    gate.unlock();
  }
  return child;
}

}  // namespace lararium
