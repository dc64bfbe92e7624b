#include "authoring/wrong_variants.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "authoring/seen_messages.h"
#include "authoring/sketched_variants.h"
#include "base/error.h"
#include "base/process.h"
#include "base/text.h"
#include "base/text_file.h"
#include "grading/unknown_check.h"
#include "render/contact_sheet.h"
#include "render/image.h"
#include "submission/build_tools.h"
#include "submission/graded_source.h"
#include "submission/submission.h"
#include "submission/symbol_scan.h"

namespace rex::authoring {
namespace {

std::string ownName(std::size_t variant, std::string_view function) {
  return fmt::format("variant_{}_{}", variant, function);
}

// Whether a piece is a function and `text` differs from it in the body only.
bool differsInBody(std::string_view reference, const submission::CppPiece& piece, std::string_view text) {
  const std::string_view function = reference.substr(piece.start, piece.end - piece.start);
  const std::size_t head = function.find('{', piece.nameStart - piece.start);
  return !piece.function.empty() && !piece.isInternal &&
         text.substr(0, head + 1) == function.substr(0, head + 1);
}

// The texts of the pieces, by index, that differ from the reference; none if some cannot be swapped.
std::vector<std::pair<std::size_t, std::string>> differingBodies(
    std::string_view reference, const std::vector<submission::CppPiece>& pieces, std::string_view variant) {
  const std::vector<submission::CppPiece> its = submission::cppPieces(submission::CppText(variant));
  if (its.size() != pieces.size()) return {};
  std::vector<std::pair<std::size_t, std::string>> differing;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const std::string_view text = variant.substr(its[i].start, its[i].end - its[i].start);
    if (text == reference.substr(pieces[i].start, pieces[i].end - pieces[i].start)) continue;
    if (!differsInBody(reference, pieces[i], text) || pieces[i].function == "main") return {};
    differing.emplace_back(i, text);
  }
  return differing;
}

int linesIn(std::string_view text) { return static_cast<int>(std::count(text.begin(), text.end(), '\n')); }

}  // namespace

JoinedVariants::JoinedVariants(std::string_view reference, const std::vector<std::string>& variants) {
  const std::vector<submission::CppPiece> pieces = submission::cppPieces(submission::CppText(reference));
  std::vector<std::vector<std::pair<std::size_t, std::string>>> versions(pieces.size());  // variant, text
  for (std::size_t k = 0; k < variants.size(); ++k) {
    const auto bodies = differingBodies(reference, pieces, variants[k]);
    functions_.push_back(bodies.size());
    for (const auto& [i, text] : bodies) versions[i].emplace_back(k, text);
  }
  std::size_t done = 0;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const submission::CppPiece& piece = pieces[i];
    source_ += reference.substr(done, piece.start - done);
    done = piece.end;
    // The compiler must not use anything that it knows about the body when it compiles the callers.
    if (!versions[i].empty()) source_ += "[[gnu::noipa]] ";
    // Nobody calls main(), and compiling what it shows would take a quarter of the time.
    source_ += piece.function == "main" ? "int main() {}" : reference.substr(piece.start, done - piece.start);
    for (auto& [k, text] : versions[i]) {
      text.replace(piece.nameStart - piece.start, piece.function.size(), ownName(k, piece.function));
      source_ += '\n';
      const int first = linesIn(source_) + 1;
      places_.push_back({first, first + linesIn(text), k});
      source_ += text;
    }
  }
  source_ += reference.substr(done);
}

std::size_t JoinedVariants::variantAt(int line) const {
  const auto place = std::find_if(places_.begin(), places_.end(),
                                  [&](const Place& p) { return p.first <= line && line <= p.last; });
  return place == places_.end() ? functions_.size() : place->variant;
}

std::vector<StandIn> standIns(const std::vector<std::string>& symbols, std::size_t variant) {
  constexpr std::string_view kMangled = "_Z";
  const std::string mark = ownName(variant, "");
  std::vector<StandIn> found;
  for (const std::string& symbol : symbols) {
    // "_Z16variant_2_turnedRKd": the length of the name, the name, the parameters.
    if (!symbol.starts_with(kMangled)) continue;
    std::string_view name = std::string_view(symbol).substr(kMangled.size());
    const std::size_t length = takeNumber<std::size_t>(name).value_or(0);
    if (!name.starts_with(mark) || length <= mark.size()) continue;
    std::string replaced = fmt::format("{}{}{}", kMangled, length - mark.size(), name.substr(mark.size()));
    if (std::find(symbols.begin(), symbols.end(), replaced) != symbols.end())
      found.push_back({symbol, std::move(replaced)});
  }
  return found;
}

