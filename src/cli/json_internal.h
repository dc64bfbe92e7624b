#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include "base/escape.h"

namespace rex::cli {

/// Keys stay in the order in which they were put.
using Json = nlohmann::ordered_json;

/// The numbers. What is not finite is printed as null.
inline Json toJson(const Eigen::Ref<const Eigen::VectorXd>& values) {
  return std::vector<double>(values.begin(), values.end());
}

/// Row by row.
inline Json jsonOfRows(const Eigen::Ref<const Eigen::MatrixXd>& matrix) {
  Json rows = Json::array();
  for (const auto& row : matrix.rowwise()) rows.push_back(toJson(row.transpose()));
  return rows;
}

/// As text on one line; bytes that are no UTF-8 are replaced, what has no look of its own is \uXXXX.
inline std::string dump(const Json& json) {
  return visibleJson(json.dump(-1, ' ', false, Json::error_handler_t::replace));
}

}  // namespace rex::cli
