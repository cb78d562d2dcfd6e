# The libraries of the build for browsers, as imported targets. Those that scripts/install_web_tools.sh has
# compiled lie in build/web-libraries; the others are headers of this machine's Debian packages, through links:
# its other headers do not fit.
set(LARARIUM_WEB_LIBRARIES ${CMAKE_SOURCE_DIR}/build/web-libraries CACHE PATH "What scripts/install_web_tools.sh made")
if(NOT EXISTS ${LARARIUM_WEB_LIBRARIES}/lib/libsndfile.a)
  message(FATAL_ERROR "${LARARIUM_WEB_LIBRARIES} lacks libraries; run scripts/install_web_tools.sh first")
endif()

find_package(Threads REQUIRED)
find_program(FLATC flatc REQUIRED)

# lararium_web_library(TARGET INCLUDE folder [LIBRARIES archive...] [DEFINITIONS name...])
function(lararium_web_library target)
  cmake_parse_arguments(arg "" "INCLUDE" "LIBRARIES;DEFINITIONS" ${ARGN})
  add_library(${target} INTERFACE IMPORTED GLOBAL)
  target_include_directories(${target} SYSTEM INTERFACE ${arg_INCLUDE})
  target_compile_definitions(${target} INTERFACE ${arg_DEFINITIONS})
  target_link_libraries(${target} INTERFACE ${arg_LIBRARIES})
endfunction()

set(headers ${CMAKE_BINARY_DIR}/headers)
file(MAKE_DIRECTORY ${headers})
foreach(folder flatbuffers fmt glm nlohmann spdlog)
  if(NOT EXISTS /usr/include/${folder})
    message(FATAL_ERROR "/usr/include/${folder} is missing; run scripts/install_packages.sh")
  endif()
  file(CREATE_LINK /usr/include/${folder} ${headers}/${folder} SYMBOLIC)
endforeach()
# The presets of reverberation; OpenAL itself is emscripten's and is not used.
file(MAKE_DIRECTORY ${headers}/AL)
file(CREATE_LINK /usr/include/AL/efx-presets.h ${headers}/AL/efx-presets.h SYMBOLIC)
lararium_web_library(PkgConfig::flatbuffers INCLUDE ${headers})
lararium_web_library(glm::glm INCLUDE ${headers})
lararium_web_library(nlohmann_json::nlohmann_json INCLUDE ${headers})
lararium_web_library(spdlog::spdlog INCLUDE ${headers} DEFINITIONS SPDLOG_FMT_EXTERNAL FMT_HEADER_ONLY)
lararium_web_library(Eigen3::Eigen INCLUDE /usr/include/eigen3)

set(lib ${LARARIUM_WEB_LIBRARIES}/lib)
set(include ${LARARIUM_WEB_LIBRARIES}/include)
lararium_web_library(JPEG::JPEG INCLUDE ${include} LIBRARIES ${lib}/libjpeg.a)
lararium_web_library(ZLIB::ZLIB INCLUDE ${include} LIBRARIES ${lib}/libz.a)
lararium_web_library(PNG::PNG INCLUDE ${include} LIBRARIES ${lib}/libpng.a ${lib}/libz.a)
# The names in this Lua are those of C++ (shared/drama/lua_api.h).
lararium_web_library(PkgConfig::lua INCLUDE ${include}/lua LIBRARIES ${lib}/liblua.a DEFINITIONS LARARIUM_LUA_NAMES_OF_CXX)
lararium_web_library(PkgConfig::sodium INCLUDE ${include} LIBRARIES ${lib}/libsodium.a)
lararium_web_library(recast_imported INCLUDE ${include}/recastnavigation LIBRARIES ${lib}/librecast.a)
lararium_web_library(PkgConfig::sndfile INCLUDE ${include} LIBRARIES ${lib}/libsndfile.a ${lib}/libFLAC.a
  ${lib}/libvorbisenc.a ${lib}/libvorbis.a ${lib}/libopus.a ${lib}/libogg.a)
set(opencv ${LARARIUM_WEB_LIBRARIES}/include/opencv4)
lararium_web_library(opencv_core INCLUDE ${opencv} LIBRARIES ${lib}/libopencv_core.a ${lib}/libz.a)
lararium_web_library(opencv_imgproc INCLUDE ${opencv} LIBRARIES ${lib}/libopencv_imgproc.a opencv_core)
