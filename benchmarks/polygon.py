"""Convex polygons in a plane: the hull of points, and what is left of one beside a straight cut."""

import numpy as np
from numpy.typing import NDArray

EPSILON = 1e-9
Polygon = NDArray[np.float64]  # corners, of shape (n, 2); no corner: empty


def hull(points: Polygon) -> Polygon:
    """Corners of the convex hull, counter-clockwise (Andrew's monotone chain)."""
    points = points[np.lexsort((points[:, 1], points[:, 0]))]
    if len(points) < 3:
        return points
    chains = []
    for ordered in (points.tolist(), points[::-1].tolist()):
        chain: list[list[float]] = []
        for x, y in ordered:
            while len(chain) > 1:
                (ax, ay), (bx, by) = chain[-2], chain[-1]
                if (bx - ax) * (y - ay) - (by - ay) * (x - ax) > EPSILON:
                    break
                chain.pop()
            chain.append([x, y])
        chains += chain[:-1]
    return np.array(chains)


def clip(polygon: Polygon, column: int, bound: float, above: bool) -> Polygon:
    """Cut off what is below a bound of a column, or above it."""
    if len(polygon) == 0:
        return polygon
    inside = (polygon[:, column] - bound) * (1.0 if above else -1.0)
    kept = []
    for k in range(len(polygon)):
        here, before = inside[k], inside[k - 1]
        if here * before < 0.0:
            share = before / (before - here)
            kept.append(polygon[k - 1] + share * (polygon[k] - polygon[k - 1]))
        if here >= 0.0:
            kept.append(polygon[k])
    return np.array(kept) if kept else np.empty((0, 2))
