#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "base/error.h"
#include "base/instant.h"
#include "base/text.h"
#include "base/text_file.h"
#include "classroom/download.h"
#include "classroom/importing.h"
#include "cli/command_line_internal.h"
#include "cli/command_table.h"
#include "cli/instructor/class_grades.h"
#include "cli/option_table_internal.h"
#include "cli/terminal.h"

namespace rex::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kImportCodes =
    "Exit codes: 0 all taken; 2 something was not, and is listed; 3 a file cannot be read or written;\n"
    "64 wrong use, or another layout than that of the platform.";

struct ImportOptions {
  fs::path source{};
  fs::path handedIn{};
  std::string exercise{};
};

using Read = std::function<classroom::DownloadedSubmissions(const fs::path& source,
                                                            const std::vector<ExerciseInfo>& exercises)>;

void requireApartFromSource(const ImportOptions& options) {
  if (!fs::exists(options.source))
    throw UsageError({.what = "no such file or folder", .where = {options.source.string()}});
  requireApart("--out", options.handedIn, options.source);
}

// A course folder brings the files of all exercises, most of them untouched.
std::map<std::string, std::string> handedOutTexts(const std::vector<ExerciseInfo>& exercises) {
  std::map<std::string, std::string> texts;
  for (const ExerciseInfo& exercise : exercises)
    for (const fs::path& folder : {exercise.definition, exercise.folder})
      if (fs::exists(folder / "main.cpp") && !texts.contains(exercise.name))
        texts[exercise.name] = readTextFile(folder / "main.cpp");
  return texts;
}

void list(const char* heading, const std::vector<std::string>& lines) {
  if (lines.empty()) return;
  note(fmt::format("{} ({}):", heading, lines.size()));
  for (const std::string& line : lines) note("  " + wrap(escapeForTerminal(line), 4, 4));
}

std::string timesOf(const classroom::ImportReport& report) {
  std::vector<std::string> parts;
  const auto add = [&](int count, const char* from) {
    if (count > 0) parts.push_back(fmt::format("{} {}", count, from));
  };
  add(report.timesOfPlatform, "from the platform"),
      add(report.timesOfGit, "from commits (the student's clock)");
  add(report.timesOfFiles, "from files, which is when they were packed or copied"),
      add(report.withoutTime, "unknown");
  return join(parts, ", ");
}

void tell(const classroom::ImportReport& report, const ImportOptions& options) {
  list("Not taken", report.complaints);
  list("Taken, but to be looked at", report.doubts);
  list("Noted", report.notes);
  list("Changed since an earlier import", report.changes);
  say(fmt::format("{} handed in, {} nothing, {} not taken. Files: {} new, {} changed, {} as before.",
                  report.handedIn, report.missing, report.rejected, report.added, report.changed,
                  report.same));
  if (report.handedIn > 0) say("Times of submission: " + timesOf(report) + ".");
  say(fmt::format("Table: {}", shown(options.handedIn / classroom::kImportTable)));
}

ExitCode import(const Project& project, const ImportOptions& options, const Read& read) {
  requireApartFromSource(options);
  const std::vector<ExerciseInfo> exercises = project.exercises();
  classroom::PickOptions pick{.exercises = exercises};
  if (!options.exercise.empty()) pick.exercise = project.exercise(options.exercise).name;
  const classroom::DownloadedSubmissions submissions = read(options.source, exercises);
  if (submissions.platform == classroom::Platform::kGit) pick.handedOut = handedOutTexts(exercises);
  const classroom::ImportReport report = classroom::importSubmissions(submissions, pick, options.handedIn);
  tell(report, options);
  return report.complaints.empty() ? ExitCode::kFull : ExitCode::kNotGradable;
}

std::shared_ptr<ImportOptions> addCommon(CLI::App* command, const char* source) {
  const auto options = std::make_shared<ImportOptions>();
  addOptions(command, {OptionRow("SOURCE", options->source, "", source).required(),
                       OptionRow("-o,--out", options->handedIn, "HANDED_IN",
                                 "folder of submissions for `rex grade`; new, or of earlier imports")
                           .required(),
                       {"--exercise", options->exercise, "EXERCISE",
                        "take this one, also from files outside of exercise folders"}});
  return options;
}

void setAction(CLI::App* command, Action& action, std::shared_ptr<ImportOptions> options, Read read) {
  command->callback([&action, options, read] {
    action = [options, read](const Project& p) { return import(p, *options, read); };
  });
}

