#!/usr/bin/python3
"""The two bounds of docs/checks.md, computed from elasticity. Needs numpy.

conformal   By how much one contact plane errs in the largest pressure where the profiles turn with the patch: the plane
            problem of a disc in a hole of the same material against two half-planes with the same gap under the same
            load. Compliance of disc and hole from their Airy functions r^n, r^(n+2), r^-n, r^(2-n) (Michell's series).
edge        By what factor a free side at right angles changes what a second, equal load at its mirror image does to the
            surface: the quarter-space of Hetenyi, whose two faces free each other of normal stress in turn, loaded by a
            point force at the distance 1 from the side. Fourier transform along the edge, a matrix across it."""
import argparse

import numpy as np


# ---- conformal contact
def hole_and_disc(n, nu):
    """G (u_disc + u_hole)/(p R), the radial displacements under the pressure p cos(n theta) in plane strain."""
    kappa = 3 - 4 * nu
    #        stress rr                          stress rt (sin)             2 G u_r
    disc = [(-n * (n - 1), n * (n - 1), -n), (-(n + 1) * (n - 2), n * (n + 1), kappa - n - 1)]
    hole = [(-n * (n + 1), -n * (n + 1), n), (-(n + 2) * (n - 1), -n * (n - 1), kappa + n - 1)]
    u = []
    for terms in (disc, hole):
        a = np.linalg.solve([[t[0] for t in terms], [t[1] for t in terms]], [-1.0, 0.0])
        u.append(0.5 * sum(c * t[2] for c, t in zip(a, terms)))
    return u[1] - u[0]  # the hole's surface moves out, the disc's in


def nodes(n):
    return np.cos((2 * np.arange(n) + 1) * np.pi / (2 * n))


def coefficients(t, f):
    """Of Chebyshev's polynomials through the values f at the nodes t."""
    c = 2 / len(t) * np.cos(np.outer(np.arange(len(t)), np.arccos(t))) @ f
    c[0] *= 0.5
    return c


def pressure_of(half, smooth, columns):
    """g = p sqrt(1 - t²) for every column w of  int p(s) (-ln|x - s| + smooth(x, s)) ds = w(x)  on |x| < half."""
    t = nodes(len(columns))
    k = np.arange(len(t))
    of_log = np.where(k > 0, np.pi / np.maximum(k, 1), np.pi * np.log(2))
    log = np.cos(np.outer(np.arccos(t), k)) * of_log @ np.stack([coefficients(t, e) for e in np.eye(len(t))], 1)
    x = half * t
    matrix = half * (log + np.pi / len(t) * (smooth(x[:, None], x[None, :]) - np.log(half)))
    return np.linalg.solve(matrix, columns)


def contact(half, smooth, approach_shape, gap, along):
    """Load and largest pressure of the contact that ends without a step at +-half: w = d approach_shape - gap."""
    t = nodes(len(gap))
    g = pressure_of(half, smooth, np.stack([approach_shape, gap], 1))
    ends = [coefficients(t, column).sum() for column in g.T]
    g = ends[1] / ends[0] * g[:, 0] - g[:, 1]
    middle = coefficients(t, g) @ np.cos(0.5 * np.pi * np.arange(len(t)))
    return half * np.pi / len(t) * (g @ along), middle


def disc_in_hole(angle, clearance, n=120):
    """Half-angle of the contact, clearance over the radius; the series sum of n/(n² - 1) cos(n f) in closed form."""
    def smooth(a, b):
        f = np.maximum(np.abs(a - b), 1e-9)
        return np.log(f) - np.cos(f) * np.log(2 * np.sin(0.5 * f)) - 0.25 - 0.25 * np.cos(f)
    x = angle * nodes(n)
    return contact(angle, smooth, np.cos(x), clearance * np.ones(n), np.cos(x))


def half_planes(half, clearance, n=120):
    x = half * nodes(n)
    gap = np.sqrt(1 - x**2) - np.sqrt((1 - clearance)**2 - x**2) - clearance
    return contact(half, lambda a, b: 0 * (a - b), np.ones(n), gap, np.ones(n))


def conformal():
    nu = 0.3
    for n in (2, 3, 7):
        assert abs(hole_and_disc(n, nu) / (2 * (1 - nu) * n / (n * n - 1)) - 1) < 1e-12
    print("angle spanned   p_max of half-planes   (error)/(half angle)²")
    for spanned in (10, 15, 20, 25, 30, 40, 50):
        angle, clearance = np.radians(0.5 * spanned), 1e-5
        load, p_max = disc_in_hole(angle, clearance)
        low, high = 0.5 * angle, 1.5 * angle
        while high - low > 1e-12:
            middle = 0.5 * (low + high)
            low, high = (middle, high) if half_planes(middle, clearance)[0] < load else (low, middle)
        error = half_planes(low, clearance)[1] / p_max - 1
        print(f"{spanned:10d}°   {100 * error:+17.2f} %   {-error / angle**2:19.3f}")


