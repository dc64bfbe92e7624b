#pragma once

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "grading/evidence.h"
#include "interface.h"
#include "random_chains.h"

// The checks of parts 1 and 2. Wanted values are those of the library; each mistake beside them is one that
// students make.

using Mistakes = std::vector<rex::grading::Mistake>;
constexpr double kPi = std::numbers::pi;

/// Frames or axes as arrows: the columns of what was returned, with those that were wanted.
inline rex::grading::Evidence arrowsOf(const Eigen::Matrix3d& got, const Eigen::Matrix3d& wanted,
                                       const Eigen::Vector3d& at = Eigen::Vector3d::Zero(),
                                       const Eigen::Vector3d& wantedAt = Eigen::Vector3d::Zero()) {
  const auto film = [](const Eigen::Matrix3d& A, const Eigen::Vector3d& p) {
    rex::Film both(2);
    for (int k = 0; k < 2; ++k) {
      rex::Picture& picture = both[static_cast<std::size_t>(k)].picture;
      both[static_cast<std::size_t>(k)].time = k;
      picture.ground.visible = false;
      for (int i = 0; i < 3; ++i) {
        rex::Color color{0.1f, 0.1f, 0.1f};
        (i == 0 ? color.r : i == 1 ? color.g : color.b) = 0.75f;
        picture.arrows.push_back({p, p + A.col(i), color, 0.03});
      }
    }
    return both;
  };
  return {.film = rex::grading::withWanted(film(got, at), film(wanted, wantedAt)), .moment = 1};
}

inline Eigen::Matrix3d turn(const Eigen::Vector3d& axis, double angle) { return rex::expSO3(angle * axis); }

inline void rotatesAbout(rex::grading::Check& check, Student& student, const Eigen::Vector3d& axis,
                         double angle) {
  check.input("a rotation", {{"axis", axis}, {"angle", angle}});
  const Eigen::Matrix3d R = turn(axis, angle), I = Eigen::Matrix3d::Identity(), W = rex::skew(axis),
                        square = axis * axis.transpose(), got = student.rotationMatrix(axis, angle);
  const double s = std::sin(angle), c = std::cos(angle);
  const auto shown = check.show([&] { return arrowsOf(got, R); });
  check.near("R of rotationMatrix", got, R, 1e-12,
             {{"Is the factor of w w^T left out? It is 1 - cos.", c * I + s * W + square},
              {"Is the angle taken for one in degrees?", turn(axis, angle * kPi / 180)},
              {"Is it the rotation of a small angle only?", I + angle * W}});
}

inline void findsAxis(rex::grading::Check& check, Student& student, const Eigen::Vector3d& axis, double angle,
                      double tolerance) {
  const Eigen::Matrix3d R = turn(axis, angle);
  check.input("a rotation by " + std::to_string(angle), {{"R", R}});
  Eigen::Vector3d got = student.rotationVector(R);
  if (angle > kPi - 1e-7 && got.dot(axis) < 0) got = -got;  // both are right
  const Eigen::Vector3d w = angle * axis, plain = std::sin(angle) * axis;
  const auto asked = check.ask(
      angle < 1e-3 ? "Is the angle nearly 0 here? Half of R - R^T is then the rotation vector, nearly."
                   : "Is the angle nearly pi here? What is left of R - R^T, and what of R + R^T?",
      angle < 1e-3 || angle > kPi - 1e-3);
  check.near("w of rotationVector", got, w, tolerance,
             {{"Is it the entries of R - R^T alone, which are the axis times 2 sin(angle)?", 2 * plain},
              {"Is the axis multiplied by the sine of the angle? It has to be the angle.", plain},
              {"Is the axis not divided by the sine of the angle?", angle * plain},
              {"Is it the axis times half of the angle?", angle / 2 * axis}});
}

inline Eigen::Vector4d randomQuaternion(rex::Rng& rng) { return rng.normalVector(4).normalized(); }
inline Eigen::Vector4d conjugate(const Eigen::Vector4d& a) { return {a[0], -a[1], -a[2], -a[3]}; }

