#pragma once

#include "sandbox/confinement.h"

namespace rex::sandbox {

/// From now on, for ever, and for what this thread starts: system calls that no honest program makes end it
/// with SIGSYS, others that lead out of the sandbox fail. Throws Error where the kernel cannot filter.
void filterSystemCalls(const Confinement& confinement);

}  // namespace rex::sandbox
