#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace rex::submission {

/// Whether a file of that name is for lecturers only: solution.cpp, wrong.cpp, seen.txt, equal_mutants.tsv.
[[nodiscard]] bool isForLecturers(const std::filesystem::path& name);

/// The files that students get of an exercise's folder, as sorted names relative to it: README.md,
/// exercise.toml, main.cpp, starter.cpp, show.cpp, exercise.h, all headers there that one of these includes,
/// directly or indirectly, and pictures and data that one of these files names. So no solution, check or
/// header of checks is among them.
[[nodiscard]] std::vector<std::filesystem::path> studentFiles(const std::filesystem::path& exercise);

/// The files of a folder that `names` are, or that these include in quotes, directly or indirectly, in the
/// order in which they are found. Names that lead out of the folder are ignored.
[[nodiscard]] std::vector<std::string> filesIncludedFrom(const std::filesystem::path& folder,
                                                         std::vector<std::string> names);

}  // namespace rex::submission
