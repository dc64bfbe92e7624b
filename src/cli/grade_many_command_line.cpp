// The commands of the instructor's desk.
#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include "cli/grade_many.h"
#include "cli/grade_many_command_line_internal.h"

namespace rex::cli {
namespace {

constexpr const char* kCodes =
    "Exit codes: 0 graded, whatever the grades; 2 something could not be taken; 3 a grading must be\n"
    "repeated; 4 the sandbox is weaker than required; 64 wrong use.";

void addDeadlines(CLI::App* command, std::filesystem::path& file) {
  command
      ->add_option("--deadlines", file, "deadlines, grace, what lateness costs (share/doc/grading-many.md)")
      ->type_name("FILE.toml");
}

void addSecret(CLI::App* command, std::filesystem::path& file) {
  command->add_option("--secret-file", file, "secret of the course, for the seeds of hidden checks")
      ->type_name("FILE");
}

// `--reports` alone, or `--reports=junit,markdown`.
void addReports(CLI::App* command, std::string& reports) {
  command
      ->add_flag("--reports{markdown}", reports,
                 "write reports beside each result: --reports=markdown,junit (alone: markdown)")
      ->type_name("");
}

void addEvidence(CLI::App* command, bool& evidence) {
  command->add_flag("--evidence", evidence, "keep pictures and replays of visible checks that do not hold");
}

void addWorkers(CLI::App* command, std::filesystem::path& folder) {
  command
      ->add_option("--workers", folder,
                   "keep compiled programs here: the same file with another seed is not compiled again")
      ->type_name("DIR");
}

void addOut(CLI::App* command, std::filesystem::path& out) {
  command->add_option("-o,--out", out, "folder for STUDENT/EXERCISE/results.json and grades.csv")
      ->type_name("DIR")
      ->required();
}

void addGrade(CLI::App& program, Action& action) {
  const auto options = std::make_shared<GradeManyOptions>();
  CLI::App* command =
      add(program, "grade", "Grade what many students handed in",
          "Examples:\n  scripts/rex grade handed-in --out results -j8\n"
          "  scripts/rex grade handed-in --out results --deadlines deadlines.toml --csv\n"
          "  scripts/rex grade handed-in --out results --reports=markdown,junit --evidence\n\n"
          "DIR holds STUDENT/EXERCISE/main.cpp. A second run grades only what has changed.\n" +
              std::string(kCodes));
  command->add_option("DIR", options->folder, "what was handed in")->type_name("")->required();
  addOut(command, options->out);
  command->add_option("-j,--jobs", options->jobs, "gradings at once (default: one per processor)")
      ->check(CLI::Range(1, 1024).description(""))
      ->type_name("N");
  command->add_option("--level", options->level, "sandbox level (default: the best that holds here)")
      ->check(CLI::Range(0, 3).description(""))
      ->type_name("N");
  command->add_option("--i-accept-level", options->accept, "also grade at this weak level: 0 or 1")
      ->check(CLI::Range(0, 1).description(""))
      ->type_name("N");
  command->add_option("--seed", options->seed, "of the random cases")->type_name("N");
  addSecret(command, options->secret);
  addWorkers(command, options->workers);
  command->add_option("--only", options->only, "only this exercise")->type_name("EXERCISE");
  addDeadlines(command, options->deadlines);
  command
      ->add_option("--submitted", options->submitted,
                   "times of submission: columns student, submitted, exercise (default: times of the files)")
      ->type_name("FILE.csv");
  command->add_option("--manifest", options->manifest, "write the list of tasks, grade nothing")
      ->type_name("FILE.tsv");
  command->add_flag("--regrade", options->regrade, "also what has a valid result");
  command->add_flag("--csv", options->csv, "print the table of grades");
  addReports(command, options->reports), addEvidence(command, options->evidence);
  command->callback(
      [&action, options] { action = [options](const Project& p) { return gradeMany(p, *options); }; });
}

void addGradeOne(CLI::App& program, Action& action) {
  const auto options = std::make_shared<GradeOneOptions>();
  CLI::App* command = add(
      program, "grade-one", "Grade one line of a list of tasks, unless that is done",
      "Example: scripts/rex grade-one --manifest tasks.tsv --task 7 --out results\n\n" + std::string(kCodes));
  command->add_option("--manifest", options->manifest, "what `rex grade --manifest` wrote")
      ->type_name("FILE.tsv")
      ->required();
  command->add_option("--task", options->task, "its number, from 1")->type_name("K")->required();
  addOut(command, options->out);
  addSecret(command, options->secret), addEvidence(command, options->evidence);
  addWorkers(command, options->workers);
  command->callback(
      [&action, options] { action = [options](const Project& p) { return gradeOne(p, *options); }; });
}

void addCollect(CLI::App& program, Action& action) {
  const auto options = std::make_shared<CollectOptions>();
  CLI::App* command =
      add(program, "collect", "Make the table of grades, name the tasks that are missing",
          "Example: scripts/rex collect results --manifest tasks.tsv\n\n" + std::string(kCodes));
  command->add_option("DIR", options->out, "the folder of results")->type_name("")->required();
  command->add_option("--manifest", options->manifest, "the list of tasks (default: DIR/tasks.tsv)")
      ->type_name("FILE.tsv");
  addDeadlines(command, options->deadlines);
  command->add_flag("--csv", options->csv, "print the table of grades");
  addReports(command, options->reports);
  command->callback(
      [&action, options] { action = [options](const Project& p) { return collectResults(p, *options); }; });
}

}  // namespace

void addGradeMany(CLI::App& program, Action& action) {
  addGrade(program, action), addGradeOne(program, action), addCollect(program, action);
}

}  // namespace rex::cli
