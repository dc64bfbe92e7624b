# How exercises are built. A student's program is compiled outside this build, by what build.json says.

# How a student's program is compiled: cheap to build, asserts on, warnings that help beginners. What was never set is
# NaN in a matrix and about -1e303 elsewhere, so that no sum of it passes, and what cannot be meant is an error: no return, and values read before they are set.
# Sections let the grader tell what main() refers to from what the student's functions do.
# The parameters keep the compiler's garbage collector quiet: a seventh less time for 70 MB more memory.
set(REX_STUDENT_FLAGS -std=c++20 -O1 -ffp-contract=off -fno-math-errno -Wall -Wextra -Wno-unused-parameter
                      -Werror=return-type -Werror=uninitialized -Wno-error=maybe-uninitialized
                      -ftrivial-auto-var-init=pattern -DEIGEN_INITIALIZE_MATRICES_BY_NAN -D_GLIBCXX_ASSERTIONS
                      -ffunction-sections -fno-gnu-unique --param=ggc-min-expand=400 --param=ggc-min-heapsize=1000000)
set(REX_STUDENT_LINK_FLAGS "")
if(REX_HAS_GOLD)
  set(REX_STUDENT_LINK_FLAGS -fuse-ld=gold)
endif()
if(REX_SANITIZE)
  list(APPEND REX_STUDENT_FLAGS -g1 -fsanitize=address,undefined -fno-sanitize-recover=undefined
                                -fno-omit-frame-pointer)
  list(APPEND REX_STUDENT_LINK_FLAGS -fsanitize=address,undefined)
endif()

# Headers of the library that teach further types to cross to the worker.
set(REX_REMOTE_HEADERS course/remote_simulator.h)

# The modules that every student's program may use; an exercise names further ones. The grader is not among them.
set(REX_STUDENT_MODULES base geometry remote scene formats kinematics collision dynamics physics render course)

# course/course.h, precompiled with the flags of a student's program by the target rex_student_prefix: prefix.h.gch, and
# in prefix.h.d the files it was made of. Leaves its place, without the endings, in `variable`; with the sanitizers and
# other compilers, which go without, nothing.
function(rex_precompiled_course variable)
  set(${variable} "" PARENT_SCOPE)
  if(REX_SANITIZE OR NOT CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    return()
  endif()
  set(prefix ${PROJECT_BINARY_DIR}/student/prefix.h)
  set(${variable} ${prefix} PARENT_SCOPE)
  if(TARGET rex_student_prefix)
    return()
  endif()
  file(CONFIGURE OUTPUT ${prefix} CONTENT "#include \"course/course.h\"\n")
  get_target_property(eigen Eigen3::Eigen INTERFACE_INCLUDE_DIRECTORIES)
  add_custom_command(OUTPUT ${prefix}.gch
    COMMAND ${CMAKE_CXX_COMPILER} ${REX_STUDENT_FLAGS} -isystem ${PROJECT_SOURCE_DIR}/src -isystem ${eigen}
            -MD -MF ${prefix}.d -MQ ${prefix}.gch -x c++-header ${prefix} -o ${prefix}.new
    COMMAND ${CMAKE_COMMAND} -E rename ${prefix}.new ${prefix}.gch  # no compiler reads half of it
    DEPENDS ${prefix} DEPFILE ${prefix}.d COMMENT "Precompiling course/course.h" VERBATIM)
  add_custom_target(rex_student_prefix DEPENDS ${prefix}.gch)
endfunction()

# The same in REX_PREFIX for the exercise in `folder`, where its header includes course/course.h first.
function(rex_student_prefix folder)
  set(REX_PREFIX "" PARENT_SCOPE)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${folder}/exercise.h)
  # Nothing before it may change what it says.
  file(READ ${folder}/exercise.h header)
  if(header MATCHES "^((//[^\n]*|#pragma once|#include [^\n]*)?\n)*#include \"course/course.h\"")
    rex_precompiled_course(prefix)
    set(REX_PREFIX "${prefix}" PARENT_SCOPE)
  endif()
