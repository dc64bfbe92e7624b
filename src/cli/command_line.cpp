#include "cli/command_line.h"

#include <algorithm>
#include <exception>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "base/error.h"
#include "cli/cma.h"
#include "cli/command_line_internal.h"
#include "cli/commands.h"
#include "cli/dev_command_line_internal.h"
#include "cli/grade_many_command_line_internal.h"
#include "cli/terminal.h"

namespace rex::cli {

CLI::App* add(CLI::App& parent, const std::string& name, const std::string& purpose,
              const std::string& examples) {
  CLI::App* command = parent.add_subcommand(name, purpose);
  command->footer(examples);
  return command;
}

std::string wrongSeed(const std::string& text) {
  constexpr std::size_t kMostDigits = 18;
  const bool isOne =
      !text.empty() && text.size() <= kMostDigits && text.find_first_not_of("0123456789") == text.npos;
  return isOne ? ""
               : fmt::format("found {}, wanted a whole number of at most {} digits", harmless(text),
                             kMostDigits);
}

void addGl(CLI::App* command, std::string& gl) {
  command->add_option("--gl", gl, "OpenGL by auto, osmesa or egl (default: auto)")
      ->type_name("NAME")
      ->envname("REX_GL");
}

Action print(const std::string& text) {
  return [text](const Project&) {
    say(text.substr(0, text.find_last_not_of('\n') + 1));
    return ExitCode::kFull;
  };
}

namespace {

constexpr const char* kExitCodes =
    R"(Exit codes: 0 full score, 1 below full score, 2 cannot be graded (missing, does
not compile), 3 fault of the grader, the project or the machine, 4 the sandbox is
weaker than asked for, 64 wrong use.)";

constexpr const char* kOutHelp = "output folder (default: out/EXERCISE, or out/EXERCISE-solution)";

Action complain(const std::string& text) {
  return [text](const Project&) {
    note(text);
    return ExitCode::kUsage;
  };
}

void addList(CLI::App& program, Action& action) {
  add(program, "list", "Show all exercises with points, script section and title",
      "Example: scripts/rex list")
      ->callback([&] { action = list; });
}

void addRun(CLI::App& program, Action& action) {
  const auto options = std::make_shared<RunOptions>();
  CLI::App* command = add(program, "run", "Build your main.cpp, run it, show what it wrote",
                          "Examples:\n  scripts/rex run 01\n  scripts/rex run 01 --solution -o /tmp/look\n\n"
                          "The program runs inside the output folder; frames and plots land there.");
  addExercise(command, options->exercise);
  command->add_flag("--solution", options->solution, "run the reference solution instead of main.cpp");
  command->add_option("-o,--out", options->out, kOutHelp)->type_name("DIR");
  command->callback(
      [&action, options] { action = [options](const Project& p) { return run(p, *options); }; });
}

CLI::Option* addLevel(CLI::App* command, std::optional<int>& level) {
  return command->add_option("--level", level, "sandbox level that must hold, 0 to 3")
      ->check(CLI::Range(0, 3))
      ->type_name("N");
}

void addSeveral(CLI::App* command, TestManyOptions& options) {
  command
      ->add_option("EXERCISE", options.exercises,
                   "numbers, topics or whole names: 01, kinematics, 01-kinematics")
      ->type_name("");
  command->add_flag("--all", options.all, "all exercises");
  command->add_option("-j,--jobs", options.jobs, "of several, so many at once (default: one per processor)")
      ->check(CLI::Range(1, 1024).description(""))
      ->type_name("N");
}

