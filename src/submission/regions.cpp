#include "submission/regions.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"

namespace rex::submission {
namespace {

enum class Place { kPublic, kSolution, kTodo, kHidden, kMarker, kVariant };

struct Line {
  std::string text;
  int number = 0;
  Place place = Place::kPublic;
  std::string name;  // of the region, for solutions, todos and their markers; of the variant for its marker
};

// Its parts are views into the line.
struct Tag {
  bool closing = false;
  std::string_view word, name;
  std::string_view rest;  // of the line; only of a variant
};

constexpr std::string_view kBlank = " \t\r";

std::string_view trim(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlank) + 1 - first);
}

// Where a part of a line begins, from 1.
int columnOf(std::string_view part, std::string_view line) {
  return static_cast<int>(part.data() - line.data()) + 1;
}

// The tag in a comment line that holds nothing but `<word name>` or `</word>`, or begins with `<variant
// name>`.
std::optional<Tag> tagIn(std::string_view line) {
  std::string_view rest = trim(line);
  if (!rest.starts_with("//")) return {};
  rest = trim(rest.substr(2));
  const std::size_t end = rest.find('>');
  if (end == std::string_view::npos || end < 2 || rest.front() != '<') return {};
  Tag tag;
  tag.rest = trim(rest.substr(end + 1));
  rest = rest.substr(1, end - 1);
  tag.closing = rest.front() == '/';
  if (tag.closing) rest.remove_prefix(1);
  const std::size_t space = std::min(rest.find(' '), rest.size());
  tag.word = rest.substr(0, space);
  tag.name = trim(rest.substr(space));
  if (!tag.rest.empty() && tag.word != "variant") return {};
  return tag;
}

// Walks through a file and classifies each line; all complaints about markers are here. Where there are
// variants, a region ends at the next marker.
class MarkerReader {
 public:
  MarkerReader(std::string file, std::vector<std::string> words)
      : file_(std::move(file)),
        words_(std::move(words)),
        hasVariants_(std::find(words_.begin(), words_.end(), "variant") != words_.end()) {}

  std::vector<Line> read(std::string_view text) {
    std::vector<Line> lines;
    for (const std::string_view line : splitLines(text)) {
      line_ = line;
      ++number_;
      const std::optional<Tag> tag = tagIn(line);
      if (tag) handle(*tag);
      const bool isVariant = tag && tag->word == "variant";
      const Place place = isVariant ? Place::kVariant : tag ? Place::kMarker : place_;
      if (place_ == Place::kTodo && !tag) requireTodo();
      lines.push_back({std::string(line), number_, place, name_});
      if (isVariant || (tag && tag->closing)) name_.clear();
    }
    if (place_ != Place::kPublic && !hasVariants_)
      throw Error({.what = fmt::format("no '// </{}>' closes this", opening()), .where = opened_});
    return lines;
  }

 private:
  std::string_view opening() const { return place_ == Place::kHidden ? "hidden" : "solution"; }
  SourceLocation placeOf(std::string_view part) const { return {file_, number_, columnOf(part, line_)}; }

  // `part` of the line is wrong.
  [[noreturn]] void fail(std::string what, std::string_view part, std::string wanted = {},
                         std::vector<std::string> nearest = {}) const {
    throw Error({.what = std::move(what),
                 .where = placeOf(part),
                 .wanted = std::move(wanted),
                 .nearest = std::move(nearest)});
  }

  void handle(const Tag& tag) {
    if (std::find(words_.begin(), words_.end(), tag.word) == words_.end())
      fail(fmt::format("unknown marker '{}'", tag.word), tag.word,
           fmt::format("one of {}", join(words_, ", ")), nearestNames(tag.word, words_));
    if (tag.word == "todo")
      openTodo(tag);
    else if (hasVariants_ && tag.closing)
      fail(fmt::format("'</{}>' is not needed", tag.word), tag.word,
           "a line '// <solution NAME>' or '// <variant NAME>', or the end of the file");
    else if (tag.word == "variant")
      openVariant(tag);
    else if (tag.closing)
      close(tag);
    else
      open(tag);
  }

  // Requires a name that is none of `names` so far, and adds it.
  void requireNewName(const Tag& tag, std::set<std::string, std::less<>>& names) const {
    if (tag.name.empty())
      fail(fmt::format("a {} without a name", tag.word), tag.word, fmt::format("'// <{} NAME>'", tag.word));
    if (!names.emplace(tag.name).second)
      fail(fmt::format("a second {} called '{}'", tag.word, tag.name), tag.name);
  }

