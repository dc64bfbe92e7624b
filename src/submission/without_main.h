#pragma once

#include <filesystem>
#include <optional>

#include "submission/build_tools.h"
#include "submission/toolchain.h"

namespace rex::grading {

/// Links the object file of a student into `part`, without main() and without what only main() leads to: what
/// stays is reached from a function that the worker asks for or from what runs before main(). A pointer to
/// main() anywhere there keeps it. Needs a file compiled with
/// -ffunction-sections -fdata-sections. Returns what the linker did; nothing where the file has only main(),
/// so that nobody can use it. Throws Error as readObjectFile() and BuildTools::run().
[[nodiscard]] std::optional<ProcessResult> withoutMain(const std::filesystem::path& object,
                                                       const std::filesystem::path& part,
                                                       const Toolchain& toolchain, const BuildTools& tools);

}  // namespace rex::grading
