#include "classroom/importing.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "base/error.h"
#include "base/escape.h"
#include "base/folders.h"
#include "base/instant.h"
#include "base/sha256.h"
#include "base/text.h"
#include "base/text_file.h"
#include "classroom/import_table.h"
#include "classroom/submission_folder.h"
#include "submission/student_build.h"

namespace rex::classroom {
namespace {

namespace fs = std::filesystem;

/// A submission whose files have been sorted.
struct SortedSubmission {
  const DownloadedSubmission& received;
  PickedFiles picked{};
};

/// Brings one download into one folder.
class Importer {
 public:
  Importer(const DownloadedSubmissions& submissions, const PickOptions& options, const fs::path& handedIn)
      : submissions_(submissions),
        options_(options),
        folder_(handedIn),
        table_(tableAt(handedIn / kImportTable)),
        before_(table_) {
    report_.complaints = submissions.complaints;
    report_.doubts = submissions.doubts;
    report_.notes = submissions.notes;
    removeLeftovers(folder_, 2);
    takeBegun(tableAt(folder_ / kBegunTable));
  }

  ImportReport run() {
    std::vector<SortedSubmission> sorted;
    for (const DownloadedSubmission& received : submissions_.all)
      sorted.push_back(
          {received, received.files.empty() ? PickedFiles{} : pickFiles(received.files, options_)});
    exercises_ = exercisesOf(sorted);
    ImportNames names(table_, submissions_);
    for (const SortedSubmission& one : sorted) take(one, names);
    tellNames(names);
    std::sort(table_.students.begin(), table_.students.end(),
              [](const auto& a, const auto& b) { return a.student < b.student; });
    writeAll();
    return std::move(report_);
  }

 private:
  static ImportTable tableAt(const fs::path& file) {
    return fs::exists(file) ? readImportTable(file) : ImportTable{};
  }

  // What an interrupted import has written already counts as imported.
  void takeBegun(const ImportTable& begun) {
    int taken = 0;
    for (const ImportedStudent& student : begun.students)
      for (const auto& [exercise, entry] : student.exercises) {
        const fs::path file = folder_ / entry.handedInBy / exercise / "main.cpp";
        const bool isWritten = entry.status == SubmissionStatus::kHandedIn &&
                               whyNoStudentName(entry.handedInBy).empty() &&
                               whyNoStudentName(exercise).empty() && presentHash(file) == entry.sha256;
        if (!isWritten) continue;
        if (table_.find(student.student) == nullptr) {
          table_.students.push_back(student);
          table_.students.back().exercises.clear();
        }
        entryOf(student.student).exercises[exercise] = entry;
        ++taken;
      }
    if (!begun.students.empty())
      report_.notes.push_back(fmt::format("continues an interrupted import that had written {} file{}", taken,
                                          taken == 1 ? "" : "s"));
  }

  // All is decided before the first file is touched. The new table comes first, under another name: if the
  // import is interrupted, it tells the next one what is ours.
  void writeAll() {
    fs::create_directories(folder_);
    const fs::path begun = folder_ / kBegunTable;
    replaceTextFile(begun, importTableText(table_), "the table of imports");
    for (const auto& [path, text] : writes_) {
      fs::create_directories(path.parent_path());
      replaceTextFile(path, text, "the copy of what was handed in");
    }
    for (const fs::path& path : removals_) {
      fs::remove(path);
      std::error_code notEmpty;
      fs::remove(path.parent_path(), notEmpty);
      fs::remove(path.parent_path().parent_path(), notEmpty);
    }
    fs::rename(begun, folder_ / kImportTable);
    bringToDisk(folder_);
  }

  // Of this download: the wanted one, or all that somebody handed in.
  std::vector<std::string> exercisesOf(const std::vector<SortedSubmission>& sorted) const {
    if (!options_.exercise.empty()) return {options_.exercise};
    std::set<std::string> names;
    for (const SortedSubmission& one : sorted)
      for (const PickedFile& file : one.picked.files) names.insert(file.exercise);
    return {names.begin(), names.end()};
  }

  void take(const SortedSubmission& one, ImportNames& names) {
    std::vector<std::string> members;
    for (Person person : one.received.people) {
      CleanName name = cleanName(person.name);
      if (!name.lost.empty())
        report_.notes.push_back(fmt::format("{}: left out of the name '{}', where nobody sees it: {}",
                                            one.received.place, name.text, join(name.lost, ", ")));
      person.name = std::move(name.text);
      members.push_back(names.personFolder(person, exercises_));
    }
    report_.complaints.insert(report_.complaints.end(), one.picked.complaints.begin(),
                              one.picked.complaints.end());
    report_.notes.insert(report_.notes.end(), one.picked.notes.begin(), one.picked.notes.end());
    if (!one.received.whyNone.empty())
      report_.complaints.push_back(one.received.place + ": not taken: " + one.received.whyNone);
    for (const std::string& exercise : exercises_) {
      const auto file = std::find_if(one.picked.files.begin(), one.picked.files.end(),
                                     [&](const PickedFile& picked) { return picked.exercise == exercise; });
      if (file != one.picked.files.end())
        takeFile(one.received, *file, members);
      else
        takeNothing(one.received, exercise, members, whyNone(one, exercise));
    }
  }

