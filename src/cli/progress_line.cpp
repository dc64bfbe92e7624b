#include "cli/progress_line.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <utility>

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

namespace rex::cli {

using namespace std::chrono_literals;

namespace {

// A line that is too long for the terminal could not be erased.
std::size_t width() {
  constexpr std::size_t kLongest = 78;
  winsize size{};
  const bool isKnown = ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1;
  return isKnown ? std::min(kLongest, static_cast<std::size_t>(size.ws_col - 1)) : kLongest;
}

// Overwrites with blanks, for terminals without escape sequences.
void erase() { fmt::print(stderr, "\r{:{}}\r", "", width()); }

}  // namespace

ProgressLine::ProgressLine(std::function<std::string()> text) : text_(std::move(text)) {
  if (::isatty(STDERR_FILENO) == 1) thread_ = std::thread([this] { show(); });
}

ProgressLine::~ProgressLine() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    isOver_ = true;
  }
  wake_.notify_one();
  thread_.join();
  erase();
}

void ProgressLine::stepAside(const std::function<void()>& print) {
  const std::lock_guard lock(mutex_);
  if (thread_.joinable()) erase();
  print();
}

void ProgressLine::show() {
  const auto start = std::chrono::steady_clock::now();
  std::unique_lock lock(mutex_);
  while (!wake_.wait_for(lock, 300ms, [&] { return isOver_; })) {
    const auto seconds =
        std::chrono::duration_cast<std::chrono::seconds>(std::chrono::steady_clock::now() - start).count();
    const std::string line = fmt::format("{} ({} s)", text_(), seconds);
    fmt::print(stderr, "\r{:{}}", line.substr(0, width()), width());
    std::fflush(stderr);
  }
}

}  // namespace rex::cli