void addTest(CLI::App& program, Action& action) {
  const auto many = std::make_shared<TestManyOptions>();
  TestOptions* options = &many->each;
  CLI::App* command =
      add(program, "test", "Grade your main.cpp: which checks pass, for how many points",
          "Examples:\n  scripts/rex test 01\n  scripts/rex test 01 --check step-hand --seed 17\n"
          "  scripts/rex test 01 --main /tmp/other.cpp --json\n  scripts/rex test 01 02 -j2\n"
          "  scripts/rex test --all\n\n"
          "The result file is results.json, results-partial.json with --check, or\n"
          "results-debug.json with --debug. Of several exercises -o DIR gets DIR/EXERCISE,\n"
          "--json is {\"schema\": \"rex-results/1\", \"results\": [...]}, and the exit code is\n"
          "the largest of theirs.\n" +
              std::string(kExitCodes));
  addSeveral(command, *many);
  command->add_flag("--solution", options->solution, "grade the reference solution");
  command->add_option("--main", options->main, "grade this file instead of main.cpp")->type_name("FILE");
  command->add_option("--check", options->checks, "only this check; may be given several times")
      ->allow_extra_args(false)
      ->type_name("NAME");
  addSeed(command, options->seed, "repeat the random cases of this seed");
  command->add_flag("--json", options->json, "print the result file and nothing else");
  command->add_flag("--debug", options->debug, "with the sanitizers: slow, names the lines of crashes");
  command->add_option("-o,--out", options->out, kOutHelp)->type_name("DIR");
  addLevel(command, options->level);
  command
      ->add_option("--secret-file", options->secret, "secret of the course, for the seeds of hidden checks")
      ->type_name("FILE");
  command->callback([&action, many] {
    const TestOptions& each = many->each;
    if (many->exercises.empty() != many->all) throw CLI::RequiredError("either EXERCISE or --all");
    if (each.solution && !each.main.empty()) throw CLI::ExcludesError("--main", "--solution");
    // The sanitizers read and map what a sandbox forbids.
    if (each.debug && each.level.value_or(0) > 0) throw CLI::ExcludesError("--debug", "--level");
    action = [many](const Project& p) { return testMany(p, *many); };
  });
}

void addReport(CLI::App& program, Action& action) {
  const auto options = std::make_shared<ReportOptions>();
  CLI::App* command =
      add(program, "report", "Write a result for Gradescope, GitHub, JUnit readers and others",
          "Examples:\n  scripts/rex report out/01-kinematics/results.json --format markdown\n"
          "  scripts/rex report results.json --format gradescope -o results/results.json\n\n"
          "Formats: exercism, github (annotations), gradescope, junit, markdown, prairielearn.\n"
          "Exit code 0: written, whatever the grade; 3: written, but the grader had failed.");
  command->add_option("RESULTS", options->results, "a result file that rex test left")
      ->type_name("")
      ->required();
  command->add_option("--format", options->format, "whose words")->type_name("NAME")->required();
  command->add_option("-o,--out", options->out, "file to write (default: print)")->type_name("FILE");
  command->callback([&action, options] { action = [options](const Project&) { return report(*options); }; });
}

void addBench(CLI::App& program, Action& action) {
  const auto options = std::make_shared<BenchOptions>();
  CLI::App* command = add(program, "bench", "Measure speed against other libraries",
                          "Examples:\n  scripts/rex bench\n  scripts/rex bench kinematics --json");
  command->add_option("NAME", options->names, "groups to measure (default: all)")->type_name("");
  command->add_flag("--json", options->json, "print JSON instead of a table");
  command->callback(
      [&action, options] { action = [options](const Project& p) { return bench(p, *options); }; });
}

void addDebug(CLI::App& program, Action& action) {
  const auto options = std::make_shared<DebugOptions>();
  CLI::App* command = add(program, "debug", "Run your main.cpp in the debugger gdb",
                          "Examples:\n  scripts/rex debug 01\n  scripts/rex debug 01 --print");
  addExercise(command, options->exercise);
  command->add_flag("--solution", options->solution, "debug the reference solution");
  command->add_flag("--print", options->print, "build, then only print the debugger's command line");
  command->callback(
      [&action, options] { action = [options](const Project& p) { return debug(p, *options); }; });
}

void addCurves(CLI::App& program, Action& action) {
  const auto options = std::make_shared<CurvesOptions>();
  CLI::App* command = add(program, "curves", "Find the shortest ways of a car with a turning radius",
                          "Examples:\n  scripts/rex curves --to 0,2,3.14159\n"
                          "  scripts/rex curves --from 0,0,0 --to -1,1,0 --radius 2 --json\n\n"
                          "Dubins' car drives forward only, that of Reeds and Shepp also backward.");
  command->add_option("--from", options->from, "where it starts (default: 0,0,0)")->type_name("x,y,th");
  command->add_option("--to", options->to, "where it goes: metres, and the heading in radians")
      ->type_name("x,y,th")
      ->required();
  command->add_option("--radius", options->radius, "of the tightest turn (default: 1)")->type_name("METRES");
  command->add_flag("--json", options->json, "print JSON");
  command->callback([&action, options] { action = [options](const Project&) { return curves(*options); }; });
}

