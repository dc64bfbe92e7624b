#include "classroom/hand_in.h"

#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>
#include <sys/stat.h>

#include "base/error.h"
#include "base/lower_case.h"
#include "base/printable.h"
#include "base/text_file.h"
#include "classroom/archive.h"
#include "submission/student_build.h"

namespace rex::grading {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFile = "main.cpp";
constexpr const char* kReceipt = "receipt.json";  // which `rex submit` adds
constexpr const char* kPerStudent = "a folder, .zip, .tar or .tar.gz file for each student";

// What is in a folder: sorted, so that messages come in the same order everywhere.
std::vector<fs::path> entriesOf(const fs::path& folder) {
  std::vector<fs::path> entries;
  std::error_code failure;
  for (fs::directory_iterator entry(folder, failure), end; !failure && entry != end; entry.increment(failure))
    entries.push_back(entry->path());
  if (failure)
    throw Error({.what = "cannot read this folder", .where = {folder.string()}, .found = failure.message()});
  std::sort(entries.begin(), entries.end());
  return entries;
}

fs::file_type typeOf(const fs::path& path) {
  std::error_code failure;
  return fs::symlink_status(path, failure).type();
}

std::string nameOf(fs::file_type type) {
  if (type == fs::file_type::symlink) return "a symbolic link";
  if (type == fs::file_type::directory) return "a folder";
  if (type == fs::file_type::regular) return "a file";
  return type == fs::file_type::not_found ? "nothing" : "a pipe or device";
}

std::int64_t modifiedAt(const fs::path& file) {
  struct stat status {};
  return ::lstat(file.c_str(), &status) == 0 ? status.st_mtim.tv_sec : 0;
}

/// Collects what one folder of submissions holds.
class HandInReader {
 public:
  HandInReader(const std::vector<ExerciseInfo>& exercises, const std::string& only)
      : exercises_(exercises), only_(only.empty() ? only : findExercise(exercises, only).name) {}

  HandIns read(const fs::path& folder) {
    std::map<std::string, std::vector<fs::path>> students;  // two that differ in capitals are one name
    for (const fs::path& entry : entriesOf(folder)) {
      const fs::file_type type = typeOf(entry);
      const std::string file = entry.filename().string();
      const bool isArchive = type == fs::file_type::regular && isArchiveName(file);
      const std::string name = isArchive ? withoutArchiveEnding(file) : file;
      if (type == fs::file_type::regular && file.starts_with('.'))
        found_.notes.push_back(fmt::format("{}: not taken", entry.string()));
      else if (type != fs::file_type::directory && !isArchive)
        complain("not taken", entry, nameOf(type), kPerStudent);
      else if (const std::string why = whyNoStudentName(name); !why.empty())
        complain("not the name of a student", entry, why,
                 "letters, digits, blanks and signs such as - _ . @");
      else
        students[lowerCase(name)].push_back(entry);
    }
    for (const auto& [name, folders] : students) {
      if (!isOneSpelling(folders, "a student")) continue;
      if (typeOf(folders.front()) == fs::file_type::directory)
        readStudent(folders.front());
      else
        readPacked(folders.front());
    }
    std::sort(found_.files.begin(), found_.files.end(), [](const HandIn& a, const HandIn& b) {
      return std::pair(a.student, a.exercise) < std::pair(b.student, b.exercise);
    });
    return std::move(found_);
  }

 private:
  void complain(std::string what, const fs::path& where, std::string found, std::string wanted) {
    complain({.what = std::move(what),
              .where = {where.string()},
              .found = std::move(found),
              .wanted = std::move(wanted)});
  }
  void complain(ErrorParts parts) { found_.complaints.emplace_back(Error(std::move(parts)).what()); }

  // Which of two spellings is meant, nobody knows.
  bool isOneSpelling(const std::vector<fs::path>& folders, const std::string& of) {
    if (folders.size() == 1) return true;
    std::vector<std::string> names;
    for (const fs::path& folder : folders) names.push_back("'" + folder.filename().string() + "'");
    complain(fmt::format("the same name of {}, spelt differently", of), folders.front().parent_path(),
             fmt::format("{}", fmt::join(names, " and ")), "one of them");
    return false;
  }

  void readStudent(const fs::path& folder) {
    std::map<std::string, std::vector<fs::path>> exercises;
    for (const fs::path& entry : entriesOf(folder)) {
      const fs::file_type type = typeOf(entry);
      if (type == fs::file_type::regular)
        noteUnlisted(entry);
      else if (type != fs::file_type::directory)
        complain("not taken", entry, nameOf(type), "a folder for each exercise");
      else if (const std::string exercise = exerciseOf(entry); !exercise.empty())
        exercises[exercise].push_back(entry);
    }
    complainOfNone(exercises.empty(), folder);
    for (const auto& [exercise, folders] : exercises) {
      if (!isOneSpelling(folders, "an exercise")) continue;
      if (only_.empty() || only_ == exercise) readFile(folder.filename().string(), exercise, folders.front());
    }
  }

  void complainOfNone(bool isEmpty, const fs::path& student) {
    if (isEmpty && only_.empty())
      complain("nothing to grade", student, "no folder of an exercise",
               exercises_.empty() ? "" : exercises_.front().name + "/" + kFile);
  }

  // ROOT/EXERCISE/main.cpp.
  static bool isFileIn(const fs::path& root, const fs::path& name) {
    return name.filename() == kFile && name.has_parent_path() && !name.parent_path().filename().empty() &&
           name.parent_path().parent_path() == root;
  }

