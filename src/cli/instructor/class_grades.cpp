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
#include "classroom/tutors.h"
#include "cli/instructor/collect.h"
#include "cli/json_internal.h"
#include "cli/terminal.h"

namespace rex::cli {

namespace fs = std::filesystem;

classroom::Course readClassCourse(const Project& project, const ClassFiles& files,
                                  classroom::RosterUse roster) {
  if (!files.course.empty()) return classroom::readCourse(files.course, project.exercises(), roster);
  return {.policy = readDeadlines(project, files.deadlines)};
}

ExitCode tellRoster(const classroom::Course& course) {
  for (const classroom::RosterFault& fault : course.faults)
    note(wrap(escapeForTerminal(fault.why + "; this row of the roster is not taken"), 2, 0));
  for (const std::string& sentence : course.notes) note(wrap(escapeForTerminal(sentence), 2, 0));
  return course.faults.empty() ? ExitCode::kFull : ExitCode::kNotGradable;
}

std::vector<std::string> courseExercises(const Project& project, const classroom::Course& course) {
  std::vector<std::string> names = project.exerciseNames();
  if (!course.exercises.empty())
    std::erase_if(names, [&](const std::string& one) { return !course.exercises.contains(one); });
  return names;
}

namespace {

// Those of the course and of its tutors, as one.
classroom::Adjustments readAllAdjustments(const Project& project, const classroom::Course& course,
                                          const ClassFiles& files) {
  const std::vector<ExerciseInfo> exercises = project.exercises();
  classroom::BlindIds blind;
  if (!course.settings.secret.empty() && fs::exists(course.settings.secret))
    blind = classroom::blindIds(classroom::classSecret(course.settings.secret), course);
  const fs::path own = files.adjustments.empty() ? course.adjustments : files.adjustments;
  classroom::Adjustments all;
  if (!own.empty()) all = classroom::readAdjustments(own, course, exercises, blind);
  std::vector<std::pair<std::string, classroom::Adjustments>> ofTutors;
  for (const classroom::Tutor& tutor : course.tutors)
    if (!tutor.adjustments.empty() && fs::exists(tutor.adjustments))
      ofTutors.emplace_back(tutor.name,
                            classroom::readAdjustments(tutor.adjustments, course, exercises, blind));
    else if (!tutor.adjustments.empty())
      all.notes.push_back(fmt::format("{} has not written {} yet", tutor.name, tutor.adjustments.string()));
  return classroom::mergeAdjustments(std::move(all), ofTutors);
}

}  // namespace

classroom::GradebookSource readGradebookSource(const Project& project, const ClassFiles& files,
                                               const classroom::ClassRun& run, const std::string& only) {
  classroom::GradebookSource source{.course = readClassCourse(project, files),
                                    .imported = classroom::importTableIn(run.out),
                                    .rejected = classroom::readRejected(run.out / kRejectedFile),
                                    .only = only};
  for (const ExerciseInfo& exercise : project.exercises())
    for (const submission::ExercisePart& part : exercise.parts)
      if (source.course.exercise(exercise.name).counts(part.id)) source.points[exercise.name] += part.points;
  source.adjustments =
      readAllAdjustments(project, classroom::withStudents(source.course, run.tasks, source.imported), files);
  return source;
}

classroom::Gradebook readGradebook(const Project& project, const ClassFiles& files,
                                   const classroom::ClassRun& run) {
  return classroom::makeGradebook(run, readGradebookSource(project, files, run));
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
    if (row.task)
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
      readGradebook(project, options.files, runIn(options.out, options.manifest));
  std::vector<std::string> known, folders;
  for (const classroom::StudentTotal& sum : book.totals)
    known.insert(known.end(), {sum.student.id, sum.student.name});
  for (const classroom::GradeRow& row : book.strangers) folders.push_back(row.student.id);
  const std::string id = classroom::studentCalled(options.student, book.everyone(),
                                                  classroom::importTableIn(options.out), folders);
  const classroom::GradeRow* found = book.row(id, name);
  for (const classroom::GradeRow& row : book.strangers)
    if (found == nullptr && row.student.id == id && row.exercise == name) found = &row;
  known.insert(known.end(), folders.begin(), folders.end());
  if (found == nullptr)
    throw UsageError({.what = fmt::format("no grade of '{}' for {}", options.student, name),
                      .wanted = "the id, number or name of a student, and an exercise that was graded",
                      .nearest = nearestNames(options.student, known)});
  const std::vector<std::string> lines = classroom::explain(*found);
  if (options.json)
    say(dump(Json{{"student", id}, {"exercise", name}, {"lines", lines}}));
  else
    for (const std::string& line : lines) say(wrap(escapeForTerminal(line), 2, 0));
  return ExitCode::kFull;
}

ExitCode listComplaints(const Project& project, const fs::path& results, const ClassFiles& files) {
  const classroom::ClassRun run = runIn(results);
  const classroom::GradebookSource source = readGradebookSource(project, files, run);
  const classroom::Gradebook book = classroom::makeGradebook(run, source);
  classroom::Course everyone = book.everyone();
  everyone.tutors = source.course.tutors;
  const auto shares = classroom::tutorShares(everyone);
  std::vector<const classroom::Complaint*> open;
  for (const classroom::Complaint& one : source.adjustments.complaints)
    if (one.answer.empty()) open.push_back(&one);
  std::ranges::stable_sort(open, {}, [](const classroom::Complaint* one) { return one->date; });
  for (const classroom::Complaint* one : open)
    for (const std::string& id : one->students) {
      const auto tutor = shares.find(id);
      say(wrap(escapeForTerminal(fmt::format("{} {}, {} ({}{}): {}", id, one->exercise, one->date,
                                             tutor == shares.end() ? "" : tutor->second + ", ",
                                             toString(one->where), one->text)),
               2, 0));
      const classroom::GradeRow* row = book.row(id, one->exercise);
      for (const std::string& line :
           row == nullptr ? std::vector<std::string>{"no grade yet"} : classroom::explain(*row))
        say("  " + wrap(escapeForTerminal(line), 4, 2));
      say();
    }
  say(fmt::format("{} open, {} answered", open.size(), source.adjustments.complaints.size() - open.size()));
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

classroom::ClassRun runIn(const fs::path& results, const fs::path& manifest) {
  return classroom::readClassRun(tasksIn(results, manifest), results);
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

Region barOf(double row, double percent, Color color) {
  constexpr double kHalfHeight = 0.36;
  return {.x = {0, percent, percent, 0},
          .y = {row - kHalfHeight, row - kHalfHeight, row + kHalfHeight, row + kHalfHeight},
          .color = color};
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
  constexpr Color kReached{0.35F, 0.6F, 0.8F}, kPossible{0.92F, 0.94F, 0.96F};
  Figure figure{.title = "Mean points of the parts",
                .xLabel = "mean points of the class [% of the maximum]",
                .yLabel = "part",
                .xRange = AxisRange{0, 105},
                .legend = Legend::kNone};
  // The first part is at the top.
  for (auto exercise = all.rbegin(); exercise != all.rend(); ++exercise)
    for (auto part = exercise->parts.rbegin(); exercise->graded > 0 && part != exercise->parts.rend();
         ++part) {
      const double percent = part->maxPoints > 0 ? 100 * part->meanPoints / part->maxPoints : 0;
      const auto row = static_cast<double>(figure.yNames.size());
      figure.yNames.push_back(fmt::format("{}: {}", exercise->exercise, part->id));
      figure.regions.push_back(barOf(row, 100, kPossible));
      figure.regions.push_back(barOf(row, percent, kReached));
      figure.notes.push_back({.text = fmt::format("{:.0f} %", percent), .x = percent, .y = row - 0.35});
    }
  if (figure.yNames.empty()) throw Error({.what = "no points to draw", .found = "only faults of the grader"});
  const auto rows = static_cast<double>(figure.yNames.size());
  figure.height = static_cast<int>(std::min(8192., 130 + 26 * rows));
  figure.yRange = AxisRange{-0.6, rows - 0.4};
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
