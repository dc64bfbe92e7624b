#include "grading/results.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/escape.h"
#include "base/sha256.h"
#include "base/text_file.h"

namespace rex::grading {
namespace {

using Json = nlohmann::ordered_json;
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

bool awaitsHiddenChecks(const GradeResult& result) {
  bool awaits = false;
  for (const CheckResult& check : result.checks) {
    if (check.status) continue;
    if (check.group == Group::kVisible) return false;
    awaits = true;
  }
  return awaits && result.outcome == Outcome::kGraderError;
}

GradeResult loadResult(const std::filesystem::path& file) {
  return gradeResultFromJson(readTextFile(file), file.string());
}

void saveResult(const GradeResult& result, const std::filesystem::path& file) {
  replaceTextFile(file, toJson(result), "the result file");
}

namespace {

constexpr const char* kSchema = "grade-result/1";

std::int64_t milliseconds(double seconds) { return std::llround(1000 * seconds); }

Json checkToJson(const CheckResult& check) {
  Json json{{"id", check.id},
            {"part", check.part},
            {"title", check.title},
            {"group", check.group == Group::kVisible ? "visible" : "hidden"},
            {"status", check.status ? toString(*check.status) : "not_run"},
            {"points", check.points},
            {"max_points", check.maxPoints},
            {"message", check.message},
            {"property", check.property},
            {"expected", check.expected},
            {"got", check.got},
            {"tolerance", check.tolerance},
            {"input", check.input},
            {"worst",
             {{"property", check.worst.property},
              {"value", check.worst.value},
              {"limit", check.worst.limit},
              {"case", check.worst.caseNumber}}},
            {"cases", check.cases},
            {"cases_held", check.casesHeld},
            {"function", check.function},
            {"line", check.line}};
  if (!check.remark.empty()) json["remark"] = check.remark;
  return json;
}

Json compileToJson(const CompileResult& compile) {
  Json diagnostics = Json::array();
  for (const CompileDiagnostic& d : compile.diagnostics)
    diagnostics.push_back({{"file", d.file},
                           {"line", d.line},
                           {"column", d.column},
                           {"severity", d.severity},
                           {"rule", d.rule},
                           {"message", d.message}});
  return {{"exit", compile.exitCode}, {"diagnostics", diagnostics}, {"truncated", compile.truncated}};
}

Json volatileToJson(const GradeResult& result) {
  Json checks = Json::array();
  for (const CheckResult& check : result.checks) {
    checks.push_back({{"id", check.id},
                      {"wall_ms", milliseconds(check.wallSeconds)},
                      {"cpu_ms", milliseconds(check.cpuSeconds)},
                      {"picture", check.picture},
                      {"replay", check.replay}});
    if (const auto& record = check.record)
      checks.back()["record"] = {{"name", record->name},
                                 {"value", record->value},
                                 {"unit", record->unit},
                                 {"more_is_better", record->isMoreBetter}};
  }
  return {{"usage",
           {{"cpu_ms", milliseconds(result.usage.cpuSeconds)},
            {"wall_ms", milliseconds(result.usage.wallSeconds)},
            {"memory_bytes", result.usage.peakMemoryBytes},
            {"output_bytes", result.usage.outputBytes}}},
          {"truncated_bytes",
           {{"stdout", result.output.truncatedBytes}, {"stderr", result.error.truncatedBytes}}},
          {"checks", checks}};
}

Json resultToJson(const GradeResult& result) {
  Json files = Json::array();
  for (const SourceFile& file : result.files) files.push_back({{"name", file.name}, {"sha256", file.sha256}});
  Json checks = Json::array();
  for (const CheckResult& check : result.checks) checks.push_back(checkToJson(check));
  return {{"schema", kSchema},
          {"submission",
           {{"id", result.submissionId}, {"files", files}, {"snapshot_sha256", result.snapshotSha256}}},
          {"exercise", {{"id", result.exerciseId}, {"version", result.exerciseVersion}}},
          {"seed_id", result.seedId},
          {"tool", {{"version", result.toolVersion}}},
          {"compiler", result.compiler},
          {"sandbox", {{"level", result.sandboxLevel}, {"warnings", result.sandboxWarnings}}},
          {"outcome", toString(result.outcome)},
          {"message", result.message},
          {"score", result.score},
          {"max_score", result.maxScore},
          {"checks", checks},
          {"compile", compileToJson(result.compile)},
          {"limits",
           {{"cpu_ms", milliseconds(result.limits.cpuSeconds)},
            {"wall_ms", milliseconds(result.limits.wallBudget())},
            {"memory_bytes", result.limits.memory},
            {"output_bytes", result.limits.output}}},
          {"stdout", result.output.text},
          {"stderr", result.error.text},
          {"volatile", volatileToJson(result)}};
}

// Texts in all parts of a result may come from strangers.
Json shown(Json json) {
  if (json.is_string()) return printable(json.get_ref<const std::string&>());
  if (json.is_structured())
    for (Json& element : json) element = shown(std::move(element));
  return json;
}

/// Reads fields of one JSON object into variables, which keep their values if a field is missing.
class Fields {
 public:
  Fields(const Json& json, std::string path, const std::string& file)
      : json_(json), path_(std::move(path)), file_(file) {
    if (!json.is_object()) refuse(path_, "an object");
  }

