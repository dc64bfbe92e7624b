#include "authoring/pasted.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "authoring/shown_code.h"
#include "authoring/wrong_variants.h"
#include "base/error.h"
#include "base/text.h"
#include "base/text_file.h"
#include "submission/build_tools.h"
#include "submission/regions.h"
#include "submission/student_files.h"
#include "submission/submission.h"

namespace rex::authoring {
namespace {

namespace fs = std::filesystem;

/// Source that students see: one file, or show.cpp with the headers that only it includes.
struct ShownSource {
  std::string name{};   ///< for messages
  std::string text{};   ///< without includes that are replaced by what they name
  std::string scope{};  ///< the namespace into which its functions go; empty: they can be called as they are
  bool isLibrary = false;  ///< its functions are pasted as lambdas: calling them would be seen
};

/// A piece of it, as one of the functions that students complete.
struct Paste {
  std::size_t task = 0, source = 0;
  ShownCode code{};
  std::string body{};
};

bool isIn(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

// The names that lines `#include "name"` and `#include <name>` of a text have, and the text without them.
std::pair<std::vector<std::string>, std::string> withoutIncludes(const std::string& text) {
  std::vector<std::string> names;
  std::string rest;
  for (const std::string_view line : splitLines(text)) {
    if (line.starts_with("#include "))
      names.emplace_back(line.substr(9));
    else if (!line.starts_with("#pragma"))
      rest += std::string(line) + '\n';
  }
  return {names, rest};
}

/// Everything that a package shows of C++ to a student who works on one exercise.
class Shown {
 public:
  explicit Shown(const GateContext& context) : folder_(context.exercise.folder) {
    const std::vector<std::string> open = submission::filesIncludedFrom(folder_, {"main.cpp", "exercise.h"});
    for (const std::string& name : open) {
      const auto [names, rest] = withoutIncludes(readTextFile(folder_ / name));
      includes_.insert(names.begin(), names.end());
      sources_.push_back({.name = name, .text = rest});
    }
    if (fs::exists(folder_ / "show.cpp")) addApart("show.cpp", folder_ / "show.cpp", open);
    for (const char* place : {"share/examples", "share/demonstrations"})
      for (const fs::path& file : sourcesBelow(context.root / place, ".cpp"))
        addApart(file.lexically_relative(context.root).generic_string(), file, {});
    for (const std::string& module : publicModules(context.root))
      for (const fs::path& file : sourcesBelow(context.root / "src" / module, ".h"))
        if (!file.string().ends_with("_internal.h"))
          sources_.push_back({.name = file.lexically_relative(context.root).generic_string(),
                              .text = readTextFile(file),
                              .isLibrary = true});
  }

  const std::vector<ShownSource>& sources() const { return sources_; }

  /// What has to be in front of a file with these pastes.
  std::string preamble(const std::vector<Paste>& pastes) const {
    std::string text;
    std::map<std::size_t, std::vector<ShownCode>> wanted;
    for (const Paste& paste : pastes) wanted[paste.source].push_back(paste.code);
    for (const auto& [k, codes] : wanted) {
      const ShownSource& source = sources_[k];
      if (source.isLibrary && !source.name.starts_with("src/legacy/"))  // which has names like course.h
        text =
            fmt::format("#include \"{}\"\n", fs::path(source.name).lexically_relative("src").string()) + text;
      if (source.scope.empty()) continue;
      for (const std::string& name : includesOf_.at(k)) text = fmt::format("#include {}\n", name) + text;
      text += fmt::format("namespace {} {{\n{}}}\n", source.scope, neededPart(source.text, codes));
    }
    return text;
  }

 private:
  // The modules whose headers packages have, lines such as "4 dynamics public".
  static std::vector<std::string> publicModules(const fs::path& root) {
    std::vector<std::string> modules;
    for (const std::string_view line : splitLines(readTextFile(root / "share/layers.txt")))
      if (const std::vector<std::string_view> words = splitWords(line);
          words.size() == 3 && words[2] == "public")
        modules.emplace_back(words[1]);
    return modules;
  }

  static std::vector<fs::path> sourcesBelow(const fs::path& folder, const std::string& ending) {
    std::vector<fs::path> files;
    if (fs::is_directory(folder))
      for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.is_regular_file() && entry.path().extension() == ending) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
  }

  // A file that main.cpp cannot include.
  void addApart(const std::string& name, const fs::path& file, std::vector<std::string> known) {
    std::vector<std::string> includes;
    ShownSource source{.name = name, .scope = fmt::format("shown_{}", sources_.size())};
    source.text = expanded(file, known, includes);
    includesOf_[sources_.size()] = includes;
    sources_.push_back(std::move(source));
  }

  // The file with the headers beside it in place of lines that include them, but for `known` ones.
  static std::string expanded(const fs::path& file, std::vector<std::string>& known,
                              std::vector<std::string>& includes) {
    const auto [names, rest] = withoutIncludes(readTextFile(file));
    std::string text;
    for (const std::string& quoted : names) {
      const std::string name = quoted.substr(1, quoted.find_last_of("\">") - 1);
      const bool isBeside = quoted.starts_with('"') && fs::exists(file.parent_path() / name);
      if (!isBeside) includes.push_back(quoted);
      if (!isBeside || isIn(known, name)) continue;
      known.push_back(name);
      text += expanded(file.parent_path() / name, known, includes);
    }
    return text + rest;
  }

  fs::path folder_;
  std::vector<ShownSource> sources_{};
  std::map<std::size_t, std::vector<std::string>> includesOf_{};
  std::set<std::string> includes_{};
};

using Arguments = std::vector<std::string>;

// The ways to call code with the parameters of a task, of which `spare` may be left out.
class Calls {
 public:
  Calls(const ShownCode& code, const ShownCode& task, std::size_t spare) : code_(code), task_(task) {
    for (const ShownParameter& parameter : code.parameters)
      if (!parameter.isOptional) wanted_.push_back(&parameter);
    if (wanted_.size() <= task.parameters.size() && task.parameters.size() <= wanted_.size() + spare)
      grow({});
  }
  std::vector<std::vector<std::size_t>> take() && { return std::move(found_); }

