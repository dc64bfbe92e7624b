#include <algorithm>
#include <map>
#include <ranges>
#include <set>

#include <fmt/format.h>

#include "base/error.h"
#include "base/escape.h"
#include "base/folders.h"
#include "base/instant.h"
#include "classroom/csv.h"
#include "classroom/download.h"
#include "classroom/gradebook_text.h"
#include "classroom/platform_time.h"
#include "classroom/repository.h"

namespace rex::classroom {
namespace {

namespace fs = std::filesystem;

const CsvTable::Headings kUser = {"username", "github_username"}, kRosterId = {"identifier"},
                         kRosterName = {"name"}, kRecordId = {"identifier", "roster_identifier"},
                         kRepositoryName = {"repository", "student_repository_name"},
                         kHandedInAt = {"submitted", "submission_timestamp"},
                         kCommit = {"commit", "commit_sha", "sha"}, kGroupName = {"group_name"};

/// What the platform recorded about one repository.
struct Recorded {
  std::vector<Person> people{};
  std::optional<std::int64_t> submitted{};
  std::string commit{};
  std::string group{};
};

Person personOfRoster(std::string id, std::string name, std::string user) {
  Person person{.id = std::move(id), .name = std::move(name), .githubUsername = std::move(user)};
  if (person.id.find('@') != std::string::npos) person.email = person.id;
  person.identifier = person.githubUsername;
  return person;
}

std::vector<Person> readRoster(const fs::path& file) {
  std::vector<Person> people;
  if (file.empty()) return people;
  const CsvTable table(file, "a roster");
  table.require(kRosterId);
  for (std::size_t k = 0; k < table.size(); ++k)
    people.push_back(
        personOfRoster(table.text(k, kRosterId), table.text(k, kRosterName), table.text(k, kUser)));
  return people;
}

// Of "2026-06-01T14-32-05Z-a1b2c3d", as Classroom 50 names tags.
std::optional<std::int64_t> timeOfTag(std::string name) {
  constexpr std::size_t kMinutes = 13, kSeconds = 16, kEnd = 20;
  if (name.size() <= kEnd || name[kEnd] != '-') return {};
  name[kMinutes] = name[kSeconds] = ':';
  return parseInstant(name.substr(0, kEnd));
}

/// Finds out whose clones there are, and which commit counts.
class CloneReader {
 public:
  CloneReader(const CloneOptions& options)
      : options_(options), roster_(readRoster(options.roster)), record_(readRecord(options)) {}

  DownloadedSubmissions read(const fs::path& source) {
    found_.platform = Platform::kGit;
    const OpenedFolder folder(source);
    std::vector<std::string> names;
    for (const OpenedFolder::Entry& entry : folder.entries()) {
      if (isOfSystem(entry.name)) continue;
      if (entry.type == fs::file_type::directory)
        names.push_back(entry.name);
      else
        found_.notes.push_back(fmt::format("{}: ignored", entry.name));
    }
    prefix_ = options_.assignment.empty() ? commonPrefix(names) : options_.assignment + "-";
    for (const std::string& name : names) readEntry(folder.folder(name), name);
    addMissing();
    tellClocks();
    return std::move(found_);
  }

 private:
  static std::map<std::string, Recorded> readRecord(const CloneOptions& options) {
    std::map<std::string, Recorded> record;
    if (options.record.empty()) return record;
    const CsvTable table(options.record, "a record of the platform");
    table.require(kRepositoryName);
    const PlatformZone zone(options.timeZone);
    for (std::size_t k = 0; k < table.size(); ++k) {
      Recorded& one = record[caseless(table.text(k, kRepositoryName))];
      Person person = personOfRoster(table.text(k, kRecordId), "", table.text(k, kUser));
      // Without either, the name of the clone tells who it is.
      if (!person.id.empty() || !person.githubUsername.empty()) one.people.push_back(std::move(person));
      one.commit = table.text(k, kCommit);
      one.group = table.text(k, kGroupName);
      const std::string time = table.text(k, kHandedInAt);
      if (!time.empty()) one.submitted = zone.toInstant(time, table.place(k));
    }
    return record;
  }

  // "kinematics-" of kinematics-adam and kinematics-zoe.
  static std::string commonPrefix(const std::vector<std::string>& names) {
    if (names.size() < 2) return {};
    std::string common = names.front();
    for (const std::string& name : names) {
      const auto [end, other] = std::mismatch(common.begin(), common.end(), name.begin(), name.end());
      common.erase(end, common.end());
    }
    const std::size_t dash = common.rfind('-');
    return dash == common.npos ? "" : common.substr(0, dash + 1);
  }

