# What `cmake --install` copies, in components: runtime (the programs behind rex, libraries, headers, graders, data and
# exercises), development (for other programs: find_package and pkg-config) and documentation. The tree may be moved:
# its files find each other by relative paths. In PREFIX/lib/rex lies what lies in a build folder (ownFolder() in
# src/base/folders.h), in PREFIX/share/rex what lies in the source tree (homeFolder()).

set(REX_INSTALLED lib/rex)

# scripts/package gives that of a commit.
set(REX_PACKAGE_VERSION ${PROJECT_VERSION} CACHE STRING "version of the packages")

# Who answers for a package is who makes it.
set(REX_MAINTAINER "the rex maintainers <rex@localhost>")
if(DEFINED ENV{REX_MAINTAINER})
  set(REX_MAINTAINER "$ENV{REX_MAINTAINER}")
endif()

# The modules that other programs may link. Headers of the others are not installed.
file(STRINGS ${PROJECT_SOURCE_DIR}/share/layers.txt REX_PUBLIC_MODULES REGEX " public$")
list(TRANSFORM REX_PUBLIC_MODULES REPLACE "^[0-9]+ (.*) public$" "\\1")
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/share/layers.txt)

# Never installed: folders and files of running programs, which remain if a program is killed (src/base/folders.h), backups by `rex reset`, lists of dependencies, and the cache of Python.
set(REX_TRANSIENT PATTERN "rex-work-*" EXCLUDE PATTERN "*.new" EXCLUDE PATTERN "main.backup-*" EXCLUDE
                  PATTERN "*.d" EXCLUDE PATTERN "__pycache__" EXCLUDE)

# Here, too, `home` leads to the files, so that a program need not know where it runs.
file(CREATE_LINK ${PROJECT_SOURCE_DIR} ${PROJECT_BINARY_DIR}/home SYMBOLIC)

