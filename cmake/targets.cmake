# lararium_library(ROOM SOURCES ... [PUBLIC ...] [PRIVATE ...]
#                  [SYSTEM_SOURCES ...] [SYSTEM_PRIVATE ...] [WEB_SOURCES ...])
# One static library for a room, named lararium_ROOM. What is specific to an operating system, the
# SYSTEM arguments, is left out in a build for browsers, and WEB_SOURCES take its place.
function(lararium_library room)
  cmake_parse_arguments(arg "" "" "SOURCES;PUBLIC;PRIVATE;SYSTEM_SOURCES;SYSTEM_PRIVATE;WEB_SOURCES" ${ARGN})
  if(EMSCRIPTEN)
    list(APPEND arg_SOURCES ${arg_WEB_SOURCES})
  else()
    list(APPEND arg_SOURCES ${arg_SYSTEM_SOURCES})
    list(APPEND arg_PRIVATE ${arg_SYSTEM_PRIVATE})
  endif()
  add_library(lararium_${room} STATIC ${arg_SOURCES})
  target_link_libraries(lararium_${room} PUBLIC lararium_options ${arg_PUBLIC} PRIVATE ${arg_PRIVATE})
  lararium_precompile(lararium_${room} rooms)
endfunction()

# lararium_tuned(ROOM OPTIONS ... SOURCES ...)
# Sources of a room that are compiled as the room is, with further options. They make a target of their own,
# because a unity build leaves out a source that has options of its own.
function(lararium_tuned room)
  cmake_parse_arguments(arg "" "" "OPTIONS;SOURCES" ${ARGN})
  add_library(lararium_${room}_tuned OBJECT ${arg_SOURCES})
  get_target_property(libraries lararium_${room} LINK_LIBRARIES)
  target_link_libraries(lararium_${room}_tuned PRIVATE ${libraries})
  target_compile_definitions(lararium_${room}_tuned PRIVATE
    $<TARGET_PROPERTY:lararium_${room},COMPILE_DEFINITIONS>)
  target_compile_options(lararium_${room}_tuned PRIVATE
    $<TARGET_PROPERTY:lararium_${room},COMPILE_OPTIONS> ${arg_OPTIONS})
  target_sources(lararium_${room} PRIVATE $<TARGET_OBJECTS:lararium_${room}_tuned>)
endfunction()

# lararium_flatbuffer(ROOM SCHEMA.fbs): generates SCHEMA_generated.h for that
# room under generated/ with the schema's own folder.
function(lararium_flatbuffer room schema)
  get_filename_component(stem ${schema} NAME_WE)
  file(RELATIVE_PATH folder ${CMAKE_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR})
  set(out ${CMAKE_BINARY_DIR}/generated/${folder})
  add_custom_command(
    OUTPUT ${out}/${stem}_generated.h
    COMMAND ${FLATC} --cpp --scoped-enums --cpp-std c++17 -o ${out} ${CMAKE_CURRENT_SOURCE_DIR}/${schema}
    DEPENDS ${schema}
    COMMENT "flatc ${schema}")
  target_sources(lararium_${room} PRIVATE ${out}/${stem}_generated.h)
endfunction()

# lararium_embed(ROOM FUNCTION FunctionName HEADER room/header.h [NAMESPACE name] FILES ...)
# Builds the texts of files into a room: lararium::ROOM::FunctionName(), or that of
# another namespace, returns them as EmbeddedText, in this order.
function(lararium_embed room)
  cmake_parse_arguments(arg "" "FUNCTION;HEADER;NAMESPACE" "FILES" ${ARGN})
  if(NOT arg_NAMESPACE)
    set(arg_NAMESPACE lararium::${room})
  endif()
  get_filename_component(stem ${arg_HEADER} NAME_WE)
  set(output ${CMAKE_BINARY_DIR}/generated/shared/${room}/${stem}_embedded.cc)
  add_custom_command(
    OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} "-DFILES=${arg_FILES}" -DNAMESPACE=${arg_NAMESPACE}
      -DFUNCTION=${arg_FUNCTION} -DHEADER=${arg_HEADER} -DOUTPUT=${output}
      -P ${CMAKE_SOURCE_DIR}/cmake/embed.cmake
    DEPENDS ${arg_FILES} ${CMAKE_SOURCE_DIR}/cmake/embed.cmake
    VERBATIM
    COMMENT "Embedding ${arg_FUNCTION}")
  target_sources(lararium_${room} PRIVATE ${output})
