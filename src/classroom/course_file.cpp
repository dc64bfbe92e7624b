#include "classroom/course_file.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/escape.h"
#include "base/text.h"
#include "classroom/csv.h"
#include "classroom/gradebook_text.h"
#include "classroom/platform_time.h"
#include "classroom/submission_folder.h"

namespace rex::classroom {
namespace {

namespace fs = std::filesystem;

constexpr const char* kCourseStudent = "a student";
const std::vector<std::string> kRosterKeys = {"id", "name", "email", "group", "number", "section"};

std::string& fieldOf(CourseStudent& student, const std::string& key) {
  if (key == "id") return student.id;
  if (key == "name") return student.name;
  if (key == "email") return student.email;
  if (key == "group") return student.group;
  return key == "number" ? student.number : student.section;
}

/// Students with the places where they stand, until it is known that they are different people. A fault of
/// one row stops that row, not the class.
class RosterReader {
 public:
  explicit RosterReader(Course& course) : course_(course) {}

  /// `read` fills in the student and throws Error as far as it cannot.
  void add(const SourceLocation& where, const std::function<void(CourseStudent&)>& read) {
    CourseStudent student;
    try {
      read(student);
      if (const std::string why = whyNoStudentName(student.id); !why.empty())
        throw Error({.what = fmt::format("{}: 'id'", kCourseStudent),
                     .where = where,
                     .found = student.id.empty() ? "none" : why,
                     .wanted = "the name of the folder that is handed in"});
      for (const std::string& key : kRosterKeys)
        if (key != "id") clean(fieldOf(student, key), key, student.id, where);
      requireNew(ids_, student.id, "id", where);
      if (!student.email.empty()) requireNew(emails_, student.email, "e-mail", where);
      rows_.emplace_back(std::move(student), where);
    } catch (const Error& error) {
      course_.faults.push_back({std::move(student), error.what()});
    }
  }

  // A folder of that name would belong to two.
  void end() {
    for (auto& [student, where] : rows_) {
      const auto same = ids_.find(caseless(student.group));
      if (same == ids_.end())
        course_.students.push_back(std::move(student));
      else
        course_.faults.push_back(
            {student, Error({.what = fmt::format("the group '{}' is also the id of a student", student.group),
                             .where = where,
                             .wanted = fmt::format("another name for the group; the student is at {}",
                                                   toString(same->second))})
                          .what()});
    }
    std::sort(course_.students.begin(), course_.students.end(),
              [](const CourseStudent& a, const CourseStudent& b) { return a.id < b.id; });
  }

 private:
  void clean(std::string& text, const std::string& key, const std::string& id, const SourceLocation& where) {
    CleanName name = cleanName(text);
    if (printable(name.text) != name.text || name.text.find('\n') != std::string::npos)
      throw Error({.what = fmt::format("{}: '{}'", kCourseStudent, key),
                   .where = where,
                   .found = "a line break or an invisible character",
                   .wanted = "one line of text"});
    if (!name.lost.empty())
      course_.notes.push_back(fmt::format("{}: left out of the {} of '{}', where nobody sees it: {}",
                                          toString(where), key, id, join(name.lost, ", ")));
    text = std::move(name.text);
  }
  static void requireNew(std::map<std::string, SourceLocation>& seen, const std::string& text,
                         const std::string& what, const SourceLocation& where) {
    const auto [first, isNew] = seen.emplace(caseless(text), where);
    if (!isNew)
      throw Error({.what = fmt::format("a second student with the {} '{}'", what, text),
                   .where = where,
                   .wanted = fmt::format("one; the first is at {}", toString(first->second))});
  }

