#include "submission/program_build.h"

#include <algorithm>
#include <array>
#include <set>
#include <system_error>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "base/error.h"
#include "base/process.h"
#include "base/text_file.h"
#include "submission/included_files.h"
#include "submission/made_from.h"

namespace rex::submission {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kBlanks = " \t\r";

// The name in `#include "name"` or `#include <name>`; empty for any other line.
std::string_view includedName(std::string_view line) {
  constexpr std::string_view kInclude = "#include";
  if (!line.starts_with(kInclude)) return {};
  line.remove_prefix(std::min(line.size(), line.find_first_not_of(kBlanks, kInclude.size())));
  if (line.empty() || (line.front() != '"' && line.front() != '<')) return {};
  const std::size_t end = line.find(line.front() == '"' ? '"' : '>', 1);
  return end == line.npos ? std::string_view{} : line.substr(1, end - 1);
}

// What may come before course.h or after it: no standard header defines or needs macros of others.
bool isStandard(std::string_view name) {
  constexpr auto kNames = std::to_array<std::string_view>({"algorithm",
                                                           "any",
                                                           "array",
                                                           "atomic",
                                                           "barrier",
                                                           "bit",
                                                           "bitset",
                                                           "cassert",
                                                           "cctype",
                                                           "cerrno",
                                                           "cfenv",
                                                           "cfloat",
                                                           "charconv",
                                                           "chrono",
                                                           "cinttypes",
                                                           "climits",
                                                           "clocale",
                                                           "cmath",
                                                           "compare",
                                                           "complex",
                                                           "concepts",
                                                           "condition_variable",
                                                           "coroutine",
                                                           "csetjmp",
                                                           "csignal",
                                                           "cstdarg",
                                                           "cstddef",
                                                           "cstdint",
                                                           "cstdio",
                                                           "cstdlib",
                                                           "cstring",
                                                           "ctime",
                                                           "cuchar",
                                                           "cwchar",
                                                           "cwctype",
                                                           "deque",
                                                           "exception",
                                                           "execution",
                                                           "filesystem",
                                                           "forward_list",
                                                           "fstream",
                                                           "functional",
                                                           "future",
                                                           "initializer_list",
                                                           "iomanip",
                                                           "ios",
                                                           "iosfwd",
                                                           "iostream",
                                                           "istream",
                                                           "iterator",
                                                           "latch",
                                                           "limits",
                                                           "list",
                                                           "locale",
                                                           "map",
                                                           "memory",
                                                           "memory_resource",
                                                           "mutex",
                                                           "new",
                                                           "numbers",
                                                           "numeric",
                                                           "optional",
                                                           "ostream",
                                                           "queue",
                                                           "random",
                                                           "ranges",
                                                           "ratio",
                                                           "regex",
                                                           "scoped_allocator",
                                                           "semaphore",
                                                           "set",
                                                           "shared_mutex",
                                                           "source_location",
                                                           "span",
                                                           "sstream",
                                                           "stack",
                                                           "stdexcept",
                                                           "stop_token",
                                                           "streambuf",
                                                           "string",
                                                           "string_view",
                                                           "syncstream",
                                                           "system_error",
                                                           "thread",
                                                           "tuple",
                                                           "type_traits",
                                                           "typeindex",
                                                           "typeinfo",
                                                           "unordered_map",
                                                           "unordered_set",
                                                           "utility",
                                                           "valarray",
                                                           "variant",
                                                           "vector",
                                                           "version"});
  return std::ranges::binary_search(kNames, name);
}

// Headers of the exercise, of the library and of Eigen: those in folders that the compiler flags name.
bool isOwn(std::string_view name, const std::vector<std::string>& flags) {
  const bool isHeader = name.ends_with(".h") || name.starts_with("Eigen/");
  if (!isHeader || name.starts_with('/') || name.find("..") != name.npos) return false;
  for (std::size_t i = 1; i < flags.size(); ++i) {
    const bool isFolder = flags[i - 1] == "-iquote" || flags[i - 1] == "-isystem";
    if (isFolder && fs::is_regular_file(fs::path(flags[i]) / name)) return true;
  }
  return false;
}

// Whether the course's header that these flags find is among the files: another rex has another one.
bool isOfThisRex(const std::vector<fs::path>& files, const std::vector<std::string>& flags) {
  constexpr const char* kHeader = "course/course.h";
  for (std::size_t i = 1; i < flags.size(); ++i) {
    const fs::path header = fs::path(flags[i]) / kHeader;
    if (flags[i - 1] != "-isystem" || !fs::exists(header)) continue;
    return std::any_of(files.begin(), files.end(), [&](const fs::path& file) {
      std::error_code missing;
      return file.string().ends_with(kHeader) && fs::equivalent(file, header, missing);
    });
  }
  return true;
}

fs::path precompiled(const fs::path& prefix) { return prefix.string() + ".gch"; }
fs::path ruleOf(const fs::path& prefix) { return prefix.string() + ".d"; }

std::vector<fs::path> prerequisites(const fs::path& prefix) {
  return dependenciesIn(readTextFile(ruleOf(prefix)), prefix.parent_path());
}

// Without a record, the build program keeps it up to date, which goes by the order of times.
bool isCurrent(const fs::path& prefix, const std::vector<std::string>& flags) {
  std::error_code missing;
  const auto made = fs::last_write_time(precompiled(prefix), missing);
  if (missing || !fs::exists(ruleOf(prefix))) return false;
  const std::vector<fs::path> files = prerequisites(prefix);
  if (files.empty() || !isOfThisRex(files, flags)) return false;
  const fs::path record = recordFile(precompiled(prefix));
  return fs::exists(record) ? haveStamps(readTextFile(record)) : !timeStamps(files, made).empty();
}

}  // namespace