void addSlam(CLI::App& program, Action& action) {
  const auto options = std::make_shared<SlamOptions>();
  CLI::App* command =
      add(program, "slam", "Make the map of a pose graph fit its measurements",
          "Examples:\n  scripts/rex slam data/graphs/streets.g2o --plot streets.png\n"
          "  scripts/rex slam data/graphs/streets.g2o -o better.g2o --json\n\n"
          "The file is one of g2o. Costs are sums of e^T information e over its edges, without a\n"
          "factor 1/2; --objective sesync takes the distances of rotation matrices instead.\n"
          "Exit code 1: it did not converge.");
  command->add_option("file", options->file, "pose graph (.g2o)")->type_name("FILE")->required();
  command->add_option("--objective", options->objective, "chi2 or sesync (default: chi2)")->type_name("NAME");
  command->add_option("--start", options->start, "chordal, file or odometry (default: chordal)")
      ->type_name("NAME");
  command
      ->add_option("--kernel", options->kernel,
                   "how large errors count: none, huber, cauchy or geman-mcclure (default: none)")
      ->type_name("NAME");
  command->add_option("--kernel-size", options->kernelSize, "from how many deviations on (default: 1)")
      ->type_name("NUMBER");
  command->add_option("--iterations", options->iterations, "at most (default: 100)")->type_name("COUNT");
  command->add_option("--plot", options->plot, "draw the poses before and after")->type_name("FILE.png");
  command->add_option("-o,--out", options->out, "write the graph with its new poses")->type_name("FILE.g2o");
  command->add_flag("--json", options->json, "print JSON");
  command->callback(
      [&action, options] { action = [options](const Project& p) { return slam(p, *options); }; });
}

void addFilter(CLI::App& program, Action& action) {
  const auto options = std::make_shared<FilterOptions>();
  CLI::App* command = add(
      program, "filter", "Let a filter follow the car: errors, consistency and a film",
      "Examples:\n  scripts/rex filter --filter ukf --seeds 50\n"
      "  scripts/rex filter --filter ekf-slam --landmarks 12 -o slam\n"
      "  scripts/rex filter --filter particles --range-bearing --max-range 15 -o lost --no-film\n"
      "  scripts/rex filter --filter ekf --assume-observation 0.3 --seeds 50 --json\n\n"
      "The car drives with u = (0.1, 0.2) from a start that is known. Filters: ekf, ukf, information, root,\n"
      "rts (ekf, then smoothed), particles; without a map ekf-slam, fast-slam, fast-slam-2; dead-reckoning.\n"
      "DIR gets filter.csv, figures of errors, NEES and map, and the film filter.mp4 of the first run.");
  const auto number = [&](const char* name, auto& value, const char* help, const char* unit) {
    command->add_option(name, value, help)->type_name(unit);
  };
  number("--filter", options->filter, "which one (default: ekf)", "NAME");
  number("--landmarks", options->landmarks, "how many (default: 5)", "N");
  number("--steps", options->steps, "of one second (default: 300)", "N");
  number("--dynamics-noise", options->dynamicsNoise, "of a step, metres and radians (default: 0.03)", "X");
  number("--observation-noise", options->observationNoise, "of what is seen (default: 0.5)", "METRES");
  command->add_flag("--range-bearing", options->rangeBearing, "see distance and bearing, not (ahead, left)");
  number("--bearing-noise", options->bearingNoise, "of bearings (default: 0.02)", "RADIANS");
  number("--max-range", options->maxRange, "how far the car sees (default: all)", "METRES");
  number("--field-of-view", options->fieldOfView, "around its heading (default: all)", "RADIANS");
  number("--assume-dynamics", options->assumeDynamics, "the filter believes in X times that noise", "X");
  number("--assume-observation", options->assumeObservation, "the same for what is seen", "X");
  number("--particles", options->particles, "how many (default: 1000)", "N");
  addSeed(command, options->seed, "of landmarks and noise (default: 0)");
  number("--seeds", options->seeds, "runs with so many seeds", "N");
  number("-o,--out", options->out, "folder for what is written", "DIR");
  command->add_flag("--no-film", options->noFilm, "no filter.mp4");
  command->add_flag("--json", options->json, "print JSON");
  command->callback([&action, options] { action = [options](const Project&) { return filter(*options); }; });
}

