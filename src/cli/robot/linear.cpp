#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <numbers>
#include <optional>
#include <span>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"
#include "base/text_file.h"
#include "cli/command_table.h"
#include "cli/numbers.h"
#include "cli/option_table_internal.h"
#include "cli/out_folder.h"
#include "cli/project.h"
#include "cli/results_internal.h"
#include "cli/terminal.h"
#include "control/controllability.h"
#include "control/regulators.h"
#include "control/responses.h"
#include "control/riccati.h"
#include "control/stability.h"
#include "render/figure_builders.h"

// `rex linear`: what chapter 8 says about a linear system, with Bode and Nyquist plots.

namespace rex::cli {
namespace {

/// A JSON object whose fields are matrices, each a list of rows. All errors name the file.
class MatrixFile {
 public:
  /// Reads it, and notes on stderr which fields are not among `known`. `given`: the name for messages. Throws
  /// Error unless it holds a JSON object.
  MatrixFile(const std::filesystem::path& path, const std::filesystem::path& given,
             const std::vector<std::string>& known);

  [[nodiscard]] bool has(const std::string& name) const { return object_.contains(name); }
  /// Throws Error if it is not there, or is not a list of rows of as many numbers.
  [[nodiscard]] Eigen::MatrixXd matrix(const std::string& name) const;
  [[nodiscard]] double number(const std::string& name) const;

  /// What `attempt` returns. An Error that it throws gets the name of the file.
  template <class Attempt>
  auto blamed(const Attempt& attempt) const {
    try {
      return attempt();
    } catch (const Error& error) {
      ErrorParts parts = error.parts();
      parts.where = {.file = file_};
      throw Error(std::move(parts));
    }
  }

 private:
  [[nodiscard]] Error wrong(const std::string& what, const std::string& found,
                            const std::string& wanted) const;
  [[nodiscard]] double numberOf(const Json& json, const std::string& what) const;

  std::string file_;
  Json object_;
};

// "A, B and C".
std::string listedNames(const std::vector<std::string>& names) {
  return fmt::format("{} and {}", join(std::span(names).first(names.size() - 1), ", "), names.back());
}

Json parsedObject(const std::string& text, const std::string& file, const std::string& wanted) {
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
                 .wanted = wanted});
  } catch (const Json::out_of_range&) {
    throw Error({.what = "JSON",
                 .where = {.file = file},
                 .found = "a number that is too large",
                 .wanted = "numbers below 1.8e308"});
  }
}

MatrixFile::MatrixFile(const std::filesystem::path& path, const std::filesystem::path& given,
                       const std::vector<std::string>& known)
    : file_(escapeForTerminal(given.string())) {
  const std::string wanted = "an object with the fields " + listedNames(known);
  object_ = parsedObject(readTextFile(path), file_, wanted);
  if (!object_.is_object())
    throw wrong("matrices", fmt::format("a JSON value of type {}", object_.type_name()), wanted);
  std::vector<std::string> unused;
  for (const auto& field : object_.items())
    if (std::find(known.begin(), known.end(), field.key()) == known.end())
      unused.push_back(escapeForTerminal(field.key()));
  if (!unused.empty()) note(wrap(fmt::format("rex: {}: not used: {}", file_, join(unused, ", ")), 2, 0));
}

Error MatrixFile::wrong(const std::string& what, const std::string& found, const std::string& wanted) const {
  return Error({.what = what, .where = {.file = file_}, .found = found, .wanted = wanted});
}

double MatrixFile::numberOf(const Json& json, const std::string& what) const {
  if (json.is_number()) return json.get<double>();
  throw wrong(what, json.is_null() ? "null" : fmt::format("a value of type {}", json.type_name()),
              "a number");
}

double MatrixFile::number(const std::string& name) const { return numberOf(object_[name], name); }

