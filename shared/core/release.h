#pragma once

#include <vector>

namespace lararium {

// Empties `items` and releases their memory, which an assignment of {} would keep.
template <typename T>
void Release(std::vector<T>& items) {
  std::vector<T>().swap(items);
}

}  // namespace lararium
