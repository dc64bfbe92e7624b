#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace rex::grading {

/// One complaint about a student's file, from the compiler, the linker or the symbol scan.
struct CompilerMessage {
  std::string file;  ///< "main.cpp"
  int line = 0;      ///< from 1; 0 unknown
  int column = 0;
  std::string severity;  ///< "error" or "warning"
  std::string rule;      ///< "-Wunused-variable", "forbidden-call"; may be empty
  std::string message;
};

/// "main.cpp:47:3: error: message [rule]".
[[nodiscard]] std::string toString(const CompilerMessage& message);

/// Errors and warnings in what g++ wrote with -fdiagnostics-format=json; text that is no such array counts
/// as none. Their files are as the compiler names them.
[[nodiscard]] std::vector<CompilerMessage> parseCompilerJson(std::string_view standardError);

/// Moves each message about another file to the line of `mainFile` that caused it, found in the plain text
/// the compiler wrote about the same run ("required from here", "included from"); line 0 when it tells not.
void blameMainFile(std::vector<CompilerMessage>& messages, const std::string& mainFile,
                   std::string_view plainText);

/// One error for each function that the linker misses or finds twice.
[[nodiscard]] std::vector<CompilerMessage> parseLinkerText(std::string_view standardError,
                                                           const std::string& mainFile);

}  // namespace rex::grading
