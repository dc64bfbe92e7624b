#include "grading/results.h"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "support/expect_error.h"
#include "support/paths.h"
#include "support/temporary_folder.h"

namespace rex::grading::results_test {

using Json = nlohmann::json;
using ::testing::HasSubstr;

GradeResult someResult() {
  GradeResult result;
  result.submissionId = "alice \"quoted\" \u00e4\n";
  result.files = {{"main.cpp", "ab12"}, {"other.h", "cd34"}};
  result.snapshotSha256 = "ef56";
  result.exerciseId = "01-kinematics";
  result.exerciseVersion = "3";
  result.seedId = "public";
  result.toolVersion = "0.1.0";
  result.compiler = "g++ 12";
  result.sandboxLevel = 0;
  result.sandboxWarnings = {"careful"};
  result.outcome = Outcome::kTimeLimit;
  result.message = "hello";
  result.score = 3;
  result.maxScore = 9;
  result.checks = {{.id = "x",
                    .part = "a",
                    .title = "X",
                    .group = Group::kHidden,
                    .status = Outcome::kTimeLimit,
                    .points = 3,
                    .maxPoints = 4,
                    .message = "m",
                    .property = "p",
                    .expected = "e",
                    .got = "g",
                    .tolerance = "t",
                    .input = "i",
                    .worst = {.property = "w", .value = "2 m", .limit = "1 m", .caseNumber = 3},
                    .cases = 8,
                    .casesHeld = 6,
                    .function = "f",
                    .line = 12,
                    .wallSeconds = 1.5,
                    .cpuSeconds = 0.25},
                   {.id = "y", .maxPoints = 5}};
  result.compile = {1, {{"main.cpp", 3, 4, "error", "-Wall", "wrong"}}, true};
  result.limits = {.cpuSeconds = 3, .wallSeconds = 5, .memory = 100 * kMegabyte, .output = 2 * kMegabyte};
  result.output = {"out", 11};
  result.error = {"err", 12};
  result.usage = {.cpuSeconds = 0.5, .wallSeconds = 2, .peakMemoryBytes = 4096, .outputBytes = 33};
  return result;
}

TEST(Results, ComeBackFromJson) {
  const std::string text = toJson(someResult());
  EXPECT_EQ(toJson(gradeResultFromJson(text, "r.json")), text);
  const GradeResult back = gradeResultFromJson(text, "r.json");
  EXPECT_EQ(back.submissionId, someResult().submissionId);
  EXPECT_EQ(back.checks.at(0).status, Outcome::kTimeLimit);
  EXPECT_EQ(back.checks.at(0).group, Group::kHidden);
  EXPECT_EQ(back.checks.at(0).worst.limit, "1 m");
  EXPECT_EQ(back.checks.at(0).worst.caseNumber, 3);
  EXPECT_EQ(back.checks.at(0).casesHeld, 6);
  EXPECT_EQ(back.checks.at(0).line, 12);
  EXPECT_EQ(back.checks.at(0).wallSeconds, 1.5);
  EXPECT_EQ(back.checks.at(1).status, std::nullopt);
  EXPECT_EQ(back.limits.memory, 100 * kMegabyte);
  EXPECT_EQ(back.compile.diagnostics.at(0).rule, "-Wall");
  EXPECT_EQ(back.error.truncatedBytes, 12u);
}

TEST(Results, KeepEverythingThatChangesBetweenRunsInOnePlace) {
  GradeResult other = someResult();
  other.usage = {};
  other.output.truncatedBytes = 99;
  other.checks[0].cpuSeconds = 7;
  auto one = nlohmann::json::parse(toJson(someResult()));
  auto two = nlohmann::json::parse(toJson(other));
  EXPECT_NE(one, two);
  one.erase("volatile");
  two.erase("volatile");
  EXPECT_EQ(one, two);
}

TEST(Results, HaveTheFieldsOfTheSchema) {
  const auto json = nlohmann::json::parse(toJson(someResult()));
  EXPECT_EQ(json.at("schema"), "grade-result/1");
  EXPECT_EQ(json.at("submission").at("files").at(1).at("sha256"), "cd34");
  EXPECT_EQ(json.at("exercise").at("version"), "3");
  EXPECT_EQ(json.at("tool").at("version"), "0.1.0");
  EXPECT_EQ(json.at("sandbox").at("warnings").at(0), "careful");
  EXPECT_EQ(json.at("outcome"), "time_limit");
  EXPECT_EQ(json.at("checks").at(1).at("status"), "not_run");
  EXPECT_EQ(json.at("checks").at(0).at("max_points"), 4);
  EXPECT_EQ(json.at("compile").at("diagnostics").at(0).at("line"), 3);
  EXPECT_EQ(json.at("limits").at("memory_bytes"), 100 << 20);
  EXPECT_EQ(json.at("volatile").at("checks").at(0).at("wall_ms"), 1500);
}

TEST(Results, SurviveInvalidUtf8) {
  GradeResult result = someResult();
  result.message = "\xff\xc3";
  EXPECT_EQ(nlohmann::json::parse(toJson(result)).at("message"), "\uFFFD\uFFFD");
}

TEST(Results, SayWhichFieldIsWrong) {
  const auto read = [](const std::string& text) { return gradeResultFromJson(text, "r.json"); };
  const std::string start = R"({"schema": "grade-result/1", )";
  EXPECT_REX_ERROR(read("{"), "r.json: result file: not JSON");
  EXPECT_REX_ERROR(read("[]"), "an object");
  EXPECT_REX_ERROR(read("{}"), "field 'schema': wanted grade-result/1");
  EXPECT_REX_ERROR(read(start + R"("score": "x"})"), "field 'score': wanted a number");
  EXPECT_REX_ERROR(read(start + R"("message": 3})"), "field 'message': wanted text");
  EXPECT_REX_ERROR(read(start + R"("outcome": "great"})"), "field 'outcome': wanted an outcome such as");
  EXPECT_REX_ERROR(read(start + R"("checks": 1})"), "field 'checks': wanted a list");
  EXPECT_REX_ERROR(read(start + R"("checks": [{"points": []}]})"),
                   "field 'checks[0].points': wanted a number");
  EXPECT_REX_ERROR(read(start + R"("checks": [{"group": "secret"}]})"), "wanted visible or hidden");
  EXPECT_REX_ERROR(read(start + R"("tool": 1})"), "field 'tool.': wanted an object");
}

TEST(Results, KnowEveryOutcomeByName) {
  for (int k = 0; k <= static_cast<int>(Outcome::kGraderError); ++k) {
    const auto outcome = static_cast<Outcome>(k);
    EXPECT_EQ(outcomeFromString(toString(outcome)), outcome);
  }
  EXPECT_EQ(outcomeFromString("grader_error"), Outcome::kGraderError);
  EXPECT_EQ(outcomeFromString("great"), std::nullopt);
}

TEST(ResultFile, IsReplacedAndReadBack) {
  const std::filesystem::path folder = ownFolder() / ("result-file-" + std::to_string(::getpid()));
  std::filesystem::create_directory(folder);
  const std::filesystem::path file = folder / "r.json";
  std::ofstream(file) << "old";
  EXPECT_REX_ERROR(loadResult(file), "not JSON");
  saveResult(someResult(), file);
  EXPECT_EQ(toJson(loadResult(file)), toJson(someResult()));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 1);
  EXPECT_REX_ERROR(loadResult(folder / "none.json"), "none.json: cannot read this file");
  EXPECT_REX_ERROR(saveResult(someResult(), folder / "no" / "r.json"), "cannot write the result file");
  std::filesystem::create_directory(folder / "taken");
  EXPECT_REX_ERROR(saveResult(someResult(), folder / "taken"), "cannot write the result file");
  std::filesystem::remove_all(folder);
}