/// q and -q are the same orientation: the answer and the mistakes get the sign that fits `wanted`.
inline void nearUpToSign(rex::grading::Check& check, const std::string& property, Eigen::Vector4d got,
                         const Eigen::Vector4d& wanted, double tolerance, Mistakes mistakes) {
  if (got.dot(wanted) < 0) got = -got;
  for (rex::grading::Mistake& mistake : mistakes)
    if (mistake.value.col(0).dot(wanted) < 0) mistake.value *= -1;
  check.near(property + ", with the sign that fits", got, wanted, tolerance, mistakes);
}

inline void composes(rex::grading::Check& check, Student& student, const Eigen::Vector4d& a,
                     const Eigen::Vector4d& b) {
  check.input("two quaternions", {{"a", a}, {"b", b}});
  const Eigen::Vector4d wanted = rex::quaternionProduct(a, b);
  const Eigen::Vector3d v = b.tail<3>(), u = a.tail<3>();
  Eigen::Vector4d plain = wanted, added = wanted;
  plain.tail<3>() -= u.cross(v);
  added[0] = a[0] * b[0] + u.dot(v);
  nearUpToSign(check, "quaternion of composed", student.composed(a, b), wanted, 1e-12,
               {{"Is the cross product left out?", plain},
                {"Does the scalar product of the vector parts have the wrong sign?", added},
                {"Are the quaternions added?", a + b},
                {"Is b conjugated?", rex::quaternionProduct(a, conjugate(b))},
                {"Is a conjugated?", rex::quaternionProduct(conjugate(a), b)}});
}

/// Of two orientations that are `arc` apart, as unit vectors in four dimensions; b is negated if `flips`.
inline void turnsSmoothly(rex::grading::Check& check, Student& student, double arc, bool flips) {
  const Eigen::Vector4d a = randomQuaternion(check.rng()), any = randomQuaternion(check.rng());
  const Eigen::Vector4d across = (any - a.dot(any) * a).normalized();
  const Eigen::Vector4d b = std::cos(arc) * a + std::sin(arc) * across;
  const auto at = [&](double angle) -> Eigen::Vector4d {
    return std::cos(angle) * a + std::sin(angle) * across;
  };
  for (const double share : {0.25, 0., 0.6, 1.}) {
    const Eigen::Vector4d end = flips ? Eigen::Vector4d(-b) : b, wanted = at(share * arc);
    check.input(arc < 1e-9 ? "twice the same orientation" : "two orientations",
                {{"a", a}, {"b", end}, {"share", share}});
    const Eigen::Vector4d got = student.between(a, end, share);
    const auto shown = check.show(
        [&] { return arrowsOf(rex::rotationFromQuaternion(got), rex::rotationFromQuaternion(wanted)); });
    const auto same =
        check.ask("Are a and b the same orientation here? Do not divide by the sine of the arc.", arc < 1e-6);
    const Eigen::Vector4d mixed = (1 - share) * a + share * b;
    nearUpToSign(check, "quaternion of between", got, wanted, 1e-9,
                 {{"Is it linear interpolation? The result has to have length one.", mixed},
                  {"Is it the way from b to a?", at((1 - share) * arc)},
                  {"Is the angle of rotation taken for the arc? It is twice as large.",
                   std::sin((1 - share) * 2 * arc) / std::sin(2 * arc) * a +
                       std::sin(share * 2 * arc) / std::sin(2 * arc) * b},
                  {"Is the division by the sine of the arc left out?",
                   std::sin((1 - share) * arc) * a + std::sin(share * arc) * b}});
  }
}

// Part 2.

inline Eigen::Matrix3d product(const char* axes, const Eigen::Vector3d& angles) {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  for (int k = 0; k < 3; ++k) R *= turn(Eigen::Vector3d::Unit(axes[k] - '1'), angles[k]);
  return R;
}

inline Eigen::Matrix3d trueEuler(Convention convention, const Eigen::Vector3d& angles) {
  return product(convention == Convention::k313 ? "313" : "321", angles);
}

