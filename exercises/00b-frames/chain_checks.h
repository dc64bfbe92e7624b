#pragma once

#include <algorithm>
#include <functional>
#include <string>

#include "base/derivative_check.h"
#include "geometry/pose.h"
#include "rotation_checks.h"

// The checks of parts 3, 4 and 5. Wanted poses are products of the library's, wanted Jacobians differences of
// those or the simulator's.

inline Eigen::Matrix4d product(const Eigen::Matrix4d& A, const Eigen::Matrix4d& B) { return A * B; }

inline Eigen::Matrix4d withParts(const Eigen::Matrix3d& R, const Eigen::Vector3d& p) {
  return matrixOf({R, p});
}

inline void inverts(rex::grading::Check& check, Student& student) {
  const rex::Pose X = randomPose(check.rng()), B = randomPose(check.rng());
  const Eigen::Matrix4d X_AB = matrixOf(X), X_WB = matrixOf(B), X_BA = matrixOf(X.inverse());
  check.input("a transform", {{"X_AB", X_AB}});
  const Eigen::Matrix3d back = X.R.transpose();
  check.near("X_BA of inverted", student.inverted(X_AB), X_BA, 1e-12,
             {{"Is the position left as it is?", withParts(back, X.p)},
              {"Is the position turned by R? It needs the transpose.", withParts(back, -X.R * X.p)},
              {"Is the transform returned as it is?", X_AB}});
  check.input("two frames in the world", {{"X_WA", X_AB}, {"X_WB", X_WB}});
  const Eigen::Matrix4d X_BW = matrixOf(B.inverse());
  check.near("X_AB of seenFrom", student.seenFrom(X_AB, X_WB), product(X_BA, X_WB), 1e-12,
             {{"Is no transform inverted?", product(X_AB, X_WB)},
              {"Is the other transform inverted?", product(X_AB, X_BW)},
              {"Is only the position subtracted? The axes of A may be turned.", withParts(B.R, B.p - X.p)}});
}

inline void describe(rex::grading::Check& check, const Chain& chain, const Eigen::VectorXd& q) {
  const auto count = static_cast<Eigen::Index>(chain.joints.size());
  Eigen::MatrixXd frames(4, 4 * count), axes(3, count), slides(1, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const ChainJoint& joint = chain.joints[static_cast<std::size_t>(i)];
    frames.middleCols(4 * i, 4) = joint.X_PJ;
    axes.col(i) = joint.axis;
    slides(0, i) = joint.kind == JointKind::kPrismatic ? 1 : 0;
  }
  check.input("a chain of " + std::to_string(count) + " joints",
              {{"X_PJ of joints 0 and 1", frames.leftCols(8)},
               {"X_PJ of the others", frames.rightCols(4 * count - 8)},
               {"axes", axes},
               {"is prismatic", slides},
               {"X_ME", chain.X_ME},
               {"q", q}});
}

inline void movesJoint(rex::grading::Check& check, Student& student, bool slides) {
  ChainJoint joint = randomChain(check.rng(), 1).joints[0];
  joint.kind = slides ? JointKind::kPrismatic : JointKind::kRevolute;
  const double q = check.rng().uniform(0.3, 1.2);
  const Eigen::Vector3d a = joint.axis, zero(0, 0, 0);
  check.input(slides ? "a prismatic joint" : "a revolute joint",
              {{"X_PJ", joint.X_PJ}, {"axis", a}, {"q", q}});
  const Eigen::Matrix3d I = Eigen::Matrix3d::Identity(), R = turn(a, q),
                        R_PJ = joint.X_PJ.topLeftCorner<3, 3>();
  const Eigen::Matrix4d turned = withParts(R, zero), moved = withParts(I, q * a),
                        wanted = slides ? moved : turned;
  check.near("X_JM of jointMotion", student.jointMotion(joint, q), wanted, 1e-12,
             {{"Is it the other kind of joint?", slides ? turned : moved},
              {"Does the joint turn and move at once?", withParts(R, q * a)},
              {"Is the axis turned out of frame J?",
               slides ? withParts(I, q * R_PJ * a) : withParts(turn(R_PJ * a, q), zero)},
              {"Does q have the wrong sign?", slides ? withParts(I, -q * a) : withParts(turn(a, -q), zero)},
              {"Does the joint not move?", Eigen::Matrix4d(Eigen::Matrix4d::Identity())}});
}

