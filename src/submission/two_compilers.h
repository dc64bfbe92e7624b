#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/process.h"
#include "submission/build_tools.h"

namespace rex::submission {

/// Compiles a part of a source (see gradedSource()) to `object`, while another compiler checks the syntax of
/// the whole, the file `name` next to the object. Both use `command`. Returns the messages of the second
/// compiler, with additional warnings for the part, as JSON. If a compiler does not end, the result is timed
/// out. Empty if something failed that is not an error in the whole: then the source must be compiled as it
/// is.
[[nodiscard]] std::optional<ProcessResult> compilePart(
    const std::string& part, const std::vector<std::string>& command, const std::string& name,
    const std::filesystem::path& object,
    const std::function<BuildTools(const std::filesystem::path& folder)>& toolsFor);

}  // namespace rex::submission
