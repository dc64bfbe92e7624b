#pragma once

#include <map>
#include <string>
#include <vector>

#include "support/temporary_folder.h"

namespace rex::bench {

/// The exercises of this tree, graded by `rex test` as a student would: wall seconds, which only a quiet
/// machine tells.
class TestedExercises {
 public:
  enum class File { kSolution, kUntouched };

  TestedExercises();

  [[nodiscard]] static std::vector<std::string> names();

  /// Of one grading, with all that `rex test` does. Throws std::runtime_error if it does not end with a
  /// grade.
  double seconds(const std::string& name, File file);
  /// Of the fastest gradings of each exercise so far, of those that were measured; one each where none was.
  double median(File file);

 private:
  TemporaryFolder folder_;
  std::map<File, std::map<std::string, double>> fastest_;
};

}  // namespace rex::bench