/// Product of what `factor` makes of X_PJ and the motion of each joint, then X_ME.
inline Eigen::Matrix4d chained(
    const Chain& chain, const Eigen::VectorXd& q,
    const std::function<Eigen::Matrix4d(const Eigen::Matrix4d&, const Eigen::Matrix4d&)>& factor) {
  Eigen::Matrix4d X = Eigen::Matrix4d::Identity();
  int k = 0;
  for (ChainJoint one : chain.joints) {
    const Eigen::Matrix4d X_PJ = one.X_PJ;
    one.X_PJ.setIdentity();
    X = X * factor(X_PJ, matrixOf(trueEnd({{one}}, q.segment(k++, 1))));
  }
  return X;
}

/// The chain, as a line from joint to joint, in the pictures of `evidence`.
inline rex::grading::Evidence withChain(rex::grading::Evidence evidence, const Chain& chain,
                                        const Eigen::VectorXd& q) {
  rex::Polyline line{.points = {{0, 0, 0}}, .color = rex::grading::kWantedColor};
  Chain part;
  for (const ChainJoint& one : chain.joints) {
    part.joints.push_back(one);
    line.points.push_back(trueEnd(part, q).p);
  }
  line.points.push_back(trueEnd(chain, q).p);
  for (rex::Frame& frame : evidence.film) frame.picture.polylines.push_back(line);
  return evidence;
}

inline rex::grading::Evidence endsOf(const Chain& chain, const Eigen::VectorXd& q,
                                     const Eigen::Matrix4d& got) {
  const rex::Pose end = trueEnd(chain, q), have = poseOf(got);
  return withChain(arrowsOf(0.4 * have.R, 0.4 * end.R, have.p, end.p), chain, q);
}

inline void reachesEnd(rex::grading::Check& check, const Chain& chain, const Eigen::VectorXd& q,
                       const Eigen::Matrix4d& wanted, const Eigen::Matrix4d& got,
                       const std::string& property) {
  describe(check, chain, q);
  const auto shown = check.show([&] { return endsOf(chain, q, got); });
  Chain shorter = chain, later = chain;
  shorter.joints.pop_back();
  later.joints.erase(later.joints.begin());
  const int n = static_cast<int>(q.size());
  check.near(property, got, wanted, 1e-9,
             {{"Are the X_PJ left out?",
               product(chained(chain, q, [](const auto&, const auto& m) { return m; }), chain.X_ME)},
              {"Are the motions left out?", matrixOf(trueEnd(chain, Eigen::VectorXd::Zero(n)))},
              {"Are the coordinates in reverse order?", matrixOf(trueEnd(chain, q.reverse()))},
              {"Is the last joint left out?", matrixOf(trueEnd(shorter, q.head(n - 1)))},
              {"Is the first joint left out?", matrixOf(trueEnd(later, q.tail(n - 1)))}});
}

// Part 4.

/// One column of the Jacobian of a point (scale 1) or of a direction (scale 0): from the axis and the
/// position of the joint, the point or vector (all in the world), and whether the joint slides.
using Column = std::function<Eigen::Vector3d(const Eigen::Vector3d& a, const Eigen::Vector3d& at,
                                             const Eigen::Vector3d& y, bool slides)>;
inline Eigen::MatrixXd byColumns(const Chain& chain, const Eigen::VectorXd& q, const Eigen::Vector3d& y,
                                 const Column& column, bool isLocal = false) {
  Eigen::MatrixXd J(3, q.size());
  for (int i = 0; i < q.size(); ++i) {
    const ChainJoint& joint = chain.joints[static_cast<std::size_t>(i)];
    const Chain before{{chain.joints.begin(), chain.joints.begin() + i}, joint.X_PJ};
    const rex::Pose X_WJ = trueEnd(before, q.head(i));
    J.col(i) = column(isLocal ? joint.axis : Eigen::Vector3d(X_WJ.R * joint.axis), X_WJ.p, y,
                      joint.kind == JointKind::kPrismatic);
  }
  return J;
}

/// The first three columns of a Jacobian as arrows where the end is, and all its rows as curves.
inline rex::grading::Evidence columnsOf(const Eigen::MatrixXd& got, const Eigen::MatrixXd& wanted,
                                        const Chain& chain, const Eigen::VectorXd& q) {
  const Eigen::Vector3d p = trueEnd(chain, q).p;
  rex::grading::Evidence evidence =
      withChain(arrowsOf(got.topLeftCorner(3, 3), wanted.topLeftCorner(3, 3), p, p), chain, q);
  evidence.figures = {rex::grading::comparison("rows over columns", got, wanted)};
  return evidence;
}

