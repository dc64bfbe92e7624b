#include "cli/progress_line.h"

#include <chrono>
#include <cstdio>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>

namespace rex::cli {

using namespace std::chrono_literals;

namespace {

constexpr std::size_t kLongest = 78;

// Blanks, for terminals that know no escape sequences.
void erase() { fmt::print(stderr, "\r{:{}}\r", "", kLongest); }

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
    fmt::print(stderr, "\r{:{}}", line.substr(0, kLongest), kLongest);
    std::fflush(stderr);
  }
}

}  // namespace rex::cli
