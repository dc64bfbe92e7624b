#include "submission/worker_part.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "base/error.h"
#include "base/process.h"
#include "base/text.h"
#include "base/text_file.h"
#include "base/toml_table.h"
#include "submission/build_tools.h"
#include "submission/reading_apart_internal.h"
#include "submission/symbol_scan.h"

namespace rex::submission {
namespace {

namespace fs = std::filesystem;

std::set<std::string> wantedByWorker(const fs::path& worker) {
  std::set<std::string> names;
  if (worker.empty() || !fs::exists(worker)) return names;
  for (const ObjectSymbol& symbol : readObjectFile(readTextFile(worker), worker.string()).symbols)
    if (!symbol.isDefined) names.insert(symbol.name);
  return names;
}

// What the worker refers to; without a worker, whatever any other file could refer to. Copies of templates
// and inline functions are kept only if something needs them.
std::set<std::string> rootsOf(const ObjectFile& object, const std::set<std::string>& wanted) {
  std::set<std::string> roots;
  for (const ObjectSymbol& symbol : object.symbols) {
    const bool isOffered = symbol.isGlobal || (symbol.isWeak && !symbol.isShared);
    const bool isWanted = wanted.empty() ? isOffered && symbol.name != "main" : wanted.contains(symbol.name);
    if (symbol.isDefined && isWanted) roots.insert(symbol.name);
  }
  return roots;
}

}  // namespace

std::optional<ProcessResult> withoutMain(const fs::path& object, const fs::path& part,
                                         const Toolchain& toolchain, const BuildTools& tools) {
  const std::set<std::string> wanted = wantedByWorker(toolchain.workerObject);
  const auto roots = readApart("what the object file defines", kAfterCompiling, [&] {
                       return rootsOf(readObjectFile(readTextFile(object), object.string()), wanted);
                     }).get<std::set<std::string>>();
  if (roots.empty()) return {};
  const fs::path options = fs::path(part).replace_extension(".args");
  for (const fs::path& old : {part, options}) fs::remove(old);  // perhaps of another user
  // There may be too many for a command line. strangeParts() has made sure that none has a blank or a quote.
  std::string list = "-Wl,--gc-sections\n";
  for (const std::string& root : roots) list += fmt::format("-Wl,--undefined={}\n", root);
  writeTextFile(options, list);
  return tools.run({toolchain.compiler, "-r", "-nostdlib", "-fno-lto", "@" + options.string(),
                    object.string(), "-o", part.string()},
                   [&](const ProcessResult& failed) { return blamesObject(failed.error, object.string()); });
}

namespace {

namespace fs = std::filesystem;
using Names = std::set<std::string, std::less<>>;

constexpr const char *kInstances = "eigen_", *kRefusal = "rexNotAllowedHere";

bool isOneOf(std::string_view symbol, const std::vector<std::string>& functions) {
  return std::any_of(functions.begin(), functions.end(),
                     [&](const std::string& function) { return isSymbolFor(symbol, function); });
}

std::vector<std::string> namesOf(const std::vector<ForbiddenFunction>& forbidden) {
  std::vector<std::string> names;
  for (const ForbiddenFunction& one : forbidden) names.push_back(one.function);
  return names;
}

// The symbols that an object file defines for other files.
Names definedIn(const fs::path& object) {
  Names names;
  for (const ObjectSymbol& symbol : readObjectFile(readTextFile(object), object.string()).symbols)
    if (symbol.isDefined && (symbol.isGlobal || symbol.isWeak)) names.insert(symbol.name);
  return names;
}

std::string run(const std::vector<std::string>& command) {
  const ProcessResult done = runProcess(command, {.outputLimit = 1u << 26});
  if (!done.ok()) throw Error({.what = "cannot run " + command.front(), .found = done.error});
  return done.output;
}

std::string fileOf(const ExerciseInfo& exercise) { return (exercise.folder / "exercise.toml").string(); }

/// What the object files of the library define.
struct Definitions {
  Names all{};
  Names ofEigen{};  ///< compiled for everybody by the library
};

Definitions definitionsIn(const std::vector<fs::path>& objects) {
  Definitions found;
  for (const fs::path& object : objects) {
    const bool isInstances = object.filename().string().starts_with(kInstances);
    for (const std::string& symbol : definedIn(object)) {
      found.all.insert(symbol);
      if (isInstances && isSymbolFor(symbol, "Eigen")) found.ofEigen.insert(symbol);
    }
  }
  return found;
}

// The symbols of the library that are allowed and not forbidden, and all of the precompiled parts of Eigen.
Names offered(const Definitions& definitions, const std::vector<std::string>& allowed,
              const ExerciseInfo& exercise) {
  const std::vector<std::string> forbidden = namesOf(exercise.forbidden);
  Names found = definitions.ofEigen, unknown(allowed.begin(), allowed.end());
  for (const std::string& symbol : definitions.all) {
    if (!isOneOf(symbol, allowed)) continue;
    std::erase_if(unknown, [&](const std::string& name) { return isSymbolFor(symbol, name); });
    if (!isOneOf(symbol, forbidden)) found.insert(symbol);
  }
  if (!unknown.empty())
    throw Error({.what = fmt::format("allows '{}', which the library does not have", *unknown.begin()),
                 .where = {fileOf(exercise)},
                 .wanted = "a function or a class of the modules that the exercise uses"});
  return found;
}

// The description of a lambda's type is no code; compilers keep it where functions share what copies lambdas.
// Destructors answer nothing; compilers keep them where they do not inline them.
bool solvesNothing(const std::string& symbol) {
  return symbol.starts_with("_ZTI") || symbol.starts_with("_ZTS") ||
         demangled(symbol).find("::~") != symbol.npos;
}

// Checks the worker of that part; if `part` is empty, the worker of all other parts.
void requireNothingForbidden(const fs::path& object, const std::string& part, const ExerciseInfo& exercise) {
  const ObjectFile file = readObjectFile(readTextFile(object), object.string());
  std::vector<std::string> there;
  for (const ForbiddenFunction& one : exercise.forbidden) {
    const bool isBanned = one.part.empty() || one.part == part;
    const auto isIt = [&](const ObjectSymbol& symbol) {
      return symbol.isDefined && isSymbolFor(symbol.name, one.function) && !solvesNothing(symbol.name);
    };
    if (isBanned && std::any_of(file.symbols.begin(), file.symbols.end(), isIt))
      there.push_back(one.function);
  }
  if (!there.empty())
    throw Error({.what = "forbids functions that an allowed one needs",
                 .where = {fileOf(exercise)},
                 .found = fmt::format("{} in the worker", join(there, ", "))});
}

void writeLines(const fs::path& file, const Names& lines) {
  writeTextFile(file, fmt::format("{}\n", join(lines, "\n")));
}

// Undefined names that something refers to, or those that nothing refers to any more.
Names undefinedIn(const fs::path& object, bool isReferred) {
  Names names;
  for (const ObjectSymbol& symbol : readObjectFile(readTextFile(object), object.string()).symbols)
    if (!symbol.isDefined && symbol.isReferred == isReferred) names.insert(symbol.name);
  return names;
}

// The linker keeps the names of what it left out; the next link would ask for their libraries.
void dropUnusedNames(const fs::path& object, const fs::path& list, const WorkerPartOrder& order) {
  writeLines(list, undefinedIn(object, false));
  run({order.objcopy, "--strip-symbols=" + list.string(), object.string()});
}

// A path as the compiler reads it in a file of options, a line.
std::string optionLine(const fs::path& file) {
  std::string line;
  for (const char c : file.string()) {
    if (c == ' ' || c == '\t' || c == '\\' || c == '"' || c == '\'') line += '\\';
    line += c;
  }
  return line + '\n';
}

// Section groups are resolved here, so that a student's copy of a template does not replace ours.
void link(const WorkerPartOrder& order, const fs::path& object, const Names& offers,
          const std::string& options) {
  std::string arguments = "-Wl,--gc-sections\n-Wl,--force-group-allocation\n" + options;
  Names roots = offers;
  roots.insert({"main", kRefusal});
  for (const std::string& name : roots) arguments += fmt::format("-Wl,--undefined={}\n", name);
  arguments += optionLine(order.worker);
  for (const fs::path& one : order.objects) arguments += optionLine(one);
  const fs::path list = fs::path(object).replace_extension(".args");
  writeTextFile(list, arguments);
  run({order.compiler, "-r", "-nostdlib", "-fno-lto", "@" + list.string(), "-o", object.string()});
  writeLines(list, roots);
  run({order.objcopy, "--strip-debug", "--keep-global-symbols=" + list.string(), object.string()});
  dropUnusedNames(object, list, order);
}

// Links without a version are for compiling, and missing where rex is installed. The shortest name with a
// version is that of the interface, which each version and each provider of the library has.
fs::path runtimeName(const fs::path& library) {
  const fs::path file = fs::canonical(library);
  const std::string whole = file.filename().string(), start = whole.substr(0, whole.find(".so")) + ".so.";
  fs::path best;
  for (const auto& entry : fs::directory_iterator(library.parent_path())) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with(start) && fs::weakly_canonical(entry.path()) == file &&
        (best.empty() || name.size() < best.filename().string().size()))
      best = entry.path();
  }
  return best.empty() ? file : best;
}

