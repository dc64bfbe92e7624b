#include "classroom/import_table.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/escape.h"
#include "base/instant.h"
#include "base/text.h"
#include "base/text_file.h"
#include "classroom/gradebook_text.h"
#include "classroom/submission_folder.h"

namespace rex::classroom {
namespace {

bool isSame(const std::string& a, const std::string& b) { return !a.empty() && caseless(a) == caseless(b); }

bool contradicts(const std::string& a, const std::string& b) {
  return !a.empty() && !b.empty() && caseless(a) != caseless(b);
}

bool hasOnlyName(const Person& person) {
  return person.id.empty() && person.email.empty() && person.githubUsername.empty();
}

void complete(std::string& known, const std::string& told) {
  if (!told.empty()) known = composed(told);
}

}  // namespace

ImportNames::ImportNames(ImportTable& table, const DownloadedSubmissions& submissions)
    : table_(table), platform_(toString(submissions.platform)) {
  for (const DownloadedSubmission& received : submissions.all)
    for (const Person& person : received.people) ++nameCounts_[caseless(person.name)];
}

// A name counts only if nobody else has it here or there, and nothing else contradicts.
ImportedStudent* ImportNames::known(const Person& person, const std::vector<std::string>& exercises) {
  const auto find = [&](const auto& fits) -> ImportedStudent* {
    const auto found = std::find_if(table_.students.begin(), table_.students.end(), fits);
    return found == table_.students.end() ? nullptr : &*found;
  };
  if (auto* one = find([&](const ImportedStudent& entry) { return isSame(entry.email, person.email); }))
    return one;
  if (auto* one = find([&](const ImportedStudent& entry) { return isSame(entry.id, person.id); })) return one;
  if (auto* one = find(
          [&](const ImportedStudent& entry) { return isSame(entry.githubUsername, person.githubUsername); }))
    return one;
  if (auto* one = find([&](const ImportedStudent& entry) {
        return std::any_of(exercises.begin(), exercises.end(), [&](const std::string& exercise) {
          const auto told = entry.exercises.find(exercise);
          return told != entry.exercises.end() && told->second.platform == platform_ &&
                 isSame(told->second.identifier, person.identifier);
        });
      }))
    return one;
  const auto hasName = [&](const ImportedStudent& entry) { return isSame(entry.name, person.name); };
  const auto count = std::count_if(table_.students.begin(), table_.students.end(), hasName);
  if (count != 1 || nameCounts_[caseless(person.name)] != 1) return nullptr;
  ImportedStudent* one = find(hasName);
  const bool isOther = contradicts(one->email, person.email) || contradicts(one->id, person.id) ||
                       contradicts(one->githubUsername, person.githubUsername);
  return isOther ? nullptr : one;
}

std::string ImportNames::newName(const Person& person) const {
  const std::string name = composed(person.name),
                    number = person.number.empty() ? person.identifier : person.number;
  const auto count = nameCounts_.find(caseless(name));
  const bool isShared = count != nameCounts_.end() && count->second > 1;
  std::vector<std::string> candidates = {composed(person.id), caseless(person.email),
                                         caseless(person.githubUsername)};
  if (!isShared) candidates.push_back(name);
  if (!name.empty() && !number.empty()) candidates.push_back(name + "-" + number);
  if (!number.empty()) candidates.push_back("participant-" + number);
  for (int k = 1; k <= static_cast<int>(table_.students.size()) + 1; ++k)
    candidates.push_back(fmt::format("student-{}", k));
  const auto isFree = [&](const std::string& candidate) {
    return std::none_of(table_.students.begin(), table_.students.end(), [&](const ImportedStudent& entry) {
      return caseless(entry.student) == caseless(candidate);
    });
  };
  for (const std::string& candidate : candidates)
    if (whyNoStudentName(candidate).empty() && isFree(candidate)) return candidate;
  return candidates.back();
}

std::string ImportNames::personFolder(const Person& person, const std::vector<std::string>& exercises) {
  ImportedStudent* entry = known(person, exercises);
  if (entry == nullptr) entry = &table_.students.emplace_back(ImportedStudent{.student = newName(person)});
  complete(entry->id, person.id);
  complete(entry->name, person.name);
  complete(entry->email, person.email);
  complete(entry->githubUsername, person.githubUsername);
  if (hasOnlyName(person) && !person.name.empty()) ++byNameAlone_;
  return entry->student;
}

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
    read.status = static_cast<SubmissionStatus>(found - kStatus.begin());
    const std::string submitted = textIn(json, "submitted", place);
    read.submitted = parseInstant(submitted);
    if (!submitted.empty() && !read.submitted)
      throw refusal(place + ".submitted", "'" + submitted + "'", "a time such as 2026-11-20T22:59:00Z");
    if (json.contains("attempts")) {
      if (!json["attempts"].is_number_unsigned() || json["attempts"] < 1 || json["attempts"] > kMostAttempts)
        throw refusal(place + ".attempts", json["attempts"].dump(), "a number from 1 on");
      read.attempts = json["attempts"].get<int>();
    }
    if (json.contains("work")) {
      read.work = submission::readWorkTime(json["work"].dump());
      if (!read.work) throw refusal(place + ".work", json["work"].dump(), "seconds and parts");
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
  if (exercise.work) json["work"] = Json::parse(workTimeText(*exercise.work));
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

}  // namespace rex::classroom
