#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include "cli/robot/simulation.h"

namespace rex::cli {

enum class LogFormat {
  kCsv,  ///< a line of names, then a line per moment, with digits that restore the same numbers
  kNpy   ///< NumPy format 1.0: a matrix of little-endian doubles in row-major order, a row per moment
};

/// A log with the columns time, q, v, kinetic, potential and total energy, written incrementally. An
/// unfinished log leaves nothing behind, neither a file nor folders made for it. An older log is kept until
/// finish().
class MotionLog {
 public:
  /// Throws Error naming the file.
  MotionLog(const std::filesystem::path& file, LogFormat format, const Model& model);
  ~MotionLog();
  MotionLog(const MotionLog&) = delete;
  MotionLog& operator=(const MotionLog&) = delete;

  /// Throws Error naming the file, for example on a full disk.
  void add(const Moment& moment);
  /// Moves the finished file into place. Throws like add().
  void finish();

 private:
  void write(const std::string& bytes);

  std::filesystem::path file_, part_, firstNew_;
  LogFormat format_;
  std::ofstream out_;
  long columns_, rows_ = 0;
  bool isFinished_ = false;
};

}  // namespace rex::cli