void addMoodle(CLI::App* all, Action& action) {
  CLI::App* command =
      addVerb(all, "moodle", "From the zip of \"Download all submissions\" of a Moodle assignment",
              "Example:\n  scripts/rex import moodle download.zip -o handed-in --exercise 01 \\\n"
              "    --worksheet Grades-Robotics-501.csv --time-zone Europe/Berlin\n\n"
              "The worksheet tells addresses and times of submission; without it, names are all there is.\n" +
                  std::string(kImportCodes));
  const auto options = addCommon(command, "the zip, or the folder it was unpacked into");
  const auto moodle = std::make_shared<classroom::MoodleOptions>();
  addOptions(command, {{"--worksheet", moodle->worksheet, "FILE.csv",
                        "\"Download grading worksheet\" of the same assignment"},
                       {"--time-zone", moodle->timeZone, "ZONE",
                        "zone of the times in the worksheet: Europe/Berlin, +01:00"}});
  setAction(command, action, options, [moodle](const auto& source, const auto& exercises) {
    return classroom::readMoodle(source, *moodle, exercises);
  });
}

void addGit(CLI::App* all, Action& action) {
  struct Words {
    classroom::CloneOptions options{};
    std::string deadline{};
  };
  CLI::App* command = addVerb(
      all, "git", "From a folder with clones of the students' repositories",
      "Example:\n  scripts/rex import git kinematics-submissions -o handed-in \\\n"
      "    --roster roster.csv --record record.csv\n\n"
      "The record says when a repository was handed in, and perhaps which commit. Without it, the dates of\n"
      "commits count, which students can set.\n" +
          std::string(kImportCodes));
  const auto options = addCommon(command, "folder of clones: ASSIGNMENT-STUDENT with a course inside");
  const auto words = std::make_shared<Words>();
  addOptions(command,
             {{"--roster", words->options.roster, "FILE.csv", "who is who: identifier, username, name"},
              {"--record", words->options.record, "FILE.csv",
               "when what was handed in: repository, username, submitted, perhaps commit"},
              {"--time-zone", words->options.timeZone, "ZONE",
               "zone of times in the record that have none: Europe/Berlin, +01:00"},
              {"--assignment", words->options.assignment, "NAME", "what the names of all clones begin with"},
              {"--deadline", words->deadline, "TIME",
               "take the last commit until then: 2026-11-20T23:59:00+01:00"}});
  setAction(command, action, options, [words](const auto& source, const auto& exercises) {
    if (!words->deadline.empty()) {
      words->options.deadline = parseInstant(words->deadline);
      if (!words->options.deadline)
        throw UsageError({.what = "--deadline",
                          .found = words->deadline,
                          .wanted = "a time with its zone, such as 2026-11-20T23:59:00+01:00"});
    }
    return classroom::readClones(source, words->options, exercises);
  });
}

void addGradescope(CLI::App* all, Action& action) {
  CLI::App* command =
      addVerb(all, "gradescope", "From the zip of \"Export Submissions\" of a Gradescope assignment",
              "Example: scripts/rex import gradescope assignment_export.zip -o handed-in --exercise 01\n\n"
              "Groups hand in once: all members get that grade.\n" +
                  std::string(kImportCodes));
  setAction(command, action, addCommon(command, "the zip, or the folder it was unpacked into"),
            classroom::readGradescope);
}

void addFolders(CLI::App* all, Action& action) {
  CLI::App* command = addVerb(
      all, "folders", "From files of students: NAME/main.cpp, NAME.cpp or NAME.zip",
      "Example: scripts/rex import folders mails -o handed-in --exercise 01\n\n" + std::string(kImportCodes));
  setAction(command, action, addCommon(command, "the folder, or an archive of it"), classroom::readFolders);
}

}  // namespace

void addImport(CLI::App* all, Action& action) {
  all->footer(
      "Examples:\n  scripts/rex import moodle download.zip -o handed-in --exercise 01\n"
      "  scripts/rex import git kinematics-submissions -o handed-in\n"
      "  scripts/rex grade handed-in --out results\n\n"
      "A later import into the same folder updates it and says what has changed.");
  all->require_subcommand(0, 1);
  all->callback([&action, all] {
    if (all->get_subcommands().empty()) action = print(all->help("rex"));
  });
  addMoodle(all, action), addGit(all, action);
  addGradescope(all, action), addFolders(all, action);
}

}  // namespace rex::cli
