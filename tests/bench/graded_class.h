#pragma once

#include "support/temporary_folder.h"

namespace rex::bench {

/// Sixteen different files for 01-kinematics, half of them wrong, that `rex grade` compiles and grades.
class GradedClass {
 public:
  GradedClass();

  /// Processor seconds of one run, with all programs that it starts, for each file: a processor grades
  /// 3600 / that in an hour. Throws std::runtime_error unless all get a grade.
  [[nodiscard]] double cpuSecondsPerFile() const;

 private:
  TemporaryFolder folder_;
};

}  // namespace rex::bench
