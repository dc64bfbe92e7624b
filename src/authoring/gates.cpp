#include "authoring/gates.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include <fmt/format.h>

#include "authoring/handed_out.h"
#include "authoring/killed_mutants.h"
#include "authoring/pasted.h"
#include "authoring/release.h"
#include "authoring/seen_messages.h"
#include "authoring/wrong_variants.h"
#include "base/error.h"
#include "base/process.h"
#include "base/text.h"
#include "base/text_file.h"
#include "submission/compiler_messages.h"
#include "submission/cpp_text.h"
#include "submission/regions.h"
#include "submission/student_build.h"
#include "submission/submission.h"

namespace rex::authoring {

using grading::GradeResult;

namespace {

namespace fs = std::filesystem;

using Words = std::set<std::string>;

// The identifiers in a text.
std::vector<std::string> wordsOf(std::string_view text) {
  const submission::CppText tokens(text);
  std::vector<std::string> words;
  for (std::size_t i = 0; i < tokens.size(); ++i)
    if (tokens.isName(i)) words.emplace_back(tokens.at(i));
  return words;
}

// A comment that mentions a name does not make it exist; a literal does, as the name of a file that is made.
void addCodeWords(const std::string& source, Words& words) {
  const submission::CppText code(source);
  for (std::size_t i = 0; i < code.size(); ++i) {
    if (code.isName(i)) words.emplace(code.at(i));
    if (!code.isKind(i, submission::TokenKind::kText)) continue;
    for (std::string& word : wordsOf(code.at(i).substr(1, code.at(i).size() - 2)))
      words.insert(std::move(word));
  }
}

Words libraryWords(const fs::path& root) {
  Words words;
  if (fs::exists(root / "src"))
    for (const auto& entry : fs::recursive_directory_iterator(root / "src"))
      if (entry.path().extension() == ".h") addCodeWords(readTextFile(entry.path()), words);
  return words;
}

Words exerciseWords(const fs::path& exercise) {
  Words words;
  for (const char* name : {"exercise.h", "main.cpp", "show.h", "show.cpp"})
    if (fs::exists(exercise / name)) addCodeWords(readTextFile(exercise / name), words);
  return words;
}

bool looksLikeFile(const std::string& name) {
  constexpr std::array kEndings = {".cpp",  ".h",   ".md",  ".toml", ".ors",  ".urdf",
                                   ".json", ".png", ".svg", ".mp4",  ".html", ".log"};
  const bool ending =
      std::any_of(kEndings.begin(), kEndings.end(), [&](const char* e) { return name.ends_with(e); });
  return name.find(' ') == std::string::npos && (ending || name.ends_with('/'));
}

// Results are made by show.cpp or main.cpp, which names them, perhaps without folder or ending.
bool fileExists(const std::string& name, const fs::path& root, const fs::path& exercise, const Words& words) {
  if (name.starts_with("out/") || fs::exists(exercise / name) || fs::exists(root / name)) return true;
  const std::vector<std::string> stem = wordsOf(fs::path(name).stem().string());
  return !stem.empty() &&
         std::all_of(stem.begin(), stem.end(), [&](const auto& w) { return words.contains(w); });
}

// Whether to check the text: a name, perhaps qualified or called, not a formula, command or foreign name.
bool looksLikeName(const std::string& text) {
  const std::string name = text.substr(0, text.find('('));
  if (name.size() < 2 || name.starts_with("std::") || name.starts_with("Eigen::")) return false;
  const bool plain = std::all_of(name.begin(), name.end(),
                                 [](char c) { return submission::isWord(c) || c == ':' || c == '.'; });
  return plain && std::isdigit(static_cast<unsigned char>(name[0])) == 0 && submission::isWord(name[0]);
}

class Checker {
 public:
  Checker(fs::path root, fs::path exercise)
      : root_(std::move(root)),
        exercise_(std::move(exercise)),
        library_(libraryWords(root_)),
        words_(exerciseWords(exercise_)) {
    words_.insert(library_.begin(), library_.end());
  }

  // Looks at the text between each pair of backticks of a line.
  void checkLine(const std::string& line, const SourceLocation& where) {
    std::size_t open = line.find('`');
    while (open != std::string::npos) {
      const std::size_t close = line.find('`', open + 1);
      if (close == std::string::npos) return;
      checkName(line.substr(open + 1, close - open - 1),
                {where.file, where.line, static_cast<int>(open) + 2});
      open = line.find('`', close + 1);
    }
  }

