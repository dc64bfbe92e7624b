#include "classroom/similar.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <set>
#include <string_view>
#include <unordered_map>

#include <fmt/format.h>

#include "base/escape.h"
#include "base/text.h"
#include "submission/cpp_text.h"

namespace rex::classroom {
namespace {

bool isWordLetter(char c) {
  return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

std::set<std::string_view> linesOf(std::string_view text) {
  std::set<std::string_view> lines;
  for (const std::string_view line : splitLines(text)) lines.insert(trimmed(line));
  return lines;
}

constexpr std::size_t kGram = 12, kWindow = 13;  // tokens, grams: so that runs from here on are found:
constexpr std::size_t kShortest = kGram + kWindow - 1;
constexpr int kContained = 90;  // percent of one file that are in another one

/// The tokens of one file, as far as a comparison sees them.
struct Fingerprints {
  std::vector<std::uint64_t> symbols{};  ///< of each token: equal for all names that are no keywords
  std::vector<int> lines{};              ///< of each token, from 1
  std::vector<std::pair<std::size_t, std::uint64_t>> chosen{};  ///< where the chosen grams begin, and hashes
  std::unordered_map<std::uint64_t, std::vector<std::size_t>> places{};  ///< of the chosen grams, by hash
};

std::uint64_t mixed(std::uint64_t h) {
  h = (h ^ (h >> 31)) * 0x9e3779b97f4a7c15;
  return h ^ (h >> 29);
}

std::uint64_t symbolOf(const submission::CppText& text, std::size_t i) {
  static const std::set<std::string_view> kKeywords = {
      "auto",   "bool",  "break",     "case", "catch",    "class",    "const",  "constexpr", "continue",
      "delete", "do",    "double",    "else", "enum",     "false",    "float",  "for",       "if",
      "int",    "long",  "namespace", "new",  "return",   "static",   "struct", "switch",    "template",
      "this",   "throw", "true",      "try",  "typename", "unsigned", "using",  "void",      "while"};
  std::string_view symbol = text.at(i);
  if (text.isKind(i, submission::TokenKind::kNumber)) symbol = "0";
  if (text.isKind(i, submission::TokenKind::kText)) symbol = "\"";
  if (text.isName(i) && !kKeywords.contains(symbol)) symbol = "a";
  std::uint64_t hash = 14695981039346656037u;
  for (const char c : symbol) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211u;
  return mixed(hash);
}

/// Reads the tokens that count: all but regions in `#if 0`, empty statements and statements `(void)...;`.
class CountedTokens {
 public:
  explicit CountedTokens(const submission::CppText& text) : text_(text) {}

  std::vector<std::size_t> read() {
    std::vector<std::size_t> counted;
    bool startsStatement = true;
    for (std::size_t i = 0; i < text_.size();) {
      const std::size_t next = startsStatement ? afterNothing(i) : afterSkipped(i);
      if (next > i) {
        i = next;
        continue;
      }
      counted.push_back(i);
      startsStatement = text_.isSign(i, ';') || text_.isSign(i, '{') || text_.isSign(i, '}');
      ++i;
    }
    return counted;
  }

 private:
  // The token after a region in `#if 0` that begins with token i, or i.
  std::size_t afterSkipped(std::size_t i) const {
    if (!text_.startsDirective(i) || text_.at(i + 1) != "if") return i;
    if (text_.nextLine(i) != i + 3 || (text_.at(i + 2) != "0" && text_.at(i + 2) != "false")) return i;
    int depth = 0;
    for (std::size_t k = i; k < text_.size(); k = nextDirective(k)) {
      const std::string_view word = text_.at(k + 1);
      depth += word.starts_with("if") ? 1 : word == "endif" ? -1 : 0;
      if (depth == 0 || (depth == 1 && word.starts_with("el"))) return text_.nextLine(k);
    }
    return text_.size();
  }

  // The same, at the beginning of a statement.
  std::size_t afterNothing(std::size_t i) const {
    if (text_.isSign(i, ';')) return i + 1;
    if (!text_.isSign(i, '(') || text_.at(i + 1) != "void" || !text_.isSign(i + 2, ')'))
      return afterSkipped(i);
    std::size_t k = i;
    for (; k < text_.size() && !text_.isSign(k, ';'); ++k)
      if (text_.partner(k) < text_.size()) k = std::max(k, text_.partner(k));
    return std::min(k + 1, text_.size());
  }

  std::size_t nextDirective(std::size_t k) const {
    do k = text_.nextLine(k);
    while (k < text_.size() && !text_.startsDirective(k));
    return k;
  }

  const submission::CppText& text_;
};

// Of each window of grams, the last one with the smallest hash is chosen.
Fingerprints fingerprintsOf(const std::string& source) {
  Fingerprints prints;
  const submission::CppText text(source);
  const submission::TextPlaces places(source);
  for (const std::size_t i : CountedTokens(text).read()) {
    prints.symbols.push_back(symbolOf(text, i));
    prints.lines.push_back(places.line(text[i].start));
  }
  std::vector<std::uint64_t> grams;
  for (std::size_t i = 0; i + kGram <= prints.symbols.size(); ++i) {
    std::uint64_t hash = 0;
    for (std::size_t k = 0; k < kGram; ++k) hash = mixed(hash + prints.symbols[i + k] * (k + 1));
    grams.push_back(hash);
  }
  for (std::size_t i = 0; i + kWindow <= grams.size(); ++i) {
    std::size_t least = i;
    for (std::size_t k = i + 1; k < i + kWindow; ++k)
      if (grams[k] <= grams[least]) least = k;
    if (!prints.chosen.empty() && prints.chosen.back().first == least) continue;
    prints.chosen.emplace_back(least, grams[least]);
    prints.places[grams[least]].push_back(least);
  }
  return prints;
}

/// How much of one file is in another one.
struct Overlap {
  std::size_t tokens = 0;
  std::vector<SimilarRun> runs{};
};

Overlap overlapOf(const Fingerprints& a, const Fingerprints& b) {
  constexpr std::size_t kMostPlaces = 16;  // a file that repeats itself has many equal ones
  Overlap overlap;
  std::size_t end = 0;  // of what is covered in a
  for (const auto& [i, hash] : a.chosen) {
    const auto found = b.places.find(hash);
    if (i < end || found == b.places.end()) continue;
    std::size_t from = 0, length = 0, there = 0;
    for (std::size_t p = 0; p < std::min(kMostPlaces, found->second.size()); ++p) {
      const std::size_t j = found->second[p];
      std::size_t back = 0, on = 0;
      while (i - back > end && back < j && a.symbols[i - back - 1] == b.symbols[j - back - 1]) ++back;
      while (i + on < a.symbols.size() && j + on < b.symbols.size() && a.symbols[i + on] == b.symbols[j + on])
        ++on;
      if (back + on > length) from = i - back, length = back + on, there = j - back;
    }
    if (length < kShortest) continue;
    end = from + length;
    overlap.tokens += length;
    overlap.runs.push_back({.first = {a.lines[from], a.lines[end - 1]},
                            .second = {b.lines[there], b.lines[there + length - 1]}});
  }
  return overlap;
}

int percentOf(std::size_t part, std::size_t whole) {
  return whole == 0 ? 0 : static_cast<int>(100 * part / whole);
}

}  // namespace

std::string withoutHandedOut(std::string_view text, std::string_view handedOut) {
  const std::set<std::string_view> known = linesOf(handedOut);
  std::string rest;
  for (const std::string_view line : splitLines(text)) {
    // A lone brace belongs to what it encloses.
    const bool hasWords = std::any_of(line.begin(), line.end(), isWordLetter);
    if (!hasWords || !known.contains(trimmed(line))) rest += line;
    rest += '\n';
  }
  return rest;
}

std::vector<SimilarPair> similarPairs(const std::vector<ComparedText>& texts, std::string_view handedOut,
                                      int leastPercent) {
  std::vector<Fingerprints> prints;
  for (const ComparedText& one : texts)
    prints.push_back(fingerprintsOf(withoutHandedOut(one.text, handedOut)));
  std::vector<SimilarPair> pairs;
  for (std::size_t i = 0; i < texts.size(); ++i)
    for (std::size_t k = i + 1; k < texts.size(); ++k) {
      const Overlap there = overlapOf(prints[i], prints[k]), back = overlapOf(prints[k], prints[i]);
      SimilarPair pair{.first = texts[i].student,
                       .second = texts[k].student,
                       .firstPercent = percentOf(there.tokens, prints[i].symbols.size()),
                       .secondPercent = percentOf(back.tokens, prints[k].symbols.size()),
                       .runs = there.runs};
      const auto [less, more] = std::minmax(pair.firstPercent, pair.secondPercent);
      if ((less < leastPercent && more < std::max(leastPercent, kContained)) || there.tokens == 0) continue;
      for (const SimilarRun& run : back.runs) pair.runs.push_back({.first = run.second, .second = run.first});
      std::sort(pair.runs.begin(), pair.runs.end(),
                [](const SimilarRun& a, const SimilarRun& b) { return a.first < b.first; });
      pairs.push_back(std::move(pair));
    }
  std::stable_sort(pairs.begin(), pairs.end(), [](const SimilarPair& a, const SimilarPair& b) {
    return std::min(a.firstPercent, a.secondPercent) > std::min(b.firstPercent, b.secondPercent);
  });
  return pairs;
}

std::vector<std::vector<std::string>> similarGroups(const std::vector<SimilarPair>& pairs) {
  std::map<std::string, std::set<std::string>> groups;  // by their first member
  std::map<std::string, std::string> first;             // of each student's group
  for (const SimilarPair& pair : pairs) {
    for (const std::string& student : {pair.first, pair.second})
      if (first.try_emplace(student, student).second) groups[student] = {student};
    const std::string a = first[pair.first], b = first[pair.second];
    if (a == b) continue;
    const auto [keep, drop] = std::minmax(a, b);
    for (const std::string& student : groups[drop]) first[student] = keep;
    groups[keep].merge(groups[drop]);
    groups.erase(drop);
  }
  std::vector<std::vector<std::string>> all;
  for (const auto& [name, members] : groups) all.emplace_back(members.begin(), members.end());
  return all;
}

namespace {

constexpr std::string_view kStyle = R"(
body { font: 15px/1.5 sans-serif; margin: 2em auto; max-width: 110em; padding: 0 1em; color: #222; background: #fff; }
p { max-width: 50em; }
.pair { display: grid; grid-template-columns: 1fr 1fr; gap: 1em; }
pre { font: 12px/1.35 monospace; margin: 0; padding: .5em; border: 1px solid #ccc; overflow-x: auto; }
pre span { display: block; white-space: pre; min-height: 1.35em; }
.alike { background: #ffe9a8; }
.given { color: #999; }
)";

constexpr std::string_view kLimits =
    "<p>The programs were compared token by token, without comments, layout, names, numbers, statements that "
    "do "
    "nothing, and the lines of the "
    "file that was handed out. Marked lines are alike in both. There are honest reasons for that: a short "
    "task with one natural solution, a formula of the script, work in a group, the same tutorial. Code that "
    "was rewritten, taken from elsewhere or generated is not found at all. So this page decides "
    "nothing: look at the lines, and ask.</p>\n";

// Which of so many lines are in a run, by their numbers.
std::vector<bool> alikeLines(std::size_t count, const SimilarPair& pair,
                             std::pair<int, int> SimilarRun::*side) {
  std::vector<int> more(count + 2);  // runs that begin with a line, less those that ended before it
  for (const SimilarRun& run : pair.runs) {
    const auto [first, last] = run.*side;
    if (first < 1 || last < first || std::size_t(last) > count) continue;
    ++more[std::size_t(first)], --more[std::size_t(last) + 1];
  }
  std::vector<bool> alike(count + 1);
  int open = 0;
  for (std::size_t line = 1; line <= count; ++line) alike[line] = (open += more[line]) > 0;
  return alike;
}

// The lines of one side; `side` selects the lines of a run.
std::string column(const std::string& text, std::string_view handedOut, const SimilarPair& pair,
                   std::pair<int, int> SimilarRun::*side) {
  std::string html = "<pre>";
  const std::string own = withoutHandedOut(text, handedOut);
  const std::vector<std::string_view> ownLines = splitLines(own);
  const std::vector<bool> alike = alikeLines(ownLines.size(), pair, side);
  std::size_t line = 0;
  for (const std::string_view one : splitLines(text)) {
    const bool given = ownLines[line].empty();
    ++line;
    const char* kind = given ? " class=\"given\"" : alike[line] ? " class=\"alike\"" : "";
    html += fmt::format("<span{}>{:4}  {}</span>", kind, line, htmlText(one));
  }
  return html + "</pre>\n";
}

std::string textOf(const std::vector<ComparedText>& texts, const std::string& student) {
  for (const ComparedText& one : texts)
    if (one.student == student) return one.text;
  return "";
}

}  // namespace

std::string similarPage(const std::string& exercise, const std::vector<ComparedText>& texts,
                        std::string_view handedOut, const std::vector<SimilarPair>& pairs) {
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>{0}: similar "
      "submissions</title>\n<style>{1}</style>\n</head>\n<body>\n<h1>{0}: similar submissions</h1>\n{2}",
      htmlText(exercise), kStyle, kLimits);
  const auto groups = similarGroups(pairs);
  html += fmt::format("<p>{} submission{} compared, {} group{}, {} pair{}.</p>\n<ul>\n", texts.size(),
                      texts.size() == 1 ? "" : "s", groups.size(), groups.size() == 1 ? "" : "s",
                      pairs.size(), pairs.size() == 1 ? "" : "s");
  for (const std::vector<std::string>& group : groups)
    html += fmt::format("<li>{}</li>\n", htmlText(join(group, ", ")));
  html += "</ul>\n<ol>\n";
  for (std::size_t k = 0; k < pairs.size(); ++k)
    html += fmt::format("<li><a href=\"#pair-{}\">{} and {}</a>: {} %, {} %</li>\n", k + 1,
                        htmlText(pairs[k].first), htmlText(pairs[k].second), pairs[k].firstPercent,
                        pairs[k].secondPercent);
  html += "</ol>\n";
  int number = 0;
  for (const SimilarPair& pair : pairs) {
    html += fmt::format(
        "<h2 id=\"pair-{4}\">{0} and {1}</h2>\n<p>{2} % of {0} is also in {1}, {3} % of {1} is also in "
        "{0}.</p>\n",
        htmlText(pair.first), htmlText(pair.second), pair.firstPercent, pair.secondPercent, ++number);
    html += "<div class=\"pair\">\n" +
            column(textOf(texts, pair.first), handedOut, pair, &SimilarRun::first) +
            column(textOf(texts, pair.second), handedOut, pair, &SimilarRun::second) + "</div>\n";
  }
  return html + "</body>\n</html>\n";
}

}  // namespace rex::classroom
