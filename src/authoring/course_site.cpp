#include "authoring/course_site.h"

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "authoring/release.h"
#include "base/error.h"
#include "base/escape.h"
#include "base/text_file.h"
#include "reports/markdown.h"
#include "submission/demonstrations.h"
#include "submission/exercise_info.h"

namespace rex::authoring {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// In the order in which the first page names them.
struct Document {
  const char* name;
  const char* title;
  bool isForLecturers = false;
};
constexpr Document kDocuments[] = {{"student.md", "For students"},
                                   {"programs.md", "Your own programs"},
                                   {"commands.md", "Commands"},
                                   {"setup.md", "Editors and other systems"},
                                   {"exercises.md", "The exercises"},
                                   {"course-map.md", "From slides to code"},
                                   {"errata.md", "Errata of the script"},
                                   {"geometry.md", "Geometry"},
                                   {"gaussians.md", "Gaussians"},
                                   {"gallery.md", "Gallery"},
                                   {"notation.md", "Notation"},
                                   {"scenes.md", "Scene files"},
                                   {"robot-files.md", "URDF, SRDF and MJCF"},
                                   {"teaching.md", "Teaching with rex", true},
                                   {"grading.md", "Grading a class", true},
                                   {"platforms.md", "Reports, CI services and Gradescope", true},
                                   {"writing-an-exercise.md", "Writing an exercise", true},
                                   {"sandbox.md", "The sandbox", true},
                                   {"architecture.md", "Architecture", true}};

// Writes pages, and keeps what the search looks through.
class SiteWriter {
 public:
  SiteWriter(fs::path root, fs::path target, std::vector<submission::ExerciseInfo> exercises,
             bool isForStudents)
      : root_(std::move(root)),
        target_(std::move(target)),
        exercises_(std::move(exercises)),
        isForStudents_(isForStudents) {}

  // Whether the site has that document.
  [[nodiscard]] bool has(const Document& document) const {
    return fs::exists(root_ / "share/doc" / document.name) && !(isForStudents_ && document.isForLecturers);
  }

  // A page from a Markdown file of the project, between two pieces of HTML. Returns its title.
  std::string addMarkdown(const fs::path& file, const fs::path& source, const std::string& before = "",
                          const std::string& after = "") {
    std::string text = readTextFile(root_ / source);
    if (isForStudents_) text = reports::forInstalledRex(std::move(text));
    return addText(file, source, text, before, after);
  }

  // The same from a text whose links are those of a file `source`.
  std::string addText(const fs::path& file, const fs::path& source, const std::string& text,
                      const std::string& before = "", const std::string& after = "") {
    const reports::MarkdownPage page = pageFrom(source, text, file.parent_path());
    const std::string title = page.sections.empty() ? file.stem().string() : page.sections.front().title;
    for (const reports::PageSection& section : page.sections)
      entries_.push_back({{"page", title},
                          {"heading", section.title},
                          {"url", file.generic_string() + "#" + section.anchor},
                          {"text", section.text}});
    write(file, title,
          before + (source.filename() == "course-map.md" ? linked(page.html) : page.html) + after);
    return title;
  }

  void write(const fs::path& file, const std::string& title, const std::string& body) {
    const std::string home = file.has_parent_path() ? "../" : "./";
    writeTextFile(
        target_ / file,
        fmt::format(
            "<!DOCTYPE html>\n<html lang=\"en\" data-home=\"{0}\">\n<head>\n<meta charset=\"utf-8\">\n"
            "<meta name=\"viewport\" content=\"width=device-width\">\n<title>{1}</title>\n"
            "<link rel=\"stylesheet\" href=\"{0}style.css\">\n</head>\n<body>\n"
            "<nav><a href=\"{0}index.html\">All exercises</a>"
            "<a href=\"{0}documents/demonstrations.html\">Demonstrations</a>"
            "<a href=\"{0}documents/course-map.html\">Course map</a>"
            "<a href=\"{0}documents/gallery.html\">Gallery</a>"
            "<span class=\"search\"><input type=\"search\" placeholder=\"Search\" "
            "aria-label=\"Search\"><ol></ol></span></nav>\n<main>\n{2}</main>\n"
            "<script src=\"{0}entries.js\"></script>\n<script src=\"{0}search.js\"></script>\n"
            "</body>\n</html>\n",
            home, htmlText(title), body));
    ++pages_;
  }

  void finish() {
    // A text of pages, not one of scripts: "</script>" in it must not end the element.
    std::string text = entries_.dump(-1, ' ', false, Json::error_handler_t::replace);
    for (std::size_t at = 0; (at = text.find("</", at)) != text.npos; at += 3) text.insert(at + 1, "\\");
    writeTextFile(target_ / "entries.js", "const entries = " + text + ";\n");
    for (const char* name : {"style.css", "search.js"})
      writeTextFile(target_ / name, readTextFile(root_ / "share" / "site" / name));
    for (const fs::path& picture : pictures_) {
      fs::create_directories((target_ / "documents" / picture).parent_path());
      fs::copy_file(root_ / "share" / "doc" / picture, target_ / "documents" / picture);
    }
  }

