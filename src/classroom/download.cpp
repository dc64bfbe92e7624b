#include "classroom/download.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <functional>
#include <map>
#include <set>

#include <fmt/format.h>
#include <unistd.h>

#include "base/error.h"
#include "base/escape.h"
#include "base/folders.h"
#include "base/text.h"
#include "base/text_file.h"
#include "classroom/archive.h"
#include "classroom/gradebook.h"
#include "classroom/gradebook_text.h"

namespace rex::classroom {

using submission::ExerciseInfo;

namespace {

constexpr const char* kRejectedHeadings = "student\texercise\twhy";

std::string oneCell(const std::string& text) {
  std::string cell = printable(text);
  for (char& c : cell)
    if (c == '\t' || c == '\n') c = ' ';
  return cell;
}

}  // namespace

std::string rejectedText(const std::vector<RejectedSubmission>& all) {
  std::string text = fmt::format("{}\n", kRejectedHeadings);
  for (const RejectedSubmission& one : all)
    text += fmt::format("{}\t{}\t{}\n", oneCell(one.student), one.exercise, oneCell(one.why));
  return text;
}

std::vector<RejectedSubmission> readRejected(const std::filesystem::path& file) {
  std::vector<RejectedSubmission> all;
  if (!std::filesystem::exists(file)) return all;
  const std::string text = readTextFile(file);
  int number = 0;
  for (const std::string_view line : splitLines(text)) {
    const std::vector<std::string_view> cells = splitAt(line, '\t');
    if (++number == 1 ? line != kRejectedHeadings : cells.size() != 3)
      throw Error({.what = "not a list of what was not taken",
                   .where = {file.string(), number, 0},
                   .wanted = "student, exercise and reason, as `rex grade` writes them"});
    if (number > 1) all.push_back({std::string(cells[0]), std::string(cells[1]), std::string(cells[2])});
  }
  return all;
}

namespace {

namespace fs = std::filesystem;

constexpr const char* kMoodleMark = "_assignsubmission_";

bool isExerciseName(const std::vector<ExerciseInfo>& exercises, const std::string& name) {
  try {
    return !submission::findExercise(exercises, name).name.empty();
  } catch (const Error&) {
    return false;
  }
}

std::string wantedBy(Platform platform) {
  switch (platform) {
    case Platform::kMoodle:
      return "the zip of \"Download all submissions\", with folders such as 'Zoe "
             "Miller_501_assignsubmission_file'";
    case Platform::kGit:
      return "a folder of clones, such as 'kinematics-zoe/.git'";
    case Platform::kGradescope:
      return fmt::format("the zip of \"Export Submissions\", with '{}'", kGradescopeMetadata);
    case Platform::kFolders:
      return "'NAME/main.cpp', 'NAME.cpp' or 'NAME.zip' for each student";
  }
  return {};
}

// The names of a folder, four levels deep, without what repositories hold.
void collectNames(const OpenedFolder& folder, const std::string& prefix, int depth,
                  std::vector<std::string>& names) {
  constexpr int kDeep = 4;
  constexpr std::size_t kMost = 20'000;
  for (const OpenedFolder::Entry& entry : folder.entries()) {
    if (names.size() >= kMost) return;
    if (entry.name == ".git")
      names.push_back(prefix + ".git/HEAD");
    else if (entry.type == fs::file_type::directory && depth < kDeep)
      collectNames(folder.folder(entry.name), prefix + entry.name + "/", depth + 1, names);
    else
      names.push_back(prefix + entry.name);
  }
}

std::string describe(const std::vector<std::string>& names) {
  std::set<std::string> tops;
  for (const std::string& name : names) tops.insert(name.substr(0, name.find('/')));
  if (tops.empty()) return "nothing";
  if (tops.size() == 1)
    return fmt::format("{} file{} such as '{}'", names.size(), names.size() == 1 ? "" : "s",
                       printable(names.front(), 120));
  return fmt::format("{} entries such as '{}'", tops.size(), printable(*tops.begin(), 120));
}

UsageError refusal(const fs::path& path, Platform wanted, const Layout& found) {
  std::string advice = wantedBy(wanted);
  if (found.platform && *found.platform != wanted)
    advice += fmt::format("; `rex import {}` takes what is there", toString(*found.platform));
  if (found.isReady) advice += "; `rex grade` takes what is there as it is";
  return UsageError({.what = fmt::format("nothing that `rex import {}` knows", toString(wanted)),
                     .where = {path.string()},
                     .found = found.found,
                     .wanted = std::move(advice)});
}

}  // namespace

std::string_view toString(Platform platform) {
  constexpr std::string_view kNames[] = {"moodle", "git", "gradescope", "folders"};
  return kNames[static_cast<int>(platform)];
}

Layout recognizeLayout(const std::vector<std::string>& names, const std::vector<ExerciseInfo>& exercises) {
  Layout layout;
  std::vector<std::string> real;
  for (const std::string& name : names)
    if (!isOfSystem(name)) real.push_back(name);
  layout.found = describe(real);
  bool isFlat = false, isClass = false;
  for (const std::string& name : real) {
    const fs::path path(name);
    const std::vector<std::string> parts(path.begin(), path.end());
    const auto has = [&](const std::string& part) {
      return std::find(parts.begin(), parts.end(), part) != parts.end();
    };
    if (path.filename() == kGradescopeMetadata) layout.platform = Platform::kGradescope;
    if (layout.platform) continue;
    if (std::any_of(parts.begin(), parts.end(), [](const auto& part) { return parseMoodleName(part); }))
      layout.platform = Platform::kMoodle;
    else if (parts.size() > 2 && has(".git"))
      layout.platform = Platform::kGit;
    const bool isInExercise = parts.size() > 1 && isExerciseName(exercises, parts[parts.size() - 2]);
    isClass = isClass || (parts.size() == 3 && parts[2] == "main.cpp" && isInExercise);
    isFlat = isFlat || ((isSourceName(name) || isArchiveName(name)) && (parts.size() > 3 || !isInExercise));
  }
  layout.isReady = !layout.platform && isClass;
  if (!layout.platform && isFlat && !isClass) layout.platform = Platform::kFolders;
  return layout;
}

Layout recognizeFolderLayout(const fs::path& folder, const std::vector<ExerciseInfo>& exercises) {
  std::vector<std::string> names;
  collectNames(OpenedFolder(folder), "", 1, names);
  return recognizeLayout(names, exercises);
}

void requireLayout(Platform platform, const fs::path& folder, const std::vector<ExerciseInfo>& exercises) {
  if (const Layout layout = recognizeFolderLayout(folder, exercises); layout.platform != platform)
    throw refusal(folder, platform, layout);
}

Download readPlatformDownload(Platform platform, const fs::path& path,
                              const std::vector<ExerciseInfo>& exercises) {
  if (fs::is_directory(path)) {
    requireLayout(platform, path, exercises);
    return readDownload(path);
  }
  Download download = readDownload(path);
  std::vector<std::string> names;
  for (const DownloadedFile& file : download.files) names.push_back(file.name);
  if (const Layout layout = recognizeLayout(names, exercises); layout.platform != platform)
    throw refusal(path, platform, layout);
  return download;
}

std::optional<MoodleName> parseMoodleName(const std::string& name) {
  const std::size_t mark = name.find(kMoodleMark);
  if (mark == name.npos || mark == 0) return {};
  const std::size_t number = name.rfind('_', mark - 1);
  if (number == name.npos || number + 1 == mark) return {};
  const std::string digits = name.substr(number + 1, mark - number - 1);
  if (digits.find_first_not_of("0123456789") != digits.npos) return {};
  const std::string rest = name.substr(mark + std::string_view(kMoodleMark).size());
  const std::size_t end = std::min(rest.find('_'), rest.size());
  const std::string kind = rest.substr(0, end);
  if (kind.empty() || kind.find_first_not_of("abcdefghijklmnopqrstuvwxyz") != kind.npos) return {};
  return MoodleName{.person = name.substr(0, number),
                    .number = digits,
                    .kind = kind,
                    .file = end < rest.size() ? rest.substr(end + 1) : ""};
}

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

DownloadedSubmissions readFolders(const std::filesystem::path& source,
                                  const std::vector<ExerciseInfo>& exercises) {
  Download download = readPlatformDownload(Platform::kFolders, source, exercises);
  const std::string around = folderAround(download);
  DownloadedSubmissions found{.platform = Platform::kFolders};
  std::map<std::string, DownloadedSubmission> submissions;
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
    DownloadedSubmission& received = submissions[caseless(person)];
    if (!received.people.empty() && received.people.front().name != person) {
      found.complaints.push_back(fmt::format("{}: not taken: the same name as '{}', spelt differently",
                                             file.place, received.people.front().name));
      continue;
    }
    received.people = {{.name = person}};
    if (received.place.empty())
      received.place = file.place.substr(0, file.place.size() - file.name.size()) + person;
    if (slash != file.name.npos) file.name = file.name.substr(slash + 1);
    received.files.push_back(std::move(file));
  }
  for (auto& [person, received] : submissions) found.all.push_back(std::move(received));
  return found;
}

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLargestFile = std::size_t{20} << 20, kMostBytes = std::size_t{512} << 20;
constexpr int kMostFiles = 100'000, kDeepest = 30;

