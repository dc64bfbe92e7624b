#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <optional>

#include <fmt/format.h>

#include "authoring/gates.h"
#include "authoring/wrong_variants.h"
#include "base/error.h"
#include "base/folders.h"
#include "cli/build_on_demand.h"
#include "cli/instructor/dev_verbs.h"
#include "cli/json_internal.h"
#include "cli/terminal.h"

namespace rex::cli {
namespace {

// What became of all gates: printed line by line, or collected for JSON.
class GateReport {
 public:
  explicit GateReport(bool json) : json_(json) {}

  void add(const std::string& exercise, const std::string& gate, const authoring::GateResult& result) {
    open_ += result.passed ? 0 : 1;
    if (json_) {
      gates_.push_back({{"exercise", exercise},
                        {"gate", gate},
                        {"passed", result.passed},
                        {"message", result.message},
                        {"note", result.note}});
      return;
    }
    say(fmt::format(" {}  {}  {}",
                    result.passed ? paint(Colour::kGreen, " ok ") : paint(Colour::kRed, "FAIL"), exercise,
                    gate));
    if (!result.passed) say("       " + wrap(escapeForTerminal(result.message), 7, 7));
    if (!result.note.empty()) say("       " + wrap(escapeForTerminal(result.note), 7, 7));
    std::fflush(stdout);  // the next may take minutes
  }

  void addPrivate(const std::string& exercise) const {
    if (json_) return;
    say(fmt::format("{} is private, as its exercise.toml says: the gates handed-out and evidence do not",
                    exercise));
    say("apply, nor do the limits of share/weight.txt.");
  }

  void addBlocked(const std::string& exercise, const std::string& why) {
    if (json_)
      blocked_.push_back({{"exercise", exercise}, {"message", why}});
    else
      note(fmt::format("rex: {}", why));
    ++blockedCount_;
  }

  [[nodiscard]] ExitCode end() const {
    if (json_) {
      say(dump(Json{{"gates", gates_}, {"blocked", blocked_}}));
    } else {
      if (open_ > 0) note(fmt::format("{} gate{} not passed.", open_, open_ == 1 ? "" : "s"));
      if (blockedCount_ > 0)
        note(fmt::format("{} exercise{} not checked.", blockedCount_, blockedCount_ == 1 ? "" : "s"));
    }
    if (blockedCount_ > 0) return ExitCode::kGraderFault;
    return open_ == 0 ? ExitCode::kFull : ExitCode::kBelow;
  }

 private:
  bool json_;
  Json gates_ = Json::array(), blocked_ = Json::array();
  int open_ = 0, blockedCount_ = 0;
};

bool isSet(const char* variable) { return std::getenv(variable) != nullptr; }

authoring::GateResult resultOf(const Project& project, const ExerciseInfo& exercise,
                               const submission::Toolchain& toolchain, const std::string& gate,
                               const CheckOptions& options) {
  const PrivateFolder work(project.workPlace("exercises/" + exercise.name));
  return authoring::runGate({.root = project.root,
                             .exercise = exercise,
                             .toolchain = toolchain,
                             .workFolder = work.path(),
                             .seeds = options.runs,
                             .sheet = options.sheet,
                             .hostileAnswers = isSet("REX_LONG_RUN") ? 10000 : 3000,
                             .variants = options.variants,
                             .storesMessages = isSet("REX_UPDATE_GOLDEN")},
                            gate);
}

// All gates, unless some are named, those that need no build first; a variant names the gate that tests it.
// Throws UsageError for unknown gates and for a variant that no gate would test.
std::vector<std::string> wantedGates(const ExerciseInfo& exercise, const CheckOptions& options) {
  std::vector<std::string> gates = options.gates;
  if (!options.variants.empty() && !gates.empty() &&
      std::find(gates.begin(), gates.end(), "wrong") == gates.end())
    throw UsageError({.what = "--variant has no effect without --gate wrong"});
  for (const std::string& gate : gates) authoring::requireGate(exercise, gate);
  std::stable_partition(gates.begin(), gates.end(), authoring::comparesTexts);
  if (!gates.empty()) return gates;
  return options.variants.empty() ? authoring::gateNames(exercise) : std::vector<std::string>{"wrong"};
}

void checkOne(const Project& project, const std::string& name, const CheckOptions& options,
              GateReport& report) {
  ExerciseInfo exercise;
  try {
    exercise = project.exercise(name);
  } catch (const Error& error) {
    report.add(name, "exercise.toml", {.passed = false, .message = error.what()});
    return;
  }
  authoring::requireVariants(exercise, options.variants);
  const std::vector<std::string> gates = wantedGates(exercise, options);
  if (exercise.isPrivate && gates == authoring::gateNames(exercise)) report.addPrivate(name);
  std::optional<submission::Toolchain> toolchain;
  for (const std::string& gate : gates) {
    if (!toolchain && !authoring::comparesTexts(gate)) toolchain = prepare(project, exercise);
    report.add(name, gate,
               resultOf(project, exercise, toolchain.value_or(submission::Toolchain{}), gate, options));
  }
}

void sayGates(const Project& project, const std::vector<std::string>& names, bool json) {
  Json all = Json::object();
  for (const std::string& name : names) {
    const std::vector<std::string> gates = authoring::gateNames(project.exercise(name));
    all[name] = gates;
    for (const std::string& gate : gates)
      if (!json) say(gate);
  }
  if (json) say(dump(all));
}

}  // namespace

void requireSourceTree(const Project& project, const std::string& command) {
  if (project.installed.empty()) return;
  throw UsageError({.what = fmt::format("rex dev {} needs the source tree of rex", command),
                    .where = {project.installed.string()},
                    .found = "an installed rex",
                    .wanted = fmt::format("`scripts/rex dev {}` in a clone", command)});
}

ExitCode devCheck(const Project& project, const CheckOptions& options) {
  requireSourceTree(project, "check");
  const std::vector<std::string> names =
      options.exercise.empty() ? project.exerciseNames()
                               : std::vector<std::string>{project.exerciseName(options.exercise)};
  if (names.empty()) note("There are no exercises to check.");
  if (options.listGates) {
    sayGates(project, names, options.json);
    return ExitCode::kFull;
  }
  GateReport report(options.json);
  for (const std::string& name : names) {
    try {
      checkOne(project, name, options, report);
    } catch (const BuildFailure& failure) {
      report.addBlocked(name, failure.what());
    }
  }
  return report.end();
}

}  // namespace rex::cli
