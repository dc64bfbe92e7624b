#pragma once

#include <filesystem>
#include <vector>

#include "classroom/task_list.h"
#include "cli/project.h"

namespace rex::cli {

/// How much of each of two submissions the other must have, in percent, to be shown.
inline constexpr int kSimilarPercent = 70;

/// Compares what was handed in to each exercise. Writes folder/EXERCISE.html with the pairs that have at
/// least that percentage in common, or removes the one of an earlier run if there are none, and
/// folder/EXERCISE/{base,submissions/STUDENT}/main.cpp for other programs that compare. Prints the groups.
/// Throws Error like grading::similarPairs().
void writeSimilar(const Project& project, const std::vector<grading::Task>& tasks,
                  const std::filesystem::path& out, const std::filesystem::path& folder, int percent);

}  // namespace rex::cli
