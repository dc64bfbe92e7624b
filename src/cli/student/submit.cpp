#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "base/error.h"
#include "base/sha256.h"
#include "cli/command_table.h"
#include "cli/json_internal.h"
#include "cli/option_table_internal.h"
#include "cli/student/progress.h"
#include "cli/terminal.h"
#include "submission/student_build.h"
#include "submission/submission.h"
#include "submission/work_time.h"
#include "submission/zip_file.h"

namespace rex::cli {
namespace {

struct SubmitOptions {
  std::vector<std::string> exercises;
  bool progress = false;  ///< also hand in how long they were worked on
  std::filesystem::path out = "handin.zip";
};

// One file that is handed in. Other files in the exercise's folder are not.
struct HandedIn {
  ExerciseInfo exercise;
  std::string name;  // in the zip
  std::string text;
  std::string sha256;
};

HandedIn handInOf(const ExerciseInfo& exercise) {
  HandedIn file{.exercise = exercise,
                .name = exercise.name + "/main.cpp",
                .text = submission::readStudentFile(exercise.folder / "main.cpp"),
                .sha256 = {}};
  file.sha256 = sha256(file.text);
  return file;
}

submission::WorkTime workOn(const ExerciseInfo& exercise, const AllProgress& all) {
  const auto found = all.exercises.find(exercise.name);
  if (found == all.exercises.end()) return {};
  submission::WorkTime work{.seconds = found->second.work.seconds};
  for (const auto& [part, passed] : found->second.work.parts) work.parts[part] = passed.worked;
  return work;
}

std::string receiptOf(const std::vector<HandedIn>& files, const AllProgress& all, bool withProgress) {
  Json list = Json::array();
  for (const HandedIn& file : files) {
    list.push_back({{"name", file.name},
                    {"bytes", file.text.size()},
                    {"sha256", file.sha256},
                    {"exercise_version", submission::exerciseVersion(file.exercise.definition)}});
    if (withProgress) list.back()["work"] = Json::parse(workTimeText(workOn(file.exercise, all)));
  }
  return Json{{"schema", "rex-receipt/1"}, {"tool", REX_VERSION}, {"files", list}}.dump(2) + "\n";
}

void sayLastTest(const HandedIn& file, const AllProgress& all) {
  const auto found = all.exercises.find(file.exercise.name);
  if (found == all.exercises.end() || found->second.fileSha256 != file.sha256)
    return note(wrap(fmt::format("This version of {} was not tested: scripts/rex test {}",
                                 shown(file.exercise.folder / "main.cpp"), file.exercise.name),
                     2, 0));
  say(fmt::format("{}: {} of {} points in its last test", file.exercise.name, found->second.points,
                  found->second.maxPoints));
}

void sayWork(const HandedIn& file, const AllProgress& all) {
  const submission::WorkTime work = workOn(file.exercise, all);
  say(fmt::format("{}: the receipt says that you worked on it for {} min, and when {} of {} parts passed",
                  file.exercise.name, work.seconds / 60, work.parts.size(), file.exercise.parts.size()));
}

// Writes the zip file to hand in: EXERCISE/main.cpp of each exercise, and receipt.json.
ExitCode submit(const Project& project, const SubmitOptions& options) {
  if (options.out.extension() != ".zip")
    throw UsageError(
        {.what = "-o", .found = escapeForTerminal(options.out.string()), .wanted = "a name ending in .zip"});
  std::vector<HandedIn> files;
  for (const std::string& name : options.exercises) {
    const ExerciseInfo exercise = project.exercise(name);
    const auto isThis = [&](const HandedIn& file) { return file.exercise.name == exercise.name; };
    if (std::any_of(files.begin(), files.end(), isThis)) continue;
    try {
      files.push_back(handInOf(exercise));
    } catch (const Error& error) {
      note(wrap(error.what(), 2, 0));
      return ExitCode::kNotGradable;
    }
  }
  const AllProgress all = ProgressFile(project.root).read();
  const std::string receipt = receiptOf(files, all, options.progress);
  std::vector<submission::ZipEntry> entries;
  for (const HandedIn& file : files) entries.push_back({file.name, file.text});
  entries.push_back({"receipt.json", receipt});
  submission::writeZip(options.out, entries);
  for (const HandedIn& file : files) {
    sayLastTest(file, all);
    if (options.progress) sayWork(file, all);
    say(fmt::format("{}  {}", file.sha256, file.name));
  }
  say(fmt::format("{} holds {} and a receipt with the hash above (SHA-256). Hand this file in.",
                  shown(options.out), files.size() == 1 ? "this file" : "these files"));
  return ExitCode::kFull;
}

}  // namespace

void addSubmit(CLI::App* command, Action& action) {
  const auto options = std::make_shared<SubmitOptions>();
  command->footer(
      "Examples:\n  scripts/rex submit 01\n  scripts/rex submit 01 02 -o handin.zip\n\n"
      "The zip holds EXERCISE/main.cpp of each, nothing else of yours, and receipt.json with\n"
      "the SHA-256 hash of every file. With --progress, the receipt also says how long you\n"
      "worked on each exercise, and after how long its parts first passed.");
  command->add_option("EXERCISE", options->exercises, kExercisesHelp)->type_name("")->required();
  addOptions(command, {{"-o,--out", options->out, "FILE.zip", "file to write"},
                       {"--progress", options->progress, "also hand in how long you worked"}});
  command->callback(
      [&action, options] { action = [options](const Project& p) { return submit(p, *options); }; });
}

}  // namespace rex::cli
