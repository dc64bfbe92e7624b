#pragma once

#include "sandbox/confinement.h"
#include "sandbox/landlock.h"

namespace rex::sandbox {

/// The call with which the launcher starts a student's program: execveat() of an open file, with exactly
/// these pointers. They must be at addresses that cannot be guessed: see hiddenWords().
struct ProgramStart {
  int program = -1;  ///< a descriptor; below 0: nothing is started
  const char* path = nullptr;
  char* const* arguments = nullptr;
  char* const* environment = nullptr;
};

/// Permanently filters the system calls of this thread and what it starts. A student's program may make the
/// calls of honest programs, and cannot execute another program after `start`; tools may make all calls
/// known to this list. Calls that no honest program makes end the program with SIGSYS. Others that lead out
/// of the sandbox fail, at level 1 also those that this landlock version does not cover. Unknown calls fail
/// as on a kernel without them. Throws Error if the kernel cannot filter.
void filterSystemCalls(const Confinement& confinement, const ProgramStart& start = {},
                       int landlock = landlockVersion());

}  // namespace rex::sandbox
