#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include "cli/command_line_internal.h"
#include "cli/instructor/dev_verbs.h"
#include "cli/instructor/instructor_room_internal.h"

namespace rex::cli {
namespace {

void addDevNew(CLI::App* dev, Action& action) {
  const auto name = std::make_shared<std::string>();
  CLI::App* command = addVerb(dev, "new", "Make a new exercise that passes its own gates",
                              "Example: scripts/rex dev new 99-demo");
  command->add_option("NAME", *name, "two digits, a dash, a topic: 99-demo")->type_name("")->required();
  command->callback([&action, name] { action = [name](const Project& p) { return devNew(p, *name); }; });
}

void addDevCheck(CLI::App* dev, Action& action) {
  const auto options = std::make_shared<CheckOptions>();
  CLI::App* command =
      addVerb(dev, "check", "Check that exercises are complete, graded well and give nothing away",
              "Examples:\n  scripts/rex dev check 01\n  scripts/rex dev check 01 --gate solution --seeds 20\n"
              "  scripts/rex dev check 01 --gate points --gate names --json\n"
              "  scripts/rex dev check 01 --gate wrong --sheet pictures.png\n"
              "  scripts/rex dev check 01 --variant looks_away_too");
  CLI::Option* exercise =
      command->add_option("EXERCISE", options->exercise, "only this one (default: all)")->type_name("");
  command->add_option("--gate", options->gates, "only this gate; may be repeated")
      ->allow_extra_args(false)
      ->type_name("NAME");
  command->add_option("--variant", options->variants, "only this wrong variant; may be repeated")
      ->allow_extra_args(false)
      ->type_name("NAME")
      ->needs(exercise);
  command->add_flag("--list-gates", options->listGates, "print the names of the gates");
  command->add_flag("--json", options->json, "print JSON");
  command->add_option("--seeds", options->seeds, "seeds to try the solution with (default: 3)")
      ->type_name("N")
      ->check(CLI::Range(1, 10000).description(""));
  command->add_option("--sheet", options->sheet, "draw the pictures of checks that wrong variants fail")
      ->type_name("FILE.png")
      ->needs(exercise);
  command->callback(
      [&action, options] { action = [options](const Project& p) { return devCheck(p, *options); }; });
}

void addDevStrip(CLI::App* dev, Action& action) {
  struct Words {
    std::string exercise, out;
    bool release = false;
  };
  const auto words = std::make_shared<Words>();
  CLI::App* command = addVerb(dev, "strip", "Make main.cpp from solution.cpp",
                              "Example: scripts/rex dev strip 01\n\n"
                              "`rex dev release DIR` makes the tree for students.");
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
      addVerb(dev, "release", "Write the tree that students get, and look for leaks in it",
              "Examples:\n  scripts/rex dev release /tmp/students --prove\n"
              "  scripts/rex dev release /tmp/students --until 2026-12-01 --deadlines deadlines.toml\n"
              "  scripts/rex dev release --scan handouts\n\n"
              "The tree has no solution, hidden check or wrong variant.\n"
              "Exit code 1: something leaks; nothing was written.");
  CLI::Option* out = command->add_option("DIR", options->out, "new folder for the release")->type_name("");
  CLI::Option* prove = command->add_flag("--prove", options->prove,
                                         "build a copy and try every exercise in it (takes minutes)");
  CLI::Option* only = command->add_option("--only", options->only, "release this exercise; may be repeated")
                          ->allow_extra_args(false)
                          ->type_name("EXERCISE");
  CLI::Option* until =
      command->add_option("--until", options->until, "release the exercises that open by then: 2026-12-01")
          ->type_name("DATE")
          ->excludes(only);
  command->add_option("--deadlines", options->deadlines, "file with the openings, as for rex grade")
      ->type_name("FILE.toml")
      ->needs(until);
  until->needs("--deadlines");
  CLI::Option* proveIn =
      command
          ->add_option("--prove-in", options->proveIn, "like --prove, but in this new folder, which is kept")
          ->type_name("FOLDER");
  CLI::Option* scan =
      command->add_option("--scan", options->scan, "only look for leaks in this folder, write nothing")
          ->type_name("FOLDER")
          ->excludes(out)
          ->excludes(only)
          ->excludes(until)
          ->excludes(prove)
          ->excludes(proveIn);
  command
      ->add_flag("--installed", options->installed,
                 "this folder is an installed tree, with programs and libraries")
      ->needs(scan);
  command->add_flag("--json", options->json, "print JSON");
  command
      ->add_option("--secret-file", options->secret,
                   "secret of the course, which must not be in the tree either")
      ->type_name("FILE");
  command->callback([&action, options] {
    if (options->out.empty() && options->scan.empty()) throw CLI::RequiredError("DIR");
    action = [options](const Project& p) { return devRelease(p, *options); };
  });
}

void addDevSite(CLI::App* dev, Action& action) {
  const auto options = std::make_shared<SiteOptions>();
  CLI::App* command = addVerb(dev, "site", "Write pages about the course, for a browser or a printer",
                              "Example: scripts/rex dev site /tmp/site\n\n"
                              "Exercises, documents, gallery and a search; no server or network is needed.\n"
                              "Exit code 1: something leaks; nothing was written.");
  command->add_option("DIR", options->out, "new folder for the pages")->type_name("")->required();
  command
      ->add_option("--secret-file", options->secret,
                   "secret of the course, which must not be in the pages either")
      ->type_name("FILE");
  command->add_flag("--notes", options->notes, "also the lecturer's notes: pages that students must not get");
  command->add_flag("--json", options->json, "print JSON");
  command->callback(
      [&action, options] { action = [options](const Project& p) { return devSite(p, *options); }; });
}

void addDevStats(CLI::App* dev, Action& action) {
  const auto options = std::make_shared<StatsOptions>();
  CLI::App* command =
      addVerb(dev, "stats", "Show how a class did: points, and which checks fail most",
              "Examples:\n  scripts/rex dev stats results\n"
              "  scripts/rex dev stats results --json --deadlines course.toml\n"
              "  scripts/rex dev stats results --students\n"
              "  scripts/rex dev stats results -o points.png --parts parts.png\n\n"
              "Exit code 2: some results could not be read, or were changed; they are named.");
  command->add_option("DIR", options->results, "the folder of results that `rex grade` wrote")
      ->type_name("")
      ->required();
  CLI::Option* json = command->add_flag("--json", options->json, "print JSON");
  CLI::Option* csv = command->add_flag("--csv", options->csv, "print a table of the checks")->excludes(json);
  command
      ->add_flag("--students", options->students,
                 "print a table of the students: points, time and number of attempts")
      ->excludes(json)
      ->excludes(csv);
  command
      ->add_option("--deadlines", options->deadlines,
                   "say how the first full score lies to opening and deadline (a course file will do)")
      ->type_name("FILE.toml");
  command->add_option("-o,--out", options->figure, "draw the points of each exercise")->type_name("FILE.png");
  command->add_option("--parts", options->parts, "draw the mean points of each part")->type_name("FILE.png");
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
  addDevStrip(dev, action);
  addDevRelease(dev, action);
  addDevSite(dev, action);
  addDevStats(dev, action);
}

}  // namespace rex::cli
