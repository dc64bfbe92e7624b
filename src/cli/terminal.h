#pragma once
// Text for people at a terminal: colours, wrapping, progress.
#include <condition_variable>
#include <cstddef>
#include <functional>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>

namespace rex::cli {

enum class Colour { kRed, kGreen, kYellow, kBold };

/// The text in that colour if standard output is a colour terminal and NO_COLOR is unset or empty;
/// otherwise the plain text.
[[nodiscard]] std::string paint(Colour colour, std::string_view text);

/// A progress bar of twenty characters: "####................". It is empty or full only if the part is
/// zero or the whole.
[[nodiscard]] std::string bar(int part, int whole);

/// Wraps text at blanks to lines of at most 80 columns, all but the first indented by `indent` blanks.
/// `used` columns of the first line are already taken.
[[nodiscard]] std::string wrap(std::string_view text, std::size_t indent, std::size_t used);

/// The text as printable() shows it, truncated: for output of a student's program or text of a file.
[[nodiscard]] std::string escapeForTerminal(std::string_view text);

/// Prints a line to standard output, through terminalText().
void say(std::string_view line = "");

/// The same to standard error: for status messages instead of requested output.
void note(std::string_view line);

/// While it lives, the last line of the terminal shows the progress of long work, updated several times a
/// second, if standard error is a terminal. The line is erased at the end. It needs no escape sequences.
class ProgressLine {
 public:
  /// `text` is called from another thread.
  explicit ProgressLine(std::function<std::string()> text);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// Erases the line while `print` writes to the terminal.
  void stepAside(const std::function<void()>& print);

 private:
  void show();

  std::function<std::string()> text_;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool isOver_ = false;
  std::thread thread_;
};

}  // namespace rex::cli
