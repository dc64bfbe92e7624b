#include "classroom/student_files.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/escape.h"
#include "classroom/archive.h"

namespace rex::classroom {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMainFile = "main.cpp";
constexpr const char* kReceiptOfSubmit = "receipt.json";

// As grading refuses a file.
std::string whyNoSource(const std::string& text) {
  constexpr std::size_t kLargest = 1u << 20;
  if (text.size() > kLargest) return "more than 1 MiB";
  if (text.find('\0') != text.npos) return "NUL bytes, as in a binary or UTF-16 file";
  return {};
}

/// Sorts the files of one student.
class FilePicker {
 public:
  explicit FilePicker(const PickOptions& options) : options_(options) {}

  PickedFiles pick(const std::vector<DownloadedFile>& files) {
    for (const DownloadedFile& file : files) look(file, false);
    takeOther();
    for (auto& [exercise, found] : found_) take(exercise, found);
    for (const DownloadedFile* file : others_) picked_.notes.push_back(ignored(file->place));
    if (picked_.files.empty() && picked_.complaints.empty() && isLeft_ && !isUntouched_)
      complain({}, "nothing to grade", nested_.empty() ? files.front().place : nested_,
               !nested_.empty()    ? "an archive in an archive"
               : files.size() == 1 ? "this file"
                                   : fmt::format("this and {} more", files.size() - 1),
               example());
    return std::move(picked_);
  }

 private:
  void look(const DownloadedFile& file, bool isPacked) {
    const fs::path path(file.name);
    if (isOfSystem(path)) return;
    if (path.filename() == kReceiptOfSubmit) return lookAtReceipt(file);
    isLeft_ = true;
    const bool isMain = path.filename() == kMainFile, isArchive = isArchiveName(file.name);
    if (!file.text && !file.whyNot.empty() && (isMain || isArchive || isSourceName(file.name)))
      complain(isArchive ? "" : exerciseOf(file), "not accepted", file.place, file.whyNot,
               wantedInsteadOf(file.whyNot, "a C++ source file or an archive"));
    else if (!file.text)
      picked_.notes.push_back(ignored(file.place) + (file.whyNot.empty() ? "" : ": " + file.whyNot));
    else if (isMain)
      lookAtMain(file);
    else if (isArchive && !isPacked)
      unpack(file);
    else if (isArchive)
      nested_ = file.place, picked_.notes.push_back(ignored(file.place) + ": an archive in an archive");
    else if (isSourceName(file.name))
      others_.push_back(&keep(file));
    else
      picked_.notes.push_back(ignored(file.place));
  }

  // Each archive may take some seconds and megabytes.
  void unpack(const DownloadedFile& file) {
    constexpr int kMostArchives = 20;
    if (++archives_ == kMostArchives + 1)
      complain({}, "not accepted", file.place,
               fmt::format("more than {} archives of one student", kMostArchives), "one");
    if (archives_ > kMostArchives) return;
    try {
      ArchiveContent content = readArchive(*file.text, file.place);
      for (ArchiveFile& member : content.files)
        look({.name =
                  withoutArchiveEnding(file.name) + "/" + fs::path(member.name).lexically_normal().string(),
              .place = file.place + "/" + member.name,
              .text = std::move(member.text),
              .modifiedAt = file.modifiedAt,
              .attempts = file.attempts},
             true);
      for (const auto& [member, why] : content.leftOut)
        look({.name = member, .place = file.place + "/" + member, .whyNot = why}, true);
    } catch (const Error& error) {
      add({}, error);
    }
  }

  void lookAtMain(const DownloadedFile& file) {
    const std::string exercise = exerciseOf(file);
    if (exercise.empty())
      complain({}, "no exercise folder around it", file.place, "a file",
               example() + ", or --exercise EXERCISE");
    else if (!options_.exercise.empty() && exercise != options_.exercise)
      picked_.notes.push_back(fmt::format("{}: not of {}", file.place, options_.exercise));
    else
      found_[exercise].push_back(&keep(file));
  }

  // {"files": [{"name": "01-kinematics/main.cpp", "work": {...}, ...}]}
  void lookAtReceipt(const DownloadedFile& file) {
    if (!file.text) return;
    const nlohmann::json receipt = nlohmann::json::parse(*file.text, nullptr, false);
    if (!receipt.is_object() || !receipt.contains("files") || !receipt["files"].is_array()) return;
    for (const nlohmann::json& one : receipt["files"]) {
      if (!one.is_object() || !one.contains("work")) continue;
      const std::string name = one.contains("name") && one["name"].is_string() ? one["name"] : "";
      const auto exercise =
          std::ranges::find(options_.exercises, exerciseAround(name), &submission::ExerciseInfo::name);
      const auto work = submission::readWorkTime(one["work"].dump());
      if (work && exercise != options_.exercises.end() && areParts(work->parts, *exercise))
        work_[exercise->name] = *work;
      else
        picked_.notes.push_back(
            fmt::format("{}: left out, as rex did not write it: how long somebody worked", file.place));
    }
  }

