#include "classroom/tutors.h"

#include <algorithm>
#include <tuple>

#include <fmt/format.h>

#include "base/text.h"
#include "grading/hidden_seed.h"
#include "reports/report.h"

namespace rex::classroom {
namespace {

// The points that an adjustment changes: student, exercise and check.
using Target = std::tuple<std::string, std::string, std::string>;

struct Decision {
  std::string tutor{};
  Adjustment adjustment{};  // of one student
};

Target targetOf(const Adjustment& adjustment, const std::string& student) {
  return {student, adjustment.exercise, adjustment.check};
}

std::string pointsText(const Adjustment& one) {
  if (one.points) return reports::hundredthsText(*one.points) + " points";
  return fmt::format("{}{} points", one.add < 0 ? "" : "+", reports::hundredthsText(one.add));
}

bool agree(const std::vector<Decision>& decisions) {
  return std::ranges::all_of(decisions, [&](const Decision& one) {
    return one.tutor == decisions.front().tutor ||
           (one.adjustment.points && one.adjustment.points == decisions.front().adjustment.points);
  });
}

std::string conflictText(const Target& target, const std::vector<Decision>& decisions) {
  std::vector<std::string> all;
  for (const Decision& one : decisions)
    all.push_back(
        fmt::format("{} ({}: {})", pointsText(one.adjustment), one.tutor, toString(one.adjustment.where)));
  const auto& [student, exercise, check] = target;
  return fmt::format("{} {}{}: {}: none of it counts until the adjustments of the course decide", student,
                     exercise, check.empty() ? "" : fmt::format(" [{}]", check), join(all, ", "));
}

}  // namespace

std::map<std::string, std::string> tutorShares(const Course& course) {
  std::map<std::string, std::string> shares, bySection, byGroup;
  std::vector<std::pair<int, std::string>> even;  // how many each has
  for (const Tutor& tutor : course.tutors)
    if (tutor.section.empty())
      even.emplace_back(0, tutor.name);
    else
      bySection[tutor.section] = tutor.name;
  for (const CourseStudent& student : course.students) {
    const auto group = byGroup.find(student.group);
    const auto section = bySection.find(student.section);
    std::string tutor;
    if (!student.group.empty() && group != byGroup.end()) {
      tutor = group->second;
    } else if (section != bySection.end()) {
      tutor = section->second;
    } else if (!even.empty()) {
      tutor = std::ranges::min_element(even, {}, &std::pair<int, std::string>::first)->second;
    } else {
      continue;
    }
    for (auto& [count, name] : even)
      if (name == tutor) ++count;
    if (!student.group.empty()) byGroup[student.group] = tutor;
    shares[student.id] = tutor;
  }
  return shares;
}

std::string blindId(const std::string& secret, const std::string& student) {
  constexpr std::size_t kDigits = 10;
  return "blind-" + grading::hmacSha256(secret, "blind id\n" + student).substr(0, kDigits);
}

BlindIds blindIds(const std::string& secret, const Course& course) {
  BlindIds ids;
  for (const CourseStudent& student : course.students) ids[blindId(secret, student.id)] = student.id;
  return ids;
}

Adjustments mergeAdjustments(Adjustments own,
                             const std::vector<std::pair<std::string, Adjustments>>& ofTutors) {
  std::map<Target, const Adjustment*> decided;
  for (const Adjustment& one : own.adjustments)
    for (const std::string& student : one.students) decided[targetOf(one, student)] = &one;
  std::map<Target, std::vector<Decision>> decisions;
  std::vector<Target> order;
  std::vector<std::string> told;
  Adjustments all;
  for (const auto& [tutor, theirs] : ofTutors) {
    for (const Adjustment& one : theirs.adjustments)
      for (const std::string& student : one.students) {
        const Target target = targetOf(one, student);
        if (const auto by = decided.find(target); by != decided.end()) {
          told.push_back(
              fmt::format("{} decides instead of {}", toString(by->second->where), toString(one.where)));
          continue;
        }
        Adjustment alone = one;
        alone.students = {student};
        if (decisions[target].empty()) order.push_back(target);
        decisions[target].push_back({tutor, std::move(alone)});
      }
    all.comments.insert(all.comments.end(), theirs.comments.begin(), theirs.comments.end());
    all.complaints.insert(all.complaints.end(), theirs.complaints.begin(), theirs.complaints.end());
  }
  for (const Target& target : order) {
    const std::vector<Decision>& some = decisions[target];
    if (!agree(some)) {
      own.conflicts.push_back(conflictText(target, some));
      continue;
    }
    for (const Decision& one : some)
      if (one.tutor == some.front().tutor) own.adjustments.push_back(one.adjustment);
  }
  own.notes.insert(own.notes.end(), told.begin(), told.end());
  own.comments.insert(own.comments.end(), all.comments.begin(), all.comments.end());
  own.complaints.insert(own.complaints.end(), all.complaints.begin(), all.complaints.end());
  return own;
}

}  // namespace rex::classroom
