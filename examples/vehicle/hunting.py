#!/usr/bin/env python3
"""The wheelset of hunting.c, and what linear theory makes of its contact forces.

usage: hunting.py LIBRARY CASE SPEED SPRINGS STEP LENGTH; LENGTH 0: eigenvalues alone
"""
import ctypes
import math
import sys

import numpy as np

D, I, Z = ctypes.c_double, ctypes.c_int, ctypes.c_size_t
MASS, INERTIA, STIFFNESS_Y, STIFFNESS_YAW, LOAD, RADIUS = 1500, 1000, 2e6, 2e6, 160e3, 0.46


def structure(name, *fields):
    return type(name, (ctypes.Structure,), {"_fields_": [(word, kind) for kind, words in fields
                                                         for word in words.split()]})


Error = structure("Error", (I, "code"), (ctypes.c_char * 1000, "message"))
State = structure("State", (Z, "size"), (I, "given"),
                  (D, "y z yaw roll speed y_rate z_rate yaw_rate roll_rate pitch_rate load roll_moment"),
                  (D * 2, "rail_y rail_z rail_roll rail_y_rate rail_z_rate"))
Wheel = structure("Wheel", (D * 3, "force moment"), (D, "normal_force lateral_force spin_moment creepage_x creepage_y"),
                  (D, "spin approach"), (D * 3, "point"), (D * 2, "on_wheel on_rail"),
                  (D, "contact_angle rolling_radius p_max patch_area dissipation"),
                  (I, "patches cells checks_hold reserved"))
Forces = structure("Forces", (Z, "size"), (D, "z roll"), (D * 3, "force moment"), (Wheel * 2, "wheel"),
                   (I, "solutions reserved"))


class Wheelset:
    def __init__(self, library, case, speed, springs):
        self.rs = ctypes.CDLL(library)
        self.rs.rs_wheelset_new.restype = self.rs.rs_wheelset_contact.restype = ctypes.c_void_p
        self.error, self.forces = Error(), Forces(size=ctypes.sizeof(Forces))
        made = self.rs.rs_wheelset_new(case.encode(), None, 0, None, 0, ctypes.byref(self.error))
        if not made:
            raise ValueError(self.error.message.decode())
        self.handle, self.speed, self.springs = ctypes.c_void_p(made), speed, springs
        self.pitch_rate = 0
        for side in (0, 1):
            self.rs.rs_set_cell(ctypes.c_void_p(self.rs.rs_wheelset_contact(self.handle, side)), D(1e-3), None)
        self.rates(0, np.zeros(4))  # wheels roll freely in the middle of the track
        self.pitch_rate = speed / self.forces.wheel[0].rolling_radius - speed / RADIUS

    def rates(self, x, q):
        y, yaw, y_rate, yaw_rate = map(float, q)
        aside = 0.25e-3 * (1 - math.cos(math.pi * min(x, 2) / 2))
        state = State(size=ctypes.sizeof(State), given=4, load=LOAD, speed=self.speed, y=y, yaw=yaw, y_rate=y_rate,
                      yaw_rate=yaw_rate, pitch_rate=self.pitch_rate, rail_y=(aside, aside))
        by_reference = ctypes.byref
        if self.rs.rs_wheelset_solve(self.handle, by_reference(state), by_reference(self.forces),
                                     by_reference(self.error)):
            raise ValueError(self.error.message.decode())
        return np.array([y_rate, yaw_rate, (self.forces.force[1] - self.springs * STIFFNESS_Y * y) / MASS,
                         (self.forces.moment[2] - self.springs * STIFFNESS_YAW * yaw) / INERTIA])

    def jacobian(self):
        steps = np.diag([1e-4, 1e-4, 1e-3, 1e-3])
        return np.array([(self.rates(0, s) - self.rates(0, -s)) / (2 * s.max()) for s in steps]).T


def main(library, case, *numbers):
    speed, springs, step, length = map(float, numbers)
    wheelset = Wheelset(library, case, speed, springs)
    jacobian, gamma, h = wheelset.jacobian(), 1 - math.sqrt(0.5), step / speed
    if length == 0:
        slow = min(np.linalg.eigvals(jacobian), key=lambda e: abs(e.real) if e.imag > 0 else math.inf)
        print(f"growth_1_m,{slow.real / speed:.6g}\nwave_m,{2 * math.pi * speed / slow.imag:.6g}")
        return
    matrix = np.eye(4) - gamma * h * jacobian
    x, q = 0.0, np.zeros(4)
    print("x_m,y_mm,yaw_mrad,radius_difference_mm")
    while x < length:
        one = wheelset.rates(x, q)
        difference = wheelset.forces.wheel[0].rolling_radius - wheelset.forces.wheel[1].rolling_radius
        print(f"{x:.4f},{1e3 * q[0]:.7f},{1e3 * q[1]:.7f},{1e3 * difference:.7f}")
        one = np.linalg.solve(matrix, one)
        two = np.linalg.solve(matrix, wheelset.rates(x + step, q + h * one) - 2 * one)
        q = q + h * (1.5 * one + 0.5 * two)
        x += step


if __name__ == "__main__":
    main(*sys.argv[1:])
