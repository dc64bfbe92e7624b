#include <map>
#include <set>

#include <fmt/format.h>

#include "classroom/archive.h"
#include "classroom/arrivals.h"
#include "classroom/composed_text.h"

namespace rex::grading {
namespace {

// The folder around everything, which programs create when they pack one; empty if there is none.
std::string folderAround(const Download& download) {
  std::set<std::string> tops;
  for (const DownloadedFile& file : download.files) {
    if (isOfSystem(file.name)) continue;
    const std::size_t slash = file.name.find('/');
    if (slash == file.name.npos || file.name.substr(slash + 1) == "main.cpp") return {};
    tops.insert(file.name.substr(0, slash + 1));
  }
  return tops.size() == 1 && !std::filesystem::is_directory(download.path) ? *tops.begin() : "";
}

// "Zoe.cpp" and "Zoe.zip" are Zoe's; empty for other files.
std::string personOfFile(const std::string& name) {
  if (isArchiveName(name)) return withoutArchiveEnding(name);
  return isSourceName(name) ? std::filesystem::path(name).stem().string() : "";
}

}  // namespace

Arrivals readFolders(const std::filesystem::path& source, const std::vector<ExerciseInfo>& exercises) {
  Download download = readDownloadOf(Platform::kFolders, source, exercises);
  const std::string around = folderAround(download);
  Arrivals found{.platform = Platform::kFolders};
  std::map<std::string, Arrival> arrivals;
  for (DownloadedFile& file : download.files) {
    if (isOfSystem(file.name)) continue;
    file.name = file.name.substr(around.size());
    const std::size_t slash = file.name.find('/');
    const std::string person =
        composed(slash == file.name.npos ? personOfFile(file.name) : file.name.substr(0, slash));
    if (person.empty() || person == "main") {
      found.complaints.push_back(
          fmt::format("{}: whose? Wanted NAME/main.cpp, NAME.cpp or NAME.zip", file.place));
      continue;
    }
    Arrival& arrival = arrivals[caseless(person)];
    if (!arrival.people.empty() && arrival.people.front().name != person) {
      found.complaints.push_back(fmt::format("{}: not taken: the same name as '{}', spelt differently",
                                             file.place, arrival.people.front().name));
      continue;
    }
    arrival.people = {{.name = person}};
    if (arrival.place.empty())
      arrival.place = file.place.substr(0, file.place.size() - file.name.size()) + person;
    if (slash != file.name.npos) file.name = file.name.substr(slash + 1);
    arrival.files.push_back(std::move(file));
  }
  for (auto& [person, arrival] : arrivals) found.all.push_back(std::move(arrival));
  return found;
}

}  // namespace rex::grading