  // The folder of an archive in which the exercises lie: its top, or one folder around all, as programs pack
  // that are asked to pack a folder. Nothing, with a complaint, where there are two: nobody knows which
  // counts.
  std::optional<fs::path> rootOf(const std::vector<ArchiveFile>& members, const fs::path& archive) {
    std::set<fs::path> known, all;
    for (const ArchiveFile& member : members) {
      const fs::path name = fs::path(member.name).lexically_normal();
      const fs::path root = name.parent_path().parent_path();
      if (!isFileIn(root, name) || std::distance(root.begin(), root.end()) > 1) continue;
      all.insert(root);
      if (isExercise(name.parent_path().filename().string())) known.insert(root);
    }
    if (known.empty()) known = std::move(all);
    if (known.size() > 1) {
      std::vector<std::string> names;
      for (const fs::path& root : known)
        names.push_back(root.empty() ? "its top" : fmt::format("'{}'", root.string()));
      complain("exercises in more than one folder", archive, fmt::format("{}", fmt::join(names, " and ")),
               "one of them");
      return {};
    }
    const fs::path root = known.empty() ? fs::path() : *known.begin();
    if (!root.empty())
      found_.notes.push_back(fmt::format("{}: taken from its folder '{}'", archive.string(), root.string()));
    return root;
  }

  bool isExercise(const std::string& name) const {
    try {
      return !findExercise(exercises_, name).name.empty();
    } catch (const UsageError&) {
      return false;
    }
  }

  // The same of a student who handed in one archive. Its own time counts, for those inside are the student's.
  void readPacked(const fs::path& archive) {
    std::vector<ArchiveFile> members;
    try {
      members = readArchive(archive);
    } catch (const Error& error) {
      complain(error.parts());
      return;
    }
    const std::optional<fs::path> root = rootOf(members, archive);
    if (!root) return;
    std::map<std::string, std::vector<fs::path>> exercises;
    std::map<fs::path, std::string> texts;
    for (ArchiveFile& member : members) {
      const fs::path name = fs::path(member.name).lexically_normal(), file = archive / name;
      if (!isFileIn(*root, name))
        noteUnlisted(file);
      else if (const std::string exercise = exerciseOf(file.parent_path()); !exercise.empty())
        exercises[exercise].push_back(file.parent_path()), texts[file.parent_path()] = std::move(member.text);
    }
    complainOfNone(exercises.empty(), archive);
    for (const auto& [exercise, folders] : exercises) {
      if (!isOneSpelling(folders, "an exercise") || (!only_.empty() && only_ != exercise)) continue;
      found_.files.push_back({.student = withoutArchiveEnding(archive.filename().string()),
                              .exercise = exercise,
                              .from = folders.front() / kFile,
                              .text = texts[folders.front()],
                              .submitted = modifiedAt(archive)});
    }
  }

  // The whole name, or empty with a complaint.
  std::string exerciseOf(const fs::path& folder) {
    try {
      return findExercise(exercises_, folder.filename().string()).name;
    } catch (const UsageError& error) {
      ErrorParts parts = error.parts();
      parts.where = {folder.string()};
      complain(std::move(parts));
      return {};
    }
  }

  void noteUnlisted(const fs::path& file) {
    if (file.filename() != kReceipt) found_.notes.push_back(fmt::format("{}: not taken", file.string()));
  }

  void readFile(const std::string& student, const std::string& exercise, const fs::path& folder) {
    for (const fs::path& entry : entriesOf(folder)) {
      if (entry.filename() != kFile) noteUnlisted(entry);
    }
    HandIn file{.student = student, .exercise = exercise, .from = folder / kFile};
    file.submitted = modifiedAt(typeOf(file.from) == fs::file_type::not_found ? folder : file.from);
    try {
      file.text = readStudentFile(file.from);
    } catch (const Error& error) {
      complain(error.parts());
    }
    found_.files.push_back(std::move(file));
  }

  const std::vector<ExerciseInfo>& exercises_;
  std::string only_;
  HandIns found_{};
};

}  // namespace

fs::path snapshotOf(const HandIn& file, const fs::path& out) {
  const fs::path snapshot = fs::path(file.student) / file.exercise / kFile;
  if (!file.text) {
    fs::remove(out / snapshot);  // one of an earlier time would look as if it were graded
    return fs::absolute(file.from);
  }
  fs::create_directories((out / snapshot).parent_path());
  if (!fs::exists(out / snapshot) || readTextFile(out / snapshot) != *file.text)
    replaceTextFile(out / snapshot, *file.text, "the copy of what was handed in");
  return snapshot;
}

std::string whyNoStudentName(const std::string& name) {
  constexpr std::size_t kLongest = 100;
  if (name.empty() || name.starts_with('.')) return "a name that begins with a dot, or none";
  if (name.size() > kLongest) return fmt::format("{} bytes, more than {}", name.size(), kLongest);
  if (name.find_first_of("/\\\n\t") != std::string::npos || printable(name, 4 * kLongest) != name)
    return "a slash, a control character or bytes that are no UTF-8";
  if (name.front() == ' ' || name.back() == ' ') return "a blank at an end";
  // Files of the output folder.
  if (lowerCase(name) == "grades.csv" || lowerCase(name) == "tasks.tsv")
    return "the name of a file of results";
  return {};
}

HandIns readHandIns(const fs::path& folder, const std::vector<ExerciseInfo>& exercises,
                    const std::string& only) {
  return HandInReader(exercises, only).read(folder);
}

}  // namespace rex::grading