inline void describe(rex::grading::Check& check, Convention convention, const Eigen::Vector3d& angles) {
  check.input(convention == Convention::k313 ? "k313" : "kYawPitchRoll", {{"angles", angles}});
}

/// Angles within the ranges of the contract; the second is `away` from where it locks.
inline Eigen::Vector3d anglesNear(rex::Rng& rng, Convention convention, double away) {
  const double side = rng.index(2) == 0 ? 1 : -1;
  const double second =
      convention == Convention::k313 ? (side > 0 ? away : kPi - away) : side * (kPi / 2 - away);
  return {rng.uniform(-3, 3), second, rng.uniform(-3, 3)};
}

inline void turnsByEuler(rex::grading::Check& check, Student& student, Convention convention,
                         const Eigen::Vector3d& angles) {
  describe(check, convention, angles);
  const Eigen::Matrix3d R = trueEuler(convention, angles), got = student.eulerMatrix(convention, angles);
  const auto only = [&](double a, double b, double c) { return trueEuler(convention, {a, b, c}); };
  const auto shown = check.show([&] { return arrowsOf(got, R); });
  check.near("R of eulerMatrix", got, R, 1e-12,
             {{"Is it the transpose? R takes coordinates of the frame to those of the world.",
               Eigen::Matrix3d(R.transpose())},
              {"Does the second rotation have the wrong sense?", only(angles[0], -angles[1], angles[2])},
              {"Is the third rotation left out?", only(angles[0], angles[1], 0)}});
}

inline void findsEuler(rex::grading::Check& check, Student& student, Convention convention,
                       const Eigen::Vector3d& angles) {
  const bool is313 = convention == Convention::k313;
  const Eigen::Matrix3d R = trueEuler(convention, angles);
  check.input(is313 ? "k313" : "kYawPitchRoll", {{"R", R}});
  const Eigen::Vector3d got = student.eulerAngles(convention, R);
  Eigen::Vector3d other(rex::wrapAngle(angles[0] + kPi), is313 ? -angles[1] : kPi - angles[1],
                        rex::wrapAngle(angles[2] + kPi));
  const Eigen::Vector3d back = is313 ? Eigen::Vector3d(kPi - angles[2], angles[1], kPi - angles[0])
                                     : rex::rollPitchYawFromRotation(R.transpose()).reverse();
  const auto wrapped = [](const Eigen::Vector3d& a) {
    return Eigen::Vector3d(rex::wrapAngle(a[0]), a[1], rex::wrapAngle(a[2]));
  };
  check.near(
      "angles of eulerAngles", got, angles, 1e-9,
      {{"Is the second angle outside its range? The same rotation has other angles as well.", other},
       {"Is it the transpose whose angles these are?", wrapped(back)},
       {"Are the two arguments of each atan2 exchanged?",
        wrapped({kPi / 2 - angles[0], angles[1], kPi / 2 - angles[2]})},
       {"Does the second argument of the third atan2 have the wrong sign?",
        wrapped({angles[0], angles[1], kPi - angles[2]})},
       {"Does the second angle have the wrong sign?", Eigen::Vector3d(angles[0], -angles[1], angles[2])},
       {"Is the third angle left at 0 everywhere? It is 0 only where the convention locks.",
        Eigen::Vector3d(angles[0], angles[1], 0)}});
}

