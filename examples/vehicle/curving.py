#!/usr/bin/env python3
"""Bogies from straight track into a curve to the right: series of their outer wheels, as vehicle codes write them.

usage: curving.py CASE FROM TO     rows of the track from FROM to TO [m]: straight to 20, curve of 800 m from 60 on

In plan view at constant speed: two wheelsets on primary springs, a frame, a car body that the track carries along. Cant
deficiency pushes all of them outwards and loads the outer wheels; both rails step aside by a sum of sines.
"""
import math
import multiprocessing
import sys

import numpy as np

import railstrata as rs

# Axle load [N], half the wheelbase [m], frame [kg], speed [m/s], springs of a wheelset sideways [N/m] and in yaw
# [N m/rad], traction over load, million gross tonnes a year
VEHICLES = {"wagon, loaded": (220e3, 0.90, 2200, 22, 5e6, 15e6, 0, 9),
            "wagon, empty": (60e3, 0.90, 2200, 22, 2e6, 2e6, 0, 1.5),
            "locomotive": (210e3, 1.30, 8000, 22, 4e6, 5e6, 0.1, 1.5),
            "coach": (130e3, 1.25, 2600, 24, 4e6, 10e6, 0, 3)}
CURVE, STRAIGHT, RAMP, CANT, BASE, HEIGHT = 800, 20, 40, 0.08, 1.5, 1.8   # m; height of the centre of gravity
RADIUS, WHEELSET, YAW_INERTIA, PITCH_INERTIA, GRAVITY = 0.46, 1300, 700, 130, 9.81
DAMPING, TURNING, STEP, EVERY = 1e5, 1e6, 0.25, 4  # frame against body [N s/m, N m s/rad]; m, steps from row to row
WAVES = np.geomspace(4, 40, 24)                    # m, of heights that grow with them, at random phases
HEIGHTS, PHASES = 0.06e-3 * (WAVES / 10) ** 0.75, np.random.default_rng(1).uniform(0, 2 * math.pi, WAVES.size)


