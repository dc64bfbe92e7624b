#pragma once

#include <string>

namespace rex {

/// Throws Error "written as ENDING, it could not be read back: ..." if rex does not read what it wrote:
/// ".ors" or ".urdf" text that breaks a limit of its reader.
void requireReadable(const std::string& text, const std::string& ending);

}  // namespace rex
