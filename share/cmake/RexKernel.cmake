set(REX_KERNEL_FLAGS_4_LANES -mavx2)

# rex_kernel(TARGET kernel.cpp ...)
#
# Compiles kernels (see src/base/pack.h), all that TARGET has, three times, with REX_LANES = 1, 2 and 4: the first two
# for every x86-64 and for arm64, the last for AVX2, and without FMA, so that all give the same bits. src/base/cpu_lanes.h
# chooses.
# Headers of Eigen are out of reach: of a template the linker might keep the copy that needs AVX2.
function(rex_kernel target)
  set(all_lanes 1 2)
  if(CMAKE_SYSTEM_PROCESSOR STREQUAL x86_64)
    list(APPEND all_lanes 4)
  endif()
  foreach(lanes IN LISTS all_lanes)
    set(objects ${target}_${lanes}_lanes)
    add_library(${objects} OBJECT ${ARGN})
    target_include_directories(${objects} PRIVATE ${PROJECT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR}/tests)
    target_compile_definitions(${objects} PRIVATE REX_LANES=${lanes})
    target_compile_options(${objects} PRIVATE ${REX_WARNINGS})
    target_sources(${target} PRIVATE $<TARGET_OBJECTS:${objects}>)
  endforeach()
  if(TARGET ${target}_4_lanes)
    target_compile_options(${target}_4_lanes PRIVATE ${REX_KERNEL_FLAGS_4_LANES})
    set_property(GLOBAL APPEND PROPERTY REX_KERNEL_OBJECTS $<TARGET_OBJECTS:${target}_4_lanes>)
  endif()
endfunction()
