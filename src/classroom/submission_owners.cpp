#include "classroom/submission_owners.h"

#include <algorithm>
#include <set>

#include "classroom/composed_text.h"

namespace rex::grading {
namespace {

bool isSameText(const std::string& a, const std::string& b) {
  return !a.empty() && !b.empty() && caseless(a) == caseless(b);
}

}  // namespace

std::string studentOf(const ImportedStudent& person, const Course& course) {
  // What the platform knows for certain comes first: a folder may be called like another student.
  using Field = std::pair<const std::string&, std::string CourseStudent::*>;
  for (const auto& [told, known] :
       {Field{person.id, &CourseStudent::id}, Field{person.id, &CourseStudent::number},
        Field{person.email, &CourseStudent::email}, Field{person.student, &CourseStudent::id},
        Field{person.githubUsername, &CourseStudent::id}})
    for (const CourseStudent& student : course.students)
      if (isSameText(told, student.*known)) return student.id;
  std::vector<std::string> named;
  for (const CourseStudent& student : course.students)
    if (isSameText(person.name, student.name)) named.push_back(student.id);
  return named.size() == 1 ? named.front() : "";
}

SubmissionOwners::SubmissionOwners(const Course& course, const ImportTable& imported)
    : course_(course), imported_(imported) {
  for (const CourseStudent& student : course.students) ids_[caseless(student.id)] = student.id;
  for (const ImportedStudent& person : imported.students)
    if (const std::string id = studentOf(person, course); !id.empty()) people_[person.student] = id;
}

std::vector<std::string> SubmissionOwners::withGroups(const std::vector<std::string>& ids) const {
  std::set<std::string> all(ids.begin(), ids.end());
  for (const std::string& id : ids)
    if (const CourseStudent* student = course_.student(id))
      for (const std::string& member : course_.members(student->group)) all.insert(member);
  return {all.begin(), all.end()};
}

std::vector<std::string> SubmissionOwners::of(const std::string& folder, const std::string& exercise) const {
  std::vector<std::string> ids;
  for (const ImportedStudent& person : imported_.students) {
    const auto entry = person.exercises.find(exercise);
    const auto id = people_.find(person.student);
    if (entry != person.exercises.end() && entry->second.handedInBy == folder && id != people_.end())
      ids.push_back(id->second);
  }
  if (!ids.empty()) return withGroups(ids);
  if (const auto own = ids_.find(caseless(folder)); own != ids_.end()) return withGroups({own->second});
  for (const std::string& group : course_.groups())
    if (isSameText(group, folder)) return course_.members(group);
  if (const auto person = people_.find(folder); person != people_.end()) return withGroups({person->second});
  return {};
}

}  // namespace rex::grading