// The external libraries that the object file needs. Others are not linked: their functions could do
// forbidden work, too.
std::string neededBy(const fs::path& object, const WorkerPartOrder& order) {
  const Names missing = undefinedIn(object, true);
  const auto isMissing = [&](std::string_view line) {
    return missing.contains(line.substr(0, line.find('@')));  // the rest is its version
  };
  std::string needed;
  for (const fs::path& library : order.libraries) {
    const std::string names = run({order.nm, "-D", "--defined-only", "-fjust-symbols", library.string()});
    const std::vector<std::string_view> lines = splitLines(names);
    if (std::any_of(lines.begin(), lines.end(), isMissing)) needed += optionLine(runtimeName(library));
  }
  return needed;
}

// It loads and holds what other workers do.
void linkControl(const WorkerPartOrder& order, const std::string& withoutStudent, const Names& offers) {
  const fs::path whole = order.folder / "worker_part.o", object = order.folder / "worker.control.o";
  link(order, object, offers, withoutStudent);
  std::vector<std::string> command = {
      order.compiler, "-s", object, "@" + linkOptions(whole).string(), "-o", controlProgram(whole)};
  command.insert(command.end(), order.linkFlags.begin(), order.linkFlags.end());
  run(command);
  fs::remove(object);
}

}  // namespace

