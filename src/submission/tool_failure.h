#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/process.h"
#include "submission/compiler_messages.h"

namespace rex::grading {

/// Whether the tool itself, or one that it had started and names in its last words, was ended by SIGKILL: by
/// a limit or from outside.
[[nodiscard]] bool wasKilled(const ProcessResult& run);

/// The compiler's words if its one error is that it could not write, because a disk or a share of it is full.
/// What a source makes it say does not count.
[[nodiscard]] std::optional<std::string> fullDiskIn(const std::vector<CompileDiagnostic>& messages);

/// What a linker has against the object file rather than the machine: the line that explains it, or that the
/// file's variables are too large for any to name it; empty if nothing.
[[nodiscard]] std::string complaintAbout(std::string_view object, std::string_view linkerText);

/// The line of a tool's text that explains most, or how it ended if there is none.
[[nodiscard]] std::string lastWordsOf(const ProcessResult& run);

}  // namespace rex::grading
