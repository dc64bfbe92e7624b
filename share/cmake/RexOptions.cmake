# Compiler settings shared by every target.
option(REX_SANITIZE "Build with the address, undefined-behaviour and leak sanitizers" OFF)
option(REX_QUICK_SANITIZERS "Leave out what they ask at each use of a pointer" OFF)
option(REX_FUZZ "Build the programs of tests/fuzz with libFuzzer; needs clang" OFF)

# Where ccache is installed, nothing is compiled twice on a machine: it also recognises a source in another clone, by paths
# relative to the clone. The settings are part of each command, because rex itself starts builds. CCACHE_DISABLE=1 in the
# environment turns it off. Not for clang, which rejects a precompiled header if one of its files has a new modification
# time. Debuggers look for sources in the folder that an object names, so builds for them share nothing with other clones.
find_program(REX_CCACHE ccache)
if(REX_CCACHE AND CMAKE_CXX_COMPILER_ID STREQUAL GNU AND NOT DEFINED CMAKE_CXX_COMPILER_LAUNCHER AND NOT DEFINED ENV{CMAKE_CXX_COMPILER_LAUNCHER})
  set(CMAKE_CXX_COMPILER_LAUNCHER ${PROJECT_SOURCE_DIR}/share/cmake/through-ccache CCACHE_BASEDIR=${PROJECT_SOURCE_DIR} CCACHE_SLOPPINESS=pch_defines,time_macros)
  if(CMAKE_BUILD_TYPE STREQUAL Release OR REX_SANITIZE)
    list(APPEND CMAKE_CXX_COMPILER_LAUNCHER CCACHE_NOHASHDIR=1)
  endif()
  list(APPEND CMAKE_CXX_COMPILER_LAUNCHER ${REX_CCACHE})
endif()

# A source that changes then brings its neighbours along: for machines that build everything once.
if(CMAKE_BUILD_TYPE STREQUAL Release)
  set(merge_by_default ON)
else()
  set(merge_by_default OFF)
endif()
option(REX_MERGE_SOURCES "Compile several sources of a module as one" ${merge_by_default})

# Merged sources take up to 1.5 GB each: no more of them at once than there is memory for.
cmake_host_system_information(RESULT memory QUERY TOTAL_PHYSICAL_MEMORY)
math(EXPR jobs "(${memory} + 1499) / 1500")
set_property(GLOBAL PROPERTY JOB_POOLS compile=${jobs})
set(CMAKE_JOB_POOL_COMPILE compile)

# g++ 12 of Debian 12 gives no warnings, so they can be errors here, too. Then scripts/demo and scripts/test compile with
# the same options, and scripts/test builds nothing again. Other compilers may have other warnings.
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_CXX_COMPILER_VERSION VERSION_GREATER_EQUAL 12 AND
   CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13 AND
   NOT DEFINED CMAKE_COMPILE_WARNING_AS_ERROR)
  set(CMAKE_COMPILE_WARNING_AS_ERROR ON)
endif()

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)

# -O1 keeps debug builds usable: unoptimised Eigen is some fifty times slower.
set(CMAKE_CXX_FLAGS_DEBUG "-O1 -g")
set(CMAKE_CXX_FLAGS_RELEASE "-O2 -DNDEBUG")

if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  # The compiler's garbage collector keeps quiet: a twelfth less time for a sixth more memory.
  add_compile_options(--param=ggc-min-expand=400 --param=ggc-min-heapsize=1000000)
  # Symbols that are unique in a process cannot be made local, as those of the worker's part must be.
  add_compile_options(-fno-gnu-unique)
endif()

# A link takes a third of the time with gold, which not every binutils has.
include(CheckLinkerFlag)
check_linker_flag(CXX -fuse-ld=gold REX_HAS_GOLD)
if(REX_HAS_GOLD)
  add_link_options(-fuse-ld=gold)
endif()

# No contraction: the same bits on every x86-64; Eigen's code for arm64 fuses anyway. No errno: sqrt is one instruction.
add_compile_options(-ffp-contract=off -fno-math-errno)

if(REX_SANITIZE)
  # Reports need lines only; all that debuggers want would make compiling half as long again.
  add_compile_options(-fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer -g1)
  add_link_options(-fsanitize=address,undefined)
  add_compile_options($<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)  # g++ 12, of std::regex with the sanitizers
  if(REX_QUICK_SANITIZERS)
    # These take a third of the time; a null pointer ends in a report anyway. Long runs have them.
    add_compile_options(-fno-sanitize=null,alignment,object-size,vptr)
  endif()
endif()
if(REX_FUZZ)
  # Comparisons are not traced: the dictionaries know the words, and it would cost a fifth of the speed.
  add_compile_options(-fsanitize=fuzzer-no-link -fno-sanitize-coverage=trace-cmp)
endif()

# How code is compiled that runs once, or waits for people and files. At this level g++ 12 warns of what is not there.
set(REX_COLD "-O1;-Wno-array-bounds;-Wno-maybe-uninitialized;-Wno-stringop-overflow")
# From version 13 on, g++ has these at -O2 only, and refuses a precompiled header with others.
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_CXX_COMPILER_VERSION VERSION_GREATER_EQUAL 13)
  if(CMAKE_SYSTEM_PROCESSOR STREQUAL x86_64)
    string(APPEND REX_COLD ";-munroll-only-small-loops;-mvzeroupper")
  elseif(CMAKE_CXX_COMPILER_VERSION VERSION_GREATER_EQUAL 14)
    string(APPEND REX_COLD ";-mearly-ra=all")
  endif()
endif()
set(REX_COLD "$<$<CONFIG:Release>:${REX_COLD}>")

set(REX_WARNINGS -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wnon-virtual-dtor -Wswitch-enum
                 -Woverloaded-virtual)
# From version 13 on, g++ warns at -O2, too, of copies in std::vector whose length it does not know, and of references to
# what lives as long as the program if a function that looks them up gets a temporary.
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_CXX_COMPILER_VERSION VERSION_GREATER_EQUAL 13)
  list(APPEND REX_WARNINGS -Wno-stringop-overflow -Wno-dangling-reference)
endif()
