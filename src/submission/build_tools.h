#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "base/process.h"
#include "sandbox/cell.h"

namespace rex::submission {

/// How student code of one exercise is compiled and graded; the build writes this to build.json.
struct Toolchain {
  std::string compiler;
  std::vector<std::string> flags;      ///< for compiling the student's file, including its include folders
  std::vector<std::string> linkFlags;  ///< for linking it to a program that finds the libraries
  std::filesystem::path workerObject;  ///< the loop that answers the grader
  std::filesystem::path grader;
  std::vector<std::filesystem::path> libraries;  ///< shared; all of rex that the student's program may call
  std::filesystem::path show{};          ///< an archive with drawing functions for main(); empty: none
  std::vector<std::string> functions{};  ///< the student's functions that the grader calls
  std::filesystem::path prefix{};        ///< see prefixFlags(); empty: none
  std::filesystem::path workerPart{};    ///< made by linkWorkerParts(); empty: workers have the whole library
  std::filesystem::path offers{};        ///< file with the names in it that graded functions may use
  std::string objcopy = "objcopy";
  std::string objdump = "objdump";
};

/// Reads build.json, with the words of installedText() replaced. Throws Error if it is missing (the exercise
/// is not built), or if a key other than prefix, show, worker_part, offers, objcopy and objdump is.
[[nodiscard]] Toolchain readToolchain(const std::filesystem::path& buildJson);

/// The text of an installed build description: it names folders as {rex} (ownFolder()), {home} (homeFolder())
/// and {include} (the library's headers), so that it holds wherever the tree was moved.
[[nodiscard]] std::string installedText(std::string text);

/// The linker's complaint about the object file: the line that explains it, or that the file's variables are
/// too large if no line names the file; empty if there is none.
[[nodiscard]] std::string complaintAbout(std::string_view object, std::string_view linkerText);

/// Whether what a linker says explains its failure by the object file: by functions that it lacks or defines
/// twice, or by a complaintAbout() it.
[[nodiscard]] bool blamesObject(std::string_view linkerText, std::string_view object);

/// The line of a tool's output that explains most, or how it ended if there is none.
[[nodiscard]] std::string lastLine(const ProcessResult& run);

/// The limits of one tool.
struct ToolLimits {
  double seconds = 30;                        ///< of CPU time; for wall time see clockSeconds()
  std::size_t memory = std::size_t{2} << 30;  ///< bytes
#ifdef __SANITIZE_ADDRESS__
  std::size_t fileSize = std::size_t{1} << 30;  ///< bytes; workers contain the sanitizers and their tables
#else
  std::size_t fileSize = std::size_t{64} << 20;  ///< bytes
#endif
};

/// The wall time for a tool with this limit on CPU time: long, since a busy machine delays it. It ends those
/// that wait, for a pipe or a terminal.
[[nodiscard]] double clockSeconds(double seconds);

/// Runs compilers and object file tools on a student's file. Confined, they see the system, the headers
/// that students may include, what workers are linked with, and their work folder. For them it is always
/// the first second of 1970, so that builds are reproducible.
class BuildTools {
 public:
  /// Throws Error if the sandbox is not available.
  BuildTools(const Toolchain& toolchain, const std::filesystem::path& workFolder,
             const sandbox::Sandbox& sandbox, const ToolLimits& limits = {});

  /// Whether what a tool said gives a reason why it failed that lies in the file.
  using Explains = std::function<bool(const ProcessResult&)>;

  /// Runs a tool, and once more if it fails without a reason: it reached no limit, and `explains`, if given,
  /// finds none. Throws Error if the tool or the sandbox does not start, and if the machine is to blame for
  /// both failures, or for a tool that does not end: see faultOfMachine().
  [[nodiscard]] ProcessResult run(const std::vector<std::string>& command, const Explains& explains = {},
                                  std::size_t outputLimit = 8u << 20) const;

  /// The same without a second try and without blaming the machine, for tools whose failure does not matter.
  [[nodiscard]] ProcessResult runOnce(const std::vector<std::string>& command,
                                      std::size_t outputLimit = 8u << 20) const;

  /// "12 KiB free in FOLDER" if that is less than one file of a tool may take; else empty.
  [[nodiscard]] std::string shortOfDisk() const;

  /// The limit on memory, processor time or the size of files that ended the tool: "took more than ...";
  /// empty if no limit was reached.
  [[nodiscard]] std::string limitReached(const ProcessResult& run) const;

 private:
  std::string faultOfMachine(const std::vector<std::string>& command, const ProcessResult& failure,
                             bool wereKilled) const;
  ProcessResult runConfined(const std::vector<std::string>& command, const ProcessOptions& options) const;

  std::filesystem::path workFolder_;
  std::vector<std::string> control_;  ///< the command that compiles and links an empty program
  ToolLimits limits_;
  sandbox::Level level_;
  sandbox::Cell cell_;
};

/// Writes a source file with the date that the compiler takes for today, so that __TIMESTAMP__ does not
/// reveal the real one. Throws Error if it cannot be written.
void writeSource(const std::filesystem::path& file, const std::string& text);

/// The headers in an exercise's folder that a student's file may include: exercise.h, and what it, the file
/// handed out (starter.cpp, else main.cpp) and solution.cpp include, directly or indirectly. Headers of the
/// checks and headers written by the student are not among them: only main.cpp is handed in.
[[nodiscard]] std::vector<std::filesystem::path> studentHeaders(const std::filesystem::path& folder);

}  // namespace rex::submission
