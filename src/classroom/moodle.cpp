#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <tuple>

#include <fmt/format.h>

#include "base/error.h"
#include "base/escape.h"
#include "base/text.h"
#include "classroom/csv.h"
#include "classroom/download.h"
#include "classroom/gradebook_text.h"
#include "classroom/platform_grades.h"
#include "classroom/platform_time.h"
#include "classroom/submission_folder.h"

namespace rex::classroom {

/// Headings of Moodle's grading worksheet in English, German and French; case does not count.
inline const CsvTable::Headings kMoodleIdentifier = {"Identifier", "ID", "Identifiant"},
                                kMoodleName = {"Full name", "Vollständiger Name", "Nom complet"},
                                kMoodleIdNumber = {"ID number",      "ID-Nummer",  "Numéro d'identification",
                                                   "Matrikelnummer", "Student ID", "Numéro d'étudiant"},
                                kMoodleEmail = {"Email address", "E-Mail-Adresse", "Adresse de courriel",
                                                "E-Mail"},
                                kMoodleGrade = {"Grade", "Bewertung", "Note"},
                                kMoodleMaximum = {"Maximum Grade", "Bestwertung", "Note maximale"};

/// "501" of the identifier "Participant 501"; empty if it has no number at its end.
inline std::string participantNumber(const std::string& identifier) {
  return identifier.substr(identifier.find_last_not_of("0123456789") + 1);
}

namespace {

const CsvTable::Headings kMoodleStatus = {"Status", "Statut"}, kMoodleGroup = {"Group", "Gruppe", "Groupe"},
                         kMoodleSubmitted = {"Last modified (submission)", "Zuletzt geändert (Abgabe)",
                                             "Dernière modification (travail remis)"};

/// What Moodle's grading worksheet says about one participant.
struct MoodleRow {
  Person person{};
  std::string status{};
  std::string group{};  ///< whose members hand in together; empty: unknown
  std::optional<std::int64_t> submitted{};
};

std::map<std::string, MoodleRow> readWorksheet(const MoodleOptions& options) {
  std::map<std::string, MoodleRow> rows;
  if (options.worksheet.empty()) return rows;
  const CsvTable table(options.worksheet, "Moodle's grading worksheet");
  table.require(kMoodleIdentifier);
  const PlatformZone zone(options.timeZone);
  for (std::size_t k = 0; k < table.size(); ++k) {
    MoodleRow row{.person = {.id = table.text(k, kMoodleIdNumber),
                             .name = table.text(k, kMoodleName),
                             .email = table.text(k, kMoodleEmail),
                             .identifier = table.text(k, kMoodleIdentifier),
                             .number = participantNumber(table.text(k, kMoodleIdentifier)),
                             .maximumGrade = table.text(k, kMoodleMaximum)},
                  .status = table.text(k, kMoodleStatus),
                  .group = table.text(k, kMoodleGroup)};
    if (row.person.number.empty())
      throw UsageError({.what = "not Moodle's grading worksheet",
                        .where = {table.place(k)},
                        .found = "'" + printable(row.person.identifier, 100) + "'",
                        .wanted = "an identifier such as 'Participant 501'"});
    const std::string time = table.text(k, kMoodleSubmitted);
    if (!time.empty() && time != "-") row.submitted = zone.toInstant(time, table.place(k));
    const std::string number = row.person.number;
    if (!rows.emplace(number, std::move(row)).second)
      throw UsageError({.what = "a second row for the same participant",
                        .where = {table.place(k)},
                        .found = "'" + number + "' again",
                        .wanted = "one row"});
  }
  return rows;
}

bool isBlindName(const std::string& name) {
  const std::string lower = caseless(name);
  return lower == "participant" || lower.starts_with("teilnehmer");
}

// A name as Moodle writes it in the name of a folder.
std::string inFolderName(const std::string& name) {
  std::string written = composed(name);
  std::erase_if(written,
                [](char c) { return std::string_view("&<>\"`|':\\/").find(c) != std::string_view::npos; });
  std::replace(written.begin(), written.end(), '_', ' ');
  return written;
}

// "Group A" of "Group A-Zoe Miller"; empty if the folder has the name of the person alone.
std::string groupIn(const std::string& folder, const std::string& person) {
  const std::string whole = inFolderName(folder), end = "-" + inFolderName(person);
  if (person.empty() || !caseless(whole).ends_with(caseless(end)) || whole.size() <= end.size()) return {};
  return whole.substr(0, whole.size() - end.size());
}

/// Sorts the files of one download by participants.
class MoodleReader {
 public:
  explicit MoodleReader(std::map<std::string, MoodleRow> rows) : rows_(std::move(rows)) {
    for (const auto& [number, row] : rows_)
      if (!row.group.empty()) teams_[caseless(inFolderName(row.group))].push_back(number);
  }

