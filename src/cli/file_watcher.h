#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <tuple>

namespace rex::cli {

/// Notices when a file is saved, in place or by an editor that replaces it. Uses inotify. The file is also
/// polled five times a second if inotify does not work or is not wanted, and for changes that it misses on
/// network drives.
class FileWatcher {
 public:
  enum class Method { kInotify, kPolling };
  enum class Event { kSaved, kKey };

  /// The file need not exist yet. `method` is what to try first.
  explicit FileWatcher(std::filesystem::path file, Method method = Method::kInotify);
  ~FileWatcher();
  FileWatcher(const FileWatcher&) = delete;
  FileWatcher& operator=(const FileWatcher&) = delete;

  /// The method in use.
  [[nodiscard]] Method method() const { return inotify_ >= 0 ? Method::kInotify : Method::kPolling; }
  /// "inotify", or "polling (inotify: Too many open files)".
  [[nodiscard]] std::string describe() const;

  /// Waits for a save after the last kSaved, or after construction, and for the end of writing; or until
  /// `keys`, a descriptor or -1, is readable. Throws Interrupted.
  [[nodiscard]] Event wait(int keys = -1);

 private:
  // Time of modification, size, and identity of the file. Zeros: it does not exist.
  using Stamp = std::tuple<std::int64_t, std::int64_t, std::uint64_t, std::uint64_t>;
  Stamp stamp() const;
  void drain() const;

  std::filesystem::path file_;
  int inotify_ = -1;
  std::string whyNot_;
  Stamp seen_;
};

}  // namespace rex::cli
