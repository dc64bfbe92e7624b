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

  /// What those reaped used, with the children that they had waited for.
  double cpuSeconds() const { return cpuSeconds_; }
  long peakKilobytes() const { return peakKilobytes_; }

 private:
  void reap(int child);

  std::vector<int> known_;
  double cpuSeconds_ = 0;
  long peakKilobytes_ = 0;
  int adopting_ = 0;
};

}  // namespace rex::grading
