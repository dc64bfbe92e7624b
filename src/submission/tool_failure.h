#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/process.h"
#include "submission/compiler_messages.h"

namespace rex::grading {

/// Whether the tool, or one that it had started and names at the end of its output, was ended by SIGKILL:
/// by a limit or from outside.
[[nodiscard]] bool wasKilled(const ProcessResult& run);

/// The compiler's message if its only error is that it could not write because a disk or quota is full.
/// Text that a source makes it print is ignored.
[[nodiscard]] std::optional<std::string> fullDiskIn(const std::vector<CompileDiagnostic>& messages);

/// The linker's complaint about the object file rather than the machine: the line that explains it, or that
/// the file's variables are too large if no line names the file; empty if there is none.
[[nodiscard]] std::string complaintAbout(std::string_view object, std::string_view linkerText);

/// The line of a tool's output that explains most, or how it ended if there is none.
[[nodiscard]] std::string lastWordsOf(const ProcessResult& run);

}  // namespace rex::grading
