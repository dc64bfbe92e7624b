# rex_exercise_gates(NAME)
#
# Registers one test per gate of exercises/NAME, label `exercise`. `rex dev check NAME --gate GATE` runs one by hand. All
# wrong variants are one gate, which compiles them together; it takes longest, so it starts first. The entry `sample`,
# label `sample-NAME`, tests a part of three gates; scripts/test runs it.
function(rex_exercise_gates name)
  set(variants)
  if(REX_SANITIZE)
    set(gates hostile)  # it asks graders most; each gate links a solution of 200 MB
  else()
    set(gates main-current points names release evidence main-floor mains solution hostile grown liars pasted mutants sanitizers)
    set(wrong_file ${PROJECT_SOURCE_DIR}/exercises/${name}/wrong.cpp)
    if(EXISTS ${wrong_file})
      file(STRINGS ${wrong_file} variants REGEX "^// <variant ")
      list(TRANSFORM variants REPLACE "^// <variant ([^>]*)>.*$" "\\1")
    endif()
  endif()
  if(variants)
    list(APPEND gates wrong)
    add_test(NAME exercise/${name}/sample COMMAND rex_gates ${name})
    set_tests_properties(exercise/${name}/sample PROPERTIES LABELS sample-${name} TIMEOUT 1200)
  endif()
  foreach(gate IN LISTS gates)
    add_test(NAME exercise/${name}/${gate} COMMAND rex-teach dev check ${name} --gate ${gate})
    set_tests_properties(exercise/${name}/${gate} PROPERTIES LABELS "exercise;${name}" TIMEOUT 600)
  endforeach()
  # Built with the sanitizers, a solution takes a quarter of a minute to compile, and so do some programs to draw; the
  # others ask it many times.
  foreach(gate mains sanitizers hostile grown liars pasted mutants)
    if(TEST exercise/${name}/${gate})
      set_tests_properties(exercise/${name}/${gate} PROPERTIES LABELS "exercise;${name};long")
    endif()
  endforeach()
  set_tests_properties(exercise/${name}/hostile PROPERTIES TIMEOUT 10000)
  if(TEST exercise/${name}/mutants)
    set_tests_properties(exercise/${name}/mutants PROPERTIES TIMEOUT 3600)
  endif()
  if(variants)
    set_tests_properties(exercise/${name}/wrong PROPERTIES COST 30 TIMEOUT 1200)
  endif()
  # The same, each in a file of its own as a student's: see writing-an-exercise.md. No gates of the list, hence without
  # the exercise's label.
  foreach(variant IN LISTS variants)
    add_test(NAME exercise/${name}/wrong/${variant} COMMAND rex-teach dev check ${name} --gate wrong/${variant})
    set_tests_properties(exercise/${name}/wrong/${variant} PROPERTIES LABELS "exercise;long;variant" TIMEOUT 600)
  endforeach()
endfunction()
