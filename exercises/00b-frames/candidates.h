#pragma once

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "rotation_checks.h"

// Functions that students test in part 6: right ones, each computed in another manner, and mistakes.

struct Candidate {
  std::string what;      ///< as a report names it
  std::string question;  ///< for a student whose test judges it wrongly
  RotationFunction function;
};

inline Eigen::Matrix3d byQuaternion(const Eigen::Vector3d& w, double angle) {
  Eigen::Vector4d q;
  q << std::cos(angle / 2), std::sin(angle / 2) * w;
  return rex::rotationFromQuaternion(q);
}

inline Eigen::Matrix3d byTwoMirrors(const Eigen::Vector3d& w, double angle) {
  const Eigen::Vector3d a = w.unitOrthogonal(),
                        b = std::cos(angle / 2) * a + std::sin(angle / 2) * w.cross(a);
  const auto mirror = [](const Eigen::Vector3d& n) -> Eigen::Matrix3d {
    return Eigen::Matrix3d::Identity() - 2 * n * n.transpose();
  };
  return mirror(b) * mirror(a);
}

inline Eigen::Matrix3d bySeries(const Eigen::Vector3d& w, double angle) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Identity(), term = sum;
  for (int k = 1; k < 40; ++k) sum += term = term * rex::skew(angle * w) / k;
  return sum;
}

inline std::vector<Candidate> rightRotations() {
  const std::string question =
      "Is a result compared exactly, or does your test have a wrong sign? Right functions differ by "
      "rounding, "
      "up to 1e-12.";
  return {{"by the library", question, turn},
          {"by a quaternion", question, byQuaternion},
          {"by two mirrors", question, byTwoMirrors},
          {"by a power series", question, bySeries}};
}

inline std::vector<Candidate> mistakenRotations() {
  using Eigen::Matrix3d;
  using Eigen::Vector3d;
  const Matrix3d I = Matrix3d::Identity();
  const auto square = [](const Vector3d& w) -> Matrix3d { return w * w.transpose(); };
  return {
      {"it turns to the other side", "Which way does a vector across the axis turn?",
       [](const Vector3d& w, double a) { return turn(w, -a); }},
      {"it takes the angle for one in degrees", "Is the size of the angle tested?",
       [](const Vector3d& w, double a) { return turn(w, a * kPi / 180); }},
      {"it turns by half of the angle", "Is the size of the angle tested?",
       [](const Vector3d& w, double a) { return turn(w, a / 2); }},
      {"it always turns about z", "Is more than one axis tested?",
       [](const Vector3d&, double a) { return turn(Vector3d::UnitZ(), a); }},
      {"it drops the signs of the axis", "Does an axis of your test have entries of both signs?",
       [](const Vector3d& w, double a) { return turn(w.cwiseAbs(), a); }},
      {"it drops the sign of the angle", "Are negative angles tested?",
       [](const Vector3d& w, double a) { return turn(w, std::abs(a)); }},
      {"it leaves out the factor of w w^T", "What happens to a vector along the axis?",
       [=](const Vector3d& w, double a) -> Matrix3d {
         return std::cos(a) * I + std::sin(a) * rex::skew(w) + square(w);
       }},
      {"it leaves out w w^T", "What happens to a vector along the axis?",
       [=](const Vector3d& w, double a) -> Matrix3d { return std::cos(a) * I + std::sin(a) * rex::skew(w); }},
      {"it is that of a small angle", "Are large angles tested?",
       [=](const Vector3d& w, double a) -> Matrix3d { return I + a * rex::skew(w); }},
      {"its cosine is the root of 1 - sin^2, which is never negative",
       "Are angles beyond a quarter turn tested?",
       [=](const Vector3d& w, double a) -> Matrix3d {
         const double s = std::sin(a), c = std::sqrt(1 - s * s);
         return c * I + s * rex::skew(w) + (1 - c) * square(w);
       }},
      {"it does not turn by angles below 0.001", "Are tiny angles tested?",
       [](const Vector3d& w, double a) { return turn(w, std::abs(a) < 1e-3 ? 0 : a); }},
      {"its axis is angle times axis, normalised: 0 / 0 without a rotation", "Is the angle 0 tested?",
       [](const Vector3d& w, double a) { return turn(a * w / std::abs(a), std::abs(a)); }},
      {"it mirrors one direction", "Are three independent vectors tested?",
       [=](const Vector3d& w, double a) -> Matrix3d {
         const Vector3d n = turn(w, a) * w.unitOrthogonal();
         return (I - 2 * n * n.transpose()) * turn(w, a);
       }},
      {"it computes in single precision", "How many digits does your test compare?",
       [](const Vector3d& w, double a) -> Matrix3d { return turn(w, a).cast<float>().cast<double>(); }},
      {"its quaternion is not of unit length", "Is the length of a turned vector tested?",
       [](const Vector3d& w, double a) -> Matrix3d { return 1.0001 * turn(w, a); }}};
}

/// The numbers from 0 to count - 1 in random order.
inline std::vector<std::size_t> shuffled(std::size_t count, rex::Rng& rng) {
  std::vector<std::size_t> order(count);
  for (std::size_t k = 0; k < count; ++k) {
    order[k] = k;
    std::swap(order[k], order[static_cast<std::size_t>(rng.index(static_cast<int>(k) + 1))]);
  }
  return order;
}
