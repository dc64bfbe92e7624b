#include <nlohmann/json.hpp>

#include "base/escape.h"
#include "base/instant.h"
#include "classroom/class_feedback.h"

namespace rex::grading {
namespace {

using GradesJson = nlohmann::ordered_json;

GradesJson pointsJson(std::int64_t hundredths) {
  if (hundredths % 100 == 0) return hundredths / 100;
  return static_cast<double>(hundredths) / 100;
}

GradesJson pointsJson(const std::optional<std::int64_t>& hundredths) {
  return hundredths ? pointsJson(*hundredths) : GradesJson();
}

GradesJson whoJson(const CourseStudent& student) {
  return {{"id", student.id},
          {"name", student.name},
          {"email", student.email},
          {"group", student.group},
          {"number", student.number}};
}

GradesJson rowJson(const GradeRow& row) {
  GradesJson adjustments = GradesJson::array(), comments = GradesJson::array();
  for (const AppliedAdjustment& one : row.applied)
    adjustments.push_back({{"check", one.adjustment.check},
                           {"before", pointsJson(one.before)},
                           {"after", pointsJson(one.after)},
                           {"reason", one.adjustment.reason},
                           {"author", one.adjustment.author},
                           {"date", one.adjustment.date}});
  for (const Comment& comment : row.comments)
    comments.push_back({{"line", comment.line}, {"text", comment.text}, {"author", comment.author}});
  return {{"exercise", row.exercise},
          {"status", toString(row.status)},
          {"remark", row.remark},
          {"points", row.result ? GradesJson(row.result->score) : GradesJson()},
          {"possible", pointsJson(row.possible)},
          {"outcome", row.result ? GradesJson(toString(row.result->outcome)) : GradesJson()},
          {"adjustments", adjustments},
          {"comments", comments},
          {"late_days", row.late.days},
          {"penalty", pointsJson(row.late.penalty)},
          {"final", pointsJson(row.final)},
          {"submitted", row.task ? GradesJson(instantText(row.submitted)) : GradesJson()},
          {"time_from", row.timeFrom},
          {"handed_in_as", row.handedInAs},
          {"deadline", row.deadline ? GradesJson(instantText(*row.deadline)) : GradesJson()},
          {"extended", row.isExtended}};
}

}  // namespace

std::string gradesJson(const Gradebook& book, const Course& course) {
  GradesJson exercises = GradesJson::array(), students = GradesJson::array(), strangers = GradesJson::array();
  for (const std::string& name : book.exercises) {
    const auto weight = course.weights.find(name);
    exercises.push_back(
        {{"exercise", name}, {"weight", pointsJson(weight == course.weights.end() ? 100 : weight->second)}});
  }
  for (const StudentTotal& sum : book.totals) {
    GradesJson student = whoJson(sum.student), grades = GradesJson::array();
    for (const GradeRow& row : book.rows)
      if (row.student.id == sum.student.id) grades.push_back(rowJson(row));
    student["total"] = pointsJson(sum.total);
    student["possible"] = pointsJson(sum.possible);
    student["grades"] = grades;
    students.push_back(student);
  }
  for (const GradeRow& row : book.strangers) {
    GradesJson student = whoJson(row.student);
    student["grades"] = GradesJson::array({rowJson(row)});
    strangers.push_back(student);
  }
  const GradesJson json = {{"schema", "rex-grades/1"}, {"title", course.title},      {"exercises", exercises},
                           {"students", students},     {"not_on_roster", strangers}, {"notes", book.notes}};
  return visibleJson(json.dump(2, ' ', false, GradesJson::error_handler_t::replace)) + "\n";
}

}  // namespace rex::grading
