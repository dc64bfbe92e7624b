# Compiler settings shared by every target.
option(REX_SANITIZE "Build with the address, undefined-behaviour and leak sanitizers" OFF)
option(REX_FUZZ "Build the programs of tests/fuzz with libFuzzer; needs clang" OFF)

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)

# -O1 keeps debug builds usable: unoptimised Eigen is some fifty times slower.
set(CMAKE_CXX_FLAGS_DEBUG "-O1 -g")
set(CMAKE_CXX_FLAGS_RELEASE "-O2 -DNDEBUG")

# No contraction: the same bits on every x86-64. No errno: sqrt becomes one instruction.
add_compile_options(-ffp-contract=off -fno-math-errno)

if(REX_SANITIZE)
  # Reports need lines only; all that debuggers want would make compiling half as long again.
  add_compile_options(-fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer -g1)
  add_link_options(-fsanitize=address,undefined)
endif()
if(REX_FUZZ)
  # Comparisons are not traced: the dictionaries know the words, and it would cost a fifth of the speed.
  add_compile_options(-fsanitize=fuzzer-no-link -fno-sanitize-coverage=trace-cmp)
endif()

set(REX_WARNINGS -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wnon-virtual-dtor
                 -Woverloaded-virtual -Werror)