  // A clone, or a folder with the only clone of one person, as GitLab's groups have it.
  void readEntry(const OpenedFolder& folder, const std::string& name) {
    try {
      if (folder.typeOf(".git") != fs::file_type::not_found) return readClone(folder, name);
      std::vector<std::string> clones;
      for (const OpenedFolder::Entry& entry : folder.entries())
        if (entry.type == fs::file_type::directory &&
            folder.folder(entry.name).typeOf(".git") != fs::file_type::not_found)
          clones.push_back(entry.name);
      if (clones.size() == 1) return readClone(folder.folder(clones.front()), name);
      found_.complaints.push_back(fmt::format("{}: no clone: found {}, wanted a folder .git", name,
                                              clones.empty() ? "none" : "several in it"));
    } catch (const Error& error) {
      found_.complaints.emplace_back(error.what());
    }
  }

  void readClone(const OpenedFolder& clone, const std::string& name) {
    DownloadedSubmission received = submissionIn(name);
    seen_.insert(caseless(name));
    try {
      const Repository repository(clone);
      const Recorded& recorded = recordedStudent(name);
      if (const std::optional<Commit> commit = choose(repository, recorded, received)) {
        received.commit = commit->id;
        addFiles(repository, *commit, received);
      }
    } catch (const Error& error) {
      received.whyNone = error.what();
    }
    found_.all.push_back(std::move(received));
  }

  const Recorded& recordedStudent(const std::string& name) const {
    static const Recorded kNothing;
    const auto found = record_.find(caseless(name));
    return found == record_.end() ? kNothing : found->second;
  }

  DownloadedSubmission submissionIn(const std::string& name) {
    const Recorded& recorded = recordedStudent(name);
    DownloadedSubmission received{.people = recorded.people, .group = recorded.group, .place = name};
    if (received.people.empty()) {
      if (!record_.empty() && !record_.contains(caseless(name)))
        found_.doubts.push_back(fmt::format("{}: not in the record of the platform", name));
      const std::string user = userOf(name);
      received.people = {{.githubUsername = user, .identifier = user}};
    }
    for (Person& person : received.people) {
      const auto listed = std::find_if(roster_.begin(), roster_.end(), [&](const Person& one) {
        const bool isUser =
            !one.githubUsername.empty() && caseless(one.githubUsername) == caseless(person.githubUsername);
        return isUser || (!person.id.empty() && one.id == person.id);
      });
      if (listed != roster_.end()) {
        person.id = listed->id, person.name = listed->name, person.email = listed->email;
      } else if (!roster_.empty()) {
        found_.notes.push_back(fmt::format("{}: '{}' is not on the roster", name, person.githubUsername));
      }
    }
    return received;
  }

  // By the roster, whose names may contain dashes; else what follows the name of the assignment.
  std::string userOf(const std::string& name) const {
    std::string longest;
    for (const Person& person : roster_) {
      const std::string& user = person.githubUsername;
      const bool fits = !user.empty() &&
                        (caseless(name) == caseless(user) || caseless(name).ends_with("-" + caseless(user)));
      if (fits && user.size() > longest.size()) longest = user;
    }
    if (!longest.empty()) return longest;
    return name.size() > prefix_.size() && name.starts_with(prefix_) ? name.substr(prefix_.size()) : name;
  }

  std::optional<Commit> choose(const Repository& repository, const Recorded& recorded,
                               DownloadedSubmission& received) {
    if (!recorded.commit.empty()) {
      const std::optional<Commit> commit = repository.find(recorded.commit);
      if (!commit)
        received.whyNone = fmt::format("the clone lacks the commit {} of the record", recorded.commit);
      received.submitted = recorded.submitted;
      received.timeFrom = recorded.submitted ? "platform" : "";
      if (commit && !recorded.submitted) received.submitted = commit->time, received.timeFrom = "git";
      return commit;
    }
    std::optional<std::int64_t> last = options_.deadline;
    const bool isRecorded = recorded.submitted && (!last || *recorded.submitted <= *last);
    if (isRecorded) last = recorded.submitted;
    if (!isRecorded && !repository.submitTags().empty()) return lastTagged(repository, last, received);
    const std::vector<Commit> history = repository.history();
    const auto commit = std::find_if(history.begin(), history.end(),
                                     [&](const Commit& one) { return !last || one.time <= *last; });
    if (commit == history.end()) {
      received.whyNone =
          history.empty() ? "no commit" : fmt::format("no commit until {}", instantText(*last));
      return {};
    }
    if (commit != history.begin())
      found_.notes.push_back(fmt::format("{}: {} newer commit{} left out", received.place,
                                         commit - history.begin(), commit - history.begin() == 1 ? "" : "s"));
    ++(isRecorded ? chosenByTime_ : chosenByClock_);
    received.submitted = isRecorded ? *recorded.submitted : commit->time;
    received.timeFrom = isRecorded ? "platform" : "git";
    return *commit;
  }

