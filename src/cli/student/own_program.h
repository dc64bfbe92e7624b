#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "base/exit_code.h"
#include "cli/project.h"
#include "submission/student_build.h"

namespace rex::cli {

/// What the argument of `rex run` means: the user's own program, which is any path that ends in .cpp, with
/// links resolved; or an exercise, also if given by the path of its main.cpp. Throws UsageError with the
/// nearest names for a missing file, and like Project::exercise().
[[nodiscard]] std::variant<std::filesystem::path, ExerciseInfo> programMeant(const Project& project,
                                                                             const std::string& argument);

/// out/NAME for NAME.cpp, and out/FOLDER for FOLDER/main.cpp. Throws UsageError if that is the folder of an
/// exercise.
[[nodiscard]] std::filesystem::path programOutFolder(const Project& project,
                                                     const std::filesystem::path& file);

struct OwnProgram {
  std::filesystem::path program{};
  submission::Toolchain toolchain{};              ///< that made it, with its libraries
  std::vector<std::string> targets{};             ///< of the build, for the libraries that it is linked with
  std::vector<std::filesystem::path> madeFrom{};  ///< files
};

/// Compiles the file like a student's, with the headers next to it, builds the parts of the library that it
/// needs, and links it. If the file has errors, it prints them and returns no program. Throws Error if
/// the tools fail, and BuildFailure like bringUpToDate().
[[nodiscard]] std::optional<OwnProgram> buildOwnProgram(const Project& project,
                                                        const std::filesystem::path& file,
                                                        const std::filesystem::path& workFolder,
                                                        const std::filesystem::path& log);

enum class Ended { kWell, kBadly, kCrashed, kTooLate };

struct OwnRun {
  std::filesystem::path out{};  ///< the folder it runs in, which is made
  std::vector<std::string> arguments{};
  int seconds = 120;                       ///< of CPU time
  std::vector<std::string> environment{};  ///< NAME=VALUE
  bool listsFiles = true;                  ///< those it wrote
  std::filesystem::path log{};             ///< of the compiler; empty: build.log in `out`
  /// Where the program stays, to be used again until a file that it was made from changes. Empty: nowhere.
  std::filesystem::path keptAs{};
};

/// Runs the command with these settings, and waits for it.
[[nodiscard]] Ended runIn(const std::vector<std::string>& command, const OwnRun& options);

/// Runs a program that crashed or took too long once more, and says in which line of its file that was; or,
/// if it took too long, where it is after 2 s. `build` is how it was made, in a folder of its own.
void sayWhereItEnded(const submission::Toolchain& toolchain, const submission::StudentBuildOptions& build,
                     const OwnRun& options, Ended ended);

[[nodiscard]] ExitCode toExitCode(Ended ended);

/// Builds a program by buildOwnProgram() and runs it by runIn(). Throws as buildOwnProgram() and
/// makeOutFolder().
[[nodiscard]] ExitCode runOwnProgram(const Project& project, const std::filesystem::path& file,
                                     const OwnRun& options);

}  // namespace rex::cli
