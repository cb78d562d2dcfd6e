// Ends a program on a processor that lacks the build's instructions, before anything else of it
// runs. Otherwise it would end with an illegal instruction. This file alone is compiled for every
// processor, and it uses no header of C++, whose inline functions the linker could take from
// another file.

#include <unistd.h>

namespace {

void CheckProcessor() {
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
      __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2")) {
    return;
  }
  constexpr char kMessage[] =
      "this processor: lacks the AVX2, FMA and BMI2 instructions of this build; use a PC that has "
      "them (Intel Core since 2013, AMD Ryzen), or build with -DLARARIUM_ISA=x86-64\n";
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, kMessage, sizeof(kMessage) - 1);
  _exit(1);
}

// The loader calls this before any initialiser, also those of libraries.
[[gnu::section(".preinit_array"), gnu::used]] void (*const first)() = CheckProcessor;

}  // namespace
