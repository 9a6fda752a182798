# What build_prebuilt makes, under TO: the program as bin/liggghts-solidem, and what is preloaded as
# lib/solidem/libsolidem_liggghts.so.
execute_process(COMMAND ${CMAKE_CURRENT_LIST_DIR}/build_prebuilt
  OUTPUT_VARIABLE paths RESULT_VARIABLE status)
if(NOT status EQUAL 0 OR NOT paths MATCHES "program ([^\n]+)\npreload ([^\n]+)\n")
  message(FATAL_ERROR "build_prebuilt failed")
endif()
set(program ${CMAKE_MATCH_1})
set(preload ${CMAKE_MATCH_2})
file(MAKE_DIRECTORY ${TO}/bin ${TO}/lib/solidem)
file(COPY_FILE ${program} ${TO}/bin/liggghts-solidem)
file(COPY_FILE ${preload} ${TO}/lib/solidem/libsolidem_liggghts.so)
