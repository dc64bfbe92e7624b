# What the sanitizers look at in a short run: modules that read files of users or talk to processes, but not the
# grader, which links with nearly all of the library. scripts/test --long looks at all.
set(REX_SANITIZED_MODULES base geometry remote scene)

# What nearly all tests include takes longer to compile than the rest of them.
function(rex_test_headers)
  file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/no_tests.cpp "")
  add_executable(rex_test_headers ${CMAKE_CURRENT_BINARY_DIR}/no_tests.cpp)
  target_compile_options(rex_test_headers PRIVATE ${REX_WARNINGS} "${REX_TEST_OPTIMISATION}")
  target_link_libraries(rex_test_headers PRIVATE Eigen3::Eigen GTest::gmock_main)
  target_precompile_headers(rex_test_headers PRIVATE <Eigen/Dense> <gmock/gmock.h> <gtest/gtest.h>)
endfunction()

# Tests run once for each time that they are compiled. At this level g++ 12 warns of what is not there.
set(REX_TEST_OPTIMISATION "$<$<CONFIG:Release>:SHELL:-O1 -Wno-array-bounds -Wno-maybe-uninitialized -Wno-stringop-overflow>")

# rex_test(MODULE NAME [USES module ...] [PRIVATE library ...])
#
# Builds tests/MODULE/NAME_test.cpp and registers each of its GoogleTest cases as MODULE/NAME.Suite.Case.
function(rex_test module name)
  cmake_parse_arguments(ARG "" "" "USES;PRIVATE" ${ARGN})
  set(target ${module}_${name}_test)
  add_executable(${target} ${PROJECT_SOURCE_DIR}/tests/${module}/${name}_test.cpp)
  target_compile_options(${target} PRIVATE ${REX_WARNINGS} "${REX_TEST_OPTIMISATION}")
  target_precompile_headers(${target} REUSE_FROM rex_test_headers)
  target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  target_compile_definitions(${target} PRIVATE
    REX_SOURCE_DIR="${PROJECT_SOURCE_DIR}" REX_BINARY_DIR="${PROJECT_BINARY_DIR}")
  target_link_libraries(${target} PRIVATE rex_${module} GTest::gmock_main ${ARG_PRIVATE})
  foreach(used IN LISTS ARG_USES)
    target_link_libraries(${target} PRIVATE rex_${used})
  endforeach()
  gtest_discover_tests(${target} TEST_PREFIX ${module}/${name}. DISCOVERY_TIMEOUT 60
    PROPERTIES LABELS ${module} TIMEOUT 300)
  if(module IN_LIST REX_SANITIZED_MODULES)
    set_property(GLOBAL APPEND PROPERTY REX_SANITIZED_TESTS ${target})
  endif()
endfunction()