using std::filesystem::path;

JointBuild::JointBuild(const GateContext& context, const std::string& reference,
                       std::vector<std::string> variants)
    : context_(context),
      sources_(std::move(variants)),
      folder_(std::filesystem::absolute(context.workFolder) / "joined") {
  std::vector<std::size_t> culprits;
  do {
    culprits = compile(reference);
    for (const std::size_t culprit : culprits) sources_[culprit] = reference;  // which leaves it out
  } while (!culprits.empty());
}

// Returns the variants whose functions do not compile.
std::vector<std::size_t> JointBuild::compile(const std::string& reference) {
  const JoinedVariants joined(reference, sources_);
  functions_.assign(sources_.size(), {});
  submission::Toolchain toolchain = context_.toolchain;
  toolchain.flags.emplace_back("-w");  // functions that only main() used are unused now
  const path file = context_.workFolder / "main.cpp";
  writeTextFile(file, joined.source());
  constexpr double kSeconds = 60, kSecondsEach = 5;
  object_ =
      submission::compileStudent(toolchain, {},
                                 {.main = file,
                                  .workFolder = folder_,
                                  .publicHeadersOnly = true,
                                  .seconds = kSeconds + kSecondsEach * static_cast<double>(sources_.size()),
                                  .memory = std::size_t{4} << 30});
  std::vector<std::size_t> culprits;
  if (object_.ok) {
    const std::vector<std::string> all = symbols();
    for (std::size_t k = 0; k < sources_.size(); ++k) {
      functions_[k] = standIns(all, k);
      if (functions_[k].size() != joined.functions(k)) functions_[k].clear();
    }
  } else {
    for (const grading::CompileDiagnostic& message : object_.messages)
      if (const std::size_t k = joined.variantAt(message.line); k < sources_.size()) culprits.push_back(k);
  }
  return culprits;
}

// The functions that other files may call, from lines such as
// "0000000000000000 g     F .text._Z4stepv\t0000000000000045 _Z4stepv".
std::vector<std::string> JointBuild::symbols() const {
  const submission::Toolchain& toolchain = context_.toolchain;
  const ProcessResult listed = submission::BuildTools(toolchain, folder_, {})
                                   .run({toolchain.objdump, "-t", object_.object.string()}, {}, 256u << 20);
  if (!listed.ok()) throw Error({.what = "cannot list the functions of the variants", .found = listed.error});
  std::vector<std::string> names;
  constexpr std::size_t kScope = 17, kKind = kScope + 6;
  for (const std::string_view line : splitLines(listed.output))
    if (line.size() > kKind && line[kScope] == 'g' && line[kKind] == 'F')
      names.emplace_back(line.substr(line.rfind(' ') + 1));
  return names;
}

bool JointBuild::holds(std::size_t variant) const { return !functions_[variant].empty(); }

std::string JointBuild::complaint() const {
  return object_.ok || object_.messages.empty() ? "" : toString(object_.messages.front());
}

// The scan of compileStudent() over everything that these functions reach. Whatever the rest of the file
// calls, the solution calls, too.
std::vector<grading::CompileDiagnostic> JointBuild::forbiddenCalls(std::size_t variant) const {
  const auto& forbidden = context_.exercise.forbidden;
  if (forbidden.empty()) return {};
  const path part = folder_ / "part.o";
  std::vector<std::string> command = {context_.toolchain.compiler, "-r", "-nostdlib", "-Wl,--gc-sections"};
  for (const StandIn& function : functions_[variant]) command.push_back("-Wl,--undefined=" + function.own);
  command.insert(command.end(), {object_.object.string(), "-o", part.string()});
  const submission::BuildTools tools(context_.toolchain, folder_, {});
  const ProcessResult run = tools.run(command);
  if (!run.ok()) throw Error({.what = "cannot separate a variant from the others", .found = run.error});
  return submission::scanSymbols(part, sources_[variant], object_.name, forbidden);
}

submission::BuiltSubmission JointBuild::link(std::size_t variant) const {
  submission::BuiltSubmission built{.start = {}, .source = sources_[variant], .worker = {}};
  built.start.compile.diagnostics = forbiddenCalls(variant);
  return linkWith(functions_[variant], std::move(built));
}

submission::BuiltSubmission JointBuild::linkReference() const { return linkWith({}, {}); }

