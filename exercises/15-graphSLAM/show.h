#pragma once

#include "exercise.h"
#include "rooms.h"

/// Prints pose j seen from pose i, which should be `motion`, errors of edges that measured this and z, and
/// whether edgeJacobians() fits them. An edge that measured `motion` has no error.
void showEdge(const Eigen::Vector3d& i, const Eigen::Vector3d& motion, const Eigen::Vector3d& z);

/// graph.png: the way by odometry with given loops, after one of your steps, adjusted, and by the library,
/// which lies on the adjusted one. Prints costs.
void showGivenLoops(const Walk& walk);

/// scans.png: a scan on the one to which you aligned it.
void showAlignment(const Points& reference, const Points& moving, const Eigen::Vector3d& guess);

/// Poses by odometry, with edges from scans if they agree with it, and loops that your loopMotion() finds.
PoseMap mapFromScans(const Walk& walk, rex::Rng& rng);

/// before.png, after.png, costs.png, adjusting.mp4: the map by odometry, the adjusted map, its cost after
/// each step, and three steps. In the end every wall appears once.
void showMap(const Walk& walk, const PoseMap& map);

/// wrongLoops.png: with three wrong loops the map folds up if all are trusted; your robust map stays as it
/// was.
void showWrongLoops(const Walk& walk, PoseMap map);

/// reprojection.png, cameras.png: pixels of the points in one picture of a VisionSimulator, where your P puts
/// them, and where 100 pictures put the camera. Prints the errors.
void showCalibration(int points);
