#pragma once

#include <vector>

namespace rex::grading {

/// While it lives, processes whose parents end become children of this process instead of the system's first
/// process, so that killNewChildren() finds them.
class OrphanAdoption {
 public:
  OrphanAdoption();
  ~OrphanAdoption();
  OrphanAdoption(const OrphanAdoption&) = delete;
  OrphanAdoption& operator=(const OrphanAdoption&) = delete;

 private:
  int before_ = 0;
};

/// Process ids of the children of this process, running or ended, as the kernel lists them in /proc.
[[nodiscard]] std::vector<int> listChildren();

/// Kills every child that is not in `known`, and the children it leaves behind, until none is left. Gives up
/// after two seconds; returns the number of processes killed.
int killNewChildren(const std::vector<int>& known);

}  // namespace rex::grading
