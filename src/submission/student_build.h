#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "base/folders.h"
#include "sandbox/cell.h"
#include "submission/build_tools.h"
#include "submission/compiler_messages.h"
#include "submission/exercise_info.h"

namespace rex::submission {

/// What to build from a student's file.
struct StudentBuildOptions {
  std::filesystem::path main;        ///< the student's file
  std::filesystem::path workFolder;  ///< made if missing; objects, worker and program go there
  bool debug = false;                ///< -g -O0, for a debugger
  bool publicHeadersOnly = false;    ///< reject other files: see forbiddenIncludes()
  bool graded = false;  ///< make StudentObject::graded, which must not call what the exercise forbids
  double seconds = 30;  ///< of CPU time that compiling may take
  std::size_t memory = std::size_t{2} << 30;  ///< bytes that compiling may take
  sandbox::Sandbox sandbox{};                 ///< in which the tools run
  bool part = false;                          ///< the object holds only what is graded
};

/// A compiled student file, or the reasons why there is none.
struct StudentObject {
  std::string name;    ///< of the file in messages: "main.cpp"
  std::string source;  ///< what was compiled; empty if the file was rejected
  std::filesystem::path object;
  std::filesystem::path graded{};  ///< withoutMain(); empty: nothing was left out
  std::vector<grading::CompileDiagnostic> messages;
  std::string log;         ///< for build.log: the compiler's own words
  int exitCode = 0;        ///< of the compiler; 1 for a rejected file
  bool truncated = false;  ///< there were more messages
  bool ok = false;
};

/// Reads and compiles the file as it is now, under limits on time, memory and file size; if it is `graded`,
/// scans it for calls that the exercise does not allow outside of main(). Any problem with the file becomes
/// a message. Throws Error only if the tools fail, as on a full disk, or if nothing explains what is wrong
/// with the file. Two builds may run at once in different work folders.
[[nodiscard]] StudentObject compileStudent(const Toolchain& toolchain,
                                           const std::vector<ForbiddenFunction>& forbidden,
                                           const StudentBuildOptions& options);

/// A linked program, or the reasons why there is none.
struct StudentProgram {
  std::filesystem::path program;
  std::vector<std::string>
      parts{};  ///< of the exercise, with workers of their own beside it: see workerProgram()
  std::vector<grading::CompileDiagnostic> messages;
  std::string log;
  bool ok = false;
};

/// Links the worker: the exercise's loop around the student's functions, with the parts of the library
/// chosen by linkWorkerParts(). If `object.graded` is empty, it keeps the student's main() under another
/// name, and the whole library, for all parts. Throws Error like compileStudent().
[[nodiscard]] StudentProgram linkWorker(const Toolchain& toolchain, const StudentObject& object,
                                        const sandbox::Sandbox& sandbox = {});

/// Links the student's own program. Throws Error like compileStudent().
[[nodiscard]] StudentProgram linkProgram(const Toolchain& toolchain, const StudentObject& object);

/// The text of a student's file. Throws Error unless it is a regular file of at most 1 MiB of text without
/// NUL bytes; symbolic links, pipes and devices are never opened for reading.
[[nodiscard]] std::string readStudentFile(const std::filesystem::path& file);

struct StudentFile {
  std::string text{};
  std::int64_t modifiedAt = 0;  ///< seconds since 1970 in UTC
};

/// The same for an entry of an opened folder, unaffected by renaming in the meantime.
[[nodiscard]] StudentFile readStudentFile(const OpenedFolder& folder, const std::string& name);

}  // namespace rex::submission
