#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "grading/results.h"
#include "submission/build_tools.h"
#include "submission/compiler_messages.h"

namespace rex::submission {

/// Finds what would make the compiler report other files or lines, or suppress messages as in a system
/// header: #line, "# 1", and the pragma for system headers, however they are spelt. Each is an error with
/// the rule "line-marker" at its line; of too many, only the first are named. Comments are skipped only if
/// they begin a line and the source has no raw string, because elsewhere two C++ parsers could disagree about
/// them: so this is the one reader that does not use CppText. Takes time in proportion to the source.
[[nodiscard]] std::vector<grading::CompileDiagnostic> lineMarkers(std::string_view source,
                                                                  const std::string& mainFile);

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
[[nodiscard]] std::vector<grading::CompileDiagnostic> forbiddenIncludes(
    const std::vector<std::filesystem::path>& dependencies, std::string_view source,
    const std::string& mainFile, const std::filesystem::path& folder, const Toolchain& toolchain);

/// The same error if `source` defines a macro `rex`: it would rename things in the library's own headers.
[[nodiscard]] std::vector<grading::CompileDiagnostic> forbiddenMacros(std::string_view source,
                                                                      const std::string& mainFile);

}  // namespace rex::submission
