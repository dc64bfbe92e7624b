#include <algorithm>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "authoring/release.h"
#include "base/error.h"
#include "base/folders.h"
#include "base/instant.h"
#include "base/process.h"
#include "base/text.h"
#include "cli/instructor/class_grades.h"
#include "cli/instructor/collect.h"
#include "cli/instructor/dev_verbs.h"
#include "cli/json_internal.h"
#include "cli/out_folder.h"
#include "cli/terminal.h"

namespace rex::cli {

namespace {

namespace fs = std::filesystem;

/// Builds and tries one copy of a release.
class Proof {
 public:
  explicit Proof(const fs::path& tree) : tree_(tree) {}

  void build() {
    if (fs::exists(tree_ / "scripts/check-links")) run({"scripts/check-links"}, 0);
    run({"cmake", "--preset", "release"}, 0);
    run({"cmake", "--build", "build/release", "--target", "rex"}, 0);
    run({kRex, "list"}, 0);
  }

  void tryExercise(const std::string& name) {
    run({kRex, "test", name}, 1);
    run({"env", "-u", "DISPLAY", "-u", "WAYLAND_DISPLAY", kRex, "run", name}, 0);
    if (filesIn(tree_ / "out" / name, ".png").empty())
      throw Error({.what = fmt::format("the release: {} drew no picture", name)});
  }

  std::string step() const {
    const std::lock_guard lock(mutex_);
    return step_;
  }

 private:
  static constexpr const char* kRex = "build/release/rex";

  void run(const std::vector<std::string>& command, int wanted) {
    constexpr double kLongest = 3 * 3600;
    constexpr std::size_t kShown = 1500;
    const std::string text = join(command, " ");
    {
      const std::lock_guard lock(mutex_);
      step_ = text;
    }
    const ProcessResult run = runProcess(command, {.directory = tree_, .timeout = kLongest});
    if (run.exitCode == wanted) return;
    const std::string said = run.output + run.error;
    note(escapeForTerminal(said.substr(said.size() - std::min(said.size(), kShown))));
    throw Error({.what = "the release does not work on its own: " + text,
                 .found = run.started ? fmt::format("exit code {}", run.exitCode) : run.error,
                 .wanted = fmt::format("{}", wanted)});
  }

  fs::path tree_;
  mutable std::mutex mutex_;
  std::string step_;
};

}  // namespace

void proveRelease(const fs::path& release, const fs::path& in) {
  std::optional<PrivateFolder> folder;
  if (in.empty()) folder.emplace(temporaryFolder());
  const fs::path tree = folder ? folder->path() / "student release" : in;
  fs::copy(release, tree, fs::copy_options::recursive);
  Proof proof(tree);
  const ProgressLine line([&] { return proof.step(); });
  proof.build();
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(tree / "exercises"))
    if (entry.is_directory()) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  for (const std::string& name : names) proof.tryExercise(name);
}