  // Looks at a line `function = "rex::name"` of exercise.toml.
  void checkForbidden(const std::string& line, const SourceLocation& where) {
    const std::size_t open = line.find('"'), close = line.find('"', open + 1);
    if (!line.starts_with("function ") || close == std::string::npos) return;
    checkWords(line.substr(open + 1, close - open - 1), {where.file, where.line, static_cast<int>(open) + 2},
               library_);
  }

  std::vector<DeadName> dead() && { return std::move(dead_); }

 private:
  void checkName(const std::string& name, const SourceLocation& where) {
    if (looksLikeFile(name)) {
      if (!fileExists(name, root_, exercise_, words_)) dead_.push_back({where, name, {}});
    } else if (looksLikeName(name)) {
      checkWords(name, where, words_);
    }
  }

  void checkWords(const std::string& name, const SourceLocation& where, const Words& known) {
    for (const std::string& word : wordsOf(name.substr(0, name.find('('))))
      if (word.size() > 1 && !known.contains(word)) {
        dead_.push_back({where, name, nearestNames(word, {known.begin(), known.end()})});
        return;
      }
  }

  fs::path root_, exercise_;
  Words library_, words_;
  std::vector<DeadName> dead_;
};

}  // namespace

std::vector<DeadName> deadNames(const fs::path& root, const fs::path& exercise) {
  Checker checker(root, exercise);
  for (const char* name : {"README.md", "solution.cpp", "exercise.toml"}) {
    const fs::path file = exercise / name;
    if (!fs::exists(file)) continue;
    std::istringstream lines(readTextFile(file));
    const bool readme = file.extension() == ".md", description = file.extension() == ".toml";
    bool fenced = false;
    int number = 0;
    for (std::string line; std::getline(lines, line);) {
      ++number;
      if (description) {
        checker.checkForbidden(line, {file.string(), number});
        continue;
      }
      if (line.starts_with("```")) fenced = !fenced;
      const bool relevant = readme ? !fenced : line.find("//|") != std::string::npos;
      if (relevant) checker.checkLine(line, {file.string(), number});
    }
  }
  return std::move(checker).dead();
}

namespace {

using std::filesystem::path;

using Points = std::map<std::string, int>;  // by part

const GateResult kPassed{.passed = true};

GateResult failed(std::string message) { return {.passed = false, .message = std::move(message)}; }

// Passed if there is nothing to complain about.
GateResult judge(const std::vector<std::string>& complaints) {
  return {.passed = complaints.empty(), .message = join(complaints, "\n")};
}

submission::SubmissionOptions optionsFor(const GateContext& context, const path& file) {
  return {.main = file,
          .workFolder = context.workFolder / "build",
          .job = {.results = context.workFolder / "results.json"}};
}

GradeResult grade(const GateContext& context, const path& file) {
  return submission::gradeSubmission(context.toolchain, context.exercise, optionsFor(context, file)).result;
}

// Everything that is wrong in a result, line by line.
std::string shortfalls(const GradeResult& result) {
  std::string lines = result.message.empty() ? "" : "\n  " + result.message;
  for (const grading::CheckResult& check : result.checks)
    if (check.status != grading::Outcome::kPass) lines += fmt::format("\n  {}: {}", check.id, check.message);
  return lines;
}

// The student must be able to see the task: code that draws for main() belongs in show.cpp.
GateResult mainIsCurrent(const GateContext& context) {
  constexpr std::size_t kMostLines = 200;
  const path folder = context.exercise.folder, solution = folder / "solution.cpp";
  const std::string main = readTextFile(folder / "main.cpp");
  if (main != submission::stripSolution(readTextFile(solution), solution.string()))
    return failed(fmt::format("main.cpp does not match solution.cpp; run: scripts/rex dev strip {}",
                              context.exercise.name));
  const std::size_t lines = splitLines(main).size();
  if (lines <= kMostLines) return kPassed;
  return failed(fmt::format("main.cpp has {} lines, wanted at most {}", lines, kMostLines));
}

// What headings of README.md promise: "## Part 2: the step (2:29; 5 points)". Headings are in the order of
// the parts.
std::vector<std::string> wrongHeadings(const submission::ExerciseInfo& exercise) {
  const std::string text = readTextFile(exercise.folder / "README.md");
  static const std::regex kHeading(R"(^#+ .*[( ](\d+) points?\))"), kNumber(R"(^#+ +Part +(\d+))");
  std::vector<std::string> complaints;
  std::size_t line = 0, next = 0;
  for (const std::string_view one : splitLines(text)) {
    ++line;
    const std::string heading(one);
    std::smatch promised, number;
    if (!std::regex_search(heading, promised, kHeading)) continue;
    const std::size_t part = std::regex_search(heading, number, kNumber)
                                 ? parseNumber<std::size_t>(number.str(1)).value_or(0) - 1
                                 : next;
    next = part + 1;
    const int points = parseNumber<int>(promised.str(1)).value_or(0);
    const std::string where = fmt::format("README.md:{}: the heading promises {} points", line, points);
    if (part >= exercise.parts.size())
      complaints.push_back(fmt::format("{}, but exercise.toml has only {} part{}", where,
                                       exercise.parts.size(), exercise.parts.size() == 1 ? "" : "s"));
    else if (points != exercise.parts[part].points)
      complaints.push_back(fmt::format("{}, exercise.toml says {} for part '{}'", where,
                                       exercise.parts[part].points, exercise.parts[part].id));
  }
  return complaints;
}

// Where checks compare an answer with other answers of the same program, by grading/own_differences.h: each
// is a place where lies could agree with each other.
int comparisonsOfAnswers(const path& exercise) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(exercise)) {
    if (entry.path().filename() != "check.cpp" && entry.path().extension() != ".h") continue;
    const std::string source = readTextFile(entry.path());
    const submission::CppText text(source);
    for (std::size_t i = 0; i < text.size(); ++i)
      if (text.isSign(i + 1, '(') && (text.at(i) == "valuesInAnyOrder" || text.at(i) == "requireIntegral"))
        ++count;
  }
  return count;
}

