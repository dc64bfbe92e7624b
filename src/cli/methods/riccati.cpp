#include "control/riccati.h"

#include <filesystem>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/json_internal.h"
#include "cli/methods/matrix_file_internal.h"
#include "cli/methods/methods_room_internal.h"
#include "cli/project.h"
#include "cli/terminal.h"
#include "cli/wrong_use_internal.h"

namespace rex::cli {
namespace {

enum class Time { kContinuous, kDiscrete };

struct RiccatiOptions {
  std::filesystem::path file{};  ///< an object with the fields A, B, Q and R, each a list of rows
  Time time{};
  bool json = false;
};

RiccatiResult solved(const RiccatiOptions& options, const std::filesystem::path& path) {
  const MatrixFile problem(path, options.file, {"A", "B", "Q", "R"});
  const Eigen::MatrixXd A = problem.matrix("A"), B = problem.matrix("B"), Q = problem.matrix("Q"),
                        R = problem.matrix("R");
  return problem.blamed(
      [&] { return options.time == Time::kDiscrete ? solveDare(A, B, Q, R) : solveCare(A, B, Q, R); });
}

const char* nameOf(RiccatiStatus status) {
  switch (status) {
    case RiccatiStatus::kSolved:
      return "solved";
    case RiccatiStatus::kNotStabilizable:
      return "not stabilizable";
    case RiccatiStatus::kNotDetectable:
      return "not detectable";
    case RiccatiStatus::kOnBoundary:
      return "on boundary";
    case RiccatiStatus::kFailed:
      return "failed";
  }
  return "";
}

Json jsonOf(const RiccatiResult& result) {
  Json json{{"X", nullptr},
            {"K", nullptr},
            {"closed_loop_eigs", nullptr},
            {"residual", nullptr},
            {"status", nameOf(result.status)}};
  if (result.X.size() > 0) {
    json["X"] = jsonOfRows(result.X);
    json["K"] = jsonOfRows(result.K);
    json["closed_loop_eigs"] = jsonOfComplex(result.closedLoop);
    json["residual"] = result.residual;
  }
  json["mode"] = result.mode ? Json::array({result.mode->real(), result.mode->imag()}) : Json();
  json["message"] = result.message;
  return json;
}

// Solves an algebraic Riccati equation. kBelow if it has no stabilizing solution.
ExitCode riccati(const Project& project, const RiccatiOptions& options) {
  const RiccatiResult result = asWrongUse([&] { return solved(options, inProject(project, options.file)); });
  if (options.json)
    say(dump(jsonOf(result)));
  else {
    say(result.message);
    if (result.X.size() > 0) {
      say(matrixText("X", result.X));
      say(matrixText("K", result.K));
      say("eigenvalues of A - B K:");
      sayComplex(result.closedLoop);
    }
  }
  return result.X.size() > 0 ? ExitCode::kFull : ExitCode::kBelow;
}

// The options that both commands share.
void addEquation(CLI::App* command, Action& action, Time time) {
  const auto options = std::make_shared<RiccatiOptions>();
  options->time = time;
  command
      ->add_option("file", options->file,
                   "{\"A\": [[...], ...], \"B\": ..., \"Q\": ..., \"R\": ...}, row by row")
      ->type_name("FILE.json")
      ->required();
  command->add_flag("--json", options->json, "print JSON");
  command->callback(
      [&action, options] { action = [options](const Project& p) { return riccati(p, *options); }; });
}

}  // namespace

void addCare(CLI::App* command, Action& action) {
  command->footer(
      "Example: scripts/rex care data/control/cart-pole.json --json\n\n"
      "Solves 0 = A^T X + X A - X B R^-1 B^T X + Q; the control is u = -K x with\n"
      "K = R^-1 B^T X. Exit code 1: there is no stabilizing solution; the message says why.");
  addEquation(command, action, Time::kContinuous);
}

void addDare(CLI::App* command, Action& action) {
  command->footer(
      "Example: scripts/rex dare data/control/cart-steps.json --json\n\n"
      "Solves X = A^T X A - A^T X B (R + B^T X B)^-1 B^T X A + Q; the control is u = -K x with\n"
      "K = (R + B^T X B)^-1 B^T X A. Exit code 1: there is no stabilizing solution; the message says why.");
  addEquation(command, action, Time::kDiscrete);
}

}  // namespace rex::cli
