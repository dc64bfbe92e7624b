#include <memory>
#include <string>
#include <utility>

#include <CLI/CLI.hpp>

#include "cli/command_line_internal.h"
#include "cli/command_table.h"
#include "cli/instructor/dev_verbs.h"
#include "cli/option_table_internal.h"

namespace rex::cli {
namespace {

void addDevNew(CLI::App* dev, Action& action) {
  const auto words = std::make_shared<std::pair<std::string, std::string>>();
  CLI::App* command =
      addVerb(dev, "new", "Make a new exercise",
              "Examples:\n  scripts/rex dev new 99-demo                  a small one that passes its gates\n"
              "  scripts/rex dev new 19-handEye exercise.h    the frame of one with these functions");
  command->add_option("NAME", words->first, "two digits (and a letter), a dash, a topic: 99-demo")
      ->type_name("")
      ->required();
  command->add_option("HEADER", words->second, "an exercise.h with comments for the functions")
      ->type_name("");
  command->callback([&action, words] {
    action = [words](const Project& p) { return devNew(p, words->first, words->second); };
  });
}

void addDevCheck(CLI::App* dev, Action& action) {
  const auto options = std::make_shared<CheckOptions>();
  CLI::App* command =
      addVerb(dev, "check", "Check that exercises are complete, graded well and give nothing away",
              "Examples:\n  scripts/rex dev check 01\n  scripts/rex dev check 01 --gate solution --runs 20\n"
              "  scripts/rex dev check 01 --gate points --gate names --json\n"
              "  scripts/rex dev check 01 --gate wrong --sheet pictures.png\n"
              "  scripts/rex dev check 01 --variant looks_away_too");
  CLI::Option* exercise =
      command->add_option("EXERCISE", options->exercise, "only this one (default: all)")->type_name("");
  const auto added = addOptions(
      command,
      {{"--gate", options->gates, "NAME", "only this gate; may be repeated"},
       {"--variant", options->variants, "NAME", "only this wrong variant; may be repeated"},
       {"--sheet", options->sheet, "FILE.png", "draw the pictures of checks that wrong variants fail"},
       {"--list-gates", options->listGates, "print the names of the gates"},
       {"--json", options->json, "print JSON"},
       {"--runs", options->runs, {1, 10'000}, "N", "runs of the solution, each with the next seed"}});
  for (const std::size_t k : {1, 2}) added[k]->needs(exercise);
  command->callback(
      [&action, options] { action = [options](const Project& p) { return devCheck(p, *options); }; });
}

void addDevViva(CLI::App* dev, Action& action) {
  const auto options = std::make_shared<VivaOptions>();
  CLI::App* command =
      addVerb(dev, "viva", "Ask about three lines of a person's own file, with answers",
              "Example: scripts/rex dev viva 01 classroom/ada/01-kinematics/main.cpp\n\n"
              "Each question changes a line by a sign, an index or the like, and the answer is the visible\n"
              "check that fails then, and its message. For a talk of five minutes about own work.\n"
              "Exit code 1: there are fewer than three.");
  addExercise(command, options->exercise);
  command->add_option("FILE", options->file, "the main.cpp that was handed in")->type_name("")->required();
  addLevel(command, options->level);
  command->callback(
      [&action, options] { action = [options](const Project& p) { return devViva(p, *options); }; });
}

void addDevStrip(CLI::App* dev, Action& action) {
  struct Words {
    std::string exercise, out;
    bool release = false;
  };
  const auto words = std::make_shared<Words>();
  CLI::App* command =
      addVerb(dev, "strip", "Make main.cpp from solution.cpp",
              "Example: scripts/rex dev strip 01\n\n"
              "`rex dev release DIR` does so for the tree that students' packages are built from.");
  command->add_option("EXERCISE", words->exercise, "exercise whose main.cpp is written")->type_name("");
  // Earlier versions made the release with these options: say what to use now instead of "unknown option".
  command->add_flag("--release", words->release)->group("");
  command->add_option("-o,--out", words->out)->group("");
  command->callback([&action, words] {
    if (words->release || !words->out.empty())
      throw CLI::ValidationError("to make the student release, use: scripts/rex dev release " +
                                 (words->out.empty() ? "DIR" : words->out));
    if (words->exercise.empty()) throw CLI::RequiredError("EXERCISE");
    action = [words](const Project& p) { return devStrip(p, words->exercise); };
  });
}

void addDevRelease(CLI::App* dev, Action& action) {
  const auto options = std::make_shared<ReleaseOptions>();
  CLI::App* command =
      addVerb(dev, "release", "Write the tree for students' packages, and look for leaks in it",
              "Examples:\n  scripts/rex dev release /tmp/students 01 02 --prove\n"
              "  scripts/rex dev release /tmp/students --until 2026-12-01 --course course.toml\n"
              "  scripts/rex dev release --scan handouts\n\n"
              "The tree has no solution, hidden check or wrong variant, but visible checks: hand out the\n"
              "packages that scripts/package makes of it.\n"
              "Exit code 1: something leaks; nothing was written.");
  CLI::Option* out = command->add_option("DIR", options->out, "new folder for the release")->type_name("");
  CLI::Option* only =
      command->add_option("EXERCISE", options->only, "release only these exercises (default: all)")
          ->type_name("");
  const auto added = addOptions(
      command,
      {{"--until", options->until, "DATE", "release the exercises that open by then: 2026-12-01"},
       {"--deadlines", options->deadlines, "FILE.toml", "file with the openings, as for rex grade"},
       {"--prove", options->prove, "build a copy and try every exercise in it (takes minutes)"},
       {"--prove-in", options->proveIn, "DIR", "like --prove, but in this new folder, which is kept"},
       {"--scan", options->scan, "DIR", "only look for leaks in this folder, write nothing"},
       {"--installed", options->installed, "this folder is an installed tree, with programs and libraries"},
       {"--json", options->json, "print JSON"},
       {"--secret-file", options->secret, "FILE",
        "secret of the course, which must not be in the tree either"},
       {"--course", options->course, "FILE.toml", "only the exercises of this course, with its openings"}});
  CLI::Option *until = added[0], *scan = added[4], *course = added[8];
  until->excludes(only);
  added[1]->needs(until)->excludes(course);
  course->excludes(only)->excludes(scan);
  scan->excludes(out)->excludes(only)->excludes(until)->excludes(added[2])->excludes(added[3]);
  added[5]->needs(scan);
  command->callback([&action, options] {
    if (options->out.empty() && options->scan.empty()) throw CLI::RequiredError("DIR");
    action = [options](const Project& p) { return devRelease(p, *options); };
  });
}

void addDevSite(CLI::App* dev, Action& action) {
  const auto options = std::make_shared<SiteOptions>();
  CLI::App* command =
      addVerb(dev, "site", "Write pages about the course, for a browser or a printer",
              "Example: scripts/rex dev site /tmp/site\n\n"
              "Exercises, demonstrations, documents and a search; no server or network is needed.\n"
              "Exit code 1: something leaks; nothing was written.");
  command->add_option("DIR", options->out, "new folder for the pages")->type_name("")->required();
  addOptions(command,
             {{"--secret-file", options->secret, "FILE",
               "secret of the course, which must not be in the pages either"},
              {"--course", options->course, "FILE.toml",
               "only the exercises of this course, with its title and dates, and nothing for lecturers"},
              {"--notes", options->notes, "also the lecturer's notes: pages that students must not get"},
              {"--json", options->json, "print JSON"}});
  command->callback(
      [&action, options] { action = [options](const Project& p) { return devSite(p, *options); }; });
}

void addDevBench(CLI::App* dev, Action& action) {
  const auto options = std::make_shared<BenchOptions>();
  CLI::App* command = addVerb(dev, "bench", "Measure speed against other libraries",
                              "Examples:\n  scripts/rex dev bench --report out/bench.html\n"
                              "  scripts/rex dev bench kinematics --json");
  command->add_option("NAME", options->names, "groups to measure (default: all)")->type_name("");
  addOptions(command, {{"--json", options->json, "print JSON instead of a table"},
                       {"--report", options->report, "FILE.html", "also write a page with figures"}});
  command->callback(
      [&action, options] { action = [options](const Project& p) { return devBench(p, *options); }; });
}

void addDevStats(CLI::App* dev, Action& action) {
  const auto options = std::make_shared<StatsOptions>();
  CLI::App* command =
      addVerb(dev, "stats", "Show how a class did: points, and which checks fail most",
              "Examples:\n  scripts/rex dev stats results\n"
              "  scripts/rex dev stats results --json --course course.toml\n"
              "  scripts/rex dev stats results --students\n"
              "  scripts/rex dev stats results -o points.png --parts parts.png\n\n"
              "Exit code 2: some results could not be read, or were changed; they are named.");
  command->add_option("DIR", options->results, "the folder of results that `rex grade` wrote")
      ->type_name("")
      ->required();
  const auto added =
      addOptions(command, {{"--json", options->json, "print JSON"},
                           {"--csv", options->csv, "print a table of the checks"},
                           {"--students", options->students,
                            "print a table of the students: points, time and number of attempts"},
                           {"--deadlines", options->deadlines, "FILE.toml",
                            "say when the first full score came, by opening and deadline (or a course file)"},
                           {"--course", options->course, "FILE.toml",
                            "count the people of this course, with adjustments by people, not folders"},
                           {"-o,--out", options->figure, "FILE.png", "draw the points of each exercise"},
                           {"--parts", options->parts, "FILE.png", "draw the mean points of each part"}});
  added[1]->excludes(added[0]);
  added[2]->excludes(added[0])->excludes(added[1]);
  added[3]->excludes(added[4]);
  command->callback(
      [&action, options] { action = [options](const Project& p) { return devStats(p, *options); }; });
}

}  // namespace

void addDev(CLI::App* dev, Action& action) {
  dev->footer(
      "Examples:\n  scripts/rex dev new 99-demo\n  scripts/rex dev check\n"
      "  scripts/rex dev release /tmp/students\n  scripts/rex dev stats results");
  dev->require_subcommand(0, 1);
  dev->callback([&action, dev] {
    if (dev->get_subcommands().empty()) action = print(dev->help("rex"));
  });
  addDevNew(dev, action), addDevCheck(dev, action);
  addDevBench(dev, action);
  addDevStrip(dev, action);
  addDevRelease(dev, action);
  addDevSite(dev, action);
  addDevStats(dev, action);
  addDevViva(dev, action);
}

}  // namespace rex::cli
