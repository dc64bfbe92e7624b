#pragma once

#include <vector>

namespace rex::grading {

/// While it lives, processes whose parents end become children of this process instead of the system's first
/// process. All children that appear meanwhile, running or ended, are killed and reaped at the end.
class NewDescendants {
 public:
  NewDescendants();
  ~NewDescendants();
  NewDescendants(const NewDescendants&) = delete;
  NewDescendants& operator=(const NewDescendants&) = delete;

  /// Kills and reaps them now, and what they leave behind, until none is left. Gives up after two seconds.
  void kill();

 private:
  std::vector<int> known_;
  int adopting_ = 0;
};

}  // namespace rex::grading
