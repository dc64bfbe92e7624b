#include <algorithm>
#include <map>
#include <tuple>

#include <fmt/format.h>

#include "base/error.h"
#include "base/printable.h"
#include "classroom/arrivals.h"
#include "classroom/composed_text.h"
#include "classroom/csv.h"
#include "classroom/moodle_worksheet_internal.h"
#include "classroom/platform_time.h"

namespace rex::grading {
namespace {

const CsvTable::Headings kMoodleStatus = {"Status"},
                         kMoodleSubmitted = {"Last modified (submission)", "Zuletzt geändert (Abgabe)"};

/// What Moodle's grading worksheet says about one participant.
struct MoodleRow {
  Person person{};
  std::string status{};
  std::optional<std::int64_t> submitted{};
  bool isHandedIn = false;
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
                  .status = table.text(k, kMoodleStatus)};
    if (row.person.number.empty())
      throw UsageError({.what = "not Moodle's grading worksheet",
                        .where = {table.place(k)},
                        .found = "'" + printable(row.person.identifier, 100) + "'",
                        .wanted = "an identifier such as 'Participant 501'"});
    const std::string time = table.text(k, kMoodleSubmitted);
    if (!time.empty() && time != "-") row.submitted = zone.instantOf(time, table.place(k));
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

// "Group A" of "Group A-Zoe Miller"; empty if the folder has the name of the person alone.
std::string groupIn(const std::string& folder, const std::string& person) {
  const std::string whole = caseless(folder), end = "-" + caseless(person);
  if (person.empty() || !whole.ends_with(end) || whole.size() == end.size()) return {};
  return composed(folder).substr(0, composed(folder).size() - composed("-" + person).size());
}

/// Sorts the files of one download by participants.
class MoodleReader {
 public:
  explicit MoodleReader(std::map<std::string, MoodleRow> rows) : rows_(std::move(rows)) {}

  Arrivals read(Download download, const MoodleOptions& options) {
    found_.platform = Platform::kMoodle;
    for (DownloadedFile& file : download.files) sort(std::move(file));
    requireRows(options);
    for (auto& [number, arrival] : arrivals_) add(number, std::move(arrival));
    for (auto& [number, row] : rows_)
      if (!arrivals_.contains(number)) found_.all.push_back({.people = {row.person}});
    joinGroups();
    return std::move(found_);
  }

 private:
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
      Arrival& arrival = arrivals_[name->number];
      if (arrival.people.empty()) {
        const std::string person = isBlindName(name->person) ? "" : composed(name->person);
        arrival.people = {{.name = person, .number = name->number}};
        arrival.place = before + part->string();
      }
      if (name->kind != "file") {
        online_[name->number] = file.place;
        return;
      }
      std::filesystem::path rest = name->file;
      for (auto inner = std::next(part); inner != path.end(); ++inner) rest /= *inner;
      file.name = rest.string();
      arrival.files.push_back(std::move(file));
      return;
    }
    found_.notes.push_back(fmt::format("{}: ignored", file.place));
  }

  void requireRows(const MoodleOptions& options) const {
    if (rows_.empty() || arrivals_.empty()) return;
    if (std::any_of(arrivals_.begin(), arrivals_.end(),
                    [&](const auto& one) { return rows_.contains(one.first); }))
      return;
    throw UsageError({.what = "a grading worksheet of another assignment",
                      .where = {options.worksheet.string()},
                      .found = fmt::format("no participant {}", arrivals_.begin()->first),
                      .wanted = "the worksheet of the assignment that was downloaded"});
  }

  void add(const std::string& number, Arrival arrival) {
    const auto online = online_.find(number);
    if (online != online_.end() && !arrival.files.empty())
      found_.notes.push_back(fmt::format("{}: an online text, ignored", online->second));
    else if (online != online_.end())
      arrival.whyNone = "an online text, no uploaded file", arrival.place = online->second;
    const auto row = rows_.find(number);
    if (row == rows_.end()) {
      if (!rows_.empty())
        found_.complaints.push_back(
            fmt::format("{}: participant {} is not in the grading worksheet; taken under "
                        "the name of the folder",
                        arrival.place, number));
      found_.all.push_back(std::move(arrival));
      return;
    }
    arrival.group = groupIn(arrival.people.front().name, row->second.person.name);
    arrival.people = {row->second.person};
    arrival.submitted = row->second.submitted;
    if (arrival.submitted) arrival.timeFrom = "platform";
    const std::string status = caseless(row->second.status);
    if (status.starts_with("draft") || status.starts_with("entwurf"))
      found_.notes.push_back(fmt::format("{}: a draft that was not submitted; taken", arrival.place));
    found_.all.push_back(std::move(arrival));
  }

  // Each member of a group has the same files in a folder of their own.
  void joinGroups() {
    const auto sameFiles = [](const Arrival& a, const Arrival& b) {
      return std::equal(a.files.begin(), a.files.end(), b.files.begin(), b.files.end(),
                        [](const auto& x, const auto& y) { return x.name == y.name && x.text == y.text; });
    };
    std::vector<Arrival> joined;
    for (Arrival& arrival : found_.all) {
      const auto first = std::find_if(joined.begin(), joined.end(), [&](const Arrival& one) {
        return !arrival.group.empty() && one.group == arrival.group;
      });
      if (first == joined.end())
        joined.push_back(std::move(arrival));
      else if (sameFiles(*first, arrival))
        first->people.push_back(arrival.people.front());
      else {
        found_.complaints.push_back(
            fmt::format("{}: other files than in '{}', though both are of the group '{}'", arrival.place,
                        first->place, arrival.group));
        arrival.group.clear();
        joined.push_back(std::move(arrival));
      }
    }
    found_.all = std::move(joined);
  }

  std::map<std::string, MoodleRow> rows_;        // by number of the participant
  std::map<std::string, Arrival> arrivals_{};    // the same
  std::map<std::string, std::string> online_{};  // places of online texts
  Arrivals found_{};
};

}  // namespace

Arrivals readMoodle(const std::filesystem::path& source, const MoodleOptions& options,
                    const std::vector<ExerciseInfo>& exercises) {
  Download download = readDownloadOf(Platform::kMoodle, source, exercises);
  return MoodleReader(readWorksheet(options)).read(std::move(download), options);
}

}  // namespace rex::grading
