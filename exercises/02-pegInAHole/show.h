#pragma once

#include "exercise.h"

/// A motion of a robot, without the posture it started from.
using Postures = std::vector<Eigen::VectorXd>;

/// circle.png, posture.png, pointing.png: with the tasks of `longRun` man.ors follows the circle of radius
/// 0.2 m around `center`, stays close to its posture, and the left hand points upwards; with the circle alone
/// it drifts, as in circle_alone_after_2000_steps.png. circle.mp4 and circle.html: the recording of `turns`.
void showCircles(const Postures& longRun, const rex::Simulator& turns, const Eigen::Vector3d& center);

/// peg_posture.png: pegInAHole.ors in posture q. Prints the position of the peg, metres, and its direction.
void showPosture(const Eigen::VectorXd& q);

/// profile_position.png, profile_velocity.png, profile_acceleration.png: four motion profiles over time. Your
/// sine lies on the library's.
void showProfiles();

/// interpolation.png, contacts.png: two ways from above the hole into it. In joint space the peg leaves the
/// axis of the hole and the contact cost rises; in task space neither does noticeably. Returns the second
/// figure.
rex::Figure showInterpolation(const Postures& inJointSpace, const Postures& inTaskSpace,
                              const Eigen::Vector3d& hole, double margin);

/// peg.mp4, peg_sheet.png, and peg.html with `contacts`: the motion from the posture of `start` into the
/// hole. Prints the final position of the peg, metres, and which bodies are close to each other.
void showInsertion(const rex::Simulator& start, const Postures& motion, const rex::Figure& contacts);

/// priority.png: the right hand circles around `center`, and a less important task pulls it away. Under
/// strict priority it stays on its circle, and the curve of your step lies on the library's dashed line.
void showPriority(const Eigen::Vector3d& center);

/// man.ors on its own feet reaches for `target`, metres, with the right hand. reach_alone.png: where it ends
/// with nothing but tasks for hand and feet; reach_balanced.png, balance.mp4: with your three maps as tasks,
/// too. balance.png and limits.png: the centre of mass and the cost of joint limits over time.
void showBalance(const Eigen::Vector3d& target);