  // A fault of one exercise says nothing about the others.
  static std::string whyNone(const SortedSubmission& one, const std::string& exercise) {
    if (!one.received.whyNone.empty()) return one.received.whyNone;
    for (const std::string& about : {exercise, std::string()})
      if (const auto found = one.picked.whyNone.find(about); found != one.picked.whyNone.end())
        return found->second;
    return {};
  }

  ImportedStudent& entryOf(const std::string& student) {
    return *std::find_if(table_.students.begin(), table_.students.end(),
                         [&](const ImportedStudent& entry) { return entry.student == student; });
  }

  ImportedExercise startOf(const DownloadedSubmission& received, std::size_t member) const {
    return {.platform = std::string(toString(submissions_.platform)),
            .identifier = received.people[member].identifier,
            .maximumGrade = received.people[member].maximumGrade,
            .group = received.group};
  }

  // One for all: who held it before, else the first.
  std::string holderOf(const std::string& exercise, const std::vector<std::string>& members) {
    for (const std::string& member : members) {
      const auto before = entryOf(member).exercises.find(exercise);
      if (before != entryOf(member).exercises.end() &&
          std::find(members.begin(), members.end(), before->second.handedInBy) != members.end())
        return before->second.handedInBy;
    }
    return members.front();
  }

  void takeFile(const DownloadedSubmission& received, const PickedFile& file,
                const std::vector<std::string>& members) {
    const std::string holder = holderOf(file.exercise, members);
    const std::optional<std::int64_t> time =
        received.submitted || file.modifiedAt == 0 ? received.submitted : file.modifiedAt;
    if (!isFirst(file, members) || !write(holder, file, time)) {
      for (std::size_t k = 0; k < members.size(); ++k) {
        if (entryOf(members[k]).exercises.contains(file.exercise))
          ++report_.rejected;
        else
          noteNothing(received, k, file.exercise, members[k], "another file is there already");
      }
      return;
    }
    for (std::size_t k = 0; k < members.size(); ++k) {
      ImportedExercise entry = startOf(received, k);
      entry.status = SubmissionStatus::kHandedIn;
      entry.handedInBy = holder;
      entry.submitted = time;
      entry.timeFrom = !time ? "" : received.timeFrom.empty() ? "file" : received.timeFrom;
      entry.commit = received.commit;
      entry.source = file.source;
      entry.sha256 = sha256(file.text);
      entry.work = file.work;
      countAttempts(file, members[k], entry);
      if (members[k] != holder) removeOwn(members[k], file.exercise);
      count(entry);
      entryOf(members[k]).exercises[file.exercise] = std::move(entry);
    }
  }

  // If the platform keeps no attempts, each import that brought another text is one of at least so many.
  void countAttempts(const PickedFile& file, const std::string& member, ImportedExercise& entry) {
    entry.attempts = file.attempts;
    entry.attemptsFrom = submissions_.platform == Platform::kGit ? "git" : "platform";
    if (file.attempts > 0) return;
    const auto before = entryOf(member).exercises.find(file.exercise);
    const bool isKnown = before != entryOf(member).exercises.end() && !before->second.sha256.empty();
    entry.attempts = isKnown ? std::max(before->second.attempts, 1) : 1;
    if (isKnown && before->second.sha256 != entry.sha256) ++entry.attempts;
    entry.attemptsFrom = "imports";
  }

  // A platform keeps one file of each student; if there are two, nobody knows which one counts.
  bool isFirst(const PickedFile& file, const std::vector<std::string>& members) {
    for (const std::string& member : members) {
      const auto [first, isNew] = takenFrom_.emplace(std::pair(member, file.exercise), file.source);
      if (isNew) continue;
      report_.complaints.push_back(fmt::format("{}: a second file of {} for {}: not taken, the first is '{}'",
                                               file.source, member, file.exercise, first->second));
      return false;
    }
    return true;
  }

  void count(const ImportedExercise& entry) {
    ++report_.handedIn;
    ++(entry.timeFrom == "platform" ? report_.timesOfPlatform
       : entry.timeFrom == "git"    ? report_.timesOfGit
       : entry.timeFrom == "file"   ? report_.timesOfFiles
                                    : report_.withoutTime);
  }

  // The hash of the file in the folder of submissions; nothing if there is none, "" if it is no text file.
  std::optional<std::string> presentHash(const fs::path& file) const {
    if (fs::symlink_status(file).type() == fs::file_type::not_found) return {};
    try {
      return sha256(submission::readStudentFile(file));
    } catch (const Error&) {
      return "";
    }
  }