  [[nodiscard]] int pages() const { return pages_; }

 private:
  reports::MarkdownPage pageFrom(const fs::path& source, const std::string& text, const fs::path& folder) {
    try {
      return reports::markdownPage(
          text, [&](const std::string& link) { return targetOf(link, source.parent_path(), folder); });
    } catch (const Error& error) {
      ErrorParts parts = error.parts();
      if (parts.where.file.empty()) parts.where.file = source.generic_string();
      throw Error(std::move(parts));
    }
  }

  // The numbers of exercises on the site become links, from a page in a folder of the site.
  [[nodiscard]] std::string linked(std::string html) const {
    for (const submission::ExerciseInfo& one : exercises_) {
      const std::string number = fmt::format("<code>{}</code>", one.name.substr(0, one.name.find('-')));
      const std::string link =
          fmt::format("<a href=\"../exercises/{}.html\">{}</a>", htmlText(one.name), number);
      for (std::size_t at = 0; (at = html.find(number, at)) != html.npos; at += link.size())
        html.replace(at, number.size(), link);
    }
    return html;
  }

  // Where a link of a file in that folder leads from a page in `page`; empty: to nothing on the site.
  std::string targetOf(const std::string& link, const fs::path& from, const fs::path& page) {
    if (link.starts_with('#') || link.starts_with("http:") || link.starts_with("https:")) return link;
    const std::size_t hash = std::min(link.find('#'), link.size());
    const fs::path there = (from / link.substr(0, hash)).lexically_normal();
    const fs::path place = placeOf(there);
    if (place.empty()) return "";
    return place.lexically_relative(page.empty() ? "." : page).generic_string() + link.substr(hash);
  }

  // The file of the site that shows a file or folder of the project.
  fs::path placeOf(const fs::path& file) {
    const std::string name = file.generic_string();
    if (const fs::path inside = file.lexically_relative("share/doc"); name.starts_with("share/doc/")) {
      if ((file.extension() == ".png" || file.extension() == ".webp") && fs::is_regular_file(root_ / file)) {
        pictures_.insert(inside);
        return "documents" / inside;
      }
      const auto isIt = [&](const Document& one) { return inside == one.name && has(one); };
      if (std::any_of(std::begin(kDocuments), std::end(kDocuments), isIt))
        return fs::path("documents") / inside.stem().concat(".html");
    }
    if (const fs::path page = fs::path(file).replace_extension(".html");
        (name.starts_with("notes/") && file.extension() == ".md") || name.starts_with("demonstrations/"))
      return fs::exists(target_ / page) ? page : "";
    if (const fs::path inside = file.lexically_relative("exercises"); name.starts_with("exercises/")) {
      const fs::path exercise = *inside.begin();
      if (std::any_of(exercises_.begin(), exercises_.end(),
                      [&](const auto& one) { return exercise == one.name; }))
        return fs::path("exercises") / (exercise.string() + ".html");
    }
    return {};
  }

