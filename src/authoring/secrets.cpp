#include "authoring/secrets.h"

#include <algorithm>
#include <set>
#include <tuple>

#include <fmt/format.h>

#include "authoring/leak_scan.h"
#include "authoring/leak_scan_internal.h"
#include "base/error.h"
#include "base/process.h"
#include "base/text.h"
#include "base/text_file.h"
#include "grading/hidden_seed.h"
#include "submission/regions.h"
#include "submission/student_files.h"

namespace rex::authoring {
namespace {

// The names that `git ls-files` prints, each ended by a zero byte.
std::set<std::string> listed(const std::filesystem::path& root, std::vector<std::string> options) {
  // The user need not own the files, and a git hook points its children to another repository.
  options.insert(options.begin(),
                 {"git", "-c", "safe.directory=*", "-C", root.string(),
                  "--git-dir=" + (root / ".git").string(), "--work-tree=" + root.string(), "ls-files", "-z"});
  const ProcessResult run = runProcess(options, {.outputLimit = 64 << 20});
  if (!run.ok())
    throw Error({.what = "cannot ask git which files belong to the course",
                 .where = {root.string()},
                 .found = run.started ? run.error.substr(0, run.error.find('\n')) : "no git program",
                 .wanted = "git, or a folder without .git"});
  std::set<std::string> names;
  for (std::size_t at = 0, end = 0; (end = run.output.find('\0', at)) != std::string::npos; at = end + 1)
    names.insert(run.output.substr(at, end - at));
  return names;
}

}  // namespace

std::optional<std::set<std::string>> knownFiles(const std::filesystem::path& root,
                                                const std::vector<std::string>& places) {
  if (!std::filesystem::exists(root / ".git")) return std::nullopt;
  std::vector<std::string> others = {"--others", "--exclude-standard", "--"};
  others.insert(others.end(), places.begin(), places.end());
  const std::set<std::string> unknown = listed(root, others);
  if (!unknown.empty())
    throw Error(
        {.what = unknown.size() == 1
                     ? "a file that git does not know would reach students"
                     : fmt::format("{} files that git does not know would reach students, this one first",
                                   unknown.size()),
         .where = {*unknown.begin()},
         .wanted = "git add, a line in .gitignore, or another folder"});
  return listed(root, {});
}

namespace {

namespace fs = std::filesystem;

using Block = std::vector<submission::BlockLine>;

// A single line of a check or of a mistake may occur anywhere; several in a row are no coincidence.
constexpr std::size_t kShortestRun = 48;
// Checks and programs that draw have short passages in common.
constexpr std::size_t kShortestOfCheck = 64;
// For a line without its comment.
constexpr std::size_t kShortestCode = 20;
// For a line of the lecturer's notes: shorter ones end paragraphs.
constexpr std::size_t kShortestNote = 40;

std::string letters(std::string_view text, Comments comments) { return normalText(text, comments).letters; }

/// Everything that anybody may read, as one text.
class PublicText {
 public:
  void add(std::string_view text) {
    letters_ += letters(text, Comments::kKeep) + '\n' + letters(text, Comments::kDrop) + '\n';
  }
  void addFile(const fs::path& file) { add(readTextFile(file)); }
  std::set<std::string> formsIn(const std::vector<std::string>& all) const {
    internal::FormIndex index;
    for (std::size_t k = 0; k < all.size(); ++k) index.add(all[k], k);
    std::set<std::string> held;
    index.search(letters_, [&](std::size_t k, std::size_t) { held.insert(all[k]); });
    return held;
  }

 private:
  std::string letters_;
};

/// Collects the secrets of the exercises.
class Collector {
 public:
  Collector(const std::vector<fs::path>& exercises, const fs::path& root) : root_(root) {
    if (fs::is_directory(root / "share/template"))
      for (const auto& entry : fs::recursive_directory_iterator(root / "share/template"))
        if (entry.is_regular_file()) handedOut_.addFile(entry.path());
    for (const fs::path& exercise : exercises) readPublic(exercise);
  }

