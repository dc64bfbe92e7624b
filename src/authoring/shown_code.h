#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace rex::authoring {

/// A parameter of a function, or a variable of an expression. Types are compared by fits().
struct ShownParameter {
  std::string type{};
  std::string name{};
  bool isOptional = false;  ///< it has a default
  bool isMutable = false;   ///< a reference to what the function may change
};

/// A function of C++ source, or an expression in it that takes more than one line.
struct ShownCode {
  std::string name{};    ///< of the function; empty: an expression
  std::string result{};  ///< its type; empty: unknown, as `auto`
  std::vector<ShownParameter> parameters{};
  std::string text{};     ///< the whole function, or the expression
  std::string lambda{};   ///< the function as a lambda
  bool isLambda = false;  ///< it is one
  std::size_t start = 0;  ///< of the text in the source
  std::size_t body = 0;   ///< of the function's brace in the source
};

/// The plain functions of a source, at file scope or in any namespace, also inline ones, and lambdas that
/// have a name and capture nothing; no templates and members. Text that is not C++ gives meaningless ones.
[[nodiscard]] std::vector<ShownCode> functionsIn(std::string_view source);

/// The expressions of more than one line that functions of the source return or that initialise a variable,
/// if the types of their variables are known. Names that no function declares count as known to all.
[[nodiscard]] std::vector<ShownCode> longExpressionsIn(std::string_view source);

/// Source without the functions that `wanted`, the rest of it and these functions do not name, and without
/// its includes and namespaces, unnamed ones excepted.
[[nodiscard]] std::string neededPart(std::string_view source, const std::vector<ShownCode>& wanted);

/// Whether a value of the first type can stand for one of the second: the same type but for const and
/// references, both numbers, or both vectors or both matrices whose sizes may agree.
[[nodiscard]] bool fits(std::string_view type, std::string_view wanted);

}  // namespace rex::authoring