TEST(ResultFile, IsNotBelievedUnlessItAddsUp) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "r.json";
  EXPECT_FALSE(readResultFile(file));
  GradeResult sound = someResult();
  sound.outcome = Outcome::kFail;
  sound.checks = {{.id = "hand", .status = Outcome::kPass, .points = 3, .maxPoints = 3},
                  {.id = "foot", .status = Outcome::kFail, .points = 1, .maxPoints = 2}};
  sound.score = 4, sound.maxScore = 5;
  saveResult(sound, file);
  EXPECT_EQ(readResultFile(file)->fault, "");
  EXPECT_EQ(toJson(*readResultFile(file)->result), toJson(sound));
  const auto expectFault = [&](GradeResult edited, const std::string& why) {
    saveResult(edited, file);
    EXPECT_THAT(readResultFile(file)->fault, HasSubstr("r.json: a result that does not add up: " + why));
  };
  GradeResult edited = sound;
  edited.score = 5;
  expectFault(edited, "score: found 5, wanted 4, the sum over its checks");
  edited = sound, edited.maxScore = 4;
  expectFault(edited, "max_score: found 4, wanted 5, the sum over its checks");
  edited = sound, edited.checks[0].points = 4;
  expectFault(edited, "check 'hand': found 4 points, wanted 0 to 3");
  edited = sound, edited.outcome = Outcome::kPass;
  expectFault(edited, "outcome: found pass, wanted the outcome of the check that did not pass");
}