  Course& course_;
  std::vector<std::pair<CourseStudent, SourceLocation>> rows_{};
  std::map<std::string, SourceLocation> ids_{}, emails_{};  // by caseless() text
};

void readStudentTables(const TomlTable& top, RosterReader& roster) {
  for (const TomlTable& table : top.tables("student"))
    roster.add(table.where("id"), [&](CourseStudent& student) {
      student.id = table.text("id");
      table.refuseKeysBut(kRosterKeys);
      for (const std::string& key : kRosterKeys)
        if (table.has(key)) fieldOf(student, key) = table.text(key);
    });
}

void readStudentRows(const fs::path& file, RosterReader& roster) {
  // In the order of kRosterKeys, also as platforms export them in German and French.
  static const std::vector<CsvTable::Headings> kColumns = {
      {"id", "Kennung", "Identifiant"},
      {"name", "Full name", "Vollständiger Name", "Nom complet", "Nom"},
      {"email", "E-Mail", "Email address", "E-Mail-Adresse", "Adresse de courriel", "Courriel"},
      {"group", "Gruppe", "Groupe"},
      {"number", "Matrikelnummer", "Numéro d'étudiant"},
      {"section", "Sektion"}};
  const CsvTable table(file, "a table of students");
  table.require(kColumns[0]);
  table.refuseMisspelt(kColumns);
  for (std::size_t k = 0; k < table.size(); ++k)
    roster.add({table.place(k)}, [&](CourseStudent& student) {
      for (std::size_t c = 0; c < kRosterKeys.size(); ++c)
        fieldOf(student, kRosterKeys[c]) = table.text(k, kColumns[c]);
      table.requireWholeRow(k);
    });
}

/// Reads one course file.
class CourseReader {
 public:
  CourseReader(const fs::path& file, const std::vector<submission::ExerciseInfo>& exercises, RosterUse use)
      : folder_(file.parent_path()),
        use_(use),
        exercises_(exercises),
        top_(TomlTable::read(file, "the course file", "a course file")) {}

  Course read() {
    top_.refuseKeysBut(kCourseKeys);
    if (top_.has("title")) course_.title = top_.text("title");
    if (top_.has("results")) course_.results = folder_ / top_.text("results");
    if (top_.has("adjustments")) course_.adjustments = folder_ / top_.text("adjustments");
    for (const char* key : {"students", "extensions", "adjustments"})
      if (top_.has(key)) course_.files.push_back(folder_ / top_.text(key));
    readSettings(course_.settings);
    if (top_.has("time_zone")) course_.timeZone = zoneAt("time_zone");
    if (use_ == RosterUse::kRead) readStudents();
    std::vector<std::string> names;
    for (const submission::ExerciseInfo& exercise : exercises_) names.push_back(exercise.name);
    course_.policy = parseLatePolicy(top_, folder_, names);
    readExercises();
    if (const auto total = top_.table("total", "[total]", "a table")) readTotal(*total);
    for (const TomlTable& table : top_.tables("tutor")) readTutor(table);
    for (auto& [exercise, rule] : course_.policy) {
      requireExtensions(rule);
      giveToMembers(rule);
    }
    return std::move(course_);
  }

 private:
  std::string zoneAt(const char* key) const {
    try {
      static_cast<void>(PlatformZone(top_.text(key)));
    } catch (const UsageError& error) {
      throw Error({.what = fmt::format("'{}'", key),
                   .where = top_.where(key),
                   .found = error.parts().found,
                   .wanted = error.parts().wanted});
    }
    return top_.text(key);
  }

  void readSettings(GradingSettings& settings) const {
    if (top_.has("secret_file")) settings.secret = folder_ / top_.text("secret_file");
    if (top_.has("seed"))
      settings.seed = static_cast<std::uint64_t>(top_.integer("seed", 0, std::numeric_limits<int>::max()));
    if (top_.has("level")) settings.level = top_.integer("level", 0, 3);
    if (top_.has("evidence")) settings.evidence = top_.boolean("evidence");
    if (top_.has("reports")) settings.reports = join(top_.texts("reports"), ",");
  }

  void readStudents() {
    RosterReader roster(course_);
    if (top_.has("students")) {
      const fs::path file = folder_ / top_.text("students");
      if (!fs::is_regular_file(file))
        throw Error({.what = "no such table of students",
                     .where = top_.where("students"),
                     .found = file.string(),
                     .wanted = "a CSV file with the column id"});
      readStudentRows(file, roster);
    }
    readStudentTables(top_, roster);
    roster.end();
  }

  void readExercises() {
    std::optional<std::int64_t> minimum;
    const auto exercises = top_.table("exercise", "[exercise]", "a table");
    if (const auto all = top_.table("all", "[all]", "a table")) {
      for (const char* key : {"weight", "parts", "bonus"})
        if (all->has(key))
          throw Error({.what = fmt::format("[all]: '{}'", key),
                       .where = all->where(key),
                       .wanted = "it in the table of an exercise"});
      if (all->has("minimum_percent")) {
        if (!exercises) throw needsExercises(*all, "[all]", "minimum_percent");
        minimum = percentAt(*all, "minimum_percent");
      }
    }
    for (const std::string& name : exercises ? exercises->keys() : std::vector<std::string>{})
      readExercise(*exercises->table(name, fmt::format("[exercise.{}]", name), "a table"), name, minimum);
  }

