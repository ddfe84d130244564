#!/usr/bin/env python3
"""The wheelset of hunting.c, and what linear theory makes of its contact forces.

usage: hunting.py CASE SPEED SPRINGS STEP LENGTH; LENGTH 0: eigenvalues alone
"""
import math
import sys

import numpy as np

import railstrata as rs

MASS, INERTIA, STIFFNESS_Y, STIFFNESS_YAW, LOAD, RADIUS = 1500, 1000, 2e6, 2e6, 160e3, 0.46


class Hunting:
    def __init__(self, case, speed, springs):
        self.wheelset, self.speed, self.springs = rs.Wheelset(case, cell=1e-3), speed, springs
        self.pitch_rate = 0
        self.rates(0, np.zeros(4))  # wheels roll freely in the middle of the track
        self.pitch_rate = speed / self.forces.left.rolling_radius - speed / RADIUS

    def rates(self, x, q):
        y, yaw, y_rate, yaw_rate = map(float, q)
        aside = 0.25e-3 * (1 - math.cos(math.pi * min(x, 2) / 2))
        self.forces = self.wheelset.solve(load=LOAD, speed=self.speed, y=y, yaw=yaw, y_rate=y_rate, yaw_rate=yaw_rate,
                                          pitch_rate=self.pitch_rate, rail_y=(aside, aside))
        return np.array([y_rate, yaw_rate, (self.forces.force[1] - self.springs * STIFFNESS_Y * y) / MASS,
                         (self.forces.moment[2] - self.springs * STIFFNESS_YAW * yaw) / INERTIA])

    def jacobian(self):
        steps = np.diag([1e-4, 1e-4, 1e-3, 1e-3])
        return np.array([(self.rates(0, s) - self.rates(0, -s)) / (2 * s.max()) for s in steps]).T


def main(case, *numbers):
    speed, springs, step, length = map(float, numbers)
    hunting = Hunting(case, speed, springs)
    jacobian, gamma, h = hunting.jacobian(), 1 - math.sqrt(0.5), step / speed
    if length == 0:
        slow = min(np.linalg.eigvals(jacobian), key=lambda e: abs(e.real) if e.imag > 0 else math.inf)
        print(f"growth_1_m,{slow.real / speed:.6g}\nwave_m,{2 * math.pi * speed / slow.imag:.6g}")
        return
    matrix = np.eye(4) - gamma * h * jacobian
    x, q = 0.0, np.zeros(4)
    print("x_m,y_mm,yaw_mrad,radius_difference_mm")
    while x < length:
        one = hunting.rates(x, q)
        difference = hunting.forces.left.rolling_radius - hunting.forces.right.rolling_radius
        print(f"{x:.4f},{1e3 * q[0]:.7f},{1e3 * q[1]:.7f},{1e3 * difference:.7f}")
        one = np.linalg.solve(matrix, one)
        two = np.linalg.solve(matrix, hunting.rates(x + step, q + h * one) - 2 * one)
        q = q + h * (1.5 * one + 0.5 * two)
        x += step


if __name__ == "__main__":
    main(*sys.argv[1:])