 private:
  static constexpr std::size_t kMost = 6;  // orders of parameters of the same type

  void grow(std::vector<std::size_t> chosen) {
    if (found_.size() == kMost) return;
    if (chosen.size() == wanted_.size()) {
      found_.push_back(chosen);
      return;
    }
    for (std::size_t k = 0; k < task_.parameters.size(); ++k) {
      if (std::find(chosen.begin(), chosen.end(), k) != chosen.end()) continue;
      if (!fits(task_.parameters[k].type, wanted_[chosen.size()]->type)) continue;
      std::vector<std::size_t> next = chosen;
      next.push_back(k);
      grow(std::move(next));
    }
  }

  const ShownCode &code_, &task_;
  std::vector<const ShownParameter*> wanted_{};
  std::vector<std::vector<std::size_t>> found_{};
};

/// Finds what fits where.
class Pasting {
 public:
  Pasting(const Shown& shown, std::vector<ShownCode> tasks) : shown_(shown), tasks_(std::move(tasks)) {
    for (std::size_t k = 0; k < shown_.sources().size(); ++k) {
      const ShownSource& source = shown_.sources()[k];
      functions_.push_back(functionsIn(source.text));
      if (source.name == "main.cpp")
        std::erase_if(functions_.back(), [&](const ShownCode& code) { return isTask(code.name); });
      for (ShownCode& code : functions_.back()) code.isLambda = code.isLambda || source.isLibrary;
    }
    for (std::size_t k = 0; k < functions_.size(); ++k) {
      for (const ShownCode& code : functions_[k]) pasteFunction(k, code);
      for (const ShownCode& code : longExpressionsIn(shown_.sources()[k].text)) pasteExpression(k, code);
    }
  }

  std::vector<Paste> take() && { return std::move(pastes_); }

 private:
  bool isTask(const std::string& name) const {
    return std::any_of(tasks_.begin(), tasks_.end(),
                       [&](const ShownCode& task) { return task.name == name; });
  }

  void pasteFunction(std::size_t k, const ShownCode& code) {
    for (std::size_t t = 0; t < tasks_.size(); ++t)
      for (const auto& chosen : Calls(code, tasks_[t], 1).take()) {
        if (chosen.empty() && !tasks_[t].parameters.empty()) continue;
        const std::string call = callOf(k, code, tasks_[t], chosen);
        if (code.result.empty() || fits(code.result, tasks_[t].result))
          add(t, k, code, before(k, code) + "return " + call + ";");
        else
          addConverted(t, k, code, call);
      }
  }

  // By a function of one argument that is shown, too, in the same source or where everything can call it.
  void addConverted(std::size_t t, std::size_t k, const ShownCode& code, const std::string& call) {
    for (std::size_t s = 0; s < functions_.size(); ++s)
      for (const ShownCode& by : functions_[s])
        if (by.parameters.size() == 1 && !by.isLambda && (s == k || shown_.sources()[s].scope.empty()) &&
            by.parameters[0].type == code.result && fits(by.result, tasks_[t].result)) {
          ShownCode both = code;
          both.text += by.text;  // so that it is kept
          add(t, k, both, before(k, code) + fmt::format("return {}({});", by.name, call));
        }
  }

