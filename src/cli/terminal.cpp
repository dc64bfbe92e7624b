#include "cli/terminal.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cwchar>
#include <utility>

#include <fmt/format.h>
#include <locale.h>
#include <sys/ioctl.h>
#include <unistd.h>
#include <wchar.h>

#include "base/escape.h"
#include "base/folders.h"

namespace rex::cli {

namespace {

constexpr std::size_t kColumns = 80;

// Marks and joiners take none, Chinese characters and emoji two.
std::size_t columns(std::string_view text) {
  static const locale_t unicode = ::newlocale(LC_CTYPE_MASK, "C.UTF-8", nullptr);
  const locale_t before = unicode == nullptr ? nullptr : ::uselocale(unicode);
  std::mbstate_t state{};
  std::size_t all = 0;
  while (!text.empty()) {
    wchar_t character = 0;
    const std::size_t length = std::mbrtowc(&character, text.data(), text.size(), &state);
    const bool isKnown = length != 0 && length <= text.size();
    all += isKnown ? static_cast<std::size_t>(std::max(0, ::wcwidth(character))) : 1;
    if (!isKnown) state = {};
    text.remove_prefix(isKnown ? length : 1);
  }
  if (before != nullptr) ::uselocale(before);
  return all;
}

// Messages name commands and documents as in the source tree, where rex is not on the path.
std::string asTyped(std::string_view line) {
  std::string text(line);
  static const bool isOnPath = isInstalled();
  if (!isOnPath) return text;
  static const std::string documents = (homeFolder().parent_path() / "doc" / "rex" / "").string();
  const std::pair<std::string_view, std::string_view> names[] = {{"scripts/rex", "rex"},
                                                                 {"share/doc/", documents}};
  for (const auto& [inSourceTree, installed] : names)
    for (std::size_t at = text.find(inSourceTree); at != text.npos; at = text.find(inSourceTree, at + 1))
      if (at == 0 || text[at - 1] != '/') text.replace(at, inSourceTree.size(), installed);
  return text;
}

// No colours if NO_COLOR is set (no-color.org), nor in terminals that would print the codes.
bool wantsColour() {
  const char* refused = std::getenv("NO_COLOR");
  const char* kind = std::getenv("TERM");
  return (refused == nullptr || *refused == '\0') && (kind == nullptr || std::string_view(kind) != "dumb");
}

}  // namespace

std::string paint(Colour colour, std::string_view text) {
  static const bool isColourful = ::isatty(STDOUT_FILENO) == 1 && wantsColour();
  if (!isColourful) return std::string(text);
  const int code = colour == Colour::kRed      ? 31
                   : colour == Colour::kGreen  ? 32
                   : colour == Colour::kYellow ? 33
                                               : 1;
  return fmt::format("\033[{}m{}\033[0m", code, text);
}

std::string bar(int part, int whole) {
  constexpr int kCells = 20;
  int cells = part <= 0 || whole <= 0 ? 0 : std::clamp(kCells * part / whole, 1, kCells);
  if (cells == kCells && part < whole) --cells;
  return std::string(static_cast<std::size_t>(cells), '#') +
         std::string(static_cast<std::size_t>(kCells - cells), '.');
}

std::string wrap(std::string_view text, std::size_t indent, std::size_t used) {
  std::string wrapped;
  std::size_t column = used;
  bool first = true, isFresh = false;  // the first word; the start of a line that the text begins
  while (!text.empty()) {
    const std::size_t end = std::min(text.find_first_of(" \n"), text.size());
    const std::string_view word = text.substr(0, end);
    const bool breaks = end < text.size() && text[end] == '\n';
    if (!word.empty()) {
      if (!first && column + 1 + columns(word) > kColumns) {
        wrapped += "\n" + std::string(indent, ' ');
        column = indent;
      } else if (!first && !isFresh) {
        wrapped += ' ';
        ++column;
      }
      wrapped += word;
      column += columns(word);
      first = isFresh = false;
    }
    if (breaks) {
      wrapped += "\n" + std::string(indent, ' ');
      column = indent;
      isFresh = true;
    }
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return wrapped;
}

std::string escapeForTerminal(std::string_view text) {
  constexpr std::size_t kLongest = 4096;
  return printable(text, kLongest);
}

void say(std::string_view line) {
  const std::string text = terminalText(asTyped(line));
  std::fwrite(text.data(), 1, text.size(), stdout);
  std::fputc('\n', stdout);
}

void note(std::string_view line) {
  std::fflush(stdout);
  const std::string text = terminalText(asTyped(line));
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fputc('\n', stderr);
}

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
