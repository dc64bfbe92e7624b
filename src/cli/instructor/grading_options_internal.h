#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "cli/instructor/class_grades.h"

namespace rex::cli {

inline constexpr const char* kGradingCodes =
    "Exit codes: 0 graded, whatever the grades; 1 fewer points wait for --accept;\n"
    "2 something could not be taken, or tutors disagree; 3 a grading must be\n"
    "repeated; 4 the sandbox is weaker than required; 64 wrong use.";

/// Options that several commands of the instructor's desk have in common: share/doc/grading.md.
CLI::Option* addDeadlines(CLI::App* command, std::filesystem::path& file);
void addSecret(CLI::App* command, std::filesystem::path& file);
/// `--course`, `--deadlines` and `--adjustments`.
void addClassFiles(CLI::App* command, ClassFiles& files);
/// `--report`; see parseReportFormats().
void addReport(CLI::App* command, std::string& reports);
/// `--out`: the folder of results.
void addResults(CLI::App* command, std::filesystem::path& out);
/// `--explain`: a student and an exercise.
void addExplain(CLI::App* command, std::vector<std::string>& explain);

}  // namespace rex::cli
