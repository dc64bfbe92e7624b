#include "classroom/submission_folder.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include <fmt/format.h>

#include "base/error.h"
#include "base/escape.h"
#include "base/folders.h"
#include "base/text.h"
#include "base/text_file.h"
#include "classroom/archive.h"
#include "classroom/download.h"
#include "classroom/gradebook_text.h"
#include "classroom/import_table.h"
#include "submission/student_build.h"

namespace rex::classroom {
namespace {

bool isSameText(const std::string& a, const std::string& b) {
  return !a.empty() && !b.empty() && caseless(a) == caseless(b);
}

}  // namespace

std::string courseStudent(const ImportedStudent& person, const Course& course) {
  // What the platform knows for certain comes first: a folder may be called like another student.
  using Field = std::pair<const std::string&, std::string CourseStudent::*>;
  for (const auto& [told, known] :
       {Field{person.id, &CourseStudent::id}, Field{person.id, &CourseStudent::number},
        Field{person.email, &CourseStudent::email}, Field{person.student, &CourseStudent::id},
        Field{person.githubUsername, &CourseStudent::id}})
    for (const CourseStudent& student : course.students)
      if (isSameText(told, student.*known)) return student.id;
  std::vector<std::string> named;
  for (const CourseStudent& student : course.students)
    if (isSameText(person.name, student.name)) named.push_back(student.id);
  return named.size() == 1 ? named.front() : "";
}

std::string studentCalled(const std::string& text, const Course& course, const ImportTable& imported,
                          const std::vector<std::string>& folders) {
  const ImportedStudent any{.student = text, .id = text, .name = text, .email = text};
  if (std::string id = courseStudent(any, course); !id.empty()) return id;
  std::set<std::string> ids;
  for (const CourseStudent& student : course.students)
    if (isSameText(text, student.name)) ids.insert(student.id);
  for (const ImportedStudent& person : imported.students)
    for (const std::string& key :
         {person.student, person.id, person.name, person.email, person.githubUsername})
      if (isSameText(text, key)) ids.insert(courseStudent(person, course));
  ids.erase("");
  if (ids.size() == 1) return *ids.begin();
  if (ids.size() > 1)
    throw UsageError({.what = fmt::format("several students are called '{}'", text),
                      .wanted = fmt::format("one of the ids {}", join(ids, ", "))});
  const auto folder = std::ranges::find_if(folders, [&](const auto& one) { return isSameText(text, one); });
  return folder == folders.end() ? "" : *folder;
}

SubmissionOwners::SubmissionOwners(const Course& course, const ImportTable& imported)
    : course_(course), imported_(imported) {
  // The partners of a student whose row was not taken still get what that student handed in.
  everyone_.students = course.students;
  for (const RosterFault& fault : course.faults)
    if (whyNoStudentName(fault.student.id).empty() && everyone_.student(fault.student.id) == nullptr)
      everyone_.students.push_back(fault.student);
  for (const CourseStudent& student : everyone_.students) ids_[caseless(student.id)] = student.id;
  for (const ImportedStudent& person : imported.students)
    if (const std::string id = courseStudent(person, everyone_); !id.empty()) people_[person.student] = id;
}

std::vector<std::string> SubmissionOwners::withGroups(const std::vector<std::string>& ids) const {
  std::set<std::string> all;
  for (const std::string& id : ids) {
    const CourseStudent* student = everyone_.student(id);
    if (course_.student(id) != nullptr) all.insert(id);
    if (student != nullptr)
      for (const std::string& member : course_.members(student->group)) all.insert(member);
  }
  return {all.begin(), all.end()};
}

std::vector<std::string> SubmissionOwners::of(const std::string& folder, const std::string& exercise) const {
  std::vector<std::string> ids;
  for (const ImportedStudent& person : imported_.students) {
    const auto entry = person.exercises.find(exercise);
    const auto id = people_.find(person.student);
    if (entry != person.exercises.end() && entry->second.handedInBy == folder && id != people_.end())
      ids.push_back(id->second);
  }
  if (!ids.empty()) return withGroups(ids);
  if (const auto own = ids_.find(caseless(folder)); own != ids_.end()) return withGroups({own->second});
  for (const std::string& group : course_.groups())
    if (isSameText(group, folder)) return course_.members(group);
  if (const auto person = people_.find(folder); person != people_.end()) return withGroups({person->second});
  return {};
}

namespace {

namespace fs = std::filesystem;

constexpr const char* kFile = "main.cpp";
constexpr const char* kReceipt = "receipt.json";  // added by `rex submit`
constexpr const char* kPerStudent = "a folder, .zip, .tar or .tar.gz file for each student";

std::string nameOf(fs::file_type type) {
  if (type == fs::file_type::symlink) return "a symbolic link";
  if (type == fs::file_type::directory) return "a folder";
  if (type == fs::file_type::regular) return "a file";
  return "a pipe or device";
}

/// Collects the contents of one folder of submissions.
class HandInReader {
 public:
  HandInReader(const std::vector<submission::ExerciseInfo>& exercises, const std::string& only)
      : exercises_(exercises), only_(only.empty() ? only : submission::findExercise(exercises, only).name) {}