bool opensWithCourseHeader(std::string_view source, const std::vector<std::string>& flags) {
  while (!source.empty()) {
    const std::size_t end = std::min(source.find('\n'), source.size());
    std::string_view line = source.substr(0, end);
    source.remove_prefix(std::min(end + 1, source.size()));
    line.remove_prefix(std::min(line.size(), line.find_first_not_of(kBlanks)));
    // A line that ends in a backslash continues on the next, and a comment may end anywhere.
    if (line.find('\\') != line.npos || line.find("/*") != line.npos) return false;
    if (line.empty() || line.starts_with("//")) continue;
    const std::string_view name = includedName(line);
    if (name == "exercise.h" || name == "course/course.h") return true;
    if (!isStandard(name) && !isOwn(name, flags)) return false;
  }
  return false;
}

std::vector<std::string> prefixFlags(const fs::path& prefix, std::string_view source,
                                     const std::vector<std::string>& flags) {
  if (prefix.empty() || !opensWithCourseHeader(source, flags)) return {};
  if (!isCurrent(prefix, flags)) return {};
  return {"-include", prefix.string()};
}

void makePrefix(const fs::path& prefix, const Toolchain& toolchain, double longest) {
  const std::string text = "#include \"course/course.h\"\n";
  if (!prefixFlags(prefix, text, toolchain.flags).empty()) return;
  std::error_code failure;
  fs::create_directories(prefix.parent_path(), failure);
  writeTextFile(prefix, text);  // which says why not
  const auto started = fs::file_time_type::clock::now();
  const fs::path made = precompiled(prefix), half = fmt::format("{}.{}.new", prefix.string(), ::getpid());
  std::vector<std::string> command = {toolchain.compiler};
  command.insert(command.end(), toolchain.flags.begin(), toolchain.flags.end());
  command.insert(command.end(),
                 {"-MD", "-MF", ruleOf(prefix), "-MQ", made, "-x", "c++-header", prefix, "-o", half});
  const ProcessResult run = runProcess(command, {.timeout = longest});
  if (!run.ok()) {
    for (const fs::path& file : {half, ruleOf(prefix)}) fs::remove(file);
    if (run.timedOut)
      throw Error({.what = fmt::format("the compiler did not read the library within {:g} s", longest),
                   .where = {toolchain.compiler},
                   .wanted = "a machine that is less busy: `rex update` tries again"});
    throw Error({.what = "the compiler cannot read the library",
                 .where = {toolchain.compiler},
                 .found = run.error.substr(0, run.error.find('\n')),
                 .wanted = "g++ in the version that rex was built with"});
  }
  fs::remove(recordFile(made));
  fs::rename(half, made);
  const std::string stamps = timeStamps(prerequisites(prefix), started);
  if (!stamps.empty()) replaceTextFile(recordFile(made), stamps, "what a header was made from");
}