TEST(ResultFile, IsNotBelievedIfItWasChangedAfterItWasSealed) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "r.json";
  GradeResult result;
  result.outcome = Outcome::kFail;
  auto json = nlohmann::json::parse(toJson(result));
  json["inputs"]["result_sha256"] = computeSeal(json.dump(), "r.json");
  json["volatile"]["usage"]["cpu_ms"] = 7;
  std::ofstream(file) << json.dump();
  EXPECT_EQ(readResultFile(file)->fault, "") << "neither times nor the order of keys count";
  json["message"] = "well done";
  std::ofstream(file) << json.dump();
  EXPECT_THAT(readResultFile(file)->fault,
              HasSubstr("r.json: a result that was changed after the grading: found hash "));
  json["inputs"].erase("result_sha256");
  std::ofstream(file) << json.dump();
  EXPECT_THAT(readResultFile(file)->fault, HasSubstr("wanted none, or a new grading"));
  std::ofstream(file) << "no JSON";
  EXPECT_THAT(readResultFile(file)->fault, HasSubstr("r.json: result file: not JSON"));
  EXPECT_FALSE(readResultFile(file)->result);
  EXPECT_REX_ERROR(computeSeal("[]", "r.json"), "r.json: result file: not JSON: wanted a result");
}

// share/grading/result.schema.json and the writer of result files must agree, field by field.
bool hasType(const Json& value, const std::string& type) {
  if (type == "number") return value.is_number();
  if (type == "object") return value.is_object();
  if (type == "array") return value.is_array();
  if (type == "string") return value.is_string();
  if (type == "integer") return value.is_number_integer();
  if (type == "boolean") return value.is_boolean();
  ADD_FAILURE() << "the schema uses the unknown type " << type;
  return false;
}

/// The first place where a value breaks a schema made of the keywords that ours uses; empty if none.
std::string violation(const Json& value, const Json& schema, const std::string& path) {
  if (schema.contains("type") && !hasType(value, schema.at("type"))) return path + ": type";
  if (schema.contains("enum")) {
    const Json& allowed = schema.at("enum");
    if (std::find(allowed.begin(), allowed.end(), value) == allowed.end()) return path + ": enum";
  }
  for (const auto& name : schema.value("required", Json::array())) {
    if (!value.contains(name.get<std::string>())) return path + ": lacks " + name.get<std::string>();
  }
  if (value.is_object()) {
    for (const auto& [name, field] : value.items()) {
      const Json& fields = schema.at("properties");
      if (!fields.contains(name)) return path + ": extra " + name;
      if (const std::string inside = violation(field, fields.at(name), path + "/" + name); !inside.empty())
        return inside;
    }
  }
  if (value.is_array()) {
    for (const Json& element : value) {
      if (const std::string inside = violation(element, schema.at("items"), path + "/0"); !inside.empty())
        return inside;
    }
  }
  return "";
}