// The checks of each part must be worth what exercise.toml and README.md promise, and exercises at most as
// much as each other.
GateResult pointsAddUp(const GateContext& context) {
  constexpr int kMost = 20;
  Points checked;
  for (const grading::CheckResult& check : submission::listChecks(context.toolchain))
    checked[check.part] += check.maxPoints;
  std::vector<std::string> complaints;
  for (const submission::ExercisePart& part : context.exercise.parts) {
    if (checked[part.id] != part.points)
      complaints.push_back(fmt::format("part '{}': checks are worth {} points, exercise.toml says {}",
                                       part.id, checked[part.id], part.points));
    checked.erase(part.id);
  }
  for (const auto& [part, points] : checked)
    complaints.push_back(fmt::format("checks name a part '{}' that exercise.toml does not have", part));
  if (context.exercise.points() > kMost)
    complaints.push_back(
        fmt::format("exercise.toml: the parts are worth {} points together, wanted at most {}",
                    context.exercise.points(), kMost));
  for (std::string& heading : wrongHeadings(context.exercise)) complaints.push_back(std::move(heading));
  GateResult result = judge(complaints);
  if (const int count = comparisonsOfAnswers(context.exercise.folder); count > 0)
    result.note = fmt::format("places that compare answers with other answers of the program: {}", count);
  return result;
}

GateResult namesExist(const GateContext& context) {
  std::vector<std::string> complaints;
  for (const DeadName& dead : deadNames(context.root, context.exercise.folder))
    complaints.emplace_back(Error({.what = fmt::format("'{}' does not exist", dead.name),
                                   .where = dead.where,
                                   .nearest = dead.nearest})
                                .what());
  return judge(complaints);
}

GateResult releaseIsClean(const GateContext& context) {
  requireNoSolutionText(context.exercise.folder);
  return kPassed;
}

GateResult isDescribed(const GateContext& context) {
  return judge(missingDescriptions(context.root, context.exercise));
}

GateResult mainScoresFloor(const GateContext& context) {
  const GradeResult result = grade(context, context.exercise.folder / "main.cpp");
  if (!result.compile.diagnostics.empty())
    return failed("main.cpp does not compile cleanly: " + toString(result.compile.diagnostics.front()));
  if (result.outcome == grading::Outcome::kGraderError) return failed("the grader failed: " + result.message);
  Points scored;
  std::map<std::string, std::vector<std::string>> checks;  // with points, by part
  for (const grading::CheckResult& check : result.checks) {
    scored[check.part] += check.points;
    if (check.points > 0) checks[check.part].push_back(fmt::format("{} {}", check.id, check.points));
  }
  std::vector<std::string> complaints;
  for (const submission::ExercisePart& part : context.exercise.parts)
    if (scored[part.id] != part.floor)
      complaints.push_back(
          fmt::format("part '{}': the untouched main.cpp gets {} point{} ({}), exercise.toml says floor = {}",
                      part.id, scored[part.id], scored[part.id] == 1 ? "" : "s",
                      checks[part.id].empty() ? "no check passes" : join(checks[part.id], ", "), part.floor));
  return judge(complaints);
}

