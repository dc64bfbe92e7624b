#include <algorithm>
#include <cstdio>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "base/error.h"
#include "base/folders.h"
#include "base/text.h"
#include "base/text_file.h"
#include "classroom/gradebook_text.h"
#include "classroom/platform_grades.h"
#include "classroom/tutors.h"
#include "cli/command_line_internal.h"
#include "cli/command_table.h"
#include "cli/instructor/class_grades.h"
#include "cli/instructor/grading_options_internal.h"
#include "cli/option_table_internal.h"
#include "cli/out_folder.h"
#include "cli/terminal.h"
#include "submission/zip_file.h"

namespace rex::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFeedbackZip = "feedback.zip";
constexpr const char* kExportCodes =
    "Exit codes: 0 written; 2 written, but somebody was left out or has more points than the platform "
    "takes,\n"
    "who is named; 3 a file is broken; 64 wrong use.";

struct ExportOptions {
  fs::path results{};
  fs::path out{};
  ClassFiles files{};
  std::string exercise{};  ///< empty: all
  fs::path worksheet{};    ///< of Moodle; empty: none
  bool scale = false;
  std::string tutor{};  ///< only this one's share; empty: everybody
  bool blind = false;   ///< ids without names
};

/// What all exports are made of.
struct Export {
  classroom::Course course{};
  classroom::Gradebook book{};
  classroom::ImportTable imported{};
  ExitCode roster = ExitCode::kFull;
};

Export read(const Project& project, const ExportOptions& options) {
  const classroom::ClassRun run = runIn(options.results);
  const std::string only = options.exercise.empty() ? "" : project.exercise(options.exercise).name;
  const classroom::GradebookSource source = readGradebookSource(project, options.files, run, only);
  Export all{.course = source.course, .imported = source.imported, .roster = tellRoster(source.course)};
  all.book = classroom::makeGradebook(run, source);
  if (all.book.rows.empty())
    throw UsageError({.what = "nothing to export",
                      .where = {options.results.string()},
                      .found = only.empty() ? "no grades" : "no grades for " + only,
                      .wanted = "an exercise that was handed in and graded"});
  for (const std::string& sentence : all.book.notes) note(wrap(escapeForTerminal(sentence), 2, 0));
  if (all.book.conflicts > 0) all.roster = ExitCode::kNotGradable;
  return all;
}

// The rows of the students of a tutor; a note names the students of nobody.
void keepShare(Export& all, const std::string& name) {
  std::vector<std::string> known, nobodys;
  for (const classroom::Tutor& tutor : all.course.tutors) known.push_back(tutor.name);
  if (std::find(known.begin(), known.end(), name) == known.end())
    throw UsageError({.what = "--tutor",
                      .found = "'" + escapeForTerminal(name) + "'",
                      .wanted = known.empty() ? "tables [[tutor]] in the course file" : join(known, ", "),
                      .nearest = nearestNames(name, known)});
  classroom::Course everyone = all.book.everyone();
  everyone.tutors = all.course.tutors;
  const auto shares = classroom::tutorShares(everyone);
  for (const classroom::CourseStudent& student : everyone.students)
    if (!shares.contains(student.id)) nobodys.push_back(student.id);
  if (!nobodys.empty())
    note(wrap(escapeForTerminal(fmt::format("in nobody's share: {}", join(nobodys, ", "))), 2, 0));
  std::erase_if(all.book.rows, [&](const classroom::GradeRow& row) {
    const auto tutor = shares.find(row.student.id);
    return tutor == shares.end() || tutor->second != name;
  });
}

void makeBlind(Export& all) {
  if (all.course.settings.secret.empty())
    throw UsageError({.what = "--blind",
                      .found = "no secret of the course",
                      .wanted = "secret_file in the course file, which leads from these ids to students"});
  const std::string secret = classroom::classSecret(all.course.settings.secret);
  for (classroom::GradeRow& row : all.book.rows)
    row.student = {.id = classroom::blindId(secret, row.student.id)};
}

// In the results, a folder could be taken for a student, and feedback for a result.
void makePlace(const ExportOptions& options) {
  if (isBelow(fs::weakly_canonical(options.results), fs::weakly_canonical(options.out)))
    throw UsageError(
        {.what = "--out", .found = options.out.string(), .wanted = "a folder outside of the results"});
  makeOutFolder(options.out);
  removeLeftovers(options.out);
}

ExitCode told(const std::vector<std::string>& notes, ExitCode roster) {
  for (const std::string& sentence : notes) note(wrap(escapeForTerminal(sentence), 2, 0));
  return notes.empty() ? roster : ExitCode::kNotGradable;
}

ExitCode exportTable(const Project& project, const ExportOptions& options,
                     classroom::PlatformGrades (*platform)(const classroom::Gradebook&)) {
  const Export all = read(project, options);
  const classroom::PlatformGrades grades = platform(all.book);
  makePlace(options);
  const fs::path file = options.out / "grades.csv";
  replaceTextFile(file, grades.csv, "the table of grades");
  say(fmt::format("Grades: {}", shown(file)));
  return told(grades.notes, all.roster);
}

ExitCode exportGradescope(const Project& project, const ExportOptions& options) {
  return exportTable(project, options, classroom::gradescopeGrades);
}

ExitCode exportCanvas(const Project& project, const ExportOptions& options) {
  return exportTable(project, options, classroom::canvasGrades);
}

ExitCode exportJson(const Project& project, const ExportOptions& options) {
  const Export all = read(project, options);
  const std::string text = classroom::gradesJson(all.book, all.course);
  if (options.out.empty()) {
    std::fputs(text.c_str(), stdout);
    return all.roster;
  }
  replaceTextFile(options.out, text, "the grades");
  say(fmt::format("Grades: {}", shown(options.out)));
  return all.roster;
}