  void read(const fs::path& exercise) {
    if (const fs::path file = exercise / "solution.cpp"; fs::exists(file))
      for (const Block& block : submission::solutionBlocks(readTextFile(file), file.string()))
        addSolution(block, file);
    if (const fs::path file = exercise / "check.cpp"; fs::exists(file))
      for (const Block& block : submission::hiddenBlocks(readTextFile(file), file.string()))
        addHidden(block, file);
    for (const fs::path& file : filesOfChecks(exercise)) addVisible(file);
    if (const fs::path file = exercise / "wrong.cpp"; fs::exists(file))
      for (const Block& block : submission::variantBlocks(readTextFile(file), file.string()))
        addWrong(block, file);
    if (const fs::path file = exercise / "seen.txt"; fs::exists(file))
      addRuns(SecretKind::kWrongVariant, linesOf(readTextFile(file)), file);
  }

  void readNotes(const fs::path& folder) {
    if (!fs::is_directory(folder)) return;
    for (const auto& entry : fs::directory_iterator(folder)) {
      if (entry.path().extension() != ".md") continue;
      int number = 0;
      const std::string text = readTextFile(entry.path());
      for (const std::string_view line : splitLines(text)) {
        ++number;
        std::string form = letters(line, Comments::kKeep);
        if (!line.starts_with('>') && form.size() >= kShortestNote)
          add(SecretKind::kLecturersNote, {number, std::string(line)}, entry.path(), {std::move(form)});
      }
    }
  }

  std::vector<Secret> take() && {
    leaveOutThePublic();
    std::stable_sort(secrets_.begin(), secrets_.end(), [](const Secret& a, const Secret& b) {
      return std::tie(a.origin.file, a.origin.line) < std::tie(b.origin.file, b.origin.line);
    });
    return std::move(secrets_);
  }

 private:
  void readPublic(const fs::path& exercise) {
    const fs::path solution = exercise / "solution.cpp";
    if (fs::exists(solution)) {
      const std::string text = readTextFile(solution);
      handedOut_.add(submission::textOutsideRegions(text, solution.string()));
      readable_.add(submission::stripSolution(text, solution.string()));
    }
    for (const fs::path& file : filesOfChecks(exercise))
      checks_.add(submission::stripHidden(readTextFile(file), file.string()));
    for (const fs::path& name : submission::studentFiles(exercise))
      if (name.extension() == ".h" || name == "show.cpp") readable_.addFile(exercise / name);
  }

  // check.cpp, and the headers that students do not get.
  static std::vector<fs::path> filesOfChecks(const fs::path& exercise) {
    const std::vector<fs::path> shown = submission::studentFiles(exercise);
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(exercise)) {
      const fs::path name = entry.path().filename();
      const bool isShown = std::find(shown.begin(), shown.end(), name) != shown.end();
      if (name == "check.cpp" || (name.extension() == ".h" && !isShown)) files.push_back(entry.path());
    }
    return files;
  }

  void leaveOutThePublic() {
    std::vector<std::string> all;
    for (const Secret& secret : secrets_) all.insert(all.end(), secret.forms.begin(), secret.forms.end());
    const std::set<std::string> handedOut = handedOut_.formsIn(all), readable = readable_.formsIn(all),
                                checks = checks_.formsIn(all);
    std::erase_if(secrets_, [&](const Secret& secret) {
      const bool isSolution = secret.kind == SecretKind::kSolution,
                 isVisible = secret.kind == SecretKind::kVisibleCheck;
      return std::any_of(secret.forms.begin(), secret.forms.end(), [&](const std::string& form) {
        return handedOut.contains(form) || (!isSolution && readable.contains(form)) ||
               (!isSolution && !isVisible && checks.contains(form));
      });
    });
    // Short code is no evidence without the comment that follows it.
    for (Secret& secret : secrets_)
      if (secret.forms.size() > 1 && secret.forms[1].size() < kShortestCode) secret.forms.pop_back();
  }

  void add(SecretKind kind, const submission::BlockLine& line, const fs::path& file,
           std::vector<std::string> forms) {
    std::erase_if(forms, [](const std::string& form) { return form.size() < kShortestForm; });
    if (forms.empty()) return;
    const std::string name = file.lexically_relative(root_).generic_string();
    secrets_.push_back(
        {.kind = kind, .text = line.text, .origin = {name, line.number}, .forms = std::move(forms)});
  }

  void addSolution(const Block& block, const fs::path& file) {
    for (const submission::BlockLine& line : block) {
      const std::string whole = letters(line.text, Comments::kKeep),
                        code = letters(line.text, Comments::kDrop);
      add(SecretKind::kSolution, line, file, whole == code ? std::vector{whole} : std::vector{whole, code});
    }
  }

