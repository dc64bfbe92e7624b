#include "classroom/late_policy.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/error.h"
#include "base/instant.h"
#include "base/toml_table.h"
#include "classroom/csv.h"
#include "submission/exercise_info.h"

namespace rex::classroom {
namespace {

constexpr std::int64_t kDay = 86400;

std::int64_t hundredths(double number) { return std::llround(100 * number); }

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Reads one file of deadlines.
class PolicyReader {
 public:
  PolicyReader(const TomlTable& file, const std::filesystem::path& folder,
               const std::vector<std::string>& exercises)
      : exercises_(exercises), top_(file), folder_(folder) {}

  LatePolicy read() const {
    LateRule all;
    if (const auto table = top_.table("all", "[all]", "a table")) readRule(*table, all);
    LatePolicy policy;
    for (const std::string& exercise : exercises_) policy[exercise] = all;
    const auto exercises = top_.table("exercise", "[exercise]", "a table");
    for (const std::string& name : exercises ? exercises->keys() : std::vector<std::string>{}) {
      if (!contains(exercises_, name))
        throw Error({.what = fmt::format("no exercise is called '{}'", name),
                     .where = exercises->where(name),
                     .nearest = nearestNames(name, exercises_)});
      readRule(*exercises->table(name, fmt::format("[exercise.{}]", name), "a table"), policy[name]);
    }
    if (top_.has("extensions")) readExtensions(policy);
    return policy;
  }

 private:
  static void readRule(const TomlTable& keys, LateRule& rule) {
    constexpr int kMostMinutes = 60 * 24 * 365;
    keys.refuseKeysBut({"opening", "deadline", "grace_minutes", "percent_per_day", "points_per_day",
                        "cap_percent", "cap_points", "extensions", "weight", "parts", "bonus",
                        "minimum_percent"});
    if (keys.has("opening")) rule.opening = keys.instant("opening");
    if (keys.has("deadline")) rule.deadline = keys.instant("deadline");
    if (keys.has("grace_minutes")) rule.graceSeconds = 60 * keys.integer("grace_minutes", 0, kMostMinutes);
    readCost(keys, "percent", "points", true, rule);
    readCost(keys, "points", "percent", false, rule);
    if (const auto extensions = keys.table("extensions", "extensions", "a table"))
      for (const std::string& student : extensions->keys())
        rule.extensions[student] = extensions->instant(student),
        rule.places[student] = extensions->where(student);
  }

  // A row without an exercise is for all of them. Of several for a student, the latest counts, as for groups.
  void readExtensions(LatePolicy& policy) const {
    const std::filesystem::path file = folder_ / top_.text("extensions");
    if (!std::filesystem::is_regular_file(file))
      throw Error({.what = "no such table of extensions",
                   .where = top_.where("extensions"),
                   .found = file.string(),
                   .wanted = "a CSV file with the columns student, deadline and exercise"});
    static const CsvTable::Headings kStudent = {"student"}, kDeadline = {"deadline"}, kOf = {"exercise"};
    const CsvTable table(file, "a table of extensions");
    table.refuseMisspelt({kStudent, kDeadline, kOf});
    table.require(kStudent), table.require(kDeadline);
    table.requireWholeRows();
    for (std::size_t row = 0; row < table.size(); ++row) {
      const std::string student = table.text(row, kStudent), time = table.text(row, kDeadline);
      const SourceLocation where{table.place(row)};
      const auto deadline = parseInstant(time);
      if (student.empty() || !deadline)
        throw Error({.what = "not an extension",
                     .where = where,
                     .found = student.empty() ? "no student" : "'" + time + "'",
                     .wanted = student.empty() ? "an id or a group"
                                               : "a time with its zone, such as 2026-11-20T23:59:00+01:00"});
      for (const std::string& exercise : exercisesIn(table.text(row, kOf), where)) {
        const auto [known, isNew] = policy[exercise].extensions.emplace(student, *deadline);
        if (isNew || known->second < *deadline)
          known->second = *deadline, policy[exercise].places[student] = where;
      }
    }
  }

