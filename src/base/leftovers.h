#pragma once

#include <filesystem>

namespace rex {

/// Removes what replaceTextFile() and others left in this folder, and down to that depth in folders in it,
/// when their process was killed: files NAME.PID.new of processes that have ended. Only for folders that no
/// other machine writes to meanwhile, whose processes look like ended ones here. Links are not followed; a
/// missing folder has no leftovers.
void removeLeftovers(const std::filesystem::path& folder, int depth = 0);

}  // namespace rex
