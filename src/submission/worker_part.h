#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "submission/build_tools.h"
#include "submission/exercise_info.h"

namespace rex::submission {

/// Links a student's object file into `part` without main() and what only main() uses. What is reachable
/// from a function that the worker needs or from code that runs before main() remains; a pointer to main()
/// in it keeps main(). The file must be compiled with -ffunction-sections -fdata-sections. Returns the
/// linker's result; empty if the file has only main(). Throws Error like readObjectFile() and
/// BuildTools::run().
[[nodiscard]] std::optional<ProcessResult> withoutMain(const std::filesystem::path& object,
                                                       const std::filesystem::path& part,
                                                       const Toolchain& toolchain, const BuildTools& tools);

/// The inputs for linkWorkerParts().
struct WorkerPartOrder {
  std::filesystem::path exercise;              ///< its folder, with exercise.toml
  std::filesystem::path groups;                ///< the file of allowedFunctions()
  std::filesystem::path worker;                ///< object file of the loop that calls the student's functions
  std::vector<std::filesystem::path> objects;  ///< of the library, with each function in its own section
  std::vector<std::string> functions;          ///< the student's functions that the loop calls
  std::vector<std::filesystem::path> libraries;  ///< third-party shared ones that the library needs
  std::string compiler;                          ///< used for linking
  std::vector<std::string> linkFlags{};          ///< of programs
  std::string objcopy, nm;
  std::filesystem::path folder;  ///< output folder
};

/// Links the worker's loop with only those parts of the library that graded functions may call or that
/// these need: worker_part.o, and worker_part.ID.o for each part of the exercise with its own worker. What
/// exercise.toml forbids is then not in the worker's memory. The names that a student's file may use go
/// into worker.offers. Also links the program controlProgram(). Throws Error if an allowed name does not
/// exist, or if an allowed function needs a forbidden one.
void linkWorkerParts(const WorkerPartOrder& order);

/// The linker options file for worker_part.o: the third-party libraries that it needs, and no others.
[[nodiscard]] std::filesystem::path linkOptions(const std::filesystem::path& workerPart);

/// The worker that answers for no student's functions, next to worker_part.o: see slownessOfMachine().
[[nodiscard]] std::filesystem::path controlProgram(const std::filesystem::path& workerPart);

/// A part's worker that linkWorkerParts() made next to worker_part.o, with the part's id and the linker
/// options file.
struct WorkerOfPart {
  std::string id;
  std::filesystem::path object;
  std::filesystem::path options;
};
[[nodiscard]] std::vector<WorkerOfPart> workersOfParts(const std::filesystem::path& workerPart);

/// The functions that a list in exercise.toml allows, with groups replaced by their members. Throws Error
/// for a group that the file does not define.
[[nodiscard]] std::vector<std::string> allowedFunctions(const std::vector<std::string>& list,
                                                        const std::filesystem::path& exercise,
                                                        const std::filesystem::path& groups);

/// The mangled names that linkWorkerParts() offers to a student's file, sorted.
[[nodiscard]] std::vector<std::string> offeredSymbols(const std::filesystem::path& offers);

}  // namespace rex::submission
