#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <tuple>

namespace rex::cli {

/// Notices when one file is saved, in place or by an editor that puts a new one there. Woken by inotify;
/// where that does not work, or is not wanted, and for what it misses on network drives, the file is looked
/// at five times a second.
class FileWatcher {
 public:
  enum class Method { kInotify, kPolling };
  enum class Event { kSaved, kKey };

  /// The file may be missing for now. `method` is what to try first.
  explicit FileWatcher(std::filesystem::path file, Method method = Method::kInotify);
  ~FileWatcher();
  FileWatcher(const FileWatcher&) = delete;
  FileWatcher& operator=(const FileWatcher&) = delete;

  /// What it came to.
  [[nodiscard]] Method method() const { return inotify_ >= 0 ? Method::kInotify : Method::kPolling; }
  /// "inotify", or "polling (inotify: Too many open files)".
  [[nodiscard]] std::string describe() const;

  /// Waits for the next save since the last kSaved, or since the beginning, and for the end of the writing;
  /// or until `keys`, a descriptor unless it is -1, has something to read. Throws Interrupted.
  [[nodiscard]] Event wait(int keys = -1);

 private:
  // When it was written, how large it is, and which file it is. Zeros: there is none.
  using Stamp = std::tuple<std::int64_t, std::int64_t, std::uint64_t, std::uint64_t>;
  Stamp stamp() const;
  void drain() const;

  std::filesystem::path file_;
  int inotify_ = -1;
  std::string whyNot_;
  Stamp seen_;
};

}  // namespace rex::cli
