#pragma once

#include "exercise.h"

/// A robot that goes twice around the corridor of an office, and its map.
struct Office {
  Grid empty;                         ///< as large as the office; nothing is known
  Grid truth;                         ///< walls: 5, everything else: -5
  std::vector<Eigen::Vector3d> path;  ///< the true one
  Log log;
};
Office officeOfShow();

/// scan.png: cells after one scan. known.png: the map after all scans, if all poses are known.
void showScan(const Office& office);

/// distances.png: wallDistances() of the true map, with the end points of a scan from its true pose, and from
/// one that is half a metre off. fit.png: how well this scan fits around its true pose.
void showFit(const Office& office);

/// matches.png: guesses around a true pose, and where matched() leads from them.
void showMatches(const Office& office);

/// odometry.png: the map of dead reckoning. slam.png: that of mapped(). sizes.png: effective sizes over time
/// with and without matching. mapping.mp4: how the map of the particle of the largest weight grows.
void showMaps(const Office& office);

/// anywhere.png: how well a scan fits in each cell, with its best heading, and what located() says.
void showAnywhere(const Office& office);
