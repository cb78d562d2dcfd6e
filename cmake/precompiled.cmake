# Headers of libraries that most sources include are parsed once for the rooms and once for the tests, in the
# unity build only: where each source is compiled by itself, it has to include what it uses. With ccache they
# are parsed as usual, because it would not know a source again after they have been precompiled again.
set(lararium_common_headers
  <algorithm> <array> <chrono> <cmath> <filesystem> <functional> <map> <memory> <mutex> <optional> <ranges>
  <span> <sstream> <string> <string_view> <unordered_map> <variant> <vector>
  <Eigen/Core> <Eigen/Geometry> <glm/glm.hpp> <glm/gtc/quaternion.hpp> <nlohmann/json.hpp>
  <opencv2/core/mat.hpp>)
if(CMAKE_UNITY_BUILD AND NOT LARARIUM_CCACHE AND NOT EMSCRIPTEN AND CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
  foreach(kind rooms tests)
    add_library(lararium_precompiled_${kind} OBJECT ${CMAKE_SOURCE_DIR}/cmake/precompiled.cc)
    target_link_libraries(lararium_precompiled_${kind} PRIVATE
      lararium_options Eigen3::Eigen glm::glm nlohmann_json::nlohmann_json opencv_core)
    target_precompile_headers(lararium_precompiled_${kind} PRIVATE ${lararium_common_headers})
  endforeach()
  target_link_libraries(lararium_precompiled_tests PRIVATE GTest::gmock)
  target_precompile_headers(lararium_precompiled_tests PRIVATE <gmock/gmock.h> <gtest/gtest.h>)
  target_compile_options(lararium_precompiled_tests PRIVATE ${lararium_test_options})
endif()

# lararium_precompile(TARGET rooms|tests): lets a target use them.
function(lararium_precompile target kind)
  if(TARGET lararium_precompiled_${kind})
    target_precompile_headers(${target} REUSE_FROM lararium_precompiled_${kind})
  endif()
endfunction()