Eigen::MatrixXd MatrixFile::matrix(const std::string& name) const {
  if (!object_.contains(name)) {
    // The names have one letter, so the only likely slip is the wrong case.
    const std::string small(1, static_cast<char>(std::tolower(name[0])));
    throw Error({.what = "matrix " + name,
                 .where = {.file = file_},
                 .found = "no field with this name",
                 .wanted = "a list of rows",
                 .nearest = object_.contains(small) ? std::vector{small} : std::vector<std::string>{}});
  }
  const Json& rows = object_[name];
  if (rows.is_object() && rows.contains("re") && rows.contains("im"))
    throw wrong("matrix " + name, "complex entries", "real ones");
  if (!rows.is_array() || rows.empty() || !rows[0].is_array())
    throw wrong("matrix " + name, "no list of rows", "rows of numbers, such as [[1, 0], [0, 1]]");
  Eigen::MatrixXd M(rows.size(), rows[0].size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::string row = fmt::format("matrix {}, row {}", name, i + 1);
    if (!rows[i].is_array() || rows[i].size() != rows[0].size())
      throw wrong(row, rows[i].is_array() ? fmt::format("{} numbers", rows[i].size()) : "no list of numbers",
                  fmt::format("{} numbers, as in row 1", rows[0].size()));
    for (std::size_t k = 0; k < rows[i].size(); ++k)
      M(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) =
          numberOf(rows[i][k], fmt::format("{}, column {}", row, k + 1));
  }
  return M;
}

// The file, or that of the project if there is none here: an example.
std::filesystem::path inProject(const Project& project, const std::filesystem::path& file) {
  const bool isExample = !std::filesystem::exists(file) && std::filesystem::exists(project.files() / file);
  return isExample ? project.files() / file : file;
}

namespace fs = std::filesystem;

struct LinearOptions {
  fs::path file{};
  fs::path out{};  ///< a folder for figures; empty: none
  int input = 1, output = 1;
  bool json = false;
};

// What the file asks for; empty where it has no weights or no noise.
struct Findings {
  LinearSystem system{};
  StabilityResult stability{};
  ReachableStates controllable{}, observable{};
  std::optional<RiccatiResult> regulator{};
  std::optional<SteadyKalman> filter{};
  std::optional<Lqg> lqg{};
  // With the regulator, from a disturbance of u to y, and the loop when it is cut at u.
  std::optional<LinearSystem> closed{}, loop{};
};

Eigen::VectorXcd polesOf(const LinearSystem& system) {
  return Eigen::EigenSolver<Eigen::MatrixXd>(system.A, false).eigenvalues();
}

// From u through the system and the controller to -u.
LinearSystem loopThrough(const LinearSystem& system, const LinearSystem& controller) {
  const Eigen::Index n = system.A.rows(), k = controller.A.rows();
  LinearSystem loop{.A = Eigen::MatrixXd::Zero(n + k, n + k), .step = system.step};
  loop.A.topLeftCorner(n, n) = system.A;
  loop.A.bottomLeftCorner(k, n) = controller.B * system.C;
  loop.A.bottomRightCorner(k, k) = controller.A;
  loop.B.resize(n + k, system.B.cols());
  loop.B << system.B, controller.B * system.D;
  loop.C.setZero(controller.C.rows(), n + k);
  loop.C.rightCols(k) = -controller.C;
  return loop;
}

Findings findingsOf(const MatrixFile& file) {
  Findings f;
  f.system = {.A = file.matrix("A"), .B = file.matrix("B")};
  if (file.has("C")) f.system.C = file.matrix("C");
  if (file.has("D")) f.system.D = file.matrix("D");
  if (file.has("step")) f.system.step = file.number("step");
  f.system = completed(f.system);
  f.stability = f.system.step ? discreteStability(f.system.A) : continuousStability(f.system.A);
  f.controllable = controllability(f.system);
  f.observable = observability(f.system);
  const bool hasWeights = file.has("Q") || file.has("R"), hasNoise = file.has("W") || file.has("V");
  // The equation may have a solution although Q has a negative eigenvalue, so not by lqr().
  if (hasWeights) {
    const Eigen::MatrixXd Q = file.matrix("Q"), R = file.matrix("R");
    f.regulator =
        f.system.step ? solveDare(f.system.A, f.system.B, Q, R) : solveCare(f.system.A, f.system.B, Q, R);
  }
  if (hasNoise) f.filter = steadyKalman(f.system, file.matrix("W"), file.matrix("V"));
  if (hasWeights && hasNoise)
    f.lqg = lqg(f.system, file.matrix("Q"), file.matrix("R"), file.matrix("W"), file.matrix("V"));
  if (f.lqg && f.lqg->status == RiccatiStatus::kSolved) {
    f.closed = closedLoop(f.system, f.lqg->controller);
    f.loop = loopThrough(f.system, f.lqg->controller);
  } else if (f.regulator && f.regulator->K.size() > 0) {
    const Eigen::MatrixXd& K = f.regulator->K;
    f.closed = f.system;
    f.closed->A -= f.system.B * K;
    f.closed->C -= f.system.D * K;
    f.loop = {.A = f.system.A, .B = f.system.B, .C = K, .step = f.system.step};
  }
  return f;
}

