#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "submission/exercise_info.h"

namespace rex::grading {

/// What to make a worker's part of the library from.
struct WorkerPartOrder {
  std::filesystem::path exercise;              ///< its folder, with exercise.toml
  std::filesystem::path groups;                ///< the file of allowedFunctions()
  std::filesystem::path worker;                ///< object file of the loop that calls the student's functions
  std::vector<std::filesystem::path> objects;  ///< of the library, each function in a section of its own
  std::vector<std::string> functions;          ///< of the student's that the loop calls
  std::vector<std::filesystem::path> libraries;  ///< shared ones of others that the library needs
  std::string compiler;                          ///< that links
  std::string objcopy, nm;
  std::filesystem::path folder;  ///< to write to
};

/// Links the worker's loop, what graded functions may call and what those need, and nothing else of the
/// library: worker_part.o, and worker_part.ID.o for each part of the exercise with a worker of its own. What
/// exercise.toml forbids is then not in the memory of the workers that it is forbidden in. The names that a
/// student's file may use go into worker.offers. Throws Error where a name that is allowed does not exist, or
/// where what is forbidden would be there because something that is allowed needs it.
void linkWorkerParts(const WorkerPartOrder& order);

/// The file of options by which worker_part.o is linked: the libraries of others that it needs, and no
/// others.
[[nodiscard]] std::filesystem::path linkOptions(const std::filesystem::path& workerPart);

/// The workers of parts that linkWorkerParts() made beside worker_part.o, by the id of the part, each with
/// the file of options by which it is linked.
struct WorkerOfPart {
  std::string id;
  std::filesystem::path object;
  std::filesystem::path options;
};
[[nodiscard]] std::vector<WorkerOfPart> workersOfParts(const std::filesystem::path& workerPart);

/// The functions that a list of exercise.toml allows: groups are replaced by what they consist of. Throws
/// Error for a group that the file does not have.
[[nodiscard]] std::vector<std::string> allowedFunctions(const std::vector<std::string>& list,
                                                        const std::filesystem::path& exercise,
                                                        const std::filesystem::path& groups);

/// The names, as they stand in object files, of what linkWorkerParts() offers to a student's file, sorted.
[[nodiscard]] std::vector<std::string> offeredSymbols(const std::filesystem::path& offers);

}  // namespace rex::grading
