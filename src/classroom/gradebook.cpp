#include "classroom/gradebook.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "base/error.h"
#include "base/instant.h"
#include "base/text.h"
#include "base/text_file.h"
#include "classroom/submission_folder.h"
#include "grading/results.h"

namespace rex::classroom {
namespace {

constexpr std::int64_t kWhole = 100;  // hundredths of a point

bool holds(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

// The number of a hidden check is all that students learn about it.
std::string targetOf(const grading::GradeResult& result, const grading::CheckResult& check) {
  if (check.group == grading::Group::kVisible) return fmt::format("{} [{}]", check.title, check.id);
  int number = 0;
  for (const grading::CheckResult& one : result.checks) {
    if (one.group == grading::Group::kHidden) ++number;
    if (&one == &check) break;
  }
  return fmt::format("Hidden check {}", number);
}

/// Makes the rows of a grade book.
class BookMaker {
 public:
  BookMaker(const ClassRun& run, const GradebookSource& source)
      : run_(run),
        source_(source),
        course_(withStudents(source.course, run.tasks, source.imported)),
        owners_(course_, source.imported) {}

  Gradebook make() {
    book_.hasRoster = source_.course.hasRoster();
    book_.hasBest = course_.total.best.has_value(), book_.hasPassRules = course_.hasPassRules();
    for (const std::vector<std::string>* told : {&source_.adjustments.conflicts, &source_.adjustments.notes})
      book_.notes.insert(book_.notes.end(), told->begin(), told->end());
    book_.conflicts = static_cast<int>(source_.adjustments.conflicts.size());
    chooseExercises();
    assignTasks();
    addFaults();
    assignRejected();
    for (const CourseStudent& student : course_.students)
      for (const std::string& exercise : shown_)
        if (holds(book_.exercises, exercise) || candidates_.contains({student.id, exercise}))
          book_.rows.push_back(rowOf(student, exercise));
    for (const CourseStudent& student : course_.students) book_.totals.push_back(totalOf(student));
    tellUnused();
    return std::move(book_);
  }

 private:
  // An exercise that nobody handed in has not been graded yet: nobody misses points in it.
  void chooseExercises() {
    std::set<std::string> graded;
    for (const Task& task : run_.tasks) graded.insert(task.exercise);
    for (const std::string& exercise : graded) {
      if (!source_.only.empty() && exercise != source_.only) continue;
      shown_.push_back(exercise);
      if (counted().empty() || counted().contains(exercise))
        book_.exercises.push_back(exercise);
      else
        book_.notes.push_back(
            fmt::format("{} is not an exercise of the course: it does not count", exercise));
    }
    for (const auto& [exercise, worth] : counted())
      if (!graded.contains(exercise) && source_.only.empty())
        book_.notes.push_back(fmt::format(
            "{}: {}, so it does not count yet", exercise,
            isImported(exercise) ? "it was imported, but not graded" : "nobody has handed it in"));
  }

  bool isImported(const std::string& exercise) const {
    return std::ranges::any_of(source_.imported.students, [&](const ImportedStudent& person) {
      const auto entry = person.exercises.find(exercise);
      return entry != person.exercises.end() && entry->second.status == SubmissionStatus::kHandedIn;
    });
  }

  void assignTasks() {
    for (std::size_t k = 0; k < run_.tasks.size(); ++k) {
      const Task& task = run_.tasks[k];
      const std::vector<std::string> ids = owners_.of(task.student, task.exercise);
      for (const std::string& id : ids) candidates_[{id, task.exercise}].push_back(k);
      if (ids.empty() && holds(shown_, task.exercise)) book_.strangers.push_back(strangerOf(k));
    }
    std::set<std::string> told;
    for (auto& [key, tasks] : candidates_) {
      std::stable_sort(tasks.begin(), tasks.end(), [&](std::size_t a, std::size_t b) {
        return run_.tasks[a].submitted < run_.tasks[b].submitted;
      });
      if (tasks.size() > 1 && holds(shown_, key.second))
        if (const std::string text = severalText(tasks); told.insert(text).second)
          book_.notes.push_back(text);
    }
  }

  std::string severalText(const std::vector<std::size_t>& tasks) const {
    std::vector<std::string> names;
    for (const std::size_t k : tasks)
      names.push_back(fmt::format("'{}' ({})", run_.tasks[k].student, instantText(run_.tasks[k].submitted)));
    return fmt::format("{} was handed in {} times by one student or group: {}; the last one counts",
                       run_.tasks[tasks.front()].exercise, tasks.size(), join(names, ", "));
  }

  void assignRejected() {
    for (const RejectedSubmission& one : source_.rejected) {
      const std::vector<std::string> ids = owners_.of(one.student, one.exercise);
      for (const std::string& id : ids) rejected_[{id, one.exercise}].push_back(one);
      if (ids.empty() && book_.hasRoster)
        book_.notes.push_back(fmt::format("'{}' is not on the roster: {}", one.student, one.why));
    }
    for (const ImportedStudent& person : source_.imported.students)
      for (const auto& [exercise, entry] : person.exercises)
        // A file that somebody has put there by hand since then counts.
        if (const std::string id = courseStudent(person, course_);
            entry.status == SubmissionStatus::kRejected && !id.empty() &&
            !candidates_.contains({id, exercise}))
          rejected_[{id, exercise}].push_back({person.student, exercise, entry.why});
  }

  GradeRow strangerOf(std::size_t task) {
    GradeRow row{.student = {.id = run_.tasks[task].student}, .exercise = run_.tasks[task].exercise};
    if (const ImportedStudent* person = source_.imported.find(row.student.id))
      row.student.name = person->name, row.student.email = person->email;
    row.remark = "not on the roster";
    row.worth = course_.exercise(row.exercise);
    if (const RosterFault* fault = faultOf(run_.tasks[task])) row.remark += ": " + fault->why;
    take(task, row);
    finish(row);
    return row;
  }

  // Of the student whose folder it is, if that row of the roster was not taken.
  const RosterFault* faultOf(const Task& task) const {
    for (const RosterFault& fault : course_.faults) {
      const Course alone{.students = {fault.student}};
      if (!SubmissionOwners(alone, source_.imported).of(task.student, task.exercise).empty()) return &fault;
    }
    return nullptr;
  }

  // Who handed in nothing is named beside those who did.
  void addFaults() {
    for (const RosterFault& fault : course_.faults)
      if (std::ranges::none_of(book_.strangers, [&](const GradeRow& row) {
            return row.remark.find(fault.why) != std::string::npos;
          }))
        book_.strangers.push_back(
            {.student = fault.student, .status = RowStatus::kRejected, .remark = fault.why});
  }

  GradeRow rowOf(const CourseStudent& student, const std::string& exercise) {
    GradeRow row{.student = student, .exercise = exercise};
    row.worth = course_.exercise(exercise);
    const auto points = source_.points.find(exercise);
    if (points != source_.points.end()) row.possible = kWhole * points->second;
    if (const auto rule = course_.policy.find(exercise); rule != course_.policy.end()) {
      row.deadline = studentDeadline(rule->second, student.id);
      row.isExtended = row.deadline != rule->second.deadline;
      row.graceSeconds = rule->second.graceSeconds;
    }
    const auto found = candidates_.find({student.id, exercise});
    if (found != candidates_.end()) take(found->second.back(), row);
    tellRejected(row);
    for (const Comment& comment : source_.adjustments.comments)
      if (comment.exercise == exercise && holds(comment.students, student.id)) addComment(comment, row);
    std::stable_sort(row.comments.begin(), row.comments.end(),
                     [](const Comment& a, const Comment& b) { return a.line < b.line; });
    finish(row);
    return row;
  }

  void take(std::size_t index, GradeRow& row) {
    const Task& task = run_.tasks[index];
    row.task = index;
    row.timeZone = course_.timeZone;
    row.handedInAs = task.student;
    row.submitted = task.submitted;
    row.timeFrom = task.timeFrom;
    row.status = RowStatus::kToRepeat;
    const StoredResult& stored = run_.stored[index];
    const TaskState state = stored.state;
    if (task.student != row.student.id)
      row.remark += (row.remark.empty() ? "" : "; ") + ("handed in by " + task.student);
    if (state == TaskState::kMissing) row.remark = "there is no result yet";
    if (state == TaskState::kStale) row.remark = "the result is for other inputs";
    if (state == TaskState::kFailed) row.remark = "the grader failed";
    if (state == TaskState::kRefused) row.remark = "the result was changed after the grading";
    if (state != TaskState::kDone) return;
    row.result = stored.result;
    row.status = RowStatus::kGraded;
    row.score = row.result->score;
    row.possible = kWhole * row.result->maxScore;
    if (row.worth.parts.empty()) return;
    row.score = 0, row.possible = 0;
    for (const grading::CheckResult& check : row.result->checks)
      if (row.worth.counts(check.part)) row.score += check.points, row.possible += kWhole * check.maxPoints;
  }

  // A file that could not be read has a result that says so; what has no task has none.
  void tellRejected(GradeRow& row) const {
    for (const std::string& exercise : {row.exercise, std::string()}) {
      const auto found = rejected_.find({row.student.id, exercise});
      if (found == rejected_.end()) continue;
      for (const RejectedSubmission& one : found->second) {
        if (row.task && (one.student != row.handedInAs || exercise.empty())) continue;
        if (row.status != RowStatus::kToRepeat) row.status = RowStatus::kRejected;
        row.remark += (row.remark.empty() ? "" : "; ") + one.why;
      }
    }
  }

  void addComment(const Comment& comment, GradeRow& row) {
    if (!row.task) {
      book_.notes.push_back(fmt::format("{}: '{}' handed in no {} to comment on", toString(comment.where),
                                        row.student.id, row.exercise));
      return;
    }
    const std::string text = readTextFile(run_.out / run_.tasks[*row.task].file);
    const auto lines = splitLines(text).size();
    if (comment.line > static_cast<int>(lines))
      throw Error({.what = fmt::format("a comment on line {} of {}", comment.line, row.student.id),
                   .where = comment.where,
                   .found = fmt::format("a file of {} lines", lines),
                   .wanted = "one of them"});
    row.comments.push_back(comment);
  }

  // Checks first, then lateness, then the final points.
  void finish(GradeRow& row) {
    if (row.result) {
      row.points = kWhole * row.score;
      adjustChecks(row);
      const auto rule = course_.policy.find(row.exercise);
      if (rule != course_.policy.end())
        row.late = latenessOfHundredths(rule->second, row.student.id, row.submitted, row.points);
      if (row.late.days > 0 && row.status == RowStatus::kGraded) row.status = RowStatus::kLate;
      row.final = row.points - row.late.penalty;
    }
    adjustFinal(row);
  }

  std::vector<const Adjustment*> adjustmentsOf(const GradeRow& row, bool ofChecks) const {
    std::vector<const Adjustment*> found;
    for (const Adjustment& one : source_.adjustments.adjustments)
      if (one.exercise == row.exercise && one.check.empty() != ofChecks &&
          holds(one.students, row.student.id))
        found.push_back(&one);
    return found;
  }

  void adjustChecks(GradeRow& row) {
    std::map<std::string, std::int64_t> now;
    for (const Adjustment* one : adjustmentsOf(row, true)) {
      const grading::CheckResult& check = checkOf(*row.result, *one);
      if (!row.worth.counts(check.part)) {
        book_.notes.push_back(fmt::format("{}: the check '{}' is in part '{}', which does not count",
                                          toString(one->where), check.id, check.part));
        continue;
      }
      const std::int64_t most = kWhole * check.maxPoints;
      const std::int64_t before = now.try_emplace(check.id, kWhole * check.points).first->second;
      if (one->points && *one->points > most)
        throw Error({.what = fmt::format("[[adjustment]] of the check '{}'", check.id),
                     .where = one->where,
                     .found = reports::hundredthsText(*one->points) + " points",
                     .wanted = fmt::format("at most {}", check.maxPoints)});
      const std::int64_t after = one->points.value_or(std::clamp(before + one->add, std::int64_t{0}, most));
      if (!one->points && after != before + one->add)
        book_.notes.push_back(fmt::format("{}: the check '{}' of {} stays within 0 and {} points",
                                          toString(one->where), check.id, row.student.id, check.maxPoints));
      row.applied.push_back({*one, before, after, targetOf(*row.result, check)});
      row.points += after - before;
      now[check.id] = after;
    }
  }

  static const grading::CheckResult& checkOf(const grading::GradeResult& result,
                                             const Adjustment& adjustment) {
    std::vector<std::string> ids;
    for (const grading::CheckResult& check : result.checks) {
      if (check.id == adjustment.check) return check;
      ids.push_back(check.id);
    }
    throw Error({.what = fmt::format("{} has no check '{}'", adjustment.exercise, adjustment.check),
                 .where = adjustment.where,
                 .wanted = "the id of a check, or no check to change the final points",
                 .nearest = nearestNames(adjustment.check, ids)});
  }

  void adjustFinal(GradeRow& row) {
    if (!row.result)
      for (const Adjustment* one : adjustmentsOf(row, true)) tellNoResult(*one, row);
    for (const Adjustment* one : adjustmentsOf(row, false)) {
      if (row.status == RowStatus::kToRepeat) {
        tellNoResult(*one, row);
        continue;
      }
      const std::int64_t before = row.final.value_or(0),
                         after = one->points.value_or(std::max(before + one->add, std::int64_t{0}));
      row.applied.push_back({*one, before, after, "Final points"});
      row.final = after;
    }
  }

  void tellNoResult(const Adjustment& one, const GradeRow& row) {
    book_.notes.push_back(fmt::format("{}: '{}' has no result for {} to adjust", toString(one.where),
                                      row.student.id, row.exercise));
  }

  StudentTotal totalOf(const CourseStudent& student) {
    StudentTotal sum{.student = student, .total = 0};
    std::vector<const GradeRow*> rows;
    for (const GradeRow& row : book_.rows)
      if (row.student.id == student.id && holds(book_.exercises, row.exercise)) rows.push_back(&row);
    leaveOut(rows, sum);
    std::int64_t total = 0, possible = 0;  // hundredths of hundredths
    for (const GradeRow* row : rows) {
      if (row->status == RowStatus::kToRepeat) sum.total.reset();
      total += row->worth.weight * row->final.value_or(0);
      if (!row->worth.isBonus) possible += row->worth.weight * row->possible;
    }
    if (sum.total) sum.total = (total + kWhole / 2) / kWhole;
    sum.possible = (possible + kWhole / 2) / kWhole;
    if (book_.hasPassRules && sum.total) judge(rows, sum);
    return sum;
  }

  // The exercises with the smallest shares of their points. Of equal shares, those with more possible points:
  // no other choice gives the student a larger share in the end.
  void leaveOut(std::vector<const GradeRow*>& rows, StudentTotal& sum) const {
    if (!course_.total.best) return;
    std::vector<const GradeRow*> ranked;
    for (const GradeRow* row : rows)
      if (!row->worth.isBonus) ranked.push_back(row);
    const auto best = static_cast<std::size_t>(*course_.total.best);
    if (ranked.size() <= best) return;
    std::ranges::stable_sort(ranked, [](const GradeRow* a, const GradeRow* b) {
      const std::int64_t left = a->final.value_or(0) * b->possible,
                         right = b->final.value_or(0) * a->possible;
      return left != right ? left > right : a->worth.weight * a->possible < b->worth.weight * b->possible;
    });
    for (std::size_t k = best; k < ranked.size(); ++k) {
      sum.leftOut.push_back(ranked[k]->exercise);
      std::erase(rows, ranked[k]);
    }
    std::ranges::sort(sum.leftOut);
  }

  void judge(const std::vector<const GradeRow*>& rows, StudentTotal& sum) const {
    const TotalRules& rules = course_.total;
    if (rules.passPercent && *sum.total * kWhole * kWhole < *rules.passPercent * sum.possible)
      sum.why.push_back(fmt::format("{} of {} points are less than {} %", reports::hundredthsText(*sum.total),
                                    reports::hundredthsText(sum.possible),
                                    reports::hundredthsText(*rules.passPercent)));
    std::vector<std::string> below;
    int reached = 0;
    for (const GradeRow* row : rows) {
      if (!row->worth.minimum) continue;
      if (row->reachesMinimum())
        ++reached;
      else
        below.push_back(row->exercise);
    }
    if (!rules.passExercises && !below.empty()) sum.why.push_back("below the minimum: " + join(below, ", "));
    if (rules.passExercises && reached < *rules.passExercises)
      sum.why.push_back(
          fmt::format("the minimum is reached in {} of {} exercises", reached, *rules.passExercises));
    sum.passes = sum.why.empty();
  }

  // Adjustments that met no row are mistakes that somebody would wait for.
  void tellUnused() {
    const auto tell = [&](const auto& one) {
      if (!holds(shown_, one.exercise) && source_.only.empty())
        book_.notes.push_back(fmt::format("{}: nobody has handed in {}", toString(one.where), one.exercise));
      for (const std::string& id : one.students)
        if (course_.student(id) == nullptr)
          book_.notes.push_back(fmt::format("{}: waits until the row of '{}' is taken from the roster",
                                            toString(one.where), id));
    };
    for (const Adjustment& one : source_.adjustments.adjustments) tell(one);
    for (const Comment& one : source_.adjustments.comments) tell(one);
  }

  const std::map<std::string, CourseExercise>& counted() const { return course_.exercises; }

  using Key = std::pair<std::string, std::string>;  // student, exercise
  const ClassRun& run_;
  const GradebookSource& source_;
  Course course_;
  SubmissionOwners owners_;
  std::vector<std::string> shown_{};                      // exercises with rows
  std::map<Key, std::vector<std::size_t>> candidates_{};  // tasks, the last one counts
  std::map<Key, std::vector<RejectedSubmission>> rejected_{};
  Gradebook book_{};
};

}  // namespace

std::string_view toString(RowStatus status) {
  switch (status) {
    case RowStatus::kGraded:
      return "graded";
    case RowStatus::kLate:
      return "late";
    case RowStatus::kMissing:
      return "missing";
    case RowStatus::kRejected:
      return "not taken";
    case RowStatus::kToRepeat:
      return "to repeat";
  }
  return "";
}

bool GradeRow::reachesMinimum() const {
  return final.value_or(0) * kWhole * kWhole >= worth.minimum.value_or(0) * possible;
}

const GradeRow* Gradebook::row(const std::string& student, const std::string& exercise) const {
  const auto found = std::find_if(rows.begin(), rows.end(), [&](const GradeRow& row) {
    return row.student.id == student && row.exercise == exercise;
  });
  return found == rows.end() ? nullptr : &*found;
}

Course Gradebook::everyone() const {
  Course course;
  for (const StudentTotal& sum : totals) course.students.push_back(sum.student);
  return course;
}

const GradeRow* rowOfTask(const Gradebook& book, std::size_t task) {
  const GradeRow* found = nullptr;
  for (const std::vector<GradeRow>* rows : {&book.strangers, &book.rows})
    for (const GradeRow& row : *rows)
      if (row.task == task && (found == nullptr || row.student.id == row.handedInAs)) found = &row;
  return found;
}

std::optional<reports::Judgement> taskJudgement(const Gradebook& book, const std::vector<Task>& tasks,
                                                std::size_t task) {
  const GradeRow* row = rowOfTask(book, task);
  const bool counts = row != nullptr;
  if (!counts) row = book.row(tasks[task].student, tasks[task].exercise);
  if (row == nullptr || !row->task) return {};
  auto judgement = rowJudgement(*row);
  if (!judgement) return {};
  std::vector<std::string> names;
  for (const GradeRow& one : book.rows)
    if (one.task == row->task && one.exercise == row->exercise) names.push_back(shownName(one.student));
  if (!names.empty()) judgement->student = join(names, ", ");
  if (!counts)
    judgement->changes.insert(
        judgement->changes.begin(),
        fmt::format("The points are those of what {} handed in later.", row->handedInAs));
  return judgement;
}

Gradebook makeGradebook(const ClassRun& run, const GradebookSource& source) {
  return BookMaker(run, source).make();
}

Course withStudents(Course course, const std::vector<Task>& tasks, const ImportTable& imported) {
  if (!course.hasRoster()) {
    std::set<std::string> ids;
    for (const Task& task : tasks) ids.insert(task.student);
    for (const ImportedStudent& person : imported.students) ids.insert(person.student);
    for (const std::string& id : ids) course.students.push_back({.id = id});
  }
  for (const ImportedStudent& person : imported.students) {
    const std::string id = courseStudent(person, course);
    for (CourseStudent& student : course.students) {
      if (student.id != id) continue;
      if (student.name.empty()) student.name = person.name;
      if (student.email.empty()) student.email = person.email;
      if (student.number.empty()) student.number = person.id;
    }
  }
  return course;
}

}  // namespace rex::classroom
