#include "grading/result_file.h"

#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/text_file.h"
#include "grading/results_internal.h"

namespace rex::grading {
namespace {

using Json = nlohmann::ordered_json;

// The table of that name; empty if there is none.
const Json& tableIn(const Json& json, const char* name) {
  static const Json kNone = Json::object();
  const bool isThere = json.is_object() && json.contains(name) && json[name].is_object();
  return isThere ? json[name] : kNone;
}

std::optional<GradedWith> gradedWith(const Json& inputs) {
  try {
    GradedWith with{.level = sandbox::parseLevel(inputs.at("level").get<int>()),
                    .secretId = inputs.at("secret_id").get<std::string>(),
                    .alone = inputs.value("alone", false)};
    if (inputs.contains("seed")) with.seed = inputs["seed"].get<std::uint64_t>();
    return with;
  } catch (const Json::exception&) {
    return {};
  } catch (const Error&) {
    return {};  // no such level
  }
}

ResultInputs inputsOf(const Json& json) {
  const Json &inputs = tableIn(json, "inputs"), &kept = tableIn(json, "volatile");
  const auto textOf = [&](const char* key) {
    return inputs.contains(key) && inputs[key].is_string() ? inputs[key].get<std::string>() : std::string();
  };
  return {.sha256 = textOf("sha256"),
          .sourceSha256 = textOf("source_sha256"),
          .seal = textOf("result_sha256"),
          .hmac = textOf("result_hmac"),
          .with = gradedWith(inputs),
          .evidence = kept.contains("evidence") && kept["evidence"] == true};
}

}  // namespace

std::optional<ResultFile> readResultFile(const std::filesystem::path& file) {
  if (!std::filesystem::exists(file)) return {};
  const Json json = Json::parse(readTextFile(file), nullptr, false);
  ResultFile read{.inputs = inputsOf(json)};
  try {
    read.result = resultFromParsed(json, file.string());
    requireSound(*read.result, json, file);
  } catch (const Error& error) {
    read.fault = error.what();
  }
  return read;
}

}  // namespace rex::grading