void addCma(CLI::App& program, Action& action) {
  const auto options = std::make_shared<CmaRunOptions>();
  CLI::App* command =
      add(program, "cma", "Count the evaluations that CMA-ES needs for a test function",
          "Examples:\n  scripts/rex cma --function ackley --dim 20 --seeds 20 -o curve\n"
          "  scripts/rex cma --function rastrigin --dim 10 --lambda 200 --seeds 10 --json\n"
          "  scripts/rex cma --function rastrigin --dim 10 --restarts 9\n\n"
          "Functions: sphere, ellipsoid, cigar, rosenbrock, ackley, griewank, rastrigin and schwefel, whose\n"
          "least value is 0. Starts, steps and targets are those of slide 9:32 unless given.\n"
          "Exit code 1: no run reached the target.");
  command->add_option("--function", options->function, "what to minimise")->type_name("NAME")->required();
  command->add_option("--dim", options->dimension, "numbers it depends on (default: 10)")->type_name("N");
  command->add_option("--sigma", options->deviation, "deviation of the first samples")->type_name("NUMBER");
  command->add_option("--x0-low", options->low, "runs start between this ...")->type_name("NUMBER");
  command->add_option("--x0-high", options->high, "... and this, in all coordinates")->type_name("NUMBER");
  command->add_option("--lambda", options->lambda, "samples per generation (default: 4 + 3 ln n)")
      ->type_name("COUNT");
  command->add_option("--target", options->target, "value at which a run is done")->type_name("NUMBER");
  command
      ->add_option("--restarts", options->restarts,
                   "begin again up to so often, with twice the samples (default: 0)")
      ->type_name("COUNT");
  command->add_option("--max-evaluations", options->maxEvaluations, "of one run (default: 1e7)")
      ->type_name("COUNT");
  addSeed(command, options->seed, "of the first run (default: 0)");
  command->add_option("--seeds", options->seeds, "runs with so many seeds (default: 1)")->type_name("COUNT");
  command->add_option("-o,--out", options->out, "draw how values fall, into this folder")->type_name("DIR");
  command->add_flag("--json", options->json, "print JSON");
  command->callback([&action, options] { action = [options](const Project&) { return cma(*options); }; });
}

void addRiccati(CLI::App& program, Action& action, bool isDiscrete) {
  const auto options = std::make_shared<RiccatiOptions>();
  options->isDiscrete = isDiscrete;
  const std::string name = isDiscrete ? "dare" : "care";
  CLI::App* command = add(
      program, name,
      std::string("Solve an algebraic Riccati equation in ") + (isDiscrete ? "discrete" : "continuous") +
          " time",
      "Example: scripts/rex " + name + " data/control/" + (isDiscrete ? "cart-steps" : "cart-pole") +
          ".json --json\n\n" +
          (isDiscrete
               ? "Solves X = A^T X A - A^T X B (R + B^T X B)^-1 B^T X A + Q; the control is u = -K x with\n"
                 "K = (R + B^T X B)^-1 B^T X A."
               : "Solves 0 = A^T X + X A - X B R^-1 B^T X + Q; the control is u = -K x with\n"
                 "K = R^-1 B^T X.") +
          " Exit code 1: there is no stabilizing solution, and why.");
  command
      ->add_option("file", options->file,
                   "{\"A\": [[...], ...], \"B\": ..., \"Q\": ..., \"R\": ...}, row by row")
      ->type_name("FILE.json")
      ->required();
  command->add_flag("--json", options->json, "print JSON");
  command->callback(
      [&action, options] { action = [options](const Project& p) { return riccati(p, *options); }; });
}

void addDoctor(CLI::App& program, Action& action) {
  const auto options = std::make_shared<DoctorOptions>();
  CLI::App* command =
      add(program, "doctor", "Try all that pictures need on this machine, or attack its sandbox",
          "Examples:\n  scripts/rex doctor\n  scripts/rex doctor --gl egl --json\n"
          "  scripts/rex doctor --sandbox --level 2");
  addGl(command, options->gl);
  command->add_flag("--json", options->json, "print JSON instead of a table");
  const auto* sandbox =
      command->add_flag("--sandbox", options->sandbox, "attack the sandbox that graded programs run in");
  addLevel(command, options->level)->needs(const_cast<CLI::Option*>(sandbox));
  command->callback([&action, options] {
    action = [options](const Project& p) {
      return options->sandbox ? doctorOfSandbox(p, *options) : doctor(p, *options);
    };
  });
}

// The innermost command that the arguments reached.
const CLI::App* reached(const CLI::App* app) {
  const auto inner = app->get_subcommands();
  return inner.empty() ? app : reached(inner.back());
}

