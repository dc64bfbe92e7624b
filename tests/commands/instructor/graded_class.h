#pragma once

#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include <fcntl.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>

#include "commands/built_project.h"
#include "support/paths.h"

namespace rex::cli {

inline constexpr const char* kBroken = "int main() { return }\n";
inline constexpr const char* kWrong =
    "#include \"exercise.h\"\nEigen::Vector2d rotated(const Eigen::Vector2d& p, double) { return p; }\n"
    "int main() {}\n";

// A small class of students, and what grading it leaves.
class GradedClass : public BuiltProject {
 protected:
  fs::path in() const { return root() / "in"; }
  fs::path results() const { return root() / "results"; }
  void handIn(const std::string& student, const std::string& text,
              const std::string& exercise = "98-template") const {
    fs::create_directories(in() / student / exercise);
    write(in() / student / exercise / "main.cpp", text);
    setTime(student, exercise);
  }
  // Of the table; tests tell the times of files.
  void setTime(const std::string& student, const std::string& exercise, long seconds = 1'700'000'000) const {
    const timespec times[2] = {{seconds, 0}, {seconds, 0}};
    ::utimensat(AT_FDCWD, (in() / student / exercise / "main.cpp").c_str(), times, 0);
  }
  Ended gradeAnew(std::vector<std::string> more = {}, const std::string& out = "results") const {
    std::vector<std::string> arguments = {
        "grade", in().string(), "--out", (root() / out).string(), "--level", "0", "--i-accept-level", "0"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return rex(arguments);
  }
  // With the programs that other tests have compiled, for most tests are not about compiling.
  Ended grade(std::vector<std::string> more = {}, const std::string& out = "results") const {
    more.insert(more.end(), {"--workers", buildPath("tests/template/workers")});
    return gradeAnew(std::move(more), out);
  }
  std::string table(const std::string& out = "results") const {
    return fileText(root() / out / "grades.csv");
  }
  nlohmann::json result(const std::string& student, const std::string& out = "results") const {
    return nlohmann::json::parse(fileText(root() / out / student / "98-template" / "results.json"));
  }
  // The row of a student without the time at its end.
  std::string row(const std::string& student) const {
    std::istringstream lines(table());
    for (std::string line; std::getline(lines, line);)
      if (line.starts_with(student + ",")) return line.substr(0, line.find(",2023-"));
    return "";
  }
};

}  // namespace rex::cli
