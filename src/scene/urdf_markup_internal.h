#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "geometry/pose.h"

namespace rex::urdf {

/// The shortest text that reads back as the same number.
[[nodiscard]] std::string numeral(double number);
[[nodiscard]] std::string numeral(const Eigen::VectorXd& numbers);

/// XML as it is written: tags in order, indented by their depth. Attributes without a value are left out.
class Markup {
 public:
  using Attributes = std::vector<std::pair<const char*, std::string>>;

  void open(const char* tag, const Attributes& attributes = {}) { line(tag, attributes, ">"), ++depth_; }
  void close(const char* tag);
  void empty(const char* tag, const Attributes& attributes) { line(tag, attributes, "/>"); }
  /// <origin>, unless it is the identity.
  void origin(const Pose& X);

  std::string text = "<?xml version=\"1.0\"?>\n";

 private:
  void line(const char* tag, const Attributes& attributes, const char* end);
  std::size_t depth_ = 0;
};

}  // namespace rex::urdf
