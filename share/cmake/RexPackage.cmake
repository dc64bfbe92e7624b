# Packages, by CPack in a build of what students get: scripts/package.
# A tree with solutions makes graders with hidden checks: another package, in the place of the students'.
file(GLOB solutions ${PROJECT_SOURCE_DIR}/exercises/*/solution.cpp)
set(package rex)
if(solutions)
  set(package rex-instructor)
  set(CPACK_DEBIAN_RUNTIME_PACKAGE_PROVIDES "rex (= ${REX_PACKAGE_VERSION})")
  set(CPACK_DEBIAN_RUNTIME_PACKAGE_CONFLICTS rex)
  set(CPACK_DEBIAN_RUNTIME_PACKAGE_REPLACES rex)
endif()
set(CPACK_PACKAGE_NAME ${package})
set(CPACK_PACKAGE_VERSION ${REX_PACKAGE_VERSION})
set(CPACK_PACKAGE_VENDOR rex)
set(CPACK_PACKAGE_CONTACT "${REX_MAINTAINER}")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "robotics exercises: see, solve and test them")
set(CPACK_STRIP_FILES ON)
# With several, the bytes depend on the number of processors.
set(CPACK_THREADS 1)

# Two packages: rex, with all that students need, and librex-dev, for other programs.
set(CPACK_COMPONENTS_ALL runtime documentation development)
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_COMPONENT_RUNTIME_GROUP runtime)
set(CPACK_COMPONENT_DOCUMENTATION_GROUP runtime)
set(CPACK_COMPONENT_DEVELOPMENT_GROUP development)

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_PACKAGE_SECTION education)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME ${package})
set(CPACK_DEBIAN_RUNTIME_FILE_NAME ${package}_${REX_PACKAGE_VERSION}_amd64.deb)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME librex-dev)
set(CPACK_DEBIAN_DEVELOPMENT_FILE_NAME librex-dev_${REX_PACKAGE_VERSION}_amd64.deb)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_RUNTIME_DESCRIPTION
"A course in robotics: kinematics, dynamics, planning, estimation, control,
 learning and grasping. Students complete functions in C++, look at pictures
 and replays of their robot, and have them graded.")
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION
"Targets for CMake and descriptions for pkg-config, one per module of the
 library, for programs outside of a course folder.")
# What programs need of libraries is found in them; the rest is started by name, or is included by student code.
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR}/lib)
string(REGEX MATCH "^[0-9]+" compiler "${CMAKE_CXX_COMPILER_VERSION}")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_DEPENDS
    "g++ (>= 4:${compiler}), binutils, libeigen3-dev, bubblewrap, fonts-dejavu-core, gnuplot-nox, libgl1-mesa-dri, libegl1 | libosmesa6")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_RECOMMENDS "ffmpeg, git, tzdata")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SUGGESTS "gdb, librex-dev")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "rex (= ${REX_PACKAGE_VERSION}), libeigen3-dev")

# For machines without root: unpack it anywhere.
cmake_host_system_information(RESULT system QUERY DISTRIB_INFO)
set(system ${system_ID}${system_VERSION_ID})
set(CPACK_ARCHIVE_COMPONENT_INSTALL OFF)
set(CPACK_ARCHIVE_FILE_NAME ${package}-${REX_PACKAGE_VERSION}-${system})
set(CPACK_PACKAGE_FILE_NAME ${package}-${REX_PACKAGE_VERSION}-${system})
include(CPack)
