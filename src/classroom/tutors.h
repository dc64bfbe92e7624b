#pragma once
// A class that several people grade: who looks at whom, ids without names, and what they decide, as one:
//   const auto shares = classroom::tutorShares(course);                 // {"zoe", "A. Tutor"}, ...
//   const std::string id = classroom::blindId("the secret", "zoe");     // "blind-5f3a..."
//   const classroom::Adjustments all = classroom::mergeAdjustments(own, {{"A. Tutor", theirs}});

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "classroom/adjustments.h"
#include "classroom/course_file.h"

namespace rex::classroom {

/// The tutor of each student, by id. A section belongs to its tutor; all others are shared evenly among the
/// tutors without a section, and nobody's if there are none. A group stays together: with its first member.
[[nodiscard]] std::map<std::string, std::string> tutorShares(const Course& course);

/// What tutors see instead of an id, if they shall not know whom they grade. Only the secret of the course
/// leads from one to the other.
[[nodiscard]] std::string blindId(const std::string& secret, const std::string& student);

/// The student of each blind id.
[[nodiscard]] BlindIds blindIds(const std::string& secret, const Course& course);

/// What the course decides and what each tutor does. If the course changes the same points as a tutor, the
/// course counts; if two tutors do, neither counts, and `conflicts` says so, unless they give the same
/// points.
[[nodiscard]] Adjustments mergeAdjustments(Adjustments own,
                                           const std::vector<std::pair<std::string, Adjustments>>& ofTutors);

}  // namespace rex::classroom