  fs::path root_, target_;
  std::vector<submission::ExerciseInfo> exercises_;
  bool isForStudents_;
  std::set<fs::path> pictures_;
  Json entries_ = Json::array();
  int pages_ = 0;
};

bool counts(const submission::ExercisePart& part, const SiteExercise& planned) {
  const auto& parts = planned.parts;
  return parts.empty() || std::find(parts.begin(), parts.end(), part.id) != parts.end();
}

int pointsOf(const submission::ExerciseInfo& exercise, const SiteExercise& planned) {
  int points = 0;
  for (const submission::ExercisePart& part : exercise.parts)
    points += counts(part, planned) ? part.points : 0;
  return points;
}

std::string pointsTable(const submission::ExerciseInfo& exercise, const SiteExercise& planned) {
  std::string rows, rules;
  for (const submission::ExercisePart& part : exercise.parts)
    rows += fmt::format("<tr><td>{}</td><td>{}</td></tr>\n", htmlText(part.title),
                        counts(part, planned) ? fmt::format("{}", part.points) : "does not count");
  if (planned.isBonus) rules += " The exercise is a bonus: its points come on top.";
  if (!planned.minimum.empty())
    rules += fmt::format(" The minimum is {} of these points.", htmlText(planned.minimum));
  return fmt::format(
      "<h2 id=\"points\">Points</h2>\n<table>\n<tr><th>part</th><th>points</th></tr>\n{}"
      "<tr><th>together</th><th>{}</th></tr>\n</table>\n{}",
      rows, pointsOf(exercise, planned), rules.empty() ? "" : "<p>" + rules.substr(1) + "</p>\n");
}

std::string contract(const fs::path& folder) {
  return fmt::format("<h2 id=\"contract\">The functions: exercise.h</h2>\n<pre><code>{}</code></pre>\n",
                     htmlText(readTextFile(folder / "exercise.h")));
}

std::string linkTo(const std::string& file, const std::string& title) {
  return fmt::format("<li><a href=\"{}\">{}</a></li>\n", htmlText(file), htmlText(title));
}

// What the plan says about an exercise.
SiteExercise plannedOf(const SitePlan& plan, const std::string& name) {
  for (const SiteExercise& one : plan.exercises)
    if (one.name == name) return one;
  return {};
}

// The first picture named in the README of an exercise that its solution has drawn; empty if there is none.
fs::path pictureOf(const fs::path& root, const submission::ExerciseInfo& exercise) {
  const std::string readme = readTextFile(exercise.folder / "README.md");
  for (std::size_t end = 0; (end = readme.find(".png`", end)) != readme.npos; ++end) {
    const std::size_t start = readme.rfind('`', end) + 1;
    const fs::path file =
        root / "out" / (exercise.name + "-solution") / readme.substr(start, end + 4 - start);
    if (fs::is_regular_file(file)) return file;
  }
  return {};
}

// `documents`, `forLecturers` and `notes` are items of lists, `drawn` the exercises that have a picture.
std::string firstPage(const std::vector<submission::ExerciseInfo>& exercises, const SitePlan& plan,
                      const std::set<std::string>& drawn, const std::string& documents,
                      const std::string& forLecturers, const std::string& notes) {
  std::string rows;
  const auto& planned = plan.exercises;
  const bool hasDates = std::any_of(planned.begin(), planned.end(), [](const auto& one) {
    return !one.opening.empty() || !one.deadline.empty();
  });
  const bool hasMinima =
      std::any_of(planned.begin(), planned.end(), [](const auto& one) { return !one.minimum.empty(); });
  for (const submission::ExerciseInfo& one : exercises) {
    const SiteExercise here = plannedOf(plan, one.name);
    std::string more;
    if (hasMinima) more += fmt::format("<td>{}</td>", htmlText(here.minimum));
    if (hasDates)
      more += fmt::format("<td>{}</td><td>{}</td>", htmlText(here.opening), htmlText(here.deadline));
    const std::string picture =
        drawn.contains(one.name)
            ? fmt::format("<img class=\"small\" src=\"exercises/{}.png\" alt=\"\">", htmlText(one.name))
            : "";
    rows += fmt::format(
        "<tr><td><a "
        "href=\"exercises/{0}.html\">{0}</a>{5}</td><td>{1}</td><td>{2}</td><td>{3}</td>{4}</tr>\n",
        htmlText(one.name), htmlText(one.title), htmlText(one.script),
        fmt::format("{}{}", pointsOf(one, here), here.isBonus ? ", bonus" : ""), more, picture);
  }
  std::string rules;
  for (const std::string& rule : plan.rules) rules += "<li>" + htmlText(rule) + "</li>\n";
  return fmt::format(
             "<h1>{}</h1>\n<table class=\"names\">\n<tr><th>exercise</th><th>about</th>"
             "<th>script</th><th>points</th>{}{}</tr>\n{}</table>\n{}<h2>Documents</h2>\n<ul>\n{}</ul>\n",
             htmlText(plan.title), hasMinima ? "<th>minimum</th>" : "",
             hasDates ? "<th>opens</th><th>due</th>" : "", rows,
             rules.empty() ? "" : "<h2>What counts</h2>\n<ul>\n" + rules + "</ul>\n", documents) +
         (forLecturers.empty() ? "" : "<h2>For lecturers</h2>\n<ul>\n" + forLecturers + "</ul>\n") +
         (notes.empty() ? "" : "<h2>Lecturer's notes</h2>\n<ul>\n" + notes + "</ul>\n");
}

// Returns links to them.
std::string addNotes(SiteWriter& site, const fs::path& root) {
  std::vector<std::string> names;
  if (fs::is_directory(root / "notes"))
    for (const auto& entry : fs::directory_iterator(root / "notes"))
      if (entry.path().extension() == ".md") names.push_back(entry.path().stem().string());
  if (names.empty())
    throw Error({.what = "no lecturer's notes",
                 .where = {(root / "notes").string()},
                 .wanted = "files such as 01-kinematics.md"});
  std::sort(names.begin(), names.end());
  std::string links;
  for (const std::string& name : names) {
    const std::string page = "notes/" + name + ".html";
    links += linkTo(
        page, site.addMarkdown(page, "notes/" + name + ".md",
                               "<p class=\"private\">For lecturers: students must not get this page.</p>\n"));
  }
  return links;
}

// A list of them, and a page for each that has a replay. Returns a link to the list.
std::string addDemonstrations(SiteWriter& site, const fs::path& root, const fs::path& target,
                              CourseSite& result) {
  const fs::path folder = "demonstrations", list = "documents/demonstrations.html";
  const std::vector<submission::Demonstration> all =
      submission::demonstrations(root / "share" / "demonstrations");
  if (all.empty()) return "";
  result.demonstrations = static_cast<int>(all.size());
  for (const submission::Demonstration& one : all) {
    const fs::path name = one.name + ".html", replay = root / "out" / folder / name;
    if (!fs::is_regular_file(replay)) continue;
    fs::create_directories(target / folder / "replays");
    fs::copy_file(replay, target / folder / "replays" / name);
    const std::string frame = "replays/" + name.string(), title = htmlText(one.title);
    site.addText(folder / name, folder / name,
                 fmt::format("# {}\n\n{}\n", markdownText(one.title), markdownText(one.about)), "",
                 fmt::format("<iframe src=\"{}\" title=\"{}\" allowfullscreen></iframe>\n", frame, title));
    ++result.playing;
  }
  return linkTo(list, site.addText(list, "demonstrations/index.md",
                                   submission::demonstrationsPage(all, [&](const auto& one) {
                                     const std::string page = one.name + ".html";
                                     return fs::exists(target / folder / page) ? page : "";
                                   })));
}

CourseSite writePages(const fs::path& root, const fs::path& target, SiteReaders readers,
                      const SitePlan& plan) {
  std::vector<submission::ExerciseInfo> exercises = submission::listExercises(root / "exercises");
  if (!plan.exercises.empty())
    std::erase_if(exercises, [&](const auto& one) { return plannedOf(plan, one.name).name.empty(); });
  SiteWriter site(root, target, exercises, !plan.exercises.empty() && readers == SiteReaders::kEverybody);
  CourseSite result{.exercises = static_cast<int>(exercises.size())};
  std::set<std::string> drawn;
  for (const submission::ExerciseInfo& one : exercises) {
    site.addMarkdown(fs::path("exercises") / (one.name + ".html"),
                     fs::path("exercises") / one.name / "README.md", "",
                     pointsTable(one, plannedOf(plan, one.name)) + contract(one.folder));
    const fs::path picture = pictureOf(root, one);
    if (picture.empty()) continue;
    fs::copy_file(picture, target / "exercises" / (one.name + ".png"));
    drawn.insert(one.name);
  }
  result.drawn = static_cast<int>(drawn.size());
  std::string documents, forLecturers, notes;
  for (const Document& one : kDocuments) {
    if (!site.has(one)) continue;
    const fs::path file = fs::path("share/doc") / one.name;
    const fs::path page = fs::path("documents") / file.stem().concat(".html");
    site.addMarkdown(page, file);
    (one.isForLecturers ? forLecturers : documents) += linkTo(page.generic_string(), one.title);
  }
  documents += addDemonstrations(site, root, target, result);
  if (readers == SiteReaders::kLecturers) notes = addNotes(site, root);
  site.write("index.html", plan.title, firstPage(exercises, plan, drawn, documents, forLecturers, notes));
  site.finish();
  result.pages = site.pages();
  return result;
}

}  // namespace