  void readExercise(const TomlTable& keys, const std::string& name, std::optional<std::int64_t> minimum) {
    constexpr double kMostWeight = 1000;
    CourseExercise& exercise = course_.exercises[name];
    if (keys.has("weight")) exercise.weight = std::llround(100 * keys.number("weight", 0, kMostWeight));
    if (exercise.weight == 0)
      throw Error({.what = fmt::format("[exercise.{}]: 'weight'", name),
                   .where = keys.where("weight"),
                   .wanted = "at least 0.01"});
    if (keys.has("parts")) exercise.parts = partsAt(keys, name);
    exercise.isBonus = keys.has("bonus") && keys.boolean("bonus");
    if (exercise.isBonus && keys.has("minimum_percent"))
      throw Error({.what = fmt::format("[exercise.{}]: 'minimum_percent'", name),
                   .where = keys.where("minimum_percent"),
                   .found = "a minimum of a bonus",
                   .wanted = "a bonus, which nobody needs, or a minimum"});
    if (keys.has("minimum_percent")) minimum = percentAt(keys, "minimum_percent");
    if (!exercise.isBonus) exercise.minimum = minimum;
  }

  std::vector<std::string> partsAt(const TomlTable& keys, const std::string& name) const {
    std::vector<std::string> known, parts;
    for (const submission::ExercisePart& part : submission::findExercise(exercises_, name).parts)
      known.push_back(part.id);
    const auto refuse = [&](std::string found, std::vector<std::string> nearest = {}) {
      throw Error({.what = fmt::format("[exercise.{}]: 'parts'", name),
                   .where = keys.where("parts"),
                   .found = std::move(found),
                   .wanted = "some of " + join(known, ", "),
                   .nearest = std::move(nearest)});
    };
    for (const std::string& part : keys.texts("parts")) {
      if (std::find(known.begin(), known.end(), part) == known.end())
        refuse("'" + part + "'", nearestNames(part, known));
      if (std::find(parts.begin(), parts.end(), part) != parts.end()) refuse("'" + part + "' twice");
      parts.push_back(part);
    }
    if (parts.empty()) refuse("none");
    return parts;
  }

  static std::int64_t percentAt(const TomlTable& keys, const char* key) {
    return std::llround(100 * keys.number(key, 0, 100));
  }

  static Error needsExercises(const TomlTable& keys, const std::string& table, const char* key) {
    return Error({.what = fmt::format("{}: '{}'", table, key),
                  .where = keys.where(key),
                  .found = "no tables of exercises",
                  .wanted = "[exercise.NAME] for each exercise that counts"});
  }

  void readTotal(const TomlTable& keys) {
    TotalRules& rules = course_.total;
    keys.refuseKeysBut({"best", "pass_percent", "pass_exercises"});
    for (const char* key : {"best", "pass_percent", "pass_exercises"})
      if (keys.has(key) && course_.exercises.empty()) throw needsExercises(keys, "[total]", key);
    const auto counted = [&](const char* key, const char* what, const auto& isCounted) {
      const auto most = std::count_if(course_.exercises.begin(), course_.exercises.end(), isCounted);
      const int count = keys.integer(key, 1, 1000);
      if (count > most)
        throw Error({.what = fmt::format("[total]: '{}'", key),
                     .where = keys.where(key),
                     .found = fmt::format("{}", count),
                     .wanted = fmt::format("at most {}, as many as {}", most, what)});
      return count;
    };
    if (keys.has("best"))
      rules.best = counted("best", "there are exercises without bonus",
                           [](const auto& one) { return !one.second.isBonus; });
    if (keys.has("pass_percent")) rules.passPercent = percentAt(keys, "pass_percent");
    if (!keys.has("pass_exercises")) return;
    rules.passExercises = counted("pass_exercises", "there are exercises with a minimum_percent",
                                  [](const auto& one) { return one.second.minimum.has_value(); });
    if (rules.best && *rules.passExercises > *rules.best)
      throw Error({.what = "[total]: 'pass_exercises'",
                   .where = keys.where("pass_exercises"),
                   .found = fmt::format("{}", *rules.passExercises),
                   .wanted = fmt::format("at most {}, as only the best {} count", *rules.best, *rules.best)});
  }