# ---- edge
def stress_across(x, y, z, nu):
    """sigma_xx at (x, y, z) below a unit force on the plane z = 0 [Johnson1985 eq. 3.19a], regular at r = 0."""
    r2, rho = x * x + y * y, np.sqrt(x * x + y * y + z * z)
    of_poisson = ((x * x - y * y) / (rho * (rho + z)) + z * y * y / rho**3) / r2
    return ((1 - 2 * nu) * of_poisson - 3 * z * x * x / rho**5) / (2 * np.pi)


def bessel_k0(a):
    t = np.linspace(0, 12, 1201)
    weight = np.where(t > 0, 0.01, 0.005)
    return sum(w * np.exp(-a * np.cosh(s)) for s, w in zip(t, weight))


def along_edge(k, smallest):
    """Nodes and weights of integrals over y of an even function times cos(k y)."""
    fine = np.linspace(np.log(smallest), np.log(1 / k), 260)
    coarse = np.linspace(1 / k, 60 / k, 800)
    y = np.concatenate([np.exp(fine), coarse])
    steps = np.concatenate([np.exp(fine) * (fine[1] - fine[0]), np.full(800, coarse[1] - coarse[0])])
    for i in (0, 259, 260, 1059):
        steps[i] *= 0.5
    steps[0] += smallest
    return y, 2 * steps * np.cos(k * y)


def added_pressure(x, k, nu):
    """What the top face carries besides the force, at the distances x from the edge, transformed along it:
    p_top = force + T p_side, p_side = T p_top, T twice the normal stress by a face's own pressure on the other's
    plane; twice, for its mirror image keeps that plane free of shear."""
    y, weight = along_edge(k, 1e-4 * x[0])
    stress = lambda a, b: 2 * (stress_across(a[..., None], y, b[..., None], nu) @ weight)
    step = x * np.log(x[1] / x[0])
    transfer = np.array([stress(x, np.full(len(x), z)) for z in x]) * step
    return np.linalg.solve(np.eye(len(x)) - transfer @ transfer, transfer @ stress(np.ones(len(x)), x))


def cubic(x, f, at):
    """Of a function on equal steps of ln x."""
    u = (np.log(np.clip(at, x[0], x[-1])) - np.log(x[0])) / np.log(x[1] / x[0])
    i = np.clip(u.astype(int), 1, len(x) - 3)
    t = u - i
    return (-t * (t - 1) * (t - 2) / 6 * f[i - 1] + (t + 1) * (t - 1) * (t - 2) / 2 * f[i] -
            (t + 1) * t * (t - 2) / 2 * f[i + 1] + (t + 1) * t * (t - 1) / 6 * f[i + 2])


def displacement(at, x, numbers, pressures):
    """pi E/((1 - nu²) P) u_z on the top face by the added pressure and its image; a point force gives 1/distance."""
    near = np.exp(np.linspace(np.log(1e-9), np.log(at - x[0]), 300))
    far = np.exp(np.linspace(np.log(1e-9), np.log(x[-1] - at), 300))
    s = np.concatenate([at - near[::-1], at + far])
    parts = []
    for k, p in zip(numbers, pressures):
        f = cubic(x, p, s) * 2 * (bessel_k0(k * np.abs(at - s)) + bessel_k0(k * (at + s)))
        parts.append(np.sum(0.5 * (f[1:] + f[:-1]) * np.diff(s)))
    g = np.array(parts) * numbers
    return (np.sum(0.5 * (g[1:] + g[:-1]) * np.diff(np.log(numbers))) + g[0]) / np.pi


def edge():
    h = 0.2
    numbers = np.geomspace(0.02, 12, 28)
    image = 2 / 2**3  # d²/dx² of 1/(1 + x) at x = 1
    print("Poisson   curvature over that of the image alone   in (b/2D)³")
    for nu in (0.25, 0.3, 0.35):
        x = np.geomspace(1e-3, 30, 60)
        pressures = [added_pressure(x, k, nu) for k in numbers]
        u = [displacement(at, x, numbers, pressures) for at in (1 - h, 1, 1 + h)]
        factor = 1 + (u[0] - 2 * u[1] + u[2]) / h**2 / image
        # of Hertz's circle N = (4/3) E* b³/R: image 2 N/(pi E* (2D)³) over 1/R
        print(f"{nu:7.2f}   {factor:38.2f}   {8 / (3 * np.pi) * factor:12.2f}")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", choices=["conformal", "edge"])
    only = parser.parse_args().only
    for bound in (conformal, edge):
        if only in (None, bound.__name__):
            bound()
