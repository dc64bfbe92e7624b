#pragma once

#include <map>
#include <string>
#include <vector>

#include "classroom/course_file.h"
#include "classroom/import_table.h"

namespace rex::grading {

/// The id of the student of the course who is this person of a platform: by id, number, e-mail, name of the
/// folder or user name, in this order, else by a full name that only one has. Case does not count, nor how
/// umlauts are written. Empty: nobody.
[[nodiscard]] std::string studentOf(const ImportedStudent& person, const Course& course);

/// Whose submissions the folders of a class are.
class SubmissionOwners {
 public:
  SubmissionOwners(const Course& course, const ImportTable& imported);

  /// The ids of all for whom the file in this folder counts, sorted: the student of that id and the members
  /// of the group, the members of the group of that name, or those whom a platform lists. Empty: nobody.
  [[nodiscard]] std::vector<std::string> of(const std::string& folder, const std::string& exercise) const;

 private:
  std::vector<std::string> withGroups(const std::vector<std::string>& ids) const;

  const Course& course_;
  const ImportTable& imported_;
  std::map<std::string, std::string> ids_{};     ///< by caseless(id)
  std::map<std::string, std::string> people_{};  ///< of a platform: folder, id
};

}  // namespace rex::grading
