#pragma once

#include <cstdio>
#include <cstdlib>
#include <string>

extern "C" {
#include <libqhull_r/qhull_ra.h>
}

namespace rex::internal {

/// qhull's state, in which errors and all memory stay.
class Qhull {
 public:
  Qhull() { qh_zero(&qh_, errors_); }
  ~Qhull() {
    int leftBlocks = 0, leftBytes = 0;
    qh_freeqhull(&qh_, !qh_ALL);
    qh_memfreeshort(&qh_, &leftBlocks, &leftBytes);
    std::fclose(errors_);
    std::free(text_);
  }
  Qhull(const Qhull&) = delete;
  Qhull& operator=(const Qhull&) = delete;

  /// The hull of `count` points that lie one after the other and stay where they are; false if it fails.
  bool run(int dimension, int count, double* points, const char* options) {
    std::string command = options;
    return qh_new_qhull(&qh_, dimension, count, points, False, command.data(), nullptr, errors_) == 0;
  }

  qhT& state() { return qh_; }

 private:
  char* text_ = nullptr;
  std::size_t size_ = 0;
  std::FILE* errors_ = open_memstream(&text_, &size_);
  qhT qh_{};
};

}  // namespace rex::internal