submission::BuiltSubmission JointBuild::linkWith(const std::vector<StandIn>& functions,
                                                 submission::BuiltSubmission built) const {
  std::vector<grading::CompileDiagnostic>& messages = built.start.compile.diagnostics;
  if (messages.empty()) {
    submission::Toolchain toolchain = context_.toolchain;
    for (const auto& [own, replaced] : functions)
      toolchain.linkFlags.push_back(fmt::format("-Wl,--defsym={}={}", replaced, own));
    const submission::StudentProgram worker = submission::linkWorker(toolchain, object_);
    if (worker.ok) built.worker = worker.program;
    built.parts = worker.parts;
    messages = worker.messages;
  }
  if (built.worker.empty()) {
    built.start.outcome = grading::Outcome::kCompileError;
    built.start.message = messages.empty() ? "it cannot be linked" : toString(messages.front());
  }
  return built;
}

namespace {

using std::filesystem::path;
using Complaints = std::vector<std::string>;

path wrongFileOf(const submission::ExerciseInfo& exercise) { return exercise.folder / "wrong.cpp"; }

submission::SubmissionOptions gradingOf(const GateContext& context, const submission::WrongVariant& variant) {
  submission::SubmissionOptions options{.main = context.workFolder / "main.cpp",
                                        .workFolder = context.workFolder / "build",
                                        .job = {.results = context.workFolder / "results.json"}};
  if (!variant.shownBy.empty() || !context.sheet.empty())
    options.job.evidence = context.workFolder / "checks";
  return options;
}

// A variant with a forbidden call is refused before any check runs.
Complaints whyNotRefused(const grading::GradeResult& result) {
  const auto& diagnostics = result.compile.diagnostics;
  const bool refused = std::any_of(diagnostics.begin(), diagnostics.end(),
                                   [](const auto& d) { return d.rule == submission::kForbiddenCall; });
  if (refused) return {};
  return {"it should call a forbidden function, but no call was found"};
}

const grading::CheckResult& checkNamed(const grading::GradeResult& result, const std::string& id,
                                       const submission::WrongVariant& variant) {
  const auto isIt = [&](const grading::CheckResult& check) { return check.id == id; };
  const auto check = std::find_if(result.checks.begin(), result.checks.end(), isIt);
  if (check != result.checks.end()) return *check;
  std::vector<std::string> ids;
  for (const grading::CheckResult& known : result.checks) ids.push_back(known.id);
  throw grading::unknownCheck(id, ids, variant.namedAt.at(id));
}

// Complains if there is no picture, or if there is a replay that begins while all is still well.
Complaints missingOf(const grading::CheckResult& check, const path& workFolder) {
  if (check.picture.empty() || !std::filesystem::exists(workFolder / check.picture))
    return {fmt::format("check '{}' leaves no picture", check.id)};
  constexpr std::string_view kAtOnce = "data-start=\"0\"";
  if (!check.replay.empty() && readTextFile(workFolder / check.replay).find(kAtOnce) != std::string::npos)
    return {fmt::format("the replay of check '{}' begins at 0 s, not where it went wrong", check.id)};
  return {};
}

// Complaints if the result is not what the variant promises.
Complaints whyNotCaughtIn(const grading::GradeResult& result, const submission::WrongVariant& variant,
                          const path& workFolder) {
  if (variant.caughtBy.front() == submission::kForbiddenCall) return whyNotRefused(result);
  if (result.outcome == grading::Outcome::kCompileError || result.outcome == grading::Outcome::kGraderError)
    return {"it was not graded: " + result.message};
  for (const std::string& id : variant.caughtBy)
    if (checkNamed(result, id, variant).status == grading::Outcome::kPass)
      return {fmt::format("check '{}' does not catch this mistake: {}", id, variant.mistake)};
  if (result.score >= result.maxScore) return {"it gets the full score"};
  Complaints missing;
  for (const std::string& id : variant.shownBy)
    for (std::string& what : missingOf(checkNamed(result, id, variant), workFolder))
      missing.push_back(std::move(what));
  return missing;
}

void requireChecks(const submission::WrongVariant& variant, const std::vector<std::string>& known) {
  for (const auto* ids : {&variant.caughtBy, &variant.shownBy})
    for (const std::string& id : *ids)
      if (id != submission::kForbiddenCall && std::find(known.begin(), known.end(), id) == known.end())
        throw grading::unknownCheck(id, known, variant.namedAt.at(id));
}

grading::GradeResult gradeWhole(const GateContext& context, const submission::WrongVariant& variant,
                                const SketchedVariants* sketched = nullptr) {
  submission::SubmissionOptions options = gradingOf(context, variant);
  if (sketched != nullptr) sketched->listenTo(options.job);
  writeTextFile(options.main, variant.source);
  return submission::gradeSubmission(context.toolchain, context.exercise, options).result;
}

// Runs only the checks that the variant names, and those that are sketched: as soon as one of the former
// fails, the full score is out of reach.
grading::GradeResult gradeLinked(const GateContext& context, const submission::BuiltSubmission& built,
                                 const submission::WrongVariant& variant, const SketchedVariants& sketched) {
  if (built.worker.empty()) return built.start;
  submission::SubmissionOptions options = gradingOf(context, variant);
  options.workFolder = built.worker.parent_path();
  options.job.checks = variant.caughtBy;
  options.job.checks.insert(options.job.checks.end(), variant.shownBy.begin(), variant.shownBy.end());
  sketched.listenTo(options.job);
  return submission::gradeBuilt(built, context.toolchain, context.exercise, options);
}

// The pictures of the checks of `ids` that failed, on the sheet.
void addPictures(std::vector<KeyFrame>& sheet, const grading::GradeResult& result,
                 const std::vector<std::string>& ids, const std::string& name, const path& workFolder) {
  for (const grading::CheckResult& check : result.checks)
    if (check.status != grading::Outcome::kPass && !check.picture.empty() &&
        std::find(ids.begin(), ids.end(), check.id) != ids.end())
      sheet.push_back({readPng(workFolder / check.picture), fmt::format("{}: {}", name, check.id)});
}

void writeSheet(const std::vector<KeyFrame>& pictures, const path& file) {
  if (pictures.empty()) return;
  writePng(
      contactSheet(pictures,
                   {.pictures = static_cast<int>(pictures.size()) + 1, .columns = 2, .pictureWidth = 900}),
      file);
}

// The variants that the context names, or all.
std::vector<submission::WrongVariant> wantedVariants(const GateContext& context) {
  const std::vector<std::string>& wanted = context.variants;
  requireVariants(context.exercise, wanted);
  std::vector<submission::WrongVariant> variants = exerciseVariants(context.exercise);
  if (!wanted.empty())
    std::erase_if(variants, [&](const submission::WrongVariant& variant) {
      return std::find(wanted.begin(), wanted.end(), variant.name) == wanted.end();
    });
  return variants;
}

// Complains if students read something else than the exercise's file says, or writes it there. The gate
// `evidence` wants the file. Messages of variants that were not tested stay as they are.
Complaints whyNotSeen(const GateContext& context, const SeenMessages& seen) {
  const path file = seenMessagesFile(context.exercise.folder);
  SeenMessages stored = std::filesystem::exists(file) ? readSeenMessages(file) : SeenMessages{};
  if (!context.variants.empty())
    std::erase_if(stored, [&](const auto& one) { return !seen.contains(one.first); });
  if (!context.storesMessages)
    return std::filesystem::exists(file) ? changedMessages(seen, stored) : Complaints{};
  SeenMessages all = seen;
  if (!context.variants.empty() && std::filesystem::exists(file)) all.merge(readSeenMessages(file));
  writeSeenMessages(all, file);
  return {};
}

grading::GradeResult gradeVariant(const GateContext& context, const JointBuild& build, std::size_t k,
                                  const submission::WrongVariant& variant, SketchedVariants& sketched) {
  grading::GradeResult result = build.holds(k) ? gradeLinked(context, build.link(k), variant, sketched)
                                               : gradeWhole(context, variant, &sketched);
  if (sketched.isNeeded()) sketched.takeVariant(variant);
  return result;
}

void takeSolution(const GateContext& context, const JointBuild& build, SketchedVariants& sketched) {
  const submission::BuiltSubmission built = build.linkReference();
  if (built.worker.empty())
    throw Error({.what = "solution.cpp cannot be linked", .found = built.start.message});
  submission::SubmissionOptions options = gradingOf(context, {});
  options.workFolder = built.worker.parent_path();
  sketched.listenTo(options.job);
  static_cast<void>(submission::gradeBuilt(built, context.toolchain, context.exercise, options));
  sketched.takeRight();
}

// The messages depend on what is stored, so this comes first.
void storeSketches(const GateContext& context, const JointBuild& build,
                   const std::vector<submission::WrongVariant>& variants, SketchedVariants& sketched) {
  for (std::size_t k = 0; sketched.isNeeded() && k < variants.size(); ++k)
    static_cast<void>(gradeVariant(context, build, k, variants[k], sketched));
  sketched.store();
}

void countQuestion(const submission::WrongVariant& variant, const std::string& message, CaughtTogether& all) {
  const bool isAsked = !variant.question.empty() && message.find(variant.question) != message.npos;
  if (isAsked) ++all.asked;
  if (!isAsked && !variant.question.empty())
    all.complaints.push_back(fmt::format("{}: nobody who makes this mistake is asked: {} They read: {}",
                                         variant.name, variant.question, message));
}

// Adds the complaints of `find`, each with the name of the variant.
template <class Find>
void addComplaints(std::vector<std::string>& complaints, const std::string& name, const Find& find) {
  try {
    for (const std::string& what : find()) complaints.push_back(fmt::format("{}: {}", name, what));
  } catch (const Error& error) {
    complaints.push_back(fmt::format("{}: {}", name, error.what()));
  }
}

}  // namespace

