# One set of compile options for the whole build. The instruction set must be
# the same everywhere: it decides the layout of Eigen's types. Eigen's alignment
# is held at 16 bytes because Debian's Ceres was built so, and matrices cross
# that border.
if(NOT LARARIUM_ISA)
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    set(LARARIUM_ISA x86-64-v3)
  elseif(CMAKE_SYSTEM_PROCESSOR MATCHES "aarch64|arm64")
    set(LARARIUM_ISA armv8-a)
  endif()
endif()

add_library(lararium_options INTERFACE)
target_compile_options(lararium_options INTERFACE
  -Wall -Wextra -Werror -Wno-psabi -ffp-contract=off $<$<BOOL:${LARARIUM_ISA}>:-march=${LARARIUM_ISA}>)
target_compile_definitions(lararium_options INTERFACE EIGEN_MAX_ALIGN_BYTES=16)
target_include_directories(lararium_options INTERFACE ${CMAKE_SOURCE_DIR})
# What flatc writes is not ours to mend. There from the beginning: ccache writes paths of folders that
# are not there in another way.
file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/generated)
target_include_directories(lararium_options SYSTEM INTERFACE ${CMAKE_BINARY_DIR}/generated)

# In a unity build every source is included by another file, for which GCC takes each member of a
# type in an unnamed namespace for a mistake.
if(CMAKE_UNITY_BUILD AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  target_compile_options(lararium_options INTERFACE -Wno-subobject-linkage)
endif()

set(CMAKE_CXX_FLAGS_RELEASE "-O2")
if(EMSCRIPTEN)
  set(CMAKE_CXX_FLAGS_RELEASE "-O3")
endif()
# Libraries check what they are given only where mistakes are looked for: Eigen's checks alone are a tenth of the
# time in which training compiles, and a sixth of its code.
if(NOT LARARIUM_SANITIZE)
  string(APPEND CMAKE_CXX_FLAGS_RELEASE " -DNDEBUG")
endif()
# Optimising the assertions would take a third of the time in which tests compile.
set(lararium_test_options $<$<CONFIG:Release>:-O1>)

# GCC that seldom collects its garbage is a quarter faster, and takes a gigabyte for each process.
cmake_host_system_information(RESULT cores QUERY NUMBER_OF_LOGICAL_CORES)
cmake_host_system_information(RESULT memory_mib QUERY TOTAL_PHYSICAL_MEMORY)
math(EXPR memory_mib "${memory_mib} / ${cores}")
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND memory_mib GREATER 3000)
  target_compile_options(lararium_options INTERFACE
    "SHELL:--param ggc-min-expand=1000" "SHELL:--param ggc-min-heapsize=4000000")
endif()

if(LARARIUM_SANITIZE)
  target_compile_options(lararium_options INTERFACE
    -fsanitize=${LARARIUM_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer -g1)
  # Says the same for every compiler and sanitizer; clang 14 does not define __SANITIZE_ADDRESS__.
  target_compile_definitions(lararium_options INTERFACE LARARIUM_SANITIZED)
  target_link_options(lararium_options INTERFACE -fsanitize=${LARARIUM_SANITIZE})
endif()

if(LARARIUM_TIDY)
  find_program(LARARIUM_CLANG_TIDY NAMES clang-tidy-14 clang-tidy REQUIRED)
  set(CMAKE_CXX_CLANG_TIDY ${LARARIUM_CLANG_TIDY})
endif()