  // Adds runs from each line on, with as many lines as it takes.
  void addRuns(SecretKind kind, const Block& block, const fs::path& file,
               std::size_t shortest = kShortestRun) {
    for (std::size_t first = 0; first < block.size(); ++first) {
      std::string code;
      for (std::size_t k = first; k < block.size() && code.size() < shortest; ++k)
        code += letters(block[k].text, Comments::kDrop);
      const bool begins = !letters(block[first].text, Comments::kDrop).empty();
      if (begins && code.size() >= shortest) add(kind, block[first], file, {code});
    }
  }

  void addHidden(const Block& block, const fs::path& file) {
    addRuns(SecretKind::kHiddenCheck, block, file);
    for (const submission::BlockLine& line : block)
      for (const std::string& literal : literalsIn(line.text))
        add(SecretKind::kHiddenName, {line.number, literal}, file, {letters(literal, Comments::kKeep)});
  }

  // All of it but includes, hidden blocks, which are other secrets, and lines of raw strings, which the
  // compiler leaves as they are, and a check may show.
  void addVisible(const fs::path& file) {
    const std::string text = readTextFile(file);
    Block lines = linesOf(text);
    bool isRaw = false;
    std::erase_if(lines, [&](const submission::BlockLine& line) {
      const bool ends = line.text.find(")\"") != line.text.npos, isInside = isRaw && !ends;
      isRaw = isInside || (line.text.find("R\"(") != line.text.npos && !ends);
      return isInside;
    });
    std::erase_if(lines, [](const submission::BlockLine& line) { return line.text.starts_with('#'); });
    for (const Block& hidden : submission::hiddenBlocks(text, file.string()))
      std::erase_if(lines, [&](const submission::BlockLine& line) {
        return !hidden.empty() && line.number >= hidden.front().number && line.number <= hidden.back().number;
      });
    addRuns(SecretKind::kVisibleCheck, lines, file, kShortestOfCheck);
  }

  void addWrong(const Block& block, const fs::path& file) {
    for (const submission::BlockLine& line : block)
      if (line.text.starts_with("// mistake:"))
        add(SecretKind::kWrongVariant, line, file, {letters(line.text, Comments::kKeep)});
    addRuns(SecretKind::kWrongVariant, block, file);
  }

  static Block linesOf(std::string_view text) {
    Block lines;
    for (const std::string_view line : splitLines(text))
      lines.push_back({static_cast<int>(lines.size()) + 1, std::string(line)});
    return lines;
  }

  static std::vector<std::string> literalsIn(std::string_view code) {
    std::vector<std::string> found;
    for (std::size_t open = code.find('"'); open != code.npos;) {
      const std::size_t close = code.find('"', open + 1);
      if (close == code.npos) break;
      found.emplace_back(code.substr(open + 1, close - open - 1));
      open = code.find('"', close + 1);
    }
    return found;
  }

  fs::path root_;
  PublicText handedOut_;  // secrets of any kind that occur here are public
  PublicText readable_;   // so are those that occur here, except lines of solutions
  PublicText checks_;     // and here, except also visible checks
  std::vector<Secret> secrets_{};
};

}  // namespace

std::string_view toString(SecretKind kind) {
  switch (kind) {
    case SecretKind::kSolution:
      return "a line of the solution";
    case SecretKind::kHiddenCheck:
      return "a hidden check";
    case SecretKind::kHiddenName:
      return "a text of a hidden check";
    case SecretKind::kVisibleCheck:
      return "a check or its helper";
    case SecretKind::kWrongVariant:
      return "a wrong variant";
    case SecretKind::kLecturersNote:
      return "a line of the lecturer's notes";
    case SecretKind::kCourseSecret:
      break;
  }
  return "the secret of the course";
}

std::vector<Secret> collectSecrets(const std::vector<fs::path>& exercises, const fs::path& root) {
  Collector collector(exercises, root);
  for (const fs::path& exercise : exercises) collector.read(exercise);
  collector.readNotes(root / "notes");
  return std::move(collector).take();
}

Secret courseSecretIn(const fs::path& file) {
  const std::string form = letters(grading::readCourseSecret(file), Comments::kKeep);
  if (form.size() < kShortestForm)
    throw Error({.what = "cannot scan for the secret of the course",
                 .where = {file.string()},
                 .found = fmt::format("{} non-blank characters", form.size()),
                 .wanted = fmt::format("at least {}", kShortestForm)});
  return {.kind = SecretKind::kCourseSecret, .text = {}, .origin = {file.string(), 1}, .forms = {form}};
}

}  // namespace rex::authoring
