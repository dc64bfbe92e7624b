#pragma once

#include <filesystem>

namespace rex::cli {

/// Builds a copy of a student release from nothing, in a temporary folder with a blank in its name; in it
/// each untouched main.cpp must be graded below the full score, and run and leave a picture. Takes minutes.
/// Throws Error with the step and the end of what it said.
void proveRelease(const std::filesystem::path& release);

}  // namespace rex::cli