  template <class T>
  void read(const char* name, T& value) const {
    if (!json_.contains(name)) return;
    try {
      json_.at(name).get_to(value);
    } catch (const Json::exception&) {
      refuse(path_ + name, std::is_arithmetic_v<T> ? "a number" : "text");
    }
  }
  void readOutcome(const char* name, std::optional<Outcome>& outcome) const {
    std::string text = "not_run";
    read(name, text);
    outcome = outcomeFromString(text);
    if (!outcome && text != "not_run") refuse(path_ + name, "an outcome such as \"fail\"");
  }
  void readMilliseconds(const char* name, double& seconds) const {
    double milliseconds = 1000 * seconds;
    read(name, milliseconds);
    seconds = milliseconds / 1000;
  }
  Fields object(const char* name) const {
    static const Json kNothing = Json::object();
    return {json_.contains(name) ? json_.at(name) : kNothing, path_ + name + ".", file_};
  }
  std::vector<Fields> list(const char* name) const {
    std::vector<Fields> elements;
    if (!json_.contains(name)) return elements;
    if (!json_.at(name).is_array()) refuse(path_ + name, "a list");
    for (const Json& element : json_.at(name))
      elements.emplace_back(element, fmt::format("{}{}[{}].", path_, name, elements.size()), file_);
    return elements;
  }
  [[noreturn]] void refuse(const std::string& field, const std::string& wanted) const {
    throw Error({.what = "result file: field '" + field + "'", .where = {.file = file_}, .wanted = wanted});
  }