std::vector<submission::WrongVariant> exerciseVariants(const submission::ExerciseInfo& exercise) {
  const path solution = exercise.folder / "solution.cpp", wrong = wrongFileOf(exercise);
  if (!std::filesystem::exists(wrong)) return {};
  return submission::readVariants(readTextFile(solution), solution.string(), readTextFile(wrong),
                                  wrong.string());
}

std::vector<std::string> variantNames(const submission::ExerciseInfo& exercise) {
  const path wrong = wrongFileOf(exercise);
  if (!std::filesystem::exists(wrong)) return {};
  return submission::variantNamesIn(readTextFile(wrong));
}

void requireVariants(const submission::ExerciseInfo& exercise, const std::vector<std::string>& names) {
  const std::vector<std::string> known = variantNames(exercise);
  for (const std::string& name : names)
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw UsageError({.what = fmt::format("{} has no wrong variant '{}'", exercise.name, name),
                        .nearest = nearestNames(name, known)});
}

std::vector<std::string> whyNotCaught(const GateContext& context, const std::string& name) {
  requireVariants(context.exercise, {name});
  const std::vector<submission::WrongVariant> variants = exerciseVariants(context.exercise);
  const auto variant = std::find_if(variants.begin(), variants.end(),
                                    [&](const submission::WrongVariant& one) { return one.name == name; });
  return whyNotCaughtIn(gradeWhole(context, *variant), *variant, context.workFolder);
}

