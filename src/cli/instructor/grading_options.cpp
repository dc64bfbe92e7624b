#include "cli/instructor/grading_options_internal.h"

namespace rex::cli {

CLI::Option* addDeadlines(CLI::App* command, std::filesystem::path& file) {
  return command
      ->add_option("--deadlines", file, "deadlines, grace and late penalties (share/doc/grading.md)")
      ->type_name("FILE.toml");
}

void addClassFiles(CLI::App* command, ClassFiles& files) {
  CLI::Option* course =
      command->add_option("--course", files.course, "roster, dates and weights (share/doc/grading.md)")
          ->type_name("FILE.toml");
  addDeadlines(command, files.deadlines)->excludes(course);
  command
      ->add_option("--adjustments", files.adjustments,
                   "points and comments by people (default: those that the course names)")
      ->type_name("FILE.toml");
}

void addSecret(CLI::App* command, std::filesystem::path& file) {
  command->add_option("--secret-file", file, "secret of the course, for the seeds of hidden checks")
      ->type_name("FILE");
}

// `--report` alone, or `--report=junit,markdown`.
void addReport(CLI::App* command, std::string& reports) {
  command
      ->add_flag("--report{markdown}", reports,
                 "write reports beside each result: --report=markdown,junit (alone: markdown)")
      ->type_name("");
}

void addExplain(CLI::App* command, std::vector<std::string>& explain) {
  command->add_option("--explain", explain, "only print how this grade came about")
      ->expected(2)
      ->type_name("STUDENT EXERCISE");
}

void addResults(CLI::App* command, std::filesystem::path& out) {
  command->add_option("-o,--out", out, "folder for STUDENT/EXERCISE/results.json and grades.csv")
      ->type_name("DIR");
}

}  // namespace rex::cli
