# SPDX-License-Identifier: MIT
# The toolchain of the module: Debian's clang 16, lld and the C and C++ libraries of WASI.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR wasm32)
set(CMAKE_CXX_COMPILER clang++-16)
set(CMAKE_CXX_COMPILER_TARGET wasm32-wasi)
# The driver would look into this machine's own headers, those of another processor, and not for libc++.
set(CMAKE_CXX_FLAGS_INIT "-nostdlibinc -isystem /usr/lib/llvm-16/include/wasm32-wasi/c++/v1 \
-idirafter /usr/include/wasm32-wasi")
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