namespace {

namespace fs = std::filesystem;

using Strings = std::vector<std::string>;

LibraryPart libraryIn(const nlohmann::json& json) {
  return {.target = json.at("target").get<std::string>(),
          .file = json.at("file").get<std::string>(),
          .folder = json.at("folder").get<std::string>(),
          .headers = json.at("headers").get<Strings>(),
          .symbols = json.at("symbols").get<Strings>(),
          .uses = json.at("uses").get<Strings>()};
}

bool contains(const Strings& names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}

// The library of that header, or nullptr if its folder has none.
const LibraryPart* libraryOf(const fs::path& header, const std::vector<LibraryPart>& libraries) {
  const LibraryPart* first = nullptr;
  for (const LibraryPart& one : libraries) {
    if (one.folder != header.parent_path().generic_string()) continue;
    if (contains(one.headers, header.filename().string())) return &one;
    if (first == nullptr) first = &one;
  }
  return first;
}

// Looks for a line such as "0000000000000000         *UND*	0000000000000000 rex::f(int)".
bool isUndefined(std::string_view symbol, std::string_view table) {
  while (!table.empty()) {
    const std::string_view line = table.substr(0, table.find('\n'));
    table.remove_prefix(std::min(line.size() + 1, table.size()));
    if (line.find("*UND*") != line.npos && line.find(" " + std::string(symbol) + "(") != line.npos)
      return true;
  }
  return false;
}

}  // namespace

ProgramToolchain readProgramToolchain(const fs::path& programJson) {
  if (!fs::exists(programJson))
    throw Error({.what = "the project is not built",
                 .where = {programJson.string()},
                 .wanted = "this file, which building the project writes"});
  try {
    const nlohmann::json json = nlohmann::json::parse(installedText(readTextFile(programJson)));
    ProgramToolchain program{.toolchain = {.compiler = json.at("compiler").get<std::string>(),
                                           .flags = json.at("compile_flags").get<Strings>(),
                                           .linkFlags = json.at("link_flags").get<Strings>(),
                                           .workerObject = {},
                                           .grader = {},
                                           .libraries = {},
                                           .prefix = json.at("prefix").get<std::string>()},
                             .sourceFolder = json.at("source_folder").get<std::string>()};
    for (const nlohmann::json& one : json.at("libraries")) program.libraries.push_back(libraryIn(one));
    return program;
  } catch (const nlohmann::json::exception& error) {
    throw Error({.what = "not a build description", .where = {programJson.string()}, .found = error.what()});
  }
}

std::vector<LibraryPart> librariesFor(const ProgramToolchain& program, const std::vector<fs::path>& files,
                                      std::string_view symbolTable) {
  Strings open;
  for (const fs::path& file : files)
    if (const LibraryPart* one = libraryOf(file.lexically_relative(program.sourceFolder), program.libraries))
      open.push_back(one->target);
  for (const LibraryPart& one : program.libraries)
    if (std::ranges::any_of(one.symbols, [&](const auto& name) { return isUndefined(name, symbolTable); }))
      open.push_back(one.target);
  std::set<std::string> needed;
  while (!open.empty()) {
    const std::string target = std::move(open.back());
    open.pop_back();
    if (!needed.insert(target).second) continue;
    for (const LibraryPart& one : program.libraries)
      if (one.target == target) open.insert(open.end(), one.uses.begin(), one.uses.end());
  }
  std::vector<LibraryPart> found;
  for (const LibraryPart& one : program.libraries)
    if (needed.contains(one.target)) found.push_back(one);
  return found;
}

}  // namespace rex::submission
