#pragma once

#include "sandbox/confinement.h"
#include "sandbox/landlock.h"

namespace rex::sandbox {

/// The call by which the launcher becomes a student's program: execveat() of an open file, by these very
/// pointers. They must lie where nobody can guess: see hiddenWords().
struct ProgramStart {
  int program = -1;  ///< a descriptor; below 0: nothing is started
  const char* path = nullptr;
  char* const* arguments = nullptr;
  char* const* environment = nullptr;
};

/// From now on, for ever, and for what this thread starts. A student's program may make the calls of honest
/// programs, and no other program can start in its place after `start`; tools may make all calls up to the
/// newest that was looked at. Calls that no honest program makes end it with SIGSYS, others that lead out of
/// the sandbox fail, and at level 1 also what this version of landlock does not rule. What is unknown fails
/// as on a kernel without it. Throws Error where the kernel cannot filter.
void filterSystemCalls(const Confinement& confinement, const ProgramStart& start = {},
                       int landlock = landlockVersion());

}  // namespace rex::sandbox
