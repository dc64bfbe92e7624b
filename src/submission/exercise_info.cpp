#include "submission/exercise_info.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"
#include "base/toml_table.h"

namespace rex::submission {
namespace {

using std::filesystem::path;

grading::Limits readLimits(const TomlTable& table) {
  table.refuseKeysBut({"cpu_seconds", "memory_mb", "output_mb"});
  grading::Limits limits;
  if (table.has("cpu_seconds")) limits.cpuSeconds = table.number("cpu_seconds", 0, 3600);
  if (table.has("memory_mb")) limits.memory = grading::kMegabyte * table.integer("memory_mb", 64, 65536);
  if (table.has("output_mb")) limits.output = grading::kMegabyte * table.integer("output_mb", 1, 1024);
  return limits;
}

ExercisePart readPart(const TomlTable& table) {
  table.refuseKeysBut({"id", "title", "points", "core", "floor", "lies", "hints", "functions", "allowed"});
  ExercisePart part{.id = table.text("id"), .title = table.text("title"), .hints = {}};
  part.points = table.integer("points", 1, 1000);
  if (table.has("core")) part.isCore = table.boolean("core");
  if (table.has("floor")) part.floor = table.integer("floor", 0, part.points);
  if (table.has("lies")) part.lies = table.integer("lies", 0, part.points);
  if (table.has("hints")) part.hints = table.texts("hints");
  if (table.has("functions")) {
    part.functions = table.texts("functions");
    part.allowed = table.texts("allowed");
  }
  return part;
}

SolutionRule readSolutionRule(const TomlTable& table) {
  if (!table.has("solution")) return SolutionRule::kNever;
  return table.choice<SolutionRule>("solution", {{"never", SolutionRule::kNever},
                                                 {"after-pass", SolutionRule::kAfterPass},
                                                 {"always", SolutionRule::kAlways}});
}

ForbiddenFunction readForbidden(const TomlTable& table) {
  table.refuseKeysBut({"function", "reason", "part"});
  return {table.text("function"), table.text("reason"), table.has("part") ? table.text("part") : ""};
}

void readParts(const TomlTable& top, const std::string& file, ExerciseInfo& info) {
  std::set<std::string> ids;
  for (const TomlTable& table : top.tables("part")) {
    info.parts.push_back(readPart(table));
    if (!ids.insert(info.parts.back().id).second)
      throw Error({.what = fmt::format("two parts are called '{}'", info.parts.back().id),
                   .where = table.where("id")});
  }
  if (info.parts.empty())
    throw Error({.what = "no part", .where = {file}, .wanted = "at least one table headed [[part]]"});
}

// "01" and "1" are the same number.
std::string_view withoutZeros(std::string_view number) {
  return number.substr(std::min(number.find_first_not_of('0'), number.size()));
}

}  // namespace

int ExerciseInfo::points() const {
  int sum = 0;
  for (const ExercisePart& part : parts) sum += part.points;
  return sum;
}

ExerciseInfo readExerciseInfo(const path& folder) {
  const path file = folder / "exercise.toml";
  const TomlTable top = TomlTable::read(file, "the exercise", "the description of an exercise");
  top.refuseKeysBut({"title", "profile", "script", "chapter", "needs", "hours", "solution", "allowed",
                     "limits", "part", "forbidden"});

  ExerciseInfo info;
  info.folder = info.definition = folder;
  info.name = folder.filename().string();
  info.title = top.text("title");
  if (top.has("profile"))
    info.isPrivate = top.choice<bool>("profile", {{"private", true}, {"public", false}});
  if (!info.isPrivate || top.has("script")) info.script = top.text("script");
  if (top.has("chapter")) info.chapter = top.integer("chapter", 1, 99);
  if (top.has("needs")) info.needs = top.texts("needs");
  if (top.has("hours")) info.hours = top.integer("hours", 1, 99);
  info.solution = readSolutionRule(top);
  info.allowed = top.has("allowed") ? top.texts("allowed") : std::vector<std::string>{"course"};
  if (const auto limits = top.table("limits", "[limits]", "a table headed [limits]"))
    info.limits = readLimits(*limits);
  readParts(top, file.string(), info);
  for (const TomlTable& table : top.tables("forbidden")) info.forbidden.push_back(readForbidden(table));
  return info;
}

std::vector<std::string> exerciseNames(const path& folder) {
  std::vector<std::string> names;
  if (std::filesystem::is_directory(folder)) {
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      if (std::filesystem::exists(entry.path() / "exercise.toml"))
        names.push_back(entry.path().filename().string());
    }
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<ExerciseInfo> listExercises(const path& folder) {
  std::vector<ExerciseInfo> exercises;
  for (const std::string& name : exerciseNames(folder)) exercises.push_back(readExerciseInfo(folder / name));
  return exercises;
}

const ExerciseInfo& findExercise(const std::vector<ExerciseInfo>& exercises, std::string_view name) {
  std::vector<const ExerciseInfo*> matches;
  std::vector<std::string> names, spellings;
  for (const ExerciseInfo& exercise : exercises) {
    const std::size_t dash = exercise.name.find('-');
    const std::string number = exercise.name.substr(0, dash);
    const std::string topic = dash == std::string::npos ? "" : exercise.name.substr(dash + 1);
    if (exercise.name == name) return exercise;
    if ((!name.empty() && withoutZeros(name) == withoutZeros(number)) || (!topic.empty() && name == topic))
      matches.push_back(&exercise);
    names.push_back(exercise.name);
    spellings.insert(spellings.end(), {exercise.name, topic});
  }
  if (matches.size() == 1) return *matches.front();
  if (matches.empty())
    throw UsageError({.what = fmt::format("no exercise is called '{}'", name),
                      .wanted = names.empty() ? "" : fmt::format("one of {}", join(names, ", ")),
                      .nearest = nearestNames(name, spellings)});
  std::vector<std::string> candidates;
  for (const ExerciseInfo* match : matches) candidates.push_back(match->name);
  throw UsageError({.what = fmt::format("several exercises are called '{}'", name), .nearest = candidates});
}

}  // namespace rex::submission