# Exercises are built on demand, and a tree with some that never were would install without an error: most of their files
# are copied by patterns. So before anything is copied, this names all missing files of exercises and of the given targets.
function(rex_install_only_if_built)
  set(files)
  foreach(target IN LISTS ARGN)
    list(APPEND files "rex|$<TARGET_FILE:${target}>")
  endforeach()
  get_property(exercises GLOBAL PROPERTY REX_EXERCISES)
  foreach(name IN LISTS exercises)
    get_target_property(products ${name}_ready REX_PRODUCTS)
    list(TRANSFORM products PREPEND "${name}|")
    list(APPEND files ${products})
  endforeach()
  install(CODE "
    set(files \"${files}\")
    set(build \"${PROJECT_BINARY_DIR}\")
    include(\"${PROJECT_SOURCE_DIR}/share/cmake/install/only_if_built.cmake\")" COMPONENT runtime)
endfunction()

set(REX_INSTALLED_PROGRAMS rex rex-robot rex-teach rex_sandbox_launcher rex_sandbox_probe)

function(rex_install_programs)
  get_property(modules GLOBAL PROPERTY REX_MODULE_TARGETS)
  install(TARGETS ${modules} LIBRARY DESTINATION ${REX_INSTALLED}/lib COMPONENT runtime)
  install(TARGETS ${REX_INSTALLED_PROGRAMS}
          RUNTIME DESTINATION ${REX_INSTALLED} COMPONENT runtime)
  foreach(module IN LISTS REX_PUBLIC_MODULES)
    install(DIRECTORY ${PROJECT_SOURCE_DIR}/src/${module} DESTINATION include/rex COMPONENT runtime
            FILES_MATCHING PATTERN "*.h" PATTERN "*_internal.h" EXCLUDE)
  endforeach()
  install(CODE "
    function(rex_link place target)
      file(MAKE_DIRECTORY \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/bin\")
      file(CREATE_LINK \${target} \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/\${place}\" SYMBOLIC)
    endfunction()
    rex_link(bin/rex ../${REX_INSTALLED}/rex)
    rex_link(${REX_INSTALLED}/home ../../share/rex)
    rex_link(${REX_INSTALLED}/include ../../include/rex)" COMPONENT runtime)
endfunction()

# Installs a build description without the paths of this machine.
function(rex_install_description file destination)
  install(CODE "
    file(READ \"${file}\" text)
    string(REPLACE \"${PROJECT_BINARY_DIR}\" \"{rex}\" text \"\${text}\")
    string(REPLACE \"${PROJECT_SOURCE_DIR}/src\" \"{include}\" text \"\${text}\")
    string(REPLACE \"${PROJECT_SOURCE_DIR}\" \"{home}\" text \"\${text}\")
    string(REGEX REPLACE \"\\\"prefix\\\": \\\"[^\\\"]*\\\"\" \"\\\"prefix\\\": \\\"\\\"\" text \"\${text}\")
    file(WRITE \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${destination}\" \"\${text}\")" COMPONENT runtime)
endfunction()

function(rex_install_exercises)
  rex_install_description(${PROJECT_BINARY_DIR}/student/program.json ${REX_INSTALLED}/student/program.json)
  get_property(exercises GLOBAL PROPERTY REX_EXERCISES)
  foreach(name IN LISTS exercises)
    set(built ${PROJECT_BINARY_DIR}/exercises/${name})
    set(destination ${REX_INSTALLED}/exercises/${name})
    install(TARGETS ${name}_grader RUNTIME DESTINATION ${destination} COMPONENT runtime)
    install(PROGRAMS ${built}/worker.control DESTINATION ${destination} COMPONENT runtime)
    install(DIRECTORY ${built}/ DESTINATION ${destination} COMPONENT runtime
            FILES_MATCHING PATTERN "worker*.o" PATTERN "worker*.options" PATTERN "worker.offers" PATTERN "show.a"
            ${REX_TRANSIENT})
    rex_install_description(${built}/build.json ${destination}/build.json)
    install(CODE "
      set(folder \"${PROJECT_SOURCE_DIR}/exercises/${name}\")
      set(target \"\${CMAKE_INSTALL_PREFIX}/share/rex/exercises/${name}\")
      include(\"${PROJECT_SOURCE_DIR}/share/cmake/install/exercise_files.cmake\")" COMPONENT runtime)
  endforeach()
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/data DESTINATION share/rex COMPONENT runtime ${REX_TRANSIENT})
  # Those who grade a class get what hands it to Slurm, and the plan of a term: see RexPackage.cmake.
  file(GLOB solutions ${PROJECT_SOURCE_DIR}/exercises/*/solution.cpp)
  set(of_trees "grade-*")
  if(solutions)
    set(of_trees "grade-parallel")
    install(FILES ${PROJECT_SOURCE_DIR}/share/grading/term.toml DESTINATION share/rex/share/grading COMPONENT runtime)
  endif()
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/share/ci DESTINATION share/rex COMPONENT runtime USE_SOURCE_PERMISSIONS
          PATTERN "${of_trees}" EXCLUDE ${REX_TRANSIENT})
  install(FILES ${PROJECT_SOURCE_DIR}/share/completion/rex.bash
          DESTINATION share/bash-completion/completions RENAME rex COMPONENT runtime)
  install(FILES ${PROJECT_SOURCE_DIR}/share/completion/_rex DESTINATION share/zsh/vendor-completions COMPONENT runtime)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/share/course ${PROJECT_SOURCE_DIR}/share/demonstrations ${PROJECT_SOURCE_DIR}/share/examples ${PROJECT_SOURCE_DIR}/share/gdb
                    ${PROJECT_SOURCE_DIR}/share/template
          DESTINATION share/rex/share COMPONENT runtime ${REX_TRANSIENT})
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/.vscode DESTINATION share/rex/share/course COMPONENT runtime)
endfunction()

# Leaves the libraries of public modules in `variable`.
function(rex_public_targets variable)
  get_property(modules GLOBAL PROPERTY REX_MODULE_TARGETS)
  set(public)
  foreach(module IN LISTS modules)
    get_target_property(folder ${module} SOURCE_DIR)
    cmake_path(GET folder FILENAME folder)
    if(folder IN_LIST REX_PUBLIC_MODULES)
      list(APPEND public ${module})
    endif()
  endforeach()
  set(${variable} ${public} PARENT_SCOPE)
endfunction()

function(rex_install_development)
  include(CMakePackageConfigHelpers)
  set(folder ${PROJECT_BINARY_DIR}/development)
  rex_public_targets(modules)
  list(JOIN modules "|" public)
  foreach(module IN LISTS modules)
    get_target_property(uses ${module} LINK_LIBRARIES)
    # A library finds the others by itself; a program names those whose headers it includes.
    list(FILTER uses INCLUDE REGEX "^(${public})$")
    string(REGEX REPLACE "^rex_" "" name ${module})
    string(REGEX REPLACE "rex_" "rex::" targets "${uses}")
    string(APPEND REX_CONFIG_MODULES "rex_imported(${name} Eigen3::Eigen;${targets})\n")
    string(REGEX REPLACE "rex_([^;]+);?" "rex-\\1 " REX_PKG_REQUIRES "${uses}")
    set(REX_PKG_NAME ${name})
    configure_file(${PROJECT_SOURCE_DIR}/share/cmake/install/rex-module.pc.in ${folder}/rex-${name}.pc @ONLY)
    list(APPEND descriptions ${folder}/rex-${name}.pc)
  endforeach()
  configure_file(${PROJECT_SOURCE_DIR}/share/cmake/install/rexConfig.cmake.in ${folder}/rexConfig.cmake @ONLY)
  write_basic_package_version_file(${folder}/rexConfigVersion.cmake COMPATIBILITY SameMinorVersion)
  install(FILES ${folder}/rexConfig.cmake ${folder}/rexConfigVersion.cmake DESTINATION lib/cmake/rex
          COMPONENT development)
  install(FILES ${descriptions} DESTINATION lib/pkgconfig COMPONENT development)
  install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION share/doc/librex-dev RENAME copyright COMPONENT development)
endfunction()

function(rex_install_changelog package component)
  install(CODE "
    set(folder \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/share/doc/${package}\")
    file(COPY_FILE ${PROJECT_BINARY_DIR}/changelog \${folder}/changelog)
    execute_process(COMMAND gzip -9nf \${folder}/changelog COMMAND_ERROR_IS_FATAL ANY)" COMPONENT ${component})
endfunction()

function(rex_install_documentation)
  install(CODE "
    set(page \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/share/man/man1/rex.1\")
    file(MAKE_DIRECTORY \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/share/man/man1\")
    execute_process(COMMAND ${PROJECT_BINARY_DIR}/rex --man OUTPUT_FILE \${page} COMMAND_ERROR_IS_FATAL ANY)
    execute_process(COMMAND gzip -9nf \${page} COMMAND_ERROR_IS_FATAL ANY)" COMPONENT documentation)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/share/doc/ DESTINATION share/doc/rex COMPONENT documentation
          ${REX_TRANSIENT})
  install(FILES ${PROJECT_SOURCE_DIR}/README.md ${PROJECT_SOURCE_DIR}/CHANGELOG.md DESTINATION share/doc/rex
          COMPONENT documentation OPTIONAL)
  install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION share/doc/rex RENAME copyright COMPONENT documentation)
  # Links of the source tree lead to where their targets are installed.
  install(CODE [[
    file(GLOB pages "$ENV{DESTDIR}${CMAKE_INSTALL_PREFIX}/share/doc/rex/*.md")
    foreach(page ${pages})
      file(READ ${page} text)
      string(REPLACE "](share/doc/" "](" text "${text}")
      string(REPLACE "](LICENSE)" "](copyright)" text "${text}")
      string(REPLACE "](../../src/" "](../../../include/rex/" text "${text}")
      string(REGEX REPLACE "\\]\\((\\.\\./|share/)(examples|demonstrations)" "](../../rex/share/\\2" text "${text}")
      string(REPLACE "](exercises/" "](../../rex/exercises/" text "${text}")
      file(WRITE ${page} "${text}")
    endforeach()]] COMPONENT documentation)
  # The form that Debian wants; what changed stands in CHANGELOG.md. By CMake the time is SOURCE_DATE_EPOCH, if that is set.
  string(TIMESTAMP now "%a, %d %b %Y %H:%M:%S +0000" UTC)
  file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/changelog @ONLY
       CONTENT "rex (@REX_PACKAGE_VERSION@) unstable; urgency=medium\n\n  * See CHANGELOG.md.\n\n -- @REX_MAINTAINER@  @now@\n")
  rex_install_changelog(rex documentation)
  rex_install_changelog(librex-dev development)
endfunction()

function(rex_install)
  get_property(modules GLOBAL PROPERTY REX_MODULE_TARGETS)
  install(CODE "execute_process(COMMAND \"${PROJECT_SOURCE_DIR}/scripts/check-layers\" COMMAND_ERROR_IS_FATAL ANY)" COMPONENT runtime)
  rex_install_only_if_built(${REX_INSTALLED_PROGRAMS} ${modules})
  rex_install_programs()
  rex_install_exercises()
  rex_install_development()
  rex_install_documentation()
endfunction()
