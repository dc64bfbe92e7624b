#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "base/opened_folder.h"
#include "sandbox/cell.h"
#include "submission/compiler_messages.h"
#include "submission/exercise_info.h"
#include "submission/toolchain.h"

namespace rex::grading {

/// What to build from a student's file.
struct StudentBuildOptions {
  std::filesystem::path main;        ///< the student's file
  std::filesystem::path workFolder;  ///< made if missing; objects, worker and program go there
  bool debug = false;                ///< -g -O0, for a debugger
  bool publicHeadersOnly = false;    ///< refuse other files: see forbiddenIncludes()
  bool graded = false;  ///< make StudentObject::graded, in which nothing may call what the exercise forbids
  double seconds = 30;  ///< of processor time that compiling may take
  std::size_t memory = std::size_t{2} << 30;  ///< bytes that compiling may take
  sandbox::Sandbox sandbox{};                 ///< that the tools run in
  bool part = false;  ///< the object holds what is graded, made while a second compiler reads the whole
};

/// A compiled student file, or why there is none.
struct StudentObject {
  std::string name;    ///< of the file in messages: "main.cpp"
  std::string source;  ///< what was compiled; empty when the file was refused
  std::filesystem::path object;
  std::filesystem::path graded{};  ///< withoutMain(); empty: nothing was left out
  std::vector<CompileDiagnostic> messages;
  std::string log;         ///< for build.log: the compiler's own words
  int exitCode = 0;        ///< of the compiler; 1 for a file that was refused
  bool truncated = false;  ///< there were more messages
  bool ok = false;
};

/// Reads and compiles the file as it is now, under limits on time, memory and file size; if it is `graded`,
/// scans it for calls that the exercise does not allow outside of main(). Any trouble with the file becomes a
/// message; throws Error only when the tools fail, as on a full disk, or where nothing explains what is wrong
/// with the file. Two builds may run at once in different work folders.
[[nodiscard]] StudentObject compileStudent(const Toolchain& toolchain,
                                           const std::vector<ForbiddenFunction>& forbidden,
                                           const StudentBuildOptions& options);

/// A linked program, or why there is none.
struct StudentProgram {
  std::filesystem::path program;
  std::vector<CompileDiagnostic> messages;
  std::string log;
  bool ok = false;
};

/// Links the worker: the exercise's loop around the student's functions, with what linkWorkerParts() left of
/// the library; with all of it and main() put aside where `object.graded` is empty. The workers of parts lie
/// beside it: worker.ID. Throws Error as compileStudent().
[[nodiscard]] StudentProgram linkWorker(const Toolchain& toolchain, const StudentObject& object,
                                        const sandbox::Sandbox& sandbox = {});

/// Links the student's own program. Throws Error as compileStudent().
[[nodiscard]] StudentProgram linkProgram(const Toolchain& toolchain, const StudentObject& object);

/// The text of a student's file. Throws Error unless it is a regular file of at most 1 MiB of text without
/// NUL bytes; symbolic links, pipes and devices are never opened for reading.
[[nodiscard]] std::string readStudentFile(const std::filesystem::path& file);

struct StudentFile {
  std::string text{};
  std::int64_t modifiedAt = 0;  ///< seconds since 1970 in UTC
};

/// The same of an entry of a folder that was opened, whatever happens to names meanwhile.
[[nodiscard]] StudentFile readStudentFile(const OpenedFolder& folder, const std::string& name);

}  // namespace rex::grading
