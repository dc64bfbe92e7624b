#pragma once

#include <filesystem>

namespace rex::cli {

/// Builds a copy of a student release from nothing, in the new folder `in`, where it stays, or, if that is
/// empty, in a temporary one with a blank in its name; in it each untouched main.cpp must be graded below the
/// full score, and run without a display and leave a picture. Takes minutes. Throws Error with the step and
/// the end of what it said.
void proveRelease(const std::filesystem::path& release, const std::filesystem::path& in);

}  // namespace rex::cli
