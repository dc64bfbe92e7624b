"""Quadratic programs by the package cvxopt, for quadratic_peer.h: reads numbers from standard input, for each
program n, m, then H, g, A, lower, upper row by row, and prints a line with the minimum and x for each.
"""
import math
import os
import sys

os.environ["OPENBLAS_NUM_THREADS"] = "1"  # threads cost more than they save on matrices this small

from cvxopt import matrix, solvers

solvers.options.update(show_progress=False, abstol=1e-11, reltol=1e-11, feastol=1e-11)
numbers = iter(map(float, sys.stdin.read().split()))


def read(rows, columns=1):
    return matrix([[next(numbers) for _ in range(columns)] for _ in range(rows)]).trans()


for n in numbers:
    n, m = int(n), int(next(numbers))
    H, g, A, lower, upper = read(n, n), read(n), read(m, n), read(m), read(m)
    equal = [i for i in range(m) if lower[i] == upper[i]]
    above = [i for i in range(m) if lower[i] != upper[i] < math.inf]
    below = [i for i in range(m) if upper[i] != lower[i] > -math.inf]
    G = matrix([A[above, :], -A[below, :]])
    h = matrix([upper[above], -lower[below]])
    solution = solvers.qp(H, g, G, h, A[equal, :], upper[equal])
    print(solution["primal objective"], *solution["x"])
