#include "submission/regions.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "base/error.h"
#include "base/join.h"
#include "base/lines.h"

namespace rex::grading {
namespace {

enum class Place { kPublic, kSolution, kTodo, kHidden, kMarker };

struct Line {
  std::string text;
  int number = 0;
  Place place = Place::kPublic;
  std::string region;  // for solutions, todos and their markers
};

struct Tag {
  bool closing = false;
  std::string word, name;
};

constexpr std::string_view kBlank = " \t\r";

std::string_view trim(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlank) + 1 - first);
}

// The tag in a comment line that holds nothing but `<word name>` or `</word>`.
std::optional<Tag> tagIn(std::string_view line) {
  std::string_view rest = trim(line);
  if (!rest.starts_with("//")) return {};
  rest = trim(rest.substr(2));
  if (rest.size() < 3 || rest.front() != '<' || rest.find('>') != rest.size() - 1) return {};
  rest = rest.substr(1, rest.size() - 2);
  Tag tag;
  tag.closing = rest.front() == '/';
  if (tag.closing) rest.remove_prefix(1);
  const std::size_t space = std::min(rest.find(' '), rest.size());
  tag.word = rest.substr(0, space);
  tag.name = trim(rest.substr(space));
  return tag;
}

// Walks through a file and classifies each line; all complaints about markers are here.
class MarkerReader {
 public:
  MarkerReader(std::string file, std::vector<std::string> words)
      : file_(std::move(file)), words_(std::move(words)) {}

  std::vector<Line> read(std::string_view text) {
    std::vector<Line> lines;
    for (const std::string_view line : splitLines(text)) {
      ++number_;
      const std::optional<Tag> tag = tagIn(line);
      if (tag) handle(*tag);
      const Place place = tag ? Place::kMarker : place_;
      if (place_ == Place::kTodo && !tag) requireTodo(line);
      lines.push_back({std::string(line), number_, place, region_});
      if (tag && tag->closing) region_.clear();
    }
    if (place_ != Place::kPublic) fail(fmt::format("no '// </{}>' closes this", opening()), opened_);
    return lines;
  }

 private:
  std::string_view opening() const { return place_ == Place::kHidden ? "hidden" : "solution"; }

  [[noreturn]] void fail(std::string what, int line, std::string wanted = {},
                         std::vector<std::string> nearest = {}) const {
    throw Error({.what = std::move(what),
                 .where = {file_, line},
                 .wanted = std::move(wanted),
                 .nearest = std::move(nearest)});
  }

  void handle(const Tag& tag) {
    if (std::find(words_.begin(), words_.end(), tag.word) == words_.end())
      fail(fmt::format("unknown marker '{}'", tag.word), number_,
           fmt::format("one of {}", join(words_, ", ")), nearestNames(tag.word, words_));
    if (tag.word == "todo")
      openTodo(tag);
    else if (tag.closing)
      close(tag);
    else
      open(tag);
  }

  void open(const Tag& tag) {
    if (place_ != Place::kPublic)
      fail(fmt::format("'{}' inside the {} opened in line {}", tag.word, opening(), opened_), number_,
           fmt::format("'// </{}>' first", opening()));
    const bool named = tag.word == "solution";
    if (named && tag.name.empty()) fail("a solution without a name", number_, "'// <solution NAME>'");
    if (named && !names_.insert(tag.name).second)
      fail(fmt::format("a second solution called '{}'", tag.name), number_);
    place_ = named ? Place::kSolution : Place::kHidden;
    region_ = tag.name;
    opened_ = number_;
  }

  void openTodo(const Tag& tag) {
    if (tag.closing) fail("'</todo>' is not needed", number_, "'// </solution>', which ends both");
    if (place_ != Place::kSolution)
      fail("'todo' out of place", number_, "one in a solution, after the reference lines");
    place_ = Place::kTodo;
  }