using Vec = const Eigen::Vector3d&;

inline void movesPoint(rex::grading::Check& check, const Chain& chain, const Eigen::VectorXd& q,
                       const Eigen::Vector3d& p_E, const Eigen::MatrixXd& wanted,
                       const Eigen::MatrixXd& got) {
  describe(check, chain, q);
  check.shape("pointJacobian", got, 3, q.size());
  const rex::Pose end = trueEnd(chain, q);
  const auto columns = [&](const Column& column, Vec y) { return byColumns(chain, q, y, column, false); };
  const auto right = [](Vec a, Vec at, Vec y, bool slides) -> Eigen::Vector3d {
    return slides ? a : a.cross(y - at);
  };
  const auto shown = check.show([&] { return columnsOf(got, wanted, chain, q); });
  check.near("J of pointJacobian", got, wanted, 1e-7,
             {{"Is p_E not turned into the axes of the world?", columns(right, end.p + p_E)},
              {"Is p_E taken for a point in the world?", columns(right, p_E)},
              {"Is the Jacobian given in the axes of E?", Eigen::MatrixXd(end.R.transpose() * wanted)},
              {"Is it the Jacobian where all coordinates are 0?",
               byColumns(chain, 0 * q, trueEnd(chain, 0 * q) * p_E, right)}});
}

inline void movesVector(rex::grading::Check& check, const Chain& chain, const Eigen::VectorXd& q,
                        const Eigen::Vector3d& v_E, const Eigen::MatrixXd& wanted,
                        const Eigen::MatrixXd& got) {
  describe(check, chain, q);
  check.shape("vectorJacobian", got, 3, q.size());
  const rex::Pose end = trueEnd(chain, q);
  const Eigen::Vector3d v = end.R * v_E;
  const auto columns = [&](const Column& column, Vec y, bool isLocal = false) {
    return byColumns(chain, q, y, column, isLocal);
  };
  const auto right = [](Vec a, Vec, Vec y, bool slides) -> Eigen::Vector3d {
    return slides ? 0 * a : a.cross(y);
  };
  const auto shown = check.show([&] { return columnsOf(got, wanted, chain, q); });
  check.near("J of vectorJacobian", got, wanted, 1e-7,
             {{"Is the axis the column of a prismatic joint? It does not turn the vector.",
               columns([](Vec a, Vec, Vec y, bool s) -> Eigen::Vector3d { return s ? a : a.cross(y); }, v)},
              {"Is the Jacobian given in the axes of E?", Eigen::MatrixXd(end.R.transpose() * wanted)},
              {"Is it the Jacobian where all coordinates are 0?",
               byColumns(chain, 0 * q, trueEnd(chain, 0 * q).R * v_E, right)}});
}

/// A function with known derivatives: f_i = sum over j of c_ij sin(w_ij x_j + s_ij).
struct Waves {
  Eigen::MatrixXd c, w, s;
  /// Of the values (0) and of their first and second derivatives, the terms, d x n.
  Eigen::MatrixXd terms(const Eigen::VectorXd& x, int order) const {
    Eigen::MatrixXd all = c;
    for (Eigen::Index i = 0; i < c.rows(); ++i)
      for (Eigen::Index j = 0; j < c.cols(); ++j)
        all(i, j) *= std::pow(w(i, j), order) * std::sin(w(i, j) * x[j] + s(i, j) + order * kPi / 2);
    return all;
  }
};