endfunction()

function(rex_json_strings variable)
  list(TRANSFORM ARGN REPLACE "(.+)" "\"\\1\"")
  list(JOIN ARGN ", " text)
  set(${variable} "${text}" PARENT_SCOPE)
endfunction()

# Writes interface.h, worker.cpp and grader.cpp for the FUNCTIONS into the folder OUTPUT.
function(rex_exercise_sources output)
  set(number 0)
  foreach(function IN LISTS ARGN)
    list(APPEND inits "${function}(caller, ${number}, \"${function}\")")
    string(APPEND REX_MEMBERS "  rex::remote::Call<decltype(::${function})> ${function};\n")
    list(APPEND layouts "rex::remote::CallLayout<decltype(::${function})>::texts()")
    list(APPEND hashes "rex::remote::functionHash<decltype(::${function})>(\"${function}\")")
    string(APPEND REX_RUNS "REX_RUN(${function})\n")
    list(APPEND methods "rex::remote::method<&::${function}>(\"${function}\", &rexRun_${function})")
    math(EXPR number "${number} + 1")
  endforeach()
  foreach(header IN LISTS REX_REMOTE_HEADERS)
    string(APPEND REX_REMOTE_INCLUDES "#include \"${header}\"\n")
  endforeach()
  list(JOIN inits ", " REX_MEMBER_INITS)
  list(JOIN layouts ",\n            " REX_LAYOUTS)
  list(JOIN hashes ",\n                                     " REX_HASHES)
  list(JOIN methods ",\n                                         " REX_METHODS)
  foreach(file interface.h worker.cpp grader.cpp)
    configure_file(${PROJECT_SOURCE_DIR}/share/cmake/exercise/${file}.in ${output}/${file} @ONLY)
  endforeach()
endfunction()

# The worker's loop. It waits for the student's object file and is compiled as that is: from the same prefix.
function(rex_worker_object name folder output)
  set(source ${output}/worker.cpp)
  if(NOT REX_PREFIX)
    add_library(${name}_worker OBJECT ${source})
    target_include_directories(${name}_worker PRIVATE ${PROJECT_SOURCE_DIR}/src)
    target_link_libraries(${name}_worker PRIVATE Eigen3::Eigen)
    target_compile_options(${name}_worker PRIVATE ${REX_WARNINGS} "SHELL:-iquote \"${folder}\"")
    set(REX_WORKER_OBJECT $<TARGET_OBJECTS:${name}_worker> PARENT_SCOPE)
  else()
    set(object ${output}/worker.o)
    set(fatal)
    if(CMAKE_COMPILE_WARNING_AS_ERROR)
      set(fatal -Werror)
    endif()
    get_target_property(eigen Eigen3::Eigen INTERFACE_INCLUDE_DIRECTORIES)
    add_custom_command(OUTPUT ${object}
      COMMAND ${CMAKE_CXX_COMPILER} ${REX_STUDENT_FLAGS} ${fatal} -include ${REX_PREFIX} -iquote ${folder}
              -isystem ${PROJECT_SOURCE_DIR}/src -isystem ${eigen} -MD -MF ${object}.d -c ${source} -o ${object}
      DEPENDS ${source} ${REX_PREFIX}.gch DEPFILE ${object}.d COMMENT "Building the worker of ${name}" VERBATIM)
    add_custom_target(${name}_worker DEPENDS ${object})
    add_dependencies(${name}_worker rex_student_prefix)
    set(REX_WORKER_OBJECT ${object} PARENT_SCOPE)
  endif()
  set_target_properties(${name}_worker PROPERTIES REX_FOLDER ${folder})
endfunction()

