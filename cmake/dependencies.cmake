# Every library that Lararium uses, as an imported target. All come from Debian
# packages (packages.txt); nothing is vendored. System headers, so that their
# warnings are not ours.
find_package(PkgConfig REQUIRED)
find_package(Threads REQUIRED)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(Ceres 2.1 REQUIRED)
find_package(TBB REQUIRED)
find_package(ZLIB REQUIRED)
find_package(JPEG REQUIRED)
find_package(PNG REQUIRED)
find_package(TIFF REQUIRED)
find_package(glfw3 3.3 REQUIRED)
find_package(glm REQUIRED)
# Without it the player says, where a headset is wanted, that it was built without.
find_package(OpenXR QUIET)
find_package(X11 REQUIRED)
find_package(assimp 5.2 REQUIRED)
find_package(draco REQUIRED)
# Its version file refuses every version but the one that is asked for.
find_package(meshoptimizer REQUIRED)
find_package(OpenEXR 3.1 REQUIRED)
# editor/bake/ray_scene.cc takes either version.
find_package(embree 4 QUIET)
if(NOT embree_FOUND)
  find_package(embree 3.13 REQUIRED)
endif()
find_package(nlohmann_json 3.11 REQUIRED)
find_package(CLI11 2.1 REQUIRED)
find_package(spdlog 1.10 REQUIRED)
find_package(GTest REQUIRED)
find_package(benchmark REQUIRED)
pkg_check_modules(apriltag REQUIRED IMPORTED_TARGET apriltag)
pkg_check_modules(libav REQUIRED IMPORTED_TARGET libavformat libavcodec libavutil libswscale)
pkg_check_modules(swresample REQUIRED IMPORTED_TARGET libswresample)
# Only its headers: shared/image/heif.cc opens the library by name.
pkg_check_modules(heif REQUIRED libheif)
add_library(heif_headers INTERFACE)
target_include_directories(heif_headers SYSTEM INTERFACE ${heif_INCLUDE_DIRS})
pkg_check_modules(v4lconvert REQUIRED IMPORTED_TARGET libv4lconvert)
pkg_check_modules(openal REQUIRED IMPORTED_TARGET openal)
pkg_check_modules(epoxy REQUIRED IMPORTED_TARGET epoxy)
pkg_check_modules(egl REQUIRED IMPORTED_TARGET egl)
# Lua as Debian builds it for C++: its errors are C++ exceptions, which unwind our
# frames; the C build would jump over their destructors.
pkg_check_modules(lua REQUIRED IMPORTED_TARGET lua5.4-c++)
include(CheckCXXSourceCompiles)
set(CMAKE_REQUIRED_LIBRARIES PkgConfig::lua)
check_cxx_source_compiles("#include <lua.hpp>
  int main() { lua_close(luaL_newstate()); }" LARARIUM_LUA_HAS_NAMES_OF_C)
unset(CMAKE_REQUIRED_LIBRARIES)
if(NOT LARARIUM_LUA_HAS_NAMES_OF_C)  # See shared/drama/lua_api.h.
  set_property(TARGET PkgConfig::lua APPEND PROPERTY INTERFACE_COMPILE_DEFINITIONS LARARIUM_LUA_NAMES_OF_CXX)
endif()
pkg_check_modules(deflate REQUIRED IMPORTED_TARGET libdeflate)
pkg_check_modules(libzip REQUIRED IMPORTED_TARGET libzip)
pkg_check_modules(lo REQUIRED IMPORTED_TARGET liblo)
pkg_check_modules(muparser REQUIRED IMPORTED_TARGET muparser)
pkg_check_modules(pugixml REQUIRED IMPORTED_TARGET pugixml)
pkg_check_modules(sodium REQUIRED IMPORTED_TARGET libsodium)
pkg_check_modules(crypto REQUIRED IMPORTED_TARGET libcrypto)
pkg_check_modules(curl REQUIRED IMPORTED_TARGET libcurl)
pkg_check_modules(mosquitto REQUIRED IMPORTED_TARGET libmosquitto)
pkg_check_modules(microhttpd REQUIRED IMPORTED_TARGET libmicrohttpd)
pkg_check_modules(seccomp REQUIRED IMPORTED_TARGET libseccomp)
pkg_check_modules(espeak REQUIRED IMPORTED_TARGET espeak-ng)
pkg_check_modules(freetype REQUIRED IMPORTED_TARGET freetype2)
# The client of D-Bus in it (sd-bus).
pkg_check_modules(systemd REQUIRED IMPORTED_TARGET libsystemd)
# Encodings of texts: recognised (i18n) and converted (uc).
pkg_check_modules(icu REQUIRED IMPORTED_TARGET icu-i18n icu-uc)
# QR codes.
pkg_check_modules(qrencode REQUIRED IMPORTED_TARGET libqrencode)
pkg_check_modules(sndfile REQUIRED IMPORTED_TARGET sndfile)
pkg_check_modules(flatbuffers REQUIRED IMPORTED_TARGET flatbuffers)
find_program(FLATC flatc REQUIRED)

# OpenCV's own CMake files come only with the package of all its modules, which
# pulls in VTK; the modules that we use are found one by one.
find_path(OPENCV_INCLUDE_DIR opencv2/core.hpp PATH_SUFFIXES opencv4 REQUIRED)
foreach(module core imgproc imgcodecs videoio video features2d calib3d photo)
  find_library(OPENCV_${module}_LIBRARY opencv_${module} REQUIRED)
  add_library(opencv_${module} INTERFACE)
  target_include_directories(opencv_${module} SYSTEM INTERFACE ${OPENCV_INCLUDE_DIR})
  target_link_libraries(opencv_${module} INTERFACE ${OPENCV_${module}_LIBRARY})
  if(NOT module STREQUAL core)
    target_link_libraries(opencv_${module} INTERFACE opencv_core)
  endif()
endforeach()

# Debian's imgui is one static library with its back ends.
find_path(IMGUI_INCLUDE_DIR imgui.h PATH_SUFFIXES imgui REQUIRED)
find_library(IMGUI_LIBRARY imgui REQUIRED)
find_library(STB_LIBRARY stb)
add_library(imgui_imported INTERFACE)
target_include_directories(imgui_imported SYSTEM INTERFACE ${IMGUI_INCLUDE_DIR} ${IMGUI_INCLUDE_DIR}/backends)
target_link_libraries(imgui_imported INTERFACE ${IMGUI_LIBRARY} $<$<BOOL:${STB_LIBRARY}>:${STB_LIBRARY}> ${CMAKE_DL_LIBS})

# pocketsphinx: its pkg-config file names folders that Debian has elsewhere.
find_path(SPHINX_INCLUDE_DIR pocketsphinx.h PATH_SUFFIXES pocketsphinx REQUIRED)
find_library(POCKETSPHINX_LIBRARY pocketsphinx REQUIRED)
find_library(SPHINXBASE_LIBRARY sphinxbase REQUIRED)
find_path(SPHINX_MODEL_DIR en-us/cmudict-en-us.dict PATHS /usr/share/pocketsphinx/model REQUIRED)
add_library(sphinx_imported INTERFACE)
target_include_directories(sphinx_imported SYSTEM INTERFACE ${SPHINX_INCLUDE_DIR} ${SPHINX_INCLUDE_DIR}/..
  /usr/include/${CMAKE_LIBRARY_ARCHITECTURE}/sphinxbase)
target_link_libraries(sphinx_imported INTERFACE ${POCKETSPHINX_LIBRARY} ${SPHINXBASE_LIBRARY})

# FLANN: its pkg-config file names libraries that we do not want.
find_path(FLANN_INCLUDE_DIR flann/flann.hpp REQUIRED)
find_library(FLANN_LIBRARY flann_cpp REQUIRED)
find_library(LZ4_LIBRARY lz4 REQUIRED)
add_library(flann_imported INTERFACE)
target_include_directories(flann_imported SYSTEM INTERFACE ${FLANN_INCLUDE_DIR})
target_link_libraries(flann_imported INTERFACE ${FLANN_LIBRARY} ${LZ4_LIBRARY})

# Recast (navigation meshes) and Detour (paths and crowds).
find_path(RECAST_INCLUDE_DIR Recast.h PATH_SUFFIXES recastnavigation REQUIRED)
add_library(recast_imported INTERFACE)
target_include_directories(recast_imported SYSTEM INTERFACE ${RECAST_INCLUDE_DIR})
foreach(module Recast Detour DetourCrowd)
  find_library(RECAST_${module}_LIBRARY ${module} REQUIRED)
  target_link_libraries(recast_imported INTERFACE ${RECAST_${module}_LIBRARY})
endforeach()
