// share/grading/result.schema.json and the writer of result files must agree, field by field.
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "grading/results.h"
#include "support/paths.h"

namespace rex::grading::result_schema_test {

using Json = nlohmann::json;

bool hasType(const Json& value, const std::string& type) {
  if (type == "object") return value.is_object();
  if (type == "array") return value.is_array();
  if (type == "string") return value.is_string();
  if (type == "integer") return value.is_number_integer();
  if (type == "boolean") return value.is_boolean();
  ADD_FAILURE() << "the schema uses the unknown type " << type;
  return false;
}

/// The first place where a value breaks a schema made of the keywords that ours uses; empty if none.
std::string violation(const Json& value, const Json& schema, const std::string& path) {
  if (schema.contains("type") && !hasType(value, schema.at("type"))) return path + ": type";
  if (schema.contains("enum")) {
    const Json& allowed = schema.at("enum");
    if (std::find(allowed.begin(), allowed.end(), value) == allowed.end()) return path + ": enum";
  }
  for (const auto& name : schema.value("required", Json::array())) {
    if (!value.contains(name.get<std::string>())) return path + ": lacks " + name.get<std::string>();
  }
  if (value.is_object()) {
    for (const auto& [name, field] : value.items()) {
      const Json& fields = schema.at("properties");
      if (!fields.contains(name)) return path + ": extra " + name;
      if (const std::string inside = violation(field, fields.at(name), path + "/" + name); !inside.empty())
        return inside;
    }
  }
  if (value.is_array()) {
    for (const Json& element : value) {
      if (const std::string inside = violation(element, schema.at("items"), path + "/0"); !inside.empty())
        return inside;
    }
  }
  return "";
}

Json schema() {
  std::ifstream file(sourcePath("share/grading/result.schema.json"));
  return Json::parse(file);
}

GradeResult fullResult() {
  GradeResult result;
  result.files = {{"main.cpp", "ab12"}};
  result.sandboxWarnings = {"careful"};
  result.checks = {{.id = "x"}};
  result.compile.diagnostics = {{.file = "main.cpp"}};
  return result;
}

TEST(ResultSchema, FitsWhatIsWritten) {
  GradeResult result = fullResult();
  for (int k = 0; k <= static_cast<int>(Outcome::kGraderError); ++k) {
    result.outcome = static_cast<Outcome>(k);
    result.checks[0].status = result.outcome;
    EXPECT_EQ(violation(Json::parse(toJson(result)), schema(), ""), "");
  }
  result.checks[0].status.reset();
  EXPECT_EQ(violation(Json::parse(toJson(result)), schema(), ""), "");
}

TEST(ResultSchema, AllowsTheHashesOfItsInputs) {
  Json result = Json::parse(toJson(fullResult()));
  result["inputs"] = {{"sha256", "a"},        {"source_sha256", "b"}, {"grader_sha256", "c"},
                      {"result_sha256", "d"}, {"level", 2},           {"seed", 7},
                      {"secret_id", ""},      {"alone", true}};
  EXPECT_EQ(violation(result, schema(), ""), "");
  result["inputs"].erase("sha256");
  EXPECT_EQ(violation(result, schema(), ""), "/inputs: lacks sha256");
}

// Removing any field, or giving it another type, breaks the schema: it says nothing too little.
TEST(ResultSchema, WantsEveryField) {
  const Json whole = Json::parse(toJson(fullResult()));
  const Json flat = whole.flatten();
  int fields = 0;
  for (const auto& [pointer, value] : flat.items()) {
    Json changed = whole;
    changed[Json::json_pointer(pointer)] = 1.5;
    EXPECT_NE(violation(changed, schema(), ""), "") << pointer;
    const Json::json_pointer place(pointer);
    if (!whole.at(place.parent_pointer()).is_object()) continue;
    changed = whole;
    changed.at(place.parent_pointer()).erase(place.back());
    EXPECT_NE(violation(changed, schema(), ""), "") << pointer;
    ++fields;
  }
  EXPECT_GT(fields, 40);
  Json extra = whole;
  extra["checks"][0]["verdict"] = "pass";
  EXPECT_EQ(violation(extra, schema(), ""), "/checks/0: extra verdict");
}

}  // namespace rex::grading::result_schema_test
