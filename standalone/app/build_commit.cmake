# Writes the header OUTPUT with the commit of the sources in SOURCE; touches it only for another.
cmake_policy(VERSION 3.20)
execute_process(COMMAND git -C ${SOURCE} describe --always --dirty --exclude=*
  OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE status)
if(NOT status EQUAL 0)
  set(commit "")
endif()
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT "#define SOLIDEM_COMMIT \"${commit}\"\n" @ONLY)
