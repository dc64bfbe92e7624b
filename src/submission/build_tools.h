#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "base/process.h"
#include "sandbox/cell.h"
#include "submission/toolchain.h"

namespace rex::grading {

/// What one tool may use.
struct ToolLimits {
  double seconds = 30;                        ///< of processor time; by the clock clockSeconds()
  std::size_t memory = std::size_t{2} << 30;  ///< bytes
  std::size_t fileSize = std::size_t{64} << 20;
};

/// How long a tool may take by the clock that may use so many seconds of processor time. Confined ones find
/// no pipe or terminal to wait for: only a busy machine keeps them, and they get patience.
[[nodiscard]] double clockSeconds(double seconds, sandbox::Level level);

/// Runs compilers and the tools for object files on what a student wrote. Confined, they see the system, the
/// headers that students may include, what workers are linked with, and their work folder. They always run
/// in the first second of 1970, so that the same file becomes the same program on every day.
class BuildTools {
 public:
  /// Throws Error where the sandbox cannot be had.
  BuildTools(const Toolchain& toolchain, const std::filesystem::path& workFolder,
             const sandbox::Sandbox& sandbox, const ToolLimits& limits = {});

  /// A tool that is killed although it reached no limit runs once more. Throws Error when it is killed again,
  /// when the tool or the sandbox does not start, or the machine was too busy.
  [[nodiscard]] ProcessResult run(const std::vector<std::string>& command,
                                  std::size_t outputLimit = 8u << 20) const;

  /// The same, but once: for what decides nothing.
  [[nodiscard]] ProcessResult runOnce(const std::vector<std::string>& command,
                                      std::size_t outputLimit = 8u << 20) const;

  /// The limit on memory, processor time or the size of files that ended the tool: "took more than ...";
  /// empty if it was none.
  [[nodiscard]] std::string limitReached(const ProcessResult& run) const;

 private:
  bool killedFromOutside(const ProcessResult& run) const;
  ProcessResult runConfined(const std::vector<std::string>& command, const ProcessOptions& options) const;

  std::filesystem::path workFolder_;
  ToolLimits limits_;
  sandbox::Level level_;
  sandbox::Cell cell_;
};

/// Writes a source file that is as old as the compiler believes today to be: __TIMESTAMP__ in it does not
/// tell when. Throws Error where it cannot be written.
void writeSource(const std::filesystem::path& file, const std::string& text);

/// The headers in an exercise's folder that a student's file may include: exercise.h, and what it, the file
/// that was handed out (starter.cpp, else main.cpp) and solution.cpp include, directly or not. Hidden are the
/// headers of the checks, and those that a student wrote: main.cpp alone is handed in.
[[nodiscard]] std::vector<std::filesystem::path> studentHeaders(const std::filesystem::path& folder);

}  // namespace rex::grading
