#include "reports/report.h"

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include "base/text_file.h"
#include "cli/report_format.h"
#include "cli/student/student_room_internal.h"
#include "grading/result_file.h"

namespace rex::cli {
namespace {

struct ReportOptions {
  std::filesystem::path results;
  std::string format;         ///< a name of grading::reportFormats()
  std::filesystem::path out;  ///< empty: the standard output
};

// Converts a result file to the format of another program. kGraderFault if the result is a grader fault.
ExitCode report(const ReportOptions& options) {
  const grading::ReportFormat& format = reportFormat(options.format, "--format");
  const grading::GradeResult result = grading::loadSoundResult(options.results);
  const std::string text = format.write(result);
  if (options.out.empty())
    std::fputs(text.c_str(), stdout);
  else
    replaceTextFile(options.out, text, "the report");
  return result.outcome == grading::Outcome::kGraderError ? ExitCode::kGraderFault : ExitCode::kFull;
}

}  // namespace

void addReport(CLI::App* command, Action& action) {
  const auto options = std::make_shared<ReportOptions>();
  command->footer(
      "Examples:\n  scripts/rex report out/01-kinematics/results.json --format markdown\n"
      "  scripts/rex report results.json --format gradescope -o results/results.json\n\n"
      "Formats: github (annotations), gradescope, junit, markdown.\n"
      "Exit code 0: written, whatever the grade; 3: written, but the grader had failed.");
  command->add_option("RESULTS", options->results, "a result file that rex test left")
      ->type_name("")
      ->required();
  command->add_option("--format", options->format, "format to write")->type_name("NAME")->required();
  command->add_option("-o,--out", options->out, "file to write (default: print)")->type_name("FILE");
  command->callback([&action, options] { action = [options](const Project&) { return report(*options); }; });
}

}  // namespace rex::cli
