# cmake -DSOURCE=... -DHEADER=... -P commit.cmake: writes the built commit for the reports. The
# header is written only if it changes, to avoid recompilation.
execute_process(
  COMMAND git -C ${SOURCE} describe --always --dirty --abbrev=10
  OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
if(failed)
  set(commit "commit unknown")
endif()
file(CONFIGURE OUTPUT ${HEADER} CONTENT "#define CLAYSTACK_COMMIT \"${commit}\"\n" @ONLY)
