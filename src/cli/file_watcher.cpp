#include "cli/file_watcher.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

#include <fmt/format.h>
#include <poll.h>
#include <sys/inotify.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/interruption.h"

namespace rex::cli {
namespace {

constexpr int kPeriod = 200;  // milliseconds between two looks
constexpr int kSettled = 30;  // without a change: the editor is done

}  // namespace

FileWatcher::FileWatcher(std::filesystem::path file, Method method) : file_(std::move(file)), seen_(stamp()) {
  if (method == Method::kPolling) return;
  inotify_ = ::inotify_init1(IN_CLOEXEC | IN_NONBLOCK);
  // Watches the folder, because editors replace the file by a new one.
  const auto folder = file_.has_parent_path() ? file_.parent_path() : std::filesystem::path(".");
  if (inotify_ >= 0 && ::inotify_add_watch(inotify_, folder.c_str(),
                                           IN_CLOSE_WRITE | IN_MOVED_TO | IN_MODIFY | IN_CREATE) >= 0)
    return;
  whyNot_ = std::strerror(errno);
  if (inotify_ >= 0) ::close(std::exchange(inotify_, -1));
}

FileWatcher::~FileWatcher() {
  if (inotify_ >= 0) ::close(inotify_);
}

std::string FileWatcher::describe() const {
  if (method() == Method::kInotify) return "inotify";
  return whyNot_.empty() ? "polling" : fmt::format("polling (inotify: {})", whyNot_);
}

FileWatcher::Stamp FileWatcher::stamp() const {
  struct stat status {};
  if (::stat(file_.c_str(), &status) != 0) return {};
  return {std::int64_t{status.st_mtim.tv_sec} * 1'000'000'000 + status.st_mtim.tv_nsec, status.st_size,
          status.st_ino, status.st_dev};
}

void FileWatcher::drain() const {
  std::array<char, 4096> events;
  while (inotify_ >= 0 && ::read(inotify_, events.data(), events.size()) > 0) {
  }
}

FileWatcher::Event FileWatcher::wait(int keys) {
  for (;;) {
    throwIfInterrupted();
    drain();
    Stamp now = stamp();
    if (now != seen_ && now != Stamp{}) {
      for (Stamp before; before != now;) {
        before = std::exchange(now, (::poll(nullptr, 0, kSettled), stamp()));
        throwIfInterrupted();
      }
      if (now != Stamp{}) {
        seen_ = now;
        return Event::kSaved;
      }
    }
    // poll() ignores negative descriptors.
    std::array<pollfd, 2> polled{{{inotify_, POLLIN, 0}, {keys, POLLIN, 0}}};
    ::poll(polled.data(), polled.size(), kPeriod);
    if ((polled[1].revents & (POLLIN | POLLHUP)) != 0) return Event::kKey;
  }
}

}  // namespace rex::cli
