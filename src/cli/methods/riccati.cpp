#include "control/riccati.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/text_file.h"
#include "cli/json_internal.h"
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

Json parsed(const std::string& text, const std::string& file) {
  try {
    return Json::parse(text);
  } catch (const Json::parse_error& error) {
    // The parser counts bytes from 1.
    const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(
                                        text.size(), error.byte > 0 ? error.byte - 1 : std::size_t{0}));
    const auto line = std::find(std::make_reverse_iterator(end), text.rend(), '\n').base();
    throw Error({.what = "not valid JSON",
                 .where = {file, static_cast<int>(1 + std::count(text.begin(), end, '\n')),
                           static_cast<int>(1 + (end - line))},
                 .wanted = "an object with the fields A, B, Q and R"});
  } catch (const Json::out_of_range&) {
    throw Error({.what = "JSON",
                 .where = {.file = file},
                 .found = "a number that is too large",
                 .wanted = "numbers below 1.8e308"});
  }
}

double numberOf(const Json& json, const std::string& what, const std::string& file) {
  if (json.is_number()) return json.get<double>();
  throw Error({.what = what,
               .where = {.file = file},
               .found = json.is_null() ? "null" : fmt::format("a value of type {}", json.type_name()),
               .wanted = "a number"});
}

Eigen::MatrixXd matrixOf(const Json& problem, const std::string& name, const std::string& file) {
  const auto complain = [&](const std::string& what, const std::string& found, const std::string& wanted) {
    throw Error({.what = what, .where = {.file = file}, .found = found, .wanted = wanted});
  };
  if (!problem.contains(name)) {
    // The names have one letter, so the only likely slip is the wrong case.
    const std::string small(1, static_cast<char>(std::tolower(name[0])));
    throw Error({.what = "matrix " + name,
                 .where = {.file = file},
                 .found = "no field with this name",
                 .wanted = "a list of rows",
                 .nearest = problem.contains(small) ? std::vector{small} : std::vector<std::string>{}});
  }
  const Json& rows = problem[name];
  if (rows.is_object() && rows.contains("re") && rows.contains("im"))
    complain("matrix " + name, "complex entries", "real ones");
  if (!rows.is_array() || rows.empty() || !rows[0].is_array())
    complain("matrix " + name, "no list of rows", "rows of numbers, such as [[1, 0], [0, 1]]");
  Eigen::MatrixXd M(rows.size(), rows[0].size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::string row = fmt::format("matrix {}, row {}", name, i + 1);
    if (!rows[i].is_array() || rows[i].size() != rows[0].size())
      complain(row, rows[i].is_array() ? fmt::format("{} numbers", rows[i].size()) : "no list of numbers",
               fmt::format("{} numbers, as in row 1", rows[0].size()));
    for (std::size_t k = 0; k < rows[i].size(); ++k)
      M(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) =
          numberOf(rows[i][k], fmt::format("{}, column {}", row, k + 1), file);
  }
  return M;
}

// For example S, a weight of products of state and control, which these equations do not have.
void noteUnused(const Json& problem, const std::string& file) {
  std::vector<std::string> unused;
  for (const auto& field : problem.items())
    if (const std::string& name = field.key(); name != "A" && name != "B" && name != "Q" && name != "R")
      unused.push_back(harmless(name));
  if (!unused.empty()) note(wrap(fmt::format("rex: {}: not used: {}", file, fmt::join(unused, ", ")), 2, 0));
}

RiccatiResult solved(const RiccatiOptions& options, const std::filesystem::path& path) {
  const std::string file = harmless(options.file.string());
  const Json problem = parsed(readTextFile(path), file);
  if (!problem.is_object())
    throw Error({.what = "Riccati equation",
                 .where = {.file = file},
                 .found = fmt::format("a JSON value of type {}", problem.type_name()),
                 .wanted = "an object with the fields A, B, Q and R"});
  const Eigen::MatrixXd A = matrixOf(problem, "A", file), B = matrixOf(problem, "B", file),
                        Q = matrixOf(problem, "Q", file), R = matrixOf(problem, "R", file);
  noteUnused(problem, file);
  try {
    return options.time == Time::kDiscrete ? solveDare(A, B, Q, R) : solveCare(A, B, Q, R);
  } catch (const Error& error) {
    ErrorParts parts = error.parts();
    parts.where = {.file = file};
    throw Error(std::move(parts));
  }
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

Json jsonOf(std::complex<double> value) { return Json::array({value.real(), value.imag()}); }

Json jsonOf(const RiccatiResult& result) {
  Json json{{"X", nullptr},
            {"K", nullptr},
            {"closed_loop_eigs", nullptr},
            {"residual", nullptr},
            {"status", nameOf(result.status)}};
  if (result.X.size() > 0) {
    json["X"] = jsonOfRows(result.X);
    json["K"] = jsonOfRows(result.K);
    json["closed_loop_eigs"] = Json::array();
    for (const std::complex<double> value : result.closedLoop)
      json["closed_loop_eigs"].push_back(jsonOf(value));
    json["residual"] = result.residual;
  }
  json["mode"] = result.mode ? jsonOf(*result.mode) : Json();
  json["message"] = result.message;
  return json;
}

std::string textOf(const char* name, const Eigen::MatrixXd& M) {
  std::ostringstream text;
  text << M.format(Eigen::IOFormat(8, 0, "  ", "\n", "  "));
  return fmt::format("{} =\n{}", name, text.str());
}

// Solves an algebraic Riccati equation. kBelow if it has no stabilizing solution.
ExitCode riccati(const Project& project, const RiccatiOptions& options) {
  const bool isExample =
      !std::filesystem::exists(options.file) && std::filesystem::exists(project.files() / options.file);
  const RiccatiResult result =
      asWrongUse([&] { return solved(options, isExample ? project.files() / options.file : options.file); });
  if (options.json)
    say(dump(jsonOf(result)));
  else {
    say(result.message);
    if (result.X.size() > 0) {
      say(textOf("X", result.X));
      say(textOf("K", result.K));
      say("eigenvalues of A - B K:");
      for (const std::complex<double> value : result.closedLoop)
        say(fmt::format("  {:.8g} {:+.8g}i", value.real(), value.imag()));
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
