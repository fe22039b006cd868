# The compiler of the page: Emscripten of Debian 13 with the libraries that sysroot.sh has built.
# Exceptions are those of WebAssembly: libraries and programs must agree.
set(CLAYSTACK_WEB_ROOT $ENV{CLAYSTACK_WEB_ROOT})
set(CMAKE_C_FLAGS_INIT "-fwasm-exceptions")
# jthread is experimental in this libc++; Boost 1.74 uses classes that C++17 removed.
set(CMAKE_CXX_FLAGS_INIT "-fwasm-exceptions -fexperimental-library -D_LIBCPP_ENABLE_CXX17_REMOVED_UNARY_BINARY_FUNCTION")
set(CMAKE_FIND_ROOT_PATH ${CLAYSTACK_WEB_ROOT})
include(/usr/share/emscripten/cmake/Modules/Platform/Emscripten.cmake)
set(ENV{PKG_CONFIG_PATH} ${CLAYSTACK_WEB_ROOT}/lib/pkgconfig)  # Emscripten.cmake sets PKG_CONFIG_LIBDIR
