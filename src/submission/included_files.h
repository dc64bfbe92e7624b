#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "grading/results.h"
#include "submission/build_tools.h"
#include "submission/compiler_messages.h"

namespace rex::submission {

/// What the compiler preprocesses in place of a source to show its line markers: every line ends in a tab, so
/// that no line of a raw string reads as a marker, and one more line comes after a gap. Nothing else changes.
[[nodiscard]] std::string sourceForMarkers(std::string_view source);

/// Finds in the preprocessed sourceForMarkers(), and in what the compiler says of it with -pedantic, whether
/// it takes lines of the file for others, as after #line and "# 1", however they are spelt: an error with the
/// rule "line-marker" at the first. Also one if the file includes itself. A comment, a literal or a skipped
/// line is nothing to the compiler, and so not here. If the text is not whole, as after an error, only names
/// of files are looked at. Takes time in proportion to the texts.
[[nodiscard]] std::vector<grading::CompileDiagnostic> lineMarkers(std::string_view text,
                                                                  std::string_view complaints,
                                                                  std::string_view source,
                                                                  const std::string& mainFile, bool isWhole);

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
