#pragma once

#include "cli/robot/path_search.h"
#include "cli/robot/posture_option.h"
#include "planning/hybrid_astar.h"
#include "render/picture.h"

namespace rex::cli {

/// Throws UsageError for a scene in which anything but one joint of type transXYPhi moves.
void requireCar(const Model& model);

/// The task of a car in a scene: from a pose (x, y, heading) to another, with all pairs of shapes `margin`
/// metres apart. Throws like robotProblem().
[[nodiscard]] PathTask parkingTask(Model model, const ContactModel& contacts, const VectorArg& start,
                                   const VectorArg& goal, double margin, double resolution);

/// What `rex plan --planner hybrid-astar` found.
struct Parking {
  Car car{};
  CarPath path{};
  ClearanceBounds clearance{};  ///< along the whole path

  [[nodiscard]] bool isFound() const { return path.driven.found.status == PathStatus::kFound; }
};

/// Searches by findCarPath(). Throws like it.
[[nodiscard]] Parking parked(const PathTask& task, const Car& car, const HybridAStarOptions& search);

/// The drive at 1 m/s, `rate` postures per second, and its end. There must be a path.
[[nodiscard]] Motion motionOf(const Parking& parking, double rate);

/// What was explored, and the path, as exploredPicture() shows them.
[[nodiscard]] Picture parkingPicture(const PathTask& task, const Parking& parking);

}  // namespace rex::cli
