#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "grading/results.h"

namespace rex::submission {

/// Whether the output of a compiler, as JSON, or of an assembler seems to name an error: a quick look, for
/// texts that only the compiled file itself can make misleading.
[[nodiscard]] bool namesErrors(std::string_view standardError);

/// Errors and warnings in the output of g++ with -fdiagnostics-format=json; none if the text is not such an
/// array. Files are named as by the compiler.
[[nodiscard]] std::vector<grading::CompileDiagnostic> parseCompilerJson(std::string_view standardError);

/// The same from its plain text without source lines, "file:line:column: error: message".
[[nodiscard]] std::vector<grading::CompileDiagnostic> parseCompilerText(std::string_view standardError);

/// The assembler's errors about lines, "file:line: Error: message"; lines of the compiler's temporary file
/// become 0. Failures to write are not included.
[[nodiscard]] std::vector<grading::CompileDiagnostic> parseAssemblerText(std::string_view standardError);

/// Moves each message about another file to the line of `mainFile` that caused it, found in the compiler's
/// plain text for the same run ("required from here", "included from"); line 0 if unknown.
void blameMainFile(std::vector<grading::CompileDiagnostic>& messages, const std::string& mainFile,
                   std::string_view plainText);

/// How many messages a result may have.
inline constexpr std::size_t kMostMessages = 50;

/// Makes messages suitable for results and logs: each is printable(), on one line and at most 2000 bytes
/// long. Keeps at most kMostMessages, and returns whether some were left out.
bool admitMessages(std::vector<grading::CompileDiagnostic>& messages);

/// One error for each function that the linker cannot find or finds twice.
[[nodiscard]] std::vector<grading::CompileDiagnostic> parseLinkerText(std::string_view standardError,
                                                                      const std::string& mainFile);

/// Adds a sentence to each visible check that failed in a function which calls, itself or through others of
/// the file, a function that failed in an earlier check: "circle uses ikStep, which fails above [step-hand]."
void explainCascades(std::vector<grading::CheckResult>& checks, std::string_view source);

}  // namespace rex::submission
