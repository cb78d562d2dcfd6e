# Fails where the player's program links a library that only authoring needs, or one that brings
# a hundred others into every start.
execute_process(COMMAND readelf -d ${PLAYER} OUTPUT_VARIABLE dynamic RESULT_VARIABLE result)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "Cannot read ${PLAYER}")
endif()
string(REGEX MATCHALL "Shared library: \\[[^]]*\\]" needed "${dynamic}")
foreach(library IN LISTS needed)
  if(library MATCHES "imgui|ceres|assimp|draco|embree|espeak|sphinx|freetype|OpenEXR|Imath|libzip|flann|meshopt|imgcodecs|videoio|systemd|heif|avfilter|icu")
    message(FATAL_ERROR "The player needs ${library}")
  endif()
endforeach()