  // Whether an import wrote a file with that hash for this student; no hash: whether it wrote any.
  bool isOurs(const std::string& student, const std::string& exercise, const std::string& hash = {}) const {
    for (const ImportTable* table : {&table_, &before_}) {
      const ImportedExercise* entry = table->find(student, exercise);
      if (entry != nullptr && (hash.empty() ? !entry->sha256.empty() : entry->sha256 == hash)) return true;
    }
    return false;
  }

  // Returns false if there is a file that no import wrote.
  bool write(const std::string& holder, const PickedFile& file, const std::optional<std::int64_t>& time) {
    const fs::path path = folder_ / holder / file.exercise / "main.cpp";
    const std::optional<std::string> present = presentHash(path);
    const std::string wanted = sha256(file.text);
    if (present && *present != wanted && (present->empty() || !isOurs(holder, file.exercise, *present))) {
      report_.complaints.emplace_back(
          Error({.what = fmt::format("not replaced by '{}'", file.source),
                 .where = {path.string()},
                 .found = isOurs(holder, file.exercise) ? "a file that was edited since"
                                                        : "a file that no import wrote",
                 .wanted = "none: remove it to import it"})
              .what());
      return false;
    }
    ++(!present ? report_.added : *present == wanted ? report_.same : report_.changed);
    if (present && *present != wanted) {
      const auto before = entryOf(holder).exercises.at(file.exercise).submitted;
      const auto text = [](const auto& at) { return at ? instantText(*at) : "at an unknown time"; };
      report_.changes.push_back(fmt::format("{} {}: handed in {}, at the import before: {}", holder,
                                            file.exercise, text(time), text(before)));
    }
    if (!present || *present != wanted) writes_.emplace_back(path, file.text);
    return true;
  }

  // Of a member whose group hands in under another name now.
  void removeOwn(const std::string& member, const std::string& exercise) {
    const fs::path path = folder_ / member / exercise / "main.cpp";
    const std::optional<std::string> present = presentHash(path);
    if (!present) return;
    if (present->empty() || !isOurs(member, exercise, *present)) {
      report_.doubts.push_back(
          fmt::format("{}: not removed, though the group of {} hands in together: no import "
                      "wrote it",
                      path.string(), member));
      return;
    }
    removals_.push_back(path);
    report_.changes.push_back(fmt::format("{} {}: removed, now handed in by the group", member, exercise));
  }

  void takeNothing(const DownloadedSubmission& received, const std::string& exercise,
                   const std::vector<std::string>& members, const std::string& why) {
    for (std::size_t k = 0; k < members.size(); ++k) {
      const auto& before = entryOf(members[k]).exercises;
      const auto found = before.find(exercise);
      if (found != before.end() && found->second.status == SubmissionStatus::kHandedIn) {
        report_.notes.push_back(fmt::format(
            "{} {}: no longer in the download; the file of an earlier import stays", members[k], exercise));
        continue;
      }
      noteNothing(received, k, exercise, members[k], why);
    }
  }

  void noteNothing(const DownloadedSubmission& received, std::size_t k, const std::string& exercise,
                   const std::string& member, const std::string& why) {
    ImportedExercise entry = startOf(received, k);
    entry.status = why.empty() ? SubmissionStatus::kNothing : SubmissionStatus::kRejected;
    entry.why = why;
    if (!why.empty()) {
      entry.submitted = received.submitted;
      entry.timeFrom = received.timeFrom;
    }
    ++(why.empty() ? report_.missing : report_.rejected);
    entryOf(member).exercises[exercise] = std::move(entry);
  }

  void tellNames(const ImportNames& names) {
    if (const int count = names.knownByNameAlone(); count > 0 && submissions_.platform != Platform::kFolders)
      report_.notes.push_back(
          fmt::format("{} {} known by the name alone: another person of that name in another assignment "
                      "would be taken for the "
                      "same; the platform's table of grades gives addresses",
                      count, count == 1 ? "student is" : "students are"));
  }

  const DownloadedSubmissions& submissions_;
  const PickOptions& options_;
  fs::path folder_;
  ImportTable table_;
  ImportTable before_;  // as the last finished import left it
  std::vector<std::string> exercises_{};
  std::vector<std::pair<fs::path, std::string>> writes_{};  // file, text
  std::vector<fs::path> removals_{};
  std::map<std::pair<std::string, std::string>, std::string> takenFrom_{};  // by student and exercise
  ImportReport report_{};
};

}  // namespace

ImportReport importSubmissions(const DownloadedSubmissions& submissions, const PickOptions& options,
                               const fs::path& handedIn) {
  return Importer(submissions, options, handedIn).run();
}

}  // namespace rex::classroom
