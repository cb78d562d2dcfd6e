#pragma once

#include <future>

namespace lararium {

// How std::async does work that nothing waits for: in a thread of its own, or, where no threads
// share memory, when its result is fetched. std::future::wait_for never returns timeout then.
std::launch BackgroundLaunch();

}  // namespace lararium
