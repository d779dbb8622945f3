# Language level, warnings, sanitizers and the floating-point rules that the guarantee rests on.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()

find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE_PROGRAM})
endif()

# Everything the project compiles gets these. No contraction (fused multiply-add would change signs and bytes between machines), no fast-math.
add_library(smopt_settings INTERFACE)
target_compile_options(smopt_settings INTERFACE -ffp-contract=off -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
  -Wnon-virtual-dtor -Wold-style-cast -Woverloaded-virtual -Wcast-align)
# GCC 12's straight-line vectoriser drops the rounding in double(float(x)) on neighbouring values (0.1 stays 0.1 in full); boxes and axes that are
# kept in single precision must be the values that were tested.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  target_compile_options(smopt_settings INTERFACE -fno-tree-slp-vectorize)
  # GCC 12 reports overlapping copies inside std::string that cannot happen (its bug 105651).
  target_compile_options(smopt_settings INTERFACE -Wno-restrict)
endif()
if(SMOPT_WARNINGS_AS_ERRORS)
  target_compile_options(smopt_settings INTERFACE -Werror)
endif()
if(SMOPT_SANITIZE)
  target_compile_options(smopt_settings INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(smopt_settings INTERFACE -fsanitize=address,undefined)
endif()
target_include_directories(smopt_settings INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>)