std::vector<std::string> allowedFunctions(const std::vector<std::string>& list, const fs::path& exercise,
                                          const fs::path& groups) {
  const TomlTable table = TomlTable::read(groups, "groups of functions", "names of functions by group");
  std::vector<std::string> functions;
  for (const std::string& name : list) {
    if (name.find("::") != name.npos) {
      functions.push_back(name);
      continue;
    }
    if (!table.has(name))
      throw Error({.what = fmt::format("allows the functions '{}'", name),
                   .where = {(exercise / "exercise.toml").string()},
                   .wanted = "a function as rex::name, or a group of " + groups.filename().string(),
                   .nearest = nearestNames(name, table.keys())});
    for (const std::string& one : table.texts(name)) functions.push_back(one);
  }
  return functions;
}

void linkWorkerParts(const WorkerPartOrder& order) {
  const ExerciseInfo exercise = readExerciseInfo(order.exercise);
  const Definitions definitions = definitionsIn(order.objects);
  const auto offers = [&](const std::vector<std::string>& allowed) {
    return offered(definitions, allowedFunctions(allowed, order.exercise, order.groups), exercise);
  };
  const Names ofAll = offers(exercise.allowed);
  const fs::path whole = order.folder / "worker_part.o";
  const auto withoutOthers = [&](const std::vector<std::string>& kept, const char* instead) {
    std::string options;
    for (const std::string& function : order.functions)
      if (std::find(kept.begin(), kept.end(), function) == kept.end())
        options += fmt::format("-Wl,--defsym=rexRun_{}={}\n", function, instead);
    return options;
  };
  for (const WorkerOfPart& old : workersOfParts(whole)) fs::remove(old.options);
  for (const ExercisePart& part : exercise.parts) {
    if (part.functions.empty()) continue;
    const Names ofPart = offers(part.allowed);
    std::string missing;
    for (const std::string& name : ofAll)
      if (!ofPart.contains(name)) missing += fmt::format("-Wl,--defsym={}={}\n", name, kRefusal);
    const fs::path object = order.folder / fmt::format("worker_part.{}.o", part.id);
    link(order, object, ofPart, withoutOthers(part.functions, "rexOfAnotherPart"));
    requireNothingForbidden(object, part.id, exercise);
    writeTextFile(linkOptions(object), missing + neededBy(object, order));
  }
  link(order, whole, ofAll, "");
  requireNothingForbidden(whole, "", exercise);
  writeTextFile(linkOptions(whole), neededBy(whole, order));
  writeLines(order.folder / "worker.offers", ofAll);
  linkControl(order, withoutOthers({}, "rexOfControl"), ofAll);
}

fs::path controlProgram(const fs::path& workerPart) { return workerPart.parent_path() / "worker.control"; }

fs::path linkOptions(const fs::path& workerPart) {
  return fs::path(workerPart).replace_extension(".options");
}

std::vector<WorkerOfPart> workersOfParts(const fs::path& workerPart) {
  std::vector<WorkerOfPart> found;
  if (workerPart.empty()) return found;
  for (const auto& entry : fs::directory_iterator(workerPart.parent_path())) {
    const std::string name = entry.path().filename().string();
    constexpr std::string_view kStart = "worker_part.", kEnd = ".options";
    if (name.starts_with(kStart) && name.ends_with(kEnd) && entry.path() != linkOptions(workerPart))
      found.push_back({.id = name.substr(kStart.size(), name.size() - kStart.size() - kEnd.size()),
                       .object = fs::path(entry.path()).replace_extension(".o"),
                       .options = entry.path()});
  }
  return found;
}

std::vector<std::string> offeredSymbols(const fs::path& offers) {
  const std::string text = readTextFile(offers);
  const std::vector<std::string_view> lines = splitLines(text);
  std::vector<std::string> names(lines.begin(), lines.end());
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace rex::submission
