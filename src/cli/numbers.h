#pragma once
// Reads numbers from options and tables of a user.
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "base/error.h"
#include "cli/terminal.h"

namespace rex::cli {

/// What `attempt()` returns. An Error that it throws becomes a UsageError that begins with `option`: what the
/// user gave cannot be used, and the project is not at fault.
template <class Attempt>
auto asWrongUse(const Attempt& attempt, const std::string& option = "") {
  try {
    return attempt();
  } catch (const Error& error) {
    ErrorParts parts = error.parts();
    parts.what = escapeForTerminal(option + parts.what);
    throw UsageError(std::move(parts));
  }
}

/// Numbers that users write, in options and in files.

/// Throws an error about a text: what was found, what was wanted.
using Refusal = std::function<void(const std::string&, const std::string&)>;

/// Throws a UsageError that begins with the option.
[[nodiscard]] Refusal optionRefusal(const std::string& option);

/// The words of a text, as views into it, separated by commas or blanks; a final comma is allowed. Refuses
/// empty fields and ';'.
[[nodiscard]] std::vector<std::string_view> numberWords(std::string_view text, const Refusal& refuse);

/// The three numbers in the text of `option`; `form` describes them in messages. Throws UsageError for
/// another count, or naming the word that is not a number.
[[nodiscard]] Eigen::Vector3d parsePoint(const std::string& text, const std::string& option,
                                         const std::string& form = "x,y,z");

/// Numbers in rows, as spreadsheets, our own programs and people write them. Lines and columns count from 1.
struct NumberTable {
  struct Name {
    std::string text{};  ///< without quotes
    int column = 0;
  };
  struct Row {
    int line = 0;
    int column = 0;  ///< of the first number
    std::vector<double> values{};
  };

  std::string file{};
  int namesLine = 0;          ///< 0: no line of names
  std::vector<Name> names{};  ///< of the columns, if the file has any
  std::vector<Row> rows{};    ///< all of the same size
};

/// Reads a row of finite numbers per line, separated by commas or blanks; a final comma is allowed. Empty
/// lines, a byte order mark and lines that begin with '#' are skipped. Before the first row, a line that
/// begins with a letter or a quote names the columns, separated by commas. Throws UsageError with
/// file:line:column, which calls the numbers `what`, for anything else.
[[nodiscard]] NumberTable readNumberTable(const std::filesystem::path& file, const std::string& what);

}  // namespace rex::cli
