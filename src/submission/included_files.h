#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "submission/compiler_messages.h"
#include "submission/toolchain.h"

namespace rex::grading {

/// The files in the dependency list that a compiler writes with -MD, without the target, under the names
/// with which it opened them; relative names are relative to `folder`.
[[nodiscard]] std::vector<std::filesystem::path> dependenciesIn(std::string_view list,
                                                                const std::filesystem::path& folder);

/// The same for the list that the assembler writes with --MD, without its own input, which is the last:
/// files that a source includes with .incbin and .include.
[[nodiscard]] std::vector<std::filesystem::path> filesOfAssembler(std::string_view list,
                                                                  const std::filesystem::path& folder);

/// An error with the rule "forbidden-call" for each file that a student's main.cpp must not include,
/// because no scan of symbols finds its code in the student's functions. Allowed are system headers, public
/// headers of the library and its dependencies, studentHeaders(), and `mainFile` of `folder` itself. Files
/// are identified by device, inode and real path, whatever links and dots are in the name. The error is at
/// the line of `source` that names the file, if there is one.
[[nodiscard]] std::vector<CompileDiagnostic> forbiddenIncludes(
    const std::vector<std::filesystem::path>& dependencies, std::string_view source,
    const std::string& mainFile, const std::filesystem::path& folder, const Toolchain& toolchain);

/// The same error if `source` defines a macro `rex`: it would rename things in the library's own headers.
[[nodiscard]] std::vector<CompileDiagnostic> forbiddenMacros(std::string_view source,
                                                             const std::string& mainFile);

}  // namespace rex::grading
