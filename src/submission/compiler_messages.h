#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "grading/results.h"

namespace rex::grading {

/// Errors and warnings in what g++ wrote with -fdiagnostics-format=json; text that is no such array counts
/// as none. Their files are as the compiler names them.
[[nodiscard]] std::vector<CompileDiagnostic> parseCompilerJson(std::string_view standardError);

/// The same from its plain text without source lines, "file:line:column: error: message".
[[nodiscard]] std::vector<CompileDiagnostic> parseCompilerText(std::string_view standardError);

/// Errors of the assembler about lines, "file:line: Error: message"; lines of the compiler's own file count
/// as 0. That it could not write is not among them.
[[nodiscard]] std::vector<CompileDiagnostic> parseAssemblerText(std::string_view standardError);

/// Moves each message about another file to the line of `mainFile` that caused it, found in the plain text
/// the compiler wrote about the same run ("required from here", "included from"); line 0 if unknown.
void blameMainFile(std::vector<CompileDiagnostic>& messages, const std::string& mainFile,
                   std::string_view plainText);

/// Makes messages fit for results and logs: each text printable(), on one line and of at most 2000 bytes, and
/// at most 50 of them. Returns whether some were left out.
bool admitMessages(std::vector<CompileDiagnostic>& messages);

/// One error for each function that the linker misses or finds twice.
[[nodiscard]] std::vector<CompileDiagnostic> parseLinkerText(std::string_view standardError,
                                                             const std::string& mainFile);

}  // namespace rex::grading