  DownloadedSubmissions read(Download download, const MoodleOptions& options) {
    found_.platform = Platform::kMoodle;
    for (DownloadedFile& file : download.files) sort(std::move(file));
    requireRows(options);
    for (auto& [number, received] : submissions_) add(number, std::move(received));
    for (auto& [number, row] : rows_)
      if (!submissions_.contains(number) && !inTeams_.contains(number))
        found_.all.push_back({.people = {row.person}});
    joinGroups();
    return std::move(found_);
  }

 private:
  // The name of a team that the worksheet knows, unless the participant of that number has this name.
  bool isTeam(const MoodleName& name) const {
    const std::string person = caseless(inFolderName(name.person));
    const auto row = rows_.find(name.number);
    return teams_.contains(person) &&
           (row == rows_.end() || caseless(inFolderName(row->second.person.name)) != person);
  }

  void sort(DownloadedFile file) {
    if (isOfSystem(file.name)) return;
    const std::filesystem::path path(file.name);
    std::string before;
    for (auto part = path.begin(); part != path.end(); ++part) {
      const std::optional<MoodleName> name = parseMoodleName(part->string());
      if (!name) {
        before += part->string() + "/";
        continue;
      }
      const std::string person = isBlindName(name->person) ? "" : composed(name->person);
      std::string key = isTeam(*name) ? "team " + name->number : name->number;
      // A team may have the number of a participant, and without a worksheet they differ by their names only.
      if (const auto other = submissions_.find(key);
          other != submissions_.end() && other->second.people.front().name != person)
        key += " " + person;
      DownloadedSubmission& received = submissions_[key];
      if (received.people.empty()) {
        received.people = {{.name = person, .number = name->number}};
        received.place = before + part->string();
      }
      if (name->kind != "file") {
        online_[key] = file.place;
        return;
      }
      std::filesystem::path rest = name->file;
      for (auto inner = std::next(part); inner != path.end(); ++inner) rest /= *inner;
      file.name = rest.string();
      received.files.push_back(std::move(file));
      return;
    }
    found_.notes.push_back(fmt::format("{}: ignored", file.place));
  }

  void requireRows(const MoodleOptions& options) const {
    if (rows_.empty() || submissions_.empty()) return;
    if (std::any_of(submissions_.begin(), submissions_.end(), [&](const auto& one) {
          return rows_.contains(one.first) ||
                 teams_.contains(caseless(inFolderName(one.second.people.front().name)));
        }))
      return;
    throw UsageError({.what = "a grading worksheet of another assignment",
                      .where = {options.worksheet.string()},
                      .found = fmt::format("no participant {}", submissions_.begin()->first),
                      .wanted = "the worksheet of the assignment that was downloaded, for teams with its "
                                "column Group"});
  }

  void add(const std::string& number, DownloadedSubmission received) {
    const auto online = online_.find(number);
    if (online != online_.end() && !received.files.empty())
      found_.notes.push_back(fmt::format("{}: an online text, ignored", online->second));
    else if (online != online_.end())
      received.whyNone = "an online text, no uploaded file", received.place = online->second;
    if (number.starts_with("team ")) return addTeam(std::move(received));
    const auto row = rows_.find(number);
    if (row == rows_.end()) {
      if (!rows_.empty())
        found_.doubts.push_back(
            fmt::format("{}: participant {} is not in the grading worksheet; taken under "
                        "the name of the folder",
                        received.place, number));
      found_.all.push_back(std::move(received));
      return;
    }
    received.group = groupIn(received.people.front().name, row->second.person.name);
    received.people.clear();
    addMember(row->second, received);
    found_.all.push_back(std::move(received));
  }