endfunction()

# lararium_test(NAME LABEL label SOURCES ... LINK ... [TIMEOUT s])
# A GoogleTest program. LABEL: unit (no GL, under a second a test), data (reads
# scenes/ or LARARIUM_DATA_DIR), gl (draws, software Mesa suffices), ui, slow. The tests of a
# unit, data or gl program run in one process, because most are shorter than its start, or share
# what they read; the others are tests of CTest each.
function(lararium_test name)
  cmake_parse_arguments(arg "" "LABEL;TIMEOUT" "SOURCES;LINK" ${ARGN})
  add_executable(${name} ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE ${arg_LINK} lararium_test_support GTest::gmock GTest::gtest_main)
  target_compile_options(${name} PRIVATE ${lararium_test_options})
  lararium_precompile(${name} tests)
  string(REGEX REPLACE "_(data_|gl_|ui_|slow_)?test$" "" room ${name})
  if(arg_LABEL MATCHES "^(unit|data|gl)$")
    lararium_test_program(${name} ${arg_LABEL} ${room}/${arg_LABEL} "*" "${arg_TIMEOUT}")
    return()
  endif()
  if(NOT arg_TIMEOUT)
    set(arg_TIMEOUT 120)
  endif()
  gtest_discover_tests(${name} NO_PRETTY_VALUES TEST_PREFIX "${room}/" DISCOVERY_TIMEOUT 60
    PROPERTIES LABELS ${arg_LABEL} TIMEOUT ${arg_TIMEOUT})
endfunction()

# lararium_thorough_test(NAME TIMEOUT seconds): a test's tests once more with the label slow, where test::IsThorough()
# (tests/support/thorough.h) is true.
function(lararium_thorough_test name)
  cmake_parse_arguments(arg "" "TIMEOUT" "" ${ARGN})
  string(REGEX REPLACE "_test$" "" room ${name})
  lararium_test_program(${name} slow ${room}/slow "*" "${arg_TIMEOUT}")
  set_tests_properties(${room}/slow PROPERTIES ENVIRONMENT LARARIUM_THOROUGH=1)
endfunction()

function(lararium_test_program name label test filter seconds)
  if(NOT seconds)
    set(seconds 1200)
  endif()
  # The emulator of another processor takes tens of times as long.
  if(CMAKE_CROSSCOMPILING)
    math(EXPR seconds "4 * ${seconds}")
  endif()
  add_test(NAME ${test} COMMAND ${name} --gtest_brief=1 --gtest_filter=${filter})
  # CTest begins with what costs most, so that short tests fill the end.
  set_tests_properties(${test} PROPERTIES LABELS ${label} TIMEOUT ${seconds} COST $<IF:$<STREQUAL:${label},data>,100,0>)
endfunction()

# lararium_gles_test(NAME FILTER filter): those of a GL test's tests once more, in OpenGL ES 3.0
# (tests/render/gl_fixture.h).
function(lararium_gles_test name)
  cmake_parse_arguments(arg "" "FILTER" "" ${ARGN})
  string(REGEX REPLACE "_gl_test$" "" room ${name})
  lararium_test_program(${name} gl ${room}/gles "${arg_FILTER}" "")
  set_tests_properties(${room}/gles PROPERTIES ENVIRONMENT LARARIUM_GRAPHICS=gles)
endfunction()
