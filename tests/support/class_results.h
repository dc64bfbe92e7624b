#pragma once

#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

#include "base/text_file.h"
#include "classroom/grade_task.h"
#include "classroom/task_list.h"
#include "grading/results.h"

namespace rex::classroom {

/// Two visible checks, "hand" of 3 points and "turn" of 4, and a hidden one of 3.
inline grading::GradeResult sampleResult(int hand, int turn, int hidden,
                                         const std::string& exercise = "01-kinematics") {
  const auto check = [](std::string id, std::string title, int points, int most, grading::Group group) {
    const bool isFull = points == most;
    return grading::CheckResult{.id = std::move(id),
                                .part = "kin",
                                .title = std::move(title),
                                .group = group,
                                .status = isFull ? grading::Outcome::kPass : grading::Outcome::kFail,
                                .points = points,
                                .maxPoints = most,
                                .message = isFull ? "" : "got 0.5 m, wanted 0.25 m"};
  };
  grading::GradeResult result{.files = {{"main.cpp", ""}}, .exerciseId = exercise};
  result.checks = {check("hand", "Position of the hand", hand, 3, grading::Group::kVisible),
                   check("turn", "Turns", turn, 4, grading::Group::kVisible),
                   check("far", "SECRET title", hidden, 3, grading::Group::kHidden)};
  result.checks[2].property = result.checks[2].message = "SECRET property";
  result.score = hand + turn + hidden;
  result.maxScore = 10;
  result.outcome = result.score == 10 ? grading::Outcome::kPass : grading::Outcome::kFail;
  return result;
}

/// A task whose file is in the folder of results, where it would be after grading.
inline Task sampleTask(const std::string& student, const std::string& exercise = "01-kinematics",
                       std::int64_t submitted = 1'700'000'000) {
  return {.student = student,
          .exercise = exercise,
          .sourceSha256 = "source of " + student,
          .graderSha256 = "grader",
          .submitted = submitted,
          .timeFrom = "table",
          .file = std::filesystem::path(student) / exercise / "main.cpp"};
}

/// Writes what grading the task would have left.
inline void saveSample(const std::filesystem::path& out, const Task& task, grading::GradeResult result,
                       const std::string& text = "int main() {}\n") {
  result.exerciseId = task.exercise;
  nlohmann::ordered_json json = nlohmann::ordered_json::parse(grading::toJson(result));
  json["inputs"] = {{"sha256", task.inputsSha256()},
                    {"source_sha256", task.sourceSha256},
                    {"grader_sha256", task.graderSha256},
                    {"result_sha256", grading::computeSeal(grading::toJson(result), "")}};
  writeTextFile(resultFolder(out, task) / "results.json", json.dump(2) + "\n");
  writeTextFile(out / task.file, text);
}

}  // namespace rex::classroom