  void addTeam(DownloadedSubmission received) {
    const std::vector<std::string>& members = teams_.at(caseless(inFolderName(received.people.front().name)));
    received.group = rows_.at(members.front()).group;
    received.people.clear();
    for (const std::string& member : members) addMember(rows_.at(member), received);
    inTeams_.insert(members.begin(), members.end());
    found_.all.push_back(std::move(received));
  }

  // The last time of a team's members counts; a draft is reported once for the team.
  void addMember(const MoodleRow& row, DownloadedSubmission& received) {
    received.people.push_back(row.person);
    received.submitted = std::max(received.submitted, row.submitted);
    if (received.submitted) received.timeFrom = "platform";
    const std::string status = caseless(row.status);
    if (received.people.size() == 1 &&
        (status.starts_with("draft") || status.starts_with("entwurf") || status.starts_with("brouillon")))
      found_.notes.push_back(fmt::format("{}: a draft that was not submitted; taken", received.place));
  }

  // Each member of a group has the same files in a folder of their own.
  void joinGroups() {
    const auto sameFiles = [](const DownloadedSubmission& a, const DownloadedSubmission& b) {
      return std::equal(a.files.begin(), a.files.end(), b.files.begin(), b.files.end(),
                        [](const auto& x, const auto& y) { return x.name == y.name && x.text == y.text; });
    };
    std::vector<DownloadedSubmission> joined;
    for (DownloadedSubmission& received : found_.all) {
      const auto first = std::find_if(joined.begin(), joined.end(), [&](const DownloadedSubmission& one) {
        return !received.group.empty() && one.group == received.group;
      });
      if (first == joined.end())
        joined.push_back(std::move(received));
      else if (sameFiles(*first, received))
        first->people.push_back(received.people.front());
      else {
        found_.doubts.push_back(fmt::format("{}: other files than in '{}', though both are of the group '{}'",
                                            received.place, first->place, received.group));
        received.group.clear();
        joined.push_back(std::move(received));
      }
    }
    found_.all = std::move(joined);
  }

  std::map<std::string, MoodleRow> rows_;                      // by number of the participant
  std::map<std::string, std::vector<std::string>> teams_{};    // by name: numbers of the members
  std::map<std::string, DownloadedSubmission> submissions_{};  // by number, or "team " and its number
  std::map<std::string, std::string> online_{};                // the same: places of online texts
  std::set<std::string> inTeams_{};  // numbers of participants for whom a team handed in
  DownloadedSubmissions found_{};
};

}  // namespace

DownloadedSubmissions readMoodle(const std::filesystem::path& source, const MoodleOptions& options,
                                 const std::vector<submission::ExerciseInfo>& exercises) {
  Download download = readPlatformDownload(Platform::kMoodle, source, exercises);
  return MoodleReader(readWorksheet(options)).read(std::move(download), options);
}

namespace {

/// Completes one worksheet.
class WorksheetWriter {
 public:
  WorksheetWriter(const std::filesystem::path& file, const Gradebook& book, const std::string& exercise,
                  const ImportTable& imported, bool scale)
      : file_(file.string()),
        table_(file, "a grading worksheet of Moodle"),
        book_(book),
        exercise_(exercise),
        everyone_(book.everyone()),
        scale_(scale) {
    for (const ImportedStudent& person : imported.students)
      if (const auto entry = person.exercises.find(exercise); entry != person.exercises.end())
        if (const std::string id = courseStudent(person, everyone_);
            !id.empty() && !entry->second.identifier.empty())
          known_[entry->second.identifier] = id;
  }

  Worksheet write() {
    table_.require(kMoodleIdentifier), table_.require(kMoodleGrade);
    table_.requireWholeRows();
    for (std::size_t row = 0; row < table_.size(); ++row) complete(row);
    tellAbsent();
    sheet_.csv = table_.csv();
    return std::move(sheet_);
  }

 private:
  std::string studentIn(std::size_t row) const {
    if (const auto found = known_.find(table_.text(row, kMoodleIdentifier)); found != known_.end())
      return found->second;
    return courseStudent({.id = table_.text(row, kMoodleIdNumber),
                          .name = table_.text(row, kMoodleName),
                          .email = table_.text(row, kMoodleEmail)},
                         everyone_);
  }

