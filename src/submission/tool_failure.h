#pragma once

#include <string>
#include <string_view>

#include "base/process.h"

namespace rex::grading {

/// The linker's complaint about the object file: the line that explains it, or that the file's variables are
/// too large if no line names the file; empty if there is none.
[[nodiscard]] std::string complaintAbout(std::string_view object, std::string_view linkerText);

/// Whether what a linker says explains its failure by the object file: by functions that it lacks or defines
/// twice, or by a complaintAbout() it.
[[nodiscard]] bool blamesObject(std::string_view linkerText, std::string_view object);

/// The line of a tool's output that explains most, or how it ended if there is none.
[[nodiscard]] std::string lastWordsOf(const ProcessResult& run);

}  // namespace rex::grading
