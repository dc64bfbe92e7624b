#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/process.h"
#include "submission/build_tools.h"

namespace rex::grading {

/// Compiles a part of a source (see gradedPart()) to `object`, while another compiler only reads the whole:
/// the file `name` beside the object. Both take `command`. Gives what that one said, with the warnings that
/// the part's adds, as the compiler's JSON; nothing where the source has to be compiled as it stands, for
/// something failed and it is not an error in the whole.
[[nodiscard]] std::optional<ProcessResult> compilePart(
    const std::string& part, const std::vector<std::string>& command, const std::string& name,
    const std::filesystem::path& object,
    const std::function<BuildTools(const std::filesystem::path& folder)>& toolsFor);

}  // namespace rex::grading