  void complete(std::size_t row) {
    const std::string id = studentIn(row), name = table_.text(row, kMoodleName);
    sheet_.rows.push_back({id, name, participantNumber(table_.text(row, kMoodleIdentifier))});
    if (id.empty()) {
      sheet_.notes.push_back(fmt::format("{}: '{}' is nobody here; the grade stays as it is",
                                         table_.place(row), printable(name)));
      return;
    }
    if (const auto [first, isNew] = seen_.emplace(id, table_.place(row)); !isNew)
      throw Error({.what = fmt::format("a second row for '{}'", id),
                   .where = {table_.place(row)},
                   .wanted = fmt::format("one; the first is at {}", first->second)});
    const GradeRow* graded = book_.row(id, exercise_);
    if (graded == nullptr || !graded->final) return;
    table_.set(row, kMoodleGrade, reports::hundredthsText(scaled(*graded, row)));
  }

  std::int64_t scaled(const GradeRow& graded, std::size_t row) {
    const std::string shown = table_.text(row, kMoodleMaximum);
    std::string text = shown;
    std::replace(text.begin(), text.end(), ',', '.');
    const std::optional<double> maximum = parseNumber<double>(text);
    const auto refuse = [&](const std::string& found, const std::string& wanted) {
      throw Error({.what = fmt::format("the maximum grade of {} in Moodle", exercise_),
                   .where = {table_.place(row)},
                   .found = found,
                   .wanted = wanted});
    };
    if (!maximum && scale_) refuse(text.empty() ? "none" : shown, "a number, to scale the points to it");
    const auto most = static_cast<std::int64_t>(100 * maximum.value_or(0) + 0.5);
    if (*graded.final > graded.possible)
      sheet_.notes.push_back(table_.place(row) + ": " + aboveMaximum(graded, *graded.final, graded.possible));
    if (!maximum || most == graded.possible) return *graded.final;
    if (!scale_ || graded.possible == 0)
      refuse(shown, fmt::format("{}, the points of the exercise, or --scale",
                                reports::hundredthsText(graded.possible)));
    return (*graded.final * most + graded.possible / 2) / graded.possible;
  }

  void tellAbsent() {
    for (const GradeRow& row : book_.rows)
      if (row.exercise == exercise_ && row.final && !seen_.contains(row.student.id))
        sheet_.notes.push_back(fmt::format("'{}' has a grade and no row in {}", row.student.id, file_));
  }

  std::string file_;
  CsvTable table_;
  const Gradebook& book_;
  std::string exercise_;
  Course everyone_;
  bool scale_;
  std::map<std::string, std::string> known_{};  // by identifier: id
  std::map<std::string, std::string> seen_{};   // by id: place
  Worksheet sheet_{};
};

}  // namespace

Worksheet moodleGrades(const std::filesystem::path& worksheet, const Gradebook& book,
                       const std::string& exercise, const ImportTable& imported, bool scale) {
  return WorksheetWriter(worksheet, book, exercise, imported, scale).write();
}

std::vector<WorksheetRow> moodleStudents(const Gradebook& book, const std::string& exercise,
                                         const ImportTable& imported) {
  const Course everyone = book.everyone();
  std::vector<WorksheetRow> rows;
  for (const ImportedStudent& person : imported.students) {
    const auto entry = person.exercises.find(exercise);
    const std::string id = courseStudent(person, everyone);
    if (entry == person.exercises.end() || entry->second.platform != "moodle" || id.empty()) continue;
    if (const std::string number = participantNumber(entry->second.identifier); !number.empty())
      rows.push_back({id, person.name, number});
  }
  return rows;
}

// Moodle splits the name at underscores; slashes and dots at the start would be folders of their own. Few
// file systems take more than 255 bytes.
std::string moodleFolder(const WorksheetRow& row) {
  constexpr std::size_t kLongest = 200;
  std::string name = printable(row.name, kLongest);
  for (char& c : name)
    if (std::string_view("_/\\:*?\"<>|\n\t").find(c) != std::string_view::npos) c = ' ';
  while (!name.empty() && (name.front() == '.' || name.front() == ' ' || name.front() == '~'))
    name.erase(0, 1);
  return fmt::format("{}_{}_assignsubmission_file_", name.empty() ? "Student" : name, row.number);
}

}  // namespace rex::classroom
