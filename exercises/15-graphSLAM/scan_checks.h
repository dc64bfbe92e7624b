#pragma once

#include <vector>

#include "graph_checks.h"
#include "rooms.h"

// Random rooms, and pairs of scans in them.

struct RandomRoom {
  Building walls;
  std::vector<Eigen::Vector4d> things;  ///< x, y, width, height
  double width = 0, depth = 0;
};

/// A room of 5 to 10 m each way with four things in it and a slanted wall.
inline RandomRoom randomRoom(rex::Rng& rng) {
  RandomRoom room;
  room.width = rng.uniform(5, 10);
  room.depth = rng.uniform(5, 10);
  addBox(room.walls, 0, 0, room.width, room.depth);
  for (int k = 0; k < 4; ++k) {
    const Eigen::Vector4d thing(rng.uniform(0.2, room.width - 1.7), rng.uniform(0.2, room.depth - 1.7),
                                rng.uniform(0.4, 1.5), rng.uniform(0.4, 1.5));
    room.things.push_back(thing);
    addBox(room.walls, thing[0], thing[1], thing[2], thing[3]);
  }
  const double cut = rng.uniform(0.8, 1.8);
  addWall(room.walls, 0, room.depth - cut, cut * rng.uniform(0.6, 1.4), room.depth);
  return room;
}

inline bool isOpen(const RandomRoom& room, const Eigen::Vector3d& pose) {
  constexpr double kClear = 0.35;
  if (pose[0] < kClear || pose[1] < kClear || pose[0] > room.width - kClear || pose[1] > room.depth - kClear)
    return false;
  for (const Eigen::Vector4d& thing : room.things)
    if (pose[0] > thing[0] - kClear && pose[0] < thing[0] + thing[2] + kClear &&
        pose[1] > thing[1] - kClear && pose[1] < thing[1] + thing[3] + kClear)
      return false;
  return pose[0] > 1.5 || pose[1] < room.depth - 2.2;  // not behind the slanted wall
}

inline Eigen::Vector3d openPose(rex::Rng& rng, const RandomRoom& room) {
  for (;;) {
    const Eigen::Vector3d pose(rng.uniform(0, room.width), rng.uniform(0, room.depth), rng.uniform(-3, 3));
    if (isOpen(room, pose)) return pose;
  }
}

/// The share of one scan that another shows too: its points near a point of the other, at the true motion.
inline double sharedPart(const Points& reference, const Points& moving, const Eigen::Vector3d& motion) {
  const Eigen::Matrix3d X = frameOf(motion);
  int shared = 0;
  for (const Eigen::Vector2d& p : moving) {
    bool isShared = false;
    for (const Eigen::Vector2d& q : reference)
      isShared = isShared || std::hypot(X(0, 0) * p.x() + X(0, 1) * p.y() + X(0, 2) - q.x(),
                                        X(1, 0) * p.x() + X(1, 1) * p.y() + X(1, 2) - q.y()) < 0.25;
    if (isShared) ++shared;
  }
  return static_cast<double>(shared) / static_cast<double>(moving.size());
}

struct ScanPair {
  Points reference, moving;
  Eigen::Vector3d motion = Eigen::Vector3d::Zero(), guess = Eigen::Vector3d::Zero();
};

/// Two scans of one room, at most 1.2 m apart, that share four fifths at least, and a guess.
inline ScanPair pairOfScans(rex::Rng& rng) {
  for (;;) {
    const RandomRoom room = randomRoom(rng);
    const Eigen::Vector3d a = openPose(rng, room);
    const Eigen::Vector3d b =
        onward(a, {rng.uniform(-0.85, 0.85), rng.uniform(-0.85, 0.85), rng.uniform(-3, 3)});
    if (!isOpen(room, b)) continue;
    ScanPair pair{scanFrom(room.walls, a, rng), scanFrom(room.walls, b, rng), relative(a, b), {}};
    const Eigen::Vector3d off(rng.uniform(-0.2, 0.2), rng.uniform(-0.2, 0.2), rng.uniform(-0.2, 0.2));
    pair.guess = {pair.motion[0] + off[0], pair.motion[1] + off[1], byTurns(pair.motion[2] + off[2])};
    const Eigen::Vector3d back = relative(pair.motion, {0, 0, 0});
    if (sharedPart(pair.reference, pair.moving, pair.motion) > 0.8 &&
        sharedPart(pair.moving, pair.reference, back) > 0.8)
      return pair;
  }
}

/// Scans of two rooms that have nothing to do with each other.
inline ScanPair pairOfStrangers(rex::Rng& rng) {
  const RandomRoom one = randomRoom(rng), other = randomRoom(rng);
  return {scanFrom(one.walls, openPose(rng, one), rng),
          scanFrom(other.walls, openPose(rng, other), rng),
          {},
          randomPose(rng, 1)};
}