  static bool areParts(const std::map<std::string, std::int64_t>& ids,
                       const submission::ExerciseInfo& exercise) {
    return std::ranges::all_of(ids, [&](const auto& one) {
      return std::ranges::find(exercise.parts, one.first, &submission::ExercisePart::id) !=
             exercise.parts.end();
    });
  }

  std::string exerciseOf(const DownloadedFile& file) const {
    const std::string around = exerciseAround(file.name);
    return around.empty() ? options_.exercise : around;
  }

  // The innermost folder that has the name of an exercise.
  std::string exerciseAround(const std::string& name) const {
    for (fs::path folder = fs::path(name).parent_path(); !folder.empty(); folder = folder.parent_path()) {
      try {
        return submission::findExercise(options_.exercises, folder.filename().string()).name;
      } catch (const Error&) {
        continue;
      }
    }
    return {};
  }

  // Students give their file a name of their own, or the platform does: "main (1).cpp".
  void takeOther() {
    if (options_.exercise.empty() || found_.contains(options_.exercise) || others_.empty()) return;
    if (others_.size() > 1) {
      complain(options_.exercise, "more than one source file", others_.front()->place,
               fmt::format("also '{}'", printable(others_.back()->place, 200)), "one, or main.cpp");
      return;
    }
    picked_.notes.push_back(fmt::format("{}: taken as main.cpp", others_.front()->place));
    found_[options_.exercise].push_back(others_.front());
    others_.clear();
  }

  void take(const std::string& exercise, const std::vector<const DownloadedFile*>& found) {
    const DownloadedFile& file = *found.front();
    const auto other = std::find_if(found.begin(), found.end(),
                                    [&](const DownloadedFile* one) { return *one->text != *file.text; });
    const auto handedOut = options_.handedOut.find(exercise);
    if (other != found.end())
      complain(exercise, "two files for " + exercise, file.place,
               fmt::format("another text in '{}'", printable((*other)->place, 200)), "one of them");
    else if (const std::string why = whyNoSource(*file.text); !why.empty())
      complain(exercise, "cannot be graded", file.place, why, "a C++ source file");
    else if (handedOut != options_.handedOut.end() && handedOut->second == *file.text)
      isUntouched_ = true,
      picked_.notes.push_back(fmt::format("{}: as it was handed out, not taken", file.place));
    else
      picked_.files.push_back(
          {exercise, *file.text, file.place, file.modifiedAt, file.attempts, workOn(exercise)});
  }

  std::optional<submission::WorkTime> workOn(const std::string& exercise) const {
    const auto found = work_.find(exercise);
    return found == work_.end() ? std::nullopt : std::optional(found->second);
  }

  const DownloadedFile& keep(const DownloadedFile& file) {
    return *kept_.emplace_back(std::make_unique<DownloadedFile>(file));
  }

  static std::string ignored(const std::string& name) { return fmt::format("{}: ignored", name); }

  std::string example() const {
    if (!options_.exercise.empty()) return kMainFile;
    return options_.exercises.empty() ? kMainFile : options_.exercises.front().name + "/" + kMainFile;
  }

  void complain(const std::string& exercise, std::string what, const std::string& where, std::string found,
                std::string wanted) {
    add(exercise, Error({.what = std::move(what),
                         .where = {where},
                         .found = std::move(found),
                         .wanted = std::move(wanted)}));
  }
  void add(const std::string& exercise, const Error& error) {
    picked_.complaints.emplace_back(error.what());
    picked_.whyNone.emplace(exercise, error.what());
  }

  const PickOptions& options_;
  PickedFiles picked_{};
  int archives_ = 0;
  std::string nested_{};      ///< an archive in an archive
  bool isLeft_ = false;       ///< there is a file of the student's own
  bool isUntouched_ = false;  ///< there is one as it was handed out
  std::vector<std::unique_ptr<DownloadedFile>> kept_{};
  std::map<std::string, std::vector<const DownloadedFile*>> found_{};
  std::vector<const DownloadedFile*> others_{};
  std::map<std::string, submission::WorkTime> work_{};
};

}  // namespace

PickedFiles pickFiles(const std::vector<DownloadedFile>& files, const PickOptions& options) {
  return FilePicker(options).pick(files);
}

}  // namespace rex::classroom