bool isWantedInDownload(const std::string& name) {
  return isSourceName(name) || isArchiveName(name) || endingOf(name) == ".yml";
}

/// Reads a folder and all folders in it.
class FolderWalk {
 public:
  explicit FolderWalk(const fs::path& path) : path_(path) {}

  std::vector<DownloadedFile> read() {
    visit(OpenedFolder(path_), "", 0,
          [&](const OpenedFolder&, const OpenedFolder::Entry&, const std::string& name) {
            budgets_.see(name);
          });
    visit(OpenedFolder(path_), "", 0,
          [&](const OpenedFolder& folder, const OpenedFolder::Entry& entry, const std::string& name) {
            take(folder, entry, name);
          });
    std::erase_if(files_, [&](const DownloadedFile& file) { return budgets_.isExceededBy(file.name); });
    for (const auto& [name, why] : budgets_.leftOut())
      files_.push_back({.name = name, .place = name, .whyNot = why});
    return std::move(files_);
  }

 private:
  using Take = std::function<void(const OpenedFolder&, const OpenedFolder::Entry&, const std::string& name)>;

  void visit(const OpenedFolder& folder, const std::string& prefix, int depth, const Take& take) {
    for (const OpenedFolder::Entry& entry : folder.entries()) {
      const std::string name = prefix + entry.name;
      if (entry.type != fs::file_type::directory || depth >= kDeepest)
        take(folder, entry, name);
      else if (entry.name != ".git")
        visit(folder.folder(entry.name), name + "/", depth + 1, take);
    }
  }

