#include "classroom/import_table.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/instant.h"
#include "base/join.h"
#include "base/printable.h"
#include "base/text_file.h"
#include "classroom/hand_in.h"

namespace rex::grading {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kImportSchema = "rex-import/1";
constexpr std::array<const char*, 3> kStatus = {"handed_in", "nothing", "not_taken"};

template <class Entry>
struct TextKey {
  const char* key;
  std::string Entry::*text;
};
constexpr TextKey<ImportedStudent> kStudentKeys[] = {{"id", &ImportedStudent::id},
                                                     {"name", &ImportedStudent::name},
                                                     {"email", &ImportedStudent::email},
                                                     {"github_username", &ImportedStudent::githubUsername}};
constexpr TextKey<ImportedExercise> kExerciseKeys[] = {{"platform", &ImportedExercise::platform},
                                                       {"identifier", &ImportedExercise::identifier},
                                                       {"maximum_grade", &ImportedExercise::maximumGrade},
                                                       {"why", &ImportedExercise::why},
                                                       {"handed_in_by", &ImportedExercise::handedInBy},
                                                       {"group", &ImportedExercise::group},
                                                       {"time_from", &ImportedExercise::timeFrom},
                                                       {"commit", &ImportedExercise::commit},
                                                       {"source", &ImportedExercise::source},
                                                       {"sha256", &ImportedExercise::sha256},
                                                       {"attempts_from", &ImportedExercise::attemptsFrom}};

/// Reads one table and knows the place in it, as in "students[3].exercises.01-kinematics".
class ImportTableReader {
 public:
  explicit ImportTableReader(const fs::path& file) : file_(file) {}

  ImportTable read() const {
    Json json;
    try {
      json = Json::parse(readTextFile(file_));
    } catch (const Json::parse_error&) {
      throw refusal("", "text that is not JSON", kMadeBy);
    }
    if (textIn(json, "schema", "") != kImportSchema)
      throw refusal("schema", "'" + textIn(json, "schema", "") + "'", kImportSchema);
    if (!json.contains("students") || !json["students"].is_array())
      throw refusal("students", "no list", kMadeBy);
    ImportTable table;
    for (const Json& entry : json["students"])
      table.students.push_back(student(entry, fmt::format("students[{}]", table.students.size())));
    std::sort(table.students.begin(), table.students.end(),
              [](const auto& a, const auto& b) { return a.student < b.student; });
    for (std::size_t k = 1; k < table.students.size(); ++k)
      if (table.students[k - 1].student == table.students[k].student)
        throw refusal("students", "'" + table.students[k].student + "' twice", "once");
    return table;
  }

 private:
  static constexpr int kMostAttempts = 1'000'000;
  static constexpr const char* kMadeBy = "a table that `rex import` wrote";

  ImportedStudent student(const Json& json, const std::string& place) const {
    ImportedStudent read{.student = textIn(json, "student", place)};
    if (const std::string why = whyNoStudentName(read.student); !why.empty())
      throw refusal(place + ".student", why, "the name of a student");
    for (const auto& [key, text] : kStudentKeys) read.*text = textIn(json, key, place);
    if (!json.contains("exercises")) return read;
    if (!json["exercises"].is_object()) throw refusal(place + ".exercises", "no table", kMadeBy);
    for (const auto& [name, entry] : json["exercises"].items())
      read.exercises[name] = exercise(entry, place + ".exercises." + name);
    return read;
  }

  ImportedExercise exercise(const Json& json, const std::string& place) const {
    ImportedExercise read;
    for (const auto& [key, text] : kExerciseKeys) read.*text = textIn(json, key, place);
    const std::string status = textIn(json, "status", place);
    const auto found = std::find(kStatus.begin(), kStatus.end(), status);
    if (found == kStatus.end()) throw refusal(place + ".status", "'" + status + "'", join(kStatus, ", "));
    read.status = static_cast<HandInStatus>(found - kStatus.begin());
    const std::string submitted = textIn(json, "submitted", place);
    read.submitted = parseInstant(submitted);
    if (!submitted.empty() && !read.submitted)
      throw refusal(place + ".submitted", "'" + submitted + "'", "a time such as 2026-11-20T22:59:00Z");
    if (json.contains("attempts")) {
      if (!json["attempts"].is_number_unsigned() || json["attempts"] < 1 || json["attempts"] > kMostAttempts)
        throw refusal(place + ".attempts", json["attempts"].dump(), "a number from 1 on");
      read.attempts = json["attempts"].get<int>();
    }
    return read;
  }

  // Empty if it is missing.
  std::string textIn(const Json& json, const char* key, const std::string& place) const {
    if (!json.is_object()) throw refusal(place, "no table", kMadeBy);
    if (!json.contains(key)) return {};
    if (!json[key].is_string())
      throw refusal(place.empty() ? key : place + "." + key, json[key].dump(), "a text");
    return json[key].get<std::string>();
  }

  Error refusal(const std::string& place, const std::string& found, std::string wanted) const {
    return Error({.what = "not a table of imports" + (place.empty() ? "" : ": " + printable(place, 200)),
                  .where = {file_.string()},
                  .found = printable(found, 200),
                  .wanted = std::move(wanted)});
  }

  fs::path file_;
};

template <class Entry, std::size_t kSize>
void putTexts(Json& json, const Entry& entry, const TextKey<Entry> (&keys)[kSize]) {
  for (const auto& [key, text] : keys)
    if (!(entry.*text).empty()) json[key] = entry.*text;
}

Json jsonOf(const ImportedExercise& exercise) {
  Json json = {{"status", kStatus[static_cast<std::size_t>(exercise.status)]}};
  putTexts(json, exercise, kExerciseKeys);
  if (exercise.submitted) json["submitted"] = instantText(*exercise.submitted);
  if (exercise.attempts > 0) json["attempts"] = exercise.attempts;
  return json;
}

}  // namespace

const ImportedStudent* ImportTable::find(const std::string& student) const {
  const auto found = std::find_if(students.begin(), students.end(),
                                  [&](const ImportedStudent& entry) { return entry.student == student; });
  return found == students.end() ? nullptr : &*found;
}

const ImportedExercise* ImportTable::find(const std::string& student, const std::string& exercise) const {
  const ImportedStudent* entry = find(student);
  if (entry == nullptr) return nullptr;
  const auto found = entry->exercises.find(exercise);
  return found == entry->exercises.end() ? nullptr : &found->second;
}

ImportTable readImportTable(const fs::path& file) { return ImportTableReader(file).read(); }

ImportTable importTableIn(const fs::path& folder) {
  if (fs::exists(folder / kBegunTable))
    throw Error({.what = "an import into this folder was interrupted",
                 .where = {folder.string()},
                 .wanted = "the same `rex import` again, which goes on"});
  const fs::path file = folder / kImportTable;
  return fs::exists(file) ? readImportTable(file) : ImportTable{};
}

std::string importTableText(const ImportTable& table) {
  Json students = Json::array();
  for (const ImportedStudent& student : table.students) {
    Json json = {{"student", student.student}};
    putTexts(json, student, kStudentKeys);
    json["exercises"] = Json::object();
    for (const auto& [name, exercise] : student.exercises) json["exercises"][name] = jsonOf(exercise);
    students.push_back(std::move(json));
  }
  return Json{{"schema", kImportSchema}, {"students", students}}.dump(2, ' ', false,
                                                                      Json::error_handler_t::replace) +
         "\n";
}

}  // namespace rex::grading
