#include "cli/instructor/class_grades.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/folders.h"
#include "base/isolated_call.h"
#include "base/text.h"
#include "base/text_file.h"
#include "classroom/grade_task.h"
#include "classroom/gradebook_text.h"
#include "classroom/similar.h"
#include "cli/instructor/collect.h"
#include "cli/json_internal.h"
#include "cli/terminal.h"

namespace rex::cli {

namespace fs = std::filesystem;

classroom::Course readClassCourse(const Project& project, const ClassFiles& files) {
  if (!files.course.empty()) return classroom::readCourse(files.course, project.exercises());
  return {.policy = readDeadlines(project, files.deadlines)};
}

std::vector<std::string> courseExercises(const Project& project, const classroom::Course& course) {
  std::vector<std::string> names = project.exerciseNames();
  if (!course.weights.empty())
    std::erase_if(names, [&](const std::string& one) { return !course.weights.contains(one); });
  return names;
}

classroom::GradebookSource readGradebookSource(const Project& project, const ClassFiles& files,
                                               const std::vector<classroom::Task>& tasks, const fs::path& out,
                                               const std::string& only) {
  classroom::GradebookSource source{.tasks = tasks, .out = out, .only = only};
  source.course = readClassCourse(project, files);
  source.imported = classroom::importTableIn(out);
  source.rejected = classroom::readRejected(out / kRejectedFile);
  for (const ExerciseInfo& exercise : project.exercises()) source.points[exercise.name] = exercise.points();
  const fs::path adjustments = files.adjustments.empty() ? source.course.adjustments : files.adjustments;
  if (!adjustments.empty())
    source.adjustments = classroom::readAdjustments(
        adjustments, classroom::withStudents(source.course, tasks, source.imported), project.exercises());
  return source;
}

classroom::Gradebook readGradebook(const Project& project, const ClassFiles& files,
                                   const std::vector<classroom::Task>& tasks, const fs::path& out,
                                   const std::string& only) {
  return classroom::makeGradebook(readGradebookSource(project, files, tasks, out, only));
}

void writeBook(const classroom::Gradebook& book, const fs::path& out, bool print) {
  const std::string text = classroom::gradesCsv(book.rows);
  replaceTextFile(out / "grades.csv", text, "the table of grades");
  replaceTextFile(out / kTotals, classroom::totalsCsv(book), "the table of totals");
  if (book.strangers.empty())
    fs::remove(out / kStrangers);
  else
    replaceTextFile(out / kStrangers, classroom::gradesCsv(book.strangers), "the table of strangers");
  if (print) std::fputs(text.c_str(), stdout);
  for (const std::string& sentence : book.notes) note(wrap(escapeForTerminal(sentence), 2, 0));
  for (const classroom::GradeRow& row : book.strangers)
    note(wrap(escapeForTerminal(fmt::format("'{}' is not on the roster: {} is graded and listed in {}",
                                            row.student.id, row.exercise, kStrangers)),
              2, 0));
  std::map<std::string_view, int> counts;
  for (const classroom::GradeRow& row : book.rows) ++counts[toString(row.status)];
  std::vector<std::string> parts;
  for (const auto& [status, count] : counts) parts.push_back(fmt::format("{} {}", count, status));
  note(fmt::format("{} students: {}", book.totals.size(), join(parts, ", ")));
}

ExitCode explainResults(const Project& project, const ExplainOptions& options) {
  const std::string name = project.exercise(options.exercise).name;
  const classroom::Gradebook book =
      readGradebook(project, options.files, tasksIn(options.out, options.manifest), options.out);
  std::vector<const classroom::GradeRow*> rows, found;
  std::vector<std::string> known, ids;
  for (const auto* part : {&book.rows, &book.strangers})
    for (const classroom::GradeRow& row : *part) {
      known.insert(known.end(), {row.student.id, row.student.name});
      if (row.exercise == name) rows.push_back(&row);
    }
  std::ranges::copy_if(rows, std::back_inserter(found),
                       [&](const auto* row) { return row->student.id == options.student; });
  const std::string called = classroom::caseless(options.student);
  if (found.empty())
    std::ranges::copy_if(rows, std::back_inserter(found),
                         [&](const auto* row) { return classroom::caseless(row->student.name) == called; });
  if (found.empty())
    throw UsageError({.what = fmt::format("no grade of '{}' for {}", options.student, name),
                      .wanted = "the id or the name of a student, and an exercise that was graded",
                      .nearest = nearestNames(options.student, known)});
  for (const auto* row : found) ids.push_back(row->student.id);
  if (found.size() > 1)
    throw UsageError({.what = fmt::format("several students are called '{}'", options.student),
                      .wanted = fmt::format("one of the ids {}", join(ids, ", "))});
  const std::vector<std::string> lines = classroom::explain(*found.front());
  if (options.json)
    say(dump(Json{{"student", ids.front()}, {"exercise", name}, {"lines", lines}}));
  else
    for (const std::string& line : lines) say(wrap(escapeForTerminal(line), 2, 0));
  return ExitCode::kFull;
}

void requireApart(const std::string& option, const fs::path& folder, const fs::path& other) {
  const fs::path here = fs::weakly_canonical(folder), there = fs::weakly_canonical(other);
  if (isBelow(here, there) || isBelow(there, here))
    throw UsageError(
        {.what = option, .found = here.string(), .wanted = "a folder apart from " + there.string()});
}

void requireFolder(const fs::path& folder, const std::string& wanted) {
  if (fs::is_directory(folder)) return;
  const fs::path whole = fs::absolute(folder).lexically_normal(),
                 path = whole.has_filename() ? whole : whole.parent_path();
  std::vector<std::string> beside;
  std::error_code failure;
  for (fs::directory_iterator entry(path.parent_path(), failure), end; !failure && entry != end;
       entry.increment(failure))
    if (entry->is_directory(failure)) beside.push_back(entry->path().filename().string());
  throw UsageError({.what = fs::exists(folder) ? "not a folder" : "no such folder",
                    .where = {folder.string()},
                    .wanted = wanted,
                    .nearest = nearestNames(path.filename().string(), beside)});
}

std::vector<classroom::Task> tasksIn(const fs::path& results, const fs::path& manifest) {
  requireFolder(results, "the folder of results that rex grade wrote");
  const fs::path file = manifest.empty() ? results / "tasks.tsv" : manifest;
  if (manifest.empty() && !fs::is_regular_file(file))
    throw UsageError({.what = "no folder of results",
                      .where = {results.string()},
                      .wanted = "the one that rex grade wrote, with tasks.tsv"});
  if (!fs::is_regular_file(file))
    throw UsageError({.what = "no such list of tasks",
                      .where = {file.string()},
                      .wanted = "one that rex grade --manifest wrote"});
  return classroom::readManifest(file);
}

namespace {

using classroom::StudentResult;

double percentOf(const grading::GradeResult& result) {
  return result.maxScore > 0 ? 100.0 * result.score / result.maxScore : 0;
}

// Exercises on an axis: at their numbers, 00b at 0.5, those without a number behind all others.
struct ExerciseAxis {
  std::map<std::string, double> places{};
  std::string label = "number of the exercise";
  double gap = 1;  // between neighbours
};

ExerciseAxis axisOf(const std::set<std::string>& exercises) {
  ExerciseAxis axis;
  double last = 0;
  for (const std::string& one : exercises) {
    std::string_view rest = one;
    const auto number = takeNumber<int>(rest);
    if (!number) continue;
    const bool isBetween = !rest.empty() && rest.front() != '-';
    axis.places[one] = *number + (isBetween ? 0.5 : 0);
    last = std::max<double>(last, *number);
    if (!isBetween) continue;
    axis.gap = 0.5;
    axis.label += fmt::format("; {}: {}", one.substr(0, one.find('-')), axis.places[one]);
  }
  for (const std::string& one : exercises)
    if (!axis.places.contains(one)) axis.places[one] = ++last;
  return axis;
}

// Offsets around 0: 0, 1, -1, 2, ... steps, which are narrower if there are many points.
double offsetOf(int k, int count, double gap) {
  constexpr double kStep = 0.06, kWidest = 0.4;
  const double step = gap * std::min(kStep, 2 * kWidest / std::max(1, count));
  return (k % 2 == 1 ? 1 : -1) * ((k + 1) / 2) * step;
}

// A field of one part; `share` is the part of the points that the class got.
Region fieldOf(double x, double y, double gap, double share) {
  constexpr double kHalfWidth = 0.48;
  const double halfHeight = 0.42 * gap;
  // A tenth less must be seen.
  const auto shade = static_cast<float>(std::sqrt(1 - std::clamp(share, 0.0, 1.0)));
  return {.x = {x - kHalfWidth, x + kHalfWidth, x + kHalfWidth, x - kHalfWidth},
          .y = {y - halfHeight, y - halfHeight, y + halfHeight, y + halfHeight},
          .color = Color{1 - 0.2F * shade, 1 - 0.8F * shade, 1 - shade}};
}

}  // namespace

Figure pointsFigure(const std::vector<StudentResult>& results) {
  std::set<std::string> exercises;
  for (const StudentResult& one : results) exercises.insert(one.exercise);
  const ExerciseAxis axis = axisOf(exercises);
  std::map<double, std::vector<double>> points;
  for (const StudentResult& one : results)
    if (one.result.outcome != grading::Outcome::kGraderError)
      points[axis.places.at(one.exercise)].push_back(percentOf(one.result));
  if (points.empty()) throw Error({.what = "no points to draw", .found = "only faults of the grader"});
  Series students{.label = "a student", .style = SeriesStyle::kPoints, .marker = Marker::kDot, .size = 2};
  Series medians{.label = "median", .style = SeriesStyle::kPoints, .marker = Marker::kPlus, .size = 3};
  for (const auto& [place, values] : points) {
    std::map<double, int> drawn;
    for (const double value : values) {
      const auto same = static_cast<int>(std::count(values.begin(), values.end(), value));
      students.x.push_back(place + offsetOf(drawn[value]++, same, axis.gap));
      students.y.push_back(value);
    }
    medians.x.push_back(place);
    medians.y.push_back(classroom::medianValue(values));
  }
  return {.title = "Points of the class",
          .xLabel = axis.label,
          .yLabel = "points [% of the maximum]",
          .xRange = AxisRange{points.begin()->first - 0.5, points.rbegin()->first + 0.5},
          .yRange = AxisRange{-5, 105},
          .legend = Legend::kOutside,
          .series = {std::move(students), std::move(medians)}};
}

Figure partsFigure(const std::vector<classroom::ExerciseStatistics>& all) {
  std::set<std::string> exercises;
  for (const classroom::ExerciseStatistics& one : all)
    if (one.graded > 0 && !one.parts.empty()) exercises.insert(one.exercise);
  if (exercises.empty()) throw Error({.what = "no points to draw", .found = "only faults of the grader"});
  const ExerciseAxis axis = axisOf(exercises);
  Figure figure{.title = "Mean points of the parts (darker: fewer)",
                .xLabel = "part",
                .yLabel = axis.label,
                .legend = Legend::kNone};
  std::size_t columns = 0;
  double first = axis.places.begin()->second, last = first;
  for (const classroom::ExerciseStatistics& one : all) {
    if (!exercises.contains(one.exercise)) continue;
    const double row = axis.places.at(one.exercise);
    first = std::min(first, row), last = std::max(last, row);
    columns = std::max(columns, one.parts.size());
    for (std::size_t k = 0; k < one.parts.size(); ++k) {
      const classroom::PartStatistics& part = one.parts[k];
      const double share = part.maxPoints > 0 ? part.meanPoints / part.maxPoints : 0;
      const auto column = static_cast<double>(k + 1);
      figure.regions.push_back(fieldOf(column, row, axis.gap, share));
      figure.notes.push_back(
          {.text = fmt::format("{} {:.0f} %", part.id, 100 * share), .x = column - 0.47, .y = row});
    }
  }
  figure.width = static_cast<int>(std::min<std::size_t>(8192, 330 + 130 * columns));
  figure.height = static_cast<int>(std::min(8192., 170 + 40 * ((last - first) / axis.gap + 1)));
  figure.xRange = AxisRange{0.5, static_cast<double>(columns) + 1.5};  // room for the last names
  figure.yRange = AxisRange{first - 0.5 * axis.gap, last + 0.5 * axis.gap};
  return figure;
}

namespace {

using classroom::ComparedText;

void writeForOthers(const fs::path& folder, const std::vector<ComparedText>& texts,
                    const std::string& handedOut) {
  for (const char* name : {"base", "submissions"}) fs::remove_all(folder / name);
  writeTextFile(folder / "base" / "main.cpp", handedOut);
  for (const ComparedText& one : texts)
    writeTextFile(folder / "submissions" / one.student / "main.cpp", one.text);
}

constexpr IsolationLimits kSimilarLimits{
    .cpuSeconds = 600, .wallSeconds = 6000, .memory = std::size_t{4} << 30};

// Who hands in together may hand in the same.
bool areOneGroup(const classroom::SimilarPair& pair, const classroom::Course& course) {
  const classroom::CourseStudent *first = course.student(pair.first), *second = course.student(pair.second);
  return first != nullptr && second != nullptr && !first->group.empty() && first->group == second->group;
}

}  // namespace

void writeSimilar(const Project& project, const classroom::Course& course,
                  const std::vector<classroom::Task>& tasks, const fs::path& out, const fs::path& folder,
                  int percent) {
  std::map<std::string, std::vector<ComparedText>> byExercise;
  for (const classroom::Task& task : tasks)
    byExercise[task.exercise].push_back({task.student, classroom::gradedText(out / task.file)});
  for (const auto& [name, texts] : byExercise) {
    const std::string handedOut = readTextFile(project.exercise(name).definition / "main.cpp");
    writeForOthers(folder / name, texts, handedOut);
    const auto compare = [&] {
      auto pairs = classroom::similarPairs(texts, handedOut, percent);
      std::erase_if(pairs, [&](const classroom::SimilarPair& pair) { return areOneGroup(pair, course); });
      const bool any = !pairs.empty();
      return Json{classroom::similarGroups(pairs),
                  any ? classroom::similarPage(name, texts, handedOut, pairs) : ""}
          .dump(-1, ' ', false, Json::error_handler_t::replace);
    };
    const IsolatedResult compared = callIsolated(compare, kSimilarLimits);
    if (compared.end != IsolatedEnd::kReturned)
      throw Error({.what = "cannot compare the submissions of " + name,
                   .found = "more than the limits of time and memory, or a crash",
                   .wanted = fmt::format("{:g} s, 4 GiB", kSimilarLimits.cpuSeconds)});
    const Json found = Json::parse(compared.bytes);
    const auto groups = found.at(0).get<std::vector<std::vector<std::string>>>();
    const fs::path page = folder / (name + ".html");
    if (groups.empty()) {
      fs::remove(page);
      say(fmt::format("{}: no two of {} submissions have {} % in common", name, texts.size(), percent));
      continue;
    }
    replaceTextFile(page, found.at(1).get<std::string>(), "the page of similar submissions");
    say(fmt::format("{}: {} group{} of similar submissions, to be looked at: {}", name, groups.size(),
                    groups.size() == 1 ? "" : "s", shown(page)));
    for (const std::vector<std::string>& group : groups)
      say("  " + wrap(escapeForTerminal(join(group, ", ")), 4, 2));
  }
}

}  // namespace rex::cli