inline void differentiates(rex::grading::Check& check, Student& student, int d, int n) {
  rex::Rng& rng = check.rng();
  const auto draw = [&](double low, double high) -> Eigen::MatrixXd {
    return rng.uniformVector(d * n, low, high).reshaped(d, n);
  };
  const Waves waves{draw(-1, 1), draw(0.5, 2), draw(-3, 3)};
  const Eigen::VectorXd x = rng.uniformVector(n, -2, 2);
  check.input("sums of waves, " + std::to_string(d) + " values of " + std::to_string(n) + " numbers",
              {{"x", x}});
  const Eigen::MatrixXd J = waves.terms(x, 1), bend = waves.terms(x, 2),
                        got = student.differences(
                            [&](const Eigen::VectorXd&at) -> Eigen::VectorXd {
                              rex::requireSize("x of f", at.size(), n);
                              return waves.terms(at, 0).rowwise().sum();
                            },
                            x);
  const auto asked = [&](const std::string& question, bool applies) { return check.ask(question, applies); };
  const auto stacked = asked("Is it transposed? A column is the derivative by one entry of x.",
                             d != n && got.rows() == n && got.cols() == d);
  check.shape("differences", got, d, n);
  const Eigen::MatrixXd off = got - J;
  const double along = off.cwiseProduct(bend).sum(), size = off.norm() * bend.norm();
  const auto oneSided =
      asked("Is the difference one-sided? Its error is h times half of the second derivative.",
            size > 0 && std::abs(along) > 0.99 * size && off.norm() < 1);
  const auto rough =
      asked("Is h too small, or too large? Compare what is cut off with what is rounded.", off.norm() < 0.1);
  const auto shown = check.show([&]() -> rex::grading::Evidence {
    return {.figures = {rex::grading::comparison("rows of the Jacobian over its columns", got, J)}};
  });
  check.near("J of differences", got, J, 1e-7,
             {{"Is it divided by 2 h, though only one step is taken?", J / 2},
              {"Does it have the wrong sign?", -J},
              {"Are the columns in reverse order?", J.rowwise().reverse()}});
}

inline void shapesEllipsoid(rex::grading::Check& check, Student& student, const Eigen::MatrixXd& J) {
  check.input("a Jacobian", {{"J", J}});
  const Manipulability got = student.manipulability(J);
  const Eigen::Index d = J.rows();
  check.shape("axes of manipulability", got.axes, d, d);
  check.shape("radii of manipulability", got.radii, d, 1);
  const Eigen::VectorXd s = rex::svd(J).s, none = Eigen::VectorXd::Zero(d);
  const auto shown = check.show([&]() -> rex::grading::Evidence {
    return {.figures = {{.title = "Radii of the ellipsoid",
                         .xLabel = "number of the axis [1]",
                         .yLabel = "radius [m/s]",
                         .series = {rex::grading::gotCurve("got", {}, {got.radii.begin(), got.radii.end()}),
                                    rex::grading::wantedCurve("wanted", {}, {s.begin(), s.end()})}}}};
  });
  check.near("radii of manipulability", got.radii, s, 1e-9,
             {{"Are the radii inverted? That is the ellipsoid of forces.", s.cwiseInverse()},
              {"Are the radii inverted? That is the ellipsoid of forces.", s.cwiseInverse().reverse()},
              {"Are the radii whole lengths? Wanted are half ones.", 2 * s}});
  check.near("axes^T axes of manipulability", got.axes.transpose() * got.axes,
             Eigen::MatrixXd::Identity(d, d), 1e-9);
  const Eigen::MatrixXd root = got.axes * got.radii.asDiagonal(), square = J * J.transpose();
  const auto rows = check.ask("Are the axes rows? They are columns.",
                              (got.axes.transpose() * square * got.axes).cwiseAbs().sum() >
                                  (got.axes * square * got.axes.transpose()).cwiseAbs().sum() + 1e-6);
  check.near("axes diag(radii^2) axes^T of manipulability, which is J J^T", root * root.transpose(), square,
             1e-8);
  const double measure = s.prod();
  const auto volume = check.ask("Is it sqrt(det(J J^T)), the product of the radii?");
  check.near("measure of manipulability", got.measure, measure, 1e-9,
             {{"Is it the condition, the ratio of the shortest and the longest radius?", s[d - 1] / s[0]},
              {"Are the radii added?", s.sum()}});
}

// Part 5.

