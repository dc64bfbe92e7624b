#include "planning/robot_problem.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include <fmt/format.h>

#include "base/error.h"
#include "collision/collision_pairs.h"
#include "collision/contacts.h"
#include "scene/state.h"

namespace rex {
namespace {

// Whether a freedom only turns about an axis, without moving along it, so that a whole turn brings it back.
bool isTurn(const DegreeOfFreedom& freedom) {
  return !freedom.angular.isZero() && std::abs(freedom.angular.dot(freedom.linear)) < 1e-12;
}

}  // namespace

Space postureSpace(const Model& model) {
  std::vector<SpacePart> parts(static_cast<std::size_t>(model.nq()));
  std::vector<bool> isPart(parts.size(), true);
  const auto part = [&](int i) -> SpacePart& { return parts[static_cast<std::size_t>(i)]; };
  forEachPlainCoordinate(model, [&](int iq, int, const DegreeOfFreedom& freedom) {
    const double lower = model.lowerLimits()[iq], upper = model.upperLimits()[iq];
    if (std::isfinite(lower) && std::isfinite(upper)) {
      part(iq) = {.lower = lower, .upper = upper};
      return;
    }
    if (!isTurn(freedom) || std::isfinite(lower) || std::isfinite(upper)) {
      const auto joint = std::find_if(model.joints().begin(), model.joints().end(), [&](const Joint& one) {
        return iq >= one.qIndex && iq < one.qIndex + one.nq;
      });
      throw Error({.what = fmt::format("joint '{}'", joint->name),
                   .found = fmt::format("limits {:g} and {:g}", lower, upper),
                   .wanted = "finite limits, since postures are drawn between them"});
    }
    part(iq) = {.kind = SpacePart::Kind::kCircle};
  });
  forEachQuaternion(model, [&](int iq, int) {
    part(iq) = {.kind = SpacePart::Kind::kQuaternion};
    for (int k = 1; k < 4; ++k) isPart[static_cast<std::size_t>(iq + k)] = false;
  });
  std::vector<SpacePart> kept;
  for (std::size_t i = 0; i < parts.size(); ++i)
    if (isPart[i]) kept.push_back(parts[i]);
  return Space(std::move(kept));
}

AllValid contactFree(const Model& model, const ContactModel& contacts, double margin) {
  return [model = std::make_shared<const Model>(model), contacts, margin, poses = PoseBatch(),
          order = std::vector<int>()](const MatrixArg& Q) mutable {
    forwardKinematicsBatch(*model, Q, poses);
    return allContactFree(contacts, poses, margin, order);
  };
}

NearestContact nearestContact(const Model& model, const ContactModel& contacts, const VectorArg& q) {
  const std::vector<Proxy> near = proxies(contacts, forwardKinematics(model, q));
  if (near.empty()) return {};
  const Proxy& nearest = *std::min_element(near.begin(), near.end(), [](const Proxy& a, const Proxy& b) {
    return a.proximity.distance < b.proximity.distance;
  });
  const double distance = nearest.proximity.distance;
  return {distance, fmt::format("'{}' and '{}' {:.4g} m {}", shapeLabel(model, nearest.pair.a),
                                shapeLabel(model, nearest.pair.b), std::abs(distance),
                                distance < 0 ? "in overlap" : "apart")};
}

PathProblem robotProblem(const Model& model, const ContactModel& contacts, const VectorArg& start,
                         const VectorArg& goal, double margin, double resolution) {
  const auto kept = std::make_shared<const Model>(model);
  return {.space = postureSpace(model),
          .allValid = contactFree(model, contacts, margin),
          .start = start,
          .goal = goal,
          .resolution = resolution,
          .reason = [kept, contacts](const VectorArg& q) { return nearestContact(*kept, contacts, q).text; }};
}

namespace {

// The number of pieces that a motion is cut into, so that no ball joint turns by more than 0.05 rad in any of
// them: then the chord of the quaternions, which a straight motion follows, and their arc nearly coincide at
// any time.
int piecesOf(const Space& space, const VectorArg& from, const VectorArg& to) {
  constexpr double kTurn = 0.05;
  double longest = 0;
  Eigen::Index i = 0;
  for (const SpacePart& part : space.parts()) {
    if (part.kind == SpacePart::Kind::kQuaternion) {
      const double cosine = std::abs(from.segment<4>(i).dot(to.segment<4>(i)));
      longest = std::max(longest, 2 * std::acos(std::min(1., cosine)));
    }
    i += coordinateCount(part.kind);
  }
  return std::max(1, static_cast<int>(std::ceil(longest / kTurn)));
}

}  // namespace

ClearanceBounds pathClearance(const Model& model, const ContactModel& contacts, const Space& space,
                              const MatrixArg& path, double tolerance) {
  requireSize("postures of a path", path.rows(), space.size());
  if (path.cols() == 0) throw Error({.what = "path", .found = "no postures", .wanted = "at least one"});
  ClearanceBounds least = clearanceBounds(model, contacts, path.col(0), path.col(0), tolerance);
  const Eigen::MatrixXd postures = unrolled(space, path);
  Eigen::VectorXd from = postures.col(0), to = from;
  for (Eigen::Index k = 1; k < postures.cols(); ++k) {
    const auto start = postures.col(k - 1), end = postures.col(k);
    const int pieces = piecesOf(space, start, end);
    for (int i = 1; i <= pieces; ++i, from = to) {
      if (i < pieces)
        space.interpolate(start, end, static_cast<double>(i) / pieces, to);
      else
        to = end;
      const ClearanceBounds piece = clearanceBounds(model, contacts, from, to, tolerance);
      least = {std::min(least.atLeast, piece.atLeast), std::min(least.atMost, piece.atMost)};
    }
  }
  return least;
}

}  // namespace rex
