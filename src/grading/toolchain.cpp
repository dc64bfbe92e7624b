#include "grading/toolchain.h"

#include <fstream>

#include <nlohmann/json.hpp>

#include "base/error.h"

namespace rex::grading {

Toolchain readToolchain(const std::filesystem::path& buildJson) {
  std::ifstream file(buildJson);
  if (!file)
    throw Error({.what = "the exercise is not built",
                 .where = {buildJson.string()},
                 .wanted = "this file, which building the project writes"});
  try {
    const nlohmann::json json = nlohmann::json::parse(file);
    return {.compiler = json.at("compiler").get<std::string>(),
            .flags = json.at("compile_flags").get<std::vector<std::string>>(),
            .linkFlags = json.at("link_flags").get<std::vector<std::string>>(),
            .workerObject = json.at("worker_object").get<std::string>(),
            .grader = json.at("grader").get<std::string>(),
            .studentLibrary = json.at("student_library").get<std::string>(),
            .objcopy = json.value("objcopy", "objcopy"),
            .objdump = json.value("objdump", "objdump")};
  } catch (const nlohmann::json::exception& error) {
    throw Error({.what = "not a build description", .where = {buildJson.string()}, .found = error.what()});
  }
}

}  // namespace rex::grading
