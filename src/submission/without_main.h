#pragma once

#include <filesystem>
#include <optional>

#include "submission/build_tools.h"
#include "submission/toolchain.h"

namespace rex::grading {

/// Links a student's object file into `part` without main() and what only main() uses. What is reachable
/// from a function that the worker needs or from code that runs before main() remains; a pointer to main()
/// in it keeps main(). The file must be compiled with -ffunction-sections -fdata-sections. Returns the
/// linker's result; empty if the file has only main(). Throws Error like readObjectFile() and
/// BuildTools::run().
[[nodiscard]] std::optional<ProcessResult> withoutMain(const std::filesystem::path& object,
                                                       const std::filesystem::path& part,
                                                       const Toolchain& toolchain, const BuildTools& tools);

}  // namespace rex::grading
