#pragma once

#include <cstring>
#include <filesystem>
#include <map>
#include <string>

#include <gtest/gtest.h>
#include <sys/inotify.h>
#include <unistd.h>

namespace rex {

/// Counts how often each file of a folder is opened, by any process, since it was made:
///   FileOpenings openings(folder);
///   grade();
///   EXPECT_EQ(openings.of("results.json"), 1);
class FileOpenings {
 public:
  explicit FileOpenings(const std::filesystem::path& folder)
      : queue_(::inotify_init1(IN_NONBLOCK | IN_CLOEXEC)) {
    // Two equal events in a row are joined to one, so closings are listed between them.
    EXPECT_GE(::inotify_add_watch(queue_, folder.c_str(), IN_OPEN | IN_CLOSE), 0) << folder;
  }
  ~FileOpenings() { ::close(queue_); }
  FileOpenings(const FileOpenings&) = delete;
  FileOpenings& operator=(const FileOpenings&) = delete;

  int of(const std::string& name) {
    alignas(inotify_event) char events[16384];
    for (ssize_t size = 0; (size = ::read(queue_, events, sizeof events)) > 0;)
      for (const char* at = events; at < events + size;) {
        inotify_event event{};
        std::memcpy(&event, at, sizeof event);
        if (event.len > 0 && (event.mask & IN_OPEN) != 0) ++counts_[at + sizeof event];
        at += sizeof event + event.len;
      }
    return counts_[name];
  }

 private:
  int queue_;
  std::map<std::string, int> counts_{};
};

}  // namespace rex