inline void movesByScrew(rex::grading::Check& check, Student& student, bool slides) {
  rex::Rng& rng = check.rng();
  const Eigen::Vector3d a = randomDirection(rng), p = rng.uniformVector(3, -1, 1), zero(0, 0, 0);
  const Screw screw = slides ? Screw{zero, a} : Screw{a, p.cross(a) + rng.uniform(0.1, 0.5) * a};
  const double q = rng.uniform(0.4, 2.5);
  check.input(slides ? "a translation" : "a screw", {{"w", screw.w}, {"v", screw.v}, {"q", q}});
  const auto exponential = [&](const Eigen::Vector3d& w, const Eigen::Vector3d& v) {
    rex::Vector6d twist;
    twist << v, w;
    return matrixOf(rex::expSE3(q * twist));
  };
  const Eigen::Matrix4d wanted = exponential(screw.w, screw.v);
  const Eigen::Matrix3d R = turn(screw.w, q), W = rex::skew(screw.w);
  const Eigen::Vector3d& v = screw.v;
  check.near(
      "screwMotion", student.screwMotion(screw, q), wanted, 1e-9,
      {{"Are w and v exchanged?", exponential(v, screw.w)},
       {"Is the position left out?", withParts(R, zero)},
       {"Is the part of v along the axis lost?", withParts(R, (1 - std::cos(q)) * W * v + std::sin(q) * v)},
       {"Does the rotation have the wrong sense?", withParts(R.transpose(), wanted.topRightCorner<3, 1>())}});
}

inline void findsScrews(rex::grading::Check& check, Student& student, const Chain& chain) {
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(static_cast<int>(chain.joints.size()));
  describe(check, chain, zero);
  const std::vector<Screw> got = student.screwsOf(chain);
  check.near("number of screws", static_cast<double>(got.size()), static_cast<double>(zero.size()), 0);
  Eigen::MatrixXd all(6, zero.size());
  for (int i = 0; i < zero.size(); ++i)
    all.col(i) << got[static_cast<std::size_t>(i)].w, got[static_cast<std::size_t>(i)].v;
  const auto made = [&](const Column& column, bool isLocal = false) {
    Eigen::MatrixXd screws(6, zero.size());
    const auto w = [](Vec a, Vec, Vec, bool s) -> Eigen::Vector3d { return s ? 0 * a : a; };
    screws << byColumns(chain, zero, {0, 0, 0}, w, isLocal),
        byColumns(chain, zero, {0, 0, 0}, column, isLocal);
    return screws;
  };
  const auto right = [](Vec a, Vec p, Vec, bool s) -> Eigen::Vector3d { return s ? a : p.cross(a); };
  const Eigen::MatrixXd wanted = made(right);
  Eigen::MatrixXd exchanged = wanted;
  exchanged << wanted.bottomRows(3), wanted.topRows(3);
  const auto shown = check.show([&] { return columnsOf(all, wanted, chain, zero); });
  check.near("w above v of screwsOf", all, wanted, 1e-9,
             {{"Is v zero for revolute joints? Their axes do not pass through the origin.",
               made([](Vec a, Vec, Vec, bool s) -> Eigen::Vector3d { return s ? a : 0 * a; })},
              {"Are w and v exchanged?", exchanged}});
}

inline void multipliesScrews(rex::grading::Check& check, Student& student, const Chain& chain,
                             const Eigen::VectorXd& q) {
  const Eigen::VectorXd zero = 0 * q;
  describe(check, chain, q);
  const auto column = [](Vec a, Vec p, Vec, bool s) -> Eigen::Vector3d { return s ? a : p.cross(a); };
  const Eigen::MatrixXd v = byColumns(chain, zero, {0, 0, 0}, column);
  std::vector<Screw> screws;
  Eigen::Matrix4d forward = Eigen::Matrix4d::Identity(), backward = forward;
  for (int i = 0; i < q.size(); ++i) {
    const Chain before{{chain.joints.begin(), chain.joints.begin() + i},
                       chain.joints[static_cast<std::size_t>(i)].X_PJ};
    const Eigen::Vector3d a =
        trueEnd(before, zero.head(i)).R * chain.joints[static_cast<std::size_t>(i)].axis;
    screws.push_back(
        {chain.joints[static_cast<std::size_t>(i)].kind == JointKind::kPrismatic ? 0 * a : a, v.col(i)});
    rex::Vector6d twist;
    twist << screws.back().v, screws.back().w;
    const Eigen::Matrix4d motion = matrixOf(rex::expSE3(q[i] * twist));
    forward = forward * motion;
    backward = motion * backward;
  }
  const Eigen::Matrix4d start = matrixOf(trueEnd(chain, zero)),
                        got = student.endPoseByScrews(screws, start, q);
  const auto shown = check.show([&] { return endsOf(chain, q, got); });
  check.near("endPoseByScrews", got, matrixOf(trueEnd(chain, q)), 1e-9,
             {{"Is X_WE0 left out?", forward}, {"Is it the pose where all coordinates are 0?", start}});
}
