#include "authoring/contract.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"
#include "submission/cpp_text.h"
#include "submission/graded_source.h"

namespace rex::authoring {
namespace {

using submission::CppPiece;
using submission::CppText;
using submission::TokenKind;

constexpr const char* kFunction = "a function such as `double area(double width, double height);`";

bool isAmong(std::string_view word, const auto& words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

// By how much a token changes the number of open brackets, those of template arguments included.
int nestingOf(const CppText& text, std::size_t i) {
  if (!text.isKind(i, TokenKind::kSign)) return 0;
  const char sign = text.at(i).front();
  return std::string_view("([{<").find(sign) != std::string_view::npos   ? 1
         : std::string_view(")]}>").find(sign) != std::string_view::npos ? -1
                                                                         : 0;
}

// "// Part 2, turning (2:9)." is the heading of part "2" called "turning".
struct Heading {
  std::size_t start = 0;  ///< in the header
  std::string_view number, title;
};

std::optional<Heading> headingIn(std::string_view line, std::size_t start) {
  constexpr std::string_view kMark = "// Part";
  if (!line.starts_with(kMark)) return {};
  const std::string_view rest = line.substr(kMark.size());
  const std::size_t end = std::min(rest.find_first_of(",:"), rest.size());
  std::string_view title = rest.substr(std::min(end + 1, rest.size()));
  title = trimmed(title.substr(0, title.find_first_of(".(;:")));
  return Heading{start, trimmed(rest.substr(0, end)), title};
}

/// Reads one header.
class ContractReader {
 public:
  ContractReader(std::string_view header, std::string file)
      : header_(header), file_(std::move(file)), text_(header), places_(header) {}

  Contract read() {
    findHeadings();
    for (const CppPiece& piece : submission::cppPieces(text_)) readPiece(piece);
    if (!hasCourse_)
      throw Error({.what = "no line `#include \"course/course.h\"`",
                   .where = {file_},
                   .wanted = "this line before the functions"});
    if (contract_.functions.empty())
      throw Error({.what = "no function", .where = {file_}, .wanted = kFunction});
    return std::move(contract_);
  }

 private:
  [[noreturn]] void refuse(std::size_t position, std::string what, std::string found,
                           std::string wanted) const {
    const auto [line, column] = places_.place(position);
    throw Error({.what = std::move(what),
                 .where = {file_, line, column},
                 .found = std::move(found),
                 .wanted = std::move(wanted)});
  }

  void findHeadings() {
    for (const std::string_view line : splitLines(header_)) {
      const auto start = static_cast<std::size_t>(line.data() - header_.data());
      const std::optional<Heading> heading = headingIn(line, start);
      if (!heading) continue;
      const std::string number = std::to_string(headings_.size() + 1);
      if (heading->number != number || heading->title.empty())
        refuse(start, "the heading of a part", fmt::format("'{}'", line),
               fmt::format("'// Part {}, TITLE.'", number));
      headings_.push_back(*heading);
      contract_.parts.emplace_back(heading->title);
    }
  }

  void readPiece(const CppPiece& piece) {
    constexpr auto kTypes = std::to_array<std::string_view>(
        {"struct", "class", "enum", "union", "using", "typedef", "static_assert", "constexpr", "inline"});
    const std::string_view all = header_.substr(piece.start, piece.end - piece.start);
    if (piece.isDirective) {
      hasCourse_ = hasCourse_ || all.starts_with("#include \"course/course.h\"");
      return;
    }
    comment_ = commentAbove(piece);
    behind_ = piece.end;
    std::size_t first = piece.first;
    while (text_.isSign(first, '[') && text_.partner(first) < piece.last) first = text_.partner(first) + 1;
    const bool isHelper = text_.at(first) == "template" && text_.isSign(piece.last - 1, '}');
    if (isAmong(text_.at(first), kTypes) || isHelper || text_.isSign(first, ';')) return;
    readFunction(piece, first);
  }

  // The lines with /// directly above a declaration; if it follows another one without a blank line, the
  // comment of that.
  std::string commentAbove(const CppPiece& piece) const {
    const std::vector<std::string_view> lines = splitLines(header_);
    const auto line = static_cast<std::size_t>(places_.line(piece.start)) - 1;
    std::size_t top = line;
    while (top > 0 && trimmed(lines[top - 1]).starts_with("///")) --top;
    std::string comment;
    for (std::size_t k = top; k < line; ++k) {
      if (k > top) comment += ' ';
      comment += trimmed(trimmed(lines[k]).substr(3));
    }
    const bool follows = behind_ > 0 && static_cast<std::size_t>(places_.line(behind_ - 1)) == line;
    return comment.empty() && follows ? comment_ : comment;
  }

  void readFunction(const CppPiece& piece, std::size_t first) {
    constexpr auto kOther = std::to_array<std::string_view>(
        {"namespace", "template", "static", "extern", "friend", "const", "thread_local"});
    std::size_t open = first;
    for (int depth = 0; open < piece.last && !(depth == 0 && text_.isSign(open, '(')); ++open)
      depth += nestingOf(text_, open);
    const bool isPlain = open < piece.last && open > first + 1 && text_.isName(open - 1) &&
                         !isAmong(text_.at(first), kOther) && text_.at(open - 1) != "operator";
    if (!isPlain) {
      const std::string_view all = header_.substr(piece.start, piece.end - piece.start);
      refuse(piece.start, "cannot read this", fmt::format("'{}'", all.substr(0, all.find_first_of("\n({="))),
             std::string(kFunction) + ", a type, or an inline function that students are given");
    }
    ContractFunction function{.name = std::string(text_.at(open - 1)), .comment = comment_};
    if (!text_.isSign(piece.last - 1, ';'))
      refuse(text_[open - 1].start, fmt::format("'{}' has a body", function.name), "",
             "a ';' behind its parameters, or the word inline before it");
    function.result = typeIn(first, open - 1, "the value of " + function.name);
    readParameters(open, text_.partner(open), function);
    requireNew(function, open - 1);
    function.part = partAt(piece.start, function);
    contract_.functions.push_back(std::move(function));
  }

  void requireNew(const ContractFunction& function, std::size_t name) const {
    if (function.comment.empty())
      refuse(text_[name].start, fmt::format("'{}' has no comment", function.name), "",
             "lines with /// above it that say what it returns, with shapes, units and frames");
    for (const ContractFunction& other : contract_.functions)
      if (other.name == function.name)
        refuse(text_[name].start, fmt::format("a second function '{}'", function.name), "",
               "another name: a check calls functions by name");
  }

  int partAt(std::size_t position, const ContractFunction& function) {
    if (headings_.empty()) {
      contract_.parts.push_back(splitName(function.name, ' '));
      return static_cast<int>(contract_.parts.size()) - 1;
    }
    int part = -1;
    for (const Heading& heading : headings_) part += heading.start < position ? 1 : 0;
    if (part < 0)
      refuse(position, fmt::format("'{}' is in no part", function.name), "",
             "'// Part 1, TITLE.' before it, or no such line at all");
    return part;
  }

  void readParameters(std::size_t open, std::size_t close, ContractFunction& function) const {
    int depth = 0;
    for (std::size_t i = open + 1, first = i; i <= close; ++i) {
      if (i < close && !(depth == 0 && text_.isSign(i, ','))) {
        depth += nestingOf(text_, i);
        continue;
      }
      if (i > first) function.parameters.push_back(parameterIn(first, i, function.name));
      first = i + 1;
    }
  }

  ContractParameter parameterIn(std::size_t first, std::size_t end, const std::string& function) const {
    constexpr auto kHalves = std::to_array<std::string_view>({"const", "unsigned", "long", "signed"});
    for (std::size_t i = first; i < end; ++i)
      if (text_.isSign(i, '=')) end = i;  // its default
    const std::size_t name = end - 1;
    const bool isNamed = end > first + 1 && text_.isName(name) && !text_.isSign(name - 1, ':') &&
                         !(end == first + 2 && isAmong(text_.at(first), kHalves));
    if (!isNamed)
      refuse(text_[first].start, fmt::format("a parameter of {} without a name", function),
             fmt::format("'{}'", spelled(first, end)), "a type and a name");
    return {typeIn(first, name, fmt::format("{} of {}", text_.at(name), function)),
            std::string(text_.at(name))};
  }

  std::string spelled(std::size_t first, std::size_t end) const {
    return std::string(header_.substr(text_[first].start, text_[end - 1].end - text_[first].start));
  }

  // The type as it is written. Whether a struct can cross is the compiler's business.
  std::string typeIn(std::size_t first, std::size_t end, const std::string& what) const {
    constexpr auto kStandard = std::to_array<std::string_view>(
        {"vector", "array", "pair", "optional", "string", "function", "size_t", "int8_t", "int16_t",
         "int32_t", "int64_t", "uint8_t", "uint16_t", "uint32_t", "uint64_t"});
    constexpr auto kChanged = std::to_array<std::string_view>({"Rng", "Simulator"});
    const std::string type = spelled(first, end), found = fmt::format("'{}'", type);
    const auto start = [&](std::size_t i) { return text_[i].start; };
    if (type == "void" || type == "auto")
      refuse(start(first), what, found,
             "the type of a value: only that comes back from a student's function");
    for (std::size_t i = first; i < end; ++i) {
      if (text_.isSign(i, '*'))
        refuse(start(i), what, found, "no pointer, but a value such as std::vector or std::optional");
      if (i > first + 2 && text_.at(i - 3) == "std" && !isAmong(text_.at(i), kStandard))
        refuse(start(i), what, fmt::format("'std::{}'", text_.at(i)),
               "std::vector, array, pair, optional, string or function, or a struct of such values");
    }
    const bool isReference = text_.isSign(end - 1, '&');
    if (isReference && text_.at(first) != "const" && !isAmong(text_.at(end - 2), kChanged))
      refuse(start(first), what, found, fmt::format("'const {}': changes to an argument are lost", type));
    return type;
  }

  std::string_view header_;
  std::string file_;
  CppText text_;
  submission::TextPlaces places_;
  std::vector<Heading> headings_;
  Contract contract_;
  std::string comment_;     // of the last declaration
  std::size_t behind_ = 0;  // its end
  bool hasCourse_ = false;
};

}  // namespace

Contract readContract(std::string_view header, const std::string& file) {
  return ContractReader(header, file).read();
}

std::string splitName(std::string_view name, char between) {
  std::string words;
  for (const char c : name) {
    const bool isUpper = std::isupper(static_cast<unsigned char>(c)) != 0;
    if (isUpper && !words.empty() && words.back() != between) words += between;
    words += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return words;
}

}  // namespace rex::authoring
