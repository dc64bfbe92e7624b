#include "grading/result_file.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/sha256.h"
#include "base/text_file.h"

namespace rex::grading {
namespace {

// Sorts keys: their order in the file does not count.
using SortedJson = nlohmann::json;

Error unsound(const std::filesystem::path& file, std::string what, std::string found, std::string wanted) {
  return Error({.what = "a result that does not add up: " + std::move(what),
                .where = {file.string()},
                .found = std::move(found),
                .wanted = std::move(wanted)});
}

void requireSums(const GradeResult& result, const std::filesystem::path& file) {
  int points = 0, possible = 0;
  bool isPassed = true;
  for (const CheckResult& check : result.checks) {
    if (check.points < 0 || check.points > check.maxPoints)
      throw unsound(file, fmt::format("check '{}'", check.id), fmt::format("{} points", check.points),
                    fmt::format("0 to {}", check.maxPoints));
    points += check.points;
    possible += check.maxPoints;
    isPassed = isPassed && check.status == Outcome::kPass;
  }
  if (result.score != points)
    throw unsound(file, "score", fmt::format("{}", result.score),
                  fmt::format("{}, the sum over its checks", points));
  if (result.maxScore != possible)
    throw unsound(file, "max_score", fmt::format("{}", result.maxScore),
                  fmt::format("{}, the sum over its checks", possible));
  if (result.outcome == Outcome::kPass && !isPassed)
    throw unsound(file, "outcome", "pass", "the outcome of the check that did not pass");
}

}  // namespace

GradeResult loadSoundResult(const std::filesystem::path& file) {
  const std::string text = readTextFile(file);
  GradeResult result = gradeResultFromJson(text, file.string());
  requireSums(result, file);
  const SortedJson json = SortedJson::parse(text);
  if (!json.contains("inputs")) return result;
  const SortedJson& inputs = json["inputs"];
  const bool isSealed =
      inputs.is_object() && inputs.contains("result_sha256") && inputs["result_sha256"].is_string();
  const std::string found = sealOf(text, file.string()),
                    wanted = isSealed ? inputs["result_sha256"].get<std::string>() : "none";
  if (found != wanted)
    throw Error({.what = "a result that was changed after the grading",
                 .where = {file.string()},
                 .found = "hash " + found.substr(0, 12),
                 .wanted = wanted.substr(0, 12) + ", or a new grading"});
  return result;
}

std::string sealOf(const std::string& text, const std::string& file) {
  SortedJson json = SortedJson::parse(text, nullptr, false);
  if (!json.is_object())
    throw Error({.what = "result file: not JSON", .where = {.file = file}, .wanted = "a result"});
  json.erase("volatile");
  json.erase("inputs");
  return sha256(json.dump(-1, ' ', false, SortedJson::error_handler_t::replace));
}

GradeResult loadResult(const std::filesystem::path& file) {
  return gradeResultFromJson(readTextFile(file), file.string());
}

void saveResult(const GradeResult& result, const std::filesystem::path& file) {
  replaceTextFile(file, toJson(result), "the result file");
}

}  // namespace rex::grading