// With the arguments that come before a subcommand: "rex scene FILE fk".
std::string fullName(const CLI::App* app) {
  if (app->get_parent() == nullptr) return "rex";
  std::string name = fullName(app->get_parent()) + " " + app->get_name();
  if (app->get_subcommands([](const CLI::App*) { return true; }).empty()) return name;
  for (const CLI::Option* option : app->get_options())
    if (option->get_positional()) name += " " + option->get_name(true);
  return name;
}

// Unknown words are best answered with the nearest known ones.
Action explainExtras(const CLI::App* command, const std::string& word) {
  std::vector<std::string> known;
  const bool isOption = word.starts_with("-");
  if (isOption) {
    for (const CLI::Option* option : command->get_options())
      for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
    if (std::ranges::find(known, word.substr(0, word.find('='))) != known.end())
      return complain(fmt::format("rex: option '{}' stands too early: wanted it behind `{}`", harmless(word),
                                  fullName(command)));
  } else {
    for (const CLI::App* inner : command->get_subcommands([](const CLI::App*) { return true; }))
      known.push_back(inner->get_name());
  }
  const std::string kind = isOption ? "option" : known.empty() ? "argument" : "command";
  const Error error({.what = fmt::format("{}: unknown {} '{}'", fullName(command), kind, harmless(word)),
                     .nearest = nearestNames(word, known)});
  return complain(fmt::format("{}\n`{} --help` shows what there is.", error.what(), fullName(command)));
}

bool isFlag(const CLI::App* command, const std::string& name) {
  for (; command != nullptr; command = command->get_parent())
    if (const CLI::Option* option = command->get_option_no_throw(name))
      return option->get_expected_max() == 0;
  return false;
}

// In our words what CLI11 says as "Could not convert: --margin = abc".
std::string reasonOf(const CLI::ParseError& error, const CLI::App* command) {
  const std::string text = error.what(), start = "Could not convert: ", sign = " = ";
  const std::size_t at = text.find(sign);
  if (!text.starts_with(start) || at == std::string::npos) return text;
  const std::string option = text.substr(start.size(), at - start.size());
  return Error({.what = option,
                .found = "'" + harmless(text.substr(at + sign.size())) + "'",
                .wanted = isFlag(command, option) ? "no value" : "a number"})
      .what();
}

Action parseCommandLine(int argc, const char* const* argv) {
  Action action = progress;
  CLI::App program("Robotics exercises: see, solve and test them. Without a command: your progress", "rex");
  program.footer(kExitCodes);
  program.require_subcommand(0, 1);
  program.get_formatter()->column_width(22);
  program.get_formatter()->label("REQUIRED", "");
  addList(program, action), addRun(program, action), addTest(program, action);
  addReport(program, action);
  addStudentCommands(program, action);
  addDebug(program, action), addScene(program, action), addRender(program, action);
  addSimulate(program, action), addPlan(program, action), addTrajectory(program, action),
      addCurves(program, action), addSlam(program, action), addFilter(program, action),
      addCma(program, action);
  addRiccati(program, action, false), addRiccati(program, action, true);
  addGradeMany(program, action);
  addDoctor(program, action), addBench(program, action);
  addDev(program, action);
  try {
    program.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    const CLI::App* command = reached(&program);
    return print(command->help(command == &program ? "" : fullName(command->get_parent())));
  } catch (const CLI::ParseError& error) {
    const CLI::App* command = reached(&program);
    // A misspelt option may be the one that is missed: it comes first.
    if (const std::vector<std::string> unknown = program.remaining(true); !unknown.empty())
      return explainExtras(command, unknown.front());
    return complain(fmt::format("{0}: {1}\n`{0} --help` explains the options.", fullName(command),
                                reasonOf(error, command)));
  }
  return action;
}

}  // namespace

int runCommandLine(int argc, const char* const* argv, const Project& project) {
  ExitCode code = ExitCode::kGraderFault;
  try {
    code = parseCommandLine(argc, argv)(project);
  } catch (const UsageError& error) {
    note(wrap(fmt::format("rex: {}", error.what()), 2, 0));
    code = ExitCode::kUsage;
  } catch (const Error& error) {
    note(wrap(fmt::format("rex: {}", error.what()), 2, 0));
  } catch (const std::exception& error) {
    note(fmt::format("rex: {}", error.what()));
  }
  return static_cast<int>(code);
}

}  // namespace rex::cli