  void pasteExpression(std::size_t k, const ShownCode& code) {
    for (std::size_t t = 0; t < tasks_.size(); ++t) {
      const ShownCode& task = tasks_[t];
      if (!code.result.empty() && !fits(code.result, task.result)) continue;
      for (const auto& chosen : Calls(code, task, task.parameters.size()).take()) {
        std::string body = scopeOf(k);
        for (std::size_t i = 0; i < chosen.size(); ++i)
          body += fmt::format("const auto rexGiven{} = {};\n", i, task.parameters[chosen[i]].name);
        body += "{\n";
        for (std::size_t i = 0; i < chosen.size(); ++i)
          body += fmt::format("const auto& {} = rexGiven{};\n", code.parameters[i].name, i);
        add(t, k, code, body + "return " + code.text + ";\n}");
      }
    }
  }

  std::string scopeOf(std::size_t k) const {
    const ShownSource& source = shown_.sources()[k];
    return "using namespace rex;\n" +
           (source.scope.empty() ? "" : fmt::format("using namespace {};\n", source.scope));
  }

  std::string before(std::size_t k, const ShownCode& code) const {
    return scopeOf(k) + (code.isLambda ? fmt::format("const auto rexShown = {};\n", code.lambda) : "");
  }

  std::string callOf(std::size_t k, const ShownCode& code, const ShownCode& task,
                     const std::vector<std::size_t>& chosen) const {
    const ShownSource& source = shown_.sources()[k];
    Arguments arguments;
    for (std::size_t i = 0; i < chosen.size(); ++i) {
      const ShownParameter& given = task.parameters[chosen[i]];
      const bool needsCopy = code.parameters[i].isMutable && !given.isMutable;
      arguments.push_back(needsCopy
                              ? fmt::format("*std::make_unique<std::decay_t<decltype({0})>>({0})", given.name)
                              : given.name);
    }
    const std::string name = code.isLambda          ? "rexShown"
                             : source.scope.empty() ? "::" + code.name
                                                    : source.scope + "::" + code.name;
    return fmt::format("{}({})", name, join(arguments, ", "));
  }

  void add(std::size_t task, std::size_t source, const ShownCode& code, const std::string& body) {
    if (seen_.insert(fmt::format("{} {}", task, code.text + body.substr(body.rfind("return ")))).second)
      pastes_.push_back({.task = task, .source = source, .code = code, .body = "{\n" + body + "\n}"});
  }

  const Shown& shown_;
  std::vector<ShownCode> tasks_;
  std::vector<std::vector<ShownCode>> functions_{};  // of each source
  std::set<std::string> seen_{};
  std::vector<Paste> pastes_{};
};

// The functions that students complete, in a source.
std::vector<ShownCode> tasksIn(const std::string& source, const std::vector<std::string>& functions) {
  std::vector<ShownCode> tasks = functionsIn(source);
  std::erase_if(tasks, [&](const ShownCode& code) { return code.isLambda || !isIn(functions, code.name); });
  return tasks;
}

std::string withBody(const std::string& source, const ShownCode& task, const std::string& body) {
  std::string text = source;
  return text.replace(task.body, task.start + task.text.size() - task.body, body);
}

using CheckResults = std::map<std::string, grading::CheckResult>;

/// Grades what was pasted.
class PasteGrader {
 public:
  explicit PasteGrader(const GateContext& context)
      : context_(context), exercise_(context.exercise), shown_(context) {
    const fs::path file = context.exercise.folder / "solution.cpp";
    const std::string solution = readTextFile(file);
    reference_ = submission::referenceText(solution, file.string());
    const std::vector<std::string>& functions = context.toolchain.functions;
    pastes_ = Pasting(shown_, tasksIn(reference_, functions)).take();
    const std::size_t last = reference_.rfind("\n#include ");
    const std::size_t at = last == reference_.npos ? 0 : reference_.find('\n', last + 1) + 1;
    std::string preamble = shown_.preamble(pastes_);
    // The library may have functions of the same names in headers that the exercise does not include.
    for (const ShownCode& helper : functionsIn(reference_))
      if (!helper.isLambda && !isIn(functions, helper.name))
        preamble += fmt::format("#define {0} {0}OfTheStudent\n", helper.name);
    reference_.insert(at, preamble);
    tasks_ = tasksIn(reference_, functions);
    std::erase_if(tasks_, [&](const ShownCode& code) {  // others of the same name
      return at <= code.start && code.start < at + preamble.size();
    });
    const std::string main = submission::stripSolution(solution, file.string());
    for (const ShownCode& stub : tasksIn(main, functions))
      stubs_[stub.name] = stub.text.substr(stub.body - stub.start);
  }

