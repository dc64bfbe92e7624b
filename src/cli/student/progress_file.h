#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>

namespace rex::cli {

/// What `rex` remembers about one exercise.
struct Progress {
  bool tested = false;
  int points = 0;            ///< of the last whole test of main.cpp
  int maxPoints = 0;         ///< that it could give: hidden checks are missing in the students' tree
  bool solved = false;       ///< some such test had the full score
  std::string fileSha256{};  ///< of the main.cpp that was tested last
  std::map<std::string, int> hints{};  ///< how many were shown, by part
};

struct AllProgress {
  std::map<std::string, Progress> exercises{};
  std::string last{};  ///< the tested exercise that was worked on last; empty: none
};

/// The file .rex/progress.json of a project. It is replaced as a whole, so that a program that is killed
/// leaves the old text or the new one, and changed under a lock, so that two programs lose nothing of each
/// other's. Keys that this version does not know stay. A file that cannot be understood is moved aside, which
/// is reported on standard error.
class ProgressFile {
 public:
  explicit ProgressFile(const std::filesystem::path& projectRoot) : folder_(projectRoot / ".rex") {}

  [[nodiscard]] AllProgress read() const;
  /// Changes what is remembered about one exercise, and makes it the last one if it was ever tested. Tells on
  /// standard error when it cannot be kept, and returns false: no command fails for that.
  bool change(const std::string& exercise, const std::function<void(Progress&)>& edit) const;

 private:
  std::filesystem::path folder_;
};

}  // namespace rex::cli
