#pragma once

namespace rex::sandbox {

/// From now on, for ever, and for what this process becomes: the memory of other processes is neither read
/// nor written, and none is traced, where the kernel has landlock (5.13) or we are root. Their variables may
/// stay readable. Nothing else is forbidden, so that it does for programs that are not confined. For use
/// between fork and exec. Returns whether it holds.
bool leaveOthersAlone() noexcept;

}  // namespace rex::sandbox