class Bogie:
    """q: y and yaw of both wheelsets and the frame [m, rad] from the axis of the track below them, the rates of these
    six, the pitch rates of the wheelsets beyond speed/RADIUS [rad/s]."""

    def __init__(self, case, vehicle):
        self.load, base, self.frame, self.speed, self.aside, self.stiff, self.drive, self.mgt = VEHICLES[vehicle]
        self.axles, self.places, self.found = [rs.Wheelset(case, cell=1e-3) for _ in range(2)], (base, -base), [0, 0]
        self.outwards = self.speed**2 / CURVE - GRAVITY * CANT / BASE  # m/s^2

    def rail(self, x):
        return float(np.sum(HEIGHTS * np.sin(2 * math.pi * x / WAVES + PHASES))) * min(1, x / 10)

    def into(self, x):
        return min(1, max(0, x - STRAIGHT) / RAMP)  # share of the curvature and of the cant

    def turn(self, axle, x, q):
        """rad/s of a wheelset about the vertical; the track itself turns to the right."""
        return float(q[2 * axle + 7]) - self.into(x + self.places[axle]) * self.speed / CURVE

    def contact(self, axle, x, q):
        """Force sideways, moments about the axle and the vertical, of both wheels."""
        place = x + self.places[axle]
        y, yaw, y_rate = (float(q[2 * axle + k]) for k in (0, 1, 6))
        f = self.found[axle] = self.axles[axle].solve(
            load=self.load, speed=self.speed, y=y, yaw=yaw, y_rate=y_rate, pitch_rate=float(q[12 + axle]),
            yaw_rate=self.turn(axle, x, q), rail_y=2 * (self.rail(place),),
            roll_moment=-self.load / GRAVITY * self.outwards * self.into(place) * HEIGHT)
        return f.force[1], f.moment[1], f.moment[2]

    def rates(self, x, q, contacts):
        out, bend, push = np.concatenate([q[6:12], np.zeros(8)]), -self.into(x) / CURVE, self.outwards * self.into(x)
        force = (2 * self.load / GRAVITY - 2 * WHEELSET) * push - DAMPING * q[10]  # of body and frame
        moment = -TURNING * q[11]
        for i, at in enumerate(self.places):
            spring = self.aside * (q[2 * i] + bend * at * at / 2 - q[4] - at * q[5])
            turn = self.stiff * (q[2 * i + 1] + bend * at - q[5])
            out[6 + 2 * i] = (contacts[i][0] - spring) / WHEELSET + push
            out[7 + 2 * i] = (contacts[i][2] - turn) / YAW_INERTIA
            out[12 + i] = (contacts[i][1] + self.drive * self.load * RADIUS) / PITCH_INERTIA
            force, moment = force + spring, moment + turn + at * spring
        out[10], out[11] = force / self.frame, moment / self.frame
        return out

    def all_rates(self, x, q):
        return self.rates(x, q, [self.contact(i, x, q) for i in range(2)])

    def jacobian(self, x, q):
        """By differences; the contact of a wheelset is solved anew where its own motion differs."""
        contacts, columns = [self.contact(i, x, q) for i in range(2)], []
        base = self.rates(x, q, contacts)
        for k, size in enumerate([1e-5] * 6 + [1e-4] * 6 + [1e-3] * 2):
            other, moved = list(contacts), q + size * (np.arange(14) == k)
            if k not in (4, 5, 10, 11):
                other[k - 12 if k >= 12 else k % 6 // 2] = self.contact(k - 12 if k >= 12 else k % 6 // 2, x, moved)
            columns.append((self.rates(x, moved, other) - base) / size)
        return np.array(columns).T


def rows(vehicle, case, begin, end):
    """The integrator is ROS2 with a matrix of every fourth step."""
    bogie, q, gamma = Bogie(case, vehicle), np.zeros(14), 1 - math.sqrt(0.5)
    h = STEP / bogie.speed
    for k in range(round(end / STEP) + 1):
        x = k * STEP
        if k % 4 == 0:
            matrix = np.eye(14) - gamma * h * bogie.jacobian(x, q)
        one = bogie.all_rates(x, q)
        for i, axle in enumerate(("leading", "trailing")):
            place, both = x + bogie.places[i], bogie.found[i]
            w = both.left
            if k % EVERY == 0 and begin <= place <= end:
                energy = w.dissipation / bogie.speed
                curve = f"{-CURVE / bogie.into(place):.1f}" if place > STRAIGHT else ""
                y = 1e3 * (q[2 * i] + RADIUS * both.roll - bogie.rail(place))  # of the tread
                yaw, rates = q[2 * i + 1], (RADIUS * q[12 + i] + BASE / 2 * bogie.turn(i, x, q), q[2 * i + 6])
                along, across = -rates[0] / bogie.speed, rates[1] / bogie.speed - yaw  # creepages of the wheel
                yield (f"{place:.2f};{vehicle}, {axle};{1e-3 * w.force[2]:.2f};{y:.3f};{1e3 * yaw:.3f};"
                       f"{1e3 * both.roll:.4f};{along:.6f};{across:.6f};{curve};{bogie.speed};"
                       f"{-1e-3 * w.force[1]:.2f};{energy:.2f}")
        one = np.linalg.solve(matrix, one)
        two = np.linalg.solve(matrix, bogie.all_rates(x + STEP, q + h * one) - 2 * one)
        q = q + h * (1.5 * one + 0.5 * two)


def series(vehicle, *given):
    found = list(rows(vehicle, *given))
    return [f"{row};{VEHICLES[vehicle][-1] / len(found):.5f}" for row in found]


if __name__ == "__main__":
    given = (sys.argv[1], float(sys.argv[2]), float(sys.argv[3]))
    with multiprocessing.get_context("spawn").Pool(2) as pool:
        found = pool.starmap(series, [(vehicle, *given) for vehicle in VEHICLES], 1)
    print("distance [m];name;Q [kN];y [mm];psi [mrad];roll [mrad];creepage;lateral_creepage;curve_radius [m];"
          "speed [m/s];Y [kN];friction_energy [N];mgt", *sum(found, []), sep="\n")
