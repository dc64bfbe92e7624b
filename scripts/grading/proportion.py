"""How often something happens, from how often it did."""

import math


def upper_bound(events, trials, doubt=0.05):
    """The largest probability under which so few events of so many trials come with a probability of `doubt` or more.

    Clopper and Pearson's bound; 1 - doubt^(1/trials), about 3 / trials for 5 %, where nothing happened.
    """
    if events >= trials:
        return 1.0

    def so_few(p):
        return sum(math.comb(trials, k) * p**k * (1 - p) ** (trials - k) for k in range(events + 1))

    low, high = 0.0, 1.0
    for _ in range(100):
        middle = (low + high) / 2
        low, high = (middle, high) if so_few(middle) > doubt else (low, middle)
    return high
