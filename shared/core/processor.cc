#include "shared/core/processor.h"

namespace lararium {

Status CheckProcessor() {
#if defined(__x86_64__) && defined(__AVX2__)
  __builtin_cpu_init();
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma")) {
    return Status::Error("this processor", "lacks the AVX2 and FMA instructions of this build",
                         "build with -DLARARIUM_ISA=x86-64, or use a PC of 2014 or later");
  }
#endif
  return Status();
}

}  // namespace lararium
