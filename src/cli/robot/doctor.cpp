#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <iterator>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <system_error>
#include <thread>
#include <tuple>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/exit_code.h"
#include "base/folders.h"
#include "base/process.h"
#include "base/text.h"
#include "cli/command_table.h"
#include "cli/file_watcher.h"
#include "cli/option_table_internal.h"
#include "cli/out_folder.h"
#include "cli/project.h"
#include "cli/results_internal.h"
#include "cli/robot/render_plan.h"
#include "cli/robot/robot_options_internal.h"
#include "cli/sandbox_choice.h"
#include "cli/terminal.h"
#include "render/figure.h"
#include "render/image.h"
#include "render/renderer.h"
#include "render/report.h"
#include "render/video_sink.h"
#include "sandbox/confinement.h"
#include "sandbox/probes.h"
#include "submission/exercise_info.h"
#include "submission/program_build.h"

namespace rex::cli {
namespace {

struct DoctorOptions {
  std::string gl = kUsualGl;  ///< auto, egl, osmesa or gpu
  bool json = false;
  bool sandbox = false;                   ///< attack the sandbox instead
  std::optional<sandbox::Level> level{};  ///< the sandbox level to test; empty: the best
};

using sandbox::Probe;

struct Trial {
  sandbox::Level level{};
  std::vector<Probe> probes{};
};

// The highest level at which all attacks fail, or the last one tried.
Trial tryLevels(const Project& project, sandbox::Level highest) {
  const PrivateFolder folder(temporaryFolder());
  Trial trial;
  for (const sandbox::Level level : sandbox::kConfiningLevels) {
    if (level > highest) continue;
    trial.probes = sandbox::attack({level, launcherPath(project)}, probePath(project), folder.path());
    if (std::all_of(trial.probes.begin(), trial.probes.end(), [](const Probe& p) { return p.held; })) {
      trial.level = level;
      break;
    }
    const auto broken =
        std::find_if(trial.probes.begin(), trial.probes.end(), [](const Probe& p) { return !p.held; });
    note(wrap(fmt::format("level {} does not hold here: {}{}", numberOf(level),
                          broken->ran ? broken->name + ": " : "", escapeForTerminal(broken->text)),
              2, 0));
  }
  return trial;
}

// Attacks the sandbox from inside with our own program. Returns kWeakSandbox unless the requested level
// holds.
ExitCode doctorOfSandbox(const Project& project, const DoctorOptions& options) {
  const Trial trial = tryLevels(project, options.level.value_or(sandbox::Level::kControlGroup));
  const bool ok = trial.level >= options.level.value_or(sandbox::Level::kFiles);
  Results results{.json = {{"level", numberOf(trial.level)}, {"probes", Json::array()}, {"ok", ok}}};
  for (const Probe& probe : trial.probes) {
    results.line("{:<10}  {}  {}", probe.name,
                 probe.held ? paint(Colour::kGreen, "held ") : paint(Colour::kRed, "fails"),
                 escapeForTerminal(probe.text));
    results.json["probes"].push_back({{"name", probe.name}, {"held", probe.held}, {"text", probe.text}});
  }
  results.lines.push_back(paint(Colour::kBold, describe(trial.level)));
  if (const std::string warning = sandbox::levelWarning(trial.level); !warning.empty())
    results.lines.push_back(wrap(warning, 0, 0));
  results.print(options.json);
  return ok ? ExitCode::kFull : ExitCode::kWeakSandbox;
}

namespace fs = std::filesystem;

enum class Status { kWorks, kMissing, kFails };

// One thing that was tried.
struct Finding {
  std::string name;
  std::string packages{};  // the Debian packages that it needs
  Status status = Status::kWorks;
  std::string text{};    // what works, or why it does not
  bool isNeeded = true;  // false: something else that works stands in for it
};

// The machine lacks something, and the message names the package.
struct Missing {
  std::string text;
};

// Runs an attempt, which returns what it found or throws. Paths of temporary files are dropped from messages.
Finding tryOut(const std::string& name, const std::string& packages,
               const std::function<std::string()>& attempt) {
  try {
    return {name, packages, Status::kWorks, attempt()};
  } catch (const Missing& missing) {
    return {name, packages, Status::kMissing, escapeForTerminal(missing.text)};
  } catch (const Error& error) {
    ErrorParts parts = error.parts();
    parts.where = {};
    const bool isMissing = parts.wanted.find("Debian package") != std::string::npos;
    return {name, packages, isMissing ? Status::kMissing : Status::kFails,
            escapeForTerminal(Error(std::move(parts)).what())};
  } catch (const std::exception& error) {
    return {name, packages, Status::kFails, escapeForTerminal(error.what())};
  }
}

[[noreturn]] void fail(const std::string& what) { throw Error({.what = what}); }

// The first line that a program prints about its version; empty if it is not installed.
std::string versionOf(const std::vector<std::string>& command) {
  constexpr double kPatience = 20;  // seconds
  const ProcessResult result = runProcess(command, {.timeout = kPatience});
  if (!result.started) return {};
  const std::string complaint = result.error.substr(0, result.error.find('\n'));
  const auto broken = [&](const std::string& how) {
    return Error(
        {.what = command[0] + " does not work", .found = complaint.empty() ? how : how + ": " + complaint});
  };
  if (result.timedOut) throw broken(fmt::format("no answer within {:g} s", kPatience));
  if (result.signal != 0) throw broken(fmt::format("termination by signal {}", result.signal));
  if (result.exitCode != 0) throw broken(fmt::format("exit code {}", result.exitCode));
  return result.output.substr(0, result.output.find('\n'));
}

// A red ball on the left and a blue box on the right, above the ground.
constexpr Color kRed{0.9f, 0.1f, 0.1f}, kBlue{0.1f, 0.2f, 0.9f};
const Eigen::Vector3d kBall(-0.6, 0, 0.5), kBox(0.6, 0, 0.5);

Picture testPicture() {
  return {
      .solids = {{.shape = {.type = ShapeType::kSphere, .radius = 0.4}, .X_WS = {.p = kBall}, .color = kRed},
                 {.shape = {.extent = {0.6, 0.6, 0.6}}, .X_WS = {.p = kBox}, .color = kBlue}}};
}

// Draws the test picture into `folder` and checks that the ball and the box are where they should be.
Image testImage(GlBackend backend, const fs::path& folder, std::string& description) {
  const Camera camera = lookAt({0, -4, 1.5}, {0, 0, 0.4});
  Renderer renderer({.width = 320, .height = 240, .gl = {.backend = backend}});
  description = renderer.describe();
  Image image = renderer.draw(testPicture(), camera);
  writePng(image, folder / "test.png");
  if (readPng(folder / "test.png") != image)
    fail("the test picture changed when it was written and read back");
  const auto colorAt = [&](const Eigen::Vector3d& p) {
    const auto at = project(camera, p, image.width, image.height);
    return image.at(static_cast<int>(at->x), static_cast<int>(at->y));
  };
  const auto ball = colorAt(kBall), box = colorAt(kBox);
  const bool isRed = ball[0] > 2 * ball[1] && ball[0] > 2 * ball[2];
  const bool isBlue = box[2] > 2 * box[0] && box[2] > 2 * box[1];
  if (!isRed || !isBlue) fail("the test picture is wrong: no red ball or blue box where they should be");
  return image;
}

// One of them is enough unless the user chose one.
std::vector<Finding> tryBackends(GlBackend wanted, const fs::path& folder) {
  constexpr std::array<std::tuple<GlBackend, const char*, const char*>, 3> kBackends = {
      {{GlBackend::kEgl, "egl", "libegl1 libgl1-mesa-dri"},
       {GlBackend::kOsMesa, "osmesa", "libosmesa6"},
       {GlBackend::kGpu, "gpu", "libegl1 libgl1-mesa-dri"}}};
  std::vector<Finding> findings;
  std::optional<Image> first;
  for (const auto& [backend, name, packages] : kBackends) {
    if (wanted == GlBackend::kAuto ? backend == GlBackend::kGpu : wanted != backend) continue;
    findings.push_back(tryOut(std::string("OpenGL by ") + name, packages, [&, one = backend] {
      std::string description;
      const auto start = std::chrono::steady_clock::now();
      const Image image = testImage(one, folder, description);
      const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - start;
      if (first && *first != image) fail(description + ": its pixels differ from those of the other backend");
      const char* same = first ? ", the same pixels" : "";
      first = image;
      return fmt::format("{}; test picture 320 x 240 as expected{}, in {:.0f} ms", description, same,
                         taken.count());
    }));
  }
  for (Finding& finding : findings) finding.isNeeded = finding.status == Status::kWorks || !first;
  return findings;
}

Finding tryFigures(const fs::path& folder) {
  return tryOut("figures", "gnuplot-nox", [&] {
    const std::string version = versionOf({"gnuplot", "--version"});
    const Figure figure{
        .title = "test", .xLabel = "x [m]", .yLabel = "y [m]", .series = {{.y = {0, 1, 0.5, 2}}}};
    static_cast<void>(encodeSvg(figure));
    writeFigure(figure, folder / "test-figure.png");
    static_cast<void>(readPng(folder / "test-figure.png"));
    return version + "; PNG and SVG";
  });
}

void writeTestVideo(const fs::path& file) {
  VideoSink sink(file);
  for (int i = 0; i < 5; ++i) {
    Image frame(64, 48);
    frame.rgb.assign(frame.rgb.size(), static_cast<std::uint8_t>(40 * i));
    sink.add(frame);
  }
  sink.finish();
}

Finding tryVideos(const fs::path& folder) {
  return tryOut("videos", "ffmpeg", [&] {
    const std::string version = versionOf({"ffmpeg", "-version"});
    for (const char* name : {"film.mp4", "film.webm", "film.gif"}) {
      if (const std::string missing = missingForVideo(name); !missing.empty()) throw Missing{missing};
      writeTestVideo(folder / name);
    }
    return version.substr(0, version.find(" Copyright")) + "; .mp4, .webm and .gif";
  });
}

Finding tryReplays(GlBackend backend, const std::vector<Finding>& backends) {
  std::string packages = backends.front().packages;
  return tryOut("replays", packages, [&] {
    const std::string page =
        reportPage({.title = "test", .film = {{0, testPicture()}}, .still = {.gl = {.backend = backend}}});
    return fmt::format("a page of {} KiB", page.size() / 1024);
  });
}

std::string processor() {
  const std::string key = "model name";
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    const std::size_t colon = line.find(": ");
    if (line.starts_with(key) && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown processor";
}

// Compiles and runs a small program, as `rex test` needs it.
Finding tryCompiler(const fs::path& folder) {
  return tryOut("compiler", "g++", [&] {
    const std::string version = versionOf({REX_COMPILER, "--version"});
    if (version.empty()) throw Missing{fmt::format("{} is not installed", REX_COMPILER)};
    std::ofstream(folder / "test.cpp") << "int main() { return 7; }\n";
    const ProcessResult compiled =
        runProcess({REX_COMPILER, "-std=c++20", "test.cpp", "-o", "test-program"}, {.directory = folder});
    const std::string complaint = compiled.error.substr(0, compiled.error.find('\n'));
    if (complaint.find("cannot execute") != std::string::npos)
      throw Missing{"a part is missing: " + complaint};
    if (!compiled.ok()) fail("it cannot compile a small program: " + complaint);
    if (runProcess({(folder / "test-program").string()}).exitCode != 7)
      fail("a program that it compiled does not work");
    return version;
  });
}

// The libraries that rex was built with.
Finding aboutLibraries() {
  return {.name = "libraries",
          .text = fmt::format("eigen {}.{}.{}, fmt {}.{}.{}, CLI11 {}, nlohmann-json {}.{}.{}",
                              EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION,
                              FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100, CLI11_VERSION,
                              NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR,
                              NLOHMANN_JSON_VERSION_PATCH)};
}

// How `rex watch` will notice saves; polling works, too.
Finding tryWatching(const fs::path& folder) {
  return {.name = "watch", .text = FileWatcher(folder / "main.cpp").describe()};
}

// The first complaint of the preprocessor about a header of what students compile; empty if all are there.
std::string missingHeader(const Project& project, const std::vector<std::string>& exercises) {
  const fs::path description = project.build / "student" / "program.json";
  if (!fs::exists(description)) return {};
  const submission::Toolchain toolchain = submission::readProgramToolchain(description).toolchain;
  std::string text;
  for (const std::string& exercise : exercises)
    for (const char* file : {"main.cpp", "show.cpp"})
      if (const fs::path path = project.files() / "exercises" / exercise / file; fs::exists(path))
        text += fmt::format("#include \"{}\"\n", path.string());
  std::vector<std::string> command = {toolchain.compiler};
  command.insert(command.end(), toolchain.flags.begin(), toolchain.flags.end());
  command.insert(command.end(), {"-M", "-x", "c++", "-"});
  const ProcessResult run = runProcess(command, {.input = text});
  if (run.ok() || !run.started) return {};  // that there is no compiler is said elsewhere
  const std::size_t error = run.error.find("error: ");
  return run.error.substr(error == std::string::npos ? 0 : error + 7,
                          run.error.find('\n', error) - error - 7);
}

// A build that was interrupted installs only some of them, and a broken one not all headers.
Finding aboutExercises(const Project& project) {
  const std::vector<std::string> all = submission::exerciseNames(project.files() / "exercises");
  if (const std::string header = missingHeader(project, all); !header.empty())
    return {.name = "exercises",
            .status = Status::kFails,
            .text = fmt::format("a header of the library is missing: {}; install rex again", header)};
  std::vector<std::string> missing;
  std::ranges::copy_if(all, std::back_inserter(missing),
                       [&](const std::string& one) { return !project.isBuilt(one); });
  const bool ok = missing.empty();
  return {.name = "exercises",
          .status = ok ? Status::kWorks : Status::kFails,
          .text = ok ? std::to_string(all.size()) : "not built in this rex: " + join(missing, ", ")};
}

// The level that `rex grade` would use. Own programs need none.
Finding trySandbox(const Project& project, const fs::path& folder) {
  const sandbox::Available best = sandbox::bestLevel(launcherPath(project), probePath(project), folder);
  const std::string warning = sandbox::levelWarning(best.level);
  std::string text = warning.empty() ? sandbox::describe(best.level) : warning;
  for (const std::string& reason : best.reasons) text += "; " + escapeForTerminal(reason);
  return {.name = "sandbox", .text = text + "; all attacks: rex doctor --sandbox"};
}

Finding aboutRex() {
#ifdef __clang__
  constexpr const char* kCompiler = "clang++";
#else
  constexpr const char* kCompiler = "g++";
#endif
  return {.name = "rex",
          .text = fmt::format("{}, by {} {}, on {} ({} threads)", REX_VERSION, kCompiler, __VERSION__,
                              processor(), std::thread::hardware_concurrency())};
}

bool isWell(const Finding& finding) { return finding.status == Status::kWorks || !finding.isNeeded; }

std::string toDo(const std::vector<Finding>& findings) {
  std::set<std::string> packages;
  std::vector<std::string> broken;
  for (const Finding& finding : findings) {
    if (isWell(finding)) continue;
    if (finding.status == Status::kMissing) packages.insert(finding.packages);
    if (finding.status == Status::kFails) broken.push_back(finding.name);
  }
  std::vector<std::string> steps;
  if (!packages.empty()) steps.push_back(fmt::format("apt-get install {}", join(packages, " ")));
  if (!broken.empty()) steps.push_back(fmt::format("repair what fails: {}", join(broken, ", ")));
  return steps.empty() ? "Nothing else is needed." : fmt::format("To do: {}", join(steps, "; then "));
}

const char* toString(Status status) {
  return status == Status::kWorks ? "works" : status == Status::kMissing ? "missing" : "fails";
}

// Tries everything that pictures need on this machine. kGraderFault if something needed does not work. One of
// the two OpenGL backends is enough unless `gl` names the one that must work.
ExitCode doctor(const Project& project, const DoctorOptions& options) {
  const GlBackend backend = parseBackend(options.gl);
  const PrivateFolder folder(temporaryFolder());
  std::vector<Finding> findings = tryBackends(backend, folder.path());
  const Finding replays = tryReplays(backend, findings);
  findings.insert(findings.begin(), {aboutRex(), tryCompiler(folder.path()), aboutLibraries()});
  findings.push_back(tryFigures(folder.path()));
  findings.push_back(tryVideos(folder.path()));
  findings.push_back(replays);
  findings.push_back(tryWatching(folder.path()));
  findings.push_back(aboutExercises(project));
  findings.push_back(trySandbox(project, folder.path()));
  const bool ok = std::all_of(findings.begin(), findings.end(), isWell);
  Results results{.json = {{"findings", Json::array()}, {"ok", ok}}};
  for (const Finding& finding : findings) {
    constexpr std::size_t kColumn = 28;
    const Colour colour = finding.status == Status::kWorks ? Colour::kGreen
                          : isWell(finding)                ? Colour::kYellow
                                                           : Colour::kRed;
    results.line("{:<18}  {} {}", finding.name, paint(colour, fmt::format("{:<7}", toString(finding.status))),
                 wrap(finding.text, kColumn, kColumn));
    results.json["findings"].push_back(
        {{"name", finding.name}, {"status", toString(finding.status)}, {"text", finding.text}});
  }
  results.lines.push_back(toDo(findings));
  results.print(options.json);
  return ok ? ExitCode::kFull : ExitCode::kGraderFault;
}

}  // namespace

void addDoctor(CLI::App* command, Action& action) {
  const auto options = std::make_shared<DoctorOptions>();
  command->footer(
      "Examples:\n  scripts/rex doctor\n  scripts/rex doctor --gl egl --json\n"
      "  scripts/rex doctor --sandbox --level 2");
  addGl(command, options->gl);
  const auto added =
      addOptions(command, {{"--json", options->json, "print JSON instead of a table"},
                           {"--sandbox", options->sandbox, "attack the sandbox that graded programs run in"},
                           OptionRow([options](CLI::App* app) { return addLevel(app, options->level); })});
  added[2]->needs(added[1]);
  command->callback([&action, options] {
    action = [options](const Project& p) {
      return options->sandbox ? doctorOfSandbox(p, *options) : doctor(p, *options);
    };
  });
}

}  // namespace rex::cli
