#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include "cli/robot/simulation.h"

namespace rex::cli {

enum class LogFormat {
  kCsv,  ///< a line of names, then a line per moment, in digits that give back the same numbers
  kNpy   ///< NumPy's format 1.0: a matrix of doubles, little-endian, row by row, a row per moment
};

/// A log with the columns time, q, v, kinetic, potential and total energy, written as it goes. A log that is
/// not finished leaves nothing, neither a file nor folders that were made for it; an older one stays until
/// then.
class MotionLog {
 public:
  /// `rows` must be added; files of kNpy begin with their number. Throws Error naming the file.
  MotionLog(const std::filesystem::path& file, LogFormat format, const Model& model, long rows);
  ~MotionLog();
  MotionLog(const MotionLog&) = delete;
  MotionLog& operator=(const MotionLog&) = delete;

  /// Throws Error naming the file, such as on a full disk.
  void add(const Moment& moment);
  /// Puts the file in its place. Throws as add().
  void finish();

 private:
  void write(const std::string& bytes);

  std::filesystem::path file_, part_, firstNew_;
  LogFormat format_;
  std::ofstream out_;
  bool isFinished_ = false;
};

}  // namespace rex::cli