  std::optional<Commit> lastTagged(const Repository& repository, std::optional<std::int64_t> last,
                                   DownloadedSubmission& received) {
    std::optional<Commit> commit;
    for (const auto& [name, id] : std::views::reverse(repository.submitTags())) {
      const std::optional<std::int64_t> time = timeOfTag(name);
      if (!time || (last && *time > *last)) continue;
      commit = repository.find(id);
      if (!commit) continue;
      commit->time = *time;
      break;
    }
    if (!commit) {
      received.whyNone =
          fmt::format("no tag submit/TIME-COMMIT{}", last ? " until " + instantText(*last) : "");
      return {};
    }
    ++chosenByTag_;
    received.submitted = commit->time;
    received.timeFrom = "git";
    return commit;
  }

  static void addFiles(const Repository& repository, const Commit& commit, DownloadedSubmission& received) {
    const std::vector<CommittedFile> files = repository.filesNamed("main.cpp", commit);
    std::vector<std::string> contents = repository.readContents(files);
    const std::map<std::string, int> changes = repository.changeCounts("main.cpp", commit);
    for (std::size_t k = 0; k < files.size(); ++k) {
      DownloadedFile& file = received.files.emplace_back(DownloadedFile{
          .name = files[k].path, .place = received.place + "/" + files[k].path, .whyNot = files[k].whyNot});
      if (file.whyNot.empty()) file.text = std::move(contents[k]);
      if (const auto found = changes.find(file.name); found != changes.end()) file.attempts = found->second;
    }
    if (files.empty()) received.whyNone = "no main.cpp in its commit " + commit.id.substr(0, 7);
  }

  // Who is in the record or on the roster, without a clone.
  void addMissing() {
    for (const auto& [name, recorded] : record_)
      if (!seen_.contains(name) && recorded.submitted) {
        DownloadedSubmission received{
            .people = recorded.people, .group = recorded.group, .place = name, .whyNone = "no clone of it"};
        if (received.people.empty())
          received.people = {{.githubUsername = userOf(name), .identifier = userOf(name)}};
        found_.all.push_back(std::move(received));
      }
    for (const Person& person : roster_) {
      const bool isThere =
          std::any_of(found_.all.begin(), found_.all.end(), [&](const DownloadedSubmission& received) {
            return std::any_of(received.people.begin(), received.people.end(),
                               [&](const Person& one) { return one.id == person.id; });
          });
      if (!isThere) found_.all.push_back({.people = {person}});
    }
  }

  void tellClocks() {
    if (chosenByClock_ > 0)
      found_.notes.push_back(
          fmt::format("{} clone{}: which commit counts, and when it was made, is known from dates in the "
                      "clone alone, which "
                      "students can set; --record FILE.csv gives the platform's record",
                      chosenByClock_, chosenByClock_ == 1 ? "" : "s"));
    if (chosenByTag_ > 0)
      found_.notes.push_back(
          fmt::format("{} clone{}: taken is the commit of the last tag submit/..., at the time in its name; "
                      "students can push such tags themselves",
                      chosenByTag_, chosenByTag_ == 1 ? "" : "s"));
    if (chosenByTime_ > 0)
      found_.notes.push_back(
          fmt::format("{} clone{}: the record has a time but no commit; taken is the last commit that is "
                      "dated until then, and "
                      "students can set that date",
                      chosenByTime_, chosenByTime_ == 1 ? "" : "s"));
  }

  CloneOptions options_;
  std::vector<Person> roster_;
  std::map<std::string, Recorded> record_;  // by name of the repository
  std::set<std::string> seen_{};            // clones, as in the record
  std::string prefix_{};
  int chosenByClock_ = 0, chosenByTime_ = 0, chosenByTag_ = 0;
  DownloadedSubmissions found_{};
};

}  // namespace

DownloadedSubmissions readClones(const fs::path& source, const CloneOptions& options,
                                 const std::vector<submission::ExerciseInfo>& exercises) {
  if (!fs::is_directory(source))
    throw UsageError({.what = "no such folder", .where = {source.string()}, .wanted = "a folder of clones"});
  requireLayout(Platform::kGit, source, exercises);
  return CloneReader(options).read(source);
}

}  // namespace rex::classroom
