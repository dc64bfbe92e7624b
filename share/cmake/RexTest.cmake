# Tests: one program per folder of tests/, one entry of ctest per file.

# The modules that `scripts/test --all` tests under the sanitizers: those that read files of users or talk to processes,
# but not the grader, which links with nearly all of the library. `scripts/test --long` tests all.
set(REX_SANITIZED_MODULES base formats geometry remote scene live_server)

# What nearly all tests include takes longer to compile than the rest of them.
function(rex_test_headers)
  file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/no_tests.cpp "")
  add_executable(rex_test_headers ${CMAKE_CURRENT_BINARY_DIR}/no_tests.cpp)
  target_compile_options(rex_test_headers PRIVATE ${REX_WARNINGS} "${REX_COLD}")
  target_link_libraries(rex_test_headers PRIVATE Eigen3::Eigen GTest::gmock_main)
  target_include_directories(rex_test_headers PRIVATE ${PROJECT_SOURCE_DIR}/src)
  target_precompile_headers(rex_test_headers PRIVATE
    <base/eigen_instances.h> <Eigen/Dense> <gmock/gmock.h> <gtest/gtest.h>)
endfunction()

# rex_tests(FOLDER [MATRICES] SOURCES a_test.cpp ... [USES module ...] [PRIVATE library ...] [APART a_test.cpp ...]
#           [ALONE a_test.cpp ...])
#
# Builds the program FOLDER_tests from sources in tests/FOLDER and registers each file as FOLDER/a. The cases of a file
# share a process; those of the files APART, which take long or change their process, have one each: FOLDER/b.Suite.Case. ALONE as in rex_module.
function(rex_tests folder)
  cmake_parse_arguments(ARG "MATRICES" "" "SOURCES;USES;PRIVATE;APART;ALONE" ${ARGN})
  set(target ${folder}_tests)
  add_executable(${target} ${ARG_SOURCES})
  target_compile_options(${target} PRIVATE ${REX_WARNINGS} "${REX_COLD}")
  target_precompile_headers(${target} REUSE_FROM rex_test_headers)
  target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  list(TRANSFORM ARG_USES PREPEND rex_)
  target_link_libraries(${target} PRIVATE GTest::gmock_main rex_base ${ARG_USES} ${ARG_PRIVATE})
  if(TARGET rex_${folder})
    target_link_libraries(${target} PRIVATE rex_${folder})
  endif()
  set_property(GLOBAL APPEND PROPERTY REX_TEST_PROGRAMS ${target})
  rex_batch_size(at_most ${ARG_MATRICES})
  set(together ${ARG_SOURCES})
  list(REMOVE_ITEM together ${ARG_ALONE} "")
  rex_merge_sources(${target} merged ${at_most} ${together})
  if(folder IN_LIST REX_SANITIZED_MODULES)
    set_property(GLOBAL APPEND PROPERTY REX_SANITIZED_TESTS ${target})
  endif()
  foreach(source IN LISTS ARG_SOURCES)
    rex_test_file(${folder} ${source})
  endforeach()
endfunction()

# The entries of one file; its cases are those of the suites that it names.
function(rex_test_file folder source)
  cmake_path(GET source STEM name)
  string(REGEX REPLACE "_test$" "" name ${name})
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${source})
  file(STRINGS ${source} lines REGEX "^(TYPED_)?TEST(_F|_P)?\\(")
  set(suites)
  foreach(line IN LISTS lines)
    string(REGEX REPLACE "^[A-Z_]+\\(([A-Za-z0-9_]+),.*" "\\1" suite "${line}")
    list(APPEND suites ${suite})
  endforeach()
  list(REMOVE_DUPLICATES suites)
  # A suite in two files of a program would run twice, or not at all.
  get_property(known GLOBAL PROPERTY REX_SUITES_OF_${folder})
  foreach(suite IN LISTS suites)
    if(suite IN_LIST known)
      message(FATAL_ERROR "tests/${folder}/${source}: another file of this folder has a suite ${suite}, too")
    endif()
  endforeach()
  set_property(GLOBAL APPEND PROPERTY REX_SUITES_OF_${folder} ${suites})
  set(filters)
  foreach(suite IN LISTS suites)
    list(APPEND filters ${suite}.* */${suite}.* ${suite}/*)
  endforeach()
  list(JOIN filters ":" filter)
  set(properties LABELS ${folder} TIMEOUT 600)
  if(source IN_LIST ARG_APART)
    gtest_discover_tests(${target} TEST_PREFIX ${folder}/${name}. TEST_FILTER "${filter}" DISCOVERY_TIMEOUT 60
                         TEST_LIST ${target}_${name}_cases PROPERTIES ${properties})
  else()
    add_test(NAME ${folder}/${name} COMMAND ${target} --gtest_filter=${filter} --gtest_brief=0)
    set_tests_properties(${folder}/${name} PROPERTIES ${properties} FAIL_REGULAR_EXPRESSION "Running 0 tests")
  endif()
endfunction()