  void close(const Tag& tag) {
    if (place_ == Place::kPublic || opening() != tag.word)
      fail(fmt::format("'</{}>' closes nothing", tag.word), number_);
    place_ = Place::kPublic;
  }

  void requireTodo(std::string_view line) const {
    const std::string_view text = trim(line);
    if (text.empty() || text == "//|" || text.starts_with("//| ")) return;
    fail("a todo line", number_, "it to start with '//| '");
  }

  std::string file_;
  std::vector<std::string> words_;
  std::set<std::string> names_;
  Place place_ = Place::kPublic;
  std::string region_;
  int number_ = 0;
  int opened_ = 0;
};

std::vector<Line> readSolution(std::string_view text, const std::string& file) {
  return MarkerReader(file, {"solution", "todo"}).read(text);
}

std::vector<std::vector<BlockLine>> blocksOf(const std::vector<Line>& lines, Place place) {
  std::vector<std::vector<BlockLine>> blocks;
  bool inside = false;
  for (const Line& line : lines) {
    const bool belongs = line.place == place;
    if (belongs && !inside) blocks.emplace_back();
    if (belongs) blocks.back().push_back({line.number, std::string(trim(line.text))});
    inside = belongs;
  }
  return blocks;
}

// "  //| code" becomes "  code".
std::string uncomment(const std::string& line) {
  const std::size_t mark = line.find("//|");
  if (mark == std::string::npos || trim(line) == "//|") return "";
  return line.substr(0, mark) + line.substr(mark + 4);
}

// Joins lines; a region that vanishes must not leave two blank lines either.
class Writer {
 public:
  void add(std::string_view line) {
    const bool blank = trim(line).empty();
    if (blank && lastBlank_) return;
    lastBlank_ = blank;
    text_.append(line).push_back('\n');
  }
  std::string text() && { return std::move(text_); }

 private:
  std::string text_;
  bool lastBlank_ = true;
};

struct Header {
  std::vector<std::string> caughtBy;
  std::vector<std::string> shownBy;
  std::string mistake;
};

std::vector<std::string> splitList(std::string_view list) {
  std::vector<std::string> items;
  while (!list.empty()) {
    const std::size_t comma = std::min(list.find(','), list.size());
    if (const std::string_view item = trim(list.substr(0, comma)); !item.empty()) items.emplace_back(item);
    list.remove_prefix(std::min(comma + 1, list.size()));
  }
  return items;
}

// Reads `// caught by: ...`, `// shown by: ...` and `// mistake: ...` among the lines outside the regions,
// where only comments are allowed.
Header readHeader(const std::vector<Line>& lines, const std::string& file) {
  Header header;
  int lineOfMistake = 0;
  for (const Line& line : lines) {
    const std::string_view text = trim(line.text);
    if (line.place != Place::kPublic || text.empty()) continue;
    if (!text.starts_with("//"))
      throw Error({.what = "code outside a region",
                   .where = {file, line.number},
                   .wanted = "'// <solution NAME>' before it"});
    const std::string_view comment = trim(text.substr(2));
    constexpr std::string_view kCaught = "caught by:", kShown = "shown by:", kMistake = "mistake:";
    if (comment.starts_with(kCaught)) header.caughtBy = splitList(comment.substr(kCaught.size()));
    if (comment.starts_with(kShown)) header.shownBy = splitList(comment.substr(kShown.size()));
    if (comment.starts_with(kMistake)) {
      header.mistake = trim(comment.substr(kMistake.size()));
      lineOfMistake = line.number;
    } else if (lineOfMistake > 0 && line.number == lineOfMistake + 1 && !comment.starts_with(kCaught) &&
               !comment.starts_with(kShown)) {
      throw Error({.what = "the mistake goes on after its line",
                   .where = {file, line.number},
                   .wanted = "'// mistake: TEXT' in one line"});
    }
  }
  if (header.caughtBy.empty())
    throw Error({.what = "no check is named", .where = {file, 1}, .wanted = "'// caught by: CHECK, ...'"});
  if (header.mistake.empty())
    throw Error({.what = "the mistake is not described", .where = {file, 1}, .wanted = "'// mistake: TEXT'"});
  return header;
}

