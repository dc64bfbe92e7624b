#include "grading/late_policy.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/error.h"
#include "grading/toml_table_internal.h"

namespace rex::grading {
namespace {

using internal::TableReader;

constexpr std::int64_t kDay = 86400;

std::int64_t hundredths(double number) { return std::llround(100 * number); }

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Reads one file of deadlines.
class PolicyReader {
 public:
  PolicyReader(const std::filesystem::path& file, const std::vector<std::string>& exercises)
      : file_(file.string()),
        exercises_(exercises),
        root_(internal::parseToml(file, "a file of deadlines")) {}

  LatePolicy read() const {
    const TableReader top(root_, "the file of deadlines", file_);
    top.refuseKeysBut({"all", "exercise"});
    LateRule all;
    if (const toml::table* table = tableOf(root_, "all", top))
      readRule({*table, "[all]", file_}, *table, all);
    LatePolicy policy;
    for (const std::string& exercise : exercises_) policy[exercise] = all;
    const toml::table* exercises = tableOf(root_, "exercise", top);
    if (exercises == nullptr) return policy;
    const TableReader names(*exercises, "[exercise]", file_);
    for (const auto& [key, node] : *exercises) {
      const std::string name(key.str());
      if (!contains(exercises_, name))
        throw Error({.what = fmt::format("no exercise is called '{}'", name),
                     .where = names.where(name),
                     .nearest = nearestNames(name, exercises_)});
      const toml::table& table = *tableOf(*exercises, name, names);
      readRule({table, fmt::format("[exercise.{}]", name), file_}, table, policy[name]);
    }
    return policy;
  }

 private:
  static const toml::table* tableOf(const toml::table& parent, const std::string& key,
                                    const TableReader& reader) {
    const toml::node* node = parent.get(key);
    if (node != nullptr && !node->is_table())
      throw Error({.what = fmt::format("'{}'", key), .where = reader.where(key), .wanted = "a table"});
    return node == nullptr ? nullptr : node->as_table();
  }

  void readRule(const TableReader& keys, const toml::table& table, LateRule& rule) const {
    constexpr int kMostMinutes = 60 * 24 * 365;
    keys.refuseKeysBut({"deadline", "grace_minutes", "percent_per_day", "points_per_day", "cap_percent",
                        "cap_points", "extensions"});
    if (keys.has("deadline")) rule.deadline = keys.instant("deadline");
    if (keys.has("grace_minutes")) rule.graceSeconds = 60 * keys.integer("grace_minutes", 0, kMostMinutes);
    readCost(keys, "percent", "points", true, rule);
    readCost(keys, "points", "percent", false, rule);
    if (const toml::table* extensions = tableOf(table, "extensions", keys))
      readExtensions({*extensions, "extensions", file_}, *extensions, rule);
  }

  // Percent or points, for both the day and the cap.
  static void readCost(const TableReader& keys, const std::string& unit, const std::string& other,
                       bool isPercent, LateRule& rule) {
    const std::string perDay = unit + "_per_day", cap = "cap_" + unit;
    const double most = isPercent ? 100 : 1000;
    if (keys.has(perDay)) {
      if (keys.has(other + "_per_day"))
        throw Error({.what = fmt::format("both {} and {}_per_day", perDay, other),
                     .where = keys.where(perDay),
                     .wanted = "one of them"});
      rule.isPercent = isPercent;
      rule.perDay = hundredths(keys.number(perDay, 0, most));
      rule.cap.reset();  // one of [all] could have the other unit
    }
    if (!keys.has(cap)) return;
    if (rule.isPercent != isPercent)
      throw Error({.what = fmt::format("'{}'", cap),
                   .where = keys.where(cap),
                   .wanted = fmt::format("cap_{}, as lateness costs {}", other, other)});
    rule.cap = hundredths(keys.number(cap, 0, most));
  }

  static void readExtensions(const TableReader& keys, const toml::table& table, LateRule& rule) {
    for (const auto& [key, node] : table) rule.extensions[std::string(key.str())] = keys.instant(key.str());
  }

  std::string file_;
  const std::vector<std::string>& exercises_;
  toml::table root_;
};

}  // namespace

Lateness latenessOf(const LateRule& rule, const std::string& student, std::int64_t submitted, int points) {
  std::optional<std::int64_t> deadline = rule.deadline;
  // One for all exercises must not shorten the time for an exercise that is due later.
  if (const auto own = rule.extensions.find(student); deadline && own != rule.extensions.end())
    deadline = std::max(*deadline, own->second);
  if (!deadline || submitted <= *deadline + rule.graceSeconds) return {};
  const std::int64_t late = submitted - *deadline, days = (late + kDay - 1) / kDay;
  const std::int64_t cost = std::min(days * rule.perDay, rule.cap.value_or(days * rule.perDay));
  // A percent is a hundredth of the points, and both count in hundredths here.
  const std::int64_t penalty = rule.isPercent ? (points * cost + 50) / 100 : cost;
  return {static_cast<int>(days), std::min(penalty, std::int64_t{100} * points)};
}

LatePolicy readLatePolicy(const std::filesystem::path& file, const std::vector<std::string>& exercises) {
  return PolicyReader(file, exercises).read();
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

}  // namespace rex::grading
