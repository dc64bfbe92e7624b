#include "classroom/adjustments.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/toml_table.h"

namespace rex::classroom {
namespace {

constexpr double kMostPoints = 1000;

/// Reads one file of adjustments.
class AdjustmentReader {
 public:
  AdjustmentReader(const std::filesystem::path& file, const Course& course,
                   const std::vector<submission::ExerciseInfo>& exercises, const BlindIds& blind)
      : course_(course),
        exercises_(exercises),
        blind_(blind),
        top_(TomlTable::read(file, "the file of adjustments", "a file of adjustments")) {}

  Adjustments read() const {
    top_.refuseKeysBut({"adjustment", "comment", "complaint"});
    Adjustments all;
    for (const TomlTable& table : top_.tables("adjustment")) all.adjustments.push_back(adjustment(table));
    for (const TomlTable& table : top_.tables("comment")) all.comments.push_back(comment(table));
    for (const TomlTable& table : top_.tables("complaint")) all.complaints.push_back(complaint(table));
    return all;
  }

 private:
  Adjustment adjustment(const TomlTable& table) const {
    table.refuseKeysBut(
        {"student", "group", "exercise", "check", "points", "add", "reason", "author", "date"});
    Adjustment read{.students = students(table),
                    .exercise = exercise(table),
                    .reason = table.text("reason"),
                    .author = table.text("author"),
                    .date = table.day("date"),
                    .where = table.where("exercise")};
    if (table.has("check")) read.check = table.text("check");
    if (table.has("points") == table.has("add"))
      throw Error({.what = "[[adjustment]]",
                   .where = table.where(table.has("add") ? "add" : "exercise"),
                   .found = table.has("add") ? "both points and add" : "neither points nor add",
                   .wanted = "points = 3 to replace the points, or add = -1 to change them"});
    if (table.has("add")) {
      read.add = std::llround(100 * table.number("add", -kMostPoints, kMostPoints));
      return read;
    }
    const double points = table.number("points", -kMostPoints, kMostPoints);
    if (points < 0)
      throw Error({.what = "[[adjustment]]: 'points'",
                   .where = table.where("points"),
                   .found = fmt::format("{}", points),
                   .wanted = "points from 0 on; add = -1 takes a point away"});
    read.points = std::llround(100 * points);
    return read;
  }

  Comment comment(const TomlTable& table) const {
    constexpr int kMostLines = 1'000'000;
    table.refuseKeysBut({"student", "group", "exercise", "line", "text", "author"});
    Comment read{.students = students(table),
                 .exercise = exercise(table),
                 .text = table.text("text"),
                 .where = table.where("text")};
    if (table.has("line")) read.line = table.integer("line", 1, kMostLines);
    if (table.has("author")) read.author = table.text("author");
    return read;
  }

  Complaint complaint(const TomlTable& table) const {
    table.refuseKeysBut({"student", "group", "exercise", "text", "date", "answer"});
    Complaint read{.students = students(table),
                   .exercise = exercise(table),
                   .text = table.text("text"),
                   .date = table.day("date"),
                   .where = table.where("text")};
    if (table.has("answer")) read.answer = table.text("answer");
    return read;
  }

  std::vector<std::string> students(const TomlTable& table) const {
    if (table.has("student") == table.has("group"))
      throw Error({.what = "whom it is about",
                   .where = table.where(table.has("group") ? "group" : "exercise"),
                   .found = table.has("group") ? "both student and group" : "neither student nor group",
                   .wanted = "one of them"});
    if (table.has("student")) {
      const std::string id = table.text("student");
      if (const auto known = blind_.find(id); known != blind_.end()) return {known->second};
      if (id.starts_with("blind-") && course_.student(id) == nullptr && blind_.empty())
        throw Error({.what = fmt::format("the student '{}'", id),
                     .where = table.where("student"),
                     .found = "an id without a name",
                     .wanted = "the secret_file of the course, which leads to the student"});
      std::vector<std::string> known = course_.ids();
      for (const RosterFault& fault : course_.faults) known.push_back(fault.student.id);
      requireKnown(id, known, "student", table.where("student"));
      return {id};
    }
    const std::string group = table.text("group");
    std::vector<std::string> known = course_.groups();
    for (const RosterFault& fault : course_.faults) known.push_back(fault.student.group);
    requireKnown(group, known, "group", table.where("group"));
    return course_.members(group);
  }

  static void requireKnown(const std::string& name, const std::vector<std::string>& known,
                           const std::string& what, const SourceLocation& where) {
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw Error({.what = fmt::format("no {} '{}'", what, name),
                   .where = where,
                   .wanted = what == "group" ? "a group of the roster" : "the id of a student",
                   .nearest = nearestNames(name, known)});
  }

  std::string exercise(const TomlTable& table) const {
    try {
      return submission::findExercise(exercises_, table.text("exercise")).name;
    } catch (const UsageError& error) {
      ErrorParts parts = error.parts();
      parts.where = table.where("exercise");
      throw Error(std::move(parts));
    }
  }

  const Course& course_;
  const std::vector<submission::ExerciseInfo>& exercises_;
  const BlindIds& blind_;
  TomlTable top_;
};

}  // namespace

Adjustments readAdjustments(const std::filesystem::path& file, const Course& course,
                            const std::vector<submission::ExerciseInfo>& exercises, const BlindIds& blind) {
  return AdjustmentReader(file, course, exercises, blind).read();
}

}  // namespace rex::classroom
