#include "submission/toolchain.h"

#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/own_folder.h"
#include "base/text_file.h"

namespace rex::grading {
namespace {

std::vector<std::filesystem::path> paths(const nlohmann::json& list) {
  const auto texts = list.get<std::vector<std::string>>();
  return {texts.begin(), texts.end()};
}

void replaceAll(std::string& text, std::string_view word, const std::string& by) {
  for (std::size_t at = text.find(word); at != text.npos; at = text.find(word, at + by.size()))
    text.replace(at, word.size(), by);
}

// A path as part of a text in JSON.
std::string inJson(const std::filesystem::path& path) {
  const std::string quoted = nlohmann::json(path.string()).dump();
  return quoted.substr(1, quoted.size() - 2);
}

}  // namespace

std::string installedText(std::string text) {
  if (text.find("{rex}") == text.npos) return text;
  replaceAll(text, "{include}", inJson(std::filesystem::weakly_canonical(ownFolder() / "include")));
  replaceAll(text, "{home}", inJson(homeFolder()));
  replaceAll(text, "{rex}", inJson(ownFolder()));
  return text;
}

Toolchain readToolchain(const std::filesystem::path& buildJson) {
  if (!std::filesystem::exists(buildJson))
    throw Error({.what = "the exercise is not built",
                 .where = {buildJson.string()},
                 .wanted = "this file, which building the project writes"});
  try {
    const nlohmann::json json = nlohmann::json::parse(installedText(readTextFile(buildJson)));
    return {.compiler = json.at("compiler").get<std::string>(),
            .flags = json.at("compile_flags").get<std::vector<std::string>>(),
            .linkFlags = json.at("link_flags").get<std::vector<std::string>>(),
            .workerObject = json.at("worker_object").get<std::string>(),
            .grader = json.at("grader").get<std::string>(),
            .libraries = paths(json.at("libraries")),
            .show = json.value("show", ""),
            .functions = json.at("functions").get<std::vector<std::string>>(),
            .prefix = json.value("prefix", ""),
            .workerPart = json.value("worker_part", ""),
            .offers = json.value("offers", ""),
            .objcopy = json.value("objcopy", "objcopy"),
            .objdump = json.value("objdump", "objdump")};
  } catch (const nlohmann::json::exception& error) {
    throw Error({.what = "not a build description", .where = {buildJson.string()}, .found = error.what()});
  }
}

}  // namespace rex::grading
