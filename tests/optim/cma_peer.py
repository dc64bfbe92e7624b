"""CMA-ES by the package cmaes, for cma_peer_test.cpp: reads a request from standard input and prints numbers.

follow N LAMBDA SIGMA, mean, then generations of LAMBDA lines "x... value":
    after each generation a line with mean, sigma and C row by row, as learnt from those very samples.
race FUNCTION N LOW HIGH SIGMA TARGET SEEDS: for each seed the evaluations until the target, or 0 without success.
"""
import math
import os
import sys

os.environ["OPENBLAS_NUM_THREADS"] = "1"  # threads cost more than they save on matrices this small

import numpy as np
from cmaes import CMA

FUNCTIONS = {
    "sphere": lambda x: np.sum(x**2),
    "ellipsoid": lambda x: np.sum(10 ** (6 * np.arange(len(x)) / (len(x) - 1)) * x**2),
    "rosenbrock": lambda x: np.sum(100 * (x[1:] - x[:-1] ** 2) ** 2 + (1 - x[:-1]) ** 2),
    "ackley": lambda x: 20 + math.e - 20 * np.exp(-0.2 * np.sqrt(np.mean(x**2)))
    - np.exp(np.mean(np.cos(2 * np.pi * x))),
}


def follow(words, lines):
    n, count, sigma = int(words[0]), int(words[1]), float(words[2])
    es = CMA(mean=np.array(lines[0]), sigma=sigma, population_size=count)
    for begin in range(1, len(lines), count):
        es.tell([(np.array(line[:n]), line[n]) for line in lines[begin : begin + count]])
        es._eigen_decomposition()
        print(*es._mean.tolist(), float(es._sigma), *es._C.flatten().tolist())


def race(words):
    f, n = FUNCTIONS[words[0]], int(words[1])
    low, high, sigma, target = (float(word) for word in words[2:6])
    for seed in range(int(words[6])):
        start = np.random.RandomState(1000 + seed).uniform(low, high, n)
        es = CMA(mean=start, sigma=sigma, seed=seed)
        evaluations, best = 0, math.inf
        while best > target and evaluations < 50000 and not es.should_stop():
            points = [es.ask() for _ in range(es.population_size)]
            values = [f(x) for x in points]
            es.tell(list(zip(points, values)))
            evaluations += len(values)
            best = min(best, *values)
        print(evaluations if best <= target else 0)


request, *rest = sys.stdin.read().splitlines()
kind, *arguments = request.split()
if kind == "follow":
    follow(arguments, [[float(word) for word in line.split()] for line in rest])
else:
    race(arguments)
