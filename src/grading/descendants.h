#pragma once

#include <vector>

namespace rex::grading {

/// While this object lives, orphaned processes become children of this process instead of init. Its
/// destructor kills and reaps all children that have appeared in the meantime, running or ended.
class NewDescendants {
 public:
  NewDescendants();
  ~NewDescendants();
  NewDescendants(const NewDescendants&) = delete;
  NewDescendants& operator=(const NewDescendants&) = delete;

  /// Kills and reaps them now, along with any children they leave behind. Gives up after two seconds.
  void kill();

  /// Resources used by the reaped processes, including the children they had waited for.
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
