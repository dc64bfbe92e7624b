#pragma once

#include <exception>
#include <string>
#include <string_view>
#include <vector>

namespace rex {

/// A position in a text file. Lines and columns count from 1; 0 means unknown.
struct SourceLocation {
  std::string file;
  int line = 0;
  int column = 0;
};

/// "file:line:column", leaving out what is unknown; empty without a file.
[[nodiscard]] std::string toString(const SourceLocation& where);

/// The parts of a message about bad input. Only `what` is required.
struct ErrorParts {
  std::string what;                    ///< what is wrong, and with what: "joint 'elbow': unknown parent"
  SourceLocation where{};              ///< position in the user's file
  std::string found{};                 ///< what is there
  std::string wanted{};                ///< what would be right
  std::vector<std::string> nearest{};  ///< the user probably meant one of these
};

/// Bad input from a user: a file, a name, a size. Its text reads
/// `file:line:column: what: found F, wanted W (did you mean 'N'?)`, with the parts that are known.
class Error : public std::exception {
 public:
  explicit Error(ErrorParts parts);
  const char* what() const noexcept override { return text_.c_str(); }
  const ErrorParts& parts() const { return parts_; }

 private:
  ErrorParts parts_;
  std::string text_;
};

/// An Error in a name, option or file that the user typed on a command line: wrong usage of the program.
class UsageError : public Error {
 public:
  using Error::Error;
};

/// The names most similar to `wanted`, best first, at most three, none if nothing is similar. Similar names
/// differ by at most one edit (a letter added, removed, changed or swapped; case ignored) per three
/// letters, or share a prefix.
[[nodiscard]] std::vector<std::string> nearestNames(std::string_view wanted,
                                                    const std::vector<std::string>& known);

/// Throws Error "what: found a vector of size 5, wanted size 7" unless the sizes agree.
void requireSize(std::string_view what, long found, long wanted);

/// A warning points to a likely mistake; a note only informs.
enum class Severity { kNote, kWarning };

/// Something that a reader noticed and tolerated: the file loads, but the user should know.
struct Diagnostic {
  SourceLocation where;
  std::string message;
  Severity severity = Severity::kNote;
};

using Diagnostics = std::vector<Diagnostic>;

/// "file:line:column: note: message", or "warning".
[[nodiscard]] std::string toString(const Diagnostic& diagnostic);

}  // namespace rex