  SubmittedFiles read(const fs::path& path) {
    const OpenedFolder folder(path);
    std::map<std::string, std::vector<OpenedFolder::Entry>>
        students;  // names that differ only in case are one
    for (const OpenedFolder::Entry& entry : folder.entries()) {
      const bool isFile = entry.type == fs::file_type::regular,
                 isArchive = isFile && isArchiveName(entry.name);
      const std::string name = isArchive ? withoutArchiveEnding(entry.name) : entry.name;
      if (isFile && entry.name == kImportTable) continue;
      if ((isFile && entry.name.starts_with('.')) || isOfSystem(entry.name))
        found_.notes.push_back(fmt::format("{}: ignored", (path / entry.name).string()));
      else if (entry.type != fs::file_type::directory && !isArchive)
        complain("not accepted", path / entry.name, nameOf(entry.type), kPerStudent);
      else if (const std::string why = whyNoStudentName(name); !why.empty())
        complain("not the name of a student", path / entry.name, why,
                 "letters, digits, blanks and signs such as - _ . @");
      else
        students[caseless(name)].push_back(entry);
    }
    for (const auto& [name, entries] : students) readStudent(folder, entries), student_.clear();
    std::sort(found_.files.begin(), found_.files.end(), [](const SubmittedFile& a, const SubmittedFile& b) {
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
  void complain(ErrorParts parts) {
    found_.complaints.emplace_back(Error(parts).what());
    parts.where = {};
    if (!student_.empty()) found_.rejected.push_back({student_, exercise_, Error(std::move(parts)).what()});
  }

  // Complains if there are several spellings: nobody knows which one is meant.
  bool isOneSpelling(const std::vector<std::string>& names, const fs::path& where, const std::string& of) {
    if (names.size() == 1) return true;
    complain(fmt::format("the same name of {}, spelt differently", of), where,
             fmt::format("'{}'", join(names, "' and '")), "one of them");
    return false;
  }

  // Only this student is affected if something cannot be opened any more because somebody replaced it.
  void readStudent(const OpenedFolder& folder, const std::vector<OpenedFolder::Entry>& entries) {
    std::vector<std::string> names;
    for (const OpenedFolder::Entry& entry : entries) names.push_back(entry.name);
    student_ = isArchiveName(names.front()) ? withoutArchiveEnding(names.front()) : names.front();
    if (!isOneSpelling(names, folder.path(), "a student")) return;
    try {
      if (entries.front().type == fs::file_type::directory)
        readUnpacked(folder.folder(names.front()));
      else
        readPacked(folder.file(names.front()), folder.path() / names.front());
    } catch (const Error& error) {
      complain(error.parts());
    }
  }

  void readUnpacked(const OpenedFolder& folder) {
    std::map<std::string, std::vector<std::string>> exercises;
    for (const OpenedFolder::Entry& entry : folder.entries()) {
      const fs::path path = folder.path() / entry.name;
      if (entry.type == fs::file_type::regular || isOfSystem(entry.name))
        noteUnlisted(path);
      else if (entry.type != fs::file_type::directory)
        complain("not accepted", path, nameOf(entry.type), "a folder for each exercise");
      else if (const std::string exercise = exerciseOf(path); !exercise.empty())
        exercises[exercise].push_back(entry.name);
    }
    complainOfNone(exercises.empty(), folder.path());
    for (const auto& [exercise, names] : exercises) {
      if (!isOneSpelling(names, folder.path(), "an exercise")) continue;
      if (only_.empty() || only_ == exercise)
        readFile(folder.path().filename().string(), exercise, folder.folder(names.front()));
    }
  }

  void complainOfNone(bool isEmpty, const fs::path& student) {
    const std::string& example = only_.empty() && !exercises_.empty() ? exercises_.front().name : only_;
    if (isEmpty)
      complain("nothing to grade", student, "no exercise folder",
               example.empty() ? "" : example + "/" + kFile);
  }

  // ROOT/EXERCISE/main.cpp.
  static bool isFileIn(const fs::path& root, const fs::path& name) {
    return name.filename() == kFile && name.has_parent_path() && !name.parent_path().filename().empty() &&
           name.parent_path().parent_path() == root;
  }

  // The folder of an archive that contains the exercises: its top, or the one folder around everything that
  // programs create when they pack a folder. Empty, with a complaint, if there are two: nobody knows which
  // one counts.
  std::optional<fs::path> rootOf(const std::vector<ArchiveFile>& members, const fs::path& archive) {
    std::set<fs::path> known, all;
    for (const ArchiveFile& member : members) {
      const fs::path name = fs::path(member.name).lexically_normal();
      const fs::path root = name.parent_path().parent_path();
      if (isOfSystem(name) || !isFileIn(root, name) || std::distance(root.begin(), root.end()) > 1) continue;
      all.insert(root);
      if (isExercise(name.parent_path().filename().string())) known.insert(root);
    }
    if (known.empty()) known = std::move(all);
    if (known.size() > 1) {
      std::vector<std::string> names;
      for (const fs::path& root : known)
        names.push_back(root.empty() ? "its top" : fmt::format("'{}'", root.string()));
      complain("exercises in more than one folder", archive, join(names, " and "), "one of them");
      return {};
    }
    const fs::path root = known.empty() ? fs::path() : *known.begin();
    if (!root.empty())
      found_.notes.push_back(fmt::format("{}: taken from its folder '{}'", archive.string(), root.string()));
    return root;
  }

  bool isExercise(const std::string& name) const {
    try {
      return !submission::findExercise(exercises_, name).name.empty();
    } catch (const UsageError&) {
      return false;
    }
  }

  // Reads what a student handed in as one archive. The time of the archive counts, for the student controls
  // the times inside it.
  void readPacked(const OpenedFile& opened, const fs::path& archive) {
    ArchiveContent content = readArchive(opened, archive);
    const std::optional<fs::path> root = rootOf(content.files, archive);
    if (!root) return;
    tellLeftOut(content.leftOut, *root, archive);
    std::map<std::string, std::vector<std::string>> exercises;
    std::map<std::string, std::string> texts;
    for (ArchiveFile& member : content.files) {
      const fs::path name = fs::path(member.name).lexically_normal(), file = archive / name;
      const std::string folder = name.parent_path().filename().string();
      if (isOfSystem(name) || !isFileIn(*root, name))
        noteUnlisted(file);
      else if (const std::string exercise = exerciseOf(file.parent_path()); !exercise.empty())
        exercises[exercise].push_back(folder), texts[folder] = std::move(member.text);
    }
    complainOfNone(exercises.empty(), archive);
    for (const auto& [exercise, folders] : exercises) {
      if (!isOneSpelling(folders, root->empty() ? archive : archive / *root, "an exercise") ||
          (!only_.empty() && only_ != exercise))
        continue;
      found_.files.push_back({.student = withoutArchiveEnding(archive.filename().string()),
                              .exercise = exercise,
                              .from = archive / *root / folders.front() / kFile,
                              .text = texts[folders.front()],
                              .submitted = opened.modifiedAt()});
    }
  }

  // A link beside the file does no harm; one in place of the file leaves nothing to grade.
  void tellLeftOut(const std::vector<ArchiveContent::LeftOut>& leftOut, const fs::path& root,
                   const fs::path& archive) {
    for (const auto& [member, why] : leftOut) {
      const fs::path name = fs::path(member).lexically_normal();
      if (isFileIn(root, name))
        complain("not accepted", archive / name, why, "a C++ source file");
      else
        found_.notes.push_back(fmt::format("{}: ignored: {}", (archive / name).string(), why));
    }
  }

  // The full name of the exercise, or empty with a complaint.
  std::string exerciseOf(const fs::path& folder) {
    try {
      return submission::findExercise(exercises_, folder.filename().string()).name;
    } catch (const UsageError& error) {
      ErrorParts parts = error.parts();
      parts.where = {folder.string()};
      complain(std::move(parts));
      return {};
    }
  }

  void noteUnlisted(const fs::path& file) {
    if (file.filename() != kReceipt) found_.notes.push_back(fmt::format("{}: ignored", file.string()));
  }

  void readFile(const std::string& student, const std::string& exercise, const OpenedFolder& folder) {
    for (const OpenedFolder::Entry& entry : folder.entries())
      if (entry.name != kFile) noteUnlisted(folder.path() / entry.name);
    SubmittedFile file{.student = student,
                       .exercise = exercise,
                       .from = folder.path() / kFile,
                       .submitted = folder.modifiedAt()};
    try {
      submission::StudentFile read = submission::readStudentFile(folder, kFile);
      file.text = std::move(read.text);
      file.submitted = read.modifiedAt;
    } catch (const Error& error) {
      file.whyNot = error.parts().found;
      exercise_ = exercise;
      complain(error.parts());
      exercise_.clear();
    }
    found_.files.push_back(std::move(file));
  }

  const std::vector<submission::ExerciseInfo>& exercises_;
  std::string only_;
  SubmittedFiles found_{};
  std::string student_{}, exercise_{};  // of complaints, if known
};

// Includes blanks that are not ASCII.
bool startsOrEndsBlank(std::string_view name) {
  constexpr auto kBlanks = std::to_array<std::string_view>(
      {" ", "\u00A0", "\u1680", "\u2000", "\u2001", "\u2002", "\u2003", "\u2004", "\u2005", "\u2006",
       "\u2007", "\u2008", "\u2009", "\u200A", "\u202F", "\u205F", "\u3000", "\u2800"});
  return std::any_of(kBlanks.begin(), kBlanks.end(), [&](std::string_view blank) {
    return name.starts_with(blank) || name.ends_with(blank);
  });
}

}  // namespace

// The original is never read again: by then, another file may have taken its place.
fs::path writeSnapshot(const SubmittedFile& file, const fs::path& out) {
  const fs::path snapshot = fs::path(file.student) / file.exercise / kFile;
  const std::string text = file.text.value_or(
      fmt::format("// Not what was handed in, which could not be read.\n#error cannot be graded: found {}, "
                  "wanted a C++ source file\n",
                  printable(file.whyNot)));
  fs::create_directories((out / snapshot).parent_path());
  if (!fs::exists(out / snapshot) || readTextFile(out / snapshot) != text)
    replaceTextFile(out / snapshot, text, "the copy of what was handed in");
  return snapshot;
}

bool isNameOfResults(const std::string& name) {
  constexpr auto kEndings = std::to_array<std::string_view>(
      {".csv", ".tsv", ".toml", ".log", ".txt", ".json", ".xml", ".md", ".html", ".png", ".new", ".lock"});
  const std::string lower = lowerCase(name);
  return std::any_of(kEndings.begin(), kEndings.end(),
                     [&](std::string_view ending) { return lower.ends_with(ending); });
}

void requireNameOfResults(const fs::path& file, const fs::path& out) {
  const bool isBeside = fs::weakly_canonical(file).parent_path() == fs::weakly_canonical(out);
  if (isBeside && !isNameOfResults(file.filename().string()))
    throw UsageError({.what = "a file beside the students' folders, whose name could be that of a student",
                      .where = {file.string()},
                      .wanted = "a name that ends in .tsv, or another folder"});
}

std::string whyNoStudentName(const std::string& name) {
  constexpr std::size_t kLongest = 100;
  if (name.empty() || name.starts_with('.')) return "an empty name, or one that begins with a dot";
  if (name.size() > kLongest) return fmt::format("{} bytes, more than {}", name.size(), kLongest);
  const bool isVisible =
      printable(name) == name && visibleJson(name) == name;  // also where scripts have joiners
  if (name.find_first_of("/\\\n\t") != std::string::npos || !isVisible)
    return "a slash, a control character, an invisible one or bytes that are not UTF-8";
  if (startsOrEndsBlank(name)) return "a leading or trailing blank";
  if (isNameOfResults(name)) return "the name of a results file";
  return {};
}

SubmittedFiles readSubmittedFiles(const fs::path& folder,
                                  const std::vector<submission::ExerciseInfo>& exercises,
                                  const std::string& only) {
  return HandInReader(exercises, only).read(folder);
}

}  // namespace rex::classroom
