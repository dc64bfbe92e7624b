#pragma once
// `rex grade --forget ID` and `--forget-before DATE`: lists what is kept about people, and removes it.

#include <filesystem>
#include <string>

#include "cli/instructor/class_grades.h"

namespace rex::cli {

struct ForgetPlan {
  std::filesystem::path handedIn{};  ///< folder of submissions; empty: not looked at
  std::filesystem::path out{};       ///< folder of results
  std::filesystem::path similar{};   ///< of `--similar`; empty: not looked at
  ClassFiles files{};
  std::string student{};  ///< by any key
  std::string before{};   ///< "2026-03-31"; empty: only that student
  bool removes = false;   ///< else the list is all
};

/// Tables of grades are made again from what is left. kNotGradable if something stays that a person has to
/// remove. Throws UsageError for a student whom nobody knows, and for a text that is no date.
ExitCode forgetPeople(const Project& project, const ForgetPlan& plan);

}  // namespace rex::cli