/// Where the convention locks, any first and third angle with the same sum or difference turn alike. If
/// `isRounded`, the sine or cosine of the second is the least number above 1 in size.
inline void findsLocked(rex::grading::Check& check, Student& student, Convention convention, bool isRounded) {
  const Eigen::Vector3d angles = anglesNear(check.rng(), convention, 0);
  Eigen::Matrix3d R = trueEuler(convention, angles);
  double& entry = R(2, convention == Convention::k313 ? 2 : 0);
  if (isRounded) entry = std::copysign(1 + std::numeric_limits<double>::epsilon(), entry);
  check.input(convention == Convention::k313 ? "k313, locked" : "kYawPitchRoll, locked", {{"R", R}});
  const Eigen::Vector3d got = student.eulerAngles.asItIs()(convention, R);
  const auto finite =
      check.ask("Is asin or acos used? An entry of R may be 1 + 2e-16 by rounding.", !got.allFinite());
  check.shape("angles of eulerAngles where it locks", got, 3, 1);
  check.near("third angle of eulerAngles where it locks", got[2], 0, 1e-9, "rad");
  check.near("second angle of eulerAngles where it locks", got[1], angles[1], 1e-7,
             {{"Is it the other of the two angles where the convention locks?",
               convention == Convention::k313 ? kPi - angles[1] : -angles[1]}},
             "rad");
  const auto first =
      check.ask("Is the first angle computed from entries that vanish here? Which ones are left?");
  check.near("rotation by the angles of eulerAngles where it locks", trueEuler(convention, got), R, 1e-7);
}

inline Eigen::Matrix3d trueAxes(Convention convention, const Eigen::Vector3d& angles) {
  const bool is313 = convention == Convention::k313;
  Eigen::Matrix3d three;
  three << Eigen::Vector3d::UnitZ(), turn(Eigen::Vector3d::UnitZ(), angles[0]).col(is313 ? 0 : 1),
      trueEuler(convention, angles).col(is313 ? 2 : 0);
  return three;
}

inline void findsAxes(rex::grading::Check& check, Student& student, Convention convention,
                      const Eigen::Vector3d& angles) {
  describe(check, convention, angles);
  const bool is313 = convention == Convention::k313;
  const Eigen::Matrix3d A = trueAxes(convention, angles), R = trueEuler(convention, angles),
                        got = student.turningAxes(convention, angles);
  Eigen::Matrix3d unmoved, turned, crossed = A;
  unmoved << Eigen::Vector3d::UnitZ(), Eigen::Vector3d::Unit(is313 ? 0 : 1),
      Eigen::Vector3d::Unit(is313 ? 2 : 0);
  turned = R * unmoved;
  crossed.col(1) = turn(Eigen::Vector3d::UnitZ(), -angles[0]).col(is313 ? 0 : 1);
  const auto shown = check.show([&] { return arrowsOf(got, A); });
  const auto each = check.ask("Is each axis that of the frame as the rotations before it left the frame?");
  check.near("axes of turningAxes", got, A, 1e-12,
             {{"Are the columns in the reverse order?", A.rowwise().reverse()},
              {"Is the second axis turned the wrong way round?", crossed},
              {"Are these the axes of the other convention?",
               trueAxes(is313 ? Convention::kYawPitchRoll : Convention::k313, angles)}});
}

inline void losesAxis(rex::grading::Check& check, Student& student, Convention convention) {
  const Eigen::Vector3d angles = anglesNear(check.rng(), convention, 0);
  describe(check, convention, angles);
  const Eigen::Matrix3d A = trueAxes(convention, angles);
  const Eigen::Matrix3d seen = student.turningAxes(convention, angles);
  const Eigen::Vector3d lost = A.col(0).cross(A.col(1)), got = student.lostAxis(convention, angles);
  const bool isWrong = (seen - A).cwiseAbs().maxCoeff() > 1e-9;
  Eigen::Matrix3d two = Eigen::Matrix3d::Zero();
  two << A.col(0), A.col(1), got;
  Eigen::Matrix3d all = two;
  all.col(2) = lost;
  const auto shown = check.show([&] { return arrowsOf(two, all); });
  check.near("determinant of turningAxes where it locks", seen.determinant(), 0, 1e-12,
             {{"Are the axes independent even where two of them should coincide?", seen.determinant()}});
  const double sign = got.dot(lost) < 0 ? -1 : 1;
  check.near(
      "axis of lostAxis, with the sign that fits", sign * got, lost, 1e-9,
      {{"Does lostAxis use turningAxes, which is wrong here?", isWrong ? Eigen::Vector3d(sign * got) : lost},
       {"Is the axis given in the turned frame? Wanted are world coordinates.",
        Eigen::Vector3d(sign * trueEuler(convention, angles).transpose() * lost)}});
}