  std::vector<std::string> exercisesIn(const std::string& name, const SourceLocation& where) const {
    if (name.empty()) return exercises_;
    std::vector<submission::ExerciseInfo> known(exercises_.size());
    for (std::size_t k = 0; k < known.size(); ++k) known[k].name = exercises_[k];
    try {
      return {submission::findExercise(known, name).name};
    } catch (const UsageError& error) {
      ErrorParts parts = error.parts();
      parts.where = where;
      throw Error(std::move(parts));
    }
  }

  // The unit is percent or points, for both the cost per day and the cap.
  static void readCost(const TomlTable& keys, const std::string& unit, const std::string& other,
                       bool isPercent, LateRule& rule) {
    const std::string perDay = unit + "_per_day", cap = "cap_" + unit;
    const double most = isPercent ? 100 : 1000;
    if (keys.has(perDay)) {
      if (keys.has(other + "_per_day"))
        throw Error({.what = fmt::format("both {} and {}_per_day", perDay, other),
                     .where = keys.where(perDay),
                     .wanted = "one of them"});
      if (rule.isPercent != isPercent) rule.cap.reset();  // that of [all] has the other unit
      rule.isPercent = isPercent;
      rule.perDay = hundredths(keys.number(perDay, 0, most));
    }
    if (!keys.has(cap)) return;
    if (rule.isPercent != isPercent)
      throw Error({.what = fmt::format("'{}'", cap),
                   .where = keys.where(cap),
                   .wanted = fmt::format("cap_{}, as lateness costs {}", other, other)});
    rule.cap = hundredths(keys.number(cap, 0, most));
  }

  const std::vector<std::string>& exercises_;
  const TomlTable& top_;
  const std::filesystem::path& folder_;
};

}  // namespace

std::optional<std::int64_t> studentDeadline(const LateRule& rule, const std::string& student) {
  // An extension for all exercises must not shorten the time for one that is due later.
  if (const auto own = rule.extensions.find(student); rule.deadline && own != rule.extensions.end())
    return std::max(*rule.deadline, own->second);
  return rule.deadline;
}

Lateness computeLateness(const LateRule& rule, const std::string& student, std::int64_t submitted,
                         int points) {
  return latenessOfHundredths(rule, student, submitted, std::int64_t{100} * points);
}

Lateness latenessOfHundredths(const LateRule& rule, const std::string& student, std::int64_t submitted,
                              std::int64_t points) {
  const std::optional<std::int64_t> deadline = studentDeadline(rule, student);
  if (!deadline || submitted <= *deadline + rule.graceSeconds) return {};
  const std::int64_t late = submitted - *deadline, days = (late + kDay - 1) / kDay;
  const std::int64_t cost = std::min(days * rule.perDay, rule.cap.value_or(days * rule.perDay));
  // The cost is in hundredths of a percent or of a point, the penalty in hundredths of a point.
  const std::int64_t penalty = rule.isPercent ? (points * cost + 5000) / 10000 : cost;
  return {static_cast<int>(days), std::min(penalty, points)};
}

LatePolicy readLatePolicy(const std::filesystem::path& file, const std::vector<std::string>& exercises) {
  const TomlTable top = TomlTable::read(file, "the file of deadlines", "a file of deadlines");
  top.refuseKeysBut(kCourseKeys);
  return parseLatePolicy(top, file.parent_path(), exercises);
}

LatePolicy parseLatePolicy(const TomlTable& file, const std::filesystem::path& folder,
                           const std::vector<std::string>& exercises) {
  return PolicyReader(file, folder, exercises).read();
}

std::vector<std::string> unknownExtensions(const LatePolicy& policy,
                                           const std::vector<std::string>& students) {
  std::vector<std::string> sentences;
  for (const auto& [exercise, rule] : policy) {
    for (const auto& [student, deadline] : rule.extensions)
      if (!contains(students, student))
        sentences.emplace_back(
            Error(
                {.what = fmt::format("'{}' has an extension for {} and handed in nothing", student, exercise),
                 .nearest = nearestNames(student, students)})
                .what());
  }
  return sentences;
}

}  // namespace rex::classroom
