#include "shared/core/memory.h"

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace lararium {

#ifdef __GLIBC__
void ReturnBlocksFrom(size_t bytes) {
  ::mallopt(M_MMAP_THRESHOLD, static_cast<int>(bytes));
  ::mallopt(M_TRIM_THRESHOLD, static_cast<int>(2 * bytes));
}
void TrimHeap() { ::malloc_trim(0); }
#else
void ReturnBlocksFrom(size_t /*bytes*/) {}
void TrimHeap() {}
#endif

}  // namespace lararium
