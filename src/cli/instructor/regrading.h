#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "classroom/task_list.h"

namespace rex::cli {

/// The points of files before and after they are graded again, by another grader or with other random cases.
class Regrading {
 public:
  /// Notes the points of the tasks that will be graded again (`isOpen`) or whose new result waits. They are
  /// kept in the folder of results until tell(), so that an interrupted regrading goes on with them. `accept`
  /// takes results that wait. Throws Error if the notes of an interrupted run cannot be read.
  Regrading(const std::vector<grading::Task>& tasks, const std::filesystem::path& out,
            const std::function<bool(const grading::Task&)>& isOpen, bool accept);

  /// Says which points have changed. Writes regraded.csv if anything was graded again or accepted in this
  /// run; the table of an earlier one stays.
  void tell() const;

 private:
  void readNotes();
  void writeNotes() const;

  const std::vector<grading::Task>& tasks_;
  std::filesystem::path out_;
  std::vector<std::optional<int>> before_{};  ///< of each task; empty: it was not graded before
  std::map<std::string, int> noted_{};        ///< of an interrupted run: by student, exercise and text
  bool isNew_ = false;                        ///< something is graded again, or accepted
};

}  // namespace rex::cli
