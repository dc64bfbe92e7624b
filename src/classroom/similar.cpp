#include "classroom/similar.h"

#include <algorithm>
#include <csignal>
#include <map>
#include <optional>
#include <set>
#include <string_view>

#include <fmt/format.h>

#include "base/error.h"
#include "base/escape.h"
#include "base/process.h"
#include "base/text.h"
#include "base/text_file.h"

namespace rex::grading {
namespace {

namespace fs = std::filesystem;

constexpr const char* kProgram = "sim_c++";

bool isWordLetter(char c) {
  return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

std::set<std::string_view> linesOf(std::string_view text) {
  std::set<std::string_view> lines;
  for (const std::string_view line : splitLines(text)) lines.insert(trimmed(line));
  return lines;
}

// Names that sim can neither take for options nor print otherwise than we wrote them.
std::string fileName(std::size_t k) { return fmt::format("{:06}.cpp", k); }

// What the program prints; nothing if it takes more processor time.
std::optional<std::string> runSim(std::vector<std::string> arguments, const std::string& input,
                                  const fs::path& folder, double cpuSeconds) {
  arguments.insert(arguments.begin(), kProgram);
  constexpr std::size_t kMostPrinted = 256u << 20, kMostMemory = std::size_t{4} << 30;
  const ProcessResult run = runProcess(arguments, {.input = input,
                                                   .directory = folder,
                                                   .timeout = 60 + 6 * cpuSeconds,
                                                   .outputLimit = kMostPrinted,
                                                   .cpuSeconds = cpuSeconds,
                                                   .addressSpace = kMostMemory});
  if (!run.started)
    throw Error({.what = "submissions cannot be compared",
                 .found = fmt::format("no program {}", kProgram),
                 .wanted = "apt-get install similarity-tester"});
  if (run.timedOut || run.signal == SIGXCPU || run.cpuSeconds >= cpuSeconds) return {};
  if (!run.ok())
    throw Error(
        {.what = fmt::format("{} failed", kProgram), .found = run.error.substr(0, run.error.find('\n'))});
  return run.output;
}

std::string compare(std::vector<std::string> arguments, const std::string& input, const fs::path& folder) {
  constexpr double kMostSeconds = 600;
  if (auto output = runSim(std::move(arguments), input, folder, kMostSeconds)) return *std::move(output);
  throw Error(
      {.what = "submissions cannot be compared",
       .found = fmt::format("more than {:g} s of processor time used by {}", kMostSeconds, kProgram)});
}

// The whole numbers in a line of the program's output, as there are no others in our names of files.
std::vector<int> numbersIn(std::string_view line) {
  std::vector<int> numbers;
  while (!line.empty()) {
    if (const auto number = takeNumber<unsigned>(line))
      numbers.push_back(static_cast<int>(*number));
    else
      line.remove_prefix(1);
  }
  return numbers;
}

// From lines such as "000000.cpp consists for 49 % of 000001.cpp material": how much of the first file is in
// the second one.
std::map<std::pair<int, int>, int> percentagesIn(std::string_view output) {
  std::map<std::pair<int, int>, int> percentages;
  for (const std::string_view line : splitLines(output))
    if (const auto numbers = numbersIn(line);
        numbers.size() == 3 && line.find(".cpp consists for ") != line.npos)
      percentages[{numbers[0], numbers[2]}] = numbers[1];
  return percentages;
}

// From lines such as "000000.cpp: line 12-215  |000001.cpp: line 12-215  [1910]".
std::vector<SimilarRun> runsIn(std::string_view output, int first) {
  std::vector<SimilarRun> runs;
  for (const std::string_view line : splitLines(output)) {
    const std::vector<int> numbers = numbersIn(line);
    if (numbers.size() < 6 || line.find(".cpp: line ") == line.npos || line.find('|') == line.npos) continue;
    std::pair left{numbers[1], numbers[2]}, right{numbers[4], numbers[5]};
    if (numbers[0] != first) std::swap(left, right);
    runs.push_back({.first = left, .second = right});
  }
  std::sort(runs.begin(), runs.end(),
            [](const SimilarRun& a, const SimilarRun& b) { return a.first < b.first; });
  return runs;
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

std::vector<std::string> tooRepetitive(const std::vector<ComparedText>& texts, std::string_view handedOut,
                                       const fs::path& folder) {
  constexpr double kSecondsOfOne = 2;
  const std::string names = fileName(0) + '\n' + fileName(1) + '\n';
  std::vector<std::string> found;
  for (const ComparedText& one : texts) {
    for (const std::size_t k : {std::size_t{0}, std::size_t{1}})
      writeTextFile(folder / fileName(k), withoutHandedOut(one.text, handedOut));
    if (!runSim({"-p", "-a", "-e", "-s", "-T", "-i"}, names, folder, kSecondsOfOne))
      found.push_back(one.student);
  }
  return found;
}

std::vector<SimilarPair> similarPairs(const std::vector<ComparedText>& texts, std::string_view handedOut,
                                      int leastPercent, const fs::path& folder) {
  if (texts.size() < 2) return {};
  std::string names;
  for (std::size_t k = 0; k < texts.size(); ++k) {
    writeTextFile(folder / fileName(k), withoutHandedOut(texts[k].text, handedOut));
    names += fileName(k) + '\n';
  }
  // Each file with each other (-a), alone (-e), and not with itself (-s).
  const auto percentages = percentagesIn(
      compare({"-p", "-a", "-e", "-s", "-T", "-t", fmt::format("{}", leastPercent), "-i"}, names, folder));
  std::vector<SimilarPair> pairs;
  for (const auto& [files, percent] : percentages) {
    const auto [first, second] = files;
    const auto back = percentages.find({second, first});
    if (first > second || back == percentages.end()) continue;
    const std::string output = compare(
        {"-n", "-e", "-s", "-T", "-w", "200", fileName(std::size_t(first)), fileName(std::size_t(second))},
        "", folder);
    pairs.push_back({.first = texts[std::size_t(first)].student,
                     .second = texts[std::size_t(second)].student,
                     .firstPercent = percent,
                     .secondPercent = back->second,
                     .runs = runsIn(output, first)});
  }
  std::stable_sort(pairs.begin(), pairs.end(), [](const SimilarPair& a, const SimilarPair& b) {
    return std::min(a.firstPercent, a.secondPercent) > std::min(b.firstPercent, b.secondPercent);
  });
  return pairs;
}

std::vector<std::vector<std::string>> groupsOf(const std::vector<SimilarPair>& pairs) {
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
    "<p>The programs were compared token by token, without comments, layout, names, numbers, and the lines "
    "of the "
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
  const auto groups = groupsOf(pairs);
  html += fmt::format("<p>{} submission{} compared, {} group{}, {} pair{}.</p>\n<ul>\n", texts.size(),
                      texts.size() == 1 ? "" : "s", groups.size(), groups.size() == 1 ? "" : "s",
                      pairs.size(), pairs.size() == 1 ? "" : "s");
  for (const std::vector<std::string>& group : groups)
    html += fmt::format("<li>{}</li>\n", htmlText(join(group, ", ")));
  html += "</ul>\n";
  for (const SimilarPair& pair : pairs) {
    html += fmt::format(
        "<h2>{0} and {1}</h2>\n<p>{2} % of {0} is also in {1}, {3} % of {1} is also in {0}.</p>\n",
        htmlText(pair.first), htmlText(pair.second), pair.firstPercent, pair.secondPercent);
    html += "<div class=\"pair\">\n" +
            column(textOf(texts, pair.first), handedOut, pair, &SimilarRun::first) +
            column(textOf(texts, pair.second), handedOut, pair, &SimilarRun::second) + "</div>\n";
  }
  return html + "</body>\n</html>\n";
}

}  // namespace rex::grading
