#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/process.h"
#include "submission/build_tools.h"

namespace rex::grading {

/// Compiles the shares of a source (see sourceShares()) at once and links them to one `object`; meanwhile
/// another compiler only reads the whole source, the file `name` beside the object, by the same `command`.
/// Gives what that one said, with the warnings that the others add, as the compiler's JSON; nothing where the
/// source has to be compiled as it stands: there are no shares, or something else failed than the whole by an
/// error of its own.
[[nodiscard]] std::optional<ProcessResult> compileShares(
    const std::vector<std::string>& shares, const std::vector<std::string>& command, const std::string& name,
    const std::filesystem::path& object,
    const std::function<BuildTools(const std::filesystem::path& folder)>& toolsFor);

}  // namespace rex::grading
