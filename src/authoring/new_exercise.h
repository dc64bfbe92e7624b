#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

namespace rex::authoring {

/// The texts of a folder of exercises/ by the names of the files.
using ExerciseFiles = std::map<std::string, std::string>;

/// A small exercise that passes its gates: share/template in the project `root`, for this name.
///   writeTextFile(folder / "README.md", templateExercise(root, "99-demo").at("README.md"));
[[nodiscard]] ExerciseFiles templateExercise(const std::filesystem::path& root, const std::string& name);

/// The frame of the private exercise whose exercise.h is given: a region and a stub for each function, a plot
/// and a replay, a description and a task with the parts, and for each function a check, which compiles and
/// which the stub fails, as does the solution until its author has written both. Throws as readContract().
[[nodiscard]] ExerciseFiles exerciseFor(std::string_view header, const std::string& file,
                                        const std::string& name);

/// The line of exercises/CMakeLists.txt for an exercise with these files. Throws as readContract().
[[nodiscard]] std::string buildLine(const ExerciseFiles& files, const std::string& name);

}  // namespace rex::authoring
