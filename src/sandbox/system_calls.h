#pragma once

#include "sandbox/confinement.h"
#include "sandbox/landlock.h"

namespace rex::sandbox {

/// From now on, for ever, and for what this thread starts: system calls that no honest program makes end it
/// with SIGSYS, others that lead out of the sandbox fail, and at level 1 also what this version of landlock
/// does not rule. Throws Error where the kernel cannot filter.
void filterSystemCalls(const Confinement& confinement, int landlock = landlockVersion());

}  // namespace rex::sandbox