  Pasted grade() {
    Pasted all;
    std::set<std::size_t> used;
    for (const Paste& paste : pastes_) {
      used.insert(paste.task);
      ++(paste.code.name.empty() ? all.expressions : all.functions);
    }
    if (pastes_.empty()) return all;
    std::vector<std::string> files;
    for (const Paste& paste : pastes_) files.push_back(withBody(reference_, tasks_[paste.task], paste.body));
    for (const std::size_t task : used)
      files.push_back(withBody(reference_, tasks_[task], stubs_[tasks_[task].name]));
    files.push_back(reference_);
    const JointBuild build(context_, reference_, files);
    if (build.holds(files.size() - 1)) limitTimeBy(resultsOf(build.link(files.size() - 1), {}));
    std::size_t next = pastes_.size();
    for (const std::size_t task : used) {
      if (!build.holds(next))
        throw Error(
            {.what = fmt::format("{}: the function as handed out cannot be graded among the pasted ones",
                                 tasks_[task].name),
             .found = build.complaint()});
      judge(task, build, next++, files, all);
    }
    return all;
  }

 private:
  CheckResults resultsOf(const submission::BuiltSubmission& built,
                         const std::vector<std::string>& checks) const {
    CheckResults results;
    if (built.worker.empty()) return results;
    submission::SubmissionOptions options{.main = context_.workFolder / "main.cpp",
                                          .workFolder = built.worker.parent_path(),
                                          .job = {.results = context_.workFolder / "results.json"}};
    options.job.checks = checks;
    for (const grading::CheckResult& check :
         submission::gradeBuilt(built, context_.toolchain, exercise_, options).checks)
      results[check.id] = check;
    return results;
  }

  // Much of what is pasted searches without end: it gets three times what the solution needs in a check.
  void limitTimeBy(const CheckResults& solution) {
    double slowest = 0;
    for (const auto& [id, check] : solution) slowest = std::max(slowest, check.cpuSeconds);
    exercise_.limits.cpuSeconds = std::min(exercise_.limits.cpuSeconds, 1 + 3 * slowest);
  }

  // The checks that the function as handed out does not pass: those that ask it, or if none does, those that
  // ask others which call it.
  static std::vector<std::string> openChecks(const CheckResults& floor, const std::string& function) {
    std::vector<std::string> own, all;
    for (const auto& [id, check] : floor) {
      if (check.points == check.maxPoints) continue;
      all.push_back(id);
      if (check.function == function) own.push_back(id);
    }
    return own.empty() ? all : own;
  }

  // What was pasted into one task, beside the function as handed out.
  void judge(std::size_t task, const JointBuild& build, std::size_t stub,
             const std::vector<std::string>& files, Pasted& all) {
    const CheckResults floor = resultsOf(build.link(stub), {});
    const std::vector<std::string> open = openChecks(floor, tasks_[task].name);
    if (open.empty()) return;
    for (std::size_t k = 0; k < pastes_.size(); ++k) {
      if (pastes_[k].task != task || !build.holds(k)) continue;
      const std::vector<std::string> gains = gainsOf(resultsOf(build.link(k), open), floor);
      if (!gains.empty() && passesAlone(files[k], gains)) complain(pastes_[k], gains, all);
    }
  }

  static std::vector<std::string> gainsOf(const CheckResults& results, const CheckResults& floor) {
    std::vector<std::string> checks;
    for (const auto& [id, check] : results)
      if (check.points > floor.at(id).points) checks.push_back(id);
    return checks;
  }

  // Whether a student could hand this file in: it may call what the exercise forbids.
  bool passesAlone(const std::string& file, const std::vector<std::string>& checks) const {
    submission::SubmissionOptions options{.main = context_.workFolder / "main.cpp",
                                          .workFolder = context_.workFolder / "alone",
                                          .job = {.results = context_.workFolder / "results.json"}};
    options.job.checks = checks;
    writeTextFile(options.main, file);
    return submission::gradeSubmission(context_.toolchain, context_.exercise, options).result.score > 0;
  }

  void complain(const Paste& paste, const std::vector<std::string>& checks, Pasted& all) const {
    const std::string what = paste.code.name.empty()
                                 ? fmt::format("the expression '{}'", shortened(paste.code.text))
                                 : fmt::format("the function '{}'", paste.code.name);
    all.complaints.push_back(fmt::format("{}: {}, pasted into '{}', passes {}",
                                         shown_.sources()[paste.source].name, what, tasks_[paste.task].name,
                                         join(checks, ", ")));
  }

  static std::string shortened(const std::string& text) {
    constexpr std::size_t kShown = 60;
    const std::string line = text.substr(0, std::min(text.find('\n'), kShown));
    return line.size() < text.size() ? line + " ..." : line;
  }

  const GateContext& context_;
  submission::ExerciseInfo exercise_;  // with its limits for what is pasted
  Shown shown_;
  std::string reference_;
  std::vector<ShownCode> tasks_{};
  std::map<std::string, std::string> stubs_{};
  std::vector<Paste> pastes_{};
};

}  // namespace

Pasted pastedCode(const GateContext& context) { return PasteGrader(context).grade(); }

}  // namespace rex::authoring
