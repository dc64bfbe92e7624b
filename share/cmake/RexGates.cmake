# rex_exercise_gates(NAME)
#
# Registers one test per gate of exercises/NAME and one per file in its wrong/, label `exercise`. `rex dev check NAME
# --gate GATE` runs one by hand.
function(rex_exercise_gates name)
  set(gates main-current points names release evidence main-floor solution sanitizers)
  file(GLOB variants ${PROJECT_SOURCE_DIR}/exercises/${name}/wrong/*.cpp)
  foreach(variant IN LISTS variants)
    cmake_path(GET variant STEM stem)
    list(APPEND gates wrong/${stem})
  endforeach()
  foreach(gate IN LISTS gates)
    add_test(NAME exercise/${name}/${gate} COMMAND rex dev check ${name} --gate ${gate})
    set_tests_properties(exercise/${name}/${gate} PROPERTIES LABELS "exercise;${name}" TIMEOUT 600)
  endforeach()
endfunction()