Json schema() {
  std::ifstream file(sourcePath("share/grading/result.schema.json"));
  return Json::parse(file);
}

GradeResult fullResult() {
  GradeResult result;
  result.files = {{"main.cpp", "ab12"}};
  result.sandboxWarnings = {"careful"};
  result.checks = {{.id = "x"}};
  result.compile.diagnostics = {{.file = "main.cpp"}};
  return result;
}

TEST(ResultSchema, FitsWhatIsWritten) {
  GradeResult result = fullResult();
  for (int k = 0; k <= static_cast<int>(Outcome::kGraderError); ++k) {
    result.outcome = static_cast<Outcome>(k);
    result.checks[0].status = result.outcome;
    EXPECT_EQ(violation(Json::parse(toJson(result)), schema(), ""), "");
  }
  result.checks[0].status.reset();
  EXPECT_EQ(violation(Json::parse(toJson(result)), schema(), ""), "");
}

TEST(ResultSchema, AllowsRemarksAndRecords) {
  GradeResult result = fullResult();
  result.checks[0].remark = "Two of ten last.";
  result.checks[0].record = {.name = "length", .value = 2.5, .unit = "m", .isMoreBetter = true};
  const Json json = Json::parse(toJson(result));
  EXPECT_EQ(violation(json, schema(), ""), "");
  EXPECT_EQ(json.at("checks").at(0).at("remark"), "Two of ten last.");
  EXPECT_FALSE(json.at("checks").at(0).contains("record")) << "no grade depends on it";
  const CheckResult back = gradeResultFromJson(toJson(result), "r.json").checks.at(0);
  EXPECT_EQ(back.remark, "Two of ten last.");
  ASSERT_TRUE(back.record);
  EXPECT_EQ(back.record->name, "length");
  EXPECT_EQ(back.record->value, 2.5);
  EXPECT_EQ(back.record->unit, "m");
  EXPECT_TRUE(back.record->isMoreBetter);
  EXPECT_FALSE(gradeResultFromJson(toJson(fullResult()), "r.json").checks.at(0).record);
}

TEST(ResultSchema, AllowsTheHashesOfItsInputs) {
  Json result = Json::parse(toJson(fullResult()));
  result["inputs"] = {{"sha256", "a"},        {"source_sha256", "b"}, {"grader_sha256", "c"},
                      {"result_sha256", "d"}, {"level", 2},           {"seed", 7},
                      {"secret_id", ""},      {"alone", true}};
  EXPECT_EQ(violation(result, schema(), ""), "");
  result["inputs"].erase("sha256");
  EXPECT_EQ(violation(result, schema(), ""), "/inputs: lacks sha256");
}

// Removing any field, or giving it another type, breaks the schema: it says nothing too little.
TEST(ResultSchema, WantsEveryField) {
  const Json whole = Json::parse(toJson(fullResult()));
  const Json flat = whole.flatten();
  int fields = 0;
  for (const auto& [pointer, value] : flat.items()) {
    Json changed = whole;
    changed[Json::json_pointer(pointer)] = 1.5;
    EXPECT_NE(violation(changed, schema(), ""), "") << pointer;
    const Json::json_pointer place(pointer);
    if (!whole.at(place.parent_pointer()).is_object()) continue;
    changed = whole;
    changed.at(place.parent_pointer()).erase(place.back());
    EXPECT_NE(violation(changed, schema(), ""), "") << pointer;
    ++fields;
  }
  EXPECT_GT(fields, 40);
  Json extra = whole;
  extra["checks"][0]["verdict"] = "pass";
  EXPECT_EQ(violation(extra, schema(), ""), "/checks/0: extra verdict");
}

}  // namespace rex::grading::results_test