// Whatever they print or draw: students run both, the stub first of all. Films may take longer.
GateResult mainsRun(const GateContext& context) {
  constexpr double kSeconds = 20;
  const ProcessOptions limits{.directory = context.workFolder, .timeout = 1200, .cpuSeconds = kSeconds};
  std::vector<std::string> complaints;
  for (const char* name : {"main.cpp", "solution.cpp"}) {
    const submission::StudentObject object = submission::compileStudent(
        context.toolchain, {},
        {.main = context.exercise.folder / name, .workFolder = context.workFolder / "run"});
    const submission::StudentProgram program =
        object.ok ? submission::linkProgram(context.toolchain, object) : submission::StudentProgram{};
    if (!program.ok) {
      complaints.push_back(fmt::format("{} cannot be built: {}", name, object.log + program.log));
      continue;
    }
    const ProcessResult run = runProcess({program.program.string()}, limits);
    if (run.ok() || run.cpuSeconds >= kSeconds) continue;
    const std::string end =
        run.signal != 0 ? fmt::format("signal {}", run.signal) : fmt::format("exit code {}", run.exitCode);
    complaints.push_back(fmt::format("main() of {} ends with {}: {}", name, end, run.error));
  }
  return judge(complaints);
}

GateResult solutionIsFull(const GateContext& context) {
  submission::SubmissionOptions options = optionsFor(context, context.exercise.folder / "solution.cpp");
  const submission::BuiltSubmission built =
      submission::buildSubmission(context.toolchain, context.exercise, options);
  if (!built.start.compile.diagnostics.empty())
    return failed("solution.cpp does not compile cleanly: " +
                  toString(built.start.compile.diagnostics.front()));
  for (int seed = 1; seed <= context.seeds; ++seed) {
    options.job.seed = static_cast<std::uint64_t>(seed);
    const GradeResult result = submission::gradeBuilt(built, context.toolchain, context.exercise, options);
    if (result.outcome != grading::Outcome::kPass || result.score != context.exercise.points())
      return failed(fmt::format("solution.cpp scores {} of {} under seed {}{}", result.score,
                                context.exercise.points(), seed, shortfalls(result)));
  }
  return kPassed;
}

// The grader's output on the solution with options that ask for something other than points. Throws Error if
// the solution cannot be built.
ProcessResult askGrader(const GateContext& context, const std::vector<std::string>& options) {
  const submission::SubmissionOptions solution =
      optionsFor(context, context.exercise.folder / "solution.cpp");
  const submission::BuiltSubmission built =
      submission::buildSubmission(context.toolchain, context.exercise, solution);
  if (built.worker.empty())
    throw Error({.what = "solution.cpp cannot be built", .found = built.start.message});
  grading::Limits limits = context.exercise.limits;
#ifdef __SANITIZE_ADDRESS__  // the whole worker has them
  limits.cpuSeconds *= grading::kSanitizedSlowness;
#endif
  std::vector<std::string> command = grading::toArguments({.worker = built.worker,
                                                           .parts = built.parts,
                                                           .limits = limits,
                                                           .temporaryFolder = context.workFolder});
  command.insert(command.begin(), context.toolchain.grader.string());
  command.insert(command.end(), options.begin(), options.end());
  constexpr double kLongest = 3 * 3600;
  return runProcess(command, {.timeout = kLongest});
}

GateResult passedWith(const std::string& output) {
  return {.passed = true, .message = {}, .note = std::string(splitLines(output).back())};
}

// Whatever a student's functions return, the grader survives it in time and gives no point for it.
GateResult answersHurtNobody(const GateContext& context) {
  const ProcessResult run = askGrader(context, {"--hostile", std::to_string(context.hostileAnswers)});
  return run.ok() ? passedWith(run.output) : failed(run.output + run.error);
}

