#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace rex::authoring {

/// A parameter as exercise.h writes it: {"const Eigen::Vector2d&", "p"}.
struct ContractParameter {
  std::string type{}, name{};
};

/// A function that students complete.
struct ContractFunction {
  std::string name{};
  std::string result{};  ///< the type of its value
  std::vector<ContractParameter> parameters{};
  std::string comment{};  ///< the lines with /// above it, in one line
  int part = 0;           ///< index in Contract::parts
};

/// What an exercise.h declares:
///   // Part 1, rotation in the plane.
///   /// The point p [m] turned by `angle` [rad].
///   Eigen::Vector2d rotated(const Eigen::Vector2d& p, double angle);
struct Contract {
  std::vector<std::string> parts{};  ///< their titles; without headings, each function is a part
  std::vector<ContractFunction> functions{};
};

/// Reads an exercise.h. Types and inline functions in it are given to students and not part of the result.
/// Throws Error (file:line:column) for what it cannot read, saying what it would read instead: anything else
/// at file scope, a function without a comment, an unnamed parameter, a type that cannot cross to the worker,
/// a second function of that name, parts out of order, and a header without functions or course/course.h.
[[nodiscard]] Contract readContract(std::string_view header, const std::string& file);

/// A name in lower case with dashes for ids ("hand-pose"), or with blanks for titles ("hand pose"), of
/// `handPose`.
[[nodiscard]] std::string splitName(std::string_view name, char between);

}  // namespace rex::authoring
