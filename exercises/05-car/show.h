#pragma once

#include "exercise.h"

/// A drive, and what the filter does not know: the state of the car after each of the 300 steps, 3 x 300.
struct RecordedDrive {
  DriveLog log;
  Eigen::MatrixXd truth;
};

/// The library's car drives in that world from (0, 0, 0), with the same control in all 300 steps.
RecordedDrive recordDrive(const CarWorld& world, const Eigen::Vector2d& u);

/// A corridor of 20 cells with doors at 2, 5, 6 and 13.
Corridor corridorOfFourDoors();

/// A walk to the right: `cells` are where the robot was.
struct Walk {
  std::vector<int> ways, seen, cells;
};
Walk recordWalk(const Corridor& corridor);

/// corridor.png: the beliefs at the start, after 3 steps and at the end, above the doors. hindsight.png: the
/// probability of the cell in which the robot was, in each step.
void showCorridor(const std::vector<Eigen::VectorXd>& beliefs, const std::vector<Eigen::VectorXd>& hindsight,
                  const Walk& walk, const Corridor& corridor);

/// dead_reckoning.png, dead_reckoning.mp4: clouds that only move, one for each step. They grow and bend, and
/// their mean follows a smaller circle than the car.
void showDeadReckoning(const std::vector<Cloud>& blind, const RecordedDrive& drive, const CarWorld& world);

/// likelihood.png: the weights of particles around the car, with its true heading, given what it saw in that
/// step. They are largest near the cross, where the car is.
void showLikelihood(int step, const RecordedDrive& drive, const CarWorld& world);

/// Prints how many of `count` children each parent has in 1000 draws, and the effective size.
void showChildren(const Eigen::VectorXd& weights, int count);

/// filter.png, filter.mp4, error.png: with landmarks the clouds stay as small as the car, and their mean
/// stays within a few decimetres of it, like the mean of the library's filter.
void showFilter(const std::vector<Cloud>& clouds, const std::vector<Cloud>& blind, const RecordedDrive& drive,
                const CarWorld& world);

/// assumed.png, effective_size.png, weights.png: the same drive with 10 sigma, sigma and sigma / 10.
void showAssumptions(const RecordedDrive& drive, const CarWorld& world);

/// bearings.mp4: 2000 particles know roughly where the car is, but nothing about its heading at first.
void showBearings(const RecordedDrive& drive, const CarWorld& world);
