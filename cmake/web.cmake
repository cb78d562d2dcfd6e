# Compiles for browsers with Debian's emscripten; scripts/install_web_tools.sh installs it and compiles the
# libraries. Everything that is linked together needs the same flags. SUPPORT_LONGJMP: libjpeg leaves by longjmp,
# which the exceptions of WebAssembly do not support in this compiler.
set(lararium_web_flags "-msimd128 -fwasm-exceptions -ffp-contract=off -sSUPPORT_LONGJMP=emscripten")
set(CMAKE_C_FLAGS_INIT "${lararium_web_flags}")
set(CMAKE_CXX_FLAGS_INIT "${lararium_web_flags}")
# The linker runs programs in Node. NODE_PATH: where Node is not Debian's, it does not look into Debian's folder.
set(ENV{EM_NODE_JS} ${CMAKE_CURRENT_LIST_DIR}/web_node.sh)
set(ENV{NODE_PATH} /usr/share/nodejs)
set(CMAKE_CXX_LINKER_LAUNCHER ${CMAKE_COMMAND} -E env EM_NODE_JS=$ENV{EM_NODE_JS} NODE_PATH=$ENV{NODE_PATH})
set(CMAKE_CROSSCOMPILING_EMULATOR $ENV{EM_NODE_JS})
include(/usr/share/emscripten/cmake/Modules/Platform/Emscripten.cmake)
