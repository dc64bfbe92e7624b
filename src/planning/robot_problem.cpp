#include "planning/robot_problem.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include <fmt/format.h>

#include "base/error.h"
#include "collision/contact_batch.h"
#include "collision/contacts.h"
#include "collision/proxy_report.h"
#include "scene/coordinates.h"

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
  return [model = std::make_shared<const Model>(model), contacts, margin,
          poses = PoseBatch()](const MatrixArg& Q) mutable {
    forwardKinematicsBatch(*model, Q, poses);
    return allContactFree(contacts, poses, margin);
  };
}

std::string nearestContact(const Model& model, const ContactModel& contacts, const VectorArg& q) {
  const std::vector<Proxy> near = proxies(contacts, forwardKinematics(model, q));
  if (near.empty()) return "all shapes apart";
  const Proxy& nearest = *std::min_element(near.begin(), near.end(), [](const Proxy& a, const Proxy& b) {
    return a.proximity.distance < b.proximity.distance;
  });
  const double distance = nearest.proximity.distance;
  return fmt::format("'{}' and '{}' {:.4g} m {}", shapeLabel(model, nearest.pair.a),
                     shapeLabel(model, nearest.pair.b), std::abs(distance),
                     distance < 0 ? "in overlap" : "apart");
}

PathProblem robotProblem(const Model& model, const ContactModel& contacts, const VectorArg& start,
                         const VectorArg& goal, double margin, double resolution) {
  const auto kept = std::make_shared<const Model>(model);
  return {.space = postureSpace(model),
          .allValid = contactFree(model, contacts, margin),
          .start = start,
          .goal = goal,
          .resolution = resolution,
          .reason = [kept, contacts](const VectorArg& q) { return nearestContact(*kept, contacts, q); }};
}

}  // namespace rex
