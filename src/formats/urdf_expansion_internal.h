#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "base/error.h"
#include "geometry/pose.h"
#include "scene/scene_spec.h"

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

/// What a format cannot say, one note for each kind.
class Losses {
 public:
  void add(const std::string& kind, const std::string& name, const SourceLocation& where);
  [[nodiscard]] Diagnostics take() const;

 private:
  struct Loss {
    std::string kind, first;
    SourceLocation where;
    int count = 0;
  };
  std::vector<Loss> losses_;
};

/// The same scene with joints as URDF has them: hinges, sliders, rigid, free, and planar ones whose `axis` is
/// the normal; all with X_MC = 1. Other joints become chains over massless bodies. Without a single root at
/// the identity, or with shapes of the world, all roots hang on joints of the parent "world". Massless links
/// fill up chains, so that the first coordinates of joints keep compile()'s order.
[[nodiscard]] SceneSpec expand(const SceneSpec& spec, Losses& losses);

}  // namespace rex::urdf
