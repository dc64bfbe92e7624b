#pragma once

#include <filesystem>

namespace rex::cli {

/// Builds a copy of a student release from scratch in the new folder `in`, which is kept, or, if that is
/// empty, in a temporary one with a blank in its name. Each untouched main.cpp must get less than the full
/// score, run without a display, and write a picture. Takes minutes. Throws Error with the failed step and
/// the end of its output.
void proveRelease(const std::filesystem::path& release, const std::filesystem::path& in);

}  // namespace rex::cli
