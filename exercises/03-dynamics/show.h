#pragma once

#include "exercise.h"

/// regimes.png, phase.png: a point of that mass (kg) on its way to 1 m, in three regimes. The exact motion
/// with the same gains is dashed; in phase space one curve spirals around the goal.
void showRegimes(double mass);

/// horizons.png: a critically damped approach in one, two and five seconds. Prints the gains.
void showHorizons(double mass);

/// load.png: against a steady push of 10 N, PD control stays short of the goal, PID control does not.
void showLoad(const PidSettings& pd, const PidSettings& pid, double mass);

/// integral.png: with Ki alone, and with Ki and Kd, the oscillation grows. With all three the point settles.
void showIntegral(const PidSettings& alone, const PidSettings& damped, const PidSettings& all, double mass);

/// restart.png: an integral accumulated while the point was held throws it far beyond its goal.
void showRestart(const PidSettings& pid, double mass);

/// kicks.png: the return to cos t after each kick, in three regimes.
void showKicks(double mass);

/// energy.png, fall.mp4: pegArm.ors falls, and its energy is conserved. Each film from here on also comes
/// with a contact sheet of six frames.
void showFall();

/// holding.png, hold.mp4, torque.mp4: held by holdArm, the arm sags and sways; with M and F it returns to
/// zero.
void showArms();

/// hand.png, circle.mp4, circle.html: the peg of pegArm2.ors on a circle of 20 cm radius, within a
/// millimetre.
void showHand();

/// newtonEuler.png: your forces, with the library's dashed lines on top. Prints M, G and C v.
void showNewtonEuler();

/// pin.png, pin.mp4: the tilt of the pin, and the arm that moves under it.
void showPin();