CourseSite writeCourseSite(const fs::path& root, const fs::path& target, const fs::path& courseSecret,
                           SiteReaders readers, const SitePlan& plan) {
  const auto unwritten = [&](const fs::filesystem_error& error) {
    return Error({.what = "cannot write the pages of the course",
                  .where = {(error.path1().empty() ? target : error.path1()).string()},
                  .found = error.code().message()});
  };
  try {
    if (fs::exists(target) && !(fs::is_directory(target) && fs::is_empty(target)))
      throw UsageError(
          {.what = "will not overwrite", .where = {target.string()}, .wanted = "an empty or new folder"});
  } catch (const fs::filesystem_error& error) {
    throw unwritten(error);
  }
  std::error_code ignored;
  try {
    CourseSite site = writePages(root, target, readers, plan);
    std::vector<Secret> secrets = secretsOfCourse(root, courseSecret);
    if (readers == SiteReaders::kLecturers)
      std::erase_if(secrets, [](const Secret& one) { return one.kind == SecretKind::kLecturersNote; });
    site.scan = scanForLeaks(target, secrets);
    if (!site.scan.leaks.empty()) fs::remove_all(target);
    return site;
  } catch (const fs::filesystem_error& error) {
    fs::remove_all(target, ignored);
    throw unwritten(error);
  } catch (...) {
    fs::remove_all(target, ignored);
    throw;
  }
}

}  // namespace rex::authoring
