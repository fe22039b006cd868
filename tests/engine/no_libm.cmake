# cmake -DNM=... -DLIBRARIES=... -P no_libm.cmake: checks that the engine does not call functions of
# libm that differ in the last bit between platforms, because it determines the bytes of pot files.
# sqrt, floor, fma and similar functions are exact everywhere.

set(inexact "a?(sin|cos|tan)h?(pi)?|atan2|sincos|exp(2|10|m1)?|log(2|10|1p)?|pow|hypot|cbrt|erfc?|[lt]gamma")
foreach(library IN LISTS LIBRARIES)
  execute_process(COMMAND ${NM} --undefined-only ${library}
    OUTPUT_VARIABLE symbols COMMAND_ERROR_IS_FATAL ANY)
  if(NOT symbols MATCHES " U memcpy")
    message(SEND_ERROR "${library}: expected names of undefined symbols, found:\n${symbols}")
  endif()
  string(REGEX MATCHALL " U (${inexact})[fl]?(@[^\n]*)?\n" found "${symbols}")
  if(found)
    list(JOIN found " " found)
    message(SEND_ERROR "${library}: calls functions that differ between platforms: ${found}")
  endif()
endforeach()
