#include "classroom/platform_grades.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <yaml-cpp/yaml.h>

#include "base/error.h"
#include "base/escape.h"
#include "base/isolated_call.h"
#include "classroom/csv.h"
#include "classroom/download.h"
#include "classroom/gradebook_text.h"
#include "classroom/platform_time.h"

namespace rex::classroom {
namespace {

std::string finalText(const GradeRow* row) {
  return row != nullptr && row->final ? reports::hundredthsText(*row->final) : "";
}

// What students have gets a number; what they lack stays empty, and is told, and so is what may be too much.
void tellOdd(const Gradebook& book, PlatformGrades& grades) {
  for (const GradeRow& row : book.rows)
    if (row.status == RowStatus::kToRepeat)
      grades.notes.push_back(
          fmt::format("{} {}: no grade yet ({})", row.student.id, row.exercise, row.remark));
    else if (row.final.value_or(0) > row.possible)
      grades.notes.push_back(aboveMaximum(row, *row.final, row.possible));
}

std::string sisOf(const CourseStudent& student) {
  return student.number.empty() ? student.id : student.number;
}

std::int64_t possibleOf(const Gradebook& book, const std::string& exercise) {
  for (const GradeRow& row : book.rows)
    if (row.exercise == exercise && !row.worth.isBonus) return row.possible;
  return 0;
}

}  // namespace

std::string aboveMaximum(const GradeRow& row, std::int64_t points, std::int64_t most) {
  return fmt::format("{} {}: {} points, though the maximum is {}: the platform may refuse or cut them",
                     row.student.id, row.exercise, reports::hundredthsText(points),
                     reports::hundredthsText(most));
}

PlatformGrades gradescopeGrades(const Gradebook& book) {
  std::vector<std::string> headings = {"Name", "SID", "Email"};
  headings.insert(headings.end(), book.exercises.begin(), book.exercises.end());
  headings.emplace_back("Total Score");
  headings.emplace_back("Max Points");
  PlatformGrades grades{.csv = csvLine(headings)};
  for (const StudentTotal& sum : book.totals) {
    std::vector<std::string> cells = {shownName(sum.student), sisOf(sum.student), sum.student.email};
    for (const std::string& exercise : book.exercises)
      cells.push_back(finalText(book.row(sum.student.id, exercise)));
    cells.push_back(sum.total ? reports::hundredthsText(*sum.total) : "");
    cells.push_back(reports::hundredthsText(sum.possible));
    grades.csv += csvLine(cells);
  }
  tellOdd(book, grades);
  return grades;
}

// The first blanks of the row of possible points are Canvas's own. Points of an assignment with none that are
// possible come on top there.
PlatformGrades canvasGrades(const Gradebook& book) {
  std::vector<std::string> headings = {"Student", "ID", "SIS User ID", "SIS Login ID", "Section"},
                           possible = {"    Points Possible", "", "", "", ""};
  for (const std::string& exercise : book.exercises) {
    headings.push_back(exercise);
    possible.push_back(reports::hundredthsText(possibleOf(book, exercise)));
  }
  PlatformGrades grades{.csv = csvLine(headings) + csvLine(possible)};
  for (const StudentTotal& sum : book.totals) {
    std::vector<std::string> cells = {shownName(sum.student), "", sisOf(sum.student), sum.student.id,
                                      sum.student.section};
    for (const std::string& exercise : book.exercises)
      cells.push_back(finalText(book.row(sum.student.id, exercise)));
    grades.csv += csvLine(cells);
  }
  tellOdd(book, grades);
  return grades;
}

namespace {

/// What Gradescope says about one submission.
struct GradescopeEntry {
  std::string folder{};  ///< "submission_123"
  std::string createdAt{};
  int attempts = 1;  ///< with those of its history
  std::vector<Person> people{};
};

// Gradescope writes keys as Ruby does: ":name". Empty for what is no scalar.
std::string scalarIn(const YAML::Node& map, const std::string& key) {
  if (!map.IsMap()) return {};
  for (const std::string& name : {":" + key, key})
    if (const YAML::Node value = map[name]; value && value.IsScalar()) return value.Scalar();
  return {};
}

YAML::Node listIn(const YAML::Node& map, const std::string& key) {
  if (map.IsMap())
    for (const std::string& name : {":" + key, key})
      if (const YAML::Node value = map[name]; value && value.IsSequence()) return value;
  return YAML::Node(YAML::NodeType::Sequence);
}

// Entries as JSON: [[folder, created_at, [[name, sid, email], ...], attempts], ...].
std::string entriesOf(const std::string& text, const std::string& place) {
  nlohmann::json entries = nlohmann::json::array();
  try {
    const YAML::Node root = YAML::Load(text);
    if (!root.IsMap())
      throw Error(
          {.what = "not Gradescope's metadata", .where = {place}, .found = "no table of submissions"});
    for (const auto& item : root) {
      if (!item.first.IsScalar()) continue;
      nlohmann::json people = nlohmann::json::array();
      for (const YAML::Node& person : listIn(item.second, "submitters"))
        people.push_back({scalarIn(person, "name"), scalarIn(person, "sid"), scalarIn(person, "email")});
      entries.push_back({item.first.Scalar(), scalarIn(item.second, "created_at"), people,
                         1 + listIn(item.second, "history").size()});
    }
  } catch (const YAML::Exception& error) {
    throw Error({.what = "not Gradescope's metadata",
                 .where = {place, error.mark.line + 1, error.mark.column + 1},
                 .found = error.msg,
                 .wanted = "YAML"});
  }
  return entries.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

// In a process of its own: the text holds what students chose, and YAML may nest without end.
std::vector<GradescopeEntry> readMetadata(const DownloadedFile& file, const std::string& place) {
  const IsolatedResult read =
      callIsolated([&] { return entriesOf(file.text.value_or(""), place); },
                   {.cpuSeconds = 60, .wallSeconds = 120, .memory = std::size_t{2} << 30});
  if (read.end != IsolatedEnd::kReturned)
    throw Error({.what = "not Gradescope's metadata",
                 .where = {place},
                 .found = "a file that crashes its reader or takes too long",
                 .wanted = "YAML"});
  std::vector<GradescopeEntry> entries;
  for (const nlohmann::json& json : nlohmann::json::parse(read.bytes)) {
    GradescopeEntry& entry = entries.emplace_back(GradescopeEntry{.folder = json.at(0).get<std::string>(),
                                                                  .createdAt = json.at(1).get<std::string>(),
                                                                  .attempts = json.at(3).get<int>()});
    for (const nlohmann::json& fields : json.at(2)) {
      Person person{.id = composed(fields.at(1).get<std::string>()),
                    .name = composed(fields.at(0).get<std::string>()),
                    .email = composed(fields.at(2).get<std::string>())};
      person.identifier = person.id.empty() ? person.email : person.id;
      const std::size_t digits = entry.folder.find_last_not_of("0123456789");
      person.number = entry.folder.substr(digits == entry.folder.npos ? 0 : digits + 1);
      entry.people.push_back(std::move(person));
    }
  }
  return entries;
}

}  // namespace

DownloadedSubmissions readGradescope(const std::filesystem::path& source,
                                     const std::vector<submission::ExerciseInfo>& exercises) {
  Download download = readPlatformDownload(Platform::kGradescope, source, exercises);
  const auto metadata = std::find_if(download.files.begin(), download.files.end(), [](const auto& file) {
    return !isOfSystem(file.name) && std::filesystem::path(file.name).filename() == kGradescopeMetadata;
  });
  const std::string root = metadata->name.substr(
                        0, metadata->name.size() - std::string(kGradescopeMetadata).size()),
                    place = (source / metadata->place).string();
  DownloadedSubmissions found{.platform = Platform::kGradescope};
  std::map<std::string, DownloadedSubmission> submissions;
  std::map<std::string, int> attempts;
  for (GradescopeEntry& entry : readMetadata(*metadata, place)) {
    DownloadedSubmission received{.people = std::move(entry.people), .place = root + entry.folder};
    if (received.people.empty()) {
      found.complaints.push_back(
          fmt::format("{}: {}: nobody handed this in", place, printable(entry.folder, 100)));
      continue;
    }
    if (!entry.createdAt.empty()) {
      received.submitted = PlatformZone("").toInstant(entry.createdAt, place + ": " + entry.folder);
      received.timeFrom = "platform";
    }
    attempts[entry.folder] = entry.attempts;
    submissions.emplace(entry.folder, std::move(received));
  }
  for (DownloadedFile& file : download.files) {
    if (isOfSystem(file.name) || &file == &*metadata) continue;
    const std::string inside = file.name.starts_with(root) ? file.name.substr(root.size()) : "";
    const std::size_t slash = inside.find('/');
    const auto received = submissions.find(inside.substr(0, slash));
    if (slash != inside.npos && received != submissions.end()) {
      file.name = inside.substr(slash + 1);
      file.attempts = attempts.at(received->first);
      received->second.files.push_back(std::move(file));
    } else if (slash != inside.npos && inside.starts_with("submission_")) {
      found.complaints.push_back(
          fmt::format("{}: of a submission that {} does not name", file.place, kGradescopeMetadata));
    } else {
      found.notes.push_back(fmt::format("{}: ignored", file.place));
    }
  }
  for (auto& [folder, received] : submissions) {
    if (received.files.empty()) received.whyNone = "no files in the export";
    found.all.push_back(std::move(received));
  }
  return found;
}

}  // namespace rex::classroom