# An archive of show.cpp, which draws for main(), compiled as a student's file is: linked where main() calls what is in
# it. Leaves its place in REX_SHOW; without a show.cpp, nothing.
function(rex_show name folder output)
  set(REX_SHOW "" PARENT_SCOPE)
  set(source ${folder}/show.cpp)
  if(NOT EXISTS ${source})
    return()
  endif()
  set(archive ${output}/show.a)
  set(object ${output}/show.o)
  set(prefix)
  set(precompiled)
  if(REX_PREFIX)
    set(prefix -include ${REX_PREFIX})
    set(precompiled ${REX_PREFIX}.gch)
  endif()
  get_target_property(eigen Eigen3::Eigen INTERFACE_INCLUDE_DIRECTORIES)
  add_custom_command(OUTPUT ${archive}
    COMMAND ${CMAKE_CXX_COMPILER} ${REX_STUDENT_FLAGS} ${prefix} -iquote ${folder} -isystem ${PROJECT_SOURCE_DIR}/src
            -isystem ${eigen} -MD -MF ${object}.d -MQ ${archive} -c ${source} -o ${object}
    COMMAND ${CMAKE_AR} rcs ${archive} ${object}
    DEPENDS ${source} ${precompiled} DEPFILE ${object}.d COMMENT "Building what ${name} shows" VERBATIM)
  add_custom_target(${name}_show DEPENDS ${archive})
  if(REX_PREFIX)
    add_dependencies(${name}_show rex_student_prefix)
  endif()
  set(REX_SHOW ${archive} PARENT_SCOPE)
endfunction()