// A hundredth of the slowest to a hundred times the fastest motion, within what a discrete system can show.
// Poles at zero are no motion; rounding moves them.
std::vector<double> frequenciesFor(const LinearSystem& system) {
  std::vector<double> rates;
  for (const std::complex<double> pole : polesOf(system))
    rates.push_back(std::abs(system.step ? std::log(pole + 1e-300) / *system.step : pole));
  const double fastest = *std::max_element(rates.begin(), rates.end());
  std::erase_if(rates, [&](double rate) { return !(rate > 1e-5 * fastest); });
  const double slowest = rates.empty() ? 1 : *std::min_element(rates.begin(), rates.end());
  double high = 100 * (rates.empty() ? 1 : fastest);
  if (system.step) high = std::min(high, 0.999 * std::numbers::pi / *system.step);
  return frequenciesBetween(std::min(slowest / 100, high / 10), high);
}

void draw(const Findings& f, const LinearOptions& options, Results& results) {
  const int input = options.input - 1, output = options.output - 1;
  const auto draw = [&](Figure figure, const char* name, const std::string& title) {
    figure.title = title;
    const fs::path file = options.out / name;
    results.json["files"].push_back(file.string());  // as it was given
    writeFigure(figure, file);
  };
  makeOutFolder(options.out);
  const std::string way = fmt::format("u{} to y{}", options.input, options.output);
  const FrequencyResponse plant = frequencyResponse(f.system, input, output, frequenciesFor(f.system));
  draw(bodeMagnitudeFigure(plant.frequencies, plant.magnitudes), "bode-magnitude.png", "From " + way);
  draw(bodePhaseFigure(plant.frequencies, plant.phases), "bode-phase.png", "From " + way);
  const TimeDomain domain = f.system.step ? TimeDomain::kDiscrete : TimeDomain::kContinuous;
  const auto listOf = [](const Eigen::VectorXcd& values) {
    return std::vector(values.begin(), values.end());
  };
  Figure poles = poleFigure(listOf(f.stability.eigenvalues), {}, domain);
  if (f.closed) {
    Figure closed = poleFigure(listOf(polesOf(*f.closed)), {}, domain);
    poles.series[0].label = "alone";
    closed.series[0].label = "with the regulator";
    closed.series[0].color = Color{0.95f, 0.35f, 0.1f};
    poles.series.push_back(closed.series[0]);
  }
  draw(poles, "poles.png", "Poles");
  if (!f.closed) return;
  const FrequencyResponse loop = frequencyResponse(*f.loop, input, input, frequenciesFor(*f.loop));
  draw(nyquistFigure(loop.values), "nyquist.png", fmt::format("The loop, cut at u{}", options.input));
  double slowest = 1e3;
  for (const std::complex<double> pole : polesOf(*f.closed))
    slowest =
        std::min(slowest, f.system.step ? -std::log(std::abs(pole) + 1e-300) / *f.system.step : -pole.real());
  const TimeResponse step = stepResponse(*f.closed, input, 6 / std::max(slowest, 1e-3));
  draw(stepFigure(step.times, step.y), "step.png",
       fmt::format("With the regulator, pushed by 1 at u{} from 0 s on", options.input));
}

