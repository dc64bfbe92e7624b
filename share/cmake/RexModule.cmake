# What nearly all sources include, compiled once, and with it the declarations of what base/eigen_instances.h has
# compiled. Sources at another level of optimisation take it, too.
function(rex_module_headers)
  set(source ${PROJECT_BINARY_DIR}/src/module.cpp)
  file(CONFIGURE OUTPUT ${source} CONTENT "")
  add_library(rex_module_headers OBJECT ${source})
  target_compile_options(rex_module_headers PRIVATE ${REX_MODULE_OPTIONS})
  target_include_directories(rex_module_headers PRIVATE ${PROJECT_SOURCE_DIR}/src)
  target_link_libraries(rex_module_headers PRIVATE Eigen3::Eigen fmt::fmt)
  target_precompile_headers(rex_module_headers PRIVATE
    <base/eigen_instances.h> <fmt/format.h> <algorithm> <cmath> <filesystem> <functional> <map> <memory> <optional>
    <string> <string_view> <vector>)
endfunction()

# Loops begin where processors fetch a line of code: otherwise the speed of Eigen's inner loops depends on what stands
# before them in the library, by a third at times.
set(REX_MODULE_OPTIONS ${REX_WARNINGS} -fno-semantic-interposition -ffunction-sections -fdata-sections -falign-loops=32)

# rex_module(NAME [COLD] [MATRICES] SOURCES a.cpp ... [COLD_SOURCES b.cpp ...] [USES module ...] [PRIVATE library ...]
#            [ALONE a.cpp ...])
#
# One shared library rex_NAME from this folder, src/NAME; a room inside a module, or a part that is built apart, has its
# module's name in front: cli_robot, course_cars. USES names the rex modules whose headers its headers include; PRIVATE
# names third-party libraries, which stay inside the .cpp files; all have Eigen, which alone is public, and fmt. COLD and
# COLD_SOURCES: compiled fast, not for speed. MATRICES: full of matrix expressions, see rex_batch_size. ALONE: those of
# the SOURCES that are not merged with others.
#
# Shared, so that each of the many programs (graders, tests, students' workers) links in no time with what it needs and
# nothing else. Calls inside a library do not go through its table of symbols.
function(rex_module name)
  cmake_parse_arguments(ARG "COLD;MATRICES" "" "SOURCES;COLD_SOURCES;USES;PRIVATE;ALONE" ${ARGN})
  set(target rex_${name})
  add_library(${target} SHARED ${ARG_SOURCES} ${ARG_COLD_SOURCES})
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
  target_precompile_headers(${target} REUSE_FROM rex_module_headers)
  if(ARG_COLD)
    target_compile_options(${target} PRIVATE "${REX_COLD}")
  endif()
  rex_batch_size(at_most ${ARG_MATRICES})
  list(REMOVE_ITEM ARG_SOURCES ${ARG_ALONE} "")
  rex_merge_sources(${target} merged ${at_most} ${ARG_SOURCES})
  rex_merge_sources(${target} cold ${at_most} ${ARG_COLD_SOURCES})
  set_source_files_properties(${ARG_COLD_SOURCES} ${cold} PROPERTIES COMPILE_OPTIONS "${REX_COLD}")
endfunction()

# rex_merge_sources(TARGET NAME AT_MOST a.cpp ...)
#
# Compiles up to AT_MOST of these sources of TARGET as one where REX_MERGE_SOURCES is on: most of the time goes into
# headers and templates that they share. Unlike those of CMake's unity builds, the merged files name sources as headers
# are named, from src/ or tests/ on, so that ccache recognises them in another clone. Generated sources, whose names have
# a folder of the build, stay as they are. Leaves the list of merged files in the variable NAME.
function(rex_merge_sources target name at_most)
  set(sources ${ARGN})
  list(FILTER sources EXCLUDE REGEX "^/")
  list(LENGTH sources count)
  set(files)
  if(REX_MERGE_SOURCES AND count GREATER 1)
    set_source_files_properties(${sources} PROPERTIES HEADER_FILE_ONLY ON)
    cmake_path(RELATIVE_PATH CMAKE_CURRENT_SOURCE_DIR BASE_DIRECTORY ${PROJECT_SOURCE_DIR} OUTPUT_VARIABLE place)
    string(REGEX REPLACE "^(src|tests)/" "" place "${place}")
    set(number 0)
    while(sources)
      list(SUBLIST sources 0 ${at_most} batch)
      list(REMOVE_ITEM sources ${batch})
      list(TRANSFORM batch REPLACE "(.+)" "#include \"${place}/\\1\"\n")
      list(JOIN batch "" text)
      set(file ${CMAKE_CURRENT_BINARY_DIR}/${target}_merged/${name}_${number}.cpp)
      file(CONFIGURE OUTPUT ${file} CONTENT "${text}")
      list(APPEND files ${file})
      math(EXPR number "${number} + 1")
    endwhile()
    target_sources(${target} PRIVATE ${files})
  endif()
  set(${name} ${files} PARENT_SCOPE)
endfunction()

# The number of sources to merge. Fewer if they are full of Eigen's expressions: each source has its own kinds of them,
# and the time grows faster than their number.
function(rex_batch_size variable matrices)
  if(matrices)
    set(${variable} 4 PARENT_SCOPE)
  else()
    set(${variable} 24 PARENT_SCOPE)
  endif()
endfunction()