# What `rex-worker-part` leaves of the modules for workers: nothing of what the exercise forbids is in it.
function(rex_worker_part name folder output)
  set(objects)
  set(libraries)
  foreach(module IN LISTS ARGN)
    foreach(target ${module} ${module}_1_lanes ${module}_2_lanes ${module}_4_lanes)
      if(TARGET ${target})
        list(APPEND objects $<TARGET_OBJECTS:${target}>)
      endif()
    endforeach()
    get_target_property(its_libraries ${module} LINK_LIBRARIES)
    list(APPEND libraries ${its_libraries})
  endforeach()
  list(FILTER libraries EXCLUDE REGEX "^rex_")
  list(REMOVE_DUPLICATES libraries)
  set(files)
  foreach(library IN LISTS libraries)
    if(TARGET ${library})
      get_target_property(type ${library} TYPE)
      if(NOT type STREQUAL INTERFACE_LIBRARY)
        list(APPEND files $<TARGET_LINKER_FILE:${library}>)
      endif()
    elseif(IS_ABSOLUTE ${library})  # others, as -ldl, are in the C library
      list(APPEND files ${library})
    endif()
  endforeach()
  set(groups ${PROJECT_SOURCE_DIR}/share/cmake/exercise/function_groups.toml)
  set(part ${output}/worker_part.o)
  rex_json_strings(functions ${ARG_FUNCTIONS})  # as in TOML
  rex_json_strings(link_flags ${REX_STUDENT_LINK_FLAGS})
  set(order ${output}/worker_part.toml)
  file(GENERATE OUTPUT ${order} CONTENT "\
exercise = \"${folder}\"
groups = \"${groups}\"
worker = \"${REX_WORKER_OBJECT}\"
objects = [\"$<JOIN:${objects},\",\n\">\"]
functions = [${functions}]
libraries = [\"$<JOIN:${files},\", \">\"]
compiler = \"${CMAKE_CXX_COMPILER}\"
link_flags = [${link_flags}]
objcopy = \"${CMAKE_OBJCOPY}\"
nm = \"${CMAKE_NM}\"
folder = \"${output}\"
")
  add_custom_command(OUTPUT ${part} ${output}/worker_part.options ${output}/worker.offers ${output}/worker.control
    COMMAND rex_worker_part ${order}
    DEPENDS rex_worker_part rex_submission ${REX_WORKER_OBJECT} ${objects} ${order} ${groups} ${folder}/exercise.toml
    COMMENT "Extracting what ${name} allows of the library" VERBATIM)
  add_custom_target(${name}_worker_part DEPENDS ${part} ${output}/worker.offers)
endfunction()

# The built files that an exercise cannot be graded or shown without. Uses REX_PREFIX and REX_SHOW.
function(rex_exercise_products variable name output)
  set(products ${output}/worker_part.o ${output}/worker_part.options ${output}/worker.offers ${output}/worker.control
               ${output}/build.json)
  if(REX_PREFIX)
    list(APPEND products ${output}/worker.o)
  endif()
  set(${variable} $<TARGET_FILE:${name}_grader> ${products} ${REX_SHOW} PARENT_SCOPE)
endfunction()

# Adds to a list of modules those that they are linked with: a program has to find, and a sandbox to show, all of them.
function(rex_all_modules variable)
  set(found ${${variable}})
  set(new ${found})
  while(new)
    list(POP_FRONT new module)
    get_target_property(libraries ${module} LINK_LIBRARIES)
    list(FILTER libraries INCLUDE REGEX "^rex_")
    list(REMOVE_ITEM libraries ${found})
    list(APPEND found ${libraries})
    list(APPEND new ${libraries})
  endwhile()
  list(REMOVE_DUPLICATES found)
  set(${variable} ${found} PARENT_SCOPE)
endfunction()

# What every check.cpp includes, compiled once for all graders.
function(rex_grader_headers)
  if(TARGET rex_grader_headers)
    return()
  endif()
  file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/student/no_checks.cpp CONTENT "int main() {}\n")
  add_executable(rex_grader_headers ${PROJECT_BINARY_DIR}/student/no_checks.cpp)
  target_compile_options(rex_grader_headers PRIVATE ${REX_GRADER_OPTIONS})
  target_link_libraries(rex_grader_headers PRIVATE rex_grading rex_course)
  target_precompile_headers(rex_grader_headers PRIVATE <grading/throwing_assertions.h> <course/course.h>
                            <course/remote_simulator.h> <grading/check.h> <remote/call.h> <remote/layout.h>)
endfunction()

# Answers lead checks to places that are not there: the library's containers look, too.
set(REX_GRADER_OPTIONS ${REX_WARNINGS} "${REX_COLD}" -D_GLIBCXX_ASSERTIONS)

# rex_exercise(NAME FUNCTIONS function ... [USES module ...] [FOLDER folder] [OUTPUT folder])
#
# NAME is a folder of exercises/ with exercise.h, which declares the FUNCTIONS that a student completes, and
# check.cpp. USES names the modules, beyond those of REX_STUDENT_MODULES, that the student's program and the checks need.
# Builds into build/PRESET/exercises/NAME the program `grader`, the object file of the worker's loop, show.a with
# what draws for main(), and build.json, which says how to compile and link a student's program; the target NAME_ready is all of it. FOLDER and OUTPUT give
# other places.
function(rex_exercise name)
  cmake_parse_arguments(ARG "" "FOLDER;OUTPUT" "FUNCTIONS;USES" ${ARGN})
  if(NOT ARG_FOLDER)
    set(ARG_FOLDER ${PROJECT_SOURCE_DIR}/exercises/${name})
  endif()
  if(NOT IS_DIRECTORY ${ARG_FOLDER})
    message(STATUS "${name} is not part of this release")
    return()
  endif()
  if(NOT ARG_OUTPUT)
    set(ARG_OUTPUT ${PROJECT_BINARY_DIR}/exercises/${name})
  endif()
  rex_exercise_sources(${ARG_OUTPUT} ${ARG_FUNCTIONS})
  rex_student_prefix(${ARG_FOLDER})
  rex_worker_object(${name} ${ARG_FOLDER} ${ARG_OUTPUT})
  rex_show(${name} ${ARG_FOLDER} ${ARG_OUTPUT})
  set(modules ${REX_STUDENT_MODULES} ${ARG_USES})
  list(TRANSFORM modules PREPEND rex_)
  rex_all_modules(modules)

  rex_grader_headers()
  if(REX_MERGE_SOURCES)  # see rex_merge_sources
    file(CONFIGURE OUTPUT ${ARG_OUTPUT}/merged.cpp CONTENT "#include \"grader.cpp\"\n#include \"check.cpp\"\n")
    add_executable(${name}_grader ${ARG_OUTPUT}/merged.cpp)
  else()
    add_executable(${name}_grader ${ARG_OUTPUT}/grader.cpp ${ARG_FOLDER}/check.cpp)
  endif()
  set_target_properties(${name}_grader PROPERTIES OUTPUT_NAME grader RUNTIME_OUTPUT_DIRECTORY ${ARG_OUTPUT})
  target_link_libraries(${name}_grader PRIVATE rex_grading ${modules} fmt::fmt)
  target_compile_options(${name}_grader PRIVATE ${REX_GRADER_OPTIONS} "SHELL:-iquote \"${ARG_FOLDER}\""
                                                "SHELL:-iquote \"${ARG_OUTPUT}\"")
  target_precompile_headers(${name}_grader REUSE_FROM rex_grader_headers)
  rex_worker_part(${name} ${ARG_FOLDER} ${ARG_OUTPUT} ${modules})
  add_custom_target(${name}_ready DEPENDS ${name}_grader ${name}_worker ${name}_worker_part ${modules})
  rex_exercise_products(products ${name} ${ARG_OUTPUT})
  set_target_properties(${name}_ready PROPERTIES REX_WORKER_PART ${ARG_OUTPUT}/worker_part REX_PRODUCTS "${products}")
  if(REX_PREFIX)
    add_dependencies(${name}_ready rex_student_prefix)
  endif()
  if(REX_SHOW)
    add_dependencies(${name}_ready ${name}_show)
  endif()
  set_property(GLOBAL APPEND PROPERTY REX_READY ${name}_ready)
  if(ARG_FOLDER STREQUAL "${PROJECT_SOURCE_DIR}/exercises/${name}")
    set_property(GLOBAL APPEND PROPERTY REX_EXERCISES ${name})
    # It finds the libraries by its own place, here as where it is installed.
    set_target_properties(${name}_grader PROPERTIES BUILD_WITH_INSTALL_RPATH ON INSTALL_RPATH "$ORIGIN/../../lib")
  endif()
  rex_exercise_description()
  rex_exercise_editor_support()
endfunction()

# Editors want to know how the student's files are compiled; nobody builds this target.
function(rex_exercise_editor_support)
  file(GLOB sources ${ARG_FOLDER}/main.cpp ${ARG_FOLDER}/solution.cpp ${ARG_FOLDER}/show.cpp)
  if(sources)
    add_library(${name}_editor OBJECT EXCLUDE_FROM_ALL ${sources})
    target_compile_options(${name}_editor PRIVATE ${REX_STUDENT_FLAGS} "SHELL:-iquote \"${ARG_FOLDER}\""
                                                  "SHELL:-isystem \"${PROJECT_SOURCE_DIR}/src\"")
    target_link_libraries(${name}_editor PRIVATE Eigen3::Eigen)
  endif()
endfunction()

# build.json: how to build a student's program. Uses the variables of rex_exercise().
function(rex_exercise_description)
  get_target_property(eigen Eigen3::Eigen INTERFACE_INCLUDE_DIRECTORIES)
  rex_json_strings(REX_COMPILE_JSON ${REX_STUDENT_FLAGS} -iquote ${ARG_FOLDER} -isystem
                   ${PROJECT_SOURCE_DIR}/src -isystem ${eigen})
  rex_json_strings(REX_LINK_JSON ${REX_STUDENT_LINK_FLAGS} -Wl,-rpath,${PROJECT_BINARY_DIR}/lib)
  set(libraries)
  foreach(module IN LISTS modules)
    list(APPEND libraries $<TARGET_FILE:${module}>)
  endforeach()
  rex_json_strings(REX_LIBRARIES_JSON ${libraries})
  rex_json_strings(REX_FUNCTIONS_JSON ${ARG_FUNCTIONS})
  configure_file(${PROJECT_SOURCE_DIR}/share/cmake/exercise/build.json.in
                 ${CMAKE_CURRENT_BINARY_DIR}/${name}.build.json.in @ONLY)
  file(GENERATE OUTPUT ${ARG_OUTPUT}/build.json INPUT ${CMAKE_CURRENT_BINARY_DIR}/${name}.build.json.in)
endfunction()

# build/PRESET/student/program.json: how `rex run FILE.cpp` builds a program of its own. It may use every module; which
# ones it needs, the headers tell that it includes, and where a class has its body in several modules, its symbols
# (the property REX_SYMBOLS).
function(rex_program_description)
  get_target_property(eigen Eigen3::Eigen INTERFACE_INCLUDE_DIRECTORIES)
  rex_json_strings(REX_COMPILE_JSON ${REX_STUDENT_FLAGS} -isystem ${PROJECT_SOURCE_DIR}/src -isystem ${eigen})
  rex_json_strings(REX_LINK_JSON ${REX_STUDENT_LINK_FLAGS} -Wl,-rpath,${PROJECT_BINARY_DIR}/lib)
  rex_precompiled_course(REX_PREFIX)
  get_property(modules GLOBAL PROPERTY REX_MODULE_TARGETS)
  foreach(module IN LISTS modules)
    get_target_property(folder ${module} SOURCE_DIR)
    get_target_property(sources ${module} SOURCES)
    get_target_property(uses ${module} LINK_LIBRARIES)
    get_target_property(symbols ${module} REX_SYMBOLS)
    list(FILTER symbols EXCLUDE REGEX "NOTFOUND$")
    list(FILTER sources INCLUDE REGEX "\\.cpp$")
    list(TRANSFORM sources REPLACE "(.*/)?([^/]+)\\.cpp$" "\\2.h")
    list(FILTER uses INCLUDE REGEX "^rex_")
    file(RELATIVE_PATH folder ${PROJECT_SOURCE_DIR}/src ${folder})
    rex_json_strings(headers ${sources})
    rex_json_strings(uses ${uses})
    rex_json_strings(symbols ${symbols})
    list(APPEND lines "    {\"target\": \"${module}\", \"file\": \"$<TARGET_FILE:${module}>\", \"folder\": \"${folder}\",
     \"headers\": [${headers}], \"symbols\": [${symbols}], \"uses\": [${uses}]}")
  endforeach()
  list(JOIN lines ",\n" REX_LIBRARIES_JSON)
  configure_file(${PROJECT_SOURCE_DIR}/share/cmake/exercise/program.json.in
                 ${CMAKE_CURRENT_BINARY_DIR}/program.json.in @ONLY)
  file(GENERATE OUTPUT ${PROJECT_BINARY_DIR}/student/program.json INPUT ${CMAKE_CURRENT_BINARY_DIR}/program.json.in)
endfunction()

# rex_worker(TARGET EXERCISE source ...)
#
# Builds a worker program from student sources that have no main(), for tests.
function(rex_worker target exercise)
  get_target_property(folder ${exercise}_worker REX_FOLDER)
  get_target_property(part ${exercise}_ready REX_WORKER_PART)
  add_executable(${target} ${ARGN})
  add_dependencies(${target} ${exercise}_worker_part)
  target_compile_options(${target} PRIVATE ${REX_STUDENT_FLAGS} -UNDEBUG "SHELL:-iquote \"${folder}\""
                                           "SHELL:-isystem \"${PROJECT_SOURCE_DIR}/src\"")
  target_link_libraries(${target} PRIVATE ${part}.o -Wl,@${part}.options -Wl,--no-relax Eigen3::Eigen)
  set_property(TARGET ${target} APPEND PROPERTY LINK_DEPENDS ${part}.o ${part}.options)
endfunction()