  void open(const Tag& tag) {
    if (place_ != Place::kPublic && !hasVariants_)
      fail(fmt::format("'{}' inside the {} opened in line {}", tag.word, opening(), opened_.line), tag.word,
           fmt::format("'// </{}>' first", opening()));
    const bool named = tag.word == "solution";
    if (named) requireNewName(tag, regions_);
    place_ = named ? Place::kSolution : Place::kHidden;
    name_ = tag.name;
    opened_ = placeOf(tag.word);
  }

  // Each variant may replace the same regions. Its name is part of a gate's name.
  void openVariant(const Tag& tag) {
    constexpr std::string_view kLetters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_";
    requireNewName(tag, variants_);
    if (tag.name.find_first_not_of(kLetters) != tag.name.npos)
      fail(fmt::format("a variant called '{}'", tag.name), tag.name, "letters, digits and '_' only");
    place_ = Place::kPublic;
    name_ = tag.name;
    regions_.clear();
  }

  void openTodo(const Tag& tag) {
    if (tag.closing) fail("'</todo>' is not needed", tag.word, "'// </solution>', which ends both");
    if (place_ != Place::kSolution)
      fail("'todo' out of place", tag.word, "one in a solution, after the reference lines");
    place_ = Place::kTodo;
  }

  void close(const Tag& tag) {
    if (place_ == Place::kPublic || opening() != tag.word)
      fail(fmt::format("'</{}>' closes nothing", tag.word), tag.word);
    place_ = Place::kPublic;
  }

  void requireTodo() const {
    const std::string_view text = trim(line_);
    if (text.empty() || text == "//|" || text.starts_with("//| ")) return;
    fail("a todo line", text, "it to start with '//| '");
  }

  std::string file_;
  std::vector<std::string> words_;
  bool hasVariants_;
  std::set<std::string, std::less<>> regions_, variants_;  // names of those so far
  Place place_ = Place::kPublic;
  std::string name_;
  std::string_view line_;
  int number_ = 0;
  SourceLocation opened_;
};

std::vector<Line> readSolution(std::string_view text, const std::string& file) {
  return MarkerReader(file, {"solution", "todo"}).read(text);
}

