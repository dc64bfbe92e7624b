#pragma once

#include <type_traits>

#include <Eigen/Core>

// What the compiler says of a variable declared with `auto` that holds an expression of Eigen instead of a
// matrix. submission/source_remarks.h puts the questions into a student's file; nobody else includes this.
namespace rex::guard {

template <class T>
inline constexpr bool isConstant = false;
template <class Op, class Plain>
inline constexpr bool isConstant<Eigen::CwiseNullaryOp<Op, Plain>> = true;

/// Expressions that compute something from other matrices: sums, products, negations. Blocks and other views
/// can be assigned to, and constants refer to nothing.
template <class T>
inline constexpr bool isComputed = [] {
  if constexpr (std::is_base_of_v<Eigen::DenseBase<T>, T>)
    return !std::is_base_of_v<Eigen::PlainObjectBase<T>, T> && (T::Flags & Eigen::DirectAccessBit) == 0 &&
           !isConstant<T>;
  return false;
}();

template <class T>
char autoHolds(const T&);
template <class T>
requires isComputed<T>
[[deprecated]] char autoHolds(const T&);

/// The same where the variable begins as a view of what a function returned.
template <class T>
char autoViews(const T&);
template <class T>
requires(std::is_base_of_v<Eigen::DenseBase<T>, T> && !std::is_base_of_v<Eigen::PlainObjectBase<T>, T>)
    [[deprecated]] char autoViews(const T&);

}  // namespace rex::guard