// No tolerance, question or case grows with an answer, and no answer gains points by its size.
GateResult growthGainsNothing(const GateContext& context) {
  const ProcessResult run = askGrader(context, {"--grown"});
  return run.ok() ? passedWith(run.output) : failed(run.output + run.error);
}

// Zeros, constants, the last answer and the question itself get no point. If a lie is nearly right, as the
// force of the previous step in a closed loop is, exercise.toml says how many points of a part it may get.
GateResult liarsGetNothing(const GateContext& context) {
  const ProcessResult run = askGrader(context, {"--lies"});
  if (!run.ok()) return failed(run.output + run.error);
  std::map<std::string, Points> scored;  // by lie, then by part
  std::map<std::string, std::string> checks;
  for (const std::string_view line : splitLines(run.output)) {
    const std::vector<std::string_view> fields = splitAt(line, '\t');
    if (fields.size() != 4) continue;
    scored[std::string(fields[2])][std::string(fields[0])] += parseNumber<int>(fields[3]).value_or(0);
    checks[std::string(fields[0])] += fmt::format(" {}", fields[1]);
  }
  std::vector<std::string> complaints;
  for (const auto& [lie, points] : scored)
    for (const submission::ExercisePart& part : context.exercise.parts)
      if (points.contains(part.id) && points.at(part.id) > part.lies)
        complaints.push_back(
            fmt::format("part '{}': the liar '{}' gets {} points, exercise.toml allows {}:{}", part.id, lie,
                        points.at(part.id), part.lies, checks[part.id]));
  return complaints.empty() ? passedWith(run.output) : judge(complaints);
}

// The sanitizers, which students use after a crash, must accept a correct program. One check is enough.
GateResult solutionPassesSanitizers(const GateContext& context) {
  submission::SubmissionOptions options = optionsFor(context, context.exercise.folder / "solution.cpp");
  options.sanitize = true;
  for (const grading::CheckResult& check : submission::listChecks(context.toolchain))
    if (check.group == grading::Group::kVisible && options.job.checks.empty())
      options.job.checks = {check.id};
  const GradeResult result = submission::gradeSubmission(context.toolchain, context.exercise, options).result;
  if (result.outcome == grading::Outcome::kPass) return kPassed;
  return failed("solution.cpp does not pass with the sanitizers: " + shortfalls(result));
}

// The parts whose checks catch no wrong variant: nothing proves that they can fail.
std::vector<std::string> partsWithoutMistake(const GateContext& context,
                                             const std::vector<submission::WrongVariant>& variants) {
  std::map<std::string, std::string> partOf;  // by check
  for (const grading::CheckResult& check : submission::listChecks(context.toolchain))
    partOf[check.id] = check.part;
  std::set<std::string> tried;
  for (const submission::WrongVariant& variant : variants)
    for (const std::string& check : variant.caughtBy) tried.insert(partOf[check]);
  std::vector<std::string> complaints;
  for (const submission::ExercisePart& part : context.exercise.parts)
    if (!tried.contains(part.id))
      complaints.push_back(
          fmt::format("part '{}': no wrong variant is caught by one of its checks", part.id));
  return complaints;
}

// The gates of the variants prove that the picture exists and that the messages are those of the file, in
// which got and wanted must differ.
GateResult mistakesAreShown(const GateContext& context) {
  const std::vector<submission::WrongVariant> variants = exerciseVariants(context.exercise);
  if (const auto untried = partsWithoutMistake(context, variants); !untried.empty()) return judge(untried);
  if (!variants.empty() && !std::filesystem::exists(seenMessagesFile(context.exercise.folder)))
    return failed(
        fmt::format("seen.txt is missing; run: REX_UPDATE_GOLDEN=1 scripts/rex dev check {} --gate wrong",
                    context.exercise.name));
  std::vector<std::string> complaints =
      messagesThatExplainNothing(readSeenMessages(seenMessagesFile(context.exercise.folder)));
  if (std::all_of(variants.begin(), variants.end(), [](const auto& one) { return one.shownBy.empty(); }))
    complaints.emplace_back(
        "no wrong variant names a check that shows its mistake: '// shown by: CHECK, ...'");
  return judge(complaints);
}

// No code that students are shown does a part of their work.
GateResult shownCodeGetsNothing(const GateContext& context) {
  const Pasted all = pastedCode(context);
  GateResult result = judge(all.complaints);
  result.note = fmt::format("pasted {} functions and {} expressions", all.functions, all.expressions);
  return result;
}