namespace {

void tellLeaks(const std::vector<authoring::Leak>& leaks) {
  constexpr std::size_t kMostTold = 20;
  for (std::size_t k = 0; k < std::min(leaks.size(), kMostTold); ++k)
    note(wrap(escapeForTerminal(toString(leaks[k])), 2, 0));
  if (leaks.size() > kMostTold) note(fmt::format("and {} more", leaks.size() - kMostTold));
}

std::string sizeOf(const authoring::LeakScan& scan) {
  const std::string packed =
      scan.packed == 0 ? "" : fmt::format(" ({} of them archives, which were opened)", scan.packed);
  return fmt::format("{} files{}, {:.1f} MB", scan.files, packed, static_cast<double>(scan.bytes) / 1e6);
}

void saySecrets(const std::vector<authoring::Secret>& secrets, bool isInstalled) {
  std::map<authoring::SecretKind, int> counts;
  for (const authoring::Secret& secret : secrets) ++counts[secret.kind];
  std::vector<std::string> parts;
  for (const auto& [kind, name] : std::map<authoring::SecretKind, const char*>{
           {authoring::SecretKind::kSolution, "lines of solutions"},
           {authoring::SecretKind::kHiddenCheck, "passages of hidden checks"},
           {authoring::SecretKind::kHiddenName, "texts of hidden checks"},
           {authoring::SecretKind::kVisibleCheck, "passages of visible checks"},
           {authoring::SecretKind::kWrongVariant, "passages of wrong variants"},
           {authoring::SecretKind::kLecturersNote, "lines of lecturer's notes"}})
    if (isInstalled || kind != authoring::SecretKind::kVisibleCheck)
      parts.push_back(fmt::format("{} {}", counts[kind], name));
  parts.emplace_back(counts.contains(authoring::SecretKind::kCourseSecret)
                         ? "the secret of the course"
                         : "no secret of the course (--secret-file)");
  constexpr std::size_t kColumn = 14;
  say("  looked for  " + wrap(join(parts, ", "), kColumn, kColumn));
}

// `out`: the release; empty after a mere scan, or if something leaks.
void sayJson(const authoring::LeakScan& scan, const fs::path& out, int exercises, bool proven) {
  Json leaks = Json::array();
  for (const authoring::Leak& leak : scan.leaks) leaks.push_back(toString(leak));
  say(dump(Json{{"written", out.empty() ? Json() : Json(shown(out))},
                {"exercises", exercises},
                {"files", scan.files},
                {"archives", scan.packed},
                {"bytes", scan.bytes},
                {"leaks", leaks},
                {"proven", proven}}));
}

ExitCode scanOnly(const Project& project, const ReleaseOptions& options) {
  if (!fs::is_directory(options.scan))
    throw UsageError({.what = "no such folder", .where = {options.scan.string()}});
  const std::vector<authoring::Secret> secrets = authoring::secretsOfCourse(project.root, options.secret);
  const authoring::LeakScan scan = authoring::scanForLeaks(
      options.scan, secrets, project.root / "src",
      options.installed ? authoring::TreeKind::kInstalled : authoring::TreeKind::kSource);
  const ExitCode code = scan.leaks.empty() ? ExitCode::kFull : ExitCode::kBelow;
  if (options.json) {
    sayJson(scan, {}, 0, false);
    return code;
  }
  tellLeaks(scan.leaks);
  say(fmt::format("{} holds {}", shown(options.scan), sizeOf(scan)));
  saySecrets(secrets, options.installed);
  say(fmt::format("  found       {} leak{}", scan.leaks.size(), scan.leaks.size() == 1 ? "" : "s"));
  return code;
}

// The exercises that are released; empty: all.
std::vector<std::string> chosenExercises(const Project& project, const ReleaseOptions& options,
                                         const classroom::Course& course) {
  std::vector<std::string> chosen;
  for (const std::string& name : options.only) chosen.push_back(project.exercise(name).name);
  const bool hasCourse = !options.course.empty();
  const std::vector<std::string> names =
      hasCourse ? courseExercises(project, course) : project.exerciseNames();
  if (options.until.empty()) return hasCourse ? names : chosen;
  if (!hasCourse && options.deadlines.empty())
    throw UsageError({.what = "--until",
                      .found = "no file with openings",
                      .wanted = "--course FILE.toml or --deadlines FILE.toml"});
  const std::optional<std::int64_t> time = parseInstant(
      options.until.find('T') == std::string::npos ? options.until + "T23:59:59Z" : options.until);
  if (!time)
    throw UsageError({.what = "--until",
                      .found = escapeForTerminal(options.until),
                      .wanted = "a day such as 2026-12-01, or a time such as 2026-12-01T08:00:00+01:00"});
  const classroom::LatePolicy policy = hasCourse ? course.policy : readDeadlines(project, options.deadlines);
  std::vector<std::string> without;
  for (const std::string& name : names)
    if (const std::optional<std::int64_t> opening = policy.at(name).opening; !opening)
      without.push_back(name);
    else if (*opening <= *time)
      chosen.push_back(name);
  if (!without.empty())
    note(wrap(fmt::format("Left out, since {} says no `opening` for them: {}",
                          shown(hasCourse ? options.course : options.deadlines), join(without, ", ")),
              2, 0));
  if (chosen.empty())
    throw UsageError(
        {.what = "--until", .found = fmt::format("no exercise that opens by {}", options.until)});
  return chosen;
}

}  // namespace

ExitCode devRelease(const Project& project, const ReleaseOptions& options) {
  requireSourceTree(project, "release");
  if (!options.scan.empty()) return scanOnly(project, options);
  const classroom::Course course =
      readClassCourse(project, {.course = options.course}, classroom::RosterUse::kLeave);
  const authoring::Release release =
      authoring::writeStudentRelease(project.root, fs::absolute(options.out),
                                     options.secret.empty() ? course.settings.secret : options.secret,
                                     chosenExercises(project, options, course));
  if (!release.scan.leaks.empty()) {
    if (options.json) {
      sayJson(release.scan, {}, 0, false);
    } else {
      tellLeaks(release.scan.leaks);
      note(fmt::format("Nothing was written: found {} leak{}.", release.scan.leaks.size(),
                       release.scan.leaks.size() == 1 ? "" : "s"));
    }
    return ExitCode::kBelow;
  }
  if (!options.json) {
    say(fmt::format("The student release is in {}", shown(options.out)));
    say(fmt::format("  holds       {} exercise{}, {}", release.exercises, release.exercises == 1 ? "" : "s",
                    sizeOf(release.scan)));
    saySecrets(release.secrets, false);
    say("  hand out    packages made of it (scripts/package): the tree itself has the visible checks");
  }
  const bool prove = options.prove || !options.proveIn.empty();
  if (prove)
    proveRelease(fs::absolute(options.out),
                 options.proveIn.empty() ? fs::path() : fs::absolute(options.proveIn));
  if (options.json)
    sayJson(release.scan, options.out, release.exercises, prove);
  else if (prove)
    say("  proven      a copy of it builds, every exercise is graded and draws its pictures");
  return ExitCode::kFull;
}

}  // namespace rex::cli
