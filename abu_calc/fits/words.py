"""Probabilities in the words of a shop."""


def of_all(probability: float, things: str = "pairs") -> str:
    """A share of pairs or bearings, as one would count them.

    >>> [of_all(p) for p in (0.0, 2e-6, 0.0031, 0.554)]
    ['no pairs', '2 of a million pairs', '3 of 1000 pairs', '55 of 100 pairs']
    >>> [of_all(p, "bearings") for p in (1e-12, 0.99996, 1.0)]
    ['under 1 of a million bearings', 'all but 40 of a million bearings', 'all bearings']
    """
    if probability in (0.0, 1.0):
        return f"{'all' if probability else 'no'} {things}"
    if probability > 0.995:
        return f"nearly all {things}" if 1 - probability < 1e-6 else f"all but {of_all(1 - probability, things)}"
    if probability < 1e-6:
        return f"under 1 of a million {things}"
    for total, name, least in ((100, "100", 5), (1000, "1000", 1), (10_000, "10000", 1)):
        if round(probability * total) >= least:
            return f"{round(probability * total)} of {name} {things}"
    return f"{round(probability * 1e6)} of a million {things}"