const char* toString(RiccatiStatus status) {
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

// A matrix, below its name; null where there is none.
void addMatrix(Results& all, Json& part, const char* name, const Eigen::MatrixXd& M) {
  part[name] = M.size() > 0 ? jsonOfRows(M) : Json();
  std::ostringstream text;
  text << M.format(Eigen::IOFormat(8, 0, "  ", "\n", "  "));
  if (M.size() > 0) all.line("{} =\n{}", name, text.str());
}

void addEigenvalues(Results& all, Json& part, const Eigen::VectorXcd& values) {
  part["eigenvalues"] = Json::array();
  for (const std::complex<double> value : values) {
    part["eigenvalues"].push_back({value.real(), value.imag()});
    all.line("  {:.8g} {:+.8g}i", value.real(), value.imag());
  }
}

void addReachable(Results& all, const char* name, const ReachableStates& states) {
  all.line("{}", states.isComplete ? name : states.message);
  all.json[name] = {{"rank", states.rank}, {"complete", states.isComplete}, {"message", states.message}};
}

Results resultsOf(const Findings& f) {
  const auto counted = [](Eigen::Index count, const char* name) {
    return fmt::format("{} {}{}", count, name, count == 1 ? "" : "s");
  };
  Results all;
  all.line("{}, {}, {}; {}", counted(f.system.A.rows(), "state"), counted(f.system.B.cols(), "control"),
           counted(f.system.C.rows(), "measurement"),
           f.system.step ? fmt::format("in steps of {:g} s", *f.system.step) : "in continuous time");
  all.line("{}", f.stability.message);
  addEigenvalues(all, all.json, f.stability.eigenvalues);
  all.json["stability"] = f.stability.message;
  addReachable(all, "controllable", f.controllable);
  addReachable(all, "observable", f.observable);
  Json regulator, filter;
  if (f.regulator) {
    const RiccatiResult& found = *f.regulator;
    all.line("LQR: {}", found.message);
    addMatrix(all, regulator, "X", found.X);
    addMatrix(all, regulator, "K", found.K);
    addEigenvalues(all, regulator, found.closedLoop);
    regulator["residual"] = found.X.size() > 0 ? Json(found.residual) : Json();
    regulator["status"] = toString(found.status);
    regulator["mode"] = found.mode ? Json{found.mode->real(), found.mode->imag()} : Json();
    regulator["message"] = found.message;
  }
  if (f.filter) {
    all.line("Kalman filter: {}", f.filter->message);
    addMatrix(all, filter, "L", f.filter->L);
    addEigenvalues(all, filter, f.filter->closedLoop);
    filter["message"] = f.filter->message;
  }
  if (f.lqg && f.lqg->status != RiccatiStatus::kSolved) all.line("LQG: {}", f.lqg->message);
  all.json.update({{"regulator", regulator}, {"filter", filter}, {"files", Json::array()}});
  return all;
}

ExitCode linear(const Project& project, const LinearOptions& options) {
  const MatrixFile file = asWrongUse([&] {
    return MatrixFile(inProject(project, options.file), options.file,
                      {"A", "B", "C", "D", "step", "Q", "R", "W", "V"});
  });
  const Findings findings = asWrongUse([&] { return file.blamed([&] { return findingsOf(file); }); });
  const auto requireOne = [](const char* option, int number, Eigen::Index count) {
    requireBetween(option, number, 1, static_cast<double>(count));
  };
  requireOne("--input", options.input, findings.system.B.cols());
  requireOne("--output", options.output, findings.system.C.rows());
  Results results = resultsOf(findings);
  if (!options.out.empty()) draw(findings, options, results);
  results.print(options.json);
  const bool isSolved = (!findings.regulator || findings.regulator->K.size() > 0) &&
                        (!findings.filter || findings.filter->L.size() > 0);
  return isSolved ? ExitCode::kFull : ExitCode::kBelow;
}

}  // namespace

void addLinear(CLI::App* command, Action& action) {
  const auto options = std::make_shared<LinearOptions>();
  command->footer(
      "Examples:\n  scripts/rex linear data/control/cart-pole-seen.json\n"
      "  scripts/rex linear data/control/cart-steps.json\n"
      "  scripts/rex linear data/control/cart-pole-seen.json -o figures --json\n\n"
      "x' = A x + B u, y = C x + D u, or x_{t+1} with a \"step\" in seconds: stability,\n"
      "controllability, observability. With Q and R the regulator u = -K x from the solution X of\n"
      "the algebraic Riccati equation (slide 8:19), with W and V (intensities of the noise of\n"
      "motion and measurement) the Kalman filter, with all four LQG. Exit code 1: one of them\n"
      "does not exist; the message says why.");
  command->add_option("file", options->file, "{\"A\": [[...], ...], \"B\": ...}; also C, D, step, Q, R, W, V")
      ->type_name("FILE.json")
      ->required();
  addOptions(command,
             {{"-o,--out", options->out, "DIR", "draw Bode, Nyquist, poles and a step into this folder"},
              {"--input", options->input, {1, 1e6}, "N", "the control that the figures show"},
              {"--output", options->output, {1, 1e6}, "N", "the measurement that they show"},
              {"--json", options->json, "print JSON"}});
  command->callback(
      [&action, options] { action = [options](const Project& p) { return linear(p, *options); }; });
}

}  // namespace rex::cli