CaughtTogether whyNotCaughtTogether(const GateContext& context) {
  const std::vector<grading::CheckResult> checks = submission::listChecks(context.toolchain);
  std::vector<std::string> known, sources;
  for (const grading::CheckResult& check : checks) known.push_back(check.id);
  CaughtTogether all;
  std::vector<submission::WrongVariant> variants;
  for (const submission::WrongVariant& variant : wantedVariants(context))
    addComplaints(all.complaints, variant.name, [&]() -> Complaints {
      requireChecks(variant, known);
      sources.push_back(variant.source);
      variants.push_back(variant);
      return {};
    });
  const path solution = context.exercise.folder / "solution.cpp";
  const JointBuild build(context, submission::referenceText(readTextFile(solution), solution.string()),
                         sources);
  SketchedVariants sketched(context, variants, checks);
  if (sketched.isNeeded()) takeSolution(context, build, sketched);
  if (context.storesMessages) storeSketches(context, build, variants, sketched);
  SeenMessages seen;
  std::vector<KeyFrame> pictures;
  for (std::size_t k = 0; k < variants.size(); ++k) {
    const submission::WrongVariant& variant = variants[k];
    if (!build.holds(k)) all.alone.push_back(variant.name);
    addComplaints(all.complaints, variant.name, [&] {
      const grading::GradeResult result = gradeVariant(context, build, k, variant, sketched);
      seen[variant.name] = seenMessage(result, variant.caughtBy);
      addPictures(pictures, result, variant.caughtBy, variant.name, context.workFolder);
      return whyNotCaughtIn(result, variant, context.workFolder);
    });
    if (sketched.isNeeded()) countQuestion(variant, seen[variant.name], all);
  }
  if (!context.sheet.empty()) writeSheet(pictures, context.sheet);
  for (const Complaints& changed : {sketched.whyNotStored(), whyNotSeen(context, seen)})
    all.complaints.insert(all.complaints.end(), changed.begin(), changed.end());
  return all;
}

}  // namespace rex::authoring
