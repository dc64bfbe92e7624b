#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "submission/compiler_messages.h"
#include "submission/toolchain.h"

namespace rex::grading {

/// The files in the list that a compiler writes by -MD, under the names by which it opened them; relative
/// ones are in `folder`. Without the target.
[[nodiscard]] std::vector<std::filesystem::path> dependenciesIn(std::string_view list,
                                                                const std::filesystem::path& folder);

/// The same of the list that the assembler writes by --MD, without its own input, which is the last: files
/// that a source takes in by .incbin and .include.
[[nodiscard]] std::vector<std::filesystem::path> filesOfAssembler(std::string_view list,
                                                                  const std::filesystem::path& folder);

/// An error of rule "forbidden-call" for each file that a student's main.cpp was compiled with and must not
/// be: one that is not a header of the system, no public header of the library or of the libraries beside it,
/// no header of studentHeaders(), and not `mainFile` of `folder` itself. A file counts by device, inode and
/// the place where it truly lies, whatever links and dots its name goes through. What such a file holds would
/// be compiled into the student's functions, where no scan of symbols finds it. At the line of `source` that
/// names it, if one does.
[[nodiscard]] std::vector<CompileDiagnostic> forbiddenIncludes(
    const std::vector<std::filesystem::path>& dependencies, std::string_view source,
    const std::string& mainFile, const std::filesystem::path& folder, const Toolchain& toolchain);

/// The same error where `source` defines a macro called `rex`: the library's own text would get other names.
[[nodiscard]] std::vector<CompileDiagnostic> forbiddenMacros(std::string_view source,
                                                             const std::string& mainFile);

}  // namespace rex::grading
