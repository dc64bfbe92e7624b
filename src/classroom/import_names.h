#pragma once

#include <map>
#include <string>
#include <vector>

#include "classroom/arrivals.h"
#include "classroom/import_table.h"

namespace rex::grading {

/// Gives each person who arrives an entry in the table, and a name for their folder that stays.
class ImportNames {
 public:
  /// `arrivals` are asked for how often a name occurs.
  ImportNames(ImportTable& table, const Arrivals& arrivals);

  /// The name of the person's folder; adds or completes their entry. `exercises`: of this import, in which
  /// the platform's identifier means the same person.
  std::string folderOf(const Person& person, const std::vector<std::string>& exercises);

  /// How many people are known by their name alone, so that another of that name would be taken for them.
  [[nodiscard]] int knownByNameAlone() const { return byNameAlone_; }

 private:
  ImportedStudent* known(const Person& person, const std::vector<std::string>& exercises);
  std::string newName(const Person& person) const;

  ImportTable& table_;
  std::string platform_;
  std::map<std::string, int> nameCounts_;
  int byNameAlone_ = 0;
};

}  // namespace rex::grading
