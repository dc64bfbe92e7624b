#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "grading/results.h"
#include "submission/exercise_info.h"

namespace rex::cli {

/// Parts of the page of `rex watch` as HTML, in which all texts are escaped.

/// The whole page of an exercise, still without results: its task with formulas, points, and exercise.h. Only
/// links to the web and inside of the page remain.
[[nodiscard]] std::string emptyWatchPage(const grading::ExerciseInfo& exercise);

/// What visible checks now pass or fail, unlike before the last save.
[[nodiscard]] std::string newsPart(const grading::GradeResult& result,
                                   const std::optional<grading::GradeResult>& before);

/// A file that the page shows, by its path in the folder of results.
struct WatchFile {
  std::string name{};
  std::string bytes{};
};

/// Pictures and replays of checks, as far as they are among the files.
[[nodiscard]] std::string evidencePart(const grading::GradeResult& result,
                                       const std::vector<WatchFile>& files);

/// What the student's own program has drawn.
[[nodiscard]] std::string ownPart(const std::vector<WatchFile>& files);

/// The hints that were shown, by part, and buttons for the next ones.
[[nodiscard]] std::string hintsPart(const grading::ExerciseInfo& exercise,
                                    const std::map<std::string, int>& shownHints);

/// main.cpp with what the checks and the compiler say about its lines; `path` is where it is.
[[nodiscard]] std::string sourcePart(const grading::GradeResult& result, const std::string& source,
                                     const std::string& path);

/// The files that checks left, and those of the program: pictures, pages and films, at most thirty of at most
/// 8 MB.
[[nodiscard]] std::vector<WatchFile> filesOfChecks(const grading::GradeResult& result,
                                                   const std::filesystem::path& folder);
[[nodiscard]] std::vector<WatchFile> filesOfProgram(const std::filesystem::path& folder);

}  // namespace rex::cli
