# Fails where a room includes another that is not below it. The linker cannot see this: a header
# leaks through a room without its library. A room's floor is its line here, the lowest first;
# rooms of one line do not include each other.
set(floors
  "shared/core"
  "shared/geometry shared/image"
  "shared/capture shared/vision shared/human shared/light"
  "shared/stage"
  "shared/drama shared/bundle shared/render shared/audio"
  "shared/show"
  "shared/group"
  "web/tracker"
  "web/page"
  "editor/text"
  "editor/desktop editor/train editor/import editor/export player/kiosk player/benchmark"
  "editor/bake editor/colmap player/staff player/openxr player/updates"
  "editor/document player/fleet"
  "editor/jobs player/app"
  "editor/check"
  "editor/session"
  "editor/panels"
  "editor/window"
  "editor/cli")

set(rooms "")
set(floor 0)
foreach(line IN LISTS floors)
  string(REPLACE " " ";" names ${line})
  foreach(room IN LISTS names)
    set(floor_${room} ${floor})
    list(APPEND rooms ${room})
  endforeach()
  math(EXPR floor "${floor} + 1")
endforeach()

set(problems "")
set(largest_folder 80)

file(GLOB_RECURSE files RELATIVE ${SOURCE_DIR}
     ${SOURCE_DIR}/shared/*.h ${SOURCE_DIR}/shared/*.cc ${SOURCE_DIR}/player/*.h
     ${SOURCE_DIR}/player/*.cc ${SOURCE_DIR}/editor/*.h ${SOURCE_DIR}/editor/*.cc
     ${SOURCE_DIR}/web/*.h ${SOURCE_DIR}/web/*.cc)
foreach(file IN LISTS files)
  file(STRINGS ${SOURCE_DIR}/${file} includes REGEX "^#include")
  string(REGEX REPLACE "^([a-z]+/[a-z]+)/.*" "\\1" home ${file})
  string(REGEX REPLACE "/.*" "" program ${file})
  if(NOT DEFINED floor_${home})
    list(APPEND problems "${file}: ${home} is no room; name its floor in layers.cmake")
    set(floor_${home} 0)
  endif()
  get_filename_component(folder ${file} DIRECTORY)
  list(APPEND in_${folder} ${file})
  list(APPEND folders ${folder})
  foreach(line IN LISTS includes)
    # Only the programs' own code; never each other's, never tests.
    if(line MATCHES "\"tests/")
      list(APPEND problems "${file}: includes a test header")
    elseif(line MATCHES "\"((shared|editor|player|web)/[a-z]+)/")
      set(room ${CMAKE_MATCH_1})
      if(NOT room STREQUAL home)
        if(NOT CMAKE_MATCH_2 STREQUAL "shared" AND NOT CMAKE_MATCH_2 STREQUAL program)
          list(APPEND problems "${file}: ${program} includes ${CMAKE_MATCH_2}")
        elseif(NOT floor_${room} LESS floor_${home})
          list(APPEND problems "${file}: ${home} includes ${room}, which is not below it")
        endif()
      endif()
    endif()
    if(line MATCHES "<(epoxy|GL|GLES3|EGL)/" AND NOT file MATCHES
       "^(shared/render|editor/(window|panels))/|^player/openxr/openxr_graphics")
      list(APPEND problems "${file}: OpenGL headers belong to shared/render")
    endif()
    if(line MATCHES "imgui" AND NOT file MATCHES "^editor/(window|panels)/")
      list(APPEND problems "${file}: ImGui belongs to editor/window and editor/panels")
    endif()
  endforeach()
endforeach()

list(REMOVE_DUPLICATES folders)
foreach(folder IN LISTS folders)
  list(LENGTH in_${folder} count)
  if(count GREATER largest_folder)
    list(APPEND problems "${folder}: holds ${count} source files, more than ${largest_folder}; split it")
  endif()
endforeach()

if(NOT files)
  list(APPEND problems "no source files below ${SOURCE_DIR}")
endif()
if(problems)
  list(JOIN problems "\n  " text)
  message(FATAL_ERROR "Layers are broken:\n  ${text}")
endif()
