#include <algorithm>
#include <memory>
#include <optional>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "base/error.h"
#include "base/folders.h"
#include "base/text.h"
#include "base/text_file.h"
#include "cli/command_table.h"
#include "cli/json_internal.h"
#include "cli/option_table_internal.h"
#include "cli/out_folder.h"
#include "cli/student/own_program.h"
#include "cli/terminal.h"
#include "reports/markdown.h"
#include "submission/demonstrations.h"

namespace rex::cli {
namespace {

namespace fs = std::filesystem;
using submission::Demonstration;

constexpr int kLecture = 100'000;  // seconds of CPU time: as long as somebody looks
constexpr std::uint64_t kFirstSeed = 0;

struct DemoOptions {
  std::string which;  ///< a name or a chapter; empty: list all
  std::string out;    ///< a folder, or an .html file; empty: live
  bool json = false;
  bool noBrowser = false;
  std::optional<std::uint64_t> seed{};
  std::optional<int> runs{};
};

void sayJson(const std::vector<Demonstration>& all) {
  Json list = Json::array();
  for (const Demonstration& one : all)
    list.push_back({{"name", one.name},
                    {"chapter", one.chapter},
                    {"title", one.title},
                    {"about", one.about},
                    {"slides", one.slides},
                    {"formula", one.formula},
                    {"try", one.toTry},
                    {"seed", one.takesSeed},
                    {"runs", one.takesRuns},
                    {"file", one.file.string()}});
  say(dump(Json{{"demonstrations", list}}));
}

void sayTable(const std::vector<Demonstration>& all) {
  std::size_t width = 0;
  for (const Demonstration& one : all) width = std::max(width, one.name.size());
  for (const Demonstration& one : all) {
    const std::string start = fmt::format("{:2}  {:{}}  ", one.chapter, one.name, width);
    const std::string slides = one.slides.empty() ? "" : fmt::format(" ({})", one.slides);
    say(paint(Colour::kBold, start) + wrap(one.title + slides, start.size(), start.size()));
  }
}

// The one of that name, or the first of that chapter, whose others it names.
const Demonstration& choose(const std::vector<Demonstration>& all, const std::string& which) {
  const std::optional<int> chapter = parseNumber<int>(which);
  const auto found = std::ranges::find_if(
      all, [&](const Demonstration& one) { return chapter ? one.chapter == *chapter : one.name == which; });
  if (found == all.end()) {
    std::vector<std::string> names;
    for (const Demonstration& one : all) names.push_back(one.name);
    throw UsageError({.what = chapter
                                  ? fmt::format("no demonstration belongs to chapter {}", *chapter)
                                  : fmt::format("there is no demonstration '{}'", escapeForTerminal(which)),
                      .wanted = "a name or a chapter that `rex demo` lists",
                      .nearest = nearestNames(which, names)});
  }
  std::string others;
  for (const Demonstration& one : all)
    if (chapter && one.chapter == *chapter && one.name != found->name) others += " " + one.name;
  if (!others.empty())
    note(wrap(fmt::format("This is {}; chapter {} also has:{}", found->name, *chapter, others), 2, 0));
  return *found;
}

// Of its program.
std::vector<std::string> argumentsOf(const Demonstration& one, const DemoOptions& options) {
  const auto refuse = [&](const char* option, const char* what) {
    throw UsageError({.what = fmt::format("{} has no {}: {} has no effect", one.name, what, option)});
  };
  if (options.seed && !one.takesSeed) refuse("--seed", "random numbers");
  if (options.runs && !one.takesRuns) refuse("--runs", "runs to compare");
  if (!options.seed && !options.runs) return {};
  std::vector<std::string> words{std::to_string(options.seed.value_or(kFirstSeed))};
  if (options.runs) words.push_back(std::to_string(*options.runs));
  return words;
}

// In front of a class nobody waits for a compiler twice.
fs::path keptProgram(const Project& project, const Demonstration& one) {
  return project.root / ".rex" / "demonstrations" / one.name;
}

// What its pages say: LiveView (course/live_view.cpp) reads it.
std::string aboutVariable(const Demonstration& one) {
  std::string text = "REX_LIVE_ABOUT=" + one.title;
  for (const auto& [name, value] : submission::demonstrationFacts(one)) text += "\n" + name + "\t" + value;
  return text;
}

ExitCode writePage(const Project& project, const Demonstration& one, std::vector<std::string> arguments,
                   const fs::path& page) {
  makeOutPlace(page);
  const PrivateFolder work(project.workPlace("student"));
  const fs::path log = fs::path(page).replace_extension(".build.log");
  const ExitCode code = runOwnProgram(project, one.file,
                                      {.out = work.path(),
                                       .arguments = std::move(arguments),
                                       .seconds = kLecture,
                                       .environment = {"REX_LIVE=0", aboutVariable(one)},
                                       .listsFiles = false,
                                       .log = log,
                                       .keptAs = keptProgram(project, one)});
  if (code != ExitCode::kNotGradable) fs::remove(log);
  const fs::path replay = work.path() / (one.name + ".html");
  if (code != ExitCode::kFull || !fs::exists(replay)) return std::max(code, ExitCode::kBelow);
  fs::copy_file(replay, page, fs::copy_options::overwrite_existing);
  say(shown(page));
  return code;
}

// A page for each, and index.html, which leads to those that were written.
ExitCode writeAll(const Project& project, const std::vector<Demonstration>& all, const fs::path& folder) {
  makeOutFolder(folder);
  ExitCode code = ExitCode::kFull;
  for (const Demonstration& one : all)
    code = std::max(code, writePage(project, one, {}, folder / (one.name + ".html")));
  const std::string page = submission::demonstrationsPage(all, [&](const Demonstration& one) {
    const std::string name = one.name + ".html";
    return fs::exists(folder / name) ? name : "";
  });
  replaceTextFile(
      folder / "index.html",
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<title>Demonstrations</title>\n<style>body { font: 1.2rem/1.45 sans-serif; margin: 2rem; } "
      "table { border-collapse: collapse; width: 100%; } td, th { text-align: left; "
      "vertical-align: top; padding: 0.4rem 0.8rem; border-top: 1px solid #ccc; }</style>\n"
      "</head>\n<body>\n" +
          reports::markdownPage(page, [](const std::string& link) { return link; }).html +
          "</body>\n</html>\n",
      "the page of all demonstrations");
  say(shown(folder / "index.html"));
  return code;
}

ExitCode demo(const Project& project, const DemoOptions& options) {
  const std::vector<Demonstration> all =
      submission::demonstrations(project.files() / "share" / "demonstrations");
  if (options.json) {
    if (!options.which.empty() || !options.out.empty())
      throw UsageError({.what = "--json lists all demonstrations",
                        .found = escapeForTerminal(options.which + options.out),
                        .wanted = "nothing else"});
    sayJson(all);
    return ExitCode::kFull;
  }
  if (options.which.empty()) {
    if (options.seed || options.runs)
      throw UsageError({.what = "--seed and --runs are for one demonstration", .wanted = "its name"});
    if (!options.out.empty()) return writeAll(project, all, fs::absolute(options.out));
    sayTable(all);
    say("\nTo show one: scripts/rex demo NAME");
    return ExitCode::kFull;
  }
  const Demonstration& one = choose(all, options.which);
  const std::vector<std::string> arguments = argumentsOf(one, options);
  note(wrap(fmt::format("Chapter {}: {}. {}", one.chapter, one.title, one.about), 0, 0));
  if (!one.toTry.empty()) note(wrap("Try: " + one.toTry, 5, 0));
  if (fs::path(options.out).extension() == ".html")
    return writePage(project, one, arguments, fs::absolute(options.out));
  OwnRun how{.out = project.root / "out" / "demonstrations",
             .arguments = arguments,
             .seconds = kLecture,
             .keptAs = keptProgram(project, one)};
  if (options.noBrowser) how.environment = {"REX_LIVE=1"};
  if (!options.out.empty()) how.out = fs::absolute(options.out), how.environment = {"REX_LIVE=0"};
  how.environment.push_back(aboutVariable(one));
  return runOwnProgram(project, one.file, how);
}

}  // namespace

void addDemo(CLI::App* command, Action& action) {
  const auto options = std::make_shared<DemoOptions>();
  command->footer(
      "Examples:\n  scripts/rex demo\n  scripts/rex demo pid\n  scripts/rex demo 4\n"
      "  scripts/rex demo localize --seed 3 --runs 5 -o localize.html\n  scripts/rex demo -o pages\n\n"
      "The first line on standard output is the address of a page with sliders and buttons,\n"
      "which waits half a minute for a browser; where there is a screen, one opens. Without a\n"
      "terminal, or with -o, the demonstration plays by itself and becomes a page to replay. Of\n"
      "a chapter with several, the first is shown. Some print a table, of one run with each\n"
      "seed. Without a name, -o writes a page of each, and an index.\n"
      "Each is a short program in share/demonstrations, compiled at its first start.");
  command
      ->add_option("DEMONSTRATION", options->which, "a name, or a chapter of the script; without: list all")
      ->type_name("");
  addOptions(
      command,
      {{"-o,--out", options->out, "PATH", "write the replay to this folder or .html file, and serve nothing"},
       seedRow(options->seed, fmt::format("seed of the first run (default: {})", kFirstSeed)),
       {"--runs", options->runs, {1, 10'000}, "N", "runs in the table, each with the next seed"},
       {"--no-browser", options->noBrowser, "serve the page, and open no browser"},
       {"--json", options->json, "list all as JSON"}});
  command->callback(
      [&action, options] { action = [options](const Project& p) { return demo(p, *options); }; });
}

}  // namespace rex::cli
