# What nearly all sources include, compiled once for each level of optimisation, and with it the declarations of what
# base/eigen_instances.h has compiled.
function(rex_module_headers)
  foreach(level module cold_module)
    set(source ${PROJECT_BINARY_DIR}/src/${level}.cpp)
    file(CONFIGURE OUTPUT ${source} CONTENT "")
    add_library(rex_${level}_headers OBJECT ${source})
    target_compile_options(rex_${level}_headers PRIVATE ${REX_MODULE_OPTIONS})
    target_include_directories(rex_${level}_headers PRIVATE ${PROJECT_SOURCE_DIR}/src)
    target_link_libraries(rex_${level}_headers PRIVATE Eigen3::Eigen fmt::fmt)
    target_precompile_headers(rex_${level}_headers PRIVATE
      <base/eigen_instances.h> <fmt/format.h> <algorithm> <cmath> <filesystem> <functional> <map> <memory> <optional>
      <string> <string_view> <vector>)
  endforeach()
  target_compile_options(rex_cold_module_headers PRIVATE "${REX_COLD}")
endfunction()

# Loops begin where processors fetch a line of code: otherwise the speed of Eigen's inner loops depends on what stands
# before them in the library, by a third at times.
set(REX_MODULE_OPTIONS ${REX_WARNINGS} -fno-semantic-interposition -ffunction-sections -fdata-sections -falign-loops=32)

# rex_module(NAME [COLD] [MATRICES] SOURCES a.cpp ... [USES module ...] [PRIVATE library ...])
#
# One shared library rex_NAME from this folder, src/NAME; a room inside a module, or a part that is built apart, has its
# module's name in front: cli_robot, course_cars. USES names the rex modules whose headers its headers include; PRIVATE
# names third-party libraries, which stay inside the .cpp files; all have Eigen, which alone is public, and fmt. COLD:
# compiled fast, not for speed. MATRICES: full of matrix expressions, see rex_merge_sources.
#
# Shared, so that each of the many programs (graders, tests, students' workers) links in no time with what it needs and
# nothing else. Calls inside a library do not go through its table of symbols.
function(rex_module name)
  cmake_parse_arguments(ARG "COLD;MATRICES" "" "SOURCES;USES;PRIVATE" ${ARGN})
  set(target rex_${name})
  add_library(${target} SHARED ${ARG_SOURCES})
  set_property(GLOBAL APPEND PROPERTY REX_MODULE_TARGETS ${target})
  # They find each other side by side, here as where they are installed.
  set_target_properties(${target} PROPERTIES LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/lib
                                             BUILD_WITH_INSTALL_RPATH ON INSTALL_RPATH "$ORIGIN")
  target_include_directories(${target} PUBLIC ${PROJECT_SOURCE_DIR}/src)
  target_compile_options(${target} PRIVATE ${REX_MODULE_OPTIONS})
  target_link_options(${target} PRIVATE -Wl,-Bsymbolic-functions $<$<NOT:$<BOOL:${REX_SANITIZE}>>:-Wl,-z,defs>)
  target_link_libraries(${target} PUBLIC Eigen3::Eigen)
  list(TRANSFORM ARG_USES PREPEND rex_)
  target_link_libraries(${target} PUBLIC ${ARG_USES} PRIVATE fmt::fmt ${ARG_PRIVATE})
  if(ARG_COLD)
    target_compile_options(${target} PRIVATE "${REX_COLD}")
    target_precompile_headers(${target} REUSE_FROM rex_cold_module_headers)
  else()
    target_precompile_headers(${target} REUSE_FROM rex_module_headers)
  endif()
  rex_merge_sources(${target} ${ARG_MATRICES})
endfunction()

# Several sources are compiled as one where REX_MERGE_SOURCES is on: most of the time goes into headers and templates
# that they share. Not so with Eigen's expressions, of which each source has its own kinds: more of them at once take
# longer than in proportion.
function(rex_merge_sources target matrices)
  if(REX_MERGE_SOURCES)
    set(at_most 24)
    if(matrices)
      set(at_most 4)
    endif()
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${at_most})
  endif()
endfunction()