std::vector<Line> readWrong(std::string_view text, const std::string& file) {
  return MarkerReader(file, {"variant", "solution"}).read(text);
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

// The file without markers and todos, and with some of its regions replaced.
std::string withReplaced(const std::vector<Line>& lines,
                         const std::map<std::string, std::string>& replacements) {
  std::string text, current;
  for (const Line& line : lines) {
    const auto replacement = replacements.find(line.name);
    const bool opens = !line.name.empty() && line.name != current;
    current = line.name;
    if (opens && replacement != replacements.end()) text += replacement->second;
    const bool kept = line.place == Place::kSolution && replacement == replacements.end();
    if (kept || line.place == Place::kPublic) text += line.text + "\n";
  }
  return text;
}

constexpr std::array<const char*, 4> kKeys = {"caught by", "shown by", "mistake", "ask"};
constexpr std::string_view kInPlaceOf = "in place of:";

// Composes the variants of wrong.cpp with the solution, line by line.
class VariantReader {
 public:
  VariantReader(std::string file, std::string_view solution, std::string solutionFile)
      : file_(std::move(file)),
        solutionFile_(std::move(solutionFile)),
        solution_(readSolution(solution, solutionFile_)) {
    for (const Line& line : solution_)
      if (!line.name.empty() && (regions_.empty() || regions_.back() != line.name))
        regions_.push_back(line.name);
  }

  std::vector<WrongVariant> read(const std::vector<Line>& lines) {
    for (const Line& line : lines) {
      if (line.place == Place::kVariant)
        begin(line);
      else if (variants_.empty())
        requireComment(line, "code before the first variant", "'// <variant NAME>' before it");
      else if (line.place == Place::kMarker)
        openRegion(line);
      else if (line.place == Place::kSolution)
        addToRegion(line);
      else
        readHeader(line);
    }
    if (variants_.empty())
      throw Error({.what = "no variant", .where = {file_, 1, 1}, .wanted = "'// <variant NAME>'"});
    end();
    return std::move(variants_);
  }

 private:
  // `part` of the line is wrong.
  [[noreturn]] void fail(std::string what, const Line& line, std::string_view part, std::string wanted = {},
                         std::vector<std::string> nearest = {}) const {
    throw Error({.what = std::move(what),
                 .where = {file_, line.number, columnOf(part, line.text)},
                 .wanted = std::move(wanted),
                 .nearest = std::move(nearest)});
  }

  void begin(const Line& line) {
    if (!variants_.empty()) end();
    variants_.emplace_back().name = line.name;
    const Tag tag = *tagIn(line.text);
    start_ = {file_, line.number, columnOf(tag.name, line.text)};
    if (!tag.rest.empty()) readHeader(tag.rest, line);
  }

  void end() {
    WrongVariant& variant = variants_.back();
    const auto require = [&](bool holds, const char* what, const char* wanted) {
      if (!holds)
        throw Error(
            {.what = fmt::format("variant '{}': {}", variant.name, what), .where = start_, .wanted = wanted});
    };
    require(!variant.caughtBy.empty(), "no check is named", "'// caught by: CHECK, ...'");
    require(!variant.mistake.empty(), "the mistake is not described", "'// mistake: TEXT'");
    require(variant.question.empty() || variant.question.find('?') != variant.question.npos,
            "the question has no '?'", "'// ask: QUESTION?'");
    require(!replacements_.empty(), "no region", "'// <solution NAME>' with the mistake");
    closeRegion();
    variant.source = withReplaced(solution_, replacements_);
    replacements_.clear();
  }

  void openRegion(const Line& line) {
    const Tag tag = *tagIn(line.text);
    if (std::find(regions_.begin(), regions_.end(), tag.name) == regions_.end())
      fail(fmt::format("{} has no region '{}'", solutionFile_, tag.name), line, tag.name, {},
           nearestNames(tag.name, regions_));
    closeRegion();
    replacements_.try_emplace(line.name);
    region_ = line.name;
  }

  // The lines of the solution after the last passage that is replaced stay.
  void closeRegion() {
    if (isEdited_) copyUntil(SIZE_MAX);
    isEdited_ = false;
    copied_ = 0;
    blanks_.clear();
  }

  std::vector<std::string_view> linesOfRegion() const {
    std::vector<std::string_view> lines;
    for (const Line& line : solution_)
      if (line.place == Place::kSolution && line.name == region_) lines.push_back(line.text);
    return lines;
  }

  // Copies the lines of the solution's region from the last copied one up to line `end`.
  void copyUntil(std::size_t end) {
    const std::vector<std::string_view> lines = linesOfRegion();
    for (; copied_ < std::min(end, lines.size()); ++copied_)
      replacements_[region_].append(lines[copied_]).append("\n");
  }

  // Copies the solution up to the passage that begins with one text and ends with the other, which lines that
  // follow replace.
  void replacePassage(std::string_view passage, const Line& line) {
    const std::vector<std::string_view> lines = linesOfRegion();
    const std::size_t dots = std::min(passage.find(" ... "), passage.size());
    const std::string_view begin = trim(passage.substr(0, dots)),
                           end = passage.substr(std::min(dots + 5, passage.size()));
    const auto begins = [&](std::string_view text) {
      return [text](std::string_view one) { return trim(one).starts_with(text); };
    };
    const std::string wanted = fmt::format("the beginning of one line of region '{}'", region_);
    if (!isEdited_ && !replacements_[region_].empty())
      fail("code before 'in place of'", line, trim(line.text), "'in place of' first, or nowhere in a region");
    const auto count = begin.empty() ? 0 : std::count_if(lines.begin(), lines.end(), begins(begin));
    if (count != 1)
      fail(fmt::format("{} lines begin with '{}'", count == 0 ? "no" : std::to_string(count), begin), line,
           begin.empty() ? trim(line.text) : begin, wanted);
    const auto first = std::find_if(lines.begin(), lines.end(), begins(begin));
    if (first < lines.begin() + static_cast<std::ptrdiff_t>(copied_))
      fail(fmt::format("'{}' comes before what was replaced last", begin), line, begin,
           "passages in the order of the solution");
    const auto last = end.empty() ? first : std::find_if(first + 1, lines.end(), begins(end));
    if (last == lines.end()) fail(fmt::format("no line after that begins with '{}'", end), line, end, wanted);
    copyUntil(static_cast<std::size_t>(first - lines.begin()));
    copied_ = static_cast<std::size_t>(last - lines.begin()) + 1;
    isEdited_ = true;
    blanks_.clear();
  }

  // Blank lines belong to a region only if another line of it follows.
  void addToRegion(const Line& line) {
    const std::string_view text = trim(line.text);
    const std::string_view comment = text.starts_with("//") ? trim(text.substr(2)) : std::string_view();
    for (const std::string key : kKeys)
      if (comment.starts_with(key + ":"))
        fail(fmt::format("'{}' after a region", key), line, text, "it below '// <variant NAME>'");
    if (comment.starts_with(kInPlaceOf)) return replacePassage(trim(comment.substr(kInPlaceOf.size())), line);
    std::string& region = replacements_[line.name];
    if (!text.empty()) region += std::exchange(blanks_, {}) + line.text;
    (text.empty() ? blanks_ : region) += "\n";
  }

  void requireComment(const Line& line, std::string what, std::string wanted) const {
    const std::string_view text = trim(line.text);
    if (line.place != Place::kPublic || (!text.empty() && !text.starts_with("//")))
      fail(std::move(what), line, text, std::move(wanted));
  }

  void readHeader(const Line& line) {
    requireComment(line, "code outside a region", "'// <solution NAME>' before it");
    const std::string_view text = trim(line.text),
                           comment = trim(text.substr(std::min<std::size_t>(2, text.size())));
    if (!comment.empty()) readHeader(comment, line);
  }

  // Reads `caught by: CHECK, ...`, `shown by: CHECK, ...`, `mistake: TEXT` or `ask: QUESTION`.
  void readHeader(std::string_view comment, const Line& line) {
    const std::string_view key = comment.substr(0, comment.find(':'));
    const std::string_view value = trim(comment.substr(std::min(key.size() + 1, comment.size())));
    WrongVariant& variant = variants_.back();
    if (key == "caught by")
      readChecks(value, line, variant.caughtBy);
    else if (key == "shown by")
      readChecks(value, line, variant.shownBy);
    else if (key == "mistake" && variant.mistake.empty())
      variant.mistake = value;
    else if (key == "mistake")
      fail("a second line for the mistake", line, key, "'// mistake: TEXT' in one line");
    else if (key == "ask")
      variant.question.append(variant.question.empty() ? "" : " ").append(value);
    else
      fail(fmt::format("unknown line '{}' in a variant", key), line, comment,
           "one of 'caught by:', 'shown by:', 'mistake:' and 'ask:', each in one line",
           nearestNames(key, {kKeys.begin(), kKeys.end()}));
  }

  // Adds the ids of a list with commas.
  void readChecks(std::string_view list, const Line& line, std::vector<std::string>& ids) {
    while (!list.empty()) {
      const std::size_t comma = std::min(list.find(','), list.size());
      if (const std::string_view id = trim(list.substr(0, comma)); !id.empty()) {
        ids.emplace_back(id);
        variants_.back().namedAt[ids.back()] = {file_, line.number, columnOf(id, line.text)};
      }
      list.remove_prefix(std::min(comma + 1, list.size()));
    }
  }

  std::string file_, solutionFile_;
  std::vector<Line> solution_;
  std::vector<std::string> regions_;  // their names in the solution
  std::vector<WrongVariant> variants_{};
  SourceLocation start_{};                             // the last variant
  std::map<std::string, std::string> replacements_{};  // of the last variant
  std::string blanks_{};                               // lines at the end of its last region
  std::string region_{};                               // its last region
  bool isEdited_ = false;                              // it says what it replaces in that
  std::size_t copied_ = 0;                             // lines of that region are copied or replaced
};

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

std::vector<WrongVariant> readVariants(std::string_view solution, const std::string& solutionFile,
                                       std::string_view wrong, const std::string& wrongFile) {
  return VariantReader(wrongFile, solution, solutionFile).read(readWrong(wrong, wrongFile));
}

std::vector<std::string> variantNamesIn(std::string_view wrong) {
  std::vector<std::string> names;
  for (const std::string_view line : splitLines(wrong))
    if (const std::optional<Tag> tag = tagIn(line); tag && tag->word == "variant" && !tag->name.empty())
      names.emplace_back(tag->name);
  return names;
}

std::vector<std::vector<BlockLine>> variantBlocks(std::string_view wrong, const std::string& file) {
  std::vector<std::vector<BlockLine>> blocks;
  for (const Line& line : readWrong(wrong, file)) {
    if (line.place == Place::kVariant)
      blocks.emplace_back();
    else if (!blocks.empty() && line.place != Place::kMarker)
      blocks.back().push_back({line.number, std::string(trim(line.text))});
  }
  return blocks;
}

}  // namespace rex::submission