struct Replacement {
  std::string text;
  int line = 0;
};

std::map<std::string, Replacement> readReplacements(const std::vector<Line>& lines) {
  std::map<std::string, Replacement> replacements;
  for (const Line& line : lines) {
    if (line.region.empty()) continue;
    Replacement& replacement = replacements[line.region];
    if (line.place == Place::kMarker && replacement.line == 0) replacement.line = line.number;
    if (line.place == Place::kSolution) replacement.text += line.text + "\n";
  }
  return replacements;
}

// The file without markers and todos, and with some of its regions replaced.
std::string withReplaced(const std::vector<Line>& lines,
                         const std::map<std::string, Replacement>& replacements) {
  std::string text, current;
  for (const Line& line : lines) {
    const auto replacement = replacements.find(line.region);
    const bool opens = !line.region.empty() && line.region != current;
    current = line.region;
    if (opens && replacement != replacements.end()) text += replacement->second.text;
    const bool kept = line.place == Place::kSolution && replacement == replacements.end();
    if (kept || line.place == Place::kPublic) text += line.text + "\n";
  }
  return text;
}

}  // namespace

std::string stripSolution(std::string_view solution, const std::string& file) {
  Writer writer;
  for (const Line& line : readSolution(solution, file)) {
    if (line.place == Place::kPublic) writer.add(line.text);
    if (line.place == Place::kTodo) writer.add(uncomment(line.text));
  }
  return std::move(writer).text();
}

std::string stripHidden(std::string_view check, const std::string& file) {
  Writer writer;
  for (const Line& line : MarkerReader(file, {"hidden"}).read(check))
    if (line.place == Place::kPublic) writer.add(line.text);
  return std::move(writer).text();
}

std::string textOutsideRegions(std::string_view solution, const std::string& file) {
  Writer writer;
  for (const Line& line : readSolution(solution, file))
    if (line.place == Place::kPublic) writer.add(line.text);
  return std::move(writer).text();
}

std::string referenceText(std::string_view solution, const std::string& file) {
  return withReplaced(readSolution(solution, file), {});
}

std::vector<std::vector<BlockLine>> solutionBlocks(std::string_view solution, const std::string& file) {
  return blocksOf(readSolution(solution, file), Place::kSolution);
}

std::vector<std::vector<BlockLine>> hiddenBlocks(std::string_view check, const std::string& file) {
  return blocksOf(MarkerReader(file, {"hidden"}).read(check), Place::kHidden);
}

WrongVariant composeVariant(std::string_view solution, const std::string& solutionFile,
                            std::string_view wrong, const std::string& wrongFile) {
  const std::vector<Line> wrongLines = MarkerReader(wrongFile, {"solution"}).read(wrong);
  const Header header = readHeader(wrongLines, wrongFile);
  const std::map<std::string, Replacement> replacements = readReplacements(wrongLines);
  if (replacements.empty())
    throw Error(
        {.what = "no region", .where = {wrongFile, 1}, .wanted = "'// <solution NAME>' with the mistake"});

  const std::vector<Line> lines = readSolution(solution, solutionFile);
  std::vector<std::string> known;
  for (const Line& line : lines)
    if (!line.region.empty() && (known.empty() || known.back() != line.region)) known.push_back(line.region);
  for (const auto& [name, replacement] : replacements) {
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw Error({.what = fmt::format("{} has no region '{}'", solutionFile, name),
                   .where = {wrongFile, replacement.line},
                   .nearest = nearestNames(name, known)});
  }
  return {header.caughtBy, header.shownBy, header.mistake, withReplaced(lines, replacements)};
}

}  // namespace rex::grading
