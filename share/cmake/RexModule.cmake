# rex_module(NAME SOURCES a.cpp ... [USES module ...] [PRIVATE library ...])
#
# One static library rex_NAME from src/NAME. USES names the rex modules whose headers its headers include;
# PRIVATE names third-party libraries, which stay inside the .cpp files. Eigen is the only public one.
function(rex_module name)
  cmake_parse_arguments(ARG "" "" "SOURCES;USES;PRIVATE" ${ARGN})
  add_library(rex_${name} STATIC ${ARG_SOURCES})
  target_include_directories(rex_${name} PUBLIC ${PROJECT_SOURCE_DIR}/src)
  target_compile_options(rex_${name} PRIVATE ${REX_WARNINGS})
  target_link_libraries(rex_${name} PUBLIC Eigen3::Eigen)
  foreach(module IN LISTS ARG_USES)
    target_link_libraries(rex_${name} PUBLIC rex_${module})
  endforeach()
  target_link_libraries(rex_${name} PRIVATE ${ARG_PRIVATE})
endfunction()
