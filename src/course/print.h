#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "render/figure.h"
#include "render/figure_builders.h"

namespace rex {

/// Prints a number, text, vector or matrix to standard output under its name, at once: "J (3 x 7)", then its
/// rows with six digits, as many columns at a time as the terminal has room for. Each of several vectors is a
/// row.
void print(const std::string& name, double value);
void print(const std::string& name, const Eigen::MatrixXd& value);
void print(const std::string& name, const std::vector<double>& values);
void print(const std::string& name, const std::vector<int>& values);
void print(const std::string& name, const std::vector<Eigen::VectorXd>& values);
void print(const std::string& name, const std::string& text);
template <class Numbers>
void print(const std::string& name, const Eigen::MatrixBase<Numbers>& value) {
  print(name, Eigen::MatrixXd(value.template cast<double>()));
}

/// The text that print() writes for lines of `width` characters.
[[nodiscard]] std::string formatMatrix(const std::string& name, const Eigen::MatrixXd& value, int width = 80);

/// Prints that there is nothing to show yet for `what`.
void nothingYet(const std::string& what);

/// Draws a figure into NAME.png and NAME.svg. What cannot be drawn, such as numbers that are not finite, is
/// reported on standard error. Throws as writeFigure (render/figure.h) if that is not due to the figure.
void plot(const std::string& name, const Figure& figure);

}  // namespace rex
