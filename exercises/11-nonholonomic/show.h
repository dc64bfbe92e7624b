#pragma once

#include <string>

#include "exercise.h"

/// drives.png: where the car gets in that time at 1 m/s, for five steering angles; the rings, small steps
/// with velocityOf(), lie on the lines. Prints two answers of canFollow().
void showDrives(const CarModel& car, double seconds);

/// tree.png: your tree of controls fills the world, and its way ends at the goal.
void showTree(const CarModel& car, const World& world);

/// fan.png: the shortest paths to twelve headings at two positions. dubins.png: the length of each word over
/// the heading at the goal; yours is the lowest of them, with the library's dashed on it. reverse.png: your
/// paths to four poses, and the library's for a car that also drives backward.
void showDubins(const CarModel& car, double radius);

/// NAME.png, NAME.mp4, NAME_sheet.png: how the car parks; it touches nothing. For "street", NAME.html, too.
void showParking(const std::string& name, const std::string& title, const CarModel& car, const World& lot);

/// hitch.png: the angle at the hitch grows with straight wheels, and dies out with feedback. reversing.png,
/// trailer.mp4, trailer_sheet.png: the same from above, backward along the x axis from this state. rig.png: a
/// plan of the library for car and trailer, with your isFree().
void showTrailer(const Rig& rig, const Eigen::Vector4d& start);