ExitCode exportHtml(const Project& project, const ExportOptions& options) {
  Export all = read(project, options);
  if (!options.tutor.empty()) keepShare(all, options.tutor);
  if (options.blind) makeBlind(all);
  makePlace(options);
  const int written = classroom::writeFeedbackFolders(all.book, options.results, options.out);
  say(fmt::format("Feedback: {} pages in {}", written, shown(options.out)));
  return all.roster;
}

void addFeedback(const Export& all, const ExportOptions& options, const std::string& exercise,
                 const classroom::WorksheetRow& row, std::vector<submission::ZipEntry>& entries) {
  const classroom::GradeRow* graded = all.book.row(row.student, exercise);
  const auto feedback = graded == nullptr ? std::nullopt : classroom::rowFeedback(*graded, options.results);
  if (!feedback) return;
  const std::string folder = classroom::moodleFolder(row);
  const auto files = classroom::evidenceFiles(*graded, options.results);
  entries.push_back({folder + "/feedback.html", reports::feedbackPage(*feedback, files)});
  for (const reports::FeedbackFile& file : files)
    if (!file.name.ends_with(".png")) entries.push_back({folder + "/" + file.name, file.bytes});
}

ExitCode exportMoodle(const Project& project, const ExportOptions& options) {
  const Export all = read(project, options);
  const std::string exercise = project.exercise(options.exercise).name;
  makePlace(options);
  std::vector<std::string> notes;
  std::vector<classroom::WorksheetRow> rows;
  if (options.worksheet.empty()) {
    rows = classroom::moodleStudents(all.book, exercise, all.imported);
    notes.emplace_back("no grades are written without --worksheet, the grading worksheet of this assignment");
  } else {
    const classroom::Worksheet sheet =
        classroom::moodleGrades(options.worksheet, all.book, exercise, all.imported, options.scale);
    replaceTextFile(options.out / "grades.csv", sheet.csv, "the grading worksheet");
    say(fmt::format("Grades: {}", shown(options.out / "grades.csv")));
    rows = sheet.rows;
    notes = sheet.notes;
  }
  std::vector<submission::ZipEntry> entries;
  for (const classroom::WorksheetRow& row : rows)
    if (!row.student.empty() && !row.number.empty()) addFeedback(all, options, exercise, row, entries);
  if (entries.empty()) {
    fs::remove(options.out / kFeedbackZip);  // of an earlier export
    notes.emplace_back("no feedback is written: nobody's number in Moodle is known");
  } else {
    submission::writeZip(options.out / kFeedbackZip, entries);
    say(fmt::format("Feedback: {}", shown(options.out / kFeedbackZip)));
  }
  return told(notes, all.roster);
}

using Exporter = ExitCode (*)(const Project&, const ExportOptions&);

CLI::App* addTarget(CLI::App* all, Action& action, const std::string& name, const std::string& purpose,
                    const std::string& example, Exporter exporter, std::shared_ptr<ExportOptions> options) {
  CLI::App* command =
      addVerb(all, name, purpose, "Example: scripts/rex export " + example + "\n\n" + kExportCodes);
  const bool isJson = name == "json", isMoodle = name == "moodle";
  const auto added = addOptions(
      command,
      {OptionRow("RESULTS", options->results, "", "the folder of results that rex grade wrote").required(),
       {"-o,--out", options->out, isJson ? "FILE" : "DIR",
        isJson ? "file to write (default: print)" : "folder to write"}});
  added[1]->required(!isJson);
  addClassFiles(command, options->files);
  addOptions(command, {{"EXERCISE", options->exercise, "",
                        isMoodle ? "the exercise of this assignment" : "only this exercise (default: all)"}})
      .front()
      ->required(isMoodle);
  command->callback([&action, options, exporter] {
    action = [options, exporter](const Project& p) { return exporter(p, *options); };
  });
  return command;
}

}  // namespace

void addExport(CLI::App* all, Action& action) {
  all->footer(
      "Examples:\n  scripts/rex export html results --course course.toml -o feedback\n"
      "  scripts/rex export moodle results 01 --worksheet grades.csv --course course.toml -o moodle\n\n"
      "What students get shows nothing of other students, and of hidden checks only points.");
  all->require_subcommand(0, 1);
  all->callback([&action, all] {
    if (all->get_subcommands().empty()) action = print(all->help("rex"));
  });
  const auto options = [] { return std::make_shared<ExportOptions>(); };
  const auto moodle = options();
  CLI::App* command = addTarget(
      all, action, "moodle", "The grading worksheet filled in, and a zip of feedback",
      "moodle results 01 --worksheet grades.csv --course course.toml -o moodle", exportMoodle, moodle);
  addOptions(command, {{"--worksheet", moodle->worksheet, "FILE.csv",
                        "grading worksheet that was downloaded from Moodle"},
                       {"--scale", moodle->scale, "scale points to the maximum grade of the worksheet"}});
  addTarget(all, action, "gradescope", "Grades by SID and e-mail",
            "gradescope results --course course.toml -o grades", exportGradescope, options());
  addTarget(all, action, "canvas", "Grades for the grade book of Canvas",
            "canvas results --course course.toml -o grades", exportCanvas, options());
  addTarget(all, action, "json", "All grades for programs",
            "json results --course course.toml -o grades.json", exportJson, options());
  const auto html = options();
  CLI::App* pages = addTarget(all, action, "html", "A page of feedback per student and exercise",
                              "html results --course course.toml -o feedback", exportHtml, html);
  addOptions(pages, {{"--tutor", html->tutor, "NAME", "only the share of this tutor of the course"},
                     {"--blind", html->blind, "ids without names, which adjustments may use"}});
}

}  // namespace rex::cli
