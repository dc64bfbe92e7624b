#pragma once

#include <string_view>

#include <Eigen/Core>

namespace rex {

/// Vectors and matrices as arguments: passed without a copy, including columns and blocks.
using VectorArg = Eigen::Ref<const Eigen::VectorXd>;
using MatrixArg = Eigen::Ref<const Eigen::MatrixXd>;

/// A unit as messages write it: "-1 m", "a positive, finite number of metres".
struct Unit {
  std::string_view symbol{}, name{};
};

inline constexpr Unit kNoUnit{};
inline constexpr Unit kMetres{"m", "metres"};
inline constexpr Unit kRadians{"rad", "radians"};
inline constexpr Unit kSeconds{"s", "seconds"};

/// Throws Error "what: found -1 m, wanted a positive, finite number of metres" unless it is one.
void requirePositive(std::string_view what, double number, const Unit& unit = kNoUnit);

/// The same, but infinity is fine: "what: found -1 m, wanted a positive number of metres, or infinity".
void requirePositiveOrInfinite(std::string_view what, double number, const Unit& unit = kNoUnit);

/// Throws Error "what: found -1 m, wanted a finite number of metres, 0 or more" unless it is one.
void requireNotNegative(std::string_view what, double number, const Unit& unit = kNoUnit);

/// The same for all numbers of a vector, saying which: "what: number 3: found -1, wanted ...".
void requireNotNegative(std::string_view what, const Eigen::Ref<const Eigen::VectorXd>& numbers);

/// The same for one number, but infinity is fine: "wanted a number of metres, 0 or more, or infinity".
void requireNotNegativeOrInfinite(std::string_view what, double number, const Unit& unit = kNoUnit);

/// Throws Error "what: found inf m, wanted a finite number of metres" unless it is one.
void requireFinite(std::string_view what, double number, const Unit& unit = kNoUnit);

/// The same for all numbers of a vector, saying which: "what: number 3: found nan, wanted a finite number".
void requireFinite(std::string_view what, const Eigen::Ref<const Eigen::VectorXd>& numbers);

/// Throws Error "what: found 0, wanted at least 1", or "wanted 0 or more", for a count less than `least`.
void requireCount(std::string_view what, long long count, long long least);

}  // namespace rex