  void take(const OpenedFolder& folder, const OpenedFolder::Entry& entry, const std::string& name) {
    if (!budgets_.add(name, 1, 0)) return;
    if (static_cast<int>(files_.size()) >= kMostFiles) throw tooMuch(path_, "files", kMostFiles);
    files_.push_back(readEntry(folder, entry, name));
  }

  DownloadedFile readEntry(const OpenedFolder& folder, const OpenedFolder::Entry& entry,
                           const std::string& name) {
    DownloadedFile file{.name = name, .place = name};
    if (entry.type == fs::file_type::directory)
      file.whyNot = fmt::format("more than {} folders in folders", kDeepest);
    else if (entry.type != fs::file_type::regular)
      file.whyNot = entry.type == fs::file_type::symlink ? "a symbolic link" : "a pipe or device";
    else if (isWantedInDownload(name))
      readText(folder, entry.name, file);
    return file;
  }

  void readText(const OpenedFolder& folder, const std::string& entry, DownloadedFile& file) {
    try {
      const OpenedFile opened = folder.file(entry);
      file.modifiedAt = opened.modifiedAt();
      std::string text;
      std::array<char, 65536> buffer;
      for (ssize_t n = 1; n > 0 && text.size() <= kLargestFile;) {
        n = ::read(opened.fd(), buffer.data(), buffer.size());
        if (n < 0) throw Error({.what = "cannot be read", .found = std::strerror(errno)});
        text.append(buffer.data(), static_cast<std::size_t>(n));
      }
      if (!budgets_.add(file.name, 0, text.size())) return;
      bytes_ += text.size();
      if (bytes_ > kMostBytes) throw tooMuch(path_, "MiB in all files", static_cast<int>(kMostBytes >> 20));
      if (text.size() > kLargestFile)
        file.whyNot = fmt::format("more than {} MiB", kLargestFile >> 20);
      else
        file.text = std::move(text);
    } catch (const UsageError&) {
      throw;
    } catch (const Error& error) {
      file.whyNot = error.parts().found;
    }
  }

  static UsageError tooMuch(const fs::path& where, const std::string& of, int limit) {
    return UsageError({.what = "too much for a class",
                       .where = {where.string()},
                       .found = "more " + of,
                       .wanted = fmt::format("at most {}", limit)});
  }

  fs::path path_;
  std::vector<DownloadedFile> files_{};
  StudentBudgets budgets_{isWantedInDownload};
  std::size_t bytes_ = 0;
};

std::vector<DownloadedFile> filesOfBundle(const fs::path& path) {
  ArchiveContent content = readBundle(path, isWantedInDownload);
  std::vector<DownloadedFile> files;
  for (ArchiveFile& file : content.files) {
    DownloadedFile& kept = files.emplace_back(
        DownloadedFile{.name = file.name, .place = file.name, .modifiedAt = file.modifiedAt});
    if (isWantedInDownload(kept.name)) kept.text = std::move(file.text);
  }
  for (const ArchiveContent::LeftOut& left : content.leftOut)
    files.push_back({.name = left.name, .place = left.name, .whyNot = left.why});
  return files;
}

}  // namespace

Download readDownload(const fs::path& path) {
  if (!fs::is_directory(path) && !isArchiveName(path.filename().string()))
    throw UsageError({.what = fs::exists(path) ? "not a download" : "no such file or folder",
                      .where = {path.string()},
                      .found = fs::exists(path) ? "a file" : "",
                      .wanted = "a .zip, .tar or .tar.gz file, or the folder that one was unpacked into"});
  Download download{.path = path,
                    .files = fs::is_directory(path) ? FolderWalk(path).read() : filesOfBundle(path)};
  std::sort(download.files.begin(), download.files.end(),
            [](const DownloadedFile& a, const DownloadedFile& b) { return a.name < b.name; });
  return download;
}

bool isOfSystem(const fs::path& name) {
  const std::string file = lowerCase(name.filename().string());
  return std::find(name.begin(), name.end(), "__MACOSX") != name.end() || file.starts_with("._") ||
         file == ".ds_store" || file == "thumbs.db" || file == "desktop.ini";
}

bool isSourceName(const std::string& name) {
  const std::string ending = endingOf(name);
  return ending == ".cpp" || ending == ".cc" || ending == ".cxx" || ending == ".c++";
}

}  // namespace rex::classroom