 private:
  const Json& json_;
  std::string path_;
  const std::string& file_;
};

CheckResult readCheck(const Fields& fields) {
  CheckResult check;
  std::string group = "visible";
  fields.read("id", check.id);
  fields.read("part", check.part);
  fields.read("title", check.title);
  fields.read("group", group);
  if (group != "visible" && group != "hidden") fields.refuse("group", "visible or hidden");
  check.group = group == "hidden" ? Group::kHidden : Group::kVisible;
  fields.readOutcome("status", check.status);
  fields.read("points", check.points);
  fields.read("max_points", check.maxPoints);
  fields.read("message", check.message);
  fields.read("property", check.property);
  fields.read("expected", check.expected);
  fields.read("got", check.got);
  fields.read("tolerance", check.tolerance);
  fields.read("input", check.input);
  const Fields worst = fields.object("worst");
  worst.read("property", check.worst.property);
  worst.read("value", check.worst.value);
  worst.read("limit", check.worst.limit);
  worst.read("case", check.worst.caseNumber);
  fields.read("cases", check.cases);
  fields.read("cases_held", check.casesHeld);
  fields.read("remark", check.remark);
  fields.read("function", check.function);
  fields.read("line", check.line);
  return check;
}

CompileResult readCompile(const Fields& fields) {
  CompileResult compile;
  fields.read("exit", compile.exitCode);
  fields.read("truncated", compile.truncated);
  for (const Fields& d : fields.list("diagnostics")) {
    CompileDiagnostic& diagnostic = compile.diagnostics.emplace_back();
    d.read("file", diagnostic.file);
    d.read("line", diagnostic.line);
    d.read("column", diagnostic.column);
    d.read("severity", diagnostic.severity);
    d.read("rule", diagnostic.rule);
    d.read("message", diagnostic.message);
  }
  return compile;
}

Limits readLimits(const Fields& fields) {
  Limits limits;
  fields.readMilliseconds("cpu_ms", limits.cpuSeconds);
  fields.readMilliseconds("wall_ms", limits.wallSeconds);
  fields.read("memory_bytes", limits.memory);
  fields.read("output_bytes", limits.output);
  return limits;
}

std::optional<Record> readRecord(const Fields& fields) {
  Record record;
  fields.read("name", record.name);
  fields.read("value", record.value);
  fields.read("unit", record.unit);
  fields.read("more_is_better", record.isMoreBetter);
  return record.name.empty() ? std::nullopt : std::optional(record);
}

void readVolatile(const Fields& fields, GradeResult& result) {
  const Fields usage = fields.object("usage");
  usage.readMilliseconds("cpu_ms", result.usage.cpuSeconds);
  usage.readMilliseconds("wall_ms", result.usage.wallSeconds);
  usage.read("memory_bytes", result.usage.peakMemoryBytes);
  usage.read("output_bytes", result.usage.outputBytes);
  fields.object("truncated_bytes").read("stdout", result.output.truncatedBytes);
  fields.object("truncated_bytes").read("stderr", result.error.truncatedBytes);
  for (const Fields& times : fields.list("checks")) {
    std::string id;
    times.read("id", id);
    for (CheckResult& check : result.checks) {
      if (check.id != id) continue;
      times.readMilliseconds("wall_ms", check.wallSeconds);
      times.readMilliseconds("cpu_ms", check.cpuSeconds);
      times.read("picture", check.picture);
      times.read("replay", check.replay);
      check.record = readRecord(times.object("record"));
    }
  }
}

GradeResult readResult(const Fields& fields) {
  GradeResult result;
  std::string schema;
  fields.read("schema", schema);
  if (schema != kSchema) fields.refuse("schema", kSchema);
  const Fields submission = fields.object("submission");
  submission.read("id", result.submissionId);
  submission.read("snapshot_sha256", result.snapshotSha256);
  for (const Fields& file : submission.list("files")) {
    file.read("name", result.files.emplace_back().name);
    file.read("sha256", result.files.back().sha256);
  }
  fields.object("exercise").read("id", result.exerciseId);
  fields.object("exercise").read("version", result.exerciseVersion);
  fields.read("seed_id", result.seedId);
  fields.object("tool").read("version", result.toolVersion);
  fields.read("compiler", result.compiler);
  fields.object("sandbox").read("level", result.sandboxLevel);
  fields.object("sandbox").read("warnings", result.sandboxWarnings);
  std::optional<Outcome> outcome;
  fields.readOutcome("outcome", outcome);
  result.outcome = outcome.value_or(Outcome::kGraderError);
  fields.read("message", result.message);
  fields.read("score", result.score);
  fields.read("max_score", result.maxScore);
  for (const Fields& check : fields.list("checks")) result.checks.push_back(readCheck(check));
  result.compile = readCompile(fields.object("compile"));
  result.limits = readLimits(fields.object("limits"));
  fields.read("stdout", result.output.text);
  fields.read("stderr", result.error.text);
  readVolatile(fields.object("volatile"), result);
  return result;
}

// The text must have been parsed without exceptions.
GradeResult resultFromParsed(const Json& json, const std::string& file) {
  if (json.is_discarded())
    throw Error({.what = "result file: not JSON", .where = {.file = file}, .wanted = kSchema});
  return readResult(Fields(json, "", file));
}

std::string sealOf(const Json& json) {
  SortedJson counted = SortedJson::object();
  for (const auto& [key, value] : json.items())
    if (key != "volatile" && key != "inputs") counted[key] = value;
  return sha256(counted.dump(-1, ' ', false, SortedJson::error_handler_t::replace));
}

// Points that do not add up, an outcome that does not fit the checks, a broken seal: see computeSeal().
void requireSound(const GradeResult& result, const Json& json, const std::filesystem::path& file) {
  requireSums(result, file);
  if (!json.contains("inputs")) return;
  const Json& inputs = json["inputs"];
  const bool isSealed =
      inputs.is_object() && inputs.contains("result_sha256") && inputs["result_sha256"].is_string();
  const std::string found = sealOf(json),
                    wanted = isSealed ? inputs["result_sha256"].get<std::string>() : "none";
  if (found != wanted)
    throw Error({.what = "a result that was changed after the grading",
                 .where = {file.string()},
                 .found = "hash " + found.substr(0, 12),
                 .wanted = wanted.substr(0, 12) + ", or a new grading"});
}

// The table of that name; empty if there is none.
const Json& tableIn(const Json& json, const char* name) {
  static const Json kNone = Json::object();
  const bool isThere = json.is_object() && json.contains(name) && json[name].is_object();
  return isThere ? json[name] : kNone;
}

std::optional<GradedWith> gradedWith(const Json& inputs) {
  try {
    GradedWith with{.level = sandbox::parseLevel(inputs.at("level").get<int>()),
                    .secretId = inputs.at("secret_id").get<std::string>(),
                    .alone = inputs.value("alone", false)};
    if (inputs.contains("seed")) with.seed = inputs["seed"].get<std::uint64_t>();
    return with;
  } catch (const Json::exception&) {
    return {};
  } catch (const Error&) {
    return {};  // no such level
  }
}

ResultInputs inputsOf(const Json& json) {
  const Json &inputs = tableIn(json, "inputs"), &kept = tableIn(json, "volatile");
  const auto textOf = [&](const char* key) {
    return inputs.contains(key) && inputs[key].is_string() ? inputs[key].get<std::string>() : std::string();
  };
  return {.sha256 = textOf("sha256"),
          .sourceSha256 = textOf("source_sha256"),
          .seal = textOf("result_sha256"),
          .hmac = textOf("result_hmac"),
          .with = gradedWith(inputs),
          .evidence = kept.contains("evidence") && kept["evidence"] == true};
}

}  // namespace

std::string toString(const CompileDiagnostic& message) {
  const std::string where = toString(SourceLocation{message.file, message.line, message.column});
  const std::string rule = message.rule.empty() ? "" : fmt::format(" [{}]", message.rule);
  return fmt::format("{}{}{}: {}{}", where, where.empty() ? "" : ": ", message.severity, message.message,
                     rule);
}

std::string toJson(const GradeResult& result) {
  return shown(resultToJson(result)).dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

GradeResult gradeResultFromJson(const std::string& text, const std::string& file) {
  return resultFromParsed(Json::parse(text, nullptr, false), file);
}

std::string computeSeal(const std::string& text, const std::string& file) {
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object())
    throw Error({.what = "result file: not JSON", .where = {.file = file}, .wanted = "a result"});
  return sealOf(json);
}

std::optional<ResultFile> readResultFile(const std::filesystem::path& file) {
  if (!std::filesystem::exists(file)) return {};
  const Json json = Json::parse(readTextFile(file), nullptr, false);
  ResultFile read{.inputs = inputsOf(json)};
  try {
    read.result = resultFromParsed(json, file.string());
    requireSound(*read.result, json, file);
  } catch (const Error& error) {
    read.fault = error.what();
  }
  return read;
}

}  // namespace rex::grading