// No small change of the solution, made by machine, gets all points.
GateResult mutantsAreKilled(const GateContext& context) {
  const MutantCounts all = countMutants(context);
  GateResult result = judge(all.complaints);
  result.note = fmt::format("made {} mutants of {}: {} killed, {} survived, {} do not compile; {:.0f} s",
                            all.made, all.possible, all.killed, all.survived, all.rejected, all.seconds);
  for (const auto& [reason, number] : all.equal) result.note += fmt::format("; {} equal: {}", number, reason);
  if (!all.idleChecks.empty()) result.note += fmt::format("; no mutant needs {}", join(all.idleChecks, ", "));
  return result;
}

GateResult variantsAreCaught(const GateContext& context) {
  const CaughtTogether all = whyNotCaughtTogether(context);
  GateResult result = judge(all.complaints);
  if (!all.alone.empty()) result.note = fmt::format("compiled alone: {}", join(all.alone, ", "));
  if (all.asked > 0)
    result.note +=
        fmt::format("{}recognised by their answers: {}", result.note.empty() ? "" : "; ", all.asked);
  return result;
}

// Which exercises have a gate: all, those that are not private, or those with wrong variants.
enum class Scope { kAll, kPublic, kVariants };

struct Gate {
  const char* name;
  GateResult (*run)(const GateContext&);
  bool comparesTexts = false;
  Scope scope = Scope::kAll;
};

constexpr std::array kGates = {Gate{"main-current", mainIsCurrent, true},
                               Gate{"names", namesExist, true},
                               Gate{"release", releaseIsClean, true},
                               Gate{"handed-out", isDescribed, true, Scope::kPublic},
                               Gate{"points", pointsAddUp},
                               Gate{"evidence", mistakesAreShown, false, Scope::kPublic},
                               Gate{"main-floor", mainScoresFloor},
                               Gate{"mains", mainsRun},
                               Gate{"solution", solutionIsFull},
                               Gate{"sanitizers", solutionPassesSanitizers},
                               Gate{"hostile", answersHurtNobody},
                               Gate{"grown", growthGainsNothing},
                               Gate{"liars", liarsGetNothing},
                               Gate{"pasted", shownCodeGetsNothing},
                               Gate{"mutants", mutantsAreKilled},
                               Gate{"wrong", variantsAreCaught, false, Scope::kVariants}};

constexpr std::string_view kOneVariant = "wrong/";

const Gate* gateCalled(const std::string& name) {
  const auto* const found =
      std::find_if(kGates.begin(), kGates.end(), [&](const Gate& gate) { return gate.name == name; });
  return found == kGates.end() ? nullptr : found;
}

}  // namespace

std::vector<std::string> gateNames(const submission::ExerciseInfo& exercise) {
  std::vector<std::string> names;
  for (const Gate& gate : kGates) {
    const bool applies = gate.scope == Scope::kPublic     ? !exercise.isPrivate
                         : gate.scope == Scope::kVariants ? fs::exists(exercise.folder / "wrong.cpp")
                                                          : true;
    if (applies) names.emplace_back(gate.name);
  }
  return names;
}

bool comparesTexts(const std::string& gate) {
  const Gate* const found = gateCalled(gate);
  return found != nullptr && found->comparesTexts;
}

void requireGate(const submission::ExerciseInfo& exercise, const std::string& gate) {
  std::vector<std::string> names = gateNames(exercise);
  for (const std::string& variant : variantNames(exercise))
    names.push_back(std::string(kOneVariant) + variant);
  if (std::find(names.begin(), names.end(), gate) != names.end()) return;
  const Gate* const found = gateCalled(gate);
  if (found != nullptr && found->scope == Scope::kPublic)
    throw UsageError({.what = fmt::format("the gate {} does not apply to {}", gate, exercise.name),
                      .found = "profile = \"private\" in its exercise.toml"});
  throw UsageError({.what = fmt::format("{} has no gate '{}'", exercise.name, gate),
                    .nearest = nearestNames(gate, names)});
}

GateResult runGate(const GateContext& context, const std::string& gate) {
  requireGate(context.exercise, gate);
  try {
    return gate.starts_with(kOneVariant) ? judge(whyNotCaught(context, gate.substr(kOneVariant.size())))
                                         : gateCalled(gate)->run(context);
  } catch (const Error& error) {
    return failed(error.what());
  }
}

}  // namespace rex::authoring
