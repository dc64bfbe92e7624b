#include "authoring/named_symbols.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <set>
#include <sstream>

#include "base/text_file.h"
#include "submission/cpp_text.h"

namespace rex::grading {
namespace {

namespace fs = std::filesystem;

using Words = std::set<std::string>;

// The identifiers in a text.
std::vector<std::string> wordsOf(std::string_view text) {
  const CppText tokens(text);
  std::vector<std::string> words;
  for (std::size_t i = 0; i < tokens.size(); ++i)
    if (tokens.isName(i)) words.emplace_back(tokens.at(i));
  return words;
}

// A comment that mentions a name does not make it exist; a literal does, as the name of a file that is made.
void addCodeWords(const std::string& source, Words& words) {
  const CppText code(source);
  for (std::size_t i = 0; i < code.size(); ++i) {
    if (code.isName(i)) words.emplace(code.at(i));
    if (!code.isKind(i, TokenKind::kText)) continue;
    for (std::string& word : wordsOf(code.at(i).substr(1, code.at(i).size() - 2)))
      words.insert(std::move(word));
  }
}

Words libraryWords(const fs::path& root) {
  Words words;
  if (fs::exists(root / "src"))
    for (const auto& entry : fs::recursive_directory_iterator(root / "src"))
      if (entry.path().extension() == ".h") addCodeWords(readTextFile(entry.path()), words);
  return words;
}

Words exerciseWords(const fs::path& exercise) {
  Words words;
  for (const char* name : {"exercise.h", "main.cpp", "show.h", "show.cpp"})
    if (fs::exists(exercise / name)) addCodeWords(readTextFile(exercise / name), words);
  return words;
}

bool looksLikeFile(const std::string& name) {
  constexpr std::array kEndings = {".cpp",  ".h",   ".md",  ".toml", ".ors",  ".urdf",
                                   ".json", ".png", ".svg", ".mp4",  ".html", ".log"};
  const bool ending =
      std::any_of(kEndings.begin(), kEndings.end(), [&](const char* e) { return name.ends_with(e); });
  return name.find(' ') == std::string::npos && (ending || name.ends_with('/'));
}

// Results are made by show.cpp or main.cpp, which names them, perhaps without folder or ending.
bool fileExists(const std::string& name, const fs::path& root, const fs::path& exercise, const Words& words) {
  if (name.starts_with("out/") || fs::exists(exercise / name) || fs::exists(root / name)) return true;
  const std::vector<std::string> stem = wordsOf(fs::path(name).stem().string());
  return !stem.empty() &&
         std::all_of(stem.begin(), stem.end(), [&](const auto& w) { return words.contains(w); });
}

// Whether to check the text: a name, perhaps qualified or called, not a formula, command or foreign name.
bool looksLikeName(const std::string& text) {
  const std::string name = text.substr(0, text.find('('));
  if (name.size() < 2 || name.starts_with("std::") || name.starts_with("Eigen::")) return false;
  const bool plain =
      std::all_of(name.begin(), name.end(), [](char c) { return isWord(c) || c == ':' || c == '.'; });
  return plain && std::isdigit(static_cast<unsigned char>(name[0])) == 0 && isWord(name[0]);
}

class Checker {
 public:
  Checker(fs::path root, fs::path exercise)
      : root_(std::move(root)),
        exercise_(std::move(exercise)),
        library_(libraryWords(root_)),
        words_(exerciseWords(exercise_)) {
    words_.insert(library_.begin(), library_.end());
  }

  // Looks at the text between each pair of backticks of a line.
  void checkLine(const std::string& line, const SourceLocation& where) {
    std::size_t open = line.find('`');
    while (open != std::string::npos) {
      const std::size_t close = line.find('`', open + 1);
      if (close == std::string::npos) return;
      checkName(line.substr(open + 1, close - open - 1),
                {where.file, where.line, static_cast<int>(open) + 2});
      open = line.find('`', close + 1);
    }
  }

  // Looks at a line `function = "rex::name"` of exercise.toml.
  void checkForbidden(const std::string& line, const SourceLocation& where) {
    const std::size_t open = line.find('"'), close = line.find('"', open + 1);
    if (!line.starts_with("function ") || close == std::string::npos) return;
    checkWords(line.substr(open + 1, close - open - 1), {where.file, where.line, static_cast<int>(open) + 2},
               library_);
  }

  std::vector<DeadName> dead() && { return std::move(dead_); }

 private:
  void checkName(const std::string& name, const SourceLocation& where) {
    if (looksLikeFile(name)) {
      if (!fileExists(name, root_, exercise_, words_)) dead_.push_back({where, name, {}});
    } else if (looksLikeName(name)) {
      checkWords(name, where, words_);
    }
  }

  void checkWords(const std::string& name, const SourceLocation& where, const Words& known) {
    for (const std::string& word : wordsOf(name.substr(0, name.find('('))))
      if (word.size() > 1 && !known.contains(word)) {
        dead_.push_back({where, name, nearestNames(word, {known.begin(), known.end()})});
        return;
      }
  }

  fs::path root_, exercise_;
  Words library_, words_;
  std::vector<DeadName> dead_;
};

}  // namespace

std::vector<DeadName> deadNames(const fs::path& root, const fs::path& exercise) {
  Checker checker(root, exercise);
  for (const char* name : {"README.md", "solution.cpp", "exercise.toml"}) {
    const fs::path file = exercise / name;
    if (!fs::exists(file)) continue;
    std::istringstream lines(readTextFile(file));
    const bool readme = file.extension() == ".md", description = file.extension() == ".toml";
    bool fenced = false;
    int number = 0;
    for (std::string line; std::getline(lines, line);) {
      ++number;
      if (description) {
        checker.checkForbidden(line, {file.string(), number});
        continue;
      }
      if (line.starts_with("```")) fenced = !fenced;
      const bool relevant = readme ? !fenced : line.find("//|") != std::string::npos;
      if (relevant) checker.checkLine(line, {file.string(), number});
    }
  }
  return std::move(checker).dead();
}

}  // namespace rex::grading