  void readTutor(const TomlTable& table) {
    table.refuseKeysBut({"name", "section", "adjustments"});
    Tutor tutor{.name = table.text("name")};
    for (const Tutor& one : course_.tutors)
      if (one.name == tutor.name || (table.has("section") && one.section == table.text("section")))
        throw Error({.what = fmt::format("a second [[tutor]] of the {} '{}'",
                                         one.name == tutor.name ? "name" : "section",
                                         one.name == tutor.name ? one.name : one.section),
                     .where = table.where(one.name == tutor.name ? "name" : "section"),
                     .wanted = "one"});
    if (table.has("section")) tutor.section = sectionAt(table);
    if (table.has("adjustments")) {
      tutor.adjustments = folder_ / table.text("adjustments");
      course_.files.push_back(tutor.adjustments);
    }
    course_.tutors.push_back(std::move(tutor));
  }

  std::string sectionAt(const TomlTable& table) const {
    std::string section = table.text("section");
    std::vector<std::string> known;
    for (const CourseStudent& student : course_.students)
      if (!student.section.empty()) known.push_back(student.section);
    for (const RosterFault& fault : course_.faults) known.push_back(fault.student.section);
    if (course_.hasRoster() && std::find(known.begin(), known.end(), section) == known.end())
      throw Error({.what = fmt::format("no section '{}'", section),
                   .where = table.where("section"),
                   .wanted = "a section of the roster",
                   .nearest = nearestNames(section, known)});
    return section;
  }

  // An extension for a name that nobody has is one that somebody misses.
  void requireExtensions(const LateRule& rule) const {
    if (!course_.hasRoster()) return;
    std::vector<std::string> known = course_.ids();
    for (const std::string& group : course_.groups()) known.push_back(group);
    for (const RosterFault& fault : course_.faults)
      known.insert(known.end(), {fault.student.id, fault.student.group});
    for (const auto& [name, where] : rule.places)
      if (std::find(known.begin(), known.end(), name) == known.end())
        throw Error({.what = fmt::format("an extension for '{}'", name),
                     .where = where,
                     .found = "nobody of this name on the roster",
                     .wanted = "the id of a student, or a group",
                     .nearest = nearestNames(name, known)});
  }

  void giveToMembers(LateRule& rule) const {
    for (const CourseStudent& student : course_.students)
      if (const auto own = rule.extensions.find(student.group); own != rule.extensions.end())
        rule.extensions[student.id] = std::max(rule.extensions[student.id], own->second);
  }

  fs::path folder_;
  RosterUse use_;
  const std::vector<submission::ExerciseInfo>& exercises_;
  TomlTable top_;
  Course course_{};
};

}  // namespace

bool CourseExercise::counts(const std::string& part) const {
  return parts.empty() || std::find(parts.begin(), parts.end(), part) != parts.end();
}

CourseExercise Course::exercise(const std::string& name) const {
  const auto found = exercises.find(name);
  return found == exercises.end() ? CourseExercise{} : found->second;
}

bool Course::hasPassRules() const {
  return total.passPercent ||
         std::ranges::any_of(exercises, [](const auto& one) { return one.second.minimum.has_value(); });
}

const CourseStudent* Course::student(const std::string& id) const {
  const auto found = std::find_if(students.begin(), students.end(),
                                  [&](const CourseStudent& student) { return student.id == id; });
  return found == students.end() ? nullptr : &*found;
}

std::vector<std::string> Course::ids() const {
  std::vector<std::string> ids;
  for (const CourseStudent& student : students) ids.push_back(student.id);
  return ids;
}

std::vector<std::string> Course::groups() const {
  std::vector<std::string> groups;
  for (const CourseStudent& student : students)
    if (!student.group.empty()) groups.push_back(student.group);
  std::sort(groups.begin(), groups.end());
  groups.erase(std::unique(groups.begin(), groups.end()), groups.end());
  return groups;
}

std::vector<std::string> Course::members(const std::string& group) const {
  std::vector<std::string> ids;
  for (const CourseStudent& student : students)
    if (!group.empty() && student.group == group) ids.push_back(student.id);
  return ids;
}

Course readCourse(const fs::path& file, const std::vector<submission::ExerciseInfo>& exercises,
                  RosterUse roster) {
  return CourseReader(file, exercises, roster).read();
}

std::string shownName(const CourseStudent& student) {
  return student.name.empty() ? student.id : student.name;
}

}  // namespace rex::classroom
