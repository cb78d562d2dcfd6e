# Fails where clang-format would change a file.
if(NOT CLANG_FORMAT)
  message(NOTICE "skipped: clang-format-14 is not installed")
  return()
endif()
file(GLOB_RECURSE files ${SOURCE_DIR}/shared/*.h ${SOURCE_DIR}/shared/*.cc ${SOURCE_DIR}/player/*.h
     ${SOURCE_DIR}/player/*.cc ${SOURCE_DIR}/editor/*.h ${SOURCE_DIR}/editor/*.cc
     ${SOURCE_DIR}/web/*.h ${SOURCE_DIR}/web/*.cc ${SOURCE_DIR}/tests/*.h ${SOURCE_DIR}/tests/*.cc)
execute_process(COMMAND ${CLANG_FORMAT} --dry-run --Werror ${files}
                RESULT_VARIABLE result ERROR_VARIABLE text)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "Run clang-format -i on the files named here:\n${text}")
endif()
