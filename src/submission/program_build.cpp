#include "submission/program_build.h"

#include <algorithm>
#include <set>

#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/text_file.h"

namespace rex::grading {
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

}  // namespace rex::grading
